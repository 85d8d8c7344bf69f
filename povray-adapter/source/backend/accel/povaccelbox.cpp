/*******************************************************************************
 * povaccelbox.cpp
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module finds the boxes of POV-Ray's objects for the accel library: boxes
 * that hold every point where the leaf test of an object may report a hit.
 * POV-Ray's own BBox is not asked: it is in float, and bounded_by, clipped_by,
 * inverse and some shapes leave it wrong or needlessly infinite. The boxes are
 * composed of those of single shapes, which povaccelshape.cpp finds.
 *
 * Three things are kept apart: where the *hits* of an object may be, where its
 * *inside* may be, the points for which Inside_Object is true, and its *outside*, the
 * others. The inside of an inverted sphere is unbounded, its hits and its outside are
 * not. Regions may be too large, never too small; what is not known is the whole
 * space. The rules:
 *
 * - Union: hits are hits of a part. Inside is inside of some part, outside is outside
 *   of all.
 * - Merge: the same, but a hit is also outside all other parts. A part with a flag
 *   like no_image is not asked by all rays (csg.cpp, Test_Ray_Flags_Shadow): it only
 *   counts for parts that have the flag as well.
 * - Intersection and difference: a hit is one of a part and inside all others.
 *   Inside is inside of all parts, outside is outside of some part. So where a part
 *   has a bounded inside, no other needs a bounded one: parts that are subtracted are
 *   inverted and have none.
 * - `inverse` of a CSG object turns it around (CSG::Invert, Morph): a union becomes
 *   an intersection of inverted parts, and an intersection a merge. What is met here
 *   is the result, so its flag INVERTED_FLAG says nothing more. That of a single
 *   shape exchanges inside and outside (a plane or quadric turns its signs instead).
 * - clipped_by: hits and inside are also inside all clips. It is the inside of a clip
 *   that counts: a clip is a cut-off half of space if it is a disc, and everything
 *   if it is inverted. Patches of the type bicubic_patch ignore clips, and light
 *   sources leave them to their looks_like.
 * - bounded_by, kept or removed: the ray has to meet the bound, but the hit may be
 *   anywhere along it. It says nothing.
 * - A light source has hits, inside and outside of its looks_like, without that one's
 *   clips for the latter two.
 * - A julia_fractal asks others about points that are not its hits, so others do not
 *   bound these.
 *
 * It is a derivative work of POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

#include <algorithm>

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"

#include "backend/accel/povaccelbox.h"
#include "backend/accel/povaccelshape.h"
#include "backend/bounding/bbox.h"
#include "backend/scene/objects.h"
#include "backend/scene/scene.h"
#include "backend/shape/bezier.h"
#include "backend/shape/csg.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

static void Find_Bounds(const ObjectBase *object, const AccelReach& reach, AccelBounds& bounds);

bool Is_Dark_Light(const ObjectBase *object)
{
	const LightSource *light = dynamic_cast<const LightSource *>(object);

	return (light != NULL) && light->children.empty();
}

/// The parts of a CSG object that may be met.
static vector<const ObjectBase *> Lit_Parts(const CompoundObject& compound)
{
	vector<const ObjectBase *> parts;

	for(vector<ObjectPtr>::const_iterator child = compound.children.begin(); child != compound.children.end(); child++)
	{
		if(Is_Dark_Light(*child) == false)
			parts.push_back(*child);
	}

	return parts;
}

static void Boxes_Of_Parts(const vector<AccelBounds>& bounds, const VECTOR slack, bool common, const AccelReach& reach, vector<accel_box>& boxes, vector<uint32_t>& always);

/// Hands out the boxes of an object's parts, if somebody wants them.
static void Show_Parts(const CompoundObject& compound, bool common, const vector<AccelBounds>& parts, const AccelBounds& together, const AccelReach& reach)
{
	vector<accel_box> boxes;
	vector<uint32_t> always;

	if((reach.observer == NULL) || (reach.observer->Wants(compound) == false) || (parts.size() < compound.children.size()))
		return;
	Boxes_Of_Parts(parts, together.slack, common, reach, boxes, always);
	reach.observer->See(compound, together.hits.Box(), boxes, always);
}

static void Find_Bounds_Of_Parts(const vector<const ObjectBase *>& objects, const AccelReach& reach, vector<AccelBounds>& parts, AccelBounds& bounds)
{
	parts.resize(objects.size());
	bounds.solid = true;
	for(size_t i = 0; i < objects.size(); i++)
	{
		Find_Bounds(objects[i], reach, parts[i]);
		Include_Box(bounds.strays, parts[i].strays);
		bounds.solid = bounds.solid && parts[i].solid;
		for(int axis = X; axis <= Z; axis++)
			bounds.slack[axis] = max(bounds.slack[axis], parts[i].slack[axis]);
	}
}

/// Where a hit may be if it is tested for being there: the point that is tested is wrong by `slack`.
static AccelRegion As_Tested(const AccelRegion& side, const VECTOR slack, const AccelReach& reach)
{
	if(!(slack[X] + slack[Y] + slack[Z] < HUGE_VAL))
		return Is_Empty(side.box) ? side : AccelRegion();

	AccelRegion region(side);
	DBL magnitude = MAX_DISTANCE + reach.radius;

	for(int axis = X; axis <= Z; axis++)
		magnitude += fabs(reach.center[axis]);
	region.Grow(slack, magnitude);

	return region;
}

/// One side of CSG objects: inside or outside.
typedef AccelRegion AccelBounds::*AccelSide;

/// What is on that side of all parts.
static AccelRegion Side_Of_All(const vector<AccelBounds>& parts, AccelSide side, const VECTOR slack, const AccelReach& reach)
{
	AccelRegion region;

	for(vector<AccelBounds>::const_iterator part = parts.begin(); part != parts.end(); part++)
		region.Intersect(As_Tested((*part).*side, slack, reach));

	return region;
}

/// What is on that side of some part.
static AccelRegion Side_Of_Some(const vector<AccelBounds>& parts, AccelSide side)
{
	accel_box box = Empty_Box();

	for(vector<AccelBounds>::const_iterator part = parts.begin(); part != parts.end(); part++)
		Include_Box(box, ((*part).*side).Box());

	return AccelRegion(box);
}

/// Is a part asked by all rays that meet the other?
static bool Is_Asked_Beside(const ObjectBase *part, const ObjectBase *other)
{
	const unsigned int flags = NO_SHADOW_FLAG | NO_IMAGE_FLAG | NO_REFLECTION_FLAG | NO_RADIOSITY_FLAG;

	return (part->Flags & flags & ~other->Flags) == 0;
}

static void Bound_Union(const CompoundObject& compound, const AccelReach& reach, AccelBounds& bounds)
{
	const bool merge = (dynamic_cast<const CSGMerge *>(&compound) != NULL);
	const vector<const ObjectBase *> objects = Lit_Parts(compound);
	vector<AccelBounds> parts;
	accel_box hits = Empty_Box();

	Find_Bounds_Of_Parts(objects, reach, parts, bounds);
	bounds.inside = Side_Of_Some(parts, &AccelBounds::inside);
	bounds.outside = Side_Of_All(parts, &AccelBounds::outside, bounds.slack, reach);
	for(size_t i = 0; i < parts.size(); i++)
	{
		AccelRegion region(parts[i].hits);

		for(size_t j = 0; merge && (j < parts.size()); j++)
		{
			if((j != i) && !parts[j].outside.IsEverything() && Is_Asked_Beside(objects[j], objects[i]))
				region.Intersect(As_Tested(parts[j].outside, bounds.slack, reach));
		}
		Include_Box(hits, region.Box());
	}
	bounds.hits = AccelRegion(hits);
	Show_Parts(compound, false, parts, bounds, reach);
}

/// A hit on a part whose hits lie in the region of its inside lies in that of all parts.
static void Bound_Intersection(const CompoundObject& compound, const AccelReach& reach, AccelBounds& bounds)
{
	vector<AccelBounds> parts;
	accel_box hits = Empty_Box();

	Find_Bounds_Of_Parts(Lit_Parts(compound), reach, parts, bounds);
	bounds.inside = Side_Of_All(parts, &AccelBounds::inside, bounds.slack, reach);
	bounds.outside = Side_Of_Some(parts, &AccelBounds::outside);

	const accel_box inside = bounds.inside.Box();

	for(size_t i = 0; i < parts.size(); i++)
	{
		AccelRegion region(parts[i].hits);

		if(parts[i].solid)
			Intersect_Box(region.box, inside);
		for(size_t j = 0; !parts[i].solid && (j < parts.size()); j++)
		{
			if(j != i)
				region.Intersect(As_Tested(parts[j].inside, bounds.slack, reach));
		}
		Include_Box(hits, region.Box());
	}
	bounds.hits = AccelRegion(hits);
	Show_Parts(compound, true, parts, bounds, reach);
}

/// Without the clips of the object itself.
static void Find_Own_Bounds(const ObjectBase *object, const AccelReach& reach, AccelBounds& bounds)
{
	const CompoundObject *compound = dynamic_cast<const CompoundObject *>(object);

	if(compound == NULL)
		Find_Shape_Bounds(object, reach, bounds);
	else if(dynamic_cast<const CSGIntersection *>(object) != NULL)
		Bound_Intersection(*compound, reach, bounds);
	else if(dynamic_cast<const CSGUnion *>(object) != NULL)
		Bound_Union(*compound, reach, bounds);
	else if((dynamic_cast<const LightSource *>(object) != NULL) && !compound->children.empty())
	{
		AccelBounds own;

		Find_Bounds(compound->children[0], reach, bounds);
		Find_Own_Bounds(compound->children[0], reach, own);
		bounds.inside = own.inside;
		bounds.outside = own.outside;
	}
	else
		bounds = AccelBounds();
}

static void Find_Bounds(const ObjectBase *object, const AccelReach& reach, AccelBounds& bounds)
{
	const bool clipsHits = (dynamic_cast<const BicubicPatch *>(object) == NULL) && (dynamic_cast<const LightSource *>(object) == NULL);

	Find_Own_Bounds(object, reach, bounds);
	for(vector<ObjectPtr>::const_iterator clip = object->Clip.begin(); clip != object->Clip.end(); clip++)
	{
		AccelBounds clipBounds;

		Find_Bounds(*clip, reach, clipBounds);

		const AccelRegion region = As_Tested(clipBounds.inside, bounds.slack, reach);
		accel_box outside = bounds.outside.Box();

		if(clipsHits)
			bounds.hits.Intersect(region);
		bounds.inside.Intersect(region);
		Include_Box(outside, clipBounds.outside.Box());
		bounds.outside = AccelRegion(outside);
		bounds.solid = bounds.solid && clipsHits;
	}
}

vector<accel_box> Find_Boxes(const vector<ObjectPtr>& objects, const AccelReach& reach)
{
	vector<accel_box> boxes(objects.size());

	for(size_t i = 0; i < objects.size(); i++)
	{
		AccelBounds bounds;

		Find_Bounds(objects[i], reach, bounds);
		boxes[i] = bounds.hits.Box();
		Include_Box(boxes[i], bounds.strays);
	}

	return boxes;
}

/*
 * A union settles a point by a part that it is inside of, an intersection by one that
 * it is outside of. Parts whose box of that side is not finite are always asked. In an
 * intersection, a point that is outside of one of those is settled by it, and a hit
 * there does not count; so the boxes of the others need not reach beyond. Its own hits
 * are in its inside only if it is solid: a patch does not ask itself.
 */
