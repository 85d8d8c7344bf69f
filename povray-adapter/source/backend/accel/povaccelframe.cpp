/*******************************************************************************
 * povaccelframe.cpp
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module says how far the rounding of double takes the hit of a leaf test
 * from the shape. A leaf test brings the ray into the space of the shape with
 * TRANSFORM::inverse, makes the direction a unit vector, solves there for a depth,
 * and divides it by the length that the direction had.
 *
 * With u = 2^-53 and M[k] bounding the coordinates of ray origins, of the shape and
 * of the way between them, A[j] = sum over k of |inverse[k][j]| * M[k], plus
 * |inverse[3][j]|, bounds all that is added up for coordinate j of a local point:
 *
 * - The local origin is wrong by 4u * A[j], what the local direction contributes at
 *   the hit by 8u * A[j], and a leaf test's own evaluation of the point by 3u * A[j].
 *   `rounding` is 16u * A[j].
 * - A leaf test that solves t*t*a + 2*t*b + c = 0 with a = d*d, b = o*d, c = o*o - r*r
 *   computes the discriminant b*b - a*c. Each of a, b, c is a sum of three products,
 *   wrong by 5u of the sum of their sizes, so the discriminant is wrong by 25u * a * L^2
 *   where L bounds |o| and |t*d|, and the form at the root by that over a; rounding
 *   the root itself adds 16u * L^2, and a direction whose length is not quite 1
 *   another 6u * L^2. `form` is 64u * L^2 with L = `length`, or for a sphere, where o is
 *   seen from the centre, with L = `distance`. So a hit on a sphere of radius r lies
 *   no farther from its centre than sqrt(r*r + sphereForm), however small the chord.
 *
 * Boxes are brought back with TRANSFORM::matrix, which is not exactly the inverse of
 * `inverse`; `mismatch` is what the product of both takes from a point. It is a
 * derivative work of POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

#include <cstring>

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"

#include "backend/accel/povaccelframe.h"
#include "backend/math/matrices.h"
#include "backend/math/vector.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

/// Beyond this from the origin of the scene no point of an infinite shape is thought of.
static const DBL FARTHEST = 1073741824.0; // 2^30

/// The largest coordinates of a box along an axis, or FARTHEST for an infinite one.
static DBL Largest_Coordinate(const accel_box& box, int axis)
{
	return min(max(fabs(box.lo[axis]), fabs(box.hi[axis])), FARTHEST);
}

AccelFrame::AccelFrame(const TRANSFORM *trans, const AccelReach& reach, const accel_box& shape) : known(true)
{
	if(trans != NULL)
	{
		memcpy(matrix, trans->matrix, sizeof(MATRIX));
		memcpy(inverse, trans->inverse, sizeof(MATRIX));
	}
	else
	{
		MIdentity(matrix);
		MIdentity(inverse);
	}
	Make_Vector(mismatch, 0.0, 0.0, 0.0);

	accel_box image = ToScene(shape);

	if(trans != NULL)
		FindMismatch(image);
	FindSizes(reach, shape, image);
}

void AccelFrame::FindSizes(const AccelReach& reach, const accel_box& shape, const accel_box& image)
{
	VECTOR coordinate, ways;

	for(int k = X; k <= Z; k++)
	{
		coordinate[k] = fabs(reach.center[k]) + max(reach.radius, 0.0) + Largest_Coordinate(image, k);
		ways[k] = min(coordinate[k], max(reach.radius, 0.0) + max(fabs(image.lo[k] - reach.center[k]), fabs(image.hi[k] - reach.center[k])));
	}
	way = sqrt(Sqr(ways[X]) + Sqr(ways[Y]) + Sqr(ways[Z]));
	distance = length = 0.0;
	for(int axis = X; axis <= Z; axis++)
	{
		DBL sum = fabs(inverse[3][axis]), difference = 0.0;

		for(int k = X; k <= Z; k++)
		{
			sum += fabs(inverse[k][axis]) * coordinate[k];
			difference += fabs(inverse[k][axis]) * ways[k];
		}
		rounding[axis] = ldexp(sum, -49);
		distance += Sqr(difference);
		length += Sqr(difference + Largest_Coordinate(shape, axis));
	}
	sphereForm = ldexp(distance, -47);
	form = ldexp(length, -47);
	distance = sqrt(distance);
	length = sqrt(length);
	known = known && (length < HUGE_VAL);
	for(int axis = X; axis <= Z; axis++)
	{
		slack[axis] = mismatch[axis] + ldexp(coordinate[axis], -48);
		for(int k = X; k <= Z; k++)
			slack[axis] += fabs(matrix[k][axis]) * rounding[k];
		if(!(slack[axis] < HUGE_VAL)) // NaN would be lost where the largest of several is sought
			slack[axis] = HUGE_VAL;
	}
}

/*
 * The product of both matrices, less the identity, times a point. The point is
 * bounded by twice the image of the shape, which is right if the mismatch itself
 * is not larger than that image.
 */
