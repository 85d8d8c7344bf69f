/* SPDX-License-Identifier: Apache-2.0
 *
 * Families of rays. Points on primitives are computed, not traced: what is aimed at does not depend
 * on any structure. A sphere lends six vertices, the ends of its axes, and three great circles as
 * edges, where its box touches it.
 */
#include "rays.h"

#include "tool/random.h"
#include "scene.h"

#include <float.h>

enum { STREAM_RAYS = 2000 };

/* A primitive that rays are aimed at. */
typedef struct target {
    accel_id id;
    double corners[3][3]; /* of a triangle; of a sphere the ends of three half axes */
    double centre[3];     /* of a sphere */
    double radius;        /* of a sphere, 0 for a triangle */
} target;

/* A point of a primitive and two vectors along it there. */
typedef struct place {
    double at[3];
    double along[3]; /* a tangent */
    double away[3];  /* a normal, any length */
} place;

static const char *const names[FAMILIES] = {
    "primary", "lines",   "inside", "bounce", "vertex",   "edge",
    "axis",    "grazing", "far",    "scaled", "interval", "odd",
};

const char *family_name(enum family family)
{
    return names[family];
}

struct rays rays_start(const accel_scene *scene, uint64_t seed)
{
    struct rays rays = {.scene = scene, .primitives = scene_primitives(scene), .seed = seed};
    scene_box(scene, &rays.box);
    double square = 0.0;
    for (int k = 0; k < 3; k++) {
        const double half = 0.5 * rays.box.hi[k] - 0.5 * rays.box.lo[k];
        rays.centre[k] = 0.5 * rays.box.lo[k] + 0.5 * rays.box.hi[k];
        square += half * half;
    }
    rays.radius = square > 0.0 && isfinite(square) ? sqrt(square) : 1.0;
    double eye[3], at[3];
    camera_frame(&rays.box, eye, at);
    camera_make(&rays.camera, eye, at, 40.0, 1024, 768);
    return rays;
}

static void copy(double to[3], const double from[3])
{
    for (int k = 0; k < 3; k++) {
        to[k] = from[k];
    }
}

static void between(double to[3], const double a[3], const double b[3], double s)
{
    for (int k = 0; k < 3; k++) {
        to[k] = a[k] + s * (b[k] - a[k]);
    }
}

static void minus(double to[3], const double a[3], const double b[3])
{
    for (int k = 0; k < 3; k++) {
        to[k] = a[k] - b[k];
    }
}

static void cross(double to[3], const double a[3], const double b[3])
{
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        to[k] = a[i] * b[j] - a[j] * b[i];
    }
}

static double random_sign(struct random *random)
{
    return (random_bits(random) & 1) != 0 ? 1.0 : -1.0;
}

/* Uniform on the unit sphere (Marsaglia 1972: the height is uniform). */
static void unit_vector(struct random *random, double out[3])
{
    const double z = random_in(random, -1.0, 1.0);
    const double angle = random_in(random, 0.0, 6.283185307179586);
    const double ring = sqrt(1.0 - z * z);
    out[0] = ring * cos(angle);
    out[1] = ring * sin(angle);
    out[2] = z;
}

static void point_in_box(const struct rays *rays, struct random *random, double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = random_in(random, rays->box.lo[k], rays->box.hi[k]);
    }
}

static void point_outside(const struct rays *rays, struct random *random, double out[3])
{
    unit_vector(random, out);
    const double distance = rays->radius * random_in(random, 1.0, 3.0);
    for (int k = 0; k < 3; k++) {
        out[k] = rays->centre[k] + distance * out[k];
    }
}

static void read_sphere(const double *sphere, struct random *random, target *out)
{
    copy(out->centre, sphere);
    out->radius = sphere[3];
    for (int k = 0; k < 3; k++) {
        copy(out->corners[k], sphere);
        out->corners[k][k] += random_sign(random) * sphere[3];
    }
}

/* Any primitive, all with the same chance; in an empty scene a triangle of the box. */
static target any_target(const struct rays *rays, struct random *random)
{
    target out = {.id = {ACCEL_NONE, ACCEL_NONE}};
    uint64_t left = rays->primitives == 0 ? 0 : random_below(random, rays->primitives);
    for (uint32_t g = 0; g < rays->scene->count; g++) {
        const accel_geometry *geometry = &rays->scene->geometries[g];
        const uint32_t count = geometry->type == ACCEL_TRIANGLES ? geometry->triangles.count
                               : geometry->type == ACCEL_SPHERES ? geometry->spheres.count
                                                                 : geometry->objects.count;
        if (left >= count) {
            left -= count;
            continue;
        }
        out.id = (accel_id){g, (uint32_t)left};
        if (geometry->type == ACCEL_TRIANGLES) {
            for (int corner = 0; corner < 3; corner++) {
                scene_vertex(&geometry->triangles, out.id.prim, corner, out.corners[corner]);
            }
            return out;
        }
        if (geometry->type == ACCEL_SPHERES) {
            read_sphere(scene_sphere(&geometry->spheres, out.id.prim), random, &out);
            return out;
        }
        break;
    }
    for (int corner = 0; corner < 3; corner++) {
        point_in_box(rays, random, out.corners[corner]);
    }
    return out;
}

