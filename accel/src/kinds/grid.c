/* SPDX-License-Identifier: Apache-2.0
 *
 * grid: one uniform grid over the whole scene (Fujimoto, Tanaka and Iwata, "ARTS: Accelerated
 * Ray-Tracing System", IEEE CG&A 6(4), 1986), its cells as cubic as possible (Woo, "Ray Tracing
 * Polygons Using Spatial Subdivision", Graphics Interface 1992).
 *
 * Encoding, invariant and cost: see grid.h. The walk: see grid_walk.h.
 */
#include "../core/kind.h"
#include "../grid/grid_walk.h"

#include "../core/number.h"

struct grid_kind {
    accel base;            /* what every kind has */
    struct grid_pool pool; /* of one grid */
};

enum { DENSITY };

static const accel_option options[] = {
    [DENSITY] = {.key = "density",
                 .meaning = "cells per primitive",
                 .min = 1e-12,
                 .max = 1e6,
                 .standard = NAN},
};

static void describe(struct build *build, const struct grid_kind *k, const struct grid_plan *plan)
{
    accel_info *info = &build->a->info;
    const struct grid *g = &k->pool.grids.at[0];
    info->nodes = 1;
    info->leaves = k->pool.starts.count - 1;
    info->references = k->pool.refs.count;
    info->depth = 1;
    accel_build_note(build, "%u x %u x %u cells, for density=%s%s", g->cells[0], g->cells[1],
                     g->cells[2], accel_number_text(plan->density, 6).at,
                     isnan(k->base.option[DENSITY]) ? ", which auto found cheapest" : "");
    accel_grid_note_empty(build, &k->pool);
    if (plan->coarser)
        accel_build_note(
            build,
            "coarser than density=%s asks: for memory in proportion, or as cells list most items",
            accel_number_text(plan->density, 6).at);
}

static bool build(struct build *build)
{
    struct grid_kind *k = (struct grid_kind *)build->a;
    const struct primitives *p = &k->base.prims;
    const struct grid_items all = {p->bounded.at, p->bounded.count};
    accel_build_phase(build, "density");
    if (!array_extend(&k->base.memory, &k->pool.grids, 1))
        return accel_build_no_memory(build);
    k->pool.grids.at[0] = (struct grid){.box = p->bounds};
    struct grid_plan plan =
        accel_grid_plan(p, &k->pool, &k->pool.grids.at[0].box, all, k->base.option[DENSITY]);
    accel_build_phase(build, "grid");
    if (!accel_grid_build(build, &k->pool, 0, all, &plan, 0.0, 1.0))
        return false;
    accel_grid_pool_trim(&k->base.memory, &k->pool);
    describe(build, k, &plan);
    return true;
}

static bool visit(const accel *a, struct query *q, const uint32_t *refs, size_t count)
{
    (void)a;
    accel_query_test_list(q, refs, count);
    return !query_done(q);
}

static void walk(const accel *a, struct query *q)
{
    const struct grid_kind *k = (const struct grid_kind *)a;
    grid_walk(a, &k->pool, k->pool.grids.at, q, visit);
}

static bool validate(const accel *a, accel_error *error)
{
    const struct grid_kind *k = (const struct grid_kind *)a;
    return accel_grid_validate(
        a, &k->pool, 0, (struct grid_items){a->prims.bounded.at, a->prims.bounded.count}, error);
}

static void release(accel *a)
{
    struct grid_kind *k = (struct grid_kind *)a;
    accel_grid_pool_free(&a->memory, &k->pool);
}

const struct accel_kind accel_grid_kind = {
    .info = {.name = "grid",
             .summary = "one uniform grid over the scene",
             .options = options,
             .option_count = sizeof options / sizeof *options},
    .cost = COST_GRID,
    .size = sizeof(struct grid_kind),
    .build = build,
    .walk = walk,
    .validate = validate,
    .release = release,
};
