/* SPDX-License-Identifier: Apache-2.0
 *
 * Where the objects of a scene stand, and the rays that look for them.
 */
#ifndef OBJECTS_WORLD_H
#define OBJECTS_WORLD_H

#include "writer.h"

/* POV-Ray's: p becomes p * matrix, its last row is the shift. */
struct placement {
    double matrix[4][3];
};

struct world {
    double scale; /* size of its objects */
    bool mixed;   /* objects of all sizes instead */
    bool dark;    /* without lights */
    bool photons;
    double offset[3]; /* where its middle is */
};

struct world draw_world(uint64_t seed);

/* Writes the transforms that put an object of unit size somewhere into the world. */
struct placement write_placement(struct writer *w, const struct world *world);

/* Rays that begin around and in an object of unit size, and mostly meet it. They are gathered in a
 * mesh, of which POV-Ray's mesh_camera sends one ray from each face along its normal. */
struct ray_list {
    double (*corners)[3]; /* three a ray */
    size_t count, room;
};

/* False if there is no memory. */
bool add_rays(struct ray_list *list, struct rng *rng, const struct placement *placement, int count);

void write_rays(struct writer *w, const struct ray_list *list);

#endif
