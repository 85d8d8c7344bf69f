/* SPDX-License-Identifier: Apache-2.0
 *
 * Which cluster's grid lies in which: in the one of smallest surface that contains it.
 *
 * A box that contains another one holds its lower corner, so a grid over the clusters' boxes finds
 * the few that can. Expected time is linear in the clusters.
 */
#include "hug.h"

#include "../core/order.h"

#include <string.h>

/* Clusters of fewer primitives have no grid. */
enum { FEW = 8 };

/* Boxes that are looked at for one cluster: where more lie over each other nesting gains little. */
enum { LOOKS = 64 };

/* Progress of the phase: where the search grid is there, and where all surroundings are. */
#define SEARCHABLE 0.3
#define FOUND      0.5

struct nester {
    struct build *build;          /* the build under way */
    const struct clustering *c;   /* what is nested */
    struct grid_pool *pool;       /* of the kind */
    struct hug_nesting *n;        /* what is made */
    struct grid_pool search;      /* grid i + 1 has the box of cluster i; grid 0 is over them */
    ARRAY_OF(struct keyed) order; /* by falling surface: no box is in a later one */
    struct ids rank;              /* by cluster: its place in the order */
    struct ids around;            /* by cluster: the cluster around it, or ACCEL_NONE */
};

/* A key that falls where a number that is not negative rises: such numbers are ordered as their
 * bits are. */
static uint64_t falling(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return ~bits;
}

static bool rank(struct nester *s)
{
    struct memory *m = &s->build->a->memory;
    const size_t count = s->c->clusters.count;
    if (!array_extend(m, &s->order, count) || !array_extend(m, &s->rank, count) ||
        !array_extend(m, &s->around, count) || !array_extend(m, &s->n->owner, count))
        return accel_build_no_memory(s->build);
    for (uint32_t i = 0; i < count; i++)
        s->order.at[i] = (struct keyed){falling(box_area(&s->c->clusters.at[i].box)), i};
    if (!accel_order_by_key(m, s->order.at, count))
        return accel_build_no_memory(s->build);
    for (uint32_t i = 0; i < count; i++)
        s->rank.at[s->order.at[i].value] = i;
    return true;
}

static bool has_grid(const struct nester *s, uint32_t cluster)
{
    return s->c->clusters.at[cluster].count >= FEW;
}

static accel_box all_clusters(const struct clustering *c)
{
    accel_box b = box_empty();
    for (size_t i = 0; i < c->clusters.count; i++)
        box_add(&b, &c->clusters.at[i].box);
    return b;
}

/* Makes the grid that finds the clusters with grids. */
static bool make_search(struct nester *s)
{
    struct memory *m = &s->build->a->memory;
    const uint32_t count = (uint32_t)s->c->clusters.count, ids = s->build->a->prims.count;
    struct ids refs = {NULL, 0, 0};
    if ((uint64_t)ids + count + 1 > ACCEL_NONE) {
        accel_error_set(
            s->build->error, ACCEL_TOO_LARGE,
            "build hug: %u primitives and %u grids, at most 4294967294 together are allowed; "
            "nothing was built",
            ids, count);
        return false;
    }
    if (!array_extend(m, &s->search.grids, (size_t)count + 1))
        return accel_build_no_memory(s->build);
    s->search.grids.at[0] = (struct grid){.box = all_clusters(s->c)};
    bool fine = array_reserve(m, &refs, count) || accel_build_no_memory(s->build);
    for (uint32_t i = 0; fine && i < count; i++) {
        s->search.grids.at[i + 1] = (struct grid){.box = s->c->clusters.at[i].box};
        if (has_grid(s, i))
            refs.at[refs.count++] = ids + i + 1;
    }
    if (fine && refs.count > 0) {
        const struct grid_items items = {refs.at, refs.count};
        struct grid_plan plan = accel_grid_plan(&s->build->a->prims, &s->search,
                                                &s->search.grids.at[0].box, items, (double)NAN);
        fine = accel_grid_build(s->build, &s->search, 0, items, &plan, 0.0, SEARCHABLE);
    }
    array_free(m, &refs);
    return fine;
}

/* The cell of the search grid that holds a point, as a run of references. */
static struct grid_items find_cell(const struct grid_pool *pool, const double point[3])
{
    const struct grid *g = &pool->grids.at[0];
    size_t brick = g->brick, stride = 1;
    uint32_t bit = 0;
    for (int k = 0; k < 3; k++) {
        const double *plane = pool->planes.at + g->plane[k];
        const double guess = (point[k] - plane[0]) * g->scale[k];
        uint32_t i = !(guess > 0.0) ? 0 : guess < g->cells[k] ? (uint32_t)guess : g->cells[k] - 1;
        while (i > 0 && plane[i] > point[k])
            i--;
        while (i + 1 < g->cells[k] && plane[i + 1] < point[k])
            i++;
        brick += i / GRID_BRICK * stride;
        stride *= g->bricks[k];
        bit |= i % GRID_BRICK << 2 * k;
    }
    if (!(pool->masks.at[brick] >> bit & 1))
        return (struct grid_items){NULL, 0};
    const size_t slot = grid_slot(pool, brick, bit);
    const uint32_t start = pool->starts.at[slot];
    return (struct grid_items){pool->refs.at + start, pool->starts.at[slot + 1] - start};
}

