/*******************************************************************************
 * povaccelshape.cpp
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module says where the hits and the inside of bodies and patches may be,
 * from their own data and transformation, in double. Every box has room for what
 * the leaf test may be wrong: `rounding` and `form` of povaccelframe.cpp are
 * bounds that follow from the arithmetic; where there is an allowance instead, the
 * comment says so. It is a derivative work of POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

#include <typeinfo>

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"

#include "backend/accel/povaccelmesh.h"
#include "backend/accel/povaccelmeshgroup.h"
#include "backend/accel/povaccelshape.h"
#include "backend/bounding/bbox.h"
#include "backend/scene/objects.h"
#include "backend/shape/bezier.h"
#include "backend/shape/blob.h"
#include "backend/shape/boxes.h"
#include "backend/shape/cones.h"
#include "backend/shape/discs.h"
#include "backend/shape/fpmetric.h"
#include "backend/shape/fractal.h"
#include "backend/shape/hfield.h"
#include "backend/shape/isosurf.h"
#include "backend/shape/lathe.h"
#include "backend/shape/mesh.h"
#include "backend/shape/ovus.h"
#include "backend/shape/planes.h"
#include "backend/shape/poly.h"
#include "backend/shape/polygon.h"
#include "backend/shape/prism.h"
#include "backend/shape/quadrics.h"
#include "backend/shape/sor.h"
#include "backend/shape/spheres.h"
#include "backend/shape/sphsweep.h"
#include "backend/shape/super.h"
#include "backend/shape/torus.h"
#include "backend/shape/triangle.h"
#include "backend/shape/truetype.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

void AccelBounds::SetBody(const AccelFrame& frame, const accel_box& box, bool inverted)
{
	SetSurface(frame, box);
	(inverted ? outside : inside) = hits;
}

void AccelBounds::LoseHits()
{
	hits = AccelRegion();
	solid = false;
}

void AccelBounds::SetSurface(const AccelFrame& frame, const accel_box& box)
{
	hits = AccelRegion(box);
	inside = outside = AccelRegion();
	solid = true;
	Assign_Vector(slack, frame.slack);
}

void AccelBounds::SetPatch(const AccelFrame& frame, const accel_box& box)
{
	hits = AccelRegion(box);
	inside = AccelRegion(Empty_Box());
	outside = AccelRegion();
	solid = false;
	Assign_Vector(slack, frame.slack);
}

accel_box Box_Between(const VECTOR corner1, const VECTOR corner2)
{
	accel_box box = Empty_Box();

	Include_Point(box, corner1);
	Include_Point(box, corner2);

	return box;
}

accel_box Box_Around(const VECTOR center, DBL radius)
{
	accel_box box = Box_Between(center, center);

	Grow_Box(box, radius);

	return box;
}

accel_box Box_Of_Sphere(const AccelFrame& frame, const VECTOR center, DBL radius2)
{
	VECTOR point;

	Make_Vector(point, 0.0, 0.0, 0.0);

	return frame.RoundToScene(center, point, sqrt(radius2 + frame.sphereForm));
}

/*
 * How far hits may drift to the side along an axis, as components up to EPSILON of a
 * direction that is no unit vector are taken for 0. The depth is bounded by the largest
 * component, which is at least 1 / (sqrt(3) * stretch). Of a box made large by its
 * transformation this is more than the depth at which hits begin to count, so that a ray
 * that leaves the box would still be tested with it. Components that are less than rounding
 * leaves of 0 add next to nothing, so there are few rays that drift.
 */
