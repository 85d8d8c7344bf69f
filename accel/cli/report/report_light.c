/* SPDX-License-Identifier: Apache-2.0
 *
 * Illumination: RMSE and bias, apart, against the time of build, photons and estimate together.
 *
 * All structures store the same photons, bit for bit (their hashes are compared), so the error
 * depends on the number of photons and the radius alone and is measured once, over SEEDS seeds;
 * what differs is the time, which is measured for each structure.
 */
#include "report_light.h"

#include "tool/threads.h"
#include "tool/machine.h"

#include <stdlib.h>
#include <string.h>

enum {
    SEEDS = 16,
    NEAREST = 100,
    MOST_PHOTONS = 10000000,
    LEAST_ROUNDS = 2,
    ESTIMATES = 4,
    MOST_KINDS = 32
};

static const char csv_name[] = "light.csv";
static const char columns[] =
    "scene,estimator,radius,photons,seeds,structure,build_seconds,photon_seconds,estimate_seconds,"
    "seconds,rmse,bias,bias_seen,floor,hash";

/* Structures shorter than this are run again until their times add up to it. */
#define LEAST_SECONDS 0.02

/* A structure that is timed. */
typedef struct timed {
    const char *config;
    accel *a;
    double build; /* processor time */
} timed;

/* One scene under way. */
typedef struct study {
    struct reporting *r;
    struct light_scene s;
    FILE *csv;
    uint64_t hash;                       /* of the photons of the first seed */
    double sum[ESTIMATES][RECEIVERS];    /* over seeds, of the error */
    double square[ESTIMATES][RECEIVERS]; /* of its square */
    struct light_row rows[ESTIMATES];    /* of the present number of photons */
    timed at[MOST_KINDS];
    size_t count;             /* of them */
    size_t best;              /* the fastest of the largest run, by paths in the middle radius */
    size_t worst;             /* the slowest */
    double total[MOST_KINDS]; /* their seconds */
} study;

/* ---------------------------------------------------------------- estimates ---- */

/* Estimates 0 .. RADII - 1 are by paths, the last by the nearest photons within the middle
 * radius. */
static bool estimate(study *y, const struct photons *photons, int which, const char *config,
                     double *out)
{
    const struct receivers receivers = {y->s.receivers, y->s.count};
    if (which == RADII) {
        return irradiance_nearest(photons, &y->s.run, receivers, y->s.radius[1], NEAREST, out);
    }
    accel_query query = {.user = NULL};
    accel_error error;
    return irradiance_paths(photons, &y->s.run, receivers, y->s.radius[which], config, out, &query,
                            &error);
}

static bool no_memory(const study *y)
{
    complain(y->r->command, "no memory for %u photons; nothing was written",
             (unsigned)y->s.run.photons);
    return false;
}

static bool add_seed(study *y, const accel *a, uint64_t seed)
{
    struct photons photons;
    y->s.run.seed = seed;
    y->s.run.threads = threads_available();
    if (!trace_photons(&photons, a, &y->s.loaded.scene, &y->s.run)) {
        return no_memory(y);
    }
    if (seed == 1) {
        y->hash = photons_hash(&photons);
    }
    bool fine = true;
    for (int e = 0; fine && e < ESTIMATES; e++) {
        double got[RECEIVERS];
        fine = estimate(y, &photons, e, ACCEL_DEFAULT_CONFIG, got);
        for (size_t i = 0; fine && i < y->s.count; i++) {
            const double off = (got[i] - y->s.right[i]) / y->s.mean;
            y->sum[e][i] += off;
            y->square[e][i] += off * off;
        }
    }
    photons_free(&photons);
    return fine || no_memory(y);
}

/* From the sums over seeds. The square of the mean error holds the noise of the mean and that of
 * the reference, which are taken off; their size tells what bias could be seen. */
