/* SPDX-License-Identifier: Apache-2.0
 *
 * The paper's figure 3 and table 1: two clusters of 8 x 8 x 8 cubes, 12 triangles each; or of more.
 *
 * Cubes have edge 1 and whole coordinates, so that faces lie on the planes of a lattice. The second
 * cluster stands beside the first along x, `gap` cluster sides of empty space between them. Every
 * cube has its own eight vertices.
 */
#include "generator.h"

static const accel_option options[] = {
    {.key = "gap",
     .meaning = "empty space between the clusters, in cluster sides",
     .min = 0.0,
     .max = 1e6,
     .standard = 100.0},
    {.key = "space",
     .meaning = "empty space between two cubes, in cube edges",
     .min = 0.0,
     .max = 100.0,
     .standard = 1.0},
    {.key = "side",
     .meaning = "cubes along each side of a cluster",
     .min = 1.0,
     .max = 150.0,
     .standard = 8.0,
     .whole = true},
};

/* Bit k of a corner's number is its side along axis k; the triangles face outward. */
static const uint32_t faces[12][3] = {
    {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5},
};

static void add_cube(struct growing *mesh, const double at[3])
{
    uint32_t first = 0;
    for (int corner = 0; corner < 8; corner++) {
        const uint32_t vertex = grow_vertex(mesh, at[0] + (corner & 1), at[1] + (corner >> 1 & 1),
                                            at[2] + (corner >> 2 & 1));
        first = corner == 0 ? vertex : first;
    }
    for (int i = 0; i < 12; i++) {
        grow_triangle(mesh, first + faces[i][0], first + faces[i][1], first + faces[i][2]);
    }
}

static void add_cluster(struct growing *mesh, int per_side, double from_x, double pitch)
{
    for (int x = 0; x < per_side; x++) {
        for (int y = 0; y < per_side; y++) {
            for (int z = 0; z < per_side; z++) {
                add_cube(mesh, (const double[3]){from_x + x * pitch, y * pitch, z * pitch});
            }
        }
    }
}

static bool generate(struct loaded *out, const double *values)
{
    const double pitch = 1.0 + values[1];
    const int per_side = (int)values[2];
    const double side = (per_side - 1) * pitch + 1.0;
    struct growing mesh = {0};
    add_cluster(&mesh, per_side, 0.0, pitch);
    add_cluster(&mesh, per_side, side * (1.0 + values[0]), pitch);
    return loaded_add(out, ACCEL_TRIANGLES, &mesh);
}

const struct generator generator_cubes = {
    .info = {.name = "cubes",
             .summary = "two clusters of 8 x 8 x 8 cubes, 12,288 triangles (the paper's figure 3)",
             .options = options,
             .option_count = sizeof options / sizeof options[0]},
    .generate = generate,
};
