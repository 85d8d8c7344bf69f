/* SPDX-License-Identifier: Apache-2.0
 *
 * One build under way, to whatever builds a part: phases and their times, progress, and what is to
 * be told of it. What is built is known by name only.
 */
#ifndef ACCEL_BUILD_H
#define ACCEL_BUILD_H

#include <time.h>

#include "error.h"
#include "memory.h"

struct accel;

struct build {
    struct accel *a;          /* what is built */
    struct memory *memory;    /* its own */
    accel_info *info;         /* its own */
    const char *kind;         /* its name */
    const accel_hooks *hooks; /* never NULL */
    accel_error *error;       /* first error; never NULL */
    const char *phase;        /* name of the phase under way */
    double done;              /* part of it that is done, as it is told: never less than before */
    struct timespec phase_start; /* when it began */
    struct timespec last_tick;   /* when the progress hook was last called */
    size_t untold;               /* primitives since the clock was last read */
};

double accel_seconds_since(const struct timespec *start);

/* Starts the next phase, or with NULL none, and notes the time of the last one. */
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
