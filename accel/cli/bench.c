/* SPDX-License-Identifier: Apache-2.0
 *
 * accel bench: build time, memory, counts and time per ray of structures and peers on the same
 * rays, and how far `auto` is from the best choice.
 */
#include "bench.h"
#include "commands.h"
#include "machine.h"
#include "output.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FLAG_CONFIG, FLAG_RAYS, FLAG_COUNT, FLAG_REPEATS, FLAG_SAMPLE, FLAG_PEERS, FLAG_CSV };

static const accel_flag flags[] = {
    [FLAG_CONFIG] = {"accelerator", 'a', "CONFIG",
                     "structure, may be repeated (default: every kind but linear)"},
    [FLAG_RAYS] = {"rays", 0, "LIST", "of primary,bounce,shadow,photon (default: all)"},
    [FLAG_COUNT] = {"count", 'n', "N", "rays of each kind (default: 100000)"},
    [FLAG_REPEATS] = {"repeats", 0, "N", "turns of each contender (default: 5)"},
    [FLAG_SAMPLE] = {"judged", 0, "N", "rays of each kind that linear judges (default: 200)"},
    [FLAG_PEERS] = {"peers", 0, NULL, "Embree as well: medium and high, fast and robust"},
    [FLAG_CSV] = {"csv", 0, "FILE", "write all figures there as well"},
};

enum { MOST_SCENES = 64 };

/* What was asked for. */
typedef struct request {
    const accel_command *command;
    const char *scenes[MOST_SCENES];
    size_t scene_count;
    accel_configs configs;
    bool sets[ACCEL_SETS];
    uint64_t count, repeats, sample;
    bool peers, quiet;
    bool headed; /* the head has been printed */
    const char *csv_name;
    FILE *csv;
    double regret_sum, regret_worst; /* of auto over the scenes */
    size_t regret_count;             /* scenes where it was measured */
    const char *regret_scene;        /* the worst */
} request;

/* ------------------------------------------------------------- our structures ---- */

static size_t trace_ours(const accel_contender *c, const accel_ray_set *set)
{
    size_t found = 0;
    accel_hit hit;
    for (size_t i = 0; i < set->count; i++) {
        found += set->any ? accel_any(c->state, &set->rays[i], NULL)
                          : accel_closest(c->state, &set->rays[i], &hit, NULL);
    }
    return found;
}

static void end_ours(accel_contender *c)
{
    accel_free(c->state);
}

static bool make_ours(accel_contender *c, const char *config, const accel_bench *b,
                      const request *r, accel_progress *progress)
{
    accel *a = accel_open_structure(&b->loaded, config, r->command, progress);
    if (a == NULL) {
        return false;
    }
    accel_info info;
    accel_describe(a, &info);
    *c = (accel_contender){.state = a,
                           .build_seconds = info.seconds,
                           .bytes = (double)info.bytes,
                           .trace = trace_ours,
                           .end = end_ours};
    snprintf(c->name, sizeof c->name, "%.63s", config);
    return true;
}

/* --------------------------------------------------------------------- output ---- */

static void print_head(const request *r)
{
    char processor[256];
    accel_machine_processor(processor, sizeof processor);
    printf("%s\n%s\n"
           "ns per ray: processor time of one thread, median of %" PRIu64
           " turns (quartiles), %" PRIu64 " rays of each kind\n",
           processor, accel_machine_build(), r->repeats, r->count);
    if (r->peers && accel_bench_no_peers() != NULL) {
        printf("%s\n", accel_bench_no_peers());
    } else if (r->peers) {
        printf("Embree: single precision, no primitive is skipped; 'other' counts its answers that "
               "name another\nprimitive than ours or none\n");
    }
}

