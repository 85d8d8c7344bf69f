/* SPDX-License-Identifier: Apache-2.0
 *
 * The walks of an instruction set, included by its file after
 *     struct node_ray, node_ray_from(ray, limit), node_ray_limit(&n, limit), node_meets(&n, node,
 *     &begins): the children that may matter as bits, and where they begin; begins_store(&begins,
 *     out): the bits of these floats, of those that matter;
 *     push_children(top, meets, node): puts their words on a stack in order, and may write WIDE
 *     words; returns its new top;
 *     leaf_test(f, block, any): tests a block of triangles; true if the best hit became better.
 * Included once for each set: every function here is static.
 */
#include "wide_isa.h"

/* A child that waits, nearer ones with smaller numbers: where it begins, which is never negative,
 * as the bits of a float, and its word. */
typedef uint64_t waiting;

static inline waiting waiting_of(uint32_t begin, uint32_t word)
{
    return (waiting)begin << 32 | word;
}

static inline uint32_t bits_of(float limit)
{
    uint32_t bits;
    memcpy(&bits, &limit, sizeof bits);
    return bits;
}

static inline uint32_t next_child(uint32_t *meets)
{
    const uint32_t i = (uint32_t)__builtin_ctz(*meets);
    *meets &= *meets - 1;
    return i;
}

/* Without branches, whatever the compiler makes of a choice of the nearer. */
static inline void order(waiting *near, waiting *far)
{
    const waiting differ = (*near ^ *far) & (0 - (waiting)(*far < *near));
    *near ^= differ;
    *far ^= differ;
}

/* Sorts what stands from `bottom`, farthest first. */
static inline void sort_waiting(waiting *bottom, const waiting *top)
{
    for (waiting *at = bottom + 1; at < top; at++) {
        const waiting moved = *at;
        waiting *to = at;
        for (; to > bottom && to[-1] < moved; to--)
            *to = to[-1];
        *to = moved;
    }
}

/* Asks for the memory of what is visited soon. */
static inline void prefetch(const struct wide *w, uint32_t word)
{
    const unsigned char *at = w->base + 16 * (size_t)(word & ~WIDE_LEAF);
    __builtin_prefetch(at);
    __builtin_prefetch(at + 64);
}

/* Stacks all children that are met but the nearest, which it returns; meets is not 0. */
__attribute__((always_inline)) static inline uint32_t descend(const struct wide *w,
                                                              const struct wide_node *node,
                                                              uint32_t meets, const begins *where,
                                                              waiting **top)
{
    _Alignas(64) uint32_t begin[WIDE];
    uint32_t i = next_child(&meets);
    prefetch(w, node->child[i]);
    if (meets == 0)
        return node->child[i];
    begins_store(where, begin);
    waiting near = waiting_of(begin[i], node->child[i]);
    i = next_child(&meets);
    prefetch(w, node->child[i]);
    waiting far = waiting_of(begin[i], node->child[i]);
    order(&near, &far);
    if (meets == 0) {
        *(*top)++ = far;
        return (uint32_t)near;
    }
    i = next_child(&meets);
    prefetch(w, node->child[i]);
    waiting farthest = waiting_of(begin[i], node->child[i]);
    order(&far, &farthest);
    order(&near, &far);
    waiting *bottom = *top;
    bottom[0] = farthest;
    bottom[1] = far;
    if (meets == 0) {
        *top += 2;
        return (uint32_t)near;
    }
    bottom[2] = near;
    *top += 3;
    while (meets != 0) {
        i = next_child(&meets);
        prefetch(w, node->child[i]);
        *(*top)++ = waiting_of(begin[i], node->child[i]);
    }
    sort_waiting(bottom, *top);
    return (uint32_t) * --*top;
}

/* Things without bounds come first: they may set the limit. */
static inline bool begin_fast(struct wide_fast *f, const accel *a, const struct wide *w,
                              const accel_ray *ray, accel_query *counters, bool any)
{
    if (!wide_ray_from(&f->ray, w, ray->org, ray->dir, ray->tmin) || isnan(ray->tmax))
        return false;
    f->a = a;
    f->caller = ray;
    f->tmin = ray->tmin;
    f->tmax = ray->tmax;
    f->skip = primitives_id(&a->prims, ray->skip);
    f->best = f->t = (double)INFINITY;
    f->u = f->v = 0.0;
    f->weights = 1.0;
    f->id = ACCEL_NONE;
    f->counters = counters;
    f->prepared = f->comes_to_leaves = false;
    f->nodes = f->tests = 0;
    const size_t unbounded = a->prims.unbounded.count;
    if (__builtin_expect(unbounded > 0, 0)) {
        f->tests += unbounded;
        accel_wide_test_list(f, a->prims.unbounded.at, unbounded, any);
    }
    return true;
}

static inline void end_fast(const struct wide_fast *f)
{
    if (!f->counters)
        return;
    f->counters->nodes += f->nodes;
    f->counters->tests += f->tests;
    f->counters->outside += f->prepared ? f->q.outside : 0;
}

/* A leaf's blocks. True if the best hit became better. */
__attribute__((always_inline)) static inline bool test_blocks(struct wide_fast *f,
                                                              const struct wide_block *b, bool any)
{
    bool better = false;
    for (;; b = wide_next_block(b)) {
        f->tests += b->count;
        if (__builtin_expect(b->type == WIDE_LIST, 0)) {
            better |= accel_wide_test_list(f, wide_block_ids(b), b->count, any);
        } else {
            if (!f->comes_to_leaves) {
                leaf_ray_from(&f->leaf, f->caller);
                f->comes_to_leaves = true;
            }
            better |= leaf_test(f, b, any);
        }
        if (b->last || (any && better))
            return better;
    }
}

