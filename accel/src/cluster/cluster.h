/* SPDX-License-Identifier: Apache-2.0
 *
 * Clusters of a scene: step 1 of the hierarchies hug (a grid for each cluster) and hoo (an octree
 * for each), after Cazals, Drettakis and Puech, "Filtering, Clustering and Hierarchy Construction",
 * Computer Graphics Forum 14(3), 1995. How they are found: cluster.c.
 *
 * Invariant: every bounded primitive is in exactly one cluster. Clusters may overlap in space: a
 * small cluster may lie inside the box of a large one.
 */
#ifndef ACCEL_CLUSTER_H
#define ACCEL_CLUSTER_H

#include "../core/build.h"
#include "../core/cost.h"
#include "../core/structure.h"

struct cluster {
    accel_box box;       /* around the padded boxes of its primitives, tight */
    uint32_t first;      /* its ids are order.at[first .. first + count - 1], rising */
    uint32_t count;      /* never 0 */
    uint32_t size_class; /* of most of its primitives; 0 holds the largest */
};

struct clustering {
    struct ids order;                  /* the bounded ids, grouped by cluster */
    ARRAY_OF(struct cluster) clusters; /* by size class, then along a space-filling curve */
    uint32_t size_classes;             /* that hold something */
    uint64_t visits; /* at cells and at what they hold: the work that might not be linear */
};

/* What the user may decide. */
struct cluster_rule {
    double connectivity; /* gap that joins two primitives, in sizes of the largest of their class;
                            NAN: by cost */
    double octaves;      /* factors of two in size that a class may span; NAN: no limit */
};

/* Finds the clusters of the bounded primitives, of which there is at least one. Progress of the
 * phase runs from `from` to `to`. *c must be zero; accel_cluster_free ends it, also after a
 * failure. Expected time and memory are linear in the primitives. */
bool accel_cluster_scene(struct build *build, struct clustering *c, struct cluster_rule rule,
                         double from, double to);

void accel_cluster_free(struct memory *m, struct clustering *c);

/* The options of kinds that hold clusters. */
#define CLUSTER_CONNECTIVITY_OPTION                                                                \
    {                                                                                              \
        .key = "connectivity",                                                                     \
        .meaning = "gap that joins two primitives, in sizes of the largest of their size class",   \
        .min = 0, .max = 1e9, .standard = NAN                                                      \
    }
#define CLUSTER_OCTAVES_OPTION                                                                     \
    {                                                                                              \
        .key = "octaves",                                                                          \
        .meaning =                                                                                 \
            "factors of two in size that a size class may span; auto: up to a gap in sizes",       \
        .min = 1, .max = 64, .standard = NAN, .whole = true                                        \
    }

#endif
