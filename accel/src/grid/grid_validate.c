/* SPDX-License-Identifier: Apache-2.0
 *
 * Checks a grid against its definition, independently of how it was built: every item is searched
 * for among the planes and sent to the cells that its box meets; what arrives in a cell must be
 * what the cell lists, or what the grid lists that stands for the cell.
 */
#include "grid.h"

#include <stdlib.h>
#include <string.h>

/* One grid being checked. */
struct checker {
    const accel *a;               /* the structure */
    const struct grid_pool *pool; /* of its grids */
    const struct grid *grid;      /* the one */
    struct grid_items items;      /* what it should be made of */
    accel_error *error;           /* the first violation */
    size_t first, cells;          /* its cells in starts */
    size_t *start;                /* by cell: its run in list; one more at the end */
    uint32_t *list;               /* what should be listed, cell after cell */
};

static bool broken(const struct checker *c, const char *what, size_t number)
{
    accel_error_set(c->error, ACCEL_BROKEN, "%s: %s %zu", c->a->info.kind, what, number);
    return false;
}

static bool check_planes(const struct checker *c, int k)
{
    const struct grid *g = c->grid;
    const uint32_t cells = g->cells[k];
    if (cells == 0 || g->bricks[k] != cells / GRID_BRICK + (cells % GRID_BRICK > 0))
        return broken(c, "the bricks do not hold the cells of axis", (size_t)k);
    if (g->plane[k] >= c->pool->planes.count ||
        g->bricks[k] > (c->pool->planes.count - g->plane[k] - 1) / GRID_BRICK)
        return broken(c, "the planes end behind the pool, axis", (size_t)k);
    const double *plane = c->pool->planes.at + g->plane[k];
    if (plane[0] != g->box.lo[k] || plane[cells] != g->box.hi[k])
        return broken(c, "the planes do not span the box, axis", (size_t)k);
    for (uint32_t i = 0; i < cells; i++)
        if (!(plane[i] < plane[i + 1]) && !(cells == 1 && plane[0] == plane[1]))
            return broken(c, "the planes do not rise at", i);
    for (uint32_t i = cells; i < GRID_BRICK * g->bricks[k]; i++)
        if (plane[i + 1] != plane[i])
            return broken(c, "a cell lies behind the box, at", i);
    return true;
}

/* Are so many bricks in the pool from the grid's first on? Their number may be beyond any type. */
static bool bricks_fit(const struct grid *g, const struct grid_pool *pool)
{
    if (g->brick >= pool->masks.count)
        return false;
    size_t most = pool->masks.count - g->brick;
    for (int k = 0; k < 3; k++)
        most /= g->bricks[k];
    return most > 0;
}

/* Are the runs of the cells where they should be? Finds first and cells. */
static bool check_bricks(struct checker *c)
{
    const struct grid *g = c->grid;
    const struct grid_pool *pool = c->pool;
    if (!bricks_fit(g, pool) || pool->firsts.count != pool->masks.count)
        return broken(c, "the bricks end behind the pool, first", g->brick);
    const size_t bricks = (size_t)g->bricks[0] * g->bricks[1] * g->bricks[2];
    c->first = pool->firsts.at[g->brick];
    for (size_t i = g->brick; i < g->brick + bricks; i++) {
        if (pool->firsts.at[i] != c->first + c->cells)
            return broken(c, "a brick's cells are out of place, brick", i);
        c->cells += (size_t)__builtin_popcountll(pool->masks.at[i]);
    }
    if (c->first + c->cells >= pool->starts.count)
        return broken(c, "the cells end behind the pool, first", c->first);
    for (size_t i = c->first; i < c->first + c->cells; i++)
        if (pool->starts.at[i] >= pool->starts.at[i + 1] ||
            pool->starts.at[i + 1] > pool->refs.count)
            return broken(c, "the references are out of place, cell", i);
    return true;
}

/* The cells of axis k whose closed range meets [lo, hi]: those from *first to *last. */
static void search(const struct checker *c, int k, double lo, double hi, uint32_t *first,
                   uint32_t *last)
{
    const double *plane = c->pool->planes.at + c->grid->plane[k];
    const uint32_t cells = c->grid->cells[k];
    uint32_t low = 0, high = cells - 1;
    while (low < high) {
        const uint32_t middle = (low + high) / 2;
        if (plane[middle + 1] >= lo)
            high = middle;
        else
            low = middle + 1;
    }
    *first = low;
    high = cells - 1;
    while (low < high) {
        const uint32_t middle = (low + high + 1) / 2;
        if (plane[middle] <= hi)
            low = middle;
        else
            high = middle - 1;
    }
    *last = low;
}

