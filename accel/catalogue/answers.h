/* SPDX-License-Identifier: Apache-2.0
 *
 * All that a structure answers to one ray, and the comparison of two structures' answers bit by
 * bit: for `accel check`, the tests and the reports.
 */
#ifndef CATALOGUE_ANSWERS_H
#define CATALOGUE_ANSWERS_H

#include "accel/accel.h"

/* Hits and ids of one query that are kept: a query with more is ended there in all structures. */
enum { KEPT = 300 };

/* What to ask. */
struct question {
    accel_ray ray;
    bool lists;      /* accel_all and accel_point as well */
    double point[3]; /* for accel_point */
};

/* What a structure says. */
struct answers {
    bool found;           /* by accel_closest */
    bool any;             /* by accel_any */
    bool untouched;       /* a miss left the hit alone */
    bool ended;           /* what accel_all returned */
    accel_hit closest;    /* where found */
    uint32_t all_count;   /* hits in `all` */
    uint32_t point_count; /* ids in `point` */
    accel_hit all[KEPT];
    accel_id point[KEPT];
};

/* How two answers differ: a sum of these. */
enum { DIFFERS_CLOSEST = 1, DIFFERS_ANY = 2, DIFFERS_ALL = 4, DIFFERS_POINT = 8 };

/* Asks `a` for the closest hit and for any. Lists become empty. */
void answers_ask(const accel *a, const accel_ray *ray, accel_query *query, struct answers *answers);

/* The same, but takes accel_any's answer from accel_closest: for a slow judge. */
void answers_ask_judge(const accel *judge, const accel_ray *ray, accel_query *query,
                       struct answers *answers);

/* Asks for the lists. */
void answers_ask_lists(const accel *a, const accel_ray *ray, const double point[3],
                       accel_query *query, struct answers *answers);

/* Do two hits agree in every bit of t, u, v, and in their ids? */
bool same_hit(const accel_hit *a, const accel_hit *b);

/* Compares what was asked. Returns 0 where all agrees. */
unsigned answers_differ(const struct question *question, const struct answers *expected,
                        const struct answers *got);

#endif
