/* SPDX-License-Identifier: Apache-2.0
 *
 * What a structure will take: a small one is built and measured; of a large one PARTS parts are,
 * each a primitive drawn at random and its nearest neighbours, so that what leaves share and how
 * boxes overlap is as in the whole.
 *
 * Parts are drawn by primitives, so the mean of what a primitive takes in them is without bias, but
 * for what depends on the whole: levels above the parts (less than a 16th of the nodes), depths and
 * cell sizes that follow the number of primitives. Its standard error is that of the parts' means;
 * ERRORS of them are added, and MARGIN for the rest.
 *
 * Whether triangles are cut (wide_split.h) depends on how their boxes lie across each other in the
 * whole: what a part takes is raised where they are in the whole but not in the part.
 *
 * Cost: four passes over the scene with PARTS distances a primitive, and the builds of the parts.
 */
#include "box.h"
#include "config.h"
#include "environment.h"
#include "kind.h"
#include "../wide/wide_split.h"

#include <string.h>

enum { WHOLE = 32768, PARTS = 16, PART = 2048, MOST_OF_PART = 2 * PART };

#define MARGIN 0.04
#define ERRORS 2.0

/* Bins of distances, eight to an octave: the upper bits of a double that is not negative. */
enum { SHIFT = 49, BINS = 1 << (63 - SHIFT) };

/* A part: who is near its primitive. */
struct part {
    double at[3];   /* the centre of that */
    uint32_t last;  /* bin of the farthest that belong to it */
    uint32_t count; /* who belongs to it */
};

/* Numbers of a primitive: its geometry and place. */
struct member {
    uint32_t geometry, place;
};

struct parts {
    struct build *build;
    const accel_scene *scene;
    struct part part[PARTS];
    uint32_t (*bins)[BINS];                 /* of each part: primitives by distance */
    struct member (*members)[MOST_OF_PART]; /* of each part, by rising number in the scene */
    double (*room)[6];                      /* arrays of the part that is built */
    accel_geometry *geometries;             /* of it */
    uint32_t bounded;                       /* primitives of the scene */
    accel_box bounds;                       /* of these */
    double scale, least, excess;            /* of triangles that may be cut: see wide_split.h */
    bool cut;                               /* they are */
};

static struct member member_of(const accel_scene *scene, uint32_t id)
{
    struct member m = {0, id};
    while (m.place >= accel_primitives_in(&scene->geometries[m.geometry]))
        m.place -= accel_primitives_in(&scene->geometries[m.geometry++]);
    return m;
}

static bool centre_of(const accel_geometry *g, uint32_t i, double centre[3])
{
    accel_box box;
    if (!accel_primitives_bounded(g, i, &box))
        return false;
    for (int k = 0; k < 3; k++)
        centre[k] = 0.5 * box.lo[k] + 0.5 * box.hi[k];
    return true;
}

static uint32_t bin_of(const struct part *part, const double centre[3])
{
    double distance = 0.0;
    uint64_t bits;
    for (int k = 0; k < 3; k++)
        distance = fmax(distance, fabs(centre[k] - part->at[k]));
    memcpy(&bits, &distance, sizeof bits);
    return (uint32_t)(bits >> SHIFT);
}

/* Draws the primitives, one from each stretch of numbers; one that is not bounded gives way to the
 * next that is. False: there are none. */
static bool draw(struct parts *p, uint32_t total)
{
    for (uint32_t i = 0; i < PARTS; i++) {
        /* Fixed, so that an estimate can be had again; spread within the stretch by the golden
         * ratio. */
        const double at = (i + fmod(0.5 + i * 0.6180339887498949, 1.0)) / PARTS;
        uint32_t id = (uint32_t)(at * total), tried = 0;
        struct member m = member_of(p->scene, id);
        while (!centre_of(&p->scene->geometries[m.geometry], m.place, p->part[i].at)) {
            if (++tried == total)
                return false;
            id = id + 1 < total ? id + 1 : 0;
            m = member_of(p->scene, id);
        }
    }
    return true;
}

