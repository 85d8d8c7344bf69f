/* SPDX-License-Identifier: Apache-2.0
 *
 * accel clusters: the time that hoo takes to find its clusters, from 10^4 primitives on, beside
 * that of its whole build. Per primitive it should stay level as scenes grow.
 */
#include "commands.h"
#include "tool/machine.h"
#include "tool/quantile.h"
#include "structure.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { FLAG_MOST, FLAG_REPEATS, FLAG_CSV };

static const struct flag flags[] = {
    [FLAG_MOST] = {"most", 'n', "N", "largest size of a family (default: 10000000)"},
    [FLAG_REPEATS] = {"repeats", 0, "N", "turns for each scene, at least (default: 3)"},
    [FLAG_CSV] = {"csv", 0, "FILE", "write all figures there as well; " ACCEL_DASH},
};

enum { MOST_REPEATS = 51, LEAST = 10000 };

/* A generator that grows: `option` is `per` * n^power for n primitives, at most `last`. */
typedef struct family {
    const char *name, *option;
    double per, power, last;
} family;

static const family families[] = {
    {"soup", "n", 1.0, 1.0, 1e8},
    {"spheres", "n", 1.0, 1.0, 1e8},
    {"cubes", "side", 0.34668063717531733, 1.0 / 3.0,
     150.0},                                  /* 24 triangles for each cube of a cluster */
    {"teapots", "quads", 0.0405, 0.5, 300.0}, /* 49,370 triangles at 9 */
    {"stadium", "quads", 0.1255, 0.5, 300.0}, /* 101,760 triangles at 40 */
};

enum { FAMILIES = sizeof families / sizeof families[0] };

/* What was asked for. */
typedef struct request {
    const struct command *command;
    struct scene_names scenes;
    uint64_t most, repeats;
    bool quiet;
    bool headed; /* the head has been printed */
    const char *csv_name;
    FILE *csv;
} request;

/* One scene's builds. */
typedef struct figures {
    const char *scene;
    double clusters[MOST_REPEATS], builds[MOST_REPEATS]; /* seconds; sorted in the end */
    size_t turns;                                        /* taken */
    accel_info info;                                     /* of the last turn */
} figures;

/* ------------------------------------------------------------------------ output ---- */

static void print_head(const request *r)
{
    char processor[256];
    machine_processor(processor, sizeof processor);
    printf("%s\n%s\n"
           "ms of processor time of one thread, median of %" PRIu64 " turns or more\n\n"
           "%-28s %10s %8s %6s %12s %12s %10s %7s\n",
           processor, machine_build(), r->repeats, "scene", "primitives", "clusters", "sizes",
           "clustering", "ns/primitive", "build", "share");
}

static void print_row(request *r, const figures *f)
{
    if (!r->headed) {
        print_head(r);
        r->headed = true;
    }
    const double clusters = quantile(f->clusters, f->turns, 0.5);
    const double build = quantile(f->builds, f->turns, 0.5);
    const double each = f->info.primitives > 0 ? clusters / (double)f->info.primitives : 0.0;
    printf("%-28s %10" PRIu64 " %8" PRIu32 " %6" PRIu32 " %12.3f %12.1f %10.2f %5.1f %%\n",
           f->scene, f->info.primitives, f->info.clusters, f->info.size_classes, 1e3 * clusters,
           1e9 * each, 1e3 * build, 100.0 * clusters / build);
    fflush(stdout);
    if (r->csv != NULL) {
        fprintf(r->csv, "\"%s\",%" PRIu64 ",%" PRIu32 ",%" PRIu32 ",%.6f,%.6f\n", f->scene,
                f->info.primitives, f->info.clusters, f->info.size_classes, clusters, build);
    }
}

/* --------------------------------------------------------------------------- run ---- */

/* The part of a build that finds clusters. */
static double cluster_part(const accel_info *info)
{
    for (uint32_t i = 0; i < info->phase_count; i++) {
        if (strcmp(info->phases[i].name, "clusters") == 0) {
            return info->phases[i].seconds / info->seconds;
        }
    }
    return 0.0;
}

/* The library notes its phases by the clock on the wall; other programs stop all of them alike. */
static bool take_turn(const request *r, const struct loaded *loaded, figures *f, size_t turn,
                      struct progress *progress)
{
    const accel_hooks hooks = {.user = progress, .progress = progress_build, .threads = 1};
    accel *a;
    accel_error error;
    progress->what = "hoo";
    const double start = machine_seconds();
    const accel_status status = accel_build(&a, &loaded->scene, "hoo", &hooks, &error);
    f->builds[turn] = machine_seconds() - start;
    progress->what = NULL;
    progress_clear(progress);
    if (status != ACCEL_OK) {
        complain(r->command, "%s", error.text);
        return false;
    }
    accel_describe(a, &f->info);
    f->clusters[turn] = f->builds[turn] * cluster_part(&f->info);
    accel_free(a);
    return true;
}

