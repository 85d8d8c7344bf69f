/* SPDX-License-Identifier: Apache-2.0
 *
 * The rays of accel bench: primary rays of a camera that frames the scene; from what those hit,
 * diffuse bounces and shadow rays towards a point above the scene; and photons that leave a square
 * above the scene and are reflected once. Made once and kept in memory, so that making them is not
 * timed; a ray that leaves a surface skips its primitive.
 */
#include "bench.h"

#include "camera.h"
#include "photons/photons_surface.h"
#include "photons/photons_vector.h"
#include "random.h"

#include <stdlib.h>

const char *const set_names[SETS] = {"primary", "bounce", "shadow", "photon"};

/* What the makers of rays share. */
typedef struct maker {
    const accel *a;
    const accel_scene *scene;
    accel_box box;
    double diagonal;
    struct camera camera;
} maker;

/* A cosine-weighted direction around a unit normal: a point of the unit sphere around its tip
 * (Lambert's law; see Shirley, Wang and Zimmerman, ACM TOG 15(1), 1996). */
static void diffuse(struct random *random, const double normal[3], double out[3])
{
    const double z = random_in(random, -1.0, 1.0);
    const double angle = random_in(random, 0.0, 6.283185307179586);
    const double r = sqrt(fmax(0.0, 1.0 - z * z));
    out[0] = normal[0] + r * cos(angle);
    out[1] = normal[1] + r * sin(angle);
    out[2] = normal[2] + z;
    if (vector_dot(out, out) == 0.0) {
        vector_add_scaled(out, normal, 0.0, normal);
    }
}

static accel_ray primary(const maker *m, struct random *random)
{
    const double i = random_in(random, -0.5, m->camera.width - 0.5);
    const double j = random_in(random, -0.5, m->camera.height - 0.5);
    return camera_ray(&m->camera, i, j);
}

/* From anywhere above the box, downwards. */
static accel_ray emitted(const maker *m, struct random *random)
{
    static const double down[3] = {0.0, -1.0, 0.0};
    double from[3], towards[3];
    for (int k = 0; k < 3; k++) {
        from[k] = random_in(random, m->box.lo[k], m->box.hi[k]);
    }
    from[1] = m->box.hi[1] + 0.25 * m->diagonal;
    diffuse(random, down, towards);
    return accel_ray_from(from, towards);
}

/* Goes on from where a ray hit. */
static accel_ray leave(const struct surface *s, const accel_hit *hit, const double dir[3])
{
    accel_ray ray = accel_ray_from(s->at, dir);
    ray.skip = (accel_id){hit->geom, hit->prim};
    return ray;
}

static accel_ray shadow(const maker *m, const struct surface *s, const accel_hit *hit)
{
    double light[3], towards[3];
    for (int k = 0; k < 3; k++) {
        light[k] = 0.5 * m->box.lo[k] + 0.5 * m->box.hi[k];
    }
    light[1] = m->box.hi[1] + m->diagonal;
    vector_subtract(towards, light, s->at);
    accel_ray ray = leave(s, hit, towards);
    ray.tmax = 1.0;
    return ray;
}

/* Ray `i` of a set. False where its number stands for none: the ray that it should leave from
 * misses. */
static bool make(const maker *m, int which, uint64_t i, accel_ray *out)
{
    struct random random = random_start(1, 77, i);
    const bool photon = which == SET_PHOTON;
    const accel_ray first = photon ? emitted(m, &random) : primary(m, &random);
    *out = first;
    if (which == SET_PRIMARY || (photon && i % 2 == 0)) {
        return true;
    }
    accel_hit hit;
    if (!accel_closest(m->a, &first, &hit, NULL)) {
        return false;
    }
    const struct surface s = surface_at(m->scene, &first, &hit);
    double towards[3];
    diffuse(&random, s.normal, towards);
    *out = which == SET_SHADOW ? shadow(m, &s, &hit) : leave(&s, &hit, towards);
    return true;
}

static maker make_maker(const accel *a, const accel_scene *scene)
{
    maker m = {.a = a, .scene = scene};
    double size[3], eye[3], at[3];
    scene_box(scene, &m.box);
    vector_subtract(size, m.box.hi, m.box.lo);
    m.diagonal = sqrt(vector_dot(size, size));
    camera_frame(&m.box, eye, at);
    camera_make(&m.camera, eye, at, 40.0, 512, 512);
    return m;
}

bool make_set(struct ray_set *set, int which, size_t count, const accel *a,
              const accel_scene *scene)
{
    const maker m = make_maker(a, scene);
    *set = (struct ray_set){.name = set_names[which],
                            .any = which == SET_SHADOW,
                            .rays = malloc(count * sizeof *set->rays),
                            .hits = malloc(count * sizeof *set->hits)};
    if (set->rays == NULL || set->hits == NULL) {
        return false;
    }
    /* of a scene that is hardly hit, tries end after as many misses again */
    for (uint64_t i = 0; set->count < count && i < 64 * (uint64_t)count; i++) {
        if (!make(&m, which, i, &set->rays[set->count])) {
            continue;
        }
        accel_hit *hit = &set->hits[set->count];
        hit->geom = ACCEL_NONE;
        set->found += accel_closest(a, &set->rays[set->count], hit, NULL);
        set->count++;
    }
    return true;
}

void free_set(struct ray_set *set)
{
    free(set->rays);
    free(set->hits);
    *set = (struct ray_set){0};
}
