/* SPDX-License-Identifier: Apache-2.0
 *
 * accel_closest_n and accel_any_n: of every kind and form, for rays of all families, batches of any
 * size are answered as their rays one by one, in every bit and count; so are the walks of wide
 * trees that have several rays under way, in trees of any size and depth.
 */
#include <stdlib.h>
#include <string.h>

#include "cmocka_all.h"
#include "compare.h"
#include "core/structure.h"
#include "modes.h"
#include "wide/wide_isa.h"

enum { MOST = 512 };

/* What is asked, and the answers of one ray after the other. */
struct singles {
    accel_ray rays[MOST];
    accel_hit hits[MOST];
    bool flags[MOST];
    size_t count, hit_count;
    accel_query closest, any; /* counts */
};

static void same_counts(const accel_query *a, const accel_query *b)
{
    assert_int_equal(a->nodes, b->nodes);
    assert_int_equal(a->tests, b->tests);
    assert_int_equal(a->refused, b->refused);
    assert_int_equal(a->outside, b->outside);
}

static void ask_singles(const accel *a, struct singles *s)
{
    s->hit_count = 0;
    s->closest = s->any = (accel_query){.user = NULL};
    for (size_t i = 0; i < s->count; i++) {
        s->hits[i] = (accel_hit){(double)INFINITY, 0, 0, ACCEL_NONE, ACCEL_NONE};
        s->hit_count += accel_closest(a, &s->rays[i], &s->hits[i], &s->closest);
        s->flags[i] = accel_any(a, &s->rays[i], &s->any);
    }
}

typedef size_t closest_n(const accel *a, const accel_ray *rays, accel_hit *hits, size_t count,
                         accel_query *query);
typedef size_t any_n(const accel *a, const accel_ray *rays, bool *flags, size_t count,
                     accel_query *query);

/* The walks with several rays under way, whatever the tree's size. */
static size_t together_closest(const accel *a, const accel_ray *rays, accel_hit *hits, size_t count,
                               accel_query *query)
{
    return a->fast->isa->closest_n(a, a->fast, rays, hits, count, query);
}

static size_t together_any(const accel *a, const accel_ray *rays, bool *flags, size_t count,
                           accel_query *query)
{
    return a->fast->isa->any_n(a, a->fast, rays, flags, count, query);
}

static void compare(const accel *a, const struct singles *s, closest_n *closest, any_n *any,
                    const char *config)
{
    static const accel_hit poison = {7, 7, 7, 7, 7};
    accel_hit hits[MOST + 1];
    bool flags[MOST + 1];
    accel_query q = {.user = NULL}, p = {.user = NULL};
    memset(flags, 7, sizeof flags);
    hits[s->count] = poison;
    assert_int_equal(closest(a, s->rays, hits, s->count, &q), s->hit_count);
    assert_int_equal(any(a, s->rays, flags, s->count, &p), s->hit_count);
    same_counts(&q, &s->closest);
    same_counts(&p, &s->any);
    for (size_t i = 0; i < s->count; i++)
        if (!same_hit(&hits[i], &s->hits[i]) || flags[i] != s->flags[i])
            fail_msg("%s: ray %zu of %zu is answered in another way in a batch", config, i,
                     s->count);
    assert_memory_equal(&hits[s->count], &poison, sizeof poison);
    assert_int_equal(*(unsigned char *)&flags[s->count], 7);
    assert_int_equal(closest(a, s->rays, NULL, s->count, NULL), s->hit_count);
    assert_int_equal(any(a, s->rays, NULL, s->count, NULL), s->hit_count);
}

/* Returns whether there is a wide tree with a walk for several rays. */
static bool compare_both(const accel *a, const struct singles *s, const char *config)
{
    compare(a, s, accel_closest_n, accel_any_n, config);
    if (a->fast)
        compare(a, s, together_closest, together_any, config);
    return a->fast != NULL;
}

static void make_rays(struct singles *s, const struct rays *rays, struct rng *d, size_t count)
{
    s->count = count;
    for (size_t i = 0; i < count; i++)
        s->rays[i] = rays_make(rays, rng_bits(d) >> 16);
}

