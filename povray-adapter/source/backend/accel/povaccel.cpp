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
#include "backend/accel/povaccelquery.h"
#include "backend/control/messagefactory.h"
#include "backend/control/renderbackend.h"
#include "backend/render/trace.h"
#include "backend/scene/objects.h"
#include "backend/scene/scene.h"
#include "backend/support/task.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

using boost::format;

static bool Never_Hit(const ObjectBase *object)
{
	const LightSource *light = dynamic_cast<const LightSource *>(object);

	return (light != NULL) && light->children.empty();
}



/*****************************************************************************
 *
 * Options and build
 *
 *****************************************************************************/

Accelerator::Accelerator(POVMS_Object& options) :
	chosen(options.TryGetInt(kPOVAttrib_BoundingMethod, 1) == 3),
	mentioned(options.Exist(kPOVAttrib_Accelerator) || options.Exist(kPOVAttrib_AcceleratorVerify)),
	verify(options.TryGetBool(kPOVAttrib_AcceleratorVerify, false)),
	lightsLeftOut(0),
	sceneData(NULL)
{
	const char *environment = getenv("POV_ACCELERATOR");

	config = options.TryGetString(kPOVAttrib_Accelerator, (environment != NULL) ? environment : "");
}

Accelerator::~Accelerator()
{
	for(int i = 0; i < ACCEL_REACHES; i++)
		accel_free(parts[i].structure);
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

/// Lets the user watch, pause and stop a build.
class AccelProgress
{
	public:
		AccelProgress(const SceneData& sd, Task& t) : scene(sd), task(t), lastProgressTime(0) { }

		/// The library calls this; exceptions must not pass through it.
		static bool Report(void *user, const char *phase, double done)
		{
			AccelProgress& self = *reinterpret_cast<AccelProgress *>(user);

			try
			{
				self.Send(phase, done);
				self.task.Cooperate(); // CurrentTaskCooperate knows the tasks of the thread that made them only
			}
			catch(...)
			{
				self.stopped = std::current_exception();
				return false;
			}

			return true;
		}

		void RethrowIfStopped() const
		{
			if(stopped)
				std::rethrow_exception(stopped);
		}
	private:
		const SceneData& scene;
		Task& task;
		Timer timer;
		POV_LONG lastProgressTime;
		std::exception_ptr stopped;

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

	if(query.MayHit(object) == false)
		return;

	query.leafTests++;
	if(query.TestLeaf(object, probe->limit) == true)
	{
		query.leafHits++;
		// of equal depths the first object counts
		if((query.candidate.Depth == query.firstDepth) && (probe->prim > query.firstUnbounded))
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

/// The structure over all objects, for rays that begin within reach of the part.
void Accelerator::BuildPart(Part& part, const accel_hooks *hooks, accel_error& error) const
{
	vector<accel_box> boxes = Find_Boxes(objects, part.reach);
	double tests = 0.0;

	if(verify)
		part.boxes = boxes;
	for(size_t i = 0; i < boxes.size(); i++)
	{
		if(!Is_Finite(boxes[i]) && !Is_Empty(boxes[i]))
		{
			part.unbounded.push_back(i);
			boxes[i] = Empty_Box();
		}
	}

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

void Accelerator::Build(const SceneData& scene, Task& task)
{
	for(vector<ObjectPtr>::const_iterator i = scene.objects.begin(); i != scene.objects.end(); i++)
	{
		if(Never_Hit(*i) == false)
			objects.push_back(*i);
	}
	lightsLeftOut = scene.objects.size() - objects.size();
	sceneData = &scene;

	AccelReach reach[ACCEL_REACHES];

	Find_Reaches(scene, objects, reach);
	for(int i = 0; i < ACCEL_REACHES; i++)
		parts[i].reach = reach[i];
	beyondBoxes = Objects_Beyond_Boxes(objects, reach[0]);

	const vector<accel_ray> pilot = Camera_Pilot(scene.parsedCamera);
	AccelProgress progress(scene, task);
	accel_hooks hooks = accel_hooks();
	hooks.user = &progress;
	hooks.progress = &AccelProgress::Report;
	hooks.pilot = pilot.data();
	hooks.pilot_count = pilot.size();
	accel_error error;

	BuildPart(parts[0], &hooks, error);
	progress.RethrowIfStopped();
	if(parts[0].built == false)
		Throw_Library_Error(error);

	vector<uint32_t> beyond;

	std::set_union(beyondBoxes.begin(), beyondBoxes.end(), parts[0].unbounded.begin(), parts[0].unbounded.end(), std::back_inserter(beyond));
	beyondBoxes.swap(beyond);
	BuildSeenMeshes(pilot, task);
}

static boost::mutex buildMutex;

/// The part whose boxes hold the hits of a ray from there, which is built if need be; NULL if there is none.
const Accelerator::Part *Accelerator::ChoosePart(const VECTOR origin) const
{
	if(parts[0].reach.Holds(origin))
		return &parts[0];
	for(int i = 1; i < ACCEL_REACHES; i++)
	{
		Part& part = parts[i];

		if(part.reach.Holds(origin))
		{
			if(part.built == false)
			{
				boost::mutex::scoped_lock lock(buildMutex);
				accel_error error;

				if(part.built == false)
				{
					BuildPart(part, NULL, error);
					if(part.built == false)
						Throw_Library_Error(error);
				}
			}
			part.queries.fetch_add(1, std::memory_order_relaxed);
			return &part;
		}
	}

	return NULL;
}



/*****************************************************************************
 *
 * Queries
 *
 *****************************************************************************/

bool Accelerator::FindIntersection(Trace& trace, TraceThreadData *thread, Intersection& bestisect, const Ray& ray) const
{
	AccelQuery query(objects, ray, NULL, NULL, thread, bestisect);

	return Find(trace, query);
}

bool Accelerator::FindIntersection(Trace& trace, TraceThreadData *thread, Intersection& bestisect, const Ray& ray,
                                   const RayObjectCondition& precondition, const RayObjectCondition& postcondition) const
{
	AccelQuery query(objects, ray, &precondition, &postcondition, thread, bestisect);

	return Find(trace, query);
}

/// The unbounded objects as a linear search would test them, then the structure for what is nearer, or as near and before them.
bool Accelerator::FindInPart(const Part& part, AccelQuery& query, accel_query& counters, uint32_t& index) const
{
	const DBL limit = query.best.Depth;
	accel_ray ray;
	accel_hit hit;

	for(vector<uint32_t>::const_iterator i = part.unbounded.begin(); i != part.unbounded.end(); i++)
	{
		ObjectPtr object = query.objects[*i];

		if(query.MayHit(object) == false)
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
	// The leaf test of a subsurface ray has no lower limit for the depth; all others report at least MIN_ISECT_DEPTH.
	ray.tmin = query.ray.IsSubsurfaceRay() ? -HUGE_VAL : 0.0;
	ray.tmax = (query.firstUnbounded != ACCEL_NONE) ? nextafter(query.firstDepth, HUGE_VAL) : limit;
	ray.skip.geom = ray.skip.prim = ACCEL_NONE;
	hit.prim = ACCEL_NONE;

	const bool found = (part.unbounded.size() < objects.size()) && accel_closest(part.structure, &ray, &hit, &counters);

	counters.tests += part.unbounded.size();
	if(counters.refused > 0)
		query.best.Depth = limit; // the linear search will find again what was found here
	index = found ? hit.prim : query.firstUnbounded;

	return index != ACCEL_NONE;
}

bool Accelerator::Find(Trace& trace, AccelQuery& query) const
{
	const DBL limit = query.best.Depth;
	const Part *part = ChoosePart(query.ray.Origin);
	accel_query counters = { &query, 0, 0, 0, 0 };
	uint32_t index = ACCEL_NONE;
	bool found = false;

	if(part != NULL)
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
	stats[Accel_Leaf_Tests] += query.leafTests;
	stats[Accel_Leaf_Tests_Succeeded] += query.leafHits;
	stats[Accel_Rays_Refused] += counters.refused;

	if(verify == false)
		stats[Accel_Hits_Outside] += counters.outside;
	else // counts them itself, and more of them
		Verify(trace, query, (counters.refused > 0) ? NULL : part, limit, found, index);

	return found;
}


/// The library names the objects whose boxes hold a point, in the order of the scene.
static bool Note_Object(void *user, accel_id id)
{
	reinterpret_cast<vector<uint32_t> *>(user)->push_back(id.prim);
	return true;
}

void Accelerator::FindContainingInteriors(const VECTOR point, TraceThreadData *thread, RayInteriorVector& interiors) const
{
	AccelPointQuery query(objects, point, thread);
	accel_query counters = { NULL, 0, 0, 0, 0 };
	RenderStatistics& stats = thread->Stats();
	vector<uint32_t> named, candidates;

	accel_point(parts[0].structure, point, Note_Object, &named, &counters);
	std::set_union(named.begin(), named.end(), beyondBoxes.begin(), beyondBoxes.end(), std::back_inserter(candidates));
	if(counters.refused > 0)
		query.SearchLinearly();
	else
	{
		for(vector<uint32_t>::const_iterator i = candidates.begin(); i != candidates.end(); i++)
			query.Test(objects[*i]);
	}

	stats[Accel_Queries]++;
	if(query.found.empty() == false)
		stats[Accel_Queries_Succeeded]++;
	stats[Accel_Nodes] += counters.nodes;
	stats[Accel_Box_Tests] += counters.tests;
	stats[Accel_Rays_Refused] += counters.refused;

	if(verify)
		VerifyInteriors(point, thread, query.found);
	for(vector<ObjectPtr>::const_iterator object = query.found.begin(); object != query.found.end(); object++)
		interiors.push_back((*object)->interior);
}



/*****************************************************************************
 *
 * Statistics
 *
 *****************************************************************************/

static std::string Describe_Structure(const accel_info& info, size_t unbounded, size_t lightsLeftOut)
{
	std::string text = str(format("Accelerator:      %s\n") % info.config);

	text += str(format("  Objects:        %10d   Unbounded:       %10d   Lights left out: %d\n") % info.primitives % unbounded % lightsLeftOut);
	if(info.clusters > 0)
		text += str(format("  Clusters:       %10d   Size classes:    %10d\n") % info.clusters % info.size_classes);
	text += str(format("  Nodes:          %10d   Leaves:          %10d   Maximum depth: %d\n") % info.nodes % info.leaves % info.depth);
	text += str(format("  References:     %10d   Memory:       %9d KiB   Peak: %d KiB\n") % info.references % ((info.bytes + 1023) / 1024) % ((info.peak_bytes + 1023) / 1024));
	text += str(format("  Build time:     %10.3f s") % info.seconds);
	for(uint32_t i = 0; i < info.phase_count; i++)
		text += str(format("%s %s %.3f") % ((i == 0) ? " =" : " +") % info.phases[i].name % info.phases[i].seconds);
	text += "\n";
	for(uint32_t i = 0; i < info.left_out_count; i++)
		text += str(format("  Left out: %s: %d bytes, %.2g s\n") % info.left_out[i].what % info.left_out[i].bytes % info.left_out[i].seconds);
	for(uint32_t i = 0; i < info.note_count; i++)
		text += str(format("  Note: %s\n") % info.notes[i]);

	return text;
}

void Accelerator::GetStatistics(POVMS_Object& parserStats) const
{
	if(parts[0].structure != NULL)
	{
		accel_info info;

		accel_describe(parts[0].structure, &info);
		parserStats.SetString(kPOVAttrib_AcceleratorText, Describe_Structure(info, parts[0].unbounded.size(), lightsLeftOut).c_str());
	}
	else if(chosen)
		parserStats.SetString(kPOVAttrib_AcceleratorText, "Accelerator:      none, linear search (bounding is off, or there are few objects)\n");
}

/// What rays have built of a lazy structure.
static std::string Describe_Built(const accel *structure)
{
	accel_info info;

	accel_describe(structure, &info);
	if((info.unbuilt_clusters == 0) && (info.lazy_bytes == 0))
		return "";

	const POV_ULONG bounded = info.primitives - info.skipped - info.degenerate - info.unbounded;

	return str(format("Accelerator built:    %d of %d clusters, %d of %d objects, %d KiB\n") %
	           (info.clusters - info.unbuilt_clusters) % info.clusters % (bounded - info.unbuilt_primitives) % bounded %
	           ((info.lazy_bytes + 1023) / 1024));
}

/// What was built for rays that begin far from the camera.
static std::string Describe_Far(const accel *structure, POV_ULONG queries, DBL radius)
{
	accel_info info;

	accel_describe(structure, &info);

	return str(format("Accelerator far:      %13d   (rays from over %.2g away, for which %d KiB were built in %.3f s)\n") %
	           queries % radius % ((info.bytes + 1023) / 1024) % info.seconds);
}

/// What rays have built in meshes.
static std::string Describe_Meshes(const AccelMeshTotals& totals)
{
	std::string text = str(format("Accelerator meshes:   %d of %d built, %d triangles, %d KiB, %.3f s\n") %
	                       totals.built % totals.meshes % totals.triangles % ((totals.bytes + 1023) / 1024) % (totals.milliseconds / 1000.0));

	if(totals.loose > 0)
		text += str(format("Accelerator loose:    %13d   (triangles of meshes that are flat as they are rounded; any ray may meet them)\n") % totals.loose);

	return text;
}

void Accelerator::GetStatistics(POVMS_Object& renderStats, const RenderStatistics& stats) const
{
	const POV_ULONG outside = stats[Accel_Hits_Outside];
	const POV_ULONG refused = stats[Accel_Rays_Refused];
	const POV_ULONG verified = stats[Accel_Queries_Verified];
	const POV_ULONG different = stats[Accel_Queries_Different];
	std::string text;

	if(parts[0].structure != NULL)
		text += Describe_Built(parts[0].structure);
	for(int i = 1; i < ACCEL_REACHES; i++)
	{
		if(parts[i].built)
			text += Describe_Far(parts[i].structure, parts[i].queries, parts[i - 1].reach.radius);
	}
	if(meshTotals.meshes > 0)
		text += Describe_Meshes(meshTotals);
	if(verified > 0)
		text += str(format("Accelerator verified: %13d   Differences:     %15d\n") % verified % different);
	if(refused > 0)
		text += str(format("Accelerator refused:  %13d   (rays that are not finite, or begin too far away; searched linearly)\n") % refused);
	if(verified > 0)
		text += str(format("Accelerator outside:  %13d   (of all hits of all objects: outside the box of their object)\n") % outside);
	else if(outside > 0)
		text += str(format("Accelerator outside:  %13d   (hits before the box of their object, which may be too small)\n") % outside);
	if(text.empty() == false)
		renderStats.SetString(kPOVAttrib_AcceleratorText, text.c_str());
}

}
