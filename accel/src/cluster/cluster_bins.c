/* SPDX-License-Identifier: Apache-2.0
 *
 * Step 1b of clustering: primitives of one size class with their middles in one cell become a part.
 * The grid is as fine as the places where primitives are (cluster_sample.c), so a part is a few of
 * them, and what follows handles parts only.
 *
 * Where primitives are not loose, a cell may hold things that do not touch, such as a bit of floor
 * and of the foot that stands a hair above it. So a cell is cut into SLABS on each axis, and a part
 * knows which slabs its primitives meet, as bits; where a slab is empty, a plane goes between its
 * primitives, and it is split there. Were the pieces so small that an octree for each would not
 * pay, as with loose cubes, none is split.
 *
 * Nothing depends on the order of the primitives but the numbers of the parts.
 */
#include "cluster_parts.h"

enum {
    SLABS = 64,
    MOST_SPARE = 8, /* pieces that a part may have beyond its primitives; most will stay empty */
    CACHED = 65536  /* cells of a table in the cache */
};

/* The slabs that a part's primitives meet: bit i of each axis. */
struct slabs {
    uint64_t met[3];
};

/* The cells of one size class. */
struct grid {
    uint32_t octave;
    double scale; /* from lengths to slabs */
    size_t first; /* of its cells in binner.table */
};

struct binner {
    struct parts *parts;
    struct grid grid[CELLS_OCTAVES];   /* by class */
    uint64_t from[SLABS], upto[SLABS]; /* the bits of the slabs from and up to each */
    uint32_t *table;                   /* the part of each cell; NULL where there are too many */
    size_t table_size;                 /* cells of all grids */
    struct cells cells;                /* each with its part, where there is no table */
    ARRAY_OF(struct slabs) slabs;      /* by part; none where primitives are loose */
    ARRAY_OF(uint32_t) first_of;       /* by part: where its pieces begin, ACCEL_NONE: not split */
    ARRAY_OF(uint32_t) pieces;         /* the parts they become, ACCEL_NONE: none yet */
};

/* A primitive on its way into a part: the slabs where it begins and ends, counted from the scene's
 * corner, and the cell of its middle. */
struct entry {
    uint32_t lo[3], hi[3], cell[3];
};

static struct memory *memory_of(const struct binner *b)
{
    return &b->parts->build->a->memory;
}

static uint32_t class_of(const struct parts *p, const accel_box *box)
{
    return p->sizes.classes > 1 ? p->sizes.class_of[sizes_octave(&p->sizes, box)] : 0;
}

/* The cell of a box's middle alone. In units of the frame all is below 1, so cells and slabs are in
 * range without a test: the scene's longest side is, and rounding is monotone. */
static inline void find_cell(const struct frame *f, const struct grid *grid, const accel_box *box,
                             uint32_t cell[3])
{
    const double scale = grid->scale / (2 * SLABS);
    for (int k = 0; k < 3; k++)
        cell[k] = (uint32_t)(scale * ((box->lo[k] - f->lo[k]) + (box->hi[k] - f->lo[k])));
}

static inline uint32_t slab_of(const struct frame *f, const struct grid *grid, double at, int k)
{
    return (uint32_t)(int32_t)((at - f->lo[k]) * grid->scale);
}

static inline struct entry entry_of(const struct frame *f, const struct grid *grid,
                                    const accel_box *box)
{
    struct entry g;
    for (int k = 0; k < 3; k++) {
        g.lo[k] = slab_of(f, grid, box->lo[k], k);
        g.hi[k] = slab_of(f, grid, box->hi[k], k);
        g.cell[k] = (g.lo[k] + g.hi[k]) / (2 * SLABS);
    }
    return g;
}

/* The first slab of the cell that an entry meets, and the last: as its middle is in the cell, it
 * begins at most before it, and ends at most behind it. */
static inline uint32_t first_in(uint32_t lo, uint32_t cell)
{
    return lo > cell * SLABS ? lo - cell * SLABS : 0;
}

static inline uint32_t last_in(uint32_t hi, uint32_t cell)
{
    return hi - cell * SLABS < SLABS ? hi - cell * SLABS : SLABS - 1;
}

static inline void meet(const struct binner *b, struct slabs *s, const struct entry *g)
{
    for (int k = 0; k < 3; k++) {
        const uint32_t first = first_in(g->lo[k], g->cell[k]), last = last_in(g->hi[k], g->cell[k]);
        s->met[k] |= b->from[first] & b->upto[last];
    }
}

/* ------------------------------------------------------------------------- bins ---- */

