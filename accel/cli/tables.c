/* SPDX-License-Identifier: Apache-2.0
 *
 * accel tables: the two tables of the hierarchy-of-octrees paper, its figures beside ours.
 *
 * Ratios of illumination time only: the paper's seconds are a Pentium 4's. What the paper does not
 * state and is chosen here: the lights (see accel_scene_lights), reflectance 0.5, the photons and
 * the gaps of table 1, the leaf size of table 2.
 */
#include "commands.h"
#include "trials.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

enum { FLAG_TABLE, FLAG_QUICK, FLAG_PHOTONS, FLAG_REPEATS, FLAG_THREADS, FLAG_CSV };

static const accel_flag flags[] = {
    [FLAG_TABLE] = {"table", 0, "N", "only table 1 or 2"},
    [FLAG_QUICK] = {"quick", 0, NULL, "fewer photons, turns and gaps: a minute instead of an hour"},
    [FLAG_PHOTONS] = {"photons", 'n', "N",
                      "photons for each light (default: 200000 and 1000000; quick: 20000)"},
    [FLAG_REPEATS] = {"repeats", 0, "N", "turns of each structure (default: 11; quick: 3)"},
    [FLAG_THREADS] = {"threads", 't', "T", "default: 1"},
    [FLAG_CSV] = {"csv", 0, "FILE", "write all figures there as well"},
};

/* A line of a table. */
typedef struct row {
    const char *config;
    int base;     /* the line that this one's time is divided by: the paper's or our best hoo */
    double paper; /* seconds in the paper, or 0 */
} row;

/* Depth and leaf of the paper first, then each kind as it comes, which is its best. */
static const row rows1[] = {
    {"hoo:depth=3,leaf=12", 0, 139.0},
    {"octree:root=cube,depth=10,leaf=12", 0, 1147.0},
    {"octree:root=scene,depth=10,leaf=12", 0, 1147.0},
    {"hoo", 3, 0.0},
    {"octree:root=cube", 3, 0.0},
    {"octree:root=scene", 3, 0.0},
    {"bvh", 3, 0.0},
};

static const row rows2[] = {
    {"hoo:depth=4,leaf=12", 0, 64.55},
    {"hug:form=paper,cells=13", 0, 81.23},
    {"hoo:depth=5,leaf=12", 2, 52.19},
    {"hug:form=paper,cells=21", 2, 80.10},
    {"hoo:depth=6,leaf=12", 4, 48.73},
    {"hug:form=paper,cells=29", 4, 80.26},
    {"hoo:depth=7,leaf=12", 6, 48.74},
    {"hug:form=paper,cells=37", 6, 80.35},
    {"hoo:depth=8,leaf=12", 8, 49.35},
    {"hug:form=paper,cells=45", 8, 79.34},
    {"hoo:depth=9,leaf=12", 10, 49.97},
    {"hug:form=paper,cells=53", 10, 80.51},
    {"hoo", 12, 0.0},
    {"hug:form=density", 12, 0.0},
    {"octree", 12, 0.0},
    {"bvh", 12, 0.0},
};

enum {
    ROWS1 = sizeof rows1 / sizeof rows1[0],
    ROWS2 = sizeof rows2 / sizeof rows2[0],
    MOST_ROWS = 16
};

static const int gaps[] = {1, 2, 4, 8, 16, 32, 64, 128, 256};
static const int quick_gaps[] = {1, 16, 256};

/* What the user asked for. */
typedef struct request {
    unsigned table; /* 0: both */
    bool quick, quiet;
    uint64_t photons, repeats; /* 0: default */
    uint64_t threads;
    const char *csv_name;
    FILE *csv; /* or NULL */
} request;

/* Is the kind of `config` compiled into this library? */
static bool has_kind(const char *config)
{
    size_t count;
    const accel_kind_info *const *kinds = accel_kinds(&count);
    const size_t length = strcspn(config, ":");
    for (size_t i = 0; i < count; i++) {
        if (strlen(kinds[i]->name) == length && memcmp(kinds[i]->name, config, length) == 0) {
            return true;
        }
    }
    return false;
}

/* The rows whose kind is there, `left` of them, as trials; place[i] is row i's trial, or -1. */
static size_t choose(const row *rows, size_t count, accel_trial *trials, int *place)
{
    size_t left = 0;
    for (size_t i = 0; i < count; i++) {
        place[i] = -1;
        if (has_kind(rows[i].config)) {
            place[i] = (int)left;
            trials[left++] = (accel_trial){.config = rows[i].config};
        }
    }
    return left;
}

static void print_missing(const row *rows, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (!has_kind(rows[i].config)) {
            printf("Left out, its kind is not compiled in: %s\n", rows[i].config);
        }
    }
}

