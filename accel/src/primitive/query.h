/* SPDX-License-Identifier: Apache-2.0
 *
 * One query under way, and the rule that makes every kind give the same answer.
 *
 * A walk is a stream of candidates: a kind calls accel_query_test_list for every primitive that
 * could win, in any order, as often as it likes. The query keeps the `room` first hits by (key,
 * id): one for a closest or any query, a batch for an all query. So closest, any, all and point
 * queries are one walk.
 *
 * The interval S of a box (query_box) is the part of the ray inside it, grown by 2^-50 on both
 * ends. Every step of it is monotone under any one rounding mode, so a larger box has a larger
 * interval, also in floating point. A hit's key is its t clamped into S of the primitive's own
 * padded box P'. Hence: if every node's box contains P' of what lies below it, then S of the node
 * contains the key of every hit below it, and a node may be skipped if its S is empty or begins
 * after q->limit, the key that a hit must not exceed to matter; equal keys are never skipped.
 *
 * Space partitions list a primitive in every cell whose closed range meets P'. On each axis the
 * grown intervals of neighbouring cells overlap, so some cell of the primitive's range contains
 * the key on that axis, and the product of those cells lists the primitive: a walk must visit
 * every cell whose S is not empty and does not begin after q->limit.
 *
 * An all query walks once for each batch of hits. A later walk need not look at what lies before
 * the last key of the batch before, and cuts S of nodes to q->begin: a key of its own is not less,
 * so it is still in S. Keys themselves are clamped to S as the caller's interval cuts it. Where
 * many hits share the last key, walks gather a pile: hits of that key alone, by id, so of most
 * primitives the id tells that they are not among the next ones.
 *
 * A point query is the ray of zero direction: its S is not empty exactly for the boxes that hold
 * the point, and its hits are ordered by id alone.
 */
#ifndef ACCEL_QUERY_H
#define ACCEL_QUERY_H

#include <fenv.h>

#include "../core/box.h"
#include "primitives.h"

#define QUERY_GROWTH 0x1p-50

/* How many hits an all or point query gathers in its first walk, and in a later one at most: they
 * are on the stack, with the callbacks above them. */
enum { QUERY_BATCH = 32, QUERY_LATER = 512 };

/* A small direct-mapped memory of tested ids: saves tests, never needed for the answer. */
enum { QUERY_MAILBOXES = 32 };

/* A hit that was found, in the order (key, id). */
struct found {
    double key;     /* t clamped into S(P'), or t itself for raw objects */
    double t, u, v; /* as accel_hit */
    uint32_t id;    /* the primitive */
};

struct query {
    const struct primitives *prims;
    double org[3], dir[3];    /* the ray */
    double inv[3];            /* 1 / dir, 0 where dir is 0: see query_inverse */
    double tmin, tmax;        /* the caller's, exclusive */
    double begin;             /* no key below matters: tmin, or that of `last` */
    uint32_t parallel;        /* bit k: dir[k] is 0 */
    uint32_t sign;            /* bit k: dir[k] is negative (and not 0) */
    uint8_t near[3];          /* index of the near plane of axis k in a box's six doubles */
    uint8_t axis[3];          /* the shear test's kx, ky, kz: kz is the largest of |dir| */
    bool point;               /* a point query */
    bool batch;               /* an all query's second or later walk: only hits after `last` */
    double shear[3];          /* dir[kx] / dir[kz], dir[ky] / dir[kz], 1 / dir[kz] */
    uint32_t skip;            /* id that the ray leaves, or ACCEL_NONE */
    double limit;             /* a hit with a greater key cannot matter */
    struct found *found;      /* the first hits so far */
    uint16_t *order;          /* their places, by (key, id); NULL where there is room for one */
    uint32_t count, capacity; /* of them; there is room for */
    bool any;                 /* the first hit ends the query */
    struct found last;        /* of the batch before: the order goes on after it */
    bool pile;                /* only hits with the key of `last` are gathered */
    uint32_t end;             /* of a pile: ids from here on cannot matter */
    accel_query *caller;      /* the caller's, or NULL */
    const accel_ray *ray;     /* the caller's ray as the callbacks see it */
    uint64_t nodes, tests;    /* visited and tested so far */
    uint64_t outside;         /* raw hits before their box */
    uint32_t mailbox[QUERY_MAILBOXES]; /* ids tested lately; last, as each walk sets it */
};

/* 1 / dir of an axis that the ray is not parallel to. Where that is flushed to zero, infinity times
 * it would cut more off a larger box than off a smaller one: NaN cuts nothing off either. */
static inline double query_inverse(double dir)
{
    const double inverse = 1.0 / dir;
    return fabs(inverse) > 0.0 ? inverse : (double)NAN;
}

/* An interval of t. Empty if a > z. */
struct interval {
    double a, z;
};

/* The two ends of S from the raw ends; monotone, and right for either sign. */
static inline double query_grow_near(double t)
{
    const double in = t * (1.0 - QUERY_GROWTH), out = t * (1.0 + QUERY_GROWTH);
    return in < out ? in : out;
}

