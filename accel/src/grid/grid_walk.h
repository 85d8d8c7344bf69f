/* SPDX-License-Identifier: Apache-2.0
 *
 * The walk of a grid, front to back, in two levels: over the bricks, and over the cells of each
 * brick that holds something.
 *
 * A level is walked by slabs along the axis on which the ray crosses most cells. Of each slab
 * [a, z] it visits, on the other two axes, every place whose near plane is not behind z and whose
 * far plane is not before a: every place whose S is not empty is among them. Stepping from one
 * cell to one neighbour, as Amanatides and Woo do (Eurographics 1987), is not exact: where two
 * planes are crossed at nearly the same t it passes a corner. As a and z only grow from slab to
 * slab, so do the ends of the two ranges, and carrying them over costs one comparison each. Planes
 * are always crossed at (plane - org) * inv, as in query_box; t is never accumulated.
 *
 * Places are numbered in the order of the ray: place 0 of an axis is its last cell where the
 * direction is negative.
 */
#ifndef ACCEL_GRID_WALK_H
#define ACCEL_GRID_WALK_H

#include "grid.h"

/* Does what a kind does with a cell's references. False: the query is done. */
typedef bool grid_visit(const accel *a, struct query *q, const uint32_t *refs, size_t count);

/* One axis of one level, and the places that the slab under way meets on it. */
struct grid_axis {
    const double *plane; /* the near plane of place 0 */
    ptrdiff_t step;      /* from a place's near plane to its far one */
    ptrdiff_t stride;    /* from a place's index to the next one's */
    double org, inv;     /* the ray's; inv is 1 where the ray is parallel */
    bool parallel;       /* to the planes */
    uint32_t lo, hi;     /* the first and the last place met */
    uint32_t end;        /* behind the last place that the ray can meet */
    double far;          /* where the ray leaves place lo */
    double near;         /* where the ray enters place hi + 1 */
};

/* A level: the bricks of a grid, or the cells of a brick. */
struct grid_level {
    struct grid_axis axis[3]; /* the major axis first */
    ptrdiff_t index;          /* of place 0, 0, 0 */
};

/* What is the same for all places of one walk. */
struct grid_walk {
    const accel *a;               /* handed to visit */
    struct query *q;              /* the query */
    const struct grid_pool *pool; /* of the grid */
    grid_visit *visit;            /* what is done with a cell */
    int axis[3];          /* x, y and z, the major axis first; all places are in that order */
    uint32_t flip;        /* a cell's bit, of that of its place in the brick */
    const uint64_t *mask; /* of the brick being walked */
};

static inline double grid_cross(const struct grid_axis *x, uint32_t place)
{
    return (x->plane[(ptrdiff_t)place * x->step] - x->org) * x->inv;
}

/* Where the ray enters and leaves a place, grown. A NaN (0 * inf) cuts nothing off. */
static inline double grid_near(const struct grid_axis *x, uint32_t place)
{
    const double t = grid_cross(x, place);
    return query_grow_near(t > -(double)INFINITY ? t : -(double)INFINITY);
}

static inline double grid_far(const struct grid_axis *x, uint32_t place)
{
    const double t = grid_cross(x, place + 1);
    return query_grow_far(t < (double)INFINITY ? t : (double)INFINITY);
}

/* Moves an axis to the first place that does not end before a, searching from `guess` on. On a
 * parallel axis t is the distance to the origin: the places that hold it are met by every slab.
 * False if there is none. */
static inline bool grid_begin(struct grid_axis *x, uint32_t guess, double a)
{
    a = x->parallel ? 0.0 : a;
    x->lo = guess;
    while (x->lo > 0 && !(grid_far(x, x->lo - 1) < a))
        x->lo--;
    while (grid_far(x, x->lo) < a)
        if (++x->lo == x->end)
            return false;
    x->hi = x->lo;
    x->far = grid_far(x, x->lo);
    x->near = grid_near(x, x->hi + 1);
    if (!x->parallel)
        return true;
    while (x->hi + 1 < x->end && grid_near(x, x->hi + 1) <= 0.0)
        x->hi++;
    x->end = x->hi + 1;
    x->near = x->far = (double)INFINITY;
    return true;
}

