/* SPDX-License-Identifier: Apache-2.0
 *
 * The kind wide: a wide tree (wide/wide.h) by the surface-area heuristic.
 */
#include "wide/wide_isa.h"

#include <string.h>

struct wide_kind {
    accel base;
    struct wide tree;
};

enum { ISA };

static const char *const isas[] = {"avx512", "avx2", "portable", NULL};

static const accel_option options[] = {
    [ISA] = {.key = "isa",
             .meaning = "instruction set of its walks",
             .words = isas,
             .standard = NAN},
};

/* The one that is asked for, or the first that works here. */
static const struct wide_isa *choose_isa(const double *option)
{
    for (size_t i = 0; wide_isas[i + 1]; i++)
        if (wide_isas[i]->works_here() &&
            (isnan(*option) || strcmp(wide_isas[i]->name, isas[(int)*option]) == 0))
            return wide_isas[i];
    return &wide_portable;
}

static bool build(struct build *build)
{
    struct wide_kind *k = (struct wide_kind *)build->a;
    k->tree.isa = choose_isa(&k->base.option[ISA]);
    if (!wide_build(build, &k->tree, k->tree.isa->rule))
        return false;
    if (k->tree.fast && k->base.prims.only_triangles)
        k->base.fast = &k->tree;
    accel_info *info = &k->base.info;
    info->nodes = k->tree.nodes;
    info->leaves = k->tree.leaves;
    info->references = k->base.prims.bounded.count;
    info->depth = k->tree.depth;
    return true;
}

static void walk(const accel *a, struct query *q)
{
    const struct wide *w = &((const struct wide_kind *)a)->tree;
    if (!w->fast || !w->isa->walk(w, q))
        wide_walk(w, q);
}

static bool validate(const accel *a, accel_error *error)
{
    return wide_validate(a, &((const struct wide_kind *)a)->tree, error);
}

static void release(accel *a)
{
    wide_free(&a->memory, &((struct wide_kind *)a)->tree);
}

const struct accel_kind wide_kind = {
    .info = {.name = "wide", .summary = "tree of up to 16 boxes a node, in float",
             .options = options,
             .option_count = sizeof options / sizeof *options},
    .cost = {.build = 41,
             .ray = 58,
             .node = 17,
             .triangle = 2.5,
             .other = 22,
             .mesh = 0.65,
             .growth = GROWS_LIKE_LOG},
    .size = sizeof(struct wide_kind),
    .build = build,
    .walk = walk,
    .validate = validate,
    .release = release,
};
