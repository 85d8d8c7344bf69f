/* SPDX-License-Identifier: Apache-2.0
 *
 * Uniform grids over some items, as a part that the kinds grid and hug are made of.
 *
 * Encoding: the planes of each axis are stored. Cells come in bricks of 4 x 4 x 4: a brick has a
 * mask of its cells that hold something and the number of the first of them; only those have a
 * place in `starts`, the offset of the cell's run of references (Lagae and Dutre, "Compact, Fast
 * and Robust Grids for Ray Tracing", EGSR 2008, with the empty cells left out). Behind the last
 * cell of an axis its last plane is repeated to fill the last brick. A reference is the id of a
 * primitive or, from primitives.count on, the number of a grid nested in this one.
 *
 * Invariant: the planes of an axis rise, from the grid's box to the grid's box; every item is
 * listed in every cell whose closed range its box meets. The box contains those of all items,
 * unless the grid stands for one cell of another: then it contains their parts in that cell.
 *
 * Cost: a walk visits the bricks that the ray crosses, and the cells of those that hold something.
 * Bad at: scenes whose detail is in a small part of the space (hug nests grids for that).
 */
#ifndef ACCEL_GRID_H
#define ACCEL_GRID_H

#include "../core/build.h"
#include "../core/cost.h"
#include "../core/structure.h"
#include "../primitive/query.h"

/* Cells of a brick along each axis, and in all: one bit of a mask each. */
enum { GRID_BRICK = 4, GRID_BRICK_CELLS = 64 };

struct grid {
    accel_box box;      /* from the first to the last plane of each axis */
    double scale[3];    /* cells per unit of length: for a guess that the planes make exact */
    uint32_t cells[3];  /* along each axis */
    uint32_t bricks[3]; /* along each axis: the cells in fours, rounded up */
    size_t plane[3];    /* each axis' first plane in the pool; 4 * bricks + 1 of them */
    size_t brick;       /* the first brick in the pool; x runs fastest */
    uint32_t depth;     /* grids around this one */
    uint32_t cell;      /* 1: stands for one cell of another grid, and is all that the cell lists */
};

/* The parts of one or many grids. */
struct grid_pool {
    ARRAY_OF(struct grid) grids;
    ARRAY_OF(double) planes;
    ARRAY_OF(uint64_t) masks;  /* by brick: bit x + 4 y + 16 z of a cell that holds something */
    ARRAY_OF(uint32_t) firsts; /* by brick: the place of its first such cell in starts */
    ARRAY_OF(uint32_t)
    starts; /* by cell that holds something: its references; one more at the end */
    ARRAY_OF(uint32_t) refs;
};

/* What a grid is made of. */
struct grid_items {
    const uint32_t *at; /* references */
    size_t count;       /* of them */
};

/* How fine a grid is to be. */
struct grid_plan {
    uint32_t cells[3]; /* along each axis */
    double density;    /* cells per item that were asked for */
    double cost;       /* predicted, of a line that meets the grid's box */
    double tests;      /* of that, for testing items */
    double capacity;   /* factor on the bounds that keep memory in proportion to the items */
    bool coarser;      /* than was asked for: for the bounds, or a pile */
};

/* Chooses the cells of a grid over the items, not empty: `density` cells per item, as cubic as
 * possible (Woo), or, if that is NAN, where the predicted cost is lowest. */
struct grid_plan accel_grid_plan(const struct primitives *p, const struct grid_pool *pool,
                                 const accel_box *box, struct grid_items items, double density);

/* A plan of so many cells along each axis, but for one axis without extent. */
struct grid_plan accel_grid_plan_given(const accel_box *box, uint32_t cells);

/* Are the bricks of a plan for a grid over `count` items within bounds? */
bool accel_grid_plan_fits(const struct grid_plan *plan, size_t count);

/* References that a grid over `count` items may have. */
double accel_grid_plan_references(const struct grid_plan *plan, size_t count);

/* Predicted cost of testing all items one by one, in visits of a node. */
double accel_grid_list_cost(const struct primitives *p, struct grid_items items);

/* Halves the number of cells. */
void accel_grid_coarsen(struct grid_plan *plan);

/* Makes it one cell. */
void accel_grid_give_up(struct grid_plan *plan);

/* Makes the parts of grid `number` of the pool, whose box is filled in, over the items, not empty;
 * coarser than the plan where its bricks or references would not be in proportion to the items;
 * of one cell where most cells would list most items.
 * The progress of the phase runs from `from` to `to`. */
bool accel_grid_build(struct build *build, struct grid_pool *pool, size_t number,
                      struct grid_items items, struct grid_plan *plan, double from, double to);

/* Are the planes of grid `number` in order, and are its cells and their references in the pool? */
bool accel_grid_validate_frame(const accel *a, const struct grid_pool *pool, size_t number,
                               accel_error *error);

/* Checks the invariant for grid `number` over the items, which rise, and for the grids that stand
 * for its cells. */
bool accel_grid_validate(const accel *a, const struct grid_pool *pool, size_t number,
                         struct grid_items items, accel_error *error);

/* Bytes of all parts. */
size_t accel_grid_pool_bytes(const struct grid_pool *pool);

/* Notes what the empty cells of all grids would take beside what finds the others. */
void accel_grid_note_empty(struct build *build, const struct grid_pool *pool);

/* Bytes of a grid's parts apart from its references, if it has one cell. */
enum {
    GRID_LEAST_BYTES = sizeof(struct grid) + 3 * (GRID_BRICK + 1) * sizeof(double) +
                       sizeof(uint64_t) + 2 * sizeof(uint32_t)
};

void accel_grid_pool_trim(struct memory *m, struct grid_pool *pool);
void accel_grid_pool_free(struct memory *m, struct grid_pool *pool);

/* The box of what a reference names. */
static inline const accel_box *grid_item_box(const struct primitives *p,
                                             const struct grid_pool *pool, uint32_t ref)
{
    return ref < p->count ? &p->box[ref] : &pool->grids.at[ref - p->count].box;
}

/* The cells of a grid that hold something: those from *first on in starts. Returns their number. */
static inline size_t grid_slots(const struct grid_pool *pool, const struct grid *g, size_t *first)
{
    const size_t bricks = (size_t)g->bricks[0] * g->bricks[1] * g->bricks[2];
    const size_t last = g->brick + bricks - 1;
    *first = pool->firsts.at[g->brick];
    return pool->firsts.at[last] + (size_t)__builtin_popcountll(pool->masks.at[last]) - *first;
}

/* The place in starts of the cell of a brick's bit, which is set. */
static inline size_t grid_slot(const struct grid_pool *pool, size_t brick, uint32_t bit)
{
    const uint64_t below = pool->masks.at[brick] & (((uint64_t)1 << bit) - 1);
    return pool->firsts.at[brick] + (size_t)__builtin_popcountll(below);
}

#endif
