/*******************************************************************************
 * povaccelmeshverify.cpp
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module is the part of Accelerator_Verify for meshes: every answer about a mesh
 * is compared with that of POV-Ray's own loop over all triangles. It is a derivative
 * work of POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

#include <cstdio>
#include <cstring>

#include <boost/format.hpp>

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"

#include "backend/accel/povaccel.h"
#include "backend/accel/povaccelmesh.h"
#include "backend/accel/povaccelquery.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

using boost::format;

static bool Are_Same(const Intersection& a, const Intersection& b)
{
	return (memcmp(&a.Depth, &b.Depth, sizeof(DBL)) == 0) && (a.Pointer == b.Pointer) && (a.Object == b.Object);
}

static std::string Describe_Hit(const Mesh& mesh, bool found, const Intersection& isect)
{
	char text[100];

	if(found == false)
		return "nothing";
	snprintf(text, sizeof(text), "triangle %ld at depth %.17g (%a)",
	         long(reinterpret_cast<const MESH_TRIANGLE *>(isect.Pointer) - mesh.Data->Triangles), isect.Depth, isect.Depth);

	return text;
}

/// As Find_Intersection does.
void Accelerator::VerifyMesh(const Intersection& isect, Mesh& mesh, const Ray& ray, DBL closest, const RayObjectCondition *postcondition, TraceThreadData *thread, bool found) const
{
	AccelPlain plain(thread);
	IStack depths(thread->stackPool);
	Intersection linear;
	bool linearFound = false;

	mesh.All_Intersections(ray, depths, thread);
	for( ; depths->size() > 0; depths->pop())
	{
		const DBL depth = depths->top().Depth;

		if((depth < closest) && (ray.IsSubsurfaceRay() || (depth >= MIN_ISECT_DEPTH)) &&
		   ((postcondition == NULL) || (*postcondition)(ray, &mesh, depth)))
		{
			linear = depths->top();
			closest = depth;
			linearFound = true;
		}
	}
	thread->Stats()[Accel_Queries_Verified]++;
	if((found != linearFound) || (found && !Are_Same(isect, linear)))
		ReportDifference(thread, "mesh, " + Describe_Ray(ray), Describe_Hit(mesh, found, isect), Describe_Hit(mesh, linearFound, linear));
}

/// The hits that were added to the stack last are those of the mesh.
void Accelerator::VerifyMesh(Mesh& mesh, const Ray& ray, const vector<Intersection>& found, TraceThreadData *thread) const
{
	AccelPlain plain(thread);
	IStack depths(thread->stackPool);
	bool same = true;

	mesh.All_Intersections(ray, depths, thread);

	const size_t count = depths->size();

	for(size_t i = found.size(); depths->size() > 0; depths->pop())
		same = same && (i > 0) && Are_Same(found[--i], depths->top());
	thread->Stats()[Accel_Queries_Verified]++;
	if(!same || (count != found.size()))
		ReportDifference(thread, "mesh, " + Describe_Ray(ray), str(format("%d hits") % found.size()), str(format("%d hits, or others") % count));
}

void Accelerator::VerifyMesh(const Mesh& mesh, const VECTOR point, TraceThreadData *thread, bool inside) const
{
	AccelPlain plain(thread);
	const bool linear = (mesh.Inside(point, thread) != (Test_Flag(&mesh, INVERTED_FLAG) != 0));
	char text[160];

	thread->Stats()[Accel_Queries_Verified]++;
	if(inside == linear)
		return;
	snprintf(text, sizeof(text), "mesh, point <%.17g, %.17g, %.17g>", point[X], point[Y], point[Z]);
	ReportDifference(thread, text, inside ? "it inside" : "it outside", linear ? "it inside" : "it outside");
}

}
