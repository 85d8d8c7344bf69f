/* SPDX-License-Identifier: Apache-2.0
 *
 * No ray slips through a mesh whose triangles share the values of their vertices: closed ones from
 * inside, open ones away from their border, aimed at every vertex, along every edge and anywhere.
 */
#include <stdlib.h>
#include <string.h>

#include "cmocka_all.h"
#include "compare.h"

/* Which targets count: those of an open mesh must be inside its border. */
typedef bool is_target(const double at[3]);

/* Where a ray to a target starts. */
typedef void start(struct dice *d, const struct test_scene *s, const double at[3], double org[3]);

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
static void in_ball(struct dice *d, const struct test_scene *s, const double at[3], double org[3])
{
    (void)at;
    for (int k = 0; k < 3; k++) {
        const double middle = s->box.lo[k] + 0.5 * (s->box.hi[k] - s->box.lo[k]);
        org[k] = middle + 0.5 * (s->box.hi[k] - middle) * dice_range(d, -1, 1);
    }
}

/* Near the axis of a double fan, above its ring. */
static void in_fan(struct dice *d, const struct test_scene *s, const double at[3], double org[3])
{
    (void)s;
    (void)at;
    for (int k = 0; k < 3; k++)
        org[k] = 0.02 * dice_unit(d) + (k == 2 ? 0.05 : 0.0);
}

/* Above a height field whose slope is below 5, either side. */
static void over_field(struct dice *d, const struct test_scene *s, const double at[3],
                       double org[3])
{
    (void)s;
    const double side = dice_chance(d, 0.5) ? 1 : -1, height = side * dice_power(d, -2, 5);
    for (int k = 0; k < 3; k++)
        org[k] = at[k] + (k == 2 ? 10 * height : height * dice_range(d, -1, 1));
}

struct mesh {
    const char *scene;
    is_target *counts;
    start *from;
    double scale, shift; /* the scene is moved */
};

static void make(struct test_scene *s, const struct mesh *m, uint64_t seed)
{
    const struct scene_maker *maker = scene_maker_find(m->scene);
    const double shift[3] = {m->shift, -m->shift, m->shift};
    struct dice d = dice_from(seed, 1);
    scene_open(s);
    maker->make(s, &d, maker->param);
    scene_move(s, m->scale, shift);
    scene_close(s);
}

static void target(struct dice *d, const double *t, double at[3])
{
    const uint32_t i = dice_below(d, 3), j = (i + 1) % 3, l = (i + 2) % 3;
    const uint32_t what = dice_below(d, 4);
    const double u = what == 0 ? 0 : what == 1 ? dice_below(d, 17) / 16.0 : dice_unit(d);
    const double v = what == 3 ? (1 - u) * dice_unit(d) : 0;
    for (uint32_t k = 0; k < 3; k++)
        at[k] =
            t[3 * i + k] + u * (t[3 * j + k] - t[3 * i + k]) + v * (t[3 * l + k] - t[3 * i + k]);
}

/* Shoots at targets on every triangle in turn; the first leak ends the test. */
static uint64_t shoot(const accel *a, const char *config, const struct mesh *m,
                      const struct test_scene *s, uint64_t seed, uint64_t count)
{
    struct dice d = dice_from(seed, 41);
    const struct part *p = s->part;
    uint64_t shot = 0;
    for (uint64_t i = 0; i < count; i++) {
        double at[3], org[3], dir[3];
        target(&d, p->data + 9 * (size_t)(i % p->count), at);
        if (!m->counts(at))
            continue;
        m->from(&d, s, at, org);
        for (int k = 0; k < 3; k++)
            dir[k] = at[k] - org[k];
        const accel_ray ray = accel_ray_from(org, dir);
        accel_hit hit;
        shot++;
        if (!accel_closest(a, &ray, &hit, NULL) || !accel_any(a, &ray, NULL))
            fail_msg("%s, %s (seed %llu): leak: ray %a %a %a  %a %a %a", config, m->scene,
                     (unsigned long long)seed, org[0], org[1], org[2], dir[0], dir[1], dir[2]);
    }
    return shot;
}

static void try_mesh(const struct mesh *m, uint64_t seeds, uint64_t count)
{
    size_t kinds;
    uint64_t shot = 0;
    const accel_kind_info *const *kind = accel_kinds(&kinds);
    for (uint64_t i = 0; i < seeds; i++) {
        struct test_scene s;
        make(&s, m, test_seed() + i);
        for (size_t k = 0; k < kinds; k++) {
            const bool slow = scene_size(&s) > 1000 && strcmp(kind[k]->name, "linear") == 0;
            accel *a = must_build(&s, kind[k]->name);
            shot += shoot(a, kind[k]->name, m, &s, test_seed() + i, slow ? count / 10 + 1 : count);
            accel_free(a);
        }
        scene_free(&s);
    }
    print_message("  %-14s scale %-6g shift %-8g %8llu rays, no leak\n", m->scene, m->scale,
                  m->shift, (unsigned long long)shot);
    assert_true(shot > seeds * count / 2);
}

static void test_closed(void **state)
{
    (void)state;
    static const struct mesh balls[] = {
        {"ball-mesh", anything, in_ball, 1, 0},      {"ball-mesh", anything, in_ball, 1, 1e5},
        {"ball-mesh", anything, in_ball, 1, 1e9},    {"ball-mesh", anything, in_ball, 1e-9, 0},
        {"ball-mesh", anything, in_ball, 1e-100, 0}, {"ball-mesh", anything, in_ball, 1e100, 0},
        {"ball-mesh", anything, in_ball, 1e-150, 0}, {"ball-mesh", anything, in_ball, 1e150, 0},
    };
    for (size_t i = 0; i < sizeof balls / sizeof *balls; i++)
        try_mesh(&balls[i], 1, scaled_count(10000));
}

static void test_fans(void **state)
{
    (void)state;
    const struct mesh fan = {"fan", anything, in_fan, 1, 0};
    try_mesh(&fan, 62, scaled_count(400));
}

static void test_open(void **state)
{
    (void)state;
    const struct mesh terrain = {"terrain", in_square, over_field, 1, 0};
    const struct mesh square = {"split-square", in_square, over_field, 1, 0};
    try_mesh(&terrain, 2, scaled_count(10000));
    try_mesh(&square, 10, scaled_count(4000));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_closed),
        cmocka_unit_test(test_fans),
        cmocka_unit_test(test_open),
    };
    return cmocka_run_group_tests_name("watertight", tests, NULL, NULL);
}
