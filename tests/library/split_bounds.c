/* SPDX-License-Identifier: Apache-2.0
 *
 * The bounds that cut triangles rest on (wide_split.h): the key of every hit is in S of a part. The
 * rays try to break them: they lie in the triangle's plane, so that t is anywhere; they pass a face
 * of its box by a few last bits, from far away, so that t is clamped to where the ray is far from
 * the triangle; in every rounding mode. Compiled once more with each bound too small, the test must
 * fail: see CMakeLists.txt.
 */
#include <fenv.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cmocka_all.h"
#include "compare.h"

#if defined(TOO_THIN)
#define SPLIT_SLAB(side) ((side) * (side) * (side)*0x1p-50)
#endif
#if defined(TOO_SHORT)
#define SPLIT_PAD -0x1p-22
#endif

/* The functions under test, with these bounds. */
#include "wide/wide_split.c"

#include "primitive/triangle.h"

enum { PIECES = 40 };

/* A triangle, cut. */
struct case_of {
    double vertices[9];
    accel_box padded;
    struct geometry geometry;
    struct primitives prims;
    struct wide w;
    struct wide_item item[PIECES];
};

static void make_triangle(struct case_of *c, struct rng *d)
{
    const double size = rng_chance(d, 0.5) ? 0.7 : rng_power(d, -8, -1);
    double centre[3];
    for (int k = 0; k < 3; k++)
        centre[k] = rng_range(d, -0.6, 0.6);
    for (int k = 0; rng_chance(d, 0.3) && k < 3; k++)
        centre[k] *= 0x1p-10;
    const double thin = rng_chance(d, 0.3) ? rng_power(d, -12, 0) : 1.0;
    double along[3], aside[3];
    for (int k = 0; k < 3; k++) {
        along[k] = size * rng_range(d, -0.5, 0.5);
        aside[k] = size * thin * rng_range(d, -0.5, 0.5);
        if (rng_chance(d, 0.1))
            along[k] = aside[k] = 0.0;
    }
    for (int k = 0; k < 3; k++) {
        c->vertices[k] = centre[k] - 0.5 * along[k];
        c->vertices[3 + k] = centre[k] + 0.5 * along[k];
        c->vertices[6 + k] = centre[k] + aside[k];
    }
    for (int i = 0; rng_chance(d, 0.5) && i < 9; i++)
        c->vertices[i] = (double)(float)c->vertices[i];
}

/* False: it is one that is never cut. */
static bool cut_triangle(struct case_of *c)
{
    static uint8_t pieces[1] = {PIECES};
    static uint32_t id[1] = {0};
    accel_box box = box_empty();
    for (int i = 0; i < 3; i++)
        box_add_point(&box, c->vertices + 3 * i);
    c->padded = box_padded(&box);
    c->geometry = (struct geometry){.type = ACCEL_TRIANGLES, .count = 1, .data = c->vertices};
    c->prims = (struct primitives){.geometry = &c->geometry,
                                   .geometry_count = 1,
                                   .box = &c->padded,
                                   .count = 1,
                                   .bounded = {id, 1, 1}};
    c->w = (struct wide){.scale = 1.0, .fast = true, .reach = box_longest(&c->padded)};
    const struct wide_split split = {.prims = &c->prims,
                                     .w = &c->w,
                                     .bounds = {{-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}},
                                     .pieces = pieces};
    if (wide_split_excess(c->vertices, &c->padded, 1.0, SPLIT_LEAST) == 0.0)
        return false;
    assert_int_equal(accel_wide_split_items(&split, 0, c->item), PIECES);
    return true;
}

/* A point of the triangle, also on its edges and corners. */
static void pick_point(const struct case_of *c, struct rng *d, double out[3])
{
    double a = rng_unit(d), b = rng_unit(d) * (1.0 - a);
    if (rng_chance(d, 0.3))
        b = 0.0;
    if (rng_chance(d, 0.3))
        a = rng_chance(d, 0.5) ? 0.0 : 1.0 - b;
    for (int k = 0; k < 3; k++)
        out[k] = a * c->vertices[k] + b * c->vertices[3 + k] + (1.0 - a - b) * c->vertices[6 + k];
}

/* Within the plane, but for some last bits; or away from it. */
static void pick_in_plane(const struct case_of *c, struct rng *d, double dir[3])
{
    const double a = rng_range(d, -1, 1), b = rng_range(d, -1, 1);
    const double off = rng_chance(d, 0.5) ? 0.0 : rng_power(d, -54, -10);
    for (int k = 0; k < 3; k++) {
        dir[k] =
            a * (c->vertices[3 + k] - c->vertices[k]) + b * (c->vertices[6 + k] - c->vertices[k]);
        dir[k] += off * rng_range(d, -1, 1);
    }
}

/* Past a face of the box, by little, from a corner that is on it. */
static void pick_past_face(const struct case_of *c, struct rng *d, double to[3], double dir[3],
                           double *away)
{
    const int k = (int)rng_below(d, 3);
    const double sign = rng_chance(d, 0.5) ? 1.0 : -1.0;
    *away = rng_power(d, 8, 40);
    int corner = 0;
    for (int i = 1; i < 3; i++)
        if (sign * c->vertices[3 * i + k] > sign * c->vertices[3 * corner + k])
            corner = i;
    for (int i = 0; i < 3; i++) {
        to[i] = c->vertices[3 * corner + i];
        dir[i] = 0.5 * (c->padded.lo[i] + c->padded.hi[i]) - to[i] + 0.1 * rng_range(d, -1, 1);
    }
    const double off = *away * rng_power(d, -55, -51);
    to[k] += sign * off;
    dir[k] = -sign * off * rng_power(d, -2, 8);
}

