/* SPDX-License-Identifier: Apache-2.0
 *
 * Step 1b of clustering: primitives of similar size that are near become parts.
 *
 * - Primitives that touch and have their middles in one cell, a few times as large as they are, are
 *   first made one unit, by looking at the units opened last in that cell; a cell that is displaced
 *   from the table of cells begins anew. Only units go through the grids.
 * - Units that touch, or are within the given gap, are connected by hash grids and union-find
 *   (touching.h): one grid for each two octaves of size in a class; each unit is entered into its
 *   own and compared with the next coarser one. So sizes may differ along a chain of neighbours,
 *   but a teapot does not melt into a hall whose floor it stands on.
 * - A scene of loose primitives, such as a cloud of spheres, would only give one component each. A
 *   sample tells: all primitives in a few of the cells of a coarse grid. If the sample falls apart
 *   into crumbs, parts are made of what is together in the cells of a grid with about one cell for
 *   each few primitives, at a fraction of the time; crumbs.c makes clusters of these.
 */
#include "cluster_parts.h"
#include "cluster_touching.h"

enum {
    PER_OPEN_UNIT = 8,    /* primitives for each place in the table of cells */
    LOOKED_AT = 4,        /* open units of a cell */
    LOOSE_MIN = 4096,     /* units below which a sample is not worth taking */
    SAMPLE_SHARE = 16,    /* one cell of so many goes into the sample */
    SAMPLE_CELL = 64,     /* units in a cell of the sample's grid, if they were spread evenly */
    LOOSE_CELL = 16,      /* as many in a cell of the grid for loose primitives */
    LARGEST_COMPONENT = 8 /* mean primitives of a component in a sample that is loose */
};

struct connector {
    struct parts *parts;
    double connectivity; /* as in cluster_rule; 0 for auto */
    bool sample;         /* only units in the sample's cells */
    struct touching touching;
    ARRAY_OF(uint32_t) order;        /* units by grid, coarse first */
    size_t begin[CELLS_OCTAVES + 1]; /* of each grid in it */
    uint32_t *number;                /* by root group: its part */
};

static struct memory *memory_of(const struct parts *p)
{
    return &p->build->a->memory;
}

/* ---------------------------------------------------------------------- units ---- */

/* The grid for a size in a class: the class's first octave or a multiple of SIZES_PER_GRID below
 * it; above for units that have outgrown the class. */
static uint32_t grid_for(uint32_t top, uint32_t octave)
{
    if (octave >= top)
        return top + (octave - top) / SIZES_PER_GRID * SIZES_PER_GRID;
    return top >= SIZES_PER_GRID && octave >= top - SIZES_PER_GRID ? top - SIZES_PER_GRID : 0;
}

/* Can the box join the unit without making it too large for the next coarser grid? */
static bool belongs(const struct parts *p, const struct unit *u, uint32_t grid,
                    const accel_box *box)
{
    if (!box_overlaps(&u->box, box))
        return false;
    accel_box both = u->box;
    box_add(&both, box);
    return sizes_octave(&p->sizes, &both) + SIZES_PER_GRID >= grid;
}

/* The cell with the middle of a box. */
static uint64_t middle_key(const struct parts *p, uint32_t class, uint32_t octave,
                           const accel_box *box)
{
    const accel_box unit = frame_box(&p->sizes.frame, box);
    const double cells = 0.5 * (double)(1u << octave);
    uint32_t c[3];
    for (int k = 0; k < 3; k++)
        c[k] = (uint32_t)(cells * (unit.lo[k] + unit.hi[k]));
    return cell_key(class, octave, c[0], c[1], c[2]);
}

/* A cell and the unit opened last in it. */
struct open_cell {
    uint64_t key;
    uint32_t unit; /* ACCEL_NONE: none yet */
};

/* A unit of the cell that the box belongs to, or ACCEL_NONE. */
static uint32_t find_unit(const struct parts *p, uint32_t unit, uint32_t grid, const accel_box *box)
{
    for (int i = 0; unit != ACCEL_NONE && i < LOOKED_AT; i++) {
        if (belongs(p, &p->units.at[unit], grid, box))
            return unit;
        unit = p->units.at[unit].next;
    }
    return ACCEL_NONE;
}

