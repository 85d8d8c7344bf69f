/* SPDX-License-Identifier: Apache-2.0
 *
 * Cuts a polygon into triangles between its corners, n - 2 of them whatever it looks like.
 *
 * A convex one becomes a fan from its first corner. Another one loses ears (Meisters, "Polygons
 * have ears", 1975), a corner whose triangle holds no other corner; linear time per ear, so that n
 * corners take at most about n^2 steps for simple polygons. It is looked at along the axis that its
 * normal by Newell's method (Sutherland, Sproull and Schumacker 1974) is nearest to: one that is
 * plane is cut rightly, one that crosses itself somehow, which is counted.
 */
#ifndef ACCEL_CLI_MESH_POLYGON_H
#define ACCEL_CLI_MESH_POLYGON_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What cutting needs; starts as zero, ended by mesh_cutter_free. */
typedef struct mesh_cutter {
    double (*at)[2];     /* of each corner, as it is looked at */
    uint32_t *next;      /* corners that are left, in a ring */
    uint32_t *previous;  /* the same, backwards */
    size_t capacity;     /* of each of these */
    uint64_t work;       /* corners that have been compared with ears, of all polygons */
    uint64_t most_work;  /* where to stop; 0: nowhere */
    uint64_t not_simple; /* polygons of which some ear was none */
} mesh_cutter;

/* Writes count - 2 triangles over the polygon's corners, which are indices of vertices: three
 * numbers each. Returns false where memory or most_work does not suffice. */
bool mesh_cut(mesh_cutter *cutter, const double *vertices, const uint32_t *corners, uint32_t count,
              uint32_t *triangles);

void mesh_cutter_free(mesh_cutter *cutter);

#endif
