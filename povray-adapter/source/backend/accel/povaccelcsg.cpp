/*******************************************************************************
 * povaccelcsg.cpp
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module answers for CSG objects of many parts, by a structure over the boxes
 * of their parts: which parts may a ray hit, and for which may a point be inside or
 * outside? POV-Ray tests all of them. The candidates go through the tests of csg.cpp
 * in the same order, so that the hits, and their order on the stack, are the same.
 *
 * What it rests on is what the boxes of povaccelbox.cpp say. It costs about as much
 * as two tests of a part, so few parts are left to POV-Ray. It is bad at parts that
 * overlap everywhere. It is a derivative work of POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

#include <algorithm>
#include <set>

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"

#include "backend/accel/povaccelbox.h"
#include "backend/accel/povaccelcsg.h"
#include "backend/accel/povaccelregion.h"
#include "backend/scene/objects.h"
#include "backend/scene/threaddata.h"
#include "backend/shape/csg.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

/*****************************************************************************
 *
 * The structure
 *
 *****************************************************************************/

AccelCsg::AccelCsg(CompoundObject& o, AccelOperation op, const AccelReach& reach) :
	object(o), parts(o.children), operation(op), measured(false)
{
	levels[FAR].reach = reach;
}

AccelCsg::AccelCsg(CompoundObject& o, AccelOperation op, const AccelReach& reach, const AccelFewParts& f) :
	object(o), parts(o.children), operation(op), few(f), measured(true)
{
	levels[FAR].reach = reach;
}

AccelCsg::~AccelCsg()
{
	for(int i = 0; i < LEVELS; i++)
		accel_free(levels[i].structure);
}

size_t AccelCsg::Bytes() const
{
	size_t bytes = few.Bytes();

	for(int i = 0; i < LEVELS; i++)
	{
		accel_info info;

		if(levels[i].structure == NULL)
			continue;
		accel_describe(levels[i].structure, &info);
		bytes += info.bytes;
	}

	return bytes;
}

/// Adds those that are always near, in order.
static void Add_Rising(AccelPlaces& near, const vector<uint32_t>& always)
{
	const size_t count = near.size();

	near.insert(near.end(), always.begin(), always.end());
	std::inplace_merge(near.begin(), near.begin() + count, near.end());
}

/// All that csg.cpp asks.
template<class Places> static void Name_All(Places& places, const vector<ObjectPtr>& parts)
{
	places.clear();
	for(size_t i = 0; i < parts.size(); i++)
	{
		if(Is_Dark_Light(parts[i]) == false)
			places.push_back(i);
	}
}

/// Notes a part whose box the ray meets, and reports no hit, so that all others are offered too.
static void Note_Part(accel_probe *probe)
{
	static_cast<AccelPlaces *>(probe->query->user)->push_back(probe->prim);
}

void AccelCsg::Build(Level& level) const
{
	vector<accel_box> boxes;

	Find_Part_Boxes(parts, operation == ACCEL_INTERSECTION, level.reach, boxes, level.always);

	accel_geometry geometry = accel_geometry();
	geometry.type = ACCEL_OBJECTS;
	geometry.objects.boxes = boxes.data();
	geometry.objects.count = boxes.size();
	geometry.objects.order = ACCEL_ORDER_RAW;
	geometry.objects.intersect = Note_Part;

	const accel_scene scene = { &geometry, 1 };
	accel_error error;

	if(accel_build(&level.structure, &scene, "bvh", NULL, &error) != ACCEL_OK)
		Name_All(level.always, parts); // no memory, say: then all parts are asked, as ever
}

/// The level for rays from there, or a point there; NULL if there is none. Built if need be.
const AccelCsg::Level *AccelCsg::Choose(const VECTOR where) const
{
	if(measured == false)
	{
		boost::mutex::scoped_lock lock(mutex);

		if(measured == false)
			levels[NEAR].reach = Find_Near_Reach(parts, levels[FAR].reach);
		measured = true;
	}
	for(int i = 0; i < LEVELS; i++)
	{
		Level& level = levels[i];

		if(level.reach.Holds(where) == false)
			continue;
		if(level.built == false)
		{
			boost::mutex::scoped_lock lock(mutex);

			if(level.built == false)
				Build(level);
			level.built = true;
		}
		return &level;
	}

	return NULL;
}

bool AccelCsg::Answers(const VECTOR where, const TraceThreadData *thread) const
{
	return levels[FAR].reach.Holds(where) && (thread->accelPlain == false);
}

