/* SPDX-License-Identifier: Apache-2.0
 *
 * Cutting polygons: see polygon.h.
 */
#include "polygon.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How an ear is chosen; the next way is tried where the one before finds none. */
typedef enum rule {
    STRICT,   /* no other corner in its triangle or on its sides */
    FLAT,     /* no area: a corner on a line, the end of a bridge to a hole */
    TOUCHING, /* no other corner within its triangle */
    CONVEX,   /* any convex corner: the polygon is not simple */
    ANY
} rule;

static bool make_room(mesh_cutter *c, size_t count)
{
    if (count <= c->capacity) {
        return true;
    }
    mesh_cutter_free(c);
    c->at = malloc(count * sizeof *c->at);
    c->next = malloc(count * sizeof *c->next);
    c->previous = malloc(count * sizeof *c->previous);
    c->capacity = count;
    if (c->at == NULL || c->next == NULL || c->previous == NULL) {
        mesh_cutter_free(c);
        return false;
    }
    return true;
}

void mesh_cutter_free(mesh_cutter *c)
{
    free(c->at);
    free(c->next);
    free(c->previous);
    c->at = NULL;
    c->next = c->previous = NULL;
    c->capacity = 0;
}

/* The power of two that brings all coordinates below 1; false where one is not finite. */
static bool find_scale(const double *vertices, const uint32_t *corners, uint32_t count, int *power)
{
    double largest = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            const double size = fabs(vertices[3 * (size_t)corners[i] + (size_t)k]);
            if (!isfinite(size)) {
                return false;
            }
            largest = fmax(largest, size);
        }
    }
    frexp(largest, power);
    return true;
}

/* Adds twice the area of a triangle's shadow along each axis, signed. True where there is any. */
static bool add_normal(const double a[3], const double b[3], double normal[3])
{
    bool some = false;
    for (int k = 0; k < 3; k++) {
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        const double area = a[u] * b[v] - a[v] * b[u];
        normal[k] += area;
        some = some || area != 0.0;
    }
    return some;
}

/* Fills c->at so that the polygon goes round to the left. False: it has no area, or is not finite,
 * and any cut will do. */
static bool look_at(mesh_cutter *c, const double *vertices, const uint32_t *corners, uint32_t count)
{
    int power;
    bool some = false;
    double normal[3] = {0.0, 0.0, 0.0}, first[3], before[3] = {0.0, 0.0, 0.0};
    if (!find_scale(vertices, corners, count, &power)) {
        return false;
    }
    for (uint32_t i = 0; i < count; i++) {
        double from_first[3];
        for (int k = 0; k < 3; k++) {
            const double at = ldexp(vertices[3 * (size_t)corners[i] + (size_t)k], -power);
            first[k] = i == 0 ? at : first[k];
            from_first[k] = at - first[k];
        }
        some = (i > 1 && add_normal(before, from_first, normal)) || some;
        memcpy(before, from_first, sizeof before);
    }
    int axis = 0;
    for (int k = 1; k < 3; k++) {
        axis = fabs(normal[k]) > fabs(normal[axis]) ? k : axis;
    }
    const int left = normal[axis] < 0.0, x = (axis + 1 + left) % 3, y = (axis + 2 - left) % 3;
    for (uint32_t i = 0; i < count; i++) {
        const double *at = &vertices[3 * (size_t)corners[i]];
        c->at[i][0] = ldexp(at[x], -power);
        c->at[i][1] = ldexp(at[y], -power);
    }
    c->not_simple += some && normal[axis] == 0.0;
    return normal[axis] != 0.0;
}

/* Above 0 where the way a, b, d turns left. */
static double turn(const mesh_cutter *c, uint32_t a, uint32_t b, uint32_t d)
{
    const double *p = c->at[a], *q = c->at[b], *r = c->at[d];
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

static bool same_place(const mesh_cutter *c, uint32_t a, uint32_t b)
{
    return c->at[a][0] == c->at[b][0] && c->at[a][1] == c->at[b][1];
}

/* Does it turn left everywhere, and once round only: does x change its direction twice? */
static bool is_convex(const mesh_cutter *c, uint32_t count)
{
    uint32_t changes = 0;
    double last = 0.0, first = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t j = i + 1 == count ? 0 : i + 1, k = j + 1 == count ? 0 : j + 1;
        const double step = c->at[j][0] - c->at[i][0];
        if (!(turn(c, i, j, k) >= 0.0)) {
            return false;
        }
        if (step != 0.0) {
            changes += last != 0.0 && (step > 0.0) != (last > 0.0);
            first = first == 0.0 ? step : first;
            last = step;
        }
    }
    return changes + ((first > 0.0) != (last > 0.0)) <= 2;
}

