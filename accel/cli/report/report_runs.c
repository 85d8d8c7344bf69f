/* SPDX-License-Identifier: Apache-2.0 */
#include "report_runs.h"

#include "answers.h"
#include "tool/machine.h"
#include "photons/photons.h"
#include "photons/photons_surface.h"
#include "tool/quantile.h"
#include "photons/scatter.h"

#include <stdlib.h>

enum { TURNS = 5, LEAST_JUDGED = 10 };

static double length_of(const accel_scene *scene)
{
    accel_box box;
    double square = 0.0;
    scene_box(scene, &box);
    for (int k = 0; k < 3; k++) {
        square += pow(box.hi[k] - box.lo[k], 2.0);
    }
    return sqrt(square);
}

static bool same(const struct ray_set *set, size_t i, bool found, const accel_hit *hit)
{
    const accel_hit *right = &set->hits[i];
    return found == (right->geom != ACCEL_NONE) && (!found || same_hit(right, hit));
}

/* Linear over the first rays, until the time is over. */
static bool judge(struct ground *g, struct reporting *r, double seconds)
{
    accel *linear = report_build(r, &g->loaded.scene, "linear");
    if (linear == NULL) {
        return false;
    }
    const double end = seconds_now() + seconds;
    for (size_t i = 0; i < g->set.count && (i < LEAST_JUDGED || seconds_now() < end); i++) {
        accel_hit hit;
        const bool found = accel_closest(linear, &g->set.rays[i], &hit, NULL);
        r->judged++;
        r->wrong += !same(&g->set, i, found, &hit);
    }
    accel_free(linear);
    return true;
}

/* One ray from a light, or from what that hits. False: it hits nothing. */
static bool make_photon(const struct ground *g, const accel *a, const struct light *light,
                        struct random *random, bool reflected, accel_ray *ray)
{
    double from[3], normal[3], dir[3];
    const double u = random_unit(random), v = random_unit(random);
    for (int k = 0; k < 3; k++) {
        from[k] = light->corner[k] + u * light->edge[0][k] + v * light->edge[1][k];
    }
    vector_cross(normal, light->edge[0], light->edge[1]);
    vector_normalize(normal);
    scatter(normal, random, dir);
    *ray = accel_ray_from(from, dir);
    accel_hit hit;
    if (!accel_closest(a, ray, &hit, NULL)) {
        return !reflected;
    }
    if (reflected) {
        const struct surface surface = surface_at(&g->loaded.scene, ray, &hit);
        scatter(surface.normal, random, dir);
        *ray = accel_ray_from(surface.at, dir);
        ray->skip = (accel_id){hit.geom, hit.prim};
    }
    return true;
}

static bool make_photons(struct ground *g, const char *scene, const accel *a, size_t count)
{
    struct light lights[MOST_LIGHTS];
    const uint32_t light_count = scene_lights(scene, &g->loaded.scene, lights);
    g->set = (struct ray_set){.name = "photon",
                              .rays = malloc((count + 1) * sizeof(accel_ray)),
                              .hits = malloc((count + 1) * sizeof(accel_hit))};
    if (g->set.rays == NULL || g->set.hits == NULL) {
        return false;
    }
    for (uint64_t i = 0; g->set.count < count && i < 16 * (uint64_t)count; i++) {
        struct random random = random_start(1, 78, i);
        const struct light *light = &lights[i % light_count];
        accel_ray *ray = &g->set.rays[g->set.count];
        if (!make_photon(g, a, light, &random, i / light_count % 2 == 1, ray)) {
            continue;
        }
        accel_hit *hit = &g->set.hits[g->set.count++];
        hit->geom = ACCEL_NONE;
        g->set.found += accel_closest(a, ray, hit, NULL);
    }
    return true;
}

