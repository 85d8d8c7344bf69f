/* SPDX-License-Identifier: Apache-2.0
 *
 * Joining neighbours pairwise into a balanced binary tree: step 3 of the hierarchy of octrees.
 *
 * Rounds as in PLOC (Meister and Bittner, "Parallel Locally-Ordered Clustering for Bounding Volume
 * Hierarchy Construction", TVCG 24(3), 2018): items lie along a space-filling curve; each looks a
 * few places up and down for the partner with the smallest common surface, and pairs that choose
 * each other are joined; the others wait for the next round. Where a round would pair fewer than
 * half of the items, items that follow each other are paired as well, so that a round leaves at
 * most 3/4 of them: the depth is at most log(count) / log(4/3), 77 for 2^32, and all rounds
 * together take linear time.
 */
#ifndef ACCEL_HOO_PAIRING_H
#define ACCEL_HOO_PAIRING_H

#include "boxtree.h"
#include "../cluster/cluster_cells.h"
#include "../core/build.h"
#include "../core/cost.h"
#include "../core/structure.h"

struct boxtree {
    ARRAY_OF(struct boxtree_node) nodes;
    uint32_t depth; /* of the deepest leaf */
};

/* Builds a tree over the boxes of leaves 0 .. count - 1, count > 1; leaf i is the child {i, 1}.
 * box_of(user, i) is the i-th box. Progress of the phase runs from 0 to 1. */
bool accel_pair_boxes(struct build *build, struct boxtree *tree, size_t count,
                      const accel_box *(*box_of)(const void *user, size_t i), const void *user);

#endif
