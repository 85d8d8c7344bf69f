/* SPDX-License-Identifier: Apache-2.0
 *
 * What every subcommand with a SCENE and CONFIGs does: load, build with progress, write figures,
 * complain.
 */
#ifndef ACCEL_CLI_STRUCTURE_H
#define ACCEL_CLI_STRUCTURE_H

#include "forms.h"
#include "options.h"
#include "output.h"
#include "progress.h"
#include "scene.h"

enum { ACCEL_MOST_CONFIGS = 64 };

/* The CONFIGs given by -a, in order. */
typedef struct accel_configs {
    const char *items[ACCEL_MOST_CONFIGS];
    size_t count;
} accel_configs;

/* Adds one, or complains and returns false. */
bool accel_configs_add(accel_configs *configs, const char *config, const accel_command *command);

/* Adds all but linear, which judges the others; `forms` must stay. False: said. */
bool accel_configs_add_forms(accel_configs *configs, const accel_forms *forms,
                             const accel_command *command);

enum { ACCEL_MOST_SCENES = 64 };

/* The SCENEs of a command that takes many, in order. */
typedef struct accel_scene_names {
    const char *items[ACCEL_MOST_SCENES];
    size_t count;
} accel_scene_names;

/* Adds one that can be made or read, or complains and returns false. */
bool accel_scene_names_add(accel_scene_names *names, const char *name,
                           const accel_command *command);

/* Puts a file in place after a run that ended with `code`, or removes it where that is worse than
 * `worst`. Returns the exit code. */
int accel_end_output(accel_output *output, int code, int worst, const accel_command *command);

/* Loads SCENE with progress, or complains and returns false. */
bool accel_open_scene(accel_loaded *loaded, const char *name, const accel_command *command,
                      accel_progress *progress);

/* Builds with progress, or complains and returns NULL. Warns of invalid primitives, once. */
accel *accel_open_structure(const accel_loaded *loaded, const char *config,
                            const accel_command *command, accel_progress *progress);

#endif
