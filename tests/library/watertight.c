/* SPDX-License-Identifier: Apache-2.0
 *
 * No ray slips through a mesh whose triangles share the values of their vertices: closed ones from
 * inside, open ones away from their border, aimed at every vertex, along every edge and anywhere.
 */
#include <string.h>

#include "cmocka_all.h"
#include "compare.h"
#include "leaks.h"

/* Shoots at targets on every triangle in turn; the first leak ends the test. */
static uint64_t shoot(const accel *a, const char *config, const struct leak_mesh *m,
                      const struct test_scene *s, uint64_t seed, uint64_t count)
{
    struct dice d = dice_from(seed, 41);
    uint64_t shot = 0;
    for (uint64_t i = 0; i < count; i++) {
        accel_ray ray;
        if (!leak_ray(m, s, &d, i, &ray))
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

static void try_mesh(const struct leak_mesh *m, uint64_t seeds, uint64_t count)
{
    size_t kinds;
    uint64_t shot = 0;
    const accel_kind_info *const *kind = accel_kinds(&kinds);
    for (uint64_t i = 0; i < seeds; i++) {
        struct test_scene s;
        leak_make(&s, m, test_seed() + i);
        for (size_t k = 0; k < kinds; k++) {
            const bool slow = scene_size(&s) > 1000 && strcmp(kind[k]->name, "linear") == 0;
            accel *a = must_build(&s, kind[k]->name);
            shot += shoot(a, kind[k]->name, m, &s, test_seed() + i, slow ? count / 10 + 1 : count);
            accel_free(a);
        }
        scene_free(&s);
    }
    print_message("  %-14s scale %-6g shift %-8g %8llu rays, no leak\n", m->scene, m->scale,
                  m->shift, (unsigned long long)shot);
    assert_true(shot > seeds * count / 2);
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
    try_mesh(&leak_fan, 62, scaled_count(400));
}

static void test_open(void **state)
{
    (void)state;
    try_mesh(&leak_terrain, 2, scaled_count(10000));
    try_mesh(&leak_square, 10, scaled_count(4000));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_closed),
        cmocka_unit_test(test_fans),
        cmocka_unit_test(test_open),
    };
    return cmocka_run_group_tests_name("watertight", tests, NULL, NULL);
}
