/* SPDX-License-Identifier: Apache-2.0
 *
 * linear: the reference. Tests every primitive in order; holds nothing.
 *
 * Cost: one test per primitive and ray. Bad at everything but being right: it shares with the other
 * kinds only the tests of single primitives (query.c).
 */
#include "../core/kind.h"
#include "../primitive/query.h"

static bool build(struct build *build)
{
    accel_info *info = &build->a->info;
    info->leaves = 1;
    info->references = build->a->prims.bounded.count;
    return true;
}

static void walk(const accel *a, struct query *q)
{
    accel_query_test_all(q, a->prims.bounded.at, a->prims.bounded.count);
}

static bool validate(const accel *a, accel_error *error)
{
    (void)a;
    (void)error;
    return true;
}

static void release(accel *a)
{
    (void)a;
}

const struct accel_kind accel_linear_kind = {
    .info = {.name = "linear",
             .summary = "no structure: tests every primitive; the reference of the others"},
    .cost = COST_LINEAR,
    .size = sizeof(accel),
    .build = build,
    .walk = walk,
    .validate = validate,
    .release = release,
};
