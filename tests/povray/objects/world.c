/* SPDX-License-Identifier: Apache-2.0 */
#include "world.h"

#include <stdlib.h>

/* Sizes 1e-3 to 1e4, then those that POV-Ray takes for infinite: from volumes of 2e10 to sides of
 * 1e6 and more, but within its MAX_DISTANCE of 1e7. */
static const double scales[] = {1.0, 1e-3, 1e-2, 0.1, 10.0, 1e2, 1e3, 1e4, 1e5, 8e5};

static double draw_decade(struct rng *d, int lo, int hi)
{
    return scales[0] * pow(10.0, (double)lo + rng_below(d, (uint32_t)(hi - lo + 1)));
}

struct world draw_world(uint64_t seed)
{
    struct rng d = rng_from(seed, 0);
    const uint32_t count = sizeof scales / sizeof scales[0];
    const uint64_t which = seed % (count + 2);
    struct world world = {.mixed = which >= count};

    world.scale = world.mixed ? 1.0 : scales[which];
    /* In large worlds a shadow ray meets one and the same surface for hours, as the solver errs by
     * more than the ray steps on. */
    world.dark = world.scale > 1e4 || seed % 4 == 2;
    world.photons = seed % 5 == 3 && !world.dark;
    /* Far away in half of the worlds, but not so far that rays end. */
    const bool far = rng_chance(&d, 0.5) && world.scale <= 1e3;
    const double distance = far ? world.scale * draw_decade(&d, 0, 3) : 0.0;
    for (int i = 0; i < 3; i++) {
        world.offset[i] = distance * rng_range(&d, -1.0, 1.0);
    }
    return world;
}

static struct placement identity(void)
{
    return (struct placement){{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}};
}

static void apply(struct placement *p, double m[4][3])
{
    double product[4][3];

    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 3; j++) {
            product[i][j] = i == 3 ? m[3][j] : 0.0;
            for (int k = 0; k < 3; k++) {
                product[i][j] += p->matrix[i][k] * m[k][j];
            }
        }
    }
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 3; j++) {
            p->matrix[i][j] = product[i][j];
        }
    }
}

static void apply_scale(struct placement *p, const double scale[3])
{
    double m[4][3] = {{scale[0], 0, 0}, {0, scale[1], 0}, {0, 0, scale[2]}, {0, 0, 0}};
    apply(p, m);
}

/* About x, then y, then z, as POV-Ray turns. */
static void apply_rotation(struct placement *p, const double degrees[3])
{
    for (int axis = 0; axis < 3; axis++) {
        const int j = (axis + 1) % 3, k = (axis + 2) % 3;
        const double angle = degrees[axis] * 3.14159265358979323846 / 180.0;
        struct placement turn = identity();
        turn.matrix[j][j] = turn.matrix[k][k] = cos(angle);
        turn.matrix[j][k] = sin(angle);
        turn.matrix[k][j] = -sin(angle);
        apply(p, turn.matrix);
    }
}

static void write_matrix(struct writer *w, double m[4][3])
{
    write_text(w, " matrix <");
    for (int i = 0; i < 12; i++) {
        write_text(w, i > 0 ? ", %.9g" : "%.9g", m[i / 3][i % 3]);
    }
    write_text(w, ">");
}

struct placement write_placement(struct writer *w, const struct world *world)
{
    struct rng *d = &w->rng;
    const double scale = world->mixed ? draw_decade(d, -3, 4) : world->scale;
    const double reach = world->mixed ? 20.0 * scale : 4.0 * scale;
    double factor[3], degrees[3], at[3];
    struct placement p = identity();

    if (rng_chance(d, 0.2)) { /* sheared */
        struct placement shear = identity();
        shear.matrix[1][0] = draw_number(w, -1.0, 1.0);
        shear.matrix[2][1] = draw_number(w, -1.0, 1.0);
        write_matrix(w, shear.matrix);
        apply(&p, shear.matrix);
    }
    const bool uniform = rng_chance(d, 0.5), thin = rng_chance(d, 0.1);
    for (int i = 0; i < 3; i++) {
        factor[i] = uniform && i > 0 ? factor[0] : scale * rng_range(d, 0.3, 1.2);
    }
    factor[1] *= thin ? 0.003 : 1.0;
    w->thin += thin;
    factor[2] *= rng_chance(d, 0.1) ? -1.0 : 1.0;
    write_text(w, " scale ");
    write_vector(w, factor);
    apply_scale(&p, factor);
    if (rng_chance(d, 0.7)) {
        draw_rotation(w, degrees);
        write_text(w, " rotate ");
        write_vector(w, degrees);
        apply_rotation(&p, degrees);
    }
    for (int i = 0; i < 3; i++) {
        at[i] = world->offset[i] + reach * rng_range(d, -1.0, 1.0);
        p.matrix[3][i] += at[i];
    }
    write_text(w, " translate ");
    write_vector(w, at);
    return p;
}

