/* SPDX-License-Identifier: Apache-2.0
 *
 * Connected meshes, lattices and ties. Only correctly rounded operations, so that every compiler
 * makes the same vertices.
 */
#include "catalogue.h"

/* Four corners in order around; split along the first diagonal. */
static void quad(struct part *p, double x[4][3])
{
    part_triangle(p, x[0], x[1], x[2]);
    part_triangle(p, x[0], x[2], x[3]);
}

/* Squares on the planes of an n^3 lattice of integers, triangles between its points. */
void make_lattice(struct test_scene *s, struct rng *d, double n)
{
    struct part *p = scene_part(s, ACCEL_TRIANGLES);
    const uint32_t cells = (uint32_t)n;
    for (int i = 0; i < 400; i++) {
        const uint32_t axis = rng_below(d, 3), u = (axis + 1) % 3, v = (axis + 2) % 3;
        double x[4][3], at[3];
        for (int k = 0; k < 3; k++)
            at[k] = rng_below(d, cells);
        for (int c = 0; c < 4; c++) {
            x[c][axis] = at[axis];
            x[c][u] = at[u] + (c == 1 || c == 2);
            x[c][v] = at[v] + (c >= 2);
        }
        quad(p, x);
    }
    for (int i = 0; i < 100; i++) {
        double x[9];
        for (int k = 0; k < 9; k++)
            x[k] = rng_below(d, cells + 1);
        part_triangle(p, x, x + 3, x + 6);
    }
}

static void normalise(double x[3])
{
    const double length = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    for (int k = 0; k < 3; k++)
        x[k] /= length;
}

/* Both triangles of an edge compute the same midpoint: a + b is b + a. */
static void midpoint(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[k] + b[k];
    normalise(out);
}

struct ball {
    struct part *p;
    const double *centre;
    double radius;
};

static void place(const struct ball *ball, const double x[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = ball->centre[k] + ball->radius * x[k];
}

static void divide(const struct ball *ball, const double a[3], const double b[3], const double c[3],
                   int levels)
{
    double x[3], y[3], z[3];
    if (levels == 0) {
        place(ball, a, x);
        place(ball, b, y);
        place(ball, c, z);
        part_triangle(ball->p, x, y, z);
        return;
    }
    midpoint(a, b, x);
    midpoint(b, c, y);
    midpoint(c, a, z);
    divide(ball, a, x, z, levels - 1);
    divide(ball, b, y, x, levels - 1);
    divide(ball, c, z, y, levels - 1);
    divide(ball, x, y, z, levels - 1);
}

void ball_mesh(struct part *p, const double centre[3], double radius, int levels)
{
    const struct ball ball = {p, centre, radius};
    for (int side = 0; side < 8; side++) {
        const double a[3] = {side & 1 ? 1 : -1, 0, 0}, b[3] = {0, side & 2 ? 1 : -1, 0};
        const double c[3] = {0, 0, side & 4 ? 1 : -1};
        divide(&ball, a, b, c, levels);
    }
}

void make_ball_mesh(struct test_scene *s, struct rng *d, double levels)
{
    const double centre[3] = {rng_unit(d), rng_unit(d), rng_unit(d)};
    ball_mesh(scene_part(s, ACCEL_TRIANGLES), centre, 1.0, (int)levels);
}

/* Splits random triangles of the square 0..1 at random points inside, 1 to 3: no vertex ever lies
 * on a neighbour's edge. */
void make_split_square(struct test_scene *s, struct rng *d, double triangles)
{
    struct part *p = scene_part(s, ACCEL_TRIANGLES);
    const double tilt = rng_unit(d);
    double x[4][3] = {{0, 0, 0}, {1, 0, tilt}, {1, 1, 0}, {0, 1, -tilt}};
    quad(p, x);
    while (p->count < (uint32_t)triangles) {
        double *t = p->data + 9 * (size_t)rng_below(d, p->count), m[3], a[3], b[3], c[3];
        const double u = rng_range(d, 0.05, 0.45), v = rng_range(d, 0.05, 0.45);
        for (int k = 0; k < 3; k++) {
            a[k] = t[k];
            b[k] = t[3 + k];
            c[k] = t[6 + k];
            m[k] = a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k]);
            t[k] = m[k];
        }
        part_triangle(p, a, m, c);
        part_triangle(p, a, b, m);
    }
}

