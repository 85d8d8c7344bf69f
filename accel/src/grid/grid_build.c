/* SPDX-License-Identifier: Apache-2.0
 *
 * Building a grid in time linear in its references: one pass over the items marks the cells that
 * will hold something, a second counts their references, a third, backwards, fills them in. So the
 * references of a cell keep the order of the items, and no cell that stays empty costs memory.
 */
#include "grid.h"

#include <string.h>

/* One grid being built. */
struct maker {
    struct build *build;     /* the build under way */
    struct grid_pool *pool;  /* that the grid's parts go into */
    const struct grid *grid; /* the grid */
    struct grid_items items; /* what it is made of */
    double from, to;         /* progress of the whole */
    double done;             /* of the passes, in 0..3 */
    uint64_t total;          /* references */
};

/* Does something for one cell that an item meets. */
typedef void cell_action(struct maker *m, size_t brick, uint32_t bit, uint32_t ref);

static bool too_many(struct build *build)
{
    accel_error_set(
        build->error, ACCEL_TOO_LARGE,
        "build %s: more than 4294967295 references; nothing was built, a lower density makes "
        "fewer",
        build->kind);
    return false;
}

/* Writes the planes of an axis; false if they do not rise. */
static bool lay_planes(double *plane, double lo, double hi, uint32_t cells, uint32_t bricks)
{
    const double width = hi - lo;
    plane[0] = lo;
    for (uint32_t i = 1; i < cells; i++) {
        plane[i] = lo + width * i / cells;
        if (!(plane[i - 1] < plane[i] && plane[i] < hi))
            return false;
    }
    for (uint32_t i = cells; i <= GRID_BRICK * bricks; i++)
        plane[i] = hi;
    return true;
}

/* Lays the planes of axis k, fewer where the axis is too thin for so many to differ. */
static bool make_axis(struct build *build, struct grid_pool *pool, struct grid *g, int k,
                      uint32_t cells)
{
    g->plane[k] = pool->planes.count;
    g->bricks[k] = (cells + GRID_BRICK - 1) / GRID_BRICK;
    if (!array_extend(&build->a->memory, &pool->planes, GRID_BRICK * (size_t)g->bricks[k] + 1))
        return accel_build_no_memory(build);
    while (
        !lay_planes(pool->planes.at + g->plane[k], g->box.lo[k], g->box.hi[k], cells, g->bricks[k]))
        cells /= 2;
    g->bricks[k] = (cells + GRID_BRICK - 1) / GRID_BRICK;
    g->cells[k] = cells;
    g->scale[k] = cells > 1 ? cells / (g->box.hi[k] - g->box.lo[k]) : 0.0;
    pool->planes.count = g->plane[k] + GRID_BRICK * (size_t)g->bricks[k] + 1;
    return true;
}

static bool make_bricks(struct build *build, struct grid_pool *pool, struct grid *g)
{
    const size_t bricks = (size_t)g->bricks[0] * g->bricks[1] * g->bricks[2];
    g->brick = pool->masks.count;
    if (!array_extend(&build->a->memory, &pool->masks, bricks) ||
        !array_extend(&build->a->memory, &pool->firsts, bricks))
        return accel_build_no_memory(build);
    memset(pool->masks.at + g->brick, 0, bricks * sizeof *pool->masks.at);
    return true;
}

/* The cells of axis k whose closed range meets [lo, hi]. */
static void cells_met(const struct maker *m, int k, double lo, double hi, uint32_t *first,
                      uint32_t *last)
{
    const struct grid *g = m->grid;
    const double *plane = m->pool->planes.at + g->plane[k];
    const uint32_t end = g->cells[k] - 1;
    const double low = (lo - plane[0]) * g->scale[k], high = (hi - plane[0]) * g->scale[k];
    uint32_t i = !(low > 0.0) ? 0 : low < end ? (uint32_t)low : end;
    uint32_t j = !(high > 0.0) ? 0 : high < end ? (uint32_t)high : end;
    while (i > 0 && plane[i] >= lo)
        i--;
    while (i < end && plane[i + 1] < lo)
        i++;
    while (j > 0 && plane[j] > hi)
        j--;
    while (j < end && plane[j + 1] <= hi)
        j++;
    *first = i;
    *last = j;
}

