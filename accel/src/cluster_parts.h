/* SPDX-License-Identifier: Apache-2.0
 *
 * Clusters in the making: components of a scene's primitives, and how some of them are joined.
 * Union-find over components; a root's entry holds what is true of all that was joined with it.
 */
#ifndef ACCEL_CLUSTER_PARTS_H
#define ACCEL_CLUSTER_PARTS_H

#include "cluster.h"
#include "cluster_sizes.h"

/* Primitives of one size class that touch and lie together: they are handled as one. */
struct unit {
    accel_box box;
    uint32_t count;  /* primitives */
    uint32_t octave; /* of its first primitive's size */
    uint32_t next;   /* opened before it in its cell */
    uint32_t home;   /* a group, then its part, at last its cluster */
};

struct parts {
    struct build *build;           /* whose memory and progress it is */
    struct sizes sizes;            /* of the scene */
    ARRAY_OF(struct unit) units;   /* all primitives */
    ARRAY_OF(uint32_t) unit_of;    /* by position in the list of bounded ids */
    ARRAY_OF(struct cluster) part; /* by component; `first` is its union-find parent */
    uint32_t crumb;                /* parts of fewer primitives are crumbs */
    double now;                    /* progress to report meanwhile */
};

uint32_t parts_root(struct parts *p, uint32_t part);

/* Joins the components of two different roots; returns the root of both. */
uint32_t parts_join(struct parts *p, uint32_t a, uint32_t b);

/* Makes a new part without primitives. False: no memory. */
bool parts_new(struct parts *p, uint32_t size_class, uint32_t *number);

/* Predicted cost of a cluster in visits of a node, times its surface: every ray that meets its box
 * goes down the levels of its octree and tests at least one primitive. */
double parts_cost(const struct parts *p, const accel_box *box, double count);

/* Reports progress now and then in a loop over i. False if the build is cancelled. */
bool parts_tick(const struct parts *p, size_t i);

/* A part of fewer primitives than this is a crumb: an octree would not pay for it. More than the 12
 * triangles of a cube, which the paper's octrees hold in one leaf. Where primitives are loose, all
 * parts are crumbs. */
enum { PARTS_CRUMB = 16 };

/* Makes units and parts of what is near: see near.c. */
bool parts_connect(struct parts *p, double connectivity);

/* Joins crumbs of one size class that are near each other: see crumbs.c. */
bool parts_join_crumbs(struct parts *p);

/* Joins parts that lie in each other's boxes: see nested.c. */
bool parts_join_nested(struct parts *p);

#endif