void make_terrain(struct test_scene *s, struct rng *d, double n)
{
    enum { MOST = 64 };
    double height[MOST + 1][MOST + 1];
    const int cells = (int)n;
    for (int i = 0; i <= cells; i++)
        for (int j = 0; j <= cells; j++)
            height[i][j] = 0.1 * rng_unit(d);
    struct part *p = scene_part(s, ACCEL_TRIANGLES);
    for (int i = 0; i < cells; i++) {
        for (int j = 0; j < cells; j++) {
            double x[4][3];
            for (int c = 0; c < 4; c++) {
                const int u = i + (c == 1 || c == 2), v = j + (c >= 2);
                x[c][0] = u / n;
                x[c][1] = v / n;
                x[c][2] = height[u][v];
            }
            quad(p, x);
        }
    }
}

/* A point of the unit circle, once around for i = 0..n, from a rational parametrisation. */
static void on_circle(uint32_t i, uint32_t n, double out[2])
{
    const double quarter = 4.0 * (i % n) / n, s = quarter - floor(quarter);
    const double w = 1.0 + s * s, x = (1.0 - s * s) / w, y = 2.0 * s / w;
    const double turned[4][2] = {{x, y}, {-y, x}, {-x, -y}, {y, -x}};
    out[0] = turned[(int)quarter][0];
    out[1] = turned[(int)quarter][1];
}

/* Two fans over one ring: closed. */
void make_fan(struct test_scene *s, struct rng *d, double unused)
{
    (void)unused;
    struct part *p = scene_part(s, ACCEL_TRIANGLES);
    const uint32_t n = 3 + rng_below(d, 62);
    const double apex[2][3] = {{0.1, 0.05, 1}, {0, 0, -rng_unit(d)}};
    for (uint32_t i = 0; i < n; i++) {
        double a[3] = {0, 0, 0}, b[3] = {0, 0, 0};
        on_circle(i, n, a);
        on_circle(i + 1, n, b);
        part_triangle(p, apex[0], a, b);
        part_triangle(p, apex[1], b, a);
    }
}

/* Squares in the planes x, y or z = 1/2, the same ones again and again, some one ulp off; several
 * geometries, so that ties are across them. */
void make_stack(struct test_scene *s, struct rng *d, double parts)
{
    for (int g = 0; g < (int)parts; g++) {
        struct part *p = scene_part(s, ACCEL_TRIANGLES);
        for (int i = 0; i < 40; i++) {
            const uint32_t axis = rng_below(d, 3), u = (axis + 1) % 3, v = (axis + 2) % 3;
            const double at[2] = {rng_below(d, 4) / 4.0, rng_below(d, 4) / 4.0};
            const double plane = rng_chance(d, 0.7) ? 0.5 : nextafter(0.5, rng_below(d, 2));
            double x[4][3];
            for (int c = 0; c < 4; c++) {
                x[c][axis] = plane;
                x[c][u] = at[0] + 0.5 * (c == 1 || c == 2);
                x[c][v] = at[1] + 0.5 * (c >= 2);
            }
            quad(p, x);
        }
    }
}

void make_twins(struct test_scene *s, struct rng *d, double unused)
{
    (void)unused;
    const double centre[3] = {rng_unit(d), rng_unit(d), rng_unit(d)};
    for (int copy = 0; copy < 3; copy++) {
        struct part *p = scene_part(s, ACCEL_TRIANGLES);
        ball_mesh(p, centre, 1.0, 2);
        for (uint32_t i = 0; copy == 2 && i < 9 * p->count; i++)
            p->data[i] = nextafter(p->data[i], 2.0);
    }
}

/* Objects whose reports are odd: many roots, roots outside the box, NaN. Ordered by key, where
 * every kind agrees whatever is reported. */
void make_exotic(struct test_scene *s, struct rng *d, double count)
{
    struct part *p = scene_part(s, ACCEL_OBJECTS);
    for (int i = 0; i < (int)count; i++) {
        accel_box box;
        for (int k = 0; k < 3; k++) {
            box.lo[k] = rng_unit(d);
            box.hi[k] = box.lo[k] + rng_power(d, -10, 0);
        }
        const double comb[6] = {1 + rng_below(d, 50), rng_range(d, -1, 1), rng_range(d, 0, 3)};
        const double stray[6] = {rng_range(d, -3, 3)};
        const double far_away[6] = {rng_power(d, -1000, 1000)};
        switch (rng_below(d, 4)) {
        case 0:
            part_object(p, &box, COMB, comb);
            break;
        case 1:
            part_object(p, &box, STRAY, stray);
            break;
        case 2:
            part_object(p, &box, STRAY, far_away);
            break;
        default:
            part_object(p, &box, NOTHING, stray);
        }
    }
    make_mixed(s, d, count);
}
