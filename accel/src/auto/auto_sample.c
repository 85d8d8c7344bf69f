/* SPDX-License-Identifier: Apache-2.0 */
#include "auto_sample.h"
#include "../core/frame.h"

#include <float.h>
#include <string.h>

/* A sampled object stands for its box: hit in the middle of the part inside. */
static void hit_box(accel_probe *probe)
{
    struct sample *s = probe->user;
    const accel_box *box = &s->boxes.at[probe->prim];
    s->calls++;
    double a = probe->ray->tmin, z = probe->ray->tmax;
    for (int k = 0; k < 3; k++) {
        const double t0 = (box->lo[k] - probe->ray->org[k]) / probe->ray->dir[k];
        const double t1 = (box->hi[k] - probe->ray->org[k]) / probe->ray->dir[k];
        a = fmax(a, fmin(t0, t1));
        z = fmin(z, fmax(t0, t1));
    }
    if (a <= z)
        accel_report(probe, 0.5 * (a + z), 0.0, 0.0);
}

/* Primitives between two looks at the clock. */
enum { TICK = 1 << 16 };

static double scaled(double x, double centre, double scale)
{
    return centre + scale * (x - centre);
}

static bool add_triangle(struct memory *m, struct sample *s, const double *from, double scale)
{
    if (!array_extend(m, &s->vertices, 9) || !array_extend(m, &s->indices, 3))
        return false;
    double *to = s->vertices.at + s->vertices.count - 9;
    for (int i = 0; i < 9; i++) {
        const double *x = from + i % 3;
        to[i] = scaled(from[i], x[0] / 3 + x[3] / 3 + x[6] / 3, scale);
    }
    for (size_t i = s->indices.count - 3; i < s->indices.count; i++)
        s->indices.at[i] = (uint32_t)i;
    return true;
}

static bool add_sphere(struct memory *m, struct sample *s, const double *from, double scale)
{
    if (!array_extend(m, &s->spheres, 4))
        return false;
    double *to = s->spheres.at + s->spheres.count - 4;
    memcpy(to, from, 4 * sizeof *to);
    to[3] *= scale;
    return true;
}

static bool add_box(struct memory *m, struct sample *s, const accel_box *from, double scale)
{
    if (!array_extend(m, &s->boxes, 1))
        return false;
    accel_box *to = s->boxes.at + s->boxes.count - 1;
    for (int k = 0; k < 3; k++) {
        const double centre = from->lo[k] + 0.5 * (from->hi[k] - from->lo[k]);
        to->lo[k] = scaled(from->lo[k], centre, scale);
        to->hi[k] = scaled(from->hi[k], centre, scale);
    }
    return true;
}

static bool add(struct memory *m, struct sample *s, const struct primitives *p, uint32_t id,
                double scale)
{
    const struct geometry *g = primitives_geometry(p, id);
    const size_t i = id - g->first;
    switch (g->type) {
    case ACCEL_TRIANGLES:
        return add_triangle(m, s, g->data + 9 * i, scale);
    case ACCEL_SPHERES:
        return add_sphere(m, s, g->data + 4 * i, scale);
    case ACCEL_OBJECTS:
        break;
    }
    return add_box(m, s, &p->box[id], scale);
}

static void make_scene(struct sample *s)
{
    s->geometry[0] = (accel_geometry){.type = ACCEL_TRIANGLES,
                                      .triangles = {.vertices = s->vertices.at,
                                                    .vertex_count = (uint32_t)s->vertices.count / 3,
                                                    .indices = s->indices.at,
                                                    .count = (uint32_t)s->indices.count / 3}};
    s->geometry[1] = (accel_geometry){
        .type = ACCEL_SPHERES,
        .spheres = {.spheres = s->spheres.at, .count = (uint32_t)s->spheres.count / 4}};
    s->geometry[2] = (accel_geometry){.type = ACCEL_OBJECTS,
                                      .objects = {.boxes = s->boxes.at,
                                                  .count = (uint32_t)s->boxes.count,
                                                  .intersect = hit_box,
                                                  .user = s}};
    s->scene = (accel_scene){s->geometry, 3};
}

/* Half the surface of a primitive's box, in units of the scene's frame; not 0. */
static double surface(const struct primitives *p, const struct frame *f, uint32_t id)
{
    const accel_box unit = frame_box(f, &p->box[id]);
    return box_area(&unit) + DBL_MIN;
}

/* Looks at the clock now and then. */
static bool tick(struct build *build, size_t i)
{
    return i % TICK != 0 || accel_build_tick(build, 0.0);
}

/* The sum of all surfaces. */
static bool add_surfaces(struct build *build, const struct frame *f, double *sum)
{
    const struct primitives *p = &build->a->prims;
    *sum = 0.0;
    for (size_t i = 0; i < p->bounded.count; i++) {
        *sum += surface(p, f, p->bounded.at[i]);
        if (!tick(build, i))
            return false;
    }
    return true;
}

/* Adds a primitive, scaled. */
static bool take(struct build *build, struct sample *s, uint32_t id, double chance)
{
    const struct primitives *p = &build->a->prims;
    box_add(&s->box, &p->box[id]);
    s->count++;
    return add(&build->a->memory, s, p, id, sqrt(1.0 / chance)) || accel_build_no_memory(build);
}

bool accel_sample_take(struct build *build, struct sample *s, size_t most)
{
    const struct primitives *p = &build->a->prims;
    const size_t n = p->bounded.count;
    const struct frame frame = frame_of(&p->bounds);
    double sum, due = 0.5;
    s->box = box_empty();
    if (!add_surfaces(build, &frame, &sum))
        return false;
    for (size_t i = 0; i < n; i++) {
        const uint32_t id = p->bounded.at[i];
        const double share = 0.5 * surface(p, &frame, id) / sum + 0.5 / (double)n;
        const double chance = n > most ? fmin(1.0, (double)most * share) : 1.0;
        due += chance;
        if (due >= 1.0 && !take(build, s, id, chance))
            return false;
        due -= due >= 1.0 ? 1.0 : 0.0;
        if (!tick(build, i))
            return false;
    }
    make_scene(s);
    return true;
}

void accel_sample_free(struct memory *m, struct sample *s)
{
    array_free(m, &s->vertices);
    array_free(m, &s->indices);
    array_free(m, &s->spheres);
    array_free(m, &s->boxes);
}
