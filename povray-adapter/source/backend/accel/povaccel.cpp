/*******************************************************************************
 * povaccel.cpp
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module implements Bounding_Method=3, which answers POV-Ray's ray queries
 * through the accel library. It is a derivative work of POV-Ray 3.7.0.10; see
 * LICENSE.
 *
 * The answers are those of POV-Ray's linear search (-MB), bit for bit: the leaf
 * test of an object is POV-Ray's own and does not depend on the other objects,
 * the library offers each object whose box the ray meets, and orders what they
 * report by (depth, place in the scene). What this rests on: the boxes that
 * povaccelbox.cpp finds hold all hits.
 *******************************************************************************/

#include <algorithm>
#include <cfloat>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iterator>

#include <boost/format.hpp>
#include <boost/thread.hpp>

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"

#include "base/povmsgid.h"
#include "base/timer.h"

#include "backend/accel/povaccel.h"
#include "backend/accel/povaccelbox.h"
#include "backend/accel/povaccelcsg.h"
#include "backend/accel/povaccelquery.h"
#include "backend/control/messagefactory.h"
#include "backend/control/renderbackend.h"
#include "backend/render/trace.h"
#include "backend/scene/objects.h"
#include "backend/scene/scene.h"
#include "backend/shape/isosurf.h"
#include "backend/support/task.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

using boost::format;



/*****************************************************************************
 *
 * Options and build
 *
 *****************************************************************************/

Accelerator::Accelerator(POVMS_Object& options) :
	chosen(options.TryGetInt(kPOVAttrib_BoundingMethod, 1) == 3),
	mentioned(options.Exist(kPOVAttrib_Accelerator) || options.Exist(kPOVAttrib_AcceleratorVerify)),
	verify(options.TryGetBool(kPOVAttrib_AcceleratorVerify, false)),
	few(false),
	lightsLeftOut(0),
	interiorsExist(false),
	sceneData(NULL)
{
	const char *environment = getenv("POV_ACCELERATOR");

	config = options.TryGetString(kPOVAttrib_Accelerator, (environment != NULL) ? environment : "");
}

Accelerator::~Accelerator()
{
	for(int i = 0; i < ACCEL_REACHES; i++)
		accel_free(parts[i].structure);
	for(vector<AccelCsg *>::iterator i = csg.begin(); i != csg.end(); i++)
		delete *i;
}

MessageFactory Accelerator::Messages(const SceneData& scene)
{
	return MessageFactory(scene.warningLevel, OFFICIAL_VERSION_NUMBER, "Accelerator", scene.backendAddress, scene.frontendAddress, scene.sceneId, 0);
}

static void Throw_Library_Error(const accel_error& error)
{
	std::string text = std::string("Accelerator: ") + error.text;

	// a comma separates the values of an option in an INI file, so only the last part of an unquoted value arrives
	if((error.status == ACCEL_BAD_CONFIG) && (strchr(error.text, '=') != NULL))
		text += " (in an INI file, put the value of Accelerator in quotes)";

	throw POV_EXCEPTION(kParamErr, text.c_str());
}

void Accelerator::CheckOptions(const SceneData& scene) const
{
	if(mentioned && (scene.boundingMethod != 3))
		Messages(scene).Warning(1, "Accelerator and Accelerator_Verify have no effect without %s.",
		                        chosen ? "bounding (Bounding=On, +MB)" : "Bounding_Method=3 (+BM3)");

	if(chosen == false)
		return;

	// fail on a bad configuration even if the scene is too small to be bounded
	accel_scene nothing = { NULL, 0 };
	accel_error error;
	accel *empty;

	if(accel_build(&empty, &nothing, config.c_str(), NULL, &error) != ACCEL_OK)
		Throw_Library_Error(error);
	accel_free(empty);
}

/// Lets the user pause and stop a build. The library calls Report; exceptions must not pass through it.
class AccelBuildHook
{
	public:
		virtual ~AccelBuildHook() { }

		accel_hooks Hooks()
		{
			accel_hooks hooks = accel_hooks();

			hooks.user = this;
			hooks.progress = &AccelBuildHook::Report;

			return hooks;
		}

		void RethrowIfStopped() const
		{
			if(stopped)
				std::rethrow_exception(stopped);
		}
	private:
		std::exception_ptr stopped;

		/// Throws to stop.
		virtual void Cooperate(const char *phase, double done) = 0;

