/* SPDX-License-Identifier: Apache-2.0
 *
 * Building the kind hug: clusters, their nesting, a grid for each, and, in the form `density`,
 * grids for crowded cells.
 *
 * A crowded cell is decided upon while its grid's references are the last of the pool, so taking
 * its list out moves only what is behind it. Time is linear in the references. References in all
 * are bounded by BUDGET, each grid's by accel_grid_plan_references.
 */
#include "hug.h"

#include "../core/kind.h"

#include <string.h>

/* A cell of no more items stays a list (Havran's limit for recursive grids). */
enum { CROWDED = 8 };

/* References in all, in multiples of the primitives, up to which cells become grids. */
enum { BUDGET = 16 };

/* Primitives that could be looked at in the time that a small grid takes. */
enum { GRID_WORK = 64 };

/* A part of the progress of a phase. */
struct span {
    double from, to;
};

/* The part of a span from `before` to `after` of `all`. */
static struct span part_of(struct span s, size_t before, size_t after, size_t all)
{
    const double per = (s.to - s.from) / (double)all;
    return (struct span){s.from + per * (double)before, s.from + per * (double)after};
}

/* Its halves: what is done first, then what follows from that. */
static struct span first_half(struct span s)
{
    return part_of(s, 0, 1, 2);
}

static struct span second_half(struct span s)
{
    return part_of(s, 1, 2, 2);
}

/* A cell that becomes a grid. */
struct job {
    struct grid_plan plan; /* of the grid */
    size_t number;         /* of the grid */
    size_t begin, count;   /* its items in builder.stack */
};

struct builder {
    struct build *build;          /* the build under way */
    struct hug *h;                /* what is built */
    struct clustering clustering; /* of the scene */
    struct hug_nesting nesting;   /* of the clusters' grids */
    struct ids items;             /* of all clusters' grids, grid after grid, each run rising */
    ARRAY_OF(size_t) begin;       /* by cluster's grid: its run in items; one more at the end */
    struct ids stack;             /* items of the cells that become grids, on the way down */
    ARRAY_OF(struct job) jobs;    /* on the way down */
    bool coarser;                 /* some grid is coarser than was asked for */
    bool full;                    /* the budget was met */
};

/* ------------------------------------------------------------ what a grid is made of ---- */

static bool count_items(struct builder *b)
{
    const struct clustering *c = &b->clustering;
    const struct ids *owner = &b->nesting.owner;
    const size_t grids = b->h->pool.grids.count;
    if (!array_extend(&b->build->a->memory, &b->begin, grids + 1))
        return accel_build_no_memory(b->build);
    memset(b->begin.at, 0, b->begin.count * sizeof *b->begin.at);
    for (size_t i = 0; i < c->clusters.count; i++)
        b->begin.at[owner->at[i] + 1] += c->clusters.at[i].count;
    for (size_t i = 1; i < grids; i++)
        b->begin.at[b->nesting.parent.at[i] + 1]++;
    for (size_t i = 0; i < grids; i++)
        b->begin.at[i + 1] += b->begin.at[i];
    return true;
}

/* Enters ids in rising order, then grids; leaves begin[i] at the end of run i. */
static bool enter_items(struct builder *b, const uint32_t *owner_of)
{
    const struct primitives *p = &b->build->a->prims;
    for (size_t i = 0; i < p->bounded.count; i++) {
        const uint32_t id = p->bounded.at[i];
        b->items.at[b->begin.at[owner_of[id]]++] = id;
        if (i % 4096 == 0 &&
            !accel_build_tick(b->build, HUG_NESTED + (1.0 - HUG_NESTED) * (double)i /
                                                         (double)p->bounded.count))
            return false;
    }
    for (size_t i = 1; i < b->h->pool.grids.count; i++)
        b->items.at[b->begin.at[b->nesting.parent.at[i]]++] = p->count + (uint32_t)i;
    return true;
}

/* Which grid each primitive is an item of. */
static void find_owners(const struct builder *b, uint32_t *owner_of)
{
    const struct clustering *c = &b->clustering;
    for (size_t i = 0; i < c->clusters.count; i++) {
        const struct cluster *cluster = &c->clusters.at[i];
        for (uint32_t j = cluster->first; j < cluster->first + cluster->count; j++)
            owner_of[c->order.at[j]] = b->nesting.owner.at[i];
    }
}

