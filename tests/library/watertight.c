/* SPDX-License-Identifier: Apache-2.0
 *
 * No ray slips through a mesh whose triangles share the values of their vertices: closed ones from
 * inside, open ones away from their border, aimed at every vertex, along every edge and anywhere.
 */
#include <stdlib.h>
#include <string.h>

#include "cmocka_all.h"
#include "compare.h"
#include "leaks.h"

/* Rays for one structure of a mesh. */
struct share {
    uint64_t count; /* so many */
    uint64_t all;   /* evenly out of so many, which are at every corner and every edge */
};

/* The first leak ends the test. */
static uint64_t shoot(const accel *a, const char *config, const struct leak_mesh *m,
                      const struct test_scene *s, uint64_t seed, struct share share)
{
    struct rng d = rng_from(seed, 41);
    uint64_t shot = 0;
    for (uint64_t i = 0; i < share.count; i++) {
        accel_ray ray;
        if (!leak_ray(m, s, &d, i * share.all / share.count, &ray))
            continue;
        accel_hit hit;
        shot++;
        if (!accel_closest(a, &ray, &hit, NULL) || !accel_any(a, &ray, NULL))
            fail_msg("%s, %s (seed %llu): leak: ray %a %a %a  %a %a %a", config, m->scene,
                     (unsigned long long)seed, ray.org[0], ray.org[1], ray.org[2], ray.dir[0],
                     ray.dir[1], ray.dir[2]);
    }
    return shot;
}

/* At least `rays`, and all where that is not many more. Of a large mesh all for auto and the first
 * seed, but below intensity 1, and for each seed a part of `rays` for the other structures; linear
 * sees what takes it no longer than them. */
static struct share share(const char *config, uint64_t triangles, uint64_t rays, bool first)
{
    enum { PARTS = 5 };
    const uint64_t all = LEAK_ROUNDS * triangles > rays ? LEAK_ROUNDS * triangles : rays;
    if (strcmp(config, "linear") == 0 && triangles > 1000)
        return (struct share){1 + 10000000 / triangles, all};
    if (all <= 2 * rays || (first && test_intensity() >= 1 && strcmp(config, "auto") == 0))
        return (struct share){all, all};
    return (struct share){rays / PARTS + 1, all};
}

/* Below intensity 1 the seeds take turns; the rays of each are scaled as well. */
static void try_mesh(const struct leak_mesh *m, uint64_t seeds, uint64_t rays)
{
    struct tested *list;
    const size_t count = tested_configs(&list);
    uint64_t shot = 0, tried = 0;
    for (uint64_t i = 0; i < seeds; i++) {
        struct test_scene s;
        if (!takes_turn(i))
            continue;
        tried++;
        leak_make(&s, m, test_seed() + i);
        for (size_t k = 0; k < count; k++) {
            if (!list[k].form)
                continue;
            accel *a = must_build(&s, list[k].config);
            shot += shoot(a, list[k].config, m, &s, test_seed() + i,
                          share(list[k].config, scene_size(&s), rays, i == 0));
            accel_free(a);
        }
        scene_free(&s);
    }
    free(list);
    print_message("  %-14s scale %-6g shift %-8g %8llu rays, no leak\n", m->scene, m->scale,
                  m->shift, (unsigned long long)shot);
    assert_true(shot > tried * rays / 2);
}

static void test_closed(void **state)
{
    (void)state;
    for (const struct leak_mesh *m = leak_balls; m->scene; m++)
        try_mesh(m, 1, scaled_count(10000));
}

static void test_fans(void **state)
{
    (void)state;
    try_mesh(&leak_fan, 62, scaled_count(1000));
}

static void test_open(void **state)
{
    (void)state;
    try_mesh(&leak_terrain, 2, scaled_count(10000));
}

static void test_squares(void **state)
{
    (void)state;
    for (const struct leak_mesh *m = leak_squares; m->scene; m++)
        try_mesh(m, 10, scaled_count(10000));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_closed),
        cmocka_unit_test(test_fans),
        cmocka_unit_test(test_open),
        cmocka_unit_test(test_squares),
    };
    return cmocka_run_group_tests_name("watertight", tests, NULL, NULL);
}
