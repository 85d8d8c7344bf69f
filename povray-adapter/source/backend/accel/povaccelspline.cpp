/*******************************************************************************
 * povaccelspline.cpp
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module says where the hits and the inside may be of shapes that are swept
 * or turned along a spline, from the coefficients of its segments. Their hits come
 * from roots of polynomials of up to tenth order, of which only SOLVER_ALLOWANCE
 * is known. It is a derivative work of POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"

#include "backend/accel/povaccelshape.h"
#include "backend/bounding/bcyl.h"
#include "backend/shape/lathe.h"
#include "backend/shape/prism.h"
#include "backend/shape/sor.h"
#include "backend/shape/sphsweep.h"
#include "backend/shape/truetype.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

/// Values of a polynomial.
struct PolynomialRange
{
	DBL lo, hi;

	PolynomialRange() : lo(HUGE_VAL), hi(-HUGE_VAL) { }

	void Include(DBL value)
	{
		lo = min(lo, value);
		hi = max(hi, value);
	}

	void Include(const PolynomialRange& other)
	{
		lo = min(lo, other.lo);
		hi = max(hi, other.hi);
	}

	DBL Size() const { return max(fabs(lo), fabs(hi)); }
};

/// The values of a*t^3 + b*t^2 + c*t + d for t in an interval: at its ends and where the derivative is 0. A place that is wrong
/// by rounding has a value that is wrong by the square of that.
static PolynomialRange Range_Of_Cubic(DBL a, DBL b, DBL c, DBL d, DBL first = 0.0, DBL last = 1.0)
{
	const DBL discriminant = b * b - 3.0 * a * c;
	DBL place[4] = { first, last, first, last };
	PolynomialRange range;

	if(discriminant >= 0.0)
	{
		const DBL q = -(b + ((b >= 0.0) ? sqrt(discriminant) : -sqrt(discriminant)));

		if(a != 0.0)
			place[2] = q / (3.0 * a);
		if(q != 0.0)
			place[3] = c / q;
	}
	for(int i = 0; i < 4; i++)
	{
		const DBL t = min(max(place[i], first), last);

		if(t == t)
			range.Include(((a * t + b) * t + c) * t + d);
	}

	const DBL t = max(fabs(first), fabs(last));
	const DBL rounded = ldexp(((fabs(a) * t + fabs(b)) * t + fabs(c)) * t + fabs(d), -40);

	range.lo -= rounded;
	range.hi += rounded;

	return range;
}

/*
 * A body turned around the y axis: radius and height. Both solvers lose more the
 * farther away the ray begins, in units of the extent. What was met was an error of
 * u * distance^3 and more for a sor, of which 64 times is allowed for, and of
 * 2^-40 * distance^2 for a lathe, of which four times.
 *
 * A lathe divides a height by the component of the direction along its axis, down to
 * EPSILON, and a sor multiplies the leading coefficient with the third power of it. So
 * where it is small, hits may be anywhere along the ray: these are grazing rays. 2^-9 is an
 * allowance, four times what was met of a sor.
 */
static void Bound_Turned(const ObjectBase& object, DBL radius, const PolynomialRange& height, DBL allowance, int power, const AccelReach& reach, AccelBounds& bounds)
{
	const DBL extent = max(2.0 * radius, height.hi - height.lo);
	VECTOR low, high;

	Make_Vector(low, -radius, height.lo, -radius);
	Make_Vector(high, radius, height.hi, radius);

	const AccelFrame frame(object.Trans, reach, Box_Between(low, high));
	const DBL margin = extent * (SOLVER_ALLOWANCE + allowance * pow(frame.length / extent, power));
	const accel_box box = (margin < 16.0 * extent) ?
		frame.CylinderToScene(Y, height.lo - margin, height.hi + margin, radius + margin) : Infinite_Box();

	bounds.SetBody(frame, box, Test_Flag(&object, INVERTED_FLAG));

	VECTOR normal;

	frame.Along(Y, normal);
	if(reach.Rays(AccelGrazing::Linear(normal, 0.5 * EPSILON / frame.Stretch(), ldexp(frame.Shrinkage(), -9))) == ACCEL_ALL_RAYS)
		bounds.LoseHits();
}

