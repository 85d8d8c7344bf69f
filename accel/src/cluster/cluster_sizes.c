/* SPDX-License-Identifier: Apache-2.0 */
#include "cluster_sizes.h"

#include <string.h>

/* Values of a double's exponent field. */
enum { EXPONENTS = 2048 };

static uint32_t exponent_of(double size)
{
    uint64_t bits;
    memcpy(&bits, &size, sizeof bits);
    return (uint32_t)(bits >> 52) % EXPONENTS;
}

/* By exponents first, which become octaves: the frame's scale is a power of two. */
static void count_octaves(const struct primitives *p, struct sizes *s)
{
    uint32_t sizes[EXPONENTS] = {0};
    for (uint32_t i = 0; i < p->bounded.count; i++)
        sizes[exponent_of(box_longest(&p->box[p->bounded.at[i]]))]++;
    for (uint32_t e = 0; e < EXPONENTS; e++)
        if (sizes[e] > 0)
            s->count[octave_of(ldexp(1.0, (int)e - 1023) * s->frame.scale)] += sizes[e];
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

struct sizes accel_sizes_of(const struct primitives *p, double octaves)
{
    struct sizes sizes = {.frame = frame_of(&p->bounds)}, *s = &sizes;
    count_octaves(p, s);
    for (uint32_t g = 0; g < CELLS_OCTAVES; g++)
        s->too_large[g] = g > SIZES_PER_GRID ? ldexp(1.0, SIZES_PER_GRID - (int)g) / s->frame.scale
                                             : (double)INFINITY;
    make_classes(s, isnan(octaves) ? CELLS_OCTAVES : octaves);
    return sizes;
}
