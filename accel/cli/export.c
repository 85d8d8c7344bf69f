/* SPDX-License-Identifier: Apache-2.0
 *
 * accel export: a scene as a file for POV-Ray to include. See sdl.c for what is written.
 */
#include "commands.h"
#include "tool/output.h"
#include "sdl.h"
#include "structure.h"

#include <inttypes.h>
#include <string.h>

enum { FLAG_OUTPUT, FLAG_AS };

static const struct flag flags[] = {
    {"output", 'o', "FILE.inc", "file to write; " ACCEL_DASH},
    {"as", 0, "FORM",
     "mesh2 (default): an array Geometry of mesh2 objects, vertices rounded to float;\n"
     "triangles: an array Corners[TRIANGLE][3], exact in double; geometry G begins at First[G]"},
};

/* What is to be done. */
typedef struct job {
    const char *scene;
    const char *output;
    enum sdl_form form;
} job;

static int write_scene(const struct command *command, const job *job, const accel_scene *scene,
                       FILE *file)
{
    accel_error error;
    if (!sdl_fits(scene, job->form, &error)) {
        return complain(command, "%s: %s; nothing was written", job->scene, error.text);
    }
    const uint64_t lost = job->form == SDL_MESH2 ? sdl_lost_as_float(scene) : 0;
    if (lost != 0) {
        fprintf(stderr,
                "accel export: %s: %" PRIu64
                " triangles have no area once they are rounded to float, "
                "as POV-Ray's meshes are; --as triangles keeps them\n",
                job->scene, lost);
    }
    return sdl_write(file, scene, job->form)
               ? EXIT_FINE
               : complain(command, "out of memory; nothing was written");
}

static int load_and_write(const struct command *command, const job *job, bool quiet, FILE *file)
{
    struct progress progress = progress_start(quiet);
    struct loaded loaded;
    if (!open_scene(&loaded, job->scene, command, &progress)) {
        return EXIT_BAD;
    }
    const int code = write_scene(command, job, &loaded.scene, file);
    unload_scene(&loaded);
    return code;
}

static int export_scene(const struct command *command, const job *job, bool quiet)
{
    struct output output;
    accel_error error;
    if (!output_open(&output, job->output, &error)) {
        return complain(command, "%s", error.text);
    }
    return end_output(&output, load_and_write(command, job, quiet, output.file), EXIT_FINE,
                      command);
}

static bool read_form(const struct command *command, const char *word, enum sdl_form *form)
{
    const bool mesh2 = strcmp(word, "mesh2") == 0;
    if (!mesh2 && strcmp(word, "triangles") != 0) {
        complain(command, "unknown form '%.60s'; mesh2 and triangles are allowed", word);
        return false;
    }
    *form = mesh2 ? SDL_MESH2 : SDL_TRIANGLES;
    return true;
}

static int run(const struct command *command, int argc, char **argv)
{
    struct arguments arguments = arguments_start(command, argc, argv);
    job job = {.form = SDL_MESH2};
    for (;;) {
        switch (next_argument(&arguments)) {
        case ARGUMENT_STOP:
            return arguments.exit_code;
        case FLAG_OUTPUT:
            job.output = arguments.value;
            break;
        case FLAG_AS:
            if (!read_form(command, arguments.value, &job.form)) {
                return EXIT_BAD;
            }
            break;
        case ARGUMENT_WORD:
            if (!one_word(&arguments, "SCENE", &job.scene)) {
                return EXIT_BAD;
            }
            break;
        default:
            if (job.scene == NULL || job.output == NULL) {
                return complain(command, "SCENE and -o FILE.inc are needed; usage: accel %s %s",
                                command->name, command->arguments);
            }
            return export_scene(command, &job, arguments.quiet);
        }
    }
}

const struct command command_export = {
    .name = "export",
    .arguments = "SCENE -o FILE.inc [--as FORM]",
    .summary = "write a scene as a file for POV-Ray to include",
    .flags = flags,
    .flag_count = sizeof flags / sizeof flags[0],
    .run = run,
};
