/* SPDX-License-Identifier: Apache-2.0
 *
 * The answers of one structure to one ray, and the comparison of two structures' answers bit by
 * bit.
 */
#ifndef ACCEL_CLI_JUDGE_H
#define ACCEL_CLI_JUDGE_H

#include <accel/accel.h>

/* Hits and ids of one query that are kept: a query with more is ended there in all structures. */
enum { ACCEL_KEPT = 256 };

/* What to ask. */
typedef struct accel_question {
    accel_ray ray;
    bool lists;      /* accel_all and accel_point as well */
    double point[3]; /* for accel_point */
} accel_question;

/* What a structure says. */
typedef struct accel_answers {
    bool found;           /* by accel_closest */
    bool any;             /* by accel_any */
    bool untouched;       /* a miss left the hit alone */
    accel_hit closest;    /* where found */
    uint32_t all_count;   /* hits in `all` */
    uint32_t point_count; /* ids in `point` */
    accel_hit all[ACCEL_KEPT];
    accel_id point[ACCEL_KEPT];
} accel_answers;

/* How two answers differ: a sum of these. */
enum {
    ACCEL_DIFFERS_CLOSEST = 1,
    ACCEL_DIFFERS_ANY = 2,
    ACCEL_DIFFERS_ALL = 4,
    ACCEL_DIFFERS_POINT = 8
};

/* Asks `a`. */
void accel_ask(const accel *a, const accel_question *question, accel_query *query,
               accel_answers *answers);

/* As accel_ask, but takes accel_any's answer from accel_closest: for the slow judge. */
void accel_ask_judge(const accel *judge, const accel_question *question, accel_query *query,
                     accel_answers *answers);

/* Do two hits agree in every bit of t, u, v, and in their ids? */
bool accel_same_hit(const accel_hit *a, const accel_hit *b);

/* Compares what was asked. Returns 0 where all agrees. */
unsigned accel_differences(const accel_question *question, const accel_answers *expected,
                           const accel_answers *got);

#endif
