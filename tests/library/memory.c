/* SPDX-License-Identifier: Apache-2.0
 *
 * accel_hooks.memory_limit: a build holds no byte more, by the count of the allocator; with what it
 * needs it succeeds, with a byte less it says what it needed. accel_estimate: exact for small
 * scenes, near from above for large ones, and it holds nothing.
 */
#include <stdlib.h>
#include <string.h>

#include "cmocka_all.h"
#include "compare.h"

static accel_status build_within(const struct test_scene *s, const char *config, size_t limit,
                                 struct pool *pool, accel_info *info, accel_error *error)
{
    *pool = (struct pool){.most = SIZE_MAX};
    const accel_hooks hooks = {.user = pool, .resize = pool_resize, .memory_limit = limit};
    accel *a;
    const accel_status status = accel_build(&a, &s->scene, config, &hooks, error);
    if (status == ACCEL_OK) {
        accel_describe(a, info);
        assert_int_equal(accel_validate(a, NULL), ACCEL_OK);
    }
    accel_free(a);
    assert_int_equal(pool->held, 0);
    assert_int_equal(pool->blocks, 0);
    return status;
}

static void refused(const struct test_scene *s, const char *config, size_t limit)
{
    struct pool pool;
    accel_info info;
    accel_error error;
    char allowed[80];
    const accel_status status = build_within(s, config, limit, &pool, &info, &error);
    snprintf(allowed, sizeof allowed, "hooks.memory_limit allows %zu bytes", limit);
    if (status != ACCEL_NO_MEMORY || error.status != status || pool.peak > limit ||
        !strstr(error.text, allowed) || !strstr(error.text, "needed") ||
        !strstr(error.text, "nothing was built"))
        fail_msg("%s within %zu bytes held %zu: %s", config, limit, pool.peak, error.text);
}

static void try_limits(const struct test_scene *s, const char *config)
{
    struct pool pool;
    accel_info whole, again;
    accel_error error;
    struct rng d = rng_from(test_seed(), 21);
    assert_int_equal(build_within(s, config, 0, &pool, &whole, &error), ACCEL_OK);
    assert_int_equal(whole.peak_bytes, pool.peak);
    assert_int_equal(build_within(s, config, pool.peak, &pool, &again, &error), ACCEL_OK);
    assert_int_equal(again.peak_bytes, pool.peak);
    assert_int_equal(again.bytes, whole.bytes);
    assert_int_equal(again.nodes, whole.nodes);
    assert_string_equal(again.kind, whole.kind);
    refused(s, config, whole.peak_bytes - 1);
    refused(s, config, 1);
    for (uint64_t i = 0; i < scaled_count(12); i++)
        refused(s, config, 1 + rng_below(&d, (uint32_t)whole.peak_bytes - 1));
}

static void test_limits(void **state)
{
    (void)state;
    static const char *const scenes[] = {"mixed",       "lattice",   "empty",
                                         "two-objects", "ball-mesh", "degenerate"};
    struct tested *list;
    const size_t count = tested_configs(&list);
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct test_scene s;
        scene_make(&s, scene_maker_find(scenes[i]), test_seed());
        for (size_t j = 0; j < count; j++)
            if (i == 0 || list[j].form)
                try_limits(&s, list[j].config);
        scene_free(&s);
    }
    free(list);
}

/* Large enough for threads, for growing arrays and for the choice of auto. */
static void test_limits_of_large(void **state)
{
    (void)state;
    struct test_scene s;
    size_t count;
    const accel_kind_info *const *kind = accel_kinds(&count);
    scene_make(&s, scene_maker_find("shards-20k"), test_seed());
    for (size_t i = 0; i < count; i++)
        try_limits(&s, kind[i]->name);
    scene_free(&s);
}

/* A build of a mesh of floats holds at most 300 bytes a triangle: 72 of vertices, 32 and 112 of the
 * binary tree, and the layout's. Boxes that are kept to the end, or room for doubles, are too much.
 */
