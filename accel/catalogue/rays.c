/* SPDX-License-Identifier: Apache-2.0
 *
 * A sphere lends six vertices, the ends of its axes; where an edge of it is asked for it is any
 * point of its surface. A box lends its corners and edges.
 */
#include "rays.h"

#include "camera.h"
#include "loaded.h"

#include <float.h>
#include <string.h>

/* Where on a primitive to aim. */
enum spot { VERTEX, EDGE, INSIDE };

static double finite_or(double x, double other)
{
    return isfinite(x) ? x : other;
}

static void on_triangle(const double *t, struct rng *d, enum spot spot, double out[3])
{
    const uint32_t i = rng_below(d, 3), j = (i + 1) % 3, l = (i + 2) % 3;
    const double u = spot == VERTEX       ? 0.0
                     : rng_chance(d, 0.5) ? rng_unit(d)
                                          : rng_below(d, 9) / 8.0;
    const double v = spot == INSIDE ? (1.0 - u) * rng_unit(d) : 0.0;
    for (uint32_t k = 0; k < 3; k++) {
        const double a = t[3 * i + k], b = t[3 * j + k], c = t[3 * l + k];
        out[k] = a + u * (b - a) + v * (c - a);
    }
}

static void on_sphere(const double *sphere, struct rng *d, enum spot spot, double out[3])
{
    double x[3] = {0, 0, 0};
    if (spot == VERTEX)
        x[rng_below(d, 3)] = rng_chance(d, 0.5) ? 1 : -1;
    else
        for (int k = 0; k < 3; k++)
            x[k] = rng_range(d, -1, 1);
    const double length = spot == EDGE ? sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) : 1.0;
    for (int k = 0; k < 3; k++)
        out[k] = sphere[k] + sphere[3] * (x[k] / length);
}

static void on_box(const accel_box *b, struct rng *d, enum spot spot, double out[3])
{
    for (int k = 0; k < 3; k++) {
        const double lo = finite_or(b->lo[k], -1.0), hi = finite_or(b->hi[k], 1.0);
        const bool end = spot == VERTEX || (spot == EDGE && rng_chance(d, 0.6));
        out[k] = end ? (rng_chance(d, 0.5) ? lo : hi) : lo + rng_unit(d) * (hi - lo);
    }
}

/* A random primitive. False if the scene has none. */
static bool pick(const struct ray_target *s, struct rng *d, accel_id *out)
{
    if (s->primitives == 0)
        return false;
    uint32_t at = rng_below(d, (uint32_t)s->primitives), g = 0, count;
    while (at >= (count = geometry_primitives(&s->scene->geometries[g]))) {
        at -= count;
        g++;
    }
    *out = (accel_id){g, at};
    return true;
}

static void corners_of(const struct ray_target *s, accel_id id, double out[9])
{
    for (int corner = 0; corner < 3; corner++)
        scene_vertex(&s->scene->geometries[id.geom].triangles, id.prim, corner, out + 3 * corner);
}

static void on_primitive(const struct ray_target *s, accel_id id, struct rng *d, enum spot spot,
                         double out[3])
{
    const accel_geometry *g = &s->scene->geometries[id.geom];
    double corners[9];
    if (g->type == ACCEL_TRIANGLES) {
        corners_of(s, id, corners);
        on_triangle(corners, d, spot, out);
    } else if (g->type == ACCEL_SPHERES) {
        on_sphere(scene_sphere(&g->spheres, id.prim), d, spot, out);
    } else {
        on_box(&g->objects.boxes[id.prim], d, spot, out);
    }
    for (int k = 0; k < 3; k++)
        out[k] = finite_or(out[k], s->box.lo[k]);
}

static void target(const struct ray_target *s, struct rng *d, enum spot spot, double out[3])
{
    accel_id id;
    if (pick(s, d, &id)) {
        on_primitive(s, id, d, spot, out);
        return;
    }
    on_box(&s->box, d, INSIDE, out);
    for (int k = 0; k < 3; k++)
        out[k] = finite_or(out[k], s->box.lo[k]);
}

