/*******************************************************************************
 * povaccelmesh.cpp
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module answers the queries of meshes through the accel library. With method 3
 * the parser builds no tree in a mesh (unless `hierarchy off` asked for none anyway),
 * and the answers are those of POV-Ray's own loop over all triangles, which is what
 * `hierarchy off` means, bit for bit:
 *
 * - The triangles are in blocks of eight, which the library holds as objects, and
 *   povaccelmeshtest.cpp tests a block in POV-Ray's own arithmetic. The boxes of the
 *   blocks hold all hits (povaccelmeshgroup.cpp). What the library is given is the ray
 *   in the space of the mesh before its direction is made a unit vector, so that its t
 *   is the depth in the scene.
 * - Find_Intersection pushes the hits of a mesh in the order of its triangles, takes
 *   them from the top, and keeps one that is nearer: so of equal depths in the scene,
 *   the last triangle counts. Hits that it does not look at (below MIN_ISECT_DEPTH,
 *   clipped, or not wanted by the condition) hide nothing.
 * - CSG objects want all hits, in the order of the triangles, and Inside their number.
 *
 * Cost: 44 bytes a triangle in its block, and about 20 of the library. Bad at: meshes
 * whose triangles `mesh` made collapse to lines or points, as a ray may hit those
 * anywhere in their plane; they are tested for every ray. It is a derivative work of
 * POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

#include <algorithm>
#include <cmath>
#include <typeinfo>

#include <boost/container/small_vector.hpp>

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"

#include "base/timer.h"

#include "backend/accel/povaccel.h"
#include "backend/accel/povaccelmesh.h"
#include "backend/accel/povaccelmeshgroup.h"
#include "backend/bounding/bbox.h"
#include "backend/math/matrices.h"
#include "backend/math/vector.h"
#include "backend/scene/scene.h"
#include "backend/support/task.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

/// Up to so many blocks are tested one after another.
static const size_t FEW_BLOCKS = 4;

static AccelMeshTest *const Test_Lanes = Choose_Mesh_Test();

/*****************************************************************************
 *
 * Queries
 *
 *****************************************************************************/

/// A query under way: what tests of blocks need.
struct AccelMeshQuery
{
	AccelMeshRay ray;
	double way[3]; // direction before it was made a unit vector
	DBL length; // of it: depths of the scene are those of the mesh divided by it
	const AccelMeshBlock *blocks;
	POV_ULONG nodes, tests, hits;

	AccelMeshQuery() : length(1.0), blocks(NULL), nodes(0), tests(0), hits(0) { }
	virtual ~AccelMeshQuery() { }

	/// Takes a hit. True if what is `Limit()` or farther away matters no more.
	virtual bool Take(uint32_t triangle, DBL depth) = 0;
	virtual DBL Limit() const { return HUGE_VAL; }

	/// Brings the ray to the space of the mesh, as Mesh::Intersect does.
	void SetRay(const TRANSFORM *trans, const VECTOR origin, const VECTOR direction)
	{
		if(trans != NULL)
		{
			MInvTransPoint(ray.origin, origin, trans);
			MInvTransDirection(ray.direction, direction, trans);
			Assign_Vector(way, ray.direction);
			VLength(length, ray.direction);
			VInverseScaleEq(ray.direction, length);
		}
		else
		{
			Assign_Vector(ray.origin, origin);
			Assign_Vector(ray.direction, direction);
			Assign_Vector(way, direction);
		}
	}

	/// Is it a ray for which the boxes of the blocks are right?
	bool IsSound() const
	{
		const double sizeOfOrigin = fabs(ray.origin[X]) + fabs(ray.origin[Y]) + fabs(ray.origin[Z]);
		const double sizeOfDirection = fabs(ray.direction[X]) + fabs(ray.direction[Y]) + fabs(ray.direction[Z]);

		return (sizeOfOrigin < 1.0e100) && (sizeOfDirection > 0.9) && (sizeOfDirection < 2.0) && (length > 0.0) && (length < HUGE_VAL);
	}

	bool TestBlock(const AccelMeshBlock& block)
	{
		DBL depth[ACCEL_MESH_LANES];
		bool nearer = false;

		tests++;
		for(uint32_t found = Test_Lanes(block, ray, depth); found != 0; found &= found - 1)
		{
			const int lane = __builtin_ctz(found);

			hits++;
			nearer = Take(block.Index(lane), depth[lane]) || nearer;
		}

		return nearer;
	}

	void TestBlocks(const vector<AccelMeshBlock>& these)
	{
		for(vector<AccelMeshBlock>::const_iterator block = these.begin(); block != these.end(); block++)
			TestBlock(*block);
	}

