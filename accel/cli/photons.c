/* SPDX-License-Identifier: Apache-2.0
 *
 * accel photons: its arguments.
 */
#include "commands.h"
#include "tool/threads.h"
#include "photons/photons_request.h"
#include "tool/words.h"

#include <string.h>

enum {
    FLAG_CONFIG,
    FLAG_PHOTONS,
    FLAG_LIGHT,
    FLAG_REFLECTANCE,
    FLAG_SEED,
    FLAG_THREADS,
    FLAG_TIME_ONLY,
    FLAG_ESTIMATE,
    FLAG_RADIUS,
    FLAG_NEAREST,
    FLAG_SIZE,
    FLAG_CAMERA,
    FLAG_OUTPUT,
};

static const struct flag flags[] = {
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
    [FLAG_TIME_ONLY] = {"time-only", 0, NULL, "no irradiance, only what the photons cost"},
    [FLAG_ESTIMATE] = {"estimate", 0, "METHOD",
                       "irradiance by 'paths' through discs or by 'nearest' photons\n"
                       "(default: paths)"},
    [FLAG_RADIUS] = {"radius", 0, "R",
                     "of the discs, or the farthest of the nearest photons (default: what\n"
                     "100 hits would have each if they were spread evenly)"},
    [FLAG_NEAREST] = {"nearest", 0, "K", "photons that 'nearest' takes (default: 100)"},
    [FLAG_SIZE] = {"size", 0, "WxH", "pixels of the picture (default: 320x240)"},
    [FLAG_CAMERA] = {"camera", 0, "E:A:F", "as for 'accel trace' (default: frames the scene)"},
    [FLAG_OUTPUT] = {"output", 'o', "FILE",
                     "irradiance of each pixel as .exr (channel Y, float) or .png (tone-mapped)"},
};

static bool read_real(const struct arguments *a, int flag, double min, double max, double *out)
{
    double value;
    if (read_number(a->value, strlen(a->value), &value) && value >= min && value <= max) {
        *out = value;
        return true;
    }
    complain(a->command, "--%s is '%.60s'; allowed is a number from %g to %g",
             a->command->flags[flag].name, a->value, min, max);
    return false;
}

static bool read_light(const struct arguments *a, struct photon_request *r)
{
    if (r->light_count == MOST_LIGHTS) {
        complain(a->command, "more than %d lights", MOST_LIGHTS);
        return false;
    }
    const char *wrong = light_read(a->value, &r->lights[r->light_count++]);
    if (wrong != NULL) {
        complain(a->command, "--light '%.100s': %s", a->value, wrong);
    }
    return wrong == NULL;
}

static bool read_estimate(const struct arguments *a, struct photon_request *r)
{
    r->nearest = strcmp(a->value, "nearest") == 0;
    if (!r->nearest && strcmp(a->value, "paths") != 0) {
        complain(a->command, "--estimate is '%.60s'; allowed are paths, nearest", a->value);
        return false;
    }
    return true;
}

/* The flags that say how to look at the result. */
static bool read_view_flag(const struct arguments *a, int flag, struct photon_request *r)
{
    switch (flag) {
    case FLAG_TIME_ONLY:
        r->time_only = true;
        return true;
    case FLAG_ESTIMATE:
        return read_estimate(a, r);
    case FLAG_RADIUS:
        return read_real(a, flag, 1e-100, 1e100, &r->radius);
    case FLAG_NEAREST:
        return whole_argument(a, flag, 2, 10000000, &r->count);
    case FLAG_SIZE:
        r->size = a->value;
        return true;
    case FLAG_CAMERA:
        r->camera = a->value;
        return true;
    case FLAG_OUTPUT:
        r->output = a->value;
        return true;
    default:
        return one_word(a, "SCENE", &r->scene);
    }
}

static bool take(struct arguments *a, int flag, void *request)
{
    struct photon_request *r = request;
    uint64_t whole;
    switch (flag) {
    case FLAG_CONFIG:
        return configs_add(&r->configs, a->value, a->command);
    case FLAG_PHOTONS:
        if (!whole_argument(a, flag, 1, 100000000, &whole)) {
            return false;
        }
        r->run.photons = (uint32_t)whole;
        return true;
    case FLAG_LIGHT:
        return read_light(a, r);
    case FLAG_REFLECTANCE:
        return read_real(a, flag, 0.0, ACCEL_MOST_REFLECTANCE, &r->run.reflectance);
    case FLAG_SEED:
        return whole_argument(a, flag, 0, UINT64_MAX, &r->run.seed);
    case FLAG_THREADS:
        if (!whole_argument(a, flag, 1, 1024, &whole)) {
            return false;
        }
        r->run.threads = (unsigned)whole;
        return true;
    default:
        return read_view_flag(a, flag, r);
    }
}

static int check_request(const struct command *command, struct photon_request *r)
{
    if (r->scene == NULL) {
        return complain(command, "no SCENE is given; usage: accel %s %s", command->name,
                        command->arguments);
    }
    if (r->output != NULL &&
        (r->time_only || (!ends_with(r->output, ".exr") && !ends_with(r->output, ".png")))) {
        return complain(command, "-o '%.100s' %s; nothing was written", r->output,
                        r->time_only ? "needs what --time-only leaves out"
                                     : "ends in neither .exr nor .png");
    }
    if (r->configs.count == 0) {
        r->configs.items[r->configs.count++] = ACCEL_DEFAULT_CONFIG;
    }
    return photons_fulfil(command, r);
}

static int run(const struct command *command, int argc, char **argv)
{
    struct photon_request r = {.run = {.photons = 100000, .reflectance = 0.5, .seed = 1},
                               .count = 100};
    r.run.threads = threads_available();
    struct arguments arguments = arguments_start(command, argc, argv);
    if (!take_arguments(&arguments, take, &r)) {
        return arguments.exit_code;
    }
    r.quiet = arguments.quiet;
    return check_request(command, &r);
}

const struct command command_photons = {
    .name = "photons",
    .arguments = "SCENE [-a CONFIG]... [-o FILE] [OPTION]...",
    .summary = "illuminate a scene by photons, and compare what structures cost",
    .details =
        "Lights shoot photons, surfaces reflect them diffusely or swallow them, every hit is\n"
        "stored. Every structure, and every number of threads, traces the same paths and\n"
        "stores the same bits: the exit code is 1 if two CONFIGs differ. 'illum s' is the\n"
        "time of emission, tracing and storing together, as in the paper on hierarchies of\n"
        "octrees; 'cpu s' and ns/ray are its processor time, of all threads together. The\n"
        "build and the irradiance are apart.",
    .flags = flags,
    .flag_count = sizeof flags / sizeof flags[0],
    .many = 1u << FLAG_CONFIG | 1u << FLAG_LIGHT,
    .run = run,
};
