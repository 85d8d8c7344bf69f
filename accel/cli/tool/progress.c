/* SPDX-License-Identifier: Apache-2.0
 *
 * Progress on a terminal.
 */
#include "progress.h"

#include <stdio.h>
#include <time.h>
#include <unistd.h>

double seconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

struct progress progress_start(bool quiet)
{
    return (struct progress){.shown = !quiet && isatty(STDERR_FILENO), .start = seconds_now()};
}

void progress_show(struct progress *progress, const char *phase, double done)
{
    if (!progress->shown) {
        return;
    }
    const double now = seconds_now();
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

void progress_clear(struct progress *progress)
{
    if (progress->dirty) {
        fprintf(stderr, "\r\033[K");
        fflush(stderr);
        progress->dirty = false;
    }
}

bool progress_build(void *user, const char *phase, double done)
{
    progress_show(user, phase, done);
    return true;
}

void progress_load(void *user, const char *phase)
{
    progress_show(user, phase, -1.0);
}
