/* SPDX-License-Identifier: Apache-2.0 */
#include "trials.h"

#include "quantile.h"

#include <stdio.h>

static void show(void *progress, double done)
{
    progress_show(progress, "photons", done);
}

static bool build_all(struct trials *t, const struct loaded *loaded, const struct command *command,
                      struct progress *progress)
{
    for (size_t i = 0; i < t->count; i++) {
        struct trial *trial = &t->at[i];
        trial->structure = open_structure(loaded, trial->config, command, progress);
        if (trial->structure == NULL) {
            return false;
        }
        accel_describe(trial->structure, &trial->info);
    }
    return true;
}

/* One turn of one structure. The first turn of each is hashed and judged. */
static int take_turn(struct trials *t, size_t index, unsigned turn, const struct loaded *loaded,
                     const struct command *command)
{
    struct trial *trial = &t->at[index];
    struct photons photons;
    if (!trace_photons(&photons, trial->structure, &loaded->scene, &t->run)) {
        return complain(command, "out of memory for the photons");
    }
    trial->seconds[turn] = photons.processor;
    int code = EXIT_FINE;
    if (turn == 0) {
        const uint64_t hash = photons_hash(&photons);
        t->hash = index == 0 ? hash : t->hash;
        if (hash != t->hash) {
            printf("DIFFERENT: %s: %s did not store the hits of %s\n", t->scene, trial->config,
                   t->at[0].config);
            code = EXIT_DIFFERENT;
        }
    }
    trial->photons = photons;
    trial->photons.at = NULL;
    photons_free(&photons);
    return code;
}

static int take_turns(struct trials *t, const struct loaded *loaded, const struct command *command,
                      struct progress *progress)
{
    int code = EXIT_FINE;
    for (unsigned turn = 0; turn < t->repeats && code == EXIT_FINE; turn++) {
        for (size_t i = 0; i < t->count && code != EXIT_BAD; i++) {
            progress->what = t->at[i].config;
            const int own = take_turn(t, i, turn, loaded, command);
            code = own == EXIT_FINE ? code : own;
        }
    }
    progress->what = NULL;
    progress_clear(progress);
    return code;
}

static void sum_up(struct trial *trial, unsigned repeats)
{
    sort_values(trial->seconds, repeats);
    trial->median = quantile(trial->seconds, repeats, 0.5);
    trial->quartiles[0] = quantile(trial->seconds, repeats, 0.25);
    trial->quartiles[1] = quantile(trial->seconds, repeats, 0.75);
}

int trials_run(struct trials *t, const struct command *command, struct progress *progress)
{
    struct loaded loaded;
    if (!open_scene(&loaded, t->scene, command, progress)) {
        return EXIT_BAD;
    }
    struct light lights[MOST_LIGHTS];
    t->run.lights.at = lights;
    t->run.lights.count = scene_lights(t->scene, &loaded.scene, lights);
    t->run.progress = show;
    t->run.user = progress;
    int code = EXIT_BAD;
    if (build_all(t, &loaded, command, progress)) {
        code = take_turns(t, &loaded, command, progress);
    }
    for (size_t i = 0; i < t->count; i++) {
        sum_up(&t->at[i], t->repeats);
        accel_free(t->at[i].structure);
        t->at[i].structure = NULL;
    }
    t->run.lights.at = NULL;
    unload_scene(&loaded);
    return code;
}
