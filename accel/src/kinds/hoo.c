/* SPDX-License-Identifier: Apache-2.0
 *
 * hoo: the hierarchy of octrees of Revelles, Aguilera, Aguado, Lastra, Garcia and Montes, "A
 * Spatial Representation for Ray-Scene Intersection Test Improvement in Complex Scenes": clusters
 * (cluster.h), an octree for each (octree.h), neighbours joined pairwise into a balanced binary
 * tree (hoo_pairing.h). The tree is walked nearest child first; clusters may overlap, so the walk
 * goes on until all that is left begins after the best hit.
 *
 * form=wide joins clusters and octrees into one wide tree (wide/wide.h): no node below those that
 * part the clusters holds primitives of two, and in a cluster it is cut as the wide octree. What
 * follows is the classic form, the paper's.
 *
 * A cluster of few primitives is a list: its octree's root is a leaf. Where the scene is one
 * cluster, there is no tree above, and hoo is an octree over the scene's tight box.
 *
 * With lazy=on an octree is built when the first ray enters its cluster's box, one over many
 * primitives in parts (octree_deferred.h): the same octrees, but only where rays go. Clusters and
 * the tree above are built first, as rays find the octrees through them.
 *
 * Invariant: every bounded primitive is in exactly one cluster; a cluster's box contains its padded
 * boxes, a node's boxes contain the clusters below.
 *
 * Cost: as an octree, without the empty space between clusters and without cells as small as one
 * cluster needs in all the others. Bad at: scenes that are one cluster gain nothing.
 */
#include "../core/kind.h"
#include "../cluster/cluster.h"
#include "../octree/octree_deferred.h"
#include "../hoo/hoo_pairing.h"
#include "../wide/wide_form.h"

#include <stdlib.h>
#include <string.h>

struct hoo_kind {
    accel base;
    struct clustering clustering;
    ARRAY_OF(struct octree) trees; /* by cluster */
    struct octree_pool pool;       /* of all */
    struct octree_lazy lazy;       /* how octrees are built that are built later */
    ARRAY_OF(struct octree_deferred)
    deferred;           /* by cluster; with lazy=on, instead of trees and pool */
    struct boxtree top; /* over the clusters; no nodes if there is but one */
    struct wide wide;   /* of the wide form, instead of all that */
};

enum { FORM, LEAF, DEPTH, CONNECTIVITY, OCTAVES, LAZY, PART, ISA };

static const char *const switches[] = {"off", "on", NULL};

static const accel_option options[] = {
    [FORM] = WIDE_FORM_OPTION("leaf, depth or lazy=on"),
    [LEAF] = OCTREE_LEAF_OPTION,
    [DEPTH] = OCTREE_DEPTH_OPTION,
    [CONNECTIVITY] = CLUSTER_CONNECTIVITY_OPTION,
    [OCTAVES] = CLUSTER_OCTAVES_OPTION,
    [LAZY] = {.key = "lazy",
              .meaning = "on: an octree is built when the first ray enters its cluster",
              .words = switches},
    [PART] = OCTREE_PART_OPTION,
    [ISA] = WIDE_ISA_OPTION,
};

static bool find_clusters(struct build *build, struct hoo_kind *h)
{
    const struct cluster_rule rule = {h->base.option[CONNECTIVITY], h->base.option[OCTAVES]};
    accel_build_phase(build, "clusters");
    return accel_cluster_scene(build, &h->clustering, rule, 0.0, 1.0);
}

static struct octree_rule octree_rule(const struct hoo_kind *h)
{
    return (struct octree_rule){h->base.option[LEAF], h->base.option[DEPTH]};
}

/* What is left of building octrees where rays do it. */
static bool leave_octrees(struct build *build, struct hoo_kind *h)
{
    const struct clustering *c = &h->clustering;
    if (!array_extend(&h->base.memory, &h->deferred, c->clusters.count))
        return accel_build_no_memory(build);
    for (size_t i = 0; i < c->clusters.count; i++) {
        const struct cluster *cluster = &c->clusters.at[i];
        h->deferred.at[i] = accel_octree_defer(c->order.at + cluster->first, cluster->count,
                                               &cluster->box, octree_rule(h));
    }
    h->lazy = (struct octree_lazy){
        .a = &h->base, .rule = octree_rule(h), .whole = (uint32_t)h->base.option[PART]};
    return true;
}

