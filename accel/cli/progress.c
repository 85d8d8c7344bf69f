/* SPDX-License-Identifier: Apache-2.0
 *
 * Progress on a terminal.
 */
#include "progress.h"

#include <stdio.h>
#include <time.h>
#include <unistd.h>

double accel_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

accel_progress accel_progress_start(bool quiet)
{
    return (accel_progress){.shown = !quiet && isatty(STDERR_FILENO), .start = accel_seconds()};
}

void accel_progress_show(accel_progress *progress, const char *phase, double done)
{
    if (!progress->shown) {
        return;
    }
    const double now = accel_seconds();
    if (now - progress->start < 1.0 || now - progress->last < 0.1) {
        return;
    }
    progress->last = now;
    progress->dirty = true;
    const char *what = progress->what == NULL ? "" : progress->what;
    fprintf(stderr, "\r\033[K%s%s%s", what, *what == '\0' ? "" : ": ", phase);
    if (done < 0.0) {
        fprintf(stderr, " %.0f s", now - progress->start);
    } else {
        fprintf(stderr, " %.0f %%", 100.0 * done);
    }
    fflush(stderr);
}

void accel_progress_clear(accel_progress *progress)
{
    if (progress->dirty) {
        fprintf(stderr, "\r\033[K");
        fflush(stderr);
        progress->dirty = false;
    }
}

bool accel_progress_build(void *user, const char *phase, double done)
{
    accel_progress_show(user, phase, done);
    return true;
}

void accel_progress_load(void *user, const char *phase)
{
    accel_progress_show(user, phase, -1.0);
}