	/// The library asks back for the hits of a block.
	static void TestObject(accel_probe *probe)
	{
		AccelMeshQuery& query = *reinterpret_cast<AccelMeshQuery *>(probe->query->user);

		if(query.TestBlock(query.blocks[probe->prim]))
			accel_report(probe, query.Limit(), 0.0, 0.0);
	}

	void Count(RenderStatistics& stats, bool found) const
	{
		stats[Accel_Mesh_Queries]++;
		if(found)
			stats[Accel_Mesh_Queries_Succeeded]++;
		stats[Accel_Mesh_Nodes] += nodes;
		stats[Accel_Mesh_Blocks] += tests;
		stats[Accel_Mesh_Hits] += hits;
	}
};

/// Looks for the hit that Find_Intersection keeps.
struct AccelNearestQuery : public AccelMeshQuery
{
	Mesh& mesh;
	const Ray& sceneRay;
	const RayObjectCondition *postcondition;
	TraceThreadData *thread;
	DBL least; // allowed depth
	DBL best; // depth; until one is found, that which it has to be below
	uint32_t triangle;
	bool found;

	AccelNearestQuery(Mesh& m, const Ray& r, DBL closest, const RayObjectCondition *postc, TraceThreadData *t) :
		mesh(m), sceneRay(r), postcondition(postc), thread(t),
		least(r.IsSubsurfaceRay() ? 0.0 : MIN_ISECT_DEPTH), best(closest), triangle(0), found(false) { }

	virtual bool Take(uint32_t index, DBL depth)
	{
		const DBL distance = depth / length;

		if(!(distance >= least) || !((distance < best) || (found && (distance == best) && (index > triangle))))
			return false;
		if((postcondition != NULL) && ((*postcondition)(sceneRay, &mesh, distance) == false))
			return false;
		if(mesh.Clip.empty() == false)
		{
			VECTOR point;

			VEvaluateRay(point, sceneRay.Origin, distance, sceneRay.Direction);
			if(Point_In_Clip(point, mesh.Clip, thread) == false)
				return false;
		}
		best = distance;
		triangle = index;
		found = true;

		return true;
	}

	/// Just above the best depth, as an equal one counts of a later triangle.
	virtual DBL Limit() const { return nextafter(best, HUGE_VAL); }
};

/// Gathers all hits.
struct AccelAllQuery : public AccelMeshQuery
{
	struct Hit
	{
		uint32_t triangle;
		DBL depth;

		bool operator<(const Hit& other) const { return triangle < other.triangle; }
		bool operator==(const Hit& other) const { return triangle == other.triangle; }
	};

	boost::container::small_vector<Hit, 32> found;

	virtual bool Take(uint32_t triangle, DBL depth)
	{
		const Hit hit = { triangle, depth };

		found.push_back(hit);
		return false;
	}

	/// In the order of the triangles, each once: the library may ask for a block again.
	void Sort()
	{
		std::sort(found.begin(), found.end());
		found.erase(std::unique(found.begin(), found.end()), found.end());
	}
};

static AccelAnswer Leave_To_Stock(TraceThreadData *thread)
{
	thread->Stats()[Accel_Rays_Refused]++;

	return ACCEL_NOT_ANSWERED;
}

/// Tests all blocks that the ray may hit between these depths of the scene. False if it is not a ray for that.
bool AccelMesh::Search(AccelMeshQuery& query, DBL from, DBL to) const
{
	if(query.IsSound() == false)
		return false;

	const Part *part = Prepare(query.ray.origin);

	query.TestBlocks(groups->looseBlocks);
	if(groups->blocks.size() <= FEW_BLOCKS)
		query.TestBlocks(groups->blocks);
	else if(part != NULL)
	{
		accel_query counters = { &query, 0, 0, 0, 0 };
		accel_ray ray = accel_ray_from(query.ray.origin, query.way);

		ray.tmin = from;
		ray.tmax = to;
		query.blocks = groups->blocks.data();
		accel_closest(part->structure, &ray, NULL, &counters);
		query.nodes = counters.nodes;
		if(counters.refused > 0)
			return false;
	}

	return true;
}

AccelAnswer AccelMesh::FindNearest(Intersection& isect, Mesh& mesh, const Ray& ray, DBL closest, const RayObjectCondition *postcondition, TraceThreadData *thread) const
{
	AccelNearestQuery query(mesh, ray, closest, postcondition, thread);

	query.SetRay(mesh.Trans, ray.Origin, ray.Direction);
	if(Search(query, 0.5 * query.least, closest) == false)
		return Leave_To_Stock(thread);
	if(query.found)
	{
		VECTOR point;

		VEvaluateRay(point, ray.Origin, query.best, ray.Direction);
		isect = Intersection(query.best, point, &mesh, &data.Triangles[query.triangle]);
	}
	query.Count(thread->Stats(), query.found);
	if(accelerator.verify)
		accelerator.VerifyMesh(isect, mesh, ray, closest, postcondition, thread, query.found);

	return query.found ? ACCEL_FOUND : ACCEL_MISSED;
}