static bool build_octrees(struct build *build, struct hoo_kind *h)
{
    const struct clustering *c = &h->clustering;
    const struct octree_rule rule = octree_rule(h);
    accel_build_phase(build, "octrees");
    if (h->base.option[LAZY] > 0)
        return leave_octrees(build, h);
    if (!array_extend(&h->base.memory, &h->trees, c->clusters.count))
        return accel_build_no_memory(build);
    for (size_t i = 0; i < c->clusters.count; i++) {
        const struct cluster *cluster = &c->clusters.at[i];
        const double from = cluster->first / (double)c->order.count;
        const double to = (cluster->first + (double)cluster->count) / (double)c->order.count;
        if (!accel_octree_build(build, &h->pool, &h->trees.at[i], c->order.at + cluster->first,
                                cluster->count, &cluster->box, rule, from, to))
            return false;
    }
    accel_octree_pool_trim(&h->base.memory, &h->pool);
    accel_octree_note_empty(build, &h->pool);
    accel_octree_note_lists(build, &h->pool, h->trees.at, h->trees.count);
    return true;
}

static const accel_box *cluster_box(const void *user, size_t i)
{
    const struct clustering *c = user;
    return &c->clusters.at[i].box;
}

static bool build_top(struct build *build, struct hoo_kind *h)
{
    const size_t count = h->clustering.clusters.count;
    if (count == 1) {
        accel_build_left_out(build, sizeof(struct boxtree_node), accel_octree_pool_bytes(&h->pool),
                             "one cluster: no tree above its octree");
        return true;
    }
    accel_build_phase(build, "tree");
    return accel_pair_boxes(build, &h->top, count, cluster_box, &h->clustering);
}

static void describe(struct build *build, const struct hoo_kind *h)
{
    accel_info *info = &build->a->info;
    info->nodes = h->top.nodes.count + h->pool.nodes;
    info->leaves = h->pool.leaves;
    info->references = h->pool.refs.count;
    info->depth += h->top.depth;
}

static bool build_classic(struct build *build, struct hoo_kind *h)
{
    if (!build_octrees(build, h) || !build_top(build, h))
        return false;
    describe(build, h);
    return true;
}

/* The clusters are the tree's shape, and not needed after it. */
static bool build_wide(struct build *build, struct hoo_kind *h)
{
    const bool fine = accel_wide_form_build(build, &h->wide, &h->base.option[ISA], WIDE_BY_OCTANTS,
                                            &h->clustering);
    accel_cluster_free(&h->base.memory, &h->clustering);
    return fine;
}

static void note_idle_options(struct build *build, bool classic)
{
    static const size_t of_classic[] = {LEAF, DEPTH, LAZY, PART};
    if (classic)
        accel_note_idle_option(build, ISA, "form=classic");
    for (size_t i = 0; !classic && i < sizeof of_classic / sizeof *of_classic; i++)
        accel_note_idle_option(build, of_classic[i], "form=wide");
    if (classic && !(build->a->option[LAZY] > 0))
        accel_note_idle_option(build, PART, "lazy=off");
}

static bool build(struct build *build)
{
    struct hoo_kind *h = (struct hoo_kind *)build->a;
    double *option = h->base.option;
    const bool classic = !isnan(option[LEAF]) || !isnan(option[DEPTH]) || option[LAZY] > 0;
    option[FORM] = wide_form_resolve(option[FORM], classic);
    note_idle_options(build, option[FORM] == WIDE_FORM_CLASSIC);
    if (option[FORM] == WIDE_FORM_WIDE)
        option[LAZY] = 0;
    return find_clusters(build, h) &&
           (option[FORM] == WIDE_FORM_CLASSIC ? build_classic(build, h) : build_wide(build, h));
}