static void Boxes_Of_Parts(const vector<AccelBounds>& bounds, const VECTOR slack, bool common, const AccelReach& reach, vector<accel_box>& boxes, vector<uint32_t>& always)
{
	AccelRegion within;

	for(size_t i = 0; i < bounds.size(); i++)
	{
		boxes.push_back(bounds[i].hits.Box());
		Include_Box(boxes[i], (common ? bounds[i].outside : bounds[i].inside).Box());
		if(!Is_Finite(boxes[i]) && !Is_Empty(boxes[i]))
		{
			always.push_back(i);
			boxes[i] = Empty_Box();
			if(common && bounds[i].solid)
				within.Intersect(As_Tested(bounds[i].inside, slack, reach));
		}
	}

	const accel_box limit = within.Box();

	for(size_t i = 0; i < bounds.size(); i++)
	{
		Intersect_Box(boxes[i], limit);
		Include_Box(boxes[i], bounds[i].strays);
	}
}

void Find_Part_Boxes(const vector<ObjectPtr>& parts, bool common, const AccelReach& reach, vector<accel_box>& boxes, vector<uint32_t>& always)
{
	vector<AccelBounds> bounds;
	AccelBounds together;

	Find_Bounds_Of_Parts(vector<const ObjectBase *>(parts.begin(), parts.end()), reach, bounds, together);
	for(size_t i = 0; i < parts.size(); i++)
	{
		if(Is_Dark_Light(parts[i]))
			bounds[i].hits = bounds[i].inside = bounds[i].outside = AccelRegion(Empty_Box());
	}
	Boxes_Of_Parts(bounds, together.slack, common, reach, boxes, always);
}

