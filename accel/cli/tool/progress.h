/* SPDX-License-Identifier: Apache-2.0
 *
 * Progress on a terminal: one line on stderr that is rewritten, from the second second on, and only
 * where stderr is a terminal and --quiet is not given.
 */
#ifndef ACCEL_CLI_PROGRESS_H
#define ACCEL_CLI_PROGRESS_H

#include <stdbool.h>

/* The progress of one run. Used by one thread. */
struct progress {
    bool shown;       /* may be shown at all */
    bool dirty;       /* a line stands on the terminal */
    double start;     /* seconds */
    double last;      /* when the line was last written */
    const char *what; /* in front of the phase, or NULL */
};

/* Seconds of a clock that only runs forward. */
double seconds_now(void);

struct progress progress_start(bool quiet);

/* Shows "what phase 42 %"; a negative `done` shows the seconds instead. */
void progress_show(struct progress *progress, const char *phase, double done);

/* Removes the line. */
void progress_clear(struct progress *progress);

/* For accel_hooks.progress; `user` is the struct progress. */
bool progress_build(void *user, const char *phase, double done);

/* For load_scene; `user` is the struct progress. */
void progress_load(void *user, const char *phase);

#endif