static bool gather_items(struct builder *b)
{
    struct memory *m = &b->build->a->memory;
    struct ids owner_of = {NULL, 0, 0};
    bool fine = count_items(b);
    if (!fine)
        return false;
    const size_t total = b->begin.at[b->begin.count - 1];
    fine = (array_extend(m, &owner_of, b->build->a->prims.count) &&
            array_extend(m, &b->items, total)) ||
           accel_build_no_memory(b->build);
    if (fine) {
        find_owners(b, owner_of.at);
        fine = enter_items(b, owner_of.at);
        memmove(b->begin.at + 1, b->begin.at, (b->begin.count - 1) * sizeof *b->begin.at);
        b->begin.at[0] = 0;
    }
    array_free(m, &owner_of);
    return fine;
}

/* ------------------------------------------------------------------- crowded cells ---- */

/* The closed range of the cell of a brick's bit. */
static accel_box cell_box(const struct grid_pool *pool, const struct grid *g, size_t brick,
                          uint32_t bit)
{
    const size_t local = brick - g->brick, row = local / g->bricks[0];
    const size_t at[3] = {local % g->bricks[0], row % g->bricks[1], row / g->bricks[1]};
    accel_box box;
    for (int k = 0; k < 3; k++) {
        const size_t i = GRID_BRICK * at[k] + (bit >> 2 * k) % GRID_BRICK;
        box.lo[k] = pool->planes.at[g->plane[k] + i];
        box.hi[k] = pool->planes.at[g->plane[k] + i + 1];
    }
    return box;
}

/* The part of a cell that its items fill. */
static accel_box filled_part(const struct builder *b, const accel_box *cell,
                             struct grid_items items)
{
    accel_box box = box_empty();
    for (size_t i = 0; i < items.count; i++)
        box_add(&box, grid_item_box(&b->build->a->prims, &b->h->pool, items.at[i]));
    for (int k = 0; k < 3; k++) {
        box.lo[k] = box.lo[k] > cell->lo[k] ? box.lo[k] : cell->lo[k];
        box.hi[k] = box.hi[k] < cell->hi[k] ? box.hi[k] : cell->hi[k];
    }
    return box;
}

/* The share of an item's tests that a cell is to blame for. A line tests an item in the first of
 * the cells that it meets; of a block of cells it meets as many times more cells than blocks as the
 * sum of the cells' surfaces is larger than the block's. */
static double blame(const accel_box *item, const accel_box *cell)
{
    double side[3], span[3];
    for (int k = 0; k < 3; k++) {
        side[k] = cell->hi[k] - cell->lo[k];
        span[k] = side[k] > 0.0 ? (item->hi[k] - item->lo[k]) / side[k] + 1.0 : 1.0;
        span[k] = item->lo[k] < cell->lo[k] || item->hi[k] > cell->hi[k] ? span[k] : 1.0;
    }
    const double one = side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
    const double block =
        side[0] * side[1] / span[2] + side[1] * side[2] / span[0] + side[2] * side[0] / span[1];
    return one > 0.0 && block < one ? block / one : 1.0;
}

static double mean_blame(const struct builder *b, const accel_box *cell, struct grid_items items)
{
    double sum = 0.0;
    for (size_t i = 0; i < items.count; i++)
        sum += blame(grid_item_box(&b->build->a->prims, &b->h->pool, items.at[i]), cell);
    return sum / (double)items.count;
}

/* Would a cell be cheaper as a grid, and which? */
static bool worth_a_grid(const struct builder *b, const accel_box *cell, const accel_box *box,
                         struct grid_items items, struct grid_plan *plan)
{
    const struct primitives *p = &b->build->a->prims;
    const double share = mean_blame(b, cell, items), chance = box_chance(box, cell);
    const double list = share * accel_grid_list_cost(p, items);
    if (list <= chance * COST_GRID_BEGIN)
        return false;
    *plan = accel_grid_plan(p, &b->h->pool, box, items, b->build->a->option[HUG_DENSITY]);
    if (plan->cells[0] == 1 && plan->cells[1] == 1 && plan->cells[2] == 1)
        return false;
    return chance * (plan->cost - (1.0 - share) * plan->tests) < list;
}

static bool may_refine(struct builder *b, size_t count)
{
    const struct primitives *p = &b->build->a->prims;
    if (count <= CROWDED)
        return false;
    const size_t used = b->h->pool.refs.count + b->stack.count;
    if (used < BUDGET * (p->bounded.count + 256) && p->count + b->h->pool.grids.count < ACCEL_NONE)
        return true;
    b->full = true;
    return false;
}

