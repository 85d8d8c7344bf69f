/* SPDX-License-Identifier: Apache-2.0
 *
 * Building an octree: top-down, depth first, children appended behind their parents.
 *
 * Where leaf or depth are left to the builder, it goes deep and then collapses, bottom-up, every
 * subtree that a leaf would beat by predicted cost (the surface-area heuristic of MacDonald and
 * Booth, 1990, applied to octrees as in Aronov et al., CGTA 34, 2006): exact for the tree that was
 * grown, and no parameter. Two rules end the growth: a budget of references, which a cell hands
 * down in proportion, bounds the whole tree; and no more than LOOKAHEAD splits in a row may fail
 * to lower the cost, as one split alone rarely pays.
 *
 * A split that lowers the predicted cost is never taken back: no subtree costs more than the leaf
 * that it replaced. So a cell below none but such splits can be left for later (octree_deferred.h)
 * and is in the end what it would have been.
 */
#include "octree.h"

#include "octree_deferred.h"

#include <string.h>

/* References that a tree may have, in multiples of its primitives: where the builder chooses the
 * depth, and where it is given. Boxes that overlap double their references with each level, so
 * that without a bound a depth of 40 would never end. */
enum { BUDGET = 10, GIVEN_BUDGET = 100 };

/* Splits in a row that may fail to lower the predicted cost. */
enum { LOOKAHEAD = 1 };

/* A large part is grown down to cells of this share of its primitives: a few levels, so that its
 * first ray pays for those only and the others do not go from part to part at every step. */
enum { SHARE_FOR_DEFERRED = 64 };

/* Primitives looked at between two chances to report progress, and those that could be looked at in
 * the time that a leaf takes. */
enum { CHUNK = 16384, LEAF_WORK = 8 };

/* What is the same for all cells of one octree. */
struct grower {
    struct build *build;
    struct octree_pool *pool;
    const accel_box *box; /* padded boxes by id */
    struct octree_rule rule;
    double test_cost;        /* of one primitive */
    struct ids stack;        /* the ids of the cells on the way down */
    uint8_t *children;       /* of the cell being split: which children each primitive meets */
    uint8_t children_in[64]; /* by halves */
    uint64_t one_each[64];   /* by halves: 1 in the byte of each child */
    double done, from, to;   /* volume finished, as a share of the root; progress range */
    uint32_t deferred;       /* cells of no more primitives are left for later; 0: none is */
    const accel_box *tree;   /* the tree's root, if cells are left for later */
    uint32_t depth;          /* deepest leaf so far */
    bool refused;            /* did a cell stay whole for want of budget? */
};

/* One cell to grow. */
struct task {
    accel_box box;   /* the cell */
    size_t begin;    /* its ids in grower.stack */
    uint32_t count;  /* of them */
    uint32_t depth;  /* of the cell */
    uint32_t failed; /* splits in a row that did not lower the cost */
    double budget;   /* references that it may become */
    double volume;   /* share of the root's */
    bool sure;       /* will no split above be taken back? */
};

/* How a cell would be split. */
struct split {
    double plane[3];
    uint32_t count[8]; /* primitives by child */
    double sum;        /* of them */
    uint32_t filled;   /* children that have any */
    double chance;     /* that a line through the cell meets a child; they are alike */
    bool pays;         /* does it lower the cost, even if it were the last? */
};

/* Which halves a box meets: bits 0 to 2, the lower one of each axis; bits 3 to 5, the upper one. */
static inline uint32_t halves_of(const accel_box *b, const double plane[3])
{
    uint32_t halves = 0;
    for (int k = 0; k < 3; k++)
        halves |= (uint32_t)(b->lo[k] <= plane[k]) << k | (uint32_t)(b->hi[k] >= plane[k])
                                                              << (3 + k);
    return halves;
}

/* The children that lie in such halves, as bits. */
static uint32_t children_in(uint32_t halves)
{
    static const uint32_t lower[3] = {0x55, 0x33, 0x0f};
    uint32_t mask = 0xff;
    for (int k = 0; k < 3; k++)
        mask &= (halves >> k & 1 ? lower[k] : 0) | (halves >> (3 + k) & 1 ? ~lower[k] : 0);
    return mask;
}