static void visit(const accel *a, struct query *q, struct boxtree_child leaf)
{
    const struct hoo_kind *h = (const struct hoo_kind *)a;
    accel_octree_walk(&h->pool, &h->trees.at[leaf.first], q);
}

static void visit_lazy(const accel *a, struct query *q, struct boxtree_child leaf)
{
    const struct hoo_kind *h = (const struct hoo_kind *)a;
    accel_octree_walk_lazy(&h->lazy, &h->deferred.at[leaf.first], q);
}

static void walk(const accel *a, struct query *q)
{
    const struct hoo_kind *h = (const struct hoo_kind *)a;
    if (h->wide.base)
        accel_wide_form_walk(&h->wide, q);
    else if (h->deferred.count == 1)
        accel_octree_walk_lazy(&h->lazy, &h->deferred.at[0], q);
    else if (h->deferred.count > 1)
        boxtree_walk(a, h->top.nodes.at, q, visit_lazy);
    else if (h->trees.count == 1)
        accel_octree_walk(&h->pool, &h->trees.at[0], q);
    else
        boxtree_walk(a, h->top.nodes.at, q, visit);
}

/* Adds what rays have built. */
static void describe_lazy(const accel *a, accel_info *info)
{
    const struct hoo_kind *h = (const struct hoo_kind *)a;
    struct octree_census census = {.nodes = 0};
    for (size_t i = 0; i < h->deferred.count; i++)
        info->unbuilt_clusters += !accel_octree_count(&h->deferred.at[i], &census);
    info->unbuilt_primitives = census.unbuilt;
    info->lazy_bytes = census.bytes;
    info->nodes += census.nodes;
    info->leaves += census.leaves;
    info->references += census.references;
    info->depth += census.depth;
    info->bytes += census.bytes;
    if (census.refused)
        accel_octree_note_refused(info);
    if (h->deferred.count > 0)
        accel_info_note(info, "lazy: %u of %zu clusters and %llu of %zu primitives are not built",
                        info->unbuilt_clusters, h->deferred.count,
                        (unsigned long long)census.unbuilt, h->clustering.order.count);
}

/* ---------------------------------------------------------------------- validate ---- */

static bool broken(accel_error *error, const char *what, size_t number)
{
    accel_error_set(error, ACCEL_BROKEN, "hoo: %s %zu", what, number);
    return false;
}

/* Marks a cluster's ids in seen[], by id. */
static bool check_cluster(const struct hoo_kind *h, size_t i, bool *seen, accel_error *error)
{
    const struct clustering *c = &h->clustering;
    const struct cluster *cluster = &c->clusters.at[i];
    if (cluster->count == 0 || (uint64_t)cluster->first + cluster->count > c->order.count)
        return broken(error, "no ids, or too many, in cluster", i);
    const accel_box *root = h->deferred.count > 0 ? &h->deferred.at[i].box : &h->trees.at[i].box;
    if (memcmp(root, &cluster->box, sizeof *root) != 0)
        return broken(error, "the octree has another box than its cluster,", i);
    const uint32_t *ids = c->order.at + cluster->first;
    for (size_t j = 0; j < cluster->count; j++) {
        if (ids[j] >= h->base.prims.count || seen[ids[j]] || (j > 0 && ids[j - 1] >= ids[j]))
            return broken(error, "a wrong, repeated or misplaced id in cluster", i);
        seen[ids[j]] = true;
    }
    return h->deferred.count > 0 ? accel_octree_validate_lazy(&h->lazy, &h->deferred.at[i], ids,
                                                              cluster->count, error)
                                 : accel_octree_validate(&h->base, &h->pool, &h->trees.at[i], ids,
                                                         cluster->count, error);
}

