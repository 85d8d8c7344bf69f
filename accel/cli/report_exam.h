/* SPDX-License-Identifier: Apache-2.0
 *
 * Counting wrong answers: rays of the catalogue, what is right for each, and contenders that are
 * asked.
 *
 * What is right comes from the search in 113 bits (cases/oracle.h), from the closedness of a mesh
 * (cases/leaks.h: every ray must hit), or from linear search where a scene holds host objects. A
 * ray that no judge decides counts for nobody. Ours must name the right primitive, with t within
 * the bound of 113 bits; a peer in single precision need only name the primitive.
 *
 * Peers are judged twice: by the scene as the user gave it, and by the scene and rays rounded to
 * single precision, which is what they were given.
 */
#ifndef ACCEL_CLI_REPORT_EXAM_H
#define ACCEL_CLI_REPORT_EXAM_H

#include "bench.h"
#include "catalogue.h"
#include "known.h"
#include "lattice.h"
#include "leaks.h"
#include "oracle.h"
#include "report.h"

/* Who says what is right. */
typedef enum accel_judge {
    ACCEL_BY_ORACLE,
    ACCEL_BY_HIT,
    ACCEL_BY_LINEAR,
    ACCEL_BY_INTEGERS
} accel_judge;

extern const char *const accel_judge_names[];

/* What to ask on. */
typedef struct accel_exam_subject {
    const struct scene_maker *maker; /* of the scene; NULL: leaks */
    const struct ray_family *family; /* of rays at it */
    const struct leak_mesh *leaks;   /* scene and rays that must hit; NULL: maker */
    const struct known *known;       /* scene, ray and answer of a report; NULL: maker */
    bool integers;                   /* rays of cases/lattice.h, judged by integers */
    uint64_t seed;                   /* 0 stands for 1 */
} accel_exam_subject;

enum { ACCEL_MOST_TIES = 32 };

/* What an integer line or the ray of a known case hits first, and all that it hits at the same t:
 * which of them a peer names is its own affair. */
typedef struct accel_first {
    struct crossing crossing; /* the right one; under is 0 where nothing is hit */
    accel_id ties[ACCEL_MOST_TIES];
    uint32_t tie_count;
} accel_first;

/* Rays on one scene, and what is right. */
typedef struct accel_exam {
    accel_judge judge;
    struct test_scene *scene; /* owned */
    accel *linear;            /* over it, owned */
    accel_ray_set set;        /* the rays; hits: what linear answers */
    struct judgement *right;  /* by the oracle, for each ray, or NULL */
    struct judgement *single; /* the same of what peers are given, or NULL */
    accel_first *exact;       /* by integers */
    size_t decided;           /* rays that count */
    size_t decided_peer;      /* of them, those that a peer can be asked */
    size_t decided_single;    /* the same, of what peers are given */
    accel_ray_set peer_set;   /* rays within a peer's range: what it is timed on */
    bool peers;               /* Embree knows all of its primitives */
} accel_exam;

/* Makes scene and rays and has them judged; takes about `seconds`: the count of rays, from `least`
 * to `most`, is chosen by the time of the first ones. False: no memory. */
bool accel_exam_make(accel_exam *exam, accel_exam_subject subject, double seconds, size_t least,
                     size_t most);

void accel_exam_free(accel_exam *exam);

/* A structure of ours as a contender; it owns the structure. */
accel_contender accel_exam_ours(accel *a, const char *config);

/* Are all numbers of the ray within a peer's range? */
bool accel_peer_reaches(const accel_ray *ray);

/* Can a peer be asked at all? */
bool accel_peer_asked(const accel_ray *ray);

/* Wrong answers of a contender to the rays that count: decided, or decided_peer of a peer. A ray
 * beyond a peer's range gets no answer from it: wrong where something is to be hit. */
size_t accel_exam_wrong(const accel_exam *exam, const accel_contender *c);

/* The same by what peers are given, of decided_single. */
size_t accel_exam_wrong_single(const accel_exam *exam, const accel_contender *c);

/* All forms of all kinds, and the peers where they know the scene. */
typedef struct accel_field {
    accel_contender at[ACCEL_MOST_FORMS + ACCEL_MOST_PEERS];
    double ns[ACCEL_MOST_FORMS + ACCEL_MOST_PEERS]; /* for each ray, median of the turns */
    size_t count;
} accel_field;

/* Builds them over the exam's scene. False: said. */
bool accel_field_build(accel_field *field, accel_reporting *r, const accel_exam *exam);

/* Times them, in turns, on the first rays. */
void accel_field_time(accel_field *field, const accel_exam *exam);

void accel_field_free(accel_field *field);

#endif
