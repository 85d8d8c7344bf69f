/* SPDX-License-Identifier: Apache-2.0
 *
 * Checks a wide tree against its definition: see wide.h.
 */
#include "wide_split.h"

#include <stdlib.h>
#include <string.h>

#include "../core/box.h"
#include "../core/seal.h"

/* A leaf that may hold but a part of a triangle. */
struct part {
    const struct wide_block *block;
    uint32_t id;
    uint8_t place; /* in the block */
    float lo[3], hi[3];
};

enum { SEEN = 1, HELD = 2 };

/* What is the same for all nodes. */
struct checker {
    const accel *a;
    const struct wide *w;
    accel_error *error;
    uint8_t *seen;       /* by id: in a leaf (SEEN), whose box holds all of it (HELD) */
    uint64_t nodes;      /* visited so far */
    uint64_t found;      /* primitives so far */
    uint64_t references; /* the same, each as often as it is in leaves */
    uint64_t sum;        /* over the vertices so far: see seal.h */
    struct part *part;   /* `parts` of them; there is room for */
    size_t parts, room;
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

/* Notes that a leaf holds a part of a triangle. */
static bool note_part(struct checker *c, const float lo[3], const float hi[3],
                      const struct wide_block *b, unsigned i)
{
    if (c->parts == c->room) {
        const size_t room = 2 * c->room + 1024;
        struct part *more = realloc(c->part, room * sizeof *more);
        if (!more) {
            accel_error_set(c->error, ACCEL_NO_MEMORY, "validate: no memory for %zu parts", room);
            return false;
        }
        c->part = more;
        c->room = room;
    }
    struct part *p = &c->part[c->parts++];
    *p = (struct part){.block = b, .id = wide_block_ids(b)[i], .place = (uint8_t)i};
    memcpy(p->lo, lo, sizeof p->lo);
    memcpy(p->hi, hi, sizeof p->hi);
    return true;
}

static bool check_primitive(struct checker *c, const struct wide_block *b, unsigned i,
                            const float lo[3], const float hi[3])
{
    const uint32_t id = wide_block_ids(b)[i];
    const bool may_be_cut = b->type < WIDE_SPHERES && c->w->reach > 0.0;
    if (id >= c->a->prims.count || (c->seen[id] && !may_be_cut))
        return broken(c, "out of range or in two leaves, primitive", id);
    c->references++;
    const bool first = c->seen[id] == 0, held = holds(c, lo, hi, b, i);
    c->seen[id] |= held ? SEEN | HELD : SEEN;
    if (!held && !may_be_cut)
        return broken(c, "a leaf's box does not hold primitive", id);
    if (!held && !note_part(c, lo, hi, b, i))
        return false;
    if (!first)
        return true;
    c->found++;
    if (b->type < WIDE_SPHERES) {
        double vertices[9];
        accel_wide_vertices(b, i, vertices);
        c->sum += seal_primitive(id, vertices, 9);
    }
    return true;
}

static bool check_block(struct checker *c, size_t at, const float lo[3], const float hi[3])
{
    const struct wide_block *b = (const struct wide_block *)(c->w->base + at);
    if (b->count == 0 || b->count > WIDE_BLOCK || b->type > WIDE_LIST || b->size > c->w->used - at)
        return broken(c, "no block, or a broken one, at byte", at);
    for (unsigned i = 0; i < b->count; i++)
        if (!check_primitive(c, b, i, lo, hi))
            return false;
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

/* -------------------------------------------------------------------------------- parts ---- */

static int by_id(const void *a, const void *b)
{
    const struct part *p = a, *q = b;
    return p->id < q->id ? -1 : p->id > q->id;
}

/* Is something of the cell that is near the plane in none of the boxes? Takes off what is in the
 * first one, and asks the others about what is left on its six sides. */
static bool is_uncovered(const struct split_plane *plane, accel_box cell, const struct part *part,
                         size_t count)
{
    if (!accel_wide_split_tighten(plane, &cell))
        return false;
    while (count > 0) {
        const accel_box box = {{(double)part->lo[0], (double)part->lo[1], (double)part->lo[2]},
                               {(double)part->hi[0], (double)part->hi[1], (double)part->hi[2]}};
        part++;
        count--;
        if (!box_overlaps(&cell, &box))
            continue;
        for (int k = 0; k < 3; k++) {
            accel_box below = cell, above = cell;
            below.hi[k] = box.lo[k];
            above.lo[k] = box.hi[k];
            if ((cell.lo[k] < box.lo[k] && is_uncovered(plane, below, part, count)) ||
                (cell.hi[k] > box.hi[k] && is_uncovered(plane, above, part, count)))
                return true;
            cell.lo[k] = fmax(cell.lo[k], box.lo[k]);
            cell.hi[k] = fmin(cell.hi[k], box.hi[k]);
        }
        return false;
    }
    return true;
}

/* The boxes of one triangle, but for what the walks need them to be larger by. */
static bool check_parts_of(const struct checker *c, struct part *part, size_t count)
{
    double vertices[9];
    accel_wide_vertices(part->block, part->place, vertices);
    const accel_box padded = accel_wide_triangle_box(part->block, part->place);
    const struct split_plane plane = accel_wide_split_plane(vertices, c->w->scale, &padded);
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) {
            part[i].lo[k] += (float)(0.875 * SPLIT_PAD);
            part[i].hi[k] -= (float)(0.875 * SPLIT_PAD);
        }
    return !is_uncovered(&plane, wide_scaled(c->w, &padded), part, count) ||
           broken(c, "no leaf's box holds some part of primitive", part->id);
}

static bool check_parts(struct checker *c)
{
    if (c->parts > 0)
        qsort(c->part, c->parts, sizeof *c->part, by_id);
    for (size_t i = 0, end; i < c->parts; i = end) {
        for (end = i + 1; end < c->parts && c->part[end].id == c->part[i].id; end++)
            ;
        if (!(c->seen[c->part[i].id] & HELD) && !check_parts_of(c, c->part + i, end - i))
            return false;
    }
    return true;
}

static bool check_all(struct checker *c)
{
    const float inf = (float)INFINITY;
    const float lo[3] = {-inf, -inf, -inf}, hi[3] = {inf, inf, inf};
    if (!check_seal(c) || !check(c, c->w->root, lo, hi, 0))
        return false;
    if (c->nodes != c->w->nodes || c->found != c->a->prims.bounded.count ||
        c->references != c->w->references)
        return broken(c,
                      "primitives are missing or nodes are left over; primitives found:", c->found);
    if (!check_parts(c))
        return false;
    return c->a->prims.box || c->sum == c->a->prims.data_seal ||
           broken(c, "other triangles than were copied; of them", c->found);
}

bool accel_wide_validate(const accel *a, const struct wide *w, accel_error *error)
{
    struct checker c = {.a = a, .w = w, .error = error, .seen = calloc(a->prims.count, 1)};
    if (!c.seen) {
        accel_error_set(error, ACCEL_NO_MEMORY, "validate: no memory for %u ids", a->prims.count);
        return false;
    }
    const bool fine = check_all(&c);
    free(c.seen);
    free(c.part);
    return fine;
}
