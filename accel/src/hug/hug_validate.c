/* SPDX-License-Identifier: Apache-2.0
 *
 * Checks a hierarchy of grids against its definition: finds out what each cluster's grid lists, in
 * its cells and in the grids that stand for them; checks that every bounded primitive and every
 * cluster's grid but the first has one owner; then that each grid lists its items where they
 * belong.
 */
#include "hug.h"

#include <stdlib.h>

struct checker {
    const accel *a;               /* the structure */
    const struct grid_pool *pool; /* of its grids */
    accel_error *error;           /* the first violation */
    uint32_t *owner; /* by reference: the cluster's grid that lists it or in which it stands for a
                       cell, or ACCEL_NONE */
    size_t *begin;   /* by grid: its run in items; two more at the end */
    uint32_t *items; /* grid after grid, each run rising */
};

static bool broken(const struct checker *c, const char *what, size_t number)
{
    accel_error_set(c->error, ACCEL_BROKEN, "%s: %s %zu", c->a->info.kind, what, number);
    return false;
}

static size_t references(const struct checker *c)
{
    return c->a->prims.count + c->pool->grids.count;
}

static bool find_owners(const struct checker *c, size_t number, uint32_t owner);

/* Notes that the grid lists a reference. */
static bool find_owner(const struct checker *c, const struct grid *g, uint32_t ref, uint32_t owner)
{
    const uint32_t ids = c->a->prims.count, before = c->owner[ref];
    const struct grid *inner = ref < ids ? NULL : &c->pool->grids.at[ref - ids];
    const bool cell = inner && inner->cell;
    if (inner && inner->depth <= g->depth)
        return broken(c, "a grid is not deeper than the one around it, number", ref - ids);
    if (before != ACCEL_NONE && (cell || before != owner))
        return broken(c, "two grids or cells list item", ref);
    c->owner[ref] = owner;
    return !cell || find_owners(c, ref - ids, owner);
}

/* Notes what a grid lists as at owner in `owner`, going into the grids that stand for its cells. */
static bool find_owners(const struct checker *c, size_t number, uint32_t owner)
{
    const struct grid *g = &c->pool->grids.at[number];
    size_t slot;
    const size_t count = grid_slots(c->pool, g, &slot);
    for (size_t i = c->pool->starts.at[slot]; i < c->pool->starts.at[slot + count]; i++) {
        const uint32_t ref = c->pool->refs.at[i];
        if (ref >= references(c))
            return broken(c, "a cell names a grid that does not exist,", ref - c->a->prims.count);
        if (!find_owner(c, g, ref, owner))
            return false;
    }
    return true;
}

/* Is it an item of a cluster's grid? */
static bool is_item(const struct checker *c, uint32_t ref)
{
    const uint32_t ids = c->a->prims.count;
    return c->owner[ref] != ACCEL_NONE && (ref < ids || !c->pool->grids.at[ref - ids].cell);
}

/* Has everything an owner that should have one? Counts the items by owner. */
static bool count_items(const struct checker *c)
{
    const struct primitives *p = &c->a->prims;
    for (size_t i = 0; i < p->bounded.count; i++)
        if (c->owner[p->bounded.at[i]] == ACCEL_NONE)
            return broken(c, "no grid lists primitive", p->bounded.at[i]);
    for (uint32_t ref = 0; ref < references(c); ref++) {
        if (ref >= p->count && (c->owner[ref] == ACCEL_NONE) != (ref == p->count))
            return broken(c, "a grid has no home, or the first has one, number", ref - p->count);
        if (is_item(c, ref))
            c->begin[c->owner[ref] + 1]++;
    }
    for (size_t i = 0; i < c->pool->grids.count; i++)
        c->begin[i + 1] += c->begin[i];
    return true;
}

/* Checks every cluster's grid over its items. */
static bool check_grids(const struct checker *c)
{
    for (uint32_t ref = 0; ref < references(c); ref++)
        if (is_item(c, ref))
            c->items[c->begin[c->owner[ref]]++] = ref;
    for (size_t i = 0, begin = 0; i < c->pool->grids.count; begin = c->begin[i++])
        if (!c->pool->grids.at[i].cell &&
            !accel_grid_validate(c->a, c->pool, i,
                                 (struct grid_items){c->items + begin, c->begin[i] - begin},
                                 c->error))
            return false;
    return true;
}

static bool check(const struct checker *c)
{
    for (uint32_t ref = 0; ref < references(c); ref++)
        c->owner[ref] = ACCEL_NONE;
    if (c->a->info.depth > HUG_MAX_DEPTH)
        return broken(c, "grids lie too deep, at", c->a->info.depth);
    for (size_t i = 0; i < c->pool->grids.count; i++)
        if (!accel_grid_validate_frame(c->a, c->pool, i, c->error))
            return false;
    for (size_t i = 0; i < c->pool->grids.count; i++)
        if (!c->pool->grids.at[i].cell && !find_owners(c, i, (uint32_t)i))
            return false;
    return count_items(c) && check_grids(c);
}

bool accel_hug_validate(const accel *a, accel_error *error)
{
    struct checker c = {.a = a, .pool = &((const struct hug *)a)->pool, .error = error};
    c.owner = malloc(references(&c) * sizeof *c.owner);
    c.items = malloc(references(&c) * sizeof *c.items);
    c.begin = calloc(c.pool->grids.count + 2, sizeof *c.begin);
    bool fine = false;
    if (c.owner && c.items && c.begin)
        fine = check(&c);
    else
        accel_error_set(error, ACCEL_NO_MEMORY, "validate: no memory for %zu items",
                        references(&c));
    free(c.owner);
    free(c.items);
    free(c.begin);
    return fine;
}
