/* SPDX-License-Identifier: Apache-2.0
 *
 * A thinned scene, for `auto` to try kinds on.
 *
 * A sample is thinner than the scene, so rays would pass where they should hit: a primitive that is
 * taken with chance p is scaled about its centre by sqrt(1 / p), which keeps the expected sum of
 * surfaces. The chance is in proportion to the surface of its box, half of it, so that the few
 * large ones that rays meet are taken as they are; and alike for all, the other half.
 *
 * Host objects are sampled by their boxes, whose callback counts its calls; the host's own are not
 * called.
 */
#ifndef ACCEL_AUTO_SAMPLE_H
#define ACCEL_AUTO_SAMPLE_H

#include "../core/build.h"
#include "../core/cost.h"
#include "../core/structure.h"

/* The sample as a scene of at most three geometries. */
struct sample {
    ARRAY_OF(double) vertices;  /* of the triangles */
    ARRAY_OF(uint32_t) indices; /* of the triangles: 0, 1, 2, ... */
    ARRAY_OF(double) spheres;   /* centre, radius */
    ARRAY_OF(accel_box) boxes;  /* of the objects */
    accel_geometry geometry[3]; /* in that order */
    accel_scene scene;
    accel_box box;  /* around all */
    uint64_t calls; /* of the objects' callback */
    size_t count;   /* primitives */
};

/* Fills *s: about `most` primitives, or all where there are no more. *s must be zero;
 * accel_sample_free ends it, also after a failure. */
bool accel_sample_take(struct build *build, struct sample *s, size_t most);

void accel_sample_free(struct memory *m, struct sample *s);

#endif
