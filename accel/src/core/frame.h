/* SPDX-License-Identifier: Apache-2.0
 *
 * The frame of a scene: its box moved to the origin and scaled by a power of two so that its
 * longest side is in [1/2, 1). Builders that work on areas or grids use it, so that neither huge
 * nor tiny scenes leave double's range. It decides no answer.
 */
#ifndef ACCEL_FRAME_H
#define ACCEL_FRAME_H

#include "box.h"

/* Where the scene lies. */
struct frame {
    double lo[3]; /* its box's low corner */
    double scale; /* a power of two */
};

static inline struct frame frame_of(const accel_box *scene)
{
    double side = 0.0;
    int exponent;
    for (int k = 0; k < 3; k++)
        side = fmax(side, scene->hi[k] - scene->lo[k]);
    frexp(side, &exponent);
    /* A scene smaller than 2^-999 would need a scale beyond double's range: grids multiply it by up
     * to 2^24. */
    const double scale = ldexp(1.0, exponent < -999 ? 999 : -exponent);
    return (struct frame){{scene->lo[0], scene->lo[1], scene->lo[2]}, scale};
}

/* A box in units of the frame: inside [0, 1). */
static inline accel_box frame_box(const struct frame *f, const accel_box *b)
{
    accel_box unit;
    for (int k = 0; k < 3; k++) {
        unit.lo[k] = (b->lo[k] - f->lo[k]) * f->scale;
        unit.hi[k] = (b->hi[k] - f->lo[k]) * f->scale;
    }
    return unit;
}

#endif
