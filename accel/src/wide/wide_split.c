/* SPDX-License-Identifier: Apache-2.0
 *
 * Cutting large triangles into parts: see wide_split.h.
 *
 * How many parts each gets: in proportion to the root of what its box has more surface than what
 * its plane cuts out of the box, so many that there are SPLIT_BUDGET times as many references more
 * as primitives; none where boxes of all triangles together are not much larger than the scene's
 * (SPLIT_OVERLAP), as on meshes of small triangles, where parts take memory and save little.
 * Measured: LOG.md.
 */
#include "wide_split.h"

#include <math.h>
#include <string.h>

#include "../core/box.h"

/* Parts of a triangle at most; cuts above each other at most; primitives between two ticks. */
enum { MOST = 255, CUTS = 80, TICK = 16384 };

/* ------------------------------------------------------------------------------- planes ---- */

struct split_plane accel_wide_split_plane(const double vertices[9], double scale,
                                          const accel_box *padded)
{
    double a[3], b[3], first[3];
    struct split_plane p = {.offset = 0.0};
    const double side = box_longest(padded) * scale;
    for (int k = 0; k < 3; k++) {
        first[k] = vertices[k] * scale;
        a[k] = vertices[3 + k] * scale - first[k];
        b[k] = vertices[6 + k] * scale - first[k];
    }
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        p.normal[k] = a[i] * b[j] - a[j] * b[i];
        p.offset += p.normal[k] * first[k];
    }
    p.slab = SPLIT_SLAB(side);
    return p;
}

/* On each axis exactly as far as the other two let the plane go. */
bool accel_wide_split_tighten(const struct split_plane *p, accel_box *cell)
{
    const accel_box from = *cell;
    double least[3], most[3];
    for (int k = 0; k < 3; k++) {
        const double lo = p->normal[k] * from.lo[k], hi = p->normal[k] * from.hi[k];
        least[k] = lo < hi ? lo : hi;
        most[k] = lo < hi ? hi : lo;
    }
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        if (p->normal[k] == 0.0)
            continue;
        const double a = (p->offset - p->slab - most[i] - most[j]) / p->normal[k];
        const double b = (p->offset + p->slab - least[i] - least[j]) / p->normal[k];
        cell->lo[k] = fmax(from.lo[k], fmin(a, b));
        cell->hi[k] = fmin(from.hi[k], fmax(a, b));
        if (!(cell->lo[k] <= cell->hi[k]))
            return false;
    }
    return true;
}

/* -------------------------------------------------------------------------------- parts ---- */

/* A triangle that is being cut. */
struct cutting {
    const struct wide_split *split;
    struct split_plane plane;
    uint32_t id;
    struct wide_item *out; /* the next */
};

static void put(struct cutting *c, const accel_box *cell, uint32_t count)
{
    accel_box box;
    for (int k = 0; k < 3; k++) {
        box.lo[k] = (cell->lo[k] - SPLIT_PAD) / c->split->w->scale;
        box.hi[k] = (cell->hi[k] + SPLIT_PAD) / c->split->w->scale;
    }
    for (; count > 0; count--)
        *c->out++ = accel_wide_item_of(c->split->w, &box, c->id);
}

/* The coarsest of the planes that halve the scene again and again, through the inside of a cell;
 * else the longest side's middle. */
static int find_cut(const struct wide_split *s, const accel_box *cell, double *at)
{
    int axis = 0, level = -1;
    for (int k = 0; k < 3; k++)
        if (cell->hi[k] - cell->lo[k] > cell->hi[axis] - cell->lo[axis])
            axis = k;
    *at = 0.5 * (cell->lo[axis] + cell->hi[axis]);
    double side = 0.0;
    for (int k = 0; k < 3; k++) {
        const double first = s->bounds.lo[k], unit = (s->bounds.hi[k] - first) * 0x1p-20;
        const double lo = (cell->lo[k] - first) / unit, hi = (cell->hi[k] - first) / unit;
        if (!(lo >= 0.0 && hi <= 0x1.00001p20))
            continue;
        const uint32_t i = (uint32_t)lo, j = (uint32_t)hi;
        const int bit = i == j ? -1 : 31 - __builtin_clz(i ^ j);
        const double plane = bit < 0 ? 0.0 : first + (double)(j >> bit << bit) * unit;
        const bool longer = bit == level && cell->hi[k] - cell->lo[k] > side;
        if (bit >= 0 && (bit > level || longer) && cell->lo[k] < plane && plane < cell->hi[k]) {
            level = bit;
            side = cell->hi[k] - cell->lo[k];
            axis = k;
            *at = plane;
        }
    }
    return axis;
}

/* What a cell is worth in parts. */
static double size_of(const accel_box *cell)
{
    return sqrt(box_area(cell));
}

