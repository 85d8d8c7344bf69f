/* SPDX-License-Identifier: Apache-2.0
 *
 * Does accel check find what is wrong? Every bit of an answer is changed in turn and must be seen;
 * and whole checks are run with a judge that was built over a scene in which one vertex lies one
 * ulp elsewhere, one primitive is missing, or ties go to another primitive.
 */
#include "check/check.h"

#include "scenes/ray_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { RAYS = 24000 };

static struct answers expected, got;

static const accel_hit some_hit = {1.5, 0.25, 0.5, 3, 7};

static void fill(struct answers *answers)
{
    memset(answers, 0, sizeof *answers);
    answers->found = true;
    answers->any = true;
    answers->untouched = true;
    answers->closest = some_hit;
    answers->all_count = 2;
    answers->all[0] = some_hit;
    answers->all[1] = some_hit;
    answers->all[1].t = 2.5;
    answers->point_count = 2;
    answers->point[0] = (accel_id){3, 7};
    answers->point[1] = (accel_id){4, 1};
}

static unsigned differences(bool lists)
{
    const struct question question = {.lists = lists};
    return answers_differ(&question, &expected, &got);
}

static void equal_answers_agree(void **state)
{
    (void)state;
    fill(&expected);
    fill(&got);
    assert_int_equal(differences(true), 0);
    got.all[5].prim = 1;
    got.point[5].prim = 1;
    assert_int_equal(differences(true), 0);
}

/* Changes every bit of `size` bytes at `at` in turn. */
static void each_bit_is_seen(void *at, size_t size, unsigned wanted)
{
    unsigned char *bytes = at;
    for (size_t bit = 0; bit < 8 * size; bit++) {
        bytes[bit / 8] ^= (unsigned char)(1u << bit % 8);
        assert_int_equal(differences(true), wanted);
        bytes[bit / 8] ^= (unsigned char)(1u << bit % 8);
    }
}

static void each_bit_of_a_hit_is_seen(void **state)
{
    (void)state;
    fill(&expected);
    fill(&got);
    each_bit_is_seen(&got.closest, sizeof got.closest, DIFFERS_CLOSEST);
    each_bit_is_seen(&got.all[1], sizeof got.all[1], DIFFERS_ALL);
    each_bit_is_seen(&got.all_count, 1, DIFFERS_ALL);
    each_bit_is_seen(&got.point[1], sizeof got.point[1], DIFFERS_POINT);
    each_bit_is_seen(&got.point_count, 1, DIFFERS_POINT);
    assert_int_equal(differences(true), 0);
}

static void found_and_any_are_seen(void **state)
{
    (void)state;
    fill(&expected);
    fill(&got);
    got.any = false;
    assert_int_equal(differences(false), DIFFERS_ANY);
    got.found = false;
    assert_int_equal(differences(false), DIFFERS_CLOSEST | DIFFERS_ANY);
    expected.found = false;
    assert_int_equal(differences(false), 0);
    got.untouched = false;
    assert_int_equal(differences(false), DIFFERS_CLOSEST);
}

static void lists_count_only_where_they_were_asked_for(void **state)
{
    (void)state;
    fill(&expected);
    fill(&got);
    got.all_count = 1;
    got.point[0].prim++;
    assert_int_equal(differences(false), 0);
    assert_int_equal(differences(true), DIFFERS_ALL | DIFFERS_POINT);
}

static accel *build(const struct loaded *loaded, const char *config)
{
    accel *a;
    accel_error error;
    assert_int_equal(accel_build(&a, &loaded->scene, config, NULL, &error), ACCEL_OK);
    return a;
}

static void load(struct loaded *loaded, const char *name)
{
    accel_error error;
    assert_true(load_scene(loaded, name, NULL, NULL, &error));
}

/* Runs a check of `config` over `scene` with linear over `judged_scene`. */
static void run_check(struct check *check, const char *scene, const char *config,
                      const struct loaded *judged_scene, uint64_t judged)
{
    memset(check, 0, sizeof *check);
    load(&check->loaded, scene);
    check->scene_name = scene;
    check->judge = build(judged_scene, "linear");
    check->suspects[0] =
        (struct suspect){.structure = build(&check->loaded, config), .first = UINT64_MAX};
    accel_describe(check->suspects[0].structure, &check->suspects[0].info);
    check->suspect_count = 1;
    check->rays = rays_start(&check->loaded.scene, 1);
    check->ray_count = RAYS;
    check->judged_count = judged;
    check->threads = 2;
    assert_true(check_run(check));
}

static void end_check(struct check *check)
{
    accel_free(check->suspects[0].structure);
    accel_free(check->judge);
    unload_scene(&check->loaded);
}

