/* SPDX-License-Identifier: Apache-2.0
 *
 * An octree over some primitives, as a part that the kinds octree and hoo are made of.
 *
 * Encoding: a cell is a leaf, a run of references to primitives, or an inner node. A node halves
 * its cell by one plane per axis, stored once for all eight children; it has a mask of the
 * children that hold something, which follow it in memory. Child bits: 1 upper x, 2 upper y,
 * 4 upper z. A plane at infinity leaves its axis whole: every primitive meets both halves, so
 * halving would only list all of them twice. Empty cells are not stored. The cells' boxes are not
 * stored either: they follow from the root's box and the planes.
 *
 * Invariant: every primitive is listed in every leaf whose closed cell meets its padded box; the
 * root's box contains them all.
 *
 * Cost: references grow with how many primitives lie on planes; a walk visits about as many cells
 * as the ray crosses. Bad at: long thin primitives across many cells; large flat ones.
 */
#ifndef ACCEL_OCTREE_H
#define ACCEL_OCTREE_H

#include "../core/build.h"
#include "../core/cost.h"
#include "../core/structure.h"
#include "../primitive/query.h"

struct octree_deferred;

/* Cells deeper than this are not split, so a walk's stack is at most OCTREE_MAX_DEPTH levels. At
 * depth 40 a cell's side is 1e-12 of the root's. */
enum { OCTREE_MAX_DEPTH = 40 };

/* A leaf with `count` references from `first` on; if count is 0, the inner node that begins at word
 * `first` of the pool; if count is OCTREE_LATER, part `first` of those that the pool leaves for
 * later. */
struct octree_cell {
    uint32_t first, count;
};

#define OCTREE_LATER UINT32_MAX

/* An inner node and, right behind it, its children: what a walk needs is in one or two lines of the
 * cache. */
struct octree_node {
    double plane[3];            /* where the cell is halved; INFINITY: this axis is left whole */
    uint32_t mask;              /* bit c: child c holds something */
    uint32_t unused;            /* fills up to a whole word */
    struct octree_cell child[]; /* those that hold something, by rising number */
};

/* The parts of one or many octrees. */
struct octree_pool {
    size_t nodes, leaves;                      /* how many there are */
    ARRAY_OF(uint32_t) deferred_ids;           /* what meets `later`, one run after the other */
    ARRAY_OF(struct octree_deferred) deferred; /* none unless lazy: see octree_deferred.h */
    ARRAY_OF(uint32_t) refs;
    ARRAY_OF(uint64_t) words; /* the inner nodes, each as many words as it needs */
};

/* Bits set in the lower 8. */
static inline uint32_t octree_bits(uint32_t mask)
{
    mask -= mask >> 1 & 0x55;
    mask = (mask & 0x33) + (mask >> 2 & 0x33);
    return (mask + (mask >> 4)) & 0x0f;
}

/* Words of a node with `children` of them. */
static inline size_t octree_words(uint32_t children)
{
    return (sizeof(struct octree_node) + children * sizeof(struct octree_cell)) / sizeof(uint64_t);
}

/* The inner node at a word. */
static inline struct octree_node *octree_node_at(const struct octree_pool *pool, uint32_t word)
{
    return (struct octree_node *)(void *)(pool->words.at + word);
}

/* The child of a number that the node's mask has. */
static inline const struct octree_cell *octree_child(const struct octree_node *node, uint32_t child)
{
    return &node->child[octree_bits(node->mask & ((1u << child) - 1))];
}

struct octree {
    accel_box box;           /* of the root */
    struct octree_cell root; /* never an empty leaf */
};

/* When a cell is split. */
struct octree_rule {
    double leaf;  /* cells of no more primitives are not; NAN: where the predicted cost is lower */
    double depth; /* deeper cells are not; NAN: as deep as it pays */
};

/* Builds an octree over ids[0 .. count - 1], count > 0, all inside `box`. Adds to the counts in
 * build->a->info; the progress of the phase runs from `from` to `to`. */
bool accel_octree_build(struct build *build, struct octree_pool *pool, struct octree *tree,
                        const uint32_t *ids, size_t count, const accel_box *box,
                        struct octree_rule rule, double from, double to);

/* Notes that cells above the given depth were left whole. */
void accel_octree_note_refused(accel_info *info);

void accel_octree_walk(const struct octree_pool *pool, const struct octree *tree, struct query *q);

/* Checks the invariant for an octree over ids[0 .. count - 1]. */
bool accel_octree_validate(const accel *a, const struct octree_pool *pool,
                           const struct octree *tree, const uint32_t *ids, size_t count,
                           accel_error *error);

/* Bytes of nodes and references. */
size_t accel_octree_pool_bytes(const struct octree_pool *pool);

/* Notes what empty cells would take; what the smallest octrees would in place of lists. */
void accel_octree_note_empty(struct build *build, const struct octree_pool *pool);
void accel_octree_note_lists(struct build *build, const struct octree_pool *pool,
                             const struct octree *trees, size_t count);

void accel_octree_pool_trim(struct memory *m, struct octree_pool *pool);
void accel_octree_pool_free(struct memory *m, struct octree_pool *pool);

/* The options `leaf` and `depth`, for kinds that hold octrees. */
#define OCTREE_LEAF_OPTION                                                                         \
    {                                                                                              \
        .key = "leaf", .meaning = "primitives that a cell may hold without being split", .min = 1, \
        .max = 1e9, .standard = NAN, .whole = true                                                 \
    }
#define OCTREE_DEPTH_OPTION                                                                        \
    {                                                                                              \
        .key = "depth", .meaning = "levels below the root", .min = 0, .max = OCTREE_MAX_DEPTH,     \
        .standard = NAN, .whole = true                                                             \
    }

#endif
