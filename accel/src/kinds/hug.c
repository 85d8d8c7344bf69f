/* SPDX-License-Identifier: Apache-2.0
 *
 * The kind hug: see hug.h.
 */
#include "../core/kind.h"
#include "../hug/hug.h"

#include "../grid/grid_walk.h"

static const char *const forms[] = {"density", "paper", NULL};

static const accel_option options[] = {
    [HUG_FORM] = {.key = "form",
                  .meaning = "cells by predicted cost and nested, or as the paper has them",
                  .words = forms},
    [HUG_CELLS] = {.key = "cells",
                   .meaning = "for form=paper: cells of a cluster's grid along each axis",
                   .min = 1,
                   .max = 256,
                   .standard = 13,
                   .whole = true},
    [HUG_DENSITY] = {.key = "density",
                     .meaning = "for form=density: cells of a grid per item",
                     .min = 1e-12,
                     .max = 1e6,
                     .standard = NAN},
    [HUG_CONNECTIVITY] = CLUSTER_CONNECTIVITY_OPTION,
    [HUG_OCTAVES] = CLUSTER_OCTAVES_OPTION,
};

static bool visit(const accel *a, struct query *q, const uint32_t *refs, size_t count);

static bool walk_grid(const accel *a, struct query *q, const struct grid *g)
{
    return grid_walk(a, &((const struct hug *)a)->pool, g, q, visit);
}

/* Was this cluster's grid walked lately? It is noted as primitives are: see hug.h. */
static bool walked(struct query *q, uint32_t ref)
{
    uint32_t *box = &q->mailbox[ref % QUERY_MAILBOXES];
    const bool same = *box == ref;
    *box = ref;
    return same;
}

/* Primitives first, as they may set the limit: they come first in the list. */
static bool visit(const accel *a, struct query *q, const uint32_t *refs, size_t count)
{
    const uint32_t ids = a->prims.count;
    size_t tested = count;
    while (tested > 0 && refs[tested - 1] >= ids)
        tested--;
    accel_query_test_list(q, refs, tested);
    if (query_done(q))
        return false;
    for (size_t i = tested; i < count; i++) {
        const struct grid *g = &((const struct hug *)a)->pool.grids.at[refs[i] - ids];
        if ((g->cell || !walked(q, refs[i])) && !walk_grid(a, q, g))
            return false;
    }
    return true;
}

static void walk(const accel *a, struct query *q)
{
    walk_grid(a, q, ((const struct hug *)a)->pool.grids.at);
}

static void release(accel *a)
{
    accel_grid_pool_free(&a->memory, &((struct hug *)a)->pool);
}

const struct accel_kind accel_hug_kind = {
    .info = {.name = "hug",
             .summary = "clusters, a uniform grid each, nested",
             .options = options,
             .option_count = sizeof options / sizeof *options},
    .cost = COST_HUG,
    .size = sizeof(struct hug),
    .build = accel_hug_build,
    .walk = walk,
    .validate = accel_hug_validate,
    .release = release,
};
