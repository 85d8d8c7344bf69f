/* SPDX-License-Identifier: Apache-2.0
 *
 * The walk of an octree, front to back: the top-down parametric one of Revelles, Urena and Lastra,
 * "An Efficient Parametric Algorithm for Octree Traversal", WSCG 2000, made exact: instead of
 * choosing one next child it visits every child whose grown interval is met, in the order that the
 * ray's signs give; planes are computed from coordinates, never by halving t.
 *
 * A cell's part of the ray begins at the greatest near crossing of its sides and ends at the least
 * far one. A child has those of its parent and, of the three planes between children, those it
 * touches: so a level needs two numbers for each child, made for all eight at once.
 *
 * For common rays (query.h) far crossings and the cap carry slack, all children are tested at once,
 * and nothing is grown: the proof there holds for any set of near and far planes, so for cells too.
 * Other rays are tested by S itself.
 */
#include "octree_deferred.h"
#include "../primitive/pair.h"

/* One level of the walk. Children in the order of the ray: place i is child i ^ sign. Near and far
 * are raw values of t; far ones with slack for common rays. */
struct level {
    double near[8], far[8];         /* where the ray enters and leaves each child */
    const struct octree_node *node; /* the cell's node */
    const struct octree_pool *pool; /* where that lies; not set in an eager tree */
    uint32_t left;                  /* children not yet visited */
};

/* Where the ray crosses a plane: the far half begins at `near`, the near half ends at `far`. */
struct crossing {
    double near, far;
};

/* For any ray. A half that a parallel ray is outside of begins at inf and ends at -inf. */
static struct crossing cross_any(const struct query *q, int k, double plane)
{
    const double inf = (double)INFINITY;
    if (q->parallel >> k & 1)
        return (struct crossing){q->org[k] >= plane ? -inf : inf, q->org[k] <= plane ? inf : -inf};
    const double t = (plane - q->org[k]) * q->inv[k];
    return (struct crossing){t, t};
}

static struct crossing cross_common(const struct query *q, int k, double plane)
{
    const double d = plane - q->org[k];
    return (struct crossing){d * q->inv[k], d * (q->inv[k] * (1.0 + QUERY_SLACK))};
}

/* Children in the order of the ray: bit i of the result is child i ^ sign. */
static inline uint32_t in_ray_order(uint32_t mask, uint32_t sign)
{
    if (sign & 1)
        mask = (mask & 0x55) << 1 | (mask >> 1 & 0x55);
    if (sign & 2)
        mask = (mask & 0x33) << 2 | (mask >> 2 & 0x33);
    if (sign & 4)
        mask = (mask & 0x0f) << 4 | mask >> 4;
    return mask;
}

/* May the part of the ray from raw `near` to `far` matter? */
static inline bool meets(const struct query *q, double near, double far, bool common)
{
    if (common)
        return near <= query_cap(q);
    return query_meets(q, query_interval(q, near, far));
}

/* Where each child begins and ends; a NaN (0 * inf) cuts nothing off. Returns those that are not
 * empty, as far as near and far tell. */
static inline uint32_t split(struct level *l, const struct crossing at[3], double near, double far)
{
    const double inf = (double)INFINITY;
    const pair near01 = pair_max(pair_of(-inf, at[0].near), pair_both(near));
    const pair near23 = pair_max(pair_both(at[1].near), near01);
    const pair near45 = pair_max(pair_both(at[2].near), near01);
    const pair near67 = pair_max(pair_both(at[2].near), near23);
    const pair far67 = pair_min(pair_of(at[0].far, inf), pair_both(far));
    const pair far45 = pair_min(pair_both(at[1].far), far67);
    const pair far23 = pair_min(pair_both(at[2].far), far67);
    const pair far01 = pair_min(pair_both(at[2].far), far45);
    pair_store(l->near, near01);
    pair_store(l->near + 2, near23);
    pair_store(l->near + 4, near45);
    pair_store(l->near + 6, near67);
    pair_store(l->far, far01);
    pair_store(l->far + 2, far23);
    pair_store(l->far + 4, far45);
    pair_store(l->far + 6, far67);
    return pair_at_most(near01, far01) | pair_at_most(near23, far23) << 2 |
           pair_at_most(near45, far45) << 4 | pair_at_most(near67, far67) << 6;
}

static inline void enter(struct query *q, struct level *l, const struct octree_node *node,
                         double near, double far, bool common)
{
    struct crossing at[3];
    q->nodes++;
    for (int k = 0; k < 3; k++)
        at[k] = common ? cross_common(q, k, node->plane[k]) : cross_any(q, k, node->plane[k]);
    const uint32_t met = split(l, at, near, far);
    l->node = node;
    l->left = in_ray_order(node->mask, q->sign) & (common ? met : 0xff);
}

static void test_leaf(const struct octree_pool *pool, struct query *q,
                      const struct octree_cell *cell)
{
    accel_query_test_list(q, pool->refs.at + cell->first, cell->count);
}

