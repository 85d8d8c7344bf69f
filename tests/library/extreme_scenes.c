/* SPDX-License-Identifier: Apache-2.0
 *
 * Sizes and shapes that break builders: many primitives in one place, nests and series without
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
    struct rng d = rng_from(1, 1);
    scene_open(s);
    struct part *p = scene_part(s, type);
    for (uint32_t i = 0; i < count; i++) {
        double x[6] = {0.25, 0.25, 0.25, 1.0, 1.0, 1.0};
        for (int k = 0; spread && k < 3; k++)
            x[k] = 100 * rng_unit(&d);
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

/* What was built, whatever the machine: nodes, leaves and references. */
static double size_of(const accel_info *info)
{
    return (double)(info->nodes + info->leaves + info->references);
}

/* A pile against as many primitives spread out: no more than ten times the time and the parts. */
static void try_pile(accel_type type, uint32_t count, const char *what)
{
    struct test_scene pile, spread;
    struct tested *list;
    const size_t configs = tested_configs(&list);
    make_pile(&pile, type, count, false);
    make_pile(&spread, type, count, true);
    for (size_t i = 0; i < configs; i++) {
        double seconds, usual;
        accel_info info, usual_info;
        if (!list[i].form)
            continue;
        accel *a = build_timed(&spread, list[i].config, &usual);
        accel_describe(a, &usual_info);
        accel_free(a);
        a = build_timed(&pile, list[i].config, &seconds);
        accel_describe(a, &info);
        const double bytes = (double)info.bytes / count;
        print_message("  %-18s %u %-9s build %6.3f s, spread out %6.3f s, %5.1f bytes each\n",
                      list[i].config, count, what, seconds, usual, bytes);
        assert_true(seconds <= 10 * usual + noise);
        assert_true(size_of(&info) <= 10 * size_of(&usual_info) + 1000);
        assert_true(bytes <= 200);
        assert_int_equal(accel_validate(a, NULL), ACCEL_OK);
        check_pile(a, list[i].config);
        accel_describe(a, &info);
        assert_true((double)info.bytes / count <= 200); /* what rays have built, too */
        accel_free(a);
    }
    free(list);
    scene_free(&pile);
    scene_free(&spread);
}

static void test_triangles(void **state)
{
    (void)state;
    try_pile(ACCEL_TRIANGLES, 200000, "triangles");
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
                                         "series",         "sizes",        "speck"};
    struct tested *list;
    const size_t count = tested_configs(&list);
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct test_scene s;
        scene_make(&s, scene_maker_find(scenes[i]), test_seed());
        for (size_t j = 0; j < count; j++) {
            if (strcmp(scenes[i], "speck") == 0 && !list[j].standard)
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

enum { MOST_CONFIGS = 128 };

/* Nodes and tests of a ray, on the average. */
static double work(const accel *a, const struct test_scene *s, const struct ray_family *family,
                   uint64_t count)
{
    struct rng d = rng_from(test_seed(), 61);
    accel_query q = {.user = NULL};
    accel_hit hit;
    for (uint64_t i = 0; i < count; i++) {
        const accel_ray ray = family->make(&s->target, a, &d, i);
        accel_closest(a, &ray, &hit, &q);
    }
    return (double)(q.nodes + q.tests) / (double)count;
}

/* A dense spot in a wide scene: what adapts keeps within ten times bvh; a plain grid cannot, but
 * its memory is bounded. */
static void test_stadium(void **state)
{
    (void)state;
    struct test_scene s;
    struct tested *list;
    const size_t configs = tested_configs(&list);
    scene_make(&s, scene_maker_find("speck"), test_seed());
    accel *bvh = must_build(&s, "bvh");
    const double best = work(bvh, &s, ray_families, 2000);
    for (size_t i = 0; i < configs; i++) {
        accel_info info;
        if (!list[i].form || strcmp(list[i].config, "linear") == 0)
            continue;
        accel *a = must_build(&s, list[i].config);
        accel_describe(a, &info);
        const double steps = work(a, &s, ray_families, 2000);
        print_message("  %-18s %8.1f nodes and tests per ray, %.1f bytes each\n", list[i].config,
                      steps, (double)info.bytes / (double)info.primitives);
        assert_true((double)info.bytes <= 400 * (double)info.primitives);
        assert_true(steps <= 10 * best || strcmp(list[i].config, "grid") == 0);
        accel_free(a);
    }
    accel_free(bvh);
    free(list);
    scene_free(&s);
}

/* Rays of zeros, subnormal and huge numbers, infinities and NaN, over all of their scenes, take at
 * most 10 times the work of the mix, in each structure: 2.5, but for wide trees with triangles that
 * are cut, whose boxes are grown for the farthest of these rays (wide_split.h): 5.1 with AVX2, and
 * 7.4 where few rays are asked. */
static void test_special(void **state)
{
    (void)state;
    struct tested *list;
    const size_t configs = tested_configs(&list);
    const struct ray_family *special = ray_family_find("special");
    double usual[MOST_CONFIGS] = {0}, extreme[MOST_CONFIGS] = {0};
    assert_true(configs <= MOST_CONFIGS);
    for (size_t i = 0; special->scenes[i]; i++) {
        struct test_scene s;
        scene_make(&s, scene_maker_find(special->scenes[i]), test_seed());
        for (size_t j = 0; j < configs; j++) {
            if (!list[j].form)
                continue;
            accel *a = must_build(&s, list[j].config);
            usual[j] += work(a, &s, ray_families, scaled_count(2000));
            extreme[j] += work(a, &s, special, scaled_count(2 * 4913));
            accel_free(a);
        }
        scene_free(&s);
    }
    for (size_t j = 0; j < configs; j++)
        if (extreme[j] > 10 * usual[j])
            fail_msg("%s: %.1f nodes and tests for special rays, %.1f for others", list[j].config,
                     extreme[j], usual[j]);
    free(list);
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
        cmocka_unit_test(test_stadium),   cmocka_unit_test(test_special),
        cmocka_unit_test(test_many),
    };
    return cmocka_run_group_tests_name("extreme_scenes", tests, NULL, NULL);
}
