/* SPDX-License-Identifier: Apache-2.0
 *
 * Cases on which other ray tracers failed, as their users reported them, in every kind and form:
 * against answers that follow from the numbers, against integers, and against 113 bits where those
 * leave nothing undecided.
 */
#include <stdlib.h>
#include <string.h>

#include "cmocka_all.h"
#include "compare.h"
#include "known.h"
#include "lattice.h"
#include "oracle.h"

/* Calls a check with every kind and form over a scene. */
typedef void check_scene(const accel *a, const char *config, const struct test_scene *s,
                         const void *expected);

static void for_forms(const struct test_scene *s, check_scene *check, const void *expected)
{
    struct tested *list;
    const size_t count = tested_configs(&list);
    for (size_t i = 0; i < count; i++) {
        if (!list[i].form)
            continue;
        accel *a = must_build(s, list[i].config);
        check(a, list[i].config, s, expected);
        accel_free(a);
    }
    free(list);
}

/* Over a scene of the catalogue, whose name is what is expected. */
static void for_scene(const char *name, check_scene *check)
{
    struct test_scene s;
    scene_make(&s, scene_maker_find(name), test_seed());
    for_forms(&s, check, name);
    scene_free(&s);
}

static void check_known(const accel *a, const char *config, const struct test_scene *s,
                        const void *expected)
{
    (void)s;
    const struct known *c = expected;
    const accel_ray ray = known_ray(c);
    accel_hit hit = {.prim = 0};
    if (accel_closest(a, &ray, &hit, NULL) != c->hit)
        fail_msg("%s, %s: %s", config, c->origin, c->hit ? "missed" : "hit");
    if (c->hit && (hit.prim != c->prim || hit.t != c->t))
        fail_msg("%s, %s: triangle %u at t = %a", config, c->origin, hit.prim, hit.t);
}

static void test_cases(void **state)
{
    (void)state;
    for (const struct known *c = known_cases; c->name; c++) {
        struct test_scene s;
        known_make(&s, c);
        for_forms(&s, check_known, c);
        scene_free(&s);
    }
}

static void complain(const char *config, const char *scene, const accel_ray *r)
{
    fail_msg("%s, %s: wrong: ray %a %a %a  %a %a %a", config, scene, r->org[0], r->org[1],
             r->org[2], r->dir[0], r->dir[1], r->dir[2]);
}

/* All hits of one ray. */
struct hits {
    accel_hit at[64];
    uint32_t count;
};

static bool store(void *user, const accel_hit *hit)
{
    struct hits *h = user;
    h->at[h->count++] = *hit;
    return h->count < sizeof h->at / sizeof *h->at;
}

/* Every hit, in order, is what the integers say. */
static void check_integers(const accel *a, const char *config, const struct test_scene *s,
                           const void *expected)
{
    uint32_t hits = 0;
    for (uint32_t i = 0; i < s->target.given_count; i++) {
        struct crossing list[64];
        struct hits found = {.count = 0};
        const struct line l = lattice_line_of(&s->target.given[i]);
        const uint32_t count = lattice_crossings(s, &l, false, list, 64);
        accel_all(a, &s->target.given[i], store, &found, NULL);
        bool right = found.count == count;
        for (uint32_t j = 0; right && j < count; j++)
            right = crossing_is(&list[j], &found.at[j]);
        if (!right)
            complain(config, expected, &s->target.given[i]);
        hits += count;
    }
    assert_true(hits > s->target.given_count / 2);
}

static void test_integers(void **state)
{
    (void)state;
    static const char *const scenes[] = {"povray-fs324", "tinybvh-168"};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++)
        for_scene(scenes[i], check_integers);
}

/* Nothing is undecided: single precision leaves the bounds of double far behind. */
static void check_decided(const accel *a, const char *config, const struct test_scene *s,
                          const void *expected)
{
    uint32_t hits = 0;
    for (uint32_t i = 0; i < s->target.given_count; i++) {
        accel_hit h;
        const struct judgement j = oracle_judge(s, &s->target.given[i]);
        const bool hit = accel_closest(a, &s->target.given[i], &h, NULL);
        assert_int_not_equal(j.verdict, UNDECIDED);
        if (!oracle_agrees(&j, hit, &h))
            complain(config, expected, &s->target.given[i]);
        hits += hit;
    }
    if (strcmp(config, "linear") == 0)
        print_message("  %-12s %u rays, %u hits, nothing undecided\n", (const char *)expected,
                      s->target.given_count, hits);
    assert_true(hits > s->target.given_count / 50);
}

static void test_decided(void **state)
{
    (void)state;
    static const char *const scenes[] = {"embree-387", "embree-416", "embree-423"};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++)
        for_scene(scenes[i], check_decided);
}

/* Embree 387: a grazing ray, a thin triangle, and a t twenty times beyond all of its corners. Here
 * t stays between those at which the ray enters and leaves the triangle's padded box. */
static void test_within_box(void **state)
{
    (void)state;
    struct test_scene s;
    scene_make(&s, scene_maker_find("slivers"), test_seed());
    accel *a = must_build(&s, "linear");
    struct rng d = rng_from(test_seed(), 81);
    uint64_t hits = 0;
    for (uint64_t i = 0; i < scaled_count(20000); i++) {
        const accel_ray ray = ray_families->make(&s.target, a, &d, i % 2 ? 5 : 2);
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
        cmocka_unit_test(test_integers),
        cmocka_unit_test(test_decided),
        cmocka_unit_test(test_within_box),
    };
    return cmocka_run_group_tests_name("reported_failures", tests, NULL, NULL);
}
