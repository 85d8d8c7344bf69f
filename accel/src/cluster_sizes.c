/* SPDX-License-Identifier: Apache-2.0 */
#include "cluster_sizes.h"

/* Values of a double's exponent field. */
enum { EXPONENTS = 2048 };

/* What one pass over the boxes finds. */
struct census {
    accel_box scene;
    uint64_t count[EXPONENTS]; /* by the exponent of the size */
    double largest[EXPONENTS];
};

static uint32_t exponent_of(double size)
{
    uint64_t bits;
    memcpy(&bits, &size, sizeof bits);
    return (uint32_t)(bits >> 52);
}

static bool take_census(struct build *build, struct census *c)
{
    const struct primitives *p = &build->a->prims;
    *c = (struct census){.scene = box_empty()};
    for (size_t i = 0; i < p->bounded.count; i++) {
        const accel_box *b = &p->box[p->bounded.at[i]];
        const double size = box_longest(b);
        const uint32_t e = exponent_of(size);
        box_add(&c->scene, b);
        c->count[e]++;
        c->largest[e] = size > c->largest[e] ? size : c->largest[e];
        if (i % 16384 == 0 && !build_tick(build, 0.0))
            return false;
    }
    return true;
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
        s->largest[o] = s->largest[top];
    }
}

bool sizes_measure(struct build *build, struct sizes *s, double octaves)
{
    struct census c;
    *s = (struct sizes){.classes = 0};
    if (!take_census(build, &c))
        return false;
    s->frame = frame_of(&c.scene);
    for (int e = 0; e < EXPONENTS; e++) {
        if (c.count[e] == 0)
            continue;
        const double size = c.largest[e] * s->frame.scale;
        const uint32_t o = octave_of(size);
        s->count[o] += c.count[e];
        s->largest[o] = size > s->largest[o] ? size : s->largest[o];
    }
    make_classes(s, isnan(octaves) ? CELLS_OCTAVES : octaves);
    return true;
}