/* As many as asked for; of short builds, whose times are easily disturbed, for half a second. */
static bool more_turns(const request *r, const figures *f, double spent)
{
    return f->turns < r->repeats || (f->turns < MOST_REPEATS && spent < 0.5);
}

static int run_scene(request *r, const char *name)
{
    struct progress progress = progress_start(r->quiet);
    struct loaded loaded;
    figures f = {.scene = name};
    bool fine = open_scene(&loaded, name, r->command, &progress);
    if (!fine) {
        return EXIT_BAD;
    }
    for (double spent = 0.0; fine && more_turns(r, &f, spent); f.turns++) {
        fine = take_turn(r, &loaded, &f, f.turns, &progress);
        spent += f.builds[f.turns];
    }
    unload_scene(&loaded);
    if (!fine) {
        return EXIT_BAD;
    }
    sort_values(f.clusters, f.turns);
    sort_values(f.builds, f.turns);
    print_row(r, &f);
    return EXIT_FINE;
}

/* Sizes 10^4, 10^5, ... of a family. */
static int run_family(request *r, const family *g)
{
    int code = EXIT_FINE;
    for (uint64_t n = LEAST; n <= r->most && code == EXIT_FINE; n *= 10) {
        const double value = round(g->per * pow((double)n, g->power));
        char name[64];
        if (value > g->last) {
            break;
        }
        snprintf(name, sizeof name, "%s:%s=%.0f", g->name, g->option, value);
        code = run_scene(r, name);
    }
    return code;
}

static int run_word(request *r, const char *word)
{
    for (size_t i = 0; i < FAMILIES; i++) {
        if (strcmp(families[i].name, word) == 0) {
            return run_family(r, &families[i]);
        }
    }
    return run_scene(r, word);
}

static int run_words(request *r)
{
    int code = EXIT_FINE;
    for (size_t i = 0; i < r->scenes.count && code == EXIT_FINE; i++) {
        code = run_word(r, r->scenes.items[i]);
    }
    return code;
}

/* The file of figures appears whole or not at all. */
static int run_into_file(request *r)
{
    if (r->csv_name == NULL) {
        return run_words(r);
    }
    struct output output;
    accel_error error;
    if (!output_open(&output, r->csv_name, &error)) {
        return complain(r->command, "%s", error.text);
    }
    r->csv = output.file;
    fprintf(r->csv, "scene,primitives,clusters,size_classes,cluster_seconds,build_seconds\n");
    return end_output(&output, run_words(r), EXIT_FINE, r->command);
}

static bool take(struct arguments *a, int flag, void *user)
{
    request *r = user;
    switch (flag) {
    case FLAG_MOST:
        return whole_argument(a, flag, LEAST, 30000000, &r->most);
    case FLAG_REPEATS:
        return whole_argument(a, flag, 1, MOST_REPEATS, &r->repeats);
    case FLAG_CSV:
        r->csv_name = a->value;
        return true;
    default:
        return scene_names_add(&r->scenes, a->value, r->command);
    }
}

static int run(const struct command *command, int argc, char **argv)
{
    struct arguments arguments = arguments_start(command, argc, argv);
    request r = {.command = command, .most = 10000000, .repeats = 3};
    if (!take_arguments(&arguments, take, &r)) {
        return arguments.exit_code;
    }
    r.quiet = arguments.quiet;
    for (size_t i = 0; r.scenes.count == 0 && i < FAMILIES; i++) {
        r.scenes.items[i] = families[i].name;
    }
    r.scenes.count = r.scenes.count > 0 ? r.scenes.count : FAMILIES;
    return run_into_file(&r);
}

const struct command command_clusters = {
    .name = "clusters",
    .arguments = "[SCENE|FAMILY]... [--most N] [--csv FILE]",
    .summary = "time to find clusters, from 10^4 to 10^7 primitives",
    .details =
        "Builds hoo and prints the time that its clusters take beside that of the whole build.\n"
        "FAMILY is soup, spheres, cubes, teapots or stadium: scenes of about 10^4, 10^5, 10^6\n"
        "and 10^7 primitives (stadium: to 10^6); without an argument, all. 10^7 take up to 8 GB.\n"
        "The clusters' part of the processor time is their part of the time on the clock.",
    .flags = flags,
    .flag_count = sizeof flags / sizeof flags[0],
    .run = run,
};