static DBL Drift_Along(int axis, const AccelFrame& frame, const AccelReach& reach)
{
	const DBL drift = 2.0 * EPSILON * frame.Stretch() * frame.length, almost_zero = ldexp(1.0, -44);
	VECTOR normal;

	if(drift * frame.Stretch() < MIN_ISECT_DEPTH / 16.0)
		return drift;
	frame.Along(axis, normal);

	const DBL size = max(max(fabs(normal[X]), fabs(normal[Y])), fabs(normal[Z]));
	const AccelGrazing grazing = AccelGrazing::Linear(normal, almost_zero * size, 1.01 * EPSILON);

	return (reach.Rays(grazing) == ACCEL_NO_RAYS) ? min(drift, almost_zero * size * frame.way) : drift;
}

/*
 * Besides, Box::Intersect lets a hit lie CLOSE_TOLERANCE (boxes.cpp: 1e-6) behind a
 * side, in the depth of the scene. Where all components may be too small, it may
 * report BOUND_HUGE as depth.
 */
accel_box Box_Of_Container(const AccelFrame& frame, const AccelReach& reach, const VECTOR corner1, const VECTOR corner2)
{
	accel_box box = Box_Between(corner1, corner2);
	VECTOR drift;

	if(!(2.0 * EPSILON * frame.Stretch() < 1.0))
		return Infinite_Box();
	for(int axis = X; axis <= Z; axis++)
		drift[axis] = Drift_Along(axis, frame, reach);
	Grow_Box(box, drift);
	Grow_Box(box, frame.rounding);
	box = frame.ToScene(box);
	Grow_Box(box, 1.1e-6);

	return box;
}



/*****************************************************************************
 *
 * Bodies
 *
 *****************************************************************************/

void Bound_Shape(const Sphere& sphere, const AccelReach& reach, AccelBounds& bounds)
{
	const AccelFrame frame(sphere.Trans, reach, Box_Around(sphere.Center, fabs(sphere.Radius)));

	bounds.SetBody(frame, Box_Of_Sphere(frame, sphere.Center, Sqr(sphere.Radius)), Test_Flag(&sphere, INVERTED_FLAG));
}

void Bound_Shape(const Box& box, const AccelReach& reach, AccelBounds& bounds)
{
	const AccelFrame frame(box.Trans, reach, Box_Between(box.bounds[0], box.bounds[1]));

	bounds.SetBody(frame, Box_Of_Container(frame, reach, box.bounds[0], box.bounds[1]), Test_Flag(&box, INVERTED_FLAG));
}

/*
 * In its space a cylinder has radius 1, a cone the radius of its height, and both end
 * at height 1. Heights are checked at the hit. For a cylinder `form` bounds the error of
 * the square of the radius, since a = d*d there. In that of a cone, a = x*x + y*y - z*z
 * becomes small for rays along its side.
 *
 * Let F(t) = a*t*t + 2*b*t + c be the form, v half its slope at the true root, the root
 * of the discriminant, and L bound the ray as in povaccelframe.cpp. v is at most the
 * distance |p| of the hit from the apex. As b differs from v by a times the way, |b| is
 * at most a*L + v, and |c| at most a*L*L + 2*v*L. The products that b and c are made of
 * are wrong by 5u of L and of L*L, so the discriminant by 20u * (a*L*L + v*L), and the
 * form at the root by that over a, 20u * (L*L + v*L / a), and 4u * v*v / a for rounding
 * the root. The first is part of `form`; the rest is at most 32u * |p| * L / a, of which
 * the double is granted. |p| is at most the root of 2 and the room itself, which leads
 * to a quadratic equation for the root of the room.
 *
 * Rays with a below 2^-14 are grazing ones, and below EPSILON a is taken for 0. Where they
 * are not kept apart and the room for all would be large, an allowance of 1/32 does.
 */
