/* SPDX-License-Identifier: Apache-2.0
 *
 * A scene that a generator made, and what it owns. Shared by the tests and by reports: see
 * catalogue.h for the list of generators.
 *
 * Triangles have their own three vertices each, so neighbours share values, not indices.
 */
#ifndef CASES_CASE_SCENE_H
#define CASES_CASE_SCENE_H

#include <stdio.h>

#include "rays.h"

enum { MAX_GEOMETRIES = 600 };

/* What a host object of a test scene does. All are functions of the ray and `p` alone. */
enum behaviour {
    BALL,    /* p: centre, radius; reports both roots */
    FILTER,  /* the same, but keeps roots beyond the limit to itself */
    CRATE,   /* p: lo, hi; reports entry and exit */
    PLANE,   /* p: a point, a normal */
    COMB,    /* p[0]: that many hits, evenly spread from t = p[1] to p[2] */
    STRAY,   /* p[0]: reports this t, wherever the box is */
    NOTHING, /* reports NaN, which is no hit */
    BEHAVIOURS
};

struct test_object {
    enum behaviour behaviour;
    double p[6];
};

/* One geometry that grows. */
struct part {
    accel_type type;
    accel_order order;           /* of objects */
    double *data;                /* 9 per triangle or 4 per sphere */
    uint32_t *indices;           /* 0, 1, 2, ... */
    accel_box *boxes;            /* of objects */
    struct test_object *objects; /* of objects */
    uint32_t count, room;        /* primitives */
};

struct test_scene {
    accel_scene scene; /* what accel_build takes, once scene_close was called */
    accel_geometry geometry[MAX_GEOMETRIES];
    struct part part[MAX_GEOMETRIES];
    uint32_t count;           /* parts */
    struct ray_target target; /* the same for rays, with those that come with reported cases */
    uint32_t given_room;      /* of them; there is room for */
};

void scene_open(struct test_scene *s);

/* Starts the next geometry. */
struct part *scene_part(struct test_scene *s, accel_type type);

void part_triangle(struct part *p, const double a[3], const double b[3], const double c[3]);
void part_sphere(struct part *p, const double centre[3], double radius);
void part_object(struct part *p, const accel_box *box, enum behaviour behaviour,
                 const double data[6]);

/* Adds a ray to those that come with the scene. */
void scene_give(struct test_scene *s, const accel_ray *ray);

/* Makes s->scene and s->target from the parts. */
void scene_close(struct test_scene *s);

void scene_free(struct test_scene *s);

/* Primitives in all parts. */
uint64_t scene_size(const struct test_scene *s);

/* Multiplies every number of triangles and spheres, then adds `shift` to every coordinate. Before
 * scene_close. */
void scene_move(struct test_scene *s, double scale, const double shift[3]);

/* The accel_intersect of test objects. */
void test_object_intersect(accel_probe *probe);

/* Writes the parts as text with hexadecimal floats, and reads them back. False: not readable. */
void scene_write(FILE *f, const struct test_scene *s);
bool scene_read(FILE *f, struct test_scene *s);

/* malloc and realloc that end the program with a message where there is no memory. */
void *must_resize(void *old, size_t size);

#endif
