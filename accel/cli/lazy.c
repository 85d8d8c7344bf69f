/* SPDX-License-Identifier: Apache-2.0
 *
 * accel lazy: build and rays together, to the first 1, 10, 10^2, ... rays of a render: a structure
 * that is built where rays go against the same one built before the first ray; and the share of it
 * that the render never built.
 *
 * The render: primary, bounce and shadow rays of bench_rays.c in turn. Pixels come in random order,
 * which is the worst that can happen to a lazy build: the first rays go everywhere.
 */
#include "bench/bench.h"
#include "commands.h"
#include "tool/machine.h"
#include "tool/quantile.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

enum { FLAG_CONFIG, FLAG_RAYS, FLAG_REPEATS, FLAG_CSV };

static const struct flag flags[] = {
    [FLAG_CONFIG] = {"accelerator", 'a', "CONFIG",
                     "structure that has the option lazy (default: hoo)"},
    [FLAG_RAYS] = {"rays", 'n', "N", "rays of the render (default: 1000000)"},
    [FLAG_REPEATS] = {"repeats", 0, "N", "turns of each (default: 5)"},
    [FLAG_CSV] = {"csv", 0, "FILE", "write all figures there as well; " ACCEL_DASH},
};

enum { MOST_MARKS = 10, MOST_REPEATS = 51, JUDGED = 200 };

/* The two that are compared. */
enum { EAGER, LAZY, BOTH };

/* What was asked for. */
typedef struct request {
    const struct command *command;
    struct scene_names scenes;
    const char *config;
    uint64_t rays, repeats;
    bool quiet;
    bool headed; /* the head has been printed */
    const char *csv_name;
    FILE *csv;
} request;

/* One of the two. */
typedef struct contender {
    char config[200];
    double build[MOST_REPEATS];               /* seconds of processor time; sorted in the end */
    double seconds[MOST_MARKS][MOST_REPEATS]; /* the same to each mark, build included */
    accel_info info;                          /* after the rays of the last turn */
} contender;

/* One scene. */
typedef struct race {
    const request *request;
    struct bench bench; /* scene and rays */
    uint64_t rays;      /* of the render, at most as many as there are */
    uint64_t marks[MOST_MARKS];
    size_t mark_count;
    contender at[BOTH];
    uint64_t found; /* rays that hit */
} race;

/* -------------------------------------------------------------------- the render ---- */

/* Kinds of rays in the render. Where nothing is hit, there are only primary ones. */
static unsigned kinds_of_rays(const race *r)
{
    return r->bench.sets[SET_BOUNCE].count > 0 && r->bench.sets[SET_SHADOW].count > 0 ? 3 : 1;
}

static bool make_rays(race *r, const accel *a)
{
    static const int sets[] = {SET_PRIMARY, SET_BOUNCE, SET_SHADOW};
    const size_t count = (size_t)r->request->rays / 3 + 1;
    uint64_t least = count;
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) {
        struct ray_set *set = &r->bench.sets[sets[i]];
        if (!make_set(set, sets[i], count, a, &r->bench.loaded.scene)) {
            return false;
        }
        least = set->count > 0 && set->count < least ? set->count : least;
    }
    const uint64_t rays = least * kinds_of_rays(r);
    r->rays = rays < r->request->rays ? rays : r->request->rays;
    return true;
}

/* 1, 10, 100, ... and the last ray. */
static void set_marks(race *r)
{
    for (uint64_t mark = 1; mark < r->rays; mark *= 10) {
        r->marks[r->mark_count++] = mark;
    }
    r->marks[r->mark_count++] = r->rays;
}

/* Ray `i` of the render: does it hit? */
static bool trace_one(const race *r, const accel *a, uint64_t i, unsigned kinds)
{
    static const int sets[] = {SET_PRIMARY, SET_BOUNCE, SET_SHADOW};
    const struct ray_set *set = &r->bench.sets[sets[i % kinds]];
    const accel_ray *ray = &set->rays[i / kinds];
    accel_hit hit;
    return set->any ? accel_any(a, ray, NULL) : accel_closest(a, ray, &hit, NULL);
}