static void cut(struct cutting *c, const accel_box *cell, uint32_t pieces, int cuts)
{
    double at;
    if (pieces == 1 || cuts == CUTS) {
        put(c, cell, pieces);
        return;
    }
    const int axis = find_cut(c->split, cell, &at);
    accel_box left = *cell, right = *cell;
    left.hi[axis] = right.lo[axis] = at;
    const bool on_left = accel_wide_split_tighten(&c->plane, &left);
    const bool on_right = accel_wide_split_tighten(&c->plane, &right);
    if (!on_left || !on_right) {
        cut(c,
            on_left    ? &left
            : on_right ? &right
                       : cell,
            pieces, on_left || on_right ? cuts + 1 : CUTS);
        return;
    }
    const double sizes = size_of(&left) + size_of(&right);
    const double share = sizes > 0.0 ? size_of(&left) / sizes : 0.5;
    const double of_left = fmax(1.0, fmin(round(pieces * share), pieces - 1.0));
    cut(c, &left, (uint32_t)of_left, cuts + 1);
    cut(c, &right, pieces - (uint32_t)of_left, cuts + 1);
}

static const double *triangle(const struct primitives *p, uint32_t id)
{
    const struct geometry *g = primitives_geometry(p, id);
    return g->type == ACCEL_TRIANGLES ? g->data + 9 * (size_t)(id - g->first) : NULL;
}

uint32_t accel_wide_split_items(const struct wide_split *s, uint32_t id, struct wide_item *out)
{
    const uint32_t pieces = wide_split_pieces(s, id);
    const accel_box *padded = &s->prims->box[id];
    if (pieces == 1) {
        *out = accel_wide_item_of(s->w, padded, id);
        return 1;
    }
    struct cutting c = {.split = s,
                        .plane =
                            accel_wide_split_plane(triangle(s->prims, id), s->w->scale, padded),
                        .id = id,
                        .out = out};
    const accel_box cell = wide_scaled(s->w, padded);
    cut(&c, &cell, pieces, 0);
    return pieces;
}

/* ----------------------------------------------------------------------------- deciding ---- */

static double excess(const struct wide_split *s, uint32_t id)
{
    const double *v = triangle(s->prims, id);
    return v ? wide_split_excess(v, &s->prims->box[id], s->w->scale, s->least) : 0.0;
}

/* The sums of all, and of their roots. */
static bool sum_excess(struct build *build, const struct wide_split *s, double *sum, double *roots)
{
    const struct ids *ids = &s->prims->bounded;
    *sum = *roots = 0.0;
    for (size_t i = 0; i < ids->count; i++) {
        const double e = excess(s, ids->at[i]);
        *sum += e;
        *roots += sqrt(e);
        if (i % TICK == TICK - 1 && !build_step(build, TICK, 0.0))
            return false;
    }
    return true;
}

/* In the order of ids: what is left over of one's share goes to the next. */
static bool share(struct build *build, struct wide *w, struct wide_split *s, double rate)
{
    const struct ids *ids = &s->prims->bounded;
    double carried = 0.0;
    memset(s->pieces, 1, s->prims->count);
    for (size_t i = 0; i < ids->count; i++) {
        const uint32_t id = ids->at[i];
        const double wish = rate * sqrt(excess(s, id));
        const double more = wish > 0.0 ? fmin(floor(wish + carried), MOST - 1) : 0.0;
        carried = fmin(wish + carried - more, 1.0);
        s->pieces[id] = (uint8_t)(1.0 + more);
        if (more > 0.0)
            w->reach = fmax(w->reach, box_longest(&s->prims->box[id]) * w->scale * (1.0 + 0x1p-20));
        if (i % TICK == TICK - 1 && !build_step(build, TICK, 0.0))
            return false;
    }
    return true;
}

bool accel_wide_split(struct build *build, struct wide *w, struct wide_split *s)
{
    const struct primitives *p = &build->a->prims;
    double sum, roots;
    w->reach = 0.0;
    *s = (struct wide_split){.prims = p, .w = w, .bounds = wide_scaled(w, &p->bounds)};
    const bool plain = w->fast && w->scale <= SPLIT_SCALE && w->scale >= 1.0 / SPLIT_SCALE;
    if (!p->triangles || !plain)
        return true;
    s->least = wide_split_least(&s->bounds, (double)p->bounded.count);
    if (!sum_excess(build, s, &sum, &roots))
        return false;
    if (!(sum >= SPLIT_OVERLAP * box_area(&s->bounds) && roots > 0.0))
        return true;
    s->pieces = accel_memory_resize(&build->a->memory, NULL, 0, p->count);
    if (!s->pieces)
        return accel_build_no_memory(build);
    return share(build, w, s, SPLIT_BUDGET * (double)p->bounded.count / roots);
}

void accel_wide_split_free(struct build *build, struct wide_split *s)
{
    if (s->pieces)
        accel_memory_resize(&build->a->memory, s->pieces, s->prims->count, 0);
    s->pieces = NULL;
}

/* -------------------------------------------------------------------------------- walks ---- */

double accel_wide_split_growth(const struct wide *w, const struct query *q)
{
    double most = 0.0, away = 1.0;
    if (w->reach == 0.0)
        return 0.0;
    if (q->point)
        return w->reach / w->scale;
    for (int k = 0; k < 3; k++) {
        most = fmax(most, fabs(q->dir[k]));
        away = fmax(away, fabs(q->org[k]) * w->scale + 1.0);
    }
    if (away <= SPLIT_FAR && most >= 0x1p-500 && most <= 0x1p500)
        return 0.0;
    return (w->reach + 0x1p-47 * away) / w->scale;
}
