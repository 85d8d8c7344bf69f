/* SPDX-License-Identifier: Apache-2.0
 *
 * What every subcommand with a SCENE and CONFIGs does: load, build with progress, complain.
 */
#ifndef ACCEL_CLI_STRUCTURE_H
#define ACCEL_CLI_STRUCTURE_H

#include "forms.h"
#include "options.h"
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

/* Loads SCENE with progress, or complains and returns false. */
bool accel_open_scene(accel_loaded *loaded, const char *name, const accel_command *command,
                      accel_progress *progress);

/* Builds with progress, or complains and returns NULL. */
accel *accel_open_structure(const accel_loaded *loaded, const char *config,
                            const accel_command *command, accel_progress *progress);

#endif