/* A new part without primitives, or ACCEL_NONE if there is no memory. */
static uint32_t new_part(struct binner *b, uint32_t class, bool loose)
{
    uint32_t made;
    if (!accel_parts_new(b->parts, class, &made))
        return ACCEL_NONE;
    if (!loose && !array_extend(memory_of(b), &b->slabs, 1))
        return ACCEL_NONE;
    if (!loose)
        b->slabs.at[made] = (struct slabs){{0, 0, 0}};
    return made;
}

/* The part of a cell, or ACCEL_NONE if there is no memory. */
static inline uint32_t part_of(struct binner *b, uint32_t class, const uint32_t cell[3], bool loose)
{
    uint32_t *part;
    if (b->table) {
        const struct grid *g = &b->grid[class];
        part = &b->table[g->first + ((cell[2] << g->octave | cell[1]) << g->octave | cell[0])];
    } else {
        const uint64_t key = cell_key(class, b->grid[class].octave, cell[0], cell[1], cell[2]);
        struct cell_slot *slot = accel_cells_at(memory_of(b), &b->cells, key);
        if (!slot)
            return ACCEL_NONE;
        part = &slot->value;
    }
    if (*part == ACCEL_NONE)
        *part = new_part(b, class, loose);
    return *part;
}

/* Inlined with `loose` known. */
__attribute__((always_inline)) static inline bool fill_as(struct binner *b, bool loose)
{
    struct parts *p = b->parts;
    const struct frame frame = p->sizes.frame;
    const accel_box *boxes = p->build->a->prims.box;
    const struct ids bounded = p->build->a->prims.bounded;
    uint32_t *piece_of = p->piece_of.at;
    for (size_t i = 0; i < bounded.count; i++) {
        const accel_box *box = &boxes[bounded.at[i]];
        const uint32_t class = class_of(p, box);
        struct entry g;
        if (loose)
            find_cell(&frame, &b->grid[class], box, g.cell);
        else
            g = entry_of(&frame, &b->grid[class], box);
        const uint32_t number = part_of(b, class, g.cell, loose);
        if (number == ACCEL_NONE)
            return accel_build_no_memory(p->build);
        struct cluster *part = &p->part.at[number];
        piece_of[i] = number;
        part->count++;
        box_add(&part->box, box);
        if (!loose)
            meet(b, &b->slabs.at[number], &g);
        if (!parts_tick(p, i))
            return false;
    }
    return true;
}

/* Is a table of all cells better than hashing those that are met? Where cells are no more than
 * primitives, or few enough to stay in the cache and to be cleared sooner than hashed. */
static bool table_pays(size_t cells, size_t primitives)
{
    return cells <= primitives || (cells <= CACHED && cells <= 4 * primitives);
}

static bool make_table(struct binner *b)
{
    if (!table_pays(b->table_size, b->parts->build->a->prims.bounded.count))
        return true;
    b->table = accel_memory_resize(memory_of(b), NULL, 0, b->table_size * sizeof *b->table);
    if (!b->table)
        return accel_build_no_memory(b->parts->build);
    memset(b->table, 0xff, b->table_size * sizeof *b->table);
    return true;
}

/* ----------------------------------------------------------------------- pieces ---- */

/* The lowest bit of each run of bits. */
static inline uint64_t begins(uint64_t met)
{
    return met & ~(met << 1);
}

/* Bits set. */
static inline uint32_t bits_of(uint64_t x)
{
    x -= x >> 1 & 0x5555555555555555;
    x = (x & 0x3333333333333333) + (x >> 2 & 0x3333333333333333);
    x = (x + (x >> 4)) & 0x0f0f0f0f0f0f0f0f;
    return (uint32_t)(x * 0x0101010101010101 >> 56);
}

/* The pieces that planes can cut a part into, at most. */
static uint32_t pieces_of(const struct slabs *s)
{
    uint32_t pieces = 1;
    for (int k = 0; k < 3; k++)
        pieces *= bits_of(begins(s->met[k]));
    return pieces;
}

/* Gives each part that is to be split its place in `pieces`. *fragments tells that most primitives
 * are in parts that fall apart into fragments. False: no memory. */
