/* SPDX-License-Identifier: Apache-2.0
 *
 * Copies a scene into flat arrays and sorts its primitives into bounded, unbounded, degenerate and
 * invalid ones.
 */
#include "primitives.h"

#include <string.h>

#include "../core/box.h"
#include "../core/build.h"
#include "../core/cost.h"
#include "../core/seal.h"

/* What becomes of one primitive. */
enum sort { BOUNDED, UNBOUNDED, DEGENERATE, INVALID };

static bool in_range(const double *x, int count)
{
    for (int i = 0; i < count; i++)
        if (!(fabs(x[i]) <= ACCEL_MAX_COORDINATE))
            return false;
    return true;
}

static bool same_point(const double *p, const double *q)
{
    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
}

static void read_vertex(const accel_triangles *t, uint32_t vertex, double out[3])
{
    const size_t packed = 3 * (t->vertices_are_float ? sizeof(float) : sizeof(double));
    const size_t stride = t->vertex_stride ? t->vertex_stride : packed;
    const char *at = (const char *)t->vertices + vertex * stride;
    if (!t->vertices_are_float) {
        memcpy(out, at, 3 * sizeof(double));
        return;
    }
    float point[3];
    memcpy(point, at, sizeof point);
    for (int k = 0; k < 3; k++)
        out[k] = (double)point[k];
}

static enum sort copy_triangle(const accel_triangles *t, uint32_t i, double *out, accel_box *box)
{
    for (int corner = 0; corner < 3; corner++)
        read_vertex(t, t->indices[3 * (size_t)i + (size_t)corner], out + 3 * corner);
    if (!in_range(out, 9))
        return INVALID;
    if (same_point(out, out + 3) || same_point(out + 3, out + 6) || same_point(out + 6, out))
        return DEGENERATE;
    *box = box_empty();
    for (int corner = 0; corner < 3; corner++)
        box_add_point(box, out + 3 * corner);
    return BOUNDED;
}

static enum sort copy_sphere(const accel_spheres *s, uint32_t i, double *out, accel_box *box)
{
    const size_t stride = s->stride ? s->stride : 4 * sizeof(double);
    memcpy(out, (const char *)s->spheres + i * stride, 4 * sizeof(double));
    if (!in_range(out, 4) || !(out[3] > 0.0))
        return INVALID;
    for (int k = 0; k < 3; k++) {
        box->lo[k] = out[k] - out[3];
        box->hi[k] = out[k] + out[3];
    }
    return in_range(box->lo, 3) && in_range(box->hi, 3) ? BOUNDED : INVALID;
}

static enum sort copy_object(const accel_objects *o, uint32_t i, accel_box *box)
{
    *box = o->boxes[i];
    for (int k = 0; k < 3; k++)
        if (!(box->lo[k] <= box->hi[k]))
            return INVALID;
    return in_range(box->lo, 3) && in_range(box->hi, 3) ? BOUNDED : UNBOUNDED;
}

uint32_t accel_primitives_in(const accel_geometry *g)
{
    return g->type == ACCEL_TRIANGLES ? g->triangles.count
           : g->type == ACCEL_SPHERES ? g->spheres.count
                                      : g->objects.count;
}

/* NULL, or what is wrong with the geometry's arrays. */
static const char *complaint(const accel_geometry *g)
{
    const accel_triangles *t = &g->triangles;
    switch (g->type) {
    case ACCEL_TRIANGLES:
        if (t->count > 0 && (!t->vertices || !t->indices))
            return "triangles without vertices or indices";
        if (t->vertex_stride > 0 && t->vertex_stride < 3 * (t->vertices_are_float ? 4u : 8u))
            return "vertex_stride is smaller than a vertex";
        return NULL;
    case ACCEL_SPHERES:
        if (g->spheres.count > 0 && !g->spheres.spheres)
            return "spheres is NULL";
        if (g->spheres.stride > 0 && g->spheres.stride < 4 * sizeof(double))
            return "stride is smaller than a sphere";
        return NULL;
    case ACCEL_OBJECTS:
        if (g->objects.count > 0 && (!g->objects.boxes || !g->objects.intersect))
            return "objects without boxes or intersect";
        if (g->objects.order != ACCEL_ORDER_KEY && g->objects.order != ACCEL_ORDER_RAW)
            return "order is not one of accel_order";
        return NULL;
    }
    return "type is not one of accel_type";
}