/* Moves an axis on to the slab [a, z]. False if the ray has left it. */
static inline bool grid_advance(struct grid_axis *x, double a, double z)
{
    while (x->far < a) {
        if (++x->lo == x->end)
            return false;
        x->far = grid_far(x, x->lo);
    }
    if (x->hi < x->lo) {
        x->hi = x->lo;
        x->near = grid_near(x, x->hi + 1);
    }
    while (x->near <= z && x->hi + 1 < x->end)
        x->near = grid_near(x, ++x->hi + 1);
    return true;
}

/* S of a slab, cut to the places of the two other axes. */
static inline struct interval grid_cut(struct interval slab, const struct grid_axis *x,
                                       uint32_t place)
{
    if (x->parallel)
        return slab;
    const double near = grid_near(x, place), far = grid_far(x, place);
    return (struct interval){near > slab.a ? near : slab.a, far < slab.z ? far : slab.z};
}

/* What a level does at a place that is met, whose S is s. False: the query is done. */
typedef bool grid_place(struct grid_walk *w, const struct grid_level *l, ptrdiff_t index,
                        const uint32_t place[3], struct interval s);

/* Does the place of this index hold something? */
typedef bool grid_holds(const struct grid_walk *w, ptrdiff_t index);

/* Visits what one slab meets. */
static inline bool grid_slab(struct grid_walk *w, const struct grid_level *l, uint32_t at,
                             struct interval s, grid_holds *holds, grid_place *visit)
{
    const struct grid_axis *m = &l->axis[0], *u = &l->axis[1], *v = &l->axis[2];
    const bool single = u->lo == u->hi && v->lo == v->hi;
    for (uint32_t i = u->lo; i <= u->hi; i++) {
        const ptrdiff_t row = l->index + at * m->stride + i * u->stride;
        for (uint32_t j = v->lo; j <= v->hi; j++) {
            const ptrdiff_t index = row + j * v->stride;
            w->q->nodes++;
            if (!holds(w, index))
                continue;
            const struct interval cut = single ? s : grid_cut(grid_cut(s, u, i), v, j);
            if (!query_meets(w->q, cut))
                continue;
            if (!visit(w, l, index, (const uint32_t[]){at, i, j}, cut))
                return false;
        }
    }
    return true;
}

/* Walks a level whose axes have begun, along the part s of the ray. False: the query is done. */
static inline bool grid_slabs(struct grid_walk *w, struct grid_level *l, struct interval s,
                              grid_holds *holds, grid_place *visit)
{
    struct grid_axis *m = &l->axis[0], *u = &l->axis[1], *v = &l->axis[2];
    double near = m->parallel ? s.a : grid_near(m, m->lo);
    for (uint32_t at = m->lo; at < m->end; at++) {
        const double end = w->q->limit < s.z ? w->q->limit : s.z;
        const double a = near > s.a ? near : s.a;
        if (a > end)
            return true;
        double far = end;
        if (!m->parallel) {
            far = grid_far(m, at);
            near = grid_near(m, at + 1);
        }
        const double z = far < end ? far : end;
        if (!grid_advance(u, a, z) || !grid_advance(v, a, z))
            return true;
        if (!grid_slab(w, l, at, (struct interval){a, z}, holds, visit))
            return false;
    }
    return true;
}

static inline bool grid_cell_holds(const struct grid_walk *w, ptrdiff_t index)
{
    return *w->mask >> ((uint32_t)index ^ w->flip) & 1;
}

static inline bool grid_visit_cell(struct grid_walk *w, const struct grid_level *l, ptrdiff_t index,
                                   const uint32_t place[3], struct interval s)
{
    (void)l;
    (void)place;
    (void)s;
    const struct grid_pool *pool = w->pool;
    const size_t slot =
        grid_slot(pool, (size_t)(w->mask - pool->masks.at), (uint32_t)index ^ w->flip);
    const uint32_t start = pool->starts.at[slot];
    return w->visit(w->a, w->q, pool->refs.at + start, pool->starts.at[slot + 1] - start);
}

static inline bool grid_brick_holds(const struct grid_walk *w, ptrdiff_t index)
{
    return w->pool->masks.at[index] != 0;
}

