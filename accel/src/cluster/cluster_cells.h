/* SPDX-License-Identifier: Apache-2.0
 *
 * A map from the cells of a grid to numbers: what finds neighbours in linear time. Only cells that
 * hold something are stored.
 *
 * The grid lies over a scene in units of its frame: the scene's box moved to the origin and scaled
 * by a power of two so that its longest side is in [1/2, 1). Grids of all octaves share one map: a
 * cell of octave o has the side 2^-o.
 *
 * Encoding: open addressing with linear probing, at most half full; keys hold class, octave and the
 * three indices.
 */
#ifndef ACCEL_CLUSTER_CELLS_H
#define ACCEL_CLUSTER_CELLS_H

#include <string.h>

#include "../core/frame.h"
#include "../core/memory.h"

/* Octaves 0 .. CELLS_OCTAVES - 1: 18 bits for an index, 5 for an octave, 5 for a class. The finest
 * cells are 2^-18 of the scene, 4e-6; what is smaller counts as that large. */
enum { CELLS_OCTAVES = 19 };

/* The finest octave whose cells are larger than a size in 0 .. 1. */
static inline uint32_t octave_of(double size)
{
    uint64_t bits;
    memcpy(&bits, &size, sizeof bits);
    const int octave = 1022 - (int)(bits >> 52);
    return octave < 0 ? 0 : octave < CELLS_OCTAVES ? (uint32_t)octave : CELLS_OCTAVES - 1;
}

static inline uint64_t cell_key(uint32_t class, uint32_t octave, uint32_t x, uint32_t y, uint32_t z)
{
    return (uint64_t) class << 59 | (uint64_t)octave << 54 | (uint64_t)x << 36 | (uint64_t)y << 18 |
           z;
}

/* The cells of an octave that a box meets. */
struct span {
    uint32_t first[3], last[3];
};

/* `reach`, in cells, is how far outside of the box a cell may be. */
static inline struct span span_of(const accel_box *unit, uint32_t octave, double reach)
{
    const double cells = (double)(1u << octave);
    struct span s;
    for (int k = 0; k < 3; k++) {
        const double lo = unit->lo[k] * cells - reach, hi = unit->hi[k] * cells + reach;
        s.first[k] = lo > 0.0 ? (uint32_t)lo : 0;
        s.last[k] = hi < cells ? (uint32_t)hi : (1u << octave) - 1;
    }
    return s;
}

struct cell_slot {
    uint64_t key;
    uint32_t value; /* ACCEL_NONE: the slot is free */
};

/* Zero is empty. */
struct cells {
    struct cell_slot *slot; /* room of them */
    size_t capacity, used;  /* room is 0 or a power of two */
};

/* Two rounds of multiplicative hashing: neighbouring cells differ in a few bits far apart. */
static inline uint32_t cell_hash(uint64_t key)
{
    key *= 0x9e3779b97f4a7c15u;
    key = (key ^ key >> 32) * 0xbf58476d1ce4e5b9u;
    return (uint32_t)(key >> 32);
}

static inline struct cell_slot *cells_probe(const struct cells *c, uint64_t key)
{
    size_t at = cell_hash(key) & (c->capacity - 1);
    while (c->slot[at].value != ACCEL_NONE && c->slot[at].key != key)
        at = (at + 1) & (c->capacity - 1);
    return &c->slot[at];
}

/* The cell's value, ACCEL_NONE if it is not stored. */
static inline uint32_t cells_get(const struct cells *c, uint64_t key)
{
    return c->capacity ? cells_probe(c, key)->value : ACCEL_NONE;
}

/* Makes room for so many cells. Zero before. */
bool accel_cells_reserve(struct memory *m, struct cells *c, size_t count);

/* The cell's slot, for the caller to set its value at once if it is ACCEL_NONE. NULL: no memory. */
struct cell_slot *accel_cells_at(struct memory *m, struct cells *c, uint64_t key);

void accel_cells_free(struct memory *m, struct cells *c);

#endif