/// The parts that a ray may hit. Only subsurface rays count hits that are nearer than MIN_ISECT_DEPTH.
void AccelCsg::FindNear(const Ray& ray, AccelPlaces& near, TraceThreadData *thread) const
{
	const Level *level = levels[FAR].reach.LeavesOut(ray.Direction) ? NULL : Choose(ray.Origin);
	accel_query query = { &near, 0, 0, 0, 0 };

	if((level != NULL) && (level->structure != NULL))
	{
		accel_ray line;

		Assign_Vector(line.org, ray.Origin);
		Assign_Vector(line.dir, ray.Direction);
		line.tmin = ray.IsSubsurfaceRay() ? -HUGE_VAL : 0.0;
		line.tmax = HUGE_VAL;
		line.skip.geom = line.skip.prim = ACCEL_NONE;
		accel_closest(level->structure, &line, NULL, &query);
		std::sort(near.begin(), near.end());
		near.erase(std::unique(near.begin(), near.end()), near.end());
	}
	if((level == NULL) || (query.refused > 0))
		Name_All(near, parts);
	else
		Add_Rising(near, level->always);
	thread->Stats()[Accel_Csg_Queries]++;
	thread->Stats()[Accel_Csg_Parts_Passed_Over] += parts.size() - near.size();
}

/// The library names in the order of the parts.
static bool Note_Place(void *user, accel_id id)
{
	static_cast<AccelPlaces *>(user)->push_back(id.prim);
	return true;
}

/// The parts that a point may be inside of, or outside of in an intersection.
void AccelCsg::FindNear(const VECTOR point, AccelPlaces& near) const
{
	const Level *level = Choose(point);
	accel_query query = { NULL, 0, 0, 0, 0 };

	if((level != NULL) && (level->structure != NULL))
		accel_point(level->structure, point, Note_Place, &near, &query);
	if((level == NULL) || (query.refused > 0))
		Name_All(near, parts);
	else
		Add_Rising(near, level->always);
}



/*****************************************************************************
 *
 * The functions of csg.cpp
 *
 *****************************************************************************/

/// Test_Ray_Flags and, with `shadow`, Test_Ray_Flags_Shadow of csg.cpp.
static bool May_Be_Seen(const Ray& ray, const ObjectBase *part, bool shadow)
{
	if(ray.IsPhotonRay() || (shadow && ray.IsShadowTestRay()))
	{
		if(!Test_Flag(part, NO_SHADOW_FLAG))
			return true;
	}

	return !ray.IsPhotonRay() &&
	       (!Test_Flag(part, NO_IMAGE_FLAG) || !ray.IsImageRay() || (!shadow && ray.IsPrimaryRay())) &&
	       (!Test_Flag(part, NO_REFLECTION_FLAG) || !ray.IsReflectionRay()) &&
	       (!Test_Flag(part, NO_RADIOSITY_FLAG) || !ray.IsRadiosityRay());
}

/// Do all hits at a point that another part has there not count?
bool AccelCsg::Hides(uint32_t place, const VECTOR point, const Ray& ray, TraceThreadData *thread) const
{
	if(operation == ACCEL_INTERSECTION)
		return Inside_Object(point, parts[place], thread) == false;

	return May_Be_Seen(ray, parts[place], true) && Inside_Object(point, parts[place], thread);
}

/// Does a hit of the part at that place count, as far as the other parts tell?
bool AccelCsg::IsSurface(const VECTOR point, uint32_t place, const Ray& ray, TraceThreadData *thread) const
{
	if(operation == ACCEL_UNION)
		return true;
	if(IsOfFew())
	{
		for(uint32_t near = few.Near(point) & ~(1u << place); near != 0; near &= near - 1)
		{
			if(Hides(__builtin_ctz(near), point, ray, thread))
				return false;
		}
		return true;
	}

	AccelPlaces near;

	FindNear(point, near);
	for(AccelPlaces::const_iterator i = near.begin(); i != near.end(); i++)
	{
		if((*i != place) && Hides(*i, point, ray, thread))
			return false;
	}

	return true;
}

/// Adds the hits of the part at that place.
bool AccelCsg::AddHits(uint32_t place, const Ray& ray, IStack& local, IStack& depths, TraceThreadData *thread) const
{
	ObjectPtr part = parts[place];
	bool found = false;

	if((operation != ACCEL_INTERSECTION) && (May_Be_Seen(ray, part, operation == ACCEL_MERGE) == false))
		return false;
	if((part->Bound.empty() == false) && (Ray_In_Bound(ray, part->Bound, thread) == false))
		return false;
	if((operation == ACCEL_UNION) && object.Clip.empty())
		return part->All_Intersections(ray, depths, thread);
	if(part->All_Intersections(ray, local, thread) == false)
		return false;
	for( ; local->size() > 0; local->pop())
	{
		Intersection& isect = local->top();

		if((object.Clip.empty() || Point_In_Clip(isect.IPoint, object.Clip, thread)) && IsSurface(isect.IPoint, place, ray, thread))
		{
			isect.Csg = &object;
			depths->push(isect);
			found = true;
		}
	}

	return found;
}