static bool plan_pieces(struct binner *b, bool *fragments)
{
    const struct parts *p = b->parts;
    size_t cut = 0, fragmented = 0;
    if (!array_extend(memory_of(b), &b->first_of, p->part.count))
        return accel_build_no_memory(p->build);
    for (size_t i = 0; i < p->part.count; i++) {
        const uint32_t pieces = pieces_of(&b->slabs.at[i]), count = p->part.at[i].count;
        const bool split =
            pieces > 1 && pieces <= (uint64_t)count + MOST_SPARE && cut + pieces <= ACCEL_NONE;
        b->first_of.at[i] = split ? (uint32_t)cut : ACCEL_NONE;
        cut += split ? pieces : 0;
        fragmented += pieces > 1 && pieces > count / PARTS_FRAGMENT ? count : 0;
    }
    *fragments = 2 * fragmented > p->build->a->prims.bounded.count;
    if (*fragments || cut == 0)
        return true;
    if (!array_extend(memory_of(b), &b->pieces, cut))
        return accel_build_no_memory(p->build);
    memset(b->pieces.at, 0xff, cut * sizeof *b->pieces.at);
    return true;
}

/* The number of a primitive's piece in its part: which runs of slabs it is in. */
static uint32_t piece_of(const struct binner *b, uint32_t part, const accel_box *box)
{
    const struct parts *p = b->parts;
    const struct frame *f = &p->sizes.frame;
    const struct grid *grid = &b->grid[p->part.at[part].size_class];
    uint32_t piece = 0;
    for (int k = 2; k >= 0; k--) {
        const uint64_t begin = begins(b->slabs.at[part].met[k]);
        if ((begin & (begin - 1)) == 0)
            continue;
        const uint32_t lo = slab_of(f, grid, box->lo[k], k), hi = slab_of(f, grid, box->hi[k], k);
        const uint32_t first = first_in(lo, (lo + hi) / (2 * SLABS));
        piece = piece * bits_of(begin) + bits_of(begin & UINT64_MAX >> (SLABS - 1 - first)) - 1;
    }
    return piece;
}

/* Moves the primitives of parts that are split into pieces; the first piece keeps the number. */
static bool move(struct binner *b)
{
    struct parts *p = b->parts;
    const size_t total = p->build->a->prims.bounded.count, before = p->part.count;
    for (size_t i = 0; i < before; i++)
        if (b->first_of.at[i] != ACCEL_NONE)
            p->part.at[i].box = box_empty(), p->part.at[i].count = 0;
    for (size_t i = 0; i < total; i++) {
        const uint32_t part = p->piece_of.at[i];
        if (b->first_of.at[part] == ACCEL_NONE)
            continue;
        const accel_box *box = parts_box(p, i);
        uint32_t *piece = &b->pieces.at[b->first_of.at[part] + piece_of(b, part, box)];
        if (*piece == ACCEL_NONE && p->part.at[part].count == 0)
            *piece = part;
        else if (*piece == ACCEL_NONE && !accel_parts_new(p, p->part.at[part].size_class, piece))
            return false;
        p->piece_of.at[i] = *piece;
        p->part.at[*piece].count++;
        box_add(&p->part.at[*piece].box, box);
        if (!parts_tick(p, i))
            return false;
    }
    return true;
}

/* Room for about as many parts as there will be. */
static bool reserve(struct binner *b, bool loose)
{
    const size_t parts = 64 + b->parts->build->a->prims.bounded.count / 32;
    return (array_reserve(memory_of(b), &b->parts->part, parts) &&
            (loose || array_reserve(memory_of(b), &b->slabs, parts))) ||
           accel_build_no_memory(b->parts->build);
}

static bool make(struct binner *b, bool *loose)
{
    if (!array_extend(memory_of(b), &b->parts->piece_of, b->parts->build->a->prims.bounded.count))
        return accel_build_no_memory(b->parts->build);
    if (!make_table(b) || !reserve(b, *loose))
        return false;
    if (*loose)
        return fill_as(b, true);
    return fill_as(b, false) && plan_pieces(b, loose) && (b->pieces.count == 0 || move(b));
}

bool accel_parts_bin(struct parts *p, struct parts_sample *sample)
{
    struct binner b = {.parts = p};
    struct memory *m = memory_of(&b);
    for (int i = 0; i < SLABS; i++) {
        b.from[i] = UINT64_MAX << i;
        b.upto[i] = UINT64_MAX >> (SLABS - 1 - i);
    }
    for (uint32_t c = 0; c < p->sizes.classes; c++) {
        const uint32_t o = sample->octave[c];
        const double scale = p->sizes.frame.scale * (double)(SLABS << o);
        b.grid[c] = (struct grid){o, scale, b.table_size};
        b.table_size += (size_t)1 << 3 * o;
    }
    const bool fine = make(&b, &sample->loose);
    p->visits += p->build->a->prims.bounded.count;
    if (b.table)
        accel_memory_resize(m, b.table, b.table_size * sizeof *b.table, 0);
    accel_cells_free(m, &b.cells);
    array_free(m, &b.slabs);
    array_free(m, &b.first_of);
    array_free(m, &b.pieces);
    return fine;
}
