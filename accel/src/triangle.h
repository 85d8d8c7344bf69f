/* SPDX-License-Identifier: Apache-2.0
 *
 * The watertight ray/triangle test: Woop, Benthin and Wald, "Watertight Ray/Triangle
 * Intersection", JCGT 2(1), 2013, in double.
 *
 * The triangle is moved to the ray's origin and sheared so that the ray is the z axis; three edge
 * functions in the plane tell whether the origin is inside. Two triangles that share an edge
 * compute the same numbers for it, so no ray slips between them. An edge function is a difference
 * of two products; rounding is monotone, so its sign is right wherever it is not 0. Where one is
 * 0, or the determinant is near the ends of double's range, everything is done again in a type
 * that holds the products exactly (`wide`).
 *
 * Needs: no contraction into fused multiply-add (-ffp-contract=off), which breaks the sharing.
 */
#ifndef ACCEL_TRIANGLE_H
#define ACCEL_TRIANGLE_H

#include "query.h"

/* Tests the triangle of three vertices (9 doubles). Returns true if the ray's line hits it, with
 * t and the weights u, v of the second and third vertex. */
bool triangle_hit(const struct query *q, const double *vertices, double *t, double *u, double *v);

#endif