static DBL Room_Of_Cone(const AccelFrame& frame, const AccelReach& reach)
{
	const DBL usual = ldexp(frame.length, -47 + 14), all = ldexp(frame.length, -47) / EPSILON;
	const DBL roomForUsual = Sqr(usual + sqrt(frame.form + 2.0 * usual));
	const DBL roomForAll = Sqr(all + sqrt(frame.form + 2.0 * all + EPSILON * Sqr(frame.length)));
	VECTOR factor, square, mixed;

	Make_Vector(factor, 1.0, 1.0, -1.0);
	frame.SquaresInScene(factor, square, mixed);
	switch(reach.Rays(AccelGrazing::Quadratic(square, mixed, ldexp(Sqr(frame.Shrinkage()), -14))))
	{
		case ACCEL_NO_RAYS: return roomForUsual;
		case ACCEL_USUAL_RAYS: return min(roomForAll, roomForUsual + 1.0 / 32.0);
		case ACCEL_ALL_RAYS: break;
	}

	return roomForAll;
}

void Bound_Shape(const Cone& cone, const AccelReach& reach, AccelBounds& bounds)
{
	VECTOR low, high;

	Make_Vector(low, -1.0, -1.0, cone.dist);
	Make_Vector(high, 1.0, 1.0, 1.0);

	const AccelFrame frame(cone.Trans, reach, Box_Between(low, high));
	DBL room = frame.form, base = 1.0;

	if(!Test_Flag(&cone, CYLINDER_FLAG))
	{
		room = Room_Of_Cone(frame, reach);
		base = cone.dist;
	}

	VECTOR center, radius;

	// Inside of an open one grants EPSILON (cones.cpp)
	room += EPSILON;
	Make_Vector(center, 0.0, 0.0, cone.dist - EPSILON);
	Make_Vector(radius, sqrt(Sqr(base) + room), sqrt(Sqr(base) + room), 0.0);

	accel_box box = frame.RoundToScene(center, radius, 0.0);

	Make_Vector(center, 0.0, 0.0, 1.0 + EPSILON);
	Make_Vector(radius, sqrt(1.0 + room), sqrt(1.0 + room), 0.0);
	Include_Box(box, frame.RoundToScene(center, radius, 0.0));
	bounds.SetBody(frame, box, Test_Flag(&cone, INVERTED_FLAG));
}

/// The solver of the quartic has SOLVER_ALLOWANCE.
void Bound_Shape(const Torus& torus, const AccelReach& reach, AccelBounds& bounds)
{
	const DBL minor = fabs(torus.MinorRadius), major = fabs(torus.MajorRadius);
	VECTOR center, ring;

	Make_Vector(center, 0.0, 0.0, 0.0);
	Make_Vector(ring, major, 0.0, major);

	const AccelFrame frame(torus.Trans, reach, Box_Around(center, major + minor));
	const DBL margin = SOLVER_ALLOWANCE * (major + minor);

	bounds.SetBody(frame, frame.RoundToScene(center, ring, minor + margin), Test_Flag(&torus, INVERTED_FLAG));
}

/// Hits are sought within a box that is larger than the superellipsoid: MIN_VALUE to MAX_VALUE in super.cpp. Direction
/// components up to EPSILON are taken for 0.
void Bound_Shape(const Superellipsoid& super, const AccelReach& reach, AccelBounds& bounds)
{
	VECTOR center;

	Make_Vector(center, 0.0, 0.0, 0.0);

	accel_box box = Box_Around(center, 1.01);
	const AccelFrame frame(super.Trans, reach, box);

	Grow_Box(box, 2.0 * EPSILON * frame.length);
	Grow_Box(box, frame.rounding);
	bounds.SetBody(frame, frame.ToScene(box), Test_Flag(&super, INVERTED_FLAG));
}

