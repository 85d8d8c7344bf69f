/* SPDX-License-Identifier: Apache-2.0 */
#include "cluster_sizes.h"

/* From exponents to octaves: the frame's scale is a power of two. */
static void count_octaves(const struct build *build, struct sizes *s)
{
    for (uint32_t e = 0; e < BUILD_SIZES; e++)
        if (build->sizes[e] > 0)
            s->count[octave_of(ldexp(1.0, (int)e - 1023) * s->frame.scale)] += build->sizes[e];
}

uint32_t accel_sizes_grid(uint32_t top, uint32_t octave)
{
    if (octave >= top)
        return top + (octave - top) / SIZES_PER_GRID * SIZES_PER_GRID;
    return top >= SIZES_PER_GRID && octave >= top - SIZES_PER_GRID ? top - SIZES_PER_GRID : 0;
}

/* Cuts the octaves that have primitives into classes. */
static void make_classes(struct sizes *s, double octaves)
{
    uint32_t span = 0, top = 0;
    for (uint32_t o = 0; o < CELLS_OCTAVES; o++) {
        if (s->count[o] == 0) {
            span = 0;
            continue;
        }
        if (span == 0 || span >= octaves) {
            s->classes++;
            span = 0;
            top = o;
        }
        span++;
        s->class_of[o] = s->classes - 1;
        s->top_of[o] = top;
        s->grid_of[o] = accel_sizes_grid(top, o);
    }
}

struct sizes accel_sizes_of(const struct build *build, double octaves)
{
    struct sizes sizes = {.frame = frame_of(&build->a->prims.bounds)}, *s = &sizes;
    count_octaves(build, s);
    for (uint32_t g = 0; g < CELLS_OCTAVES; g++)
        s->too_large[g] = g > SIZES_PER_GRID ? ldexp(1.0, SIZES_PER_GRID - (int)g) / s->frame.scale
                                             : (double)INFINITY;
    make_classes(s, isnan(octaves) ? CELLS_OCTAVES : octaves);
    return sizes;
}