/* A point in the scene's box, or up to one and a half extents outside. */
static void anywhere(const struct ray_target *s, struct rng *d, double out[3])
{
    const bool inside = rng_chance(d, 0.3);
    for (int k = 0; k < 3; k++) {
        const double lo = s->box.lo[k], size = s->box.hi[k] - lo;
        out[k] = lo + size * (inside ? rng_unit(d) : rng_range(d, -1.5, 2.5));
    }
}

static accel_ray towards(const double org[3], const double to[3])
{
    double dir[3];
    for (int k = 0; k < 3; k++)
        dir[k] = to[k] - org[k];
    return accel_ray_from(org, dir);
}

static accel_ray aimed(const struct ray_target *s, struct rng *d, enum spot spot)
{
    double org[3], to[3];
    anywhere(s, d, org);
    target(s, d, spot, to);
    accel_ray ray = towards(org, to);
    if (rng_chance(d, 0.5)) {
        const double largest = fmax(fabs(ray.dir[0]), fmax(fabs(ray.dir[1]), fabs(ray.dir[2])));
        for (int k = 0; largest > 0 && k < 3; k++)
            ray.dir[k] /= largest;
    }
    return ray;
}

static accel_ray random_ray(const struct ray_target *s, struct rng *d)
{
    double org[3], to[3];
    anywhere(s, d, org);
    on_box(&s->box, d, INSIDE, to);
    return towards(org, to);
}

static double either_zero(struct rng *d)
{
    return rng_chance(d, 0.5) ? 0.0 : -0.0;
}

static accel_ray parallel_ray(const struct ray_target *s, struct rng *d)
{
    double org[3], dir[3];
    target(s, d, VERTEX, org);
    const uint32_t k = rng_below(d, 3);
    const bool up = rng_chance(d, 0.5);
    for (int i = 0; i < 3; i++)
        dir[i] = either_zero(d);
    dir[k] = up ? 1.0 : -1.0;
    const double size = fmax(s->box.hi[k] - s->box.lo[k], DBL_MIN);
    if (rng_chance(d, 0.8))
        org[k] = up ? s->box.lo[k] - size : s->box.hi[k] + size;
    return accel_ray_from(org, dir);
}

/* From far along a line that leaves a triangle's plane by 1e-2..1e-15. */
static accel_ray grazing_ray(const struct ray_target *s, struct rng *d)
{
    double a[3], b[3], org[3], corners[9];
    accel_id id;
    if (!pick(s, d, &id) || s->scene->geometries[id.geom].type != ACCEL_TRIANGLES)
        return aimed(s, d, EDGE);
    corners_of(s, id, corners);
    on_triangle(corners, d, INSIDE, a);
    on_triangle(corners, d, EDGE, b);
    const double off = rng_power(d, -50, -6), back = rng_range(d, 0.1, 20);
    double size = 0.0;
    for (int k = 0; k < 3; k++)
        size = fmax(size, fabs(b[k] - a[k]));
    for (int k = 0; k < 3; k++)
        org[k] = finite_or(a[k] - back * (b[k] - a[k]) + size * off * rng_range(d, -1, 1), 0.0);
    return towards(org, a);
}

static accel_ray mix_ray(const struct ray_target *s, const accel *judge, struct rng *d, uint64_t i)
{
    (void)judge;
    switch (i % 6) {
    case 0:
        return random_ray(s, d);
    case 1:
        return aimed(s, d, VERTEX);
    case 2:
        return aimed(s, d, EDGE);
    case 3:
        return aimed(s, d, INSIDE);
    case 4:
        return parallel_ray(s, d);
    default:
        return grazing_ray(s, d);
    }
}

/* ------------------------------------------------------------------ R1 .. R6 ---- */

enum { SPECIALS = 17 };

static double special(uint32_t i)
{
    static const double value[SPECIALS / 2] = {0.0, 0x1p-1074, DBL_MIN, 1e-300,
                                               1.0, 1e300,     DBL_MAX, INFINITY};
    return i == SPECIALS - 1 ? (double)NAN : i % 2 ? -value[i / 2] : value[i / 2];
}

