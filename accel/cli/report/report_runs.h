/* SPDX-License-Identifier: Apache-2.0
 *
 * One structure on one set of rays: judged, counted and timed.
 */
#ifndef ACCEL_CLI_REPORT_RUNS_H
#define ACCEL_CLI_REPORT_RUNS_H

#include "bench/bench.h"
#include "report.h"

/* What it came to. */
struct run {
    char name[80];       /* CONFIG or peer */
    bool peer;           /* its other answers are counted, its nodes are not known */
    size_t rays, wrong;  /* wrong: other bits than linear; of a peer: another primitive */
    double ns;           /* for each ray, median of the turns, processor time */
    double nodes, tests; /* for each ray */
    double build;        /* seconds, processor time */
    double bytes;        /* held */
};

/* Which rays. */
enum ground_rays {
    GROUND_BOUNCES, /* diffuse, from what a camera that frames the scene sees */
    GROUND_PHOTONS  /* from the scene's lights, and diffuse from what those hit, half and half:
                             a camera would hardly see two clusters far apart */
};

/* A scene with rays and what is right for them. */
struct ground {
    struct loaded loaded;
    struct ray_set set; /* hits: right, bit for bit; linear has judged a sample */
};

/* Loads the scene, makes up to `rays` rays, has linear judge them for about `seconds`. False: said.
 */
bool ground_make(struct ground *g, struct reporting *r, const char *scene, enum ground_rays which,
                 size_t rays, double seconds);

void ground_free(struct ground *g);

/* Builds, judges and times CONFIG, on as many of the rays as fit into the time, at least
 * RUN_LEAST_RAYS: a bad choice may be a thousand times slower. False: said. */
bool run_config(struct run *run, struct reporting *r, const struct ground *g, const char *config,
                double seconds);

enum { RUN_LEAST_RAYS = 200 };

/* The same for all peers; returns how many. */
size_t run_peers(struct run runs[MOST_PEERS], const struct ground *g);

#endif
