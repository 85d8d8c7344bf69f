/* SPDX-License-Identifier: Apache-2.0
 *
 * Finding the clusters of a scene in expected linear time: filter by size, cluster what is near.
 *
 * The idea is that of Cazals, Drettakis and Puech (see cluster.h). Their exact rules are not
 * public; these are ours, each with its reason:
 * - Size: the longest side of the padded box, in octaves (factors of two). What is smaller than
 *   2^-18 of the scene counts as that large: no ray tells it apart.
 * - Filter: a new size class begins where an octave is empty. A fixed number of classes would cut
 *   meshes, whose triangles vary without gaps, into interleaved pieces. `octaves` limits the span.
 * - Near: boxes that touch are connected (connectivity 0.0, as Havran's published setting for hug
 *   has it) if their sizes are within a factor of about 16: a teapot does not melt into a hall
 * whose floor it stands on. Found by hash grids and union-find (touching.h): one grid for each two
 *   octaves of size, each box entered into its own and compared with the next coarser one.
 *   A given connectivity c > 0 joins gaps up to c times the largest size of the class.
 * - Too fine: if there are more components than one for each PARTS_CRUMB primitives, the small ones
 *   are gathered by distance (crumbs.c).
 * - Overlap: parts in each other's boxes are joined where one octree is cheaper (nested.c).
 * With a given connectivity neither of the last two is done: the user gets what he asked for.
 */
#include "cluster.h"

#include "order.h"
#include "parts.h"
#include "touching.h"

/* Octaves of size that share one grid. */
enum { OCTAVES_PER_GRID = 2 };

struct clusterer {
    struct build *build;
    struct clustering *c; /* what is made */
    struct cluster_rule rule;
    double from, to;                  /* progress range */
    const struct ids *bounded;        /* positions in it stand for primitives here */
    struct frame frame;               /* of the scene */
    uint8_t *octave;                  /* of size, by position */
    struct ids by_size;               /* positions, from large to small octaves */
    size_t begin[CELLS_OCTAVES + 1];  /* of each octave in by_size */
    double largest[CELLS_OCTAVES];    /* size in each octave; later in its class */
    uint32_t class_of[CELLS_OCTAVES]; /* by octave */
    uint32_t grid_of[CELLS_OCTAVES];  /* octave of the cells, by octave of size */
    struct touching touching;
    uint32_t *home; /* by position: one of its groups, then its component, then its cluster */
    struct parts parts;
};

static bool tick(const struct clusterer *k, size_t i, double from, double to)
{
    return i % 4096 != 0 ||
           build_tick(k->build,
                      k->from + (k->to - k->from) *
                                    (from + (to - from) * (double)i / (double)k->bounded->count));
}

static const accel_box *box_at(const struct clusterer *k, size_t position)
{
    return &k->build->a->prims.box[k->bounded->at[position]];
}

static bool find_frame(struct clusterer *k)
{
    accel_box scene = box_empty();
    for (size_t i = 0; i < k->bounded->count; i++) {
        box_add(&scene, box_at(k, i));
        if (!tick(k, i, 0.0, 0.05))
            return false;
    }
    k->frame = frame_of(&scene);
    return true;
}

/* ------------------------------------------------------------ filter by size ---- */

static bool allocate(struct clusterer *k)
{
    struct memory *m = &k->build->a->memory;
    const size_t n = k->bounded->count;
    return ((k->octave = memory_resize(m, NULL, 0, n)) != NULL &&
            (k->home = memory_resize(m, NULL, 0, n * sizeof *k->home)) != NULL &&
            array_extend(m, &k->by_size, n)) ||
           build_no_memory(k->build);
}

/* The histogram of sizes: begin[o] becomes how many there are in octave o. */
static bool measure(struct clusterer *k)
{
    for (size_t i = 0; i < k->bounded->count; i++) {
        const double size = box_longest(box_at(k, i)) * k->frame.scale;
        const uint32_t octave = octave_of(size);
        k->octave[i] = (uint8_t)octave;
        k->begin[octave]++;
        k->largest[octave] = fmax(k->largest[octave], size);
        if (!tick(k, i, 0.05, 0.1))
            return false;
    }
    return true;
}

