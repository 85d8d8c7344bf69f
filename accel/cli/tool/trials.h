/* SPDX-License-Identifier: Apache-2.0
 *
 * Timing structures against each other by photons: all are built first, then they take turns, so
 * that whatever else the machine does falls on all of them; medians of processor time are compared,
 * which waiting for other programs does not lengthen.
 */
#ifndef ACCEL_CLI_TRIALS_H
#define ACCEL_CLI_TRIALS_H

#include "photons/photons.h"
#include "structure.h"

enum { MOST_REPEATS = 101 };

/* One structure. */
struct trial {
    const char *config;
    accel *structure;
    accel_info info;              /* of the structure */
    double seconds[MOST_REPEATS]; /* of illumination, processor time; sorted in the end */
    double median, quartiles[2];  /* of them */
    struct photons photons;       /* counts of one run; the list itself is gone */
};

/* A scene and the structures that take turns on it. */
struct trials {
    const char *scene;
    struct trial *at; /* count of them, config set */
    size_t count;
    unsigned repeats;
    struct photon_run run; /* its lights are the scene's own */
    uint64_t hash;         /* of what all have stored */
};

/* Runs them. Returns the exit code; EXIT_DIFFERENT where two stored different bits, which has
 * been printed. Structures are gone afterwards. */
int trials_run(struct trials *trials, const struct command *command, struct progress *progress);

#endif
