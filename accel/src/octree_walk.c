/* SPDX-License-Identifier: Apache-2.0
 *
 * Walking an octree front to back.
 *
 * The walk is the top-down parametric one of Revelles, Urena and Lastra, "An Efficient Parametric
 * Algorithm for Octree Traversal", WSCG 2000, made exact: instead of choosing one next child it
 * visits every child whose grown interval is met, in the order that the ray's signs give; planes
 * are computed from coordinates, never by halving t.
 */
#include "octree.h"

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
