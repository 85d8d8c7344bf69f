/*******************************************************************************
 * povaccelbox.cpp
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module finds the boxes of POV-Ray's objects for the accel library: boxes
 * that hold every point where the leaf test of an object may report a hit.
 * POV-Ray's own BBox does not always: it is in float, rounded to nearest, and for
 * some objects it says nothing about the hits. It is a derivative work of
 * POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"

#include "backend/accel/povaccelbox.h"
#include "backend/scene/objects.h"
#include "backend/scene/scene.h"
#include "backend/shape/csg.h"
#include "backend/shape/discs.h"
#include "backend/shape/hfield.h"
#include "backend/shape/planes.h"
#include "backend/shape/poly.h"
#include "backend/shape/sphsweep.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

static bool Has_Inverted_Clip(const ObjectBase *object)
{
	for(vector<ObjectPtr>::const_iterator clip = object->Clip.begin(); clip != object->Clip.end(); clip++)
	{
		if(Test_Flag(*clip, INVERTED_FLAG))
			return true;
	}

	return false;
}

/*
 * Is the BBox of an object known to hold all points inside it? Not for a disc
 * or height_field: what is behind the one or below the other counts as inside.
 */
static bool Box_Holds_Inside(const ObjectBase *object)
{
	if((dynamic_cast<const Disc *>(object) != NULL) || (dynamic_cast<const HField *>(object) != NULL))
		return false;

	const CompoundObject *compound = dynamic_cast<const CompoundObject *>(object);

	if(compound != NULL)
	{
		for(vector<ObjectPtr>::const_iterator child = compound->children.begin(); child != compound->children.end(); child++)
		{
			if(Box_Holds_Inside(*child) == false)
				return false;
		}
	}

	return true;
}

static bool Box_Holds_Hits(const ObjectBase *object);

/*
 * The box of an intersection is the intersection of the boxes of its parts, but
 * for those that are inverted or height_fields; a hit on one part is inside all
 * others. The box of a union holds those of its parts.
 */
static bool Box_Of_Parts_Holds_Hits(const CompoundObject *compound)
{
	bool intersection = (dynamic_cast<const CSGIntersection *>(compound) != NULL);

	for(vector<ObjectPtr>::const_iterator child = compound->children.begin(); child != compound->children.end(); child++)
	{
		if(Box_Holds_Hits(*child) == false)
			return false;
		if(intersection && !Test_Flag(*child, INVERTED_FLAG) && (dynamic_cast<const HField *>(*child) == NULL) &&
		   (Box_Holds_Inside(*child) == false))
			return false;
	}

	return true;
}

/*
 * Is the BBox of an object known to hold all its hits? It is not
 * - with a bounded_by: the box may be that of the bounding object, which only
 *   has to be hit by the ray, while the surface may be anywhere along it;
 * - for a plane or poly whose clipping object is inverted: it takes the box of
 *   its first clipping object, inverted or not;
 * - for a sphere_sweep: the box is that of the modelling spheres, which a
 *   spline may leave;
 * - for an inverted CSG object: inverting turns its operation around, but
 *   leaves the box alone;
 * - if it is not for a part of a CSG object.
 */
static bool Box_Holds_Hits(const ObjectBase *object)
{
	if(object->Bound.empty() == false)
		return false;
	if((dynamic_cast<const Plane *>(object) != NULL) || (dynamic_cast<const Poly *>(object) != NULL))
		return (Has_Inverted_Clip(object) == false);
	if(dynamic_cast<const SphereSweep *>(object) != NULL)
		return false;

	const CompoundObject *compound = dynamic_cast<const CompoundObject *>(object);

	return (compound == NULL) || (!Test_Flag(object, INVERTED_FLAG) && Box_Of_Parts_Holds_Hits(compound));
}

/// The box of an object as POV-Ray has it. With looks_like, a light source has the hits of that object.
static const ObjectBase *Boxed_Object(const ObjectBase *object)
{
	const LightSource *light = dynamic_cast<const LightSource *>(object);

	return (light != NULL) ? light->children[0] : object;
}

