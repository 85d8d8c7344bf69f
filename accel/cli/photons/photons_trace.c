/* SPDX-License-Identifier: Apache-2.0
 *
 * Shooting photons. Threads take blocks of consecutive photons; the blocks' hits are joined in the
 * order of the photons, whoever traced them.
 */
#include "photons.h"

#include "tool/threads.h"
#include "photons_surface.h"
#include "photons_vector.h"
#include "tool/progress.h"
#include "random.h"

#include <assert.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* Photons of one block: enough that taking one costs nothing, few enough to share evenly. */
enum { BLOCK = 1024 };

static_assert(sizeof(struct photon) == 72, "hashed as bytes: no padding");

/* The hits of one block, in the worker's array. */
typedef struct block {
    const struct worker *worker;
    size_t first, count;
} block;

/* One thread's part. */
typedef struct worker {
    struct photon *hits; /* of all its blocks */
    size_t count, capacity;
    uint64_t absorbed, escaped, rays;
    accel_query query;
    bool failed; /* no memory */
} worker;

/* One run. */
typedef struct shoot {
    const accel *a;
    const accel_scene *scene;
    const struct photon_run *run;
    worker *workers; /* run->threads of them */
    block *blocks;   /* block_count of them, in the order of the photons */
    size_t block_count;
    atomic_size_t next; /* block that nobody has taken yet */
} shoot;

/* A photon on its way. */
typedef struct flight {
    accel_ray ray;
    uint32_t light, number;
} flight;

/* A direction by the cosine around the unit vector n. The basis is the one of Duff et al.,
 * "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017. */
static void scatter(double dir[3], const double n[3], struct random *random)
{
    const double square = random_unit(random);
    const double angle = 2.0 * acos(-1.0) * random_unit(random);
    const double x = sqrt(square) * cos(angle), y = sqrt(square) * sin(angle);
    const double z = sqrt(1.0 - square);
    const double sign = copysign(1.0, n[2]);
    const double a = -1.0 / (sign + n[2]), b = n[0] * n[1] * a;
    const double s[3] = {1.0 + sign * n[0] * n[0] * a, sign * b, -sign * n[0]};
    const double t[3] = {b, sign + n[1] * n[1] * a, -n[1]};
    for (int k = 0; k < 3; k++) {
        dir[k] = x * s[k] + y * t[k] + z * n[k];
    }
}

static struct random draw(const shoot *s, const flight *f, uint32_t bounce)
{
    return random_start(s->run->seed, f->light, (uint64_t)bounce << 32 | f->number);
}

static void emit(const shoot *s, flight *f)
{
    const struct light *light = &s->run->lights.at[f->light];
    struct random random = draw(s, f, 0);
    double normal[3], org[3], dir[3];
    vector_cross(normal, light->edge[0], light->edge[1]);
    vector_normalize(normal);
    vector_add_scaled(org, light->corner, random_unit(&random), light->edge[0]);
    vector_add_scaled(org, org, random_unit(&random), light->edge[1]);
    scatter(dir, normal, &random);
    f->ray = accel_ray_from(org, dir);
}

static bool store(worker *w, const struct photon *photon)
{
    if (w->count == w->capacity) {
        const size_t capacity = w->capacity == 0 ? 4 * BLOCK : 2 * w->capacity;
        struct photon *hits = realloc(w->hits, capacity * sizeof *hits);
        if (hits == NULL) {
            w->failed = true;
            return false;
        }
        w->hits = hits;
        w->capacity = capacity;
    }
    w->hits[w->count++] = *photon;
    return true;
}

static struct photon photon_of(const flight *f, const struct surface *surface, const accel_hit *hit,
                               uint32_t bounce)
{
    struct photon out = {.length = hit->t,
                         .geom = hit->geom,
                         .prim = hit->prim,
                         .number = f->number,
                         .light = (uint16_t)f->light,
                         .bounce = (uint16_t)bounce};
    memcpy(out.at, surface->at, sizeof out.at);
    memcpy(out.dir, f->ray.dir, sizeof out.dir);
    return out;
}

