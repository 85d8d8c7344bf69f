/* SPDX-License-Identifier: Apache-2.0
 *
 * bsp: a kd-tree, that is a binary space partition by axis-parallel planes, placed by the
 * surface-area heuristic: MacDonald and Booth, The Visual Computer 6(3), 1990; Havran, "Heuristic
 * Ray Shooting Algorithms", 2000.
 *
 * Encoding: nodes in depth-first order, 16 bytes each. The half below an inner node's plane is the
 * node after it, the half above is named. Halves that hold nothing are not stored. A leaf is a run
 * of references. The cells' boxes follow from the root's box and the planes.
 *
 * Invariant: every bounded primitive is listed in every leaf whose closed cell meets its padded
 * box; the root's box contains them all.
 *
 * Cost: a step of the walk tests one plane; references grow with how much the primitives' boxes
 * overlap, within a budget. Bad at: building fast; long primitives that lie aslant.
 */
#ifndef ACCEL_BSP_H
#define ACCEL_BSP_H

#include "../core/build.h"
#include "../core/cost.h"
#include "../core/structure.h"
#include "../primitive/query.h"

/* Cells this deep are not split, so the walk's stack holds at most so many. */
enum { BSP_MAX_DEPTH = 64 };

/* bsp_node.bits: the axis of the plane in the lower two, or BSP_LEAF. */
enum { BSP_LEAF = 3, BSP_AXIS = 3, BSP_LOWER_EMPTY = 4, BSP_UPPER_EMPTY = 8 };

struct bsp_node {
    union {
        double plane; /* of an inner node */
        struct {
            uint32_t count;  /* of a leaf: references, more than 0 */
            uint32_t unused; /* 0, so that all of a leaf has a value, whatever it is taken for */
        };
    };
    uint32_t first; /* the node above the plane, or the leaf's first reference */
    uint32_t bits;  /* axis or BSP_LEAF, and which halves are empty */
};

struct bsp {
    accel base;
    accel_box box; /* of the root */
    ARRAY_OF(struct bsp_node) nodes;
    ARRAY_OF(uint32_t) refs; /* ids */
};

/* When a cell is split. */
struct bsp_rule {
    double leaf;  /* cells of no more primitives are not; NAN: where the predicted cost is lower */
    double depth; /* cells this deep are not; NAN: BSP_MAX_DEPTH */
};

/* Builds the tree over all bounded primitives. */
bool accel_bsp_build(struct build *build, struct bsp *bsp, struct bsp_rule rule);

/* Checks the invariant. */
bool accel_bsp_validate(const struct bsp *bsp, accel_error *error);

#endif
