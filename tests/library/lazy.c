/* SPDX-License-Identifier: Apache-2.0
 *
 * Structures that grow while rays come: what is built depends on where rays went and on nothing
 * else, and where they went everywhere it is what an eager build makes. As many rays as that takes,
 * at any intensity: below 1 it is scenes, rules and modes that take turns.
 */
#include <stdlib.h>
#include <string.h>

#include "cmocka_all.h"
#include "compare.h"
#include "modes.h"

enum { RAYS = 400 };

static accel_info describe(const accel *a)
{
    accel_info info;
    accel_describe(a, &info);
    return info;
}

static void must_be_valid(const accel *a, const char *config)
{
    accel_error error;
    if (accel_validate(a, &error) != ACCEL_OK)
        fail_msg("%s: %s", config, error.text);
}

/* One ray of the mixed family, by all four queries. */
static void shoot(const struct test_scene *s, const accel *a, uint64_t i)
{
    struct rng d = rng_from(test_seed(), i);
    const accel_ray ray = ray_families->make(&s->target, a, &d, i);
    ask(a, &ray, true);
}

static bool same_cells(const accel_info *a, const accel_info *b)
{
    return a->nodes == b->nodes && a->leaves == b->leaves && a->references == b->references &&
           a->depth == b->depth;
}

/* ------------------------------------------------------------- the eager structure ---- */

/* Shoots until all is built. */
static void become_eager(const struct test_scene *s, const char *rule, const char *part,
                         const struct mode *mode)
{
    enum { PATIENCE = 60 };
    char config[120];
    snprintf(config, sizeof config, "hoo:form=classic,lazy=off%s%s", *rule ? "," : "", rule);
    accel *eager = must_build(s, config);
    snprintf(config, sizeof config, "hoo:lazy=on,part=%s%s%s", part, *rule ? "," : "", rule);
    accel *lazy = must_build(s, config);
    const accel_info goal = describe(eager);
    accel_info now = describe(lazy);
    assert_int_equal(now.unbuilt_clusters, now.clusters);
    assert_int_equal(now.leaves, 0);
    for (uint64_t turn = 0; turn < PATIENCE && !same_cells(&now, &goal); turn++) {
        mode_enter(mode);
        for (uint64_t i = 0; i < RAYS; i++)
            shoot(s, lazy, turn * RAYS + i);
        mode_leave();
        must_be_valid(lazy, config);
        now = describe(lazy);
    }
    if (!same_cells(&now, &goal) || now.unbuilt_clusters > 0 || now.unbuilt_primitives > 0)
        fail_msg("%s, rounding %s: %llu nodes, %llu leaves, %llu references, depth %u, %llu "
                 "primitives not built; eager: %llu, %llu, %llu, %u",
                 config, mode->name, (unsigned long long)now.nodes, (unsigned long long)now.leaves,
                 (unsigned long long)now.references, now.depth,
                 (unsigned long long)now.unbuilt_primitives, (unsigned long long)goal.nodes,
                 (unsigned long long)goal.leaves, (unsigned long long)goal.references, goal.depth);
    accel_free(eager);
    accel_free(lazy);
}

static void test_becomes_eager(void **state)
{
    (void)state;
    if (!kind_is_there("hoo"))
        skip();
    static const char *const scenes[] = {"shards",     "mixed",   "lattice",
                                         "ball-mesh",  "slivers", "twins",
                                         "copies-512", "terrain", "scale-1e-300"};
    static const char *const rules[] = {"", "leaf=3", "depth=5", "leaf=2,depth=7",
                                        "connectivity=0"};
    static const char *const parts[] = {"1", "30", "1000000000"};
    uint64_t turn = 0;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct test_scene s;
        scene_make(&s, scene_maker_find(scenes[i]), test_seed());
        for (size_t r = 0; r < sizeof rules / sizeof *rules; r++)
            for (size_t p = 0; p < sizeof parts / sizeof *parts; p++)
                if (takes_turn(turn++))
                    become_eager(&s, rules[r], parts[p], &modes[0]);
        scene_free(&s);
    }
}

/* The mode of the rays that build must not matter. */
static void test_modes(void **state)
{
    (void)state;
    if (!kind_is_there("hoo"))
        skip();
    static const char *const scenes[] = {"shards", "scale-1e-310"};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct test_scene s;
        scene_make(&s, scene_maker_find(scenes[i]), test_seed());
        for (size_t m = 0; m < MODES; m++)
            if (takes_turn(m))
                become_eager(&s, "", "1", &modes[m]);
        scene_free(&s);
    }
}

/* -------------------------------------------------------------- the order of rays ---- */

static accel_info shoot_in_order(const struct test_scene *s, const char *config, uint64_t step)
{
    accel *a = must_build(s, config);
    for (uint64_t i = 0; i < RAYS; i++)
        shoot(s, a, i * step % RAYS);
    must_be_valid(a, config);
    const accel_info info = describe(a);
    accel_free(a);
    return info;
}

