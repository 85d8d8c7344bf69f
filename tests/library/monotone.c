/* SPDX-License-Identifier: Apache-2.0
 *
 * What the proof of exactness rests on, tried on random and extreme numbers in every rounding mode,
 * with and without flushing of subnormal numbers: a larger box has a larger interval S, the padded
 * box contains the box, and the walk's faster box test meets all that S meets.
 */
#include <fenv.h>
#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "hoo/boxtree.h"
#include "cmocka_all.h"
#include "compare.h"
#include "modes.h"

/* Any magnitude up to the largest coordinate, small integers, and the ends of double. */
static double extreme(struct rng *d)
{
    const double sign = rng_chance(d, 0.5) ? 1 : -1;
    switch (rng_below(d, 6)) {
    case 0:
        return sign * rng_below(d, 5);
    case 1:
        return sign * rng_power(d, -3, 4);
    case 2:
        return sign * rng_power(d, -1074, -1000);
    case 3:
        return sign * rng_power(d, 980, 1000);
    case 4:
        return sign * rng_power(d, -1074, 1000);
    default:
        return sign * (rng_chance(d, 0.5) ? 0.0 : rng_chance(d, 0.5) ? DBL_MIN : 0x1p-1074);
    }
}

static double near_by(struct rng *d, double x)
{
    const double inf = (double)INFINITY;
    switch (rng_below(d, 4)) {
    case 0:
        return x;
    case 1:
        return nextafter(x, rng_chance(d, 0.5) ? inf : -inf);
    case 2:
        return x * (1.0 + rng_range(d, -1e-14, 1e-14));
    default:
        return extreme(d);
    }
}

static accel_box random_box(struct rng *d)
{
    accel_box b;
    for (int k = 0; k < 3; k++) {
        const double x = extreme(d), y = near_by(d, x);
        b.lo[k] = fmin(x, y);
        b.hi[k] = fmax(x, y);
    }
    return b;
}

/* Some sides further out. */
static accel_box larger_box(struct rng *d, const accel_box *b)
{
    accel_box l = *b;
    for (int k = 0; k < 3; k++) {
        l.lo[k] = fmin(l.lo[k], near_by(d, l.lo[k]));
        l.hi[k] = fmax(l.hi[k], near_by(d, l.hi[k]));
    }
    return l;
}

/* A ray may start and point anywhere that is finite. */
static double largest(struct rng *d)
{
    const double x = rng_chance(d, 0.5) ? DBL_MAX : rng_power(d, 1018, 1024);
    return rng_chance(d, 0.5) ? x : -x;
}

static double origin(struct rng *d, double lo, double hi)
{
    if (rng_chance(d, 0.1))
        return largest(d);
    return rng_chance(d, 0.4) ? extreme(d) : near_by(d, rng_chance(d, 0.5) ? lo : hi);
}

/* As accel_closest prepares it. */
static void prepare(struct query *q, struct rng *d, const accel_box *b)
{
    memset(q, 0, sizeof *q);
    for (int k = 0; k < 3; k++) {
        q->org[k] = origin(d, b->lo[k], b->hi[k]);
        q->dir[k] = rng_chance(d, 0.1) ? largest(d) : extreme(d);
        const bool negative = q->dir[k] < 0, parallel = q->dir[k] == 0;
        q->inv[k] = parallel ? 0.0 : query_inverse(q->dir[k]);
        q->parallel |= (uint32_t)parallel << k;
        q->sign |= (uint32_t)negative << k;
        q->near[k] = (uint8_t)(negative ? k + 3 : k);
    }
    q->tmin = rng_chance(d, 0.6) ? 0.0 : extreme(d);
    q->tmax = rng_chance(d, 0.6) ? (double)INFINITY : extreme(d);
    q->limit = (double)INFINITY;
}

