/* SPDX-License-Identifier: Apache-2.0
 *
 * Counting wrong answers: rays of the catalogue, what is right for each, and contenders that are
 * asked.
 *
 * What is right comes from the search in 113 bits (catalogue/oracle.h), from the closedness of a
 * mesh (catalogue/leaks.h: every ray must hit), or from linear search where a scene holds host
 * objects. A ray that no judge decides counts for nobody. Ours must name the right primitive, with
 * t within the bound of 113 bits; a peer in single precision need only name the primitive.
 *
 * Peers are judged twice: by the scene as the user gave it, and by the scene and rays rounded to
 * single precision, which is what they were given.
 */
#ifndef ACCEL_CLI_REPORT_EXAM_H
#define ACCEL_CLI_REPORT_EXAM_H

#include "bench/bench.h"
#include "catalogue.h"
#include "known.h"
#include "lattice.h"
#include "leaks.h"
#include "oracle.h"
#include "report.h"

/* Who says what is right. */
enum judge { BY_ORACLE, BY_HIT, BY_LINEAR, BY_INTEGERS };

extern const char *const judge_names[];

/* What to ask on. */
struct exam_subject {
    const struct scene_maker *maker; /* of the scene; NULL: leaks */
    const struct ray_family *family; /* of rays at it */
    const struct leak_mesh *leaks;   /* scene and rays that must hit; NULL: maker */
    const struct known *known;       /* scene, ray and answer of a report; NULL: maker */
    bool integers;                   /* rays of catalogue/lattice.h, judged by integers */
    uint64_t seed;                   /* 0 stands for 1 */
};

enum { MOST_TIES = 32 };

/* What an integer line or the ray of a known case hits first, and all that it hits at the same t:
 * which of them a peer names is its own affair. */
struct first {
    struct crossing crossing; /* the right one; under is 0 where nothing is hit */
    accel_id ties[MOST_TIES];
    uint32_t tie_count;
};

/* Rays on one scene, and what is right. */
struct exam {
    enum judge judge;
    struct test_scene *scene; /* owned */
    accel *linear;            /* over it, owned */
    struct ray_set set;       /* the rays; hits: what linear answers */
    struct judgement *right;  /* by the oracle, for each ray, or NULL */
    struct judgement *single; /* the same of what peers are given, or NULL */
    struct first *exact;      /* by integers */
    size_t decided;           /* rays that count */
    size_t decided_peer;      /* of them, those that a peer can be asked */
    size_t decided_single;    /* the same, of what peers are given */
    struct ray_set peer_set;  /* rays within a peer's range: what it is timed on */
    bool peers;               /* Embree knows all of its primitives */
};

/* Makes scene and rays and has them judged; takes about `seconds`: the count of rays, from `least`
 * to `most`, is chosen by the time of the first ones. False: no memory. */
bool exam_make(struct exam *exam, struct exam_subject subject, double seconds, size_t least,
               size_t most);

void exam_free(struct exam *exam);

/* A structure of ours as a contender; it owns the structure. */
struct bench_contender exam_ours(accel *a, const char *config);

/* Are all numbers of the ray within a peer's range? */
bool peer_reaches(const accel_ray *ray);

/* Can a peer be asked at all? */
bool peer_asked(const accel_ray *ray);

/* Wrong answers of a contender to the rays that count: decided, or decided_peer of a peer. A ray
 * beyond a peer's range gets no answer from it: wrong where something is to be hit. */
size_t exam_wrong(const struct exam *exam, const struct bench_contender *c);

/* The same by what peers are given, of decided_single. */
size_t exam_wrong_single(const struct exam *exam, const struct bench_contender *c);

/* All forms of all kinds, and the peers where they know the scene. */
struct field {
    struct bench_contender at[MOST_FORMS + MOST_PEERS];
    double ns[MOST_FORMS + MOST_PEERS]; /* for each ray, median of the turns */
    size_t count;
};

/* Builds them over the exam's scene. False: said. */
bool field_build(struct field *field, struct reporting *r, const struct exam *exam);

/* Times them, in turns, on the first rays. */
void field_time(struct field *field, const struct exam *exam);

void field_free(struct field *field);

#endif
