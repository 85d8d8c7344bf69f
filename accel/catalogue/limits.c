/* SPDX-License-Identifier: Apache-2.0
 *
 * Scenes at the limits: nothing, one, all alike, nested without end, invalid.
 */
#include "catalogue.h"

#include <float.h>

void make_empty(struct test_scene *s, struct rng *d, double parts)
{
    (void)d;
    for (int i = 0; i < (int)parts; i++)
        scene_part(s, (accel_type)(i % 3));
}

static const double unit_corners[3][3] = {{0, 0, 0}, {1, 0, 0.25}, {0, 1, 0.5}};

static void add_one(struct part *p)
{
    const double centre[6] = {0.5, 0.5, 0.5, 0.25, 0, 0};
    const accel_box box = {{0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}};
    if (p->type == ACCEL_TRIANGLES)
        part_triangle(p, unit_corners[0], unit_corners[1], unit_corners[2]);
    else if (p->type == ACCEL_SPHERES)
        part_sphere(p, centre, centre[3]);
    else
        part_object(p, &box, BALL, centre);
}

/* `code` is 10 * type + count. */
void make_few(struct test_scene *s, struct rng *d, double code)
{
    (void)d;
    struct part *p = scene_part(s, (accel_type)(code / 10));
    for (int i = 0; i < (int)code % 10; i++)
        add_one(p);
}

void make_coincident(struct test_scene *s, struct rng *d, double count)
{
    (void)d;
    struct part *p = scene_part(s, ACCEL_TRIANGLES);
    for (uint32_t i = 0; i < (uint32_t)count; i++)
        add_one(p);
}

/* Radii 2^-1 .. 2^-998: the padded boxes of the last are still normal numbers. */
void make_nested(struct test_scene *s, struct rng *d, double type)
{
    (void)d;
    struct part *p = scene_part(s, type == 0   ? ACCEL_SPHERES
                                   : type == 1 ? ACCEL_OBJECTS
                                               : ACCEL_TRIANGLES);
    for (int i = 1; i < 999; i++) {
        const double r = ldexp(1.0, -i), centre[3] = {0, 0, 0};
        const double crate[6] = {-r, -r, -r, r, r, r};
        const accel_box box = {{-r, -r, -r}, {r, r, r}};
        const double a[3] = {-r, -r, -r}, b[3] = {r, -r, 0}, c[3] = {0, r, r};
        if (type == 0)
            part_sphere(p, centre, r);
        else if (type == 1)
            part_object(p, &box, CRATE, crate);
        else
            part_triangle(p, a, b, c);
    }
}

void make_series(struct test_scene *s, struct rng *d, double count)
{
    (void)d;
    struct part *p = scene_part(s, ACCEL_TRIANGLES);
    for (int i = 1; i <= (int)count; i++) {
        const double r = ldexp(1.0, -i), near[3] = {r, r, r};
        const double far[3] = {1 - r, 1 - r, 1 - r};
        const double a[3] = {r + r / 4, r, r}, b[3] = {r, r + r / 4, r};
        const double c[3] = {1 - r + r / 4, 1 - r, 1 - r}, e[3] = {1 - r, 1 - r + r / 4, 1 - r};
        part_triangle(p, near, a, b);
        part_triangle(p, far, c, e);
    }
}

/* A number that makes what it is in invalid. */
static double bad_number(struct rng *d)
{
    static const double bad[] = {NAN, INFINITY, -INFINITY, DBL_MAX, 0x1.000001p1000};
    return bad[rng_below(d, 5)];
}

static void bad_triangle(struct part *p, struct rng *d)
{
    double x[9];
    for (int k = 0; k < 9; k++)
        x[k] = rng_unit(d);
    const uint32_t at = rng_below(d, 9);
    x[at] = bad_number(d);
    part_triangle(p, x, x + 3, x + 6);
}

static void bad_sphere(struct part *p, struct rng *d)
{
    double x[4] = {rng_unit(d), rng_unit(d), rng_unit(d), 0.1};
    const uint32_t which = rng_below(d, 6);
    if (which < 4)
        x[which] = bad_number(d);
    else
        x[3] = which == 4 ? 0.0 : -0.1;
    part_sphere(p, x, x[3]);
}

static void bad_object(struct part *p, struct rng *d)
{
    const uint32_t k = rng_below(d, 3);
    const double data[6] = {0.5, 0, 0, 0, 0, 0};
    accel_box box = {{0, 0, 0}, {1, 1, 1}};
    if (rng_chance(d, 0.5))
        box.lo[k] = 2.0;
    else
        box.hi[k] = (double)NAN;
    part_object(p, &box, STRAY, data);
}

void make_all_invalid(struct test_scene *s, struct rng *d, double unused)
{
    (void)unused;
    struct part *p = scene_part(s, ACCEL_TRIANGLES);
    for (int i = 0; i < 20; i++)
        bad_triangle(p, d);
    p = scene_part(s, ACCEL_SPHERES);
    for (int i = 0; i < 20; i++)
        bad_sphere(p, d);
    p = scene_part(s, ACCEL_OBJECTS);
    for (int i = 0; i < 20; i++)
        bad_object(p, d);
}

/* Points, segments, equal corners, and three corners on one line. */
static void thin_triangle(struct part *p, struct rng *d)
{
    double x[9];
    for (int k = 0; k < 9; k++)
        x[k] = rng_below(d, 5) / 4.0;
    const uint32_t which = rng_below(d, 4);
    for (int k = 0; k < 3; k++) {
        if (which <= 1)
            x[6 + k] = x[3 + k];
        if (which == 0)
            x[k] = x[3 + k];
        if (which == 2)
            x[6 + k] = x[k] + 2 * (x[3 + k] - x[k]);
    }
    part_triangle(p, x, x + 3, x + 6);
}

static void flat_object(struct part *p, struct rng *d)
{
    double x[6];
    for (int k = 0; k < 3; k++) {
        x[k] = rng_below(d, 5) / 4.0;
        x[3 + k] = rng_chance(d, 0.5) ? x[k] : x[k] + 0.5;
    }
    const accel_box box = {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
    part_object(p, &box, CRATE, x);
}

void make_degenerate(struct test_scene *s, struct rng *d, double count)
{
    struct part *triangles = scene_part(s, ACCEL_TRIANGLES);
    struct part *spheres = scene_part(s, ACCEL_SPHERES);
    struct part *objects = scene_part(s, ACCEL_OBJECTS);
    for (int i = 0; i < (int)count; i++) {
        const double x[3] = {rng_unit(d), rng_unit(d), rng_unit(d)};
        switch (rng_below(d, 7)) {
        case 0:
            bad_triangle(triangles, d);
            break;
        case 1:
            bad_sphere(spheres, d);
            break;
        case 2:
            bad_object(objects, d);
            break;
        case 3:
        case 4:
            thin_triangle(triangles, d);
            break;
        case 5:
            flat_object(objects, d);
            break;
        default:
            part_sphere(spheres, x, rng_power(d, -1074, -2));
        }
    }
}
