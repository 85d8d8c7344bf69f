/*******************************************************************************
 * povaccelfew.cpp
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module asks boxes before the parts of a CSG object are tested, where these
 * are too few for a structure. It is a derivative work of POV-Ray 3.7.0.10; see
 * LICENSE.
 *
 * A box is asked by the slab test, which may not pass over a hit that lies in it. Let
 * a hit have the depth t >= 0, u = 2^-53. On each axis (lo - o) / d <= t <= (hi - o)
 * / d for d > 0, and the other way round for d < 0. Computed are (plane - o) * (1 / d),
 * which three roundings change by less than 4u, relatively: a near crossing that
 * exceeds a far one by no more than that, in units of either, does not separate them,
 * nor does a far one of less than 0. For d = 0 a product is infinite, with the sign
 * that keeps what is between the planes, or a NaN on a plane, which cuts nothing off.
 * Underflow changes products by 2^-1074, and hits are not that near: MIN_ISECT_DEPTH.
 *******************************************************************************/

#include <cfloat>

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"

#include "backend/accel/povaccelbox.h"
#include "backend/accel/povaccelfew.h"
#include "backend/render/ray.h"
#include "backend/scene/objects.h"
#include "backend/shape/boxes.h"
#include "backend/shape/cones.h"
#include "backend/shape/discs.h"
#include "backend/shape/planes.h"
#include "backend/shape/spheres.h"
#include "backend/shape/triangle.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

AccelFewParts::AccelFewParts(const vector<accel_box>& b, uint32_t a) : boxes(b), always(a) { }

/// Is the inverse of a component finite, and no underflow, or that of 0? So it is in all renders.
static inline bool Is_Usual(DBL component)
{
	return ((fabs(component) > 1.0e-290) && (fabs(component) < 1.0e290)) || (component == 0.0);
}

/// Cuts the interval of the ray on one axis. What is not a number cuts nothing off.
static inline void Cut_Slab(const accel_box& box, int axis, DBL origin, DBL inverse, DBL& begin, DBL& end)
{
	const DBL near = ((inverse < 0.0 ? box.hi[axis] : box.lo[axis]) - origin) * inverse;
	const DBL far = ((inverse < 0.0 ? box.lo[axis] : box.hi[axis]) - origin) * inverse;

	begin = (near > begin) ? near : begin;
	end = (far < end) ? far : end;
}

uint32_t AccelFewParts::Near(const Ray& ray) const
{
	const DBL *origin = ray.Origin, *direction = ray.Direction;
	const DBL inverse[3] = { 1.0 / direction[X], 1.0 / direction[Y], 1.0 / direction[Z] };
	const DBL nearest = ray.IsSubsurfaceRay() ? -HUGE_VAL : 0.0;
	uint32_t near = always;

	if(!Is_Usual(direction[X]) || !Is_Usual(direction[Y]) || !Is_Usual(direction[Z]))
		return All();
	for(uint32_t asked = All() & ~always; asked != 0; asked &= asked - 1)
	{
		const int i = __builtin_ctz(asked);
		DBL begin = nearest, end = HUGE_VAL;

		for(int axis = X; axis <= Z; axis++)
			Cut_Slab(boxes[i], axis, origin[axis], inverse[axis], begin, end);
		// each end by 4u, and the sums of this line
		if(begin - fabs(begin) * (4.0 * DBL_EPSILON) <= end + fabs(end) * (4.0 * DBL_EPSILON))
			near |= 1u << i;
	}

	return near;
}

uint32_t AccelFewParts::Near(const VECTOR point) const
{
	uint32_t near = always;

	for(uint32_t asked = All() & ~always; asked != 0; asked &= asked - 1)
	{
		const int i = __builtin_ctz(asked);
		const accel_box& box = boxes[i];

		near |= uint32_t((box.lo[X] <= point[X]) && (point[X] <= box.hi[X]) && (box.lo[Y] <= point[Y]) && (point[Y] <= box.hi[Y]) &&
		                 (box.lo[Z] <= point[Z]) && (point[Z] <= box.hi[Z])) << i;
	}

	return near;
}

/// Takes the test of a part hardly longer than that of a box? Cones were measured as well: to ask their boxes gains nothing.
static bool Is_Cheap(const ObjectBase *part)
{
	return (dynamic_cast<const Sphere *>(part) != NULL) || (dynamic_cast<const Box *>(part) != NULL) || (dynamic_cast<const Plane *>(part) != NULL) ||
	       (dynamic_cast<const Triangle *>(part) != NULL) || (dynamic_cast<const Cone *>(part) != NULL) || (dynamic_cast<const Disc *>(part) != NULL);
}

bool AccelFewBoxes::Wants(const CompoundObject& compound) const
{
	return (compound.children.size() > 1) && (compound.children.size() < mostParts) && (kept.count(&compound) == 0);
}

static DBL Surface(const accel_box& box)
{
	const DBL x = box.hi[X] - box.lo[X], y = box.hi[Y] - box.lo[Y], z = box.hi[Z] - box.lo[Z];

	return x * y + y * z + z * x;
}

/// A part is worth asking for if it is not cheap, and few enough of the rays that come to the object meet its box: about so many
/// as its part of the surface.
void AccelFewBoxes::See(const CompoundObject& compound, const accel_box& whole, const vector<accel_box>& boxes, const vector<uint32_t>& always)
{
	const DBL most = 0.7 * Surface(whole);
	uint32_t notAsked = 0;

	for(vector<uint32_t>::const_iterator i = always.begin(); i != always.end(); i++)
		notAsked |= 1u << *i;
	for(size_t i = 0; i < boxes.size(); i++)
	{
		if(!Is_Empty(boxes[i]) && (Is_Cheap(compound.children[i]) || !(Surface(boxes[i]) < most)))
			notAsked |= 1u << i;
	}
	if(notAsked != (1u << boxes.size()) - 1)
		kept[&compound] = AccelFewParts(boxes, notAsked);
}

const AccelFewParts *AccelFewBoxes::Of(const CompoundObject& compound) const
{
	const std::unordered_map<const CompoundObject *, AccelFewParts>::const_iterator found = kept.find(&compound);

	return (found == kept.end()) ? NULL : &found->second;
}

}
