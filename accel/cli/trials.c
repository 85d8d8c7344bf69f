/* SPDX-License-Identifier: Apache-2.0 */
#include "trials.h"

#include "quantile.h"

#include <stdio.h>

static void show(void *progress, double done)
{
    accel_progress_show(progress, "photons", done);
}

static bool build_all(accel_trials *t, const accel_loaded *loaded, const accel_command *command,
                      accel_progress *progress)
{
    for (size_t i = 0; i < t->count; i++) {
        accel_trial *trial = &t->at[i];
        trial->structure = accel_open_structure(loaded, trial->config, command, progress);
        if (trial->structure == NULL) {
            return false;
        }
        accel_describe(trial->structure, &trial->info);
    }
    return true;
}

/* One turn of one structure. The first turn of each is hashed and judged. */
static int take_turn(accel_trials *t, size_t index, unsigned turn, const accel_loaded *loaded,
                     const accel_command *command)
{
    accel_trial *trial = &t->at[index];
    accel_photons photons;
    if (!accel_trace_photons(&photons, trial->structure, &loaded->scene, &t->run)) {
        return accel_complain(command, "out of memory for the photons");
    }
    trial->seconds[turn] = photons.processor;
    int code = ACCEL_EXIT_FINE;
    if (turn == 0) {
        const uint64_t hash = accel_photons_hash(&photons);
        t->hash = index == 0 ? hash : t->hash;
        if (hash != t->hash) {
            printf("DIFFERENT: %s: %s did not store the hits of %s\n", t->scene, trial->config,
                   t->at[0].config);
            code = ACCEL_EXIT_DIFFERENT;
        }
    }
    trial->photons = photons;
    trial->photons.at = NULL;
    accel_photons_free(&photons);
    return code;
}

static int take_turns(accel_trials *t, const accel_loaded *loaded, const accel_command *command,
                      accel_progress *progress)
{
    int code = ACCEL_EXIT_FINE;
    for (unsigned turn = 0; turn < t->repeats && code == ACCEL_EXIT_FINE; turn++) {
        for (size_t i = 0; i < t->count && code != ACCEL_EXIT_BAD; i++) {
            progress->what = t->at[i].config;
            const int own = take_turn(t, i, turn, loaded, command);
            code = own == ACCEL_EXIT_FINE ? code : own;
        }
    }
    progress->what = NULL;
    accel_progress_clear(progress);
    return code;
}

static void sum_up(accel_trial *trial, unsigned repeats)
{
    accel_sort_values(trial->seconds, repeats);
    trial->median = accel_quantile(trial->seconds, repeats, 0.5);
    trial->quartiles[0] = accel_quantile(trial->seconds, repeats, 0.25);
    trial->quartiles[1] = accel_quantile(trial->seconds, repeats, 0.75);
}

int accel_trials_run(accel_trials *t, const accel_command *command, accel_progress *progress)
{
    accel_loaded loaded;
    if (!accel_open_scene(&loaded, t->scene, command, progress)) {
        return ACCEL_EXIT_BAD;
    }
    accel_light lights[ACCEL_MOST_LIGHTS];
    t->run.lights.at = lights;
    t->run.lights.count = accel_scene_lights(t->scene, &loaded.scene, lights);
    t->run.progress = show;
    t->run.user = progress;
    int code = ACCEL_EXIT_BAD;
    if (build_all(t, &loaded, command, progress)) {
        code = take_turns(t, &loaded, command, progress);
    }
    for (size_t i = 0; i < t->count; i++) {
        sum_up(&t->at[i], t->repeats);
        accel_free(t->at[i].structure);
        t->at[i].structure = NULL;
    }
    t->run.lights.at = NULL;
    accel_unload_scene(&loaded);
    return code;
}
