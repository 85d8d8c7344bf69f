/* SPDX-License-Identifier: Apache-2.0
 *
 * Progress on a terminal: one line on stderr that is rewritten, from the second second on, and only
 * where stderr is a terminal and --quiet is not given.
 */
#ifndef ACCEL_CLI_PROGRESS_H
#define ACCEL_CLI_PROGRESS_H

#include <stdbool.h>

/* The progress of one run. Used by one thread. */
typedef struct accel_progress {
    bool shown;       /* may be shown at all */
    bool dirty;       /* a line stands on the terminal */
    double start;     /* seconds */
    double last;      /* when the line was last written */
    const char *what; /* in front of the phase, or NULL */
} accel_progress;

/* Seconds of a clock that only runs forward. */
double accel_seconds(void);

accel_progress accel_progress_start(bool quiet);

/* Shows "what phase 42 %"; a negative `done` shows the seconds instead. */
void accel_progress_show(accel_progress *progress, const char *phase, double done);

/* Removes the line. */
void accel_progress_clear(accel_progress *progress);

/* For accel_hooks.progress; `user` is the accel_progress. */
bool accel_progress_build(void *user, const char *phase, double done);

/* For accel_load_scene; `user` is the accel_progress. */
void accel_progress_load(void *user, const char *phase);

#endif
