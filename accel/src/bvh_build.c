/* SPDX-License-Identifier: Apache-2.0
 *
 * Building a bvh: top-down over one array of items that is partitioned in place, so the
 * primitives below a node are always one run of it, and the references are that array's ids.
 *
 * A large range is cut between bins of equal width, a small one between any two of its items in
 * order: always where the surface-area heuristic is lowest. Where the leaf size is left to the
 * builder, it splits down to one primitive and then collapses, bottom-up, every subtree that a
 * leaf would beat by predicted cost.
 *
 * Items are ordered by the centres of their boxes. Where all centres coincide they are ordered by
 * lower corners, that is by size; where those coincide too, all boxes are the same, no tree can
 * tell them apart, and the range becomes a leaf however many they are.
 *
 * Depth: a range at depth d has at most 2^(BOXTREE_MAX_DEPTH - d) items. It holds at the root, as
 * there are fewer than 2^32; and a cut is only made if it holds on both sides, which the cut in
 * the middle always does. So a range at BOXTREE_MAX_DEPTH has one item and is a leaf.
 */
#include "bvh.h"
#include "frame.h"

#include <string.h>

/* Predicted costs, in units of one node's visit. Of two triangles, which are tested at once, as
 * measured; other primitives cost primitives.test_cost each. */
#define NODE_COST 1.0
#define PAIR_COST 0.5

/* Bins per axis, the largest range whose items are sorted instead, items between two ticks, and
 * those that could be looked at in the time that a leaf takes. */
enum { BINS = 32, SWEEP = 24, TICK = 16384, LEAF_WORK = 8 };

/* One primitive. */
struct item {
    accel_box box; /* padded */
    uint32_t id;
};

/* What falls between two planes of the binning. */
struct bin {
    accel_box box;  /* of its items */
    double least;   /* least key of them */
    uint32_t count; /* of them */
};

/* An item's place in a sorted range. */
struct place {
    double key;
    double right;  /* area of the box of this item and all after it */
    uint32_t id;   /* of the item */
    uint32_t item; /* index in the range */
};

/* A range of items, and how they may be told apart. */
struct range {
    accel_box box;      /* of them all */
    double least[3];    /* keys by axis */
    double greatest[3]; /* keys by axis */
    struct item *at;    /* count of them */
    uint32_t count;     /* items */
    uint32_t limit;     /* most of them that a side of a cut may have */
    double weight;      /* key = lo + weight * hi: 1 for centres, 0 for lower corners */
};

/* Items before (key, id) on this axis go left. */
struct cut {
    double key, cost; /* cost: the heuristic's, of both sides */
    uint32_t id;
    int axis; /* -1: there is no cut */
};

/* What is the same for all ranges. */
struct grower {
    struct build *build;
    struct bvh *bvh;
    struct item *items;            /* all of them */
    ARRAY_OF(struct place) places; /* of the range that is sorted */
    struct bin bins[3][BINS];      /* of the range that is binned */
    double leaf;                   /* as for bvh_build */
    double scale;                  /* power of two that takes the scene's extent to about 1 */
};

/* A finished subtree. */
struct subtree {
    struct boxtree_child child;
    accel_box box;
    double cost;     /* predicted, given that the box is met */
    uint32_t height; /* levels below */
};

static double key_of(const struct range *r, const struct item *item, int axis)
{
    return item->box.lo[axis] + r->weight * item->box.hi[axis];
}

/* Half the surface in scaled units, in which no scene over- or underflows. */
static double area(const struct grower *g, const accel_box *b)
{
    const double x = g->scale * (b->hi[0] - b->lo[0]), y = g->scale * (b->hi[1] - b->lo[1]),
                 z = g->scale * (b->hi[2] - b->lo[2]);
    return x * y + y * z + z * x;
}

static double chance(const struct grower *g, const accel_box *inner, const accel_box *outer)
{
    const double ratio = area(g, inner) / area(g, outer);
    return ratio >= 0.0 && ratio <= 1.0 ? ratio : 1.0;
}

/* ---------------------------------------------------------------- one range ---- */

