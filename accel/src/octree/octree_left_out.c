/* SPDX-License-Identifier: Apache-2.0
 *
 * What octrees do without, counted after the build: children that hold nothing are in no node, and
 * a tree of few primitives is a list.
 */
#include "octree.h"

size_t accel_octree_pool_bytes(const struct octree_pool *pool)
{
    return pool->words.count * sizeof *pool->words.at + pool->refs.count * sizeof *pool->refs.at;
}

/* Children that a node would have if all were stored: an axis that is left whole has no halves. */
static uint32_t possible_children(const struct octree_node *node)
{
    uint32_t children = 1;
    for (int k = 0; k < 3; k++)
        children *= isinf(node->plane[k]) ? 1 : 2;
    return children;
}

void accel_octree_note_empty(struct build *build, const struct octree_pool *pool)
{
    size_t empty = 0, stored = 0;
    for (size_t word = 0; word < pool->words.count;) {
        const struct octree_node *node = octree_node_at(pool, (uint32_t)word);
        const uint32_t children = octree_bits(node->mask);
        empty += possible_children(node) - children;
        stored += children;
        word += octree_words(children);
    }
    if (empty > 0)
        accel_build_left_out(build, empty * sizeof(struct octree_cell),
                             accel_octree_pool_bytes(pool),
                             "%zu of %zu cells are empty: not stored", empty, empty + stored);
}

void accel_octree_note_lists(struct build *build, const struct octree_pool *pool,
                             const struct octree *trees, size_t count)
{
    size_t lists = 0, bytes = 0;
    for (size_t i = 0; i < count; i++) {
        const uint32_t refs = trees[i].root.count;
        lists += refs > 0;
        bytes += refs > 0 ? octree_words(refs < 8 ? refs : 8) * sizeof(uint64_t) : 0;
    }
    const size_t made = accel_octree_pool_bytes(pool);
    if (lists > 0 && count == 1)
        accel_build_left_out(build, bytes, made, "few primitives: a list, no octree");
    else if (lists > 0)
        accel_build_left_out(build, bytes, made, "%zu of %zu clusters are short: lists, no octrees",
                             lists, count);
}
