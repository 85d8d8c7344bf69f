/* SPDX-License-Identifier: Apache-2.0
 *
 * Several references to one large triangle, each with the box of a part of it: scenes whose
 * triangles are long, or lie across each other, are told apart by no boxes of whole triangles.
 * Before the tree is built, as in Ernst and Greiner, "Early Split Clipping for Bounding Volume
 * Hierarchies", 2007, at the planes of Karras and Aila, "Fast Parallel Construction of High-Quality
 * Bounding Volume Hierarchies", 2013: the coarsest of the halves, quarters, .. of the scene.
 *
 * What must not be cut off: the key of a hit (query.h) lies in S of P', but t of a ray that grazes
 * the triangle may be anywhere in there, also far from the triangle. So it is P' that is cut, at
 * planes, and of each part of it only what is nearer to the triangle's plane than SPLIT_SLAB is
 * kept. Every key is in S of a part, so a walk may pass by all nodes that it may pass by otherwise:
 *
 * All in scaled coordinates (wide.h). Let v = 2^-53, twice that under a directed rounding; C the
 * largest |coordinate| of the triangle, L the longest side of P', at least 2^-10 and less than
 * 2.01 C; n = a x b for two edges, |n_k| <= 2 L^2; D = 1 + |org| <= 2^24 (SPLIT_FAR); K = org + key
 * dir, exactly; s = dir_k / dir_z for the major axis z; x a sheared coordinate as computed, X what
 * it would be without rounding, m the largest |x|. Then |x - X| <= e_k = 2.01 v m + 4.01 v |s| D;
 * let e be that for |s| = 1. Of a hit, the computed x hold the origin between them, for edge
 * functions have the right sign where they are not 0 (triangle.h): hence m <= 2 L + 2 e < 2.01 L,
 * and sum w x = 0 for some weights w, so there is a point Q of the triangle where the ray's line,
 * at tau, is within e_k of it along axis k, and not off along the major axis. Distances are of
 * coordinates.
 *
 * 1. K leaves P' by 11.1 v D at the most: slabs are rounded by 3 v, S is grown by 8 v.
 * 2. If |det| < 2^-24 m^2, as computed, the ray grazes the triangle: so K is near its plane, as is
 *    all of the line in P'. For the true det, n.dir / dir_z, differs from it by 24 v m^2 from the
 *    products and sums and by 12 e m + 6 e^2 from x - X; and K is at most L (1 + 2^-20) before or
 *    behind Q along the major axis; so n.K differs from n.Q by at most
 *        L (1 + 2^-20) (2^-24 m^2 + 24 v m^2 + 12 e m + 6 e^2) + 6 e L^2
 *        < 2^-21.9 L^3 + 40 e L^2 < 2^-21.8 L^3 + 2^-20.6 L^2.
 * 3. Else t is right: by the proof of "no clamp" (wide_leaf.h), the line at t is within d = 12 v
 * m^3 / |det| + 14 v D < 2^-23.3 L + 14 v D of a point of the triangle. (Where edge functions are
 * computed in a longer type they have no error.) If t is in S, so is K. Else, if tau is in S, t is
 * clamped to a key between both; and between two points near a triangle, which is convex, the line
 * is as near to it: K is within the larger of d and e. Else axis k, not the major one, ends S
 * between K, to which t is clamped, and the line at tau, which is off by more than the padding
 * there, 2^-44 C: 256 v C - 2 v C < e_k < 8.2 v C + 4.01 v |s| D; hence |s| D > 60 C, and K is at
 *    most e_k / |s| < 4.2 v D from the line at tau, and 4.2 v D + e from Q. n.K differs from n.Q by
 *    at most 6 d L^2 < 2^-20.7 L^3 + 2^-21.6 L^2.
 * So n.K differs from n.Q by less than 2^-20 L^3 + 2^-20 L^2 (SPLIT_SLAB) in any case, and there is
 * room for n as computed, off by 6 v L^2, for the sums with it, and for 1. P' is the union of the
 * cells that it is cut into: the one that K is in, or nearest to, grown by SPLIT_PAD = 2^-22, holds
 * K when it is cut to the slab; and so does its S the key, whose slabs are rounded by 3 v D.
 *
 * Rays from farther away, and those whose products with dir may underflow, are only known to have K
 * in P', by 1. For them, as for points, the general walk grows boxes by the longest side of P' of
 * any triangle that is cut (`reach`), so that each part is as large as P', and by 64 v D. Scales
 * are such that nothing else underflows.
 */