void AccelFrame::FindMismatch(const accel_box& image)
{
	const DBL size = max(max(Largest_Coordinate(image, X), Largest_Coordinate(image, Y)), Largest_Coordinate(image, Z));

	for(int axis = X; axis <= Z; axis++)
	{
		DBL wrong = 0.0;

		for(int row = 0; row <= 3; row++)
		{
			DBL sum = (row == 3) ? matrix[3][axis] : 0.0, products = fabs(sum);

			for(int k = X; k <= Z; k++)
			{
				sum += inverse[row][k] * matrix[k][axis];
				products += fabs(inverse[row][k] * matrix[k][axis]);
			}
			if(row == axis)
				sum -= 1.0;
			wrong += (fabs(sum) + ldexp(products, -50)) * ((row == 3) ? 1.0 : 2.0 * size);
		}
		if(!(wrong <= size))
			known = false;
		mismatch[axis] = wrong;
	}
}

accel_box AccelFrame::ToScene(const accel_box& box) const
{
	accel_box image;

	if(Is_Empty(box))
		return Empty_Box();
	if(known == false)
		return Infinite_Box();
	for(int axis = X; axis <= Z; axis++)
	{
		DBL size = fabs(matrix[3][axis]);

		image.lo[axis] = image.hi[axis] = matrix[3][axis];
		for(int k = X; k <= Z; k++)
		{
			const DBL factor = matrix[k][axis];

			if(factor != 0.0)
			{
				image.lo[axis] += factor * ((factor > 0.0) ? box.lo[k] : box.hi[k]);
				image.hi[axis] += factor * ((factor > 0.0) ? box.hi[k] : box.lo[k]);
				size += fabs(factor) * Largest_Coordinate(box, k);
			}
		}

		const DBL wrong = mismatch[axis] + ldexp(size, -50);

		image.lo[axis] -= wrong;
		image.hi[axis] += wrong;
		if(!(image.lo[axis] <= image.hi[axis]))
			return Infinite_Box();
	}

	return image;
}

accel_box AccelFrame::RoundToScene(const VECTOR center, const VECTOR radius, DBL ball) const
{
	accel_box image;

	if(known == false)
		return Infinite_Box();
	for(int axis = X; axis <= Z; axis++)
	{
		DBL middle = matrix[3][axis], size = fabs(middle), ellipse2 = 0.0, stretch2 = 0.0, extent = mismatch[axis];

		for(int k = X; k <= Z; k++)
		{
			middle += matrix[k][axis] * center[k];
			size += fabs(matrix[k][axis] * center[k]);
			ellipse2 += Sqr(matrix[k][axis] * radius[k]);
			stretch2 += Sqr(matrix[k][axis]);
			extent += fabs(matrix[k][axis]) * rounding[k];
		}
		extent += (sqrt(ellipse2) + ball * sqrt(stretch2)) * (1.0 + ldexp(1.0, -48)) + ldexp(size, -50);
		image.lo[axis] = middle - extent;
		image.hi[axis] = middle + extent;
		if(!(image.lo[axis] <= image.hi[axis]))
			return Infinite_Box();
	}

	return image;
}

accel_box AccelFrame::CylinderToScene(int along, DBL lo, DBL hi, DBL radius) const
{
	VECTOR center, radii;

	Make_Vector(center, 0.0, 0.0, 0.0);
	Make_Vector(radii, radius, radius, radius);
	radii[along] = 0.0;
	center[along] = lo;

	accel_box image = RoundToScene(center, radii, 0.0);

	center[along] = hi;
	Include_Box(image, RoundToScene(center, radii, 0.0));

	return image;
}

/// Frobenius norm.
static DBL Size_Of(const MATRIX matrix)
{
	DBL sum = 0.0;

	for(int k = X; k <= Z; k++)
	{
		for(int axis = X; axis <= Z; axis++)
			sum += Sqr(matrix[k][axis]);
	}

	return sqrt(sum);
}

DBL AccelFrame::Stretch() const
{
	return Size_Of(matrix);
}

DBL AccelFrame::Shrinkage() const
{
	return Size_Of(inverse);
}

void AccelFrame::Along(int axis, VECTOR normal) const
{
	for(int k = X; k <= Z; k++)
		normal[k] = inverse[k][axis];
}

void AccelFrame::SquaresInScene(const VECTOR factor, VECTOR square, VECTOR mixed) const
{
	for(int k = X; k <= Z; k++)
	{
		const int other = (k == X) ? Y : Z, one = (k == Z) ? Y : X; // XY, XZ, YZ

		square[k] = mixed[k] = 0.0;
		for(int axis = X; axis <= Z; axis++)
		{
			square[k] += factor[axis] * Sqr(inverse[k][axis]);
			mixed[k] += 2.0 * factor[axis] * inverse[one][axis] * inverse[other][axis];
		}
	}
}

void AccelFrame::AddHalfSpace(AccelRegion& region, const VECTOR normal, DBL distance) const
{
	VECTOR inScene;

	if(known == false)
		return;
	for(int axis = X; axis <= Z; axis++)
		inScene[axis] = inverse[axis][X] * normal[X] + inverse[axis][Y] * normal[Y] + inverse[axis][Z] * normal[Z];
	for(int axis = X; axis <= Z; axis++)
		distance += fabs(normal[axis]) * rounding[axis] - normal[axis] * inverse[3][axis];
	region.AddHalfSpace(inScene, distance);
}

}
