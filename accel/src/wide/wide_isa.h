/* SPDX-License-Identifier: Apache-2.0
 *
 * The interface of instruction sets: what a wide tree is walked by, compiled once for each set from
 * wide_fast.h, and chosen when a structure is built.
 */
#ifndef ACCEL_WIDE_ISA_H
#define ACCEL_WIDE_ISA_H

#include "wide.h"
#include "wide_ray.h"

/* The answer of a fast walk. */
enum wide_answer {
    WIDE_MISSED,
    WIDE_HIT,
    WIDE_NOT_HANDLED /* the ray is not one for this walk; nothing was done */
};

/* What batches tell of a ray that hits nothing. */
static inline accel_hit wide_no_hit(void)
{
    return (accel_hit){(double)INFINITY, 0.0, 0.0, ACCEL_NONE, ACCEL_NONE};
}

/* Trees of more bytes are walked by several rays of a batch at a time. The time of a ray alone was
 * taken times 0.85 at 4 MB, 0.5 at 34 MB, 0.35 at 400 MB (meshes), but 1.1 at 0.5 MB, where a
 * core's own cache holds all; and 1.1 of long triangles across each other at 40 MB, whose rays
 * mostly test.
 */
#define WIDE_BATCH_BYTES ((size_t)4 << 20)

struct wide_isa {
    const char *name;
    bool (*works_here)(void); /* does the processor have it? */
    struct wide_rule rule;    /* what its leaves look like */
    enum wide_answer (*closest)(const accel *a, const struct wide *w, const accel_ray *ray,
                                accel_hit *hit, accel_query *counters);
    enum wide_answer (*any)(const accel *a, const struct wide *w, const accel_ray *ray,
                            accel_query *counters);
    /* Many of them, several under way at a time: see wide_batch.h. Returns how many rays hit; hits
     * or flags, unless NULL, are set for every ray. */
    size_t (*closest_n)(const accel *a, const struct wide *w, const accel_ray *rays,
                        accel_hit *hits, size_t count, accel_query *counters);
    size_t (*any_n)(const accel *a, const struct wide *w, const accel_ray *rays, bool *flags,
                    size_t count, accel_query *counters);
    /* Any query but a point query, over any primitives: false if the ray is not one for this walk.
     */
    bool (*walk)(const struct wide *w, struct query *q);
    bool (*find_box)(const struct wide *w, uint32_t id, accel_box *box); /* accel_wide_find_box */
};

/* The sets that are compiled in, best first, NULL-ended; the last one works everywhere. */
extern const struct wide_isa *const accel_wide_isas[];
extern const struct wide_isa accel_wide_portable;

/* A closest or any query under way. */
struct wide_fast {
    struct wide_ray ray;
    struct leaf_ray leaf;
    const accel *a;
    const accel_ray *caller;
    double tmin, tmax;
    uint32_t skip;        /* id, or ACCEL_NONE */
    double best;          /* key of the best hit so far, infinity without one */
    double t;             /* of it: the key, but for hits that a host reports */
    double u, v, weights; /* its weights are u and v divided by their sum with the third one */
    uint32_t id;          /* its primitive; ACCEL_NONE without one */
    bool comes_to_leaves; /* `leaf` is made */
    bool prepared;        /* q is */
    uint64_t nodes, tests;
    accel_query *counters; /* the caller's, or NULL */
    struct query q;        /* for what takes the general test */
    struct found found;    /* its one hit */
};

/* The i-th triangle or sphere of a block by the whole rule of query.h. True if it is the best hit
 * so far. */
bool accel_wide_test_slowly(struct wide_fast *f, const struct wide_block *b, unsigned i);

/* Any primitives by that rule. True if the best hit became better. */
bool accel_wide_test_list(struct wide_fast *f, const uint32_t *ids, size_t count, bool any);

#endif
