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
    struct crossing list[ALL_HITS];
    uint32_t count, next;
    bool wrong;
};

static bool check_hit(void *user, const accel_hit *h)
{
    struct expected *e = user;
    e->wrong |= e->next >= e->count || !crossing_is(&e->list[e->next], h);
    return ++e->next < ALL_HITS && !e->wrong;
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

/* Doubled, the triangles of these scenes have integer corners. */
static void try_scene(const char *name, double scale, uint64_t count)
{
    static struct expected e;
    const double nowhere[3] = {0, 0, 0};
    struct test_scene s;
    struct dice d = dice_from(test_seed(), 1);
    const struct scene_maker *maker = scene_maker_find(name);
    scene_open(&s);
    maker->make(&s, &d, maker->param);
    scene_move(&s, scale, nowhere);
    scene_close(&s);
    size_t kinds;
    uint64_t hits = 0;
    const accel_kind_info *const *kind = accel_kinds(&kinds);
    for (size_t k = 0; k < kinds; k++) {
        accel *a = must_build(&s, kind[k]->name);
        struct dice rays = dice_from(test_seed(), 31);
        for (uint64_t i = 0; i < count; i++) {
            struct line l;
            accel_ray ray = lattice_line(&s, &rays, &l);
            const bool backwards = dice_chance(&rays, 0.3);
            ray.tmin = backwards ? -(double)INFINITY : 0.0;
            e.count = lattice_crossings(&s, &l, backwards, e.list, ALL_HITS);
            check_ray(a, kind[k]->name, &ray, &e);
            hits += e.count;
        }
        accel_free(a);
    }
    scene_free(&s);
    assert_true(hits > kinds * count / 2);
}

static void test_lattice(void **state)
{
    (void)state;
    try_scene("lattice", 1, scaled_count(4000));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_lattice)};
    return cmocka_run_group_tests_name("lattice", tests, NULL, NULL);
}