/* So many primitives are too many: ids end below ACCEL_NONE, and no array has elements so large
 * that its size would overflow with fewer, where a size has 32 bits. */
enum { LARGEST_ELEMENT = 256 };
static const uint64_t too_many =
    SIZE_MAX / LARGEST_ELEMENT < ACCEL_NONE ? SIZE_MAX / LARGEST_ELEMENT : ACCEL_NONE;

/* Checks what can be checked before anything is allocated. */
static bool check(struct build *build, const accel_scene *scene)
{
    uint64_t total = 0;
    for (uint32_t g = 0; g < scene->count; g++) {
        const char *wrong = complaint(&scene->geometries[g]);
        if (wrong) {
            accel_error_set(build->error, ACCEL_BAD_ARGUMENT, "geometry %u: %s; nothing was built",
                            g, wrong);
            return false;
        }
        total += accel_primitives_in(&scene->geometries[g]);
    }
    if (total >= too_many) {
        accel_error_set(build->error, ACCEL_TOO_LARGE,
                        "scene: %llu primitives, at most %llu are allowed; nothing was built",
                        (unsigned long long)total, (unsigned long long)too_many - 1);
        return false;
    }
    return true;
}

static bool check_indices(struct build *build, uint32_t number, const accel_triangles *t)
{
    for (size_t i = 0; i < 3 * (size_t)t->count; i++) {
        if (t->indices[i] < t->vertex_count)
            continue;
        accel_error_set(
            build->error, ACCEL_BAD_ARGUMENT,
            "geometry %u, triangle %zu: vertex %u is used, but there are %u; nothing was built",
            number, i / 3, t->indices[i], t->vertex_count);
        return false;
    }
    return true;
}

static void *allocate(struct build *build, size_t count, size_t size)
{
    struct memory *m = build->memory;
    void *block = accel_memory_resize(m, NULL, 0, count * size);
    if (!block)
        accel_build_no_memory(build);
    return block;
}

static bool allocate_all(struct build *build, struct primitives *p, const accel_scene *scene,
                         uint32_t total)
{
    if (scene->count == 0)
        return true;
    if (!(p->geometry = allocate(build, scene->count, sizeof *p->geometry)))
        return false;
    memset(p->geometry, 0, scene->count * sizeof *p->geometry);
    p->geometry_count = scene->count;
    if (total == 0)
        return true;
    p->count = total;
    if (!(p->box = allocate(build, total, sizeof *p->box)))
        return false;
    return scene->count == 1 ||
           (p->geometry_of = allocate(build, total, sizeof *p->geometry_of)) != NULL;
}

static size_t data_doubles(const struct geometry *g)
{
    return primitives_words(g) * (size_t)g->count;
}

static bool copy_header(struct build *build, const accel_geometry *from, uint32_t first,
                        struct geometry *g)
{
    g->type = from->type;
    g->first = first;
    g->count = accel_primitives_in(from);
    g->order = ACCEL_ORDER_KEY;
    if (from->type == ACCEL_OBJECTS) {
        g->order = from->objects.order;
        g->intersect = from->objects.intersect;
        g->user = from->objects.user;
        g->cost = from->objects.cost;
    }
    const size_t doubles = data_doubles(g);
    return doubles == 0 || (g->data = allocate(build, doubles, sizeof(double))) != NULL;
}

static enum sort copy_primitive(const accel_geometry *from, struct geometry *g, uint32_t i,
                                accel_box *box)
{
    switch (from->type) {
    case ACCEL_TRIANGLES:
        return copy_triangle(&from->triangles, i, g->data + 9 * (size_t)i, box);
    case ACCEL_SPHERES:
        return copy_sphere(&from->spheres, i, g->data + 4 * (size_t)i, box);
    case ACCEL_OBJECTS:
        break;
    }
    return copy_object(&from->objects, i, box);
}

