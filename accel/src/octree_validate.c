/* SPDX-License-Identifier: Apache-2.0
 *
 * Checks an octree against its definition, independently of how it was built: hands every
 * primitive down to the cells that its box meets and compares what arrives with what is listed,
 * also where the cells below are not built yet.
 */
#include "octree_later.h"

#include <stdlib.h>
#include <string.h>

/* What is the same for all cells. */
struct checker {
    const accel *a;
    const struct octree_pool *pool; /* of the tree or the part */
    uint32_t depth;                 /* no leaf of it may lie deeper */
    accel_error *error;
};

static bool broken(const struct checker *c, const char *what, uint32_t number)
{
    error_set(c->error, ACCEL_BROKEN, "%s: %s %u", c->a->kind->info.name, what, number);
    return false;
}

static bool check_leaf(const struct checker *c, const struct octree_cell *cell, const uint32_t *ids,
                       size_t count, uint32_t depth)
{
    if (depth > c->depth)
        return broken(c, "a leaf lies deeper than is said, at", depth);
    if ((size_t)cell->first + cell->count > c->pool->refs.count)
        return broken(c, "a leaf ends behind the references, first", cell->first);
    if (cell->count != count ||
        memcmp(c->pool->refs.at + cell->first, ids, count * sizeof *ids) != 0)
        return broken(c, "a leaf does not list what its cell meets, first reference", cell->first);
    return true;
}

static bool check_cell(const struct checker *c, const struct octree_cell *cell,
                       const accel_box *box, const uint32_t *ids, size_t count, uint32_t depth);

static bool check_child(const struct checker *c, const struct octree_node *node, uint32_t child,
                        const accel_box *parent, const uint32_t *ids, size_t count, uint32_t depth)
{
    accel_box box = *parent;
    for (int k = 0; k < 3; k++) {
        if (isinf(node->plane[k]) && child >> k & 1)
            return !(node->mask >> child & 1) ||
                   broken(c, "a child beyond an infinite plane", child);
        if (!isinf(node->plane[k]))
            *(child >> k & 1 ? &box.lo[k] : &box.hi[k]) = node->plane[k];
    }
    size_t kept;
    uint32_t *list = primitives_meeting(&c->a->prims, ids, count, &box, &kept, c->error);
    if (!list)
        return false;
    const bool fine = node->mask >> child & 1
                          ? check_cell(c, octree_child(node, child), &box, list, kept, depth)
                          : kept == 0 || broken(c, "an empty cell meets primitive", list[0]);
    free(list);
    return fine;
}

/* A part, if it is built. */
static bool check_part(const struct checker *c, const struct octree_later *later)
{
    const struct octree_part *part = atomic_load_explicit(&later->built, memory_order_acquire);
    if (!part)
        return true;
    const struct checker below = {c->a, &part->pool, part->depth, c->error};
    return check_cell(&below, &part->root, &later->box, later->ids, later->count, later->depth);
}

static bool check_later(const struct checker *c, const struct octree_cell *cell,
                        const accel_box *box, const uint32_t *ids, size_t count, uint32_t depth)
{
    if (cell->first >= c->pool->later.count)
        return broken(c, "a cell names a part that does not exist,", cell->first);
    const struct octree_later *later = &c->pool->later.at[cell->first];
    if (memcmp(&later->box, box, sizeof *box) != 0 || later->depth != depth)
        return broken(c, "a part is not where its cell is, part", cell->first);
    if (later->count != count || memcmp(later->ids, ids, count * sizeof *ids) != 0)
        return broken(c, "a part does not list what its cell meets, part", cell->first);
    return check_part(c, later);
}

static bool check_cell(const struct checker *c, const struct octree_cell *cell,
                       const accel_box *box, const uint32_t *ids, size_t count, uint32_t depth)
{
    if (depth > OCTREE_MAX_DEPTH)
        return broken(c, "a cell lies too deep, at", depth);
    if (cell->count == OCTREE_LATER)
        return check_later(c, cell, box, ids, count, depth);
    if (cell->count > 0)
        return check_leaf(c, cell, ids, count, depth);
    if (cell->first + octree_words(0) > c->pool->words.count)
        return broken(c, "a cell names a node that does not exist,", cell->first);
    const struct octree_node *node = octree_node_at(c->pool, cell->first);
    if (node->mask > 0xff ||
        cell->first + octree_words(octree_bits(node->mask)) > c->pool->words.count)
        return broken(c, "children end behind the pool, node", cell->first);
    for (int k = 0; k < 3; k++)
        if (!isinf(node->plane[k]) && !(box->lo[k] < node->plane[k] && node->plane[k] < box->hi[k]))
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

bool octree_validate(const accel *a, const struct octree_pool *pool, const struct octree *tree,
                     const uint32_t *ids, size_t count, accel_error *error)
{
    const struct checker c = {a, pool, a->info.depth, error};
    return check_root(&c, &tree->box, ids, count) &&
           check_cell(&c, &tree->root, &tree->box, ids, count, 0);
}

bool octree_validate_lazy(const accel *a, const struct octree_later *tree, accel_error *error)
{
    const struct checker c = {.a = a, .error = error};
    return check_root(&c, &tree->box, tree->ids, tree->count) && check_part(&c, tree);
}
