/*******************************************************************************
 * povaccelregion.cpp
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module finds boxes around regions: intersections of a box, half-spaces and
 * quadrics. What it finds is never too small:
 *
 * - A combination of half-spaces with factors that are not negative is a
 *   half-space that holds their intersection. If its normal is that of a plane of
 *   the box, its distance bounds that side. The best combination has three
 *   half-spaces at most (the dual of a linear program in three variables), so all
 *   triples, pairs and single ones are tried.
 * - What is known of the other coordinates bounds one coordinate in a half-space,
 *   and one coordinate along an axis of a quadric.
 *
 * Each bound is moved outward by what its arithmetic may be wrong. It is a
 * derivative work of POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

#include <algorithm>

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"

#include "backend/accel/povaccelregion.h"
#include "backend/math/vector.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

/// Combinations of more would take too long; leaving some out makes the region larger.
static const size_t MOST_HALVES = 24;
static const size_t MOST_QUADRICS = 8;

/// Half-spaces that combine to a plane of the box do so up to rounding. Points beyond this are not thought of: no shape
/// with a half-space or quadric is hit farther than MAX_DISTANCE from the origin of a ray.
static const DBL FARTHEST = 1073741824.0; // 2^30

accel_box Infinite_Box()
{
	const accel_box box = { { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL }, { HUGE_VAL, HUGE_VAL, HUGE_VAL } };

	return box;
}

accel_box Empty_Box()
{
	const accel_box box = { { HUGE_VAL, HUGE_VAL, HUGE_VAL }, { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL } };

	return box;
}

bool Is_Empty(const accel_box& box)
{
	return (box.lo[X] > box.hi[X]) || (box.lo[Y] > box.hi[Y]) || (box.lo[Z] > box.hi[Z]);
}

bool Is_Finite(const accel_box& box)
{
	for(int axis = X; axis <= Z; axis++)
	{
		if(!(box.lo[axis] > -HUGE_VAL) || !(box.hi[axis] < HUGE_VAL))
			return false;
	}

	return true;
}

bool Box_In_Box(const accel_box& inner, const accel_box& outer)
{
	for(int axis = X; axis <= Z; axis++)
	{
		if(!(inner.lo[axis] >= outer.lo[axis]) || !(inner.hi[axis] <= outer.hi[axis]))
			return false;
	}

	return true;
}

void Include_Point(accel_box& box, const VECTOR point)
{
	for(int axis = X; axis <= Z; axis++)
	{
		box.lo[axis] = min(box.lo[axis], point[axis]);
		box.hi[axis] = max(box.hi[axis], point[axis]);
	}
}

void Include_Box(accel_box& box, const accel_box& other)
{
	if(Is_Empty(other))
		return;
	Include_Point(box, other.lo);
	Include_Point(box, other.hi);
}

void Intersect_Box(accel_box& box, const accel_box& other)
{
	for(int axis = X; axis <= Z; axis++)
	{
		box.lo[axis] = max(box.lo[axis], other.lo[axis]);
		box.hi[axis] = min(box.hi[axis], other.hi[axis]);
	}
}

void Grow_Box(accel_box& box, const VECTOR amount)
{
	for(int axis = X; axis <= Z; axis++)
	{
		box.lo[axis] -= amount[axis];
		box.hi[axis] += amount[axis];
	}
}

void Grow_Box(accel_box& box, DBL amount)
{
	VECTOR same;

	Make_Vector(same, amount, amount, amount);
	Grow_Box(box, same);
}



/*****************************************************************************
 *
 * Half-spaces
 *
 *****************************************************************************/

/// The distance that a combination of half-spaces gives a plane: factors with the normals should make up the direction, and
/// what is missing is bounded by the farthest point. HUGE_VAL for a negative factor.
static DBL Combined_Distance(const VECTOR direction, const AccelHalfSpace *const half[], const DBL factor[], int count)
{
	VECTOR missing;
	DBL distance = 0.0, size = 0.0;

	Assign_Vector(missing, direction);
	for(int i = 0; i < count; i++)
	{
		if(factor[i] < -1.0e-12)
			return HUGE_VAL;

		const DBL f = max(factor[i], 0.0);

		VAddScaledEq(missing, -f, half[i]->normal);
		distance += f * half[i]->distance;
		size += fabs(f * half[i]->distance);
	}

	const DBL rest = fabs(missing[X]) + fabs(missing[Y]) + fabs(missing[Z]);

	// written so that a NaN is no limit
	return (rest < 1.0e-9) ? distance + FARTHEST * rest + ldexp(size, -48) : HUGE_VAL;
}