/* Cuts the occupied octaves into classes, and these into grids. */
static void make_classes(struct clusterer *k)
{
    const double most = isnan(k->rule.octaves) ? CELLS_OCTAVES : k->rule.octaves;
    uint32_t class = 0, span = 0, top = 0;
    for (uint32_t o = 0; o < CELLS_OCTAVES; o++) {
        if (k->begin[o] == 0 || span >= most) {
            class += span > 0;
            span = 0;
        }
        if (k->begin[o] == 0)
            continue;
        if (span == 0)
            top = o;
        k->class_of[o] = class;
        k->grid_of[o] = top + span / OCTAVES_PER_GRID * OCTAVES_PER_GRID;
        k->largest[o] = k->largest[top];
        span++;
    }
    k->c->size_classes = class + (span > 0);
}

/* Counting sort of the positions by octave. */
static void sort_by_size(struct clusterer *k)
{
    size_t next[CELLS_OCTAVES], sum = 0;
    for (uint32_t o = 0; o < CELLS_OCTAVES; o++) {
        const size_t here = k->begin[o];
        k->begin[o] = next[o] = sum;
        sum += here;
    }
    k->begin[CELLS_OCTAVES] = sum;
    for (size_t i = 0; i < k->bounded->count; i++)
        k->by_size.at[next[k->octave[i]]++] = (uint32_t)i;
}

/* --------------------------------------------------------- cluster what is near ---- */

/* The grid for boxes of an octave: its own, or one with cells of at least twice the gap. */
static struct touch_rule rule_for(const struct clusterer *k, uint32_t octave, uint32_t grid)
{
    const double c = isnan(k->rule.connectivity) ? 0.0 : k->rule.connectivity;
    const double gap = c * k->largest[octave];
    const uint32_t widest = octave_of(fmin(2.0 * gap, 0.5));
    const uint32_t used = grid < widest ? grid : widest;
    return (struct touch_rule){k->class_of[octave], used, 0.5 * gap * (double)(1u << used)};
}

/* The next coarser grid of the class. False if there is none. */
static bool coarser(const struct clusterer *k, uint32_t octave, struct touch_rule *rule)
{
    const uint32_t grid = k->grid_of[octave];
    if (grid < OCTAVES_PER_GRID || k->begin[grid - 1] == k->begin[grid] ||
        k->class_of[grid - 1] != k->class_of[octave])
        return false;
    *rule = rule_for(k, octave, k->grid_of[grid - 1]);
    return true;
}

/* Enters the boxes of an octave. */
static bool connect_octave(struct clusterer *k, uint32_t octave)
{
    struct memory *m = &k->build->a->memory;
    const struct touch_rule own = rule_for(k, octave, k->grid_of[octave]);
    struct touch_rule next;
    const bool compare = coarser(k, octave, &next) && next.octave != own.octave;
    for (size_t i = k->begin[octave]; i < k->begin[octave + 1]; i++) {
        const uint32_t position = k->by_size.at[i];
        const accel_box unit = frame_box(&k->frame, box_at(k, position));
        const uint32_t group = touching_enter(m, &k->touching, &unit, own);
        if (group == ACCEL_NONE)
            return build_no_memory(k->build);
        if (compare)
            touching_join(&k->touching, &unit, next, group);
        k->home[position] = group;
        if (!tick(k, i, 0.1, 0.7))
            return false;
    }
    return true;
}

static bool connect(struct clusterer *k)
{
    for (uint32_t o = 0; o < CELLS_OCTAVES; o++)
        if (!connect_octave(k, o))
            return false;
    return true;
}

static bool new_part(struct clusterer *k, uint32_t class)
{
    struct parts *p = &k->parts;
    if (!array_extend(&k->build->a->memory, &p->part, 1))
        return build_no_memory(k->build);
    const uint32_t number = (uint32_t)p->part.count - 1;
    p->part.at[number] = (struct cluster){box_empty(), number, 0, class};
    return true;
}

/* Makes a part of each component; number[] is by root group. The first primitive's class stands
 * for all: components never mix classes. */
static bool number_parts(struct clusterer *k, uint32_t *number)
{
    memset(number, 0xff, k->touching.groups.count * sizeof *number);
    for (size_t i = 0; i < k->bounded->count; i++) {
        const uint32_t root = touching_root(&k->touching, k->home[i]);
        if (number[root] == ACCEL_NONE) {
            number[root] = (uint32_t)k->parts.part.count;
            if (!new_part(k, k->class_of[k->octave[i]]))
                return false;
        }
        struct cluster *part = &k->parts.part.at[number[root]];
        box_add(&part->box, box_at(k, i));
        part->count++;
        k->home[i] = number[root];
        if (!tick(k, i, 0.7, 0.8))
            return false;
    }
    return true;
}