static bool append(struct build *build, struct ids *list, uint32_t id)
{
    if (!array_extend(build->memory, list, 1))
        return accel_build_no_memory(build);
    list->at[list->count - 1] = id;
    return true;
}

static void note_invalid(accel_info *info, accel_id name)
{
    if (info->skipped < ACCEL_INFO_IDS)
        info->skipped_ids[info->skipped] = name;
    info->skipped++;
}

/* Enters one primitive into the lists and counts; makes its box the padded one. */
static bool enter(struct build *build, struct primitives *p, uint32_t id, enum sort sort)
{
    accel_box *box = &p->box[id];
    if (sort == BOUNDED) {
        *box = box_padded(box);
        box_add(&p->bounds, box);
        return append(build, &p->bounded, id);
    }
    if (sort == UNBOUNDED) {
        const double inf = (double)INFINITY;
        *box = (accel_box){{-inf, -inf, -inf}, {inf, inf, inf}};
        return append(build, &p->unbounded, id);
    }
    *box = box_empty();
    if (sort == DEGENERATE)
        build->info->degenerate++;
    else
        note_invalid(build->info, primitives_name(p, id));
    return true;
}

static bool are_floats(const double *x, size_t count)
{
    bool all = true;
    for (size_t i = 0; i < count; i++)
        all &= (double)(float)x[i] == x[i];
    return all;
}

static bool copy_geometry(struct build *build, struct primitives *p, const accel_geometry *from,
                          uint32_t number)
{
    struct geometry *g = &p->geometry[number];
    const size_t words = primitives_words(g);
    for (uint32_t i = 0; i < g->count; i++) {
        const uint32_t id = g->first + i;
        if (p->geometry_of)
            p->geometry_of[id] = number;
        const enum sort sort = copy_primitive(from, g, i, &p->box[id]);
        p->only_floats =
            p->only_floats && (sort != BOUNDED || are_floats(g->data + words * i, words));
        if (sort == BOUNDED && words > 0)
            p->data_seal += seal_primitive(id, g->data + words * i, words);
        if (!enter(build, p, id, sort))
            return false;
        p->box_seal += seal_primitive(id, &p->box[id], PRIMITIVES_BOX_WORDS);
        if (i % 4096 == 0 && !accel_build_tick(build, (double)id / p->count))
            return false;
    }
    return true;
}

static double mean_cost(const struct primitives *p)
{
    static const double cost[] = {COST_TRIANGLE, COST_SPHERE, COST_OBJECT};
    double sum = 0.0, count = 0.0;
    for (uint32_t g = 0; g < p->geometry_count; g++) {
        sum += cost[p->geometry[g].type] * p->geometry[g].count;
        count += p->geometry[g].count;
    }
    return count > 0.0 ? sum / count : COST_TRIANGLE;
}

static uint32_t scene_size(const accel_scene *scene)
{
    uint32_t total = 0;
    for (uint32_t g = 0; g < scene->count; g++)
        total += accel_primitives_in(&scene->geometries[g]);
    return total;
}

static bool only_triangles(const struct primitives *p)
{
    for (uint32_t g = 0; g < p->geometry_count; g++)
        if (p->geometry[g].type != ACCEL_TRIANGLES && p->geometry[g].count > 0)
            return false;
    return true;
}

static bool has_triangles(const struct primitives *p)
{
    for (uint32_t g = 0; g < p->geometry_count; g++)
        if (p->geometry[g].type == ACCEL_TRIANGLES && p->geometry[g].count > 0)
            return true;
    return false;
}

static bool by_key(const struct primitives *p)
{
    for (uint32_t g = 0; g < p->geometry_count; g++)
        if (p->geometry[g].order != ACCEL_ORDER_KEY)
            return false;
    return true;
}

