/* SPDX-License-Identifier: Apache-2.0
 *
 * Gathering fragments: parts of so few primitives that an octree would not pay, such as loose
 * cubes, leaves of a tree, the cells of a cloud of spheres.
 *
 * The fragments of a size class are joined where the gap between their boxes is at most d, then the
 * clusters that this gives where theirs is at most 2d, and so on, until one is left; of these
 * partitions the one with the lowest predicted cost is taken. Those with more clusters than the
 * square root of the primitives are out of the question, unless there are but a few fragments in
 * all: a tree over more clusters than there are primitives in each does what octrees do better.
 * Doubling finds the distances at which the class falls apart, to a factor of two. Each gap is one
 * pass, linear in the clusters of the one before; there are at most CELLS_OCTAVES of them, and
 * after the first few hardly anything is left to look at.
 *
 * The predicted cost of a partition is that of its clusters (accel_parts_cost) and of the tree over
 * them: a ray that meets the box around all visits about log2 of their number in nodes.
 */
#include "cluster_parts.h"
#include "cluster_touching.h"
#include "../core/order.h"

enum {
    FEWEST = 8,  /* primitives of a fragment, on average, where there are many */
    LEAST = 4096 /* primitives that are many */
};

struct gatherer {
    struct parts *parts;
    struct ids fragments;                  /* of one class: root parts */
    uint64_t primitives;                   /* in them */
    size_t roots, all;                     /* root parts of every class, and their primitives */
    accel_box box;                         /* around them */
    ARRAY_OF(struct cluster) now;          /* the clusters so far, boxes in units of the frame */
    ARRAY_OF(struct cluster) next;         /* those being made */
    ARRAY_OF(uint32_t) order;              /* the clusters so far by octave of size, coarse first */
    uint32_t octave_at[CELLS_OCTAVES + 1]; /* where each octave begins in `order` */
    ARRAY_OF(uint32_t) group;              /* by cluster so far */
    ARRAY_OF(uint32_t) number;             /* by root group: the new cluster */
    ARRAY_OF(uint32_t) cluster_of, best;   /* by fragment: its cluster now, in the best partition */
    double best_cost;                      /* INFINITY: no partition was legal yet */
};

static struct memory *memory_of(const struct gatherer *g)
{
    return &g->parts->build->a->memory;
}

/* ------------------------------------------------------------------- the fragments ---- */

static void take(struct gatherer *g, uint32_t part)
{
    const struct cluster *fragment = &g->parts->part.at[part];
    const uint32_t i = (uint32_t)g->fragments.count++;
    g->fragments.at[i] = part;
    g->now.at[i] = *fragment;
    g->now.at[i].box = frame_box(&g->parts->sizes.frame, &fragment->box);
    g->cluster_of.at[i] = i;
    g->primitives += fragment->count;
    box_add(&g->box, &g->now.at[i].box);
}

static bool collect(struct gatherer *g, uint32_t class, bool all)
{
    const struct parts *p = g->parts;
    struct memory *m = memory_of(g);
    if (!array_reserve(m, &g->fragments, p->part.count) ||
        !array_reserve(m, &g->now, p->part.count) ||
        !array_reserve(m, &g->cluster_of, p->part.count))
        return accel_build_no_memory(p->build);
    g->box = box_empty();
    g->best_cost = (double)INFINITY;
    for (size_t i = 0; i < p->part.count; i++) {
        const struct cluster *part = &p->part.at[i];
        if (part->first != i)
            continue;
        g->roots++;
        g->all += part->count;
        if (part->size_class == class && (all || part->count < p->fragment))
            take(g, (uint32_t)i);
    }
    g->now.count = g->cluster_of.count = g->fragments.count;
    return true;
}

/* The mean size of a fragment. */
static double mean_size(const struct gatherer *g)
{
    double sum = 0.0;
    for (size_t i = 0; i < g->now.count; i++)
        sum += box_longest(&g->now.at[i].box);
    return fmax(sum / (double)g->now.count, ldexp(1.0, -CELLS_OCTAVES));
}

/* ----------------------------------------------------------------------- a pass ---- */

/* The octave of the cells for a box and a gap: the box is no larger than one, the gap than a
 * quarter. Boxes of a few sizes share a grid, as each is compared with all coarser grids. */
static uint32_t cells_for(const accel_box *unit, double gap)
{
    const double longest = box_longest(unit), size = longest > 4.0 * gap ? longest : 4.0 * gap;
    return size < 0.5 ? octave_of(size) / SIZES_PER_GRID * SIZES_PER_GRID : 0;
}

