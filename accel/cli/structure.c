/* SPDX-License-Identifier: Apache-2.0
 *
 * Loading a scene and building structures for a subcommand.
 */
#include "structure.h"

#include <inttypes.h>
#include <string.h>

bool configs_add(struct configs *configs, const char *config, const struct command *command)
{
    if (configs->count == MOST_CONFIGS) {
        complain(command, "more than %d configs; allowed are %d", MOST_CONFIGS, MOST_CONFIGS);
        return false;
    }
    configs->items[configs->count++] = config;
    return true;
}

bool configs_add_forms(struct configs *configs, const struct forms *forms,
                       const struct command *command)
{
    for (size_t i = 0; i < forms->count; i++) {
        if (strcmp(forms->at[i], "linear") != 0 && !configs_add(configs, forms->at[i], command)) {
            return false;
        }
    }
    return true;
}

bool scene_names_add(struct scene_names *names, const char *name, const struct command *command)
{
    if (names->count == MOST_SCENES) {
        complain(command, "more than %d scenes; allowed are %d", MOST_SCENES, MOST_SCENES);
        return false;
    }
    accel_error error;
    if (!scene_understood(name, &error)) {
        complain(command, "%s", error.text);
        return false;
    }
    names->items[names->count++] = name;
    return true;
}

int end_output(struct output *output, int code, int worst, const struct command *command)
{
    accel_error error;
    if (code > worst) {
        output_abandon(output);
    } else if (!output_commit(output, &error)) {
        return complain(command, "%s", error.text);
    }
    return code;
}

/* Says what a file holds that is not in the scene. */
static void note_left_out(const struct loaded *loaded, const char *name,
                          const struct command *command)
{
    char left_out[80] = "";
    if (loaded->left_out != 0) {
        snprintf(left_out, sizeof left_out, "%" PRIu64 " points and lines are left out%s",
                 loaded->left_out, loaded->note[0] == '\0' ? "" : "; ");
    }
    if (left_out[0] != '\0' || loaded->note[0] != '\0') {
        note(command, "%.200s: %s%s", name, left_out, loaded->note);
    }
}

static bool has_objects(const accel_scene *scene)
{
    bool found = false;
    for (uint32_t g = 0; g < scene->count; g++) {
        found = found || scene->geometries[g].type == ACCEL_OBJECTS;
    }
    return found;
}

bool open_scene(struct loaded *loaded, const char *name, const struct command *command,
                struct progress *progress)
{
    accel_error error;
    progress->what = name;
    const bool fine = load_scene(loaded, name, progress_load, progress, &error);
    progress->what = NULL;
    progress_clear(progress);
    if (!fine) {
        complain(command, "%s", error.text);
        return false;
    }
    if (!command->takes_objects && has_objects(&loaded->scene)) {
        unload_scene(loaded);
        complain(command,
                 "scene %s has objects of a host, allowed are triangles and spheres; "
                 "nothing was done",
                 name);
        return false;
    }
    note_left_out(loaded, name, command);
    return true;
}

/* Says, once in a run, that primitives are missing from what follows. */
static void warn_of_skipped(const accel *a, const struct command *command)
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

accel *open_structure(const struct loaded *loaded, const char *config,
                      const struct command *command, struct progress *progress)
{
    accel *a;
    accel_error error;
    const accel_hooks hooks = {.user = progress, .progress = progress_build};
    progress->what = config;
    const accel_status status = accel_build(&a, &loaded->scene, config, &hooks, &error);
    progress->what = NULL;
    progress_clear(progress);
    if (status != ACCEL_OK) {
        complain(command, "%s", error.text);
        return NULL;
    }
    warn_of_skipped(a, command);
    return a;
}
