/* SPDX-License-Identifier: Apache-2.0
 *
 * What the walks of all instruction sets share: the list of them, and the whole rule for what the
 * lanes cannot decide.
 */
#include "wide_isa.h"

#include "../core/box.h"
#include "../primitive/sphere.h"
#include "../primitive/triangle.h"

#if defined(__x86_64__) && defined(__GNUC__)
#define X86 1
extern const struct wide_isa accel_wide_avx512, accel_wide_avx2;
#endif

const struct wide_isa *const accel_wide_isas[] = {
#if defined(X86)
    &accel_wide_avx512, &accel_wide_avx2,
#endif
    &accel_wide_portable, NULL};

/* The query of the general test (query.h), with the best hit so far. */
static struct query *prepare(struct wide_fast *f)
{
    struct query *q = &f->q;
    if (!f->prepared) {
        accel_query_prepare(q, f->a, f->caller);
        q->caller = f->counters;
        q->found = &f->found;
        q->capacity = 1;
        f->prepared = true;
    }
    q->count = f->id != ACCEL_NONE;
    q->limit = f->best;
    q->end = f->id;
    f->found = (struct found){f->best, f->t, 0.0, 0.0, f->id}; /* take_over keeps u and v */
    return q;
}

/* Takes over what the query found. True if that is better. */
static bool take_over(struct wide_fast *f)
{
    const struct found *found = &f->found;
    if (f->q.count == 0 || (found->id == f->id && found->key == f->best))
        return false;
    f->best = found->key;
    f->t = found->t;
    f->u = found->u;
    f->v = found->v;
    f->weights = 1.0;
    f->id = found->id;
    return true;
}

static void test_triangle(struct query *q, const struct wide_block *b, unsigned i)
{
    double vertices[9], t, u, v;
    accel_wide_vertices(b, i, vertices);
    if (!accel_triangle_hit(q, vertices, &t, &u, &v))
        return;
    const accel_box box = accel_wide_triangle_box(b, i);
    accel_query_offer(q, &box, wide_block_ids(b)[i], t, u, v);
}

static void test_sphere(struct query *q, const struct wide_block *b, unsigned i)
{
    const uint32_t id = wide_block_ids(b)[i];
    double sphere[4], t[2];
    wide_sphere(b, i, sphere);
    const int roots = accel_sphere_hits(q, sphere, id == q->skip, t);
    for (int j = 0; j < roots; j++)
        accel_query_offer(q, &q->prims->box[id], id, t[j], 0.0, 0.0);
}

bool accel_wide_test_slowly(struct wide_fast *f, const struct wide_block *b, unsigned i)
{
    struct query *q = prepare(f);
    if (b->type >= WIDE_SPHERES)
        test_sphere(q, b, i);
    else if (wide_block_ids(b)[i] != f->skip)
        test_triangle(q, b, i);
    return take_over(f);
}

bool accel_wide_test_list(struct wide_fast *f, const uint32_t *ids, size_t count, bool any)
{
    struct query *q = prepare(f);
    q->any = any;
    accel_query_test_once(q, ids, count);
    return take_over(f);
}
