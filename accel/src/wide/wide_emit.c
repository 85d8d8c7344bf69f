/* SPDX-License-Identifier: Apache-2.0
 *
 * Laying out a wide tree: depth first, each node followed by what is below it, so that a ray that
 * goes down finds much of its way in the same pages.
 */
#include "wide.h"

#include <stdlib.h>
#include <string.h>

#include "../core/seal.h"

/* Vertices that a block's triangles may share, and bytes behind the last block: loads of full
 * registers end there at the latest. */
enum { POOL = 16, TAIL = 256 };

struct emitter {
    struct build *build;
    struct wide *w;
    struct wide_rule rule;
    const struct wide_binary_tree *tree;
    size_t used;   /* bytes so far */
    uint32_t done; /* primitives laid out */
    bool stopped;  /* the build is cancelled */
};

/* A leaf takes as long to lay out as looking at so many primitives, a node's room to reckon. */
enum { TICK_LEAF = 64, TICK_ROOM = 16 };

static const struct geometry *geometry_of(const struct emitter *e, uint32_t id)
{
    return primitives_geometry(&e->build->a->prims, id);
}

static const double *triangle(const struct emitter *e, uint32_t id)
{
    const struct geometry *g = geometry_of(e, id);
    return g->data + 9 * (size_t)(id - g->first);
}

static bool tick(struct emitter *e, uint32_t looked_at)
{
    const double part = (double)e->done / (double)e->tree->count;
    e->stopped = e->stopped || !build_step(e->build, looked_at, part);
    return !e->stopped;
}

/* ------------------------------------------------------------------------------- blocks ---- */

static size_t aligned(size_t size, size_t to)
{
    return (size + to - 1) / to * to;
}

/* Finishes a block of `size` bytes. */
static void end_block(struct emitter *e, struct wide_block *b, size_t size)
{
    b->size = (uint32_t)aligned(sizeof *b + size, 16);
    memset((unsigned char *)(b + 1) + size, 0, b->size - sizeof *b - size);
    e->used += b->size;
    e->w->blocks++;
}

static struct wide_block *begin_block(struct emitter *e, enum wide_type type)
{
    struct wide_block *b = (struct wide_block *)(e->w->base + e->used);
    *b = (struct wide_block){
        .type = (uint8_t)type, .least_det = 0.0f, .far_origin = (float)INFINITY};
    return b;
}

static bool is_float(const double *x, int count)
{
    for (int i = 0; i < count; i++)
        if ((double)(float)x[i] != x[i])
            return false;
    return true;
}

static float rounded_up(double x)
{
    const double up = x * (1.0 + 0x1p-22) + 0x1p-126;
    return up < 0x1p127 ? (float)up : (float)INFINITY;
}

/* Widens a block's bounds for the lemma "no clamp" (wide_leaf.h) to another triangle. */
static void bound(struct wide_block *b, const double *v)
{
    accel_box box = box_empty();
    double coordinate = 0.0;
    for (int i = 0; i < 3; i++)
        box_add_point(&box, v + 3 * i);
    for (int k = 0; k < 3; k++)
        coordinate = fmax(coordinate, fmax(fabs(box.lo[k]), fabs(box.hi[k])));
    const double side = box_longest(&box);
    const float det = rounded_up(side / coordinate * side * side);
    const double far = 7.0 * coordinate * (1.0 - 0x1p-22);
    b->least_det = det > b->least_det ? det : b->least_det;
    if (!(far >= (double)b->far_origin))
        b->far_origin = far > 0x1p-120 ? (float)far : -1.0f;
}

static size_t coordinate_size(bool floats)
{
    return floats ? sizeof(float) : sizeof(double);
}

static void put_coordinate(unsigned char *at, double x, bool floats)
{
    const float single = floats ? (float)x : 0.0f;
    memcpy(at, floats ? (const void *)&single : (const void *)&x, coordinate_size(floats));
}

/* The first of the triangles as a block. Returns how many. */
static uint32_t emit_packed(struct emitter *e, const uint32_t *ids, uint32_t count, bool floats)
{
    struct wide_block *b = begin_block(e, floats ? WIDE_FLOATS : WIDE_DOUBLES);
    unsigned char *at = (unsigned char *)(b + 1);
    const uint32_t n = count < WIDE_BLOCK ? count : WIDE_BLOCK;
    const size_t size = coordinate_size(floats);
    b->count = (uint8_t)n;
    for (uint32_t i = 0; i < n; i++) {
        const double *v = triangle(e, ids[i]);
        bound(b, v);
        for (uint32_t c = 0; c < 9; c++)
            put_coordinate(at + size * (c * n + i), v[c], floats);
    }
    memcpy(at + 9 * size * n, ids, n * sizeof *ids);
    end_block(e, b, (9 * size + sizeof *ids) * n);
    return n;
}