		static bool Report(void *user, const char *phase, double done)
		{
			AccelBuildHook& self = *reinterpret_cast<AccelBuildHook *>(user);

			try
			{
				self.Cooperate(phase, done);
			}
			catch(...)
			{
				self.stopped = std::current_exception();
				return false;
			}

			return true;
		}
};

/// For a build that a ray waits for.
class AccelRenderHook : public AccelBuildHook
{
	public:
		explicit AccelRenderHook(Trace::CooperateFunctor& c) : cooperate(c) { }
	private:
		Trace::CooperateFunctor& cooperate;

		virtual void Cooperate(const char *, double) { cooperate(); }
};

/// Lets the user watch the first build as well.
class AccelProgress : public AccelBuildHook
{
	public:
		AccelProgress(const SceneData& sd, Task& t) : scene(sd), task(t), lastProgressTime(0) { }
	private:
		const SceneData& scene;
		Task& task;
		Timer timer;
		POV_LONG lastProgressTime;

		virtual void Cooperate(const char *phase, double done)
		{
			Send(phase, done);
			task.Cooperate(); // CurrentTaskCooperate knows the tasks of the thread that made them only
		}

		void Send(const char *phase, double done)
		{
			if((timer.ElapsedRealTime() - lastProgressTime) <= 1000) // update progress at most every second
				return;
			lastProgressTime = timer.ElapsedRealTime();

			POVMS_Object obj(kPOVObjectClass_BoundingProgress);
			obj.SetLong(kPOVAttrib_RealTime, lastProgressTime);
			obj.SetLong(kPOVAttrib_CurrentNodeCount, 0);
			obj.SetString(kPOVAttrib_AcceleratorText, str(format("Building accelerator: %s %d%%") % phase % int(100.0 * done)).c_str());
			RenderBackend::SendSceneOutput(scene.sceneId, scene.frontendAddress, kPOVMsgIdent_Progress, obj);
		}
};

/// The library asks back for the hits of one object.
static void Test_Object(accel_probe *probe)
{
	AccelQuery& query = *reinterpret_cast<AccelQuery *>(probe->query->user);
	ObjectPtr object = query.objects[probe->prim];

	if(query.IsToTest(object) == false)
		return;

	query.leafTests++;
	if(query.TestLeaf(object, probe->limit) == true)
	{
		query.leafHits++;
		if(query.FirstIsBefore(probe->prim))
			return;
		if(accel_report(probe, query.candidate.Depth, 0.0, 0.0))
			query.best = query.candidate;
	}
}

/// Objects that a leaf test runs through: a CSG object tests all its parts.
static double Count_Parts(const ObjectBase *object)
{
	const CompoundObject *compound = dynamic_cast<const CompoundObject *>(object);
	double parts = 0.0;

	if((compound == NULL) || compound->children.empty())
		return 1.0;
	for(vector<ObjectPtr>::const_iterator i = compound->children.begin(); i != compound->children.end(); i++)
		parts += Count_Parts(*i);

	return parts;
}

static bool Any_Changes(const vector<ObjectPtr>& objects);

/// Does a leaf test change what the next one finds? An isosurface with `evaluate` learns its gradient.
static bool Changes_When_Tested(const ObjectBase *object)
{
	const IsoSurface *surface = dynamic_cast<const IsoSurface *>(object);
	const CompoundObject *compound = dynamic_cast<const CompoundObject *>(object);

	return ((surface != NULL) && surface->eval) || Any_Changes(object->Clip) || Any_Changes(object->Bound) ||
	       ((compound != NULL) && Any_Changes(compound->children));
}

static bool Any_Changes(const vector<ObjectPtr>& objects)
{
	bool any = false;

	for(vector<ObjectPtr>::const_iterator i = objects.begin(); i != objects.end(); i++)
		any = any || Changes_When_Tested(*i);

	return any;
}

