/* SPDX-License-Identifier: Apache-2.0
 *
 * Step 1a of clustering: filter by size. A primitive's size is the longest side of its padded box,
 * in octaves (factors of two) of the scene; a size class is a run of octaves without a gap.
 */
#ifndef ACCEL_CLUSTER_SIZES_H
#define ACCEL_CLUSTER_SIZES_H

#include "cluster_cells.h"
#include "../primitive/primitives.h"

/* Octaves of size that share one grid of cells. */
enum { SIZES_PER_GRID = 2 };

struct sizes {
    struct frame frame;               /* of the scene */
    uint64_t count[CELLS_OCTAVES];    /* primitives in each octave */
    uint32_t class_of[CELLS_OCTAVES]; /* by octave that has primitives; 0 holds the largest */
    uint32_t top_of[CELLS_OCTAVES];   /* by octave: the first octave of its class */
    uint32_t grid_of[CELLS_OCTAVES];  /* by octave: the octave of its class's grid for it */
    double too_large[CELLS_OCTAVES];  /* by grid: sizes that do not fit the next coarser one */
    uint32_t classes;
};

/* The sizes of all bounded primitives. A class spans at most `octaves` of them; NAN: no limit. */
struct sizes accel_sizes_of(const struct primitives *p, double octaves);

/* The grid for a size in a class: the class's first octave or a multiple of SIZES_PER_GRID below
 * it; above for what has outgrown the class. */
uint32_t accel_sizes_grid(uint32_t top, uint32_t octave);

/* The octave of a box's size. */
static inline uint32_t sizes_octave(const struct sizes *s, const accel_box *box)
{
    return octave_of(box_longest(box) * s->frame.scale);
}

#endif
