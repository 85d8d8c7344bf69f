/* SPDX-License-Identifier: Apache-2.0
 *
 * Density estimation on paths, with the discs as objects of the library: see photons.h.
 */
#include "photons.h"

#include "tool/threads.h"
#include "photons_surface.h"
#include "photons_vector.h"

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

/* Paths that a thread takes at once. */
enum { BLOCK = 256 };

/* The estimate under way. */
typedef struct estimate {
    const accel *discs;
    const struct photons *photons;
    const struct photon_run *run;
    struct receivers receivers;
    double radius;
    atomic_uint *crossings; /* of receiver r by paths of light l: [r * lights + l] */
    atomic_size_t next;     /* path that nobody has taken yet */
    atomic_ullong nodes, tests;
} estimate;

/* What a visitor of one path knows. */
typedef struct path {
    estimate *estimate;
    uint32_t light;
} path;

/* The disc around a receiver, half-open: from the front, nearer than the radius. */
static void cross_disc(accel_probe *probe)
{
    const estimate *e = probe->user;
    const struct receiver *receiver = &e->receivers.at[probe->prim];
    double from[3];
    vector_subtract(from, probe->ray->org, receiver->at);
    const double height = vector_dot(from, receiver->normal);
    const double fall = -vector_dot(probe->ray->dir, receiver->normal);
    if (!(height > 0.0 && fall > 0.0)) {
        return;
    }
    double apart[3];
    vector_add_scaled(apart, from, height / fall, probe->ray->dir);
    if (vector_dot(apart, apart) < e->radius * e->radius) {
        accel_report(probe, height / fall, 0.0, 0.0);
    }
}

static bool count_disc(void *user, const accel_hit *hit)
{
    const path *p = user;
    const size_t at = (size_t)hit->prim * p->estimate->run->lights.count + p->light;
    atomic_fetch_add_explicit(&p->estimate->crossings[at], 1, memory_order_relaxed);
    return true;
}

static void send_path(estimate *e, const struct photon *photon, accel_query *query)
{
    double org[3];
    vector_add_scaled(org, photon->at, -photon->length, photon->dir);
    accel_ray ray = accel_ray_from(org, photon->dir);
    ray.tmax = photon->length + e->radius;
    accel_all(e->discs, &ray, count_disc, &(path){e, photon->light}, query);
}

static void work(void *user, unsigned thread)
{
    estimate *e = user;
    accel_query query = {.user = NULL};
    size_t first;
    while ((first = atomic_fetch_add(&e->next, BLOCK)) < e->photons->count) {
        const size_t rest = e->photons->count - first;
        for (size_t i = 0; i < (rest < BLOCK ? rest : BLOCK); i++) {
            send_path(e, &e->photons->at[first + i], &query);
        }
        if (thread == 0 && e->run->progress != NULL) {
            e->run->progress(e->run->user, (double)first / (double)e->photons->count);
        }
    }
    atomic_fetch_add(&e->nodes, query.nodes);
    atomic_fetch_add(&e->tests, query.tests);
}

/* Half the width of the disc along axis k is radius * sqrt(1 - n_k^2); from the two other parts of
 * the normal it is right to rounding also where n_k is nearly 1. */
static accel_box disc_box(const struct receiver *receiver, double radius)
{
    accel_box box;
    const double *n = receiver->normal;
    for (int k = 0; k < 3; k++) {
        const double i = n[(k + 1) % 3], j = n[(k + 2) % 3];
        const double half = radius * sqrt(i * i + j * j);
        box.lo[k] = receiver->at[k] - half;
        box.hi[k] = receiver->at[k] + half;
    }
    return box;
}

static accel *build_discs(estimate *e, accel_box *boxes, const char *config, accel_error *error)
{
    for (size_t i = 0; i < e->receivers.count; i++) {
        boxes[i] = disc_box(&e->receivers.at[i], e->radius);
    }
    const accel_geometry geometry = {.type = ACCEL_OBJECTS,
                                     .objects = {.boxes = boxes,
                                                 .count = (uint32_t)e->receivers.count,
                                                 .order = ACCEL_ORDER_KEY,
                                                 .intersect = cross_disc,
                                                 .user = e}};
    const accel_scene scene = {&geometry, 1};
    accel *discs = NULL;
    accel_build(&discs, &scene, config, NULL, error);
    return discs;
}

static void add_up(const estimate *e, double *irradiance)
{
    const double area = acos(-1.0) * e->radius * e->radius;
    const uint32_t lights = e->run->lights.count;
    for (size_t i = 0; i < e->receivers.count; i++) {
        double power = 0.0;
        for (uint32_t l = 0; l < lights; l++) {
            power += atomic_load(&e->crossings[i * lights + l]) * photon_power(e->run, l);
        }
        irradiance[i] = power / area;
    }
}

bool irradiance_paths(const struct photons *photons, const struct photon_run *run,
                      struct receivers receivers, double radius, const char *config,
                      double *irradiance, accel_query *query, accel_error *error)
{
    estimate e = {.photons = photons, .run = run, .receivers = receivers, .radius = radius};
    accel_box *boxes = malloc((receivers.count + 1) * sizeof *boxes);
    e.crossings = calloc(receivers.count * run->lights.count + 1, sizeof *e.crossings);
    accel *discs = NULL;
    if (boxes == NULL || e.crossings == NULL || receivers.count >= ACCEL_NONE) {
        snprintf(error->text, sizeof error->text, "out of memory for %zu discs", receivers.count);
    } else {
        discs = build_discs(&e, boxes, config, error);
    }
    free(boxes);
    if (discs != NULL) {
        e.discs = discs;
        threads_run(run->threads, work, &e);
        add_up(&e, irradiance);
        query->nodes += atomic_load(&e.nodes);
        query->tests += atomic_load(&e.tests);
    }
    accel_free(discs);
    free(e.crossings);
    return discs != NULL;
}

double irradiance_radius(const struct photons *photons, const accel_scene *scene, double paths)
{
    accel_box box;
    double size[3];
    scene_box(scene, &box);
    vector_subtract(size, box.hi, box.lo);
    const double most = 0.05 * sqrt(vector_dot(size, size));
    const double area = scene_area(scene);
    return photons->count == 0
               ? most
               : fmin(most, sqrt(paths * area / (acos(-1.0) * (double)photons->count)));
}
