/* SPDX-License-Identifier: Apache-2.0
 *
 * Small integers, where double is exact: triangles with integer corners, rays through half integers
 * along directions whose ratios are powers of two. Integers alone say which triangles are hit, in
 * which order and at which t; no answer is ambiguous, at edges, at corners and on planes neither.
 */
#include <stdlib.h>

#include "cmocka_all.h"
#include "compare.h"

/* Twice the coordinates, so that half integers are integers. */
struct line {
    int64_t org[3], dir[3];
};

/* A hit at t = over / under, under > 0, in units of the doubled origin. */
struct crossing {
    int64_t over, under;
    uint32_t geom, prim;
};

static int64_t cross_dot(const int64_t d[3], const int64_t a[3], const int64_t b[3])
{
    return d[0] * (a[1] * b[2] - a[2] * b[1]) + d[1] * (a[2] * b[0] - a[0] * b[2]) +
           d[2] * (a[0] * b[1] - a[1] * b[0]);
}

/* All coordinates are below 2^7, so that every product below stays far inside 63 bits. */
static bool crosses(const struct line *l, const double *vertices, struct crossing *c)
{
    int64_t p[3][3], e[3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            p[i][k] = (int64_t)(2 * vertices[3 * i + k]) - l->org[k];
    bool positive = false, negative = false;
    for (int i = 0; i < 3; i++) {
        e[i] = cross_dot(l->dir, p[(i + 1) % 3], p[(i + 2) % 3]);
        positive |= e[i] > 0;
        negative |= e[i] < 0;
    }
    const int64_t sum = e[0] + e[1] + e[2];
    if ((positive && negative) || sum == 0)
        return false;
    /* t d = sum of e_i p_i / sum, along any axis where d is not 0. */
    const int k = l->dir[0] ? 0 : l->dir[1] ? 1 : 2;
    const int64_t over = e[0] * p[0][k] + e[1] * p[1][k] + e[2] * p[2][k];
    const int64_t under = sum * l->dir[k];
    c->over = under < 0 ? -over : over;
    c->under = under < 0 ? -under : under;
    return true;
}

static int compare_crossings(const void *x, const void *y)
{
    const struct crossing *a = x, *b = y;
    const __int128 left = (__int128)a->over * b->under, right = (__int128)b->over * a->under;
    if (left != right)
        return left < right ? -1 : 1;
    if (a->geom != b->geom)
        return a->geom < b->geom ? -1 : 1;
    return a->prim < b->prim ? -1 : a->prim > b->prim;
}

enum { MOST = ALL_HITS };

static uint32_t all_crossings(const struct test_scene *s, const struct line *l, bool backwards,
                              struct crossing out[MOST])
{
    uint32_t count = 0;
    for (uint32_t g = 0; g < s->count; g++) {
        for (uint32_t i = 0; i < s->part[g].count && count < MOST; i++) {
            struct crossing *c = &out[count];
            if (!crosses(l, s->part[g].data + 9 * (size_t)i, c) || (!backwards && c->over <= 0))
                continue;
            c->geom = g;
            c->prim = i;
            count++;
        }
    }
    qsort(out, count, sizeof *out, compare_crossings);
    return count;
}

static accel_ray random_line(const struct test_scene *s, struct dice *d, struct line *l)
{
    double org[3], dir[3];
    bool zero = true;
    for (int k = 0; k < 3; k++) {
        const uint32_t cells = 2 * ((uint32_t)(s->box.hi[k] - s->box.lo[k]) + 4);
        l->org[k] = 2 * (int64_t)(s->box.lo[k] - 2) + (int64_t)dice_below(d, cells);
        l->dir[k] = dice_chance(d, 0.35) ? 0 : 1 << dice_below(d, 4);
        if (dice_chance(d, 0.5))
            l->dir[k] = -l->dir[k];
        zero = zero && l->dir[k] == 0;
        org[k] = (double)l->org[k] / 2;
        dir[k] = l->dir[k] ? (double)l->dir[k] : dice_chance(d, 0.5) ? 0.0 : -0.0;
    }
    if (zero) {
        l->dir[1] = 1;
        dir[1] = 1;
    }
    return accel_ray_from(org, dir);
}

struct expected {
    struct crossing list[MOST];
    uint32_t count, next;
    bool wrong;
};

/* over / under is doubled once by the origin's units; the division rounds once, as the library's
 * does. */
static bool same(const struct crossing *c, const accel_hit *h)
{
    return c->geom == h->geom && c->prim == h->prim &&
           h->t == (double)c->over / (2 * (double)c->under);
}

static bool check_hit(void *user, const accel_hit *h)
{
    struct expected *e = user;
    e->wrong |= e->next >= e->count || !same(&e->list[e->next], h);
    return ++e->next < MOST && !e->wrong;
}

static void check_ray(const accel *a, const char *kind, const accel_ray *ray, struct expected *e)
{
    accel_hit h;
    const bool hit = accel_closest(a, ray, &h, NULL);
    e->next = 0;
    e->wrong = hit != (e->count > 0) || (hit && !same(&e->list[0], &h));
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
            accel_ray ray = random_line(&s, &rays, &l);
            const bool backwards = dice_chance(&rays, 0.3);
            ray.tmin = backwards ? -(double)INFINITY : 0.0;
            e.count = all_crossings(&s, &l, backwards, e.list);
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
