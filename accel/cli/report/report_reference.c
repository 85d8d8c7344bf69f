/* SPDX-License-Identifier: Apache-2.0
 *
 * Scenes and references of the report on illumination.
 *
 * The reference shares no estimator with the photons: it follows light backwards (Kajiya, SIGGRAPH
 * 1986). From a receiver a path leaves by the cosine and goes on at each diffuse surface with the
 * chance `reflectance`; at each of its points a shadow ray to a random point of the light adds
 *     power / pi * cos * cos' / distance^2.
 * Both sides of a surface reflect, as they do for photons. The mean over paths is the irradiance,
 * without bias; their spread gives its standard error.
 */
#include "report_light.h"

#include "camera.h"
#include "tool/threads.h"
#include "photons/photons_surface.h"
#include "photons/photons_vector.h"
#include "photons/plates.h"
#include "photons/scatter.h"
#include "loaded.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.141592653589793

enum { FLOOR_SIDE = 128, ROUND = 64, SEED = 977 };

/* ------------------------------------------------------------------- scenes ---- */

static void sum_up(struct light_scene *s)
{
    double square = 0.0;
    s->mean = 0.0;
    for (size_t i = 0; i < s->count; i++) {
        s->mean += s->right[i] / (double)s->count;
        square += s->error[i] * s->error[i] / (double)s->count;
    }
    s->floor = sqrt(square) / s->mean;
}

static bool make_floor(struct loaded *out)
{
    struct growing mesh = {0};
    for (uint32_t i = 0; i <= FLOOR_SIDE; i++) {
        for (uint32_t j = 0; j <= FLOOR_SIDE; j++) {
            grow_vertex(&mesh, (double)i / FLOOR_SIDE, 0.0, (double)j / FLOOR_SIDE);
        }
    }
    for (uint32_t i = 0; i < FLOOR_SIDE; i++) {
        for (uint32_t j = 0; j < FLOOR_SIDE; j++) {
            const uint32_t a = i * (FLOOR_SIDE + 1) + j, b = a + FLOOR_SIDE + 1;
            grow_triangle(&mesh, a, b, b + 1);
            grow_triangle(&mesh, a, b + 1, a + 1);
        }
    }
    return loaded_add(out, ACCEL_TRIANGLES, &mesh);
}

bool light_plates(struct light_scene *s, struct reporting *r)
{
    *s = (struct light_scene){.name = "plates",
                              .title = "lit square over a black floor",
                              .light = {{0, 1, 0}, {{1, 0, 0}, {0, 0, 1}}, 1.0},
                              .radius = {0.01, 0.04, 0.16}};
    s->run.lights = (struct lights){&s->light, 1};
    if (!make_floor(&s->loaded)) {
        complain(r->command, "no memory for the plates; nothing was written");
        return false;
    }
    for (int i = 0; i < RECEIVERS; i++) {
        const double x = 0.2 + 0.6 * (i % 8) / 7.0, z = 0.2 + 0.6 * (i / 8) / 7.0;
        s->receivers[i] = (struct receiver){{x, 0, z}, {0, 1, 0}};
        s->right[i] = ceiling_form_factor(x, z);
    }
    s->count = RECEIVERS;
    sum_up(s);
    return true;
}

/* Points that a camera sees, evenly over its picture. */
static void find_receivers(struct light_scene *s, const accel *a, const accel_box *box)
{
    double eye[3], at[3];
    struct camera camera;
    camera_frame(box, eye, at);
    camera_make(&camera, eye, at, 40.0, 4 * RECEIVERS, 4 * RECEIVERS);
    for (uint64_t i = 0; s->count < RECEIVERS && i < 64 * RECEIVERS; i++) {
        struct random random = random_start(SEED, 1, i);
        const accel_ray ray = camera_ray(&camera, random_in(&random, 0, 4 * RECEIVERS),
                                         random_in(&random, 0, 4 * RECEIVERS));
        accel_hit hit;
        if (!accel_closest(a, &ray, &hit, NULL)) {
            continue;
        }
        const struct surface surface = surface_at(&s->loaded.scene, &ray, &hit);
        struct receiver *to = &s->receivers[s->count];
        memcpy(to->at, surface.at, sizeof to->at);
        memcpy(to->normal, surface.normal, sizeof to->normal);
        s->on[s->count++] = (accel_id){hit.geom, hit.prim};
    }
}