/* Every direction of special components, one after the other; the rest is sampled. */
static accel_ray special_ray(const struct ray_target *s, const accel *judge, struct rng *d,
                             uint64_t i)
{
    (void)judge;
    double org[3], dir[3];
    uint64_t left = i;
    target(s, d, (enum spot)rng_below(d, 3), org);
    if (rng_chance(d, 0.5))
        anywhere(s, d, org);
    for (int k = 0; k < 3; k++) {
        dir[k] = special((uint32_t)(left % SPECIALS));
        left /= SPECIALS;
        if (rng_chance(d, 0.1))
            org[k] = special(rng_below(d, SPECIALS));
    }
    accel_ray ray = accel_ray_from(org, dir);
    if (rng_chance(d, 0.2))
        ray.tmin = special(rng_below(d, SPECIALS));
    if (rng_chance(d, 0.2))
        ray.tmax = special(rng_below(d, SPECIALS));
    return ray;
}

/* From a vertex, an edge, a face or a box's corner, along an axis, an edge or anywhere. */
static accel_ray origin_on(const struct ray_target *s, const accel *judge, struct rng *d,
                           uint64_t i)
{
    (void)judge;
    double org[3], to[3];
    target(s, d, (enum spot)(i % 3), org);
    target(s, d, (enum spot)rng_below(d, 3), to);
    accel_ray ray = towards(org, to);
    const uint32_t keep = rng_below(d, 6);
    for (uint32_t k = 0; keep < 3 && k < 3; k++)
        ray.dir[k] = k == keep ? (rng_chance(d, 0.5) ? 1.0 : -1.0) : either_zero(d);
    if (rng_chance(d, 0.3))
        ray.tmin = -(double)INFINITY;
    return ray;
}

/* Through points and half points of the integer lattice, in the 26 directions, both zeros. */
static accel_ray lattice_ray(const struct ray_target *s, const accel *judge, struct rng *d,
                             uint64_t i)
{
    (void)judge;
    double org[3], dir[3];
    const uint64_t code = i % 27 == 13 ? 0 : i % 27;
    const uint32_t digit[3] = {(uint32_t)code % 3, (uint32_t)code / 3 % 3, (uint32_t)code / 9};
    for (int k = 0; k < 3; k++) {
        const uint32_t cells = (uint32_t)(s->box.hi[k] - s->box.lo[k]) + 5;
        org[k] = s->box.lo[k] - 2 + rng_below(d, 2 * cells) / 2.0;
        dir[k] = digit[k] == 1 ? either_zero(d) : (double)digit[k] - 1.0;
    }
    for (int k = 0; rng_chance(d, 0.3) && k < 3; k++)
        dir[k] *= 1 + rng_below(d, 7);
    return accel_ray_from(org, dir);
}

/* Ends its interval at the first hit's t, or one step before or behind. */
static accel_ray ending_ray(const struct ray_target *s, const accel *judge, struct rng *d,
                            uint64_t i)
{
    const double inf = (double)INFINITY;
    accel_ray ray = mix_ray(s, judge, d, i);
    accel_hit hit;
    if (!accel_closest(judge, &ray, &hit, NULL))
        return ray;
    const double end[3] = {hit.t, nextafter(hit.t, -inf), nextafter(hit.t, inf)};
    const uint32_t which = rng_below(d, 6);
    *(which < 3 ? &ray.tmin : &ray.tmax) = end[which % 3];
    return ray;
}

static accel_ray unnormalised_ray(const struct ray_target *s, const accel *judge, struct rng *d,
                                  uint64_t i)
{
    accel_ray ray = mix_ray(s, judge, d, i);
    const int power = rng_chance(d, 0.5) ? 500 : -500;
    for (int k = 0; k < 3; k++)
        ray.dir[k] = ldexp(ray.dir[k], power);
    return ray;
}

