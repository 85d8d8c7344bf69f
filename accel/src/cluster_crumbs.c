/* SPDX-License-Identifier: Apache-2.0
 *
 * Gathering crumbs: parts of so few primitives that an octree would not pay, such as loose cubes,
 * leaves of a tree, a cloud of spheres.
 *
 * The crumbs of a size class are joined where the gap between them is at most d, for d = about the
 * size of the largest, twice that, and so on; of these partitions the one with the lowest predicted
 * cost is taken. Those with more clusters than one for each PARTS_CRUMB primitives are out of the
 * question, unless there are but a few crumbs in all. Doubling finds the distances at which the
 * class falls apart, to a factor of two; each gap is one linear pass, at most CELLS_OCTAVES of them
 * and rarely more than three.
 *
 * The predicted cost of a partition is that of its clusters (parts_cost) and of the tree over
 * them: a ray that meets the box around all visits about log2 of their number in nodes.
 */
#include "cluster_parts.h"
#include "cluster_touching.h"

/* Half the gap, in cells: the gap is a quarter of a cell. */
#define REACH 0.125

/* A partition of a class's crumbs. */
struct partition {
    uint32_t *cluster_of; /* by crumb */
    size_t clusters;
    double cost;
};

struct gatherer {
    struct parts *parts;
    struct ids crumbs;            /* of one class: root parts */
    uint64_t primitives;          /* in them */
    accel_box box;                /* around them */
    uint32_t octave;              /* of the cells: a quarter of one is the gap */
    ARRAY_OF(struct cluster) sum; /* the clusters of `now` */
    struct partition now, best;   /* for this gap; of lowest cost so far */
};

static struct memory *memory_of(const struct gatherer *g)
{
    return &g->parts->build->a->memory;
}

/* Finds the crumbs of a class and where to begin. */
static bool collect(struct gatherer *g, uint32_t class)
{
    struct parts *p = g->parts;
    double largest = 0.0;
    g->box = box_empty();
    for (size_t i = 0; i < p->part.count; i++) {
        const struct cluster *part = &p->part.at[i];
        if (part->first != i || part->size_class != class || part->count >= p->crumb)
            continue;
        if (!array_extend(memory_of(g), &g->crumbs, 1))
            return build_no_memory(p->build);
        g->crumbs.at[g->crumbs.count - 1] = (uint32_t)i;
        g->primitives += part->count;
        box_add(&g->box, &part->box);
        const accel_box unit = frame_box(&p->sizes.frame, &part->box);
        largest = fmax(largest, box_longest(&unit));
    }
    g->octave = octave_of(fmin(4.0 * largest, 0.5));
    return true;
}

static uint32_t *new_numbers(struct gatherer *g, size_t count)
{
    uint32_t *at = memory_resize(memory_of(g), NULL, 0, count * sizeof *at);
    if (!at)
        build_no_memory(g->parts->build);
    return at;
}

static void free_numbers(struct gatherer *g, uint32_t *at, size_t count)
{
    if (at)
        memory_resize(memory_of(g), at, count * sizeof *at, 0);
}

/* Every crumb's group goes into now.cluster_of. */
static bool enter(struct gatherer *g, struct touching *t)
{
    const struct parts *p = g->parts;
    const struct touch_rule rule = {.octave = g->octave, .reach = REACH};
    for (size_t i = 0; i < g->crumbs.count; i++) {
        const accel_box unit = frame_box(&p->sizes.frame, &p->part.at[g->crumbs.at[i]].box);
        g->now.cluster_of[i] = touching_enter(memory_of(g), t, &unit, rule);
        if (g->now.cluster_of[i] == ACCEL_NONE)
            return build_no_memory(p->build);
        if (!parts_tick(p, i))
            return false;
    }
    return true;
}

/* Replaces groups by clusters and sums these up; number[] is by root group. */
static bool sum_up(struct gatherer *g, struct touching *t, uint32_t *number)
{
    g->sum.count = 0;
    memset(number, 0xff, t->groups.count * sizeof *number);
    for (size_t i = 0; i < g->crumbs.count; i++) {
        const struct cluster *crumb = &g->parts->part.at[g->crumbs.at[i]];
        const uint32_t root = touching_root(t, g->now.cluster_of[i]);
        if (number[root] == ACCEL_NONE) {
            number[root] = (uint32_t)g->sum.count;
            if (!array_extend(memory_of(g), &g->sum, 1))
                return build_no_memory(g->parts->build);
            g->sum.at[number[root]] = (struct cluster){.box = box_empty()};
        }
        g->now.cluster_of[i] = number[root];
        box_add(&g->sum.at[number[root]].box, &crumb->box);
        g->sum.at[number[root]].count += crumb->count;
    }
    return true;
}

static double cost(const struct gatherer *g)
{
    const accel_box all = frame_box(&g->parts->sizes.frame, &g->box);
    double sum = box_area(&all) * log2((double)g->sum.count);
    for (size_t i = 0; i < g->sum.count; i++)
        sum += parts_cost(g->parts, &g->sum.at[i].box, g->sum.at[i].count);
    return sum;
}

/* Makes the partition for the gap of this octave. */
static bool partition(struct gatherer *g)
{
    struct touching t = {0};
    uint32_t *number = NULL;
    const bool fine =
        enter(g, &t) && (number = new_numbers(g, t.groups.count)) != NULL && sum_up(g, &t, number);
    free_numbers(g, number, t.groups.count);
    touching_free(memory_of(g), &t);
    g->now.clusters = g->sum.count;
    g->now.cost = fine ? cost(g) : 0.0;
    return fine;
}

/* Is the partition legal, and cheaper than the best so far? */
static bool is_better(const struct gatherer *g)
{
    const double allowed = fmax(PARTS_CRUMB, (double)g->primitives / PARTS_CRUMB);
    return (double)g->now.clusters <= allowed &&
           (g->best.clusters == 0 || g->now.cost < g->best.cost);
}

/* Finds the best partition. */
static bool sweep(struct gatherer *g)
{
    for (;; g->octave--) {
        if (!partition(g))
            return false;
        if (is_better(g)) {
            const struct partition best = g->now;
            g->now = g->best;
            g->best = best;
        }
        if (g->octave == 0 || g->sum.count == 1)
            return true;
    }
}

static void apply(struct gatherer *g)
{
    struct parts *p = g->parts;
    uint32_t *first = g->now.cluster_of;
    memset(first, 0xff, g->crumbs.count * sizeof *first);
    for (size_t i = 0; i < g->crumbs.count; i++) {
        uint32_t *root = &first[g->best.cluster_of[i]];
        *root = *root == ACCEL_NONE ? g->crumbs.at[i] : parts_join(p, *root, g->crumbs.at[i]);
    }
}

static bool gather_class(struct parts *p, uint32_t class)
{
    struct gatherer g = {.parts = p};
    bool fine = collect(&g, class);
    const size_t n = g.crumbs.count;
    if (fine && n > 1) {
        fine = (g.now.cluster_of = new_numbers(&g, n)) != NULL &&
               (g.best.cluster_of = new_numbers(&g, n)) != NULL && sweep(&g);
        if (fine && g.best.clusters > 0)
            apply(&g);
        free_numbers(&g, g.now.cluster_of, n);
        free_numbers(&g, g.best.cluster_of, n);
    }
    array_free(memory_of(&g), &g.sum);
    array_free(memory_of(&g), &g.crumbs);
    return fine;
}

bool parts_join_crumbs(struct parts *p)
{
    for (uint32_t c = 0; c < p->sizes.classes; c++)
        if (!gather_class(p, c))
            return false;
    return true;
}