/* One build and render of one of the two. */
static int take_turn(race *r, int which, size_t turn)
{
    contender *c = &r->at[which];
    const unsigned kinds = kinds_of_rays(r);
    accel *a;
    accel_error error;
    uint64_t found = 0, i = 0;
    const accel_hooks hooks = {.threads = 1};
    const double start = machine_seconds();
    if (accel_build(&a, &r->bench.loaded.scene, c->config, &hooks, &error) != ACCEL_OK) {
        return complain(r->request->command, "%s", error.text);
    }
    c->build[turn] = machine_seconds() - start;
    for (size_t m = 0; m < r->mark_count; m++) {
        for (; i < r->marks[m]; i++) {
            found += trace_one(r, a, i, kinds);
        }
        c->seconds[m][turn] = machine_seconds() - start;
    }
    accel_describe(a, &c->info);
    accel_free(a);
    r->found = turn == 0 && which == EAGER ? found : r->found;
    if (found != r->found) {
        printf("DIFFERENT: %s: %s hits with %" PRIu64 " rays, %s with %" PRIu64 "\n",
               r->bench.scene_name, c->config, found, r->at[EAGER].config, r->found);
        return EXIT_DIFFERENT;
    }
    return EXIT_FINE;
}

static int take_turns(race *r, struct progress *progress)
{
    int code = EXIT_FINE;
    for (size_t turn = 0; turn < r->request->repeats && code == EXIT_FINE; turn++) {
        progress->what = r->bench.scene_name;
        progress_show(progress, "timed", (double)turn / (double)r->request->repeats);
        for (int which = 0; which < BOTH && code == EXIT_FINE; which++) {
            code = take_turn(r, which, turn);
        }
    }
    progress->what = NULL;
    progress_clear(progress);
    for (int which = 0; which < BOTH; which++) {
        sort_values(r->at[which].build, r->request->repeats);
        for (size_t m = 0; m < r->mark_count; m++) {
            sort_values(r->at[which].seconds[m], r->request->repeats);
        }
    }
    return code;
}

/* ------------------------------------------------------------------------ output ---- */

static void print_head(const request *r)
{
    char processor[256];
    machine_processor(processor, sizeof processor);
    printf("%s\n%s\n"
           "ms of processor time of one thread, build and rays, median of %" PRIu64
           " turns; above 1 lazy is faster\n",
           processor, machine_build(), r->repeats);
}

static double median(const race *r, const double *seconds)
{
    return quantile(seconds, r->request->repeats, 0.5);
}

static void print_row(const race *r, const char *name, const double *eager, const double *lazy)
{
    const double e = median(r, eager), l = median(r, lazy);
    printf("%10s %12.2f %12.2f %8.2f\n", name, 1e3 * e, 1e3 * l, e / l);
}

static double percent(uint64_t part, uint64_t whole)
{
    return whole > 0 ? 100.0 * (double)part / (double)whole : 0.0;
}

static void print_left(const char *what, uint64_t built, uint64_t whole)
{
    printf("  %-22s %12" PRIu64 " of %12" PRIu64 "  %6.2f %%\n", what, whole - built, whole,
           percent(whole - built, whole));
}

/* Primitives that can be hit and are in clusters. */
static uint64_t primitives(const accel_info *info)
{
    return info->primitives - info->skipped - info->degenerate - info->unbounded;
}

/* Where rays went nearly everywhere, the lists of parts take more than was saved. */
static void print_bytes(const accel_info *eager, const accel_info *lazy)
{
    const double saved = (double)eager->bytes - (double)lazy->bytes;
    printf("  %-22s %12.0f of %12" PRIu64 "  %6.2f %%\n", "bytes, all included", saved,
           eager->bytes, 100.0 * saved / (double)eager->bytes);
}