/* Leaves the primitive that it was reflected or refracted at. */
static accel_ray secondary_ray(const struct ray_target *s, const accel *judge, struct rng *d,
                               uint64_t i)
{
    struct rng base = rng_from(d->seed, i / 1000);
    const accel_ray first = mix_ray(s, judge, &base, i / 1000);
    accel_hit hit;
    if (!accel_closest(judge, &first, &hit, NULL))
        return first;
    double org[3], dir[3];
    for (int k = 0; k < 3; k++) {
        org[k] = first.org[k] + hit.t * first.dir[k];
        dir[k] = rng_range(d, -1, 1);
    }
    accel_ray ray = accel_ray_from(org, dir);
    ray.skip = (accel_id){hit.geom, hit.prim};
    return ray;
}

/* From 1e3 to 1e14 extents away. */
static accel_ray far_ray(const struct ray_target *s, const accel *judge, struct rng *d, uint64_t i)
{
    (void)judge;
    double org[3], to[3];
    target(s, d, (enum spot)(i % 3), to);
    const double distance = rng_power(d, 10, 47);
    for (int k = 0; k < 3; k++)
        org[k] = to[k] + distance * (s->box.hi[k] - s->box.lo[k]) * rng_range(d, -1, 1);
    return towards(org, to);
}

/* Those that come with the scene, one after the other. */
static accel_ray given_ray(const struct ray_target *s, const accel *judge, struct rng *d,
                           uint64_t i)
{
    return s->given_count ? s->given[i % s->given_count] : mix_ray(s, judge, d, i);
}

static const char *const for_special[] = {"scale-1", "mixed", "lattice", "huge-and-tiny", NULL};
static const char *const for_origins[] = {"lattice", "ball-mesh", "stack", "mixed", NULL};
static const char *const for_lattice[] = {"lattice", "stack", NULL};
static const char *const for_ends[] = {"shards", "mixed", "twins", "lattice", "exotic", NULL};
static const char *const for_lengths[] = {"shards", "mixed", "sizes", NULL};
static const char *const for_secondary[] = {"ball-mesh", "mixed", "slivers", NULL};
static const char *const for_exotic[] = {"exotic", "mixed", "huge-and-tiny", NULL};
static const char *const for_far[] = {"scale-1", "shift-1e6", "mixed-key", NULL};
static const char *const for_reported[] = {"embree-387",   "embree-416",  "embree-423",
                                           "povray-fs324", "tinybvh-168", NULL};
static const char *const for_all[] = {NULL};

const struct ray_family ray_families[] = {
    {"mix", "mix", "random, at vertices and edges, axis-parallel, grazing", mix_ray, 0, for_all},
    {"special-rays", "special", "zeros, subnormal, huge, infinite and NaN components", special_ray,
     100000, for_special},
    {"surface-origins", "origin-on", "origins on vertices, edges and faces", origin_on, 20000,
     for_origins},
    {"surface-origins", "lattice-lines", "along lattice lines, 26 directions, both zeros",
     lattice_ray, 20000, for_lattice},
    {"interval-ends", "ends", "interval ends at a hit's t and its neighbours", ending_ray, 20000,
     for_ends},
    {"direction-lengths", "lengths", "directions of length 2^-500 and 2^500", unnormalised_ray,
     5000, for_lengths},
    {"secondary-rays", "secondary", "1,000 rays leave each hit, skipping its primitive",
     secondary_ray, 100000, for_secondary},
    {"odd-objects", "exotic-mix", "the mix, at objects that report oddly", mix_ray, 5000,
     for_exotic},
    {"reported", "reported", "the rays of the reports", given_ray, 10000, for_reported},
    {"offsets", "far", "origins 1e3..1e14 extents away", far_ray, 6000, for_far},
    {NULL, NULL, NULL, NULL, 0, NULL},
};

const struct ray_family *ray_family_find(const char *name)
{
    for (const struct ray_family *f = ray_families; f->name; f++)
        if (strcmp(f->name, name) == 0)
            return f;
    return NULL;
}

