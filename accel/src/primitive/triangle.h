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
 * that holds the products exactly (`quad`).
 *
 * Needs: no contraction into fused multiply-add, which breaks the sharing: see contract.h.
 */
#ifndef ACCEL_TRIANGLE_H
#define ACCEL_TRIANGLE_H

#include "pair.h"
#include "query.h"

/* Tests the triangle of three vertices (9 doubles). Returns true if the ray's line hits it, with
 * t and the weights u, v of the second and third vertex. */
bool accel_triangle_hit(const struct query *q, const double *vertices, double *t, double *u,
                        double *v);

/* Two triangles at once. Bit i of the result is 0 only if accel_triangle_hit is false for the i-th:
 * the same edge functions in the same order of operations have both signs. Where one is NaN the
 * sign found is still that of another. */
static inline uint32_t triangle_pair_may_hit(const struct query *q, const double *first,
                                             const double *second)
{
    const int kx = q->axis[0], ky = q->axis[1], kz = q->axis[2];
    pair x[3], y[3];
    for (int i = 0; i < 3; i++) {
        const double *a = first + 3 * i, *b = second + 3 * i;
        const pair z = pair_sub(pair_of(a[kz], b[kz]), pair_both(q->org[kz]));
        x[i] = pair_sub(pair_sub(pair_of(a[kx], b[kx]), pair_both(q->org[kx])),
                        pair_mul(pair_both(q->shear[0]), z));
        y[i] = pair_sub(pair_sub(pair_of(a[ky], b[ky]), pair_both(q->org[ky])),
                        pair_mul(pair_both(q->shear[1]), z));
    }
    const pair e0 = pair_sub(pair_mul(x[2], y[1]), pair_mul(y[2], x[1]));
    const pair e1 = pair_sub(pair_mul(x[0], y[2]), pair_mul(y[0], x[2]));
    const pair e2 = pair_sub(pair_mul(x[1], y[0]), pair_mul(y[1], x[0]));
    const pair zero = pair_both(0.0);
    const uint32_t negative = pair_below(pair_min(pair_min(e0, e1), e2), zero);
    const uint32_t positive = pair_below(zero, pair_max(pair_max(e0, e1), e2));
    return 3 & ~(negative & positive);
}

#endif
