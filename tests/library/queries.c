/* SPDX-License-Identifier: Apache-2.0
 *
 * What queries promise, for every kind: open intervals, refused rays, skipped primitives, visitors
 * that stop, counters, and what callbacks see and may do.
 */
#include <stdlib.h>
#include <string.h>

#include "cmocka_all.h"
#include "compare.h"

static struct tested *list;
static size_t list_count;

static int make_list(void **state)
{
    (void)state;
    list_count = tested_configs(&list);
    return 0;
}

static int free_list(void **state)
{
    (void)state;
    free(list);
    return 0;
}

/* Runs `test` for every config over a scene of the catalogue. */
static void for_all(const char *name, void (*test)(const accel *a, const struct test_scene *s))
{
    struct test_scene s;
    scene_make(&s, scene_maker_find(name), 1);
    for (size_t i = 0; i < list_count; i++) {
        accel *a = must_build(&s, list[i].config);
        test(a, &s);
        accel_free(a);
    }
    scene_free(&s);
}

/* ------------------------------------------------------------- the rays ---- */

static bool legal(const accel_ray *r)
{
    bool zero = true;
    for (int k = 0; k < 3; k++) {
        zero = zero && r->dir[k] == 0;
        if (!isfinite(r->org[k]) || !isfinite(r->dir[k]))
            return false;
    }
    return !zero && !isnan(r->tmin) && !isnan(r->tmax);
}

static bool count_hit(void *user, const accel_hit *hit)
{
    (void)hit;
    ++*(uint32_t *)user;
    return true;
}

/* A refused ray costs nothing: no node, no test. */
static void refused(const accel *a, const accel_ray *ray)
{
    accel_query q = {.user = NULL};
    accel_hit hit;
    uint32_t visited = 0;
    assert_false(accel_closest(a, ray, &hit, &q));
    assert_int_equal(q.refused, 1);
    assert_false(accel_any(a, ray, &q));
    assert_int_equal(q.refused, 2);
    assert_true(accel_all(a, ray, count_hit, &visited, &q));
    assert_int_equal(q.refused, 3);
    assert_int_equal(visited, 0);
    assert_int_equal(q.nodes, 0);
    assert_int_equal(q.tests, 0);
    assert_false(accel_closest(a, ray, &hit, NULL));
}

static void try_special(const accel *a, const struct test_scene *s)
{
    struct rng d = rng_from(1, 1);
    uint64_t bad = 0;
    const uint64_t count = 5000;
    for (uint64_t i = 0; i < count; i++) {
        const accel_ray ray = ray_family_find("special")->make(&s->target, a, &d, i);
        accel_query q = {.user = NULL};
        accel_hit hit;
        bad += !legal(&ray);
        if (!legal(&ray))
            refused(a, &ray);
        else
            accel_closest(a, &ray, &hit, &q);
        assert_int_equal(q.refused, 0);
    }
    assert_true(bad > count / 10 && bad < count);
}

static void test_special(void **state)
{
    (void)state;
    for_all("scale-1", try_special);
}

static uint64_t work(const accel *a, const struct test_scene *s, const struct ray_family *family)
{
    struct rng d = rng_from(1, 1);
    accel_query q = {.user = NULL};
    accel_hit hit;
    for (uint64_t i = 0; i < 9826; i++) {
        const accel_ray ray = family->make(&s->target, a, &d, i);
        accel_closest(a, &ray, &hit, &q);
    }
    return q.nodes + q.tests;
}

/* Special directions are not a way to make queries slow. */
static void try_work(const accel *a, const struct test_scene *s)
{
    const uint64_t normal = work(a, s, ray_families);
    const uint64_t odd = work(a, s, ray_family_find("special"));
    accel_info info;
    accel_describe(a, &info);
    if ((double)odd > 2.5 * (double)normal)
        fail_msg("%s: special rays visit and test %llu, the mix %llu", info.config,
                 (unsigned long long)odd, (unsigned long long)normal);
}

