/* SPDX-License-Identifier: Apache-2.0
 *
 * Between the parts of accel photons: what the user asked for, and doing it.
 */
#ifndef ACCEL_CLI_PHOTONS_REQUEST_H
#define ACCEL_CLI_PHOTONS_REQUEST_H

#include "photons.h"
#include "structure.h"

/* What the arguments say. */
typedef struct accel_photon_request {
    const char *scene;
    accel_configs configs;
    accel_light lights[ACCEL_MOST_LIGHTS];
    uint32_t light_count; /* 0: the scene's own */
    accel_photon_run run; /* without lights and progress */
    bool time_only;       /* no irradiance */
    bool nearest;         /* irradiance by nearest photons, otherwise by paths */
    double radius;        /* of the search or the discs; 0: from the number of hits */
    uint64_t count;       /* of nearest photons */
    const char *size;     /* of the picture, or NULL */
    const char *camera;   /* or NULL */
    const char *output;   /* picture to write, or NULL */
    bool quiet;
} accel_photon_request;

/* Illuminates through each CONFIG, prints what it cost, writes the picture. Returns the exit code.
 */
int accel_photons_fulfil(const accel_command *command, accel_photon_request *request);

#endif
