/* SPDX-License-Identifier: Apache-2.0
 *
 * Between the parts of accel check: the run over many rays, its tallies, the replay of one ray.
 */
#ifndef ACCEL_CLI_CHECK_H
#define ACCEL_CLI_CHECK_H

#include "answers.h"
#include "rays.h"
#include "structure.h"

/* Queries whose differences are told apart: see answers.h. */
enum { DIFFERS_BATCH = 16, QUERIES = 5 };

/* One structure under check. */
struct suspect {
    accel *structure;
    accel_info info; /* describes it */
    bool added;      /* not asked for: a second opinion where linear judges a sample only */
    uint64_t hits;   /* rays that hit */
    uint64_t family_hits[FAMILIES];
    uint64_t refused;           /* rays that were not valid */
    uint64_t outside;           /* rays that met a raw hit before its object's box */
    uint64_t mismatches;        /* rays with any difference */
    uint64_t by_query[QUERIES]; /* of them by accel_closest, accel_any, accel_all, accel_point, and
                                   by accel_closest_n or accel_any_n not as by a ray alone */
    uint64_t first;             /* the lowest ray with a difference; UINT64_MAX for none */
};

/* A whole check. */
struct check {
    const struct command *command;
    const char *scene_name;
    struct loaded loaded;
    accel *judge; /* linear */
    struct suspect suspects[MOST_CONFIGS + 1];
    size_t suspect_count;
    struct rays rays;
    uint64_t ray_count;    /* to check */
    uint64_t judged_count; /* of them by linear */
    unsigned threads;
    struct progress progress;
};

/* One ray in 2^4 of each family is asked accel_all and accel_point as well. */
enum { LISTS_EVERY = 16 };

/* Question number `index`. Lists need the closest hit of some structure for their point. */
struct question check_question(const struct check *check, uint64_t index);

/* Asks a structure, or linear. */
void check_ask(const accel *a, const struct question *question, accel_query *query,
               struct answers *answers);
void check_ask_judge(const struct check *check, const struct question *question, accel_query *query,
                     struct answers *answers);

/* How many of the first `count` rays are of a family. */
uint64_t check_family_rays(uint64_t count, uint64_t family);

/* Does linear judge ray `index`? They lie evenly in each family. */
bool check_judged(const struct check *check, uint64_t index);

/* Checks all rays and fills the tallies. Returns false when memory runs out. */
bool check_run(struct check *check);

/* Prints the tallies and the rays that differ. Returns the exit code. */
int check_report(const struct check *check);

/* Asks linear and all suspects for one ray and prints their answers. Returns the exit code. */
int check_replay(const struct check *check, const accel_ray *ray);

#endif
