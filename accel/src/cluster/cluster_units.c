/* SPDX-License-Identifier: Apache-2.0
 *
 * Clusters by a given connectivity: primitives that touch and lie together become units, so that
 * few things go through the grids that follow (cluster_near.c).
 *
 * A primitive joins the unit of the one before it in the list if it touches that, as it does in
 * most meshes; else one of the units opened last in the cell of its middle, a few times as large as
 * it is; else it opens a new one. A cell that is displaced from the table of cells begins anew. No
 * unit outgrows the next coarser grid.
 */
#include "cluster_parts.h"

enum {
    PER_OPEN_UNIT = 8, /* primitives for each place in the table of cells */
    MOST_VISITED = 4   /* open units of a cell */
};

/* A cell and the unit opened last in it. */
struct open_cell {
    uint64_t key;
    uint32_t unit; /* ACCEL_NONE: none yet */
};

struct opener {
    struct parts *parts;
    struct open_cell *cells; /* `room` of them, a power of two, by hash */
    size_t capacity;
    uint32_t last; /* unit of the primitive before, or ACCEL_NONE */
};

/* A primitive on its way into a unit. */
struct joiner {
    const accel_box *box;
    uint32_t octave, class, grid;
};

static struct memory *memory_of(const struct parts *p)
{
    return &p->build->a->memory;
}

/* Takes the box into the unit if they touch and that does not make it too large. */
static bool join(struct parts *p, uint32_t unit, const struct joiner *j)
{
    struct unit *u = &p->units.at[unit];
    if (!box_overlaps(&u->box, j->box))
        return false;
    accel_box both = u->box;
    box_add(&both, j->box);
    if (box_longest(&both) >= p->sizes.too_large[j->grid])
        return false;
    u->box = both;
    u->count++;
    return true;
}

/* The unit of the cell that takes the box, or ACCEL_NONE. */
static uint32_t join_in_cell(struct parts *p, uint32_t unit, const struct joiner *j)
{
    for (int i = 0; unit != ACCEL_NONE && i < MOST_VISITED; i++) {
        if (join(p, unit, j))
            return unit;
        unit = p->units.at[unit].next;
    }
    return ACCEL_NONE;
}

/* A new unit of the cell; ACCEL_NONE if there is no memory. */
static uint32_t open_unit(struct parts *p, struct open_cell *cell, const struct joiner *j)
{
    if (!array_extend(memory_of(p), &p->units, 1))
        return ACCEL_NONE;
    const uint32_t made = (uint32_t)p->units.count - 1;
    p->units.at[made] = (struct unit){*j->box, 1, j->octave, cell->unit, ACCEL_NONE};
    return cell->unit = made;
}

/* Puts a primitive into a unit, perhaps a new one. ACCEL_NONE if there is no memory. */
static uint32_t put(struct opener *o, const accel_box *box)
{
    struct parts *p = o->parts;
    const struct sizes *s = &p->sizes;
    const uint32_t octave = sizes_octave(s, box);
    const struct joiner j = {box, octave, s->class_of[octave], s->grid_of[octave]};
    if (o->last != ACCEL_NONE && s->class_of[p->units.at[o->last].octave] == j.class &&
        join(p, o->last, &j))
        return o->last;
    const uint32_t coarse = j.grid > SIZES_PER_GRID ? j.grid - SIZES_PER_GRID : 0;
    const uint64_t key = parts_middle(p, j.class, coarse, box);
    struct open_cell *cell = &o->cells[cell_hash(key) & (o->capacity - 1)];
    if (cell->key != key)
        *cell = (struct open_cell){key, ACCEL_NONE};
    const uint32_t unit = join_in_cell(p, cell->unit, &j);
    return unit == ACCEL_NONE ? open_unit(p, cell, &j) : unit;
}

static bool fill(struct opener *o)
{
    struct parts *p = o->parts;
    const struct primitives *prims = &p->build->a->prims;
    for (size_t i = 0; i < prims->bounded.count; i++) {
        o->last = put(o, &prims->box[prims->bounded.at[i]]);
        p->piece_of.at[i] = o->last;
        if (o->last == ACCEL_NONE)
            return accel_build_no_memory(p->build);
        if (!parts_tick(p, i))
            return false;
    }
    return true;
}

bool accel_parts_make_units(struct parts *p)
{
    const size_t count = p->build->a->prims.bounded.count;
    struct opener o = {.parts = p, .capacity = 64, .last = ACCEL_NONE};
    while (o.capacity < count / PER_OPEN_UNIT)
        o.capacity *= 2;
    o.cells = accel_memory_resize(memory_of(p), NULL, 0, o.capacity * sizeof *o.cells);
    if (!o.cells || !array_extend(memory_of(p), &p->piece_of, count)) {
        if (o.cells)
            accel_memory_resize(memory_of(p), o.cells, o.capacity * sizeof *o.cells, 0);
        return accel_build_no_memory(p->build);
    }
    memset(o.cells, 0xff, o.capacity * sizeof *o.cells);
    const bool fine = fill(&o);
    accel_memory_resize(memory_of(p), o.cells, o.capacity * sizeof *o.cells, 0);
    return fine;
}