AccelAnswer AccelMesh::FindAll(Mesh& mesh, const Ray& ray, IStack& depths, TraceThreadData *thread) const
{
	AccelAllQuery query;
	vector<Intersection> pushed; // for Accelerator_Verify
	bool found = false;

	query.SetRay(mesh.Trans, ray.Origin, ray.Direction);
	if(Search(query, 0.0, HUGE_VAL) == false)
		return Leave_To_Stock(thread);
	query.Sort();
	for(size_t i = 0; i < query.found.size(); i++)
	{
		const DBL depth = query.found[i].depth / query.length;
		VECTOR point;

		VEvaluateRay(point, ray.Origin, depth, ray.Direction);
		if(mesh.Clip.empty() || Point_In_Clip(point, mesh.Clip, thread))
		{
			depths->push(Intersection(depth, point, &mesh, &data.Triangles[query.found[i].triangle]));
			if(accelerator.verify)
				pushed.push_back(depths->top());
			found = true;
		}
	}
	query.Count(thread->Stats(), found);
	if(accelerator.verify)
		accelerator.VerifyMesh(mesh, ray, pushed, thread);

	return found ? ACCEL_FOUND : ACCEL_MISSED;
}

AccelAnswer AccelMesh::IsInside(const Mesh& mesh, const VECTOR point, TraceThreadData *thread) const
{
	AccelAllQuery query;

	query.SetRay(mesh.Trans, point, data.Inside_Vect);
	if(Search(query, 0.0, HUGE_VAL) == false)
		return Leave_To_Stock(thread);
	query.Sort();

	const bool inside = (query.found.size() % 2 == 1);

	query.Count(thread->Stats(), inside);
	if(accelerator.verify)
		accelerator.VerifyMesh(mesh, point, thread, inside);

	return inside ? ACCEL_FOUND : ACCEL_MISSED;
}



/*****************************************************************************
 *
 * Build
 *
 *****************************************************************************/

AccelMesh::AccelMesh(const MESH_DATA& d, SceneData& scene) : data(d), accelerator(*scene.accelerator), groups(NULL), built(false)
{
	scene.accelerator->sceneData = &scene; // the parser may ask before anything is built
	box = Bound_Mesh(data, largest);
	accelerator.meshTotals.meshes++;
}

AccelMesh::~AccelMesh()
{
	for(int i = 0; i < 2; i++)
		accel_free(parts[i].structure);
	delete groups;
}

/// The part whose boxes are right for a ray from there, built if need be. NULL if it is too far away for any hit.
const AccelMesh::Part *AccelMesh::Prepare(const double origin[3]) const
{
	const double size = max(fabs(origin[X]), max(fabs(origin[Y]), fabs(origin[Z])));

	if(built == false)
		BuildGroups();
	for(int i = 0; i < 2; i++)
	{
		if(size <= parts[i].reach)
		{
			if((parts[i].built == false) && (groups->blocks.size() > FEW_BLOCKS))
				BuildPart(parts[i]);
			return &parts[i];
		}
	}

	return NULL;
}

/*
 * POV-Ray finds nothing beyond MAX_DISTANCE, in the space of the mesh. A direction there has components up to 2, if the
 * scene's own is not a unit vector, so rays from beyond `farthest` hit nothing. Boxes for origins within 2^24 times the mesh
 * are hardly larger than those for the mesh itself.
 */
void AccelMesh::BuildGroups() const
{
	boost::mutex::scoped_lock lock(mutex);

	if(built)
		return;

	Timer timer;

	groups = new AccelMeshGroups(data);

	const double farthest = 2.1 * MAX_DISTANCE + 2.0 * groups->largest;

	parts[0].reach = min(farthest, ldexp(groups->largest, 24));
	parts[1].reach = farthest;
	accelerator.meshTotals.built++;
	accelerator.meshTotals.triangles += groups->triangles;
	accelerator.meshTotals.loose += groups->looseTriangles;
	accelerator.meshTotals.bytes += (groups->blocks.size() + groups->looseBlocks.size()) * sizeof(AccelMeshBlock);
	accelerator.meshTotals.milliseconds += timer.ElapsedRealTime();
	built = true;
}