static accel_ray make_ray(const struct case_of *c, struct rng *d)
{
    double to[3], dir[3], org[3];
    double away = rng_chance(d, 0.2) ? rng_power(d, 0, 40) : rng_range(d, -3, 3);
    pick_point(c, d, to);
    if (rng_chance(d, 0.5))
        pick_in_plane(c, d, dir);
    else
        pick_past_face(c, d, to, dir, &away);
    double length = 0.0;
    for (int k = 0; k < 3; k++)
        length = fmax(length, fabs(dir[k]));
    if (length == 0.0)
        dir[0] = length = 1.0;
    for (int k = 0; k < 3; k++)
        org[k] = to[k] - away * dir[k] / length;
    accel_ray ray = accel_ray_from(org, dir);
    ray.tmin = -(double)INFINITY;
    return ray;
}

static bool holds_key(const struct case_of *c, const struct query *q, double key, double growth)
{
    for (int i = 0; i < PIECES; i++) {
        accel_box box;
        for (int k = 0; k < 3; k++) {
            box.lo[k] = (double)c->item[i].lo[k] - growth;
            box.hi[k] = (double)c->item[i].hi[k] + growth;
        }
        const struct interval s = query_box(q, &box);
        if (s.a <= key && key <= s.z)
            return true;
    }
    return false;
}

/* What was found. */
struct tally {
    uint64_t hits, clamped, elsewhere, off, lost;
};

/* Is the key farther from the plane than the slab is thick? */
static bool is_off(const struct case_of *c, const accel_ray *ray, double key)
{
    const struct split_plane p = accel_wide_split_plane(c->vertices, 1.0, &c->padded);
    long double sum = -(long double)p.offset;
    for (int k = 0; k < 3; k++)
        sum += (long double)p.normal[k] *
               ((long double)ray->org[k] + (long double)key * (long double)ray->dir[k]);
    return fabsl(sum) > (long double)p.slab;
}

/* Is it away from the triangle? By barycentric coordinates in the plane across the normal. */
static bool is_elsewhere(const struct case_of *c, const accel_ray *ray, double key)
{
    const struct split_plane p = accel_wide_split_plane(c->vertices, 1.0, &c->padded);
    const double *n = p.normal;
    double whole = 0.0;
    int k = fabs(n[1]) > fabs(n[0]) ? 1 : 0;
    k = fabs(n[2]) > fabs(n[k]) ? 2 : k;
    const int x = (k + 1) % 3, y = (k + 2) % 3;
    const double at[2] = {ray->org[x] + key * ray->dir[x], ray->org[y] + key * ray->dir[y]};
    for (int i = 0; i < 3; i++) {
        const double *a = c->vertices + 3 * i, *b = c->vertices + 3 * ((i + 1) % 3);
        whole += fabs((a[x] - at[0]) * (b[y] - at[1]) - (a[y] - at[1]) * (b[x] - at[0]));
    }
    return whole > 1.01 * fabs(n[k]);
}

/* The rule of query.h for one triangle. */
__attribute__((noinline)) static void try_ray(const struct case_of *c, const accel_ray *ray,
                                              struct tally *tally)
{
    static const accel nothing = {.prims = {.triangles = true}};
    struct query q;
    double t, u, v;
    accel_query_prepare(&q, &nothing, ray);
    if (!accel_triangle_hit(&q, c->vertices, &t, &u, &v) || isnan(t))
        return;
    const struct interval raw = query_slabs(&q, &c->padded);
    const struct interval s = query_cut(raw.a, raw.z, q.tmin, q.tmax);
    if (!(s.a <= s.z))
        return;
    const double key = t < s.a ? s.a : t > s.z ? s.z : t;
    const bool near = accel_wide_split_growth(&c->w, &q) == 0.0;
    tally->hits++;
    tally->clamped += key != t;
    tally->elsewhere += near && is_elsewhere(c, ray, key);
    tally->off += near && is_off(c, ray, key);
    tally->lost += !holds_key(c, &q, key, accel_wide_split_growth(&c->w, &q));
}

static void test_keys(void **state)
{
    (void)state;
    enum { RAYS = 400 };
    static const int modes[] = {FE_TONEAREST, FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    struct rng d = rng_from(test_seed(), 23);
    struct tally tally = {0};
    /* not fewer in small: of 10,000 hits one is clamped */
    const uint64_t turns = scaled_count(6000) > 6000 ? scaled_count(6000) : 6000;
    for (uint64_t turn = 0; turn < turns; turn++) {
        struct case_of c;
        make_triangle(&c, &d);
        const bool is_cut = cut_triangle(&c);
        for (uint32_t i = 0; is_cut && i < RAYS; i++) {
            const accel_ray ray = make_ray(&c, &d);
            const int mode = modes[rng_below(&d, sizeof modes / sizeof *modes)];
            fesetround(mode);
            try_ray(&c, &ray, &tally);
            fesetround(FE_TONEAREST);
        }
    }
    print_message("%llu hits, %llu clamped, %llu away from their triangle, %llu of those that are "
                  "near too far from its plane; %llu lost\n",
                  (unsigned long long)tally.hits, (unsigned long long)tally.clamped,
                  (unsigned long long)tally.elsewhere, (unsigned long long)tally.off,
                  (unsigned long long)tally.lost);
    assert_true(tally.hits > turns && tally.clamped > 0 && tally.elsewhere > 0);
    assert_int_equal(tally.off, 0);
    assert_int_equal(tally.lost, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_keys)};
    return cmocka_run_group_tests_name("split_bounds", tests, NULL, NULL);
}