static void sum_up(study *y, int e)
{
    double all = 0.0, mean_square = 0.0, noise = 0.0;
    const double n = (double)y->s.count;
    for (size_t i = 0; i < y->s.count; i++) {
        const double mean = y->sum[e][i] / SEEDS;
        const double spread = (y->square[e][i] / SEEDS - mean * mean) * SEEDS / (SEEDS - 1.0);
        const double own = y->s.error[i] / y->s.mean;
        all += y->square[e][i] / SEEDS / n;
        mean_square += mean * mean / n;
        noise += (spread / SEEDS + own * own) / n;
    }
    y->rows[e] = (struct light_row){.estimator = e == RADII ? "nearest" : "paths",
                                    .radius = e == RADII ? 1 : e,
                                    .photons = y->s.run.photons,
                                    .seeds = SEEDS,
                                    .rmse = sqrt(all),
                                    .bias = sqrt(fmax(0.0, mean_square - noise)),
                                    .bias_seen = sqrt(noise)};
}

static bool measure_errors(study *y, const accel *a)
{
    memset(y->sum, 0, sizeof y->sum);
    memset(y->square, 0, sizeof y->square);
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        progress_show(&y->r->progress, y->s.name, (double)seed / SEEDS);
        if (!add_seed(y, a, seed)) {
            return false;
        }
    }
    for (int e = 0; e < ESTIMATES; e++) {
        sum_up(y, e);
    }
    return true;
}

/* ------------------------------------------------------------- time of each ---- */

/* Processor time of one thread. */
typedef struct times {
    double build, photons, estimate[ESTIMATES];
} times;

static void write_rows(const study *y, const char *config, const times *t, uint64_t hash)
{
    for (int e = 0; e < ESTIMATES; e++) {
        const struct light_row *row = &y->rows[e];
        fprintf(y->csv, "%s,%s,%.4g,%u,%u,%s,%.6f,%.6f,%.6f,%.6f,%.5e,%.5e,%.5e,%.3e,%016llx\n",
                y->s.name, row->estimator, y->s.radius[row->radius], (unsigned)row->photons,
                row->seeds, config, t->build, t->photons, t->estimate[e],
                t->build + t->photons + t->estimate[e], row->rmse, row->bias, row->bias_seen,
                y->s.floor, (unsigned long long)hash);
    }
}

/* Adds one run to the times. */
static bool time_once(study *y, const accel *a, const char *config, times *t, uint64_t *hash)
{
    struct photons photons;
    if (!trace_photons(&photons, a, &y->s.loaded.scene, &y->s.run)) {
        return no_memory(y);
    }
    *hash = photons_hash(&photons);
    t->photons += photons.processor;
    bool fine = true;
    for (int e = 0; fine && e < ESTIMATES; e++) {
        double got[RECEIVERS];
        const double start = machine_seconds();
        fine = estimate(y, &photons, e, config, got);
        t->estimate[e] += machine_seconds() - start;
    }
    photons_free(&photons);
    return fine || no_memory(y);
}

static bool time_structure(study *y, size_t at)
{
    const timed *x = &y->at[at];
    times t = {.build = x->build};
    y->s.run.seed = 1;
    y->s.run.threads = 1;
    uint64_t hash = 0;
    int rounds = 0;
    bool fine = true;
    while (fine && (rounds == 0 || t.photons < LEAST_SECONDS)) {
        fine = time_once(y, x->a, x->config, &t, &hash);
        rounds++;
    }
    t.photons /= rounds;
    for (int e = 0; e < ESTIMATES; e++) {
        t.estimate[e] /= rounds;
    }
    y->r->judged++;
    y->r->wrong += hash != y->hash;
    y->total[at] = t.build + t.photons + t.estimate[1];
    if (fine) {
        write_rows(y, x->config, &t, hash);
    }
    return fine;
}