/// Two spheres, and between them a part of a spindle torus of which only what satisfies its equation within ROOT_TOLERANCE
/// (ovus.cpp: 1e-4) counts. So the errors are bounded.
void Bound_Shape(const Ovus& ovus, const AccelReach& reach, AccelBounds& bounds)
{
	const DBL bottom = ovus.BottomRadius, top = ovus.TopRadius;
	const DBL girth = max(max(bottom, top), ovus.ConnectingRadius - ovus.HorizontalPosition);
	const DBL lowest = min(-bottom, bottom - top), highest = bottom + max(bottom, top);
	VECTOR low, high;

	Make_Vector(low, -girth, lowest, -girth);
	Make_Vector(high, girth, highest, girth);

	const AccelFrame frame(ovus.Trans, reach, Box_Between(low, high));
	const DBL sphere = sqrt(Sqr(max(bottom, top)) + frame.form) - max(bottom, top);
	const DBL spindle = sqrt(Sqr(ovus.ConnectingRadius) + 1.0e-4 + frame.form) - ovus.HorizontalPosition;

	bounds.SetBody(frame, frame.CylinderToScene(Y, lowest - sphere, highest + sphere, max(girth + sphere, spindle)),
	               Test_Flag(&ovus, INVERTED_FLAG));
}

/// The box of what a component of a blob may influence, in the space of the blob. Its leaf test accepts roots only between the
/// points where the ray enters and leaves the influence of some component, so only these are wrong, as in `form`.
static accel_box Box_Of_Component(const Blob_Element& element, const AccelReach& reach)
{
	const DBL radius = sqrt(element.rad2);
	VECTOR center;

	Make_Vector(center, 0.0, 0.0, 0.0);
	switch(element.Type)
	{
		case BLOB_SPHERE:
		case BLOB_ELLIPSOID:
			Assign_Vector(center, element.O);
			break;
		case BLOB_APEX_HEMISPHERE:
			center[Z] = element.len;
			break;
		case BLOB_CYLINDER:
		{
			accel_box box = Box_Around(center, radius);

			box.lo[Z] = 0.0;
			box.hi[Z] = element.len;

			const AccelFrame frame(element.Trans, reach, box);

			return frame.CylinderToScene(Z, 0.0, element.len, sqrt(element.rad2 + frame.form));
		}
	}

	const AccelFrame frame(element.Trans, reach, Box_Around(center, radius));

	return Box_Of_Sphere(frame, center, element.rad2);
}

static accel_box Box_Of_Components(const Blob& blob, const AccelReach& reach)
{
	accel_box box = Empty_Box();

	for(vector<Blob_Element>::const_iterator element = blob.Data->Entry.begin(); element != blob.Data->Entry.end(); element++)
		Include_Box(box, Box_Of_Component(*element, reach));

	return box;
}

/// Negative components count as well: what remains of the coefficients of others that the ray has left may be anything where
/// only negative ones are left. If the density of nothing is above the threshold, every point far away is inside.
void Bound_Shape(const Blob& blob, const AccelReach& reach, AccelBounds& bounds)
{
	AccelReach local;

	Make_Vector(local.center, 0.0, 0.0, 0.0);
	local.radius = 0.0;

	const AccelFrame frame(blob.Trans, reach, Box_Of_Components(blob, local));

	local.radius = frame.length;

	accel_box box = Box_Of_Components(blob, local);

	Grow_Box(box, frame.rounding);
	if(blob.Data->Threshold < 1.0e-5)
		bounds.SetSurface(frame, frame.ToScene(box));
	else
		bounds.SetBody(frame, frame.ToScene(box), Test_Flag(&blob, INVERTED_FLAG));
}

/*
 * Hits lie in the box that Box::Intersect cuts out. Everything in the column below the
 * water level counts as inside, however deep.
 */
void Bound_Shape(const HField& field, const AccelReach& reach, AccelBounds& bounds)
{
	accel_box column = Box_Between(field.bounding_corner1, field.bounding_corner2);
	const AccelFrame frame(field.Trans, reach, column);

	bounds.SetBody(frame, Box_Of_Container(frame, reach, field.bounding_corner1, field.bounding_corner2),
	               Test_Flag(&field, INVERTED_FLAG));
	column.lo[X] = min(column.lo[X], 0.0);
	column.lo[Z] = min(column.lo[Z], 0.0);
	Grow_Box(column, frame.rounding);
	column.lo[Y] = -HUGE_VAL;
	Include_Box((Test_Flag(&field, INVERTED_FLAG) ? bounds.outside : bounds.inside).box, frame.ToScene(column));
}



