/* SPDX-License-Identifier: Apache-2.0
 *
 * What scenes may hold: invalid and degenerate primitives, bad arguments, strides, float vertices,
 * objects without bounds.
 */
#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "cmocka_all.h"
#include "compare.h"

static void describe(const accel_geometry *g, uint32_t count, accel_info *info)
{
    accel *a;
    accel_error error;
    if (accel_build(&a, &(accel_scene){g, count}, NULL, NULL, &error) != ACCEL_OK)
        fail_msg("%s", error.text);
    accel_describe(a, info);
    accel_free(a);
}

static void refuse(const accel_geometry *g, uint32_t count, accel_status status, const char *word)
{
    accel *a = (accel *)&a;
    accel_error error;
    const accel_scene scene = {g, count};
    assert_int_equal(accel_build(&a, &scene, NULL, NULL, &error), status);
    assert_null(a);
    assert_int_equal(error.status, status);
    if (!strstr(error.text, word) || !strstr(error.text, "nothing was built"))
        fail_msg("'%s' is not in: %s", word, error.text);
    assert_int_equal(accel_build(&a, &scene, NULL, NULL, NULL), status);
}

static void no_intersect(accel_probe *probe)
{
    accel_report(probe, 0.5, 0, 0);
}

static const double corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
static const uint32_t order[3] = {0, 1, 2};
static const accel_box unit_box = {{0, 0, 0}, {1, 1, 1}};

static accel_geometry triangles(const double *x, uint32_t count, const uint32_t *indices)
{
    return (accel_geometry){
        .type = ACCEL_TRIANGLES,
        .triangles = {
            .vertices = x, .vertex_count = 3 * count, .indices = indices, .count = count}};
}

static accel_geometry objects(const accel_box *boxes, uint32_t count)
{
    return (accel_geometry){.type = ACCEL_OBJECTS,
                            .objects = {.boxes = boxes, .count = count, .intersect = no_intersect}};
}

static accel_geometry spheres(const double *x, uint32_t count)
{
    return (accel_geometry){.type = ACCEL_SPHERES, .spheres = {.spheres = x, .count = count}};
}

static const double bad_numbers[] = {NAN, -NAN, INFINITY, -INFINITY, DBL_MAX, -DBL_MAX};

static void test_invalid_triangles(void **state)
{
    (void)state;
    for (size_t b = 0; b < sizeof bad_numbers / sizeof *bad_numbers; b++) {
        for (int k = 0; k < 9; k++) {
            double x[9];
            accel_info info;
            memcpy(x, corners, sizeof x);
            x[k] = bad_numbers[b];
            const accel_geometry g = triangles(x, 1, order);
            describe(&g, 1, &info);
            assert_int_equal(info.skipped, 1);
            assert_int_equal(info.degenerate, 0);
        }
    }
}

static void test_invalid_spheres(void **state)
{
    (void)state;
    const double bad_radii[] = {0.0, -0.0, -1.0, NAN, INFINITY, -INFINITY, DBL_MAX};
    accel_info info;
    for (size_t b = 0; b < sizeof bad_radii / sizeof *bad_radii; b++) {
        const double x[4] = {1, 2, 3, bad_radii[b]};
        const accel_geometry g = spheres(x, 1);
        describe(&g, 1, &info);
        assert_int_equal(info.skipped, 1);
    }
    for (size_t b = 0; b < sizeof bad_numbers / sizeof *bad_numbers; b++) {
        for (int k = 0; k < 3; k++) {
            double x[4] = {1, 2, 3, 1};
            x[k] = bad_numbers[b];
            const accel_geometry g = spheres(x, 1);
            describe(&g, 1, &info);
            assert_int_equal(info.skipped, 1);
        }
    }
}

static void test_invalid_boxes(void **state)
{
    (void)state;
    for (int k = 0; k < 3; k++) {
        accel_box b[3] = {unit_box, unit_box, unit_box};
        accel_info info;
        b[0].lo[k] = 2.0;
        b[1].lo[k] = (double)NAN;
        b[2].hi[k] = (double)NAN;
        const accel_geometry g = objects(b, 3);
        describe(&g, 1, &info);
        assert_int_equal(info.skipped, 3);
        for (uint32_t i = 0; i < 3; i++)
            assert_int_equal(info.skipped_ids[i].prim, i);
    }
}