static void print_row(const accel_bench *b, size_t c)
{
    const accel_contender *x = &b->at[c];
    const double n = (double)accel_scene_primitives(&b->loaded.scene);
    printf("%-26s %9.1f %7.1f", x->name, 1e3 * x->build_seconds, n > 0 ? x->bytes / n : 0.0);
    for (int s = 0; s < ACCEL_SETS; s++) {
        if (b->sets[s].count == 0) {
            continue;
        }
        printf("  %6.0f (%.0f-%.0f)", accel_bench_ns(b, c, s, 0.5), accel_bench_ns(b, c, s, 0.25),
               accel_bench_ns(b, c, s, 0.75));
        if (x->peer) {
            printf(" other %zu", x->wrong[s]);
        } else {
            printf(" %.1f+%.1f", x->nodes[s], x->tests[s]);
        }
    }
    printf("\n");
}

static void print_bench(const accel_bench *b)
{
    printf("\n%s: %" PRIu64 " primitives; every answer of ours judged\n", b->scene_name,
           accel_scene_primitives(&b->loaded.scene));
    printf("%-26s %9s %7s", "", "build ms", "B/prim");
    for (int s = 0; s < ACCEL_SETS; s++) {
        if (b->sets[s].count > 0) {
            printf("  %s ns nodes+tests", b->sets[s].name);
        }
    }
    printf("\n");
    for (size_t c = 0; c < b->count; c++) {
        print_row(b, c);
    }
}

static void write_csv(const accel_bench *b, FILE *csv)
{
    for (size_t c = 0; c < b->count; c++) {
        const accel_contender *x = &b->at[c];
        for (int s = 0; s < ACCEL_SETS; s++) {
            if (b->sets[s].count == 0) {
                continue;
            }
            fprintf(csv, "\"%s\",\"%s\",%s,%zu,%.6f,%.0f,%.3f,%.3f,%.3f,%.3f,%.3f,%zu\n",
                    b->scene_name, x->name, b->sets[s].name, b->sets[s].count, x->build_seconds,
                    x->bytes, x->nodes[s], x->tests[s], accel_bench_ns(b, c, s, 0.25),
                    accel_bench_ns(b, c, s, 0.5), accel_bench_ns(b, c, s, 0.75), x->wrong[s]);
        }
    }
}

/* --------------------------------------------------------------------- regret ---- */

/* The rays that auto assumes unless told otherwise. */
#define AUTO_RAYS 1e7

/* Build and AUTO_RAYS rays, an even mix of the kinds that were timed. */
static double total_seconds(const accel_bench *b, size_t c)
{
    double sum = 0.0;
    int sets = 0;
    for (int s = 0; s < ACCEL_SETS; s++) {
        if (b->sets[s].count > 0) {
            sum += accel_bench_ns(b, c, s, 0.5);
            sets++;
        }
    }
    return b->at[c].build_seconds + 1e-9 * AUTO_RAYS * sum / sets;
}

/* What auto lost by its choice, its own time included, against the best of the others. */
static void note_regret(request *r, const accel_bench *b)
{
    double chosen = 0.0, best = (double)INFINITY;
    for (size_t c = 0; c < b->count; c++) {
        if (strcmp(b->at[c].name, "auto") == 0) {
            chosen = total_seconds(b, c);
        } else if (!b->at[c].peer) {
            best = fmin(best, total_seconds(b, c));
        }
    }
    if (chosen == 0.0 || isinf(best)) {
        return;
    }
    const double regret = fmax(1.0, chosen / best);
    printf("auto: %.3f s for its choice and %g rays, %.3f s for the best: regret %.3f\n", chosen,
           AUTO_RAYS, best, regret);
    r->regret_sum += regret;
    r->regret_count++;
    if (regret > r->regret_worst) {
        r->regret_worst = regret;
        r->regret_scene = b->scene_name;
    }
}

/* ------------------------------------------------------------------------ run ---- */

static bool make_sets(accel_bench *b, const request *r)
{
    for (int s = 0; s < ACCEL_SETS; s++) {
        if (r->sets[s] &&
            !accel_make_set(&b->sets[s], s, r->count, b->at[0].state, &b->loaded.scene)) {
            accel_complain(r->command, "no memory for %" PRIu64 " rays", r->count);
            return false;
        }
    }
    return true;
}

