/*******************************************************************************
 * povaccelquery.h
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module contains all defines, typedefs, and prototypes for
 * povaccelquery.cpp: one query under way, as POV-Ray's tests of single objects
 * see it, and POV-Ray's linear search for it. It is a derivative work of POV-Ray
 * 3.7.0.10; see LICENSE.
 *******************************************************************************/

#ifndef POVRAY_BACKEND_POVACCELQUERY_H
#define POVRAY_BACKEND_POVACCELQUERY_H

#include <string>
#include <vector>

#include "backend/frame.h"
#include "backend/scene/objects.h"
#include "backend/support/statistics.h"
#include "backend/accel/accel.h"
#include "backend/accel/povaccelbox.h"
#include "backend/accel/povaccelmesh.h"

namespace pov
{

class Trace;

/// One ray query: what the leaf tests need, and the best hit so far.
struct AccelQuery
{
	const vector<ObjectPtr>& objects;
	const Ray& ray;
	const RayObjectCondition *precondition;
	const RayObjectCondition *postcondition;
	TraceThreadData *thread;
	Intersection& best;
	Intersection candidate;
	bool prepared; // the next three: not before a leaf is tested, as most rays come to none
	BBOX_VECT origin;
	BBOX_VECT invdir;
	ObjectBase::BBoxDirection variant;
	POV_ULONG leafTests;
	POV_ULONG leafHits;
	ObjectPtr missed; // what the ray was found to miss just before (povaccelmissed.h), or NULL
	uint32_t firstUnbounded; // of what was hit before the structure was asked, or ACCEL_NONE
	DBL firstDepth;

	AccelQuery(const vector<ObjectPtr>& objs, const Ray& r, const RayObjectCondition *prec, const RayObjectCondition *postc,
	           TraceThreadData *t, Intersection& bi) :
		objects(objs), ray(r), precondition(prec), postcondition(postc), thread(t), best(bi), prepared(false), leafTests(0), leafHits(0), missed(t->accelMissed), firstUnbounded(ACCEL_NONE), firstDepth(HUGE_VAL)
	{
	}

	/// Does what was hit before the structure was asked come before the candidate? Of equal depths the first object counts.
	bool FirstIsBefore(uint32_t index) const
	{
		return (firstDepth < candidate.Depth) || ((firstDepth == candidate.Depth) && (firstUnbounded < index));
	}

	bool MayHit(ObjectPtr object) const
	{
		return (precondition == NULL) || (*precondition)(ray, object, 0.0);
	}

	/// May a leaf test find what is not known yet?
	bool IsToTest(ObjectPtr object)
	{
		return MayHit(object) && ((object != missed) || (IsMissed() == false));
	}

	/// As BSPIntersectFunctor does.
	void Prepare()
	{
		Vector3d tmp(1.0 / ray.GetDirection()[X], 1.0 / ray.GetDirection()[Y], 1.0 / ray.GetDirection()[Z]);
		Assign_Vector(origin, ray.Origin);
		Assign_Vector(invdir, *tmp);
		variant = (ObjectBase::BBoxDirection)((int(invdir[X] < 0.0) << 2) | (int(invdir[Y] < 0.0) << 1) | int(invdir[Z] < 0.0));
		prepared = true;
	}

	/// Finds the nearest hit of an object. One beyond the limit is not needed.
	bool TestLeaf(ObjectPtr object, DBL limit = HUGE_VAL)
	{
		if(prepared == false)
			Prepare();
		if((object->Type & HIERARCHY_OK_OBJECT) && (Accel_Mesh_Of(object, thread) != NULL))
			return TestMesh(object, limit);
		if(postcondition != NULL)
			return Find_Intersection(&candidate, object, ray, variant, origin, invdir, *postcondition, thread);
		else
			return Find_Intersection(&candidate, object, ray, variant, origin, invdir, thread);
	}
	private:
		/// Was `missed` tested indeed? Stock asks the object's box first, up to the limit of the test.
		bool IsMissed()
		{
			if(prepared == false)
				Prepare();

			const bool isMissed = missed->Intersect_BBox(variant, origin, invdir, thread->accelMissedLimit);

			thread->Stats()[Accel_Shadow_Tests_Spared] += isMissed;

			return isMissed;
		}

		bool TestMesh(ObjectPtr object, DBL limit);
};

/// One line for messages.
std::string Describe_Ray(const Ray& ray);

/// Sees every hit of a linear search: the nearest of each object.
class AccelHitObserver
{
	public:
		virtual void See(uint32_t index, const Intersection& isect) = 0;
	protected:
		~AccelHitObserver() { }
};

/// POV-Ray's linear search, as in Trace::FindIntersection. Improves best and index.
bool Search_Linearly(Trace& trace, const AccelQuery& query, Intersection& best, uint32_t& index, AccelHitObserver *observer = NULL);

/// A search for the objects with an interior around a point.
struct AccelPointQuery
{
	const vector<ObjectPtr>& objects;
	const DBL *point;
	AccelContainerSearch search;
	TraceThreadData *thread;
	vector<ObjectPtr> found;

	AccelPointQuery(const vector<ObjectPtr>& objs, const VECTOR p, AccelContainerSearch s, TraceThreadData *t) :
		objects(objs), point(p), search(s), thread(t) { }

	/// Tests an object as stock does.
	void Test(ObjectPtr object)
	{
		if((object->interior != NULL) && ((search == ACCEL_OF_PHOTONS) || Inside_BBox(point, object->BBox)) && object->Inside(point, thread))
			found.push_back(object);
	}

	void SearchLinearly()
	{
		for(vector<ObjectPtr>::const_iterator object = objects.begin(); object != objects.end(); object++)
			Test(*object);
	}
};

}

#endif // POVRAY_BACKEND_POVACCELQUERY_H
