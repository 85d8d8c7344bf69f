/* SPDX-License-Identifier: Apache-2.0
 *
 * Scenes of unconnected primitives: many sizes, places and shapes.
 */
#include "catalogue.h"

static void random_point(struct rng *d, double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = rng_unit(d);
}

/* A number of either sign and magnitude up to `size`. */
static double around(struct rng *d, double size)
{
    return size * rng_range(d, -1.0, 1.0);
}

void random_triangle(struct part *p, struct rng *d, double edge)
{
    double a[3], b[3], c[3];
    random_point(d, a);
    for (int k = 0; k < 3; k++) {
        b[k] = a[k] + around(d, edge);
        c[k] = a[k] + around(d, edge);
    }
    part_triangle(p, a, b, c);
}

void make_shards(struct test_scene *s, struct rng *d, double count)
{
    struct part *p = scene_part(s, ACCEL_TRIANGLES);
    for (uint32_t i = 0; i < (uint32_t)count; i++)
        random_triangle(p, d, count < 5000 ? rng_power(d, -10, 0) : rng_power(d, -10, -4));
}

/* Large triangles across each other, as trees cut them up; every third with its corners on a
 * lattice, so that many lie in one plane and along the axes; and small ones between. */
void make_thicket(struct test_scene *s, struct rng *d, double count)
{
    struct part *p = scene_part(s, ACCEL_TRIANGLES);
    for (uint32_t i = 0; i < (uint32_t)count; i++) {
        double at[3][3];
        if (i % 3 != 0) {
            random_triangle(p, d, i % 3 == 1 ? rng_power(d, -1, 1) : rng_power(d, -12, -2));
            continue;
        }
        for (int corner = 0; corner < 3; corner++)
            for (int k = 0; k < 3; k++)
                at[corner][k] = 0.25 * (double)rng_below(d, 9) - 1.0;
        part_triangle(p, at[0], at[1], at[2]);
    }
}

void make_log_sizes(struct test_scene *s, struct rng *d, double count)
{
    struct part *p = scene_part(s, ACCEL_TRIANGLES);
    for (uint32_t i = 0; i < (uint32_t)count; i++)
        random_triangle(p, d, rng_power(d, -40, 0));
}

void make_scaled(struct test_scene *s, struct rng *d, double factor)
{
    const double nowhere[3] = {0, 0, 0};
    make_shards(s, d, 300);
    scene_move(s, factor, nowhere);
}

void make_shifted(struct test_scene *s, struct rng *d, double offset)
{
    const double odd[3] = {148376, 1234, -223423}, even[3] = {offset, -offset, offset};
    make_shards(s, d, 300);
    scene_move(s, 1.0, offset == 0 ? odd : even);
}

/* Needles: two long edges and a short one. Caps: three corners nearly on a line. */
void make_slivers(struct test_scene *s, struct rng *d, double count)
{
    struct part *p = scene_part(s, ACCEL_TRIANGLES);
    for (uint32_t i = 0; i < (uint32_t)count; i++) {
        const double aspect = rng_power(d, -47, -10), length = rng_power(d, -3, 0);
        const double along = rng_chance(d, 0.5) ? 1.0 : rng_unit(d);
        double a[3], b[3], c[3];
        random_point(d, a);
        for (int k = 0; k < 3; k++) {
            b[k] = a[k] + around(d, length);
            c[k] = a[k] + along * (b[k] - a[k]) + around(d, aspect * length);
        }
        part_triangle(p, a, b, c);
    }
}

/* A ball of 8 * 4^levels triangles, 1e-3 large, somewhere in a box of 1e3 with a few seats. */
void make_speck(struct test_scene *s, struct rng *d, double levels)
{
    struct part *p = scene_part(s, ACCEL_TRIANGLES);
    const double centre[3] = {123.456, -321.0, 7.25};
    for (int i = 0; i < 1696; i++) {
        double a[3], b[3], c[3];
        for (int k = 0; k < 3; k++) {
            a[k] = around(d, 500.0);
            b[k] = a[k] + around(d, 40.0);
            c[k] = a[k] + around(d, 40.0);
        }
        part_triangle(p, a, b, c);
    }
    ball_mesh(p, centre, 0.5e-3, (int)levels);
    for (int i = 0; i < 65536; i++) {
        double x[9];
        for (int k = 0; k < 9; k++)
            x[k] = centre[k % 3] + around(d, 0.5e-3);
        for (int k = 3; k < 9; k++)
            x[k] = x[k % 3] + around(d, 1e-5);
        part_triangle(p, x, x + 3, x + 6);
    }
}

