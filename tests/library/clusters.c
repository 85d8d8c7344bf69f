/* SPDX-License-Identifier: Apache-2.0
 *
 * Finding clusters takes linear work, also where the input is meant to be hard: counted looks at
 * cells and at what they hold, which no clock disturbs, and bytes. And what is found is whole:
 * every primitive in exactly one cluster, inside its box.
 */
#include <stdlib.h>
#include <string.h>

#include "core/box.h"
#include "cluster/cluster.h"
#include "cmocka_all.h"
#include "rng.h"

/* For each primitive, at most: about twice the looks of the worst family, and what it takes where
 * the user's connectivity leaves every primitive alone. */
enum { MOST_LOOKS = 50, MOST_BYTES = 1400 };

enum { SIZES = 3 };
static const uint32_t sizes[SIZES] = {1000, 16000, 128000};

/* A family fills in sphere i of n. */
typedef void family(struct rng *d, uint32_t i, uint32_t n, double out[4]);

static void scatter(struct rng *d, double side, double radius, double out[4])
{
    for (int k = 0; k < 3; k++)
        out[k] = rng_unit(d) * side;
    out[3] = radius;
}

static void same(struct rng *d, uint32_t i, uint32_t n, double out[4])
{
    (void)d, (void)i, (void)n;
    memcpy(out, (double[4]){1, 2, 3, 1}, 4 * sizeof *out);
}

static void even(struct rng *d, uint32_t i, uint32_t n, double out[4])
{
    (void)i;
    scatter(d, 1.0, 0.2 / cbrt(n), out);
}

static void dense(struct rng *d, uint32_t i, uint32_t n, double out[4])
{
    (void)i;
    scatter(d, 1.0, 2.0 / cbrt(n), out);
}

/* One crowded cell, and a single sphere that makes the scene large. */
static void crowded(struct rng *d, uint32_t i, uint32_t n, double out[4])
{
    (void)n;
    scatter(d, i == 0 ? 1e6 : 1e-6, 1e-9, out);
}

/* Half in one place, half everywhere. */
static void uneven(struct rng *d, uint32_t i, uint32_t n, double out[4])
{
    (void)n;
    scatter(d, i % 2 ? 1.0 : 1e-3, 1e-6, out);
}

/* As many at each distance from a corner, on a log scale. */
static void corner(struct rng *d, uint32_t i, uint32_t n, double out[4])
{
    (void)i, (void)n;
    const double side = rng_power(d, -30, 0);
    scatter(d, side, side * 1e-3, out);
}

static void all_sizes(struct rng *d, uint32_t i, uint32_t n, double out[4])
{
    (void)i, (void)n;
    scatter(d, 1.0, rng_power(d, -30, -1), out);
}

/* Sizes with gaps: a class for each. */
static void many_classes(struct rng *d, uint32_t i, uint32_t n, double out[4])
{
    (void)n;
    scatter(d, 1.0, ldexp(1.0, -2 - 2 * (int)(i % 8)), out);
}

static void line(struct rng *d, uint32_t i, uint32_t n, double out[4])
{
    (void)d, (void)n;
    memcpy(out, (double[4]){i, 0, 0, 0.1}, 4 * sizeof *out);
}

/* A Cantor set: clusters of clusters, at every scale. */
static void dust(struct rng *d, uint32_t i, uint32_t n, double out[4])
{
    (void)i, (void)n;
    memset(out, 0, 3 * sizeof *out);
    for (int level = 1; level <= 8; level++)
        for (int k = 0; k < 3; k++)
            out[k] += 2.0 * rng_below(d, 2) / pow(3.0, level);
    out[3] = 1e-5;
}

static const struct {
    const char *name;
    family *fill;
} families[] = {
    {"same", same},       {"even", even},           {"dense", dense},
    {"crowded", crowded}, {"uneven", uneven},       {"corner", corner},
    {"line", line},       {"all sizes", all_sizes}, {"many classes", many_classes},
    {"dust", dust},
};

static void check_whole(const accel *a, const struct clustering *c)
{
    const uint32_t n = a->prims.count;
    bool *seen = calloc(n, sizeof *seen);
    size_t total = 0;
    assert_non_null(seen);
    for (size_t i = 0; i < c->clusters.count; i++) {
        const struct cluster *cluster = &c->clusters.at[i];
        assert_int_equal(cluster->first, total);
        for (uint32_t j = 0; j < cluster->count; j++) {
            const uint32_t id = c->order.at[cluster->first + j];
            assert_false(seen[id]);
            assert_true(box_contains(&cluster->box, &a->prims.box[id]));
            seen[id] = true;
        }
        total += cluster->count;
    }
    assert_int_equal(total, n);
    free(seen);
}

/* Clusters the scene; returns the looks. */
static double cluster(const accel_scene *scene, struct cluster_rule rule)
{
    static const accel_hooks hooks;
    accel_error error = {.text = ""};
    accel a = {.memory = {.resize = accel_memory_system}};
    struct build build = {.a = &a,
                          .memory = &a.memory,
                          .info = &a.info,
                          .kind = "hoo",
                          .hooks = &hooks,
                          .error = &error,
                          .phase = "clusters"};
    struct clustering found = {0};
    assert_true(accel_primitives_copy(&build, &a.prims, scene));
    const size_t before = a.memory.bytes;
    assert_true(accel_cluster_scene(&build, &found, rule, 0.0, 1.0));
    check_whole(&a, &found);
    assert_in_range(a.memory.peak - before, 0, 65536 + MOST_BYTES * (size_t)a.prims.count);
    print_message("%6.1f bytes, ", (double)(a.memory.peak - before) / a.prims.count);
    const double visits = (double)found.visits;
    accel_cluster_free(&a.memory, &found);
    accel_primitives_free(&a.memory, &a.prims);
    assert_int_equal(a.memory.bytes, 0);
    return visits;
}

static void measure(size_t number, uint32_t n, struct cluster_rule rule)
{
    struct rng rng = {number, 0};
    double(*spheres)[4] = malloc(n * sizeof *spheres);
    assert_non_null(spheres);
    for (uint32_t i = 0; i < n; i++)
        families[number].fill(&rng, i, n, spheres[i]);
    const accel_geometry geometry = {.type = ACCEL_SPHERES,
                                     .spheres = {.spheres = spheres[0], .count = n}};
    const double each = cluster(&(accel_scene){&geometry, 1}, rule) / n;
    print_message("%-14s n %7u: %6.2f looks each\n", families[number].name, n, each);
    if (!(each <= MOST_LOOKS))
        fail_msg("%s, %u spheres: %g looks for each", families[number].name, n, each);
    free(spheres);
}

static void work_is_linear(void **state)
{
    (void)state;
    for (size_t f = 0; f < sizeof families / sizeof *families; f++)
        for (int s = 0; s < SIZES; s++)
            measure(f, sizes[s], (struct cluster_rule){NAN, NAN});
}

static void work_is_linear_with_options(void **state)
{
    (void)state;
    for (size_t f = 0; f < sizeof families / sizeof *families; f++)
        for (int s = 0; s < SIZES - 1; s++)
            measure(f, sizes[s], (struct cluster_rule){0.5, 2.0});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(work_is_linear),
        cmocka_unit_test(work_is_linear_with_options),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