/* The cluster of smallest surface whose box contains that of `inner`. */
static uint32_t find_around(const struct nester *s, uint32_t inner)
{
    const accel_box *box = &s->c->clusters.at[inner].box;
    const struct grid_items cell = find_cell(&s->search, box->lo);
    uint32_t best = ACCEL_NONE;
    for (size_t i = 0; i < cell.count && i < LOOKS; i++) {
        const uint32_t outer = cell.at[i] - s->build->a->prims.count - 1;
        if (s->rank.at[outer] < s->rank.at[inner] &&
            (best == ACCEL_NONE || s->rank.at[outer] > s->rank.at[best]) &&
            box_contains(&s->c->clusters.at[outer].box, box))
            best = outer;
    }
    return best;
}

/* Reports progress between two parts of the phase after i of the clusters. */
static bool tick(const struct nester *s, size_t i, double from, double to)
{
    return i % 4096 != 0 || accel_build_tick(s->build, from + (to - from) * (double)i /
                                                                  (double)s->c->clusters.count);
}

/* Finds every cluster's surroundings, and how many clusters lie in no other's grid. */
static bool find_all(struct nester *s, size_t *outermost)
{
    *outermost = 0;
    for (uint32_t i = 0; i < s->c->clusters.count; i++) {
        s->around.at[i] = s->search.masks.count ? find_around(s, i) : ACCEL_NONE;
        *outermost += s->around.at[i] == ACCEL_NONE;
        if (!tick(s, i, SEARCHABLE, FOUND))
            return false;
    }
    return true;
}

static bool add_grid(struct nester *s, const accel_box *box, uint32_t parent, uint32_t depth)
{
    struct memory *m = &s->build->a->memory;
    if (!array_extend(m, &s->pool->grids, 1) || !array_extend(m, &s->n->parent, 1))
        return accel_build_no_memory(s->build);
    s->pool->grids.at[s->pool->grids.count - 1] = (struct grid){.box = *box, .depth = depth};
    s->n->parent.at[s->n->parent.count - 1] = parent;
    return true;
}

/* Gives one cluster its place, after those around it. */
static bool place(struct nester *s, uint32_t cluster)
{
    const uint32_t around = s->around.at[cluster];
    uint32_t parent = around == ACCEL_NONE ? 0 : s->n->owner.at[around];
    s->n->owner.at[cluster] = parent;
    if (!has_grid(s, cluster)) {
        s->n->lists++;
        return true;
    }
    const uint32_t number = (uint32_t)s->pool->grids.count;
    uint32_t depth = number == 0 ? 0 : s->pool->grids.at[parent].depth + 1;
    if (depth > HUG_MAX_NESTING) {
        depth--;
        parent = s->n->parent.at[parent];
    }
    s->n->owner.at[cluster] = number;
    return add_grid(s, &s->c->clusters.at[cluster].box, parent, depth);
}

/* A cluster that contains all others is grid 0 itself. */
static bool place_all(struct nester *s, size_t outermost)
{
    const accel_box all = all_clusters(s->c);
    if ((outermost > 1 || !has_grid(s, s->order.at[0].value)) && !add_grid(s, &all, 0, 0))
        return false;
    for (size_t i = 0; i < s->order.count; i++) {
        if (!place(s, s->order.at[i].value))
            return false;
        if (!tick(s, i, FOUND, HUG_NESTED))
            return false;
    }
    return true;
}

bool accel_hug_nest(struct build *build, struct grid_pool *pool, const struct clustering *c,
                    struct hug_nesting *n)
{
    struct nester s = {.build = build, .c = c, .pool = pool, .n = n};
    struct memory *m = &build->a->memory;
    size_t outermost;
    const bool fine =
        rank(&s) && make_search(&s) && find_all(&s, &outermost) && place_all(&s, outermost);
    accel_grid_pool_free(m, &s.search);
    array_free(m, &s.order);
    array_free(m, &s.rank);
    array_free(m, &s.around);
    return fine;
}

void accel_hug_nesting_free(struct memory *m, struct hug_nesting *n)
{
    array_free(m, &n->owner);
    array_free(m, &n->parent);
}