static struct check check;

static void equal_scenes_have_no_mismatch(void **state)
{
    (void)state;
    struct loaded same;
    load(&same, "cubes:gap=1");
    run_check(&check, "cubes:gap=1", "auto", &same, RAYS);
    assert_int_equal(check.suspects[0].mismatches, 0);
    assert_true(check.suspects[0].first == UINT64_MAX);
    assert_true(check.suspects[0].hits > RAYS / 3);
    assert_true(check.suspects[0].refused > 0);
    assert_int_equal(check_report(&check), EXIT_FINE);
    end_check(&check);
    unload_scene(&same);
}

/* The first mismatch must replay: as text and back, against the same judge. */
static void expect_mismatch(uint64_t most)
{
    const struct suspect *suspect = &check.suspects[0];
    assert_true(suspect->mismatches > 0 && suspect->mismatches <= most);
    const accel_ray ray = rays_make(&check.rays, suspect->first);
    char text[RAY_TEXT];
    accel_ray again;
    write_ray(&ray, text);
    assert_true(ray_from_text(text, &again));
    assert_memory_equal(&ray, &again, sizeof ray);
    assert_int_equal(check_replay(&check, &again), EXIT_DIFFERENT);
    assert_int_equal(check_report(&check), EXIT_DIFFERENT);
    end_check(&check);
}

static void one_ulp_of_one_vertex_is_seen(void **state)
{
    (void)state;
    struct loaded moved;
    load(&moved, "teapots");
    double *vertex = (double *)moved.geometries[9].triangles.vertices + 3 * 20;
    vertex[1] = nextafter(vertex[1], 1.0);
    run_check(&check, "teapots", "auto", &moved, RAYS);
    expect_mismatch(RAYS / 10);
    unload_scene(&moved);
}

static void one_missing_triangle_is_seen(void **state)
{
    (void)state;
    struct loaded fewer;
    load(&fewer, "cubes:gap=1");
    fewer.geometries[0].triangles.count--;
    run_check(&check, "cubes:gap=1", "auto", &fewer, RAYS);
    expect_mismatch(RAYS / 10);
    unload_scene(&fewer);
}

static void another_order_of_ties_is_seen(void **state)
{
    (void)state;
    struct loaded swapped;
    load(&swapped, "same:n=2");
    uint32_t *indices = (uint32_t *)swapped.geometries[0].triangles.indices;
    /* the judge finds no first triangle, so that the second one wins */
    indices[1] = indices[0];
    run_check(&check, "same:n=2", "auto", &swapped, RAYS);
    expect_mismatch(RAYS);
    unload_scene(&swapped);
}

static void a_sample_is_even_in_each_family(void **state)
{
    (void)state;
    check.ray_count = 12007;
    check.judged_count = 1201;
    uint64_t judged[FAMILIES] = {0}, all = 0;
    for (uint64_t i = 0; i < check.ray_count; i++) {
        const bool here = check_judged(&check, i);
        judged[i % FAMILIES] += here;
        all += here;
    }
    assert_int_equal(all, 1201);
    for (int family = 0; family < FAMILIES; family++) {
        assert_in_range(judged[family], 100, 101);
    }
}

static void rays_are_the_same_in_any_order(void **state)
{
    (void)state;
    struct loaded loaded;
    load(&loaded, "teapots");
    const struct rays rays = rays_start(&loaded.scene, 42);
    const struct rays other = rays_start(&loaded.scene, 43);
    unsigned equal = 0;
    for (uint64_t i = 0; i < 1200; i++) {
        const accel_ray first = rays_make(&rays, i);
        rays_make(&rays, 1199 - i);
        const accel_ray second = rays_make(&rays, i);
        assert_memory_equal(&first, &second, sizeof first);
        const accel_ray foreign = rays_make(&other, i);
        equal += memcmp(&first, &foreign, sizeof first) == 0;
    }
    assert_true(equal < 12);
    unload_scene(&loaded);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_answers_agree),
        cmocka_unit_test(each_bit_of_a_hit_is_seen),
        cmocka_unit_test(found_and_any_are_seen),
        cmocka_unit_test(lists_count_only_where_they_were_asked_for),
        cmocka_unit_test(equal_scenes_have_no_mismatch),
        cmocka_unit_test(one_ulp_of_one_vertex_is_seen),
        cmocka_unit_test(one_missing_triangle_is_seen),
        cmocka_unit_test(another_order_of_ties_is_seen),
        cmocka_unit_test(a_sample_is_even_in_each_family),
        cmocka_unit_test(rays_are_the_same_in_any_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
