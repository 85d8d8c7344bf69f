/* SPDX-License-Identifier: Apache-2.0
 *
 * Thousands of hits of one ray, many at one t: each is visited once, in order, against what the
 * numbers of the scene say; and how much is tested for it.
 */
#include <stdlib.h>
#include <string.h>

#include "cmocka_all.h"
#include "compare.h"

enum { MOST = 20000 };

/* What a ray along the z axis is to meet. */
struct list {
    accel_hit at[MOST];
    uint32_t count, most; /* visiting ends after `most` */
};

static struct list expected, found;

static int order_of(const void *a, const void *b)
{
    const accel_hit *x = a, *y = b;
    if (x->t != y->t)
        return x->t < y->t ? -1 : 1;
    if (x->geom != y->geom)
        return x->geom < y->geom ? -1 : 1;
    return x->prim < y->prim ? -1 : x->prim > y->prim;
}

static void expect(double t, uint32_t geom, uint32_t prim)
{
    expected.at[expected.count++] = (accel_hit){t, 0, 0, geom, prim};
}

static bool store(void *user, const accel_hit *hit)
{
    struct list *l = user;
    l->at[l->count++] = *hit;
    return l->count < l->most;
}

/* ----------------------------------------------------------------------- scenes ---- */

/* A triangle across the axis at z. */
static void across(struct part *p, uint32_t geom, double z)
{
    const double a[3] = {-4, -4, z}, b[3] = {8, -4, z}, c[3] = {-4, 8, z};
    expect(z, geom, p->count);
    part_triangle(p, a, b, c);
}

static void sphere_around(struct part *p, uint32_t geom, double z, double r)
{
    const double centre[3] = {0, 0, z};
    expect(z - r, geom, p->count);
    expect(z + r, geom, p->count);
    part_sphere(p, centre, r);
}

/* Teeth from t = from on, 1 apart. */
static void comb(struct part *p, uint32_t geom, double from, uint32_t teeth)
{
    const double data[6] = {teeth, from, from + teeth};
    const accel_box box = {{-1, -1, from}, {1, 1, from + teeth}};
    for (uint32_t i = 0; i < teeth; i++)
        expect(from + i, geom, p->count);
    part_object(p, &box, COMB, data);
}

/* Reports t, wherever its box is. */
static void stray(struct part *p, uint32_t geom, double z, double t)
{
    const double data[6] = {t};
    const accel_box box = {{-1, -1, z}, {1, 1, z + 0.5}};
    expect(t, geom, p->count);
    part_object(p, &box, STRAY, data);
}

typedef void fill(struct test_scene *s);

/* From far behind the origin to far before it. */
static void spread(struct test_scene *s)
{
    struct part *p = scene_part(s, ACCEL_TRIANGLES);
    for (int i = 0; i < 5000; i++)
        across(p, 0, (i * 1237) % 5000 - 2500);
}

/* Thousands at one place, some before, behind and between. */
static void piles(struct test_scene *s)
{
    struct part *p = scene_part(s, ACCEL_TRIANGLES);
    for (int i = 0; i < 6000; i++)
        across(p, 0, i % 7 == 0 ? i % 3 - 1 : i % 11 == 0 ? 0.25 * (i % 100) : 4);
}

/* Of exactly as many as batches hold, and one less or more. */
static void small_piles(struct test_scene *s)
{
    static const int sizes[] = {32, 31, 33, 128, 127, 512, 511, 513, 544, 1, 64, 672, 16};
    struct part *p = scene_part(s, ACCEL_TRIANGLES);
    for (int i = 0; i < 13; i++)
        for (int k = 0; k < sizes[i]; k++)
            across(p, 0, i);
}

/* Spheres in spheres, and more than once. */
static void spheres(struct test_scene *s)
{
    struct part *p = scene_part(s, ACCEL_SPHERES);
    for (int i = 0; i < 3000; i++)
        sphere_around(p, 0, 1024, i % 3 ? 512 : 1 + i % 700);
}

/* All sorts, of which some tie. */
static void mixed(struct test_scene *s)
{
    struct part *p = scene_part(s, ACCEL_OBJECTS);
    for (int i = 0; i < 3; i++)
        comb(p, 0, 100 * i, 1500);
    p = scene_part(s, ACCEL_TRIANGLES);
    for (int i = 0; i < 1500; i++)
        across(p, 1, i % 2 ? 700 : i);
    p = scene_part(s, ACCEL_SPHERES);
    for (int i = 0; i < 700; i++)
        sphere_around(p, 2, 704, i % 2 ? 4 : i + 1);
}

/* Ordered as reported: hits that lie behind their boxes, which end before. */
static void strays(struct test_scene *s)
{
    struct part *p = scene_part(s, ACCEL_OBJECTS);
    p->order = ACCEL_ORDER_RAW;
    for (int i = 0; i < 2000; i++)
        stray(p, 0, 10 + i % 50, i % 4 ? 5000 : 100 + i % 1000);
    p = scene_part(s, ACCEL_TRIANGLES);
    for (int i = 0; i < 1500; i++)
        across(p, 1, i % 5 ? i : 5000);
}

