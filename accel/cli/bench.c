/* SPDX-License-Identifier: Apache-2.0
 *
 * accel bench: build time, memory, counts and time per ray of structures and peers on the same
 * rays, and how far `auto` is from the best choice. This file reads what is asked for and makes the
 * contenders; bench_rays.c makes the rays, bench_run.c judges and times, bench_table.c prints.
 */
#include "bench/bench.h"
#include "commands.h"
#include "tool/machine.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    FLAG_CONFIG,
    FLAG_RAYS,
    FLAG_COUNT,
    FLAG_REPEATS,
    FLAG_JUDGED,
    FLAG_PILOT,
    FLAG_BATCH,
    FLAG_PEERS,
    FLAG_CSV
};

static const struct flag flags[] = {
    [FLAG_CONFIG] = {"accelerator", 'a', "CONFIG",
                     "structure, may be repeated (default: every kind but linear, and each\n"
                     "in all its forms)"},
    [FLAG_RAYS] = {"rays", 0, "LIST", "of primary,bounce,shadow,photon (default: all)"},
    [FLAG_COUNT] = {"count", 'n', "N", "rays of each kind (default: 100000)"},
    [FLAG_REPEATS] = {"repeats", 0, "N", "turns of each contender (default: 5)"},
    [FLAG_JUDGED] = {"judged", 0, "N",
                     "rays of each kind that linear judges (default: what takes it about a\n"
                     "second, but 200 at least)"},
    [FLAG_PILOT] = {"pilot", 0, "N",
                    "rays of each kind that auto may try before it chooses (default: 64)"},
    [FLAG_BATCH] = {"batch", 0, NULL,
                    "each structure a second time, asked by accel_closest_n and accel_any_n"},
    [FLAG_PEERS] = {"peers", 0, NULL, "Embree as well: medium and high, fast and robust"},
    [FLAG_CSV] = {"csv", 0, "[FILE.csv]",
                  "all figures as well; without a file, or as -, on standard output instead\n"
                  "of the tables"},
};

/* Tests that linear may take to judge rays of one kind, and the rays that it judges at least. */
enum { JUDGING_TESTS = 50000000, FEWEST_JUDGED = 200 };

/* What was asked for. */
typedef struct request {
    const struct command *command;
    struct scene_names scenes;
    struct configs configs;
    struct forms forms; /* where no config is given */
    bool sets[SETS];
    uint64_t count, repeats, pilot;
    uint64_t judged; /* 0: as many as is quick */
    bool batch, peers, quiet;
    bool csv;             /* figures are asked for */
    const char *csv_name; /* where; NULL: on standard output */
    struct bench_output output;
} request;

/* ------------------------------------------------------------- our structures ---- */

static size_t trace_ours(const struct bench_contender *c, const struct ray_set *set)
{
    size_t found = 0;
    accel_hit hit;
    for (size_t i = 0; i < set->count; i++) {
        found += set->any ? accel_any(c->state, &set->rays[i], NULL)
                          : accel_closest(c->state, &set->rays[i], &hit, NULL);
    }
    return found;
}

static void end_ours(struct bench_contender *c)
{
    accel_free(c->state);
}

static size_t trace_batch(const struct bench_contender *c, const struct ray_set *set)
{
    struct batch_answers answers;
    size_t found = 0;
    for (size_t i = 0; i < set->count; i += BATCH) {
        found += ask_batch(c->state, set, i, NULL, &answers);
    }
    return found;
}

static void end_nothing(struct bench_contender *c)
{
    (void)c;
}

/* The same structure, asked in another way. */
static struct bench_contender in_batches(const struct bench_contender *c)
{
    struct bench_contender batch = *c;
    batch.batch = true;
    batch.trace = trace_batch;
    batch.end = end_nothing;
    snprintf(batch.name, sizeof batch.name, "%.55s, batch", c->name);
    return batch;
}

/* Every so many-th ray of each kind, for auto. */
static bool make_pilot(const struct bench *b, uint64_t each, accel_hooks *hooks)
{
    accel_ray *rays = malloc(SETS * (each + 1) * sizeof *rays);
    hooks->pilot = rays;
    for (int s = 0; s < SETS && rays != NULL; s++) {
        const size_t count = b->sets[s].count < each ? b->sets[s].count : each;
        for (size_t i = 0; i < count; i++) {
            rays[hooks->pilot_count++] = b->sets[s].rays[i * b->sets[s].count / count];
        }
    }
    return rays != NULL;
}

static bool make_ours(struct bench_contender *c, const char *config, const struct bench *b,
                      const accel_hooks *hooks, const request *r)
{
    accel *a;
    accel_error error;
    const double start = machine_seconds_of_all();
    if (accel_build(&a, &b->loaded.scene, config, hooks, &error) != ACCEL_OK) {
        complain(r->command, "%s", error.text);
        return false;
    }
    const double seconds = machine_seconds_of_all() - start;
    accel_info info;
    accel_describe(a, &info);
    *c = (struct bench_contender){.state = a,
                                  .kind = info.kind,
                                  .build_seconds = seconds,
                                  .bytes = (double)info.bytes,
                                  .trace = trace_ours,
                                  .end = end_ours};
    snprintf(c->name, sizeof c->name, "%.63s", config);
    return true;
}

