/* SPDX-License-Identifier: Apache-2.0 */
#include "leaks.h"

#include "catalogue.h"

static bool anything(const double at[3])
{
    (void)at;
    return true;
}

static bool in_square(const double at[3])
{
    return at[0] > 0.02 && at[0] < 0.98 && at[1] > 0.02 && at[1] < 0.98;
}

/* Inside a ball mesh. */
static void in_ball(struct rng *d, const struct test_scene *s, const double at[3], double org[3])
{
    (void)at;
    for (int k = 0; k < 3; k++) {
        const double middle =
            s->target.box.lo[k] + 0.5 * (s->target.box.hi[k] - s->target.box.lo[k]);
        org[k] = middle + 0.5 * (s->target.box.hi[k] - middle) * rng_range(d, -1, 1);
    }
}

/* Near the axis of a double fan, above its ring. */
static void in_fan(struct rng *d, const struct test_scene *s, const double at[3], double org[3])
{
    (void)s;
    (void)at;
    for (int k = 0; k < 3; k++)
        org[k] = 0.02 * rng_unit(d) + (k == 2 ? 0.05 : 0.0);
}

/* Above a height field whose slope is below 5, either side. */
static void over_field(struct rng *d, const struct test_scene *s, const double at[3], double org[3])
{
    (void)s;
    const double side = rng_chance(d, 0.5) ? 1 : -1, height = side * rng_power(d, -2, 5);
    for (int k = 0; k < 3; k++)
        org[k] = at[k] + (k == 2 ? 10 * height : height * rng_range(d, -1, 1));
}

void leak_make(struct test_scene *s, const struct leak_mesh *m, uint64_t seed)
{
    const struct scene_maker *maker = scene_maker_find(m->scene);
    const double shift[3] = {m->shift, -m->shift, m->shift};
    struct rng d = rng_from(seed, 1);
    scene_open(s);
    maker->make(s, &d, maker->param);
    scene_move(s, m->scale, shift);
    scene_close(s);
}

/* On a triangle, `round` by round: its three corners, a point of each edge, a point inside. Which
 * comes first differs from triangle to triangle. */
static void aim(struct rng *d, const double *t, uint64_t round, double at[3])
{
    const uint32_t what = (uint32_t)(round % LEAK_ROUNDS);
    const uint32_t i = what % 3, j = (i + 1) % 3, l = (i + 2) % 3;
    const double u = what < 3 ? 0 : rng_chance(d, 0.5) ? rng_below(d, 17) / 16.0 : rng_unit(d);
    const double v = what == 6 ? (1 - u) * rng_unit(d) : 0;
    for (uint32_t k = 0; k < 3; k++)
        at[k] =
            t[3 * i + k] + u * (t[3 * j + k] - t[3 * i + k]) + v * (t[3 * l + k] - t[3 * i + k]);
}

bool leak_ray(const struct leak_mesh *m, const struct test_scene *s, struct rng *d, uint64_t i,
              accel_ray *ray)
{
    double at[3], org[3], dir[3];
    const uint64_t triangle = i % s->part->count, round = i / s->part->count + triangle;
    aim(d, s->part->data + 9 * (size_t)triangle, round, at);
    if (!m->counts(at))
        return false;
    m->from(d, s, at, org);
    for (int k = 0; k < 3; k++)
        dir[k] = at[k] - org[k];
    *ray = accel_ray_from(org, dir);
    return true;
}

const struct leak_mesh leak_balls[] = {
    {"ball-mesh", anything, in_ball, 1, 0},
    {"ball-mesh", anything, in_ball, 1, 1e5},
    {"ball-mesh", anything, in_ball, 1, 1e9},
    {"ball-mesh", anything, in_ball, 1e-9, 0},
    {"ball-mesh", anything, in_ball, 1e-100, 0},
    {"ball-mesh", anything, in_ball, 1e100, 0},
    {"ball-mesh", anything, in_ball, 1e-150, 0},
    {"ball-mesh", anything, in_ball, 1e150, 0},
    {NULL, NULL, NULL, 0, 0},
};

const struct leak_mesh leak_fan = {"fan", anything, in_fan, 1, 0};
const struct leak_mesh leak_terrain = {"terrain", in_square, over_field, 1, 0};
const struct leak_mesh leak_squares[] = {
    {"split-4", in_square, over_field, 1, 0},
    {"split-16", in_square, over_field, 1, 0},
    {"split-64", in_square, over_field, 1, 0},
    {"split-256", in_square, over_field, 1, 0},
    {"split-1024", in_square, over_field, 1, 0},
    {"split-4096", in_square, over_field, 1, 0},
    {"split-16384", in_square, over_field, 1, 0},
    {"split-65536", in_square, over_field, 1, 0},
    {NULL, NULL, NULL, 0, 0},
};
