/* SPDX-License-Identifier: Apache-2.0
 *
 * Joining parts that lie in each other's boxes: two octrees over the same place are both walked,
 * one octree over both costs one more level or two. A lid goes to its pot, a mesh's loose bits go
 * to the mesh, strands of hair become one head; but a teapot stays apart from the stadium around
 * it.
 *
 * Parts are taken from large to small. Each looks for parts already taken that its box overlaps,
 * by a grid of cells as large as they are, and joins the one with the greatest gain: the predicted
 * cost (accel_parts_cost) of both apart less that of both as one. A part of fewer than TINY
 * primitives joins whatever contains it nearly, as one leaf more or less is cheaper than one tree
 * more. Parts that do not overlap are never joined: their boxes tell them apart better than cells.
 *
 * Expected linear: a part has at most 8 cells, looks at a constant number of octaves, and in each
 * cell at a few of the parts there. Boxes that grew are found anew in the next of a few rounds.
 */
#include "../core/order.h"
#include "cluster_parts.h"

enum { TINY = 8, MOST_VISITED = 8, ROUNDS = 3 };

/* A tiny part joins where the box of both has no more than this of the larger's surface. */
#define NEARLY 1.1

/* A part's entry in a cell. */
struct entry {
    uint32_t part; /* perhaps joined with another since */
    uint32_t next; /* in the same cell */
};

struct nester {
    struct parts *parts;
    ARRAY_OF(struct keyed) order; /* root parts from large to small */
    struct cells cells;           /* each with its first entry */
    ARRAY_OF(struct entry) entries;
    bool octaves[CELLS_OCTAVES]; /* that have entries */
    bool joined;                 /* anything in this round */
};

/* What a part may join. */
struct choice {
    uint32_t part;
    double gain;
};

static struct memory *memory_of(const struct nester *n)
{
    return &n->parts->build->a->memory;
}

/* Root parts from large to small, then along the curve, so that ids do not matter. */
static bool sort(struct nester *n)
{
    const struct parts *p = n->parts;
    n->order.count = 0;
    for (size_t i = 0; i < p->part.count; i++) {
        if (p->part.at[i].first != i)
            continue;
        if (!array_extend(memory_of(n), &n->order, 1))
            return accel_build_no_memory(p->build);
        const accel_box unit = frame_box(&p->sizes.frame, &p->part.at[i].box);
        const uint64_t octave = octave_of(box_longest(&unit));
        n->order.at[n->order.count - 1] =
            (struct keyed){octave << 57 | accel_order_morton(&unit), (uint32_t)i};
    }
    return accel_order_by_key(memory_of(n), n->order.at, n->order.count) ||
           accel_build_no_memory(p->build);
}

/* The gain of joining b with the larger a. True if it should be done. */
static bool gain_of(const struct parts *p, const struct cluster *a, const struct cluster *b,
                    double *gain)
{
    accel_box both = a->box;
    box_add(&both, &b->box);
    *gain = accel_parts_cost(p, &a->box, a->count) + accel_parts_cost(p, &b->box, b->count) -
            accel_parts_cost(p, &both, (double)a->count + b->count);
    const accel_box unit = frame_box(&p->sizes.frame, &both),
                    larger = frame_box(&p->sizes.frame, &a->box);
    return *gain > 0.0 || (b->count < TINY && box_area(&unit) <= NEARLY * box_area(&larger));
}

/* Looks at the entries of one cell. */
static void consider(struct nester *n, uint32_t entry, uint32_t part, struct choice *best)
{
    struct parts *p = n->parts;
    p->visits++;
    for (int i = 0; entry != ACCEL_NONE && i < MOST_VISITED;
         i++, entry = n->entries.at[entry].next) {
        const uint32_t host = accel_parts_root(p, n->entries.at[entry].part);
        p->visits++;
        const struct cluster *a = &p->part.at[host], *b = &p->part.at[part];
        double gain;
        if (box_overlaps(&a->box, &b->box) && gain_of(p, a, b, &gain) &&
            (best->part == ACCEL_NONE || gain > best->gain))
            *best = (struct choice){host, gain};
    }
}

static struct choice choose(struct nester *n, uint32_t part, const accel_box *unit)
{
    struct choice best = {ACCEL_NONE, 0.0};
    uint32_t c[3];
    for (uint32_t octave = 0; octave <= octave_of(box_longest(unit)); octave++) {
        if (!n->octaves[octave])
            continue;
        const struct span s = span_of(unit, octave, 0.0);
        for (c[2] = s.first[2]; c[2] <= s.last[2]; c[2]++)
            for (c[1] = s.first[1]; c[1] <= s.last[1]; c[1]++)
                for (c[0] = s.first[0]; c[0] <= s.last[0]; c[0]++)
                    consider(n, cells_get(&n->cells, cell_key(0, octave, c[0], c[1], c[2])), part,
                             &best);
    }
    return best;
}

static bool enter_cell(struct nester *n, uint64_t key, uint32_t part)
{
    struct cell_slot *slot = accel_cells_at(memory_of(n), &n->cells, key);
    if (!slot || n->entries.count == ACCEL_NONE || !array_extend(memory_of(n), &n->entries, 1))
        return accel_build_no_memory(n->parts->build);
    n->entries.at[n->entries.count - 1] = (struct entry){part, slot->value};
    slot->value = (uint32_t)n->entries.count - 1;
    return true;
}

static bool enter(struct nester *n, uint32_t part, const accel_box *unit)
{
    const uint32_t octave = octave_of(box_longest(unit));
    const struct span s = span_of(unit, octave, 0.0);
    uint32_t c[3];
    n->octaves[octave] = true;
    for (c[2] = s.first[2]; c[2] <= s.last[2]; c[2]++)
        for (c[1] = s.first[1]; c[1] <= s.last[1]; c[1]++)
            for (c[0] = s.first[0]; c[0] <= s.last[0]; c[0]++)
                if (!enter_cell(n, cell_key(0, octave, c[0], c[1], c[2]), part))
                    return false;
    return true;
}

static bool go_round(struct nester *n)
{
    struct parts *p = n->parts;
    n->joined = false;
    if (!sort(n))
        return false;
    for (size_t i = 0; i < n->order.count; i++) {
        const uint32_t part = n->order.at[i].value;
        const accel_box unit = frame_box(&p->sizes.frame, &p->part.at[part].box);
        const struct choice best = choose(n, part, &unit);
        if (best.part != ACCEL_NONE) {
            accel_parts_join(p, best.part, part);
            n->joined = true;
        } else if (!enter(n, part, &unit)) {
            return false;
        }
        if (!parts_tick(p, i))
            return false;
    }
    return true;
}

bool accel_parts_join_nested(struct parts *p)
{
    bool fine = true, joined = true;
    for (int round = 0; fine && joined && round < ROUNDS; round++) {
        struct nester n = {.parts = p};
        fine = go_round(&n);
        joined = n.joined;
        array_free(memory_of(&n), &n.order);
        array_free(memory_of(&n), &n.entries);
        accel_cells_free(memory_of(&n), &n.cells);
    }
    return fine;
}
