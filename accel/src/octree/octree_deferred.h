/* SPDX-License-Identifier: Apache-2.0
 *
 * Octrees whose parts are built when the first ray enters them.
 *
 * A part is a cell and what meets it: a whole tree, or, in a part of many primitives, each cell
 * some levels further down. Until a ray enters it, it is a list of ids and what the builder knew on
 * its way there. Who enters it first builds it into a block of its own and publishes the block by
 * compare-and-swap with release order; of two that do so at the same time one throws its own away.
 * All that a walk pays is one load with acquire order for each part that it enters.
 *
 * Invariant: what is built is, cell by cell, what accel_octree_build would have made: parts begin
 * only where no split above can be taken back, with what the builder had at hand there, and are
 * built in the environment of builds (environment.h). So neither the order of rays nor the number
 * of threads changes the structure or an answer.
 *
 * Without memory for a part its ids are tested as a list, which answers the same (query.h); it is
 * tried again at the 1st, 2nd, 4th, 8th, ... entry after that.
 *
 * Bad at: being entered everywhere. The ids of all parts are kept, which takes memory that an eager
 * build does not need, and a walk goes from block to block.
 */
#ifndef ACCEL_OCTREE_DEFERRED_H
#define ACCEL_OCTREE_DEFERRED_H

#include <stdatomic.h>

#include "octree.h"

struct octree_part;

struct octree_deferred {
    accel_box box;       /* the cell */
    const uint32_t *ids; /* what meets it, rising; of a pool that grows: set in the end */
    uint32_t count;      /* of them */
    uint32_t owned;      /* of them those that no part beside this one owns */
    uint32_t depth;      /* of the cell in its tree */
    uint32_t failed;     /* the builder's, as is the budget */
    double budget;
    atomic_uint retries;    /* retries since an allocation failed */
    atomic_uintptr_t built; /* 0 until a ray enters it; then the part's address, and its mark in
                               the low bits */
    atomic_uintptr_t check; /* 0; then, a moment after, the complement of built */
};

/* The low bits of an address, which are 0. */
enum { OCTREE_MARK = 7 };

/* The mark of an address: the sum without carry of its bits in threes. So if one bit of `built`
 * changes, be it 0 or not, its mark is wrong: what leads to other memory is never followed by
 * accel_validate, not even in the moment before `check` is set. */
static inline uintptr_t octree_mark(uintptr_t address)
{
    uint64_t sum = address;
    for (int shift = 48; shift >= 3; shift /= 2)
        sum ^= sum >> shift;
    return (uintptr_t)sum & OCTREE_MARK;
}

/* A part as it is built: one block, in which its pool lies too, the nodes first. So what a ray
 * needs to enter, the end of this and the first node, is in one or two lines of the cache.
 * Immutable once published. */
struct octree_part {
    size_t bytes;   /* of the block */
    uint32_t depth; /* of its deepest leaf, in the tree */
    bool refused;   /* see accel_octree_note_refused */
    struct octree_pool pool;
    struct octree_cell root;
};

/* How parts are built. */
struct octree_lazy {
    const accel *a;
    struct octree_rule rule;
    uint32_t whole; /* a part of no more primitives is built as a whole */
};

/* A whole tree, to be built later over ids[0 .. count - 1], count > 0, all inside `box`. The ids
 * must stay. */
struct octree_deferred accel_octree_defer(const uint32_t *ids, size_t count, const accel_box *box,
                                          struct octree_rule rule);

/* Grows the cells of a part, which belongs to the tree in the box `tree`, into *pool and *root. */
bool accel_octree_grow_part(struct build *build, struct octree_pool *pool, struct octree_cell *root,
                            const struct octree_lazy *lazy, const struct octree_deferred *part,
                            const accel_box *tree, bool *refused);

/* Builds a part that is not there yet. NULL: there is no memory now, test its ids. */
const struct octree_part *accel_octree_build_part(const struct octree_lazy *lazy,
                                                  struct octree_deferred *deferred,
                                                  const accel_box *tree);

/* The part, or NULL if it is not built. */
static inline struct octree_part *octree_part_of(const struct octree_deferred *deferred)
{
    const uintptr_t built = atomic_load_explicit(&deferred->built, memory_order_acquire);
    return (struct octree_part *)(built & ~(uintptr_t)OCTREE_MARK);
}

/* The same for checks, also while it is built: false if what leads to the part was overwritten. */
bool accel_octree_part_is_sound(const struct octree_deferred *deferred,
                                const struct octree_part **part);

/* The part, which is built if this is the first entry. NULL: test its ids. */
static inline const struct octree_part *octree_enter(const struct octree_lazy *lazy,
                                                     struct octree_deferred *deferred,
                                                     const accel_box *tree)
{
    const struct octree_part *part = octree_part_of(deferred);
    return __builtin_expect(part != NULL, 1) ? part : accel_octree_build_part(lazy, deferred, tree);
}

/* The walk of a lazy tree. */
void accel_octree_walk_lazy(const struct octree_lazy *lazy, struct octree_deferred *tree,
                            struct query *q);

/* What is built by now, and what is not. */
struct octree_census {
    uint64_t nodes, leaves, references, bytes;
    uint64_t unbuilt; /* primitives of parts that no ray has entered, each counted once */
    uint32_t depth;   /* deepest leaf */
    bool refused;     /* see accel_octree_note_refused */
};

/* Adds a part and the parts in it; is it built? While others query it may miss what they build. */
bool accel_octree_count(const struct octree_deferred *deferred, struct octree_census *census);

/* As accel_octree_validate, for as much as is built. */
bool accel_octree_validate_lazy(const struct octree_lazy *lazy, const struct octree_deferred *tree,
                                const uint32_t *ids, size_t count, accel_error *error);

/* Frees what was built below. */
void accel_octree_free_parts(const struct octree_lazy *lazy, struct octree_deferred *deferred);

/* The default of the option `part`. On the dragon of 871,414 triangles, against an eager build: up
 * to the first 100 rays, build included, took 0.57 of the time with 512, 0.60 with 4,096, 0.67 with
 * 16,384, and all of it without parts. Rays through what was built took 7 to 20 % longer with 512;
 * with more the difference did not show. */
enum { OCTREE_PART = 4096 };

/* The option `part`, for kinds that hold lazy octrees. */
#define OCTREE_PART_OPTION                                                                         \
    {                                                                                              \
        .key = "part",                                                                             \
        .meaning = "lazy: octrees of no more primitives are built as a whole, larger ones in "     \
                   "parts",                                                                        \
        .min = 1, .max = 1e9, .standard = OCTREE_PART, .whole = true                               \
    }

#endif
