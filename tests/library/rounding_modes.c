/* SPDX-License-Identifier: Apache-2.0
 *
 * The floating-point environment is the caller's: under every rounding mode, and with subnormal
 * numbers flushed to zero, each kind answers as linear does in that mode, and the environment is
 * left as it was. Structures built in one mode may be walked in another.
 */
#include <float.h>
#include <stdlib.h>

#include "cmocka_all.h"
#include "compare.h"
#include "modes.h"

enum { TURNS = 8 };

static void leave(const struct mode *m)
{
    if (!mode_leave_kept(m))
        fail_msg("the floating-point environment '%s' was not kept", m->name);
}

struct shots {
    uint32_t count;
    accel_ray *ray;
    struct answer *answer;
};

/* Shoots in the mode; compares with what linear said in it, or notes that. */
static uint32_t shoot(const accel *a, const struct mode *m, struct shots *r, bool judge,
                      uint32_t *first)
{
    uint32_t wrong = 0;
    mode_enter(m);
    for (uint32_t i = 0; i < r->count; i++) {
        const struct answer found = ask(a, &r->ray[i], i % 4 == 0);
        if (judge)
            r->answer[i] = found;
        else if (!r->answer[i].outside && !same_answer(&found, &r->answer[i]) && wrong++ == 0)
            *first = i;
    }
    leave(m);
    return wrong;
}

static accel *build_in(const struct mode *m, const struct test_scene *s, const char *config)
{
    accel *a;
    accel_error error;
    mode_enter(m);
    const accel_status status = accel_build(&a, &s->scene, config, NULL, &error);
    const accel_status valid = status == ACCEL_OK ? accel_validate(a, &error) : status;
    leave(m);
    if (status != ACCEL_OK || valid != ACCEL_OK)
        fail_msg("%s, built rounding %s: %s", config, m->name, error.text);
    return a;
}

/* From as far as there are doubles, along directions whose inverses are flushed to zero. */
static accel_ray huge_ray(const struct test_scene *s, struct rng *d)
{
    double org[3], dir[3];
    const uint32_t axis = rng_below(d, 3);
    const double side = rng_chance(d, 0.5) ? 1 : -1;
    for (uint32_t k = 0; k < 3; k++) {
        org[k] = s->target.box.lo[k] + rng_unit(d) * (s->target.box.hi[k] - s->target.box.lo[k]);
        dir[k] = rng_chance(d, 0.5) ? 0.0 : rng_power(d, -3, 3);
    }
    org[axis] = side * (rng_chance(d, 0.7) ? DBL_MAX : rng_power(d, 1020, 1024));
    dir[axis] = -side * rng_power(d, 1022, 1024);
    accel_ray ray = accel_ray_from(org, dir);
    ray.tmin = rng_chance(d, 0.5) ? -(double)INFINITY : -1.0;
    return ray;
}

/* Boxes are padded when they are built, so linear must be built in the same mode. Default configs
 * are tried each time, the others take turns. */
static void agree_in(const struct test_scene *s, const char *name, const struct mode *built,
                     const struct mode *walked, const struct tested *list, size_t count)
{
    struct shots r = {(uint32_t)scaled_count(120), NULL, NULL};
    r.ray = must_resize(NULL, r.count * sizeof *r.ray);
    r.answer = must_resize(NULL, r.count * sizeof *r.answer);
    struct rng d = rng_from(test_seed(), 11);
    accel *judge = build_in(built, s, "linear");
    for (uint32_t i = 0; i < r.count; i++)
        r.ray[i] =
            i % 8 == 6 ? huge_ray(s, &d) : ray_families[i % 4 == 3].make(&s->target, judge, &d, i);
    uint32_t first = 0;
    shoot(judge, walked, &r, true, &first);
    static size_t turn = 0;
    turn++;
    for (size_t i = 0; i < count; i++) {
        if (!list[i].standard && (i + turn) % TURNS != 0)
            continue;
        accel *a = build_in(built, s, list[i].config);
        const uint32_t wrong = shoot(a, walked, &r, false, &first);
        accel_free(a);
        if (wrong > 0)
            fail_msg("%s on %s, built rounding %s, walked rounding %s: %u of %u differ; ray %a %a "
                     "%a  %a %a %a",
                     list[i].config, name, built->name, walked->name, wrong, r.count,
                     r.ray[first].org[0], r.ray[first].org[1], r.ray[first].org[2],
                     r.ray[first].dir[0], r.ray[first].dir[1], r.ray[first].dir[2]);
    }
    accel_free(judge);
    free(r.ray);
    free(r.answer);
}

static void test_modes(void **state)
{
    (void)state;
    static const char *const scenes[] = {"scale-1",   "scale-1e-310", "scale-1e-300",
                                         "shift-1e9", "slivers",      "nested-spheres",
                                         "lattice",   "mixed",        "scale-1e300"};
    struct tested *list;
    const size_t count = tested_configs(&list);
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct test_scene s;
        scene_make(&s, scene_maker_find(scenes[i]), test_seed());
        for (size_t m = 0; m < MODES; m++) {
            agree_in(&s, scenes[i], &modes[m], &modes[m], list, count);
            agree_in(&s, scenes[i], &modes[0], &modes[m], list, count);
            agree_in(&s, scenes[i], &modes[m], &modes[(m + 3) % MODES], list, count);
        }
        scene_free(&s);
    }
    free(list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_modes)};
    return cmocka_run_group_tests_name("rounding_modes", tests, NULL, NULL);
}