static bool tick(struct grower *g, const struct item *at, uint32_t looked_at)
{
    return build_step(g->build, looked_at,
                      (double)(at - g->items) / (double)g->build->a->prims.bounded.count);
}

static bool keys_differ(const struct range *r)
{
    return r->least[0] < r->greatest[0] || r->least[1] < r->greatest[1] ||
           r->least[2] < r->greatest[2];
}

/* Fills in what follows from the items and the weight. */
static bool measure(struct grower *g, struct range *r)
{
    accel_box box = box_empty(), keys = box_empty();
    for (uint32_t i = 0; i < r->count; i++) {
        const struct item *item = &r->at[i];
        const double key[3] = {key_of(r, item, 0), key_of(r, item, 1), key_of(r, item, 2)};
        box_add(&box, &item->box);
        box_add_point(&keys, key);
        if (i % TICK == TICK - 1 && !tick(g, r->at, TICK))
            return false;
    }
    r->box = box;
    memcpy(r->least, keys.lo, sizeof r->least);
    memcpy(r->greatest, keys.hi, sizeof r->greatest);
    return true;
}

/* ------------------------------------------------------------------ binning ---- */

static void clear_bins(struct grower *g)
{
    for (int k = 0; k < 3; k++)
        for (int b = 0; b < BINS; b++)
            g->bins[k][b] = (struct bin){box_empty(), (double)INFINITY, 0};
}

static bool fill_bins(struct grower *g, const struct range *r)
{
    double scale[3];
    for (int k = 0; k < 3; k++)
        scale[k] = (BINS - 0.5) / (r->greatest[k] - r->least[k]);
    clear_bins(g);
    for (uint32_t i = 0; i < r->count; i++) {
        for (int k = 0; k < 3; k++) {
            const double key = key_of(r, &r->at[i], k);
            const double place = (key - r->least[k]) * scale[k];
            struct bin *bin = &g->bins[k][place >= 0.0 && place < BINS ? (int)place : 0];
            box_add(&bin->box, &r->at[i].box);
            bin->least = key < bin->least ? key : bin->least;
            bin->count++;
        }
        if (i % TICK == TICK - 1 && !tick(g, r->at, TICK))
            return false;
    }
    return true;
}

/* Offers every cut between two bins of one axis. */
static void cut_bins(const struct grower *g, const struct range *r, int axis, struct cut *best)
{
    const struct bin *bins = g->bins[axis];
    double right_cost[BINS], least[BINS];
    uint32_t right = 0;
    accel_box box = box_empty();
    for (int b = BINS - 1; b > 0; b--) {
        right += bins[b].count;
        box_add(&box, &bins[b].box);
        right_cost[b] = right > 0 && right <= r->limit ? right * area(g, &box) : (double)INFINITY;
        least[b] = b < BINS - 1 && least[b + 1] < bins[b].least ? least[b + 1] : bins[b].least;
    }
    uint32_t left = 0;
    box = box_empty();
    for (int b = 1; b < BINS; b++) {
        left += bins[b - 1].count;
        if (left == 0)
            continue;
        if (left > r->limit)
            break;
        box_add(&box, &bins[b - 1].box);
        const double cost = left * area(g, &box) + right_cost[b];
        if (cost < best->cost)
            *best = (struct cut){least[b], cost, 0, axis};
    }
}

static bool find_binned_cut(struct grower *g, const struct range *r, struct cut *best)
{
    if (!fill_bins(g, r))
        return false;
    for (int k = 0; k < 3; k++)
        if (r->least[k] < r->greatest[k])
            cut_bins(g, r, k, best);
    return true;
}

/* ----------------------------------------------------------------- sweeping ---- */

static bool place_before(const struct place *a, const struct place *b)
{
    return a->key < b->key || (a->key == b->key && a->id < b->id);
}

static void sift_down(struct place *p, size_t at, size_t count)
{
    const struct place moved = p[at];
    for (;;) {
        size_t child = 2 * at + 1;
        if (child >= count)
            break;
        if (child + 1 < count && place_before(&p[child], &p[child + 1]))
            child++;
        if (!place_before(&moved, &p[child]))
            break;
        p[at] = p[child];
        at = child;
    }
    p[at] = moved;
}