/// POV-Ray's own box of an object, as far as points may be taken to lie in it.
static accel_box Box_Of_Stock(const ObjectBase *object)
{
	VECTOR low, high;

	Make_min_max_from_BBox(low, high, object->BBox);

	accel_box box = Box_Between(low, high);

	for(int axis = X; axis <= Z; axis++)
	{
		box.lo[axis] -= ldexp(max(fabs(low[axis]), fabs(high[axis])), -20);
		box.hi[axis] += ldexp(max(fabs(low[axis]), fabs(high[axis])), -20);
	}

	return box;
}

vector<accel_box> Find_Insides(const vector<ObjectPtr>& objects, const AccelReach& reach)
{
	vector<accel_box> boxes(objects.size());

	for(size_t i = 0; i < objects.size(); i++)
	{
		AccelBounds bounds;

		if((objects[i]->interior != NULL) || (dynamic_cast<const CompoundObject *>(objects[i]) != NULL))
			Find_Own_Bounds(objects[i], reach, bounds);
		boxes[i] = (objects[i]->interior != NULL) ? bounds.inside.Box() : Empty_Box();
	}

	return boxes;
}

vector<uint32_t> Objects_Beyond_Boxes(const vector<ObjectPtr>& objects, const vector<accel_box>& boxes, const vector<accel_box>& insides,
                                      AccelContainerSearch search)
{
	vector<uint32_t> beyond;

	for(size_t i = 0; i < objects.size(); i++)
	{
		accel_box box = insides[i];

		if(search == ACCEL_OF_CAMERA_RAYS)
			Intersect_Box(box, Box_Of_Stock(objects[i]));
		if(!Is_Empty(box) && !Box_In_Box(box, boxes[i]))
			beyond.push_back(i);
	}

	return beyond;
}