/* ------------------------------------------------------- the families of check ---- */

/* Uniform on the unit sphere (Marsaglia 1972: the height is uniform). */
static void unit_vector(struct rng *d, double out[3])
{
    const double z = rng_range(d, -1.0, 1.0), ring = sqrt(1.0 - z * z);
    const double angle = rng_range(d, 0.0, 6.283185307179586);
    out[0] = ring * cos(angle);
    out[1] = ring * sin(angle);
    out[2] = z;
}

static accel_ray primary_ray(const struct ray_target *s, const accel *judge, struct rng *d,
                             uint64_t i)
{
    (void)judge, (void)i;
    struct camera camera;
    double eye[3], at[3];
    camera_frame(&s->box, eye, at);
    camera_make(&camera, eye, at, 40.0, 1024, 768);
    const double column = rng_range(d, -0.5, 1023.5);
    return camera_ray(&camera, column, rng_range(d, -0.5, 767.5));
}

static accel_ray line_ray(const struct ray_target *s, const accel *judge, struct rng *d, uint64_t i)
{
    (void)judge, (void)i;
    return random_ray(s, d);
}

static accel_ray inside_ray(const struct ray_target *s, const accel *judge, struct rng *d,
                            uint64_t i)
{
    (void)judge, (void)i;
    double org[3], dir[3];
    on_box(&s->box, d, INSIDE, org);
    unit_vector(d, dir);
    return accel_ray_from(org, dir);
}

static accel_ray bounce_ray(const struct ray_target *s, const accel *judge, struct rng *d,
                            uint64_t i)
{
    accel_id id;
    double org[3], dir[3];
    if (!pick(s, d, &id))
        return inside_ray(s, judge, d, i);
    on_primitive(s, id, d, INSIDE, org);
    unit_vector(d, dir);
    accel_ray ray = accel_ray_from(org, dir);
    ray.skip = id;
    return ray;
}

/* Aimed at such a spot, one in three from a vertex. */
static accel_ray spot_ray(const struct ray_target *s, struct rng *d, enum spot spot)
{
    double org[3], to[3];
    if (!rng_chance(d, 1.0 / 3.0))
        return aimed(s, d, spot);
    target(s, d, VERTEX, org);
    target(s, d, spot, to);
    return towards(org, to);
}

static accel_ray vertex_ray(const struct ray_target *s, const accel *judge, struct rng *d,
                            uint64_t i)
{
    (void)judge, (void)i;
    return spot_ray(s, d, VERTEX);
}

static accel_ray edge_ray(const struct ray_target *s, const accel *judge, struct rng *d, uint64_t i)
{
    (void)judge, (void)i;
    return spot_ray(s, d, EDGE);
}

/* Parallel to an axis, one in four to a diagonal; one origin's coordinate in eight on a plane that
 * halving the box makes. */
static accel_ray axis_ray(const struct ray_target *s, const accel *judge, struct rng *d, uint64_t i)
{
    (void)judge, (void)i;
    accel_ray ray = parallel_ray(s, d);
    const uint32_t other = rng_below(d, 3);
    if (rng_chance(d, 0.25) && ray.dir[other] == 0.0)
        ray.dir[other] = copysign(1.0, ray.dir[other]);
    for (int k = 0; k < 3; k++) {
        const uint32_t parts = 1u << rng_below(d, 8);
        const double part = (double)rng_below(d, parts + 1) / parts;
        if (ray.dir[k] == 0.0 && rng_chance(d, 0.125))
            ray.org[k] = s->box.lo[k] + part * (s->box.hi[k] - s->box.lo[k]);
    }
    return ray;
}

