/* SPDX-License-Identifier: Apache-2.0
 *
 * Step 1a of clustering: filter by size. A primitive's size is the longest side of its padded box,
 * in octaves (factors of two) of the scene; a size class is a run of octaves without a gap.
 */
#ifndef ACCEL_CLUSTER_SIZES_H
#define ACCEL_CLUSTER_SIZES_H

#include "cluster_cells.h"
#include "kind.h"

/* Octaves of size that share one grid of cells. */
enum { SIZES_PER_GRID = 2 };

struct sizes {
    struct frame frame;               /* of the scene */
    uint64_t count[CELLS_OCTAVES];    /* primitives in each octave */
    double largest[CELLS_OCTAVES];    /* size in the class of each octave, in units of the frame */
    uint32_t class_of[CELLS_OCTAVES]; /* by octave that has primitives; 0 holds the largest */
    uint32_t top_of[CELLS_OCTAVES];   /* by octave: the first octave of its class */
    uint32_t classes;
};

/* Measures all bounded primitives. A class spans at most `octaves` of them; NAN: no limit. False
 * if the build was cancelled. */
bool sizes_measure(struct build *build, struct sizes *s, double octaves);

/* The octave of a box's size. */
static inline uint32_t sizes_octave(const struct sizes *s, const accel_box *box)
{
    return octave_of(box_longest(box) * s->frame.scale);
}

#endif
