/*******************************************************************************
 * povaccelframe.h
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module contains all defines, typedefs, and prototypes for
 * povaccelframe.cpp: where rays begin, and what follows from it for the rounding
 * in a leaf test that works in the space of its shape. It is a derivative work of
 * POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

#ifndef POVRAY_BACKEND_POVACCELFRAME_H
#define POVRAY_BACKEND_POVACCELFRAME_H

#include "backend/frame.h"
#include "backend/accel/povaccelregion.h"

namespace pov
{

/// Boxes are found for rays that begin in this cube. From farther away, leaf tests are wrong by more.
struct AccelReach
{
	VECTOR center;
	DBL radius;

	bool Holds(const VECTOR origin) const
	{
		return (fabs(origin[X] - center[X]) <= radius) && (fabs(origin[Y] - center[Y]) <= radius) && (fabs(origin[Z] - center[Z]) <= radius);
	}
};

/// The space of a shape, given a box around the shape in it. TRANSFORM keeps two matrices, and leaf tests go by `inverse`.
class AccelFrame
{
	public:
		/// The transformation may be NULL.
		AccelFrame(const TRANSFORM *trans, const AccelReach& reach, const accel_box& shape);

		/// Can boxes be brought from this space to that of the scene?
		bool known;
		/// How far the point on a ray that a leaf test computes in this space lies from the one that its depth means, along each axis.
		VECTOR rounding;
		/// Any point of a ray between its origin and the shape, its differences and their sums lie in a ball of this size around the origin of this space.
		DBL length;
		/// The size of the error in a quadratic form with factors 1 that is 0 at a computed hit: see povaccelframe.cpp.
		DBL form;
		/// The longest way from the origin of a ray to the shape, in the scene.
		DBL way;
		/// How far the point that a leaf test hands to others (IPoint) may lie from the one that its depth means.
		VECTOR slack;

		/// The box in the scene of a box in this space.
		accel_box ToScene(const accel_box& box) const;

		/// The box in the scene of an ellipsoid in this space, flat where a radius is 0, with a ball around each of its points.
		/// Includes `rounding`.
		accel_box RoundToScene(const VECTOR center, const VECTOR radius, DBL ball) const;

		/// The same for a cylinder along an axis of this space, from lo to hi.
		accel_box CylinderToScene(int along, DBL lo, DBL hi, DBL radius) const;

		/// A bound on how much longer directions in the scene are than in this space.
		DBL Stretch() const;

		/// A half-space in the scene from one in this space.
		void AddHalfSpace(AccelRegion& region, const VECTOR normal, DBL distance) const;
	private:
		MATRIX matrix, inverse;
		VECTOR mismatch; // in the scene: how far matrix brings a point from where inverse took it from

		void FindMismatch(const accel_box& image);
};

}

#endif // POVRAY_BACKEND_POVACCELFRAME_H