/* Acts on every cell that the item meets; returns their number. */
static inline size_t for_cells(struct maker *m, uint32_t ref, cell_action *action)
{
    const accel_box *b = grid_item_box(&m->build->a->prims, m->pool, ref);
    const struct grid *g = m->grid;
    uint32_t lo[3], hi[3];
    for (int k = 0; k < 3; k++)
        cells_met(m, k, b->lo[k], b->hi[k], &lo[k], &hi[k]);
    for (uint32_t z = lo[2]; z <= hi[2]; z++) {
        for (uint32_t y = lo[1]; y <= hi[1]; y++) {
            const size_t row = g->brick + g->bricks[0] * (y / GRID_BRICK +
                                                          (size_t)g->bricks[1] * (z / GRID_BRICK));
            const uint32_t bit = 4 * (y % GRID_BRICK) + 16 * (z % GRID_BRICK);
            for (uint32_t x = lo[0]; x <= hi[0]; x++)
                action(m, row + x / GRID_BRICK, bit + x % GRID_BRICK, ref);
        }
    }
    return (size_t)(hi[0] - lo[0] + 1) * (hi[1] - lo[1] + 1) * (hi[2] - lo[2] + 1);
}

static void mark_cell(struct maker *m, size_t brick, uint32_t bit, uint32_t ref)
{
    (void)ref;
    m->pool->masks.at[brick] |= (uint64_t)1 << bit;
    m->total++;
}

static void count_reference(struct maker *m, size_t brick, uint32_t bit, uint32_t ref)
{
    (void)ref;
    m->pool->starts.at[grid_slot(m->pool, brick, bit)]++;
}

static void fill_in(struct maker *m, size_t brick, uint32_t bit, uint32_t ref)
{
    m->pool->refs.at[--m->pool->starts.at[grid_slot(m->pool, brick, bit)]] = ref;
}

/* Reports progress: `references` more, after `finished` items of a pass. */
static inline bool tick(struct maker *m, size_t references, size_t finished)
{
    const double done = (m->done + (double)finished / (double)m->items.count) / 3.0;
    return build_step(m->build, references, m->from + (m->to - m->from) * done);
}

static inline bool pass(struct maker *m, cell_action *action)
{
    for (size_t i = m->items.count; i-- > 0;) {
        const size_t references = for_cells(m, m->items.at[i], action);
        if (!tick(m, references, m->items.count - i))
            return false;
    }
    m->done += 1.0;
    return true;
}

/* Gives the marked cells their places in starts, with no references yet. */
static bool number_cells(struct maker *m)
{
    struct grid_pool *pool = m->pool;
    const size_t last = pool->starts.count ? pool->starts.count - 1 : 0;
    size_t cells = 0;
    for (size_t i = m->grid->brick; i < pool->masks.count; i++) {
        pool->firsts.at[i] = (uint32_t)(last + cells);
        cells += (size_t)__builtin_popcountll(pool->masks.at[i]);
    }
    if (pool->refs.count + m->total > ACCEL_NONE)
        return too_many(m->build);
    if (!array_extend(&m->build->a->memory, &pool->starts, last + cells + 1 - pool->starts.count))
        return accel_build_no_memory(m->build);
    memset(pool->starts.at + last, 0, (cells + 1) * sizeof *pool->starts.at);
    return true;
}

/* Turns the counts of references into the ends of their runs. */
static bool place_runs(struct maker *m)
{
    struct grid_pool *pool = m->pool;
    size_t end = pool->refs.count;
    for (size_t i = pool->firsts.at[m->grid->brick]; i < pool->starts.count; i++) {
        end += pool->starts.at[i];
        pool->starts.at[i] = (uint32_t)end;
    }
    return array_extend(&m->build->a->memory, &pool->refs, m->total) ||
           accel_build_no_memory(m->build);
}

static bool make_frame(struct maker *m, struct grid *g, const uint32_t cells[3])
{
    for (int k = 0; k < 3; k++)
        if (!make_axis(m->build, m->pool, g, k, cells[k]))
            return false;
    return make_bricks(m->build, m->pool, g);
}

