/* SPDX-License-Identifier: Apache-2.0
 *
 * The queries of the public interface: each prepares the ray, lets the kind walk, and hands out
 * what was found.
 */
#include "kind.h"
#include "../primitive/query.h"
#include "../wide/wide_isa.h"

#include <string.h>

static bool valid(const accel *a, const accel_ray *ray)
{
    if (!a || !ray)
        return false;
    double sum = 0.0;
    for (int k = 0; k < 3; k++) {
        if (!isfinite(ray->org[k]) || !isfinite(ray->dir[k]))
            return false;
        sum = fmax(sum, fabs(ray->dir[k]));
    }
    return sum > 0.0 && !isnan(ray->tmin) && !isnan(ray->tmax);
}

/* What the slabs need. */
static void prepare_slabs(struct query *q)
{
    q->parallel = q->sign = 0;
    for (int k = 0; k < 3; k++) {
        const bool parallel = q->dir[k] == 0.0, negative = q->dir[k] < 0.0;
        q->inv[k] = parallel ? 0.0 : query_inverse(q->dir[k]);
        q->parallel |= (uint32_t)parallel << k;
        q->sign |= (uint32_t)negative << k;
        q->near[k] = (uint8_t)(negative ? k + 3 : k);
    }
}

/* What the shear test needs, if anything is tested by it. */
static void prepare_shear(struct query *q)
{
    if (!q->prims->triangles)
        return;
    int kz = fabs(q->dir[1]) > fabs(q->dir[0]) ? 1 : 0;
    kz = fabs(q->dir[2]) > fabs(q->dir[kz]) ? 2 : kz;
    const int kx = (kz + 1) % 3, ky = (kz + 2) % 3;
    q->axis[0] = (uint8_t)kx;
    q->axis[1] = (uint8_t)ky;
    q->axis[2] = (uint8_t)kz;
    q->shear[0] = q->dir[kx] / q->dir[kz];
    q->shear[1] = q->dir[ky] / q->dir[kz];
    q->shear[2] = 1.0 / q->dir[kz];
}

/* Sets one after the other, as clearing all first takes a third of the time; what only some queries
 * read (shear, mailbox) is set by these. */
static void prepare(struct query *q, const accel *a, const accel_ray *ray, accel_query *caller)
{
    q->prims = &a->prims;
    q->point = q->batch = q->any = q->pile = false;
    q->limit = (double)INFINITY;
    q->found = NULL;
    q->order = NULL;
    q->count = q->capacity = 0;
    q->last = (struct found){0.0, 0.0, 0.0, 0.0, ACCEL_NONE};
    q->end = ACCEL_NONE;
    q->nodes = q->tests = q->outside = 0;
    memcpy(q->org, ray->org, sizeof q->org);
    memcpy(q->dir, ray->dir, sizeof q->dir);
    q->tmin = q->begin = ray->tmin;
    q->tmax = ray->tmax;
    q->skip = primitives_id(&a->prims, ray->skip);
    q->caller = caller;
    q->ray = ray;
    prepare_slabs(q);
}

void accel_query_prepare(struct query *q, const accel *a, const accel_ray *ray)
{
    prepare(q, a, ray, NULL);
    prepare_shear(q);
}

static void give_room(struct query *q, struct found *found, uint16_t *order, uint32_t capacity)
{
    q->found = found;
    q->order = order;
    q->capacity = capacity;
}

/* One walk: the first hits after q->last. Things without bounds come first: they may set the
 * limit. In a point query all keys are 0, and what begins at infinity holds no point. */
static void walk(struct query *q, const accel *a)
{
    q->count = 0;
    q->limit = q->pile ? q->last.key : q->point ? 0.0 : (double)INFINITY;
    q->end = ACCEL_NONE;
    memset(q->mailbox, 0xff, sizeof q->mailbox);
    accel_query_test_all(q, a->prims.unbounded.at, a->prims.unbounded.count);
    if (a->prims.bounded.count > 0 && !query_done(q))
        a->kind->walk(a, q);
}

static void account(const struct query *q)
{
    if (!q->caller)
        return;
    q->caller->nodes += q->nodes;
    q->caller->tests += q->tests;
    q->caller->outside += q->outside;
}

static bool refuse(accel_query *caller)
{
    if (caller)
        caller->refused++;
    return false;
}

static accel_hit hit_from(const struct primitives *p, const struct found *f)
{
    const accel_id name = primitives_name(p, f->id);
    return (accel_hit){f->t, f->u, f->v, name.geom, name.prim};
}

/* The first hit, or any one. Returns whether there is one. */
static bool find_first(struct query *q, const accel *a, const accel_ray *ray, bool any,
                       struct found *found, accel_query *caller)
{
    prepare(q, a, ray, caller);
    prepare_shear(q);
    give_room(q, found, NULL, 1);
    q->any = any;
    walk(q, a);
    account(q);
    return q->count > 0;
}

bool accel_closest(const accel *a, const accel_ray *ray, accel_hit *hit, accel_query *query)
{
    if (a && ray && a->fast) {
        const enum wide_answer answer = a->fast->isa->closest(a, a->fast, ray, hit, query);
        if (answer != WIDE_NOT_HANDLED)
            return answer == WIDE_HIT;
    }
    if (!valid(a, ray))
        return refuse(query);
    struct query q;
    struct found found;
    if (!find_first(&q, a, ray, false, &found, query))
        return false;
    if (hit)
        *hit = hit_from(&a->prims, &found);
    return true;
}

