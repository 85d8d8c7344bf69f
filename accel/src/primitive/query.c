/* SPDX-License-Identifier: Apache-2.0
 *
 * Testing one primitive against one query, and keeping the first hits.
 */
#include "query.h"

#include "sphere.h"
#include "triangle.h"

#include <string.h>

/* A probe as the library sees it. The public part, and so each copy of it, leads back here. */
struct probing {
    accel_probe probe;
    struct query *q;
    struct interval s; /* S of the object's padded box */
    accel_order order; /* how its hits are ordered */
    uint32_t id;       /* the object */
};

static bool before(double key, uint32_t id, const struct found *other)
{
    return key < other->key || (key == other->key && id < other->id);
}

static bool after(double key, uint32_t id, const struct found *other)
{
    return key > other->key || (key == other->key && id > other->id);
}

/* The place in q->order of the first hit that is not before this one. */
static uint32_t place_of(const struct query *q, const struct found *hit)
{
    uint32_t lo = 0, hi = q->count;
    while (lo < hi) {
        const uint32_t middle = (lo + hi) / 2;
        if (after(hit->key, hit->id, &q->found[q->order[middle]]))
            lo = middle + 1;
        else
            hi = middle;
    }
    return lo;
}

/* What is not before this hit cannot matter. */
static void set_limit(struct query *q, const struct found *last)
{
    q->limit = last->key;
    q->end = last->id;
}

/* Of a query for one hit: keeps the first. */
static bool keep_first(struct query *q, const struct found *hit)
{
    if (q->count > 0 && !before(hit->key, hit->id, &q->found[0]))
        return false;
    q->count = 1;
    q->found[0] = *hit;
    if (q->any)
        q->limit = -(double)INFINITY;
    else
        set_limit(q, hit);
    return true;
}

/* Keeps a hit if it is among the first `room`, in place of the last if there are that many. A hit
 * that is there already is not kept again, so a primitive may be tested any number of times. */
static bool keep(struct query *q, const struct found *hit)
{
    if (q->capacity == 1)
        return keep_first(q, hit);
    if (q->batch && !after(hit->key, hit->id, &q->last))
        return false;
    if (q->pile && hit->key != q->last.key)
        return false;
    const bool full = q->count == q->capacity;
    if (full && !before(hit->key, hit->id, &q->found[q->order[q->count - 1]]))
        return false;
    const uint32_t at = place_of(q, hit);
    if (at < q->count && !before(hit->key, hit->id, &q->found[q->order[at]]))
        return false;
    const uint16_t to = full ? q->order[q->count - 1] : (uint16_t)q->count++;
    memmove(&q->order[at + 1], &q->order[at], (q->count - 1 - at) * sizeof *q->order);
    q->order[at] = to;
    q->found[to] = *hit;
    if (q->count == q->capacity)
        set_limit(q, &q->found[q->order[q->count - 1]]);
    return true;
}

static double clamp(double t, struct interval s)
{
    return t < s.a ? s.a : t > s.z ? s.z : t;
}

static bool inside(const struct query *q, double t)
{
    return q->tmin < t && t < q->tmax;
}

/* S of a primitive's box, in the caller's interval. */
static struct interval own_interval(const struct query *q, const accel_box *padded)
{
    const struct interval raw = query_slabs(q, padded);
    return query_cut(raw.a, raw.z, q->tmin, q->tmax);
}

/* A native hit: t is clamped into S(P'), and a hit whose S(P') is empty is none. */
void accel_query_offer(struct query *q, const accel_box *padded, uint32_t id, double t, double u,
                       double v)
{
    const struct interval s = own_interval(q, padded);
    if (!(s.a <= s.z) || isnan(t))
        return;
    const double key = clamp(t, s);
    if (inside(q, key))
        keep(q, &(struct found){key, key, u, v, id});
}

void accel_query_offer_point(struct query *q, const accel_box *padded, uint32_t id)
{
    const struct interval s = own_interval(q, padded);
    if (s.a <= s.z)
        keep(q, &(struct found){0.0, 0.0, 0.0, 0.0, id});
}

static void offer(struct query *q, uint32_t id, double t, double u, double v)
{
    accel_query_offer(q, &q->prims->box[id], id, t, u, v);
}

static void test_triangle(struct query *q, const struct geometry *g, uint32_t id)
{
    double t, u, v;
    if (accel_triangle_hit(q, g->data + 9 * (size_t)(id - g->first), &t, &u, &v))
        offer(q, id, t, u, v);
}

static void test_sphere(struct query *q, const struct geometry *g, uint32_t id)
{
    double t[2];
    const int roots = accel_sphere_hits(q, g->data + 4 * (size_t)(id - g->first), id == q->skip, t);
    for (int i = 0; i < roots; i++)
        offer(q, id, t[i], 0.0, 0.0);
}

