/* SPDX-License-Identifier: Apache-2.0
 *
 * The scenes that have options: cubes, teapots and others, of any size. Random ones draw from
 * random.h.
 */
#ifndef CATALOGUE_GENERATOR_H
#define CATALOGUE_GENERATOR_H

#include "loaded.h"

/* Generates a scene from the values of its options, in the order of its table. Returns false when
 * memory runs out. */
typedef bool generate_scene(struct loaded *out, const double *values);

/* One built-in scene. */
struct generator {
    accel_kind_info info;     /* what `accel kinds` shows */
    generate_scene *generate; /* makes it */
};

/* The list of them, ended by NULL. */
extern const struct generator *const generators[];

extern const struct generator generator_cubes, generator_teapots, generator_stadium, generator_soup,
    generator_spheres, generator_nested, generator_same, generator_one;

#endif