/* Every bounded id is in exactly one cluster, and every octree is right. */
static bool check_clusters(const struct hoo_kind *h, accel_error *error)
{
    const struct ids *bounded = &h->base.prims.bounded;
    bool *seen = calloc(h->base.prims.count, sizeof *seen);
    bool fine = true;
    if (!seen) {
        accel_error_set(error, ACCEL_NO_MEMORY, "validate: no memory for %u marks",
                        h->base.prims.count);
        return false;
    }
    for (size_t i = 0; fine && i < h->clustering.clusters.count; i++)
        fine = check_cluster(h, i, seen, error);
    for (size_t i = 0; fine && i < bounded->count; i++)
        fine = seen[bounded->at[i]] || broken(error, "no cluster holds id", bounded->at[i]);
    free(seen);
    return fine && (h->clustering.order.count == bounded->count ||
                    broken(error, "ids in clusters:", h->clustering.order.count));
}

/* Checks a child of the top tree against the box that its parent keeps of it, and marks the
 * clusters below it in seen[]. */
static bool check_child(const struct hoo_kind *h, const accel_box *box, struct boxtree_child child,
                        uint32_t depth, bool *seen, accel_error *error)
{
    if (depth > h->top.depth || depth > BOXTREE_MAX_DEPTH)
        return broken(error, "the top tree is too deep, at", depth);
    if (child.count > 0) {
        if (child.first >= h->clustering.clusters.count || seen[child.first] ||
            !box_contains(box, &h->clustering.clusters.at[child.first].box))
            return broken(error, "the top tree is wrong about cluster", child.first);
        return seen[child.first] = true;
    }
    if (child.first >= h->top.nodes.count)
        return broken(error, "the top tree has no node", child.first);
    const struct boxtree_node *node = &h->top.nodes.at[child.first];
    for (int side = 0; side < 2; side++) {
        const accel_box inner = boxtree_box(node, side);
        if (!box_contains(box, &inner) ||
            !check_child(h, &inner, node->child[side], depth + 1, seen, error))
            return broken(error, "wrong below node of the top tree", child.first);
    }
    return true;
}

/* Every cluster is in the top tree exactly once. */
static bool check_top(const struct hoo_kind *h, accel_error *error)
{
    const double inf = (double)INFINITY;
    const accel_box all = {{-inf, -inf, -inf}, {inf, inf, inf}};
    const size_t clusters = h->clustering.clusters.count;
    if (clusters == 1)
        return h->top.nodes.count == 0 || broken(error, "nodes over one cluster:", 1);
    bool *seen = calloc(clusters, sizeof *seen);
    if (!seen) {
        accel_error_set(error, ACCEL_NO_MEMORY, "validate: no memory for %zu marks", clusters);
        return false;
    }
    bool fine = check_child(h, &all, (struct boxtree_child){0, 0}, 0, seen, error);
    for (size_t i = 0; fine && i < clusters; i++)
        fine = seen[i] || broken(error, "the top tree misses cluster", i);
    free(seen);
    return fine;
}

static bool validate(const accel *a, accel_error *error)
{
    const struct hoo_kind *h = (const struct hoo_kind *)a;
    if (h->wide.base)
        return accel_wide_validate(a, &h->wide, error);
    return check_clusters(h, error) && check_top(h, error);
}

static void release(accel *a)
{
    struct hoo_kind *h = (struct hoo_kind *)a;
    for (size_t i = 0; i < h->deferred.count; i++)
        accel_octree_free_parts(&h->lazy, &h->deferred.at[i]);
    array_free(&a->memory, &h->deferred);
    accel_cluster_free(&a->memory, &h->clustering);
    accel_octree_pool_free(&a->memory, &h->pool);
    array_free(&a->memory, &h->trees);
    array_free(&a->memory, &h->top.nodes);
    accel_wide_free(&a->memory, &h->wide);
}

const struct accel_kind accel_hoo_kind = {
    .info = {.name = "hoo",
             .summary = "hierarchy of octrees: clusters, an octree for each, a binary tree on top",
             .options = options,
             .option_count = sizeof options / sizeof *options},
    .cost = COST_HOO,
    .size = sizeof(struct hoo_kind),
    .build = build,
    .walk = walk,
    .describe = describe_lazy,
    .validate = validate,
    .release = release,
};
