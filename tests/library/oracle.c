/* SPDX-License-Identifier: Apache-2.0
 *
 * The library against an independent closest-hit search in 113 bits: where no rounding can change
 * the answer, every kind must give it, and t must be within the derived bound. What is left
 * undecided is counted and printed.
 */
#include "cmocka_all.h"
#include "compare.h"
#include "oracle.h"

static void complain(const char *config, const accel_ray *r, const struct judgement *j, bool hit,
                     const accel_hit *h)
{
    fprintf(stderr, "%s: ray %a %a %a  %a %a %a\n", config, r->org[0], r->org[1], r->org[2],
            r->dir[0], r->dir[1], r->dir[2]);
    fprintf(stderr, "  exact: verdict %d, %u/%u t=%.17g +- %.3g\n", (int)j->verdict, j->geom,
            j->prim, (double)j->hit.t, (double)j->hit.off);
    if (hit)
        fprintf(stderr, "  found: %u/%u t=%.17g, off by %.3g\n", h->geom, h->prim, h->t,
                (double)((quad)h->t - j->hit.t));
}

/* `generic`: only rays of the family's first sort, which of "mix" aim at nothing in particular.
 * Returns the share left undecided, or 0 where there are too few rays for a share. */
static double try_family(const char *family, const char *name, uint64_t count, bool generic)
{
    const struct ray_family *rays = ray_family_find(family);
    struct test_scene s;
    scene_make(&s, scene_maker_find(name), test_seed());
    struct forms all = build_forms(&s);
    struct rng d = rng_from(test_seed(), 21);
    uint64_t undecided = 0, hits = 0, wrong = 0;
    for (uint64_t i = 0; i < count; i++) {
        const accel_ray ray = rays->make(&s.target, all.a[0], &d, generic ? 0 : i);
        const struct judgement j = oracle_judge(&s, &ray);
        undecided += j.verdict == UNDECIDED;
        hits += j.verdict == HIT;
        for (size_t k = 0; k < all.count; k++) {
            accel_hit h;
            const bool hit = accel_closest(all.a[k], &ray, &h, NULL);
            if (!oracle_agrees(&j, hit, &h) && wrong++ == 0)
                complain(all.of[k].config, &ray, &j, hit, &h);
        }
    }
    free_forms(&all);
    scene_free(&s);
    print_message("  %-14s %-7s rays %5llu, hits %5llu, undecided %6.2f %%, wrong %llu\n", name,
                  generic ? "generic" : family, (unsigned long long)count, (unsigned long long)hits,
                  100.0 * (double)undecided / (double)count, (unsigned long long)wrong);
    assert_int_equal(wrong, 0);
    assert_true(hits > count / 50 || count < 100);
    return count < 100 ? 0 : (double)undecided / (double)count;
}

static double try_scene(const char *name, uint64_t count, bool generic)
{
    return try_family("mix", name, count, generic);
}

/* Scenes of triangles and spheres alone. */
static const char *const scenes[] = {"shards",    "sizes",     "slivers",        "scale-1e-150",
                                     "scale-1e9", "shift-1e6", "nested-spheres", "terrain",
                                     "ball-mesh", "scale-1e38"};

static void test_generic(void **state)
{
    (void)state;
    assert_true(try_scene("shards", scaled_count(5000), true) < 0.01);
    assert_true(try_scene("terrain", scaled_count(300), true) < 0.01);
    assert_true(try_scene("nested-spheres", scaled_count(300), true) < 0.01);
}

static void test_mixed(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++)
        assert_true(try_scene(scenes[i], scaled_count(1000), false) < 0.7);
    assert_true(try_scene("slivers", scaled_count(5000), false) < 0.7);
}

/* Directions so small that only their hits are in range, not the corners of what is hit. */
static void test_special(void **state)
{
    (void)state;
    try_family("special", "lattice", scaled_count(2 * 4913), false);
    try_family("special", "scale-1", scaled_count(4913), false);
    try_family("special", "nested-spheres", scaled_count(4913), false);
}

/* The quick way out never leaves where the search in 113 bits does not. */
static void test_misses(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct test_scene s;
        scene_make(&s, scene_maker_find(scenes[i]), test_seed());
        accel *linear = must_build(&s, "linear");
        struct rng d = rng_from(test_seed(), 22);
        uint64_t quick = 0, pairs = 0;
        const struct part *p = s.part;
        for (uint64_t r = 0; r < scaled_count(120) && p->type == ACCEL_TRIANGLES; r++) {
            const accel_ray ray = ray_families->make(&s.target, linear, &d, r);
            for (uint32_t k = (uint32_t)(r % 4); k < p->count; k += 4, pairs++) {
                if (exact_misses(&ray, p->data + 9 * (size_t)k)) {
                    quick++;
                    assert_int_equal(exact_triangle(&ray, p->data + 9 * (size_t)k).verdict, NO_HIT);
                }
            }
        }
        print_message("  %-14s %7llu pairs, %6.2f %% left out in double\n", scenes[i],
                      (unsigned long long)pairs, pairs ? 100.0 * (double)quick / (double)pairs : 0);
        accel_free(linear);
        scene_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_generic),
        cmocka_unit_test(test_mixed),
        cmocka_unit_test(test_special),
        cmocka_unit_test(test_misses),
    };
    return cmocka_run_group_tests_name("oracle", tests, NULL, NULL);
}