bool light_teapots(struct light_scene *s, struct reporting *r, double seconds)
{
    static const char scene[] = "teapots";
    struct light lights[MOST_LIGHTS];
    *s = (struct light_scene){.name = scene, .title = "nine teapots and a floor"};
    if (!open_scene(&s->loaded, scene, r->command, &r->progress)) {
        return false;
    }
    scene_lights(scene, &s->loaded.scene, lights);
    s->light = lights[0];
    s->run.lights = (struct lights){&s->light, 1};
    s->run.reflectance = 0.5;
    accel *a = report_build(r, &s->loaded.scene, ACCEL_DEFAULT_CONFIG);
    if (a == NULL) {
        return false;
    }
    accel_box box;
    double size[3];
    scene_box(&s->loaded.scene, &box);
    vector_subtract(size, box.hi, box.lo);
    for (int i = 0; i < RADII; i++) {
        s->radius[i] = 0.0025 * pow(4.0, i) * sqrt(vector_dot(size, size));
    }
    find_receivers(s, a, &box);
    light_reference(s, a, seconds);
    sum_up(s);
    accel_free(a);
    return true;
}

void light_scene_free(struct light_scene *s)
{
    unload_scene(&s->loaded);
}

/* ---------------------------------------------------------------- reference ---- */

/* A point of a path. */
typedef struct stop {
    double at[3], normal[3];
    accel_id on; /* the primitive, which the next ray skips */
} stop;

/* Direct light at a point, by one random point of the light. */
static double direct(const struct light_scene *s, const accel *a, const stop *p,
                     struct random *random)
{
    double normal[3], to[3], ray_to[3];
    const double u = random_unit(random), v = random_unit(random);
    for (int k = 0; k < 3; k++) {
        ray_to[k] = s->light.corner[k] + u * s->light.edge[0][k] + v * s->light.edge[1][k];
    }
    vector_cross(normal, s->light.edge[0], s->light.edge[1]);
    vector_normalize(normal);
    vector_subtract(to, ray_to, p->at);
    const double square = vector_dot(to, to);
    const double here = vector_dot(to, p->normal), there = -vector_dot(to, normal);
    if (here <= 0.0 || there <= 0.0) {
        return 0.0;
    }
    accel_ray ray = accel_ray_from(p->at, to);
    ray.tmax = 1.0;
    ray.skip = p->on;
    return accel_any(a, &ray, NULL) ? 0.0 : s->light.power / PI * here * there / (square * square);
}

static double follow(const struct light_scene *s, const accel *a, size_t receiver, uint64_t number)
{
    struct random random = random_start(SEED, 2 + (uint32_t)receiver, number);
    stop p = {.on = s->on[receiver]};
    memcpy(p.at, s->receivers[receiver].at, sizeof p.at);
    memcpy(p.normal, s->receivers[receiver].normal, sizeof p.normal);
    double sum = direct(s, a, &p, &random);
    while (random_unit(&random) < s->run.reflectance) {
        double dir[3];
        scatter(p.normal, &random, dir);
        accel_ray ray = accel_ray_from(p.at, dir);
        ray.skip = p.on;
        accel_hit hit;
        if (!accel_closest(a, &ray, &hit, NULL)) {
            break;
        }
        const struct surface surface = surface_at(&s->loaded.scene, &ray, &hit);
        memcpy(p.at, surface.at, sizeof p.at);
        memcpy(p.normal, surface.normal, sizeof p.normal);
        p.on = (accel_id){hit.geom, hit.prim};
        sum += direct(s, a, &p, &random);
    }
    return sum;
}

/* Shared by the threads: each takes receivers. */
typedef struct gathering {
    struct light_scene *s;
    const accel *a;
    double seconds;     /* for each receiver */
    atomic_size_t next; /* receiver that nobody has taken */
} gathering;

static void gather_one(const gathering *g, size_t receiver)
{
    double sum = 0.0, square = 0.0, n = 0.0;
    const double start = seconds_now();
    do {
        for (int i = 0; i < ROUND; i++) {
            const double e = follow(g->s, g->a, receiver, (uint64_t)n);
            sum += e;
            square += e * e;
            n += 1.0;
        }
    } while (n < 4 * ROUND || seconds_now() - start < g->seconds);
    const double mean = sum / n;
    g->s->right[receiver] = mean;
    g->s->error[receiver] = sqrt(fmax(0.0, square / n - mean * mean) / (n - 1.0));
}

static void gather_some(void *user, unsigned thread)
{
    (void)thread;
    gathering *g = user;
    for (size_t i = atomic_fetch_add(&g->next, 1); i < g->s->count;
         i = atomic_fetch_add(&g->next, 1)) {
        gather_one(g, i);
    }
}

void light_reference(struct light_scene *s, const accel *a, double seconds)
{
    const unsigned threads = threads_available();
    gathering g = {
        .s = s, .a = a, .seconds = seconds * threads / (double)(s->count > 0 ? s->count : 1)};
    threads_run(threads, gather_some, &g);
}
