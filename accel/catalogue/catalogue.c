/* SPDX-License-Identifier: Apache-2.0 */
#include "catalogue.h"

#include <stdlib.h>
#include <string.h>

#define SCALED(name, factor)                                                                       \
    {                                                                                              \
        "scales", name, "300 triangles, all coordinates times " #factor, make_scaled, factor,      \
            2000, 0                                                                                \
    }
#define SHIFTED(name, offset)                                                                      \
    {                                                                                              \
        "offsets", name, "300 triangles, " #offset " off the origin", make_shifted, offset, 2000,  \
            0                                                                                      \
    }
/* A ray at an edge of a pile redoes every copy in 113 bits. */
#define COPIES(name, count)                                                                        \
    {                                                                                              \
        "coincident", name, "one triangle, " #count " times", make_coincident, count,              \
            (count) > 100000 ? 4                                                                   \
            : (count) > 1000 ? 12                                                                  \
                             : 200,                                                                \
            0                                                                                      \
    }
#define SPLIT(name, count)                                                                         \
    {                                                                                              \
        "closed", name, "a square, split at random into " #count " triangles", make_split_square,  \
            count, (count) > 5000 ? 200 : 1000, 10                                                 \
    }

const struct scene_maker scene_makers[] = {
    {"random", "shards", "1,000 triangles, edges 1e-3..1", make_shards, 1000, 5000, 0},
    {"random", "shards-20k", "20,000 triangles, edges 1e-3..1", make_shards, 20000, 5000, 0},
    {"random", "shards-100k", "100,000 triangles, edges 1e-3..1", make_shards, 100000, 5000, 0},
    {"random", "thicket", "900 large triangles across each other", make_thicket, 900, 5000, 0},
    {"sizes", "sizes", "1,000 triangles, edges 1e-12..1", make_log_sizes, 1000, 5000, 0},
    SCALED("scale-1e-310", 1e-310),
    SCALED("scale-1e-300", 1e-300),
    SCALED("scale-1e-150", 1e-150),
    SCALED("scale-1e-38", 1e-38),
    SCALED("scale-1e-12", 1e-12),
    SCALED("scale-1e-9", 1e-9),
    SCALED("scale-1e-4", 1e-4),
    SCALED("scale-1", 1.0),
    SCALED("scale-1e4", 1e4),
    SCALED("scale-1e9", 1e9),
    SCALED("scale-1e18", 1e18),
    SCALED("scale-1e38", 1e38),
    SCALED("scale-1e150", 1e150),
    SCALED("scale-1e300", 1e300),
    SCALED("scale-1e308", 1e308),
    SHIFTED("shift-1e3", 1e3),
    SHIFTED("shift-1e6", 1e6),
    SHIFTED("shift-1e9", 1e9),
    SHIFTED("shift-1e12", 1e12),
    SHIFTED("shift-1e15", 1e15),
    {"offsets", "shift-odd", "300 triangles at (148376, 1234, -223423)", make_shifted, 0, 2000, 0},
    {"slivers", "slivers", "500 needles and caps, aspect 1e-3..1e-14", make_slivers, 500, 5000, 0},
    {"reported", "embree-387", "a skinny triangle at half a degree (embree 387)", make_skinny, 2000,
     200, 0},
    {"reported", "embree-416", "a box 120,000 high and 5.89e11 wide (embree 416)", make_slab,
     5.89075e11, 200, 0},
    {"reported", "embree-423", "edges of one mesh against another (embree 423)", make_collision, 3,
     200, 0},
    {"reported", "povray-fs324", "a closed pyramid, flat as 1 in 512 (POV-Ray FS324)", make_pyramid,
     512, 200, 0},
    {"reported", "tinybvh-168", "a closed mesh of integer vertices (tinybvh 168)", make_quantised,
     512, 200, 0},
    {"degenerate", "degenerate", "points, segments, inverted boxes, NaN, zero radius",
     make_degenerate, 24, 20, 1000},
    COPIES("copies-1", 1),
    COPIES("copies-2", 2),
    COPIES("copies-255", 255),
    COPIES("copies-256", 256),
    COPIES("copies-257", 257),
    COPIES("copies-511", 511),
    COPIES("copies-512", 512),
    COPIES("copies-65535", 65535),
    COPIES("copies-65536", 65536),
    COPIES("copies-1000000", 1000000),
    {"nested", "nested-spheres", "spheres of radius 2^-i, one centre", make_nested, 0, 1000, 0},
    {"nested", "nested-boxes", "boxes of side 2^-i, one centre", make_nested, 1, 1000, 0},
    {"nested", "nested-triangles", "triangles of size 2^-i, one centre", make_nested, 2, 1000, 0},
    {"series", "series", "triangles at 2^-i and 1 - 2^-i", make_series, 1000, 2000, 0},
    {"lattice", "lattice", "faces on the planes of an 8 x 8 x 8 lattice", make_lattice, 8, 20000,
     0},
    {"closed", "ball-mesh", "closed sphere of 2,048 triangles", make_ball_mesh, 4, 10000, 0},
    SPLIT("split-4", 4),
    SPLIT("split-16", 16),
    SPLIT("split-64", 64),
    SPLIT("split-256", 256),
    SPLIT("split-1024", 1024),
    SPLIT("split-4096", 4096),
    SPLIT("split-16384", 16384),
    SPLIT("split-65536", 65536),
    {"closed", "terrain", "a height field, 32 x 32", make_terrain, 32, 10000, 0},
    {"closed", "fan", "closed double fans of 3..64", make_fan, 0, 200, 62},
    {"speck", "speck", "100,000 triangles in 1e-3 of a scene of 1e3", make_speck, 6, 2000, 0},
    {"huge-and-tiny", "huge-and-tiny", "spheres of 1e7 and 1e-6, boxes, infinite planes",
     make_huge_and_tiny, 0, 2000, 0},
    {"ties", "stack", "coplanar squares, 0 or 1 ulp apart", make_stack, 8, 5000, 0},
    {"ties", "twins", "a mesh twice, 0 or 1 ulp apart", make_twins, 0, 5000, 0},
    {"few", "empty", "no geometry", make_empty, 0, 20, 0},
    {"few", "hollow", "three geometries without primitives", make_empty, 3, 20, 0},
    {"few", "one-triangle", "one triangle", make_few, 1, 200, 0},
    {"few", "one-sphere", "one sphere", make_few, 11, 200, 0},
    {"few", "one-object", "one object", make_few, 21, 200, 0},
    {"few", "two-triangles", "two identical triangles", make_few, 2, 200, 0},
    {"few", "two-spheres", "two identical spheres", make_few, 12, 200, 0},
    {"few", "two-objects", "two identical objects", make_few, 22, 200, 0},
    {"few", "all-invalid", "nothing but invalid primitives", make_all_invalid, 0, 20, 0},
    {"odd-objects", "exotic", "objects with several roots, wrong ones, none", make_exotic, 200,
     5000, 0},
    {"mix", "mixed", "triangles, spheres and objects of all orders", make_mixed, 300, 5000, 0},
    {"mix", "mixed-key", "the same, all ordered by key", make_mixed, -300, 5000, 0},
    {NULL, NULL, NULL, NULL, 0, 0, 0},
};

