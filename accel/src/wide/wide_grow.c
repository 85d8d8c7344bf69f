/* SPDX-License-Identifier: Apache-2.0
 *
 * Growing the binary tree that a wide tree is collapsed from: top-down, cut between bins where the
 * surface-area heuristic is lowest (Wald, "On fast Construction of SAH-based Bounding Volume
 * Hierarchies", 2007), small ranges between any two of their items.
 *
 * On the way back up each node learns what its subtree costs at the least as j children of one wide
 * node, for j = 1 .. 16: as one leaf, as one wide node, or as a children of its left side and j - a
 * of its right one (after Wald, Benthin and Boulos 2008). A subtree of n primitives has no use for
 * more than n slots, so most of these tables are short.
 *
 * Depth: a range at depth d has at most 2^(WIDE_MAX_DEPTH - d) items. It holds at the root, as
 * there are fewer than 2^32; and a cut is only made if it holds on both sides, which the cut in the
 * middle always does. So a range at WIDE_MAX_DEPTH has one item. Clusters are parted in the same
 * way within CLUSTER_DEPTH levels.
 */
#include "wide_split.h"

#include <string.h>

#include "../cluster/cluster.h"
#include "../core/four.h"
#include "../core/team.h"

/* Bins an axis; the largest range that is sorted instead; most primitives of a leaf; items between
 * two ticks, and those that could be looked at in the time that a leaf takes. */
enum { BINS = 32, SWEEP = 8, LEAF = 8, TICK = 16384, TICK_LEAF = 8, TICK_GROWN = 1024 };

/* All three axes. Levels that clusters may take of the tree: below, 48 are left for 2^32
 * primitives.
 */
enum { ALL_AXES = 7, CLUSTER_DEPTH = 48 };

/* Fewer items are not worth a thread. */
enum { LEAST_OF_THREAD = 8192 };

struct bounds {
    four lo, hi; /* the fourth is not used */
};

struct bin {
    struct bounds box;
    uint32_t count;
};

/* What all threads share. */
struct shared {
    struct team team;
    atomic_uint grown; /* items that are in their leaves, as far as threads have told */
};

/* What is the same for all ranges of a thread. */
struct grower {
    struct build *build;
    struct shared *shared;
    uint32_t grown; /* items that are in their leaves, not told yet */
    bool helps;     /* a thread beside the one that builds: it must not call hooks */
    const struct wide *w;
    struct wide_rule rule;
    enum wide_cut cut;
    struct wide_binary_tree *tree;
    struct bin (*bins)[BINS]; /* 3 axes, of the range that is cut */
};

/* A range of items, told apart by their keys: twice their centres, or where those coincide their
 * lower corners. */
struct range {
    struct wide_item *at;
    uint32_t count;
    uint32_t limit; /* most of them that a side of a cut may have */
    float weight;   /* key = lo + weight * hi */
    uint32_t axes;  /* bits: those that it may be cut along */
    struct bounds box, keys;
};

/* Where to cut a range: before a bin of an axis, or behind the first `left` items, which then are
 * in order. */
struct cut {
    float cost;    /* the heuristic's, of both sides */
    int axis, bin; /* axis < 0: none was found */
    uint32_t left;
};

/* What a subtree costs at the least as j children, by j; more than `slots` make it no cheaper. */
struct costs {
    float as[WIDE + 1];
    uint32_t slots;
};

static struct bounds nothing(void)
{
    const float inf = (float)INFINITY;
    return (struct bounds){four_all(inf), four_all(-inf)};
}

static inline void add(struct bounds *b, four lo, four hi)
{
    b->lo = four_min(lo, b->lo);
    b->hi = four_max(hi, b->hi);
}

static inline struct bounds sides_of(const struct wide_item *item)
{
    return (struct bounds){four_of_three(item->lo), four_of_three(item->hi)};
}

static inline float key_of(const struct range *r, const struct wide_item *item, int axis)
{
    return item->lo[axis] + r->weight * item->hi[axis];
}

static inline float area(const struct bounds *b)
{
    const float x = b->hi[0] - b->lo[0], y = b->hi[1] - b->lo[1], z = b->hi[2] - b->lo[2];
    return x * y + y * z + z * x;
}

/* Progress, and whether to go on. */
static bool tick(struct grower *g, uint32_t looked_at)
{
    struct shared *s = g->shared;
    if (atomic_load_explicit(&s->team.stopped, memory_order_relaxed))
        return false;
    if (g->grown >= TICK_GROWN) {
        atomic_fetch_add_explicit(&s->grown, g->grown, memory_order_relaxed);
        g->grown = 0;
    }
    if (g->helps)
        return true;
    const double grown = (double)atomic_load_explicit(&s->grown, memory_order_relaxed);
    if (build_step(g->build, looked_at, grown / (double)g->tree->count))
        return true;
    atomic_store(&s->team.stopped, true);
    return false;
}