/* Is `to` strictly between the sides of the corner `at`, which go to `right` and to `left`? */
static bool between(const mesh_cutter *c, uint32_t at, uint32_t right, uint32_t left, uint32_t to)
{
    return turn(c, at, right, to) > 0.0 && turn(c, at, to, left) > 0.0;
}

/* A corner r at the place of a corner of the triangle: do the polygon's sides at r enter it? */
static bool enters(const mesh_cutter *c, uint32_t at, uint32_t right, uint32_t left, uint32_t r)
{
    return same_place(c, at, r) &&
           (between(c, at, right, left, c->next[r]) || between(c, at, right, left, c->previous[r]));
}

/* Does corner r keep the triangle p, i, q from being an ear? */
static bool is_in_the_way(const mesh_cutter *c, uint32_t p, uint32_t i, uint32_t q, uint32_t r,
                          rule rule)
{
    if (same_place(c, p, r) || same_place(c, i, r) || same_place(c, q, r)) {
        return enters(c, p, i, q, r) || enters(c, i, q, p, r) || enters(c, q, p, i, r);
    }
    const double a = turn(c, p, i, r), b = turn(c, i, q, r), d = turn(c, q, p, r);
    return rule == STRICT ? a >= 0.0 && b >= 0.0 && d >= 0.0 : a > 0.0 && b > 0.0 && d > 0.0;
}

static bool is_ear(mesh_cutter *c, uint32_t i, rule rule)
{
    const uint32_t p = c->previous[i], q = c->next[i];
    const double area = turn(c, p, i, q);
    if (rule >= CONVEX) {
        return rule == ANY || area > 0.0;
    }
    if (rule == FLAT || !(area > 0.0)) {
        return rule == FLAT && area == 0.0;
    }
    for (uint32_t r = c->next[q]; r != p; r = c->next[r]) {
        c->work++;
        if (is_in_the_way(c, p, i, q, r, rule)) {
            return false;
        }
    }
    return true;
}

static bool is_overworked(const mesh_cutter *c)
{
    return c->most_work != 0 && c->work > c->most_work;
}

/* Finds an ear among the `left` corners from `start` on. ANY always finds one. */
static uint32_t find_ear(mesh_cutter *c, uint32_t start, uint32_t left, rule *found)
{
    for (int rule = STRICT;; rule++) {
        uint32_t i = start;
        for (uint32_t tried = 0; tried < left; tried++, i = c->next[i]) {
            if (is_ear(c, i, (enum rule)rule) || is_overworked(c)) {
                *found = (enum rule)rule;
                return i;
            }
        }
    }
}

static bool cut_ears(mesh_cutter *c, const uint32_t *corners, uint32_t count, uint32_t *triangles)
{
    bool simple = true;
    for (uint32_t i = 0; i < count; i++) {
        c->next[i] = i + 1 == count ? 0 : i + 1;
        c->previous[i] = i == 0 ? count - 1 : i - 1;
    }
    uint32_t start = 1;
    for (uint32_t left = count; left >= 3; left--) {
        rule found;
        const uint32_t i = left == 3 ? start : find_ear(c, start, left, &found);
        const uint32_t p = c->previous[i], q = c->next[i];
        simple = simple && (left == 3 ? turn(c, p, i, q) >= 0.0 : found < CONVEX);
        *triangles++ = corners[p];
        *triangles++ = corners[i];
        *triangles++ = corners[q];
        c->next[p] = q;
        c->previous[q] = p;
        start = c->next[q]; /* not q: its triangle would share the new side, and be thin */
        if (is_overworked(c)) {
            return false;
        }
    }
    c->not_simple += !simple;
    return true;
}

bool mesh_cut(mesh_cutter *c, const double *vertices, const uint32_t *corners, uint32_t count,
              uint32_t *triangles)
{
    if (!make_room(c, count)) {
        return false;
    }
    if (count > 3 && look_at(c, vertices, corners, count) && !is_convex(c, count)) {
        return cut_ears(c, corners, count, triangles);
    }
    for (uint32_t i = 1; i + 1 < count; i++) {
        *triangles++ = corners[0];
        *triangles++ = corners[i];
        *triangles++ = corners[i + 1];
    }
    return true;
}