/* Puts a primitive into a unit, perhaps a new one, which goes into *unit. */
static bool put(struct parts *p, struct open_cell *cell, uint32_t octave, uint32_t grid,
                const accel_box *box, uint32_t *unit)
{
    *unit = find_unit(p, cell->unit, grid, box);
    if (*unit == ACCEL_NONE) {
        if (!array_extend(memory_of(p), &p->units, 1))
            return build_no_memory(p->build);
        *unit = (uint32_t)p->units.count - 1;
        p->units.at[*unit] = (struct unit){*box, 0, octave, cell->unit, ACCEL_NONE};
        cell->unit = *unit;
    }
    box_add(&p->units.at[*unit].box, box);
    p->units.at[*unit].count++;
    return true;
}

/* `open` has room for a power of two. */
static bool fill_units(struct parts *p, struct open_cell *open, size_t room)
{
    const struct primitives *prims = &p->build->a->prims;
    for (size_t i = 0; i < prims->bounded.count; i++) {
        const accel_box *box = &prims->box[prims->bounded.at[i]];
        const uint32_t octave = sizes_octave(&p->sizes, box);
        const uint32_t grid = grid_for(p->sizes.top_of[octave], octave);
        const uint32_t coarse = grid > SIZES_PER_GRID ? grid - SIZES_PER_GRID : 0;
        const uint64_t key = middle_key(p, p->sizes.class_of[octave], coarse, box);
        struct open_cell *cell = &open[cell_hash(key) & (room - 1)];
        if (cell->key != key)
            *cell = (struct open_cell){key, ACCEL_NONE};
        if (!put(p, cell, octave, grid, box, &p->unit_of.at[i]) || !parts_tick(p, i))
            return false;
    }
    return true;
}

static bool make_units(struct parts *p)
{
    const size_t count = p->build->a->prims.bounded.count;
    size_t room = 64;
    while (room < count / PER_OPEN_UNIT)
        room *= 2;
    struct open_cell *open = memory_resize(memory_of(p), NULL, 0, room * sizeof *open);
    if (!open || !array_extend(memory_of(p), &p->unit_of, count)) {
        if (open)
            memory_resize(memory_of(p), open, room * sizeof *open, 0);
        return build_no_memory(p->build);
    }
    memset(open, 0xff, room * sizeof *open);
    const bool fine = fill_units(p, open, room);
    memory_resize(memory_of(p), open, room * sizeof *open, 0);
    return fine;
}

/* ---------------------------------------------------------- units that touch ---- */

/* The grid of a unit. */
static uint32_t unit_grid(const struct parts *p, const struct unit *u)
{
    return grid_for(p->sizes.top_of[u->octave], sizes_octave(&p->sizes, &u->box));
}

/* The grid that would hold `per_cell` units in a cell if they filled the scene evenly. */
static uint32_t even_octave(const struct parts *p, double per_cell)
{
    const double octave = log2((double)p->units.count / per_cell) / 3.0;
    return octave < 0.0 ? 0 : octave < CELLS_OCTAVES ? (uint32_t)octave : CELLS_OCTAVES - 1;
}

/* Is the unit among those to connect? */
static bool takes_part(const struct connector *k, const struct unit *u)
{
    if (!k->sample)
        return true;
    const uint64_t key = middle_key(k->parts, 0, even_octave(k->parts, SAMPLE_CELL), &u->box);
    return cell_hash(key) % SAMPLE_SHARE == 0;
}

/* Counting sort of the units by grid. */
static bool sort_units(struct connector *k)
{
    const struct parts *p = k->parts;
    size_t next[CELLS_OCTAVES] = {0}, sum = 0;
    for (size_t i = 0; i < p->units.count; i++)
        if (takes_part(k, &p->units.at[i]))
            next[unit_grid(p, &p->units.at[i])]++;
    for (uint32_t g = 0; g < CELLS_OCTAVES; g++) {
        const size_t here = next[g];
        k->begin[g] = next[g] = sum;
        sum += here;
    }
    k->begin[CELLS_OCTAVES] = sum;
    if (!array_extend(memory_of(p), &k->order, sum))
        return build_no_memory(p->build);
    for (size_t i = 0; i < p->units.count; i++)
        if (takes_part(k, &p->units.at[i]))
            k->order.at[next[unit_grid(p, &p->units.at[i])]++] = (uint32_t)i;
    return true;
}

/* The cells of a grid, or larger ones where the gap needs at least twice itself. */
static struct touch_rule rule_for(const struct connector *k, uint32_t octave, uint32_t grid)
{
    const struct sizes *s = &k->parts->sizes;
    const double gap = k->connectivity * s->largest[octave];
    const uint32_t widest = octave_of(gap < 0.25 ? 2.0 * gap : 0.5);
    const uint32_t used = grid < widest ? grid : widest;
    return (struct touch_rule){s->class_of[octave], used, 0.5 * gap * (double)(1u << used)};
}

