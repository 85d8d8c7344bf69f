/* SPDX-License-Identifier: Apache-2.0
 *
 * All that a structure answers to one ray (answers.h) as hashes, which may be stored, and whether
 * it may be answered; the list of configs that are tested; and the file that a failure leaves,
 * which `replay` runs again.
 */
#ifndef TESTS_COMPARE_H
#define TESTS_COMPARE_H

#include "answers.h"
#include "catalogue.h"

struct answer {
    bool hit, any;       /* of accel_closest, accel_any */
    accel_hit closest;   /* if hit */
    uint64_t all, ids;   /* hash of what accel_all and accel_point visited, in order */
    uint32_t all_count;  /* how many hits; the visitor stops at KEPT */
    uint32_t id_count;   /* how many primitives hold the ray's origin; the same */
    uint32_t left;       /* how many hits of the primitive that the ray leaves */
    uint64_t refused;    /* how many of the queries were refused */
    uint64_t outside;    /* raw hits before their box, where kinds need not agree */
    const char *illegal; /* NULL, or what no structure may answer to this ray */
};

/* Asks for the nearest hit and for any; with `deep` also for all and for the origin's boxes. */
struct answer ask(const accel *a, const accel_ray *ray, bool deep);

bool same_answer(const struct answer *a, const struct answer *b);

/* Of a triangle that the ray leaves there is no hit, of a sphere one at most. */
bool leaves_rightly(const struct test_scene *s, const accel_ray *ray, const struct answer *a);

/* Bits of everything in an answer, FNV-1a. */
uint64_t answer_hash(uint64_t hash, const struct answer *a);
#define HASH_START 0xcbf29ce484222325u
uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t size);

/* The answer to a pile of `copies` of one primitive, from a structure over one of them. */
struct answer ask_pile(const accel *one, const accel_ray *ray, uint32_t copies, bool deep);

/* One config string to test. */
struct tested {
    char config[120];
    bool standard; /* all options at their defaults */
    bool form;     /* the same, or one names another form, or the smallest of lazy parts: what tests
                      try in full */
};

/* All kinds, each with its defaults, then with each word of each option, the ends of each range
 * and values between; below intensity 1, of those that are no forms only that share. Returns how
 * many; the array is free()d by the caller. */
size_t tested_configs(struct tested **list);

/* Is a kind compiled into the library? */
bool kind_is_there(const char *name);

/* What was wrong, where. */
struct failure {
    const char *scene, *family; /* their names */
    uint64_t seed, index;       /* of the scene; of the ray */
    const char *config;
    const accel_ray *ray;
    const struct answer *expected, *found;
};

/* Prints the failure and writes a file that `replay` reads. */
void report_failure(const struct failure *f, const struct test_scene *s);

void print_answer(FILE *f, const char *who, const struct answer *a);

/* Builds, or ends the test with the error's text. */
accel *must_build(const struct test_scene *s, const char *config);

/* Every kind and form over one scene. */
struct forms {
    accel **a;
    struct tested *of; /* what they are */
    size_t count;
};
struct forms build_forms(const struct test_scene *s);
void free_forms(struct forms *f);

/* The seed of this run: the environment's ACCEL_TEST_SEED, or a fixed one. */
uint64_t test_seed(void);

/* An allocator with an end: at most `most` bytes are held at a time. For accel_hooks. */
struct pool {
    size_t held, peak, most, blocks;
};
void *pool_resize(void *user, void *old, size_t from, size_t to);

#endif