static bool make_parts(struct clusterer *k)
{
    struct memory *m = &k->build->a->memory;
    const size_t size = k->touching.groups.count * sizeof(uint32_t);
    uint32_t *number = memory_resize(m, NULL, 0, size);
    const bool fine = number ? number_parts(k, number) : build_no_memory(k->build);
    if (number)
        memory_resize(m, number, size, 0);
    touching_free(m, &k->touching);
    return fine;
}

static bool join_parts(struct clusterer *k)
{
    struct parts *p = &k->parts;
    p->build = k->build;
    p->frame = k->frame;
    p->now = k->from + 0.8 * (k->to - k->from);
    if (!isnan(k->rule.connectivity) || p->part.count == 1)
        return true;
    if (p->part.count > k->bounded->count / PARTS_CRUMB &&
        !parts_join_crumbs(p, k->c->size_classes))
        return false;
    return parts_join_nested(p);
}

/* ---------------------------------------------------------- number the clusters ---- */

/* The clusters in their final order. parts.part.at[i].count of a root becomes its number. */
static bool take_clusters(struct clusterer *k, struct keyed *order, size_t count)
{
    struct memory *m = &k->build->a->memory;
    struct clustering *c = k->c;
    if (!order_by_key(m, order, count) || !array_extend(m, &c->clusters, count))
        return build_no_memory(k->build);
    uint32_t first = 0;
    for (size_t i = 0; i < count; i++) {
        struct cluster *part = &k->parts.part.at[order[i].value];
        c->clusters.at[i] = *part;
        c->clusters.at[i].first = first;
        first += part->count;
        part->count = (uint32_t)i;
    }
    return true;
}

static bool order_clusters(struct clusterer *k)
{
    struct memory *m = &k->build->a->memory;
    ARRAY_OF(struct keyed) order = {0};
    bool fine = true;
    for (size_t i = 0; fine && i < k->parts.part.count; i++) {
        const struct cluster *part = &k->parts.part.at[i];
        if (part->first != i)
            continue;
        if (!(fine = array_extend(m, &order, 1) || build_no_memory(k->build)))
            break;
        const accel_box unit = frame_box(&k->frame, &part->box);
        order.at[order.count - 1] =
            (struct keyed){(uint64_t)part->size_class << 57 | order_morton(&unit), (uint32_t)i};
    }
    fine = fine && take_clusters(k, order.at, order.count);
    array_free(m, &order);
    return fine;
}

/* Counting sort of the ids by cluster. */
static bool order_ids(struct clusterer *k)
{
    struct clustering *c = k->c;
    if (!array_extend(&k->build->a->memory, &c->order, k->bounded->count))
        return build_no_memory(k->build);
    for (size_t i = 0; i < k->bounded->count; i++) {
        const uint32_t root = parts_root(&k->parts, k->home[i]);
        struct cluster *cluster = &c->clusters.at[k->parts.part.at[root].count];
        c->order.at[cluster->first++] = k->bounded->at[i];
    }
    for (size_t i = 0; i < c->clusters.count; i++)
        c->clusters.at[i].first -= c->clusters.at[i].count;
    return true;
}

static void release(struct clusterer *k)
{
    struct memory *m = &k->build->a->memory;
    const size_t n = k->bounded->count;
    if (k->octave)
        memory_resize(m, k->octave, n, 0);
    if (k->home)
        memory_resize(m, k->home, n * sizeof *k->home, 0);
    array_free(m, &k->by_size);
    array_free(m, &k->parts.part);
    touching_free(m, &k->touching);
}

bool cluster_scene(struct build *build, struct clustering *c, struct cluster_rule rule, double from,
                   double to)
{
    struct clusterer k = {.build = build,
                          .c = c,
                          .rule = rule,
                          .from = from,
                          .to = to,
                          .bounded = &build->a->prims.bounded};
    bool fine = find_frame(&k) && allocate(&k) && measure(&k);
    if (fine) {
        make_classes(&k);
        sort_by_size(&k);
        fine =
            connect(&k) && make_parts(&k) && join_parts(&k) && order_clusters(&k) && order_ids(&k);
    }
    release(&k);
    build->a->info.size_classes = c->size_classes;
    build->a->info.clusters = (uint32_t)c->clusters.count;
    return fine;
}

void cluster_free(struct memory *m, struct clustering *c)
{
    array_free(m, &c->order);
    array_free(m, &c->clusters);
}