static accel_box child_box(const accel_box *cell, const double plane[3], uint32_t child)
{
    accel_box b = *cell;
    for (int k = 0; k < 3; k++) {
        if (plane[k] == (double)INFINITY)
            continue;
        *(child >> k & 1 ? &b.lo[k] : &b.hi[k]) = plane[k];
    }
    return b;
}

/* The planes that halve the cell, where double can. */
static void place_planes(const struct task *t, double plane[3])
{
    for (int k = 0; k < 3; k++) {
        const double lo = t->box.lo[k], hi = t->box.hi[k], middle = lo + 0.5 * (hi - lo);
        plane[k] = lo < middle && middle < hi ? middle : (double)INFINITY;
    }
}

/* Reports progress after a look at some primitives. */
static inline bool tick(struct grower *g, uint32_t looked_at)
{
    return build_step(g->build, looked_at, g->from + (g->to - g->from) * fmin(g->done, 1.0));
}

/* Notes each primitive's halves, and those that all of them meet. */
static bool note_halves(struct grower *g, const struct task *t, const double plane[3],
                        uint32_t *all)
{
    const uint32_t *ids = g->stack.at + t->begin;
    uint32_t met = 0x3f; /* *all may share its place with children, for all the compiler knows */
    for (uint32_t i = 0; i < t->count;) {
        const uint32_t first = i, end = t->count - i > CHUNK ? i + CHUNK : t->count;
        for (; i < end; i++) {
            const uint32_t halves = halves_of(&g->box[ids[i]], plane);
            g->children[i] = (uint8_t)halves;
            met &= halves;
        }
        if (!tick(g, end - first))
            return false;
    }
    *all = met;
    return true;
}

/* Turns halves into children and counts them: eight counters of a byte side by side, emptied before
 * they overflow. */
static void count_children(struct grower *g, const struct task *t, struct split *s)
{
    for (uint32_t i = 0; i < t->count;) {
        const uint32_t end = t->count - i > UINT8_MAX ? i + UINT8_MAX : t->count;
        uint64_t counters = 0;
        for (; i < end; i++) {
            const uint8_t halves = g->children[i];
            counters += g->one_each[halves];
            g->children[i] = g->children_in[halves];
        }
        for (int c = 0; c < 8; c++)
            s->count[c] += counters >> (8 * c) & UINT8_MAX;
    }
    for (int c = 0; c < 8; c++) {
        s->sum += s->count[c];
        s->filled += s->count[c] > 0;
    }
}

static double leaf_cost(const struct grower *g, uint32_t count)
{
    return COST_OCTREE_LEAF + g->test_cost * count;
}

/* The cost of the cell if the split were the last. */
static double split_cost(const struct grower *g, const struct split *s)
{
    return COST_OCTREE_NODE + s->chance * (COST_OCTREE_LEAF * s->filled + g->test_cost * s->sum);
}

/* Places the planes, except those that every primitive would lie on, and counts the children.
 * False: cancelled. */
static bool try_split(struct grower *g, const struct task *t, struct split *s)
{
    uint32_t all;
    *s = (struct split){.sum = 0};
    place_planes(t, s->plane);
    if (!note_halves(g, t, s->plane, &all))
        return false;
    const uint32_t across = all & all >> 3;
    for (int k = 0; k < 3; k++)
        if (across >> k & 1)
            s->plane[k] = (double)INFINITY;
    if (across && !note_halves(g, t, s->plane, &all))
        return false;
    count_children(g, t, s);
    const accel_box first = child_box(&t->box, s->plane, 0);
    s->chance = box_chance(&first, &t->box);
    s->pays = split_cost(g, s) < leaf_cost(g, t->count);
    return true;
}

/* Is the cell a leaf before any split is tried? */
static bool small_enough(const struct grower *g, const struct task *t)
{
    const double leaf = isnan(g->rule.leaf) ? 1 : g->rule.leaf;
    const double depth = isnan(g->rule.depth) ? OCTREE_MAX_DEPTH : g->rule.depth;
    return t->count <= leaf || t->depth >= depth;
}

