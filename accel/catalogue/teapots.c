/* SPDX-License-Identifier: Apache-2.0
 *
 * The paper's figure 5 and table 2, nine teapots over a floor, and the teapot in a stadium.
 *
 * A patch becomes quads x quads quads, two triangles each. Sums are symmetric under reversal and
 * end points are copied, so patches that share an edge share its vertices bit for bit. Triangles
 * without area at the poles are left out. y is up, as in POV-Ray: (x, y, z) of the patches becomes
 * (x, z, -y). One geometry for each object: teapots first, then what they stand in.
 */
#include "generator.h"
#include "teapot_patches.h"

#include <stdlib.h>
#include <string.h>

enum { FLOOR_QUADS = 41, FLOOR_FOR = 9, SEAT_ROWS = 20, SEATS = 60 };

/* Pitch of the teapots along x and z; a teapot with handle and spout is 6.43 x 4. */
static const double pitch_x = 7.2, pitch_z = 5.0;

/* The cubic Bezier curve at i/n. */
static double curve(const double b[4], int i, int n)
{
    if (i == 0 || (b[0] == b[1] && b[1] == b[2] && b[2] == b[3])) {
        return b[0];
    }
    if (i == n) {
        return b[3];
    }
    const double s = n - i, t = i, all = n;
    return ((s * s * s * b[0] + t * t * t * b[3]) +
            (3.0 * s * s * t * b[1] + 3.0 * s * t * t * b[2])) /
           (all * all * all);
}

static double patch_coordinate(int patch, int axis, int i, int j, int n)
{
    double across[4];
    for (int row = 0; row < 4; row++) {
        double b[4];
        for (int column = 0; column < 4; column++) {
            const int point = teapot_patches[patch][4 * row + column] - 1;
            b[column] = teapot_points[point][axis];
        }
        across[row] = curve(b, j, n);
    }
    return curve(across, i, n);
}

static bool same_point(const struct growing *mesh, uint32_t a, uint32_t b)
{
    return memcmp(mesh->numbers + 3 * (size_t)a, mesh->numbers + 3 * (size_t)b,
                  3 * sizeof(double)) == 0;
}

static void add_if_it_has_area(struct growing *mesh, uint32_t a, uint32_t b, uint32_t c)
{
    if (!mesh->failed && !same_point(mesh, a, b) && !same_point(mesh, b, c) &&
        !same_point(mesh, c, a)) {
        grow_triangle(mesh, a, b, c);
    }
}

/* The two triangles of each cell of an (n + 1) x (m + 1) lattice of vertices from `first` on. */
static void add_lattice(struct growing *mesh, uint32_t first, uint32_t n, uint32_t m)
{
    for (uint32_t i = 0; i < n; i++) {
        for (uint32_t j = 0; j < m; j++) {
            const uint32_t a = first + i * (m + 1) + j, c = a + m + 2;
            add_if_it_has_area(mesh, a, a + 1, c);
            add_if_it_has_area(mesh, a, c, c - 1);
        }
    }
}

/* A zero must have one sign, or equal points would differ in their bits. */
static double plus_zero(double x)
{
    return x == 0.0 ? 0.0 : x;
}

static void add_patch(struct growing *mesh, int patch, int n, const double at[3], double scale)
{
    const size_t first = mesh->number_count / 3;
    for (int i = 0; i <= n; i++) {
        for (int j = 0; j <= n; j++) {
            const double x = patch_coordinate(patch, 0, i, j, n);
            const double y = patch_coordinate(patch, 1, i, j, n);
            const double z = patch_coordinate(patch, 2, i, j, n);
            grow_vertex(mesh, at[0] + plus_zero(scale * x), at[1] + plus_zero(scale * z),
                        at[2] + plus_zero(-scale * y));
        }
    }
    add_lattice(mesh, (uint32_t)first, (uint32_t)n, (uint32_t)n);
}