/* ---- rays ---- */

static void place(const struct placement *p, const double local[3], double out[3])
{
    for (int j = 0; j < 3; j++) {
        out[j] = p->matrix[3][j];
        for (int i = 0; i < 3; i++) {
            out[j] += local[i] * p->matrix[i][j];
        }
    }
}

static double length(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static void draw_in_ball(struct rng *d, double radius, double v[3])
{
    do {
        for (int i = 0; i < 3; i++) {
            v[i] = rng_range(d, -1.0, 1.0);
        }
    } while (length(v) > 1.0 || length(v) < 0.01);
    for (int i = 0; i < 3; i++) {
        v[i] *= radius;
    }
}

/* From where to what is looked, around the object: from outside, from inside, from afar, along an
 * axis of the world. */
static void draw_ray(struct rng *d, const struct placement *p, double from[3], double to[3])
{
    const double kind = rng_unit(d);
    double local[3], target[3];

    draw_in_ball(d, 1.3, target);
    place(p, target, to);
    draw_in_ball(d, 1.0, local);
    const double away = kind < 0.15 ? 1.0 : (kind < 0.2 ? 200.0 : 3.0) / length(local);
    for (int i = 0; i < 3; i++) {
        local[i] *= away;
    }
    place(p, local, from);
    if (kind > 0.7) {
        const uint32_t axis = rng_below(d, 3);
        const double sign = rng_chance(d, 0.5) ? 1.0 : -1.0;
        double way[3] = {from[0] - to[0], from[1] - to[1], from[2] - to[2]};
        const double far = sign * length(way);
        for (uint32_t i = 0; i < 3; i++) {
            from[i] = to[i] + (i == axis ? far : 0.0);
        }
    }
}

/* A face with that middle and normal. POV-Ray keeps its corners in float: it is so large that this
 * turns the normal by less than the object's size as seen from there. */
static void face_of_ray(const double from[3], const double to[3], double corner[3][3])
{
    double way[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]}, u[3], v[3];
    const double far = length(way);
    int least = 0;

    for (int i = 0; i < 3; i++) {
        way[i] /= far;
        least = fabs(way[i]) < fabs(way[least]) ? i : least;
    }
    double axis[3] = {0.0, 0.0, 0.0};
    axis[least] = 1.0;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        u[i] = way[j] * axis[k] - way[k] * axis[j];
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        v[i] = way[j] * u[k] - way[k] * u[j];
    }
    for (int i = 0; i < 3; i++) {
        corner[0][i] = from[i] + far * u[i];
        corner[1][i] = from[i] + far * (-0.5 * u[i] - v[i]);
        corner[2][i] = from[i] + far * (-0.5 * u[i] + v[i]);
    }
}

bool add_rays(struct ray_list *list, struct rng *rng, const struct placement *placement, int count)
{
    const size_t needed = list->count + (size_t)count;

    if (needed > list->room) {
        const size_t room = 2 * needed;
        void *grown = realloc(list->corners, 3 * room * sizeof list->corners[0]);
        if (grown == NULL) {
            return false;
        }
        list->corners = grown;
        list->room = room;
    }
    for (; list->count < needed; list->count++) {
        double from[3], to[3];
        draw_ray(rng, placement, from, to);
        face_of_ray(from, to, &list->corners[3 * list->count]);
    }
    return true;
}

void write_rays(struct writer *w, const struct ray_list *list)
{
    write_text(w, "#declare Rays = mesh2 {\nvertex_vectors { %zu", 3 * list->count);
    for (size_t i = 0; i < 3 * list->count; i++) {
        write_text(w, ",\n");
        write_vector(w, list->corners[i]);
    }
    write_text(w, "\n}\nface_indices { %zu", list->count);
    for (size_t i = 0; i < list->count; i++) {
        write_text(w, ",\n<%zu, %zu, %zu>", 3 * i, 3 * i + 1, 3 * i + 2);
    }
    write_text(w, "\n}\n}\n");
}
