/* SPDX-License-Identifier: Apache-2.0 */
#include "report_runs.h"

#include "judge.h"
#include "machine.h"
#include "photons.h"
#include "photons_surface.h"
#include "quantile.h"
#include "scatter.h"

#include <stdlib.h>

enum { TURNS = 5, LEAST_JUDGED = 10 };

static double length_of(const accel_scene *scene)
{
    accel_box box;
    double square = 0.0;
    accel_scene_box(scene, &box);
    for (int k = 0; k < 3; k++) {
        square += pow(box.hi[k] - box.lo[k], 2.0);
    }
    return sqrt(square);
}

static bool same(const accel_ray_set *set, size_t i, bool found, const accel_hit *hit)
{
    const accel_hit *right = &set->hits[i];
    return found == (right->geom != ACCEL_NONE) && (!found || accel_same_hit(right, hit));
}

/* Linear over the first rays, until the time is over. */
static bool judge(accel_ground *g, accel_reporting *r, double seconds)
{
    accel *linear = accel_report_build(r, &g->loaded.scene, "linear");
    if (linear == NULL) {
        return false;
    }
    const double end = accel_seconds() + seconds;
    for (size_t i = 0; i < g->set.count && (i < LEAST_JUDGED || accel_seconds() < end); i++) {
        accel_hit hit;
        const bool found = accel_closest(linear, &g->set.rays[i], &hit, NULL);
        r->judged++;
        r->wrong += !same(&g->set, i, found, &hit);
    }
    accel_free(linear);
    return true;
}

/* One ray from a light, or from what that hits. False: it hits nothing. */
static bool make_photon(const accel_ground *g, const accel *a, const accel_light *light,
                        accel_random *random, bool reflected, accel_ray *ray)
{
    double from[3], normal[3], dir[3];
    const double u = accel_random_unit(random), v = accel_random_unit(random);
    for (int k = 0; k < 3; k++) {
        from[k] = light->corner[k] + u * light->edge[0][k] + v * light->edge[1][k];
    }
    vector_cross(normal, light->edge[0], light->edge[1]);
    vector_normalize(normal);
    accel_scatter(normal, random, dir);
    *ray = accel_ray_from(from, dir);
    accel_hit hit;
    if (!accel_closest(a, ray, &hit, NULL)) {
        return !reflected;
    }
    if (reflected) {
        const accel_surface surface = accel_surface_at(&g->loaded.scene, ray, &hit);
        accel_scatter(surface.normal, random, dir);
        *ray = accel_ray_from(surface.at, dir);
        ray->skip = (accel_id){hit.geom, hit.prim};
    }
    return true;
}

static bool make_photons(accel_ground *g, const char *scene, const accel *a, size_t count)
{
    accel_light lights[ACCEL_MOST_LIGHTS];
    const uint32_t light_count = accel_scene_lights(scene, &g->loaded.scene, lights);
    g->set = (accel_ray_set){.name = "photon",
                             .rays = malloc((count + 1) * sizeof(accel_ray)),
                             .hits = malloc((count + 1) * sizeof(accel_hit))};
    if (g->set.rays == NULL || g->set.hits == NULL) {
        return false;
    }
    for (uint64_t i = 0; g->set.count < count && i < 16 * (uint64_t)count; i++) {
        accel_random random = accel_random_start(1, 78, i);
        const accel_light *light = &lights[i % light_count];
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

bool accel_ground_make(accel_ground *g, accel_reporting *r, const char *scene,
                       accel_ground_rays which, size_t rays, double seconds)
{
    *g = (accel_ground){.set = {.count = 0}};
    if (!accel_open_scene(&g->loaded, scene, r->command, &r->progress)) {
        return false;
    }
    accel *a = accel_report_build(r, &g->loaded.scene, ACCEL_DEFAULT_CONFIG);
    bool fine = a != NULL;
    if (fine && !(which == ACCEL_GROUND_PHOTONS
                      ? make_photons(g, scene, a, rays)
                      : accel_make_set(&g->set, ACCEL_SET_BOUNCE, rays, a, &g->loaded.scene))) {
        accel_complain(r->command, "no memory for %zu rays; nothing was written", rays);
        fine = false;
    }
    accel_free(a);
    fine = fine && judge(g, r, seconds);
    if (!fine) {
        accel_ground_free(g);
    }
    return fine;
}

void accel_ground_free(accel_ground *g)
{
    accel_free_set(&g->set);
    accel_unload_scene(&g->loaded);
}

/* Traces all rays; what is timed. */
static void trace_ours(const void *state, const accel_ray_set *set)
{
    accel_hit hit;
    for (size_t i = 0; i < set->count; i++) {
        accel_closest(state, &set->rays[i], &hit, NULL);
    }
}

static void trace_peer(const void *state, const accel_ray_set *set)
{
    const accel_contender *c = state;
    c->trace(c, set);
}

static double median_ns(void (*trace)(const void *, const accel_ray_set *), const void *state,
                        const accel_ray_set *set)
{
    double ns[TURNS];
    for (int turn = 0; turn < TURNS; turn++) {
        const double start = accel_machine_seconds();
        trace(state, set);
        ns[turn] =
            1e9 * (accel_machine_seconds() - start) / (double)(set->count > 0 ? set->count : 1);
    }
    accel_sort_values(ns, TURNS);
    return ns[TURNS / 2];
}

/* Judges the first rays and counts, until the time is over. */
static void judge_run(accel_run *run, const accel_ground *g, const accel *a, double seconds)
{
    accel_query query = {.user = NULL};
    const double end = accel_seconds() + seconds;
    size_t i = 0;
    for (; i < g->set.count && (i < ACCEL_LEAST_RAYS || accel_seconds() < end); i++) {
        accel_hit hit;
        const bool found = accel_closest(a, &g->set.rays[i], &hit, &query);
        run->wrong += !same(&g->set, i, found, &hit);
    }
    run->rays = i;
    run->nodes = (double)query.nodes / (double)(i > 0 ? i : 1);
    run->tests = (double)query.tests / (double)(i > 0 ? i : 1);
}

bool accel_run_config(accel_run *run, accel_reporting *r, const accel_ground *g, const char *config,
                      double seconds)
{
    accel *a = accel_report_build(r, &g->loaded.scene, config);
    if (a == NULL) {
        return false;
    }
    accel_info info;
    accel_describe(a, &info);
    *run = (accel_run){.build = r->built, .bytes = (double)info.bytes};
    snprintf(run->name, sizeof run->name, "%.79s", config);
    judge_run(run, g, a, seconds / (TURNS + 1));
    accel_ray_set set = g->set;
    set.count = run->rays;
    run->ns = median_ns(trace_ours, a, &set);
    r->judged += run->rays;
    r->wrong += run->wrong;
    accel_free(a);
    return true;
}

size_t accel_run_peers(accel_run runs[ACCEL_MOST_PEERS], const accel_ground *g)
{
    accel_contender peers[ACCEL_MOST_PEERS];
    const size_t count = accel_bench_peers(peers, &g->loaded.scene, length_of(&g->loaded.scene));
    for (size_t c = 0; c < count; c++) {
        accel_run *run = &runs[c];
        *run = (accel_run){.peer = true,
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