/* Corners of a block's triangles, each vertex once. */
struct vertex_pool {
    double at[POOL][3];
    uint32_t count;
    uint8_t corner[3][WIDE_BLOCK];
};

/* Adds a triangle; false: the pool is full. */
static bool pool_add(struct vertex_pool *p, const double *v, uint32_t triangle)
{
    for (int i = 0; i < 3; i++) {
        uint32_t j = 0;
        while (j < p->count && memcmp(p->at[j], v + 3 * i, sizeof p->at[j]) != 0)
            j++;
        if (j == POOL)
            return false;
        if (j == p->count)
            memcpy(p->at[p->count++], v + 3 * i, sizeof p->at[j]);
        p->corner[i][triangle] = (uint8_t)j;
    }
    return true;
}

static void put_pool(struct emitter *e, struct wide_block *b, const struct vertex_pool *p,
                     const uint32_t *ids)
{
    unsigned char *at = (unsigned char *)(b + 1);
    const size_t size = coordinate_size(b->type == WIDE_POOL);
    b->vertices = (uint8_t)p->count;
    for (uint32_t k = 0; k < 3; k++)
        for (uint32_t j = 0; j < p->count; j++, at += size)
            put_coordinate(at, p->at[j][k], b->type == WIDE_POOL);
    memcpy(at, p->corner, sizeof p->corner);
    memcpy(at + sizeof p->corner, ids, b->count * sizeof *ids);
    end_block(e, b, 3 * size * p->count + sizeof p->corner + b->count * sizeof *ids);
}

/* Do doubles take less memory packed? Of floats pools never take much more, and another type of
 * block is a branch that is mispredicted. */
static bool better_packed(const struct vertex_pool *p, uint32_t count, bool floats)
{
    const size_t size = sizeof(double);
    return !floats && 3 * size * p->count + sizeof p->corner > 9 * size * count;
}

/* The same with each vertex once; packed, where those are too many. */
static uint32_t emit_pool(struct emitter *e, const uint32_t *ids, uint32_t count, bool floats)
{
    struct vertex_pool p = {.count = 0, .corner = {{0}}};
    struct wide_block *b = begin_block(e, floats ? WIDE_POOL : WIDE_POOL_DOUBLES);
    const uint32_t n = count < WIDE_BLOCK ? count : WIDE_BLOCK;
    bool fits = true;
    b->count = (uint8_t)n;
    for (uint32_t i = 0; i < n && fits; i++) {
        const double *v = triangle(e, ids[i]);
        fits = pool_add(&p, v, i);
        bound(b, v);
    }
    if (!fits || better_packed(&p, n, floats))
        return emit_packed(e, ids, count, floats);
    put_pool(e, b, &p, ids);
    return n;
}

/* Widens a block's bounds for the lemma on spheres (wide_leaf.h) to another one. */
static void bound_sphere(struct wide_block *b, const double *sphere)
{
    double coordinate = 0.0;
    for (int k = 0; k < 3; k++)
        coordinate = fmax(coordinate, fabs(sphere[k]) + sphere[3]);
    const double far = 7.0 * coordinate * (1.0 - 0x1p-22);
    if (!(sphere[3] >= 0x1p-40 * coordinate && far > 0x1p-120))
        b->far_origin = -1.0f;
    else if (!(far >= (double)b->far_origin))
        b->far_origin = (float)far;
}

static uint32_t emit_spheres(struct emitter *e, const uint32_t *ids, uint32_t count)
{
    struct wide_block *b = begin_block(e, WIDE_SPHERES);
    unsigned char *at = (unsigned char *)(b + 1);
    const uint32_t n = count < WIDE_BLOCK ? count : WIDE_BLOCK;
    b->count = (uint8_t)n;
    for (uint32_t i = 0; i < n; i++) {
        const struct geometry *g = geometry_of(e, ids[i]);
        const double *sphere = g->data + 4 * (size_t)(ids[i] - g->first);
        bound_sphere(b, sphere);
        for (uint32_t c = 0; c < 4; c++)
            memcpy(at + sizeof(double) * (c * n + i), &sphere[c], sizeof(double));
    }
    memcpy(at + 4 * sizeof(double) * n, ids, n * sizeof *ids);
    end_block(e, b, (4 * sizeof(double) + sizeof *ids) * n);
    return n;
}