static void any_vertex(const struct rays *rays, struct random *random, double out[3])
{
    const target t = any_target(rays, random);
    copy(out, t.corners[random_below(random, 3)]);
}

static void any_edge_point(const struct rays *rays, struct random *random, double out[3])
{
    const target t = any_target(rays, random);
    const size_t from = random_below(random, 3);
    if (t.radius == 0.0) {
        between(out, t.corners[from], t.corners[(from + 1) % 3], random_unit(random));
        return;
    }
    const double angle = random_in(random, 0.0, 6.283185307179586);
    copy(out, t.centre);
    out[from] += t.radius * cos(angle);
    out[(from + 1) % 3] += t.radius * sin(angle);
}

static place place_on_triangle(const target *t, struct random *random)
{
    place out;
    double first[3], second[3], middle[3];
    minus(first, t->corners[1], t->corners[0]);
    minus(second, t->corners[2], t->corners[0]);
    between(middle, t->corners[1], t->corners[2], random_unit(random));
    between(out.at, t->corners[0], middle, sqrt(random_unit(random)));
    between(out.along, first, second, random_unit(random));
    cross(out.away, first, second);
    return out;
}

static place place_on_sphere(const target *t, struct random *random)
{
    place out;
    double other[3];
    unit_vector(random, out.away);
    unit_vector(random, other);
    cross(out.along, out.away, other);
    for (int k = 0; k < 3; k++) {
        out.at[k] = t->centre[k] + t->radius * out.away[k];
    }
    return out;
}

static place any_place(const struct rays *rays, struct random *random, accel_id *id)
{
    const target t = any_target(rays, random);
    *id = t.id;
    return t.radius == 0.0 ? place_on_triangle(&t, random) : place_on_sphere(&t, random);
}

/* Outside, inside, or at a vertex. */
static void any_origin(const struct rays *rays, struct random *random, double out[3])
{
    switch (random_below(random, 3)) {
    case 0:
        point_outside(rays, random, out);
        break;
    case 1:
        point_in_box(rays, random, out);
        break;
    default:
        any_vertex(rays, random, out);
    }
}

static accel_ray aimed(const double from[3], const double at[3])
{
    double direction[3];
    minus(direction, at, from);
    return accel_ray_from(from, direction);
}

static accel_ray make_primary(const struct rays *rays, struct random *random)
{
    const double i = random_in(random, -0.5, 1023.5);
    return camera_ray(&rays->camera, i, random_in(random, -0.5, 767.5));
}

static accel_ray make_line(const struct rays *rays, struct random *random)
{
    double first[3], second[3], from[3];
    point_in_box(rays, random, first);
    point_in_box(rays, random, second);
    between(from, first, second, -random_in(random, 0.0, 4.0));
    return aimed(from, second);
}

static accel_ray make_inside(const struct rays *rays, struct random *random)
{
    double from[3], direction[3];
    point_in_box(rays, random, from);
    unit_vector(random, direction);
    return accel_ray_from(from, direction);
}

static accel_ray make_bounce(const struct rays *rays, struct random *random)
{
    accel_id id;
    double direction[3];
    const place from = any_place(rays, random, &id);
    unit_vector(random, direction);
    accel_ray ray = accel_ray_from(from.at, direction);
    ray.skip = id;
    return ray;
}

static accel_ray make_vertex(const struct rays *rays, struct random *random)
{
    double from[3], at[3];
    any_origin(rays, random, from);
    any_vertex(rays, random, at);
    return aimed(from, at);
}

static accel_ray make_edge(const struct rays *rays, struct random *random)
{
    double from[3], at[3];
    any_origin(rays, random, from);
    any_edge_point(rays, random, at);
    return aimed(from, at);
}

/* A plane of the lattice that halving the box makes, along axis k. */
static double lattice_plane(const struct rays *rays, struct random *random, int k)
{
    const double parts = (double)(1 << random_below(random, 8));
    const double part = floor(random_in(random, 0.0, parts + 1.0)) / parts;
    return rays->box.lo[k] + part * (rays->box.hi[k] - rays->box.lo[k]);
}