/* Sends an item to its cells: counts it, or, if `enter`, enters it in the list. */
static bool send(struct checker *c, uint32_t ref, bool enter)
{
    const struct grid *g = c->grid;
    const accel_box *b = grid_item_box(&c->a->prims, c->pool, ref);
    uint32_t lo[3], hi[3];
    if (g->cell ? !box_overlaps(&g->box, b) : !box_contains(&g->box, b))
        return broken(c, "the box does not contain item", ref);
    for (int k = 0; k < 3; k++)
        search(c, k, b->lo[k], b->hi[k], &lo[k], &hi[k]);
    for (uint32_t z = lo[2]; z <= hi[2]; z++) {
        for (uint32_t y = lo[1]; y <= hi[1]; y++) {
            for (uint32_t x = lo[0]; x <= hi[0]; x++) {
                const size_t row = y / 4 + (size_t)g->bricks[1] * (z / 4);
                const size_t brick = g->brick + x / 4 + g->bricks[0] * row;
                const uint32_t bit = x % 4 + 4 * (y % 4) + 16 * (z % 4);
                if (!(c->pool->masks.at[brick] >> bit & 1))
                    return broken(c, "an empty cell meets item", ref);
                const size_t cell = grid_slot(c->pool, brick, bit) - c->first;
                if (enter)
                    c->list[c->start[cell]++] = ref;
                else
                    c->start[cell + 1]++;
            }
        }
    }
    return true;
}

/* Fills start and list. */
static bool send_all(struct checker *c)
{
    c->start = calloc(c->cells + 2, sizeof *c->start);
    if (!c->start) {
        accel_error_set(c->error, ACCEL_NO_MEMORY, "validate: no memory for %zu cells", c->cells);
        return false;
    }
    for (size_t i = 0; i < c->items.count; i++)
        if (!send(c, c->items.at[i], false))
            return false;
    for (size_t i = 0; i < c->cells; i++)
        c->start[i + 1] += c->start[i];
    const size_t total = c->start[c->cells];
    c->list = malloc((total ? total : 1) * sizeof *c->list);
    if (!c->list) {
        accel_error_set(c->error, ACCEL_NO_MEMORY, "validate: no memory for %zu references", total);
        return false;
    }
    for (size_t i = 0; i < c->items.count; i++)
        if (!send(c, c->items.at[i], true))
            return false;
    memmove(c->start + 1, c->start, c->cells * sizeof *c->start);
    c->start[0] = 0;
    return true;
}

/* Compares what a cell lists with what it should list. */
static bool check_cell(const struct checker *c, size_t cell)
{
    const uint32_t *at = c->pool->refs.at + c->pool->starts.at[c->first + cell];
    const size_t count =
        c->pool->starts.at[c->first + cell + 1] - (size_t)c->pool->starts.at[c->first + cell];
    const struct grid_items want = {c->list + c->start[cell], c->start[cell + 1] - c->start[cell]};
    const uint32_t ids = c->a->prims.count;
    if (at[0] >= ids && at[0] - ids >= c->pool->grids.count)
        return broken(c, "a cell names a grid that does not exist,", at[0] - ids);
    const struct grid *inner = at[0] < ids ? NULL : &c->pool->grids.at[at[0] - ids];
    if (inner && inner->cell)
        return count == 1 && inner->depth > c->grid->depth
                   ? accel_grid_validate(c->a, c->pool, at[0] - ids, want, c->error)
                   : broken(c, "not alone in its cell, or not below the one around, grid",
                            at[0] - ids);
    if (count != want.count || memcmp(at, want.at, count * sizeof *at) != 0)
        return broken(c, "a cell does not list what it meets, cell", c->first + cell);
    return true;
}

bool accel_grid_validate_frame(const accel *a, const struct grid_pool *pool, size_t number,
                               accel_error *error)
{
    struct checker c = {.a = a, .pool = pool, .grid = &pool->grids.at[number], .error = error};
    if (c.grid->depth >= a->info.depth || c.grid->cell > 1)
        return broken(&c, "too deep, or neither of a cell nor of a cluster, grid", number);
    return check_planes(&c, 0) && check_planes(&c, 1) && check_planes(&c, 2) && check_bricks(&c);
}

bool accel_grid_validate(const accel *a, const struct grid_pool *pool, size_t number,
                         struct grid_items items, accel_error *error)
{
    struct checker c = {
        .a = a, .pool = pool, .grid = &pool->grids.at[number], .items = items, .error = error};
    bool fine =
        accel_grid_validate_frame(a, pool, number, error) && check_bricks(&c) && send_all(&c);
    for (size_t i = 0; fine && i < c.cells; i++)
        fine = check_cell(&c, i);
    free(c.start);
    free(c.list);
    return fine;
}