static void test_work(void **state)
{
    (void)state;
    for_all("shards", try_work);
}

static void try_ends(const accel *a, const struct test_scene *s)
{
    const double inf = (double)INFINITY;
    struct rng d = rng_from(2, 2);
    uint32_t hits = 0;
    for (uint64_t i = 0; i < 500; i++) {
        accel_ray ray = ray_families->make(&s->target, a, &d, i);
        accel_hit hit, again;
        if (!accel_closest(a, &ray, &hit, NULL))
            continue;
        hits++;
        ray.tmax = hit.t;
        assert_false(accel_closest(a, &ray, &again, NULL));
        ray.tmax = nextafter(hit.t, inf);
        assert_true(accel_closest(a, &ray, &again, NULL));
        assert_memory_equal(&again, &hit, sizeof hit);
        ray.tmax = inf;
        ray.tmin = hit.t;
        if (accel_closest(a, &ray, &again, NULL))
            assert_true(again.t > hit.t);
        ray.tmin = nextafter(hit.t, -inf);
        assert_true(accel_closest(a, &ray, &again, NULL));
        assert_memory_equal(&again, &hit, sizeof hit);
        ray.tmin = hit.t;
        ray.tmax = nextafter(hit.t, inf);
        assert_false(accel_any(a, &ray, NULL));
        ray.tmin = ray.tmax;
        ray.tmax = hit.t;
        assert_false(accel_any(a, &ray, NULL));
    }
    assert_true(hits > 50);
}

static void test_ends(void **state)
{
    (void)state;
    for_all("scale-1", try_ends);
}

/* t may be negative, from minus infinity on. */
static void test_behind(void **state)
{
    (void)state;
    const double x[4] = {0, 0, -5, 1}, org[3] = {0, 0, 0}, dir[3] = {0, 0, 2};
    const accel_geometry g = {.type = ACCEL_SPHERES, .spheres = {.spheres = x, .count = 1}};
    for (size_t i = 0; i < list_count; i++) {
        accel *a;
        accel_hit hit;
        accel_ray ray = accel_ray_from(org, dir);
        assert_int_equal(accel_build(&a, &(accel_scene){&g, 1}, list[i].config, NULL, NULL),
                         ACCEL_OK);
        assert_false(accel_any(a, &ray, NULL));
        ray.tmin = -(double)INFINITY;
        assert_true(accel_closest(a, &ray, &hit, NULL));
        assert_true(hit.t == -3.0);
        ray.tmin = -3.0;
        assert_true(accel_closest(a, &ray, &hit, NULL));
        assert_true(hit.t == -2.0);
        ray.tmin = -2.0;
        assert_false(accel_any(a, &ray, NULL));
        accel_free(a);
    }
}

/* Of a sphere that is left from its very middle neither root is farther; the sign of the 0 that
 * tells them apart depends on the direction, and must not show. */
static void test_middle(void **state)
{
    (void)state;
    const double x[4] = {3, -2, 5, 1};
    const accel_geometry g = {.type = ACCEL_SPHERES, .spheres = {.spheres = x, .count = 1}};
    for (size_t i = 0; i < list_count; i++) {
        accel *a;
        assert_int_equal(accel_build(&a, &(accel_scene){&g, 1}, list[i].config, NULL, NULL),
                         ACCEL_OK);
        for (int way = 0; way < 27; way++) {
            const double dir[3] = {way % 3 - 1, way / 3 % 3 - 1, way / 9 - 1};
            accel_ray ray = accel_ray_from(x, dir);
            assert_int_equal(accel_any(a, &ray, NULL), way != 13);
            ray.skip = (accel_id){0, 0};
            assert_false(accel_any(a, &ray, NULL));
            assert_false(accel_closest(a, &ray, NULL, NULL));
        }
        accel_free(a);
    }
}

/* ----------------------------------------------------------- skip, visitors ---- */

struct hits {
    accel_hit at[KEPT];
    uint32_t count, most;
};

