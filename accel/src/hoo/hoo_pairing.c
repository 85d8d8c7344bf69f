/* SPDX-License-Identifier: Apache-2.0 */
#include "hoo_pairing.h"

#include "../core/order.h"

/* Places up and down the curve where a partner is looked for. */
enum { WINDOW = 12 };

/* A tree that waits for its partner. */
struct item {
    accel_box box;
    struct boxtree_child child; /* its root */
    uint32_t partner;           /* the item it would be joined with */
    uint32_t depth;             /* of its deepest leaf, below its root */
};

struct pairer {
    struct build *build;
    struct boxtree *tree;
    struct frame frame; /* of all boxes */
    ARRAY_OF(struct item) items;
    size_t total; /* items at the start */
};

static struct memory *memory_of(const struct pairer *p)
{
    return &p->build->a->memory;
}

/* Lays the leaves along the curve. */
static bool fill(struct pairer *p, struct keyed *order,
                 const accel_box *(*box_of)(const void *user, size_t i), const void *user)
{
    accel_box all = box_empty();
    for (size_t i = 0; i < p->total; i++)
        box_add(&all, box_of(user, i));
    p->frame = frame_of(&all);
    for (size_t i = 0; i < p->total; i++) {
        const accel_box unit = frame_box(&p->frame, box_of(user, i));
        order[i] = (struct keyed){accel_order_morton(&unit), (uint32_t)i};
    }
    if (!accel_order_by_key(memory_of(p), order, p->total) ||
        !array_extend(memory_of(p), &p->items, p->total))
        return accel_build_no_memory(p->build);
    for (size_t i = 0; i < p->total; i++)
        p->items.at[i] = (struct item){*box_of(user, order[i].value), {order[i].value, 1}, 0, 0};
    return true;
}

/* Surface of the box around two, in units of the frame. Where surfaces are equal, for instance 0
 * for points on a line, the nearer on the curve is taken. */
static double surface(const struct pairer *p, size_t i, size_t j)
{
    accel_box both = p->items.at[i].box;
    box_add(&both, &p->items.at[j].box);
    const accel_box unit = frame_box(&p->frame, &both);
    return box_area(&unit);
}

static uint32_t best_partner(const struct pairer *p, size_t i)
{
    const size_t last = p->items.count - 1;
    size_t best = i < last ? i + 1 : i - 1;
    double least = (double)INFINITY;
    for (size_t step = 1; step <= WINDOW; step++) {
        const size_t near[2] = {i + step, i - step};
        const bool there[2] = {step <= last - i, step <= i};
        for (int side = 0; side < 2; side++) {
            const double area = there[side] ? surface(p, i, near[side]) : least;
            if (area < least) {
                least = area;
                best = near[side];
            }
        }
    }
    return (uint32_t)best;
}

/* Every item chooses. */
static bool choose(struct pairer *p)
{
    for (size_t i = 0; i < p->items.count; i++) {
        p->items.at[i].partner = best_partner(p, i);
        if (i % 1024 == 0 &&
            !accel_build_tick(p->build, 1.0 - (double)p->items.count / (double)p->total))
            return false;
    }
    return true;
}

/* Leaves a partner only to those that are chosen by it; others get themselves. Returns the number
 * of pairs. */
static size_t keep_mutual(struct pairer *p)
{
    size_t pairs = 0;
    for (size_t i = 0; i < p->items.count; i++) {
        struct item *item = &p->items.at[i];
        if (item->partner < i)
            continue; /* has been decided from the other side */
        struct item *other = &p->items.at[item->partner];
        const bool mutual = other->partner == i;
        pairs += mutual;
        if (!mutual)
            item->partner = (uint32_t)i;
    }
    for (size_t i = 0; i < p->items.count; i++) {
        struct item *item = &p->items.at[i];
        if (p->items.at[item->partner].partner != i)
            item->partner = (uint32_t)i;
    }
    return pairs;
}

/* Pairs single items that follow each other until half of all are paired. */
static void add_pairs(struct pairer *p, size_t pairs)
{
    const size_t wanted = (p->items.count + 3) / 4;
    size_t single = p->items.count;
    for (size_t i = 0; i < p->items.count && pairs < wanted; i++) {
        if (p->items.at[i].partner != i)
            continue;
        if (single == p->items.count) {
            single = i;
            continue;
        }
        p->items.at[single].partner = (uint32_t)i;
        p->items.at[i].partner = (uint32_t)single;
        single = p->items.count;
        pairs++;
    }
}

static struct item joined(struct pairer *p, const struct item *a, const struct item *b)
{
    struct boxtree_node *node = &p->tree->nodes.at[p->tree->nodes.count];
    boxtree_set(node, 0, &a->box, a->child);
    boxtree_set(node, 1, &b->box, b->child);
    struct item both = {a->box,
                        {(uint32_t)p->tree->nodes.count, 0},
                        0,
                        1 + (a->depth > b->depth ? a->depth : b->depth)};
    box_add(&both.box, &b->box);
    p->tree->nodes.count++;
    return both;
}

/* Joins the pairs; each stays where its first item was. */
static void join(struct pairer *p)
{
    size_t kept = 0;
    for (size_t i = 0; i < p->items.count; i++) {
        const struct item item = p->items.at[i];
        if (item.partner == i)
            p->items.at[kept++] = item;
        else if (item.partner > i)
            p->items.at[kept++] = joined(p, &item, &p->items.at[item.partner]);
    }
    p->items.count = kept;
}

/* Nodes were made from the leaves up; the walk begins at node 0. */
static void put_root_first(struct boxtree *tree)
{
    const uint32_t last = (uint32_t)tree->nodes.count - 1;
    for (uint32_t low = 0, high = last; low < high; low++, high--) {
        const struct boxtree_node swapped = tree->nodes.at[low];
        tree->nodes.at[low] = tree->nodes.at[high];
        tree->nodes.at[high] = swapped;
    }
    for (uint32_t i = 0; i <= last; i++)
        for (int side = 0; side < 2; side++)
            if (tree->nodes.at[i].child[side].count == 0)
                tree->nodes.at[i].child[side].first = last - tree->nodes.at[i].child[side].first;
}

static bool pair_up(struct pairer *p)
{
    if (!array_reserve(memory_of(p), &p->tree->nodes, p->total - 1))
        return accel_build_no_memory(p->build);
    while (p->items.count > 1) {
        if (!choose(p))
            return false;
        add_pairs(p, keep_mutual(p));
        join(p);
    }
    p->tree->depth = p->items.at[0].depth;
    put_root_first(p->tree);
    return true;
}

bool accel_pair_boxes(struct build *build, struct boxtree *tree, size_t count,
                      const accel_box *(*box_of)(const void *user, size_t i), const void *user)
{
    struct pairer p = {.build = build, .tree = tree, .total = count};
    struct memory *m = memory_of(&p);
    struct keyed *order = accel_memory_resize(m, NULL, 0, count * sizeof *order);
    bool fine = order || accel_build_no_memory(build);
    if (order) {
        fine = fill(&p, order, box_of, user);
        accel_memory_resize(m, order, count * sizeof *order, 0);
    }
    fine = fine && pair_up(&p);
    array_free(m, &p.items);
    return fine;
}
