/* SPDX-License-Identifier: Apache-2.0
 *
 * The stiff and extreme scenes: each generator once, for the command, the tests and the reports.
 * Scenes and families of rays belong to a test, such as "slivers".
 */
#ifndef CASES_CATALOGUE_H
#define CASES_CATALOGUE_H

#include "case_scene.h"
#include "loaded.h"

struct scene_maker {
    const char *test;    /* "slivers" */
    const char *name;    /* unique, one word */
    const char *meaning; /* one line */
    void (*make)(struct test_scene *s, struct rng *d, double param);
    double param;
    uint32_t rays;     /* at intensity 1 */
    uint32_t variants; /* that many scenes from as many seeds; 0 stands for 1 */
};

/* Ended by a NULL name. */
extern const struct scene_maker scene_makers[];

/* NULL if there is none of that name. */
const struct scene_maker *scene_maker_find(const char *name);

/* Makes a scene; ends with scene_free. */
void scene_make(struct test_scene *s, const struct scene_maker *maker, uint64_t seed);

/* The same as a scene of the command, which owns it. */
void case_load(struct loaded *out, const struct scene_maker *maker, uint64_t seed);

/* A factor for all counts: the environment's ACCEL_TEST_INTENSITY, 1 if it is not set. */
double test_intensity(void);

/* count * intensity, at least 1. */
uint64_t scaled_count(uint64_t count);

/* Is the i-th of many tried? Below intensity 1 only that share of them is, the first in any case.
 */
bool takes_turn(uint64_t i);

/* The generators, by file. */
typedef void make_scene(struct test_scene *s, struct rng *d, double param);
make_scene make_shards, make_thicket, make_log_sizes, make_scaled, make_shifted, make_slivers,
    make_speck, make_huge_and_tiny, make_mixed; /* loose.c */
make_scene make_degenerate, make_coincident, make_nested, make_series, make_few, make_all_invalid,
    make_empty;                                                                  /* limits.c */
make_scene make_skinny, make_slab, make_collision, make_pyramid, make_quantised; /* reported.c */
make_scene make_lattice, make_ball_mesh, make_split_square, make_terrain, make_fan, make_stack,
    make_twins, make_exotic; /* meshes.c */

/* A closed mesh around the origin of radius about `radius`: 8 * 4^levels triangles. */
void ball_mesh(struct part *p, const double centre[3], double radius, int levels);

/* A triangle with a random corner in the unit cube and edges of about `edge`. */
void random_triangle(struct part *p, struct rng *d, double edge);

#endif