void AccelMesh::BuildPart(Part& part) const
{
	boost::mutex::scoped_lock lock(mutex);

	if(part.built)
		return;

	vector<accel_box> boxes(groups->blocks.size());

	for(size_t i = 0; i < boxes.size(); i++)
		boxes[i] = Bound_Mesh_Block(groups->blocks[i], groups->largest, part.reach);

	accel_geometry geometry = accel_geometry();
	geometry.type = ACCEL_OBJECTS;
	geometry.objects.boxes = boxes.data();
	geometry.objects.count = boxes.size();
	geometry.objects.order = ACCEL_ORDER_RAW;
	geometry.objects.intersect = &AccelMeshQuery::TestObject;

	const accel_scene scene = { &geometry, 1 };
	accel_error error;
	accel_info info;

	if(accel_build(&part.structure, &scene, "bvh", NULL, &error) != ACCEL_OK)
		throw POV_EXCEPTION((error.status == ACCEL_NO_MEMORY) ? kOutOfMemoryErr : kParamErr, (std::string("Accelerator of a mesh: ") + error.text).c_str());
	accel_describe(part.structure, &info);
	accelerator.meshTotals.bytes += info.bytes;
	accelerator.meshTotals.milliseconds += static_cast<POV_ULONG>(1000.0 * info.seconds);
	part.built = true;
}

/// Where a ray enters the bounding box of an object, or HUGE_VAL. Not in need of being exact.
static DBL Find_Entry(const ObjectBase *object, const accel_ray& ray)
{
	VECTOR low, high;
	DBL from = 0.0, to = HUGE_VAL;

	Make_min_max_from_BBox(low, high, object->BBox);
	for(int axis = X; axis <= Z; axis++)
	{
		const DBL a = (low[axis] - ray.org[axis]) / ray.dir[axis], b = (high[axis] - ray.org[axis]) / ray.dir[axis];

		from = max(from, min(a, b));
		to = min(to, max(a, b));
	}

	return (from <= to) ? from : HUGE_VAL;
}

/// Asks the meshes along a ray, nearest first, until one is hit.
static void Ask_Meshes(const vector<Mesh *>& meshes, const accel_ray& pilot, TraceThreadData *thread)
{
	vector<std::pair<DBL, Mesh *> > entered;
	VECTOR direction;

	for(vector<Mesh *>::const_iterator mesh = meshes.begin(); mesh != meshes.end(); mesh++)
	{
		const DBL entry = Find_Entry(*mesh, pilot);

		if(entry < HUGE_VAL)
			entered.push_back(std::make_pair(entry, *mesh));
	}
	std::sort(entered.begin(), entered.end());
	VNormalize(direction, pilot.dir);

	const Ray ray(pilot.org, direction);
	Intersection isect;

	for(size_t i = 0; i < entered.size(); i++)
	{
		if(Accel_Find_Nearest(isect, entered[i].second, ray, HUGE_VAL, NULL, thread) == ACCEL_FOUND)
			return;
	}
}

/*
 * What camera rays will ask is built before they come, where the user sees and can stop it. Tests of other objects may not run
 * yet, so meshes behind those are built as well.
 */
void Accelerator::BuildSeenMeshes(const vector<accel_ray>& pilot, Task& task) const
{
	SceneThreadData *thread = static_cast<SceneThreadData *>(task.GetDataPtr());
	vector<Mesh *> meshes;

	for(vector<ObjectPtr>::const_iterator object = objects.begin(); object != objects.end(); object++)
	{
		if((Accel_Mesh_Of(*object, thread) != NULL) && (*object)->Clip.empty() && !Test_Flag(*object, NO_IMAGE_FLAG))
			meshes.push_back(static_cast<Mesh *>(*object));
	}
	for(size_t i = 0; (i < pilot.size()) && !meshes.empty() && (meshTotals.built < meshTotals.meshes); i++)
	{
		Ask_Meshes(meshes, pilot[i], thread);
		task.Cooperate();
	}
}

AccelMesh *Accel_Take_Mesh(const Mesh& mesh, SceneData& scene)
{
	if((scene.boundingMethod != 3) || !Test_Flag(&mesh, HIERARCHY_FLAG) || (mesh.Data->Number_Of_Triangles >= (1L << AccelMeshBlock::INDEX_BITS)))
		return NULL;

	return new AccelMesh(*mesh.Data, scene);
}

const AccelMesh *Accel_Mesh_Of(const ObjectBase *object, const TraceThreadData *thread)
{
	if(thread->accelPlainMeshes || (typeid(*object) != typeid(Mesh)))
		return NULL;

	return static_cast<const Mesh *>(object)->Data->Accel;
}

}