const struct scene_maker *scene_maker_find(const char *name)
{
    for (const struct scene_maker *m = scene_makers; m->name; m++)
        if (strcmp(m->name, name) == 0)
            return m;
    return NULL;
}

void scene_make(struct test_scene *s, const struct scene_maker *maker, uint64_t seed)
{
    struct rng d = rng_from(seed, 1);
    scene_open(s);
    maker->make(s, &d, maker->param);
    scene_close(s);
}

void case_load(struct loaded *out, const struct scene_maker *maker, uint64_t seed)
{
    *out = (struct loaded){0};
    struct test_scene *s = must_resize(NULL, sizeof *s);
    scene_make(s, maker, seed);
    out->geometries = must_resize(NULL, s->count * sizeof *out->geometries);
    memcpy(out->geometries, s->geometry, s->count * sizeof *out->geometries);
    out->scene = (accel_scene){out->geometries, s->count};
    free(s->target.given);
    free(s);
}

double test_intensity(void)
{
    const char *text = getenv("ACCEL_TEST_INTENSITY");
    const double given = text ? strtod(text, NULL) : 1.0;
    return given > 0.0 ? given : 1.0;
}

uint64_t scaled_count(uint64_t count)
{
    const double scaled = (double)count * test_intensity();
    return scaled < 1.0 ? 1 : (uint64_t)scaled;
}

bool takes_turn(uint64_t i)
{
    return i == 0 || floor((double)i * fmin(test_intensity(), 1.0)) >
                         floor((double)(i - 1) * fmin(test_intensity(), 1.0));
}
