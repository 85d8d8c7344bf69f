/*******************************************************************************
 * povaccelsurface.cpp
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module says where the hits and the inside may be of surfaces that are
 * given by an equation. Planes and quadrics become half-spaces and quadrics of a
 * region, so that what a clip or another part of an intersection leaves of them
 * gets a box. Of a poly of higher order nothing is known. It is a derivative work
 * of POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"

#include "backend/accel/povaccelshape.h"
#include "backend/shape/fpmetric.h"
#include "backend/shape/fractal.h"
#include "backend/shape/isosurf.h"
#include "backend/shape/planes.h"
#include "backend/shape/poly.h"
#include "backend/shape/quadrics.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

/// Hits lie in the plane. Inverting turns the normal.
void Bound_Shape(const Plane& plane, const AccelReach& reach, AccelBounds& bounds)
{
	const AccelFrame frame(plane.Trans, reach, Infinite_Box());
	VECTOR opposite;

	bounds.SetSurface(frame, Infinite_Box());
	frame.AddHalfSpace(bounds.inside, plane.Normal_Vector, EPSILON - plane.Distance);
	frame.AddHalfSpace(bounds.hits, plane.Normal_Vector, EPSILON - plane.Distance);
	VScale(opposite, plane.Normal_Vector, -1.0);
	frame.AddHalfSpace(bounds.hits, opposite, EPSILON + plane.Distance);
	frame.AddHalfSpace(bounds.outside, opposite, EPSILON + plane.Distance);
}

void Bound_Shape(const Poly& poly, const AccelReach& reach, AccelBounds& bounds)
{
	bounds.SetSurface(AccelFrame(poly.Trans, reach, Infinite_Box()), Infinite_Box());
}



/*****************************************************************************
 *
 * Quadrics
 *
 *****************************************************************************/

/// Makes m[p][q] zero by a rotation of the axes p and q (Jacobi's method), and turns the axes with it.
static void Rotate_Axes(DBL m[3][3], VECTOR axis[3], int p, int q)
{
	const int r = 3 - p - q;

	if(m[p][q] == 0.0)
		return;

	const DBL theta = 0.5 * (m[q][q] - m[p][p]) / m[p][q];
	const DBL t = ((theta >= 0.0) ? 1.0 : -1.0) / (fabs(theta) + sqrt(Sqr(theta) + 1.0));
	const DBL c = 1.0 / sqrt(Sqr(t) + 1.0), s = t * c;
	const DBL rp = m[r][p], rq = m[r][q];

	m[p][p] -= t * m[p][q];
	m[q][q] += t * m[p][q];
	m[p][q] = m[q][p] = 0.0;
	m[r][p] = m[p][r] = c * rp - s * rq;
	m[r][q] = m[q][r] = s * rp + c * rq;
	for(int k = X; k <= Z; k++)
	{
		const DBL ap = axis[p][k], aq = axis[q][k];

		axis[p][k] = c * ap - s * aq;
		axis[q][k] = s * ap + c * aq;
	}
}

/// The quadric along its own axes. Eight sweeps leave nothing beside the diagonal but rounding, for which the region allows.
static AccelQuadric Find_Axes(const Quadric& quadric)
{
	const VECTOR& square = quadric.Square_Terms;
	const VECTOR& mixed = quadric.Mixed_Terms;
	DBL m[3][3] =
	{
		{ square[X], 0.5 * mixed[X], 0.5 * mixed[Y] },
		{ 0.5 * mixed[X], square[Y], 0.5 * mixed[Z] },
		{ 0.5 * mixed[Y], 0.5 * mixed[Z], square[Z] }
	};
	AccelQuadric result;

	result.exact = (mixed[X] == 0.0) && (mixed[Y] == 0.0) && (mixed[Z] == 0.0);
	result.constant = quadric.Constant;
	for(int k = X; k <= Z; k++)
	{
		Make_Vector(result.axis[k], 0.0, 0.0, 0.0);
		result.axis[k][k] = 1.0;
	}
	for(int sweep = 0; sweep < 8; sweep++)
	{
		Rotate_Axes(m, result.axis, X, Y);
		Rotate_Axes(m, result.axis, X, Z);
		Rotate_Axes(m, result.axis, Y, Z);
	}
	for(int k = X; k <= Z; k++)
	{
		result.square[k] = m[k][k];
		VDot(result.linear[k], quadric.Terms, result.axis[k]);
	}

	return result;
}