/* Along a tangent of a sphere, nearly. */
static accel_ray tangent_ray(const struct ray_target *s, struct rng *d, const double *sphere)
{
    double normal[3], other[3], along[3], org[3], dir[3], length = 0.0;
    unit_vector(d, normal);
    unit_vector(d, other);
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        along[k] = normal[i] * other[j] - normal[j] * other[i];
        length += along[k] * along[k];
    }
    const double lift = rng_power(d, -50, -6) * (rng_chance(d, 0.5) ? 1.0 : -1.0);
    const double size = rng_chance(d, 0.5) ? sphere[3] : s->box.hi[0] - s->box.lo[0];
    const double back = size * rng_range(d, 0.0, 2.0);
    for (int k = 0; k < 3; k++) {
        dir[k] = along[k] / sqrt(length) + lift * normal[k];
        org[k] = sphere[k] + sphere[3] * normal[k] - back * dir[k];
    }
    return accel_ray_from(org, dir);
}

static accel_ray near_plane_ray(const struct ray_target *s, const accel *judge, struct rng *d,
                                uint64_t i)
{
    (void)judge, (void)i;
    struct rng copy = *d;
    accel_id id;
    if (!pick(s, &copy, &id) || s->scene->geometries[id.geom].type != ACCEL_SPHERES)
        return grazing_ray(s, d);
    *d = copy;
    return tangent_ray(s, d, scene_sphere(&s->scene->geometries[id.geom].spheres, id.prim));
}

static accel_ray scaled_ray(const struct ray_target *s, const accel *judge, struct rng *d,
                            uint64_t i)
{
    (void)judge, (void)i;
    accel_ray ray = rng_chance(d, 0.5) ? random_ray(s, d) : aimed(s, d, EDGE);
    const int power = (int)rng_below(d, 1001) - 500;
    for (int k = 0; k < 3; k++)
        ray.dir[k] = ldexp(ray.dir[k], power);
    return ray;
}

/* The hit is at t = 1, up to rounding. */
static double interval_end(struct rng *d)
{
    static const double ends[] = {0.0, 0.5,  1.0,   1.0 - 0x1p-53, 1.0 + 0x1p-52,
                                  2.0, -1.0, 1e300, -INFINITY,     INFINITY};
    return ends[rng_below(d, sizeof ends / sizeof *ends)];
}

static accel_ray interval_ray(const struct ray_target *s, const accel *judge, struct rng *d,
                              uint64_t i)
{
    (void)judge, (void)i;
    double org[3], to[3];
    if (rng_chance(d, 1.0 / 3.0))
        target(s, d, VERTEX, org);
    else
        anywhere(s, d, org);
    target(s, d, INSIDE, to);
    accel_ray ray = towards(org, to);
    ray.tmin = interval_end(d);
    ray.tmax = interval_end(d);
    return ray;
}

static const struct ray_family check_families[FAMILIES] = {
    [RAYS_PRIMARY] = {.name = "primary", .make = primary_ray},
    [RAYS_LINES] = {.name = "lines", .make = line_ray},
    [RAYS_INSIDE] = {.name = "inside", .make = inside_ray},
    [RAYS_BOUNCE] = {.name = "bounce", .make = bounce_ray},
    [RAYS_VERTEX] = {.name = "vertex", .make = vertex_ray},
    [RAYS_EDGE] = {.name = "edge", .make = edge_ray},
    [RAYS_AXIS] = {.name = "axis", .make = axis_ray},
    [RAYS_GRAZING] = {.name = "grazing", .make = near_plane_ray},
    [RAYS_FAR] = {.name = "far", .make = far_ray},
    [RAYS_SCALED] = {.name = "scaled", .make = scaled_ray},
    [RAYS_INTERVAL] = {.name = "interval", .make = interval_ray},
    [RAYS_ODD] = {.name = "odd", .make = special_ray},
};

const char *family_name(enum family family)
{
    return check_families[family].name;
}

struct rays rays_start(const accel_scene *scene, uint64_t seed)
{
    struct rays rays = {.target = {.scene = scene, .primitives = scene_primitives(scene)},
                        .seed = seed};
    scene_box(scene, &rays.target.box);
    return rays;
}

accel_ray rays_make(const struct rays *rays, uint64_t index)
{
    struct rng d = rng_from(rays->seed, index);
    return check_families[index % FAMILIES].make(&rays->target, NULL, &d, index / FAMILIES);
}