/* Fills in the boxes. */
static bool measure(struct grower *g, struct range *r)
{
    r->box = r->keys = nothing();
    for (uint32_t i = 0; i < r->count; i++) {
        const struct bounds b = sides_of(&r->at[i]);
        const four key = b.lo + r->weight * b.hi;
        add(&r->box, b.lo, b.hi);
        add(&r->keys, key, key);
        if (i % TICK == TICK - 1 && !tick(g, TICK))
            return false;
    }
    return true;
}

/* ------------------------------------------------------------------------------- bins ---- */

/* Smaller extents would take the scale of the bins beyond float's range. */
#define LEAST_EXTENT 0x1p-100f

static inline bool keys_differ(const struct range *r, int axis)
{
    return r->keys.hi[axis] - r->keys.lo[axis] > LEAST_EXTENT;
}

static inline float bin_scale(const struct range *r, int axis)
{
    return keys_differ(r, axis) ? (BINS - 0.01f) / (r->keys.hi[axis] - r->keys.lo[axis]) : 0.0f;
}

static inline int bin_of(const struct range *r, float key, int axis, float scale)
{
    return (int)((key - r->keys.lo[axis]) * scale);
}

static bool fill_bins(struct grower *g, const struct range *r)
{
    const four scale = {bin_scale(r, 0), bin_scale(r, 1), bin_scale(r, 2), 0.0f};
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < BINS; i++)
            g->bins[k][i] = (struct bin){nothing(), 0};
    for (uint32_t i = 0; i < r->count; i++) {
        const struct bounds b = sides_of(&r->at[i]);
        const four key = b.lo + r->weight * b.hi;
        const four_int at = __builtin_convertvector((key - r->keys.lo) * scale, four_int);
        for (int k = 0; k < 3; k++) {
            struct bin *bin = &g->bins[k][at[k]];
            add(&bin->box, b.lo, b.hi);
            bin->count++;
        }
        if (i % TICK == TICK - 1 && !tick(g, TICK))
            return false;
    }
    return true;
}

/* Offers the cuts between two bins of an axis. */
static void cut_bins(const struct grower *g, const struct range *r, int axis, struct cut *best)
{
    const struct bin *bins = g->bins[axis];
    float right_cost[BINS];
    struct bounds box = nothing();
    uint32_t right = 0, left = 0;
    for (int i = BINS - 1; i > 0; i--) {
        add(&box, bins[i].box.lo, bins[i].box.hi);
        right += bins[i].count;
        right_cost[i] = right > 0 ? (float)right * area(&box) : (float)INFINITY;
    }
    box = nothing();
    for (int i = 1; i < BINS; i++) {
        add(&box, bins[i - 1].box.lo, bins[i - 1].box.hi);
        left += bins[i - 1].count;
        if (left == 0 || left > r->limit || r->count - left > r->limit)
            continue;
        const float cost = (float)left * area(&box) + right_cost[i];
        if (cost < best->cost)
            *best = (struct cut){cost, axis, i, left};
    }
}

/* Moves the items before the cut to the front. */
static void partition(const struct range *r, const struct cut *cut)
{
    const float scale = bin_scale(r, cut->axis);
    uint32_t left = 0, right = r->count;
    for (;;) {
        while (left < right &&
               bin_of(r, key_of(r, &r->at[left], cut->axis), cut->axis, scale) < cut->bin)
            left++;
        while (left < right &&
               bin_of(r, key_of(r, &r->at[right - 1], cut->axis), cut->axis, scale) >= cut->bin)
            right--;
        if (left >= right)
            return;
        const struct wide_item moved = r->at[left];
        r->at[left++] = r->at[--right];
        r->at[right] = moved;
    }
}

static bool cut_large(struct grower *g, const struct range *r, struct cut *cut)
{
    if (!fill_bins(g, r))
        return false;
    for (int k = 0; k < 3; k++)
        if (keys_differ(r, k) && r->axes >> k & 1)
            cut_bins(g, r, k, cut);
    if (cut->axis >= 0)
        partition(r, cut);
    return true;
}

/* ------------------------------------------------------------------------------ sweeps ---- */