static uint32_t emit_list(struct emitter *e, const uint32_t *ids, uint32_t count)
{
    struct wide_block *b = begin_block(e, WIDE_LIST);
    const uint32_t n = count < WIDE_BLOCK ? count : WIDE_BLOCK;
    b->count = (uint8_t)n;
    memcpy(b + 1, ids, n * sizeof *ids);
    end_block(e, b, n * sizeof *ids);
    return n;
}

static uint32_t emit_block(struct emitter *e, const uint32_t *ids, uint32_t count,
                           enum wide_type type)
{
    if (type == WIDE_LIST)
        return emit_list(e, ids, count);
    if (type == WIDE_SPHERES)
        return emit_spheres(e, ids, count);
    return e->rule.pool ? emit_pool(e, ids, count, type == WIDE_FLOATS)
                        : emit_packed(e, ids, count, type == WIDE_FLOATS);
}

static enum wide_type type_of(const struct emitter *e, uint32_t id)
{
    const accel_type type = geometry_of(e, id)->type;
    if (type != ACCEL_TRIANGLES)
        return type == ACCEL_SPHERES ? WIDE_SPHERES : WIDE_LIST;
    return is_float(triangle(e, id), 9) ? WIDE_FLOATS : WIDE_DOUBLES;
}

/* Several parts of a triangle may have come to one leaf. */
static bool is_among(const uint32_t *ids, uint32_t count, uint32_t id)
{
    for (uint32_t i = 0; i < count; i++)
        if (ids[i] == id)
            return true;
    return false;
}

/* A leaf: its primitives by type, in blocks. Returns its word. */
static uint32_t emit_leaf(struct emitter *e, const struct wide_binary *node)
{
    const uint32_t word = WIDE_LEAF | (uint32_t)(e->used / 16);
    struct wide_block *last = NULL;
    e->w->leaves++;
    for (enum wide_type type = WIDE_FLOATS; type <= WIDE_LIST; type++) {
        uint32_t ids[WIDE_BLOCK], count = 0, done = 0;
        for (uint32_t i = 0; i < node->count; i++) {
            const uint32_t id = e->tree->items[node->first + i].id;
            if (type_of(e, id) == type && !is_among(ids, count, id))
                ids[count++] = id;
        }
        e->w->references += count;
        while (done < count) {
            last = (struct wide_block *)(e->w->base + e->used);
            done += emit_block(e, ids + done, count - done, type);
        }
    }
    last->last = 1;
    return word;
}

/* -------------------------------------------------------------------------------- nodes ---- */

struct children {
    uint32_t place[WIDE]; /* in the binary tree */
    uint32_t count;
};

/* The subtree at `place` as at most `slots` children. */
static void collect(const struct emitter *e, uint32_t place, uint32_t slots, struct children *out)
{
    const struct wide_binary *node = &e->tree->nodes[place];
    slots = slots < node->slots ? slots : node->slots;
    while (slots > 1 && node->left[slots] == 0)
        slots--;
    if (slots == 1) {
        out->place[out->count++] = place;
        return;
    }
    collect(e, place + 1, node->left[slots], out);
    collect(e, node->right, slots - node->left[slots], out);
}

static float area(const struct wide_binary *n)
{
    const float x = n->hi[0] - n->lo[0], y = n->hi[1] - n->lo[1], z = n->hi[2] - n->lo[2];
    return x * y + y * z + z * x;
}

/* Smallest last: any-hit walks take the last one first, which on the dragon visits 3 % fewer nodes
 * and tests 6 % fewer triangles than the other way round. */
static void sort_children(const struct emitter *e, struct children *c)
{
    for (uint32_t i = 1; i < c->count; i++) {
        const uint32_t moved = c->place[i];
        const float size = area(&e->tree->nodes[moved]);
        uint32_t to = i;
        for (; to > 0 && area(&e->tree->nodes[c->place[to - 1]]) < size; to--)
            c->place[to] = c->place[to - 1];
        c->place[to] = moved;
    }
}

static float outward(double x, double away)
{
    const double moved = x + away;
    const float f = (float)moved;
    if (away < 0 ? (double)f <= moved : (double)f >= moved)
        return f;
    return nextafterf(f, away < 0 ? -(float)INFINITY : (float)INFINITY);
}