/// A coarse grid of the rays that a perspective or orthographic camera will shoot, and about those of others. For
/// Accelerator=auto, which counts what they would visit; they decide no answer.
static vector<accel_ray> Camera_Pilot(const Camera& camera)
{
	const int side = 16;
	vector<accel_ray> pilot;

	for(int i = 0; i < side * side; i++)
	{
		const DBL x = (i % side + 0.5) / side - 0.5;
		const DBL y = (i / side + 0.5) / side - 0.5;
		VECTOR origin, direction;

		Assign_Vector(origin, camera.Location);
		Assign_Vector(direction, camera.Direction);
		VECTOR& shifted = (camera.Type == ORTHOGRAPHIC_CAMERA) ? origin : direction;
		VAddScaledEq(shifted, x, camera.Right);
		VAddScaledEq(shifted, y, camera.Up);
		pilot.push_back(accel_ray_from(origin, direction));
	}

	return pilot;
}

/// The structure over all objects, given their boxes for rays within reach of the part, which are spoiled.
void Accelerator::BuildPart(Part& part, vector<accel_box>& boxes, const accel_hooks *hooks, accel_error& error) const
{
	double tests = 0.0;

	if(verify)
		part.boxes = boxes;
	part.unbounded.clear(); // of a build that was stopped
	for(size_t i = 0; i < boxes.size(); i++)
	{
		if(!Is_Finite(boxes[i]) && !Is_Empty(boxes[i]))
		{
			part.unbounded.push_back(i);
			boxes[i] = Empty_Box();
		}
	}

	part.bounds = part.unbounded.size() < objects.size();

	for(vector<ObjectPtr>::const_iterator i = objects.begin(); i != objects.end(); i++)
		tests += Count_Parts(*i);

	accel_geometry geometry = accel_geometry();
	geometry.type = ACCEL_OBJECTS;
	geometry.objects.boxes = boxes.data();
	geometry.objects.count = boxes.size();
	geometry.objects.order = ACCEL_ORDER_RAW; // POV-Ray's own depths decide
	geometry.objects.intersect = Test_Object;
	geometry.objects.user = NULL;
	geometry.objects.cost = 100.0 * tests / max(1.0, double(objects.size())); // a test of a sphere or box: about 100 ns

	const accel_scene library_scene = { &geometry, 1 };

	part.built = (accel_build(&part.structure, &library_scene, config.c_str(), hooks, &error) == ACCEL_OK);
}

void Accelerator::TakeObjects(const SceneData& scene)
{
	AccelReach reach[ACCEL_REACHES];

	for(vector<ObjectPtr>::const_iterator i = scene.objects.begin(); i != scene.objects.end(); i++)
	{
		if(Is_Dark_Light(*i) == false)
			objects.push_back(*i);
	}
	lightsLeftOut = scene.objects.size() - objects.size();
	for(vector<ObjectPtr>::const_iterator i = objects.begin(); i != objects.end(); i++)
	{
		if(Changes_When_Tested(*i))
			changing.insert(*i);
	}
	few = (objects.size() <= MOST_FEW) && ((config == "") || (config.compare(0, 4, "auto") == 0)) && (verify == false);
	sceneData = &scene;

	Find_Reaches(scene, objects, grazings, reach, nearBoxes);
	for(int i = 0; i < ACCEL_REACHES; i++)
		parts[i].reach = reach[i];

	AccelFewBoxes partBoxes(AccelCsg::FEWEST_PARTS);
	AccelReach seen = reach[0];

	seen.observer = &partBoxes;
	insides = Find_Insides(objects, seen);
	Accel_Take_Csg(objects, reach[ACCEL_REACHES - 2], reach[0], partBoxes, csg);
}

void Accelerator::Build(const SceneData& scene, Task& task)
{
	const vector<accel_ray> pilot = Camera_Pilot(scene.parsedCamera);
	AccelProgress progress(scene, task);
	accel_hooks hooks = progress.Hooks();
	hooks.pilot = pilot.data();
	hooks.pilot_count = pilot.size();
	accel_error error;

	BuildPart(parts[0], nearBoxes, &hooks, error);
	progress.RethrowIfStopped();
	if(parts[0].built == false)
		Throw_Library_Error(error);

	FindBeyondBoxes();
	vector<accel_box>().swap(nearBoxes);
	vector<accel_box>().swap(insides);
	BuildSeenMeshes(pilot, task);
}