static accel_box box_around(const double centre[3], double radius)
{
    accel_box b;
    for (int k = 0; k < 3; k++) {
        b.lo[k] = centre[k] - radius;
        b.hi[k] = centre[k] + radius;
    }
    return b;
}

static void random_ball(struct part *p, struct rng *d, double radius, enum behaviour behaviour)
{
    double x[6] = {0};
    random_point(d, x);
    x[3] = radius;
    const accel_box box = box_around(x, radius * 1.0000001);
    part_object(p, &box, behaviour, x);
}

static void random_crate(struct part *p, struct rng *d, double size)
{
    double x[6];
    random_point(d, x);
    for (int k = 0; k < 3; k++)
        x[3 + k] = x[k] + size * rng_unit(d);
    const accel_box box = {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
    part_object(p, &box, CRATE, x);
}

static void random_plane(struct part *p, struct rng *d)
{
    const double inf = (double)INFINITY;
    double x[6];
    random_point(d, x);
    for (int k = 3; k < 6; k++)
        x[k] = around(d, 1.0);
    const accel_box endless = {{-inf, -inf, -inf}, {inf, inf, inf}};
    const accel_box half = {{-inf, -inf, x[2]}, {inf, inf, x[2]}};
    const double flat[6] = {x[0], x[1], x[2], 0, 0, 1};
    if (rng_chance(d, 0.5))
        part_object(p, &endless, PLANE, x);
    else
        part_object(p, &half, PLANE, flat);
}

void make_huge_and_tiny(struct test_scene *s, struct rng *d, double unused)
{
    (void)unused;
    struct part *p = scene_part(s, ACCEL_SPHERES);
    const double far_below[3] = {0, -1e7, 0};
    part_sphere(p, far_below, 1e7);
    for (int i = 0; i < 200; i++) {
        double x[3];
        random_point(d, x);
        part_sphere(p, x, rng_power(d, -20, -2));
    }
    p = scene_part(s, ACCEL_OBJECTS);
    for (int i = 0; i < 40; i++)
        random_ball(p, d, rng_power(d, -20, 20), BALL);
    for (int i = 0; i < 4; i++)
        random_plane(p, d);
    for (int i = 0; i < 40; i++)
        random_crate(p, d, rng_power(d, -20, 10));
    p = scene_part(s, ACCEL_TRIANGLES);
    for (int i = 0; i < 100; i++)
        random_triangle(p, d, rng_power(d, -20, 20));
}

/* A negative count leaves out the objects that are ordered as reported. */
void make_mixed(struct test_scene *s, struct rng *d, double count)
{
    const uint32_t n = (uint32_t)fabs(count) / 3;
    make_shards(s, d, n);
    for (int order = 0; order < 2; order++) {
        struct part *p = scene_part(s, ACCEL_OBJECTS);
        p->order = order == 0 || count < 0 ? ACCEL_ORDER_KEY : ACCEL_ORDER_RAW;
        for (uint32_t i = 0; i < n / 4; i++)
            random_ball(p, d, rng_power(d, -10, -2), i % 2 ? BALL : FILTER);
        for (uint32_t i = 0; i < n / 4; i++)
            random_crate(p, d, rng_power(d, -10, -1));
        random_plane(p, d);
    }
    struct part *p = scene_part(s, ACCEL_SPHERES);
    for (uint32_t i = 0; i < n; i++) {
        double x[3];
        random_point(d, x);
        part_sphere(p, x, rng_power(d, -10, -2));
    }
    make_shards(s, d, n);
}
