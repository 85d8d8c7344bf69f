/* SPDX-License-Identifier: Apache-2.0
 *
 * Checks a bvh against its definition: see bvh.h.
 */
#include "bvh.h"

#include <stdlib.h>

/* What is the same for all nodes. */
struct checker {
    const struct bvh *bvh;
    accel_error *error;
    uint8_t *seen;  /* by id: referred to */
    uint32_t nodes; /* visited so far */
    uint32_t refs;  /* visited so far */
};

static bool broken(const struct checker *c, const char *what, uint32_t number)
{
    error_set(c->error, ACCEL_BROKEN, "bvh: %s %u", what, number);
    return false;
}

static bool check_leaf(struct checker *c, struct boxtree_child leaf, const accel_box *box)
{
    if ((size_t)leaf.first + leaf.count > c->bvh->refs.count)
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
    if (child.first >= c->bvh->nodes.count || c->nodes++ == c->bvh->nodes.count)
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

bool bvh_validate(const struct bvh *bvh, accel_error *error)
{
    struct checker c = {bvh, error, calloc(bvh->base.prims.count, 1), 0, 0};
    if (!c.seen) {
        error_set(error, ACCEL_NO_MEMORY, "validate: no memory for %u ids", bvh->base.prims.count);
        return false;
    }
    bool fine = check(&c, bvh->root, &bvh->box, 0);
    if (fine && (c.nodes != bvh->nodes.count || c.refs != bvh->base.prims.bounded.count))
        fine =
            broken(&c, "primitives are missing or nodes are left over; references found:", c.refs);
    free(c.seen);
    return fine;
}
