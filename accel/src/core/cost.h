/* SPDX-License-Identifier: Apache-2.0
 *
 * What things cost, in nanoseconds where all is in the cache: the one table that the builders and
 * `auto` read. Builders compare costs with each other, so only ratios matter to them.
 *
 * The figures of the kinds are refitted by scenes/costs.sh, which prints new lines for this file;
 * those of the builders were measured by hand, each around its best value: the times of teapots,
 * armadillo, spheres and cubes lie within a few percent from half to twice the ratios below.
 */
#ifndef ACCEL_COST_H
#define ACCEL_COST_H

/* How a kind's nodes per ray grow with the primitives. */
enum kind_growth { GROWS_LIKE_LOG, GROWS_LIKE_FIFTH_ROOT, GROWS_LIKE_N };

/* What a kind costs, for `auto`. Fitted to the counts and times that `accel bench` prints. */
struct kind_cost {
    double build;    /* per primitive and level, n * log2 n in all */
    double ray;      /* per ray, before the first node */
    double node;     /* per node or cell visited */
    double triangle; /* per triangle tested */
    double other;    /* per other primitive tested; of an object, until its callback is called */
    enum kind_growth growth;
};

/* Of the kinds, in the order above. octree, hoo and bvh walk the same kind of tree: rays cost the
 * same in them, nodes and tests only differ in number. */
/* clang-format off */
#define COST_LINEAR {  0, 250,  0, 22.0, 16.0, GROWS_LIKE_N}
#define COST_GRID   { 20, 150, 42, 19.5, 55.0, GROWS_LIKE_FIFTH_ROOT}
#define COST_HUG    { 45, 150, 42, 19.5, 55.0, GROWS_LIKE_FIFTH_ROOT}
#define COST_OCTREE { 90,  19, 26, 15.7, 33.0, GROWS_LIKE_LOG}
#define COST_HOO    { 65,  19, 26, 15.7, 33.0, GROWS_LIKE_LOG}
#define COST_BSP    {160,  89, 20, 16.5, 47.0, GROWS_LIKE_LOG}
#define COST_BVH    { 80,  19, 26, 15.7, 33.0, GROWS_LIKE_LOG}
/* clang-format on */

/* A call of a host's object, if the host does not say. */
#define COST_CALL 100.0

/* A node of a kd-tree; a test by type, of an object without its callback, in whatever has its
 * primitives one by one: see primitives.test_cost. */
#define COST_NODE     16.0
#define COST_TRIANGLE 6.4
#define COST_SPHERE   24.0
#define COST_OBJECT   96.0

/* The classic octree: a node, a leaf apart from its tests, and a test where there are only
 * triangles, which are tested in twos. */
#define COST_OCTREE_NODE     80.0
#define COST_OCTREE_LEAF     80.0
#define COST_OCTREE_TRIANGLE 16.0

/* Grids: to begin with one, a step from cell to cell, a reference found in the mailbox, an item
 * that is a grid itself. */
#define COST_GRID_BEGIN   400.0
#define COST_GRID_STEP    6.4
#define COST_GRID_MAILBOX 1.6
#define COST_GRID_ITEM    480.0

/* Wide trees: a leaf beside its tests; triangles, or spheres, in all lanes; an object, which has
 * none beside it, as its box is asked and then its host; a node by instruction set. */
#define COST_WIDE_LEAF      4.8f
#define COST_WIDE_TRIANGLES 16.0f
#define COST_WIDE_SPHERES   16.0f
#define COST_WIDE_OBJECT    64.0f
#define COST_WIDE_NODE      16.0f /* of vectors */
#define COST_WIDE_PORTABLE  32.0f

#endif