/*****************************************************************************
 *
 * Where rays begin
 *
 *****************************************************************************/

/// Half the largest side of what is neither infinite nor empty, for each object.
static vector<DBL> Radii(const vector<accel_box>& boxes)
{
	vector<DBL> radii;

	for(vector<accel_box>::const_iterator box = boxes.begin(); box != boxes.end(); box++)
	{
		if(Is_Finite(*box) && !Is_Empty(*box))
			radii.push_back(0.5 * max(max(box->hi[X] - box->lo[X], box->hi[Y] - box->lo[Y]), box->hi[Z] - box->lo[Z]));
	}

	return radii;
}

/// Where the rays of a camera begin, as TracePixel::CreateCameraRay says: on its meshes, on a plane or an axis, or within its
/// aperture.
static accel_box Origins_Of_Camera(const Camera& camera)
{
	DBL right, up;

	VLength(right, camera.Right);
	VLength(up, camera.Up);
	if(camera.Type == MESH_CAMERA)
	{
		accel_box box = Empty_Box();

		for(vector<ObjectPtr>::const_iterator mesh = camera.Meshes.begin(); mesh != camera.Meshes.end(); mesh++)
		{
			VECTOR low, high;

			Make_min_max_from_BBox(low, high, (*mesh)->BBox);
			Include_Point(box, low);
			Include_Point(box, high);
		}
		Grow_Box(box, fabs(camera.Location[Z])); // how far before the mesh
		return box;
	}

	const bool wide = (camera.Type == ORTHOGRAPHIC_CAMERA) || (camera.Type == CYL_3_CAMERA) || (camera.Type == CYL_4_CAMERA);

	return Box_Around(camera.Location, (wide ? right + up : 0.0) + fabs(camera.Aperture));
}

/// How far from a point the finite boxes, the camera, and with photons the lights, reach along an axis.
static DBL Farthest_Place(const SceneData& scene, const vector<accel_box>& boxes, const VECTOR center)
{
	const accel_box camera = Origins_Of_Camera(scene.parsedCamera);
	DBL farthest = 0.0;

	for(int axis = X; axis <= Z; axis++)
	{
		if(Is_Finite(camera) && !Is_Empty(camera))
			farthest = max(farthest, max(fabs(camera.lo[axis] - center[axis]), fabs(camera.hi[axis] - center[axis])));
		for(vector<accel_box>::const_iterator box = boxes.begin(); box != boxes.end(); box++)
		{
			if(Is_Finite(*box) && !Is_Empty(*box))
				farthest = max(farthest, max(fabs(box->lo[axis] - center[axis]), fabs(box->hi[axis] - center[axis])));
		}
		for(vector<LightSource *>::const_iterator light = scene.lightSources.begin(); light != scene.lightSources.end(); light++)
		{
			if(scene.photonSettings.photonsEnabled)
				farthest = max(farthest, fabs((*light)->Center[axis] - center[axis]));
		}
	}

	return farthest;
}