static inline double query_grow_far(double t)
{
    const double in = t * (1.0 - QUERY_GROWTH), out = t * (1.0 + QUERY_GROWTH);
    return in > out ? in : out;
}

/* S of the part of the ray from raw t `near` to raw t `far`, cut to an interval. */
static inline struct interval query_cut(double near, double far, double from, double to)
{
    const double a = query_grow_near(near), z = query_grow_far(far);
    return (struct interval){a > from ? a : from, z < to ? z : to};
}

/* The same of a node, whose S is of use where a key in it may matter. */
static inline struct interval query_interval(const struct query *q, double near, double far)
{
    return query_cut(near, far, q->begin, q->tmax);
}

/* The part of the ray's line inside a box: raw values of t. The comparisons are written so that a
 * NaN (0 * inf, where 1 / dir overflows or the direction is 0, or 1 / dir itself) leaves it as it
 * is, which is conservative. */
static inline struct interval query_slabs(const struct query *q, const accel_box *box)
{
    const double *plane = (const double *)box;
    struct interval raw = {-(double)INFINITY, (double)INFINITY};
    for (int k = 0; k < 3; k++) {
        if (q->parallel >> k & 1) {
            if (!(box->lo[k] <= q->org[k] && q->org[k] <= box->hi[k]))
                return (struct interval){(double)INFINITY, -(double)INFINITY};
            continue;
        }
        const double t0 = (plane[q->near[k]] - q->org[k]) * q->inv[k];
        const double t1 = (plane[3 - q->near[k] + 2 * k] - q->org[k]) * q->inv[k];
        raw.a = t0 > raw.a ? t0 : raw.a;
        raw.z = t1 < raw.z ? t1 : raw.z;
    }
    return raw;
}

/* S of a node's box. */
static inline struct interval query_box(const struct query *q, const accel_box *box)
{
    const struct interval raw = query_slabs(q, box);
    return query_interval(q, raw.a, raw.z);
}

/* May something whose S is `s` still matter? */
static inline bool query_meets(const struct query *q, struct interval s)
{
    return s.a <= s.z && s.a <= q->limit;
}

/* Walks may test against a little more than S where that is cheaper; what is met in vain costs only
 * time. For common rays, which are parallel to no axis, start at tmin >= 0 and round to nearest,
 * let begin be the greatest of q->begin and the raw near crossings, and end the least raw far
 * crossing, scaled up by 1 + QUERY_SLACK. Where S = [a, z] meets the query and may hold a hit,
 * begin <= end and begin <= query_cap. Proof: z > tmin >= 0, as the interval of keys is open, so no
 * far crossing is negative, and the slack takes each up by at least QUERY_SLACK - 4u relatively, u
 * = 2^-53, whether it is multiplied to t or to 1 / dir: more than QUERY_GROWTH and what growth was
 * rounded by; hence end >= z. If begin is q->begin or not positive, begin <= a. Otherwise begin
 * exceeds a by less than half the slack, relatively, which the slack makes up for in end and in the
 * cap. Where a product is subnormal, rounding to nearest undoes the growth, and is monotone; a
 * directed rounding would make the growth a whole step, hence S itself there. */
#define QUERY_SLACK (8 * QUERY_GROWTH)

static inline bool query_common(const struct query *q)
{
    return q->parallel == 0 && q->tmin >= 0.0 && fegetround() == FE_TONEAREST;
}

/* Where what matters to a common ray begins at the latest. */
static inline double query_cap(const struct query *q)
{
    return (q->limit < q->tmax ? q->limit : q->tmax) * (1.0 + QUERY_SLACK);
}

/* What the tests of primitives need to know of a ray, for a query that keeps its hits itself. */
void accel_query_prepare(struct query *q, const accel *a, const accel_ray *ray);

/* Does the id alone say that a primitive is not among the next of a pile? */
static inline bool query_may_matter(const struct query *q, uint32_t id)
{
    return !q->pile || (id > q->last.id && id < q->end);
}

/* Is the query answered, whatever else may come? */
static inline bool query_done(const struct query *q)
{
    return q->any && q->count > 0;
}

/* Tests a leaf's primitives and keeps those hits that are among the first. Leaves out what was
 * tested lately, and objects whose box begins after the limit. */
void accel_query_test_list(struct query *q, const uint32_t *ids, size_t count);

/* The same where no primitive is met twice: what was tested lately is not asked. */
void accel_query_test_once(struct query *q, const uint32_t *ids, size_t count);

/* For kinds that keep the data of primitives themselves: a hit of a triangle or sphere, and a box
 * that a point query may be in. padded: P'. */
void accel_query_offer(struct query *q, const accel_box *padded, uint32_t id, double t, double u,
                       double v);
void accel_query_offer_point(struct query *q, const accel_box *padded, uint32_t id);

/* Tests every one: what linear does. */
void accel_query_test_all(struct query *q, const uint32_t *ids, size_t count);

#endif