static void sort_items(const struct range *r, int axis, struct wide_item out[SWEEP])
{
    for (uint32_t i = 0; i < r->count; i++) {
        const float key = key_of(r, &r->at[i], axis);
        uint32_t to = i;
        for (; to > 0 && key_of(r, &out[to - 1], axis) > key; to--)
            out[to] = out[to - 1];
        out[to] = r->at[i];
    }
}

/* Offers the cuts between two items in the order of one axis. */
static void sweep(const struct range *r, const struct wide_item *sorted, int axis, struct cut *best)
{
    float right_cost[SWEEP];
    struct bounds box = nothing();
    for (uint32_t i = r->count - 1; i > 0; i--) {
        const struct bounds b = sides_of(&sorted[i]);
        add(&box, b.lo, b.hi);
        right_cost[i] = (float)(r->count - i) * area(&box);
    }
    box = nothing();
    for (uint32_t left = 1; left < r->count; left++) {
        const struct bounds b = sides_of(&sorted[left - 1]);
        add(&box, b.lo, b.hi);
        const float cost = (float)left * area(&box) + right_cost[left];
        if (cost < best->cost && left <= r->limit && r->count - left <= r->limit)
            *best = (struct cut){cost, axis, 0, left};
    }
}

static void cut_small(const struct range *r, struct cut *cut)
{
    struct wide_item sorted[3][SWEEP];
    for (int k = 0; k < 3; k++) {
        if (!(r->axes >> k & 1))
            continue;
        sort_items(r, k, sorted[k]);
        sweep(r, sorted[k], k, cut);
    }
    if (cut->axis >= 0)
        memcpy(r->at, sorted[cut->axis], r->count * sizeof *r->at);
}

/* ------------------------------------------------------------------------- what it costs ---- */

static accel_type type_of(const struct grower *g, uint32_t id)
{
    return primitives_geometry(&g->build->a->prims, id)->type;
}

static float in_lanes(const struct grower *g, uint32_t count)
{
    return (float)((count + g->rule.lanes - 1) / g->rule.lanes);
}

/* Of some items as one leaf. */
static float leaf_cost(const struct grower *g, const struct wide_item *at, uint32_t count)
{
    uint32_t spheres = 0, objects = 0;
    if (count > LEAF)
        return (float)INFINITY;
    for (uint32_t i = 0; i < count && !g->build->a->prims.only_triangles; i++) {
        const accel_type type = type_of(g, at[i].id);
        spheres += type == ACCEL_SPHERES;
        objects += type == ACCEL_OBJECTS;
    }
    return COST_WIDE_LEAF + COST_WIDE_TRIANGLES * in_lanes(g, count - spheres - objects) +
           COST_WIDE_SPHERES * in_lanes(g, spheres) + COST_WIDE_OBJECT * (float)objects;
}

/* The cheapest sharing of `slots` slots between the sides. */
static uint8_t share(const struct costs side[2], uint32_t slots, float *least)
{
    uint8_t best = 1;
    *least = (float)INFINITY;
    const uint32_t most = side[0].slots < slots - 1 ? side[0].slots : slots - 1;
    for (uint32_t left = 1; left <= most; left++) {
        const uint32_t right = slots - left < side[1].slots ? slots - left : side[1].slots;
        const float cost = side[0].as[left] + side[1].as[right];
        if (cost < *least) {
            *least = cost;
            best = (uint8_t)left;
        }
    }
    return best;
}

/* Fills in a node's costs from those of its sides. */
static void join(const struct grower *g, struct wide_binary *node, float surface,
                 const struct costs side[2], struct costs *out)
{
    const float leaf = surface * leaf_cost(g, g->tree->items + node->first, node->count);
    const uint32_t slots = side[0].slots + side[1].slots;
    float shared = 0.0f;
    out->slots = slots < WIDE ? slots : WIDE;
    for (uint32_t j = 2; j <= out->slots; j++) {
        node->left[j] = share(side, j, &shared);
        out->as[j] = shared;
    }
    const float inner = surface * g->rule.node_cost + shared;
    node->left_of_all = node->left[out->slots];
    node->leaf = leaf <= inner;
    out->as[1] = node->leaf ? leaf : inner;
    for (uint32_t j = 2; j <= out->slots; j++) {
        if (out->as[j - 1] <= out->as[j]) {
            out->as[j] = out->as[j - 1];
            node->left[j] = 0;
        }
    }
    while (out->slots > 1 && node->left[out->slots] == 0)
        out->slots--;
    node->slots = (uint8_t)out->slots;
}

/* ------------------------------------------------------------------------------ growing ---- */