static void print_race(const race *r)
{
    const accel_info *eager = &r->at[EAGER].info, *lazy = &r->at[LAZY].info;
    printf("\n%s: %" PRIu64 " primitives, %" PRIu32 " clusters; every answer of both judged\n",
           r->bench.scene_name, eager->primitives, eager->clusters);
    printf("%10s %12s %12s %8s\n", "rays", "eager", "lazy", "ratio");
    print_row(r, "build", r->at[EAGER].build, r->at[LAZY].build);
    for (size_t m = 0; m < r->mark_count; m++) {
        char name[24];
        snprintf(name, sizeof name, "%" PRIu64, r->marks[m]);
        print_row(r, name, r->at[EAGER].seconds[m], r->at[LAZY].seconds[m]);
    }
    printf("never built by %" PRIu64 " rays, of %s:\n", r->rays, r->at[LAZY].config);
    print_left("clusters", eager->clusters - lazy->unbuilt_clusters, eager->clusters);
    print_left("primitives", primitives(eager) - lazy->unbuilt_primitives, primitives(eager));
    print_left("nodes", lazy->nodes, eager->nodes);
    print_bytes(eager, lazy);
}

static void write_csv(const race *r, FILE *csv)
{
    const accel_info *eager = &r->at[EAGER].info, *lazy = &r->at[LAZY].info;
    for (size_t m = 0; m < r->mark_count; m++) {
        fprintf(csv,
                "\"%s\",\"%s\",%" PRIu64 ",%.6f,%.6f,%" PRIu64 ",%" PRIu32 ",%" PRIu32 ",%" PRIu64
                ",%" PRIu64 ",%" PRIu64 ",%" PRIu64 "\n",
                r->bench.scene_name, r->request->config, r->marks[m],
                median(r, r->at[EAGER].seconds[m]), median(r, r->at[LAZY].seconds[m]), r->rays,
                lazy->unbuilt_clusters, eager->clusters, lazy->unbuilt_primitives,
                primitives(eager), lazy->bytes, eager->bytes);
    }
}

/* --------------------------------------------------------------------------- run ---- */

static void set_configs(race *r)
{
    static const char *const words[BOTH] = {"off", "on"};
    const char *config = r->request->config;
    for (int i = 0; i < BOTH; i++) {
        snprintf(r->at[i].config, sizeof r->at[i].config, "%.150s%clazy=%s", config,
                 strchr(config, ':') != NULL ? ',' : ':', words[i]);
    }
}

/* Both, built to be judged; linear judges a sample of them. */
static int judge(race *r, accel *const both[BOTH], struct progress *progress)
{
    struct bench_contender at[BOTH] = {{.state = both[EAGER]}, {.state = both[LAZY]}};
    accel *linear = open_structure(&r->bench.loaded, "linear", r->request->command, progress);
    if (linear == NULL) {
        return EXIT_BAD;
    }
    for (int i = 0; i < BOTH; i++) {
        snprintf(at[i].name, sizeof at[i].name, "%.63s", r->at[i].config);
    }
    r->bench.reference_name = at[EAGER].name;
    r->bench.at = at;
    r->bench.count = BOTH;
    const bool agree = bench_judge(&r->bench, linear, JUDGED, progress);
    r->bench.at = NULL;
    accel_free(linear);
    return agree ? EXIT_FINE : EXIT_DIFFERENT;
}

/* Makes the rays and has both answer all of them. */
static int prepare(race *r, struct progress *progress)
{
    const struct command *command = r->request->command;
    accel *both[BOTH] = {NULL, NULL};
    int code = EXIT_BAD;
    set_configs(r);
    for (int i = 0; i < BOTH; i++) {
        both[i] = open_structure(&r->bench.loaded, r->at[i].config, command, progress);
        if (both[i] == NULL) {
            break;
        }
    }
    if (both[LAZY] != NULL) {
        code = make_rays(r, both[EAGER])
                   ? judge(r, both, progress)
                   : complain(command, "no memory for %" PRIu64 " rays", r->request->rays);
    }
    accel_free(both[EAGER]);
    accel_free(both[LAZY]);
    return code;
}