/* The limit of coordinates is inclusive. */
static void test_largest(void **state)
{
    (void)state;
    const double m = ACCEL_MAX_COORDINATE;
    accel_info info;
    double x[9] = {-m, -m, -m, m, -m, -m, -m, m, m};
    accel_geometry g = triangles(x, 1, order);
    describe(&g, 1, &info);
    assert_int_equal(info.skipped, 0);
    x[8] = nextafter(m, (double)INFINITY);
    describe(&g, 1, &info);
    assert_int_equal(info.skipped, 1);
}

static void test_degenerate(void **state)
{
    (void)state;
    double x[4 * 9];
    uint32_t indices[12];
    accel_info info;
    for (uint32_t i = 0; i < 4; i++)
        memcpy(x + 9 * i, corners, sizeof corners);
    memcpy(x + 3, x, 3 * sizeof *x);
    memcpy(x + 9 + 6, x + 9 + 3, 3 * sizeof *x);
    memcpy(x + 18 + 6, x + 18, 3 * sizeof *x);
    for (uint32_t i = 0; i < 12; i++)
        indices[i] = i;
    const accel_geometry g = triangles(x, 4, indices);
    describe(&g, 1, &info);
    assert_int_equal(info.degenerate, 3);
    assert_int_equal(info.skipped, 0);
    assert_int_equal(info.primitives, 4);
    assert_int_equal(info.references, 1);
}

/* -0.0 and 0.0 are one coordinate. */
static void test_signed_zero(void **state)
{
    (void)state;
    const double x[9] = {0.0, 0, 0, -0.0, -0.0, -0.0, 0, 1, 0};
    accel_info info;
    const accel_geometry g = triangles(x, 1, order);
    describe(&g, 1, &info);
    assert_int_equal(info.degenerate, 1);
}

static void count_invalid(const accel_info *info, uint64_t count)
{
    assert_int_equal(info->skipped, count);
    for (uint32_t i = 0; i < ACCEL_INFO_IDS && i < count; i++) {
        assert_int_equal(info->skipped_ids[i].geom, 1);
        assert_int_equal(info->skipped_ids[i].prim, 2 * i);
    }
}

/* Every second sphere is invalid: the others keep their ids, in every kind. */
static void test_ids_stay(void **state)
{
    (void)state;
    double x[4 * 30];
    for (int i = 0; i < 30; i++) {
        const double sphere[4] = {10.0 * i, 0, 0, i % 2 ? 1.0 : -1.0};
        memcpy(x + 4 * i, sphere, sizeof sphere);
    }
    const accel_geometry g[3] = {triangles(corners, 1, order), spheres(x, 30),
                                 objects(&unit_box, 1)};
    struct tested *list;
    const size_t count = tested_configs(&list);
    for (size_t c = 0; c < count; c++) {
        accel *a;
        accel_info info;
        accel_box box;
        assert_int_equal(accel_build(&a, &(accel_scene){g, 3}, list[c].config, NULL, NULL),
                         ACCEL_OK);
        accel_describe(a, &info);
        count_invalid(&info, 15);
        for (uint32_t i = 0; i < 30; i++) {
            const double org[3] = {10.0 * i, 0.5, -5}, dir[3] = {0, 0, 1};
            const accel_ray ray = accel_ray_from(org, dir);
            accel_hit hit = {.prim = 99};
            const bool found = accel_closest(a, &ray, &hit, NULL);
            assert_int_equal(found, i % 2 || i == 0);
            assert_true(!found || i == 0 || (hit.geom == 1 && hit.prim == i));
            assert_int_equal(accel_padded_box(a, (accel_id){1, i}, &box), i % 2);
        }
        assert_false(accel_padded_box(a, (accel_id){3, 0}, &box));
        assert_false(accel_padded_box(a, (accel_id){2, 1}, &box));
        assert_false(accel_padded_box(a, (accel_id){ACCEL_NONE, ACCEL_NONE}, &box));
        accel_free(a);
    }
    free(list);
}

static void test_padded_box(void **state)
{
    (void)state;
    const double x[4] = {0, 0, 4, 1};
    const accel_geometry g = spheres(x, 1);
    accel *a;
    accel_box box;
    assert_int_equal(accel_build(&a, &(accel_scene){&g, 1}, NULL, NULL, NULL), ACCEL_OK);
    assert_true(accel_padded_box(a, (accel_id){0, 0}, &box));
    const double q = 5.0 * 0x1p-44, lo[3] = {-1 - q, -1 - q, 3 - q}, hi[3] = {1 + q, 1 + q, 5 + q};
    for (int k = 0; k < 3; k++)
        assert_true(box.lo[k] == lo[k] && box.hi[k] == hi[k]);
    accel_free(a);
}