/// The form that a leaf test computes in the scene is wrong by this for a ray from within reach, as `form` of povaccelframe.cpp.
static DBL Rounding_Of_Form(const Quadric& quadric, DBL length)
{
	DBL size = fabs(quadric.Constant);

	for(int k = X; k <= Z; k++)
		size += (fabs(quadric.Square_Terms[k]) + fabs(quadric.Mixed_Terms[k])) * Sqr(length) + fabs(quadric.Terms[k]) * length;

	return ldexp(size, -46);
}

/*
 * What dividing by the quadratic term `a` of the ray adds to that: Quadric::Intersect
 * does so for any a but 0. The root is wrong by 4u * sqrt(b*b + |a*c|) / a, the form
 * there by 8u * b*b / a and what `form` allows for. Where all squares have the same
 * sign, b*b is at most a times the form of the origin seen from the middle of the
 * quadric, which is part of `form` as well. There are two others:
 *
 * - Along an axis without square and with a linear term, that of a paraboloid, b stays
 *   |linear| / 2 when a vanishes. Rays with a below 2^-20 times the least square are
 *   grazing ones. Where they are not kept apart, room is made for rays of a down to 2^-40
 *   of it, which is those that are off the axis by a millionth: an allowance.
 * - Where squares have both signs, b is bounded by the size of the form, and rays with a
 *   below 2^-12 times the largest square are grazing ones, along a line in the surface.
 *   Where they are not kept apart, no room is made for them.
 */
static DBL Rounding_Of_Root(const Quadric& quadric, const AccelQuadric& axes, const AccelReach& reach, DBL length, AccelRays& rays)
{
	DBL largest = 0.0, least = HUGE_VAL, linear = 0.0, all_linear = 0.0;
	bool positive = false, negative = false;

	for(int k = X; k <= Z; k++)
		largest = max(largest, fabs(axes.square[k]));
	for(int k = X; k <= Z; k++)
	{
		all_linear += fabs(axes.linear[k]);
		// less is what turning the axes leaves of 0
		if(fabs(axes.square[k]) > ldexp(largest, -44))
		{
			least = min(least, fabs(axes.square[k]));
			positive = positive || (axes.square[k] > 0.0);
			negative = negative || (axes.square[k] < 0.0);
		}
		else
			linear += fabs(axes.linear[k]);
	}
	rays = ACCEL_NO_RAYS;
	if(positive && negative)
	{
		rays = reach.Rays(AccelGrazing::Quadratic(quadric.Square_Terms, quadric.Mixed_Terms, ldexp(largest, -12)));
		return (rays == ACCEL_NO_RAYS) ? ldexp(Sqr(3.0 * largest * length + all_linear) / largest, -38) : 0.0;
	}
	if((linear > 0.0) && (least < HUGE_VAL))
	{
		rays = reach.Rays(AccelGrazing::Quadratic(quadric.Square_Terms, quadric.Mixed_Terms, ldexp(least, -20)));
		return ldexp(Sqr(linear) / least, (rays == ACCEL_NO_RAYS) ? -31 : -13);
	}

	return 0.0;
}

/// The points where the form is not positive are inside; at a hit it is 0, so it is also not negative. Inverting turns all signs.
void Bound_Shape(const Quadric& quadric, const AccelReach& reach, AccelBounds& bounds)
{
	VECTOR center;

	Make_Vector(center, 0.0, 0.0, 0.0);

	const AccelFrame frame(NULL, reach, Box_Around(center, 0.0)); // there is no transformation to keep apart
	AccelQuadric surface = Find_Axes(quadric);
	AccelRays rays;
	const DBL rounded = Rounding_Of_Form(quadric, frame.length) + Rounding_Of_Root(quadric, surface, reach, frame.length, rays);

	bounds.SetSurface(AccelFrame(NULL, reach, Infinite_Box()), Infinite_Box());
	surface.constant = quadric.Constant - rounded;
	bounds.inside.quadrics.push_back(surface);
	bounds.hits.quadrics.push_back(surface);
	for(int k = X; k <= Z; k++)
	{
		surface.square[k] *= -1.0;
		surface.linear[k] *= -1.0;
	}
	surface.constant = -quadric.Constant - rounded;
	bounds.outside.quadrics.push_back(surface);
	bounds.hits.quadrics.push_back(surface);
	if(rays == ACCEL_ALL_RAYS)
		bounds.LoseHits();
}