static DBL Distance_Of_One(const VECTOR direction, const AccelHalfSpace& a)
{
	const AccelHalfSpace *const half[1] = { &a };
	DBL factor[1];

	VDot(factor[0], direction, a.normal);

	return Combined_Distance(direction, half, factor, 1);
}

static DBL Distance_Of_Two(const VECTOR direction, const AccelHalfSpace& a, const AccelHalfSpace& b)
{
	const AccelHalfSpace *const half[2] = { &a, &b };
	DBL factor[2], along_a, along_b, cosine;

	VDot(along_a, direction, a.normal);
	VDot(along_b, direction, b.normal);
	VDot(cosine, a.normal, b.normal);

	const DBL determinant = 1.0 - Sqr(cosine);

	if(determinant < 1.0e-6)
		return HUGE_VAL;
	factor[0] = (along_a - cosine * along_b) / determinant;
	factor[1] = (along_b - cosine * along_a) / determinant;

	return Combined_Distance(direction, half, factor, 2);
}

static DBL Distance_Of_Three(const VECTOR direction, const AccelHalfSpace& a, const AccelHalfSpace& b, const AccelHalfSpace& c)
{
	const AccelHalfSpace *const half[3] = { &a, &b, &c };
	VECTOR bc, ca, ab;
	DBL factor[3], determinant;

	VCross(bc, b.normal, c.normal);
	VDot(determinant, a.normal, bc);
	if(fabs(determinant) < 1.0e-6)
		return HUGE_VAL;
	VCross(ca, c.normal, a.normal);
	VCross(ab, a.normal, b.normal);
	VDot(factor[0], direction, bc);
	VDot(factor[1], direction, ca);
	VDot(factor[2], direction, ab);
	for(int i = 0; i < 3; i++)
		factor[i] /= determinant;

	return Combined_Distance(direction, half, factor, 3);
}

/// How far points of all half-spaces may lie along a direction; HUGE_VAL if there is no limit.
static DBL Farthest_Along(const VECTOR direction, const vector<AccelHalfSpace>& halves)
{
	const size_t count = min(halves.size(), MOST_HALVES);
	DBL best = HUGE_VAL;

	for(size_t i = 0; i < count; i++)
	{
		best = min(best, Distance_Of_One(direction, halves[i]));
		for(size_t j = i + 1; j < count; j++)
		{
			best = min(best, Distance_Of_Two(direction, halves[i], halves[j]));
			for(size_t k = j + 1; k < count; k++)
				best = min(best, Distance_Of_Three(direction, halves[i], halves[j], halves[k]));
		}
	}

	return best;
}

/// The finite sides of a box as half-spaces, and others after them.
static vector<AccelHalfSpace> Sides_And(const accel_box& box, const vector<AccelHalfSpace>& others)
{
	vector<AccelHalfSpace> halves;

	for(int side = 0; side < 6; side++)
	{
		const int axis = side / 2;
		const DBL sign = (side & 1) ? -1.0 : 1.0;
		AccelHalfSpace half;

		Make_Vector(half.normal, 0.0, 0.0, 0.0);
		half.normal[axis] = sign;
		half.distance = (side & 1) ? -box.lo[axis] : box.hi[axis];
		if(half.distance < HUGE_VAL)
			halves.push_back(half);
	}
	halves.insert(halves.end(), others.begin(), others.end());

	return halves;
}

/// Cuts a box down to what lies in the combinations of half-spaces. Its own finite sides are among them.
static void Cut_With_Combinations(accel_box& box, const vector<AccelHalfSpace>& others)
{
	const vector<AccelHalfSpace> halves = Sides_And(box, others);

	for(int axis = X; axis <= Z; axis++)
	{
		VECTOR direction;

		Make_Vector(direction, 0.0, 0.0, 0.0);
		direction[axis] = 1.0;
		box.hi[axis] = min(box.hi[axis], Farthest_Along(direction, halves));
		direction[axis] = -1.0;
		box.lo[axis] = max(box.lo[axis], -Farthest_Along(direction, halves));
	}
}

