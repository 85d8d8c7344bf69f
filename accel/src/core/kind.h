/* SPDX-License-Identifier: Apache-2.0
 *
 * What a kind of structure is to the rest of the library: one static table of functions.
 * A new kind is one file that fills an `accel_kind`, and one line in kinds.h.
 */
#ifndef ACCEL_KIND_H
#define ACCEL_KIND_H

#include <time.h>

#include "accel/accel.h"
#include "cost.h"
#include "error.h"
#include "memory.h"
#include "../primitive/primitives.h"

struct query;
struct wide;

/* Options of a kind, and kinds, at most. */
enum { MAX_OPTIONS = 12, MAX_KINDS = 16 };

/* The parts that every structure has. A kind's own struct embeds it as its first member. */
struct accel {
    const struct accel_kind *kind; /* how it was built, how it is walked */
    struct memory memory;          /* what it holds */
    struct primitives prims;       /* what it is built over */
    double option[MAX_OPTIONS];    /* by the kind's option index; NAN stands for auto */
    accel_info info;               /* as accel_describe hands it out */
    const struct wide *fast;       /* the tree that answers closest and any queries, or NULL */
    uint64_t seal[2];              /* over all above, and over what the kind adds: see seal.h. What
                                      changes after accel_build lies in blocks of its own */
};

/* Values of a double's exponent field. */
enum { BUILD_SIZES = 2048 };

/* One build under way. */
struct build {
    struct accel *a;          /* what is built */
    const accel_hooks *hooks; /* never NULL */
    accel_error *error;       /* first error; never NULL */
    const char *phase;        /* name of the phase under way */
    double done;              /* part of it that is done, as it is told: never less than before */
    struct timespec phase_start; /* when it began */
    struct timespec last_tick;   /* when the progress hook was last called */
    size_t untold;               /* primitives looked at since the last question for the time */
    uint32_t sizes[BUILD_SIZES]; /* how many bounded primitives have a longest side with this binary
                                    exponent */
};

struct accel_kind {
    accel_kind_info info; /* name, summary, options; the first member: see kinds */
    struct kind_cost cost;
    size_t size; /* of the kind's struct */
    /* Only of a kind that stands for others: picks one of them, over a->prims.bounded. */
    bool (*choose)(struct build *build, const struct accel_kind **kind);
    /* Builds over a->prims.bounded, which is not empty; reads a->option and writes back what auto
     * became; fills the counts in a->info. False: build->error says why, `release` cleans up. */
    bool (*build)(struct build *build);
    /* Offers to the query every primitive that could win: see query.h. */
    void (*walk)(const struct accel *a, struct query *q);
    /* Only of a kind that builds on after accel_build: adds what there is now to the counts, also
     * while other threads query. */
    void (*describe)(const struct accel *a, accel_info *info);
    /* Checks the invariants of the file's head. False: *error says what is broken. */
    bool (*validate)(const struct accel *a, accel_error *error);
    /* Frees what build allocated, also after a build that failed half-way. */
    void (*release)(struct accel *a);
};

/* The kinds, NULL-ended; each is the `info` of an accel_kind. */
extern const accel_kind_info *const accel_kind_list[];

/* Starts the next phase of the build and notes the time of the last one. */
void accel_build_phase(struct build *build, const char *name);

/* Tells the progress hook how far the phase is, at most every few milliseconds; call it often. What
 * is told is the most of the phase so far, and in 0..1, whatever `done` is: a builder that takes
 * work back, or whose guess was too high, need not care. False if the build is cancelled. */
bool accel_build_tick(struct build *build, double done);

/* The same in small steps: after each, tell how many primitives it looked at. To ask for the time
 * takes as long as to make a small leaf, so that is done once for thousands. */
static inline bool build_step(struct build *build, size_t looked_at, double done)
{
    enum { PRIMITIVES_A_TICK = 16384 };
    build->untold += looked_at;
    if (build->untold < PRIMITIVES_A_TICK)
        return true;
    build->untold = 0;
    return accel_build_tick(build, done);
}

/* Notes that memory ran out, which the failed allocation left in a->memory. Returns false. */
bool accel_build_no_memory(struct build *build);

/* Adds to accel_info.left_out something that would take so many bytes; the phase under way made
 * `made` bytes of that sort. */
__attribute__((format(printf, 4, 5))) void
accel_build_left_out(struct build *build, size_t bytes, size_t made, const char *format, ...);

/* Adds a line to accel_info.notes: why something was chosen, or a limit that was met. Once. */
__attribute__((format(printf, 2, 3))) void accel_build_note(struct build *build, const char *format,
                                                            ...);

/* The same, of a description. */
__attribute__((format(printf, 2, 3))) void accel_info_note(accel_info *info, const char *format,
                                                           ...);

#endif
