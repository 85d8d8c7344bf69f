/* SPDX-License-Identifier: Apache-2.0
 *
 * bvh: a hierarchy of boxes over the primitives by the surface-area heuristic: Goldsmith and
 * Salmon, IEEE CG&A 7(5), 1987; a wide tree (wide/wide.h), cut wherever the cost is lowest.
 *
 * Invariant, encoding, cost: wide/wide.h. Bad at: primitives whose boxes overlap much, such as long
 * thin ones across each other.
 */
#include "../core/kind.h"
#include "../wide/wide_form.h"

struct bvh {
    accel base;
    struct wide tree;
};

enum { ISA };

static const accel_option options[] = {[ISA] = WIDE_ISA_OPTION};

static bool build(struct build *build)
{
    struct bvh *b = (struct bvh *)build->a;
    return accel_wide_form_build(build, &b->tree, &b->base.option[ISA], WIDE_BY_COST, NULL);
}

static void walk(const accel *a, struct query *q)
{
    accel_wide_form_walk(&((const struct bvh *)a)->tree, q);
}

static bool validate(const accel *a, accel_error *error)
{
    return accel_wide_validate(a, &((const struct bvh *)a)->tree, error);
}

static void release(accel *a)
{
    accel_wide_free(&a->memory, &((struct bvh *)a)->tree);
}

const struct accel_kind accel_bvh_kind = {
    .info = {.name = "bvh",
             .summary = "hierarchy of boxes by the surface-area heuristic",
             .options = options,
             .option_count = sizeof options / sizeof *options},
    .cost = COST_BVH,
    .size = sizeof(struct bvh),
    .build = build,
    .walk = walk,
    .validate = validate,
    .release = release,
};
