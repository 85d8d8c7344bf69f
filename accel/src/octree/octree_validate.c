/* SPDX-License-Identifier: Apache-2.0
 *
 * Checks an octree against its definition, independently of how it was built: hands every
 * primitive down to the cells that its box meets and compares what arrives with what is listed,
 * also where the cells below are not built yet.
 */
#include "octree_deferred.h"

#include <stdlib.h>
#include <string.h>

/* What is the same for all cells. */
struct checker {
    const accel *a;
    const struct octree_pool *pool; /* of the tree or the part */
    uint32_t depth;                 /* no leaf of it may lie deeper */
    double budget;                  /* references that a part in it may become at most */
    accel_error *error;
};

static bool broken(const struct checker *c, const char *what, uint32_t number)
{
    accel_error_set(c->error, ACCEL_BROKEN, "%s: %s %u", c->a->info.kind, what, number);
    return false;
}

static bool check_leaf(const struct checker *c, const struct octree_cell *cell, const uint32_t *ids,
                       size_t count, uint32_t depth)
{
    if (depth > c->depth)
        return broken(c, "a leaf lies deeper than is said, at", depth);
    if ((uint64_t)cell->first + cell->count > c->pool->refs.count)
        return broken(c, "a leaf ends behind the references, first", cell->first);
    if (cell->count != count ||
        memcmp(c->pool->refs.at + cell->first, ids, count * sizeof *ids) != 0)
        return broken(c, "a leaf does not list what its cell meets, first reference", cell->first);
    return true;
}

static bool check_cell(const struct checker *c, const struct octree_cell *cell,
                       const accel_box *box, const uint32_t *ids, size_t count, uint32_t depth);

/* Does the node leave this axis whole? */
static bool is_whole(const struct octree_node *node, int k)
{
    return node->plane[k] == (double)INFINITY;
}

static bool check_child(const struct checker *c, const struct octree_node *node, uint32_t child,
                        const accel_box *parent, const uint32_t *ids, size_t count, uint32_t depth)
{
    accel_box box = *parent;
    for (int k = 0; k < 3; k++) {
        if (is_whole(node, k) && child >> k & 1)
            return !(node->mask >> child & 1) ||
                   broken(c, "a child beyond an infinite plane", child);
        if (!is_whole(node, k))
            *(child >> k & 1 ? &box.lo[k] : &box.hi[k]) = node->plane[k];
    }
    size_t kept;
    uint32_t *list = accel_primitives_meeting(&c->a->prims, ids, count, &box, &kept, c->error);
    if (!list)
        return false;
    const bool fine = node->mask >> child & 1
                          ? check_cell(c, octree_child(node, child), &box, list, kept, depth)
                          : kept == 0 || broken(c, "an empty cell meets primitive", list[0]);
    free(list);
    return fine;
}

/* Is the array where the one before it ends? Moves *at behind it. */
static bool follows(const void *array, size_t count, size_t size, uintptr_t *at, uintptr_t end)
{
    if ((uintptr_t)array != *at || count > (end - *at) / size)
        return false;
    *at += count * size;
    return true;
}

/* Are the arrays of a part where its block has them? */
static bool check_layout(const struct checker *c, const struct octree_part *part)
{
    const struct octree_pool *p = &part->pool;
    uintptr_t at = (uintptr_t)(part + 1), end = (uintptr_t)part + part->bytes;
    return (end >= at && follows(p->words.at, p->words.count, sizeof *p->words.at, &at, end) &&
            follows(p->deferred.at, p->deferred.count, sizeof *p->deferred.at, &at, end) &&
            follows(p->refs.at, p->refs.count, sizeof *p->refs.at, &at, end) &&
            follows(p->deferred_ids.at, p->deferred_ids.count, sizeof(uint32_t), &at, end) &&
            at == end) ||
           broken(c, "the arrays of a part do not fill its block, bytes:", (uint32_t)part->bytes);
}

/* Are the ids of the parts of a pool one run after the other? */
static bool check_runs(const struct checker *c)
{
    const struct octree_pool *p = c->pool;
    size_t at = 0;
    for (size_t i = 0; i < p->deferred.count; at += p->deferred.at[i++].count)
        if (p->deferred.at[i].ids != p->deferred_ids.at + at ||
            p->deferred.at[i].count > p->deferred_ids.count - at)
            return broken(c, "its ids are not where they should be, part", (uint32_t)i);
    return true;
}

