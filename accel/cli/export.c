/* SPDX-License-Identifier: Apache-2.0
 *
 * accel export: a scene as a file for POV-Ray to include. See sdl.c for what is written.
 */
#include "commands.h"
#include "output.h"
#include "sdl.h"
#include "structure.h"

#include <string.h>

enum { FLAG_OUTPUT, FLAG_AS };

static const accel_flag flags[] = {
    {"output", 'o', "FILE.inc", "file to write; " ACCEL_DASH},
    {"as", 0, "FORM",
     "mesh2 (default): an array Geometry of mesh2 objects, vertices rounded to float;\n"
     "triangles: an array Corners[TRIANGLE][3], exact in double; geometry G begins at First[G]"},
};

/* What is to be done. */
typedef struct job {
    const char *scene;
    const char *output;
    accel_sdl_form form;
} job;

static int write_scene(const accel_command *command, const job *job, const accel_scene *scene,
                       FILE *file)
{
    accel_error error;
    if (!accel_sdl_fits(scene, job->form, &error)) {
        return accel_complain(command, "%s: %s; nothing was written", job->scene, error.text);
    }
    return accel_sdl_write(file, scene, job->form)
               ? ACCEL_EXIT_FINE
               : accel_complain(command, "out of memory; nothing was written");
}

static int load_and_write(const accel_command *command, const job *job, bool quiet, FILE *file)
{
    accel_progress progress = accel_progress_start(quiet);
    accel_loaded loaded;
    if (!accel_open_scene(&loaded, job->scene, command, &progress)) {
        return ACCEL_EXIT_BAD;
    }
    const int code = write_scene(command, job, &loaded.scene, file);
    accel_unload_scene(&loaded);
    return code;
}

static int export_scene(const accel_command *command, const job *job, bool quiet)
{
    accel_output output;
    accel_error error;
    if (!accel_output_open(&output, job->output, &error)) {
        return accel_complain(command, "%s", error.text);
    }
    return accel_end_output(&output, load_and_write(command, job, quiet, output.file),
                            ACCEL_EXIT_FINE, command);
}

static bool read_form(const accel_command *command, const char *word, accel_sdl_form *form)
{
    const bool mesh2 = strcmp(word, "mesh2") == 0;
    if (!mesh2 && strcmp(word, "triangles") != 0) {
        accel_complain(command, "unknown form '%.60s'; mesh2 and triangles are allowed", word);
        return false;
    }
    *form = mesh2 ? ACCEL_SDL_MESH2 : ACCEL_SDL_TRIANGLES;
    return true;
}

static int run(const accel_command *command, int argc, char **argv)
{
    accel_arguments arguments = accel_arguments_start(command, argc, argv);
    job job = {.form = ACCEL_SDL_MESH2};
    for (;;) {
        switch (accel_next_argument(&arguments)) {
        case ACCEL_ARGUMENT_STOP:
            return arguments.exit_code;
        case FLAG_OUTPUT:
            job.output = arguments.value;
            break;
        case FLAG_AS:
            if (!read_form(command, arguments.value, &job.form)) {
                return ACCEL_EXIT_BAD;
            }
            break;
        case ACCEL_ARGUMENT_WORD:
            if (!accel_one_word(&arguments, "SCENE", &job.scene)) {
                return ACCEL_EXIT_BAD;
            }
            break;
        default:
            if (job.scene == NULL || job.output == NULL) {
                return accel_complain(command,
                                      "SCENE and -o FILE.inc are needed; usage: accel %s %s",
                                      command->name, command->arguments);
            }
            return export_scene(command, &job, arguments.quiet);
        }
    }
}

const accel_command accel_command_export = {
    .name = "export",
    .arguments = "SCENE -o FILE.inc [--as FORM]",
    .summary = "write a scene as a file for POV-Ray to include",
    .flags = flags,
    .flag_count = sizeof flags / sizeof flags[0],
    .run = run,
};
