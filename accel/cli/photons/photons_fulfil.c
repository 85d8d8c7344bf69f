/* SPDX-License-Identifier: Apache-2.0
 *
 * accel photons: photons and irradiance through each CONFIG, and that all agree in every bit.
 */
#include "photons_request.h"

#include "camera_argument.h"
#include "photons_view.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* One run of the command. */
typedef struct session {
    const struct command *command;
    struct photon_request *request;
    struct loaded loaded;
    struct progress progress;
    struct camera camera;
    struct view view;   /* made with the first structure */
    double *irradiance; /* of its receivers through the first CONFIG */
    double *again;      /* through another one */
    uint64_t hash;      /* of what the first CONFIG stored */
    bool different;     /* a CONFIG disagreed */
} session;

static void show_photons(void *progress, double done)
{
    progress_show(progress, "photons", done);
}

static void print_head(const session *s)
{
    const struct photon_run *run = &s->request->run;
    printf("%s: %" PRIu32 " lights, %" PRIu32 " photons for each, reflectance %g, seed %" PRIu64
           ", %u threads\n",
           s->request->scene, run->lights.count, run->photons, run->reflectance, run->seed,
           run->threads);
    printf("%-36s %8s %8s %8s %10s %10s %7s %7s %7s  %s\n", "structure", "build s", "illum s",
           "cpu s", "rays", "hits", "nodes/r", "tests/r", "ns/ray", "hash of the hits");
}

static void print_row(const char *config, const accel *a, const struct photons *photons,
                      uint64_t hash)
{
    accel_info info;
    accel_describe(a, &info);
    const double rays = (double)photons->rays;
    printf("%-36s %8.3f %8.3f %8.3f %10" PRIu64 " %10zu %7.2f %7.2f %7.0f  %016" PRIx64 "\n",
           config, info.seconds, photons->seconds, photons->processor, photons->rays,
           photons->count, (double)photons->query.nodes / rays, (double)photons->query.tests / rays,
           1e9 * photons->processor / rays, hash);
    fflush(stdout);
}

static bool disagree(session *s, const char *config, const char *what)
{
    s->different = true;
    printf("DIFFERENT: %s has other %s than %s\n", config, what, s->request->configs.items[0]);
    return true;
}

/* The receivers, once, through the first structure: any other gives the same. */
static bool prepare_view(session *s, const accel *a, const struct photons *photons)
{
    if (s->irradiance != NULL) {
        return true;
    }
    if (s->request->radius == 0.0) {
        s->request->radius = irradiance_radius(photons, &s->loaded.scene, 100.0);
    }
    if (!view_make(&s->view, a, &s->loaded.scene, &s->camera)) {
        return false;
    }
    s->irradiance = malloc((s->view.count + 1) * sizeof(double));
    s->again = malloc((s->view.count + 1) * sizeof(double));
    return s->irradiance != NULL && s->again != NULL;
}

static bool estimate(const session *s, const struct photons *photons, const char *config,
                     double *irradiance, accel_error *error)
{
    const struct photon_request *r = s->request;
    const struct receivers receivers = {s->view.receivers, s->view.count};
    accel_query query = {.user = NULL};
    snprintf(error->text, sizeof error->text, "out of memory for the irradiance");
    return r->nearest ? irradiance_nearest(photons, &r->run, receivers, r->radius,
                                           (uint32_t)r->count, irradiance)
                      : irradiance_paths(photons, &r->run, receivers, r->radius, config, irradiance,
                                         &query, error);
}

static void print_irradiance(const session *s, const double *irradiance, double seconds)
{
    double mean = 0.0;
    for (size_t i = 0; i < s->view.count; i++) {
        mean += irradiance[i] / (double)s->view.count;
    }
    printf("  irradiance by %s, radius %.6g: %zu points, mean %.9g, %.3f s\n",
           s->request->nearest ? "nearest photons" : "paths", s->request->radius, s->view.count,
           mean, seconds);
    fflush(stdout);
}