static void heap_sort(struct place *p, size_t count)
{
    for (size_t i = count / 2; i-- > 0;)
        sift_down(p, i, count);
    for (size_t end = count; end-- > 1;) {
        const struct place last = p[end];
        p[end] = p[0];
        p[0] = last;
        sift_down(p, 0, end);
    }
}

static void insertion_sort(struct place *p, size_t count)
{
    for (size_t i = 1; i < count; i++) {
        const struct place moved = p[i];
        size_t at = i;
        for (; at > 0 && place_before(&moved, &p[at - 1]); at--)
            p[at] = p[at - 1];
        p[at] = moved;
    }
}

static void sort_places(const struct grower *g, const struct range *r, int axis)
{
    for (uint32_t i = 0; i < r->count; i++)
        g->places.at[i] = (struct place){key_of(r, &r->at[i], axis), 0.0, r->at[i].id, i};
    if (r->count <= SWEEP)
        insertion_sort(g->places.at, r->count);
    else
        heap_sort(g->places.at, r->count);
}

/* Offers every cut between two items in the order of one axis. */
static void sweep(const struct grower *g, const struct range *r, int axis, struct cut *best)
{
    struct place *places = g->places.at;
    sort_places(g, r, axis);
    accel_box box = box_empty();
    for (uint32_t i = r->count - 1; i > 0; i--) {
        box_add(&box, &r->at[places[i].item].box);
        places[i].right = area(g, &box);
    }
    box = box_empty();
    for (uint32_t left = 1; left < r->count; left++) {
        const uint32_t right = r->count - left;
        box_add(&box, &r->at[places[left - 1].item].box);
        if (left > r->limit || right > r->limit)
            continue;
        const double cost = left * area(g, &box) + right * places[left].right;
        if (cost < best->cost)
            *best = (struct cut){places[left].key, cost, places[left].id, axis};
    }
}

static bool find_swept_cut(struct grower *g, const struct range *r, struct cut *best)
{
    if (!array_reserve(&g->build->a->memory, &g->places, r->count))
        return build_no_memory(g->build);
    for (int k = 0; k < 3; k++)
        if (r->least[k] < r->greatest[k])
            sweep(g, r, k, best);
    return true;
}

/* ------------------------------------------------------------------ growing ---- */

/* The items that a range at this depth may have. */
static uint32_t most_items(uint32_t depth)
{
    return BOXTREE_MAX_DEPTH - depth < 32 ? 1u << (BOXTREE_MAX_DEPTH - depth) : UINT32_MAX;
}

static bool find_cut(struct grower *g, const struct range *r, struct cut *cut)
{
    *cut = (struct cut){0.0, (double)INFINITY, 0, -1};
    if (r->count > SWEEP && !find_binned_cut(g, r, cut))
        return false;
    return cut->axis >= 0 || find_swept_cut(g, r, cut);
}

static bool goes_left(const struct range *r, const struct cut *cut, const struct item *item)
{
    const double key = key_of(r, item, cut->axis);
    return key < cut->key || (key == cut->key && item->id < cut->id);
}

/* Moves the items that go left to the front. Returns how many. */
static uint32_t partition(const struct range *r, const struct cut *cut)
{
    uint32_t left = 0, right = r->count;
    for (;;) {
        while (left < right && goes_left(r, cut, &r->at[left]))
            left++;
        while (left < right && !goes_left(r, cut, &r->at[right - 1]))
            right--;
        if (left >= right)
            return left;
        const struct item moved = r->at[left];
        r->at[left++] = r->at[--right];
        r->at[right] = moved;
    }
}

static double leaf_cost(const struct grower *g, uint32_t count)
{
    const struct primitives *p = &g->build->a->prims;
    return p->only_triangles ? PAIR_COST * ((count + 1) / 2) : p->test_cost * count;
}

/* Is a range a leaf before any cut is tried? Where cost decides, a node alone may cost more. */
static bool small_enough(const struct grower *g, uint32_t count)
{
    return isnan(g->leaf) ? count == 1 || leaf_cost(g, count) <= NODE_COST : count <= g->leaf;
}

