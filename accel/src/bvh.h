/* SPDX-License-Identifier: Apache-2.0
 *
 * bvh: a binary hierarchy of boxes over the primitives, split by the surface-area heuristic:
 * Goldsmith and Salmon, IEEE CG&A 7(5), 1987; binned as in Wald, "On fast Construction of
 * SAH-based Bounding Volume Hierarchies", 2007.
 *
 * Encoding: a boxtree (boxtree.h) whose leaves are runs of references to primitives, in the order
 * of the tree. A tree of one leaf has no node.
 *
 * Invariant: every bounded primitive is referred to exactly once; each child's box contains the
 * padded boxes of all primitives below it.
 *
 * Cost: a reference and at most one node for each primitive, whatever the scene. Bad at:
 * primitives whose boxes overlap much, such as long thin ones across each other.
 */
#ifndef ACCEL_BVH_H
#define ACCEL_BVH_H

#include "boxtree.h"
#include "kind.h"

struct bvh {
    accel base;
    ARRAY_OF(struct boxtree_node) nodes;
    ARRAY_OF(uint32_t) refs;   /* ids, leaf after leaf */
    double *triangles;         /* 9 doubles per reference if all are triangles, else NULL */
    struct boxtree_child root; /* node 0, or the only leaf */
    accel_box box;             /* of the root */
};

/* Builds the tree over all bounded primitives. `leaf`: ranges of no more primitives are not split;
 * NAN: where a leaf's predicted cost is lower. */
bool bvh_build(struct build *build, struct bvh *bvh, double leaf);

/* Checks the invariant. */
bool bvh_validate(const struct bvh *bvh, accel_error *error);

#endif
