/* SPDX-License-Identifier: Apache-2.0
 *
 * accel photons: illuminates a scene by photons through each CONFIG, says what it cost, and that
 * all of them stored the same bits.
 */
#include "commands.h"
#include "crew.h"
#include "photons.h"
#include "structure.h"
#include "words.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    FLAG_CONFIG,
    FLAG_PHOTONS,
    FLAG_LIGHT,
    FLAG_REFLECTANCE,
    FLAG_SEED,
    FLAG_THREADS,
};

static const accel_flag flags[] = {
    [FLAG_CONFIG] = {"accelerator", 'a', "CONFIG",
                     "structure to use, may be repeated (default: " ACCEL_DEFAULT_CONFIG ")"},
    [FLAG_PHOTONS] = {"photons", 'n', "N", "photons for each light (default: 100000)"},
    [FLAG_LIGHT] = {"light", 'l', "LIGHT",
                    "CORNER:EDGE:EDGE[:POWER], each of the three x,y,z; shines towards the\n"
                    "cross product of its edges; may be repeated (default: the scene's own,\n"
                    "or one above its box)"},
    [FLAG_REFLECTANCE] = {"reflectance", 'r', "R", "of all surfaces, 0..0.99 (default: 0.5)"},
    [FLAG_SEED] = {"seed", 's', "S", "another number, other photons (default: 1)"},
    [FLAG_THREADS] = {"threads", 't', "T", "default: one for each processor"},
};

/* What the user asked for. */
typedef struct request {
    const char *scene;
    accel_configs configs;
    accel_light lights[ACCEL_MOST_LIGHTS];
    uint32_t light_count; /* 0: the scene's own */
    accel_photon_run run;
    bool quiet;
} request;

static bool read_real(const accel_arguments *a, int flag, double min, double max, double *out)
{
    double value;
    if (accel_read_number(a->value, strlen(a->value), &value) && value >= min && value <= max) {
        *out = value;
        return true;
    }
    accel_complain(a->command, "--%s is '%.60s'; allowed is a number from %g to %g",
                   a->command->flags[flag].name, a->value, min, max);
    return false;
}

static bool read_light(const accel_arguments *a, request *r)
{
    if (r->light_count == ACCEL_MOST_LIGHTS) {
        accel_complain(a->command, "more than %d lights", ACCEL_MOST_LIGHTS);
        return false;
    }
    const char *wrong = accel_read_light(a->value, &r->lights[r->light_count++]);
    if (wrong != NULL) {
        accel_complain(a->command, "--light '%.100s': %s", a->value, wrong);
    }
    return wrong == NULL;
}

static bool read_flag(const accel_arguments *a, int flag, request *r)
{
    uint64_t whole = 0;
    switch (flag) {
    case FLAG_CONFIG:
        return accel_configs_add(&r->configs, a->value, a->command);
    case FLAG_PHOTONS:
        if (!accel_whole_argument(a, flag, 1, 100000000, &whole)) {
            return false;
        }
        r->run.photons = (uint32_t)whole;
        return true;
    case FLAG_LIGHT:
        return read_light(a, r);
    case FLAG_REFLECTANCE:
        return read_real(a, flag, 0.0, ACCEL_MOST_REFLECTANCE, &r->run.reflectance);
    case FLAG_SEED:
        return accel_whole_argument(a, flag, 0, UINT64_MAX, &r->run.seed);
    case FLAG_THREADS:
        if (!accel_whole_argument(a, flag, 1, 1024, &whole)) {
            return false;
        }
        r->run.threads = (unsigned)whole;
        return true;
    default:
        return accel_one_word(a, "SCENE", &r->scene);
    }
}

static void show_tracing(void *progress, double done)
{
    accel_progress_show(progress, "photons", done);
}

static void print_head(const request *r)
{
    printf("%s: %" PRIu32 " lights, %" PRIu32 " photons for each, reflectance %g, seed %" PRIu64
           ", %u threads\n",
           r->scene, r->run.lights.count, r->run.photons, r->run.reflectance, r->run.seed,
           r->run.threads);
    printf("%-36s %9s %9s %10s %10s %7s %7s %7s  %s\n", "structure", "build s", "illum s", "rays",
           "hits", "nodes/r", "tests/r", "ns/ray", "hash of the hits");
}

