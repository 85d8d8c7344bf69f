/*******************************************************************************
 * povaccelverify.cpp
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module implements Accelerator_Verify, which runs POV-Ray's own search over
 * all objects beside every query. It looks for two things: answers that are not
 * those of the linear search, and hits that do not lie in the box of their object.
 * The second is stricter: such a hit may be missed by some structure, on some ray,
 * even where no answer was wrong. It is a derivative work of POV-Ray 3.7.0.10; see
 * LICENSE.
 *******************************************************************************/

#include <cstdio>
#include <cstring>
#include <typeinfo>

#include <boost/core/demangle.hpp>
#include <boost/format.hpp>
#include <boost/thread.hpp>

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"

#include "backend/accel/povaccel.h"
#include "backend/accel/povaccelplain.h"
#include "backend/accel/povaccelmesh.h"
#include "backend/accel/povaccelquery.h"
#include "backend/control/messagefactory.h"
#include "backend/scene/scene.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

using boost::format;

static boost::mutex faultMutex;
static POV_ULONG differenceCount = 0;
static POV_ULONG outsideCount = 0;
static const POV_ULONG faultsPrinted = 10;

std::string Describe_Ray(const Ray& ray)
{
	const VECTOR& o = ray.Origin;
	const VECTOR& d = ray.Direction;
	char text[400];

	snprintf(text, sizeof(text), "ray from <%.17g, %.17g, %.17g> along <%.17g, %.17g, %.17g> (%a %a %a, %a %a %a)",
	         o[X], o[Y], o[Z], d[X], d[Y], d[Z], o[X], o[Y], o[Z], d[X], d[Y], d[Z]);

	return text;
}

/// The hit that is origin + depth * direction lies in the box, or as near as these three operations round it.
static bool Holds_Hit(const accel_box& box, const Ray& ray, DBL depth)
{
	for(int axis = X; axis <= Z; axis++)
	{
		const DBL way = depth * ray.Direction[axis];
		const DBL place = ray.Origin[axis] + way;
		const DBL rounding = ldexp(fabs(ray.Origin[axis]) + fabs(way), -52);

		// a NaN is that of a ray that is not finite, which no box decides on
		if((place < box.lo[axis] - rounding) || (place > box.hi[axis] + rounding))
			return false;
	}

	return true;
}

/// Checks the hits of one linear search against the boxes of their objects.
class Accelerator::BoxCheck : public AccelHitObserver
{
	public:
		BoxCheck(const Accelerator& a, const AccelQuery& q, const vector<accel_box>& b) : accelerator(a), query(q), boxes(b) { }

		virtual void See(uint32_t index, const Intersection& isect)
		{
			if(Holds_Hit(boxes[index], query.ray, isect.Depth) == false)
				accelerator.ReportOutside(query, boxes[index], index, isect.Depth);
		}
	private:
		const Accelerator& accelerator;
		const AccelQuery& query;
		const vector<accel_box>& boxes;
};

/// No boxes were relied on for a query without a part.
void Accelerator::Verify(Trace& trace, const AccelQuery& query, const Part *part, DBL limit, bool found, uint32_t index) const
{
	Intersection linear;
	uint32_t linearIndex = ACCEL_NONE;
	AccelPlain plain(query.thread);
	BoxCheck check(*this, query, (part != NULL) ? part->boxes : parts[0].boxes);

	linear.Depth = limit;
	bool linearFound = Search_Linearly(trace, query, linear, linearIndex, (part != NULL) ? &check : NULL);

	query.thread->Stats()[Accel_Queries_Verified]++;
	if((found == linearFound) &&
	   (!found || ((query.best.Object == linear.Object) && (memcmp(&query.best.Depth, &linear.Depth, sizeof(DBL)) == 0))))
		return;

	char upTo[80];

	snprintf(upTo, sizeof(upTo), " up to %.17g (%a)", limit, limit);
	ReportDifference(query.thread, Describe_Ray(query.ray) + upTo, Describe(found, index, query.best), Describe(linearFound, linearIndex, linear));
}

void Accelerator::ReportOutside(const AccelQuery& query, const accel_box& box, uint32_t index, DBL depth) const
{
	query.thread->Stats()[Accel_Hits_Outside]++;
	{
		boost::mutex::scoped_lock lock(faultMutex);

		outsideCount++;
		if((namedOutside.size() >= faultsPrinted) || (namedOutside.insert(index).second == false))
			return;
	}

	const VECTOR& o = query.ray.Origin;
	const VECTOR& d = query.ray.Direction;
	char text[400];

	snprintf(text, sizeof(text), "depth %.17g, <%.17g, %.17g, %.17g>, lies outside its box <%.17g, %.17g, %.17g>, <%.17g, %.17g, %.17g>",
	         depth, o[X] + depth * d[X], o[Y] + depth * d[Y], o[Z] + depth * d[Z],
	         box.lo[X], box.lo[Y], box.lo[Z], box.hi[X], box.hi[Y], box.hi[Z]);
	Messages(*sceneData).Warning(1, "Hit of %s at %s: %s.", DescribeObject(index).c_str(), text, Describe_Ray(query.ray).c_str());
}

std::string Accelerator::DescribeObject(uint32_t index) const
{
	return str(format("object %u (%s)") % index % boost::core::demangle(typeid(*objects[index]).name()));
}

std::string Accelerator::Describe(bool found, uint32_t index, const Intersection& isect) const
{
	if(found == false)
		return "nothing";

	char depth[80];

	sprintf(depth, "depth %.17g (%a)", isect.Depth, isect.Depth);
	return DescribeObject(index) + " at " + depth;
}

void Accelerator::VerifyInteriors(const AccelPointQuery& query) const
{
	AccelPointQuery linear(query.objects, query.point, query.search, query.thread);
	const DBL *point = query.point;

	AccelPlain plain(query.thread);

	linear.SearchLinearly();
	query.thread->Stats()[Accel_Queries_Verified]++;
	if(query.found == linear.found)
		return;

	char text[256];

	snprintf(text, sizeof(text), "point <%.17g, %.17g, %.17g> (%a %a %a)", point[X], point[Y], point[Z], point[X], point[Y], point[Z]);
	ReportDifference(query.thread, text, str(format("%d objects around it") % query.found.size()), str(format("%d objects") % linear.found.size()));
}

void Accelerator::ReportDifference(TraceThreadData *thread, const std::string& query, const std::string& ours, const std::string& linear) const
{
	thread->Stats()[Accel_Queries_Different]++;
	{
		boost::mutex::scoped_lock lock(faultMutex);

		if(++differenceCount > faultsPrinted)
			return;
	}

	Messages(*sceneData).PossibleError("%s: the accelerator finds %s, the linear search %s.", query.c_str(), ours.c_str(), linear.c_str());
}

bool Accelerator::FaultWasFound()
{
	boost::mutex::scoped_lock lock(faultMutex);

	return (differenceCount > 0) || (outsideCount > 0);
}

}
