/* SPDX-License-Identifier: Apache-2.0
 *
 * The bounds that the walks of wide trees rest on (wide_ray.h), for one instruction set: a node's
 * test in float passes by no child whose S may matter. The rays try to break them: they go through
 * corners and edges of boxes, where S is as short as it can be, from near and from far, steeply,
 * and with limits at the last bit. Compiled once more with each bound a little too small, the test
 * must fail: see CMakeLists.txt.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cmocka_all.h"
#include "compare.h"

#if defined(TOO_FEW_STEPS)
#define WIDE_STEPS 1
#endif
#if defined(TOO_LITTLE_PAD)
#define WIDE_PAD 0x1p-28f
#endif

/* The functions under test are static. */
#include "wide/wide_emit.c"
#include WIDE_ISA_FILE

/* Boxes of one node, as the rule sees them, and the node. */
struct boxes {
    accel_box padded[WIDE];
    struct wide_node node;
    struct wide w;
};

/* Coordinates as far out as there are, where rounding is worst, or anywhere. */
static double far_out(struct rng *d, double size)
{
    const double sign = rng_chance(d, 0.5) ? 1 : -1;
    if (rng_chance(d, 0.5))
        return sign * size * (1.0 - rng_unit(d) * rng_power(d, -24, -2));
    return sign * size * rng_unit(d) * rng_power(d, -20, 0);
}

static void make_boxes(struct boxes *b, struct rng *d)
{
    struct wide_binary nodes[WIDE];
    const struct wide_binary_tree tree = {.nodes = nodes};
    struct emitter e = {.tree = &tree};
    struct children c = {.count = WIDE};
    const double size = rng_chance(d, 0.5) ? 1.0 : rng_power(d, -200, 200);
    memset(b, 0, sizeof *b);
    b->w.scale = ldexp(1.0, -ilogb(size) - 1);
    for (uint32_t i = 0; i < WIDE; i++) {
        accel_box box;
        for (int k = 0; k < 3; k++) {
            const double at = far_out(d, size), side = size * rng_power(d, -50, -1);
            box.lo[k] = fmax(at - side, -size);
            box.hi[k] = fmin(at + side, size);
        }
        b->padded[i] = box;
        const struct wide_item item = accel_wide_item_of(&b->w, &box, i);
        memcpy(nodes[i].lo, item.lo, sizeof item.lo);
        memcpy(nodes[i].hi, item.hi, sizeof item.hi);
        c.place[i] = i;
    }
    fill_node(&e, &b->node, &c);
}

/* A point of a box: on a corner, an edge or a face, or near it. */
static void pick_target(const accel_box *box, struct rng *d, double out[3])
{
    for (int k = 0; k < 3; k++) {
        const double at = rng_chance(d, 0.8) ? (rng_chance(d, 0.5) ? box->lo[k] : box->hi[k])
                                             : rng_range(d, box->lo[k], box->hi[k]);
        out[k] = rng_chance(d, 0.5) ? at : nextafter(at, rng_chance(d, 0.5) ? 1e300 : -1e300);
    }
}

static accel_ray make_ray(const struct boxes *b, uint32_t target, struct rng *d)
{
    double to[3], org[3], dir[3];
    pick_target(&b->padded[target], d, to);
    const double size = 1.0 / b->w.scale;
    const double away = rng_chance(d, 0.3) ? rng_power(d, 0, 30) : 1.0;
    const double length = rng_chance(d, 0.5) ? 1.0 : rng_power(d, -300, 300);
    for (int k = 0; k < 3; k++) {
        org[k] = far_out(d, size) * away;
        if (rng_chance(d, 0.2))
            org[k] = to[k];
        dir[k] = to[k] - org[k];
        if (rng_chance(d, 0.1))
            dir[k] *= rng_power(d, -80, -40);
    }
    for (int k = 0; k < 3; k++)
        dir[k] = dir[k] / size * length;
    accel_ray ray = accel_ray_from(org, dir);
    return ray;
}

/* An interval that ends or begins where S does, if that is legal. */
static void narrow(accel_ray *ray, struct interval s, struct rng *d)
{
    if (rng_chance(d, 0.3) && s.z >= 0)
        ray->tmin = rng_chance(d, 0.5) ? s.z : nextafter(s.z, 0);
    if (rng_chance(d, 0.3) && s.a > 0)
        ray->tmax = rng_chance(d, 0.5) ? s.a : nextafter(s.a, (double)INFINITY);
}

static struct query query_of(const accel_ray *ray)
{
    static const accel nothing;
    struct query q;
    accel_query_prepare(&q, &nothing, ray);
    return q;
}

/* How many children are passed by that may matter. */
static uint32_t count_lost(const struct boxes *b, const accel_ray *ray, double limit, uint64_t *met)
{
    struct wide_ray r;
    struct query q = query_of(ray);
    begins where;
    _Alignas(64) uint32_t begin[WIDE];
    uint32_t lost = 0;
    if (!wide_ray_from(&r, &b->w, ray->org, ray->dir, ray->tmin))
        return 0;
    q.limit = limit;
    const struct node_ray n =
        node_ray_from(&r, wide_limit(&r, limit < ray->tmax ? limit : ray->tmax));
    const uint32_t meets = node_meets(&n, &b->node, &where);
    begins_store(&where, begin);
    for (uint32_t i = 0; i < WIDE; i++) {
        const struct interval s = query_box(&q, &b->padded[i]);
        if (!query_meets(&q, s))
            continue;
        ++*met;
        lost += !(meets >> i & 1) || begin[i] > bits_of(wide_limit(&r, limit));
    }
    return lost;
}

static void test_nodes(void **state)
{
    (void)state;
    enum { RAYS = 200 };
    struct rng d = rng_from(test_seed(), 17);
    uint64_t met = 0, lost = 0;
    if (!WIDE_ISA.works_here())
        skip();
    const uint64_t turns = scaled_count(4000);
    for (uint64_t turn = 0; turn < turns; turn++) {
        _Alignas(64) struct boxes b;
        make_boxes(&b, &d);
        for (uint32_t i = 0; i < RAYS; i++) {
            const uint32_t target = rng_below(&d, WIDE);
            accel_ray ray = make_ray(&b, target, &d);
            struct query q = query_of(&ray);
            const struct interval s = query_box(&q, &b.padded[target]);
            if (s.a <= s.z)
                narrow(&ray, s, &d);
            lost += count_lost(&b, &ray, (double)INFINITY, &met);
            lost += count_lost(&b, &ray, s.a <= s.z ? s.a : 0.0, &met);
        }
    }
    print_message("%llu children met, %llu of them lost\n", (unsigned long long)met,
                  (unsigned long long)lost);
    assert_true(met > turns * RAYS);
    assert_int_equal(lost, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_nodes)};
    return cmocka_run_group_tests_name("wide_bounds", tests, NULL, NULL);
}