/* What a ray enters does not depend on what others have built. */
static void test_order(void **state)
{
    (void)state;
    if (!kind_is_there("hoo"))
        skip();
    static const char *const configs[] = {"hoo:lazy=on", "hoo:lazy=on,part=1",
                                          "hoo:lazy=on,part=20"};
    struct test_scene s;
    scene_make(&s, scene_maker_find("shards-20k"), test_seed());
    for (size_t i = 0; i < sizeof configs / sizeof *configs; i++) {
        const accel_info first = shoot_in_order(&s, configs[i], 1);
        const accel_info other = shoot_in_order(&s, configs[i], 171);
        assert_true(same_cells(&first, &other));
        assert_int_equal(first.bytes, other.bytes);
        assert_int_equal(first.lazy_bytes, other.lazy_bytes);
        assert_int_equal(first.unbuilt_primitives, other.unbuilt_primitives);
        assert_int_equal(first.unbuilt_clusters, other.unbuilt_clusters);
        assert_true(first.lazy_bytes > 0);
    }
    scene_free(&s);
}

/* --------------------------------------------------------------- what is not built ---- */

enum { LEFT_BALL = 2048, RIGHT_BALL = 512 };

/* Two balls far apart. */
static void make_balls(struct test_scene *s)
{
    static const double left[3] = {0, 0, 0}, right[3] = {100, 0, 0};
    scene_open(s);
    struct part *p = scene_part(s, ACCEL_TRIANGLES);
    ball_mesh(p, left, 1.0, 4);
    ball_mesh(p, right, 1.0, 3);
    scene_close(s);
}

static bool ignore_hit(void *user, const accel_hit *hit)
{
    (void)user;
    (void)hit;
    return true;
}

static bool ignore_id(void *user, accel_id id)
{
    (void)user;
    (void)id;
    return true;
}

/* Asks by one of the four queries. */
static void ask_by(const accel *a, int which, const double org[3])
{
    static const double dir[3] = {0.01, 0.02, 1};
    const accel_ray ray = accel_ray_from(org, dir);
    accel_hit hit;
    switch (which) {
    case 0:
        accel_closest(a, &ray, &hit, NULL);
        break;
    case 1:
        accel_any(a, &ray, NULL);
        break;
    case 2:
        accel_all(a, &ray, ignore_hit, NULL, NULL);
        break;
    default:
        accel_point(a, org, ignore_id, NULL, NULL);
        break;
    }
}

/* Each query builds the cluster that it enters, and no other. */
static void test_share(void **state)
{
    (void)state;
    if (!kind_is_there("hoo"))
        skip();
    static const double nowhere[3] = {50, 0, 0}, left[3] = {0, 0, 0}, right[3] = {100, 0, 0};
    struct test_scene s;
    make_balls(&s);
    for (int which = 0; which < 4; which++) {
        struct pool pool = {.most = SIZE_MAX};
        const accel_hooks hooks = {.user = &pool, .resize = pool_resize};
        accel *a;
        assert_int_equal(accel_build(&a, &s.scene, "hoo:lazy=on", &hooks, NULL), ACCEL_OK);
        const accel_info start = describe(a);
        assert_int_equal(start.clusters, 2);
        assert_int_equal(start.unbuilt_clusters, 2);
        assert_int_equal(start.unbuilt_primitives, LEFT_BALL + RIGHT_BALL);
        assert_int_equal(start.lazy_bytes, 0);
        ask_by(a, which, nowhere);
        assert_int_equal(describe(a).unbuilt_clusters, 2);
        ask_by(a, which, left);
        const accel_info half = describe(a);
        assert_int_equal(half.unbuilt_clusters, 1);
        assert_int_equal(half.unbuilt_primitives, RIGHT_BALL);
        assert_int_equal(half.bytes, start.bytes + half.lazy_bytes);
        assert_int_equal(half.bytes, pool.held);
        must_be_valid(a, "hoo:lazy=on");
        ask_by(a, which, right);
        const accel_info end = describe(a);
        assert_int_equal(end.unbuilt_clusters, 0);
        assert_int_equal(end.unbuilt_primitives, 0);
        assert_int_equal(end.bytes, pool.held);
        assert_true(end.lazy_bytes > half.lazy_bytes && half.lazy_bytes > 0);
        assert_non_null(strstr(end.notes[end.note_count - 1], "0 of 2 clusters"));
        accel_free(a);
        assert_int_equal(pool.held, 0);
        assert_int_equal(pool.blocks, 0);
    }
    scene_free(&s);
}

/* A part that rays went by stays unbuilt; each primitive is counted once, however many cells list
 * it. */
static void test_parts(void **state)
{
    (void)state;
    if (!kind_is_there("hoo"))
        skip();
    struct test_scene s;
    scene_make(&s, scene_maker_find("shards-20k"), test_seed());
    accel *a = must_build(&s, "hoo:lazy=on,part=100");
    uint64_t before = 20000, bytes = 0;
    for (uint64_t i = 0; i < 40; i++) {
        const double org[3] = {-1, 0.025 * (double)i, 0.3}, dir[3] = {1, 0.001, 0.002};
        const accel_ray ray = accel_ray_from(org, dir);
        ask(a, &ray, true);
        const accel_info info = describe(a);
        assert_true(info.unbuilt_primitives <= before && info.lazy_bytes >= bytes);
        before = info.unbuilt_primitives;
        bytes = info.lazy_bytes;
        if (i == 0)
            assert_true(before > 10000 && before < 20000);
    }
    accel_free(a);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_becomes_eager), cmocka_unit_test(test_modes),
        cmocka_unit_test(test_order),         cmocka_unit_test(test_share),
        cmocka_unit_test(test_parts),
    };
    return cmocka_run_group_tests_name("lazy", tests, NULL, NULL);
}
