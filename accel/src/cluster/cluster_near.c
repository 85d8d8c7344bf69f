/* SPDX-License-Identifier: Apache-2.0
 *
 * Clusters by a given connectivity: units (cluster_units.c) of similar size that touch, or are
 * within the gap that is given, become parts.
 *
 * They are connected by hash grids and union-find (cluster_touching.h): one grid for each two
 * octaves of size in a class; each unit is entered into its own and compared with the next coarser
 * one. So sizes may differ along a chain of neighbours, but a teapot does not melt into a hall
 * whose floor it stands on.
 */
#include "cluster_parts.h"
#include "cluster_touching.h"

struct connector {
    struct parts *parts;
    double connectivity;           /* as in cluster_rule */
    double largest[CELLS_OCTAVES]; /* size in each class, in units of the frame */
    struct touching touching;
    ARRAY_OF(uint32_t) order;        /* units by grid, coarse first */
    size_t begin[CELLS_OCTAVES + 1]; /* of each grid in it */
};

static struct memory *memory_of(const struct parts *p)
{
    return &p->build->a->memory;
}

/* Finds the largest size of each class. */
static bool measure(struct connector *k)
{
    const struct parts *p = k->parts;
    for (size_t i = 0; i < p->build->a->prims.bounded.count; i++) {
        const double size = box_longest(parts_box(p, i)) * p->sizes.frame.scale;
        double *largest = &k->largest[p->sizes.class_of[octave_of(size)]];
        *largest = size > *largest ? size : *largest;
        if (!parts_tick(p, i))
            return false;
    }
    return true;
}

/* The grid of a unit. */
static uint32_t unit_grid(const struct parts *p, const struct unit *u)
{
    return accel_sizes_grid(p->sizes.top_of[u->octave], sizes_octave(&p->sizes, &u->box));
}

/* Counting sort of the units by grid. */
static bool sort_units(struct connector *k)
{
    const struct parts *p = k->parts;
    size_t next[CELLS_OCTAVES] = {0}, sum = 0;
    for (size_t i = 0; i < p->units.count; i++)
        next[unit_grid(p, &p->units.at[i])]++;
    for (uint32_t g = 0; g < CELLS_OCTAVES; g++) {
        const size_t here = next[g];
        k->begin[g] = next[g] = sum;
        sum += here;
    }
    k->begin[CELLS_OCTAVES] = sum;
    if (!array_extend(memory_of(p), &k->order, sum))
        return accel_build_no_memory(p->build);
    for (size_t i = 0; i < p->units.count; i++)
        k->order.at[next[unit_grid(p, &p->units.at[i])]++] = (uint32_t)i;
    return true;
}

/* The cells of a grid, or larger ones where the gap needs at least twice itself. */
static struct touch_rule rule_for(const struct connector *k, uint32_t octave, uint32_t grid)
{
    const struct sizes *s = &k->parts->sizes;
    const double gap = k->connectivity * k->largest[s->class_of[octave]];
    const uint32_t widest = octave_of(gap < 0.25 ? 2.0 * gap : 0.5);
    const uint32_t used = grid < widest ? grid : widest;
    return (struct touch_rule){s->class_of[octave], used, 0.5 * gap * (double)(1u << used)};
}

static bool connect_unit(struct connector *k, struct unit *u, uint32_t grid)
{
    const struct parts *p = k->parts;
    const accel_box box = frame_box(&p->sizes.frame, &u->box);
    const struct touch_rule own = rule_for(k, u->octave, grid);
    u->owner = accel_touching_enter(memory_of(p), &k->touching, &box, own);
    if (u->owner == ACCEL_NONE)
        return accel_build_no_memory(p->build);
    if (grid >= SIZES_PER_GRID && k->begin[grid - SIZES_PER_GRID] != k->begin[grid - 1]) {
        const struct touch_rule next = rule_for(k, u->octave, grid - SIZES_PER_GRID);
        if (next.octave != own.octave)
            accel_touching_join(&k->touching, &box, next, u->owner);
    }
    return true;
}

static bool connect_units(struct connector *k)
{
    struct parts *p = k->parts;
    if (!sort_units(k))
        return false;
    for (uint32_t grid = 0; grid < CELLS_OCTAVES; grid++)
        for (size_t i = k->begin[grid]; i < k->begin[grid + 1]; i++)
            if (!connect_unit(k, &p->units.at[k->order.at[i]], grid) || !parts_tick(p, i))
                return false;
    return true;
}

/* Makes a part of each component; number[] is by root group. */
static bool number_parts(struct connector *k, uint32_t *number)
{
    struct parts *p = k->parts;
    memset(number, 0xff, k->touching.groups.count * sizeof *number);
    for (size_t i = 0; i < p->units.count; i++) {
        struct unit *u = &p->units.at[i];
        uint32_t *part = &number[accel_touching_root(&k->touching, u->owner)];
        if (*part == ACCEL_NONE && !accel_parts_new(p, p->sizes.class_of[u->octave], part))
            return false;
        u->owner = *part;
        box_add(&p->part.at[*part].box, &u->box);
        p->part.at[*part].count += u->count;
        if (!parts_tick(p, i))
            return false;
    }
    return true;
}

static bool make_parts(struct connector *k)
{
    struct memory *m = memory_of(k->parts);
    const size_t groups = k->touching.groups.count;
    uint32_t *number = accel_memory_resize(m, NULL, 0, groups * sizeof *number);
    if (!number)
        return accel_build_no_memory(k->parts->build);
    const bool fine = number_parts(k, number);
    accel_memory_resize(m, number, groups * sizeof *number, 0);
    return fine;
}

bool accel_parts_connect(struct parts *p, double connectivity)
{
    struct connector k = {.parts = p, .connectivity = connectivity};
    const bool fine = measure(&k) && connect_units(&k) && make_parts(&k);
    p->visits += k.touching.visits;
    array_free(memory_of(p), &k.order);
    accel_touching_free(memory_of(p), &k.touching);
    return fine;
}