/* May the split that was tried be made? */
static bool may_split(struct grower *g, struct task *t, const struct split *s)
{
    if (isinf(s->plane[0]) && isinf(s->plane[1]) && isinf(s->plane[2]))
        return false;
    if (s->sum > t->budget) {
        g->refused = true;
        return false;
    }
    if (!isnan(g->rule.depth))
        return true;
    t->failed = s->pays ? 0 : t->failed + 1;
    return t->failed <= LOOKAHEAD;
}

static bool too_large(const struct grower *g, const char *what)
{
    accel_error_set(
        g->build->error, ACCEL_TOO_LARGE,
        "build %s: more than 4294967295 %s; nothing was built, allow more primitives per leaf "
        "or less depth",
        g->build->kind, what);
    return false;
}

static bool make_leaf(struct grower *g, const struct task *t, struct octree_cell *cell)
{
    struct memory *m = &g->build->a->memory;
    const size_t first = g->pool->refs.count;
    if (first + t->count > ACCEL_NONE)
        return too_large(g, "references");
    if (!array_extend(m, &g->pool->refs, t->count))
        return accel_build_no_memory(g->build);
    memcpy(g->pool->refs.at + first, g->stack.at + t->begin, t->count * sizeof(uint32_t));
    *cell = (struct octree_cell){(uint32_t)first, t->count};
    g->pool->leaves++;
    g->depth = t->depth > g->depth ? t->depth : g->depth;
    g->done += t->volume;
    return tick(g, LEAF_WORK + t->count);
}

/* Primitives of the cell that no other cell has as well: those whose box begins in it. */
static uint32_t count_owned(const struct grower *g, const struct task *t)
{
    const uint32_t *ids = g->stack.at + t->begin;
    uint32_t owned = 0;
    for (uint32_t i = 0; i < t->count; i++) {
        const accel_box *b = &g->box[ids[i]];
        bool owns = true;
        for (int k = 0; k < 3; k++)
            owns = owns && (b->lo[k] > t->box.lo[k] || t->box.lo[k] == g->tree->lo[k]);
        owned += owns;
    }
    return owned;
}

static bool defer(struct grower *g, const struct task *t, struct octree_cell *cell)
{
    struct memory *m = &g->build->a->memory;
    struct octree_pool *p = g->pool;
    const size_t number = p->deferred.count, first = p->deferred_ids.count;
    if (!array_extend(m, &p->deferred, 1) || !array_extend(m, &p->deferred_ids, t->count))
        return accel_build_no_memory(g->build);
    memcpy(p->deferred_ids.at + first, g->stack.at + t->begin, t->count * sizeof(uint32_t));
    p->deferred.at[number] = (struct octree_deferred){.box = t->box,
                                                      .count = t->count,
                                                      .owned = count_owned(g, t),
                                                      .depth = t->depth,
                                                      .failed = t->failed,
                                                      .budget = t->budget};
    *cell = (struct octree_cell){(uint32_t)number, OCTREE_LATER};
    return tick(g, t->count);
}

/* Pushes the ids of each child, one run after the other. */
static bool push_children(struct grower *g, const struct task *t, const struct split *s)
{
    const size_t base = g->stack.count;
    if (!array_extend(&g->build->a->memory, &g->stack, (size_t)s->sum))
        return accel_build_no_memory(g->build);
    size_t next[8], at = base;
    for (int c = 0; c < 8; c++) {
        next[c] = at;
        at += s->count[c];
    }
    for (uint32_t i = 0; i < t->count;) {
        const uint32_t first = i, end = t->count - i > CHUNK ? i + CHUNK : t->count;
        for (; i < end; i++)
            for (uint32_t mask = g->children[i]; mask; mask &= mask - 1)
                g->stack.at[next[__builtin_ctz(mask)]++] = g->stack.at[t->begin + i];
        if (!tick(g, end - first))
            return false;
    }
    return true;
}

