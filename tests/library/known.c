/* SPDX-License-Identifier: Apache-2.0
 *
 * Cases on which other ray tracers failed, as their users reported them: numbers are data of those
 * reports, answers follow from the numbers.
 */
#include <stdlib.h>

#include "cmocka_all.h"
#include "compare.h"
#include "known.h"

static void try_case(const struct known *c, const char *kind)
{
    struct test_scene s;
    known_make(&s, c);
    accel *a = must_build(&s, kind);
    const accel_ray ray = known_ray(c);
    accel_hit hit = {.prim = 0};
    if (accel_closest(a, &ray, &hit, NULL) != c->hit)
        fail_msg("%s, %s: %s", kind, c->origin, c->hit ? "missed" : "hit");
    if (c->hit && (hit.prim != c->prim || hit.t != c->t))
        fail_msg("%s, %s: triangle %u at t = %a", kind, c->origin, hit.prim, hit.t);
    accel_free(a);
    scene_free(&s);
}

static void test_cases(void **state)
{
    (void)state;
    size_t kinds;
    const accel_kind_info *const *kind = accel_kinds(&kinds);
    for (const struct known *c = known_cases; c->name; c++)
        for (size_t k = 0; k < kinds; k++)
            try_case(c, kind[k]->name);
}

/* Embree 387: a grazing ray, a thin triangle, and a t twenty times beyond all of its corners. Here
 * t stays between those at which the ray enters and leaves the triangle's padded box. */
static void test_within_box(void **state)
{
    (void)state;
    struct test_scene s;
    scene_make(&s, scene_maker_find("slivers"), test_seed());
    accel *a = must_build(&s, "linear");
    struct dice d = dice_from(test_seed(), 81);
    uint64_t hits = 0;
    for (uint64_t i = 0; i < scaled_count(20000); i++) {
        const accel_ray ray = ray_families->make(&s, a, &d, i % 2 ? 5 : 2);
        accel_hit hit;
        accel_box box;
        if (!accel_closest(a, &ray, &hit, NULL))
            continue;
        hits++;
        assert_true(accel_padded_box(a, (accel_id){hit.geom, hit.prim}, &box));
        for (int k = 0; k < 3; k++) {
            const double x = ray.org[k] + hit.t * ray.dir[k];
            const double off = 0x1p-48 * (fabs(ray.org[k]) + fabs(hit.t * ray.dir[k]));
            if (!(x >= box.lo[k] - off && x <= box.hi[k] + off))
                fail_msg("triangle %u at t = %a lies outside its box: ray %a %a %a  %a %a %a",
                         hit.prim, hit.t, ray.org[0], ray.org[1], ray.org[2], ray.dir[0],
                         ray.dir[1], ray.dir[2]);
        }
    }
    assert_true(hits > 100);
    accel_free(a);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cases),
        cmocka_unit_test(test_within_box),
    };
    return cmocka_run_group_tests_name("known", tests, NULL, NULL);
}