/* What a range `levels` above the deepest may hold. */
static uint32_t most_items(uint32_t levels)
{
    return levels < 32 ? 1u << levels : UINT32_MAX;
}

/* The axes that the next cut may be along. */
static uint32_t axes_after(const struct grower *g, uint32_t axes, int cut)
{
    const uint32_t left = cut < 0 ? axes : axes & ~(1u << cut);
    return g->cut == WIDE_BY_COST || left == 0 ? ALL_AXES : left;
}

/* Splits a range in two: *left items stand before the cut. Where nothing tells them apart, or where
 * the tree would become too deep, in the middle. */
static bool split(struct grower *g, struct range *r, uint32_t *left)
{
    struct cut cut = {(float)INFINITY, -1, 0, 0};
    if (r->count <= SWEEP) {
        cut_small(r, &cut);
    } else {
        if (!keys_differ(r, 0) && !keys_differ(r, 1) && !keys_differ(r, 2)) {
            r->weight = 0.0f;
            if (!measure(g, r))
                return false;
        }
        if (!cut_large(g, r, &cut))
            return false;
        if (cut.axis < 0 && r->axes != ALL_AXES) {
            r->axes = ALL_AXES;
            if (!cut_large(g, r, &cut))
                return false;
        }
    }
    r->axes = axes_after(g, r->axes, cut.axis);
    *left = cut.axis >= 0 ? cut.left : r->count / 2;
    return true;
}

/* Fills in a node over `count` items from the `first` on, as a leaf. */
static void set_node(struct wide_binary *node, const struct bounds *box, uint32_t first,
                     uint32_t count)
{
    memcpy(node->lo, &box->lo, sizeof node->lo);
    memcpy(node->hi, &box->hi, sizeof node->hi);
    node->first = first;
    node->count = count;
    node->right = 0;
    node->slots = 1;
    node->leaf = true;
}

/* A range that is to be grown. */
struct task {
    uint32_t first, count, place, depth, axes;
    struct costs *out;
};

/* The same by a thread of its own. */
struct branch {
    struct grower grower;
    struct task task;
    bool fine;
};

static bool grow_sides(struct grower *g, const struct task side[2]);

static bool grow(struct grower *g, uint32_t first, uint32_t count, uint32_t place, uint32_t depth,
                 uint32_t axes, struct costs *out)
{
    struct wide_binary *node = &g->tree->nodes[place];
    struct range r = {.at = g->tree->items + first, .count = count, .weight = 1.0f, .axes = axes};
    struct costs side[2];
    uint32_t left;
    if (!measure(g, &r))
        return false;
    set_node(node, &r.box, first, count);
    if (count == 1) {
        *out = (struct costs){.as[1] = area(&r.box) * leaf_cost(g, r.at, 1), .slots = 1};
        g->grown++;
        return tick(g, TICK_LEAF);
    }
    r.limit = most_items(WIDE_MAX_DEPTH - depth - 1);
    if (!split(g, &r, &left))
        return false;
    node->right = place + 2 * left;
    const struct task task[2] = {
        {first, left, place + 1, depth + 1, r.axes, &side[0]},
        {first + left, count - left, node->right, depth + 1, r.axes, &side[1]}};
    if (!grow_sides(g, task))
        return false;
    join(g, node, area(&r.box), side, out);
    return true;
}

static bool grow_task(struct grower *g, const struct task *t)
{
    return grow(g, t->first, t->count, t->place, t->depth, t->axes, t->out);
}

static void grow_branch(void *user)
{
    struct branch *b = user;
    struct bin bins[3][BINS];
    b->grower.bins = bins;
    b->fine = grow_task(&b->grower, &b->task);
    atomic_fetch_add_explicit(&b->grower.shared->grown, b->grower.grown, memory_order_relaxed);
}

static void watch(void *user)
{
    tick(user, TICK);
}

/* One side beside the other, where a thread is to be had and both are worth it. */
__attribute__((noinline)) static bool grow_beside(struct grower *g, const struct task side[2])
{
    struct branch b = {*g, side[1], false};
    struct team_branch t = {.work = grow_branch, .user = &b};
    b.grower.helps = true;
    b.grower.grown = 0;
    if (!accel_team_start(&g->shared->team, &t))
        return grow_task(g, &side[0]) && grow_task(g, &side[1]);
    const bool fine = grow_task(g, &side[0]);
    accel_team_wait(&t, g->helps ? NULL : watch, g);
    return fine && b.fine && !atomic_load(&g->shared->team.stopped);
}