/// What a search for the objects around a point has to ask beside those whose box holds it.
void Accelerator::FindBeyondBoxes()
{
	const vector<uint32_t>& unbounded = parts[0].unbounded;

	for(vector<ObjectPtr>::const_iterator i = objects.begin(); i != objects.end(); i++)
		interiorsExist = interiorsExist || ((*i)->interior != NULL);
	for(int search = 0; interiorsExist && (search <= ACCEL_OF_PHOTONS); search++)
	{
		const vector<uint32_t> beyond = Objects_Beyond_Boxes(objects, nearBoxes, insides, AccelContainerSearch(search));

		std::set_union(beyond.begin(), beyond.end(), unbounded.begin(), unbounded.end(), std::back_inserter(beyondBoxes[search]));
	}
}

static boost::mutex buildMutex;

/// A part that a ray needs, built if need be.
const Accelerator::Part *Accelerator::BuiltPart(Part& part, Trace::CooperateFunctor& cooperate) const
{
	if(part.built == false)
	{
		boost::mutex::scoped_lock lock(buildMutex);
		AccelRenderHook hook(cooperate);
		const accel_hooks hooks = hook.Hooks();
		accel_error error;

		if(part.built == false)
		{
			vector<accel_box> boxes = Find_Boxes(objects, part.reach);

			BuildPart(part, boxes, &hooks, error);
			hook.RethrowIfStopped();
			if(part.built == false)
				Throw_Library_Error(error);
		}
	}
	part.queries.fetch_add(1, std::memory_order_relaxed);

	return &part;
}

/// The part whose boxes hold the hits of a ray that does not belong to the first; NULL if there is none.
const Accelerator::Part *Accelerator::FarPart(const Ray& ray, Trace::CooperateFunctor& cooperate) const
{
	const bool grazing = grazings.Holds(ray.Direction);

	for(int i = grazing ? ACCEL_REACHES - 1 : 1; i < ACCEL_REACHES; i++)
	{
		if(parts[i].reach.Holds(ray.Origin))
			return BuiltPart(parts[i], cooperate);
	}

	return NULL;
}



/*****************************************************************************
 *
 * Queries
 *
 *****************************************************************************/

bool Accelerator::FindIntersection(Trace& trace, Trace::CooperateFunctor& cooperate, TraceThreadData *thread, Intersection& bestisect,
                                   const Ray& ray) const
{
	AccelQuery query(objects, ray, NULL, NULL, thread, bestisect);

	return Find(trace, cooperate, query);
}

bool Accelerator::FindIntersection(Trace& trace, Trace::CooperateFunctor& cooperate, TraceThreadData *thread, Intersection& bestisect,
                                   const Ray& ray, const RayObjectCondition& precondition, const RayObjectCondition& postcondition) const
{
	AccelQuery query(objects, ray, &precondition, &postcondition, thread, bestisect);

	return Find(trace, cooperate, query);
}

/// The unbounded objects as a linear search would test them, then the structure for what is nearer, or as near and before them.
inline bool Accelerator::FindInPart(const Part& part, AccelQuery& query, accel_query& counters, uint32_t& index) const
{
	const DBL limit = query.best.Depth;
	accel_ray ray;
	accel_hit hit;

	for(vector<uint32_t>::const_iterator i = part.unbounded.begin(); i != part.unbounded.end(); i++)
	{
		ObjectPtr object = query.objects[*i];

		if(query.IsToTest(object) == false)
			continue;
		query.leafTests++;
		if(query.TestLeaf(object, query.best.Depth) == true)
		{
			query.leafHits++;
			if(query.candidate.Depth < query.best.Depth)
			{
				query.best = query.candidate;
				query.firstUnbounded = *i;
				query.firstDepth = query.candidate.Depth;
			}
		}
	}

	Assign_Vector(ray.org, query.ray.Origin);
	Assign_Vector(ray.dir, query.ray.Direction);
	// No leaf test reports less than MIN_ISECT_DEPTH, but that of a subsurface ray may. So an object that the ray leaves at
	// once is not asked. The interval is open.
	ray.tmin = query.ray.IsSubsurfaceRay() ? -HUGE_VAL : MIN_ISECT_DEPTH * (1.0 - DBL_EPSILON);
	ray.tmax = (query.firstUnbounded != ACCEL_NONE) ? query.firstDepth + fabs(query.firstDepth) * DBL_EPSILON + DBL_MIN : limit;
	ray.skip.geom = ray.skip.prim = ACCEL_NONE;
	hit.prim = ACCEL_NONE;

	const bool found = part.bounds && accel_closest(part.structure, &ray, &hit, &counters);

	counters.tests += part.unbounded.size();
	if(counters.refused > 0)
		query.best.Depth = limit; // the linear search will find again what was found here
	index = found ? hit.prim : query.firstUnbounded;

	return index != ACCEL_NONE;
}