static void print_case(const char *what, const struct mode *m, const struct query *q,
                       const accel_box *small, const accel_box *large)
{
    fprintf(stderr, "%s, rounding %s\n  ray %a %a %a  %a %a %a  %a %a, limit %a\n", what, m->name,
            q->org[0], q->org[1], q->org[2], q->dir[0], q->dir[1], q->dir[2], q->tmin, q->tmax,
            q->limit);
    for (int i = 0; i < 2; i++) {
        const accel_box *b = i ? large : small;
        fprintf(stderr, "  box %a %a %a  %a %a %a\n", b->lo[0], b->lo[1], b->lo[2], b->hi[0],
                b->hi[1], b->hi[2]);
    }
}

static bool contains(struct interval large, struct interval small)
{
    return !(small.a <= small.z) || (large.a <= small.a && small.z <= large.z);
}

/* S of the larger contains S of the smaller. */
__attribute__((noinline)) static bool grows(const struct query *q, const accel_box *small,
                                            const accel_box *large)
{
    return contains(query_box(q, large), query_box(q, small));
}

/* May a hit lie in the box? Its key is in S, in the open interval, and not beyond the limit. */
static bool may_hold_hit(const struct query *q, const accel_box *b)
{
    const struct interval s = query_box(q, b);
    return s.a <= s.z && s.z > q->tmin && s.a < q->tmax && s.a <= q->limit && q->limit > q->tmin;
}

/* Wherever a hit may lie, the pair test of a tree's walk goes as well. */
__attribute__((noinline)) static bool pair_meets(const struct query *q, const accel_box *small,
                                                 const accel_box *large)
{
    struct boxtree_node node;
    double begin[2];
    if (!query_common(q))
        return true;
    boxtree_set(&node, 0, small, (struct boxtree_child){0, 1});
    boxtree_set(&node, 1, large, (struct boxtree_child){0, 1});
    const struct boxtree_ray ray = boxtree_ray_from(q);
    const uint32_t meets = boxtree_meets(&ray, &node, begin);
    const bool must[2] = {may_hold_hit(q, small), may_hold_hit(q, large)};
    /* On the way down, and when it comes back from the stack. */
    for (int i = 0; i < 2; i++)
        if (must[i] && (!(meets >> i & 1) || begin[i] > query_cap(q)))
            return false;
    return true;
}

/* A limit at or next to where one of the boxes begins. */
static void set_limit(struct query *q, struct rng *d, const accel_box *b)
{
    const struct interval s = query_box(q, b);
    if (rng_chance(d, 0.7) && !isnan(s.a))
        q->limit = rng_chance(d, 0.5) ? s.a : near_by(d, s.a);
}

/* Counts violations in one mode; nothing of cmocka runs while the mode is set. */
static uint64_t try_mode(const struct mode *m, uint64_t count)
{
    uint64_t wrong = 0;
    struct rng d = rng_from(test_seed(), (uint64_t)(m - modes));
    for (uint64_t i = 0; i < count; i++) {
        struct query q;
        const accel_box small = random_box(&d), large = larger_box(&d, &small);
        accel_box padded = box_padded(&small);
        const char *what = NULL;
        __asm__ volatile("" : "+m"(padded)); /* made before the mode is set, not after */
        mode_enter(m);
        prepare(&q, &d, &small);
        if (!grows(&q, &small, &large))
            what = "a larger box has a smaller interval";
        if (!box_contains(&padded, &small))
            what = "a padded box is smaller than its box";
        set_limit(&q, &d, rng_chance(&d, 0.5) ? &small : &large);
        if (!pair_meets(&q, &small, &large))
            what = "a box that may hold a hit is not visited";
        mode_leave();
        if (what && wrong++ == 0)
            print_case(what, m, &q, &small, &large);
    }
    return wrong;
}

static void test_monotone(void **state)
{
    (void)state;
    uint64_t wrong = 0;
    for (size_t m = 0; m < MODES; m++)
        wrong += try_mode(&modes[m], scaled_count(400000));
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_monotone)};
    return cmocka_run_group_tests_name("monotone", tests, NULL, NULL);
}
