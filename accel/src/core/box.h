/* SPDX-License-Identifier: Apache-2.0
 *
 * Boxes: closed, axis-aligned, in double.
 */
#ifndef ACCEL_BOX_H
#define ACCEL_BOX_H

#include <math.h>

#include "accel/accel.h"
#include "contract.h"

/* Relative growth of a primitive's box: 2^-44. How far t may be off its exact value before it
 * leaves its own box; it never decides whether two kinds agree. */
#define BOX_GROWTH 0x1p-44

static inline accel_box box_empty(void)
{
    const double inf = (double)INFINITY;
    return (accel_box){{inf, inf, inf}, {-inf, -inf, -inf}};
}

static inline void box_add_point(accel_box *b, const double p[3])
{
    for (int k = 0; k < 3; k++) {
        b->lo[k] = p[k] < b->lo[k] ? p[k] : b->lo[k];
        b->hi[k] = p[k] > b->hi[k] ? p[k] : b->hi[k];
    }
}

static inline void box_add(accel_box *b, const accel_box *other)
{
    for (int k = 0; k < 3; k++) {
        b->lo[k] = other->lo[k] < b->lo[k] ? other->lo[k] : b->lo[k];
        b->hi[k] = other->hi[k] > b->hi[k] ? other->hi[k] : b->hi[k];
    }
}

static inline bool box_contains(const accel_box *outer, const accel_box *inner)
{
    for (int k = 0; k < 3; k++)
        if (!(outer->lo[k] <= inner->lo[k] && inner->hi[k] <= outer->hi[k]))
            return false;
    return true;
}

static inline bool box_overlaps(const accel_box *a, const accel_box *b)
{
    for (int k = 0; k < 3; k++)
        if (!(a->lo[k] <= b->hi[k] && b->lo[k] <= a->hi[k]))
            return false;
    return true;
}

/* Half the surface: what the surface-area heuristic needs. Not finite for huge boxes. */
static inline double box_area(const accel_box *b)
{
    const double x = b->hi[0] - b->lo[0], y = b->hi[1] - b->lo[1], z = b->hi[2] - b->lo[2];
    return x * y + y * z + z * x;
}

/* The longest side. */
static inline double box_longest(const accel_box *b)
{
    double longest = 0.0;
    for (int k = 0; k < 3; k++) {
        const double side = b->hi[k] - b->lo[k];
        longest = side > longest ? side : longest;
    }
    return longest;
}

/* The chance that a line through `outer` meets `inner`, which lies in it: the ratio of surfaces.
 * 1 where the surfaces do not tell: boxes without extent, or too large or small for double. */
static inline double box_chance(const accel_box *inner, const accel_box *outer)
{
    const double ratio = box_area(inner) / box_area(outer);
    return ratio >= 0.0 && ratio <= 1.0 ? ratio : 1.0;
}

/* The primitive's box P': grown on every side by BOX_GROWTH of its largest coordinate. */
static inline accel_box box_padded(const accel_box *b)
{
    double largest = 0.0;
    for (int k = 0; k < 3; k++)
        largest = fmax(largest, fmax(fabs(b->lo[k]), fabs(b->hi[k])));
    accel_box grown;
    for (int k = 0; k < 3; k++) {
        grown.lo[k] = b->lo[k] - largest * BOX_GROWTH;
        grown.hi[k] = b->hi[k] + largest * BOX_GROWTH;
    }
    return grown;
}

#endif
