/* SPDX-License-Identifier: Apache-2.0
 *
 * accel trace: hits of a camera or of a file of rays, as OpenEXR, PNG or text.
 */
#include "trace/trace.h"

#include "camera_argument.h"
#include "commands.h"
#include "tool/threads.h"
#include "tool/words.h"

#include <stdlib.h>
#include <string.h>

enum { FLAG_CONFIG, FLAG_OUTPUT, FLAG_SIZE, FLAG_CAMERA, FLAG_RAYS, FLAG_THREADS };

static const struct flag flags[] = {
    {"accelerator", 'a', "CONFIG", "structure to trace with (default: " ACCEL_DEFAULT_CONFIG ")"},
    {"output", 'o', "FILE",
     "file to write; its name ends in .exr or .png, with --rays in anything, and\n" ACCEL_DASH},
    {"size", 0, "WxH", "pixels (default 640x480)"},
    {"camera", 0, "E:A:F",
     "eye x,y,z : point x,y,z in the middle of the image : full horizontal field of\n"
     "view in degrees (default: frames the scene with 40 degrees)"},
    {"rays", 0, "FILE", "trace the rays of FILE instead and write a text"},
    {"threads", 't', "T", "threads (default: one for each processor)"},
};

/* What the arguments say. */
typedef struct request {
    const char *scene, *config, *output, *size, *camera, *rays;
    uint64_t threads;
} request;

static bool write_image(struct tracing *tracing, const struct camera *camera, struct output *output,
                        accel_error *error)
{
    error->status = ACCEL_NO_MEMORY;
    snprintf(error->text, sizeof error->text, "out of memory; nothing was written");
    bool fine = false;
    if (ends_with(output->path, ".png")) {
        unsigned char *pixels = trace_picture(tracing, camera);
        fine = pixels != NULL && png_write(pixels, camera->width, camera->height, output, error);
        free(pixels);
    } else {
        struct image image;
        if (trace_image(tracing, camera, &image)) {
            fine = image_write_exr(&image, output, error);
            image_free(&image);
        }
    }
    return fine;
}

static int fill_output(const struct command *command, const request *request,
                       struct tracing *tracing, struct output *output)
{
    struct camera camera;
    if (request->rays == NULL &&
        !camera_argument(command, request->size, request->camera, tracing->scene, &camera)) {
        return EXIT_BAD;
    }
    accel_error error;
    const bool fine = request->rays == NULL
                          ? write_image(tracing, &camera, output, &error)
                          : trace_text(tracing, request->rays, output->file, &error);
    return fine ? EXIT_FINE : complain(command, "%s", error.text);
}

static int load_and_trace(const struct command *command, const request *request, bool quiet,
                          struct output *output)
{
    struct tracing tracing = {.threads = request->threads == 0 ? threads_available()
                                                               : (unsigned)request->threads,
                              .progress = progress_start(quiet)};
    struct loaded loaded;
    if (!open_scene(&loaded, request->scene, command, &tracing.progress)) {
        return EXIT_BAD;
    }
    accel *a = open_structure(&loaded, request->config, command, &tracing.progress);
    tracing.scene = &loaded.scene;
    tracing.structure = a;
    const int code = a == NULL ? EXIT_BAD : fill_output(command, request, &tracing, output);
    accel_free(a);
    unload_scene(&loaded);
    return code;
}

static int trace_into_file(const struct command *command, const request *request, bool quiet)
{
    struct output output;
    accel_error error;
    if (!output_open(&output, request->output, &error)) {
        return complain(command, "%s", error.text);
    }
    return end_output(&output, load_and_trace(command, request, quiet, &output), EXIT_FINE,
                      command);
}

static int check_request(const struct command *command, const request *request, bool quiet)
{
    if (request->scene == NULL || request->output == NULL) {
        return complain(command, "SCENE and -o FILE are needed; usage: accel %s %s", command->name,
                        command->arguments);
    }
    if (request->rays != NULL && (request->camera != NULL || request->size != NULL)) {
        return complain(command,
                        "--rays takes the rays of a file: %s does not go with it; "
                        "nothing was written",
                        request->camera != NULL ? "--camera" : "--size");
    }
    if (request->rays == NULL && !ends_with(request->output, ".exr") &&
        !ends_with(request->output, ".png")) {
        return complain(command,
                        "-o '%.100s' ends in neither .exr nor .png; nothing was "
                        "written",
                        request->output);
    }
    return trace_into_file(command, request, quiet);
}

static bool take(struct arguments *arguments, int found, void *user)
{
    request *request = user;
    const char **const texts[] = {[FLAG_CONFIG] = &request->config,
                                  [FLAG_OUTPUT] = &request->output,
                                  [FLAG_SIZE] = &request->size,
                                  [FLAG_CAMERA] = &request->camera,
                                  [FLAG_RAYS] = &request->rays};
    if (found == FLAG_THREADS) {
        return whole_argument(arguments, found, 1, 1024, &request->threads);
    }
    if (found == ARGUMENT_WORD) {
        return one_word(arguments, "SCENE", &request->scene);
    }
    *texts[found] = arguments->value;
    return true;
}

static int run(const struct command *command, int argc, char **argv)
{
    struct arguments arguments = arguments_start(command, argc, argv);
    request request = {.config = ACCEL_DEFAULT_CONFIG};
    if (!take_arguments(&arguments, take, &request)) {
        return arguments.exit_code;
    }
    return check_request(command, &request, arguments.quiet);
}

const struct command command_trace = {
    .name = "trace",
    .arguments = "SCENE -o FILE [-a CONFIG] [--size WxH] [--camera E:A:F] [--rays FILE]",
    .summary = "write the hits of a camera's rays, or of a file of rays",
    .details =
        "OpenEXR channels, scan lines, ZIP:\n"
        "  N.X N.Y N.Z   float   geometric normal, as the triangle's winding has it\n"
        "  P.X P.Y P.Z   float   position\n"
        "  Z             float   distance from the eye; infinite for a miss\n"
        "  geom prim     uint    ids; 4294967295 for a miss\n"
        "  t.hi t.lo     uint    upper and lower 32 bits of the double t, in units of |direction|\n"
        "  u.hi u.lo, v.hi v.lo  likewise the barycentric weights of the second and third vertex\n"
        "PNG: coloured by the normal.\n"
        "\n"
        "Camera, in double, in this order of operations; column i and row j count from 0 at the\n"
        "upper left, E is the eye, A the point looked at, F the degrees:\n"
        "  w = (A - E) / |A - E|\n"
        "  r = (-w.z, 0, w.x) / |(-w.z, 0, w.x)|     u = r x w\n"
        "      (r = (w.y, -w.x, 0) / |...| where w.x = w.z = 0)\n"
        "  h = tan(F * pi / 360)\n"
        "  x = (2 (i + 0.5) / W - 1) h               y = (1 - 2 (j + 0.5) / H) (h H / W)\n"
        "  origin = E     direction = (w + x r) + y u, not normalised\n"
        "y is up; the system is right-handed, but nothing depends on that.\n"
        "\n"
        "--rays FILE: each line 'ox oy oz dx dy dz [tmin tmax [geom prim]]', blanks, commas or\n"
        "semicolons between; empty lines, what follows '#', and a first line with the names of "
        "columns\n"
        "are passed over; each line of the output is 'geom prim t u v' with 17 digits, or 'miss', "
        "for\n"
        "a ray.",
    .flags = flags,
    .flag_count = sizeof flags / sizeof flags[0],
    .run = run,
};