static bool make_contenders(accel_bench *b, const request *r, accel_progress *progress)
{
    b->at = calloc(r->configs.count + ACCEL_MOST_PEERS, sizeof *b->at);
    if (b->at == NULL) {
        accel_complain(r->command, "no memory for %zu contenders", r->configs.count);
        return false;
    }
    for (size_t i = 0; i < r->configs.count; i++) {
        if (!make_ours(&b->at[i], r->configs.items[i], b, r, progress)) {
            return false;
        }
        b->count++;
    }
    if (r->peers) {
        accel_box box;
        accel_scene_box(&b->loaded.scene, &box);
        const double length = sqrt(pow(box.hi[0] - box.lo[0], 2) + pow(box.hi[1] - box.lo[1], 2) +
                                   pow(box.hi[2] - box.lo[2], 2));
        b->count += accel_bench_peers(b->at + b->count, &b->loaded.scene, length);
    }
    return make_sets(b, r);
}

static void end_bench(accel_bench *b)
{
    for (size_t c = 0; c < b->count; c++) {
        b->at[c].end(&b->at[c]);
    }
    for (int s = 0; s < ACCEL_SETS; s++) {
        accel_free_set(&b->sets[s]);
    }
    free(b->at);
    accel_unload_scene(&b->loaded);
}

static int run_made(request *r, accel_bench *b, accel_progress *progress)
{
    accel *linear = accel_open_structure(&b->loaded, "linear", r->command, progress);
    if (linear == NULL) {
        return ACCEL_EXIT_BAD;
    }
    const bool agrees = accel_bench_judge(b, linear, r->sample, progress);
    accel_free(linear);
    if (!agrees || !accel_bench_time(b, progress)) {
        return ACCEL_EXIT_DIFFERENT;
    }
    if (!r->headed) {
        print_head(r);
        r->headed = true;
    }
    print_bench(b);
    note_regret(r, b);
    if (r->csv != NULL) {
        write_csv(b, r->csv);
    }
    return ACCEL_EXIT_FINE;
}

static int run_scene(request *r, const char *name)
{
    accel_progress progress = accel_progress_start(r->quiet);
    accel_bench b = {.scene_name = name, .repeats = (unsigned)r->repeats};
    if (!accel_open_scene(&b.loaded, name, r->command, &progress)) {
        return ACCEL_EXIT_BAD;
    }
    const int code =
        make_contenders(&b, r, &progress) ? run_made(r, &b, &progress) : ACCEL_EXIT_BAD;
    end_bench(&b);
    return code;
}

static int run_scenes(request *r)
{
    int worst = ACCEL_EXIT_FINE;
    for (size_t i = 0; i < r->scene_count && worst != ACCEL_EXIT_BAD; i++) {
        const int code = run_scene(r, r->scenes[i]);
        worst = code > worst ? code : worst;
        fflush(stdout);
    }
    if (r->regret_count > 1) {
        printf("\nauto over %zu scenes: mean regret %.3f, worst %.3f (%s)\n", r->regret_count,
               r->regret_sum / (double)r->regret_count, r->regret_worst, r->regret_scene);
    }
    return worst;
}

/* The file of figures appears whole or not at all. */
static int run_into_file(request *r)
{
    if (r->csv_name == NULL) {
        return run_scenes(r);
    }
    accel_output output;
    accel_error error;
    if (!accel_output_open(&output, r->csv_name, &error)) {
        return accel_complain(r->command, "%s", error.text);
    }
    r->csv = output.file;
    fprintf(r->csv, "scene,contender,rays,count,build_seconds,bytes,nodes,tests,ns_quartile1,"
                    "ns_median,ns_quartile3,other_answers\n");
    const int code = run_scenes(r);
    if (code != ACCEL_EXIT_FINE) {
        accel_output_abandon(&output);
    } else if (!accel_output_commit(&output, &error)) {
        return accel_complain(r->command, "%s", error.text);
    }
    return code;
}