static bool add_teapot(struct loaded *out, int quads, const double at[3], double scale)
{
    struct growing mesh = {0};
    for (int patch = 0; patch < TEAPOT_PATCHES; patch++) {
        add_patch(&mesh, patch, quads, at, scale);
    }
    return loaded_add(out, ACCEL_TRIANGLES, &mesh);
}

/* A floor around the origin at y = 0, `side` x `side` quads. */
static bool add_floor(struct loaded *out, int side, double width, double depth)
{
    struct growing mesh = {0};
    for (int i = 0; i <= side; i++) {
        for (int j = 0; j <= side; j++) {
            grow_vertex(&mesh, width * ((double)i / side - 0.5), 0.0,
                        depth * ((double)j / side - 0.5));
        }
    }
    add_lattice(&mesh, 0, (uint32_t)side, (uint32_t)side);
    return loaded_add(out, ACCEL_TRIANGLES, &mesh);
}

static bool generate_teapots(struct loaded *out, const double *values)
{
    const int quads = (int)values[0];
    bool fine = true;
    for (int i = 0; i < 9 && fine; i++) {
        const double at[3] = {pitch_x * (i % 3 - 1), values[1], pitch_z * (i / 3 - 1)};
        fine = add_teapot(out, quads, at, 1.0);
    }
    const int side = (FLOOR_QUADS * quads + FLOOR_FOR / 2) / FLOOR_FOR;
    return fine && add_floor(out, side, 3.0 * pitch_x, 3.0 * pitch_z);
}

/* Terraces from radius 250 to 500, rising to 150: large quads far around the small teapot. */
static bool add_terraces(struct loaded *out)
{
    struct growing mesh = {0};
    for (int row = 0; row <= SEAT_ROWS; row++) {
        for (int seat = 0; seat <= SEATS; seat++) {
            const double angle = 6.283185307179586 * (seat % SEATS) / SEATS;
            const double radius = 250.0 + 500.0 * ((row + 1) / 2) / SEAT_ROWS;
            const double height = 300.0 * (row / 2) / SEAT_ROWS;
            grow_vertex(&mesh, radius * cos(angle), height, radius * sin(angle));
        }
    }
    add_lattice(&mesh, 0, SEAT_ROWS, SEATS);
    return loaded_add(out, ACCEL_TRIANGLES, &mesh);
}

static bool generate_stadium(struct loaded *out, const double *values)
{
    /* a teapot is 6.43 long: 1e-3 of the stadium's 1000 is one unit */
    const double at[3] = {0.0, 0.01, 0.0};
    return add_teapot(out, (int)values[0], at, 1.0 / 6.43) && add_floor(out, 10, 500.0, 500.0) &&
           add_terraces(out);
}

static const accel_option teapots_options[] = {
    {.key = "quads",
     .meaning = "quads along each side of a patch; the floor follows with 41 for 9",
     .min = 1.0,
     .max = 300.0,
     .standard = 9.0,
     .whole = true},
    {.key = "lift",
     .meaning = "space between the teapots and the floor; a teapot is 3.15 high",
     .min = 0.0,
     .max = 100.0,
     .standard = 0.05},
};

static const accel_option stadium_options[] = {
    {.key = "quads",
     .meaning = "quads along each side of a patch of the teapot",
     .min = 1.0,
     .max = 300.0,
     .standard = 40.0,
     .whole = true},
};

const struct generator generator_teapots = {
    .info = {.name = "teapots",
             .summary = "nine Utah teapots and a floor, 49,370 triangles (the paper's figure 5)",
             .options = teapots_options,
             .option_count = sizeof teapots_options / sizeof teapots_options[0]},
    .generate = generate_teapots,
};

const struct generator generator_stadium = {
    .info = {.name = "stadium",
             .summary = "a teapot of 101,760 triangles, 1 wide, in a stadium 1000 wide",
             .options = stadium_options,
             .option_count = sizeof stadium_options / sizeof stadium_options[0]},
    .generate = generate_stadium,
};
