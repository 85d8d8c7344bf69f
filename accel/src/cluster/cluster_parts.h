/* SPDX-License-Identifier: Apache-2.0
 *
 * Clusters in the making: pieces, which are a few primitives each, make parts; parts are joined.
 * Union-find over parts; a root's entry holds what is true of all that was joined with it.
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
    uint32_t owner;  /* its component, then its part */
};

struct parts {
    struct build *build;         /* whose memory and progress it is */
    struct sizes sizes;          /* of the scene */
    ARRAY_OF(struct unit) units; /* with a given connectivity only */
    ARRAY_OF(uint32_t)
    piece_of;                      /* by position in the list of bounded ids: with a given
                                      connectivity its unit, else its part */
    ARRAY_OF(struct cluster) part; /* by piece or component; `first` is its union-find parent */
    uint32_t fragment;             /* parts of fewer primitives are fragments */
    uint64_t visits;               /* at cells and what is in them, so far */
    double now;                    /* progress to report meanwhile */
};

uint32_t accel_parts_root(struct parts *p, uint32_t part);

/* Joins the parts of two different roots; returns the root of both. */
uint32_t accel_parts_join(struct parts *p, uint32_t a, uint32_t b);

/* Makes a new part without primitives. False: no memory. */
bool accel_parts_new(struct parts *p, uint32_t size_class, uint32_t *number);

/* Predicted cost of a cluster in visits of a node, times its surface: every ray that meets its box
 * goes down the levels of its octree and tests at least one primitive. */
double accel_parts_cost(const struct parts *p, const accel_box *box, double count);

/* The same for a box in units of the frame. */
double accel_parts_unit_cost(const struct parts *p, const accel_box *unit, double count);

/* Reports progress now and then in a loop over i. False if the build is cancelled. */
static inline bool parts_tick(const struct parts *p, size_t i)
{
    return i % 4096 != 0 || accel_build_tick(p->build, p->now);
}

/* The padded box at a position in the list of bounded ids. */
static inline const accel_box *parts_box(const struct parts *p, size_t position)
{
    const struct primitives *prims = &p->build->a->prims;
    return &prims->box[prims->bounded.at[position]];
}

/* The cell with the middle of a box. */
static inline uint64_t parts_middle(const struct parts *p, uint32_t class, uint32_t octave,
                                    const accel_box *box)
{
    const struct frame *f = &p->sizes.frame;
    const uint32_t last = (1u << octave) - 1;
    const double cells = 0.5 * f->scale * (double)(1u << octave);
    uint32_t c[3];
    for (int k = 0; k < 3; k++) {
        const double at = cells * ((box->lo[k] - f->lo[k]) + (box->hi[k] - f->lo[k]));
        c[k] = at < (double)last ? (uint32_t)at : last;
    }
    return cell_key(class, octave, c[0], c[1], c[2]);
}

/* A part of fewer primitives than this is a fragment: an octree would not pay for it. More than the
 * 12 triangles of a cube, which the paper's octrees hold in one leaf. Where primitives are loose,
 * all parts are fragments. */
enum { PARTS_FRAGMENT = 16 };

/* What a sample tells. */
struct parts_sample {
    bool loose;                     /* most primitives touch hardly any others */
    uint32_t octave[CELLS_OCTAVES]; /* by class: of cells that hold some primitives where there are
                                       any */
};

/* Looks at a sample: see cluster_sample.c. */
bool accel_parts_sample(const struct parts *p, struct parts_sample *sample);

/* Makes parts of what is together in the cells of the octave: see cluster_bins.c. What falls apart
 * into fragments becomes loose. */
bool accel_parts_bin(struct parts *p, struct parts_sample *sample);

/* Makes units of all primitives: see cluster_units.c. */
bool accel_parts_make_units(struct parts *p);

/* Makes parts of what is near: see cluster_near.c. */
bool accel_parts_connect(struct parts *p, double connectivity);

/* Joins parts of one size class that touch, and fragments of one that are near each other,
 * beginning with half of a cell that the look found; NULL: with the size of a fragment. See
 * cluster_fragments.c. */
bool accel_parts_join_touching(struct parts *p);
bool accel_parts_join_fragments(struct parts *p, const struct parts_sample *sample);

/* Joins parts that lie in each other's boxes: see cluster_nested.c. */
bool accel_parts_join_nested(struct parts *p);

#endif