/* What a walk of a lazy tree must know; NULL stands for an eager one. */
struct growing {
    const struct octree_lazy *lazy;
    const accel_box *tree; /* the root's */
};

/* Goes into a part: *cell becomes its root, *pool what that lies in. False: there is no memory to
 * build it, and it has been tested as a list. */
static inline bool enter_part(const struct growing *growing, struct query *q,
                              struct octree_deferred *deferred, const struct octree_cell **cell,
                              const struct octree_pool **pool)
{
    const struct octree_part *part = octree_enter(growing->lazy, deferred, growing->tree);
    if (!part) {
        accel_query_test_list(q, deferred->ids, deferred->count);
        return false;
    }
    *cell = &part->root;
    *pool = &part->pool;
    return true;
}

/* Visits a node and all below it. Inlined with `common` known, and whether the tree is lazy. */
__attribute__((always_inline)) static inline void walk_nodes(const struct octree_pool *pool,
                                                             const struct growing *growing,
                                                             struct query *q, uint32_t root,
                                                             double near, double far, bool common)
{
    struct level stack[OCTREE_MAX_DEPTH + 1];
    struct level *top = stack;
    enter(q, top, octree_node_at(pool, root), near, far, common);
    if (growing)
        top->pool = pool;
    for (;;) {
        if (top->left == 0) {
            if (top == stack)
                return;
            top--;
            continue;
        }
        const uint32_t i = (uint32_t)__builtin_ctz(top->left);
        top->left &= top->left - 1;
        if (!meets(q, top->near[i], top->far[i], common))
            continue;
        const struct octree_cell *cell = octree_child(top->node, i ^ q->sign);
        if (growing) {
            pool = top->pool;
            if (cell->count == OCTREE_LATER &&
                !enter_part(growing, q, &pool->deferred.at[cell->first], &cell, &pool)) {
                if (query_done(q))
                    return;
                continue;
            }
        }
        if (cell->count > 0) {
            test_leaf(pool, q, cell);
            if (query_done(q))
                return;
        } else {
            top++;
            enter(q, top, octree_node_at(pool, cell->first), top[-1].near[i], top[-1].far[i],
                  common);
            if (growing)
                top->pool = pool;
        }
    }
}

/* The part of the ray inside a box, as raw values of t. */
static void cross_box(const struct query *q, const accel_box *box, bool common, double *near,
                      double *far)
{
    for (int k = 0; k < 3; k++) {
        const bool negative = q->sign >> k & 1;
        const double first = negative ? box->hi[k] : box->lo[k];
        const double last = negative ? box->lo[k] : box->hi[k];
        const double a = (common ? cross_common(q, k, first) : cross_any(q, k, first)).near;
        const double z = (common ? cross_common(q, k, last) : cross_any(q, k, last)).far;
        *near = a > *near ? a : *near;
        *far = z < *far ? z : *far;
    }
}

/* Does the ray meet the root's box? Then *near to *far is its part inside. */
static inline bool meets_root(const struct query *q, const accel_box *box, bool common,
                              double *near, double *far)
{
    *near = common ? q->begin : -(double)INFINITY;
    *far = common ? query_cap(q) : (double)INFINITY;
    cross_box(q, box, common, near, far);
    /* Raw ends without slack tell nothing before they are grown. */
    return (!common || *near <= *far) && meets(q, *near, *far, common);
}

__attribute__((always_inline)) static inline void
walk_as(const struct octree_pool *pool, const struct octree *tree, struct query *q, bool common)
{
    double near, far;
    if (!meets_root(q, &tree->box, common, &near, &far))
        return;
    if (tree->root.count > 0)
        test_leaf(pool, q, &tree->root);
    else
        walk_nodes(pool, NULL, q, tree->root.first, near, far, common);
}

__attribute__((always_inline)) static inline void walk_lazy_as(const struct octree_lazy *lazy,
                                                               struct octree_deferred *tree,
                                                               struct query *q, bool common)
{
    const struct growing growing = {lazy, &tree->box};
    const struct octree_cell *root;
    const struct octree_pool *pool;
    double near, far;
    if (!meets_root(q, &tree->box, common, &near, &far) ||
        !enter_part(&growing, q, tree, &root, &pool))
        return;
    if (root->count > 0)
        test_leaf(pool, q, root);
    else
        walk_nodes(pool, &growing, q, root->first, near, far, common);
}

void accel_octree_walk(const struct octree_pool *pool, const struct octree *tree, struct query *q)
{
    if (query_common(q))
        walk_as(pool, tree, q, true);
    else
        walk_as(pool, tree, q, false);
}

void accel_octree_walk_lazy(const struct octree_lazy *lazy, struct octree_deferred *tree,
                            struct query *q)
{
    if (query_common(q))
        walk_lazy_as(lazy, tree, q, true);
    else
        walk_lazy_as(lazy, tree, q, false);
}
