/* SPDX-License-Identifier: Apache-2.0
 *
 * octree: one octree over the whole scene (Glassner, IEEE CG&A 4(10), 1984), walked front to back.
 *
 * The walk is the top-down parametric one of Revelles, Urena and Lastra, "An Efficient Parametric
 * Algorithm for Octree Traversal", WSCG 2000, made exact: instead of choosing one next child it
 * visits every child whose grown interval is met, in the order that the ray's signs give; planes
 * are computed from coordinates, never by halving t.
 *
 * Encoding, invariant and cost: see octree.h.
 */
#include "octree.h"

#include <string.h>

/* One level of the walk. Raw values of t, near and far as the ray goes. A half of an axis that the
 * ray is parallel to and outside of has near = inf, far = -inf. */
struct level {
    double near[3], far[3];         /* where the ray enters and leaves the cell's slabs */
    double half_near[3];            /* enters the far half of each axis */
    double half_far[3];             /* leaves the near half */
    const struct octree_node *node; /* the cell's node */
    uint32_t left;                  /* children not yet visited, in the ray's order */
};

/* The near and far planes of a closed range on axis k. */
static void cross_range(const struct query *q, int k, double lo, double hi, double *near,
                        double *far)
{
    const double inf = (double)INFINITY;
    if (q->parallel >> k & 1) {
        const bool inside = lo <= q->org[k] && q->org[k] <= hi;
        *near = inside ? -inf : inf;
        *far = inside ? inf : -inf;
        return;
    }
    const bool negative = q->sign >> k & 1;
    const double t0 = ((negative ? hi : lo) - q->org[k]) * q->inv[k];
    const double t1 = ((negative ? lo : hi) - q->org[k]) * q->inv[k];
    *near = t0 > -inf ? t0 : -inf;
    *far = t1 < inf ? t1 : inf;
}

/* Where the ray crosses the plane between the halves: the far half begins at *half_near, the near
 * half ends at *half_far. A NaN (0 * inf) cuts nothing off. */
static void cross_plane(const struct query *q, int k, double plane, double *half_near,
                        double *half_far)
{
    const double inf = (double)INFINITY;
    if (q->parallel >> k & 1) {
        *half_near = q->org[k] >= plane ? -inf : inf;
        *half_far = q->org[k] <= plane ? inf : -inf;
        return;
    }
    const double t = (plane - q->org[k]) * q->inv[k];
    *half_near = t > -inf ? t : -inf;
    *half_far = t < inf ? t : inf;
}

/* Children in the order of the ray: bit i of the result is child i ^ sign. */
static uint32_t in_ray_order(uint32_t mask, uint32_t sign)
{
    if (sign & 1)
        mask = (mask & 0x55) << 1 | (mask >> 1 & 0x55);
    if (sign & 2)
        mask = (mask & 0x33) << 2 | (mask >> 2 & 0x33);
    if (sign & 4)
        mask = (mask & 0x0f) << 4 | mask >> 4;
    return mask;
}

static void enter(struct query *q, struct level *l, const struct octree_node *node)
{
    q->nodes++;
    l->node = node;
    l->left = in_ray_order(node->mask, q->sign);
    for (int k = 0; k < 3; k++) {
        cross_plane(q, k, node->plane[k], &l->half_near[k], &l->half_far[k]);
        l->half_near[k] = l->half_near[k] > l->near[k] ? l->half_near[k] : l->near[k];
        l->half_far[k] = l->half_far[k] < l->far[k] ? l->half_far[k] : l->far[k];
    }
}

/* The slabs of the child at place `i` of the ray's order. False if it need not be visited. */
static bool child_slabs(const struct query *q, const struct level *l, uint32_t i, double near[3],
                        double far[3])
{
    double a = -(double)INFINITY, z = (double)INFINITY;
    for (int k = 0; k < 3; k++) {
        near[k] = i >> k & 1 ? l->half_near[k] : l->near[k];
        far[k] = i >> k & 1 ? l->far[k] : l->half_far[k];
        a = near[k] > a ? near[k] : a;
        z = far[k] < z ? far[k] : z;
    }
    return query_meets(q, query_interval(q, a, z));
}

static const struct octree_cell *child_cell(const struct octree_pool *pool, const struct level *l,
                                            uint32_t child)
{
    const uint32_t below = l->node->mask & ((1u << child) - 1);
    return &pool->cells.at[l->node->first + (uint32_t)__builtin_popcount(below)];
}

static void test_leaf(const struct octree_pool *pool, struct query *q,
                      const struct octree_cell *cell)
{
    query_test_list(q, pool->refs.at + cell->first, cell->count);
}

