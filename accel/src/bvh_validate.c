/* SPDX-License-Identifier: Apache-2.0
 *
 * Checks a bvh against its definition: see bvh.h.
 */
#include "bvh.h"

#include <stdlib.h>

#include "seal.h"

/* What is the same for all nodes. */
struct checker {
    const struct bvh *bvh;
    accel_error *error;
    uint8_t *seen; /* by id: referred to */
    size_t nodes;  /* visited so far */
    size_t refs;   /* visited so far */
};

static bool broken(const struct checker *c, const char *what, uint32_t number)
{
    error_set(c->error, ACCEL_BROKEN, "bvh: %s %u", what, number);
    return false;
}

static bool check_leaf(struct checker *c, struct boxtree_child leaf, const accel_box *box)
{
    if ((uint64_t)leaf.first + leaf.count > c->bvh->refs.count)
        return broken(c, "a leaf ends behind the references, first", leaf.first);
    for (uint32_t i = 0; i < leaf.count; i++) {
        const uint32_t id = c->bvh->refs.at[leaf.first + i];
        if (id >= c->bvh->base.prims.count || c->seen[id]++)
            return broken(c, "out of range or in two leaves, primitive", id);
        if (!box_contains(box, &c->bvh->base.prims.box[id]))
            return broken(c, "a leaf's box does not contain primitive", id);
    }
    c->refs += leaf.count;
    return true;
}

static bool check(struct checker *c, struct boxtree_child child, const accel_box *box,
                  uint32_t depth)
{
    if (depth > BOXTREE_MAX_DEPTH || depth > c->bvh->base.info.depth)
        return broken(c, "a child lies too deep, at", depth);
    if (child.count > 0)
        return check_leaf(c, child, box);
    if (child.first >= c->bvh->nodes.count || c->nodes++ >= c->bvh->nodes.count)
        return broken(c, "out of range or below itself, node", child.first);
    const struct boxtree_node *node = &c->bvh->nodes.at[child.first];
    for (int i = 0; i < 2; i++) {
        const accel_box inner = boxtree_box(node, i);
        if (!box_contains(box, &inner))
            return broken(c, "a child's box leaves its parent's, node", child.first);
        if (!check(c, node->child[i], &inner, depth + 1))
            return false;
    }
    return true;
}

/* Is every bounded primitive referred to, and nothing left over? */
static bool check_all(const struct checker *c)
{
    const struct ids *bounded = &c->bvh->base.prims.bounded;
    for (size_t i = 0; i < bounded->count; i++)
        if (!c->seen[bounded->at[i]])
            return broken(c, "in no leaf, primitive", bounded->at[i]);
    return (c->nodes == c->bvh->nodes.count && c->refs == c->bvh->refs.count &&
            c->refs == bounded->count) ||
           broken(c, "nodes or references are left over; references found:", (uint32_t)c->refs);
}

/* Are the triangles those that were copied? */
static bool check_triangles(const struct checker *c)
{
    uint64_t sum = 0;
    for (size_t i = 0; i < c->bvh->refs.count; i++)
        sum += seal_primitive(c->bvh->refs.at[i], c->bvh->triangles + 9 * i, 9);
    return sum == c->bvh->base.prims.data_seal ||
           broken(c, "overwritten since they were built, triangles,", (uint32_t)c->bvh->refs.count);
}

bool bvh_validate(const struct bvh *bvh, accel_error *error)
{
    struct checker c = {bvh, error, calloc(bvh->base.prims.count, 1), 0, 0};
    if (!c.seen) {
        error_set(error, ACCEL_NO_MEMORY, "validate: no memory for %u ids", bvh->base.prims.count);
        return false;
    }
    const bool fine = check(&c, bvh->root, &bvh->box, 0) && check_all(&c) &&
                      (!bvh->triangles || check_triangles(&c));
    free(c.seen);
    return fine;
}