/* What a pass does with a bounded primitive. */
typedef void visit_member(struct parts *p, struct member m, const double centre[3]);

static bool pass(struct parts *p, visit_member *visit)
{
    enum { TICK = 4096 };
    for (uint32_t g = 0; g < p->scene->count; g++) {
        const accel_geometry *from = &p->scene->geometries[g];
        for (uint32_t i = 0; i < accel_primitives_in(from); i++) {
            double centre[3];
            if (centre_of(from, i, centre))
                visit(p, (struct member){g, i}, centre);
            if (i % TICK == 0 && !accel_build_tick(p->build, 0.0))
                return false;
        }
    }
    return true;
}

static void count_distance(struct parts *p, struct member m, const double centre[3])
{
    accel_box box;
    if (accel_primitives_bounded(&p->scene->geometries[m.geometry], m.place, &box))
        box_add(&p->bounds, &box);
    p->bounded++;
    for (int i = 0; i < PARTS; i++)
        p->bins[i][bin_of(&p->part[i], centre)]++;
}

static void gather(struct parts *p, struct member m, const double centre[3])
{
    for (int i = 0; i < PARTS; i++) {
        struct part *part = &p->part[i];
        if (part->count < MOST_OF_PART && bin_of(part, centre) <= part->last)
            p->members[i][part->count++] = m;
    }
}

static void add_excess(struct parts *p, struct member m, const double centre[3])
{
    const accel_geometry *from = &p->scene->geometries[m.geometry];
    double vertices[9];
    accel_box box;
    (void)centre;
    if (from->type == ACCEL_TRIANGLES && accel_primitives_triangle(from, m.place, vertices, &box))
        p->excess += wide_split_excess(vertices, &box, p->scale, p->least);
}

/* Are triangles cut in a wide tree over the whole? A little sooner than the build says so, as boxes
 * are not padded here. */
static bool see_whether_cut(struct parts *p)
{
    double largest = 0.0;
    accel_box scaled;
    for (int k = 0; k < 3; k++)
        largest = fmax(largest, fmax(fabs(p->bounds.lo[k]), fabs(p->bounds.hi[k])));
    p->scale = wide_scale(largest);
    for (int k = 0; k < 3; k++) {
        scaled.lo[k] = p->bounds.lo[k] * p->scale;
        scaled.hi[k] = p->bounds.hi[k] * p->scale;
    }
    p->least = 0.999 * wide_split_least(&scaled, (double)p->bounded);
    if (!pass(p, add_excess))
        return false;
    p->cut = p->excess >= 0.999 * SPLIT_OVERLAP * box_area(&scaled);
    return true;
}

static void choose_distances(struct parts *p)
{
    for (int i = 0; i < PARTS; i++) {
        uint32_t sum = p->bins[i][0];
        while (sum < PART && p->part[i].last + 1 < BINS)
            sum += p->bins[i][++p->part[i].last];
    }
}

/* ---------------------------------------------------------------------- a part as a scene ---- */

/* Copies what the geometry needs of one primitive to its place among `room`. */
static void copy_member(const accel_geometry *from, uint32_t place, void *room, uint32_t to)
{
    if (from->type == ACCEL_TRIANGLES) {
        memcpy((uint32_t *)room + 3 * (size_t)to, from->triangles.indices + 3 * (size_t)place,
               3 * sizeof(uint32_t));
    } else if (from->type == ACCEL_SPHERES) {
        const size_t stride = from->spheres.stride ? from->spheres.stride : 4 * sizeof(double);
        memcpy((double *)room + 4 * (size_t)to,
               (const char *)from->spheres.spheres + place * stride, 4 * sizeof(double));
    } else {
        ((accel_box *)room)[to] = from->objects.boxes[place];
    }
}

static void set_arrays(accel_geometry *g, void *room, uint32_t count)
{
    if (g->type == ACCEL_TRIANGLES) {
        g->triangles.indices = room;
        g->triangles.count = count;
    } else if (g->type == ACCEL_SPHERES) {
        g->spheres.spheres = room;
        g->spheres.stride = 0;
        g->spheres.count = count;
    } else {
        g->objects.boxes = room;
        g->objects.count = count;
    }
}

