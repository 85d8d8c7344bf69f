/* SPDX-License-Identifier: Apache-2.0
 *
 * Finding the clusters of a scene in expected linear time: filter by size, cluster what is near.
 *
 * The idea is that of Cazals, Drettakis and Puech (see cluster.h). Their exact rules are not
 * public; these are ours, each with its reason:
 * - Filter (cluster_sizes.c): a new size class begins where an octave of size is empty. A fixed
 * number of classes would cut meshes, whose triangles vary without gaps, into interleaved pieces.
 * `octaves` limits the span. What is smaller than 2^-18 of the scene counts as that large.
 * - Near (cluster_near.c): boxes that touch are connected (connectivity 0.0, Havran's published
 * setting for hug). A given connectivity c > 0 connects over gaps up to c times the largest size of
 * the class.
 * - Too many (cluster_crumbs.c): if there are more parts than one for each PARTS_CRUMB primitives,
 * the small ones are gathered by distance.
 * - Overlap (cluster_nested.c): parts in each other's boxes are joined where one octree is cheaper.
 * With a given connectivity neither of the last two is done: the user gets what he asked for.
 */
#include "cluster.h"

#include "order.h"
#include "cluster_parts.h"

static bool make_parts(struct parts *p, struct cluster_rule rule)
{
    if (!sizes_measure(p->build, &p->sizes, rule.octaves) || !parts_connect(p, rule.connectivity))
        return false;
    if (!isnan(rule.connectivity) || p->part.count == 1)
        return true;
    if ((p->crumb > PARTS_CRUMB ||
         p->part.count > p->build->a->prims.bounded.count / PARTS_CRUMB) &&
        !parts_join_crumbs(p))
        return false;
    return parts_join_nested(p);
}

/* ---------------------------------------------------------- number the clusters ---- */

/* The clusters in their final order. A root part's count becomes its cluster's number. */
static bool take_clusters(struct parts *p, struct clustering *c, struct keyed *order, size_t count)
{
    struct memory *m = &p->build->a->memory;
    if (!order_by_key(m, order, count) || !array_extend(m, &c->clusters, count))
        return build_no_memory(p->build);
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
        fine = array_extend(m, &order, 1) || build_no_memory(p->build);
        if (!fine)
            break;
        const accel_box unit = frame_box(&p->sizes.frame, &part->box);
        order.at[order.count - 1] =
            (struct keyed){(uint64_t)part->size_class << 57 | order_morton(&unit), i};
    }
    fine = fine && take_clusters(p, c, order.at, order.count);
    array_free(m, &order);
    return fine;
}

/* Counting sort of the ids by cluster. */
static bool order_ids(struct parts *p, struct clustering *c)
{
    const struct ids *bounded = &p->build->a->prims.bounded;
    if (!array_extend(&p->build->a->memory, &c->order, bounded->count))
        return build_no_memory(p->build);
    for (size_t i = 0; i < p->units.count; i++) {
        struct unit *u = &p->units.at[i];
        u->home = p->part.at[parts_root(p, u->home)].count;
    }
    for (size_t i = 0; i < bounded->count; i++) {
        struct cluster *cluster = &c->clusters.at[p->units.at[p->unit_of.at[i]].home];
        c->order.at[cluster->first++] = bounded->at[i];
    }
    for (size_t i = 0; i < c->clusters.count; i++)
        c->clusters.at[i].first -= c->clusters.at[i].count;
    return true;
}

bool cluster_scene(struct build *build, struct clustering *c, struct cluster_rule rule, double from,
                   double to)
{
    struct memory *m = &build->a->memory;
    struct parts p = {.build = build, .now = 0.5 * (from + to)};
    const bool fine = make_parts(&p, rule) && order_clusters(&p, c) && order_ids(&p, c);
    array_free(m, &p.units);
    array_free(m, &p.unit_of);
    array_free(m, &p.part);
    c->size_classes = p.sizes.classes;
    build->a->info.size_classes = c->size_classes;
    build->a->info.clusters = (uint32_t)c->clusters.count;
    return fine;
}

void cluster_free(struct memory *m, struct clustering *c)
{
    array_free(m, &c->order);
    array_free(m, &c->clusters);
}
