/* SPDX-License-Identifier: Apache-2.0
 *
 * Checks the copied scene: that no number of it was overwritten, and that each primitive is in the
 * list that its box says.
 */
#include "primitives.h"

#include <stdlib.h>

#include "../core/box.h"
#include "../core/error.h"
#include "../core/seal.h"

static bool broken(accel_error *error, const char *what, size_t number)
{
    accel_error_set(error, ACCEL_BROKEN, "scene: %s %zu", what, number);
    return false;
}

static uint64_t geometry_seal(const struct primitives *p)
{
    return seal_bytes(p->geometry, p->geometry_count * sizeof *p->geometry);
}

void accel_primitives_seal(struct primitives *p)
{
    p->geometry_seal = geometry_seal(p);
}

static bool check_geometries(const struct primitives *p, accel_error *error)
{
    if (geometry_seal(p) != p->geometry_seal)
        return broken(error, "overwritten since it was built, the table of geometries,",
                      p->geometry_count);
    for (uint32_t g = 0; p->geometry_of && g < p->geometry_count; g++)
        for (uint32_t i = 0; i < p->geometry[g].count; i++)
            if (p->geometry_of[p->geometry[g].first + i] != g)
                return broken(error, "of another geometry than it is said to be, primitive",
                              p->geometry[g].first + i);
    return true;
}

static bool check_boxes(const struct primitives *p, accel_error *error)
{
    uint64_t sum = 0;
    for (uint32_t id = 0; id < p->count; id++)
        sum += seal_primitive(id, &p->box[id], PRIMITIVES_BOX_WORDS);
    return sum == p->box_seal ||
           broken(error, "overwritten since they were built, boxes,", p->count);
}

/* Does the list go on with the id? */
static bool next_is(const struct ids *list, size_t *at, uint32_t id)
{
    return *at < list->count && list->at[(*at)++] == id;
}

static bool check_lists(const struct primitives *p, accel_error *error)
{
    size_t bounded = 0, unbounded = 0;
    for (uint32_t id = 0; id < p->count; id++) {
        const accel_box *b = &p->box[id];
        if (b->lo[0] <= b->hi[0] && !(isinf(b->lo[0]) ? next_is(&p->unbounded, &unbounded, id)
                                                      : next_is(&p->bounded, &bounded, id)))
            return broken(error, "not in the list where it should be, primitive", id);
    }
    return (bounded == p->bounded.count && unbounded == p->unbounded.count) ||
           broken(error, "too long, lists of primitives,", p->bounded.count + p->unbounded.count);
}

static bool check_data(const struct primitives *p, accel_error *error)
{
    uint64_t sum = 0;
    for (size_t i = 0; i < p->bounded.count; i++) {
        const uint32_t id = p->bounded.at[i];
        const struct geometry *g = primitives_geometry(p, id);
        const size_t words = primitives_words(g);
        if (words > 0)
            sum += seal_primitive(id, g->data + words * (id - g->first), words);
    }
    return sum == p->data_seal ||
           broken(error, "overwritten since they were built, triangles or spheres,", p->count);
}

bool accel_primitives_validate(const struct primitives *p, accel_error *error)
{
    return check_geometries(p, error) &&
           (p->left || (check_boxes(p, error) && check_lists(p, error) && check_data(p, error)));
}

uint32_t *accel_primitives_meeting(const struct primitives *p, const uint32_t *ids, size_t count,
                                   const accel_box *cell, size_t *kept, accel_error *error)
{
    uint32_t *list = malloc((count ? count : 1) * sizeof *list);
    if (!list) {
        accel_error_set(error, ACCEL_NO_MEMORY, "validate: no memory for %zu ids", count);
        return NULL;
    }
    *kept = 0;
    for (size_t i = 0; i < count; i++)
        if (box_overlaps(&p->box[ids[i]], cell))
            list[(*kept)++] = ids[i];
    return list;
}