/// Adds the hits of the parts whose bits are set.
bool AccelCsg::AddHitsOfFew(uint32_t near, const Ray& ray, IStack& depths, TraceThreadData *thread) const
{
	bool found = false;

	thread->Stats()[Accel_Csg_Queries]++;
	thread->Stats()[Accel_Csg_Parts_Passed_Over] += parts.size() - __builtin_popcount(near);
	if(near == 0)
		return false;

	IStack local(thread->stackPool);

	for( ; near != 0; near &= near - 1)
		found = AddHits(__builtin_ctz(near), ray, local, depths, thread) || found;

	return found;
}

bool AccelCsg::AddHitsOfMany(const Ray& ray, IStack& depths, TraceThreadData *thread) const
{
	AccelPlaces near;
	IStack local(thread->stackPool);
	bool found = false;

	FindNear(ray, near, thread);
	for(AccelPlaces::const_iterator place = near.begin(); place != near.end(); place++)
		found = AddHits(*place, ray, local, depths, thread) || found;

	return found;
}

bool AccelCsg::AllIntersections(const Ray& ray, IStack& depths, TraceThreadData *thread) const
{
	static const IntStatsIndex tests[] = { Ray_CSG_Union_Tests, Ray_CSG_Merge_Tests, Ray_CSG_Intersection_Tests };
	static const IntStatsIndex successes[] = { Ray_CSG_Union_Tests_Succeeded, Ray_CSG_Merge_Tests_Succeeded, Ray_CSG_Intersection_Tests_Succeeded };
	bool found;

	if(IsOfFew())
		found = AddHitsOfFew(levels[FAR].reach.LeavesOut(ray.Direction) ? few.All() : few.Near(ray), ray, depths, thread);
	else
		found = AddHitsOfMany(ray, depths, thread);
	thread->Stats()[tests[operation]]++;
	if(found)
		thread->Stats()[successes[operation]]++;

	return found;
}

bool AccelCsg::Inside(const VECTOR point, TraceThreadData *thread) const
{
	const bool settled = (operation != ACCEL_INTERSECTION); // by one part that the point is inside of, or else outside

	if(IsOfFew())
	{
		for(uint32_t near = few.Near(point); near != 0; near &= near - 1)
		{
			if(Inside_Object(point, parts[__builtin_ctz(near)], thread) == settled)
				return settled;
		}
		return !settled;
	}

	AccelPlaces near;

	FindNear(point, near);
	for(AccelPlaces::const_iterator i = near.begin(); i != near.end(); i++)
	{
		if(Inside_Object(point, parts[*i], thread) == settled)
			return settled;
	}

	return !settled;
}



/*****************************************************************************
 *
 * Which objects
 *
 *****************************************************************************/

/// Goes through objects, which may be shared, and what they consist of.
class AccelCsgTaker
{
	public:
		AccelCsgTaker(const AccelReach& r, const AccelReach& n, const AccelFewBoxes& b, vector<AccelCsg *>& t) :
			reach(r), near(n), boxes(b), taken(t) { }

		void TakeAll(const vector<ObjectPtr>& objects)
		{
			for(vector<ObjectPtr>::const_iterator i = objects.begin(); i != objects.end(); i++)
				Take(*i);
		}
	private:
		const AccelReach& reach;
		const AccelReach& near;
		const AccelFewBoxes& boxes;
		vector<AccelCsg *>& taken;
		std::set<ObjectPtr> seen;

		void Take(ObjectPtr object);
		void TakeCsg(CSG& csg);
};

void AccelCsgTaker::Take(ObjectPtr object)
{
	CompoundObject *compound = dynamic_cast<CompoundObject *>(object);
	CSG *csg = dynamic_cast<CSG *>(object);

	if(seen.insert(object).second == false)
		return;
	TakeAll(object->Bound);
	TakeAll(object->Clip);
	if(compound != NULL)
		TakeAll(compound->children);
	if(csg != NULL)
		TakeCsg(*csg);
}

void AccelCsgTaker::TakeCsg(CSG& csg)
{
	const bool common = (dynamic_cast<CSGIntersection *>(&csg) != NULL);
	const bool merged = (dynamic_cast<CSGMerge *>(&csg) != NULL);
	const AccelOperation operation = common ? ACCEL_INTERSECTION : merged ? ACCEL_MERGE : ACCEL_UNION;
	const AccelFewParts *few = boxes.Of(csg);

	if(csg.children.size() >= AccelCsg::FEWEST_PARTS)
		csg.accelerated = new AccelCsg(csg, operation, reach);
	else if(few != NULL)
		csg.accelerated = new AccelCsg(csg, operation, near, *few);
	else
		return;
	taken.push_back(csg.accelerated);
}

void Accel_Take_Csg(const vector<ObjectPtr>& objects, const AccelReach& reach, const AccelReach& near, const AccelFewBoxes& boxes,
                    vector<AccelCsg *>& taken)
{
	AccelCsgTaker(reach, near, boxes, taken).TakeAll(objects);
}

}