static int run_race(request *q, race *r, struct progress *progress)
{
    int code = prepare(r, progress);
    if (code == EXIT_FINE) {
        set_marks(r);
        code = take_turns(r, progress);
    }
    if (code != EXIT_FINE) {
        return code;
    }
    if (!q->headed) {
        print_head(q);
        q->headed = true;
    }
    print_race(r);
    if (q->csv != NULL) {
        write_csv(r, q->csv);
    }
    return EXIT_FINE;
}

static int run_scene(request *q, const char *name)
{
    struct progress progress = progress_start(q->quiet);
    race r = {.request = q, .bench = {.scene_name = name}};
    if (!open_scene(&r.bench.loaded, name, q->command, &progress)) {
        return EXIT_BAD;
    }
    const int code = run_race(q, &r, &progress);
    for (int s = 0; s < SETS; s++) {
        free_set(&r.bench.sets[s]);
    }
    unload_scene(&r.bench.loaded);
    fflush(stdout);
    return code;
}

static int run_scenes(request *q)
{
    int worst = EXIT_FINE;
    for (size_t i = 0; i < q->scenes.count && worst != EXIT_BAD; i++) {
        const int code = run_scene(q, q->scenes.items[i]);
        worst = code > worst ? code : worst;
    }
    return worst;
}

/* The file of figures appears whole or not at all. */
static int run_into_file(request *q)
{
    if (q->csv_name == NULL) {
        return run_scenes(q);
    }
    struct output output;
    accel_error error;
    if (!output_open(&output, q->csv_name, &error)) {
        return complain(q->command, "%s", error.text);
    }
    q->csv = output.file;
    fprintf(q->csv, "scene,config,rays,eager_seconds,lazy_seconds,render_rays,unbuilt_clusters,"
                    "clusters,unbuilt_primitives,primitives,lazy_bytes,eager_bytes\n");
    return end_output(&output, run_scenes(q), EXIT_FINE, q->command);
}

static bool take(struct arguments *a, int flag, void *user)
{
    request *q = user;
    switch (flag) {
    case FLAG_CONFIG:
        q->config = a->value;
        return true;
    case FLAG_RAYS:
        return whole_argument(a, flag, 1, 100000000, &q->rays);
    case FLAG_REPEATS:
        return whole_argument(a, flag, 1, MOST_REPEATS, &q->repeats);
    case FLAG_CSV:
        q->csv_name = a->value;
        return true;
    default:
        return scene_names_add(&q->scenes, a->value, q->command);
    }
}

static int run(const struct command *command, int argc, char **argv)
{
    struct arguments arguments = arguments_start(command, argc, argv);
    request q = {.command = command, .config = "hoo", .rays = 1000000, .repeats = 5};
    if (!take_arguments(&arguments, take, &q)) {
        return arguments.exit_code;
    }
    if (q.scenes.count == 0) {
        return complain(command, "no SCENE is given; usage: accel %s %s", command->name,
                        command->arguments);
    }
    if (strstr(q.config, ":lazy=") != NULL || strstr(q.config, ",lazy=") != NULL) {
        return complain(command, "-a '%.100s' sets lazy; leave it out, both are built", q.config);
    }
    q.quiet = arguments.quiet;
    return run_into_file(&q);
}

const struct command command_lazy = {
    .name = "lazy",
    .arguments = "SCENE... [-a CONFIG] [--rays N] [--csv FILE]",
    .summary = "time to the first rays: built where rays go, or before",
    .details =
        "Builds CONFIG with lazy=off and with lazy=on in turns and traces a render: primary,\n"
        "bounce and shadow rays as accel bench makes them, one of each in turn, pixels in\n"
        "random order. Prints build and rays together up to 1, 10, 100, ... rays, and what\n"
        "the render never built. No time is printed before both have answered every ray\n"
        "with the same bits, of which linear judges a sample.",
    .flags = flags,
    .flag_count = sizeof flags / sizeof flags[0],
    .run = run,
};