static void test_peak(void **state)
{
    (void)state;
    enum { SIDE = 120, TRIANGLES = 2 * SIDE * SIDE };
    static const char *const kinds[] = {"bvh", "octree", "hoo"};
    float(*xyz)[3] = malloc((SIDE + 1) * (SIDE + 1) * sizeof *xyz);
    uint32_t(*abc)[3] = malloc(TRIANGLES * sizeof *abc);
    for (uint32_t i = 0; i <= SIDE; i++)
        for (uint32_t j = 0; j <= SIDE; j++)
            for (int k = 0; k < 3; k++)
                xyz[i * (SIDE + 1) + j][k] = k == 0   ? (float)i
                                             : k == 1 ? (float)j
                                                      : sinf((float)(i * j));
    for (uint32_t i = 0; i < TRIANGLES; i++) {
        const uint32_t at = i / 2 / SIDE * (SIDE + 1) + i / 2 % SIDE, side = SIDE + 1;
        abc[i][0] = i % 2 ? at + side + 1 : at;
        abc[i][1] = at + 1;
        abc[i][2] = at + side;
    }
    const accel_geometry g = {.type = ACCEL_TRIANGLES,
                              .triangles = {.vertices = xyz,
                                            .vertices_are_float = true,
                                            .vertex_count = (SIDE + 1) * (SIDE + 1),
                                            .indices = &abc[0][0],
                                            .count = TRIANGLES}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        accel *a;
        accel_info info;
        if (!kind_is_there(kinds[i]))
            continue;
        assert_int_equal(accel_build(&a, &(accel_scene){&g, 1}, kinds[i], NULL, NULL), ACCEL_OK);
        accel_describe(a, &info);
        accel_free(a);
        if (info.peak_bytes > 300 * TRIANGLES)
            fail_msg("%s: %llu bytes a triangle", kinds[i],
                     (unsigned long long)info.peak_bytes / TRIANGLES);
    }
    free(xyz);
    free(abc);
}

/* -------------------------------------------------------------------------- estimates ---- */

/* What the header says that it allocates at most, beside a small scene's structure. */
enum { LARGEST = 24 << 20, SMALL = 32768 };

static accel_size estimate(const struct test_scene *s, const char *config)
{
    struct pool pool = {.most = SIZE_MAX};
    const accel_hooks hooks = {.user = &pool, .resize = pool_resize, .memory_limit = 1};
    accel_size size;
    accel_error error;
    if (accel_estimate(&s->scene, config, &hooks, &size, &error) != ACCEL_OK)
        fail_msg("%s: %s", config, error.text);
    assert_int_equal(pool.held, 0);
    assert_int_equal(pool.blocks, 0);
    assert_true(pool.peak <= LARGEST);
    return size;
}

static accel_info built(const struct test_scene *s, const char *config)
{
    accel_info info;
    accel *a = must_build(s, config);
    accel_describe(a, &info);
    accel_free(a);
    return info;
}

static void test_exact(void **state)
{
    (void)state;
    size_t count;
    const accel_kind_info *const *kind = accel_kinds(&count);
    for (const struct scene_maker *maker = scene_makers; maker->name; maker++) {
        struct test_scene s;
        scene_make(&s, maker, test_seed());
        for (size_t i = 0; i < count && s.target.primitives <= SMALL; i++) {
            const accel_size size = estimate(&s, kind[i]->name);
            const accel_info info = built(&s, kind[i]->name);
            assert_true(size.exact);
            assert_int_equal(size.bytes, info.bytes);
            assert_int_equal(size.peak_bytes, info.peak_bytes);
        }
        scene_free(&s);
    }
}

/* Cells over the whole are seen badly in parts, and clusters that parts cut worse. */
static double allowed_above(const char *kind)
{
    return strcmp(kind, "grid") == 0 || strcmp(kind, "hug") == 0 ? 0.25 : 0.1;
}

static double allowed_below(const char *kind)
{
    return strcmp(kind, "hug") == 0 ? 0.1 : 0.0;
}