static bool store(void *user, const accel_hit *hit)
{
    struct hits *h = user;
    h->at[h->count++] = *hit;
    return h->count < h->most;
}

static bool in_order(const accel_hit *a, const accel_hit *b)
{
    return a->t < b->t ||
           (a->t == b->t && (a->geom < b->geom || (a->geom == b->geom && a->prim < b->prim)));
}

static void try_skip(const accel *a, const struct test_scene *s)
{
    struct rng d = rng_from(3, 3);
    for (uint64_t i = 0; i < 200; i++) {
        accel_ray ray = ray_families->make(&s->target, a, &d, i);
        struct hits with = {.most = KEPT}, without = {.most = KEPT};
        accel_all(a, &ray, store, &with, NULL);
        if (with.count == 0)
            continue;
        ray.skip = (accel_id){with.at[0].geom, with.at[0].prim};
        accel_all(a, &ray, store, &without, NULL);
        uint32_t kept = 0;
        for (uint32_t j = 0; j < with.count; j++)
            if (with.at[j].geom != ray.skip.geom || with.at[j].prim != ray.skip.prim)
                assert_memory_equal(&with.at[j], &without.at[kept++], sizeof(accel_hit));
        assert_int_equal(kept, without.count);
        assert_int_equal(accel_any(a, &ray, NULL), kept > 0);
    }
}

static void test_skip(void **state)
{
    (void)state;
    for_all("ball-mesh", try_skip);
}

/* An id that does not exist skips nothing. */
static void try_skip_none(const accel *a, const struct test_scene *s)
{
    static const accel_id odd[] = {
        {ACCEL_NONE, 0}, {0, ACCEL_NONE}, {ACCEL_NONE, ACCEL_NONE}, {7, 0}, {0, 1000000}};
    struct rng d = rng_from(4, 4);
    for (uint64_t i = 0; i < 60; i++) {
        accel_ray ray = ray_families->make(&s->target, a, &d, i);
        const struct answer plain = ask(a, &ray, true);
        for (size_t j = 0; j < sizeof odd / sizeof *odd; j++) {
            ray.skip = odd[j];
            const struct answer same = ask(a, &ray, true);
            assert_true(same_answer(&plain, &same));
        }
    }
}

static void test_skip_none(void **state)
{
    (void)state;
    for_all("scale-1", try_skip_none);
}

static void try_stop(const accel *a, const struct test_scene *s)
{
    struct rng d = rng_from(5, 5);
    uint32_t longest = 0;
    for (uint64_t i = 0; i < 12; i++) {
        const accel_ray ray = ray_families->make(&s->target, a, &d, i);
        struct hits all = {.most = KEPT};
        accel_all(a, &ray, store, &all, NULL);
        longest = all.count > longest ? all.count : longest;
        for (uint32_t j = 1; j < all.count; j++)
            assert_true(in_order(&all.at[j - 1], &all.at[j]));
        for (uint32_t most = 1; most <= all.count && most < 130; most += most < 30 ? 29 : 1) {
            struct hits some = {.most = most};
            assert_false(accel_all(a, &ray, store, &some, NULL));
            assert_int_equal(some.count, most);
            assert_memory_equal(some.at, all.at, most * sizeof *some.at);
        }
    }
    assert_true(longest > 40);
}

/* Longer than one of the library's batches. */
static void test_stop(void **state)
{
    (void)state;
    for_all("copies-512", try_stop);
    for_all("nested-spheres", try_stop);
}

struct ids {
    accel_id at[KEPT];
    uint32_t count;
};

static bool store_id(void *user, accel_id id)
{
    struct ids *h = user;
    h->at[h->count++] = id;
    return h->count < KEPT;
}

static bool holds(const accel_box *b, const double p[3])
{
    for (int k = 0; k < 3; k++)
        if (!(b->lo[k] <= p[k] && p[k] <= b->hi[k]))
            return false;
    return true;
}

