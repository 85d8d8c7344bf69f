/* SPDX-License-Identifier: Apache-2.0
 *
 * accel check: does every structure answer as linear does, bit for bit?
 */
#include "check/check.h"

#include "commands.h"
#include "tool/threads.h"
#include "scenes/ray_text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FLAG_CONFIG, FLAG_RAYS, FLAG_SEED, FLAG_THREADS, FLAG_JUDGED, FLAG_RAY };

/* Linear judges all rays up to this many tests of primitives, and at least LEAST_JUDGED rays. */
#define DEFAULT_TESTS 2000000000.0

enum { LEAST_JUDGED = 20000, DEFAULT_RAYS = 120000, MOST_THREADS = 1024 };

static const struct flag flags[] = {
    {"accelerator", 'a', "CONFIG",
     "structure to check, may be repeated (default: every kind and form but linear)"},
    {"rays", 'n', "N", "rays to check (default 120000)"},
    {"seed", 's', "S", "other rays (default 1)"},
    {"threads", 't', "T", "threads (default: one for each processor)"},
    {"judged", 'j', "N",
     "rays that linear judges (default: all up to 2 * 10^9 tests of primitives, at\n"
     "least 20000); the others are judged by agreement of the structures"},
    {"ray", 0, "RAY",
     "replay one ray, 'ox oy oz dx dy dz [tmin tmax [geom prim]]'; hex floats, inf\n"
     "and nan are read; geom prim is the primitive that is skipped"},
};

/* What the arguments say. */
typedef struct request {
    const char *scene, *ray;
    struct configs configs;
    struct forms forms;                   /* where no config is given */
    bool asked;                           /* the configs are given by -a */
    uint64_t rays, seed, threads, judged; /* 0 for the default of threads and judged */
} request;

/* Has a structure with the same resolved config been built before? Is it the judge itself? */
static bool is_known(const struct check *check, const accel_info *info)
{
    for (size_t i = 0; i < check->suspect_count; i++) {
        if (strcmp(check->suspects[i].info.config, info->config) == 0) {
            return true;
        }
    }
    return strcmp(info->kind, "linear") == 0;
}

/* `asked` is false for a structure that was not given by -a. */
static bool add_suspect(struct check *check, const char *config, bool asked)
{
    accel *a = open_structure(&check->loaded, config, check->command, &check->progress);
    if (a == NULL) {
        return false;
    }
    struct suspect *suspect = &check->suspects[check->suspect_count];
    *suspect = (struct suspect){.structure = a, .first = UINT64_MAX};
    accel_describe(a, &suspect->info);
    if (!asked && is_known(check, &suspect->info)) {
        printf("%s means %s here, which is checked anyway\n", config, suspect->info.config);
        accel_free(a);
        return true;
    }
    check->suspect_count++;
    return true;
}

static bool has_two_kinds(const struct check *check)
{
    for (size_t i = 1; i < check->suspect_count; i++) {
        if (strcmp(check->suspects[i].info.kind, check->suspects[0].info.kind) != 0) {
            return true;
        }
    }
    return false;
}

/* Agreement needs a second kind of structure beside the only one. */
static bool add_second_opinion(struct check *check)
{
    size_t count;
    const accel_kind_info *const *kinds = accel_kinds(&count);
    for (size_t i = 0; i < count; i++) {
        if (strcmp(kinds[i]->name, "linear") != 0 && strcmp(kinds[i]->name, "auto") != 0 &&
            strcmp(kinds[i]->name, check->suspects[0].info.kind) != 0) {
            const bool fine = add_suspect(check, kinds[i]->name, false);
            check->suspects[check->suspect_count - 1].added = true;
            return fine;
        }
    }
    return true;
}

static uint64_t default_judged(const struct check *check)
{
    const double tests = (double)check->rays.target.primitives;
    const uint64_t judged = tests * (double)check->ray_count <= DEFAULT_TESTS
                                ? check->ray_count
                                : (uint64_t)(DEFAULT_TESTS / tests);
    const uint64_t least = judged < LEAST_JUDGED ? LEAST_JUDGED : judged;
    return least < check->ray_count ? least : check->ray_count;
}

