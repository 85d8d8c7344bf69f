/* SPDX-License-Identifier: Apache-2.0
 *
 * Would a broken structure show in accel report? Structures that lie on purpose, each in another
 * way, are examined beside honest ones.
 */
#include "report/report_exam.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static accel *build(const accel_scene *scene, const char *config)
{
    accel *a;
    accel_error error = {.text = ""};
    if (accel_build(&a, scene, config, NULL, &error) != ACCEL_OK) {
        fail_msg("%s: %s", config, error.text);
    }
    return a;
}

static struct exam examine(const char *scene)
{
    struct exam e;
    const struct exam_subject on = {.maker = scene_maker_find(scene), .family = ray_families};
    assert_true(exam_make(&e, on, 0.0, 300, 300));
    assert_int_equal(e.set.count, 300);
    assert_true(e.decided > 50);
    return e;
}

/* Every kind over the scene itself. */
static void honest(const struct exam *e)
{
    size_t kinds;
    const accel_kind_info *const *kind = accel_kinds(&kinds);
    for (size_t k = 0; k < kinds; k++) {
        struct bench_contender c = exam_ours(build(&e->scene->scene, kind[k]->name), "honest");
        assert_int_equal(exam_wrong(e, &c), 0);
        c.end(&c);
    }
}

/* A structure over a scene whose vertices are a last bit off: only t and its bits tell. */
static void nudged(const struct exam *e, const char *scene)
{
    struct test_scene s;
    scene_make(&s, scene_maker_find(scene), 1);
    for (uint32_t i = 0; i < 9 * s.part[0].count; i++) {
        s.part[0].data[i] = nextafter(s.part[0].data[i], 1e300);
    }
    struct bench_contender c = exam_ours(build(&s.scene, "linear"), "nudged");
    assert_true(exam_wrong(e, &c) > e->decided / 10);
    c.end(&c);
    scene_free(&s);
}

/* A structure that has lost a tenth of the scene. */
static void lossy(const struct exam *e, const char *scene)
{
    struct test_scene s;
    scene_make(&s, scene_maker_find(scene), 1);
    s.geometry[0].triangles.count -= s.geometry[0].triangles.count / 10;
    struct bench_contender c = exam_ours(build(&s.scene, "linear"), "lossy");
    assert_true(exam_wrong(e, &c) > 0);
    c.end(&c);
    scene_free(&s);
}

/* A peer that names the first primitive for every ray, and one that names none. */
static accel_id name_first(const struct bench_contender *c, const struct ray_set *set, size_t i)
{
    (void)c;
    (void)set;
    (void)i;
    return (accel_id){0, 0};
}

static accel_id name_none(const struct bench_contender *c, const struct ray_set *set, size_t i)
{
    (void)c;
    (void)set;
    (void)i;
    return (accel_id){ACCEL_NONE, ACCEL_NONE};
}

static void peers(const struct exam *e)
{
    const struct bench_contender first = {.peer = true, .ask = name_first};
    const struct bench_contender none = {.peer = true, .ask = name_none};
    assert_true(exam_wrong(e, &first) > e->decided / 2);
    assert_true(exam_wrong(e, &none) > e->decided / 10);
    assert_true(exam_wrong_single(e, &first) > e->decided_single / 2);
}

static void oracle(void **state)
{
    (void)state;
    static const char *const scenes[] = {"shards", "scale-1e-12", "shift-1e6"};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct exam e = examine(scenes[i]);
        assert_int_equal(e.judge, BY_ORACLE);
        honest(&e);
        nudged(&e, scenes[i]);
        lossy(&e, scenes[i]);
        peers(&e);
        exam_free(&e);
    }
}

/* A mesh with a triangle missing leaks. */
static void leaks(void **state)
{
    (void)state;
    struct exam e;
    const size_t rays = LEAK_ROUNDS * 2048;
    assert_true(exam_make(&e, (struct exam_subject){.leaks = leak_balls}, 0.0, rays, rays));
    assert_int_equal(e.judge, BY_HIT);
    honest(&e);
    struct test_scene s;
    leak_make(&s, leak_balls, 1);
    s.geometry[0].triangles.count--;
    struct bench_contender c = exam_ours(build(&s.scene, "linear"), "leaky");
    assert_true(exam_wrong(&e, &c) > 0);
    c.end(&c);
    scene_free(&s);
    const struct bench_contender none = {.peer = true, .ask = name_none};
    assert_int_equal(exam_wrong(&e, &none), e.set.count);
    exam_free(&e);
}

/* Scenes with host objects are judged by linear. */
static void objects(void **state)
{
    (void)state;
    struct exam e = examine("mixed");
    assert_int_equal(e.judge, BY_LINEAR);
    assert_false(e.peers);
    honest(&e);
    const struct bench_contender none = exam_ours(build(&(accel_scene){NULL, 0}, "linear"), "none");
    assert_true(exam_wrong(&e, &none) > 0);
    accel_free(none.state);
    exam_free(&e);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(oracle),
        cmocka_unit_test(leaks),
        cmocka_unit_test(objects),
    };
    return cmocka_run_group_tests_name("report", tests, NULL, NULL);
}