/* ------------------------------------------------------------------ arguments ---- */

/* Reads "primary,bounce". */
static bool read_sets(request *r, const char *list)
{
    memset(r->sets, 0, sizeof r->sets);
    while (true) {
        const size_t length = strcspn(list, ",");
        int s = 0;
        while (s < ACCEL_SETS && (strlen(accel_set_names[s]) != length ||
                                  memcmp(accel_set_names[s], list, length) != 0)) {
            s++;
        }
        if (s == ACCEL_SETS) {
            accel_complain(r->command,
                           "--rays: '%.*s' is no kind of rays; primary, bounce, shadow and photon "
                           "are",
                           (int)(length < 40 ? length : 40), list);
            return false;
        }
        r->sets[s] = true;
        if (list[length] == '\0') {
            return true;
        }
        list += length + 1;
    }
}

/* Every kind but the judge. */
static void default_configs(request *r)
{
    size_t count;
    const accel_kind_info *const *kinds = accel_kinds(&count);
    for (size_t i = 0; i < count; i++) {
        if (strcmp(kinds[i]->name, "linear") != 0) {
            r->configs.items[r->configs.count++] = kinds[i]->name;
        }
    }
}

static bool take(accel_arguments *a, int flag, void *user)
{
    request *r = user;
    switch (flag) {
    case FLAG_CONFIG:
        return accel_configs_add(&r->configs, a->value, r->command);
    case FLAG_RAYS:
        return read_sets(r, a->value);
    case FLAG_COUNT:
        return accel_whole_argument(a, flag, 1, 100000000, &r->count);
    case FLAG_REPEATS:
        return accel_whole_argument(a, flag, 1, ACCEL_MOST_REPEATS_BENCH, &r->repeats);
    case FLAG_SAMPLE:
        return accel_whole_argument(a, flag, 1, 100000000, &r->sample);
    case FLAG_PEERS:
        r->peers = true;
        return true;
    case FLAG_CSV:
        r->csv_name = a->value;
        return true;
    default:
        break;
    }
    if (r->scene_count == MOST_SCENES) {
        accel_complain(r->command, "more than %d scenes; allowed are %d", MOST_SCENES, MOST_SCENES);
        return false;
    }
    r->scenes[r->scene_count++] = a->value;
    return true;
}

static int run(const accel_command *command, int argc, char **argv)
{
    accel_arguments arguments = accel_arguments_start(command, argc, argv);
    request r = {.command = command,
                 .sets = {true, true, true, true},
                 .count = 100000,
                 .repeats = 5,
                 .sample = 200};
    if (!accel_take_arguments(&arguments, take, &r)) {
        return arguments.exit_code;
    }
    if (r.scene_count == 0) {
        return accel_complain(command, "no SCENE is given; usage: accel %s %s", command->name,
                              command->arguments);
    }
    r.quiet = arguments.quiet;
    if (r.configs.count == 0) {
        default_configs(&r);
    }
    return run_into_file(&r);
}

const accel_command accel_command_bench = {
    .name = "bench",
    .arguments = "SCENE... [-a CONFIG]... [--rays LIST] [--peers]",
    .summary = "time structures, and Embree, on the same rays",
    .details =
        "Rays: primary, from the camera that frames the scene; bounce, diffuse, from what those\n"
        "hit; shadow, from there to a point above the scene, any hit; photon, from a square above\n"
        "the scene, every second one reflected once. No time is printed before every structure\n"
        "has answered every ray with the same bits, of which linear judges a sample.\n"
        "nodes+tests: nodes visited and primitives tested per ray. With auto among the CONFIGs,\n"
        "its regret: build and 10^7 rays of its choice over those of the best structure.",
    .flags = flags,
    .flag_count = sizeof flags / sizeof flags[0],
    .run = run,
};