static void test_bad_arguments(void **state)
{
    (void)state;
    const double x[4] = {0, 0, 0, 1};
    accel_geometry g = triangles(NULL, 1, order);
    accel_error error;
    refuse(&g, 1, ACCEL_BAD_ARGUMENT, "geometry 0: triangles without vertices");
    g = triangles(corners, 1, NULL);
    refuse(&g, 1, ACCEL_BAD_ARGUMENT, "geometry 0: triangles without");
    g = triangles(corners, 1, order);
    g.triangles.vertex_stride = 23;
    refuse(&g, 1, ACCEL_BAD_ARGUMENT, "vertex_stride");
    g.triangles.vertices_are_float = true;
    g.triangles.vertex_stride = 11;
    refuse(&g, 1, ACCEL_BAD_ARGUMENT, "vertex_stride");
    g = spheres(NULL, 1);
    refuse(&g, 1, ACCEL_BAD_ARGUMENT, "geometry 0: spheres");
    g = spheres(x, 1);
    g.spheres.stride = 31;
    refuse(&g, 1, ACCEL_BAD_ARGUMENT, "stride");
    g = objects(NULL, 1);
    refuse(&g, 1, ACCEL_BAD_ARGUMENT, "boxes");
    g = objects(&unit_box, 1);
    g.objects.intersect = NULL;
    refuse(&g, 1, ACCEL_BAD_ARGUMENT, "intersect");
    g = objects(&unit_box, 1);
    g.objects.order = (accel_order)7;
    refuse(&g, 1, ACCEL_BAD_ARGUMENT, "order");
    g.type = (accel_type)9;
    refuse(&g, 1, ACCEL_BAD_ARGUMENT, "type");
    refuse(NULL, 1, ACCEL_BAD_ARGUMENT, "geometries");
    assert_int_equal(accel_build(NULL, NULL, NULL, NULL, &error), ACCEL_BAD_ARGUMENT);
    accel *a = (accel *)&a;
    assert_int_equal(accel_build(&a, NULL, NULL, NULL, &error), ACCEL_BAD_ARGUMENT);
    assert_null(a);
    const accel_scene empty = {NULL, 0};
    const accel_hooks no_rays = {.pilot_count = 3};
    assert_int_equal(accel_build(&a, &empty, NULL, &no_rays, &error), ACCEL_BAD_ARGUMENT);
    assert_non_null(strstr(error.text, "hooks.pilot is NULL"));
    accel_free(NULL);
}

static void test_bad_indices(void **state)
{
    (void)state;
    for (uint32_t corner = 0; corner < 3; corner++) {
        uint32_t indices[6] = {0, 1, 2, 0, 1, 2};
        indices[3 + corner] = 3;
        accel_geometry g[2] = {triangles(corners, 1, order), triangles(corners, 2, indices)};
        g[1].triangles.vertex_count = 3;
        refuse(g, 2, ACCEL_BAD_ARGUMENT,
               "geometry 1, triangle 1: vertex 3 is used, but there are 3");
        indices[3 + corner] = UINT32_MAX;
        refuse(g, 2, ACCEL_BAD_ARGUMENT, "vertex 4294967295");
    }
}

/* Refused before anything is read or allocated: the arrays are not there. */
static void test_too_large(void **state)
{
    (void)state;
    const accel_geometry g[2] = {objects(&unit_box, UINT32_MAX), objects(&unit_box, 1)};
    refuse(g, 1, ACCEL_TOO_LARGE, "4294967295 primitives");
    refuse(g, 2, ACCEL_TOO_LARGE, "4294967296 primitives");
}

static void test_nothing(void **state)
{
    (void)state;
    const accel_geometry g[3] = {
        triangles(NULL, 0, NULL), spheres(NULL, 0), {.type = ACCEL_OBJECTS}};
    accel_info info;
    describe(g, 3, &info);
    assert_int_equal(info.primitives, 0);
    describe(NULL, 0, &info);
    assert_int_equal(info.primitives, 0);
}

enum { SHAPES = 60 };

/* The same mesh in four layouts, between other bytes; the arrays are overwritten after the
 * build. */