/* Notes that the grids among the items lie in one of depth `depth`. */
static void deepen(struct builder *b, struct grid_items items, uint32_t depth)
{
    const uint32_t ids = b->build->a->prims.count;
    for (size_t i = items.count; i > 0 && items.at[i - 1] >= ids; i--) {
        struct grid *inner = &b->h->pool.grids.at[items.at[i - 1] - ids];
        inner->depth = inner->depth > depth ? inner->depth : depth + 1;
    }
}

/* Makes a grid of a cell's list, of depth `depth`, to be built later. */
static bool add_job(struct builder *b, const accel_box *box, uint32_t depth,
                    struct grid_items items, const struct grid_plan *plan)
{
    struct memory *m = &b->build->a->memory;
    struct grid_pool *pool = &b->h->pool;
    const struct job job = {*plan, pool->grids.count, b->stack.count, items.count};
    if (!array_extend(m, &b->jobs, 1) || !array_extend(m, &b->stack, items.count) ||
        !array_extend(m, &pool->grids, 1))
        return accel_build_no_memory(b->build);
    memcpy(b->stack.at + job.begin, items.at, items.count * sizeof *items.at);
    b->jobs.at[b->jobs.count - 1] = job;
    pool->grids.at[job.number] = (struct grid){.box = *box, .depth = depth, .cell = 1};
    deepen(b, items, depth);
    return true;
}

/* The list of one cell, whose box is `cell`: makes it a job if that pays. False: no memory. */
static bool consider(struct builder *b, const struct grid *g, const accel_box *cell,
                     struct grid_items items, bool *taken)
{
    struct grid_plan plan;
    *taken = false;
    if (!may_refine(b, items.count))
        return true;
    const accel_box box = filled_part(b, cell, items);
    if (!worth_a_grid(b, cell, &box, items, &plan))
        return true;
    *taken = true;
    return add_job(b, &box, g->depth + 1, items, &plan);
}

/* Takes the lists out of those cells of the grid just built that are better grids. */
static bool take_crowded(struct builder *b, size_t number, struct span span)
{
    struct grid_pool *pool = &b->h->pool;
    const struct grid g = pool->grids.at[number];
    size_t slot;
    const size_t cells = grid_slots(pool, &g, &slot);
    size_t left = cells, begin = pool->starts.at[slot], to = begin;
    for (size_t brick = g.brick; left > 0; brick++) {
        for (uint64_t mask = pool->masks.at[brick]; mask; mask &= mask - 1, slot++, left--) {
            const uint32_t bit = (uint32_t)__builtin_ctzll(mask);
            const accel_box cell = cell_box(pool, &g, brick, bit);
            const struct grid_items items = {pool->refs.at + begin,
                                             pool->starts.at[slot + 1] - begin};
            bool taken;
            if (!consider(b, &g, &cell, items, &taken))
                return false;
            pool->starts.at[slot] = (uint32_t)to;
            if (taken)
                pool->refs.at[to++] =
                    b->build->a->prims.count + (uint32_t)b->jobs.at[b->jobs.count - 1].number;
            else
                memmove(pool->refs.at + to, items.at, items.count * sizeof *items.at);
            to += taken ? 0 : items.count;
            begin += items.count;
        }
        if (!accel_build_tick(b->build, part_of(span, cells - left, cells, cells).from))
            return false;
    }
    pool->starts.at[slot] = (uint32_t)to;
    pool->refs.count = to;
    return true;
}

/* Builds the grids that stand for cells of the grid just built, and those inside them. */
static bool refine(struct builder *b, size_t number, uint32_t nesting, struct span span)
{
    const size_t first = b->jobs.count, stacked = b->stack.count;
    if (nesting == HUG_MAX_CELL_NESTING)
        return true;
    if (!take_crowded(b, number, first_half(span)))
        return false;
    const size_t last = b->jobs.count, all = b->stack.count - stacked;
    for (size_t i = first; i < last; i++) {
        struct job job = b->jobs.at[i];
        const size_t before = job.begin - stacked;
        const struct grid_items items = {b->stack.at + job.begin, job.count};
        const struct span its = part_of(second_half(span), before, before + job.count, all);
        const struct span own = first_half(its);
        if (!accel_grid_build(b->build, &b->h->pool, job.number, items, &job.plan, own.from,
                              own.to) ||
            !refine(b, job.number, nesting + 1, second_half(its)))
            return false;
    }
    b->jobs.count = first;
    b->stack.count = stacked;
    return true;
}