static bool connect_unit(struct connector *k, struct unit *u, uint32_t grid)
{
    const struct parts *p = k->parts;
    const accel_box box = frame_box(&p->sizes.frame, &u->box);
    const struct touch_rule own = rule_for(k, u->octave, grid);
    u->home = touching_enter(memory_of(p), &k->touching, &box, own);
    if (u->home == ACCEL_NONE)
        return build_no_memory(p->build);
    if (grid >= SIZES_PER_GRID && k->begin[grid - SIZES_PER_GRID] != k->begin[grid - 1]) {
        const struct touch_rule next = rule_for(k, u->octave, grid - SIZES_PER_GRID);
        if (next.octave != own.octave)
            touching_join(&k->touching, &box, next, u->home);
    }
    return true;
}

static bool connect_units(struct connector *k)
{
    struct parts *p = k->parts;
    for (uint32_t grid = 0; grid < CELLS_OCTAVES; grid++)
        for (size_t i = k->begin[grid]; i < k->begin[grid + 1]; i++)
            if (!connect_unit(k, &p->units.at[k->order.at[i]], grid) || !parts_tick(p, i))
                return false;
    return true;
}

static bool add_unit(struct parts *p, size_t unit, uint32_t part)
{
    struct unit *u = &p->units.at[unit];
    u->home = part;
    box_add(&p->part.at[part].box, &u->box);
    p->part.at[part].count += u->count;
    return parts_tick(p, unit);
}

/* Makes a part of each component. */
static bool number_parts(struct connector *k)
{
    struct parts *p = k->parts;
    const size_t groups = k->touching.groups.count;
    if (!(k->number = memory_resize(memory_of(p), NULL, 0, groups * sizeof *k->number)))
        return build_no_memory(p->build);
    memset(k->number, 0xff, groups * sizeof *k->number);
    for (size_t i = 0; i < p->units.count; i++) {
        const struct unit *u = &p->units.at[i];
        uint32_t *part = &k->number[touching_root(&k->touching, u->home)];
        if (*part == ACCEL_NONE && !parts_new(p, p->sizes.class_of[u->octave], part))
            return false;
        if (!add_unit(p, i, *part))
            return false;
    }
    return true;
}

static void release(struct connector *k)
{
    struct memory *m = memory_of(k->parts);
    if (k->number)
        memory_resize(m, k->number, k->touching.groups.count * sizeof *k->number, 0);
    array_free(m, &k->order);
    touching_free(m, &k->touching);
}

/* ------------------------------------------------------------ loose primitives ---- */

/* Are the units mostly loose? */
static bool sample(struct parts *p, bool *loose)
{
    struct connector k = {.parts = p, .sample = true};
    size_t components = 0;
    const bool fine = sort_units(&k) && connect_units(&k);
    for (size_t g = 0; g < k.touching.groups.count; g++)
        components += touching_root(&k.touching, (uint32_t)g) == g;
    *loose = components * LARGEST_COMPONENT > k.order.count;
    release(&k);
    return fine;
}

/* Makes a part of the units in each cell. */
static bool bin_units(struct parts *p, struct cells *cells)
{
    const uint32_t octave = even_octave(p, LOOSE_CELL);
    for (size_t i = 0; i < p->units.count; i++) {
        const struct unit *u = &p->units.at[i];
        const uint32_t class = p->sizes.class_of[u->octave];
        struct cell_slot *slot =
            cells_at(memory_of(p), cells, middle_key(p, class, octave, &u->box));
        if (!slot)
            return build_no_memory(p->build);
        if (slot->value == ACCEL_NONE && !parts_new(p, class, &slot->value))
            return false;
        if (!add_unit(p, i, slot->value))
            return false;
    }
    return true;
}

bool parts_connect(struct parts *p, double connectivity)
{
    bool loose = false;
    if (!make_units(p))
        return false;
    if (isnan(connectivity) && p->units.count >= LOOSE_MIN &&
        p->units.count > p->build->a->prims.bounded.count / LARGEST_COMPONENT && !sample(p, &loose))
        return false;
    p->crumb = loose ? ACCEL_NONE : PARTS_CRUMB;
    if (loose) {
        struct cells cells = {0};
        const bool fine = bin_units(p, &cells);
        cells_free(memory_of(p), &cells);
        return fine;
    }
    struct connector k = {.parts = p, .connectivity = isnan(connectivity) ? 0.0 : connectivity};
    const bool fine = sort_units(&k) && connect_units(&k) && number_parts(&k);
    release(&k);
    return fine;
}