/*****************************************************************************
 *
 * Surfaces in a container
 *
 *****************************************************************************/

/// Container of an isosurface or a parametric: a box, or a sphere, whose depths may be taken from a ray of any length.
template<class SURFACE> static accel_box Box_Of_Contained(const SURFACE& surface, const AccelReach& reach, AccelBounds& bounds)
{
	if(surface.container_shape != 0)
	{
		const VECTOR& center = surface.container.sphere.center;
		const DBL radius = surface.container.sphere.radius;
		const AccelFrame frame(surface.Trans, reach, Box_Around(center, fabs(radius)));

		Assign_Vector(bounds.slack, frame.slack);
		return Box_Of_Sphere(frame, center, Sqr(radius));
	}
	else
	{
		const VECTOR& corner1 = surface.container.box.corner1;
		const VECTOR& corner2 = surface.container.box.corner2;
		const AccelFrame frame(surface.Trans, reach, Box_Between(corner1, corner2));

		Assign_Vector(bounds.slack, frame.slack);
		return Box_Of_Container(frame, reach, corner1, corner2);
	}
}

/// A hit may lie 5 * accuracy behind the container, where the search goes on after it met the surface at the very end.
void Bound_Shape(const IsoSurface& surface, const AccelReach& reach, AccelBounds& bounds)
{
	accel_box box = Box_Of_Contained(surface, reach, bounds);

	Grow_Box(box, 6.0 * fabs(surface.accuracy));
	bounds.hits = AccelRegion(box);
	(Test_Flag(&surface, INVERTED_FLAG) ? bounds.outside : bounds.inside) = bounds.hits;
}

/// A flat container has no inside, and its leaf test then takes hits before it.
void Bound_Shape(const Parametric& surface, const AccelReach& reach, AccelBounds& bounds)
{
	accel_box box = Box_Of_Contained(surface, reach, bounds);

	if(surface.container_shape == 0)
	{
		for(int axis = X; axis <= Z; axis++)
		{
			if(!(surface.container.box.corner1[axis] < surface.container.box.corner2[axis]))
				box = Infinite_Box();
		}
	}
	Grow_Box(box, 6.0 * fabs(surface.accuracy));
	bounds.hits = AccelRegion(box);
	bounds.inside = AccelRegion(Empty_Box());
	bounds.solid = false;
}

/*
 * Hits are sought within a sphere, and then twice Fractal_Tolerance (fractal.cpp: 1e-7)
 * farther. A point is outside as soon as an iterate, the first of which is the point,
 * is farther from the origin than the root of Exit_Value. But Iteration_HCompl_Func
 * takes the y coordinate for z as well, so nothing bounds z.
 *
 * After its first hit the leaf test goes on from a point beyond it, but with the depth
 * of the hit. From there on depths are too small, while clips and other parts of a CSG
 * object are asked about the point. Depths remain between those of the sphere.
 */
void Bound_Shape(const Fractal& fractal, const AccelReach& reach, AccelBounds& bounds)
{
	const DBL radius = sqrt(max(fractal.Radius_Squared, fractal.Exit_Value)) + 4.0e-7;
	const AccelFrame frame(fractal.Trans, reach, Box_Around(fractal.Center, radius));
	const bool bounded = (fractal.Algebra == QUATERNION_TYPE) || (fractal.Sub_Type == SQR_STYPE) || (fractal.Sub_Type == CUBE_STYPE) ||
	                     (fractal.Sub_Type == RECIPROCAL_STYPE);

	bounds.strays = Box_Of_Sphere(frame, fractal.Center, Sqr(radius));
	if(bounded)
		bounds.SetBody(frame, bounds.strays, fractal.Inverted);
	else
		bounds.SetSurface(frame, bounds.strays);
	bounds.hits = AccelRegion(Empty_Box());
}

}
