/* SPDX-License-Identifier: Apache-2.0
 *
 * Checks a kd-tree against its definition, independently of how it was built: hands every primitive
 * down to the cells that its box meets and compares what arrives with what is listed.
 */
#include "bsp.h"

#include <stdlib.h>
#include <string.h>

/* What is the same for all cells. */
struct checker {
    const struct bsp *bsp;
    accel_error *error;
    size_t nodes; /* visited so far; in order, as the encoding says */
    size_t refs;  /* the same */
};

static bool broken(const struct checker *c, const char *what, size_t number)
{
    accel_error_set(c->error, ACCEL_BROKEN, "bsp: %s %zu", what, number);
    return false;
}

static bool check_leaf(struct checker *c, const struct bsp_node *leaf, const uint32_t *ids,
                       size_t count)
{
    if (leaf->first != c->refs || leaf->count > c->bsp->refs.count - c->refs)
        return broken(c, "a leaf does not follow the one before, first reference", leaf->first);
    if (leaf->count != count ||
        memcmp(c->bsp->refs.at + leaf->first, ids, count * sizeof *ids) != 0)
        return broken(c, "a leaf does not list what its cell meets, first reference", leaf->first);
    c->refs += count;
    return true;
}

static bool check_cell(struct checker *c, const accel_box *box, const uint32_t *ids, size_t count,
                       uint32_t depth);

static bool check_half(struct checker *c, const struct bsp_node *node, int half,
                       const accel_box *parent, const uint32_t *ids, size_t count, uint32_t depth)
{
    const uint32_t axis = node->bits & BSP_AXIS;
    const bool empty = node->bits & (half ? BSP_UPPER_EMPTY : BSP_LOWER_EMPTY);
    accel_box box = *parent;
    *(half ? &box.lo[axis] : &box.hi[axis]) = node->plane;
    if (half && !empty && node->first != c->nodes)
        return broken(c, "the half above does not follow the one below, node", node->first);
    size_t kept;
    uint32_t *list =
        accel_primitives_meeting(&c->bsp->base.prims, ids, count, &box, &kept, c->error);
    if (!list)
        return false;
    const bool fine = !empty      ? check_cell(c, &box, list, kept, depth)
                      : kept == 0 ? true
                                  : broken(c, "an empty cell meets primitive", list[0]);
    free(list);
    return fine;
}

static bool check_cell(struct checker *c, const accel_box *box, const uint32_t *ids, size_t count,
                       uint32_t depth)
{
    if (depth > BSP_MAX_DEPTH || depth > c->bsp->base.info.depth)
        return broken(c, "a cell lies too deep, at", depth);
    if (c->nodes >= c->bsp->nodes.count)
        return broken(c, "a cell names a node that does not exist,", c->nodes);
    const struct bsp_node *node = &c->bsp->nodes.at[c->nodes++];
    if (node->bits == BSP_LEAF)
        return check_leaf(c, node, ids, count);
    const uint32_t axis = node->bits & BSP_AXIS;
    if (axis == BSP_LEAF || !(box->lo[axis] < node->plane && node->plane < box->hi[axis]))
        return broken(c, "a plane lies outside its cell, node", c->nodes - 1);
    return check_half(c, node, 0, box, ids, count, depth + 1) &&
           check_half(c, node, 1, box, ids, count, depth + 1);
}

bool accel_bsp_validate(const struct bsp *bsp, accel_error *error)
{
    struct checker c = {bsp, error, 0, 0};
    const struct primitives *p = &bsp->base.prims;
    for (size_t i = 0; i < p->bounded.count; i++)
        if (!box_contains(&bsp->box, &p->box[p->bounded.at[i]]))
            return broken(&c, "the root does not contain primitive", p->bounded.at[i]);
    if (!check_cell(&c, &bsp->box, p->bounded.at, p->bounded.count, 0))
        return false;
    return (c.nodes == bsp->nodes.count && c.refs == bsp->refs.count) ||
           broken(&c, "nodes or references are left over, from node", c.nodes);
}
