/* SPDX-License-Identifier: Apache-2.0
 *
 * Random scenes: triangles and spheres in the unit cube, sizes uniform on a log scale.
 */
#include "random.h"
#include "generator.h"

enum { STREAM_SOUP = 1000, STREAM_SPHERES = 1001 };

#define OPTION_COUNT                                                                               \
    {                                                                                              \
        .key = "n", .meaning = "number of primitives", .min = 0.0, .max = 1e8, .standard = 1e5,    \
        .whole = true                                                                              \
    }
#define OPTION_SEED                                                                                \
    {                                                                                              \
        .key = "seed", .meaning = "another number, another scene", .min = 0.0, .max = 0x1p53,      \
        .standard = 1.0, .whole = true                                                             \
    }

static const accel_option soup_options[] = {
    OPTION_COUNT,
    {.key = "min", .meaning = "smallest size", .min = 1e-300, .max = 1e6, .standard = 1e-6},
    {.key = "max", .meaning = "largest size", .min = 1e-300, .max = 1e6, .standard = 1.0},
    OPTION_SEED,
};

static const accel_option spheres_options[] = {
    OPTION_COUNT,
    {.key = "min", .meaning = "smallest radius", .min = 1e-300, .max = 1e6, .standard = 1e-4},
    {.key = "max", .meaning = "largest radius", .min = 1e-300, .max = 1e6, .standard = 1e-2},
    OPTION_SEED,
};

static double log_uniform(struct random *random, double min, double max)
{
    return exp(random_in(random, log(min), log(max)));
}

static uint32_t vertex_near(struct growing *mesh, struct random *random, const double centre[3],
                            double size)
{
    double at[3];
    for (int k = 0; k < 3; k++) {
        at[k] = centre[k] + size * (random_unit(random) - 0.5);
    }
    return grow_vertex(mesh, at[0], at[1], at[2]);
}

static bool generate_soup(struct loaded *out, const double *values)
{
    struct growing mesh = {0};
    for (uint64_t i = 0; i < (uint64_t)values[0] && !mesh.failed; i++) {
        struct random random = random_start((uint64_t)values[3], STREAM_SOUP, i);
        const double size = log_uniform(&random, values[1], values[2]);
        double centre[3];
        for (int k = 0; k < 3; k++) {
            centre[k] = random_unit(&random);
        }
        const uint32_t a = vertex_near(&mesh, &random, centre, size);
        const uint32_t b = vertex_near(&mesh, &random, centre, size);
        const uint32_t c = vertex_near(&mesh, &random, centre, size);
        grow_triangle(&mesh, a, b, c);
    }
    return loaded_add(out, ACCEL_TRIANGLES, &mesh);
}

static bool generate_spheres(struct loaded *out, const double *values)
{
    struct growing spheres = {0};
    for (uint64_t i = 0; i < (uint64_t)values[0] && !spheres.failed; i++) {
        struct random random = random_start((uint64_t)values[3], STREAM_SPHERES, i);
        const double radius = log_uniform(&random, values[1], values[2]);
        const double x = random_unit(&random);
        const double y = random_unit(&random);
        const double z = random_unit(&random);
        grow_sphere(&spheres, x, y, z, radius);
    }
    return loaded_add(out, ACCEL_SPHERES, &spheres);
}

const struct generator generator_soup = {
    .info = {.name = "soup",
             .summary = "random triangles in the unit cube, sizes uniform on a log scale",
             .options = soup_options,
             .option_count = sizeof soup_options / sizeof soup_options[0]},
    .generate = generate_soup,
};

const struct generator generator_spheres = {
    .info = {.name = "spheres",
             .summary = "random spheres in the unit cube, radii uniform on a log scale",
             .options = spheres_options,
             .option_count = sizeof spheres_options / sizeof spheres_options[0]},
    .generate = generate_spheres,
};