void Bound_Shape(const Lathe& lathe, const AccelReach& reach, AccelBounds& bounds)
{
	PolynomialRange radius, height;

	for(int i = 0; i < lathe.Number; i++)
	{
		const LATHE_SPLINE_ENTRY& e = lathe.Spline->Entry[i];

		radius.Include(Range_Of_Cubic(e.A[X], e.B[X], e.C[X], e.D[X]));
		height.Include(Range_Of_Cubic(e.A[Y], e.B[Y], e.C[Y], e.D[Y]));
	}
	Bound_Turned(lathe, radius.Size(), height, ldexp(1.0, -38), 2, reach, bounds);
}

/// The square of the radius is a cubic of the height.
void Bound_Shape(const Sor& sor, const AccelReach& reach, AccelBounds& bounds)
{
	const BCYL& cylinders = *sor.Spline->BCyl;
	PolynomialRange radius2, height;

	radius2.Include(max(0.0, max(sor.Base_Radius_Squared, sor.Cap_Radius_Squared)));
	height.Include(sor.Height1);
	height.Include(sor.Height2);
	for(int i = 0; i < sor.Number; i++)
	{
		const SOR_SPLINE_ENTRY& e = sor.Spline->Entry[i];

		radius2.Include(Range_Of_Cubic(e.A, e.B, e.C, e.D, cylinders.height[cylinders.entry[i].h1], cylinders.height[cylinders.entry[i].h2]));
	}
	Bound_Turned(sor, sqrt(radius2.hi), height, ldexp(1.0, -47), 3, reach, bounds);
}

/// A conic sweep is scaled by its height. Caps end where the outline does, which Prism keeps in u and v.
void Bound_Shape(const Prism& prism, const AccelReach& reach, AccelBounds& bounds)
{
	PolynomialRange x, z;

	x.Include(prism.u1);
	x.Include(prism.u2);
	z.Include(prism.v1);
	z.Include(prism.v2);
	for(int i = 0; i < prism.Number; i++)
	{
		const PRISM_SPLINE_ENTRY& e = prism.Spline->Entry[i];

		x.Include(Range_Of_Cubic(e.A[X], e.B[X], e.C[X], e.D[X]));
		z.Include(Range_Of_Cubic(e.A[Y], e.B[Y], e.C[Y], e.D[Y]));
	}

	accel_box box = Empty_Box();

	for(int end = 0; end < 2; end++)
	{
		const DBL height = (end == 0) ? prism.Height1 : prism.Height2;
		const DBL scale = (prism.Sweep_Type == CONIC_SWEEP) ? height : 1.0;
		VECTOR low, high;

		Make_Vector(low, scale * x.lo, height, scale * z.lo);
		Make_Vector(high, scale * x.hi, height, scale * z.hi);
		Include_Box(box, Box_Between(low, high));
	}
	if(Test_Flag(&prism, DEGENERATE_FLAG))
		box = Empty_Box(); // never hit

	const AccelFrame frame(prism.Trans, reach, box);

	Grow_Box(box, SOLVER_ALLOWANCE * max(max(box.hi[X] - box.lo[X], box.hi[Y] - box.lo[Y]), box.hi[Z] - box.lo[Z]));
	Grow_Box(box, frame.rounding);
	if(Test_Flag(&prism, DEGENERATE_FLAG))
		bounds.SetSurface(frame, frame.ToScene(box));
	else
		bounds.SetBody(frame, frame.ToScene(box), Test_Flag(&prism, INVERTED_FLAG));
}

/*
 * What the leaf test of a straight segment of a sphere_sweep adds to the square of
 * its radius. With the ray p + t*D, the centers C0 + u*C and the radii R0 + u*R the
 * form F(t, u) = |p + t*D - C0 - u*C|^2 - (R0 + u*R)^2 is 0, and so is its derivative
 * 2*d*u + e + b*t by u, with d = C*C - R*R and b = -2*C*D. With t from the latter,
 * b*b * F = d * (4*d - b*b) * u^2 + ... is solved for u in 0..1, and a hit counts if
 * |b| > ZERO_TOLERANCE (sphsweep.cpp: 1e-4).
 *
 * - solve_quadratic takes a discriminant, of the equation with leading coefficient 1,
 *   for 0 if it is less than SMALL_ENOUGH (polysolv.cpp: 1e-10) from it, and returns the
 *   vertex. There the form is the leading coefficient times a quarter of that.
 * - Solve_Polynomial drops a leading coefficient up to SMALL_ENOUGH, and so as much of
 *   the form. That needs 4*d*d about as small, and the form is then no more than all of
 *   it, or |b| near 2 * sqrt(d).
 *
 * At other roots F is 0 up to rounding. Inside solves d*u^2 + ... = F in the same way.
 */
