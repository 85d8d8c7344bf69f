/* SPDX-License-Identifier: Apache-2.0
 *
 * A binary tree of boxes and its walk, nearest child first: what the kinds hoo (over clusters) and
 * bvh (over primitives) are made of.
 *
 * Encoding: node 0 is the root; a node holds the boxes of its two children and what they are: an
 * inner node, or a leaf whose meaning is the kind's. Invariant: a child's box contains the padded
 * boxes of all primitives below it.
 */
#ifndef ACCEL_BOXTREE_H
#define ACCEL_BOXTREE_H

#include "query.h"

/* Builders keep every leaf at this depth or above it: the walk's stack holds one entry a level. */
enum { BOXTREE_MAX_DEPTH = 96 };

struct boxtree_child {
    uint32_t first; /* a leaf's content, or the number of an inner node */
    uint32_t count; /* 0: an inner node */
};

struct boxtree_node {
    accel_box box[2];
    struct boxtree_child child[2];
};

/* What a kind does with a leaf. */
typedef void boxtree_visit(const accel *a, struct query *q, struct boxtree_child leaf);

/* Visits every leaf whose box's S is not empty and does not begin after q->limit. Inlined with
 * `visit` known, so a leaf costs no indirect call. */
static inline void boxtree_walk(const accel *a, const struct boxtree_node *nodes, struct query *q,
                                boxtree_visit *visit)
{
    struct {
        double a; /* where S of the child begins */
        struct boxtree_child child;
    } stack[BOXTREE_MAX_DEPTH + 1];
    uint32_t depth = 0;
    struct boxtree_child at = {0, 0};
    for (;;) {
        if (at.count > 0) {
            visit(a, q, at);
            if (query_done(q))
                return;
        } else {
            const struct boxtree_node *node = &nodes[at.first];
            const struct interval s[2] = {query_box(q, &node->box[0]), query_box(q, &node->box[1])};
            const bool meets[2] = {query_meets(q, s[0]), query_meets(q, s[1])};
            q->nodes++;
            if (meets[0] && meets[1]) {
                const int second = s[0].a <= s[1].a;
                stack[depth].a = s[second].a;
                stack[depth++].child = node->child[second];
                at = node->child[!second];
                continue;
            }
            if (meets[0] || meets[1]) {
                at = node->child[meets[1]];
                continue;
            }
        }
        do {
            if (depth == 0)
                return;
            at = stack[--depth].child;
        } while (stack[depth].a > q->limit);
    }
}

#endif