/* Boxes are closed: their own corners count. */
static void try_points(const accel *a, const struct test_scene *s)
{
    struct rng d = rng_from(6, 6);
    for (int i = 0; i < 200; i++) {
        const accel_id at = {0, rng_below(&d, s->part[0].count)};
        accel_box box;
        double p[3];
        if (!accel_padded_box(a, at, &box))
            continue;
        for (int k = 0; k < 3; k++)
            p[k] = rng_chance(&d, 0.5) ? box.lo[k] : box.hi[k];
        struct ids found = {.count = 0};
        uint32_t next = 0;
        accel_point(a, p, store_id, &found, NULL);
        for (uint32_t j = 0; j < s->part[0].count; j++)
            if (accel_padded_box(a, (accel_id){0, j}, &box) && holds(&box, p)) {
                assert_true(next < found.count);
                assert_int_equal(found.at[next++].prim, j);
            }
        assert_int_equal(next, found.count);
        assert_true(next > 0);
    }
    const double nowhere[3] = {(double)NAN, 0, 0};
    accel_query q = {.user = NULL};
    assert_true(accel_point(a, nowhere, store_id, NULL, &q));
    assert_int_equal(q.refused, 1);
}

static void test_points(void **state)
{
    (void)state;
    for_all("scale-1", try_points);
}

/* --------------------------------------------------------------- callbacks ---- */

/* What one object reports, and what came back. */
struct script {
    double t[4];
    uint32_t count;
    bool counted[4];
    uint32_t calls;
    const accel_ray *ray;
    accel_query *query;
    double limit;
};

static void act(accel_probe *probe)
{
    struct script *s = (struct script *)probe->user + probe->prim;
    s->calls++;
    s->ray = probe->ray;
    s->query = probe->query;
    s->limit = probe->limit;
    for (uint32_t i = 0; i < s->count; i++)
        s->counted[i] = accel_report(probe, s->t[i], (double)i, (double)probe->prim);
}

/* Two objects at z = 1..2 and z = 3..4, seen from the origin along z. */
/* A point in one of a thousand boxes that do not touch: a structure leads there. */
static void test_point_cost(void **state)
{
    (void)state;
    enum { SIDE = 10, COUNT = SIDE * SIDE * SIDE };
    accel_box boxes[COUNT];
    for (int i = 0; i < COUNT; i++) {
        const double at[3] = {i % SIDE, i / SIDE % SIDE, i / (SIDE * SIDE)};
        for (int k = 0; k < 3; k++) {
            boxes[i].lo[k] = at[k] + 0.25;
            boxes[i].hi[k] = at[k] + 0.75;
        }
    }
    const accel_geometry g = {.type = ACCEL_OBJECTS,
                              .objects = {boxes, COUNT, ACCEL_ORDER_KEY, act, NULL, 0}};
    size_t kinds;
    const accel_kind_info *const *kind = accel_kinds(&kinds);
    for (size_t i = 0; i < kinds; i++) {
        accel *a;
        accel_info info;
        assert_int_equal(accel_build(&a, &(accel_scene){&g, 1}, kind[i]->name, NULL, NULL),
                         ACCEL_OK);
        accel_describe(a, &info);
        struct ids found = {.count = 0};
        accel_query q = {.user = NULL};
        accel_point(a, (const double[3]){4.5, 5.5, 3.5}, store_id, &found, &q);
        assert_true(found.count == 1 && found.at[0].prim == 354);
        assert_true(strcmp(info.kind, "linear") == 0 || (q.tests <= 32 && q.nodes <= 64));
        accel_free(a);
    }
}

static const accel_box two_boxes[2] = {{{-1, -1, 1}, {1, 1, 2}}, {{-1, -1, 3}, {1, 1, 4}}};

static accel_ray along_z(void)
{
    const double org[3] = {0, 0, 0}, dir[3] = {0, 0, 1};
    return accel_ray_from(org, dir);
}