/* Counting sort of the clusters by octave. */
static bool sort(struct gatherer *g, double gap)
{
    uint32_t next[CELLS_OCTAVES] = {0}, sum = 0;
    g->order.count = g->group.count = 0;
    if (!array_extend(memory_of(g), &g->order, g->now.count) ||
        !array_extend(memory_of(g), &g->group, g->now.count))
        return accel_build_no_memory(g->parts->build);
    for (size_t i = 0; i < g->now.count; i++)
        next[cells_for(&g->now.at[i].box, gap)]++;
    for (uint32_t o = 0; o < CELLS_OCTAVES; o++) {
        const uint32_t here = next[o];
        g->octave_at[o] = next[o] = sum;
        sum += here;
    }
    g->octave_at[CELLS_OCTAVES] = sum;
    for (size_t i = 0; i < g->now.count; i++)
        g->order.at[next[cells_for(&g->now.at[i].box, gap)]++] = (uint32_t)i;
    return true;
}

static struct touch_rule rule_for(uint32_t octave, double gap)
{
    return (struct touch_rule){0, octave, 0.5 * gap * (double)(1u << octave)};
}

/* Finds the group of a cluster among those that are as large or larger. */
static bool enter(struct gatherer *g, struct touching *t, uint32_t cluster, uint32_t octave,
                  double gap)
{
    const accel_box *unit = &g->now.at[cluster].box;
    const uint32_t group = accel_touching_enter(memory_of(g), t, unit, rule_for(octave, gap));
    if (group == ACCEL_NONE)
        return accel_build_no_memory(g->parts->build);
    g->group.at[cluster] = group;
    for (uint32_t o = 0; o < octave; o++)
        if (g->octave_at[o] < g->octave_at[o + 1])
            accel_touching_join(t, unit, rule_for(o, gap), group);
    return true;
}

static bool connect(struct gatherer *g, struct touching *t, double gap)
{
    for (uint32_t o = 0; o < CELLS_OCTAVES; o++)
        for (uint32_t i = g->octave_at[o]; i < g->octave_at[o + 1]; i++)
            if (!enter(g, t, g->order.at[i], o, gap) || !parts_tick(g->parts, i))
                return false;
    return true;
}

/* Takes over the grouping: group.at[i] is a number below `groups` for each cluster so far. New
 * clusters are in the order of their first ones. */
static bool regroup(struct gatherer *g, size_t groups)
{
    g->number.count = g->next.count = 0;
    if (!array_extend(memory_of(g), &g->number, groups) ||
        !array_reserve(memory_of(g), &g->next, g->now.count))
        return accel_build_no_memory(g->parts->build);
    memset(g->number.at, 0xff, groups * sizeof *g->number.at);
    for (size_t i = 0; i < g->now.count; i++) {
        uint32_t *number = &g->number.at[g->group.at[i]];
        if (*number == ACCEL_NONE) {
            *number = (uint32_t)g->next.count++;
            g->next.at[*number] = (struct cluster){.box = box_empty()};
        }
        g->group.at[i] = *number;
        box_add(&g->next.at[*number].box, &g->now.at[i].box);
        g->next.at[*number].count += g->now.at[i].count;
    }
    for (size_t i = 0; i < g->fragments.count; i++)
        g->cluster_of.at[i] = g->group.at[g->cluster_of.at[i]];
    for (size_t i = 0; i < g->next.count; i++)
        g->now.at[i] = g->next.at[i];
    g->now.count = g->next.count;
    return true;
}

/* Joins the clusters so far over a gap. */
static bool join_over(struct gatherer *g, double gap)
{
    struct touching t = {0};
    const bool capacity = accel_touching_reserve(memory_of(g), &t, g->now.count);
    bool fine =
        capacity ? sort(g, gap) && connect(g, &t, gap) : accel_build_no_memory(g->parts->build);
    for (size_t i = 0; fine && i < g->now.count; i++)
        g->group.at[i] = accel_touching_root(&t, g->group.at[i]);
    fine = fine && regroup(g, t.groups.count);
    g->parts->visits += t.visits;
    accel_touching_free(memory_of(g), &t);
    return fine;
}

/* Joins the clusters so far whose middles are in one cell of an octave. */
static bool join_in_cells(struct gatherer *g, struct cells *cells, uint32_t octave)
{
    uint32_t groups = 0;
    g->group.count = 0;
    if (!array_extend(memory_of(g), &g->group, g->now.count))
        return accel_build_no_memory(g->parts->build);
    g->parts->visits += g->now.count;
    for (size_t i = 0; i < g->now.count; i++) {
        const uint64_t key = accel_order_morton(&g->now.at[i].box) >> 3 * (CELLS_OCTAVES - octave);
        struct cell_slot *slot = accel_cells_at(memory_of(g), cells, key);
        if (!slot)
            return accel_build_no_memory(g->parts->build);
        if (slot->value == ACCEL_NONE)
            slot->value = groups++;
        g->group.at[i] = slot->value;
    }
    return regroup(g, groups);
}