static void print_row(const char *config, const accel *a, const accel_photons *photons,
                      uint64_t hash)
{
    accel_info info;
    accel_describe(a, &info);
    const double rays = (double)photons->rays;
    printf("%-36s %9.3f %9.3f %10" PRIu64 " %10zu %7.2f %7.2f %7.0f  %016" PRIx64 "\n", config,
           info.seconds, photons->seconds, photons->rays, photons->count,
           (double)photons->query.nodes / rays, (double)photons->query.tests / rays,
           1e9 * photons->seconds / rays, hash);
    fflush(stdout);
}

/* One CONFIG: exit code, and the hash of what it stored. */
static int illuminate(const accel_command *command, request *r, const accel_loaded *loaded,
                      const char *config, accel_progress *progress, uint64_t *hash)
{
    accel *a = accel_open_structure(loaded, config, command, progress);
    if (a == NULL) {
        return ACCEL_EXIT_BAD;
    }
    accel_photons photons;
    progress->what = config;
    const bool fine = accel_trace_photons(&photons, a, &loaded->scene, &r->run);
    accel_progress_clear(progress);
    if (!fine) {
        accel_free(a);
        return accel_complain(command, "out of memory for the photons");
    }
    *hash = accel_photons_hash(&photons);
    print_row(config, a, &photons, *hash);
    accel_photons_free(&photons);
    accel_free(a);
    return ACCEL_EXIT_FINE;
}

static int illuminate_all(const accel_command *command, request *r, const accel_loaded *loaded,
                          accel_progress *progress)
{
    r->run.progress = show_tracing;
    r->run.user = progress;
    r->run.lights.at = r->lights;
    r->run.lights.count = r->light_count;
    if (r->light_count == 0) {
        r->run.lights.count = accel_scene_lights(r->scene, &loaded->scene, r->lights);
    }
    print_head(r);
    uint64_t first = 0;
    int code = ACCEL_EXIT_FINE;
    for (size_t i = 0; i < r->configs.count && code != ACCEL_EXIT_BAD; i++) {
        uint64_t hash = 0;
        const int own = illuminate(command, r, loaded, r->configs.items[i], progress, &hash);
        first = i == 0 ? hash : first;
        if (own != ACCEL_EXIT_FINE) {
            code = own;
        } else if (hash != first) {
            printf("DIFFERENT: %s did not store the hits of %s\n", r->configs.items[i],
                   r->configs.items[0]);
            code = ACCEL_EXIT_DIFFERENT;
        }
    }
    return code;
}

static int run(const accel_command *command, int argc, char **argv)
{
    request r = {.run = {.photons = 100000, .reflectance = 0.5, .seed = 1}};
    r.run.threads = accel_crew_size();
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
    if (r.scene == NULL) {
        return accel_complain(command, "no SCENE is given; usage: accel %s %s", command->name,
                              command->arguments);
    }
    if (r.configs.count == 0) {
        r.configs.items[r.configs.count++] = ACCEL_DEFAULT_CONFIG;
    }
    accel_progress progress = accel_progress_start(arguments.quiet);
    accel_loaded loaded;
    if (!accel_open_scene(&loaded, r.scene, command, &progress)) {
        return ACCEL_EXIT_BAD;
    }
    const int code = illuminate_all(command, &r, &loaded, &progress);
    accel_unload_scene(&loaded);
    return code;
}

const accel_command accel_command_photons = {
    .name = "photons",
    .arguments = "SCENE [-a CONFIG]... [OPTION]...",
    .summary = "illuminate a scene by photons, and compare what structures cost",
    .details =
        "Lights shoot photons, surfaces reflect them diffusely or swallow them, every hit is\n"
        "stored. Every structure, and every number of threads, traces the same paths and\n"
        "stores the same bits: the exit code is 1 if two CONFIGs differ. 'illum s' is the\n"
        "time of emission, tracing and storing together, as in the paper on hierarchies of\n"
        "octrees; the build is apart.",
    .flags = flags,
    .flag_count = sizeof flags / sizeof flags[0],
    .run = run,
};
