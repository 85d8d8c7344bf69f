/* SPDX-License-Identifier: Apache-2.0
 *
 * Hits of a camera's rays as channels of an image, and as a picture.
 */
#include "trace.h"

#include "tool/threads.h"
#include "scenes/scene.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* In the order of their bytes, as OpenEXR sorts them. */
enum channel { NX, NY, NZ, PX, PY, PZ, DEPTH, GEOM, PRIM, T_HI, T_LO, U_HI, U_LO, V_HI, V_LO };

static const char *const channel_names[] = {"N.X",  "N.Y",  "N.Z",  "P.X",  "P.Y",  "P.Z",
                                            "Z",    "geom", "prim", "t.hi", "t.lo", "u.hi",
                                            "u.lo", "v.hi", "v.lo", NULL};

/* What is done with a pixel's hit; hit is NULL for a miss. */
typedef void use_hit(void *target, const accel_scene *scene, size_t pixel, const accel_ray *ray,
                     const accel_hit *hit);

/* What the threads share. */
typedef struct run {
    struct tracing *tracing;
    const struct camera *camera;
    use_hit *use;
    void *target;
    atomic_uint_fast32_t next; /* row to take */
} run;

static void cross(double to[3], const double a[3], const double b[3])
{
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        to[k] = a[i] * b[j] - a[j] * b[i];
    }
}

static double length_of(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

void hit_normal(const accel_scene *scene, const accel_ray *ray, const accel_hit *hit,
                double normal[3])
{
    const accel_geometry *geometry = &scene->geometries[hit->geom];
    double corners[3][3];
    if (geometry->type == ACCEL_SPHERES) {
        const double *sphere = scene_sphere(&geometry->spheres, hit->prim);
        for (int k = 0; k < 3; k++) {
            normal[k] = ray->org[k] + hit->t * ray->dir[k] - sphere[k];
        }
    } else {
        for (int i = 0; i < 3; i++) {
            scene_vertex(&geometry->triangles, hit->prim, i, corners[i]);
        }
        for (int k = 0; k < 3; k++) {
            corners[1][k] -= corners[0][k];
            corners[2][k] -= corners[0][k];
        }
        cross(normal, corners[1], corners[2]);
    }
    const double length = length_of(normal);
    for (int k = 0; k < 3; k++) {
        normal[k] = length > 0.0 ? normal[k] / length : 0.0;
    }
}

static uint32_t float_bits(double x)
{
    const float narrow = (float)x;
    uint32_t bits;
    memcpy(&bits, &narrow, sizeof bits);
    return bits;
}

/* The upper and the lower half of a double: nothing is lost. */
static void store_double(struct image *image, int hi, size_t pixel, double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    image->channels[hi].bits[pixel] = (uint32_t)(bits >> 32);
    image->channels[hi + 1].bits[pixel] = (uint32_t)bits;
}

static void store_hit(void *target, const accel_scene *scene, size_t pixel, const accel_ray *ray,
                      const accel_hit *hit)
{
    struct image *image = target;
    static const accel_hit miss = {(double)INFINITY, 0.0, 0.0, ACCEL_NONE, ACCEL_NONE};
    double normal[3] = {0.0, 0.0, 0.0};
    const accel_hit *shown = hit == NULL ? &miss : hit;
    if (hit != NULL) {
        hit_normal(scene, ray, hit, normal);
    }
    for (int k = 0; k < 3; k++) {
        const double at = hit == NULL ? 0.0 : ray->org[k] + hit->t * ray->dir[k];
        image->channels[NX + k].bits[pixel] = float_bits(normal[k]);
        image->channels[PX + k].bits[pixel] = float_bits(at);
    }
    image->channels[DEPTH].bits[pixel] = float_bits(shown->t * length_of(ray->dir));
    image->channels[GEOM].bits[pixel] = shown->geom;
    image->channels[PRIM].bits[pixel] = shown->prim;
    store_double(image, T_HI, pixel, shown->t);
    store_double(image, U_HI, pixel, shown->u);
    store_double(image, V_HI, pixel, shown->v);
}

/* Coloured by the normal, darker where the surface is seen at a flat angle; misses are dark. */
static void paint_hit(void *target, const accel_scene *scene, size_t pixel, const accel_ray *ray,
                      const accel_hit *hit)
{
    unsigned char *colour = (unsigned char *)target + 3 * pixel;
    if (hit == NULL) {
        memset(colour, 24, 3);
        return;
    }
    double normal[3];
    hit_normal(scene, ray, hit, normal);
    double facing = 0.0;
    for (int k = 0; k < 3; k++) {
        facing -= normal[k] * ray->dir[k] / length_of(ray->dir);
    }
    const double light = 0.25 + 0.75 * fabs(facing);
    for (int k = 0; k < 3; k++) {
        const double side = facing < 0.0 ? -normal[k] : normal[k];
        colour[k] = (unsigned char)(255.0 * light * (0.6 + 0.4 * side));
    }
}

/* Pixels that are asked together. */
enum { BATCH = 256 };

/* Some pixels of a row, one at least. Returns how many. */
static uint32_t trace_pixels(const run *r, uint32_t row, uint32_t from)
{
    accel_ray rays[BATCH];
    accel_hit hits[BATCH];
    uint32_t count = 0;
    do {
        rays[count] = camera_ray(r->camera, from + count, row);
    } while (++count < BATCH && from + count < r->camera->width);
    accel_closest_n(r->tracing->structure, rays, hits, count, NULL);
    for (uint32_t i = 0; i < count; i++) {
        r->use(r->target, r->tracing->scene, (size_t)row * r->camera->width + from + i, &rays[i],
               hits[i].geom != ACCEL_NONE ? &hits[i] : NULL);
    }
    return count;
}

static void work(void *user, unsigned thread)
{
    run *r = user;
    struct tracing *tracing = r->tracing;
    for (;;) {
        const uint32_t row = (uint32_t)atomic_fetch_add(&r->next, 1);
        if (row >= r->camera->height) {
            return;
        }
        for (uint32_t from = 0; from < r->camera->width;) {
            from += trace_pixels(r, row, from);
        }
        if (thread == 0) {
            progress_show(&tracing->progress, "tracing", (double)row / (double)r->camera->height);
        }
    }
}

static void trace_all(struct tracing *tracing, const struct camera *camera, use_hit *use,
                      void *target)
{
    run r = {.tracing = tracing, .camera = camera, .use = use, .target = target};
    threads_run(tracing->threads, work, &r);
    progress_clear(&tracing->progress);
}

bool trace_image(struct tracing *tracing, const struct camera *camera, struct image *image)
{
    if (!image_make(image, camera->width, camera->height, channel_names)) {
        return false;
    }
    trace_all(tracing, camera, store_hit, image);
    return true;
}

unsigned char *trace_picture(struct tracing *tracing, const struct camera *camera)
{
    unsigned char *pixels = calloc((size_t)camera->width * camera->height, 3);
    if (pixels != NULL) {
        trace_all(tracing, camera, paint_hit, pixels);
    }
    return pixels;
}