static bool make_leaf(struct grower *g, const struct range *r, struct subtree *out)
{
    const uint32_t first = (uint32_t)(r->at - g->items);
    *out = (struct subtree){{first, r->count}, r->box, leaf_cost(g, r->count), 0};
    return tick(g, r->at, LEAF_WORK + r->count);
}

/* Puts a node over two subtrees, or a leaf in its place if that costs less. */
static bool join(struct grower *g, const struct range *r, size_t node, const struct subtree half[2],
                 struct subtree *out)
{
    const double cost = NODE_COST + chance(g, &half[0].box, &r->box) * half[0].cost +
                        chance(g, &half[1].box, &r->box) * half[1].cost;
    if (isnan(g->leaf) && cost >= leaf_cost(g, r->count)) {
        g->bvh->nodes.count = node;
        return make_leaf(g, r, out);
    }
    const uint32_t height = half[0].height > half[1].height ? half[0].height : half[1].height;
    for (int i = 0; i < 2; i++)
        boxtree_set(&g->bvh->nodes.at[node], i, &half[i].box, half[i].child);
    *out = (struct subtree){{(uint32_t)node, 0}, r->box, cost, height + 1};
    return true;
}

/* Grows the subtree over the items at[0 .. count - 1]. */
static bool grow(struct grower *g, struct item *at, uint32_t count, uint32_t depth,
                 struct subtree *out)
{
    struct range r = {.at = at, .count = count, .weight = 1.0};
    struct cut cut;
    if (!measure(g, &r))
        return false;
    if (count > 1 && !keys_differ(&r)) {
        r.weight = 0.0;
        if (!measure(g, &r))
            return false;
    }
    if (!keys_differ(&r) || small_enough(g, count))
        return make_leaf(g, &r, out);
    r.limit = most_items(depth + 1);
    if (!find_cut(g, &r, &cut))
        return false;
    const uint32_t left = partition(&r, &cut);
    const size_t node = g->bvh->nodes.count;
    struct subtree half[2];
    if (!array_extend(&g->build->a->memory, &g->bvh->nodes, 1))
        return build_no_memory(g->build);
    return grow(g, at, left, depth + 1, &half[0]) &&
           grow(g, at + left, count - left, depth + 1, &half[1]) && join(g, &r, node, half, out);
}

/* Copies what the builder needs of every bounded primitive. */
static bool gather(struct grower *g)
{
    const struct primitives *p = &g->build->a->prims;
    struct memory *m = &g->build->a->memory;
    const accel_box box = p->bounds;
    g->items = memory_resize(m, NULL, 0, p->bounded.count * sizeof *g->items);
    if (!g->items || !array_extend(m, &g->bvh->refs, p->bounded.count))
        return build_no_memory(g->build);
    for (size_t i = 0; i < p->bounded.count; i++)
        g->items[i] = (struct item){p->box[p->bounded.at[i]], p->bounded.at[i]};
    g->scale = frame_of(&box).scale;
    return true;
}

/* Takes the finished tree over. */
static void finish(struct grower *g, const struct subtree *root)
{
    struct bvh *b = g->bvh;
    for (size_t i = 0; i < b->refs.count; i++)
        b->refs.at[i] = g->items[i].id;
    b->root = root->child;
    b->box = root->box;
    b->base.info.depth = root->height;
}

bool bvh_build(struct build *build, struct bvh *bvh, double leaf)
{
    struct grower g = {.build = build, .bvh = bvh, .leaf = leaf};
    struct memory *m = &build->a->memory;
    const size_t count = build->a->prims.bounded.count;
    struct subtree root;
    build_phase(build, "bvh");
    const bool fine = gather(&g) && grow(&g, g.items, (uint32_t)count, 0, &root);
    if (fine)
        finish(&g, &root);
    if (g.items)
        memory_resize(m, g.items, count * sizeof *g.items, 0);
    array_free(m, &g.places);
    build_phase(build, "layout");
    return fine && primitives_move_triangles(build, bvh->refs.at, count, &bvh->triangles);
}
