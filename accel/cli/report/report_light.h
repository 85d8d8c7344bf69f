/* SPDX-License-Identifier: Apache-2.0
 *
 * Between the parts of the report on illumination: scenes with receivers whose irradiance is known
 * by a method that has nothing to do with photons.
 *
 * plates: a lit unit square over a floor, black, 32,768 triangles; irradiance by the form factor, a
 * closed form. teapots: the paper's nine teapots and a floor, reflectance 1/2; irradiance by paths
 * from the receivers to the light (see report_reference.c), with a standard error.
 */
#ifndef ACCEL_CLI_REPORT_LIGHT_H
#define ACCEL_CLI_REPORT_LIGHT_H

#include "photons/photons.h"
#include "report.h"

enum { RECEIVERS = 64, RADII = 3 };

/* A scene and what is right in it. Ended by light_scene_free. */
struct light_scene {
    const char *name, *title;
    struct loaded loaded;
    struct light light;
    struct photon_run run; /* its light and reflectance; photons and seed are set for each run */
    struct receiver receivers[RECEIVERS];
    accel_id on[RECEIVERS]; /* the primitives that they lie on */
    size_t count;           /* of receivers */
    double radius[RADII];
    double right[RECEIVERS]; /* irradiance */
    double error[RECEIVERS]; /* standard error of it */
    double mean;             /* of right */
    double floor;            /* root of the mean square of error, over mean */
};

bool light_plates(struct light_scene *s, struct reporting *r);

/* The reference takes about `seconds`. */
bool light_teapots(struct light_scene *s, struct reporting *r, double seconds);

void light_scene_free(struct light_scene *s);

/* Irradiance of the receivers by paths from them: fills right and error. `a` is built over the
 * scene. */
void light_reference(struct light_scene *s, const accel *a, double seconds);

/* What one line of the figures says. */
struct light_row {
    const char *estimator; /* "paths" or "nearest" */
    int radius;            /* its index */
    uint32_t photons;
    unsigned seeds;
    double rmse;      /* over receivers and seeds, over the mean irradiance */
    double bias;      /* root of the mean square over receivers, the noise taken off; not below 0 */
    double bias_seen; /* what of bias can be told from noise: its standard error */
};

#endif
