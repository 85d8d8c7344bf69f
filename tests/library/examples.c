/* SPDX-License-Identifier: Apache-2.0
 *
 * The examples of the header and of the README, taken from their text, do what they say.
 */
#include <stdio.h>
#include <stdlib.h>

#include "cmocka_all.h"
#include "compare.h"
#include "header_ball.inc"
#include "header_follow.inc"

/* ----------------------------------------------------------------- statements ---- */

static const double xyz[] = {0, 0, 1, 4, 0, 1, 0, 4, 1, 0, 0, 2, 4, 0, 2, 0, 4, 2};
static const uint32_t abc[] = {3, 4, 5, 0, 1, 2};
static const uint32_t n = 6, m = 2;
static const double origin[3] = {1, 1, -1}, direction[3] = {0, 0, 2};
static accel_hit seen;

static int complain(const char *text)
{
    fail_msg("%s", text);
    return 1;
}

static void shade(uint32_t geom, uint32_t prim, double t, double u, double v)
{
    seen = (accel_hit){t, u, v, geom, prim};
}

static int run_readme(void)
{
#include "readme.inc"
    return 0;
}

/* What the header prints is read from `out`. */
static int run_header(FILE *out)
{
    const double *eye = origin;
#define printf(...) fprintf(out, __VA_ARGS__)
#include "header_start.inc"
#undef printf
    return 0;
}

static void test_readme(void **state)
{
    (void)state;
    if (!kind_is_there("hoo"))
        skip();
    assert_int_equal(run_readme(), 0);
    assert_true(seen.prim == 1 && seen.geom == 0 && seen.t == 1 && seen.u == 0.25 &&
                seen.v == 0.25);
}

static void test_header(void **state)
{
    (void)state;
    if (!kind_is_there("hoo"))
        skip();
    char line[100] = "";
    FILE *out = tmpfile();
    assert_non_null(out);
    assert_int_equal(run_header(out), 0);
    rewind(out);
    assert_non_null(fgets(line, sizeof line, out));
    fclose(out);
    assert_string_equal(line, "triangle 1 at t = 1\n");
}

/* ----------------------------------------------------------------------- host ---- */

enum { BALLS = 64 };

static accel *build_balls(const struct ball *balls, uint32_t count, accel_order order,
                          const char *config)
{
    accel_box boxes[BALLS];
    accel *a;
    accel_error error;
    for (uint32_t i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            boxes[i].lo[k] = balls[i].centre[k] - balls[i].radius;
            boxes[i].hi[k] = balls[i].centre[k] + balls[i].radius;
        }
    }
    const accel_geometry g = {.type = ACCEL_OBJECTS,
                              .objects = {.boxes = boxes,
                                          .count = count,
                                          .order = order,
                                          .intersect = intersect_ball,
                                          .user = (void *)balls}};
    if (accel_build(&a, &(accel_scene){&g, 1}, config, NULL, &error) != ACCEL_OK)
        fail_msg("%s: %s", config, error.text);
    return a;
}

static double unit(const double from[3], const double to[3], double dir[3])
{
    double square = 0;
    for (int k = 0; k < 3; k++) {
        dir[k] = to[k] - from[k];
        square += dir[k] * dir[k];
    }
    for (int k = 0; k < 3; k++)
        dir[k] /= sqrt(square);
    return sqrt(square);
}

/* One ball of glass: a ray turns twice, by the same angle at both sides, whatever double made of
 * where it goes on. */
static void try_lone_ball(const char *config, accel_order order)
{
    const struct ball ball = {{1000, 1000, 1000}, 1, 1.5};
    accel *a = build_balls(&ball, 1, order, config);
    struct rng d = rng_from(test_seed(), 91);
    uint32_t through = 0;
    for (int i = 0; i < 2000; i++) {
        double from[3], at[3], dir[3], apart = 0, cosine = 0;
        for (int k = 0; k < 3; k++) {
            from[k] = ball.centre[k] + rng_range(&d, -5, 5);
            at[k] = ball.centre[k] + rng_range(&d, -1, 1);
        }
        if (unit(ball.centre, from, dir) < 1.01)
            continue;
        unit(from, at, dir);
        for (int k = 0; k < 3; k++)
            cosine += (ball.centre[k] - from[k]) * dir[k];
        for (int k = 0; k < 3; k++)
            apart += pow(from[k] + cosine * dir[k] - ball.centre[k], 2);
        accel_ray ray = accel_ray_from(from, dir);
        const int turns = follow(a, &ball, &ray);
        if (cosine < 0 || apart > 1 + 1e-9)
            assert_int_equal(turns, 0);
        if (cosine < 0 || apart > 0.98)
            continue;
        const double turned = 2 * (asin(sqrt(apart)) - asin(sqrt(apart) / 1.5));
        assert_int_equal(turns, 2);
        cosine = 0;
        for (int k = 0; k < 3; k++)
            cosine += ray.dir[k] * dir[k];
        assert_true(fabs(cosine - cos(turned)) < 1e-10);
        through++;
    }
    assert_true(through > 300);
    accel_free(a);
}

/* Each kind, the order of hits by key and as reported. */
static void test_lone_ball(void **state)
{
    (void)state;
    size_t kinds;
    const accel_kind_info *const *kind = accel_kinds(&kinds);
    for (size_t i = 0; i < kinds; i++)
        for (int order = 0; order < 2; order++)
            try_lone_ball(kind[i]->name, (accel_order)order);
}

/* Balls of glass and mirrors that do not touch: each kind sends the ray out alike. */
static void test_many_balls(void **state)
{
    (void)state;
    struct ball balls[BALLS];
    struct rng d = rng_from(test_seed(), 92);
    for (int i = 0; i < BALLS; i++) {
        for (int k = 0; k < 3; k++)
            balls[i].centre[k] = 1000 + i / (k == 2 ? 16 : k == 1 ? 4 : 1) % 4;
        balls[i].radius = rng_range(&d, 0.2, 0.49);
        balls[i].index = rng_chance(&d, 0.3) ? 0 : rng_range(&d, 0.6, 2.5);
    }
    size_t kinds;
    const accel_kind_info *const *kind = accel_kinds(&kinds);
    accel *judge = build_balls(balls, BALLS, ACCEL_ORDER_KEY, "linear");
    int most = 0;
    for (size_t i = 0; i < kinds; i++) {
        accel *a = build_balls(balls, BALLS, ACCEL_ORDER_KEY, kind[i]->name);
        for (int r = 0; r < 1500; r++) {
            double from[3], at[3], dir[3];
            for (int k = 0; k < 3; k++) {
                from[k] = rng_range(&d, 990, 1000 - 1);
                at[k] = rng_range(&d, 1000, 1000 + 3);
            }
            unit(from, at, dir);
            accel_ray ray = accel_ray_from(from, dir), same = ray;
            const int turns = follow(judge, balls, &ray);
            assert_int_equal(follow(a, balls, &same), turns);
            assert_memory_equal(&same, &ray, sizeof ray);
            most = turns > most ? turns : most;
        }
        accel_free(a);
    }
    accel_free(judge);
    assert_true(most > 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_readme),
        cmocka_unit_test(test_header),
        cmocka_unit_test(test_lone_ball),
        cmocka_unit_test(test_many_balls),
    };
    return cmocka_run_group_tests_name("examples", tests, NULL, NULL);
}
