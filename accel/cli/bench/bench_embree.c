/* SPDX-License-Identifier: Apache-2.0
 *
 * Embree 3 as the outside judge of speed: medium and high build quality, fast and robust. It works
 * in single precision and does not skip a primitive: rays that leave a surface start a hundred
 * thousandth of the scene's diagonal further on. Its answers are compared with ours by primitive.
 */
#include "bench.h"
#include "tool/machine.h"

#include <embree3/rtcore.h>

#include <stdio.h>
#include <stdlib.h>

/* Where rays that leave a surface start, in diagonals of the scene. */
#define START 1e-5

/* A scene of Embree. */
typedef struct peer {
    RTCDevice device;
    RTCScene scene;
    double start; /* distance that rays from a surface keep from it */
} peer;

/* Copies in single precision: Embree's own buffers, which it pads as it needs. */
static void add_triangles(peer *p, const accel_triangles *t, enum RTCBuildQuality quality)
{
    RTCGeometry g = rtcNewGeometry(p->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    float *xyz = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                         3 * sizeof(float), 3 * (size_t)t->count);
    uint32_t *abc = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            3 * sizeof(uint32_t), t->count);
    for (uint32_t i = 0; i < t->count; i++) {
        for (uint32_t corner = 0; corner < 3; corner++) {
            double vertex[3];
            scene_vertex(t, i, (int)corner, vertex);
            abc[3 * (size_t)i + corner] = 3 * i + corner;
            for (size_t k = 0; k < 3; k++) {
                xyz[9 * (size_t)i + 3 * corner + k] = (float)vertex[k];
            }
        }
    }
    rtcSetGeometryBuildQuality(g, quality);
    rtcCommitGeometry(g);
    rtcAttachGeometry(p->scene, g);
    rtcReleaseGeometry(g);
}

static void add_spheres(peer *p, const accel_spheres *s, enum RTCBuildQuality quality)
{
    RTCGeometry g = rtcNewGeometry(p->device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    float *xyzr = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                                          4 * sizeof(float), s->count);
    for (uint32_t i = 0; i < s->count; i++) {
        for (size_t k = 0; k < 4; k++) {
            xyzr[4 * (size_t)i + k] = (float)scene_sphere(s, i)[k];
        }
    }
    rtcSetGeometryBuildQuality(g, quality);
    rtcCommitGeometry(g);
    rtcAttachGeometry(p->scene, g);
    rtcReleaseGeometry(g);
}

static bool leaves_surface(const accel_ray *ray)
{
    return ray->skip.geom != ACCEL_NONE;
}

static struct RTCRay convert(const peer *p, const accel_ray *ray)
{
    const double *d = ray->dir;
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    return (struct RTCRay){.org_x = (float)ray->org[0],
                           .org_y = (float)ray->org[1],
                           .org_z = (float)ray->org[2],
                           .dir_x = (float)d[0],
                           .dir_y = (float)d[1],
                           .dir_z = (float)d[2],
                           .tnear =
                               leaves_surface(ray) ? (float)(p->start / length) : (float)ray->tmin,
                           .tfar = (float)ray->tmax,
                           .mask = UINT32_MAX};
}

static bool occluded(const peer *p, const accel_ray *ray)
{
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    struct RTCRay r = convert(p, ray);
    rtcOccluded1(p->scene, &context, &r);
    return r.tfar < 0.0f;
}

static accel_id intersect(const peer *p, const accel_ray *ray)
{
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    struct RTCRayHit r = {
        .ray = convert(p, ray),
        .hit = {.geomID = RTC_INVALID_GEOMETRY_ID, .instID = {RTC_INVALID_GEOMETRY_ID}}};
    rtcIntersect1(p->scene, &context, &r);
    return (accel_id){r.hit.geomID, r.hit.primID};
}

static size_t trace(const struct bench_contender *c, const struct ray_set *set)
{
    size_t found = 0;
    for (size_t i = 0; i < set->count; i++) {
        found += set->any ? occluded(c->state, &set->rays[i])
                          : intersect(c->state, &set->rays[i]).geom != ACCEL_NONE;
    }
    return found;
}

static accel_id ask(const struct bench_contender *c, const struct ray_set *set, size_t i)
{
    if (!set->any) {
        return intersect(c->state, &set->rays[i]);
    }
    const uint32_t geom = occluded(c->state, &set->rays[i]) ? 0 : ACCEL_NONE;
    return (accel_id){geom, 0};
}

static void end(struct bench_contender *c)
{
    peer *p = c->state;
    rtcReleaseScene(p->scene);
    rtcReleaseDevice(p->device);
    free(p);
}

/* Adds up what Embree allocates. */
static bool count_bytes(void *user, ssize_t bytes, bool post)
{
    (void)post;
    *(double *)user += (double)bytes;
    return true;
}

static bool make_peer(struct bench_contender *c, const accel_scene *scene, double length, bool high,
                      bool robust)
{
    peer *p = malloc(sizeof *p);
    if (p == NULL || (p->device = rtcNewDevice("threads=1")) == NULL) {
        free(p);
        return false;
    }
    const enum RTCBuildQuality quality = high ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM;
    *c = (struct bench_contender){.peer = true, .state = p, .trace = trace, .ask = ask, .end = end};
    snprintf(c->name, sizeof c->name, "Embree %d.%d %s%s", RTC_VERSION_MAJOR, RTC_VERSION_MINOR,
             high ? "high" : "medium", robust ? " robust" : "");
    rtcSetDeviceMemoryMonitorFunction(p->device, count_bytes, &c->bytes);
    p->start = START * length;
    p->scene = rtcNewScene(p->device);
    rtcSetSceneBuildQuality(p->scene, quality);
    rtcSetSceneFlags(p->scene, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    const double start = machine_seconds_of_all();
    for (uint32_t g = 0; g < scene->count; g++) {
        const accel_geometry *from = &scene->geometries[g];
        if (from->type == ACCEL_TRIANGLES) {
            add_triangles(p, &from->triangles, quality);
        } else {
            add_spheres(p, &from->spheres, quality);
        }
    }
    rtcCommitScene(p->scene);
    c->build_seconds = machine_seconds_of_all() - start;
    return true;
}

size_t bench_peers(struct bench_contender *peers, const accel_scene *scene, double length)
{
    size_t made = 0;
    for (unsigned i = 0; i < MOST_PEERS; i++) {
        made += make_peer(&peers[made], scene, length, i & 1, i >> 1);
    }
    return made;
}

const char *bench_no_peers(void)
{
    return NULL;
}