/* Around the number of rays that are under way together, and any other. */
static const size_t counts[] = {0, 1, 2, 15, 16, 17, 33, MOST};
enum { COUNTS = sizeof counts / sizeof *counts };

static bool try_config(const struct test_scene *scene, const struct rays *rays, const char *config)
{
    accel *a = must_build(scene, config);
    struct rng d = rng_from(test_seed(), 12);
    bool together = false;
    for (uint64_t i = 0; i < COUNTS + scaled_count(3); i++) {
        struct singles s;
        make_rays(&s, rays, &d, i < COUNTS ? counts[i] : rng_below(&d, 100));
        ask_singles(a, &s);
        together = compare_both(a, &s, config);
    }
    accel_free(a);
    return together;
}

static void try_scene(const char *name, bool forms)
{
    struct test_scene scene;
    struct tested *list;
    size_t together = 0;
    const size_t count = tested_configs(&list);
    scene_make(&scene, scene_maker_find(name), test_seed());
    const struct rays rays = rays_start(&scene.scene, test_seed());
    for (size_t i = 0; i < count; i++)
        if (!forms || list[i].form)
            together += try_config(&scene, &rays, list[i].config);
    /* each of the three in each instruction set, and by default; beyond 2^300 no walk is fast */
    if (strcmp(name, "mixed") == 0 && kind_is_there("bvh"))
        assert_true(together >= 3);
    scene_free(&scene);
    free(list);
}

static void test_forms(void **state)
{
    (void)state;
    static const char *const scenes[] = {"mixed",      "exotic",      "series",    "copies-257",
                                         "degenerate", "scale-1e300", "ball-mesh", "one-triangle"};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++)
        try_scene(scenes[i], true);
}

static void test_options(void **state)
{
    (void)state;
    try_scene("mixed-key", false);
}

/* Larger than WIDE_BATCH_BYTES: the interface itself has several rays under way. */
static void test_large(void **state)
{
    (void)state;
    static const char *const configs[] = {"bvh", "bvh:isa=avx2", "bvh:isa=portable", "hoo"};
    struct test_scene scene;
    scene_make(&scene, scene_maker_find("shards-100k"), test_seed());
    const struct rays rays = rays_start(&scene.scene, test_seed());
    for (size_t i = 0; i < sizeof configs / sizeof *configs; i++) {
        if (!kind_is_there(i < 3 ? "bvh" : configs[i]))
            continue;
        accel *a = must_build(&scene, configs[i]);
        struct rng d = rng_from(test_seed(), 14);
        struct singles s;
        assert_true(a->fast->used > WIDE_BATCH_BYTES);
        make_rays(&s, &rays, &d, MOST);
        ask_singles(a, &s);
        compare_both(a, &s, configs[i]);
        accel_free(a);
    }
    scene_free(&scene);
}

/* In other rounding modes, and where subnormal numbers are flushed, rays go another way. */
static void test_modes(void **state)
{
    (void)state;
    struct test_scene scene;
    scene_make(&scene, scene_maker_find("mixed"), test_seed());
    const struct rays rays = rays_start(&scene.scene, test_seed());
    struct forms f = build_forms(&scene);
    struct rng d = rng_from(test_seed(), 13);
    for (size_t i = 0; i < f.count * MODES; i++) {
        const accel *a = f.a[i / MODES];
        const struct mode *mode = &modes[i % MODES];
        struct singles s;
        accel_hit hits[MOST];
        bool flags[MOST];
        make_rays(&s, &rays, &d, 200);
        mode_enter(mode);
        ask_singles(a, &s);
        accel_closest_n(a, s.rays, hits, s.count, NULL);
        accel_any_n(a, s.rays, flags, s.count, NULL);
        bool same = true;
        for (int pass = 0; pass < 2; pass++) {
            for (size_t j = 0; j < s.count; j++)
                same = same && same_hit(&hits[j], &s.hits[j]) && flags[j] == s.flags[j];
            if (a->fast) {
                together_closest(a, s.rays, hits, s.count, NULL);
                together_any(a, s.rays, flags, s.count, NULL);
            }
        }
        mode_leave();
        if (!same)
            fail_msg("%s, %s: a batch is answered in another way", f.of[i / MODES].config,
                     mode->name);
    }
    free_forms(&f);
    scene_free(&scene);
}