/// The least value of factor * x for x in an interval.
static inline DBL Least_Multiple(DBL factor, DBL lo, DBL hi)
{
	return (factor == 0.0) ? 0.0 : factor * ((factor > 0.0) ? lo : hi);
}

/// Cuts each side of a box down to what the other sides leave of a half-space.
static void Cut_With_Half_Space(accel_box& box, const AccelHalfSpace& half)
{
	for(int axis = X; axis <= Z; axis++)
	{
		const DBL along = half.normal[axis];
		DBL rest = half.distance, size = fabs(half.distance);

		if(fabs(along) < 1.0e-9)
			continue;
		for(int other = X; other <= Z; other++)
		{
			if(other != axis)
			{
				const DBL least = Least_Multiple(half.normal[other], box.lo[other], box.hi[other]);

				rest -= least;
				size += fabs(least);
			}
		}
		if(!(size < HUGE_VAL))
			continue;
		rest += ldexp(size, -48);
		if(along > 0.0)
			box.hi[axis] = min(box.hi[axis], rest / along);
		else
			box.lo[axis] = max(box.lo[axis], rest / along);
	}
}



/*****************************************************************************
 *
 * Quadrics
 *
 *****************************************************************************/

struct AccelRange
{
	DBL lo, hi;
};

/// Where the points of a box and of half-spaces lie along a direction.
static AccelRange Range_Along(const VECTOR direction, const accel_box& box, const vector<AccelHalfSpace>& halves)
{
	AccelRange range = { 0.0, 0.0 };
	VECTOR opposite;

	for(int axis = X; axis <= Z; axis++)
	{
		range.lo += Least_Multiple(direction[axis], box.lo[axis], box.hi[axis]);
		range.hi -= Least_Multiple(-direction[axis], box.lo[axis], box.hi[axis]);
	}
	if(!(range.lo > -HUGE_VAL) || !(range.hi < HUGE_VAL))
	{
		VScale(opposite, direction, -1.0);
		range.lo = max(range.lo, -Farthest_Along(opposite, Sides_And(box, halves)));
		range.hi = min(range.hi, Farthest_Along(direction, Sides_And(box, halves)));
	}

	return range;
}

/// The least value of (square * y + linear) * y in a range.
static DBL Least_Term(DBL square, DBL linear, const AccelRange& y)
{
	if((square == 0.0) && (linear == 0.0))
		return 0.0;
	if(square > 0.0)
	{
		const DBL vertex = min(max(-0.5 * linear / square, y.lo), y.hi);

		return (square * vertex + linear) * vertex;
	}
	if(square == 0.0)
		return Least_Multiple(linear, y.lo, y.hi);
	if(!(y.lo > -HUGE_VAL) || !(y.hi < HUGE_VAL))
		return -HUGE_VAL;

	return min((square * y.lo + linear) * y.lo, (square * y.hi + linear) * y.hi);
}

/// Magnitude of what was rounded: the terms, and if the axes are computed ones, the whole form.
static DBL Quadric_Size(const AccelQuadric& quadric, const AccelRange y[3])
{
	DBL size = fabs(quadric.constant), largest = 0.0, length2 = 0.0;

	for(int k = 0; k < 3; k++)
	{
		const DBL farthest = max(fabs(y[k].lo), fabs(y[k].hi));

		if((quadric.square[k] != 0.0) || (quadric.linear[k] != 0.0))
			size += (fabs(quadric.square[k]) * farthest + fabs(quadric.linear[k])) * farthest;
		largest = max(largest, fabs(quadric.square[k]));
		if(k != quadric.allowed)
			length2 += Sqr(farthest);
	}

	return quadric.exact ? size : size + largest * length2;
}

/// Narrows the range along axis k, given what the other two terms and rounding leave for its own. False if there is no limit.
static bool Narrow_Range(const AccelQuadric& quadric, int k, DBL rest, AccelRange& y)
{
	const DBL square = quadric.square[k], linear = quadric.linear[k];

	if(!(rest < HUGE_VAL))
		return false;
	if(square > 0.0)
	{
		const DBL middle = -0.5 * linear / square;
		const DBL width2 = (rest + 0.25 * Sqr(linear) / square) / square;
		const DBL width = sqrt(max(width2, 0.0)) * (1.0 + ldexp(1.0, -40)) + ldexp(fabs(middle), -48);

		y.lo = max(y.lo, middle - width);
		y.hi = min(y.hi, middle + width);
		return true;
	}
	if(square < 0.0 || linear == 0.0)
		return false;
	if(linear > 0.0)
		y.hi = min(y.hi, rest / linear);
	else
		y.lo = max(y.lo, rest / linear);
	return true;
}

