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
#include "backend/accel/povaccelgrazing.h"
#include "backend/accel/povaccelregion.h"

namespace pov
{

/// How many cubes there are, from near to far, the last for grazing rays.
static const int ACCEL_REACHES = 4;

/// Which of the rays along a grazing direction does a box have to allow for?
enum AccelRays
{
	ACCEL_NO_RAYS,
	ACCEL_USUAL_RAYS, // as many as a box that is not endless can
	ACCEL_ALL_RAYS
};

class CompoundObject;

/// Sees the parts of CSG objects while bounds are found.
class AccelPartObserver
{
	public:
		virtual bool Wants(const CompoundObject& compound) const = 0;

		/// A box around the hits of the object, and what Find_Part_Boxes says of its parts.
		virtual void See(const CompoundObject& compound, const accel_box& whole, const vector<accel_box>& boxes, const vector<uint32_t>& always) = 0;
	protected:
		~AccelPartObserver() { }
};

/// Boxes are found for rays that begin in this cube. From farther away, leaf tests are wrong by more.
struct AccelReach
{
	VECTOR center;
	DBL radius;
	AccelGrazings *grazings; // rays that do not belong here; NULL: all do
	bool wanting; // what is wanted for grazings is only now found
	AccelPartObserver *observer; // or NULL

	/// No place at all.
	AccelReach() : radius(-1.0), grazings(NULL), wanting(false), observer(NULL) { center[X] = center[Y] = center[Z] = 0.0; }

	/// Does a ray along there not belong here, wherever it begins?
	bool LeavesOut(const VECTOR direction) const { return (grazings != NULL) && grazings->Holds(direction); }

	AccelRays Rays(const AccelGrazing& grazing) const
	{
		if(grazings == NULL)
			return ACCEL_ALL_RAYS;
		if(wanting)
			grazings->Want(grazing);

		return (wanting || grazings->Keeps(grazing)) ? ACCEL_NO_RAYS : ACCEL_USUAL_RAYS;
	}

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
		/// Bounds in this space the way from the origin of a ray to any point of the shape.
		DBL distance;
		/// The same in the scene.
		DBL way;
		/// Bounds the coordinates of such a ray as well, seen from the origin of this space.
		DBL length;
		/// The error of a quadratic form with factors 1 at a computed hit, for a sphere, whose centre is subtracted first, and for
		/// what stands at the origin of this space: see povaccelframe.cpp.
		DBL sphereForm, form;
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

		/// A bound on how much longer directions are in this space than in the scene.
		DBL Shrinkage() const;

		/// What times a direction in the scene is its component along an axis of this space.
		void Along(int axis, VECTOR normal) const;

		/// The form in the scene of the sum of factor[k] * direction[k]^2 in this space.
		void SquaresInScene(const VECTOR factor, VECTOR square, VECTOR mixed) const;

		/// A half-space in the scene from one in this space.
		void AddHalfSpace(AccelRegion& region, const VECTOR normal, DBL distance) const;
	private:
		MATRIX matrix, inverse;
		VECTOR mismatch; // in the scene: how far matrix brings a point from where inverse took it from

		void FindMismatch(const accel_box& image);
		void FindSizes(const AccelReach& reach, const accel_box& shape, const accel_box& image);
};

}

#endif // POVRAY_BACKEND_POVACCELFRAME_H
