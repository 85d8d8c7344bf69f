/* SPDX-License-Identifier: Apache-2.0 */
#include "case_scene.h"

#include "loaded.h"

#include <stdlib.h>
#include <string.h>

void *must_resize(void *old, size_t size)
{
    void *block = realloc(old, size ? size : 1);
    if (block)
        return block;
    fprintf(stderr, "scenes: no memory for %zu bytes\n", size);
    exit(2);
}

void scene_open(struct test_scene *s)
{
    memset(s, 0, sizeof *s);
}

struct part *scene_part(struct test_scene *s, accel_type type)
{
    if (s->count == MAX_GEOMETRIES) {
        fprintf(stderr, "scenes: more than %d geometries\n", MAX_GEOMETRIES);
        exit(2);
    }
    struct part *p = &s->part[s->count++];
    p->type = type;
    return p;
}

static void grow(struct part *p)
{
    if (p->count < p->room)
        return;
    p->room = p->room ? 2 * p->room : 16;
    const size_t n = p->room;
    if (p->type == ACCEL_OBJECTS) {
        p->boxes = must_resize(p->boxes, n * sizeof *p->boxes);
        p->objects = must_resize(p->objects, n * sizeof *p->objects);
    } else if (p->type == ACCEL_SPHERES) {
        p->data = must_resize(p->data, n * 4 * sizeof(double));
    } else {
        p->data = must_resize(p->data, n * 9 * sizeof(double));
    }
}

void part_triangle(struct part *p, const double a[3], const double b[3], const double c[3])
{
    grow(p);
    double *to = p->data + 9 * (size_t)p->count++;
    memcpy(to, a, 3 * sizeof(double));
    memcpy(to + 3, b, 3 * sizeof(double));
    memcpy(to + 6, c, 3 * sizeof(double));
}

void part_sphere(struct part *p, const double centre[3], double radius)
{
    grow(p);
    double *to = p->data + 4 * (size_t)p->count++;
    memcpy(to, centre, 3 * sizeof(double));
    to[3] = radius;
}

void part_object(struct part *p, const accel_box *box, enum behaviour behaviour,
                 const double data[6])
{
    grow(p);
    p->boxes[p->count] = *box;
    struct test_object *o = &p->objects[p->count++];
    o->behaviour = behaviour;
    memcpy(o->p, data, sizeof o->p);
}

void scene_give(struct test_scene *s, const accel_ray *ray)
{
    if (s->target.given_count == s->given_room) {
        s->given_room = s->given_room ? 2 * s->given_room : 16;
        s->target.given = must_resize(s->target.given, s->given_room * sizeof *s->target.given);
    }
    s->target.given[s->target.given_count++] = *ray;
}

static size_t part_doubles(const struct part *p)
{
    return (p->type == ACCEL_TRIANGLES ? 9u
            : p->type == ACCEL_SPHERES ? 4u
                                       : 0u) *
           (size_t)p->count;
}

void scene_move(struct test_scene *s, double scale, const double shift[3])
{
    for (uint32_t g = 0; g < s->count; g++) {
        struct part *p = &s->part[g];
        for (size_t i = 0; i < part_doubles(p); i++) {
            const size_t k = p->type == ACCEL_TRIANGLES ? i % 3 : i % 4;
            p->data[i] = p->data[i] * scale + (k < 3 ? shift[k] : 0.0);
        }
    }
}

static accel_geometry describe_part(struct part *p)
{
    accel_geometry g = {.type = p->type};
    if (p->type == ACCEL_TRIANGLES) {
        const uint32_t corners = 3 * p->count;
        p->indices = must_resize(p->indices, corners * sizeof *p->indices);
        for (uint32_t i = 0; i < corners; i++)
            p->indices[i] = i;
        g.triangles = (accel_triangles){
            .vertices = p->data, .vertex_count = corners, .indices = p->indices, .count = p->count};
    } else if (p->type == ACCEL_SPHERES) {
        g.spheres = (accel_spheres){.spheres = p->data, .count = p->count};
    } else {
        g.objects = (accel_objects){.boxes = p->boxes,
                                    .count = p->count,
                                    .order = p->order,
                                    .intersect = test_object_intersect,
                                    .user = p->objects};
    }
    return g;
}

