/*******************************************************************************
 * povaccelshape.h
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module contains all defines, typedefs, and prototypes for the rules that
 * say where the hits and the inside of a single shape may be. They are in
 * povaccelshape.cpp (bodies and patches), povaccelspline.cpp (what is swept or
 * turned along a spline) and povaccelsurface.cpp (surfaces given by an equation).
 * It is a derivative work of POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

#ifndef POVRAY_BACKEND_POVACCELSHAPE_H
#define POVRAY_BACKEND_POVACCELSHAPE_H

#include "backend/frame.h"
#include "backend/accel/povaccelframe.h"
#include "backend/accel/povaccelregion.h"

namespace pov
{

class BicubicPatch;
class Blob;
class Box;
class Cone;
class Disc;
class Fractal;
class HField;
class IsoSurface;
class Lathe;
class Mesh;
class Ovus;
class Parametric;
class Plane;
class Poly;
class Polygon;
class Prism;
class Quadric;
class Sor;
class Sphere;
class SphereSweep;
class Superellipsoid;
class Torus;
class Triangle;
class TrueType;

/// Where an object may be. Regions may be too large, never too small.
struct AccelBounds
{
	/// holds every hit that a leaf test may report
	AccelRegion hits;
	/// holds every point for which Inside is true
	AccelRegion inside;
	/// holds every point for which Inside is false
	AccelRegion outside;
	/// holds the hits that the leaf test reports elsewhere than at the points that it hands to clips and to other parts of a CSG
	/// object, so that these do not bound them
	accel_box strays;
	/// do the hits lie in the region `inside`? Not for patches, which have no inside.
	bool solid;
	/// how far the points that the leaf test hands to clips and to other parts of a CSG object may be from the hits
	VECTOR slack;

	/// Nothing is known: all are the whole space.
	AccelBounds() : strays(Empty_Box()), solid(true) { slack[0] = slack[1] = slack[2] = 0.0; }

	/// A body, given a box around its hits, which it also lies in. If it is inverted, what is outside of it lies there.
	void SetBody(const AccelFrame& frame, const accel_box& box, bool inverted);

	/// Hits may be anywhere. Inside and outside remain.
	void LoseHits();

	/// A surface, given a box around its hits. The inside may be anywhere.
	void SetSurface(const AccelFrame& frame, const accel_box& box);

	/// A patch, given a box around its hits. No point is inside.
	void SetPatch(const AccelFrame& frame, const accel_box& box);
};

/// Finds hits and inside of a shape, without its clips, for rays that begin within `reach`. A type without a rule gets the
/// whole space.
void Find_Shape_Bounds(const ObjectBase *object, const AccelReach& reach, AccelBounds& bounds);

/// The rules, one for each class of shapes. povaccelshape.cpp:
void Bound_Shape(const Sphere& sphere, const AccelReach& reach, AccelBounds& bounds);
void Bound_Shape(const Box& box, const AccelReach& reach, AccelBounds& bounds);
void Bound_Shape(const Cone& cone, const AccelReach& reach, AccelBounds& bounds);
void Bound_Shape(const Torus& torus, const AccelReach& reach, AccelBounds& bounds);
void Bound_Shape(const Superellipsoid& super, const AccelReach& reach, AccelBounds& bounds);
void Bound_Shape(const Ovus& ovus, const AccelReach& reach, AccelBounds& bounds);
void Bound_Shape(const Blob& blob, const AccelReach& reach, AccelBounds& bounds);
void Bound_Shape(const Disc& disc, const AccelReach& reach, AccelBounds& bounds);
void Bound_Shape(const Triangle& triangle, const AccelReach& reach, AccelBounds& bounds);
void Bound_Shape(const Polygon& polygon, const AccelReach& reach, AccelBounds& bounds);
void Bound_Shape(const BicubicPatch& patch, const AccelReach& reach, AccelBounds& bounds);
void Bound_Shape(const Mesh& mesh, const AccelReach& reach, AccelBounds& bounds);
void Bound_Shape(const HField& field, const AccelReach& reach, AccelBounds& bounds);

/// povaccelspline.cpp:
void Bound_Shape(const Lathe& lathe, const AccelReach& reach, AccelBounds& bounds);
void Bound_Shape(const Sor& sor, const AccelReach& reach, AccelBounds& bounds);
void Bound_Shape(const Prism& prism, const AccelReach& reach, AccelBounds& bounds);
void Bound_Shape(const SphereSweep& sweep, const AccelReach& reach, AccelBounds& bounds);
void Bound_Shape(const TrueType& text, const AccelReach& reach, AccelBounds& bounds);

/// povaccelsurface.cpp:
void Bound_Shape(const Plane& plane, const AccelReach& reach, AccelBounds& bounds);
void Bound_Shape(const Quadric& quadric, const AccelReach& reach, AccelBounds& bounds);
void Bound_Shape(const Poly& poly, const AccelReach& reach, AccelBounds& bounds);
void Bound_Shape(const IsoSurface& surface, const AccelReach& reach, AccelBounds& bounds);
void Bound_Shape(const Parametric& surface, const AccelReach& reach, AccelBounds& bounds);
void Bound_Shape(const Fractal& fractal, const AccelReach& reach, AccelBounds& bounds);

/// The box in the scene of what Box::Intersect finds between two corners.
accel_box Box_Of_Container(const AccelFrame& frame, const AccelReach& reach, const VECTOR corner1, const VECTOR corner2);

/// The box in the scene of what a quadratic solver finds of a sphere with this squared radius.
accel_box Box_Of_Sphere(const AccelFrame& frame, const VECTOR center, DBL radius2);

/// A box with these corners.
accel_box Box_Between(const VECTOR corner1, const VECTOR corner2);

/// A box around a sphere.
accel_box Box_Around(const VECTOR center, DBL radius);

/// What a solver may be wrong whose error is not known, as a part of the extent of the shape. This is an allowance, not a
/// bound: it is some 70 times what was met in random scenes, and makes a box 3 % larger.
static const DBL SOLVER_ALLOWANCE = 1.0 / 128.0;

}

#endif // POVRAY_BACKEND_POVACCELSHAPE_H