/* What a subtree adds is taken back by going to its mark. */
struct mark {
    size_t words, refs, nodes, leaves, stacked;
    double done;
    uint32_t depth;
    bool refused;
};

static struct mark mark(const struct grower *g)
{
    const struct octree_pool *p = g->pool;
    return (struct mark){p->words.count, p->refs.count, p->nodes, p->leaves,
                         g->stack.count, g->done,       g->depth, g->refused};
}

static void take_back(struct grower *g, const struct mark *m)
{
    g->pool->words.count = m->words;
    g->pool->refs.count = m->refs;
    g->pool->nodes = m->nodes;
    g->pool->leaves = m->leaves;
    g->done = m->done;
    g->depth = m->depth;
    g->refused = m->refused;
}

static bool grow(struct grower *g, struct task *t, struct octree_cell *cell, double *cost);

/* Makes a node with room for its children. */
static bool make_node(struct grower *g, const struct split *s, struct octree_cell *cell)
{
    struct octree_pool *p = g->pool;
    const size_t first = p->words.count;
    uint32_t mask = 0;
    for (uint32_t c = 0; c < 8; c++)
        mask |= (uint32_t)(s->count[c] > 0) << c;
    const size_t words = octree_words(octree_bits(mask));
    if (first + words > ACCEL_NONE)
        return too_large(g, "words of nodes");
    if (!array_extend(&g->build->a->memory, &p->words, words))
        return accel_build_no_memory(g->build);
    *cell = (struct octree_cell){(uint32_t)first, 0};
    struct octree_node *node = octree_node_at(p, cell->first);
    *node = (struct octree_node){{s->plane[0], s->plane[1], s->plane[2]}, mask, 0};
    p->nodes++;
    return true;
}

/* Grows the children of a node just made; their expected cost goes into *cost. */
static bool grow_children(struct grower *g, const struct task *t, const struct split *s,
                          const struct octree_cell *cell, double *cost)
{
    size_t begin = g->stack.count - (size_t)s->sum;
    uint32_t at = 0;
    *cost = COST_OCTREE_NODE;
    for (uint32_t c = 0; c < 8; c++) {
        if (s->count[c] == 0) {
            g->done += t->volume / 8;
            continue;
        }
        const double share = s->count[c] / s->sum;
        struct task child = {child_box(&t->box, s->plane, c),
                             begin,
                             s->count[c],
                             t->depth + 1,
                             t->failed,
                             t->budget * share,
                             t->volume / 8,
                             t->sure && (s->pays || !isnan(g->rule.leaf))};
        struct octree_cell made;
        double child_cost;
        if (!grow(g, &child, &made, &child_cost))
            return false;
        octree_node_at(g->pool, cell->first)->child[at++] = made;
        *cost += s->chance * child_cost;
        begin += s->count[c];
    }
    return true;
}

/* Grows one cell; its expected cost goes into *cost. */
static bool grow(struct grower *g, struct task *t, struct octree_cell *cell, double *cost)
{
    struct split s;
    *cost = leaf_cost(g, t->count);
    if (small_enough(g, t))
        return make_leaf(g, t, cell);
    if (t->sure && t->count <= g->deferred)
        return defer(g, t, cell);
    if (!try_split(g, t, &s))
        return false;
    if (!may_split(g, t, &s))
        return make_leaf(g, t, cell);
    const struct mark before = mark(g);
    double inner;
    if (!push_children(g, t, &s) || !make_node(g, &s, cell) ||
        !grow_children(g, t, &s, cell, &inner))
        return false;
    g->stack.count = before.stacked;
    if (isnan(g->rule.leaf) && !s.pays && inner >= *cost) {
        take_back(g, &before);
        return make_leaf(g, t, cell);
    }
    *cost = inner;
    return true;
}

static bool prepare(struct grower *g, const uint32_t *ids, size_t count)
{
    struct memory *m = &g->build->a->memory;
    for (uint32_t halves = 0; halves < 64; halves++) {
        g->children_in[halves] = (uint8_t)children_in(halves);
        for (int c = 0; c < 8; c++)
            g->one_each[halves] |= (uint64_t)(g->children_in[halves] >> c & 1) << (8 * c);
    }
    g->children = accel_memory_resize(m, NULL, 0, count);
    if (!g->children || !array_extend(m, &g->stack, count))
        return accel_build_no_memory(g->build);
    memcpy(g->stack.at, ids, count * sizeof *ids);
    return true;
}

