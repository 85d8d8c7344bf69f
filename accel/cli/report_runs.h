/* SPDX-License-Identifier: Apache-2.0
 *
 * One structure on one set of rays: judged, counted and timed.
 */
#ifndef ACCEL_CLI_REPORT_RUNS_H
#define ACCEL_CLI_REPORT_RUNS_H

#include "bench.h"
#include "report.h"

/* What it came to. */
typedef struct accel_run {
    char name[80];       /* CONFIG or peer */
    bool peer;           /* its other answers are counted, its nodes are not known */
    size_t rays, wrong;  /* wrong: other bits than linear; of a peer: another primitive */
    double ns;           /* for each ray, median of the turns, processor time */
    double nodes, tests; /* for each ray */
    double build;        /* seconds, processor time */
    double bytes;        /* held */
} accel_run;

/* Which rays. */
typedef enum accel_ground_rays {
    ACCEL_GROUND_BOUNCES, /* diffuse, from what a camera that frames the scene sees */
    ACCEL_GROUND_PHOTONS /* from the scene's lights, and diffuse from what those hit, half and half:
                            a camera would hardly see two clusters far apart */
} accel_ground_rays;

/* A scene with rays and what is right for them. */
typedef struct accel_ground {
    accel_loaded loaded;
    accel_ray_set set; /* hits: right, bit for bit; linear has judged a sample */
} accel_ground;

/* Loads the scene, makes up to `rays` rays, has linear judge them for about `seconds`. False: said.
 */
bool accel_ground_make(accel_ground *g, accel_reporting *r, const char *scene,
                       accel_ground_rays which, size_t rays, double seconds);

void accel_ground_free(accel_ground *g);

/* Builds, judges and times CONFIG, on as many of the rays as fit into the time, at least
 * ACCEL_LEAST_RAYS: a bad choice may be a thousand times slower. False: said. */
bool accel_run_config(accel_run *run, accel_reporting *r, const accel_ground *g, const char *config,
                      double seconds);

enum { ACCEL_LEAST_RAYS = 200 };

/* The same for all peers; returns how many. */
size_t accel_run_peers(accel_run runs[ACCEL_MOST_PEERS], const accel_ground *g);

#endif
