/* SPDX-License-Identifier: Apache-2.0
 *
 * A binary tree of boxes and its walk, nearest child first: what hoo's classic form puts over its
 * clusters. The wide form has one tree for all (wide/wide.h).
 *
 * Encoding: node 0 is the root; a node holds the boxes of its two children, axis by axis and side
 * by side, and what they are: an inner node, or a leaf whose meaning is the kind's. Invariant: a
 * child's box contains the padded boxes of all primitives below it.
 *
 * For common rays (query.h) both boxes are tested at once, with slack; for the others, S of each.
 */
#ifndef ACCEL_BOXTREE_H
#define ACCEL_BOXTREE_H

#include "../primitive/pair.h"
#include "../primitive/query.h"

/* Builders keep every leaf at this depth or above it: the walk's stack holds one entry a level. */
enum { BOXTREE_MAX_DEPTH = 96 };

struct boxtree_child {
    uint32_t first; /* a leaf's content, or the number of an inner node */
    uint32_t count; /* 0: an inner node */
};

struct boxtree_node {
    double plane[3][4]; /* by axis: the lower sides of both boxes, then the upper sides */
    struct boxtree_child child[2];
};

static inline void boxtree_set(struct boxtree_node *node, int i, const accel_box *box,
                               struct boxtree_child child)
{
    for (int k = 0; k < 3; k++) {
        node->plane[k][i] = box->lo[k];
        node->plane[k][2 + i] = box->hi[k];
    }
    node->child[i] = child;
}

static inline accel_box boxtree_box(const struct boxtree_node *node, int i)
{
    accel_box box;
    for (int k = 0; k < 3; k++) {
        box.lo[k] = node->plane[k][i];
        box.hi[k] = node->plane[k][2 + i];
    }
    return box;
}

/* The ray, twice side by side, for testing both boxes at once. */
struct boxtree_ray {
    pair org[3], inv[3];
    pair inv_far[3]; /* inv with slack */
    pair begin, cap; /* cap: where a box may begin at most, with slack */
    int near[3];     /* where in a node's planes the near ones of each axis stand: 0 or 2 */
};

static inline struct boxtree_ray boxtree_ray_from(const struct query *q)
{
    struct boxtree_ray r;
    for (int k = 0; k < 3; k++) {
        r.org[k] = pair_both(q->org[k]);
        r.inv[k] = pair_both(q->inv[k]);
        r.inv_far[k] = pair_both(q->inv[k] * (1.0 + QUERY_SLACK));
        r.near[k] = q->sign >> k & 1 ? 2 : 0;
    }
    r.begin = pair_both(q->begin);
    r.cap = pair_both(query_cap(q));
    return r;
}

/* Which children to visit, as bits, and where they begin. */
static inline uint32_t boxtree_meets(const struct boxtree_ray *r, const struct boxtree_node *node,
                                     double begin[2])
{
    pair a = r->begin, z = r->cap;
    for (int k = 0; k < 3; k++) {
        const pair near = pair_load(node->plane[k] + r->near[k]);
        const pair far = pair_load(node->plane[k] + 2 - r->near[k]);
        a = pair_max(pair_mul(pair_sub(near, r->org[k]), r->inv[k]), a);
        z = pair_min(pair_mul(pair_sub(far, r->org[k]), r->inv_far[k]), z);
    }
    pair_store(begin, a);
    return pair_at_most(a, z);
}

/* The same for any ray. */
static inline uint32_t boxtree_meets_any(const struct query *q, const struct boxtree_node *node,
                                         double begin[2])
{
    uint32_t meets = 0;
    for (int i = 0; i < 2; i++) {
        const accel_box box = boxtree_box(node, i);
        const struct interval s = query_box(q, &box);
        begin[i] = s.a;
        meets |= (uint32_t)query_meets(q, s) << i;
    }
    return meets;
}

/* What a kind does with a leaf. */
typedef void boxtree_visit(const accel *a, struct query *q, struct boxtree_child leaf);

/* The walk of either sort of ray. Inlined with `visit` and `common` known, so a leaf costs no
 * indirect call. */
__attribute__((always_inline)) static inline void boxtree_walk_as(const accel *a,
                                                                  const struct boxtree_node *nodes,
                                                                  struct query *q,
                                                                  boxtree_visit *visit, bool common)
{
    struct {
        double begin;
        struct boxtree_child child;
    } stack[BOXTREE_MAX_DEPTH + 1];
    uint32_t depth = 0;
    struct boxtree_ray ray = boxtree_ray_from(q);
    struct boxtree_child at = {0, 0};
    for (;;) {
        if (at.count > 0) {
            visit(a, q, at);
            if (query_done(q))
                return;
            ray.cap = pair_both(query_cap(q));
        } else {
            const struct boxtree_node *node = &nodes[at.first];
            double begin[2];
            const uint32_t meets =
                common ? boxtree_meets(&ray, node, begin) : boxtree_meets_any(q, node, begin);
            q->nodes++;
            /* No branch tells one child from two: it would be taken at random. */
            const uint32_t first = meets == 3 ? begin[1] < begin[0] : meets >> 1;
            stack[depth].begin = begin[first ^ 1];
            stack[depth].child = node->child[first ^ 1];
            depth += meets == 3;
            if (meets) {
                at = node->child[first];
                continue;
            }
        }
        do {
            if (depth == 0)
                return;
            at = stack[--depth].child;
        } while (stack[depth].begin > (common ? query_cap(q) : q->limit));
    }
}

/* Visits every leaf whose box may hold a hit: S is not empty and does not begin after q->limit. */
static inline void boxtree_walk(const accel *a, const struct boxtree_node *nodes, struct query *q,
                                boxtree_visit *visit)
{
    if (query_common(q))
        boxtree_walk_as(a, nodes, q, visit, true);
    else
        boxtree_walk_as(a, nodes, q, visit, false);
}

#endif