static int check_rays(struct check *check, const request *request)
{
    check->rays = rays_start(&check->loaded.scene, request->seed);
    check->ray_count = request->rays;
    check->judged_count = request->judged == 0              ? default_judged(check)
                          : request->judged < request->rays ? request->judged
                                                            : request->rays;
    check->threads = request->threads == 0 ? threads_available() : (unsigned)request->threads;
    if (check->judged_count < check->ray_count && !has_two_kinds(check) &&
        !add_second_opinion(check)) {
        return EXIT_BAD;
    }
    if (!check_run(check)) {
        return complain(check->command, "out of memory; nothing was checked");
    }
    return check_report(check);
}

static int build_and_check(struct check *check, const request *request)
{
    accel_ray ray;
    if (request->ray != NULL && !ray_from_text(request->ray, &ray)) {
        return complain(check->command,
                        "--ray '%.200s' is no ray; allowed is 'ox oy oz dx dy dz [tmin "
                        "tmax [geom prim]]'; nothing was checked",
                        request->ray);
    }
    if (!open_scene(&check->loaded, request->scene, check->command, &check->progress)) {
        return EXIT_BAD;
    }
    check->judge = open_structure(&check->loaded, "linear", check->command, &check->progress);
    bool fine = check->judge != NULL;
    for (size_t i = 0; fine && i < request->configs.count; i++) {
        fine = add_suspect(check, request->configs.items[i], request->asked);
    }
    /* where no other kind is compiled in, linear's own queries are compared with each other */
    if (!fine || (check->suspect_count == 0 && !add_suspect(check, "linear", true))) {
        return EXIT_BAD;
    }
    return request->ray != NULL ? check_replay(check, &ray) : check_rays(check, request);
}

static int run_request(const struct command *command, request *request, bool quiet)
{
    if (request->scene == NULL) {
        return complain(command, "no SCENE is given; usage: accel %s %s", command->name,
                        command->arguments);
    }
    request->asked = request->configs.count != 0;
    if (!request->asked) {
        request->forms = forms_of_kinds(NULL);
        if (!configs_add_forms(&request->configs, &request->forms, command)) {
            return EXIT_BAD;
        }
    }
    struct check *check = calloc(1, sizeof *check);
    if (check == NULL) {
        return complain(command, "out of memory; nothing was checked");
    }
    check->command = command;
    check->scene_name = request->scene;
    check->progress = progress_start(quiet);
    const int code = build_and_check(check, request);
    for (size_t i = 0; i < check->suspect_count; i++) {
        accel_free(check->suspects[i].structure);
    }
    accel_free(check->judge);
    unload_scene(&check->loaded);
    free(check);
    return code;
}

static bool take(struct arguments *arguments, int found, void *user)
{
    request *request = user;
    switch (found) {
    case FLAG_CONFIG:
        return configs_add(&request->configs, arguments->value, arguments->command);
    case FLAG_RAYS:
        return whole_argument(arguments, found, 1, 10000000000, &request->rays);
    case FLAG_SEED:
        return whole_argument(arguments, found, 0, UINT64_MAX, &request->seed);
    case FLAG_THREADS:
        return whole_argument(arguments, found, 1, MOST_THREADS, &request->threads);
    case FLAG_JUDGED:
        return whole_argument(arguments, found, 1, 10000000000, &request->judged);
    case FLAG_RAY:
        request->ray = arguments->value;
        return true;
    default:
        return one_word(arguments, "SCENE", &request->scene);
    }
}

static int run(const struct command *command, int argc, char **argv)
{
    struct arguments arguments = arguments_start(command, argc, argv);
    request request = {.rays = DEFAULT_RAYS, .seed = 1};
    if (!take_arguments(&arguments, take, &request)) {
        return arguments.exit_code;
    }
    return run_request(command, &request, arguments.quiet);
}

const struct command command_check = {
    .name = "check",
    .takes_objects = true,
    .arguments = "SCENE [-a CONFIG]... [--rays N] [--seed S] [--threads T]",
    .summary = "compare structures with linear, bit for bit, over adversarial rays",
    .details =
        "Prints rays and mismatches of each structure and exits with 1 where there is any, with a\n"
        "command that replays the ray. accel_closest (t, u, v, ids) and accel_any are compared "
        "for\n"
        "each ray, alone and in batches (accel_closest_n, accel_any_n), accel_all (256 hits) and\n"
        "accel_point for one in 16. The invariants of each structure are validated as well.\n"
        "Families of rays, in turn: primary, lines, inside,\n"
        "bounce, vertex, edge, axis, grazing, far, scaled, interval, odd.",
    .flags = flags,
    .flag_count = sizeof flags / sizeof flags[0],
    .many = 1u << FLAG_CONFIG,
    .run = run,
};