/// Adds to `derived` what follows from a quadric, the box and the half-spaces.
static void Derive_From_Quadric(const AccelQuadric& quadric, const accel_box& box, const vector<AccelHalfSpace>& halves, vector<AccelHalfSpace>& derived)
{
	AccelRange known[3], y[3];
	bool narrowed[3];

	for(int k = 0; k < 3; k++)
		known[k] = y[k] = Range_Along(quadric.axis[k], box, halves);
	for(int pass = 0; pass < 2; pass++)
	{
		// The first pass is without rounding and serves to know how large coordinates get.
		const DBL rounded = (pass == 0) ? 0.0 : ldexp(Quadric_Size(quadric, y), -44);

		for(int k = 0; k < 3; k++)
		{
			DBL rest = -quadric.constant + rounded;

			for(int other = 0; other < 3; other++)
			{
				if(other != k)
					rest -= Least_Term(quadric.square[other], quadric.linear[other], known[other]);
			}

			AccelRange narrow = known[k];

			narrowed[k] = Narrow_Range(quadric, k, rest, narrow);
			y[k] = narrow;
		}
	}
	for(int k = 0; k < 3; k++)
	{
		if(narrowed[k])
		{
			AccelHalfSpace half;

			Assign_Vector(half.normal, quadric.axis[k]);
			half.distance = y[k].hi;
			if(half.distance < HUGE_VAL)
				derived.push_back(half);
			VScale(half.normal, quadric.axis[k], -1.0);
			half.distance = -y[k].lo;
			if(half.distance < HUGE_VAL)
				derived.push_back(half);
		}
	}
}

static DBL Largest_Square(const AccelQuadric& quadric)
{
	return max(max(fabs(quadric.square[0]), fabs(quadric.square[1])), fabs(quadric.square[2]));
}

/// The axis along which a quadric has no square but what turning the axes leaves of 0, if its other squares are positive: the axis
/// of a paraboloid. Otherwise -1.
static int Open_Axis(const AccelQuadric& quadric)
{
	const DBL lost = ldexp(Largest_Square(quadric), -44);
	int open = -1;

	for(int k = 0; k < 3; k++)
	{
		if(quadric.square[k] > lost)
			continue;
		if((open >= 0) || (quadric.square[k] < -lost))
			return -1;
		open = k;
	}

	return open;
}

/*
 * A paraboloid that a half-space cuts off, not along one of its axes. Let the linear
 * term be -l*y. The form, with s*y^2 as what turning the axes may have left of a square
 * or taken from it, plus (l + e) / n times that of the half-space, in which y has the
 * factor n > 0, has no linear term but e*y. With e = 2 * FARTHEST * |s| both together are not negative for y > 0, no more than
 * 2*e*|y| below 0 for y < 0, and there |y| is at most what the other terms leave, over
 * l - e, `behind`. So what remains is an elliptic cylinder, from which a box follows.
 * False if the half-space does not cut it off.
 */
static bool Cut_Paraboloid(const AccelQuadric& quadric, int open, const AccelHalfSpace& half, AccelQuadric& cylinder, AccelHalfSpace& apex)
{
	const DBL linear = fabs(quadric.linear[open]), rest = 2.0 * FARTHEST * ldexp(Largest_Square(quadric), -43);
	const DBL forward = (quadric.linear[open] < 0.0) ? 1.0 : -1.0;
	DBL left = -quadric.constant, along[3];

	for(int k = 0; k < 3; k++)
	{
		VDot(along[k], half.normal, quadric.axis[k]);
		if(k != open)
			left += 0.25 * Sqr(quadric.linear[k]) / quadric.square[k];
	}
	if(!(forward * along[open] > 1.0e-3) || !(linear > 2.0 * rest))
		return false;

	const DBL factor = (linear + rest) / (forward * along[open]);
	const DBL behind = max(left, 0.0) / (linear - rest);

	cylinder = quadric;
	for(int k = 0; k < 3; k++)
		cylinder.linear[k] += factor * along[k];
	cylinder.square[open] = cylinder.linear[open] = 0.0;
	cylinder.constant -= factor * half.distance + 2.0 * rest * behind + ldexp(linear + factor, -50) * 2.0 * FARTHEST;
	cylinder.exact = false;
	cylinder.allowed = open;
	VScale(apex.normal, quadric.axis[open], -forward);
	apex.distance = behind * (1.0 + ldexp(1.0, -40));

	return true;
}