/* What there is nothing to ask of or by is refused, ray by ray. */
static void test_refused(void **state)
{
    (void)state;
    const double org[3] = {0, 0, 0}, dir[3] = {0, 0, 1}, sphere[4] = {0, 0, 5, 1};
    const accel_geometry g = {.type = ACCEL_SPHERES, .spheres = {.spheres = sphere, .count = 1}};
    const accel_ray rays[3] = {accel_ray_from(org, dir), accel_ray_from(org, org),
                               accel_ray_from(org, dir)};
    accel *a;
    accel_hit hits[3] = {{.geom = 5}, {.geom = 5}, {.geom = 5}};
    bool flags[3] = {true, true, true};
    accel_query q = {.user = NULL};
    assert_int_equal(accel_build(&a, &(accel_scene){&g, 1}, NULL, NULL, NULL), ACCEL_OK);
    assert_int_equal(accel_closest_n(a, NULL, hits, 3, &q), 0);
    assert_int_equal(q.refused, 3);
    assert_int_equal(accel_any_n(NULL, rays, flags, 3, &q), 0);
    assert_int_equal(q.refused, 6);
    for (size_t i = 0; i < 3; i++)
        assert_true(hits[i].geom == ACCEL_NONE && hits[i].t == (double)INFINITY && !flags[i]);
    assert_int_equal(accel_closest_n(a, rays, hits, 3, &q), 2);
    assert_int_equal(q.refused, 7);
    assert_true(hits[0].t == 4.0 && hits[1].geom == ACCEL_NONE && hits[2].t == 4.0);
    assert_int_equal(accel_closest_n(a, NULL, NULL, 0, &q), 0);
    assert_int_equal(accel_any_n(NULL, NULL, NULL, 0, NULL), 0);
    assert_int_equal(q.refused, 7);
    accel_free(a);
}

/* A callback tells by its ray's address which one it is; hits that it keeps so are the answers. */
struct keeper {
    const accel_ray *rays;
    double t[MOST];
};

static void report_layer(accel_probe *probe)
{
    struct keeper *k = probe->query ? probe->query->user : NULL;
    const double t = (1.0 + probe->prim - probe->ray->org[2]) / probe->ray->dir[2];
    if (accel_report(probe, t, 0, 0) && k)
        k->t[probe->ray - k->rays] = t;
}

static void test_callbacks(void **state)
{
    (void)state;
    enum { LAYERS = 300 };
    static accel_box boxes[LAYERS];
    for (int i = 0; i < LAYERS; i++)
        boxes[i] = (accel_box){{-1, -1, 0.5 + i}, {1, 1, 1.5 + i}};
    const accel_geometry g = {
        .type = ACCEL_OBJECTS,
        .objects = {.boxes = boxes, .count = LAYERS, .intersect = report_layer}};
    struct forms f = build_forms(&(struct test_scene){.scene = {&g, 1}});
    for (size_t i = 0; i < f.count; i++) {
        accel_ray rays[MOST];
        accel_hit hits[MOST];
        struct keeper k = {.rays = rays};
        accel_query q = {.user = &k};
        struct rng d = rng_from(3, 3);
        for (size_t j = 0; j < MOST; j++) {
            const double org[3] = {0.1, 0.2, 0.3 + LAYERS * rng_unit(&d)}, dir[3] = {0, 1e-4, 1};
            rays[j] = accel_ray_from(org, dir);
        }
        for (int together = 0; together < (f.a[i]->fast ? 2 : 1); together++) {
            size_t found =
                (together ? together_closest : accel_closest_n)(f.a[i], rays, hits, MOST, &q);
            assert_true(found > MOST / 2);
            for (size_t j = 0; j < MOST; j++)
                assert_true(hits[j].geom == ACCEL_NONE || k.t[j] == hits[j].t);
        }
    }
    free_forms(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_forms),   cmocka_unit_test(test_options),
        cmocka_unit_test(test_large),   cmocka_unit_test(test_modes),
        cmocka_unit_test(test_refused), cmocka_unit_test(test_callbacks),
    };
    return cmocka_run_group_tests_name("batches", tests, NULL, NULL);
}
