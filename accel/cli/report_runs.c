/* SPDX-License-Identifier: Apache-2.0 */
#include "report_runs.h"

#include "judge.h"
#include "machine.h"

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

bool accel_ground_make(accel_ground *g, accel_reporting *r, const char *scene, size_t rays,
                       double seconds)
{
    *g = (accel_ground){.set = {.count = 0}};
    if (!accel_open_scene(&g->loaded, scene, r->command, &r->progress)) {
        return false;
    }
    accel *a = accel_report_build(r, &g->loaded.scene, ACCEL_DEFAULT_CONFIG);
    bool fine = a != NULL;
    if (fine && !accel_make_set(&g->set, ACCEL_SET_BOUNCE, rays, a, &g->loaded.scene)) {
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

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
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
        ns[turn] = 1e9 * (accel_machine_seconds() - start) / (double)(set->count + 1);
    }
    qsort(ns, TURNS, sizeof ns[0], compare);
    return ns[TURNS / 2];
}

bool accel_run_config(accel_run *run, accel_reporting *r, const accel_ground *g, const char *config)
{
    accel *a = accel_report_build(r, &g->loaded.scene, config);
    if (a == NULL) {
        return false;
    }
    accel_info info;
    accel_describe(a, &info);
    *run = (accel_run){.rays = g->set.count, .build = r->built, .bytes = (double)info.bytes};
    snprintf(run->name, sizeof run->name, "%.79s", config);
    accel_query query = {.user = NULL};
    for (size_t i = 0; i < g->set.count; i++) {
        accel_hit hit;
        const bool found = accel_closest(a, &g->set.rays[i], &hit, &query);
        run->wrong += !same(&g->set, i, found, &hit);
    }
    run->nodes = (double)query.nodes / (double)(run->rays + 1);
    run->tests = (double)query.tests / (double)(run->rays + 1);
    run->ns = median_ns(trace_ours, a, &g->set);
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
