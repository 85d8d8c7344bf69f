/* SPDX-License-Identifier: Apache-2.0
 *
 * accel bench: structures and peers against each other on the same rays.
 */
#ifndef ACCEL_CLI_BENCH_H
#define ACCEL_CLI_BENCH_H

#include "structure.h"

#include <stdio.h>

enum { MOST_REPEATS_BENCH = 51, MOST_PEERS = 4 };

/* The kinds of rays. */
enum { SET_PRIMARY, SET_BOUNCE, SET_SHADOW, SET_PHOTON, SETS };

/* Rays of one kind, and what they hit. */
struct ray_set {
    const char *name;
    bool any;        /* asked by accel_any, else by accel_closest */
    size_t count;    /* rays */
    accel_ray *rays; /* owned */
    accel_hit *hits; /* the answers, owned; geom is ACCEL_NONE for a miss */
    size_t found;    /* rays that hit something */
};

/* The names of the kinds of rays, in their order. */
extern const char *const set_names[SETS];

/* Fills set->rays with up to `count` rays of kind `which`; `a` traces what must be known to make
 * them. Fills the answers as well. False: no memory. */
bool make_set(struct ray_set *set, int which, size_t count, const accel *a,
              const accel_scene *scene);

void free_set(struct ray_set *set);

/* One that takes part: one of our structures or a peer. */
struct bench_contender {
    char name[64];        /* config or peer */
    const char *kind;     /* what auto has become; ours only */
    bool batch;           /* ours, its rays asked together: the one before it, which owns `state` */
    bool peer;            /* not ours: single precision, its answers are counted, not judged */
    void *state;          /* an accel, or the peer's scene */
    double build_seconds; /* processor time */
    double bytes;         /* held */
    /* Traces all rays of the set; returns how many hit. What is timed. */
    size_t (*trace)(const struct bench_contender *c, const struct ray_set *set);
    /* The primitive that ray `i` hits, or ACCEL_NONE in geom. */
    accel_id (*ask)(const struct bench_contender *c, const struct ray_set *set, size_t i);
    void (*end)(struct bench_contender *c);
    double ns[SETS][MOST_REPEATS_BENCH]; /* per ray, processor time; sorted in the end */
    double nodes[SETS], tests[SETS];     /* per ray; ours only */
    size_t wrong[SETS];                  /* answers with another primitive than ours; peers only */
};

/* Makes the peers that this build knows, at most MOST_PEERS; returns how many. */
size_t bench_peers(struct bench_contender *peers, const accel_scene *scene, double length);

/* Why there are no peers in this build, or NULL. */
const char *bench_no_peers(void);

/* Rays that are asked together. */
enum { BATCH = 256 };

struct batch_answers {
    size_t count;
    accel_hit hits[BATCH];
    bool flags[BATCH]; /* of an any set, which has no hits */
};

/* Asks BATCH rays of the set, or what is left of it, from the i-th on. Returns how many hit. */
size_t ask_batch(const accel *a, const struct ray_set *set, size_t i, accel_query *query,
                 struct batch_answers *out);

/* All of one scene. */
struct bench {
    const char *scene_name;
    struct loaded loaded;
    const char *reference_name; /* config whose answers all are compared with */
    accel *reference;           /* the structure of it; also makes the rays */
    size_t judged;              /* rays of each kind that linear has judged, at most */
    uint64_t asked;             /* rays of each kind that were asked for */
    struct ray_set sets[SETS];  /* count 0: not asked for */
    struct bench_contender *at; /* count of them */
    size_t count;
    unsigned repeats;
};

/* Judges every answer of our structures: against the reference's, and that against linear for
 * `sample` rays of each set. Counts nodes, tests and the peers' other answers. Prints the first
 * difference and returns false if there is one. */
bool bench_judge(struct bench *bench, const accel *linear, size_t sample,
                 struct progress *progress);

/* Times all, taking turns. False where a structure found another number of hits than before. */
bool bench_time(struct bench *bench, struct progress *progress);

/* What is printed of all scenes. */
struct bench_output {
    bool table;                      /* tables go to standard output */
    bool peers;                      /* were asked for */
    bool headed;                     /* the heads have been printed */
    FILE *csv;                       /* for the figures, or NULL */
    double regret_sum, regret_worst; /* of auto over the scenes */
    size_t regret_count;             /* scenes where it was measured */
    const char *regret_scene;        /* the worst */
};

/* Prints one scene, judged and timed. */
void bench_print(struct bench_output *output, const struct bench *bench);

/* Prints the regret over all scenes. */
void bench_print_sum(const struct bench_output *output);

/* Quantile 0..1 of the times of contender c in set s. */
double bench_ns(const struct bench *bench, size_t c, int set, double part);

#endif
