/* SPDX-License-Identifier: Apache-2.0 */
#include "tree.h"

#include "shapes.h"

#include <string.h>

int written_shapes[64];

enum { UNION, MERGE, INTERSECTION, DIFFERENCE, OPERATIONS, PARTS = 4 };

static const char *const operation_names[OPERATIONS] = {"union", "merge", "intersection",
                                                        "difference"};

/* ---- what is bounded ---- */

static void invert_reach(struct reach *r)
{
    const struct extent own = r->own;

    r->own = r->inverse;
    r->inverse = own;
    r->takes_apart = false;
}

/* A clip leaves what lies inside it. */
static void clip_extent(struct extent *e, const struct extent *clip)
{
    e->surface = e->surface || clip->inside;
    e->inside = e->inside || clip->inside;
    e->outside = e->outside && clip->outside;
}

static void clip_reach(struct reach *r, const struct reach *clip)
{
    clip_extent(&r->own, &clip->own);
    clip_extent(&r->inverse, &clip->own);
    r->clipped = true;
    r->takes_apart = false;
}

static struct reach reach_of_shape(const struct shape *shape)
{
    const bool finite = (shape->traits & SHAPE_FINITE) != 0;
    const bool solid = (shape->traits & SHAPE_SOLID) != 0;

    return (struct reach){.own = {.surface = finite, .inside = solid},
                          .inverse = {.surface = finite, .outside = solid}};
}

/* Surfaces count where they are inside all other parts of an intersection, outside those of a
 * merge. */
static bool is_kept_bounded(const struct extent *parts, int count, int part, bool merge)
{
    bool bounded = parts[part].surface;

    for (int i = 0; i < count; i++) {
        bounded = bounded || (i != part && (merge ? parts[i].outside : parts[i].inside));
    }
    return bounded;
}

static struct extent extent_of_union(int operation, const struct extent *parts, int count)
{
    struct extent e = {.surface = true, .inside = true};

    for (int i = 0; i < count; i++) {
        e.surface = e.surface && (operation == MERGE ? is_kept_bounded(parts, count, i, true)
                                                     : parts[i].surface);
        e.inside = e.inside && parts[i].inside;
        e.outside = e.outside || parts[i].outside;
    }
    return e;
}

static struct extent extent_of_intersection(const struct extent *parts, int count)
{
    struct extent e = {.surface = true, .outside = true};

    for (int i = 0; i < count; i++) {
        e.surface = e.surface && is_kept_bounded(parts, count, i, false);
        e.inside = e.inside || parts[i].inside;
        e.outside = e.outside && parts[i].outside;
    }
    return e;
}

/* A difference has all parts but the first inverted already. */
static struct reach reach_of_csg(int operation, const struct reach *parts, int count)
{
    struct extent own[PARTS], inverse[PARTS];
    struct reach r = {.takes_apart = operation == UNION};

    for (int i = 0; i < count; i++) {
        own[i] = parts[i].own;
        inverse[i] = parts[i].inverse;
        r.unbounded_parts += unbounded_objects(&parts[i]);
    }
    if (operation == UNION || operation == MERGE) {
        r.own = extent_of_union(operation, own, count);
        r.inverse = extent_of_intersection(inverse, count);
    } else {
        r.own = extent_of_intersection(own, count);
        r.inverse = extent_of_union(MERGE, inverse, count);
    }
    return r;
}

int unbounded_objects(const struct reach *reach)
{
    return reach->takes_apart ? reach->unbounded_parts : !reach->own.surface;
}

/* ---- modifiers ---- */

static void write_transform(struct writer *w)
{
    static const char *const transforms[] = {
        " translate @p / 2",
        " rotate @a",
        " scale 0.5 + @u",
        " scale <0.4 + @u, 0.4 + @u, 0.4 + @u>",
        " scale <-1, 1, 0.6 + @u>",
        " matrix <1, @s / 2, @s / 3, @s / 3, 1, @s / 2, 0, @s / 3, 1, @s / 4, 0, @s / 4>",
        " transform { rotate @a translate @p / 3 inverse }"};

    write_pattern(w, transforms[rng_below(&w->rng, sizeof transforms / sizeof transforms[0])]);
}