bool accel_any(const accel *a, const accel_ray *ray, accel_query *query)
{
    if (a && ray && a->fast) {
        const enum wide_answer answer = a->fast->isa->any(a, a->fast, ray, query);
        if (answer != WIDE_NOT_HANDLED)
            return answer == WIDE_HIT;
    }
    if (!valid(a, ray))
        return refuse(query);
    struct query q;
    struct found found;
    return find_first(&q, a, ray, true, &found, query);
}

/* Of a batch without a structure or rays. */
static size_t refuse_n(size_t count, accel_query *caller)
{
    if (caller)
        caller->refused += count;
    return 0;
}

size_t accel_closest_n(const accel *a, const accel_ray *rays, accel_hit *hits, size_t count,
                       accel_query *query)
{
    if (a && rays && a->fast && a->fast->used > WIDE_BATCH_BYTES)
        return a->fast->isa->closest_n(a, a->fast, rays, hits, count, query);
    size_t found = 0;
    for (size_t i = 0; i < count; i++) {
        accel_hit hit = wide_no_hit();
        found += rays && accel_closest(a, &rays[i], &hit, query);
        if (hits)
            hits[i] = hit;
    }
    return rays ? found : refuse_n(count, query);
}

size_t accel_any_n(const accel *a, const accel_ray *rays, bool *flags, size_t count,
                   accel_query *query)
{
    if (a && rays && a->fast && a->fast->used > WIDE_BATCH_BYTES)
        return a->fast->isa->any_n(a, a->fast, rays, flags, count, query);
    size_t found = 0;
    for (size_t i = 0; i < count; i++) {
        const bool hit = rays && accel_any(a, &rays[i], query);
        found += hit;
        if (flags)
            flags[i] = hit;
    }
    return rays ? found : refuse_n(count, query);
}

/* Receives what an all query found. */
typedef bool visit_found(void *visitor, const struct primitives *p, const struct found *f);

/* What the next walk is to gather: all after the last hit; if half of these have its key, first a
 * pile of that; if such a pile came to its end, what has a greater key. */
static void go_on(struct query *q)
{
    if (q->count == q->capacity)
        q->last = q->found[q->order[q->count - 1]];
    else
        q->last.id = ACCEL_NONE;
    q->pile = q->count == q->capacity && q->found[q->order[q->count / 2]].key == q->last.key;
    q->batch = true;
    if (q->prims->by_key && !q->point)
        q->begin = q->last.key;
}

/* One batch. True if there may be another. */
static bool visit_batch(struct query *q, const accel *a, visit_found *visit, void *visitor,
                        bool *stopped)
{
    walk(q, a);
    for (uint32_t i = 0; i < q->count && !*stopped; i++)
        *stopped = !visit(visitor, q->prims, &q->found[q->order[i]]);
    if (*stopped || (q->count < q->capacity && !q->pile))
        return false;
    go_on(q);
    return true;
}

/* The batches after the first: larger, as each is a walk that may test all of a pile again. Apart,
 * so that the stack holds this room where it is needed only. */
__attribute__((noinline)) static void
visit_deferred(struct query *q, const accel *a, visit_found *visit, void *visitor, bool *stopped)
{
    struct found found[QUERY_LATER];
    uint16_t order[QUERY_LATER];
    give_room(q, found, order, QUERY_LATER / 4);
    while (visit_batch(q, a, visit, visitor, stopped))
        q->capacity = QUERY_LATER;
}

/* False if the visitor said stop. */
static bool visit_all(struct query *q, const accel *a, visit_found *visit, void *visitor)
{
    struct found found[QUERY_BATCH];
    uint16_t order[QUERY_BATCH];
    bool stopped = false;
    give_room(q, found, order, QUERY_BATCH);
    if (visit_batch(q, a, visit, visitor, &stopped))
        visit_deferred(q, a, visit, visitor, &stopped);
    account(q);
    return !stopped;
}

struct hit_visitor {
    accel_visit_hit *visit;
    void *user;
};

static bool visit_hit(void *visitor, const struct primitives *p, const struct found *f)
{
    const struct hit_visitor *v = visitor;
    const accel_hit hit = hit_from(p, f);
    return v->visit(v->user, &hit);
}

bool accel_all(const accel *a, const accel_ray *ray, accel_visit_hit *visit, void *user,
               accel_query *query)
{
    if (!visit || !valid(a, ray)) {
        refuse(query);
        return true;
    }
    struct query q;
    prepare(&q, a, ray, query);
    prepare_shear(&q);
    return visit_all(&q, a, visit_hit, &(struct hit_visitor){visit, user});
}

struct id_visitor {
    accel_visit_id *visit;
    void *user;
};

static bool visit_id(void *visitor, const struct primitives *p, const struct found *f)
{
    const struct id_visitor *v = visitor;
    return v->visit(v->user, primitives_name(p, f->id));
}

static bool is_finite_point(const double point[3])
{
    return isfinite(point[0]) && isfinite(point[1]) && isfinite(point[2]);
}

bool accel_point(const accel *a, const double *point, accel_visit_id *visit, void *user,
                 accel_query *query)
{
    const double nowhere[3] = {0.0, 0.0, 0.0};
    if (!a || !point || !visit || !is_finite_point(point)) {
        refuse(query);
        return true;
    }
    const accel_ray ray = accel_ray_from(point, nowhere);
    struct query q;
    prepare(&q, a, &ray, query);
    q.point = true;
    return visit_all(&q, a, visit_id, &(struct id_visitor){visit, user});
}