/* Members of one geometry stand together. A scene of several geometries has several here too, as
 * primitives then note theirs. */
static accel_scene make_part(struct parts *p, int number)
{
    const struct member *m = p->members[number];
    const uint32_t count = p->part[number].count;
    uint32_t made = 0;
    for (uint32_t i = 0, end; i < count; i = end) {
        const accel_geometry *from = &p->scene->geometries[m[i].geometry];
        for (end = i; end < count && m[end].geometry == m[i].geometry; end++)
            copy_member(from, m[end].place, p->room[i], end - i);
        p->geometries[made] = *from;
        set_arrays(&p->geometries[made++], p->room[i], end - i);
    }
    if (made == 1 && p->scene->count > 1)
        p->geometries[made++] = (accel_geometry){.type = ACCEL_SPHERES};
    return (accel_scene){p->geometries, made};
}

/* ------------------------------------------------------------------------------ measuring ---- */

/* What one primitive takes, mean and sum of squares over parts. */
struct mean {
    double sum, squares;
};

static void add_to(struct mean *m, double x)
{
    m->sum += x;
    m->squares += x * x;
}

/* Of `count` primitives, from above. */
static double upper(const struct mean *m, double count)
{
    const double mean = m->sum / PARTS;
    const double variance = fmax(0.0, (m->squares / PARTS - mean * mean) / (PARTS - 1));
    return count * (mean * (1.0 + MARGIN) + ERRORS * sqrt(variance));
}

/* What does not grow with the primitives. */
static double fixed_bytes(const struct accel_kind *kind, uint32_t geometries)
{
    return (double)kind->size + (double)geometries * sizeof(struct geometry);
}

/* *wide: it is a wide tree. */
static bool measure(struct build *build, const accel_scene *scene, const char *config,
                    accel_info *info, bool *wide)
{
    accel *a;
    accel_hooks hooks = *build->hooks;
    hooks.memory_limit = 0;
    hooks.progress = NULL;
    if (accel_build(&a, scene, config, &hooks, build->error) != ACCEL_OK)
        return false;
    accel_describe(a, info);
    *wide = a->fast != NULL;
    accel_free(a);
    return true;
}

static bool measure_parts(struct parts *p, const struct accel_kind *kind, const char *config,
                          uint32_t total, accel_size *size)
{
    struct mean bytes = {0}, peak = {0};
    for (int i = 0; i < PARTS; i++) {
        const accel_scene scene = make_part(p, i);
        accel_info info;
        bool wide;
        if (!measure(p->build, &scene, config, &info, &wide))
            return false;
        const double fixed = fixed_bytes(kind, scene.count), count = p->part[i].count;
        const bool whole = wide && p->cut && (double)info.references <= count;
        const double raise = whole ? 1.0 + SPLIT_BUDGET : 1.0;
        add_to(&bytes, ((double)info.bytes - fixed) / count * raise);
        add_to(&peak, ((double)info.peak_bytes - fixed) / count * raise);
    }
    /* who is left out has a box and vertices nevertheless, in most kinds */
    const double left_out = (double)(total - p->bounded) * (sizeof(accel_box) + 9 * sizeof(double));
    const double fixed = fixed_bytes(kind, p->scene->count) + left_out;
    size->bytes = (uint64_t)(fixed + upper(&bytes, p->bounded));
    size->peak_bytes = (uint64_t)(fixed + upper(&peak, p->bounded));
    return true;
}

static bool estimate_parts(struct parts *p, const struct accel_kind *kind, const char *config,
                           uint32_t total, accel_size *size)
{
    memset(p->bins, 0, PARTS * sizeof *p->bins);
    if (!pass(p, count_distance))
        return false;
    choose_distances(p);
    return see_whether_cut(p) && pass(p, gather) && measure_parts(p, kind, config, total, size);
}