bool ground_make(struct ground *g, struct reporting *r, const char *scene, enum ground_rays which,
                 size_t rays, double seconds)
{
    *g = (struct ground){.set = {.count = 0}};
    if (!open_scene(&g->loaded, scene, r->command, &r->progress)) {
        return false;
    }
    accel *a = report_build(r, &g->loaded.scene, ACCEL_DEFAULT_CONFIG);
    bool fine = a != NULL;
    if (fine &&
        !(which == GROUND_PHOTONS ? make_photons(g, scene, a, rays)
                                  : make_set(&g->set, SET_BOUNCE, rays, a, &g->loaded.scene))) {
        complain(r->command, "no memory for %zu rays; nothing was written", rays);
        fine = false;
    }
    accel_free(a);
    fine = fine && judge(g, r, seconds);
    if (!fine) {
        ground_free(g);
    }
    return fine;
}

void ground_free(struct ground *g)
{
    free_set(&g->set);
    unload_scene(&g->loaded);
}

/* Traces all rays; what is timed. */
static void trace_ours(const void *state, const struct ray_set *set)
{
    accel_hit hit;
    for (size_t i = 0; i < set->count; i++) {
        accel_closest(state, &set->rays[i], &hit, NULL);
    }
}

static void trace_peer(const void *state, const struct ray_set *set)
{
    const struct bench_contender *c = state;
    c->trace(c, set);
}

static double median_ns(void (*trace)(const void *, const struct ray_set *), const void *state,
                        const struct ray_set *set)
{
    double ns[TURNS];
    for (int turn = 0; turn < TURNS; turn++) {
        const double start = machine_seconds();
        trace(state, set);
        ns[turn] = 1e9 * (machine_seconds() - start) / (double)(set->count > 0 ? set->count : 1);
    }
    sort_values(ns, TURNS);
    return ns[TURNS / 2];
}

/* Judges the first rays and counts, until the time is over. */
static void judge_run(struct run *run, const struct ground *g, const accel *a, double seconds)
{
    accel_query query = {.user = NULL};
    const double end = seconds_now() + seconds;
    size_t i = 0;
    for (; i < g->set.count && (i < RUN_LEAST_RAYS || seconds_now() < end); i++) {
        accel_hit hit;
        const bool found = accel_closest(a, &g->set.rays[i], &hit, &query);
        run->wrong += !same(&g->set, i, found, &hit);
    }
    run->rays = i;
    run->nodes = (double)query.nodes / (double)(i > 0 ? i : 1);
    run->tests = (double)query.tests / (double)(i > 0 ? i : 1);
}

bool run_config(struct run *run, struct reporting *r, const struct ground *g, const char *config,
                double seconds)
{
    accel *a = report_build(r, &g->loaded.scene, config);
    if (a == NULL) {
        return false;
    }
    accel_info info;
    accel_describe(a, &info);
    *run = (struct run){.build = r->built, .bytes = (double)info.bytes};
    snprintf(run->name, sizeof run->name, "%.79s", config);
    judge_run(run, g, a, seconds / (TURNS + 1));
    struct ray_set set = g->set;
    set.count = run->rays;
    run->ns = median_ns(trace_ours, a, &set);
    r->judged += run->rays;
    r->wrong += run->wrong;
    accel_free(a);
    return true;
}

size_t run_peers(struct run runs[MOST_PEERS], const struct ground *g)
{
    struct bench_contender peers[MOST_PEERS];
    const size_t count = bench_peers(peers, &g->loaded.scene, length_of(&g->loaded.scene));
    for (size_t c = 0; c < count; c++) {
        struct run *run = &runs[c];
        *run = (struct run){.peer = true,
                            .rays = g->set.count,
                            .build = peers[c].build_seconds,
                            .bytes = peers[c].bytes};
        snprintf(run->name, sizeof run->name, "%.63s", peers[c].name);
        for (size_t i = 0; i < g->set.count; i++) {
            const accel_id got = peers[c].ask(&peers[c], &g->set, i);
            const accel_hit *right = &g->set.hits[i];
            run->wrong +=
                got.geom != right->geom || (right->geom != ACCEL_NONE && got.prim != right->prim);
        }
        run->ns = median_ns(trace_peer, &peers[c], &g->set);
        peers[c].end(&peers[c]);
    }
    return count;
}
