/*******************************************************************************
 * povaccelregion.h
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module contains all defines, typedefs, and prototypes for
 * povaccelregion.cpp: sets of points that are the intersection of a box,
 * half-spaces and quadrics, and the boxes around them. It is a derivative work of
 * POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

#ifndef POVRAY_BACKEND_POVACCELREGION_H
#define POVRAY_BACKEND_POVACCELREGION_H

#include <vector>

#include "backend/frame.h"
#include "backend/accel/accel.h"

namespace pov
{

/// The whole space as a box.
accel_box Infinite_Box();

/// The box of no point: what other boxes can be added to.
accel_box Empty_Box();

bool Is_Empty(const accel_box& box);

/// Are all its sides finite?
bool Is_Finite(const accel_box& box);

bool Box_In_Box(const accel_box& inner, const accel_box& outer);
void Include_Point(accel_box& box, const VECTOR point);
void Include_Box(accel_box& box, const accel_box& other);
void Intersect_Box(accel_box& box, const accel_box& other);

/// Moves each side outward, by an amount for each axis or one for all.
void Grow_Box(accel_box& box, const VECTOR amount);
void Grow_Box(accel_box& box, DBL amount);

/// The points where normal * point <= distance. The normal has length 1.
struct AccelHalfSpace
{
	VECTOR normal;
	DBL distance;
};

/// The points where the sum over k of (square[k] * y[k] + linear[k]) * y[k] is at most -constant, y[k] being axis[k] * point.
struct AccelQuadric
{
	VECTOR axis[3]; // orthonormal
	DBL square[3];
	DBL linear[3];
	DBL constant;
	bool exact; // the axes are those of space, so that nothing was rounded
	int allowed; // the axis along which the constant allows for rounding, or -1

	AccelQuadric() : allowed(-1) { }
};

/// The points that lie in a box, in all half-spaces and in all quadrics.
class AccelRegion
{
	public:
		/// The whole space.
		AccelRegion() : box(Infinite_Box()) { }
		explicit AccelRegion(const accel_box& b) : box(b) { }

		accel_box box;
		vector<AccelHalfSpace> halves;
		vector<AccelQuadric> quadrics;

		void AddHalfSpace(const VECTOR normal, DBL distance);
		void Intersect(const AccelRegion& other);

		/// Adds what lies at most `amount` away, for each axis. Of quadrics, what lies at most `magnitude` from the origin.
		void Grow(const VECTOR amount, DBL magnitude);

		/// A box that holds the region.
		accel_box Box() const;

		/// Is it no more than its box?
		bool IsBox() const { return halves.empty() && quadrics.empty(); }

		/// Is it the whole space?
		bool IsEverything() const { return IsBox() && Box_In_Box(Infinite_Box(), box); }
};

}

#endif // POVRAY_BACKEND_POVACCELREGION_H
