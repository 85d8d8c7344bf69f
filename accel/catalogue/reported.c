/* SPDX-License-Identifier: Apache-2.0
 *
 * Cases on which other ray tracers failed, made after what their users reported: sizes, angles and
 * kinds of meshes, where the numbers are not known or too many (known.h has those that are). Each
 * scene brings the rays of its report: see test_scene.given.
 */
#include "catalogue.h"

/* As the reports' programs, which are in single precision, have it. */
static double single(double x)
{
    return (double)(float)x;
}

static accel_ray single_ray(const double org[3], const double to[3])
{
    double o[3], dir[3];
    for (int k = 0; k < 3; k++) {
        o[k] = single(org[k]);
        dir[k] = single(to[k] - o[k]);
    }
    return accel_ray_from(o, dir);
}

/* embree 387: one triangle of sides 11.2, 9.8 and 1.5, rays from up to 600 away that meet its plane
 * at half a degree, at the triangle or beside it. */
void make_skinny(struct test_scene *s, struct rng *d, double rays)
{
    const double a[3] = {single(310.7), single(-201.3), single(77.9)};
    const double along[3] = {single(6.3), single(7.2), single(5.8)}; /* 11.2 long */
    const double side[3] = {single(-0.34), single(0.69), single(-0.48)};
    double b[3], c[3];
    for (int k = 0; k < 3; k++) {
        b[k] = single(a[k] + along[k]);
        c[k] = single(a[k] + 0.87 * along[k] + side[k]);
    }
    part_triangle(scene_part(s, ACCEL_TRIANGLES), a, b, c);
    for (int i = 0; i < (int)rays; i++) {
        const double u = rng_range(d, -0.5, 1.5), v = rng_range(d, -0.5, 1.5);
        const double far = rng_range(d, 10, 50), turn = rng_range(d, -3, 3);
        double to[3], org[3], normal[3];
        for (int k = 0; k < 3; k++) {
            const int m = (k + 1) % 3, n = (k + 2) % 3;
            normal[k] = along[m] * side[n] - along[n] * side[m];
        }
        for (int k = 0; k < 3; k++) {
            to[k] = a[k] + u * along[k] + v * side[k];
            org[k] = to[k] + far * (along[k] + turn * side[k] + 0.0091 * normal[k]);
        }
        const accel_ray ray = single_ray(org, to);
        scene_give(s, &ray);
    }
}

/* embree 416: a box 120,000 high and `extent` wide, seen from 500 above. */
void make_slab(struct test_scene *s, struct rng *d, double extent)
{
    struct part *p = scene_part(s, ACCEL_TRIANGLES);
    const double size[3] = {single(extent), single(extent), 120000};
    for (int axis = 0; axis < 3; axis++) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (int end = 0; end < 2; end++) {
            double x[4][3];
            for (int c = 0; c < 4; c++) {
                x[c][axis] = end ? size[axis] : 0;
                x[c][u] = c == 1 || c == 2 ? size[u] : 0;
                x[c][v] = c >= 2 ? size[v] : 0;
            }
            part_triangle(p, x[0], x[1], x[2]);
            part_triangle(p, x[0], x[2], x[3]);
        }
    }
    for (int i = 0; i < 1000; i++) {
        const double slope = i % 2 ? rng_power(d, -10, 10) : 0;
        const double org[3] = {single(rng_range(d, 0.1, 0.9) * extent),
                               single(rng_range(d, 0.1, 0.9) * extent), 120500};
        const double to[3] = {org[0] + slope, org[1] - slope / 3, 120499};
        const accel_ray ray = single_ray(org, to);
        scene_give(s, &ray);
    }
}

/* embree 423: do two meshes collide? Each edge of one is a ray that ends at t = 1; one of the two
 * other balls is out of reach, the other overlaps. */
void make_collision(struct test_scene *s, struct rng *d, double levels)
{
    (void)d;
    const double at[3] = {single(0.22868), single(1.35269), single(-0.4)};
    const double apart[3] = {at[0] + 2.2, at[1] + 0.3, at[2]};
    const double close[3] = {at[0] - 1.1, at[1] + 0.9, at[2] + 0.2};
    struct test_scene others;
    scene_open(&others);
    ball_mesh(scene_part(&others, ACCEL_TRIANGLES), apart, 1.0, (int)levels);
    ball_mesh(others.part, close, 1.0, (int)levels);
    struct part *p = scene_part(s, ACCEL_TRIANGLES);
    ball_mesh(p, at, 1.0, (int)levels);
    for (size_t i = 0; i < 9 * (size_t)p->count; i++)
        p->data[i] = single(p->data[i]);
    for (size_t i = 0; i < 3 * (size_t)others.part->count; i++) {
        const double *t = others.part->data + 9 * (i / 3);
        accel_ray ray = single_ray(t + 3 * (i % 3), t + 3 * ((i + 1) % 3));
        ray.tmax = 1;
        scene_give(s, &ray);
    }
    scene_free(&others);
}

/* At x, y = i, j halves of the square 0..side, far above it, straight down the axis or a little
 * aslant, where double still is exact. */
static void give_down(struct test_scene *s, struct rng *d, int axis, uint32_t side)
{
    double org[3], dir[3];
    for (int k = 0; k < 3; k++) {
        org[k] = (double)rng_below(d, 2 * side + 1) / 2 - side / 2.0;
        dir[k] = rng_chance(d, 0.7) ? 0 : rng_chance(d, 0.5) ? 1 : -1;
    }
    org[axis] = side;
    dir[axis] = -1;
    const accel_ray ray = accel_ray_from(org, dir);
    scene_give(s, &ray);
}

/* POV-Ray FS324: a closed pyramid so flat that its faces meet at a tenth of a degree: near its rim
 * one hit follows the other at a distance below any tolerance. */
void make_pyramid(struct test_scene *s, struct rng *d, double half)
{
    struct part *p = scene_part(s, ACCEL_TRIANGLES);
    const double top[3] = {0, 0, 1};
    const double x[4][3] = {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}};
    for (int i = 0; i < 4; i++)
        part_triangle(p, x[i], x[(i + 1) % 4], top);
    part_triangle(p, x[0], x[2], x[1]);
    part_triangle(p, x[0], x[3], x[2]);
    for (int i = 0; i < 2000; i++)
        give_down(s, d, 2, 2 * (uint32_t)half);
}

/* tinybvh 168: a closed mesh whose vertices are integers, seen from a grid above. */
void make_quantised(struct test_scene *s, struct rng *d, double half)
{
    const double origin[3] = {0, 0, 0};
    struct part *p = scene_part(s, ACCEL_TRIANGLES);
    ball_mesh(p, origin, half, 4);
    for (size_t i = 0; i < 9 * (size_t)p->count; i++)
        p->data[i] = floor(p->data[i] + 0.5);
    for (int i = 0; i < 4000; i++)
        give_down(s, d, 1, 2 * (uint32_t)half);
}
