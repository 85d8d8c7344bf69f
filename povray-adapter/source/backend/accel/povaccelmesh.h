/*******************************************************************************
 * povaccelmesh.h
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module contains all defines, typedefs, and prototypes for povaccelmesh.cpp:
 * the structure of a mesh, in place of POV-Ray's own tree. It is a derivative work
 * of POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

#ifndef POVRAY_BACKEND_POVACCELMESH_H
#define POVRAY_BACKEND_POVACCELMESH_H

#include <atomic>
#include <vector>

#include <boost/thread.hpp>

#include "backend/frame.h"
#include "backend/accel/accel.h"
#include "backend/scene/threaddata.h"
#include "backend/scene/objects.h"
#include "backend/shape/mesh.h"

namespace pov
{

class Accelerator;
class SceneData;
struct AccelMeshGroups;
struct AccelMeshQuery;

/// How a query of a mesh ends. Where it is not answered, POV-Ray's own loop over all triangles does.
enum AccelAnswer { ACCEL_NOT_ANSWERED, ACCEL_MISSED, ACCEL_FOUND };

/// The structure of one MESH_DATA, in the space of the mesh, shared by all copies. Built when the first ray comes.
class AccelMesh
{
	public:
		AccelMesh(const MESH_DATA& data, SceneData& scene);
		~AccelMesh();

		/// Finds the hit of least depth below `closest`, as Find_Intersection does. The condition may be NULL.
		AccelAnswer FindNearest(Intersection& isect, Mesh& mesh, const Ray& ray, DBL closest, const RayObjectCondition *postcondition, TraceThreadData *thread) const;

		/// Finds all hits, as Mesh::Intersect does.
		AccelAnswer FindAll(Mesh& mesh, const Ray& ray, IStack& depths, TraceThreadData *thread) const;

		/// Is a point inside, as Mesh::Inside finds it, unless the mesh is inverted?
		AccelAnswer IsInside(const Mesh& mesh, const VECTOR point, TraceThreadData *thread) const;

		/// As Bound_Mesh finds it.
		const accel_box& Box(double& largestCorner) const { largestCorner = largest; return box; }
	private:
		/// The library's structure over the blocks, for rays that begin within `reach` of the origin.
		struct Part
		{
			double reach;
			accel *structure;
			std::atomic<bool> built;

			Part() : reach(0.0), structure(NULL), built(false) { }
		};

		const MESH_DATA& data;
		const Accelerator& accelerator;
		accel_box box;
		double largest;
		mutable AccelMeshGroups *groups;
		mutable std::atomic<bool> built; // groups are
		mutable Part parts[2];
		mutable boost::mutex mutex;

		const Part *Prepare(const double origin[3]) const;
		void BuildGroups() const;
		void BuildPart(Part& part) const;
		bool Search(AccelMeshQuery& query, DBL from, DBL to) const;

		/// not available
		AccelMesh(const AccelMesh&);
		AccelMesh& operator=(const AccelMesh&);
};

/// The structure for a mesh that the parser has read, or NULL if POV-Ray's own tree is to be built.
AccelMesh *Accel_Take_Mesh(const Mesh& mesh, SceneData& scene);

/// The structure that answers for an object, or NULL.
const AccelMesh *Accel_Mesh_Of(const ObjectBase *object, const TraceThreadData *thread);

/// For Find_Intersection: what comes in place of All_Intersections if it is answered.
inline AccelAnswer Accel_Find_Nearest(Intersection& isect, ObjectBase *object, const Ray& ray, DBL closest, const RayObjectCondition *postcondition, TraceThreadData *thread)
{
	const AccelMesh *mesh = (object->Type & HIERARCHY_OK_OBJECT) ? Accel_Mesh_Of(object, thread) : NULL;

	return (mesh != NULL) ? mesh->FindNearest(isect, *static_cast<Mesh *>(object), ray, closest, postcondition, thread) : ACCEL_NOT_ANSWERED;
}

/// While it lives, a thread uses POV-Ray's own loop over all triangles of a mesh.
class AccelPlainMeshes
{
	public:
		explicit AccelPlainMeshes(TraceThreadData *t) : thread(t), before(t->accelPlainMeshes) { thread->accelPlainMeshes = true; }
		~AccelPlainMeshes() { thread->accelPlainMeshes = before; }
	private:
		TraceThreadData *thread;
		const bool before;

		/// not available
		AccelPlainMeshes(const AccelPlainMeshes&);
		AccelPlainMeshes& operator=(const AccelPlainMeshes&);
};

}

#endif // POVRAY_BACKEND_POVACCELMESH_H