static void describe(struct build *build, const struct primitives *p)
{
    if (!p->geometry_of)
        accel_build_left_out(build, p->count * sizeof *p->geometry_of, build->memory->bytes,
                             "one geometry: no table of each primitive's geometry");
    if (p->only_triangles)
        accel_build_left_out(
            build, 0, 0,
            "only triangles: no callback path; leaves are tested two by two (saves rays' "
            "time only)");
}

bool accel_primitives_check(struct build *build, const accel_scene *scene, uint32_t *count)
{
    if (!check(build, scene))
        return false;
    for (uint32_t g = 0; g < scene->count; g++)
        if (scene->geometries[g].type == ACCEL_TRIANGLES &&
            !check_indices(build, g, &scene->geometries[g].triangles))
            return false;
    *count = scene_size(scene);
    return true;
}

bool accel_primitives_triangle(const accel_geometry *from, uint32_t i, double vertices[9],
                               accel_box *box)
{
    return copy_triangle(&from->triangles, i, vertices, box) == BOUNDED;
}

bool accel_primitives_bounded(const accel_geometry *from, uint32_t i, accel_box *box)
{
    double copied[9];
    if (from->type == ACCEL_TRIANGLES)
        return accel_primitives_triangle(from, i, copied, box);
    if (from->type == ACCEL_SPHERES)
        return copy_sphere(&from->spheres, i, copied, box) == BOUNDED;
    return copy_object(&from->objects, i, box) == BOUNDED;
}

bool accel_primitives_copy(struct build *build, struct primitives *p, const accel_scene *scene)
{
    if (!check(build, scene))
        return false;
    const uint32_t total = scene_size(scene);
    build->info->primitives = total;
    if (!allocate_all(build, p, scene, total))
        return false;
    uint32_t first = 0;
    for (uint32_t g = 0; g < scene->count; g++) {
        const accel_geometry *from = &scene->geometries[g];
        if (from->type == ACCEL_TRIANGLES && !check_indices(build, g, &from->triangles))
            return false;
        if (!copy_header(build, from, first, &p->geometry[g]))
            return false;
        first += p->geometry[g].count;
    }
    p->bounds = box_empty();
    p->test_cost = mean_cost(p);
    p->triangles = has_triangles(p);
    p->only_triangles = p->only_floats = only_triangles(p);
    p->by_key = by_key(p);
    if (total == 0)
        return true;
    if (!array_reserve(build->memory, &p->bounded, total))
        return accel_build_no_memory(build);
    for (uint32_t g = 0; g < scene->count; g++)
        if (!copy_geometry(build, p, &scene->geometries[g], g))
            return false;
    build->info->unbounded = p->unbounded.count;
    array_trim(build->memory, &p->bounded);
    describe(build, p);
    return true;
}

static void free_data(struct memory *m, struct geometry *g)
{
    if (g->data)
        accel_memory_resize(m, g->data, data_doubles(g) * sizeof(double), 0);
    g->data = NULL;
}

void accel_primitives_leave(struct memory *m, struct primitives *p)
{
    for (uint32_t g = 0; g < p->geometry_count; g++)
        free_data(m, &p->geometry[g]);
    p->left = true;
}

size_t accel_primitives_leave_boxes(struct memory *m, struct primitives *p)
{
    const size_t before = m->bytes;
    accel_memory_resize(m, p->box, p->count * sizeof *p->box, 0);
    accel_memory_resize(m, p->bounded.at, p->bounded.capacity * sizeof *p->bounded.at, 0);
    p->box = NULL;
    p->bounded.at = NULL;
    p->bounded.capacity = 0;
    return before - m->bytes;
}

void accel_primitives_free(struct memory *m, struct primitives *p)
{
    for (uint32_t g = 0; g < p->geometry_count; g++)
        free_data(m, &p->geometry[g]);
    if (p->geometry)
        accel_memory_resize(m, p->geometry, p->geometry_count * sizeof *p->geometry, 0);
    if (p->box)
        accel_memory_resize(m, p->box, p->count * sizeof *p->box, 0);
    if (p->geometry_of)
        accel_memory_resize(m, p->geometry_of, p->count * sizeof *p->geometry_of, 0);
    array_free(m, &p->bounded);
    array_free(m, &p->unbounded);
}