static void write_clip(struct writer *w, struct reach *reach, int depth)
{
    const bool link = rng_chance(&w->rng, 0.1) && !reach->clipped && reach->bounded;
    const int count = rng_chance(&w->rng, 0.2) ? 2 : 1;

    if (reach->linked) {
        return;
    }
    if (link) {
        /* The bound clips now; what it is was not kept. */
        write_text(w, " clipped_by { bounded_by }");
        reach->clipped = reach->linked = true;
        reach->own.outside = reach->inverse.outside = reach->takes_apart = false;
        return;
    }
    write_text(w, " clipped_by { ");
    for (int i = 0; i < count; i++) {
        const struct reach clip = write_tree(w, depth, -1, true);
        write_text(w, " } ");
        clip_reach(reach, &clip);
    }
    if (rng_chance(&w->rng, 0.3)) {
        write_transform(w);
    }
    write_text(w, " }");
}

/* Mostly bounds that hold the object, sometimes ones that do not. */
static void write_bound(struct writer *w, struct reach *reach, int depth)
{
    const double kind = rng_unit(&w->rng);

    if (reach->linked) {
        return;
    }
    if (kind < 0.2 && reach->clipped && !reach->bounded) {
        write_text(w, " bounded_by { clipped_by }");
        reach->linked = true;
    } else if (kind < 0.6) {
        write_pattern(w, " bounded_by { sphere { @p / 4, 1.5 + @u } }");
    } else {
        write_text(w, " bounded_by { ");
        write_tree(w, depth, -1, true);
        write_text(w, " } }");
    }
    reach->bounded = true;
}

void write_modifiers(struct writer *w, struct reach *reach, int depth)
{
    const uint32_t count = rng_below(&w->rng, 5);

    depth = w->budget > 0 ? depth : 0;
    for (uint32_t i = 0; i < count; i++) {
        const double kind = rng_unit(&w->rng);
        if (kind < 0.15) {
            write_text(w, " inverse");
            invert_reach(reach);
        } else if (kind < 0.3 && depth > 0) {
            write_clip(w, reach, depth - 1);
        } else if (kind < 0.4 && depth > 0) {
            write_bound(w, reach, depth - 1);
        } else {
            write_transform(w);
        }
    }
}

/* ---- objects ---- */

static int draw_shape(struct writer *w, bool plain)
{
    int which;

    do {
        which = (int)rng_below(&w->rng, (uint32_t)shape_count);
    } while (plain && (shapes[which].traits & SHAPE_PATCH));
    return which;
}

static struct reach write_shape(struct writer *w, int which)
{
    const struct shape *shape = &shapes[which];

    if (shape->write != NULL) {
        shape->write(w);
    } else {
        write_pattern(w, shape->pattern);
    }
    if (shape->traits & SHAPE_STURM) {
        write_pattern(w, " [sturm]");
    }
    if ((shape->traits & SHAPE_HIERARCHY) && rng_chance(&w->rng, 0.2)) {
        write_text(w, " hierarchy off");
    }
    if (strncmp(shape->name, "mesh", 4) == 0) { /* POV-Ray's tree in them may lose hits */
        write_text(w, " #ifdef (Trees_Off) hierarchy off #end");
    }
    w->budget--;
    w->loose += (shape->traits & SHAPE_LOOSE) != 0;
    written_shapes[which] += w->out != NULL;
    return reach_of_shape(shape);
}

static void write_own_texture(struct writer *w, bool plain)
{
    if (!plain && rng_chance(&w->rng, 0.1)) {
        write_pattern(w, " pigment { rgb @c transmit 0.6 }");
    }
}

static struct reach write_csg(struct writer *w, int depth, int wanted, bool plain)
{
    const int operation = (int)rng_below(&w->rng, OPERATIONS);
    const int room = w->budget < PARTS ? w->budget : PARTS;
    const int count = 1 + (int)rng_below(&w->rng, (uint32_t)room);
    const int place = (int)rng_below(&w->rng, (uint32_t)count);
    struct reach parts[PARTS];

    write_text(w, "%s { ", operation_names[operation]);
    for (int i = 0; i < count; i++) {
        parts[i] = write_tree(w, depth - 1, i == place ? wanted : -1, plain);
        write_own_texture(w, plain);
        write_text(w, " } ");
        if (operation == DIFFERENCE && i > 0) {
            invert_reach(&parts[i]);
        }
    }
    return reach_of_csg(operation, parts, count);
}

struct reach write_tree(struct writer *w, int depth, int wanted, bool plain)
{
    const bool csg = depth > 0 && w->budget > 1 && rng_chance(&w->rng, 0.5);
    struct reach reach;

    if (csg) {
        reach = write_csg(w, depth, wanted, plain);
    } else {
        reach = write_shape(w, wanted >= 0 ? wanted : draw_shape(w, plain));
    }
    write_modifiers(w, &reach, depth);
    return reach;
}