/// As a linear search. Leaf tests ask boxes of their own.
bool Accelerator::FindAmongFew(AccelQuery& query, uint32_t& index) const
{
	for(size_t i = 0; i < objects.size(); i++)
	{
		if(query.IsToTest(objects[i]) == false)
			continue;
		query.leafTests++;
		if(query.TestLeaf(objects[i]) == true)
		{
			query.leafHits++;
			if(query.candidate.Depth < query.best.Depth)
			{
				query.best = query.candidate;
				index = i;
			}
		}
	}

	return index != ACCEL_NONE;
}

bool Accelerator::Find(Trace& trace, Trace::CooperateFunctor& cooperate, AccelQuery& query) const
{
	const DBL limit = query.best.Depth;
	const Part *part = NULL;
	accel_query counters = { &query, 0, 0, 0, 0 };
	uint32_t index = ACCEL_NONE;
	bool found = false;

	if((query.missed != NULL) && (changing.count(query.missed) > 0))
		query.missed = NULL;
	if(few == false)
	{
		const bool usual = parts[0].reach.Holds(query.ray.Origin) && !grazings.Holds(query.ray.Direction);

		part = usual ? &parts[0] : FarPart(query.ray, cooperate);
	}
	if(few)
		found = FindAmongFew(query, index);
	else if(part != NULL)
		found = FindInPart(*part, query, counters, index);
	else
		counters.refused = 1;

	RenderStatistics& stats = query.thread->Stats();

	// The library refuses a ray that is not finite, but POV-Ray's leaf tests may still answer it.
	if(counters.refused > 0)
		found = Search_Linearly(trace, query, query.best, index);

	stats[Accel_Queries]++;
	if(found)
		stats[Accel_Queries_Succeeded]++;
	stats[Accel_Nodes] += counters.nodes;
	stats[Accel_Box_Tests] += counters.tests;
	if(query.leafTests > 0)
	{
		stats[Accel_Leaf_Tests] += query.leafTests;
		stats[Accel_Leaf_Tests_Succeeded] += query.leafHits;
		stats[Accel_Hits_Outside] += verify ? 0 : counters.outside;
	}
	stats[Accel_Rays_Refused] += counters.refused;

	if(verify) // counts them itself, and more of them
		Verify(trace, query, (counters.refused > 0) ? NULL : part, limit, found, index);

	return found;
}


/// The library names the objects whose boxes hold a point, in the order of the scene.
static bool Note_Object(void *user, accel_id id)
{
	reinterpret_cast<vector<uint32_t> *>(user)->push_back(id.prim);
	return true;
}

void Accelerator::FindContainingInteriors(const VECTOR point, AccelContainerSearch search, TraceThreadData *thread, RayInteriorVector& interiors) const
{
	if(interiorsExist == false)
		return;

	AccelPointQuery query(objects, point, search, thread);
	accel_query counters = { NULL, 0, 0, 0, 0 };
	RenderStatistics& stats = thread->Stats();
	const vector<uint32_t>& beyond = beyondBoxes[search];
	vector<uint32_t> named;

	if(few == false)
		accel_point(parts[0].structure, point, Note_Object, &named, &counters);
	if(few || (counters.refused > 0) || !parts[0].reach.Holds(point))
		query.SearchLinearly();
	else
	{
		// both lists rise
		for(size_t i = 0, j = 0; (i < named.size()) || (j < beyond.size()); )
		{
			const uint32_t a = (i < named.size()) ? named[i] : ACCEL_NONE, b = (j < beyond.size()) ? beyond[j] : ACCEL_NONE;

			i += (a <= b);
			j += (b <= a);
			query.Test(objects[min(a, b)]);
		}
	}

	stats[Accel_Queries]++;
	if(query.found.empty() == false)
		stats[Accel_Queries_Succeeded]++;
	stats[Accel_Nodes] += counters.nodes;
	stats[Accel_Box_Tests] += counters.tests;
	stats[Accel_Rays_Refused] += counters.refused;

	if(verify)
		VerifyInteriors(query);
	for(vector<ObjectPtr>::const_iterator object = query.found.begin(); object != query.found.end(); object++)
		interiors.push_back((*object)->interior);
}

}