/// False if the box of an object is infinite or not known.
static bool Get_Box(const ObjectBase *object, accel_box& box)
{
	bool known = !Test_Flag(object, INFINITE_FLAG) && Box_Holds_Hits(object);

	for(int axis = X; axis <= Z; axis++)
	{
		box.lo[axis] = object->BBox.Lower_Left[axis];
		box.hi[axis] = (DBL)object->BBox.Lower_Left[axis] + (DBL)object->BBox.Lengths[axis];
		known = known && (box.lo[axis] <= box.hi[axis]);
	}

	return known;
}

/*
 * Grows a box by what POV-Ray may be wrong, for rays that begin at most
 * `distance` away. It covers
 * (a) the rounding of the box to float: at most 2^-24 of the largest coordinate
 *     for the corner, and 2^-23 for the length, which may be twice that
 *     coordinate;
 * (b) the error of the solvers of a quadratic: its coefficients grow as
 *     distance^2, its discriminant is wrong by some 8 * 2^-53 of that, and a
 *     root by this over the chord, which is about the extent where the ray
 *     enters the box. 2^-48 leaves a factor of 4. More than the extent is not
 *     granted: a solver that is wrong by so much finds the surface by chance;
 * (c) other solvers: 1e-4 of the extent is an allowance, not a bound; it
 *     enlarges the area of a box by 0.04 %.
 * Hits before their box are counted and reported.
 */
static void Grow_Box(accel_box& box, DBL distance)
{
	DBL extent = 0.0;
	DBL coordinate = 0.0;

	for(int axis = X; axis <= Z; axis++)
	{
		extent = max(extent, box.hi[axis] - box.lo[axis]);
		coordinate = max(coordinate, max(fabs(box.lo[axis]), fabs(box.hi[axis])));
	}

	DBL solver = (extent > 0.0) ? min(ldexp(distance * distance, -48) / extent, extent) : 0.0;
	DBL padding = ldexp(coordinate, -22) + solver + 1.0e-4 * extent;

	for(int axis = X; axis <= Z; axis++)
	{
		box.lo[axis] -= padding;
		box.hi[axis] += padding;
	}
}

static void Include_Point(accel_box& box, const VECTOR point)
{
	for(int axis = X; axis <= Z; axis++)
	{
		box.lo[axis] = min(box.lo[axis], point[axis]);
		box.hi[axis] = max(box.hi[axis], point[axis]);
	}
}

/// The longest way from where rays begin, the camera, finite objects and for photons the lights, to a finite object.
static DBL Longest_Way(const SceneData& scene, const vector<accel_box>& boxes)
{
	accel_box all = { { HUGE_VAL, HUGE_VAL, HUGE_VAL }, { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL } };
	DBL length = 0.0;

	for(vector<accel_box>::const_iterator box = boxes.begin(); box != boxes.end(); box++)
	{
		if(box->hi[X] < HUGE_VAL)
		{
			Include_Point(all, box->lo);
			Include_Point(all, box->hi);
		}
	}
	Include_Point(all, scene.parsedCamera.Location);
	if(scene.photonSettings.photonsEnabled)
	{
		for(vector<LightSource *>::const_iterator light = scene.lightSources.begin(); light != scene.lightSources.end(); light++)
			Include_Point(all, (*light)->Center);
	}
	for(int axis = X; axis <= Z; axis++)
		length += Sqr(all.hi[axis] - all.lo[axis]);

	return sqrt(length);
}

vector<accel_box> Find_Boxes(const SceneData& scene, const vector<ObjectPtr>& objects)
{
	const accel_box unbounded = { { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL }, { HUGE_VAL, HUGE_VAL, HUGE_VAL } };
	vector<accel_box> boxes(objects.size());

	for(size_t i = 0; i < objects.size(); i++)
	{
		if(Get_Box(Boxed_Object(objects[i]), boxes[i]) == false)
			boxes[i] = unbounded;
	}

	const DBL distance = Longest_Way(scene, boxes);

	for(size_t i = 0; i < objects.size(); i++)
	{
		if(boxes[i].hi[X] < HUGE_VAL)
			Grow_Box(boxes[i], distance);
	}

	return boxes;
}

}