static accel *build_script(const char *config, struct script *script, accel_order how)
{
    const accel_geometry g = {.type = ACCEL_OBJECTS,
                              .objects = {two_boxes, 2, how, act, script, 0}};
    accel *a;
    assert_int_equal(accel_build(&a, &(accel_scene){&g, 1}, config, NULL, NULL), ACCEL_OK);
    return a;
}

static void test_callback(void **state)
{
    (void)state;
    for (size_t i = 0; i < list_count; i++) {
        struct script script[2] = {{{1.5, 1.25, 1.75}, 3, {false}, 0, NULL, NULL, 0},
                                   {{3.5}, 1, {false}, 0, NULL, NULL, 0}};
        accel *a = build_script(list[i].config, script, ACCEL_ORDER_KEY);
        accel_query q = {.user = script};
        const accel_ray ray = along_z();
        accel_hit hit;
        assert_true(accel_closest(a, &ray, &hit, &q));
        assert_true(hit.t == 1.25 && hit.u == 1.0 && hit.v == 0.0 && hit.prim == 0);
        assert_true(script[0].counted[0] && script[0].counted[1] && !script[0].counted[2]);
        assert_ptr_equal(script[0].ray, &ray);
        assert_ptr_equal(script[0].query, &q);
        assert_true(q.tests >= 1);
        accel_free(a);
    }
}

/* Reports that are no hits: NaN, the ends of the interval, what lies outside it. */
static void test_ignored(void **state)
{
    (void)state;
    for (int how = 0; how < 2; how++) {
        for (size_t i = 0; i < list_count; i++) {
            struct script script[2] = {{.t = {(double)NAN, 0.5, 9, -9}, .count = 4},
                                       {.t = {3.0, 3.75}, .count = 2}};
            accel *a = build_script(list[i].config, script, (accel_order)how);
            accel_ray ray = along_z();
            ray.tmin = 3.0;
            ray.tmax = 3.75;
            assert_false(accel_any(a, &ray, NULL));
            ray.tmax = nextafter(3.75, 4);
            accel_hit hit;
            assert_true(accel_closest(a, &ray, &hit, NULL));
            assert_true(hit.t == 3.75 && hit.u == 1.0 && hit.prim == 1);
            ray.tmin = 0.75; /* the first box lies in the interval, its reports do not */
            ray.tmax = 2.75;
            assert_false(accel_any(a, &ray, NULL));
            accel_free(a);
        }
    }
}

/* By key, a lie is ordered within its box; what is handed out is what was reported. By t as
 * reported, a hit before its box is counted. */
static void test_lies(void **state)
{
    (void)state;
    for (size_t i = 0; i < list_count; i++) {
        struct script script[2] = {{.t = {1.5}, .count = 1}, {.t = {0.5}, .count = 1}};
        const accel_ray ray = along_z();
        accel_hit hit;
        accel *a = build_script(list[i].config, script, ACCEL_ORDER_KEY);
        assert_true(accel_closest(a, &ray, &hit, NULL));
        assert_true(hit.prim == 0 && hit.t == 1.5);
        struct hits all = {.most = KEPT};
        accel_all(a, &ray, store, &all, NULL);
        assert_int_equal(all.count, 2);
        assert_true(all.at[1].prim == 1 && all.at[1].t == 0.5);
        accel_free(a);
        a = build_script(list[i].config, script, ACCEL_ORDER_RAW);
        accel_query q = {.user = NULL};
        struct hits raw = {.most = KEPT};
        accel_all(a, &ray, store, &raw, &q);
        assert_int_equal(q.outside, 1);
        assert_int_equal(raw.count, 2);
        assert_true(raw.at[0].prim == 1 && raw.at[0].t == 0.5);
        accel_free(a);
    }
}