/* The whole way of one photon. */
static void shoot_one(const shoot *s, worker *w, flight *f)
{
    emit(s, f);
    for (uint32_t bounce = 0;; bounce++) {
        accel_hit hit;
        w->rays++;
        if (!accel_closest(s->a, &f->ray, &hit, &w->query)) {
            w->escaped++;
            return;
        }
        const struct surface surface = surface_at(s->scene, &f->ray, &hit);
        const struct photon photon = photon_of(f, &surface, &hit, bounce);
        if (!store(w, &photon)) {
            return;
        }
        struct random random = draw(s, f, bounce + 1);
        if (random_unit(&random) >= s->run->reflectance) {
            w->absorbed++;
            return;
        }
        double dir[3];
        scatter(dir, surface.normal, &random);
        f->ray = accel_ray_from(surface.at, dir);
        f->ray.skip = (accel_id){hit.geom, hit.prim};
    }
}

static block shoot_block(const shoot *s, worker *w, size_t index)
{
    const uint64_t photons = s->run->photons;
    const uint64_t total = photons * s->run->lights.count;
    const uint64_t first = (uint64_t)index * BLOCK;
    const uint64_t end = first + BLOCK < total ? first + BLOCK : total;
    const size_t before = w->count;
    for (uint64_t i = first; i < end && !w->failed; i++) {
        flight f = {.light = (uint32_t)(i / photons), .number = (uint32_t)(i % photons)};
        shoot_one(s, w, &f);
    }
    return (block){NULL, before, w->count - before};
}

/* Counts in a worker of its own: threads that count in one cache line wait for each other. */
static void work(void *user, unsigned thread)
{
    shoot *s = user;
    worker w = {.hits = NULL};
    size_t index;
    while (!w.failed && (index = atomic_fetch_add(&s->next, 1)) < s->block_count) {
        s->blocks[index] = shoot_block(s, &w, index);
        s->blocks[index].worker = &s->workers[thread];
        if (thread == 0 && s->run->progress != NULL) {
            s->run->progress(s->run->user, (double)index / (double)s->block_count);
        }
    }
    s->workers[thread] = w;
}

static bool join(const shoot *s, struct photons *out)
{
    for (unsigned i = 0; i < s->run->threads; i++) {
        const worker *w = &s->workers[i];
        if (w->failed) {
            return false;
        }
        out->count += w->count;
        out->absorbed += w->absorbed;
        out->escaped += w->escaped;
        out->rays += w->rays;
        out->query.nodes += w->query.nodes;
        out->query.tests += w->query.tests;
        out->query.refused += w->query.refused;
    }
    out->at = malloc((out->count + 1) * sizeof *out->at);
    size_t at = 0;
    for (size_t i = 0; i < s->block_count && out->at != NULL; i++) {
        const block *b = &s->blocks[i];
        if (b->count > 0) {
            memcpy(out->at + at, b->worker->hits + b->first, b->count * sizeof *out->at);
        }
        at += b->count;
    }
    return out->at != NULL;
}

/* Seconds of processor time of this process. */
static double processor_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

bool trace_photons(struct photons *out, const accel *a, const accel_scene *scene,
                   const struct photon_run *run)
{
    const double start = seconds_now(), processor = processor_seconds();
    *out = (struct photons){.emitted = (uint64_t)run->photons * run->lights.count};
    const size_t block_count = (size_t)((out->emitted + BLOCK - 1) / BLOCK);
    shoot s = {.a = a,
               .scene = scene,
               .run = run,
               .workers = calloc(run->threads, sizeof(worker)),
               .blocks = calloc(block_count + 1, sizeof(block)),
               .block_count = block_count};
    bool fine = s.workers != NULL && s.blocks != NULL;
    if (fine) {
        threads_run(run->threads, work, &s);
        fine = join(&s, out);
        out->seconds = seconds_now() - start;
        out->processor = processor_seconds() - processor;
    }
    for (unsigned i = 0; s.workers != NULL && i < run->threads; i++) {
        free(s.workers[i].hits);
    }
    free(s.workers);
    free(s.blocks);
    if (!fine) {
        photons_free(out);
    }
    return fine;
}

void photons_free(struct photons *photons)
{
    free(photons->at);
    *photons = (struct photons){.at = NULL};
}

uint64_t photons_hash(const struct photons *photons)
{
    uint64_t hash = 0xcbf29ce484222325u;
    const unsigned char *bytes = (const unsigned char *)photons->at;
    for (size_t i = 0; i < photons->count * sizeof *photons->at; i++) {
        hash = (hash ^ bytes[i]) * 0x100000001b3u;
    }
    return hash;
}

double photon_power(const struct photon_run *run, uint32_t light)
{
    return run->lights.at[light].power / run->photons;
}
