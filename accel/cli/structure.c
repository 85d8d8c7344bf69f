/* SPDX-License-Identifier: Apache-2.0
 *
 * Loading a scene and building structures for a subcommand.
 */
#include "structure.h"

#include <inttypes.h>
#include <string.h>

bool accel_configs_add(accel_configs *configs, const char *config, const accel_command *command)
{
    if (configs->count == ACCEL_MOST_CONFIGS) {
        accel_complain(command, "more than %d configs; allowed are %d", ACCEL_MOST_CONFIGS,
                       ACCEL_MOST_CONFIGS);
        return false;
    }
    configs->items[configs->count++] = config;
    return true;
}

bool accel_configs_add_forms(accel_configs *configs, const accel_forms *forms,
                             const accel_command *command)
{
    for (size_t i = 0; i < forms->count; i++) {
        if (strcmp(forms->at[i], "linear") != 0 &&
            !accel_configs_add(configs, forms->at[i], command)) {
            return false;
        }
    }
    return true;
}

bool accel_scene_names_add(accel_scene_names *names, const char *name, const accel_command *command)
{
    if (names->count == ACCEL_MOST_SCENES) {
        accel_complain(command, "more than %d scenes; allowed are %d", ACCEL_MOST_SCENES,
                       ACCEL_MOST_SCENES);
        return false;
    }
    accel_error error;
    if (!accel_scene_understood(name, &error)) {
        accel_complain(command, "%s", error.text);
        return false;
    }
    names->items[names->count++] = name;
    return true;
}

int accel_end_output(accel_output *output, int code, int worst, const accel_command *command)
{
    accel_error error;
    if (code > worst) {
        accel_output_abandon(output);
    } else if (!accel_output_commit(output, &error)) {
        return accel_complain(command, "%s", error.text);
    }
    return code;
}

/* Says what a file holds that is not in the scene. */
static void note_left_out(const accel_loaded *loaded, const char *name,
                          const accel_command *command)
{
    char left_out[80] = "";
    if (loaded->left_out != 0) {
        snprintf(left_out, sizeof left_out, "%" PRIu64 " points and lines are left out%s",
                 loaded->left_out, loaded->note[0] == '\0' ? "" : "; ");
    }
    if (left_out[0] != '\0' || loaded->note[0] != '\0') {
        accel_note(command, "%.200s: %s%s", name, left_out, loaded->note);
    }
}

bool accel_open_scene(accel_loaded *loaded, const char *name, const accel_command *command,
                      accel_progress *progress)
{
    accel_error error;
    progress->what = name;
    const bool fine = accel_load_scene(loaded, name, accel_progress_load, progress, &error);
    progress->what = NULL;
    accel_progress_clear(progress);
    if (fine) {
        note_left_out(loaded, name, command);
    } else {
        accel_complain(command, "%s", error.text);
    }
    return fine;
}

/* Says, once in a run, that primitives are missing from what follows. */
static void warn_of_skipped(const accel *a, const accel_command *command)
{
    static bool warned;
    accel_info info;
    accel_describe(a, &info);
    if (warned || info.skipped == 0) {
        return;
    }
    warned = true;
    fprintf(stderr,
            "accel %s: warning: %" PRIu64 " of %" PRIu64 " primitives are invalid and skipped, the "
            "first is geometry %" PRIu32 ", primitive %" PRIu32 "\n",
            command->name, info.skipped, info.primitives, info.skipped_ids[0].geom,
            info.skipped_ids[0].prim);
}

accel *accel_open_structure(const accel_loaded *loaded, const char *config,
                            const accel_command *command, accel_progress *progress)
{
    accel *a;
    accel_error error;
    const accel_hooks hooks = {.user = progress, .progress = accel_progress_build};
    progress->what = config;
    const accel_status status = accel_build(&a, &loaded->scene, config, &hooks, &error);
    progress->what = NULL;
    accel_progress_clear(progress);
    if (status != ACCEL_OK) {
        accel_complain(command, "%s", error.text);
        return NULL;
    }
    warn_of_skipped(a, command);
    return a;
}