static void print_ratio(const row *rows, size_t i, const accel_trial *trial,
                        const accel_trial *base)
{
    const row *r = &rows[i];
    char ratio[20] = "-", gain[20] = "-", paper[20] = "-", paper_gain[20] = "-";
    if (base != NULL) {
        snprintf(ratio, sizeof ratio, "%.2f", trial->median / base->median);
        snprintf(gain, sizeof gain, "%.0f %%", 100.0 * (1.0 - base->median / trial->median));
    }
    if (r->paper > 0.0) {
        const double seconds = rows[r->base].paper;
        snprintf(paper, sizeof paper, "%.2f", r->paper / seconds);
        snprintf(paper_gain, sizeof paper_gain, "%.0f %%", 100.0 * (1.0 - seconds / r->paper));
    }
    printf("%-35s %6s %6s %6s %6s", r->config, ratio, paper, gain, paper_gain);
}

static void print_counts(const accel_trial *trial)
{
    const accel_photons *p = &trial->photons;
    const double rays = (double)p->rays;
    printf(" %7.0f %4.0f%% %7.2f %7.2f %8" PRIu64 " %8" PRIu64 " %8.0f\n",
           1e9 * trial->median / rays,
           50.0 * (trial->quartiles[1] - trial->quartiles[0]) / trial->median,
           (double)p->query.nodes / rays, (double)p->query.tests / rays,
           trial->info.nodes + trial->info.leaves, trial->info.references,
           (double)trial->info.bytes / 1024.0);
}

static void write_csv(FILE *csv, const char *scene, const row *r, const accel_trial *trial)
{
    const accel_photons *p = &trial->photons;
    fprintf(csv,
            "%s,\"%s\",%.9g,%.9g,%.9g,%.9g,%.9g,%" PRIu64 ",%zu,%" PRIu64 ",%" PRIu64 ",%" PRIu64
            ",%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%" PRIu32 "\n",
            scene, r->config, trial->median, trial->quartiles[0], trial->quartiles[1],
            trial->info.seconds, r->paper, p->rays, p->count, p->query.nodes, p->query.tests,
            trial->info.nodes, trial->info.leaves, trial->info.references, trial->info.bytes,
            trial->info.depth);
}

static void print_head(const accel_trials *t)
{
    printf("\n%s: %" PRIu32 " lights, %" PRIu32 " photons for each, %u turns, %u threads\n",
           t->scene, t->run.lights.count, t->run.photons, t->repeats, t->run.threads);
    printf("%-35s %6s %6s %6s %6s %7s %5s %7s %7s %8s %8s %8s\n", "structure", "T/hoo", "paper",
           "gain", "paper", "ns/ray", "+-", "nodes/r", "tests/r", "cells", "refs", "KiB");
}

/* One scene with its rows. Fills medians[i] with row i's time, 0 where it was left out. */
static int run_rows(const accel_command *command, const request *r, const char *scene,
                    const row *rows, size_t count, uint64_t photons, double *medians)
{
    accel_trial trials[MOST_ROWS];
    int place[MOST_ROWS];
    accel_progress progress = accel_progress_start(r->quiet);
    accel_trials t = {.scene = scene,
                      .at = trials,
                      .count = choose(rows, count, trials, place),
                      .repeats = r->repeats != 0 ? (unsigned)r->repeats
                                 : r->quick      ? 3
                                                 : 11};
    t.run = (accel_photon_run){.photons = (uint32_t)(r->photons != 0 ? r->photons : photons),
                               .reflectance = 0.5,
                               .seed = 1,
                               .threads = (unsigned)r->threads};
    const int code = accel_trials_run(&t, command, &progress);
    if (code == ACCEL_EXIT_BAD) {
        return code;
    }
    print_head(&t);
    for (size_t i = 0; i < count; i++) {
        medians[i] = 0.0;
        if (place[i] >= 0) {
            const int base = place[rows[i].base];
            const accel_trial *trial = &trials[place[i]];
            medians[i] = trial->median;
            print_ratio(rows, i, trial, base < 0 ? NULL : &trials[base]);
            print_counts(trial);
            if (r->csv != NULL) {
                write_csv(r->csv, scene, &rows[i], trial);
            }
        }
    }
    printf("hits of all: %zu, hash %016" PRIx64 "\n", trials[0].photons.count, t.hash);
    fflush(stdout);
    return code;
}

/* Ratios by gap; medians[gap][row]. */
static void print_sweep(const int *list, size_t count, double medians[][MOST_ROWS])
{
    printf("\nTime over hoo's, by gap between the clusters in cluster sides (paper: 8.25 at one)\n"
           "%-35s",
           "structure");
    for (size_t i = 0; i < count; i++) {
        printf(" %6d", list[i]);
    }
    for (size_t k = 0; k < ROWS1; k++) {
        printf("\n%-35s", rows1[k].config);
        for (size_t i = 0; i < count; i++) {
            const double time = medians[i][k], base = medians[i][rows1[k].base];
            char ratio[20] = "-";
            if (time > 0.0 && base > 0.0) {
                snprintf(ratio, sizeof ratio, "%.2f", time / base);
            }
            printf(" %6s", ratio);
        }
    }
    printf("\n\n");
}

