/* SPDX-License-Identifier: Apache-2.0
 *
 * Sizes and shapes that break builders: a million primitives in one place, nests and series without
 * end, a dense spot in a wide scene. Time, memory, depth and work stay within bounds.
 */
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "cmocka_all.h"
#include "compare.h"

static double processor_time(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static accel *build_timed(const struct test_scene *s, const char *kind, double *seconds)
{
    const double start = processor_time();
    accel *a = must_build(s, kind);
    *seconds = processor_time() - start;
    return a;
}

/* `count` primitives of a type, all the same, or spread out. */
static void make_pile(struct test_scene *s, accel_type type, uint32_t count, bool spread)
{
    struct dice d = dice_from(1, 1);
    scene_open(s);
    struct part *p = scene_part(s, type);
    for (uint32_t i = 0; i < count; i++) {
        double x[6] = {0.25, 0.25, 0.25, 1.0, 1.0, 1.0};
        for (int k = 0; spread && k < 3; k++)
            x[k] = 100 * dice_unit(&d);
        for (int k = 0; k < 3; k++)
            x[3 + k] = x[k] + 0.75;
        const accel_box box = {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
        const double b[3] = {x[3], x[1], x[2]}, c[3] = {x[0], x[4], x[5]};
        if (type == ACCEL_TRIANGLES)
            part_triangle(p, x, b, c);
        else if (type == ACCEL_SPHERES)
            part_sphere(p, x, 0.5);
        else
            part_object(p, &box, CRATE, x);
    }
    scene_close(s);
}

struct ids {
    uint32_t at[100];
    uint32_t count, most;
};

static bool store(void *user, const accel_hit *hit)
{
    struct ids *l = user;
    l->at[l->count++] = hit->prim;
    return l->count < l->most;
}

/* The lowest id of all that tie; then the next one. */
static void check_pile(const accel *a, const char *kind)
{
    const double org[3] = {0.375, 0.3125, -2}, dir[3] = {0, 0.0625, 1};
    accel_ray ray = accel_ray_from(org, dir);
    accel_hit hit;
    struct ids first = {.most = 40};
    assert_true(accel_closest(a, &ray, &hit, NULL));
    if (hit.prim != 0)
        fail_msg("%s: primitive %u wins the tie", kind, hit.prim);
    accel_all(a, &ray, store, &first, NULL);
    for (uint32_t i = 0; i < first.most; i++)
        assert_int_equal(first.at[i], i);
    ray.skip = (accel_id){0, 0};
    assert_true(accel_closest(a, &ray, &hit, NULL));
    assert_int_equal(hit.prim, 1);
}

/* Seconds that may pass whatever the scene: clocks, and the trials that auto makes. */
static const double noise = 0.5;

static void try_pile(accel_type type, uint32_t count, const char *what)
{
    struct test_scene pile, spread;
    size_t kinds;
    const accel_kind_info *const *kind = accel_kinds(&kinds);
    make_pile(&pile, type, count, false);
    make_pile(&spread, type, count, true);
    for (size_t i = 0; i < kinds; i++) {
        double seconds, usual;
        accel_info info;
        accel *a = build_timed(&spread, kind[i]->name, &usual);
        accel_free(a);
        a = build_timed(&pile, kind[i]->name, &seconds);
        accel_describe(a, &info);
        const double bytes = (double)info.bytes / count;
        print_message("  %-8s %u %-9s build %6.3f s, spread out %6.3f s, %5.1f bytes each\n",
                      kind[i]->name, count, what, seconds, usual, bytes);
        assert_true(seconds <= 10 * usual + noise);
        assert_true(bytes <= 200);
        assert_int_equal(accel_validate(a, NULL), ACCEL_OK);
        check_pile(a, kind[i]->name);
        accel_free(a);
    }
    scene_free(&pile);
    scene_free(&spread);
}

static void test_triangles(void **state)
{
    (void)state;
    try_pile(ACCEL_TRIANGLES, 1000000, "triangles");
}

static void test_spheres(void **state)
{
    (void)state;
    try_pile(ACCEL_SPHERES, 200000, "spheres");
}

static void test_objects(void **state)
{
    (void)state;
    try_pile(ACCEL_OBJECTS, 200000, "objects");
}

/* No walk needs more levels than its stack has: 128 would be more than any kind allows. */
static void test_depth(void **state)
{
    (void)state;
    static const char *const scenes[] = {"nested-spheres", "nested-boxes", "nested-triangles",
                                         "series",         "sizes",        "stadium"};
    struct tested *list;
    const size_t count = tested_configs(&list);
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct test_scene s;
        scene_make(&s, scene_maker_find(scenes[i]), test_seed());
        for (size_t j = 0; j < count; j++) {
            if (strcmp(scenes[i], "stadium") == 0 && !list[j].standard)
                continue;
            accel_info info;
            accel *a = must_build(&s, list[j].config);
            accel_describe(a, &info);
            if (info.depth > 128)
                fail_msg("%s on %s: depth %u", list[j].config, scenes[i], info.depth);
            assert_int_equal(accel_validate(a, NULL), ACCEL_OK);
            accel_free(a);
        }
        scene_free(&s);
    }
    free(list);
}

static double work(const accel *a, const struct test_scene *s)
{
    struct dice d = dice_from(test_seed(), 61);
    accel_query q = {.user = NULL};
    accel_hit hit;
    for (uint64_t i = 0; i < 400; i++) {
        const accel_ray ray = ray_families->make(s, a, &d, i);
        accel_closest(a, &ray, &hit, &q);
    }
    return (double)(q.nodes + q.tests) / 400;
}

/* A dense spot in a wide scene: what adapts keeps within ten times the best; a plain grid cannot,
 * but its memory is bounded. */
static void test_stadium(void **state)
{
    (void)state;
    struct test_scene s;
    double steps[32], best = (double)INFINITY;
    size_t kinds;
    const accel_kind_info *const *kind = accel_kinds(&kinds);
    scene_make(&s, scene_maker_find("stadium"), test_seed());
    for (size_t i = 0; i < kinds; i++) {
        accel_info info;
        accel *a = must_build(&s, kind[i]->name);
        accel_describe(a, &info);
        steps[i] = work(a, &s);
        best = fmin(best, steps[i]);
        print_message("  %-8s %8.1f nodes and tests per ray, %.1f bytes each\n", kind[i]->name,
                      steps[i], (double)info.bytes / (double)info.primitives);
        assert_true((double)info.bytes <= 400 * (double)info.primitives);
        accel_free(a);
    }
    for (size_t i = 0; i < kinds; i++)
        if (strcmp(kind[i]->name, "linear") != 0 && strcmp(kind[i]->name, "grid") != 0)
            assert_true(steps[i] <= 10 * best);
    scene_free(&s);
}

/* Many small structures: nothing is left of any. */
static void test_many(void **state)
{
    (void)state;
    struct test_scene s;
    size_t kinds;
    struct pool pool = {.most = SIZE_MAX};
    const accel_hooks hooks = {.user = &pool, .resize = pool_resize};
    const accel_kind_info *const *kind = accel_kinds(&kinds);
    scene_make(&s, scene_maker_find("one-triangle"), 1);
    for (uint64_t i = 0; i < scaled_count(20000); i++) {
        accel *a;
        assert_int_equal(accel_build(&a, &s.scene, kind[i % kinds]->name, &hooks, NULL), ACCEL_OK);
        accel_free(a);
    }
    assert_int_equal(pool.held, 0);
    assert_true(pool.peak < 1 << 20);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_triangles), cmocka_unit_test(test_spheres),
        cmocka_unit_test(test_objects),   cmocka_unit_test(test_depth),
        cmocka_unit_test(test_stadium),   cmocka_unit_test(test_many),
    };
    return cmocka_run_group_tests_name("limits", tests, NULL, NULL);
}