/* Gives the parts room, in one block, and estimates. */
static bool estimate_large(struct parts *p, const struct accel_kind *kind, const char *config,
                           uint32_t total, accel_size *size)
{
    const size_t bins = PARTS * sizeof *p->bins, members = PARTS * sizeof *p->members,
                 room = MOST_OF_PART * sizeof *p->room,
                 geometries = (MOST_OF_PART + 1) * sizeof *p->geometries;
    const size_t bytes = bins + members + room + geometries;
    char *block = accel_memory_resize(p->build->memory, NULL, 0, bytes);
    if (!block)
        return accel_build_no_memory(p->build);
    p->room = (void *)block;
    p->geometries = (void *)(block + room);
    p->members = (void *)(block + room + geometries);
    p->bins = (void *)(block + room + geometries + members);
    const bool fine = estimate_parts(p, kind, config, total, size);
    accel_memory_resize(p->build->memory, block, bytes, 0);
    return fine;
}

/* ------------------------------------------------------------------------------- by config ---- */

static bool estimate_kind(struct build *build, const accel_scene *scene,
                          const struct accel_kind *kind, const char *config, uint32_t total,
                          accel_size *size)
{
    struct parts p = {.build = build, .scene = scene, .bounds = box_empty()};
    if (total > WHOLE && draw(&p, total))
        return estimate_large(&p, kind, config, total, size);
    accel_info info;
    bool wide;
    if (!measure(build, scene, config, &info, &wide))
        return false;
    *size = (accel_size){info.bytes, info.peak_bytes, true};
    return true;
}

/* The largest of the kinds that may be chosen. */
static bool estimate_choice(struct build *build, const accel_scene *scene, uint32_t total,
                            accel_size *size)
{
    accel_size all = {0, 0, false};
    for (size_t i = 0; accel_kind_list[i]; i++) {
        const struct accel_kind *kind = (const struct accel_kind *)accel_kind_list[i];
        if (kind->choose)
            continue;
        if (!estimate_kind(build, scene, kind, kind->info.name, total, size))
            return false;
        all.bytes = size->bytes > all.bytes ? size->bytes : all.bytes;
        all.peak_bytes = size->peak_bytes > all.peak_bytes ? size->peak_bytes : all.peak_bytes;
    }
    *size = all;
    return true;
}

/* In the default floating-point environment: see environment.h. */
__attribute__((noinline)) static bool estimate(struct build *build, const accel_scene *scene,
                                               const char *config, accel_size *size)
{
    double option[MAX_OPTIONS];
    uint32_t total;
    const struct accel_kind *kind = accel_config_parse(config, option, build->error);
    if (!kind)
        return false;
    build->kind = kind->info.name;
    accel_build_phase(build, "estimate");
    build->last_tick = build->phase_start;
    if (!accel_primitives_check(build, scene, &total))
        return false;
    return kind->choose && total > WHOLE ? estimate_choice(build, scene, total, size)
                                         : estimate_kind(build, scene, kind, config, total, size);
}

accel_status accel_estimate(const accel_scene *scene, const char *config, const accel_hooks *hooks,
                            accel_size *size, accel_error *error)
{
    static const accel_hooks no_hooks = {.user = NULL};
    accel_error ignored;
    accel_info info = {.kind = ""};
    error = error ? error : &ignored;
    hooks = hooks ? hooks : &no_hooks;
    *error = (accel_error){.status = ACCEL_OK};
    if (size)
        *size = (accel_size){0, 0, false};
    if (!size || !scene || (scene->count > 0 && !scene->geometries))
        return accel_error_set(error, ACCEL_BAD_ARGUMENT, "estimate: %s is NULL; nothing was built",
                               !size    ? "size"
                               : !scene ? "scene"
                                        : "scene.geometries");
    struct memory m = {.resize = hooks->resize ? hooks->resize : accel_memory_system,
                       .user = hooks->user};
    struct build build = {.memory = &m, .info = &info, .hooks = hooks, .error = error};
    const fenv_t callers = environment_enter();
    if (!estimate(&build, scene, config, size))
        *size = (accel_size){0, 0, false};
    environment_leave(&callers);
    return error->status;
}