static DBL Room_Of_Straight_Segment(const SPHSWEEP_SEG& segment)
{
	const DBL small = 1.0e-10, least = Sqr(1.0e-4);
	DBL d;

	VDot(d, segment.Center_Coef[1], segment.Center_Coef[1]);
	d = fabs(d - Sqr(segment.Radius_Coef[1]));

	const DBL vertex = 0.25 * small * (4.0 * Sqr(d) / least + d);
	const DBL dropped = (2.0 * Sqr(d) < small) ? min(small, 4.0 * Sqr(d) + d * least) / least : small / (2.0 * d);

	return vertex + dropped + small;
}

/// The spheres of all segments. Center and radius of each are polynomials, and so are the places where it ends on each axis; a
/// radius may be negative. The root of the square of a linear function and a constant is largest at an end.
void Bound_Shape(const SphereSweep& sweep, const AccelReach& reach, AccelBounds& bounds)
{
	accel_box box = Empty_Box();

	for(int i = 0; i < sweep.Num_Segments; i++)
	{
		const SPHSWEEP_SEG& segment = sweep.Segment[i];

		for(int end = 0; (segment.Num_Coefs == 2) && (end <= 1); end++)
		{
			VECTOR center;
			const DBL radius = segment.Radius_Coef[0] + end * segment.Radius_Coef[1];

			VAddScaled(center, segment.Center_Coef[0], (DBL)end, segment.Center_Coef[1]);
			Include_Box(box, Box_Around(center, sqrt(Sqr(radius) + Room_Of_Straight_Segment(segment))));
		}
		for(int axis = X; axis <= Z; axis++)
		{
			for(int sign = -1; sign <= 1; sign += 2)
			{
				DBL c[4] = { 0.0, 0.0, 0.0, 0.0 };

				for(int k = 0; k < segment.Num_Coefs; k++)
					c[k] = segment.Center_Coef[k][axis] + sign * segment.Radius_Coef[k];

				const PolynomialRange range = Range_Of_Cubic(c[3], c[2], c[1], c[0]);

				box.lo[axis] = min(box.lo[axis], range.lo);
				box.hi[axis] = max(box.hi[axis], range.hi);
			}
		}
	}

	const AccelFrame frame(sweep.Trans, reach, box);

	Grow_Box(box, SOLVER_ALLOWANCE * max(max(box.hi[X] - box.lo[X], box.hi[Y] - box.lo[Y]), box.hi[Z] - box.lo[Z]));
	Grow_Box(box, sqrt(frame.sphereForm)); // spheres of any radius are solved for
	bounds.SetBody(frame, frame.ToScene(box), Test_Flag(&sweep, INVERTED_FLAG));
}

/*
 * The outline is made of quadratic splines, within their control points. That a point
 * is inside is decided by counting crossings to the right: there are none above, below
 * and to the right of all control points. To the left there should be an even number,
 * but one that is counted wrong leaves a point inside, however far away. Hits on the
 * faces are decided in the same way, but no ray of a test at the heights of all control
 * points met one there, and room for them would leave texts without a box.
 */
void Bound_Shape(const TrueType& text, const AccelReach& reach, AccelBounds& bounds)
{
	accel_box box = Empty_Box();

	box.lo[Z] = min(0.0, text.depth);
	box.hi[Z] = max(0.0, text.depth);
	text.Find_Outline(box.lo, box.hi); // includes nothing for a blank

	const AccelFrame frame(text.Trans, reach, box);

	Grow_Box(box, SOLVER_ALLOWANCE * max(max(box.hi[X] - box.lo[X], box.hi[Y] - box.lo[Y]), box.hi[Z] - box.lo[Z]));
	Grow_Box(box, frame.rounding);
	bounds.SetBody(frame, frame.ToScene(box), Test_Flag(&text, INVERTED_FLAG));
	if(!Is_Empty(box))
	{
		box.lo[X] = -HUGE_VAL;
		(Test_Flag(&text, INVERTED_FLAG) ? bounds.outside : bounds.inside).box = frame.ToScene(box);
	}
}

}