/* ---------------------------------------------------------------------- the whole ---- */

static bool build_grid(struct builder *b, size_t number)
{
    const accel *a = b->build->a;
    struct grid_pool *pool = &b->h->pool;
    const accel_box *box = &pool->grids.at[number].box;
    const size_t begin = b->begin.at[number];
    const struct grid_items items = {b->items.at + begin, b->begin.at[number + 1] - begin};
    const bool paper = a->option[HUG_FORM] == HUG_FORM_PAPER;
    struct grid_plan plan =
        paper ? accel_grid_plan_given(box, (uint32_t)a->option[HUG_CELLS])
              : accel_grid_plan(&a->prims, pool, box, items, a->option[HUG_DENSITY]);
    const struct span its =
        part_of((struct span){0.0, 1.0}, begin, begin + items.count, b->items.count);
    const struct span own = paper ? its : first_half(its);
    deepen(b, items, pool->grids.at[number].depth);
    if (!accel_grid_build(b->build, pool, number, items, &plan, own.from, own.to))
        return false;
    b->coarser |= plan.coarser;
    return (paper || refine(b, number, 0, second_half(its))) &&
           build_step(b->build, GRID_WORK, its.to);
}

static void describe(const struct builder *b)
{
    accel_info *info = &b->build->a->info;
    const struct grid_pool *pool = &b->h->pool;
    info->size_classes = b->clustering.size_classes;
    info->clusters = (uint32_t)b->clustering.clusters.count;
    info->nodes = pool->grids.count;
    info->leaves = pool->starts.count - 1;
    info->references = pool->refs.count;
    for (size_t i = 0; i < pool->grids.count; i++)
        info->depth =
            pool->grids.at[i].depth + 1 > info->depth ? pool->grids.at[i].depth + 1 : info->depth;
}

static void note(const struct builder *b)
{
    const struct grid_pool *pool = &b->h->pool;
    const size_t lists = b->nesting.lists, clusters = b->clustering.clusters.count;
    const size_t made = accel_grid_pool_bytes(pool);
    if (clusters == 1)
        accel_build_left_out(b->build, GRID_LEAST_BYTES, made,
                             "one cluster: no grid above its grid");
    else if (lists > 0)
        accel_build_left_out(b->build, lists * GRID_LEAST_BYTES, made,
                             "%zu of %zu clusters are short: items of the grid around, no grids",
                             lists, clusters);
    accel_grid_note_empty(b->build, pool);
    if (b->coarser)
        accel_build_note(b->build,
                         "some grids are coarser than asked for: for memory in proportion, "
                         "or as cells list most items");
    if (b->full)
        accel_build_note(
            b->build, "crowded cells stayed lists: %d references per primitive were met", BUDGET);
}

static bool run(struct builder *b)
{
    struct build *build = b->build;
    const double *option = build->a->option;
    accel_note_idle_option(build, option[HUG_FORM] == HUG_FORM_PAPER ? HUG_DENSITY : HUG_CELLS,
                           option[HUG_FORM] == HUG_FORM_PAPER ? "form=paper" : "form=density");
    const struct cluster_rule rule = {option[HUG_CONNECTIVITY], option[HUG_OCTAVES]};
    accel_build_phase(build, "clusters");
    if (!accel_cluster_scene(build, &b->clustering, rule, 0.0, 1.0))
        return false;
    accel_build_phase(build, "nesting");
    if (!accel_hug_nest(build, &b->h->pool, &b->clustering, &b->nesting) || !gather_items(b))
        return false;
    accel_build_phase(build, "grids");
    for (size_t i = 0; i + 1 < b->begin.count; i++)
        if (!build_grid(b, i))
            return false;
    accel_grid_pool_trim(&build->a->memory, &b->h->pool);
    describe(b);
    note(b);
    return true;
}

bool accel_hug_build(struct build *build)
{
    struct builder b = {.build = build, .h = (struct hug *)build->a};
    struct memory *m = &build->a->memory;
    const bool fine = run(&b);
    accel_cluster_free(m, &b.clustering);
    accel_hug_nesting_free(m, &b.nesting);
    array_free(m, &b.items);
    array_free(m, &b.begin);
    array_free(m, &b.stack);
    array_free(m, &b.jobs);
    return fine;
}
