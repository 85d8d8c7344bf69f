/* SPDX-License-Identifier: Apache-2.0
 *
 * The scene's primitives, copied into flat arrays. Every primitive has one number, its id: the
 * geometries laid end to end, so that the order of ids is the order of (geometry, primitive), and
 * a tie between two hits goes to the lower id. Skipped primitives keep their ids.
 *
 * The padded box P' of each primitive is computed once and stored: computed again under another
 * rounding mode it could leave the cells that were built around it.
 */
#ifndef ACCEL_PRIMITIVES_H
#define ACCEL_PRIMITIVES_H

#include "accel/accel.h"
#include "../core/memory.h"

struct build;

/* A list of ids. */
struct ids {
    uint32_t *at;           /* count of them */
    size_t count, capacity; /* an array of memory.h */
};

/* One geometry. A triangle is 9 doubles (three vertices), a sphere 4 (centre, radius). */
struct geometry {
    accel_type type;
    accel_order order;          /* of objects; triangles and spheres are ordered by key */
    uint32_t first;             /* id of its primitive 0 */
    uint32_t count;             /* primitives */
    double *data;               /* the triangles or spheres, NULL for objects */
    accel_intersect *intersect; /* of objects */
    void *user;                 /* of objects */
    double cost;                /* of objects: nanoseconds of a call; 0: not known */
};

struct primitives {
    struct geometry *geometry; /* geometry_count of them, by first id */
    uint32_t geometry_count;   /* of the scene */
    uint32_t *geometry_of;     /* by id; NULL if there is but one geometry */
    accel_box *box;            /* P' by id; empty (lo > hi) if skipped, endless if unbounded; NULL
                                  if the kind makes them again: see accel_primitives_leave */
    uint32_t count;            /* ids */
    struct ids bounded;        /* what structures are built over, rising */
    struct ids unbounded;      /* objects with an infinite side, rising */
    accel_box bounds;          /* around the padded boxes of all that is bounded */
    bool triangles;            /* there are some */
    bool only_triangles;       /* no spheres, no objects */
    bool only_floats;          /* nothing but triangles whose coordinates are floats */
    bool by_key;               /* no objects whose hits are ordered as reported */
    bool left;                 /* the kind alone has the triangles: see accel_primitives_leave */
    uint64_t box_seal;         /* over all boxes: see seal.h */
    uint64_t data_seal;        /* over the triangles and spheres that are bounded */
    uint64_t geometry_seal;    /* over the geometries, once all is built */
    double test_cost;          /* mean cost of a test: see cost.h */
};

/* Copies and checks the scene, filling the counts in build->info. False: see build->error. */
bool accel_primitives_copy(struct build *build, struct primitives *p, const accel_scene *scene);

/* What accel_primitives_copy checks before it allocates anything for the primitives: arrays and
 * indices of the whole scene, and how many primitives there are. False: see build->error. */
bool accel_primitives_check(struct build *build, const accel_scene *scene, uint32_t *count);

/* How many primitives a geometry has. */
uint32_t accel_primitives_in(const accel_geometry *geometry);

/* The box of one of its primitives, not padded. False if it is not bounded, or left out. */
bool accel_primitives_bounded(const accel_geometry *geometry, uint32_t i, accel_box *box);

/* The vertices of a triangle, as they are copied, and its box. False if it is not bounded, or left
 * out. */
bool accel_primitives_triangle(const accel_geometry *geometry, uint32_t i, double vertices[9],
                               accel_box *box);

/* Where there are only bounded triangles, and the kind keeps their vertices: frees boxes and the
 * list of ids (not its count), for good, and returns how many bytes that were; then the vertices.
 */
size_t accel_primitives_leave_boxes(struct memory *m, struct primitives *p);
void accel_primitives_leave(struct memory *m, struct primitives *p);

/* Notes the geometries as they now are. */
void accel_primitives_seal(struct primitives *p);

/* Is all as it was built, and does every list hold what it should? All ids and indices are in range
 * then. False: *error says what is not. */
bool accel_primitives_validate(const struct primitives *p, accel_error *error);

/* Those of the ids whose boxes meet a cell, *kept of them in a new array that the caller free()s:
 * for checks. NULL: no memory, and *error says so. */
uint32_t *accel_primitives_meeting(const struct primitives *p, const uint32_t *ids, size_t count,
                                   const accel_box *cell, size_t *kept, accel_error *error);

void accel_primitives_free(struct memory *m, struct primitives *p);

/* Doubles of each of a geometry's primitives. */
static inline size_t primitives_words(const struct geometry *g)
{
    return g->type == ACCEL_TRIANGLES ? 9 : g->type == ACCEL_SPHERES ? 4 : 0;
}

/* Doubles of a box. */
enum { PRIMITIVES_BOX_WORDS = sizeof(accel_box) / sizeof(double) };

static inline const struct geometry *primitives_geometry(const struct primitives *p, uint32_t id)
{
    return p->geometry + (p->geometry_of ? p->geometry_of[id] : 0);
}

/* ACCEL_NONE if nothing has that name. */
static inline uint32_t primitives_id(const struct primitives *p, accel_id name)
{
    if (name.geom >= p->geometry_count || name.prim >= p->geometry[name.geom].count)
        return ACCEL_NONE;
    return p->geometry[name.geom].first + name.prim;
}

static inline accel_id primitives_name(const struct primitives *p, uint32_t id)
{
    const struct geometry *g = primitives_geometry(p, id);
    return (accel_id){(uint32_t)(g - p->geometry), id - g->first};
}

#endif