/* Visits the node of stack[0] and all below it. */
static void walk_nodes(const struct octree_pool *pool, struct query *q, struct level *stack)
{
    struct level *top = stack;
    while (top >= stack) {
        if (top->left == 0) {
            top--;
            continue;
        }
        const uint32_t i = (uint32_t)__builtin_ctz(top->left);
        top->left &= top->left - 1;
        if (!child_slabs(q, top, i, top[1].near, top[1].far))
            continue;
        const struct octree_cell *cell = child_cell(pool, top, i ^ q->sign);
        if (cell->count > 0) {
            test_leaf(pool, q, cell);
            if (query_done(q))
                return;
        } else {
            enter(q, ++top, &pool->nodes.at[cell->first]);
        }
    }
}

void octree_walk(const struct octree_pool *pool, const struct octree *tree, struct query *q)
{
    /* A level for each inner node on the way down, and one more that child_slabs writes into. */
    struct level stack[OCTREE_MAX_DEPTH + 2];
    double a = -(double)INFINITY, z = (double)INFINITY;
    for (int k = 0; k < 3; k++) {
        cross_range(q, k, tree->box.lo[k], tree->box.hi[k], &stack->near[k], &stack->far[k]);
        a = stack->near[k] > a ? stack->near[k] : a;
        z = stack->far[k] < z ? stack->far[k] : z;
    }
    if (!query_meets(q, query_interval(q, a, z)))
        return;
    if (tree->root.count > 0) {
        test_leaf(pool, q, &tree->root);
        return;
    }
    enter(q, stack, &pool->nodes.at[tree->root.first]);
    walk_nodes(pool, q, stack);
}

/* ------------------------------------------------------------------ the kind ---- */

struct octree_kind {
    accel base;
    struct octree_pool pool;
    struct octree tree;
};

enum { FORM, LEAF, DEPTH, ROOT };

static const char *const forms[] = {"classic", NULL};
static const char *const roots[] = {"cube", "scene", NULL};

static const accel_option options[] = {
    [FORM] = {.key = "form", .meaning = "how cells are laid out", .words = forms},
    [LEAF] = OCTREE_LEAF_OPTION,
    [DEPTH] = OCTREE_DEPTH_OPTION,
    [ROOT] = {.key = "root", .meaning = "shape of the root cell", .words = roots},
};

static accel_box scene_box(const struct primitives *p)
{
    accel_box b = box_empty();
    for (size_t i = 0; i < p->bounded.count; i++)
        box_add(&b, &p->box[p->bounded.at[i]]);
    return b;
}

/* The cube around a box, with the same centre; it contains the box whatever the rounding. */
static accel_box cube_around(const accel_box *b)
{
    double side = 0.0;
    for (int k = 0; k < 3; k++)
        side = fmax(side, b->hi[k] - b->lo[k]);
    accel_box cube = *b;
    for (int k = 0; k < 3; k++) {
        const double middle = b->lo[k] + 0.5 * (b->hi[k] - b->lo[k]);
        cube.lo[k] = fmin(b->lo[k], middle - 0.5 * side);
        cube.hi[k] = fmax(b->hi[k], middle + 0.5 * side);
    }
    return cube;
}

static bool build(struct build *build)
{
    struct octree_kind *o = (struct octree_kind *)build->a;
    const struct primitives *p = &o->base.prims;
    const accel_box tight = scene_box(p);
    const accel_box root = o->base.option[ROOT] == 0 ? cube_around(&tight) : tight;
    const struct octree_rule rule = {o->base.option[LEAF], o->base.option[DEPTH]};
    build_phase(build, "octree");
    if (!octree_build(build, &o->pool, &o->tree, p->bounded.at, p->bounded.count, &root, rule, 0,
                      1))
        return false;
    octree_pool_trim(&o->base.memory, &o->pool);
    o->base.info.nodes = o->pool.nodes.count;
    o->base.info.leaves = o->pool.cells.count + 1 - o->pool.nodes.count;
    o->base.info.references = o->pool.refs.count;
    return true;
}

static void walk(const accel *a, struct query *q)
{
    const struct octree_kind *o = (const struct octree_kind *)a;
    octree_walk(&o->pool, &o->tree, q);
}

static bool validate(const accel *a, accel_error *error)
{
    const struct octree_kind *o = (const struct octree_kind *)a;
    return octree_validate(a, &o->pool, &o->tree, a->prims.bounded.at, a->prims.bounded.count,
                           error);
}

static void release(accel *a)
{
    struct octree_kind *o = (struct octree_kind *)a;
    octree_pool_free(&a->memory, &o->pool);
}

const struct accel_kind octree_kind = {
    .info = {.name = "octree",
             .summary = "one octree over the scene",
             .options = options,
             .option_count = sizeof options / sizeof *options},
    .size = sizeof(struct octree_kind),
    .build = build,
    .walk = walk,
    .validate = validate,
    .release = release,
};