/* A hit with t == limit may matter: the lower id wins a tie, whoever is asked first. */
static void test_limit(void **state)
{
    (void)state;
    const accel_box same[2] = {two_boxes[0], two_boxes[0]};
    for (int how = 0; how < 2; how++) {
        for (size_t i = 0; i < list_count; i++) {
            struct script script[2] = {{.t = {1.5}, .count = 1}, {.t = {1.5}, .count = 1}};
            const accel_geometry g = {.type = ACCEL_OBJECTS,
                                      .objects = {same, 2, (accel_order)how, act, script, 0}};
            const accel_ray ray = along_z();
            accel *a;
            accel_hit hit;
            assert_int_equal(accel_build(&a, &(accel_scene){&g, 1}, list[i].config, NULL, NULL),
                             ACCEL_OK);
            assert_true(accel_closest(a, &ray, &hit, NULL));
            assert_int_equal(hit.prim, 0);
            assert_true(script[0].limit >= 1.5);
            accel_free(a);
        }
    }
}

/* A callback may query other structures, and its own. */
struct nested {
    const accel *other;
    const accel *own;
    int depth;
};

static void ask_inside(accel_probe *probe)
{
    struct nested *n = probe->user;
    accel_hit hit;
    accel_query q = {.user = NULL};
    if (accel_closest(n->other, probe->ray, &hit, &q))
        accel_report(probe, hit.t, 0, 0);
    if (n->depth > 0) {
        n->depth--;
        accel_any(n->own, probe->ray, probe->query);
    }
}

static void test_nested(void **state)
{
    (void)state;
    const double x[4] = {0, 0, 1.5, 0.25};
    const accel_geometry inner = {.type = ACCEL_SPHERES, .spheres = {.spheres = x, .count = 1}};
    for (size_t i = 0; i < list_count; i++) {
        struct nested n = {.depth = 3};
        const accel_geometry g = {.type = ACCEL_OBJECTS,
                                  .objects = {two_boxes, 1, ACCEL_ORDER_KEY, ask_inside, &n, 0}};
        const accel_ray ray = along_z();
        accel *a, *b;
        accel_hit hit;
        assert_int_equal(accel_build(&b, &(accel_scene){&inner, 1}, list[i].config, NULL, NULL),
                         ACCEL_OK);
        assert_int_equal(accel_build(&a, &(accel_scene){&g, 1}, list[i].config, NULL, NULL),
                         ACCEL_OK);
        n.other = b;
        n.own = a;
        assert_true(accel_closest(a, &ray, &hit, NULL));
        assert_true(hit.t == 1.25);
        accel_free(a);
        accel_free(b);
    }
}

/* The library only adds to the counters. */
static void try_counters(const accel *a, const struct test_scene *s)
{
    struct rng d = rng_from(8, 8);
    const accel_ray ray = ray_families->make(&s->target, a, &d, 1);
    accel_query once = {.user = NULL}, twice = {.nodes = 5, .tests = 6, .refused = 7};
    accel_hit hit;
    accel_closest(a, &ray, &hit, &once);
    accel_closest(a, &ray, &hit, &twice);
    accel_closest(a, &ray, &hit, &twice);
    assert_int_equal(twice.nodes, 5 + 2 * once.nodes);
    assert_int_equal(twice.tests, 6 + 2 * once.tests);
    assert_int_equal(twice.refused, 7);
    assert_true(once.tests > 0);
}

static void test_counters(void **state)
{
    (void)state;
    for_all("shards", try_counters);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_special),   cmocka_unit_test(test_work),
        cmocka_unit_test(test_ends),      cmocka_unit_test(test_behind),
        cmocka_unit_test(test_middle),    cmocka_unit_test(test_skip),
        cmocka_unit_test(test_skip_none), cmocka_unit_test(test_stop),
        cmocka_unit_test(test_points),    cmocka_unit_test(test_point_cost),
        cmocka_unit_test(test_callback),  cmocka_unit_test(test_ignored),
        cmocka_unit_test(test_lies),      cmocka_unit_test(test_limit),
        cmocka_unit_test(test_nested),    cmocka_unit_test(test_counters),
    };
    return cmocka_run_group_tests_name("queries", tests, make_list, free_list);
}
