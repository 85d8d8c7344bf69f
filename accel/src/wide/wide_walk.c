/* SPDX-License-Identifier: Apache-2.0
 *
 * The walk of any query on any ray: S of every child by the rule of query.h, in double. The fast
 * walks are judged by it, and leave to it what they do not serve.
 */
#include "wide_split.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "../core/box.h"
#include "../core/environment.h"
#include "../primitive/triangle.h"

void accel_wide_vertices(const struct wide_block *b, unsigned i, double out[9])
{
    const void *data = wide_block_data(b);
    const bool pool = b->type <= WIDE_POOL_DOUBLES;
    const bool doubles = b->type == WIDE_POOL_DOUBLES || b->type == WIDE_DOUBLES;
    const size_t size = doubles ? sizeof(double) : sizeof(float);
    const uint8_t *corner = (const uint8_t *)data + 3 * size * b->vertices;
    for (unsigned c = 0; c < 9; c++) {
        const unsigned place =
            pool ? c % 3 * b->vertices + corner[c / 3 * WIDE_BLOCK + i] : c * b->count + i;
        out[c] = doubles ? ((const double *)data)[place] : (double)((const float *)data)[place];
    }
}

/* Is the environment one in which sums have the bits that they have in the default one? */
static bool is_plain(void)
{
#if defined(__SSE2__)
    return (_mm_getcsr() & 0xe040) == 0; /* rounding, flushing results, flushing operands */
#else
    return false;
#endif
}

/* Not inlined, so that it stays between two changes of the environment. */
__attribute__((noinline)) static void make_box(const double *vertices, accel_box *out)
{
    accel_box box = box_empty();
    for (int corner = 0; corner < 3; corner++)
        box_add_point(&box, vertices + 3 * corner);
    *out = box_padded(&box);
}

accel_box accel_wide_triangle_box(const struct wide_block *b, unsigned i)
{
    double vertices[9];
    accel_box box;
    accel_wide_vertices(b, i, vertices);
    if (is_plain()) {
        make_box(vertices, &box);
        return box;
    }
    const fenv_t callers = environment_enter();
    make_box(vertices, &box);
    environment_leave(&callers);
    return box;
}

static bool find_in_leaf(const struct wide_block *b, uint32_t id, accel_box *box)
{
    for (;; b = wide_next_block(b)) {
        for (unsigned i = 0; i < b->count; i++) {
            if (wide_block_ids(b)[i] == id) {
                *box = accel_wide_triangle_box(b, i);
                return true;
            }
        }
        if (b->last)
            return false;
    }
}

static bool find_below(const struct wide *w, uint32_t word, uint32_t id, accel_box *box)
{
    if (word & WIDE_LEAF)
        return find_in_leaf(wide_leaf_at(w, word), id, box);
    const struct wide_node *node = wide_node_at(w, word);
    for (int i = 0; i < WIDE && node->plane[0][0][i] <= node->plane[0][1][i]; i++)
        if (find_below(w, node->child[i], id, box))
            return true;
    return false;
}

bool accel_wide_find_box(const struct wide *w, uint32_t id, accel_box *box)
{
    return find_below(w, w->root, id, box);
}

static void test_triangle(struct query *q, const struct wide_block *b, unsigned i, uint32_t id)
{
    double vertices[9], t, u, v;
    q->tests++;
    accel_wide_vertices(b, i, vertices);
    if (!q->point && !accel_triangle_hit(q, vertices, &t, &u, &v))
        return;
    const accel_box box = accel_wide_triangle_box(b, i);
    if (q->point)
        accel_query_offer_point(q, &box, id);
    else
        accel_query_offer(q, &box, id, t, u, v);
}

static void test_triangles(struct query *q, const struct wide_block *b)
{
    const uint32_t *ids = wide_block_ids(b);
    for (unsigned i = 0; i < b->count && !query_done(q); i++)
        if (ids[i] != q->skip && query_may_matter(q, ids[i]))
            test_triangle(q, b, i, ids[i]);
}

void accel_wide_test_leaf(const struct wide *w, struct query *q, uint32_t word)
{
    const struct wide_block *b = wide_leaf_at(w, word);
    for (;; b = wide_next_block(b)) {
        if (b->type >= WIDE_SPHERES)
            accel_query_test_once(q, wide_block_ids(b), b->count);
        else
            test_triangles(q, b);
        if (b->last || query_done(q))
            return;
    }
}

static accel_box child_box(const struct wide *w, const struct wide_node *node, int i, double growth)
{
    accel_box box;
    for (int k = 0; k < 3; k++) {
        box.lo[k] = (double)node->plane[k][0][i] / w->scale - growth;
        box.hi[k] = (double)node->plane[k][1][i] / w->scale + growth;
    }
    return box;
}

/* A child that waits. */
struct waiting {
    double begin;
    uint32_t word;
};

/* Puts the children that may matter on the stack, nearest last. */
static struct waiting *push(const struct wide *w, const struct wide_node *node, struct query *q,
                            double growth, struct waiting *top)
{
    struct waiting *bottom = top;
    for (int i = 0; i < WIDE && node->plane[0][0][i] <= node->plane[0][1][i]; i++) {
        const accel_box box = child_box(w, node, i, growth);
        const struct interval s = query_box(q, &box);
        if (!query_meets(q, s))
            continue;
        struct waiting *at = top++;
        for (; at > bottom && at[-1].begin < s.a; at--)
            *at = at[-1];
        *at = (struct waiting){s.a, node->child[i]};
    }
    return top;
}

void accel_wide_walk(const struct wide *w, struct query *q)
{
    struct waiting stack[WIDE_MAX_DEPTH * (WIDE - 1) + 2], *top = stack;
    const double growth = accel_wide_split_growth(w, q);
    *top++ = (struct waiting){-(double)INFINITY, w->root};
    while (top > stack && !query_done(q)) {
        const struct waiting at = *--top;
        if (at.begin > q->limit)
            continue;
        if (at.word & WIDE_LEAF) {
            accel_wide_test_leaf(w, q, at.word);
            continue;
        }
        q->nodes++;
        top = push(w, wide_node_at(w, at.word), q, growth, top);
    }
}