/*****************************************************************************
 *
 * Patches
 *
 *****************************************************************************/

/// Hits lie in the plane up to rounding and are checked against the radius. One side of the plane is the inside.
void Bound_Shape(const Disc& disc, const AccelReach& reach, AccelBounds& bounds)
{
	const DBL radius = sqrt(disc.oradius2) * (1.0 + ldexp(1.0, -48));
	VECTOR center, radii, normal, opposite;

	Make_Vector(center, 0.0, 0.0, 0.0);
	Make_Vector(radii, radius, radius, 0.0);
	Make_Vector(normal, 0.0, 0.0, Test_Flag(&disc, INVERTED_FLAG) ? -1.0 : 1.0);
	VScale(opposite, normal, -1.0);

	const AccelFrame frame(disc.Trans, reach, Box_Around(center, radius));

	bounds.SetSurface(frame, frame.RoundToScene(center, radii, 0.0));
	frame.AddHalfSpace(bounds.inside, normal, 0.0);
	frame.AddHalfSpace(bounds.outside, opposite, 0.0);
}

/// The box of the corners of a flat shape in the scene. Hits lie in the plane up to rounding. An edge test is wrong by the same
/// times the length of the edge, which takes the tip of an acute corner farther: 2^-16 of the extent is an allowance.
static void Bound_Corners(const accel_box& corners, const AccelReach& reach, AccelBounds& bounds)
{
	const AccelFrame frame(NULL, reach, corners);
	const DBL extent = max(max(corners.hi[X] - corners.lo[X], corners.hi[Y] - corners.lo[Y]), corners.hi[Z] - corners.lo[Z]);
	accel_box box(corners);

	Grow_Box(box, ldexp(frame.length, -46) + ldexp(extent, -16));
	bounds.SetPatch(frame, box);
}

void Bound_Shape(const Triangle& triangle, const AccelReach& reach, AccelBounds& bounds)
{
	accel_box corners = Box_Between(triangle.P1, triangle.P2);

	Include_Point(corners, triangle.P3);
	if(Test_Flag(&triangle, DEGENERATE_FLAG))
		corners = Empty_Box(); // never hit
	Bound_Corners(corners, reach, bounds);
}

/// Hits are points in triangles between points of the patch, which lies within its control points. Triangles may be needles, so
/// 2^-10 of the extent is an allowance.
void Bound_Shape(const BicubicPatch& patch, const AccelReach& reach, AccelBounds& bounds)
{
	accel_box box = Empty_Box();

	for(int i = 0; i < 4; i++)
	{
		for(int j = 0; j < 4; j++)
			Include_Point(box, patch.Control_Points[i][j]);
	}

	const AccelFrame frame(NULL, reach, box);
	const DBL extent = max(max(box.hi[X] - box.lo[X], box.hi[Y] - box.lo[Y]), box.hi[Z] - box.lo[Z]);

	Grow_Box(box, ldexp(frame.length, -46) + ldexp(extent, -10));
	bounds.SetPatch(frame, box);
}

void Bound_Shape(const Polygon& polygon, const AccelReach& reach, AccelBounds& bounds)
{
	accel_box corners = Empty_Box();

	for(int i = 0; (i < polygon.Data->Number) && !Test_Flag(&polygon, DEGENERATE_FLAG); i++)
	{
		VECTOR corner;

		Make_Vector(corner, polygon.Data->Points[i][X], polygon.Data->Points[i][Y], 0.0);
		Include_Point(corners, corner);
	}

	const AccelFrame frame(polygon.Trans, reach, corners);

	Grow_Box(corners, frame.rounding);
	bounds.SetPatch(frame, frame.ToScene(corners));
}