/// Adds to `derived` what follows if a half-space cuts off a paraboloid.
static void Derive_From_Cuts(const AccelQuadric& quadric, const accel_box& box, const vector<AccelHalfSpace>& halves, vector<AccelHalfSpace>& derived)
{
	const int open = Open_Axis(quadric);

	if(open < 0)
		return;

	const vector<AccelHalfSpace> sides = Sides_And(box, halves);
	bool cut = false;

	for(size_t i = 0; i < sides.size(); i++)
	{
		AccelQuadric cylinder;
		AccelHalfSpace apex;

		if(Cut_Paraboloid(quadric, open, sides[i], cylinder, apex) == false)
			continue;
		if(cut == false)
			derived.push_back(apex);
		cut = true;
		Derive_From_Quadric(cylinder, box, halves, derived);
	}
}


/*****************************************************************************
 *
 * Regions
 *
 *****************************************************************************/

void AccelRegion::AddHalfSpace(const VECTOR normal, DBL distance)
{
	AccelHalfSpace half;
	DBL length;

	VLength(length, normal);
	if(!(length > 0.0) || !(length < HUGE_VAL) || !(fabs(distance / length) < FARTHEST / 4.0))
		return; // too far off to be of use
	VInverseScale(half.normal, normal, length);
	half.distance = distance / length;
	half.distance += ldexp(fabs(half.distance), -50);
	halves.push_back(half);
}

void AccelRegion::Intersect(const AccelRegion& other)
{
	Intersect_Box(box, other.box);
	for(size_t i = 0; (i < other.halves.size()) && (halves.size() < MOST_HALVES); i++)
		halves.push_back(other.halves[i]);
	for(size_t i = 0; (i < other.quadrics.size()) && (quadrics.size() < MOST_QUADRICS); i++)
		quadrics.push_back(other.quadrics[i]);
}

void AccelRegion::Grow(const VECTOR amount, DBL magnitude)
{
	Grow_Box(box, amount);
	for(vector<AccelHalfSpace>::iterator half = halves.begin(); half != halves.end(); half++)
		half->distance += fabs(half->normal[X]) * amount[X] + fabs(half->normal[Y]) * amount[Y] + fabs(half->normal[Z]) * amount[Z];
	for(vector<AccelQuadric>::iterator quadric = quadrics.begin(); quadric != quadrics.end(); quadric++)
	{
		const DBL step = amount[X] + amount[Y] + amount[Z];

		for(int k = 0; k < 3; k++) // the slope times the way
			quadric->constant -= (2.0 * fabs(quadric->square[k]) * (magnitude + step) + fabs(quadric->linear[k])) * step;
	}
}

accel_box AccelRegion::Box() const
{
	accel_box result = box;

	if(IsBox() || Is_Empty(box))
		return result;

	const int rounds = quadrics.empty() ? 1 : 3;

	for(int round = 0; round < rounds; round++)
	{
		vector<AccelHalfSpace> all(halves);

		// of many half-spaces the first ones are combined, so those of cylinders come last
		for(vector<AccelQuadric>::const_iterator quadric = quadrics.begin(); quadric != quadrics.end(); quadric++)
			Derive_From_Quadric(*quadric, result, all, all);
		for(vector<AccelQuadric>::const_iterator quadric = quadrics.begin(); quadric != quadrics.end(); quadric++)
			Derive_From_Cuts(*quadric, result, halves, all);
		if(Is_Finite(result) == false)
			Cut_With_Combinations(result, all);
		for(int pass = 0; pass < 3; pass++)
		{
			for(vector<AccelHalfSpace>::const_iterator half = all.begin(); half != all.end(); half++)
				Cut_With_Half_Space(result, *half);
		}
	}

	return result;
}

}
