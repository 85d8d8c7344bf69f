/* SPDX-License-Identifier: Apache-2.0
 *
 * What every subcommand with a SCENE and CONFIGs does: load, build with progress, write figures,
 * complain.
 */
#ifndef ACCEL_CLI_STRUCTURE_H
#define ACCEL_CLI_STRUCTURE_H

#include "bench/forms.h"
#include "tool/options.h"
#include "tool/output.h"
#include "tool/progress.h"
#include "scenes/scene.h"

enum { MOST_CONFIGS = 64 };

/* The CONFIGs given by -a, in order. */
struct configs {
    const char *items[MOST_CONFIGS];
    size_t count;
};

/* Adds one, or complains and returns false. */
bool configs_add(struct configs *configs, const char *config, const struct command *command);

/* Adds all but linear, which judges the others; `forms` must stay. False: said. */
bool configs_add_forms(struct configs *configs, const struct forms *forms,
                       const struct command *command);

enum { MOST_SCENES = 64 };

/* The SCENEs of a command that takes many, in order. */
struct scene_names {
    const char *items[MOST_SCENES];
    size_t count;
};

/* Adds one that can be made or read, or complains and returns false. */
bool scene_names_add(struct scene_names *names, const char *name, const struct command *command);

/* Puts a file in place after a run that ended with `code`, or removes it where that is worse than
 * `worst`. Returns the exit code. */
int end_output(struct output *output, int code, int worst, const struct command *command);

/* Loads SCENE with progress, or complains and returns false. */
bool open_scene(struct loaded *loaded, const char *name, const struct command *command,
                struct progress *progress);

/* Builds with progress, or complains and returns NULL. Warns of invalid primitives, once. */
accel *open_structure(const struct loaded *loaded, const char *config,
                      const struct command *command, struct progress *progress);

#endif
