/* SPDX-License-Identifier: Apache-2.0
 *
 * Clusters in the making: the touching components of a scene, and how some of them are joined.
 * Union-find over components; a root's entry holds what is true of all that was joined with it.
 */
#ifndef ACCEL_PARTS_H
#define ACCEL_PARTS_H

#include "cells.h"
#include "cluster.h"

struct parts {
    struct build *build;           /* whose memory and progress it is */
    struct frame frame;            /* of the scene */
    ARRAY_OF(struct cluster) part; /* by component; `first` is its union-find parent */
    double now;                    /* progress to report meanwhile */
};

uint32_t parts_root(struct parts *p, uint32_t part);

/* Joins the components of two different roots; returns the root of both. */
uint32_t parts_join(struct parts *p, uint32_t a, uint32_t b);

/* Predicted cost of a cluster in visits of a node, times its surface: every ray that meets its box
 * goes down the levels of its octree and tests at least one primitive. */
double parts_cost(const struct parts *p, const accel_box *box, double count);

/* A component of fewer primitives than this is a crumb: an octree would not pay for it. More than
 * the 12 triangles of a cube, which the paper's octrees hold in one leaf. */
enum { PARTS_CRUMB = 16 };

/* Joins crumbs of one size class that are near each other: see crumbs.c. */
bool parts_join_crumbs(struct parts *p, uint32_t size_classes);

/* Joins parts that lie in each other's boxes: see nested.c. */
bool parts_join_nested(struct parts *p);

#endif