static const struct {
    const char *name;
    fill *make;
    double tests; /* for each hit at most, but by linear; 0: not told */
} scenes[] = {
    {"spread", spread, 3},   {"piles", piles, 4}, {"small piles", small_piles, 12},
    {"spheres", spheres, 8}, {"mixed", mixed, 4}, {"strays", strays, 0},
};

/* ---------------------------------------------------------------------- checking ---- */

static accel_ray axis(void)
{
    const double org[3] = {0, 0, 0}, dir[3] = {0, 0, 1};
    accel_ray ray = accel_ray_from(org, dir);
    ray.tmin = -(double)INFINITY;
    return ray;
}

static void check_list(const char *scene, const char *config)
{
    const uint32_t count = expected.count < found.most ? expected.count : found.most;
    if (found.count != count)
        fail_msg("%s on %s: %u hits, not %u", config, scene, found.count, count);
    for (uint32_t i = 0; i < count; i++)
        if (order_of(&found.at[i], &expected.at[i]) != 0)
            fail_msg("%s on %s: hit %u is %u/%u at %a, not %u/%u at %a", config, scene, i,
                     found.at[i].geom, found.at[i].prim, found.at[i].t, expected.at[i].geom,
                     expected.at[i].prim, expected.at[i].t);
}

static void check_all(const accel *a, const char *scene, const char *config, double tests)
{
    static const uint32_t stops[] = {1, 31, 32, 33, 159, 160, 161, 671, 672, 673, 1300, MOST};
    const accel_ray ray = axis();
    accel_query query = {.user = NULL};
    for (size_t i = 0; i < sizeof stops / sizeof *stops; i++) {
        found.count = 0;
        found.most = stops[i];
        query = (accel_query){.user = NULL};
        assert_int_equal(accel_all(a, &ray, store, &found, &query), expected.count < found.most);
        check_list(scene, config);
    }
    if (tests > 0 && strcmp(config, "linear") != 0 && (double)query.tests > tests * expected.count)
        fail_msg("%s on %s: %llu tests for %u hits", config, scene, (unsigned long long)query.tests,
                 expected.count);
}

/* Two hits of one primitive at one t are one. */
static void sort_expected(void)
{
    qsort(expected.at, expected.count, sizeof *expected.at, order_of);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < expected.count; i++)
        if (kept == 0 || order_of(&expected.at[kept - 1], &expected.at[i]) != 0)
            expected.at[kept++] = expected.at[i];
    expected.count = kept;
}

static void test_hits(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct test_scene s;
        expected.count = 0;
        scene_open(&s);
        scenes[i].make(&s);
        scene_close(&s);
        sort_expected();
        struct forms f = build_forms(&s);
        for (size_t k = 0; k < f.count; k++)
            check_all(f.a[k], scenes[i].name, f.of[k].config, scenes[i].tests);
        free_forms(&f);
        scene_free(&s);
    }
}

/* -------------------------------------------------------------------- primitives ---- */

struct ids {
    uint32_t next, most;
    bool wrong;
};

static bool count_id(void *user, accel_id id)
{
    struct ids *ids = user;
    ids->wrong |= id.geom != 0 || id.prim != ids->next;
    return ++ids->next < ids->most;
}

/* Boxes around one point. */
static void test_point(void **state)
{
    (void)state;
    enum { COUNT = 6000 };
    struct test_scene s;
    expected.count = 0;
    scene_open(&s);
    struct part *p = scene_part(&s, ACCEL_SPHERES);
    for (int i = 0; i < COUNT; i++)
        sphere_around(p, 0, 0, 1 + i % 100);
    scene_close(&s);
    struct forms f = build_forms(&s);
    const double at[3] = {0.5, 0.25, 0.125};
    for (size_t k = 0; k < f.count; k++) {
        accel_query query = {.user = NULL};
        for (uint32_t most = 1; most <= COUNT + 1; most += most < 700 ? 223 : 1777) {
            struct ids ids = {.most = most};
            query = (accel_query){.user = NULL};
            assert_int_equal(accel_point(f.a[k], at, count_id, &ids, &query), most > COUNT);
            assert_false(ids.wrong);
            assert_int_equal(ids.next, most < COUNT ? most : COUNT);
        }
        if (query.tests > 4 * COUNT && strcmp(f.of[k].config, "linear") != 0)
            fail_msg("%s: %llu tests", f.of[k].config, (unsigned long long)query.tests);
    }
    free_forms(&f);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hits),
        cmocka_unit_test(test_point),
    };
    return cmocka_run_group_tests_name("all", tests, NULL, NULL);
}