/*
 * Where the hits of triangles lie: povaccelmeshgroup.cpp.
 *
 * A point is inside if a ray from it along Inside_Vect meets an odd number of
 * triangles. That may go wrong at edges, and in an open mesh, however far away
 * against that direction.
 */
void Bound_Shape(const Mesh& mesh, const AccelReach& reach, AccelBounds& bounds)
{
	const AccelMesh *accelerated = mesh.Data->Accel;
	double largest;
	accel_box box = (accelerated != NULL) ? accelerated->Box(largest) : Bound_Mesh(*mesh.Data, largest);
	const AccelFrame frame(mesh.Trans, reach, box);

	Grow_Box(box, Mesh_Growth(largest, frame.length));
	bounds.SetPatch(frame, frame.ToScene(box));
	if(mesh.has_inside_vector)
	{
		bounds.SetBody(frame, bounds.hits.box, Test_Flag(&mesh, INVERTED_FLAG));

		accel_box& body = (Test_Flag(&mesh, INVERTED_FLAG) ? bounds.outside : bounds.inside).box;

		for(int axis = X; axis <= Z; axis++)
		{
			if(mesh.Data->Inside_Vect[axis] > 0.0)
				body.lo[axis] = -HUGE_VAL;
			if(mesh.Data->Inside_Vect[axis] < 0.0)
				body.hi[axis] = HUGE_VAL;
		}
	}
}



/*****************************************************************************
 *
 * The rules
 *
 *****************************************************************************/

template<class SHAPE> static void Apply(const ObjectBase *object, const AccelReach& reach, AccelBounds& bounds)
{
	Bound_Shape(*static_cast<const SHAPE *>(object), reach, bounds);
}

struct ShapeRule
{
	const std::type_info *type;
	void (*apply)(const ObjectBase *object, const AccelReach& reach, AccelBounds& bounds);
};

// most frequent ones first
static const ShapeRule shapeRules[] =
{
	{ &typeid(Sphere), &Apply<Sphere> },
	{ &typeid(Box), &Apply<Box> },
	{ &typeid(Cone), &Apply<Cone> },
	{ &typeid(Triangle), &Apply<Triangle> },
	{ &typeid(SmoothTriangle), &Apply<Triangle> },
	{ &typeid(Mesh), &Apply<Mesh> },
	{ &typeid(Plane), &Apply<Plane> },
	{ &typeid(Quadric), &Apply<Quadric> },
	{ &typeid(Disc), &Apply<Disc> },
	{ &typeid(Torus), &Apply<Torus> },
	{ &typeid(TrueType), &Apply<TrueType> },
	{ &typeid(Prism), &Apply<Prism> },
	{ &typeid(Lathe), &Apply<Lathe> },
	{ &typeid(Sor), &Apply<Sor> },
	{ &typeid(Superellipsoid), &Apply<Superellipsoid> },
	{ &typeid(Polygon), &Apply<Polygon> },
	{ &typeid(BicubicPatch), &Apply<BicubicPatch> },
	{ &typeid(Blob), &Apply<Blob> },
	{ &typeid(SphereSweep), &Apply<SphereSweep> },
	{ &typeid(HField), &Apply<HField> },
	{ &typeid(IsoSurface), &Apply<IsoSurface> },
	{ &typeid(Parametric), &Apply<Parametric> },
	{ &typeid(Fractal), &Apply<Fractal> },
	{ &typeid(Ovus), &Apply<Ovus> },
	{ &typeid(Poly), &Apply<Poly> },
	{ NULL, NULL }
};

void Find_Shape_Bounds(const ObjectBase *object, const AccelReach& reach, AccelBounds& bounds)
{
	for(const ShapeRule *rule = shapeRules; rule->type != NULL; rule++)
	{
		if(typeid(*object) == *rule->type)
		{
			rule->apply(object, reach, bounds);
			return;
		}
	}
	bounds = AccelBounds();
}

}
