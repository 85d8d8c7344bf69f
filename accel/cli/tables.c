/* SPDX-License-Identifier: Apache-2.0
 *
 * accel tables: the two tables of the hierarchy-of-octrees paper, its figures beside ours; and, as
 * its last section asks, other distributions and larger scenes.
 *
 * Ratios of illumination time only: the paper's seconds are a Pentium 4's, ours are processor time.
 * What the paper does not state and is chosen here: the lights (see scene_lights),
 * reflectance 0.5, the photons and the gaps of table 1, the leaf size of table 2.
 */
#include "commands.h"
#include "tables/tables.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

enum { FLAG_TABLE, FLAG_QUICK, FLAG_PHOTONS, FLAG_REPEATS, FLAG_THREADS, FLAG_CSV };

static const struct flag flags[] = {
    [FLAG_TABLE] = {"table", 0, "N", "only table 1, 2 or 3"},
    [FLAG_QUICK] = {"quick", 0, NULL,
                    "fewer photons, turns and gaps: seconds instead of ten minutes"},
    [FLAG_PHOTONS] = {"photons", 'n', "N",
                      "photons for each light (default: 200000, 1000000, 200000; quick: 20000)"},
    [FLAG_REPEATS] = {"repeats", 0, "N", "turns of each structure (default: 11; quick: 3)"},
    [FLAG_THREADS] = {"threads", 't', "T", "default: 1"},
    [FLAG_CSV] = {"csv", 0, "FILE", "write all figures there as well; " ACCEL_DASH},
};

/* Depth and leaf of the paper, then each kind as it comes, then each with its best option. */
static const struct table_row rows1[] = {
    {"hoo:depth=3,leaf=12", 0, 139.0},
    {"octree:root=cube,depth=10,leaf=12", 0, 1147.0},
    {"octree:root=scene,depth=10,leaf=12", 0, 1147.0},
    {"hoo:form=classic", 3, 0.0},
    {"octree:form=classic,root=cube", 3, 0.0},
    {"octree:root=scene", 3, 0.0},
    {"bvh", 3, 0.0},
    {"hoo:leaf=?", 7, 0.0},
    {"octree:root=cube,leaf=?", 7, 0.0},
    {"octree:root=scene,leaf=?", 7, 0.0},
};

static const struct table_row rows2[] = {
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
    {"hoo:form=classic", 12, 0.0},
    {"hug", 12, 0.0},
    {"bvh", 12, 0.0},
    {"hoo:leaf=?", 15, 0.0},
    {"hug:density=?", 15, 0.0},
    {"octree:leaf=?", 15, 0.0},
};

/* Every kind as it comes. */
static const struct table_row rows3[] = {
    {"hoo:form=classic", 0, 0.0},
    {"octree:form=classic", 0, 0.0},
    {"hug", 0, 0.0},
    {"grid", 0, 0.0},
    {"bsp", 0, 0.0},
    {"bvh", 0, 0.0},
};

static const char *const scenes3[] = {
    "cubes:gap=0,space=0.1", /* one cluster for the eye */
    "soup:n=20000",          /* sizes from 1e-6 to 1, none near its like */
    "spheres:n=20000",       /* even */
    "stadium",               /* one small thing in a large one */
    "teapots:quads=30",      /* table 2 with eleven times as many triangles */
};

/* Of these the first QUICK_SCENES are quick. */
enum { SCENES3 = sizeof scenes3 / sizeof scenes3[0], QUICK_SCENES = 3 };

enum {
    ROWS1 = sizeof rows1 / sizeof rows1[0],
    ROWS2 = sizeof rows2 / sizeof rows2[0],
    ROWS3 = sizeof rows3 / sizeof rows3[0],
};

static const int gaps[] = {1, 2, 4, 8, 16, 32, 64, 128, 256, 512};
static const int quick_gaps[] = {1, 16, 512};

enum { MOST_GAPS = sizeof gaps / sizeof gaps[0] };

/* The results of table 1 by gap and row. */
typedef struct sweep {
    const int *gaps;
    size_t count; /* of them */
    struct table_result at[MOST_GAPS][MOST_ROWS];
} sweep;

static double time_ratio(const struct table_result *row, const struct table_result *base)
{
    return row->seconds / base->seconds;
}

static double node_count(const struct table_result *row, const struct table_result *base)
{
    (void)base;
    return row->nodes;
}

static double test_count(const struct table_result *row, const struct table_result *base)
{
    (void)base;
    return row->tests;
}

/* One figure of every row by gap. */
static void print_sweep(const sweep *s, const char *title,
                        double (*figure)(const struct table_result *, const struct table_result *))
{
    printf("\n%s\n%-39s", title, "gap between the clusters, cluster sides");
    for (size_t i = 0; i < s->count; i++) {
        printf(" %7d", s->gaps[i]);
    }
    for (size_t k = 0; k < ROWS1; k++) {
        printf("\n%-39s", rows1[k].config);
        for (size_t i = 0; i < s->count; i++) {
            const struct table_result *row = &s->at[i][k], *base = &s->at[i][rows1[k].base];
            if (row->seconds > 0.0 && base->seconds > 0.0) {
                printf(" %7.2f", figure(row, base));
            } else {
                printf(" %7s", "-");
            }
        }
    }
    printf("\n");
}