/* ------------------------------------------------------------------------ run ---- */

static bool has_kind(const char *name)
{
    size_t count;
    const accel_kind_info *const *kinds = accel_kinds(&count);
    for (size_t i = 0; i < count; i++) {
        if (strcmp(kinds[i]->name, name) == 0) {
            return true;
        }
    }
    return false;
}

/* The rays, and what is to be known of them. */
static bool make_sets(struct bench *b, const request *r, struct progress *progress)
{
    b->reference_name = has_kind("bvh") ? "bvh" : ACCEL_DEFAULT_CONFIG;
    b->reference = open_structure(&b->loaded, b->reference_name, r->command, progress);
    for (int s = 0; s < SETS && b->reference != NULL; s++) {
        if (r->sets[s] && !make_set(&b->sets[s], s, r->count, b->reference, &b->loaded.scene)) {
            complain(r->command, "no memory for %" PRIu64 " rays", r->count);
            return false;
        }
    }
    return b->reference != NULL;
}

static void make_peers(struct bench *b)
{
    accel_box box;
    scene_box(&b->loaded.scene, &box);
    const double length = sqrt(pow(box.hi[0] - box.lo[0], 2) + pow(box.hi[1] - box.lo[1], 2) +
                               pow(box.hi[2] - box.lo[2], 2));
    b->count += bench_peers(b->at + b->count, &b->loaded.scene, length);
}

static bool make_contenders(struct bench *b, const request *r, struct progress *progress)
{
    accel_hooks hooks = {.user = progress, .progress = progress_build};
    b->at = calloc(2 * r->configs.count + MOST_PEERS, sizeof *b->at);
    bool fine = b->at != NULL && make_pilot(b, r->pilot, &hooks);
    if (!fine) {
        complain(r->command, "no memory for %zu contenders", r->configs.count);
    }
    for (size_t i = 0; i < r->configs.count && fine; i++) {
        progress->what = r->configs.items[i];
        fine = make_ours(&b->at[b->count], r->configs.items[i], b, &hooks, r);
        b->count += fine;
        if (fine && r->batch) {
            b->at[b->count] = in_batches(&b->at[b->count - 1]);
            b->count++;
        }
    }
    progress->what = NULL;
    progress_clear(progress);
    if (fine && r->peers) {
        make_peers(b);
    }
    free((void *)hooks.pilot);
    return fine;
}

static void end_bench(struct bench *b)
{
    for (size_t c = 0; c < b->count; c++) {
        b->at[c].end(&b->at[c]);
    }
    for (int s = 0; s < SETS; s++) {
        free_set(&b->sets[s]);
    }
    free(b->at);
    accel_free(b->reference);
    unload_scene(&b->loaded);
}

/* How many rays of each kind linear judges. */
static size_t judged_count(const request *r, const struct bench *b)
{
    const uint64_t primitives = scene_primitives(&b->loaded.scene) + 1;
    const uint64_t quick = JUDGING_TESTS / primitives;
    return r->judged > 0 ? r->judged : quick > FEWEST_JUDGED ? quick : FEWEST_JUDGED;
}

static int run_made(request *r, struct bench *b, struct progress *progress)
{
    accel *linear = open_structure(&b->loaded, "linear", r->command, progress);
    if (linear == NULL) {
        return EXIT_BAD;
    }
    const bool agrees = bench_judge(b, linear, judged_count(r, b), progress);
    accel_free(linear);
    if (!agrees || !bench_time(b, progress)) {
        return EXIT_DIFFERENT;
    }
    bench_print(&r->output, b);
    return EXIT_FINE;
}

static int run_scene(request *r, const char *name)
{
    struct progress progress = progress_start(r->quiet);
    struct bench b = {.scene_name = name, .repeats = (unsigned)r->repeats, .asked = r->count};
    if (!open_scene(&b.loaded, name, r->command, &progress)) {
        return EXIT_BAD;
    }
    const int code = make_sets(&b, r, &progress) && make_contenders(&b, r, &progress)
                         ? run_made(r, &b, &progress)
                         : EXIT_BAD;
    end_bench(&b);
    return code;
}

static int run_scenes(request *r)
{
    int worst = EXIT_FINE;
    for (size_t i = 0; i < r->scenes.count && worst != EXIT_BAD; i++) {
        const int code = run_scene(r, r->scenes.items[i]);
        worst = code > worst ? code : worst;
        fflush(stdout);
    }
    bench_print_sum(&r->output);
    return worst;
}