/* A part, if it is built. */
static bool check_part(const struct checker *c, const struct octree_deferred *deferred)
{
    const struct octree_part *part;
    if (!accel_octree_part_is_sound(deferred, &part))
        return broken(c, "overwritten since it was built, what leads to a part at depth",
                      deferred->depth);
    if (!part)
        return true;
    const struct checker below = {c->a, &part->pool, part->depth, deferred->budget, c->error};
    return check_layout(&below, part) && check_runs(&below) &&
           check_cell(&below, &part->root, &deferred->box, deferred->ids, deferred->count,
                      deferred->depth);
}

static bool check_deferred(const struct checker *c, const struct octree_cell *cell,
                           const accel_box *box, const uint32_t *ids, size_t count, uint32_t depth)
{
    if (cell->first >= c->pool->deferred.count)
        return broken(c, "a cell names a part that does not exist,", cell->first);
    const struct octree_deferred *deferred = &c->pool->deferred.at[cell->first];
    if (memcmp(&deferred->box, box, sizeof *box) != 0 || deferred->depth != depth)
        return broken(c, "a part is not where its cell is, part", cell->first);
    if (deferred->count != count || memcmp(deferred->ids, ids, count * sizeof *ids) != 0)
        return broken(c, "a part does not list what its cell meets, part", cell->first);
    if (deferred->owned > count || !(deferred->budget >= 0.0 && deferred->budget <= c->budget))
        return broken(c, "what is known of it is wrong, part", cell->first);
    return check_part(c, deferred);
}

static bool check_cell(const struct checker *c, const struct octree_cell *cell,
                       const accel_box *box, const uint32_t *ids, size_t count, uint32_t depth)
{
    if (depth > OCTREE_MAX_DEPTH)
        return broken(c, "a cell lies too deep, at", depth);
    if (cell->count == OCTREE_LATER)
        return check_deferred(c, cell, box, ids, count, depth);
    if (cell->count > 0)
        return check_leaf(c, cell, ids, count, depth);
    if ((uint64_t)cell->first + octree_words(0) > c->pool->words.count)
        return broken(c, "a cell names a node that does not exist,", cell->first);
    const struct octree_node *node = octree_node_at(c->pool, cell->first);
    if (node->mask > 0xff ||
        (uint64_t)cell->first + octree_words(octree_bits(node->mask)) > c->pool->words.count)
        return broken(c, "children end behind the pool, node", cell->first);
    for (int k = 0; k < 3; k++)
        if (!is_whole(node, k) && !(box->lo[k] < node->plane[k] && node->plane[k] < box->hi[k]))
            return broken(c, "a plane lies outside its cell, node", cell->first);
    for (uint32_t child = 0; child < 8; child++)
        if (!check_child(c, node, child, box, ids, count, depth + 1))
            return false;
    return true;
}

static bool check_root(const struct checker *c, const accel_box *box, const uint32_t *ids,
                       size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!box_contains(box, &c->a->prims.box[ids[i]]))
            return broken(c, "the root does not contain primitive", ids[i]);
    return true;
}

bool accel_octree_validate(const accel *a, const struct octree_pool *pool,
                           const struct octree *tree, const uint32_t *ids, size_t count,
                           accel_error *error)
{
    const struct checker c = {a, pool, a->info.depth, 0.0, error};
    return check_root(&c, &tree->box, ids, count) &&
           check_cell(&c, &tree->root, &tree->box, ids, count, 0);
}

bool accel_octree_validate_lazy(const struct octree_lazy *lazy, const struct octree_deferred *tree,
                                const uint32_t *ids, size_t count, accel_error *error)
{
    const struct octree_deferred want = accel_octree_defer(ids, count, &tree->box, lazy->rule);
    const struct checker c = {.a = lazy->a, .error = error};
    if (tree->ids != want.ids || tree->count != want.count || tree->owned != want.owned ||
        tree->depth != want.depth || tree->failed != want.failed || tree->budget != want.budget)
        return broken(&c, "what is known of it is wrong, tree of primitives:", tree->count);
    return check_root(&c, &tree->box, ids, count) && check_part(&c, tree);
}