static int run_table1(const struct command *command, const struct table_request *r)
{
    printf("Table 1: one octree against the hierarchy of octrees, two clusters of cubes.\n"
           "Paper: 1147 s / 139 s = 8.25, gain 87 %%; its gap is not stated.\n");
    table_missing(rows1, ROWS1);
    sweep s = {.gaps = r->quick ? quick_gaps : gaps,
               .count = r->quick ? sizeof quick_gaps / sizeof quick_gaps[0] : MOST_GAPS};
    int worst = EXIT_FINE;
    for (size_t i = 0; i < s.count && worst != EXIT_BAD; i++) {
        char scene[40];
        snprintf(scene, sizeof scene, "cubes:gap=%d", s.gaps[i]);
        const int code =
            table_run(command, r, scene, rows1, ROWS1, r->quick ? 20000 : 200000, s.at[i]);
        worst = code > worst ? code : worst;
    }
    if (worst != EXIT_BAD) {
        print_sweep(&s, "Time over that of the hoo it is compared with (paper: 8.25, at one gap)",
                    time_ratio);
        print_sweep(&s, "Nodes visited per ray", node_count);
        print_sweep(&s, "Triangles tested per ray", test_count);
        printf("\n");
    }
    return worst;
}

static int run_table2(const struct command *command, const struct table_request *r)
{
    printf("Table 2: hierarchy of octrees against hierarchy of uniform grids, nine teapots and a "
           "floor.\nEach hug is divided by the hoo above it, as in the paper.\n");
    table_missing(rows2, ROWS2);
    struct table_result results[MOST_ROWS];
    return table_run(command, r, "teapots", rows2, ROWS2, r->quick ? 20000 : 1000000, results);
}

static int run_table3(const struct command *command, const struct table_request *r)
{
    printf("\nTable 3, not in the paper: every kind as it comes, on other distributions.\n");
    table_missing(rows3, ROWS3);
    int worst = EXIT_FINE;
    for (size_t i = 0; i < (r->quick ? QUICK_SCENES : SCENES3) && worst != EXIT_BAD; i++) {
        struct table_result results[MOST_ROWS];
        const int code =
            table_run(command, r, scenes3[i], rows3, ROWS3, r->quick ? 20000 : 200000, results);
        worst = code > worst ? code : worst;
    }
    return worst;
}

static int run_tables(const struct command *command, const struct table_request *r)
{
    int (*const tables[])(const struct command *,
                          const struct table_request *) = {run_table1, run_table2, run_table3};
    int worst = EXIT_FINE;
    for (unsigned i = 0; i < 3 && worst != EXIT_BAD; i++) {
        const int code = r->table == 0 || r->table == i + 1 ? tables[i](command, r) : EXIT_FINE;
        worst = code > worst ? code : worst;
    }
    return worst;
}

/* The file of figures appears whole or not at all. */
static int run_into_file(const struct command *command, struct table_request *r)
{
    if (r->csv_name == NULL) {
        return run_tables(command, r);
    }
    struct output output;
    accel_error error;
    if (!output_open(&output, r->csv_name, &error)) {
        return complain(command, "%s", error.text);
    }
    r->csv = output.file;
    fprintf(r->csv, "scene,config,seconds,quartile1,quartile3,build_seconds,paper_seconds,rays,"
                    "hits,nodes_visited,tests,nodes,leaves,references,bytes,depth\n");
    return end_output(&output, run_tables(command, r), EXIT_DIFFERENT, command);
}

static bool take(struct arguments *a, int flag, void *request)
{
    struct table_request *r = request;
    uint64_t table;
    switch (flag) {
    case FLAG_TABLE:
        if (!whole_argument(a, flag, 1, 3, &table)) {
            return false;
        }
        r->table = (unsigned)table;
        return true;
    case FLAG_QUICK:
        r->quick = true;
        return true;
    case FLAG_PHOTONS:
        return whole_argument(a, flag, 1, 100000000, &r->photons);
    case FLAG_REPEATS:
        return whole_argument(a, flag, 1, MOST_REPEATS, &r->repeats);
    case FLAG_THREADS:
        return whole_argument(a, flag, 1, 1024, &r->threads);
    case FLAG_CSV:
        r->csv_name = a->value;
        return true;
    default:
        complain(a->command, "unexpected '%.60s'", a->value);
        return false;
    }
}

static int run(const struct command *command, int argc, char **argv)
{
    struct table_request r = {.threads = 1};
    struct arguments arguments = arguments_start(command, argc, argv);
    if (!take_arguments(&arguments, take, &r)) {
        return arguments.exit_code;
    }
    r.quiet = arguments.quiet;
    return run_into_file(command, &r);
}

const struct command command_tables = {
    .name = "tables",
    .arguments = "[OPTION]...",
    .summary =
        "the tables of the paper on hierarchies of octrees, and one more, its figures beside ours",
    .details =
        "Times photon illumination (see 'accel photons'). Structures take turns; a line shows\n"
        "the median of its turns divided by that of the hoo it is compared with, half the\n"
        "distance of the quartiles, and the counts that explain it. The first lines are the\n"
        "paper's settings, then each kind as it comes, then each with the best of seven values\n"
        "of its option. Exit code 1 if two structures stored different hits.",
    .flags = flags,
    .flag_count = sizeof flags / sizeof flags[0],
    .run = run,
};