static accel_ray make_axis(const struct rays *rays, struct random *random)
{
    double from[3], direction[3];
    any_vertex(rays, random, from);
    const int axis = (int)random_below(random, 3);
    const bool diagonal = random_below(random, 4) == 0;
    for (int k = 0; k < 3; k++) {
        const bool moves = k == axis || (diagonal && k == (axis + 1) % 3);
        direction[k] = copysign(moves ? 1.0 : 0.0, random_sign(random));
        if (random_below(random, 8) == 0) {
            from[k] = lattice_plane(rays, random, k);
        }
    }
    if (random_below(random, 2) == 0) {
        const double back = 3.0 * rays->radius;
        for (int k = 0; k < 3; k++) {
            from[k] -= direction[k] * back;
        }
    }
    return accel_ray_from(from, direction);
}

static accel_ray make_grazing(const struct rays *rays, struct random *random)
{
    accel_id id;
    double from[3], direction[3];
    const place at = any_place(rays, random, &id);
    const double length =
        sqrt(at.along[0] * at.along[0] + at.along[1] * at.along[1] + at.along[2] * at.along[2]);
    const double height =
        sqrt(at.away[0] * at.away[0] + at.away[1] * at.away[1] + at.away[2] * at.away[2]);
    const double lift = random_sign(random) * pow(10.0, -random_in(random, 2.0, 15.0));
    const double back =
        random_in(random, 0.0, 2.0) * (random_below(random, 2) == 0 ? rays->radius : length);
    for (int k = 0; k < 3; k++) {
        direction[k] = at.along[k] / length + lift * at.away[k] / height;
        from[k] = at.at[k] - back * direction[k];
    }
    return accel_ray_from(from, direction);
}

static accel_ray make_far(const struct rays *rays, struct random *random)
{
    accel_id id;
    double from[3];
    const place at = any_place(rays, random, &id);
    const double distance = rays->radius * pow(10.0, random_in(random, 3.0, 14.0));
    unit_vector(random, from);
    for (int k = 0; k < 3; k++) {
        from[k] = rays->centre[k] + distance * from[k];
    }
    return aimed(from, at.at);
}

static accel_ray make_scaled(const struct rays *rays, struct random *random)
{
    accel_ray ray =
        random_below(random, 2) == 0 ? make_line(rays, random) : make_edge(rays, random);
    const int power = (int)random_below(random, 1001) - 500;
    for (int k = 0; k < 3; k++) {
        ray.dir[k] = ldexp(ray.dir[k], power);
    }
    return ray;
}

/* The hit is at t = 1, up to rounding. */
static double interval_end(struct random *random)
{
    static const double ends[] = {0.0, 0.5, 1.0, 1.0 - 0x1p-53, 1.0 + 0x1p-52, 2.0, -1.0, 1e300};
    const uint64_t pick = random_below(random, 10);
    return pick < 8 ? ends[pick] : pick == 8 ? -(double)INFINITY : (double)INFINITY;
}

static accel_ray make_interval(const struct rays *rays, struct random *random)
{
    accel_id id;
    double from[3];
    any_origin(rays, random, from);
    accel_ray ray = aimed(from, any_place(rays, random, &id).at);
    ray.tmin = interval_end(random);
    ray.tmax = interval_end(random);
    return ray;
}

static double odd_number(struct random *random)
{
    static const double odd[] = {0.0, DBL_TRUE_MIN, DBL_MIN, 1e-300, 1.0, 1e300, DBL_MAX};
    const uint64_t pick = random_below(random, 9);
    const double number = pick < 7 ? odd[pick] : pick == 7 ? (double)INFINITY : (double)NAN;
    return copysign(number, random_sign(random));
}

/* All of the direction is odd, a third of the origins and a quarter of the interval's ends are. */
static accel_ray make_odd(const struct rays *rays, struct random *random)
{
    accel_ray ray = make_line(rays, random);
    for (int k = 0; k < 3; k++) {
        ray.dir[k] = odd_number(random);
        ray.org[k] = random_below(random, 9) == 0 ? odd_number(random) : ray.org[k];
    }
    ray.tmin = random_below(random, 4) == 0 ? odd_number(random) : ray.tmin;
    ray.tmax = random_below(random, 4) == 0 ? odd_number(random) : ray.tmax;
    return ray;
}

accel_ray rays_make(const struct rays *rays, uint64_t index)
{
    static accel_ray (*const makers[FAMILIES])(const struct rays *, struct random *) = {
        make_primary, make_line,    make_inside, make_bounce, make_vertex,   make_edge,
        make_axis,    make_grazing, make_far,    make_scaled, make_interval, make_odd,
    };
    struct random random = random_start(rays->seed, STREAM_RAYS, index);
    return makers[index % FAMILIES](rays, &random);
}