static int find_irradiance(session *s, const accel *a, const struct photons *photons,
                           const char *config)
{
    const bool first = s->irradiance == NULL;
    accel_error error;
    if (!prepare_view(s, a, photons)) {
        return complain(s->command, "out of memory for the picture");
    }
    double *irradiance = first ? s->irradiance : s->again;
    const double start = seconds_now();
    const bool fine = estimate(s, photons, config, irradiance, &error);
    progress_clear(&s->progress);
    if (!fine) {
        return complain(s->command, "%s", error.text);
    }
    print_irradiance(s, irradiance, seconds_now() - start);
    if (memcmp(irradiance, s->irradiance, s->view.count * sizeof *irradiance) != 0) {
        disagree(s, config, "irradiance");
    }
    return EXIT_FINE;
}

static int illuminate(session *s, const accel *a, const char *config)
{
    struct photons photons;
    const bool fine = trace_photons(&photons, a, &s->loaded.scene, &s->request->run);
    progress_clear(&s->progress);
    if (!fine) {
        return complain(s->command, "out of memory for the photons");
    }
    const uint64_t hash = photons_hash(&photons);
    print_row(config, a, &photons, hash);
    if (config == s->request->configs.items[0]) {
        s->hash = hash;
    } else if (hash != s->hash) {
        disagree(s, config, "hits");
    }
    const int code = s->request->time_only ? EXIT_FINE : find_irradiance(s, a, &photons, config);
    photons_free(&photons);
    return code;
}

static int illuminate_all(session *s)
{
    print_head(s);
    for (size_t i = 0; i < s->request->configs.count; i++) {
        const char *config = s->request->configs.items[i];
        accel *a = open_structure(&s->loaded, config, s->command, &s->progress);
        if (a == NULL) {
            return EXIT_BAD;
        }
        s->progress.what = config;
        const int code = illuminate(s, a, config);
        accel_free(a);
        if (code != EXIT_FINE) {
            return code;
        }
    }
    return s->different ? EXIT_DIFFERENT : EXIT_FINE;
}

/* A CONFIG that is wrong is told before the first one's results: built over nothing. */
static bool check_configs(const session *s)
{
    const accel_scene nothing = {NULL, 0};
    for (size_t i = 0; i < s->request->configs.count; i++) {
        accel *a;
        accel_error error;
        if (accel_build(&a, &nothing, s->request->configs.items[i], NULL, &error) != ACCEL_OK) {
            complain(s->command, "%s", error.text);
            return false;
        }
        accel_free(a);
    }
    return true;
}

/* `output` is NULL where no picture is asked for. */
static int illuminate_and_write(session *s, struct output *output)
{
    accel_error error;
    const int code = illuminate_all(s);
    return code == EXIT_BAD || output == NULL || view_write(&s->view, s->irradiance, output, &error)
               ? code
               : complain(s->command, "%s", error.text);
}

static int load_and_illuminate(const struct command *command, struct photon_request *r,
                               struct output *output)
{
    session s = {.command = command, .request = r, .progress = progress_start(r->quiet)};
    if (!open_scene(&s.loaded, r->scene, command, &s.progress)) {
        return EXIT_BAD;
    }
    if (r->light_count == 0) {
        r->light_count = scene_lights(r->scene, &s.loaded.scene, r->lights);
    }
    r->run.lights = (struct lights){r->lights, r->light_count};
    r->run.progress = show_photons;
    r->run.user = &s.progress;
    const char *size = r->size == NULL ? "320x240" : r->size;
    int code = EXIT_BAD;
    if (check_configs(&s) &&
        camera_argument(command, size, r->camera, &s.loaded.scene, &s.camera)) {
        code = illuminate_and_write(&s, output);
    }
    view_free(&s.view);
    free(s.irradiance);
    free(s.again);
    unload_scene(&s.loaded);
    return code;
}

/* The file is opened before anything long is computed, and appears whole or not at all. */
int photons_fulfil(const struct command *command, struct photon_request *r)
{
    struct output output;
    accel_error error;
    if (r->output == NULL) {
        return load_and_illuminate(command, r, NULL);
    }
    if (!output_open(&output, r->output, &error)) {
        return complain(command, "%s", error.text);
    }
    return end_output(&output, load_and_illuminate(command, r, &output), EXIT_DIFFERENT, command);
}
