/* SPDX-License-Identifier: Apache-2.0
 *
 * Scenes at the limits: one triangle, many at one place, spheres within spheres.
 */
#include "generator.h"

static const accel_option same_options[] = {
    {.key = "n",
     .meaning = "number of triangles",
     .min = 0.0,
     .max = 1e8,
     .standard = 1e6,
     .whole = true},
};

static const accel_option nested_options[] = {
    {.key = "n",
     .meaning = "number of spheres; the radii are 1, 1/2, 1/4, ...",
     .min = 0.0,
     .max = 1000.0,
     .standard = 1000.0,
     .whole = true},
};

/* `count` times the triangle (0,0,0) (1,0,0) (0,1,0), each with vertices of its own. */
static bool add_same(struct loaded *out, uint64_t count)
{
    struct growing mesh = {0};
    for (uint64_t i = 0; i < count && !mesh.failed; i++) {
        const uint32_t a = grow_vertex(&mesh, 0.0, 0.0, 0.0);
        const uint32_t b = grow_vertex(&mesh, 1.0, 0.0, 0.0);
        const uint32_t c = grow_vertex(&mesh, 0.0, 1.0, 0.0);
        grow_triangle(&mesh, a, b, c);
    }
    return loaded_add(out, ACCEL_TRIANGLES, &mesh);
}

static bool generate_same(struct loaded *out, const double *values)
{
    return add_same(out, (uint64_t)values[0]);
}

static bool generate_one(struct loaded *out, const double *values)
{
    (void)values;
    return add_same(out, 1);
}

/* All touch the origin from the same side, so that their centres differ as well. */
static bool generate_nested(struct loaded *out, const double *values)
{
    struct growing spheres = {0};
    double radius = 1.0;
    for (int i = 0; i < (int)values[0]; i++) {
        grow_sphere(&spheres, radius, 0.0, 0.0, radius);
        radius *= 0.5;
    }
    return loaded_add(out, ACCEL_SPHERES, &spheres);
}

const struct generator generator_same = {
    .info = {.name = "same",
             .summary = "triangles that all lie at one place",
             .options = same_options,
             .option_count = sizeof same_options / sizeof same_options[0]},
    .generate = generate_same,
};

const struct generator generator_nested = {
    .info = {.name = "nested",
             .summary = "spheres within spheres, each half as large, touching at one point",
             .options = nested_options,
             .option_count = sizeof nested_options / sizeof nested_options[0]},
    .generate = generate_nested,
};

const struct generator generator_one = {
    .info = {.name = "one", .summary = "one triangle"},
    .generate = generate_one,
};