static void try_large(const struct test_scene *s, const char *name, const char *config)
{
    const accel_size size = estimate(s, config);
    const accel_info info = built(s, config);
    const double above = (double)size.bytes / (double)info.bytes - 1.0;
    assert_false(size.exact);
    if (!(above >= -allowed_below(info.kind) && above <= allowed_above(info.kind)))
        fail_msg("%s over %s: %llu bytes estimated, %llu taken", config, name,
                 (unsigned long long)size.bytes, (unsigned long long)info.bytes);
}

/* The choice of auto is not known before: it is told as the largest. */
static void try_choice(const struct test_scene *s)
{
    assert_true(estimate(s, "auto").bytes >= built(s, "auto").bytes);
    if (kind_is_there("grid"))
        assert_true(estimate(s, "auto").bytes >= estimate(s, "grid").bytes);
}

static void test_large(void **state)
{
    (void)state;
    static const char *const scenes[] = {"shards-100k", "split-65536", "copies-65536", "speck"};
    struct tested *list;
    const size_t count = tested_configs(&list);
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct test_scene s;
        scene_make(&s, scene_maker_find(scenes[i]), test_seed());
        for (size_t j = 0; j < count; j++)
            if (list[j].standard && strcmp(list[j].config, "auto") != 0)
                try_large(&s, scenes[i], list[j].config);
        if (i == 0)
            try_choice(&s);
        scene_free(&s);
    }
    free(list);
}

static void fails(const accel_scene *scene, const char *config, accel_status status)
{
    accel_size size = {1, 1, true};
    accel_error error;
    assert_int_equal(accel_estimate(scene, config, NULL, &size, &error), status);
    assert_int_equal(error.status, status);
    assert_true(error.text[0] != '\0');
    assert_true(size.bytes == 0 && size.peak_bytes == 0 && !size.exact);
    assert_int_equal(accel_estimate(scene, config, NULL, &size, NULL), status);
}

static void test_faults(void **state)
{
    (void)state;
    const float vertices[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const uint32_t indices[3] = {0, 1, 3};
    const accel_geometry g = {.type = ACCEL_TRIANGLES,
                              .triangles = {.vertices = vertices,
                                            .vertices_are_float = true,
                                            .vertex_count = 3,
                                            .indices = indices,
                                            .count = 1}};
    accel_error error;
    fails(NULL, "linear", ACCEL_BAD_ARGUMENT);
    fails(&(accel_scene){NULL, 1}, "linear", ACCEL_BAD_ARGUMENT);
    fails(&(accel_scene){&g, 1}, "linear", ACCEL_BAD_ARGUMENT);
    fails(&(accel_scene){NULL, 0}, "nothing", ACCEL_BAD_CONFIG);
    assert_int_equal(accel_estimate(&(accel_scene){NULL, 0}, NULL, NULL, NULL, &error),
                     ACCEL_BAD_ARGUMENT);
}

/* Every allocation of an estimate in turn. */
static void test_no_memory(void **state)
{
    (void)state;
    struct test_scene s;
    bool fine = false;
    scene_make(&s, scene_maker_find("split-65536"), test_seed());
    for (size_t most = 1 << 10; !fine; most += most / 2) {
        struct pool pool = {.most = most};
        const accel_hooks hooks = {.user = &pool, .resize = pool_resize};
        accel_size size;
        const accel_status status = accel_estimate(&s.scene, "linear", &hooks, &size, NULL);
        fine = status == ACCEL_OK;
        assert_true(fine || (status == ACCEL_NO_MEMORY && size.bytes == 0));
        assert_int_equal(pool.held, 0);
    }
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_limits),    cmocka_unit_test(test_limits_of_large),
        cmocka_unit_test(test_peak),      cmocka_unit_test(test_exact),
        cmocka_unit_test(test_large),     cmocka_unit_test(test_faults),
        cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests_name("memory", tests, NULL, NULL);
}