void scene_close(struct test_scene *s)
{
    for (uint32_t g = 0; g < s->count; g++)
        s->geometry[g] = describe_part(&s->part[g]);
    s->scene = (accel_scene){s->geometry, s->count};
    s->target.scene = &s->scene;
    s->target.primitives = scene_primitives(&s->scene);
    scene_box(&s->scene, &s->target.box);
}

void scene_free(struct test_scene *s)
{
    for (uint32_t g = 0; g < s->count; g++) {
        struct part *p = &s->part[g];
        free(p->data);
        free(p->indices);
        free(p->boxes);
        free(p->objects);
    }
    free(s->target.given);
    scene_open(s);
}

uint64_t scene_size(const struct test_scene *s)
{
    uint64_t size = 0;
    for (uint32_t g = 0; g < s->count; g++)
        size += s->part[g].count;
    return size;
}

/* ------------------------------------------------------------------- text ---- */

static void write_doubles(FILE *f, const double *x, size_t count)
{
    for (size_t i = 0; i < count; i++)
        fprintf(f, "%a%c", x[i], i + 1 < count ? ' ' : '\n');
}

void scene_write(FILE *f, const struct test_scene *s)
{
    fprintf(f, "scene %u\n", s->count);
    for (uint32_t g = 0; g < s->count; g++) {
        const struct part *p = &s->part[g];
        fprintf(f, "part %d %d %u\n", (int)p->type, (int)p->order, p->count);
        for (uint32_t i = 0; i < p->count; i++) {
            if (p->type == ACCEL_OBJECTS) {
                fprintf(f, "%d ", (int)p->objects[i].behaviour);
                write_doubles(f, p->objects[i].p, 6);
                write_doubles(f, p->boxes[i].lo, 6);
            } else {
                const size_t n = p->type == ACCEL_SPHERES ? 4 : 9;
                write_doubles(f, p->data + n * i, n);
            }
        }
    }
}

static bool read_doubles(FILE *f, double *x, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (fscanf(f, "%lf", &x[i]) != 1)
            return false;
    return true;
}

static bool read_primitive(FILE *f, struct part *p)
{
    double x[9];
    if (p->type == ACCEL_TRIANGLES) {
        if (!read_doubles(f, x, 9))
            return false;
        part_triangle(p, x, x + 3, x + 6);
        return true;
    }
    if (p->type == ACCEL_SPHERES) {
        if (!read_doubles(f, x, 4))
            return false;
        part_sphere(p, x, x[3]);
        return true;
    }
    int behaviour;
    accel_box box;
    if (fscanf(f, "%d", &behaviour) != 1 || behaviour < 0 || behaviour >= BEHAVIOURS ||
        !read_doubles(f, x, 6) || !read_doubles(f, box.lo, 3) || !read_doubles(f, box.hi, 3))
        return false;
    part_object(p, &box, (enum behaviour)behaviour, x);
    return true;
}

bool scene_read(FILE *f, struct test_scene *s)
{
    uint32_t parts;
    scene_open(s);
    if (fscanf(f, " scene %u", &parts) != 1 || parts > MAX_GEOMETRIES)
        return false;
    for (uint32_t g = 0; g < parts; g++) {
        int type, order;
        uint32_t count;
        if (fscanf(f, " part %d %d %u", &type, &order, &count) != 3 || type < ACCEL_TRIANGLES ||
            type > ACCEL_OBJECTS)
            return false;
        struct part *p = scene_part(s, (accel_type)type);
        p->order = (accel_order)order;
        for (uint32_t i = 0; i < count; i++)
            if (!read_primitive(f, p))
                return false;
    }
    scene_close(s);
    return true;
}
