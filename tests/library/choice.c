/* SPDX-License-Identifier: Apache-2.0
 *
 * What auto chooses, and why: the same every time; the host's pilot is used, whatever its rays are,
 * and decides no answer; few rays need no structure.
 */
#include <string.h>

#include "cmocka_all.h"
#include "compare.h"

enum { PILOT = 300, RAYS = 100 };

static accel_info build_auto(accel **a, const struct test_scene *s, const char *config,
                             const accel_hooks *hooks)
{
    accel_info info;
    accel_error error;
    if (accel_build(a, &s->scene, config, hooks, &error) != ACCEL_OK)
        fail_msg("%s: %s", config, error.text);
    accel_describe(*a, &info);
    return info;
}

static bool noted(const accel_info *info, const char *words)
{
    for (uint32_t i = 0; i < info->note_count; i++)
        if (strstr(info->notes[i], words))
            return true;
    return false;
}

static void expect_same_answers(const struct test_scene *s, const accel *a, const accel *b)
{
    struct rng d = rng_from(test_seed(), 3);
    for (uint64_t i = 0; i < RAYS; i++) {
        const accel_ray ray = ray_families->make(&s->target, a, &d, i);
        const struct answer x = ask(a, &ray, true), y = ask(b, &ray, true);
        assert_true(same_answer(&x, &y));
    }
}

/* Builds twice, with a pilot of this family. */
static void try_pilot(const struct test_scene *s, const accel *linear, const char *family)
{
    accel_ray pilot[PILOT];
    struct rng d = rng_from(test_seed(), 5);
    for (uint64_t i = 0; i < PILOT; i++)
        pilot[i] = ray_family_find(family)->make(&s->target, linear, &d, i);
    const accel_hooks hooks = {.pilot = pilot, .pilot_count = PILOT};
    accel *a, *b;
    const accel_info one = build_auto(&a, s, "auto", &hooks);
    const accel_info two = build_auto(&b, s, "auto", &hooks);
    assert_string_equal(one.kind, two.kind);
    assert_int_equal(one.note_count, two.note_count);
    for (uint32_t i = 0; i < one.note_count; i++)
        assert_string_equal(one.notes[i], two.notes[i]);
    assert_true(noted(&one, "rays of the host"));
    assert_true(noted(&one, "seconds for 1e+07 rays"));
    expect_same_answers(s, a, linear);
    accel_free(a);
    accel_free(b);
}

static void pilot_decides_no_answer(void **state)
{
    (void)state;
    static const char *const names[] = {"shards-20k", "mixed", "nested-spheres", "twins"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        struct test_scene s;
        scene_make(&s, scene_maker_find(names[i]), test_seed());
        accel *linear = must_build(&s, "linear"), *a;
        const accel_info none = build_auto(&a, &s, "auto", NULL);
        assert_true(noted(&none, "random rays") && !noted(&none, "rays of the host"));
        accel_free(a);
        try_pilot(&s, linear, "mix");
        try_pilot(&s, linear, "special");
        accel_free(linear);
        scene_free(&s);
    }
}

/* The pilot's counts are those of its rays: rays that look away from the scene visit nothing but
 * the root of a wide tree, except where linear is all there is. */
static void pilot_is_traced(void **state)
{
    (void)state;
    struct test_scene s;
    scene_make(&s, scene_maker_find("shards-20k"), test_seed());
    const double from[3] = {0.0, 1e3, 0.0}, away[3] = {0.0, 1.0, 0.0};
    const accel_ray ray = accel_ray_from(from, away);
    const accel_hooks hooks = {.pilot = &ray, .pilot_count = 1};
    accel *a;
    const accel_info info = build_auto(&a, &s, "auto", &hooks);
    assert_true(strcmp(info.kind, "linear") == 0 || noted(&info, ": 0 nodes, 0 tests") ||
                noted(&info, ": 1 nodes, 0 tests"));
    accel_free(a);
    scene_free(&s);
}

static void few_rays_need_nothing(void **state)
{
    (void)state;
    struct test_scene s;
    scene_make(&s, scene_maker_find("shards"), test_seed());
    accel *a;
    const accel_info info = build_auto(&a, &s, "auto:rays=1", NULL);
    assert_string_equal(info.kind, "linear");
    assert_true(noted(&info, "do not pay for a structure"));
    accel_free(a);
    scene_free(&s);
}

static void note_no_hit(accel_probe *probe)
{
    (void)probe;
}

/* Few rays over objects whose callback takes long do pay for a structure. */
static void costly_objects_need_one(void **state)
{
    (void)state;
    enum { N = 2000 };
    static accel_box boxes[N];
    struct rng d = rng_from(test_seed(), 7);
    for (size_t i = 0; i < N; i++)
        for (int k = 0; k < 3; k++) {
            boxes[i].lo[k] = rng_unit(&d);
            boxes[i].hi[k] = boxes[i].lo[k] + 0.02;
        }
    accel_geometry objects = {
        .type = ACCEL_OBJECTS,
        .objects = {.boxes = boxes, .count = N, .intersect = note_no_hit, .cost = 1e6}};
    struct test_scene s = {.scene = {&objects, 1}};
    for (int costly = 0; costly < 2; costly++) {
        accel *a;
        objects.objects.cost = costly ? 1e6 : 1.0;
        const accel_info info = build_auto(&a, &s, "auto:rays=100", NULL);
        if (kind_is_there("bvh"))
            assert_int_equal(strcmp(info.kind, "linear") != 0, costly);
        accel_free(a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pilot_decides_no_answer),
        cmocka_unit_test(pilot_is_traced),
        cmocka_unit_test(few_rays_need_nothing),
        cmocka_unit_test(costly_objects_need_one),
    };
    return cmocka_run_group_tests_name("choice", tests, NULL, NULL);
}