static struct grower grower_of(struct build *build, struct octree_pool *pool,
                               struct octree_rule rule)
{
    const struct primitives *prims = &build->a->prims;
    return (struct grower){.build = build,
                           .pool = pool,
                           .box = prims->box,
                           .rule = rule,
                           .test_cost =
                               prims->only_triangles ? COST_OCTREE_TRIANGLE : prims->test_cost};
}

static double budget_of(struct octree_rule rule, size_t count)
{
    return (isnan(rule.depth) ? BUDGET : GIVEN_BUDGET) * (double)count;
}

/* Grows the tree or part below `root`, over ids. */
static bool grow_all(struct grower *g, struct task *root, const uint32_t *ids,
                     struct octree_cell *cell)
{
    struct memory *m = &g->build->a->memory;
    accel_info *info = &g->build->a->info;
    double cost;
    const bool fine = prepare(g, ids, root->count) && grow(g, root, cell, &cost);
    if (g->children)
        accel_memory_resize(m, g->children, root->count, 0);
    array_free(m, &g->stack);
    info->depth = g->depth > info->depth ? g->depth : info->depth;
    return fine;
}

bool accel_octree_build(struct build *build, struct octree_pool *pool, struct octree *tree,
                        const uint32_t *ids, size_t count, const accel_box *box,
                        struct octree_rule rule, double from, double to)
{
    struct grower g = grower_of(build, pool, rule);
    struct task root = {
        .box = *box, .count = (uint32_t)count, .budget = budget_of(rule, count), .volume = 1.0};
    g.from = from;
    g.to = to;
    tree->box = *box;
    const bool fine = grow_all(&g, &root, ids, &tree->root);
    if (g.refused && !isnan(rule.depth))
        accel_octree_note_refused(&build->a->info);
    return fine;
}

/* Cells of no more primitives are left for later in a part of `count`. */
static uint32_t size_for_deferred(uint32_t count, uint32_t whole)
{
    if (count <= whole)
        return 0;
    return whole > count / SHARE_FOR_DEFERRED ? whole : count / SHARE_FOR_DEFERRED;
}

bool accel_octree_grow_part(struct build *build, struct octree_pool *pool, struct octree_cell *root,
                            const struct octree_lazy *lazy, const struct octree_deferred *part,
                            const accel_box *tree, bool *refused)
{
    struct grower g = grower_of(build, pool, lazy->rule);
    struct task task = {.box = part->box,
                        .count = part->count,
                        .depth = part->depth,
                        .failed = part->failed,
                        .budget = part->budget,
                        .sure = true};
    g.deferred = size_for_deferred(part->count, lazy->whole);
    g.tree = tree;
    const bool fine = grow_all(&g, &task, part->ids, root);
    *refused = g.refused && !isnan(lazy->rule.depth);
    return fine;
}

struct octree_deferred accel_octree_defer(const uint32_t *ids, size_t count, const accel_box *box,
                                          struct octree_rule rule)
{
    return (struct octree_deferred){.box = *box,
                                    .ids = ids,
                                    .count = (uint32_t)count,
                                    .owned = (uint32_t)count,
                                    .budget = budget_of(rule, count)};
}

void accel_octree_note_refused(accel_info *info)
{
    accel_info_note(
        info,
        "cells above the given depth were left whole: %d references for each primitive were "
        "used up",
        GIVEN_BUDGET);
}

void accel_octree_pool_trim(struct memory *m, struct octree_pool *pool)
{
    array_trim(m, &pool->words);
    array_trim(m, &pool->refs);
}

void accel_octree_pool_free(struct memory *m, struct octree_pool *pool)
{
    array_free(m, &pool->words);
    array_free(m, &pool->refs);
    array_free(m, &pool->deferred);
    array_free(m, &pool->deferred_ids);
}
