/*******************************************************************************
 * povaccelquery.cpp
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module searches linearly for the hit nearest along a ray: for rays that the
 * library refuses, and as the judge of Accelerator_Verify. It is a derivative work
 * of POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"

#include "backend/accel/povaccelquery.h"
#include "backend/render/trace.h"
#include "backend/scene/objects.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

/// As Find_Intersection tests any object, but for the limit.
bool AccelQuery::TestMesh(ObjectPtr object, DBL limit)
{
	if(object->Intersect_BBox(variant, origin, invdir, HUGE_VAL) == false)
		return false;
	if((object->Bound.empty() == false) && (Ray_In_Bound(ray, object->Bound, thread) == false))
		return false;

	const AccelAnswer answer = Accel_Find_Nearest(candidate, object, ray, nextafter(limit, HUGE_VAL), postcondition, thread);

	if(answer != ACCEL_NOT_ANSWERED)
		return answer == ACCEL_FOUND;

	AccelPlain plain(thread);

	return TestLeaf(object);
}

bool Search_Linearly(Trace& trace, const AccelQuery& query, Intersection& best, uint32_t& index, AccelHitObserver *observer)
{
	bool found = false;

	for(size_t i = 0; i < query.objects.size(); i++)
	{
		if(query.MayHit(query.objects[i]) == true)
		{
			Intersection isect;
			bool hit;

			if(query.postcondition != NULL)
				hit = trace.FindIntersection(query.objects[i], isect, query.ray, *query.postcondition);
			else
				hit = trace.FindIntersection(query.objects[i], isect, query.ray);

			if(hit && (observer != NULL))
				observer->See(i, isect);
			if(hit && (isect.Depth < best.Depth))
			{
				best = isect;
				index = i;
				found = true;
			}
		}
	}

	return found;
}

}