/* Walks the cells of a brick. */
static inline bool grid_visit_brick(struct grid_walk *w, const struct grid_level *bricks,
                                    ptrdiff_t index, const uint32_t place[3], struct interval s)
{
    struct grid_level cells = {.index = 0};
    for (int k = 0; k < 3; k++) {
        const struct grid_axis *brick = &bricks->axis[k];
        struct grid_axis *x = &cells.axis[k];
        *x = (struct grid_axis){.plane = brick->plane + (ptrdiff_t)place[k] * brick->step,
                                .step = brick->step / GRID_BRICK,
                                .stride = 1 << 2 * w->axis[k],
                                .org = brick->org,
                                .inv = brick->inv,
                                .parallel = brick->parallel,
                                .end = GRID_BRICK};
        if (!grid_begin(x, 0, s.a))
            return true;
    }
    w->mask = &w->pool->masks.at[index];
    return grid_slabs(w, &cells, s, grid_cell_holds, grid_visit_cell);
}

/* A first guess at the brick of an axis in which the ray is at t = a. */
static inline uint32_t grid_guess(const struct query *q, const struct grid *g, int k, double a)
{
    const bool negative = q->sign >> k & 1;
    const double at = q->parallel >> k & 1 ? q->org[k] : q->org[k] + q->dir[k] * a;
    const double offset = negative ? g->box.hi[k] - at : at - g->box.lo[k];
    const double place = offset * g->scale[k] / GRID_BRICK, last = g->bricks[k] - 1;
    return !(place > 0.0) ? 0 : place < last ? (uint32_t)place : g->bricks[k] - 1;
}

/* Axis k of the bricks of a grid. */
static inline struct grid_axis grid_bricks_axis(const struct grid_pool *pool, const struct grid *g,
                                                const struct query *q, int k)
{
    const bool parallel = q->parallel >> k & 1, negative = q->sign >> k & 1;
    const ptrdiff_t strides[3] = {1, g->bricks[0], (ptrdiff_t)g->bricks[0] * g->bricks[1]};
    const double *planes = pool->planes.at + g->plane[k];
    return (struct grid_axis){.plane = negative ? planes + GRID_BRICK * g->bricks[k] : planes,
                              .step = negative ? -GRID_BRICK : GRID_BRICK,
                              .stride = negative ? -strides[k] : strides[k],
                              .org = q->org[k],
                              .inv = parallel ? 1.0 : q->inv[k],
                              .parallel = parallel,
                              .end = g->bricks[k]};
}

/* The axis on which the ray crosses most cells. */
static inline int grid_major_axis(const struct query *q, const struct grid *g)
{
    int major = 0;
    for (int k = 1; k < 3; k++)
        if (fabs(q->dir[k]) * g->scale[k] > fabs(q->dir[major]) * g->scale[major])
            major = k;
    return major;
}

/* Visits every cell whose S is not empty and does not begin after q->limit. Inlined with `visit`
 * known, so a cell costs no indirect call. False: the query is done. */
static inline bool grid_walk(const accel *a, const struct grid_pool *pool, const struct grid *g,
                             struct query *q, grid_visit *visit)
{
    const struct interval s = query_box(q, &g->box);
    if (!query_meets(q, s))
        return true;
    const int major = grid_major_axis(q, g);
    struct grid_walk w = {.a = a,
                          .q = q,
                          .pool = pool,
                          .visit = visit,
                          .axis = {major, (major + 1) % 3, (major + 2) % 3}};
    struct grid_level bricks = {.index = (ptrdiff_t)g->brick};
    for (int i = 0; i < 3; i++) {
        const int k = w.axis[i];
        struct grid_axis *x = &bricks.axis[i];
        *x = grid_bricks_axis(pool, g, q, k);
        if (q->sign >> k & 1) {
            w.flip |= 3u << 2 * k;
            bricks.index -= (ptrdiff_t)(g->bricks[k] - 1) * x->stride;
        }
        if (!grid_begin(x, grid_guess(q, g, k, s.a), s.a))
            return true;
    }
    return grid_slabs(&w, &bricks, s, grid_brick_holds, grid_visit_brick);
}

#endif
