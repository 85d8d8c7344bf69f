/* SPDX-License-Identifier: Apache-2.0
 *
 * Finding the clusters of a scene in expected linear time: filter by size, cluster what is near.
 *
 * The idea is that of Cazals, Drettakis and Puech (see cluster.h). Their exact rules are not
 * public; these are ours, each with its reason:
 * - Filter (cluster_sizes.c): a new size class begins where an octave of size is empty. A fixed
 *   number of classes would cut meshes, whose triangles vary without gaps, into interleaved pieces.
 *   `octaves` limits the span. What is smaller than 2^-18 of the scene counts as that large.
 * - Bins (cluster_sample.c, cluster_bins.c): a sample tells how fine a grid has to be; what lies
 *   together in one of its cells is a part, split where planes go between. All that follows handles
 *   parts, of which there are but one for some dozens of primitives.
 * - Near (cluster_fragments.c): parts whose boxes touch are joined. Where primitives are loose, or
 * what touches is small, they are joined by distance, as far as the predicted cost falls.
 * - Overlap (cluster_nested.c): parts in each other's boxes are joined where one octree is cheaper.
 * With a given connectivity c (cluster_units.c, cluster_near.c), primitives are connected over gaps
 * up to c times the largest size of their class, and nothing else is done: the user gets what he
 * asked for. Havran's published setting for hug is 0.
 */
#include "cluster.h"

#include "../core/order.h"
#include "cluster_parts.h"

/* The parts that touch, or that are within the gap that the user wants. */
static bool make_given(struct parts *p, double connectivity)
{
    return accel_parts_make_units(p) && accel_parts_connect(p, connectivity);
}

static bool make_auto(struct parts *p)
{
    struct parts_sample sample;
    p->fragment = PARTS_FRAGMENT;
    if (!accel_parts_sample(p, &sample) || !accel_parts_bin(p, &sample))
        return false;
    if (sample.loose)
        p->fragment = ACCEL_NONE;
    else if (p->part.count > 1 && !accel_parts_join_touching(p))
        return false;
    return accel_parts_join_fragments(p, sample.loose ? &sample : NULL) &&
           accel_parts_join_nested(p);
}

static bool make_parts(struct parts *p, struct cluster_rule rule)
{
    p->sizes = accel_sizes_of(&p->build->a->prims, rule.octaves);
    return isnan(rule.connectivity) ? make_auto(p) : make_given(p, rule.connectivity);
}

/* ---------------------------------------------------------- number the clusters ---- */

/* The clusters in their final order. A root part's count becomes its cluster's number. */
static bool take_clusters(struct parts *p, struct clustering *c, struct keyed *order, size_t count)
{
    struct memory *m = &p->build->a->memory;
    if (!accel_order_by_key(m, order, count) || !array_extend(m, &c->clusters, count))
        return accel_build_no_memory(p->build);
    uint32_t first = 0;
    for (size_t i = 0; i < count; i++) {
        struct cluster *part = &p->part.at[order[i].value];
        c->clusters.at[i] = *part;
        c->clusters.at[i].first = first;
        first += part->count;
        part->count = (uint32_t)i;
    }
    return true;
}

static bool order_clusters(struct parts *p, struct clustering *c)
{
    struct memory *m = &p->build->a->memory;
    ARRAY_OF(struct keyed) order = {0};
    bool fine = true;
    for (uint32_t i = 0; fine && i < p->part.count; i++) {
        const struct cluster *part = &p->part.at[i];
        if (part->first != i)
            continue;
        fine = array_extend(m, &order, 1) || accel_build_no_memory(p->build);
        if (!fine)
            break;
        const accel_box unit = frame_box(&p->sizes.frame, &part->box);
        order.at[order.count - 1] =
            (struct keyed){(uint64_t)part->size_class << 57 | accel_order_morton(&unit), i};
    }
    fine = fine && take_clusters(p, c, order.at, order.count);
    array_free(m, &order);
    return fine;
}

/* The cluster of each piece: a unit with a given connectivity, else a part. */
static bool find_owners(struct parts *p, struct ids *owner)
{
    const size_t pieces = p->units.count > 0 ? p->units.count : p->part.count;
    if (!array_extend(&p->build->a->memory, owner, pieces))
        return accel_build_no_memory(p->build);
    for (size_t i = 0; i < pieces; i++) {
        const uint32_t part = p->units.count > 0 ? p->units.at[i].owner : (uint32_t)i;
        owner->at[i] = p->part.at[accel_parts_root(p, part)].count;
    }
    return true;
}

/* Counting sort of the ids by cluster. */
static void sort_ids(const struct parts *p, struct clustering *c, const struct ids *owner)
{
    const struct ids *bounded = &p->build->a->prims.bounded;
    for (size_t i = 0; i < bounded->count; i++) {
        struct cluster *cluster = &c->clusters.at[owner->at[p->piece_of.at[i]]];
        c->order.at[cluster->first++] = bounded->at[i];
    }
    for (size_t i = 0; i < c->clusters.count; i++)
        c->clusters.at[i].first -= c->clusters.at[i].count;
}

static bool order_ids(struct parts *p, struct clustering *c)
{
    const struct ids *bounded = &p->build->a->prims.bounded;
    struct memory *m = &p->build->a->memory;
    struct ids owner = {0};
    if (!array_extend(m, &c->order, bounded->count))
        return accel_build_no_memory(p->build);
    if (c->clusters.count == 1) {
        memcpy(c->order.at, bounded->at, bounded->count * sizeof *bounded->at);
        return true;
    }
    const bool fine = find_owners(p, &owner);
    if (fine)
        sort_ids(p, c, &owner);
    array_free(m, &owner);
    return fine;
}

bool accel_cluster_scene(struct build *build, struct clustering *c, struct cluster_rule rule,
                         double from, double to)
{
    struct memory *m = &build->a->memory;
    struct parts p = {.build = build, .now = 0.5 * (from + to)};
    const bool fine = make_parts(&p, rule) && order_clusters(&p, c) && order_ids(&p, c);
    array_free(m, &p.units);
    array_free(m, &p.piece_of);
    array_free(m, &p.part);
    c->size_classes = p.sizes.classes;
    c->visits = p.visits;
    build->a->info.size_classes = c->size_classes;
    build->a->info.clusters = (uint32_t)c->clusters.count;
    return fine;
}

void accel_cluster_free(struct memory *m, struct clustering *c)
{
    array_free(m, &c->order);
    array_free(m, &c->clusters);
}