/* The file of figures appears whole or not at all. */
static int run_into_file(request *r)
{
    r->output.table = !r->csv || r->csv_name != NULL;
    r->output.peers = r->peers;
    if (r->csv_name == NULL) {
        r->output.csv = r->csv ? stdout : NULL;
        return run_scenes(r);
    }
    struct output output;
    accel_error error;
    if (!output_open(&output, r->csv_name, &error)) {
        return complain(r->command, "%s", error.text);
    }
    r->output.csv = output.file;
    return end_output(&output, run_scenes(r), EXIT_FINE, r->command);
}

/* ------------------------------------------------------------------ arguments ---- */

/* Reads "primary,bounce". */
static bool read_sets(request *r, const char *list)
{
    memset(r->sets, 0, sizeof r->sets);
    while (true) {
        const size_t length = strcspn(list, ",");
        int s = 0;
        while (s < SETS &&
               (strlen(set_names[s]) != length || memcmp(set_names[s], list, length) != 0)) {
            s++;
        }
        if (s == SETS) {
            complain(r->command,
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

/* What makes a kind another structure; when it is built, as by lazy, is not asked here. */
static bool is_form(const accel_option *option)
{
    return strcmp(option->key, "form") == 0 || strcmp(option->key, "root") == 0;
}

/* A word behind a bare --csv may be meant as its file: it is a scene only where it cannot be. */
static bool add_scene(const struct arguments *a, request *r)
{
    accel_error error;
    if (a->declined && (access(a->value, F_OK) == 0 || !scene_understood(a->value, &error))) {
        complain(r->command,
                 "'%.100s' behind --csv does not end in .csv and is no built-in scene; to "
                 "write to it say --csv=%.100s, to read it put it in front of --csv",
                 a->value, a->value);
        return false;
    }
    return scene_names_add(&r->scenes, a->value, r->command);
}

static bool take(struct arguments *a, int flag, void *user)
{
    request *r = user;
    switch (flag) {
    case FLAG_CONFIG:
        return configs_add(&r->configs, a->value, r->command);
    case FLAG_RAYS:
        return read_sets(r, a->value);
    case FLAG_COUNT:
        return whole_argument(a, flag, 1, 100000000, &r->count);
    case FLAG_REPEATS:
        return whole_argument(a, flag, 1, MOST_REPEATS_BENCH, &r->repeats);
    case FLAG_JUDGED:
        return whole_argument(a, flag, 1, 100000000, &r->judged);
    case FLAG_PILOT:
        return whole_argument(a, flag, 0, 1000000, &r->pilot);
    case FLAG_BATCH:
        r->batch = true;
        return true;
    case FLAG_PEERS:
        r->peers = true;
        return true;
    case FLAG_CSV:
        r->csv = true;
        r->csv_name = a->value == NULL || strcmp(a->value, "-") == 0 ? NULL : a->value;
        return true;
    default:
        return add_scene(a, r);
    }
}

static int run(const struct command *command, int argc, char **argv)
{
    struct arguments arguments = arguments_start(command, argc, argv);
    request r = {.command = command,
                 .sets = {true, true, true, true},
                 .count = 100000,
                 .repeats = 5,
                 .pilot = 64};
    if (!take_arguments(&arguments, take, &r)) {
        return arguments.exit_code;
    }
    if (r.scenes.count == 0) {
        return complain(command, "no SCENE is given; usage: accel %s %s", command->name,
                        command->arguments);
    }
    r.quiet = arguments.quiet;
    if (r.configs.count == 0) {
        r.forms = forms_of_kinds(is_form);
        if (!configs_add_forms(&r.configs, &r.forms, command)) {
            return EXIT_BAD;
        }
    }
    return run_into_file(&r);
}

const struct command command_bench = {
    .name = "bench",
    .arguments = "SCENE... [-a CONFIG]... [--rays LIST] [--peers] [--csv [FILE.csv]]",
    .summary = "time structures, and Embree, on the same rays",
    .details =
        "Rays: primary, from the camera that frames the scene; bounce, diffuse, from what those\n"
        "hit; shadow, from there to a point above the scene, any hit; photon, from a square above\n"
        "the scene, every second one reflected once. No time is printed before every structure\n"
        "has answered every ray with the bits that bvh (auto, if that is not compiled) gives, of\n"
        "which linear judges a sample.\n"
        "nodes+tests: nodes visited and primitives tested per ray. Builds and rays are measured\n"
        "in processor time, which waiting for other programs does not lengthen.\n"
        "\n"
        "With auto among the CONFIGs (it is by default), its regret: what its choice takes for\n"
        "build and 10^7 rays, an even mix of those timed, over what the best of the others takes.\n"
        "With several scenes, mean and worst as well: accel bench SCENE... -n 4000 --repeats 3",
    .flags = flags,
    .flag_count = sizeof flags / sizeof flags[0],
    .many = 1u << FLAG_CONFIG,
    .run = run,
};