/// The surfaces of all bounded boxes together.
static DBL Surface(const vector<accel_box>& boxes)
{
	DBL sum = 0.0;

	for(vector<accel_box>::const_iterator box = boxes.begin(); box != boxes.end(); box++)
	{
		const DBL x = box->hi[X] - box->lo[X], y = box->hi[Y] - box->lo[Y], z = box->hi[Z] - box->lo[Z];
		const DBL surface = x * y + y * z + z * x;

		if(surface < HUGE_VAL)
			sum += surface;
	}

	return sum;
}

/// Finds the largest of some cubes, in radii, for which no more objects are without a box, and boxes hardly larger, than for the
/// camera alone; turns `boxes` from those for the camera into those for the cube.
static DBL Radius_Of_Near(const vector<ObjectPtr>& objects, const AccelReach& point, vector<accel_box>& boxes, DBL radius, DBL farthest)
{
	static const int exponents[] = { 20, 17, 14 };
	const size_t bounded = Radii(boxes).size();
	const DBL surface = Surface(boxes);
	AccelReach reach = point;

	for(int i = 0; i < 3; i++)
	{
		reach.radius = min(farthest, ldexp(radius, exponents[i]));
		boxes = Find_Boxes(objects, reach);
		if((Radii(boxes).size() == bounded) && (Surface(boxes) <= 1.01 * surface))
			break;
	}

	return reach.radius;
}

/// What 19 of 20 boxes reach at least from their middle; 1 if there are none.
static DBL Small_Radius(const vector<accel_box>& boxes)
{
	vector<DBL> radii = Radii(boxes);

	if(radii.empty())
		return 1.0;

	vector<DBL>::iterator small = radii.begin() + radii.size() / 20;

	std::nth_element(radii.begin(), small, radii.end());

	return *small;
}

AccelReach Find_Near_Reach(const vector<ObjectPtr>& objects, const AccelReach& whole)
{
	AccelReach reach = whole;

	reach.radius = 0.0;

	vector<accel_box> boxes = Find_Boxes(objects, reach);
	const DBL radius = Small_Radius(boxes);

	reach.radius = Radius_Of_Near(objects, reach, boxes, radius, whole.radius);

	return reach;
}

/*
 * Rays begin at the camera, on an object or at a light. Rounding in a leaf test grows
 * with the distance of that place, in units of the size of the shape. So most of the
 * objects, 19 of 20, set the near cubes: at 2^14 radii a sor is wrong by a sixth of
 * its size, at 2^20 a sphere by a ten-thousandth. A structure for rays from farther
 * away is built while they wait, so the near cube is as large as boxes allow. The largest
 * cubes hold all bounded objects, and where there are others, what MAX_DISTANCE lets
 * rays reach. From farther away no structure is asked.
 */
void Find_Reaches(const SceneData& scene, const vector<ObjectPtr>& objects, AccelGrazings& grazings, AccelReach reach[ACCEL_REACHES],
                  vector<accel_box>& near)
{
	AccelReach point;

	Assign_Vector(point.center, scene.parsedCamera.Location);
	point.radius = 0.0;
	point.grazings = &grazings;
	point.wanting = true;
	near = Find_Boxes(objects, point);
	point.wanting = false;
	if(grazings.Keep() == false)
		near = Find_Boxes(objects, point);

	const DBL radius = Small_Radius(near);
	DBL farthest = 2.0 * Farthest_Place(scene, near, point.center);

	if(Radii(near).size() < near.size())
		farthest = max(farthest, 2.0 * MAX_DISTANCE);
	farthest = min(farthest, ldexp(1.0, 27));
	for(int i = 0; i < ACCEL_REACHES; i++)
	{
		reach[i] = point;
		reach[i].radius = farthest;
	}
	reach[0].radius = Radius_Of_Near(objects, point, near, radius, farthest);
	reach[1].radius = min(farthest, ldexp(radius, 20));
	reach[ACCEL_REACHES - 1].grazings = NULL;
}

}