static uint64_t hash_layout(bool is_float, size_t stride, struct test_scene *s)
{
    const size_t size = is_float ? 4 : 8, step = stride ? stride : 3 * size;
    const uint32_t count = s->part[0].count;
    char *bytes = must_resize(NULL, 3 * (size_t)count * step);
    memset(bytes, 0x7f, 3 * (size_t)count * step);
    for (size_t i = 0; i < 9 * (size_t)count; i++) {
        const double x = s->part[0].data[i];
        const float f = (float)x;
        memcpy(bytes + i / 3 * step + i % 3 * size, is_float ? (const void *)&f : &x, size);
    }
    accel_geometry g = s->geometry[0];
    g.triangles.vertices = bytes;
    g.triangles.vertex_stride = stride;
    g.triangles.vertices_are_float = is_float;
    accel *a;
    assert_int_equal(accel_build(&a, &(accel_scene){&g, 1}, NULL, NULL, NULL), ACCEL_OK);
    memset(bytes, 0xff, 3 * (size_t)count * step);
    free(bytes);
    uint64_t hash = HASH_START, hits = 0;
    struct rng d = rng_from(3, 3);
    for (uint64_t i = 0; i < 1000; i++) {
        const accel_ray ray = ray_families->make(&s->target, a, &d, i);
        const struct answer answer = ask(a, &ray, true);
        hash = answer_hash(hash, &answer);
        hits += answer.hit;
    }
    assert_true(hits > 100);
    accel_free(a);
    return hash;
}

static void test_layouts(void **state)
{
    (void)state;
    struct test_scene s;
    struct rng d = rng_from(1, 1);
    scene_open(&s);
    make_shards(&s, &d, SHAPES);
    for (size_t i = 0; i < 9 * SHAPES; i++)
        s.part[0].data[i] = (double)(float)s.part[0].data[i];
    scene_close(&s);
    const uint64_t expected = hash_layout(false, 0, &s);
    assert_int_equal(hash_layout(false, 24, &s), expected);
    assert_int_equal(hash_layout(false, 29, &s), expected);
    assert_int_equal(hash_layout(true, 0, &s), expected);
    assert_int_equal(hash_layout(true, 12, &s), expected);
    assert_int_equal(hash_layout(true, 17, &s), expected);
    scene_free(&s);
}

static void test_sphere_stride(void **state)
{
    (void)state;
    const double x[11] = {0, 0, 5, 1, -7, -7, -7, 0, 0, 3, 1};
    const double nowhere[3] = {0, 0, 0}, up[3] = {0, 0, 1};
    const accel_ray ray = accel_ray_from(nowhere, up);
    accel_geometry g = spheres(x, 2);
    g.spheres.stride = 7 * sizeof(double);
    accel *a;
    accel_hit hit;
    assert_int_equal(accel_build(&a, &(accel_scene){&g, 1}, NULL, NULL, NULL), ACCEL_OK);
    assert_true(accel_closest(a, &ray, &hit, NULL));
    assert_int_equal(hit.prim, 1);
    assert_true(hit.t == 2.0);
    accel_free(a);
}

/* Any infinite side makes an object unbounded; it is tested for every ray, also far away. */
static void test_unbounded(void **state)
{
    (void)state;
    const double inf = (double)INFINITY;
    for (int side = 0; side < 6; side++) {
        accel_box b[2] = {unit_box, unit_box};
        *(side < 3 ? &b[1].lo[side] : &b[1].hi[side - 3]) = side < 3 ? -inf : inf;
        const accel_geometry g = objects(b, 2);
        const double org[3] = {1e30, 1e30, 1e30}, dir[3] = {1, 1, 1};
        const accel_ray ray = accel_ray_from(org, dir);
        accel_info info;
        accel *a;
        accel_hit hit;
        assert_int_equal(accel_build(&a, &(accel_scene){&g, 1}, NULL, NULL, NULL), ACCEL_OK);
        accel_describe(a, &info);
        assert_int_equal(info.unbounded, 1);
        assert_true(accel_closest(a, &ray, &hit, NULL));
        assert_int_equal(hit.prim, 1);
        accel_free(a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_invalid_triangles), cmocka_unit_test(test_invalid_spheres),
        cmocka_unit_test(test_invalid_boxes),     cmocka_unit_test(test_largest),
        cmocka_unit_test(test_degenerate),        cmocka_unit_test(test_signed_zero),
        cmocka_unit_test(test_ids_stay),          cmocka_unit_test(test_padded_box),
        cmocka_unit_test(test_bad_arguments),     cmocka_unit_test(test_bad_indices),
        cmocka_unit_test(test_too_large),         cmocka_unit_test(test_nothing),
        cmocka_unit_test(test_layouts),           cmocka_unit_test(test_sphere_stride),
        cmocka_unit_test(test_unbounded),
    };
    return cmocka_run_group_tests_name("scene_input", tests, NULL, NULL);
}