static bool time_all(study *y)
{
    bool fine = true;
    for (size_t i = 0; fine && i < y->count; i++) {
        progress_show(&y->r->progress, y->at[i].config, -1.0);
        fine = time_structure(y, i);
        y->best = i == 0 || y->total[i] < y->total[y->best] ? i : y->best;
        y->worst = i == 0 || y->total[i] > y->total[y->worst] ? i : y->worst;
    }
    return fine;
}

/* Every kind but linear, which would take hours. */
static bool build_all(study *y)
{
    size_t kinds;
    const accel_kind_info *const *kind = accel_kinds(&kinds);
    for (size_t k = 0; k < kinds && y->count < MOST_KINDS; k++) {
        if (strcmp(kind[k]->name, "linear") == 0) {
            continue;
        }
        accel *a = report_build(y->r, &y->s.loaded.scene, kind[k]->name);
        if (a == NULL) {
            return false;
        }
        y->at[y->count++] = (timed){kind[k]->name, a, y->r->built};
    }
    return true;
}

/* Ten times as many photons as long as they fit: a step takes ten times the one before. Errors come
 * from the structure built last, which is auto. */
static bool run_steps(study *y, double seconds)
{
    const double end = seconds_now() + seconds;
    int rounds = 0;
    for (uint32_t n = 1000; n <= MOST_PHOTONS; n *= 10, rounds++) {
        const double start = seconds_now();
        y->s.run.photons = n;
        if (!measure_errors(y, y->at[y->count - 1].a) || !time_all(y)) {
            return false;
        }
        const double next = 10.0 * (seconds_now() - start);
        if (rounds + 1 >= LEAST_ROUNDS && seconds_now() + next > end) {
            break;
        }
    }
    return true;
}

/* Adds to `note` who was slowest. */
static bool run_study(struct reporting *r, FILE *csv, bool plates, double seconds, char *note,
                      size_t capacity)
{
    study *y = calloc(1, sizeof *y);
    if (y == NULL) {
        complain(r->command, "no memory; nothing was written");
        return false;
    }
    y->r = r;
    y->csv = csv;
    const bool fine = (plates ? light_plates(&y->s, r) : light_teapots(&y->s, r, 0.15 * seconds)) &&
                      build_all(y) && run_steps(y, (plates ? 1.0 : 0.85) * seconds);
    if (fine) {
        const size_t used = strlen(note);
        snprintf(note + used, capacity - used,
                 " %s, %.0e photons: the slowest, <code>%s</code>, takes %.1f times as long as the "
                 "fastest, <code>%s</code>.",
                 y->s.title, (double)y->s.run.photons, y->at[y->worst].config,
                 y->total[y->worst] / y->total[y->best], y->at[y->best].config);
    }
    for (size_t i = 0; i < y->count; i++) {
        accel_free(y->at[i].a);
    }
    light_scene_free(&y->s);
    free(y);
    return fine;
}

/* The structure of the plot of radii: hoo, where it is there. */
static bool draw(struct reporting *r)
{
    return plot_draw(r, "light", "light", PLOT_KINDS, "by_structure = 1\none = ''\n") &&
           plot_draw(r, "light-radius", "light", PLOT_KINDS,
                     "by_structure = 0\n"
                     "one = strstrt(' '.forms, ' hoo ') ? 'hoo' : word(forms, 1)\n") &&
           plot_draw(r, "light-parts", "light-parts", PLOT_KINDS, "");
}

bool report_light(struct reporting *r, double seconds)
{
    if (!report_has_structures(r)) {
        return true;
    }
    FILE *csv = report_csv(r, csv_name, columns);
    if (csv == NULL) {
        return false;
    }
    char note[600] = "";
    const bool fine = run_study(r, csv, true, 0.35 * seconds, note, sizeof note) &&
                      run_study(r, csv, false, 0.65 * seconds, note, sizeof note);
    if (!fine) {
        fclose(csv);
        return false;
    }
    return report_csv_close(r, csv, csv_name) && draw(r) && page_set(r, "light", "%s", note);
}