__attribute__((always_inline)) static inline enum wide_answer
walk_closest(const accel *a, const struct wide *w, const accel_ray *ray, accel_query *counters,
             struct wide_fast *f)
{
    waiting stack[WIDE_MAX_DEPTH * (WIDE - 1) + 2], *top = stack;
    if (!begin_fast(f, a, w, ray, counters, false))
        return WIDE_NOT_HANDLED;
    float limit = wide_limit(&f->ray, f->best < f->tmax ? f->best : f->tmax);
    struct node_ray n = node_ray_from(&f->ray, limit);
    uint32_t word = w->root;
    for (;;) {
        while (!(word & WIDE_LEAF)) {
            const struct wide_node *node = wide_node_at(w, word);
            begins begin;
            const uint32_t meets = node_meets(&n, node, &begin);
            f->nodes++;
            if (meets == 0)
                goto next;
            word = descend(w, node, meets, &begin, &top);
        }
        if (test_blocks(f, wide_leaf_at(w, word), false)) {
            limit = wide_limit(&f->ray, f->best < f->tmax ? f->best : f->tmax);
            node_ray_limit(&n, limit);
        }
    next:
        do {
            if (top == stack)
                return f->id != ACCEL_NONE ? WIDE_HIT : WIDE_MISSED;
            word = (uint32_t) * --top;
        } while (*top >> 32 > bits_of(limit));
    }
}

/* Any hit: no order but that of the children, whose last one is taken first; the limit stays. At
 * the bottom of the stack lies a word that is never taken, so that there is always one to fetch.
 */
__attribute__((always_inline)) static inline enum wide_answer
walk_any(const accel *a, const struct wide *w, const accel_ray *ray, accel_query *counters,
         struct wide_fast *f)
{
    uint32_t stack[WIDE_MAX_DEPTH * (WIDE - 1) + WIDE + 1], *top = stack, word = w->root;
    if (!begin_fast(f, a, w, ray, counters, true))
        return WIDE_NOT_HANDLED;
    if (__builtin_expect(f->id != ACCEL_NONE, 0))
        return WIDE_HIT;
    const struct node_ray n = node_ray_from(&f->ray, wide_limit(&f->ray, f->tmax));
    *top++ = word;
    for (;;) {
        while (!(word & WIDE_LEAF)) {
            const struct wide_node *node = wide_node_at(w, word);
            begins begin;
            const uint32_t meets = node_meets(&n, node, &begin);
            f->nodes++;
            if (meets == 0)
                goto next;
            const uint32_t last = 31 - (uint32_t)__builtin_clz(meets);
            word = node->child[last];
            prefetch(w, word);
            top = push_children(top, meets ^ 1u << last, node);
            prefetch(w, top[-1]);
        }
        if (test_blocks(f, wide_leaf_at(w, word), true))
            return WIDE_HIT;
    next:
        word = *--top;
        if (top == stack)
            return WIDE_MISSED;
    }
}

/* The best hit, as the caller sees it. */
static inline accel_hit hit_of(const struct wide_fast *f)
{
    const accel_id name = primitives_name(&f->a->prims, f->id);
    return (accel_hit){f->t, f->u / f->weights, f->v / f->weights, name.geom, name.prim};
}

static enum wide_answer closest(const accel *a, const struct wide *w, const accel_ray *ray,
                                accel_hit *hit, accel_query *counters)
{
    struct wide_fast f;
    const enum wide_answer answer = walk_closest(a, w, ray, counters, &f);
    if (answer == WIDE_NOT_HANDLED)
        return answer;
    end_fast(&f);
    if (answer == WIDE_HIT && hit)
        *hit = hit_of(&f);
    return answer;
}

static enum wide_answer any(const accel *a, const struct wide *w, const accel_ray *ray,
                            accel_query *counters)
{
    struct wide_fast f;
    const enum wide_answer answer = walk_any(a, w, ray, counters, &f);
    if (answer != WIDE_NOT_HANDLED)
        end_fast(&f);
    return answer;
}

/* Where what matters to a query ends. */
static inline float query_end(const struct wide_ray *r, const struct query *q)
{
    return wide_limit(r, q->limit < q->tmax ? q->limit : q->tmax);
}

static bool walk(const struct wide *w, struct query *q)
{
    waiting stack[WIDE_MAX_DEPTH * (WIDE - 1) + 2], *top = stack;
    struct wide_ray ray;
    if (q->point || !wide_ray_from(&ray, w, q->org, q->dir, q->begin))
        return false;
    float limit = query_end(&ray, q);
    struct node_ray n = node_ray_from(&ray, limit);
    uint32_t word = w->root;
    for (;;) {
        while (!(word & WIDE_LEAF)) {
            const struct wide_node *node = wide_node_at(w, word);
            begins begin;
            const uint32_t meets = node_meets(&n, node, &begin);
            q->nodes++;
            if (meets == 0)
                goto next;
            word = descend(w, node, meets, &begin, &top);
        }
        accel_wide_test_leaf(w, q, word);
        if (query_done(q))
            return true;
        limit = query_end(&ray, q);
        node_ray_limit(&n, limit);
    next:
        do {
            if (top == stack)
                return true;
            word = (uint32_t) * --top;
        } while (*top >> 32 > bits_of(limit));
    }
}