static int run_table1(const accel_command *command, const request *r)
{
    printf("Table 1: one octree against the hierarchy of octrees, two clusters of cubes.\n"
           "Paper: 1147 s / 139 s = 8.25, gain 87 %%; its gap is not stated.\n");
    const int *list = r->quick ? quick_gaps : gaps;
    const size_t count =
        r->quick ? sizeof quick_gaps / sizeof quick_gaps[0] : sizeof gaps / sizeof gaps[0];
    double medians[sizeof gaps / sizeof gaps[0]][MOST_ROWS];
    int worst = ACCEL_EXIT_FINE;
    for (size_t i = 0; i < count && worst != ACCEL_EXIT_BAD; i++) {
        char scene[40];
        snprintf(scene, sizeof scene, "cubes:gap=%d", list[i]);
        const int code =
            run_rows(command, r, scene, rows1, ROWS1, r->quick ? 20000 : 200000, medians[i]);
        worst = code > worst ? code : worst;
    }
    if (worst != ACCEL_EXIT_BAD) {
        print_sweep(list, count, medians);
    }
    return worst;
}

static int run_table2(const accel_command *command, const request *r)
{
    printf("Table 2: hierarchy of octrees against hierarchy of uniform grids, nine teapots and a "
           "floor.\nEach hug is divided by the hoo above it, as in the paper.\n");
    print_missing(rows2, ROWS2);
    double medians[MOST_ROWS];
    return run_rows(command, r, "teapots", rows2, ROWS2, r->quick ? 20000 : 1000000, medians);
}

static int run_tables(const accel_command *command, request *r)
{
    if (r->csv_name != NULL) {
        r->csv = fopen(r->csv_name, "w");
        if (r->csv == NULL) {
            return accel_complain(command, "cannot write %s: %s", r->csv_name, strerror(errno));
        }
        fprintf(r->csv, "scene,config,seconds,quartile1,quartile3,build_seconds,paper_seconds,rays,"
                        "hits,nodes_visited,tests,nodes,leaves,references,bytes,depth\n");
    }
    const int first = r->table == 2 ? ACCEL_EXIT_FINE : run_table1(command, r);
    const int second =
        r->table == 1 || first == ACCEL_EXIT_BAD ? ACCEL_EXIT_FINE : run_table2(command, r);
    const int worst = first > second ? first : second;
    if (r->csv != NULL && fclose(r->csv) != 0) {
        return accel_complain(command, "cannot write %s: %s", r->csv_name, strerror(errno));
    }
    return worst;
}

static bool read_flag(const accel_arguments *a, int flag, request *r)
{
    uint64_t table;
    switch (flag) {
    case FLAG_TABLE:
        if (!accel_whole_argument(a, flag, 1, 2, &table)) {
            return false;
        }
        r->table = (unsigned)table;
        return true;
    case FLAG_QUICK:
        r->quick = true;
        return true;
    case FLAG_PHOTONS:
        return accel_whole_argument(a, flag, 1, 100000000, &r->photons);
    case FLAG_REPEATS:
        return accel_whole_argument(a, flag, 1, ACCEL_MOST_REPEATS, &r->repeats);
    case FLAG_THREADS:
        return accel_whole_argument(a, flag, 1, 1024, &r->threads);
    case FLAG_CSV:
        r->csv_name = a->value;
        return true;
    default:
        accel_complain(a->command, "unexpected '%.60s'", a->value);
        return false;
    }
}

static int run(const accel_command *command, int argc, char **argv)
{
    request r = {.threads = 1};
    accel_arguments arguments = accel_arguments_start(command, argc, argv);
    int flag;
    while ((flag = accel_next_argument(&arguments)) != ACCEL_ARGUMENT_END) {
        if (flag == ACCEL_ARGUMENT_STOP) {
            return arguments.exit_code;
        }
        if (!read_flag(&arguments, flag, &r)) {
            return ACCEL_EXIT_BAD;
        }
    }
    r.quiet = arguments.quiet;
    return run_tables(command, &r);
}

const accel_command accel_command_tables = {
    .name = "tables",
    .arguments = "[OPTION]...",
    .summary = "the two tables of the paper on hierarchies of octrees, its figures beside ours",
    .details =
        "Times photon illumination (see 'accel photons'). Structures take turns; a line shows\n"
        "the median of its turns divided by that of the hoo it is compared with, half the\n"
        "distance of the quartiles, and the counts that explain it. The first lines are the\n"
        "paper's settings, the last ones each kind as it comes. Exit code 1 if two\n"
        "structures stored different hits.",
    .flags = flags,
    .flag_count = sizeof flags / sizeof flags[0],
    .run = run,
};
