/* SPDX-License-Identifier: Apache-2.0
 *
 * Checks a wide tree against its definition: see wide.h.
 */
#include "wide.h"

#include <stdlib.h>

#include "../core/box.h"
#include "../core/seal.h"

/* What is the same for all nodes. */
struct checker {
    const accel *a;
    const struct wide *w;
    accel_error *error;
    uint8_t *seen;  /* by id: in a leaf */
    uint64_t nodes; /* visited so far */
    uint64_t found; /* primitives so far */
    uint64_t sum;   /* over the vertices so far: see seal.h */
};

static bool broken(const struct checker *c, const char *what, uint64_t number)
{
    accel_error_set(c->error, ACCEL_BROKEN, "wide tree: %s %llu", what, (unsigned long long)number);
    return false;
}

static accel_box padded_box(const struct checker *c, const struct wide_block *b, unsigned i)
{
    return b->type >= WIDE_SPHERES ? c->a->prims.box[wide_block_ids(b)[i]]
                                   : accel_wide_triangle_box(b, i);
}

/* P', scaled, lies in the box. */
static bool holds(const struct checker *c, const float lo[3], const float hi[3],
                  const struct wide_block *b, unsigned i)
{
    const accel_box p = padded_box(c, b, i);
    for (int k = 0; k < 3; k++)
        if (!((double)lo[k] <= p.lo[k] * c->w->scale && p.hi[k] * c->w->scale <= (double)hi[k]))
            return false;
    return true;
}

static bool check_block(struct checker *c, size_t at, const float lo[3], const float hi[3])
{
    const struct wide_block *b = (const struct wide_block *)(c->w->base + at);
    if (b->count == 0 || b->count > WIDE_BLOCK || b->type > WIDE_LIST || b->size > c->w->used - at)
        return broken(c, "no block, or a broken one, at byte", at);
    for (unsigned i = 0; i < b->count; i++) {
        const uint32_t id = wide_block_ids(b)[i];
        if (id >= c->a->prims.count || c->seen[id]++)
            return broken(c, "out of range or in two leaves, primitive", id);
        if (!holds(c, lo, hi, b, i))
            return broken(c, "a leaf's box does not hold primitive", id);
        c->found++;
        if (b->type < WIDE_SPHERES) {
            double vertices[9];
            accel_wide_vertices(b, i, vertices);
            c->sum += seal_primitive(id, vertices, 9);
        }
    }
    return true;
}

static bool check_leaf(struct checker *c, uint32_t word, const float lo[3], const float hi[3])
{
    size_t at = 16 * (size_t)(word & ~WIDE_LEAF);
    for (;;) {
        if (at + sizeof(struct wide_block) > c->w->used)
            return broken(c, "a leaf begins behind the end, at byte", at);
        if (!check_block(c, at, lo, hi))
            return false;
        const struct wide_block *b = (const struct wide_block *)(c->w->base + at);
        if (b->last)
            return true;
        at += b->size;
    }
}

static bool check(struct checker *c, uint32_t word, const float lo[3], const float hi[3],
                  uint32_t depth)
{
    if (word & WIDE_LEAF)
        return check_leaf(c, word, lo, hi);
    if (depth >= c->w->depth || 16 * (size_t)word + sizeof(struct wide_node) > c->w->used ||
        word % 4 != 0)
        return broken(c, "out of range or too deep, node", word);
    if (c->nodes++ == c->w->nodes)
        return broken(c, "more nodes than were made:", c->w->nodes);
    const struct wide_node *node = wide_node_at(c->w, word);
    for (int i = 0; i < WIDE; i++) {
        float l[3], h[3];
        for (int k = 0; k < 3; k++) {
            l[k] = node->plane[k][0][i];
            h[k] = node->plane[k][1][i];
        }
        if (l[0] > h[0] && i > 0)
            break;
        for (int k = 0; k < 3; k++)
            if (!(lo[k] <= l[k] && l[k] <= h[k] && h[k] <= hi[k]))
                return broken(c, "a child's box leaves its parent's, node", word);
        if (!check(c, node->child[i], l, h, depth + 1))
            return false;
    }
    return true;
}

/* Was nothing overwritten since it was built? Only then are all sizes and words what they say. */
static bool check_seal(const struct checker *c)
{
    return seal_bytes(c->w->base, c->w->used) == c->w->seal ||
           broken(c, "overwritten since they were built, bytes of nodes and leaves,", c->w->used);
}

static bool check_all(struct checker *c)
{
    const float inf = (float)INFINITY;
    const float lo[3] = {-inf, -inf, -inf}, hi[3] = {inf, inf, inf};
    if (!check_seal(c) || !check(c, c->w->root, lo, hi, 0))
        return false;
    if (c->nodes != c->w->nodes || c->found != c->a->prims.bounded.count)
        return broken(c,
                      "primitives are missing or nodes are left over; primitives found:", c->found);
    return c->a->prims.box || c->sum == c->a->prims.data_seal ||
           broken(c, "other triangles than were copied; of them", c->found);
}

bool accel_wide_validate(const accel *a, const struct wide *w, accel_error *error)
{
    struct checker c = {a, w, error, calloc(a->prims.count, 1), 0, 0, 0};
    if (!c.seen) {
        accel_error_set(error, ACCEL_NO_MEMORY, "validate: no memory for %u ids", a->prims.count);
        return false;
    }
    const bool fine = check_all(&c);
    free(c.seen);
    return fine;
}