static bool grow_sides(struct grower *g, const struct task side[2])
{
    if (side[0].count >= LEAST_OF_THREAD && side[1].count >= LEAST_OF_THREAD)
        return grow_beside(g, side);
    return grow_task(g, &side[0]) && grow_task(g, &side[1]);
}

/* ----------------------------------------------------------------------------- clusters ---- */

/* Makes items of some primitives. */
static bool gather(struct grower *g, const uint32_t *ids, uint32_t first, uint32_t count)
{
    struct wide_item *items = g->tree->items + first;
    for (uint32_t i = 0; i < count; i++) {
        items += accel_wide_split_items(g->tree->split, ids[i], items);
        if (i % TICK == TICK - 1 && !tick(g, 0))
            return false;
    }
    return true;
}

/* Items that a cluster becomes. */
static uint32_t count_items(const struct grower *g, const struct cluster *c)
{
    const uint32_t *ids = g->tree->clusters->order.at + c->first;
    uint32_t sum = 0;
    if (!g->tree->split->pieces)
        return c->count;
    for (uint32_t i = 0; i < c->count; i++)
        sum += wide_split_pieces(g->tree->split, ids[i]);
    return sum;
}

static uint32_t count_primitives(const struct grower *g, const struct wide_item *clusters,
                                 uint32_t count)
{
    uint32_t sum = 0;
    for (uint32_t i = 0; i < count; i++)
        sum += count_items(g, &g->tree->clusters->clusters.at[clusters[i].id]);
    return sum;
}

static bool grow_cluster(struct grower *g, uint32_t number, uint32_t first, uint32_t place,
                         uint32_t depth, struct costs *out)
{
    const struct clustering *c = g->tree->clusters;
    const struct cluster *cluster = &c->clusters.at[number];
    return gather(g, c->order.at + cluster->first, first, cluster->count) &&
           grow(g, first, count_items(g, cluster), place, depth, ALL_AXES, out);
}

/* Grows the subtree over some clusters, whose primitives will stand from the `first` item on. */
static bool grow_clusters(struct grower *g, struct wide_item *at, uint32_t count, uint32_t first,
                          uint32_t place, uint32_t depth, struct costs *out)
{
    struct wide_binary *node = &g->tree->nodes[place];
    struct range r = {.at = at, .count = count, .weight = 1.0f, .axes = ALL_AXES};
    struct costs side[2];
    uint32_t left;
    if (count == 1)
        return grow_cluster(g, at->id, first, place, depth, out);
    r.limit = most_items(CLUSTER_DEPTH - depth - 1);
    if (!measure(g, &r) || !split(g, &r, &left))
        return false;
    const uint32_t before = count_primitives(g, at, left);
    set_node(node, &r.box, first, before + count_primitives(g, at + left, count - left));
    node->right = place + 2 * before;
    if (!grow_clusters(g, at, left, first, place + 1, depth + 1, &side[0]) ||
        !grow_clusters(g, at + left, count - left, first + before, node->right, depth + 1,
                       &side[1]))
        return false;
    join(g, node, area(&r.box), side, out);
    return true;
}

static bool grow_hierarchy(struct grower *g, struct costs *out)
{
    const struct clustering *c = g->tree->clusters;
    struct memory *m = &g->build->a->memory;
    const size_t bytes = c->clusters.count * sizeof(struct wide_item);
    struct wide_item *clusters = accel_memory_resize(m, NULL, 0, bytes);
    if (!clusters)
        return accel_build_no_memory(g->build);
    for (uint32_t i = 0; i < c->clusters.count; i++)
        clusters[i] = accel_wide_item_of(g->w, &c->clusters.at[i].box, i);
    const bool fine = grow_clusters(g, clusters, (uint32_t)c->clusters.count, 0, 0, 0, out);
    accel_memory_resize(m, clusters, bytes, 0);
    return fine;
}

bool accel_wide_grow(struct build *build, const struct wide *w, struct wide_rule rule,
                     enum wide_cut cut, struct wide_binary_tree *tree)
{
    struct shared shared = {.grown = 0};
    struct bin bins[3][BINS];
    struct grower g = {.build = build,
                       .shared = &shared,
                       .w = w,
                       .rule = rule,
                       .cut = cut,
                       .tree = tree,
                       .bins = bins};
    struct costs costs;
    accel_team_make(&shared.team, build->hooks->threads);
    if (tree->clusters)
        return grow_hierarchy(&g, &costs);
    return gather(&g, build->a->prims.bounded.at, 0, (uint32_t)build->a->prims.bounded.count) &&
           grow(&g, 0, tree->count, 0, 0, ALL_AXES, &costs);
}
