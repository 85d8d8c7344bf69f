/* SPDX-License-Identifier: Apache-2.0
 *
 * Small integers, where double is exact: triangles with integer corners, rays through half integers
 * along directions whose ratios are powers of two. Integers alone say which triangles are hit, in
 * which order and at which t; no answer is ambiguous, at edges, at corners and on planes neither.
 */
#include "cmocka_all.h"
#include "compare.h"
#include "lattice.h"

struct expected {
    struct crossing list[KEPT];
    uint32_t count, next;
    bool wrong;
};

static bool check_hit(void *user, const accel_hit *h)
{
    struct expected *e = user;
    e->wrong |= e->next >= e->count || !crossing_is(&e->list[e->next], h);
    return ++e->next < KEPT && !e->wrong;
}

static void check_ray(const accel *a, const char *kind, const accel_ray *ray, struct expected *e)
{
    accel_hit h;
    const bool hit = accel_closest(a, ray, &h, NULL);
    e->next = 0;
    e->wrong = hit != (e->count > 0) || (hit && !crossing_is(&e->list[0], &h));
    accel_all(a, ray, check_hit, e, NULL);
    if (!e->wrong && e->next == e->count && accel_any(a, ray, NULL) == hit)
        return;
    fail_msg("%s: ray %a %a %a  %a %a %a: %u hits expected, the first %u/%u at %lld/%lld / 2; "
             "found %u/%u at %a",
             kind, ray->org[0], ray->org[1], ray->org[2], ray->dir[0], ray->dir[1], ray->dir[2],
             e->count, e->list[0].geom, e->list[0].prim, (long long)e->list[0].over,
             (long long)e->list[0].under, hit ? h.geom : 0, hit ? h.prim : 0, hit ? h.t : 0);
}

typedef accel_ray make_line(const struct test_scene *s, struct rng *d, struct line *l);

static void try_scene(const char *name, make_line *make, uint64_t count)
{
    static struct expected e;
    struct test_scene s;
    scene_make(&s, scene_maker_find(name), test_seed());
    struct forms all = build_forms(&s);
    struct rng d = rng_from(test_seed(), 31);
    uint64_t hits = 0;
    for (uint64_t i = 0; i < count; i++) {
        struct line l;
        accel_ray ray = make(&s, &d, &l);
        const bool backwards = rng_chance(&d, 0.3);
        ray.tmin = backwards ? -(double)INFINITY : 0.0;
        e.count = lattice_crossings(&s, &l, backwards, e.list, KEPT);
        for (size_t k = 0; k < all.count; k++)
            check_ray(all.a[k], all.of[k].config, &ray, &e);
        hits += e.count;
    }
    free_forms(&all);
    scene_free(&s);
    assert_true(hits > count / 2);
}

static void test_lines(void **state)
{
    (void)state;
    try_scene("lattice", lattice_line, scaled_count(20000));
}

/* From corners and edges, hence from faces, from the planes of cells and from inside of leaves. */
static void test_origins(void **state)
{
    (void)state;
    try_scene("lattice", lattice_line_on, scaled_count(20000));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lines),
        cmocka_unit_test(test_origins),
    };
    return cmocka_run_group_tests_name("lattice", tests, NULL, NULL);
}
