/* SPDX-License-Identifier: Apache-2.0
 *
 * Which boxes touch, through chains of others: connected components in expected linear time.
 *
 * A box is entered into every cell of a grid that it meets. In a cell, boxes that touch are one
 * group, with one tight box around their parts in the cell; a box that touches a group joins it,
 * and groups that come to touch become one, so what a cell ends with does not depend on the order
 * in which boxes came. Groups are joined over cells by union-find (Tarjan, JACM 22(2), 1975). A
 * cell that would hold more than a few groups makes one of all: it is crowded, and cannot cost more
 * than a constant for each box. So a million coincident boxes cost as much as a million scattered
 * ones.
 *
 * Coarser than testing boxes pair by pair: two boxes may be called touching when one touches the
 * box around others in one cell. Cells are about as large as boxes, so that happens at close range
 * only. Exact for what is told apart: boxes of two components are disjoint in every cell.
 */
#ifndef ACCEL_CLUSTER_TOUCHING_H
#define ACCEL_CLUSTER_TOUCHING_H

#include "cluster_cells.h"

/* Boxes of one component in one cell. */
struct group {
    float lo[3], hi[3]; /* in cells, from the cell's low corner; rounding keeps what touches */
    uint32_t parent;    /* union-find: a group of the same component; itself if it is the root */
    uint32_t next;      /* in the same cell */
};

/* Zero is empty. */
struct touching {
    struct cells cells; /* each with its first group */
    ARRAY_OF(struct group) groups;
    uint64_t visits; /* at cells and groups, so far */
};

/* Makes room for about so many boxes. Zero before. */
bool accel_touching_reserve(struct memory *m, struct touching *t, size_t boxes);

/* How boxes are entered. */
struct touch_rule {
    uint32_t class;  /* boxes of different classes do not meet */
    uint32_t octave; /* of the cells; a box should not be larger than one */
    double reach;    /* half the gap that still counts as touching, in cells */
};

/* Enters a box and returns one of its groups, or ACCEL_NONE if there is no memory. */
uint32_t accel_touching_enter(struct memory *m, struct touching *t, const accel_box *unit,
                              struct touch_rule rule);

/* Joins `group` with what the box touches in the cells of another octave. */
void accel_touching_join(struct touching *t, const accel_box *unit, struct touch_rule rule,
                         uint32_t group);

/* The number of a group's component: its root group. */
uint32_t accel_touching_root(struct touching *t, uint32_t group);

void accel_touching_free(struct memory *m, struct touching *t);

#endif