#ifndef ACCEL_WIDE_SPLIT_H
#define ACCEL_WIDE_SPLIT_H

#include <math.h>

#include "../core/box.h"
#include "wide.h"

/* See above. */
#if !defined(SPLIT_SLAB) /* a test makes them too small */
#define SPLIT_SLAB(side) ((side) * (side) * ((side)*0x1p-20 + 0x1p-20))
#endif
#if !defined(SPLIT_PAD)
#define SPLIT_PAD 0x1p-22
#endif
#define SPLIT_FAR 0x1p24

/* The shortest triangle that is cut, and the scales of trees that have some. */
#define SPLIT_LEAST 0x1p-10
#define SPLIT_SCALE 0x1p300

/* Which triangles are cut, into how many parts. */
struct wide_split {
    const struct primitives *prims;
    const struct wide *w;
    accel_box bounds; /* of the scene, scaled */
    double least;     /* side of a triangle that is cut */
    uint8_t *pieces;  /* by id; NULL: nothing is cut */
};

/* Decides, and notes it in w. False: see build->error. */
bool accel_wide_split(struct build *build, struct wide *w, struct wide_split *split);

void accel_wide_split_free(struct build *build, struct wide_split *split);

/* Into how many parts a primitive is cut: items that it becomes. */
static inline uint32_t wide_split_pieces(const struct wide_split *s, uint32_t id)
{
    return s->pieces ? s->pieces[id] : 1;
}

/* Makes them. Returns how many. */
uint32_t accel_wide_split_items(const struct wide_split *s, uint32_t id, struct wide_item *out);

/* By how much the general walk must grow a tree's boxes, in the scene's coordinates: see above. */
double accel_wide_split_growth(const struct wide *w, const struct query *q);

/* Triangles are cut where their boxes have so many times the surface of the scene's more than what
 * their planes cut out of them, into so many parts more than there are primitives. */
#define SPLIT_OVERLAP 8.0
#define SPLIT_BUDGET  0.6

/* The shortest side of a triangle that is cut, of so many primitives in a box: parts of triangles
 * that are not much larger than the space between them come to one leaf again. Here, as the next,
 * because estimates need it, also where no kind has a wide form. */
#define SPLIT_CELLS 3.0
static inline double wide_split_least(const accel_box *scaled, double count)
{
    double volume = 1.0;
    for (int k = 0; k < 3; k++)
        volume *= scaled->hi[k] - scaled->lo[k];
    return fmax(SPLIT_LEAST, SPLIT_CELLS * cbrt(volume / count));
}

/* How much more surface a triangle's box has than its plane in the box, scaled; 0 if it is not cut:
 * nothing can be taken off the box of a triangle across an axis, or without a surface. */
static inline double wide_split_excess(const double v[9], const accel_box *box, double scale,
                                       double least)
{
    double a[3], b[3], normal[3], square = 0.0;
    accel_box scaled;
    for (int k = 0; k < 3; k++) {
        a[k] = (v[3 + k] - v[k]) * scale;
        b[k] = (v[6 + k] - v[k]) * scale;
        scaled.lo[k] = box->lo[k] * scale;
        scaled.hi[k] = box->hi[k] * scale;
    }
    if (!(box_longest(&scaled) >= least))
        return 0.0;
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        normal[k] = a[i] * b[j] - a[j] * b[i];
        square += normal[k] * normal[k];
    }
    /* the plane's part in the box is no larger than the box's side allows, seen along any axis */
    double flat = box_area(&scaled);
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const double face = (scaled.hi[i] - scaled.lo[i]) * (scaled.hi[j] - scaled.lo[j]);
        flat = fmin(flat, face * sqrt(square) / fabs(normal[k]));
    }
    return box_area(&scaled) - flat;
}

/* A triangle, and the part of a cell near its plane. */
struct split_plane {
    double normal[3], offset, slab;
};
struct split_plane accel_wide_split_plane(const double vertices[9], double scale,
                                          const accel_box *padded);

/* Cuts the cell to what is near the plane. False: nothing is. */
bool accel_wide_split_tighten(const struct split_plane *p, accel_box *cell);

/* A box, scaled. */
static inline accel_box wide_scaled(const struct wide *w, const accel_box *box)
{
    accel_box scaled;
    for (int k = 0; k < 3; k++) {
        scaled.lo[k] = box->lo[k] * w->scale;
        scaled.hi[k] = box->hi[k] * w->scale;
    }
    return scaled;
}

#endif