/* Where there are more fragments than one for each FEWEST primitives, as where most primitives are
 * in one place and the rest is scattered, joins some at once: to join them gap by gap would take
 * longer, for partitions that are out of the question. The first cells are those that they would
 * fill evenly. */
static bool coarsen(struct gatherer *g)
{
    uint32_t o = 1 + (uint32_t)(log2((double)g->now.count) / 3.0);
    for (; o > 0 && g->now.count > g->primitives / FEWEST; o--) {
        struct cells cells = {0};
        const bool fine = join_in_cells(g, &cells, o);
        accel_cells_free(memory_of(g), &cells);
        if (!fine)
            return false;
    }
    return true;
}

/* ----------------------------------------------------------- the best partition ---- */

static double cost(const struct gatherer *g)
{
    double sum = box_area(&g->box) * log2((double)g->now.count);
    for (size_t i = 0; i < g->now.count; i++)
        sum += accel_parts_unit_cost(g->parts, &g->now.at[i].box, g->now.at[i].count);
    return sum;
}

static void keep(struct gatherer *g)
{
    memcpy(g->best.at, g->cluster_of.at, g->fragments.count * sizeof *g->best.at);
}

/* Keeps the partition if it is legal, and cheaper than the best so far. */
static void assess(struct gatherer *g)
{
    const double allowed = fmax(PARTS_FRAGMENT, sqrt((double)g->primitives));
    if ((double)g->now.count > allowed)
        return;
    const double now = cost(g);
    if (now >= g->best_cost)
        return;
    g->best_cost = now;
    keep(g);
}

static bool sweep(struct gatherer *g, double gap)
{
    if (g->primitives > LEAST && !coarsen(g))
        return false;
    for (; g->now.count > 1 && gap < 1.0; gap *= 2.0) {
        if (!join_over(g, gap))
            return false;
        assess(g);
    }
    return true;
}

static bool apply(struct gatherer *g)
{
    struct parts *p = g->parts;
    g->number.count = 0;
    if (!array_extend(memory_of(g), &g->number, g->fragments.count))
        return accel_build_no_memory(p->build);
    memset(g->number.at, 0xff, g->fragments.count * sizeof *g->number.at);
    for (size_t i = 0; i < g->fragments.count; i++) {
        uint32_t *root = &g->number.at[g->best.at[i]];
        *root = *root == ACCEL_NONE ? g->fragments.at[i]
                                    : accel_parts_join(p, *root, g->fragments.at[i]);
    }
    return true;
}

/* Are there so many parts that small ones must be gathered? */
static bool too_many(const struct gatherer *g)
{
    return g->fragments.count > 1 &&
           (g->parts->fragment > PARTS_FRAGMENT || g->roots > g->all / PARTS_FRAGMENT);
}

/* Finds the best partition over gaps, or the one of what touches, and applies it. */
static bool gather(struct gatherer *g, double gap, bool touching)
{
    if (!array_extend(memory_of(g), &g->best, g->fragments.count))
        return accel_build_no_memory(g->parts->build);
    if (touching) {
        if (!join_over(g, 0.0))
            return false;
        keep(g);
        g->best_cost = 0.0;
    } else if (!too_many(g)) {
        return true;
    } else if (!sweep(g, gap > 0.0 ? gap : mean_size(g))) {
        return false;
    }
    return isinf(g->best_cost) || apply(g);
}

static bool gather_class(struct parts *p, uint32_t class, double gap, bool touching)
{
    struct gatherer g = {.parts = p};
    struct memory *m = memory_of(&g);
    const bool fine =
        collect(&g, class, touching) && (g.fragments.count < 2 || gather(&g, gap, touching));
    array_free(m, &g.fragments);
    array_free(m, &g.now);
    array_free(m, &g.next);
    array_free(m, &g.order);
    array_free(m, &g.group);
    array_free(m, &g.number);
    array_free(m, &g.cluster_of);
    array_free(m, &g.best);
    return fine;
}

bool accel_parts_join_touching(struct parts *p)
{
    for (uint32_t c = 0; c < p->sizes.classes; c++)
        if (!gather_class(p, c, 0.0, true))
            return false;
    return true;
}

bool accel_parts_join_fragments(struct parts *p, const struct parts_sample *sample)
{
    for (uint32_t c = 0; c < p->sizes.classes; c++)
        if (!gather_class(p, c, sample ? ldexp(0.5, -(int)sample->octave[c]) : 0.0, false))
            return false;
    return true;
}
