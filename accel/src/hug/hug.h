/* SPDX-License-Identifier: Apache-2.0
 *
 * hug: the hierarchy of uniform grids of Cazals, Drettakis and Puech, "Filtering, Clustering and
 * Hierarchy Construction: a New Solution for Ray-Tracing Complex Scenes", Computer Graphics Forum
 * 14(3), 1995: the clusters of the scene (cluster.h), a grid for each, nested in the smallest grid
 * whose box contains it.
 *
 * Two forms. `paper`: k x k x k cells for each cluster. `density`: the cells of a grid as its
 * predicted cost says, and a crowded cell becomes a grid of its own where that is cheaper, and so
 * on inside it. In both a cluster of a few primitives has no grid: they are items of the grid
 * around it.
 *
 * Encoding: grid 0 contains all; then the other clusters' grids; then those that stand for one
 * cell, each the only reference of its cell. Invariant: that of grid.h for each of them; every
 * bounded primitive is an item of exactly one cluster's grid, every cluster's grid but the first
 * an item of exactly one other. A grid that is met in several cells is walked once, in full, the
 * first time: a walk may be repeated, and the limit only falls, so a later one would add nothing.
 *
 * Cost: as a grid where the scene is one cluster. Bad at: many clusters that overlap.
 */
#ifndef ACCEL_HUG_H
#define ACCEL_HUG_H

#include "../cluster/cluster.h"
#include "../grid/grid.h"

/* Clusters' grids around a cluster's grid: it goes into one further out where there would be more.
 * Grids inside each other that stand for cells. Both together bound the stack of a walk, at about
 * one kilobyte a grid. */
enum {
    HUG_MAX_NESTING = 6,
    HUG_MAX_CELL_NESTING = 5,
    HUG_MAX_DEPTH = (HUG_MAX_NESTING + 1) * (HUG_MAX_CELL_NESTING + 1)
};

struct hug {
    accel base;            /* what every kind has */
    struct grid_pool pool; /* the grids */
};

enum hug_option { HUG_FORM, HUG_CELLS, HUG_DENSITY, HUG_CONNECTIVITY, HUG_OCTAVES };
enum hug_form { HUG_FORM_DENSITY, HUG_FORM_PAPER };

/* Which grid everything belongs to. */
struct hug_nesting {
    struct ids owner;  /* by cluster: the grid that has its primitives as items */
    struct ids parent; /* by cluster's grid: the grid around it; 0 for grid 0 */
    size_t lists;      /* clusters without a grid */
};

/* Progress of the phase that nests and then gathers items: where nesting ends. */
#define HUG_NESTED 0.6

/* Makes grid 0 and the other clusters' grids, with box and depth alone, and fills the nesting,
 * which must be zero; accel_hug_nesting_free ends it, also after a failure. Progress of the phase
 * runs from 0 to HUG_NESTED. */
bool accel_hug_nest(struct build *build, struct grid_pool *pool, const struct clustering *c,
                    struct hug_nesting *n);

void accel_hug_nesting_free(struct memory *m, struct hug_nesting *n);

bool accel_hug_build(struct build *build);
bool accel_hug_validate(const accel *a, accel_error *error);

#endif