static void fill_node(struct emitter *e, struct wide_node *node, const struct children *c)
{
    const float inf = (float)INFINITY;
    for (uint32_t i = 0; i < WIDE; i++) {
        const struct wide_binary *child = i < c->count ? &e->tree->nodes[c->place[i]] : NULL;
        for (int k = 0; k < 3; k++) {
            node->plane[k][0][i] = child ? outward((double)child->lo[k], -(double)WIDE_PAD) : inf;
            node->plane[k][1][i] = child ? outward((double)child->hi[k], (double)WIDE_PAD) : -inf;
        }
        node->child[i] = 0;
    }
}

/* Lays out the subtree at `place`. */
static bool emit(struct emitter *e, uint32_t place, uint32_t depth, uint32_t *word)
{
    const struct wide_binary *top = &e->tree->nodes[place];
    struct children c = {.count = 0};
    if (top->leaf) {
        *word = emit_leaf(e, top);
        e->done += top->count;
        return tick(e, TICK_LEAF);
    }
    collect(e, place + 1, top->left_of_all, &c);
    collect(e, top->right, WIDE - top->left_of_all, &c);
    sort_children(e, &c);
    const size_t at = aligned(e->used, 64);
    memset(e->w->base + e->used, 0, at - e->used);
    e->used = at;
    struct wide_node *node = (struct wide_node *)(e->w->base + at);
    fill_node(e, node, &c);
    e->used += sizeof *node;
    e->w->nodes++;
    e->w->depth = depth + 1 > e->w->depth ? depth + 1 : e->w->depth;
    *word = (uint32_t)(at / 16);
    for (uint32_t i = 0; i < c.count; i++)
        if (!emit(e, c.place[i], depth + 1, &node->child[i]))
            return false;
    return true;
}

/* --------------------------------------------------------------------------------- room ---- */

/* The bytes that a leaf takes at most. A block with a pool is full with 5 triangles at the least,
 * as they have 15 vertices at the most. */
static size_t room_for_leaf(const struct emitter *e, size_t count)
{
    const size_t align = 15, head = sizeof(struct wide_block) + align, id = sizeof(uint32_t);
    if (!e->build->a->prims.only_floats)
        return count * (head + 9 * sizeof(double) + id);
    const size_t least = e->rule.pool ? POOL / 3 : WIDE_BLOCK;
    const size_t corners = e->rule.pool ? 3 * WIDE_BLOCK : 0;
    return count * (9 * sizeof(float) + id) + (count + least - 1) / least * (head + corners);
}

/* The bytes that the subtree takes at most. */
static size_t room_for(struct emitter *e, uint32_t place)
{
    const struct wide_binary *top = &e->tree->nodes[place];
    struct children c = {.count = 0};
    if (!tick(e, TICK_ROOM))
        return 0;
    if (top->leaf)
        return room_for_leaf(e, top->count);
    collect(e, place + 1, top->left_of_all, &c);
    collect(e, top->right, WIDE - top->left_of_all, &c);
    size_t capacity = sizeof(struct wide_node) + 64;
    for (uint32_t i = 0; i < c.count; i++)
        capacity += room_for(e, c.place[i]);
    return capacity;
}

static unsigned char *align(void *memory)
{
    return (unsigned char *)(((uintptr_t)memory + 63) & ~(uintptr_t)63);
}

static bool allocate(struct emitter *e, size_t bytes)
{
    struct wide *w = e->w;
    w->memory = accel_memory_resize(&e->build->a->memory, NULL, 0, bytes + 64);
    if (!w->memory)
        return accel_build_no_memory(e->build);
    w->bytes = bytes + 64;
    w->base = align(w->memory);
    return true;
}

/* Gives back what the layout did not need. */
static void trim(struct emitter *e)
{
    struct wide *w = e->w;
    const size_t bytes = e->used + TAIL + 64,
                 shift = (size_t)(w->base - (unsigned char *)w->memory);
    memset(w->base + e->used, 0, TAIL);
    void *smaller = accel_memory_resize(&e->build->a->memory, w->memory, w->bytes, bytes);
    if (!smaller)
        return;
    w->memory = smaller;
    w->bytes = bytes;
    w->base = align(smaller);
    if (w->base != (unsigned char *)smaller + shift)
        memmove(w->base, (unsigned char *)smaller + shift, e->used + TAIL);
}

bool accel_wide_emit(struct build *build, struct wide *w, struct wide_rule rule,
                     const struct wide_binary_tree *tree)
{
    struct emitter e = {.build = build, .w = w, .rule = rule, .tree = tree};
    const size_t capacity = room_for(&e, 0) + TAIL;
    if (e.stopped || !allocate(&e, capacity) || !emit(&e, 0, 0, &w->root))
        return false;
    trim(&e);
    w->used = e.used;
    w->seal = seal_bytes(w->base, w->used);
    return true;
}
