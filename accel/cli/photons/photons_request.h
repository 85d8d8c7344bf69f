/* SPDX-License-Identifier: Apache-2.0
 *
 * Between the parts of accel photons: what the user asked for, and doing it.
 */
#ifndef ACCEL_CLI_PHOTONS_REQUEST_H
#define ACCEL_CLI_PHOTONS_REQUEST_H

#include "photons.h"
#include "structure.h"

/* What the arguments say. */
struct photon_request {
    const char *scene;
    struct configs configs;
    struct light lights[MOST_LIGHTS];
    uint32_t light_count;  /* 0: the scene's own */
    struct photon_run run; /* without lights and progress */
    bool time_only;        /* no irradiance */
    bool nearest;          /* irradiance by nearest photons, otherwise by paths */
    double radius;         /* of the search or the discs; 0: from the number of hits */
    uint64_t count;        /* of nearest photons */
    const char *size;      /* of the picture, or NULL */
    const char *camera;    /* or NULL */
    const char *output;    /* picture to write, or NULL */
    bool quiet;
};

/* Illuminates through each CONFIG, prints what it cost, writes the picture. Returns the exit code.
 */
int photons_fulfil(const struct command *command, struct photon_request *request);

#endif