/* `prune` leaves out an object that begins after the limit. Linear, the judge, does without. */
static void test_object(struct query *q, const struct geometry *g, uint32_t id, bool prune)
{
    const struct interval s = own_interval(q, &q->prims->box[id]);
    if (!(s.a <= s.z) || (prune && s.a > q->limit))
        return;
    const double limit = g->order == ACCEL_ORDER_RAW && q->limit < q->tmax ? q->limit : q->tmax;
    struct probing probing = {
        {q->ray, g->user, q->caller, id - g->first, id == q->skip, limit, NULL},
        q,
        s,
        g->order,
        id};
    probing.probe.library = &probing;
    g->intersect(&probing.probe);
}

bool accel_report(accel_probe *probe, double t, double u, double v)
{
    if (!probe || !probe->library)
        return false;
    struct probing *p = probe->library;
    struct query *q = p->q;
    const bool raw = p->order == ACCEL_ORDER_RAW;
    const double key = raw ? t : clamp(t, p->s);
    if (!inside(q, t) || !inside(q, key))
        return false;
    if (raw && t < p->s.a)
        q->outside++;
    return keep(q, &(struct found){key, t, u, v, p->id});
}

static void test(struct query *q, uint32_t id, bool prune)
{
    const struct geometry *g = primitives_geometry(q->prims, id);
    if (id == q->skip && g->type == ACCEL_TRIANGLES)
        return;
    q->tests++;
    if (q->point) {
        accel_query_offer_point(q, &q->prims->box[id], id);
    } else if (g->type == ACCEL_TRIANGLES) {
        test_triangle(q, g, id);
    } else if (g->type == ACCEL_SPHERES) {
        test_sphere(q, g, id);
    } else {
        test_object(q, g, id, prune);
    }
}

/* One triangle that a test of two has not ruled out. */
static void test_survivor(struct query *q, uint32_t id, const double *vertices)
{
    double t, u, v;
    if (id != q->skip && accel_triangle_hit(q, vertices, &t, &u, &v))
        offer(q, id, t, u, v);
}

/* Those that may be in a pile. */
static void test_pile(struct query *q, const uint32_t *ids, size_t count, bool prune)
{
    for (size_t i = 0; i < count; i++)
        if (query_may_matter(q, ids[i]))
            test(q, ids[i], prune);
}

void accel_query_test_all(struct query *q, const uint32_t *ids, size_t count)
{
    if (q->pile) {
        test_pile(q, ids, count, false);
        return;
    }
    for (size_t i = 0; i < count && !query_done(q); i++)
        test(q, ids[i], false);
}

/* Notes that a primitive is being tested. True if it was lately. */
static bool tested_lately(struct query *q, uint32_t id)
{
    uint32_t *box = &q->mailbox[id % QUERY_MAILBOXES];
    const bool known = *box == id;
    *box = id;
    return known;
}

static void test_two(struct query *q, const uint32_t id[2], const double *const vertices[2])
{
    const uint32_t may = triangle_pair_may_hit(q, vertices[0], vertices[1]);
    for (int i = 0; i < 2; i++)
        if (may >> i & 1)
            test_survivor(q, id[i], vertices[i]);
}

/* A list of triangles, two at a time. */
static void test_triangles(struct query *q, const uint32_t *ids, size_t count)
{
    uint32_t id[2];
    const double *vertices[2];
    int held = 0;
    for (size_t i = 0; i < count && !query_done(q); i++) {
        if (ids[i] == q->skip || tested_lately(q, ids[i]))
            continue;
        const struct geometry *g = primitives_geometry(q->prims, ids[i]);
        id[held] = ids[i];
        vertices[held++] = g->data + 9 * (size_t)(ids[i] - g->first);
        q->tests++;
        if (held == 2)
            test_two(q, id, vertices);
        held %= 2;
    }
    if (held == 1 && !query_done(q))
        test_survivor(q, id[0], vertices[0]);
}

void accel_query_test_once(struct query *q, const uint32_t *ids, size_t count)
{
    if (q->pile) {
        test_pile(q, ids, count, true);
        return;
    }
    for (size_t i = 0; i < count && !query_done(q); i++)
        test(q, ids[i], true);
}

void accel_query_test_list(struct query *q, const uint32_t *ids, size_t count)
{
    if (q->pile) {
        test_pile(q, ids, count, true);
        return;
    }
    if (q->prims->only_triangles && !q->point) {
        test_triangles(q, ids, count);
        return;
    }
    for (size_t i = 0; i < count && !query_done(q); i++)
        if (!tested_lately(q, ids[i]))
            test(q, ids[i], true);
}
