/* SPDX-License-Identifier: Apache-2.0
 *
 * Rays at the edges of an object's padded box, where the raw crossings of its sides come in either
 * order by rounding: only when grown do they tell, so a walk that compares raw ones loses hits.
 */
#include <stdlib.h>

#include "cmocka_all.h"
#include "compare.h"

static void act(accel_probe *probe)
{
    accel_report(probe, 1.0, 0.0, 0.0);
}

static accel *build(const accel_box *box, const char *config)
{
    const accel_geometry g = {.type = ACCEL_OBJECTS,
                              .objects = {box, 1, ACCEL_ORDER_KEY, act, NULL, 0}};
    accel *a;
    assert_int_equal(accel_build(&a, &(accel_scene){&g, 1}, config, NULL, NULL), ACCEL_OK);
    return a;
}

/* At a point of an edge along axis `along`; every other ray begins before its origin, as those are
 * tested another way. */
static accel_ray at_edge(const accel_box *box, int along, struct rng *d)
{
    double org[3], dir[3];
    for (int k = 0; k < 3; k++) {
        const double side = rng_chance(d, 0.5) ? box->lo[k] : box->hi[k];
        const double at = k == along ? rng_range(d, box->lo[k], box->hi[k]) : side;
        org[k] = rng_range(d, -2, 2);
        dir[k] = at - org[k];
    }
    accel_ray ray = accel_ray_from(org, dir);
    ray.tmin = rng_chance(d, 0.5) ? -1.0 : 0.0;
    return ray;
}

static void try_box(const accel_box *box, const char *config, struct rng *d)
{
    accel *judge = build(box, "linear"), *a = build(box, config);
    accel_box padded;
    assert_true(accel_padded_box(a, (accel_id){0, 0}, &padded));
    for (int i = 0; i < 60; i++) {
        const accel_ray ray = at_edge(&padded, i % 3, d);
        if (accel_any(a, &ray, NULL) != accel_any(judge, &ray, NULL))
            fail_msg("%s: from %a %a %a along %a %a %a, tmin %g", config, ray.org[0], ray.org[1],
                     ray.org[2], ray.dir[0], ray.dir[1], ray.dir[2], ray.tmin);
    }
    accel_free(judge);
    accel_free(a);
}

static void test_edges(void **state)
{
    (void)state;
    struct tested *list;
    const size_t count = tested_configs(&list);
    struct rng d = rng_from(test_seed(), 61);
    for (int i = 0; i < 20; i++) {
        accel_box box;
        for (int k = 0; k < 3; k++) {
            box.lo[k] = rng_unit(&d);
            box.hi[k] = box.lo[k] + rng_unit(&d);
        }
        for (size_t j = 0; j < count; j++)
            try_box(&box, list[j].config, &d);
    }
    free(list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_edges)};
    return cmocka_run_group_tests_name("box_edges", tests, NULL, NULL);
}