/* Marks cells until there are more references than `budget`. */
static bool mark_until(struct maker *m, double budget)
{
    m->total = 0;
    for (size_t i = 0; i < m->items.count && (double)m->total <= budget; i++) {
        const size_t references = for_cells(m, m->items.at[i], mark_cell);
        if (!tick(m, references, i))
            return false;
    }
    m->done = 1.0;
    return true;
}

/* Do the lists hold most of the items each? Such cells save no tests: piles have them. */
static bool is_pile(const struct maker *m, const struct grid_plan *plan)
{
    const size_t cells = (size_t)plan->cells[0] * plan->cells[1] * plan->cells[2];
    size_t marked = 0;
    for (size_t i = m->grid->brick; cells > 1 && i < m->pool->masks.count; i++)
        marked += (size_t)__builtin_popcountll(m->pool->masks.at[i]);
    return 2.0 * (double)m->total > (double)m->items.count * (double)marked && marked > 1;
}

/* Frames the grid and marks its cells, coarser until the references are within bounds. */
static bool mark_cells(struct maker *m, struct grid *g, struct grid_plan *plan)
{
    const double budget = accel_grid_plan_references(plan, m->items.count);
    const size_t planes = m->pool->planes.count, bricks = m->pool->masks.count;
    for (;;) {
        while (!accel_grid_plan_fits(plan, m->items.count))
            accel_grid_coarsen(plan);
        if (!make_frame(m, g, plan->cells) || !mark_until(m, budget))
            return false;
        const bool over = (double)m->total > budget;
        if (!over && !is_pile(m, plan))
            return true;
        m->pool->planes.count = planes;
        m->pool->masks.count = m->pool->firsts.count = bricks;
        m->done = 0.0;
        if (over)
            accel_grid_coarsen(plan);
        else
            accel_grid_give_up(plan);
    }
}

bool accel_grid_build(struct build *build, struct grid_pool *pool, size_t number,
                      struct grid_items items, struct grid_plan *plan, double from, double to)
{
    struct grid *g = &pool->grids.at[number];
    struct maker m = {
        .build = build, .pool = pool, .grid = g, .items = items, .from = from, .to = to};
    return mark_cells(&m, g, plan) && number_cells(&m) && pass(&m, count_reference) &&
           place_runs(&m) && pass(&m, fill_in);
}

size_t accel_grid_pool_bytes(const struct grid_pool *p)
{
    return p->grids.count * sizeof *p->grids.at + p->planes.count * sizeof *p->planes.at +
           p->masks.count * (sizeof *p->masks.at + sizeof *p->firsts.at) +
           (p->starts.count + p->refs.count) * sizeof(uint32_t);
}

void accel_grid_note_empty(struct build *build, const struct grid_pool *pool)
{
    size_t cells = 0;
    for (size_t i = 0; i < pool->grids.count; i++) {
        const uint32_t *n = pool->grids.at[i].cells;
        cells += (size_t)n[0] * n[1] * n[2];
    }
    const size_t empty = cells - (pool->starts.count - 1);
    const size_t places = empty * sizeof *pool->starts.at;
    const size_t masks = pool->masks.count * (sizeof *pool->masks.at + sizeof *pool->firsts.at);
    if (places > masks)
        accel_build_left_out(build, places - masks, accel_grid_pool_bytes(pool),
                             "%zu of %zu cells are empty: not stored (%zu bytes of bit masks)",
                             empty, cells, masks);
}

void accel_grid_pool_trim(struct memory *m, struct grid_pool *pool)
{
    array_trim(m, &pool->grids);
    array_trim(m, &pool->planes);
    array_trim(m, &pool->masks);
    array_trim(m, &pool->firsts);
    array_trim(m, &pool->starts);
    array_trim(m, &pool->refs);
}

void accel_grid_pool_free(struct memory *m, struct grid_pool *pool)
{
    array_free(m, &pool->grids);
    array_free(m, &pool->planes);
    array_free(m, &pool->masks);
    array_free(m, &pool->firsts);
    array_free(m, &pool->starts);
    array_free(m, &pool->refs);
}
