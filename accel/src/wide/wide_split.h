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
 * All in scaled coordinates (wide.h). Let v = 2^-53, twice that under a directed rounding; L the
 * longest side of P', n = a x b for two edges of the triangle, |n_k| <= 2 L^2; D = 1 + |org|, and
 * D <= 2^16; K = org + key dir, exactly; x a sheared coordinate as computed, X what it would be
 * without rounding, |x - X| <= e = 4.01 v D + v m, m the largest |x| or |y|. Of a hit the computed
 * x hold the origin between them, for edge functions have the right sign where they are not 0
 * (triangle.h): hence m <= 2 L + 8.1 v D, and sum w x = 0 for some weights w, so that the ray's
 * line is within e of a point Q of the triangle, where t = tau. All distances are of coordinates.
 *
 * 1. K leaves P' by 11.1 v D at the most: S is that of the slabs, each rounded by 3 v, grown by 8 v.
 * 2. If |det| < 2^-24 m^2, as computed, the ray grazes the triangle: K is in its plane, as is all of
 *    the line in P'. For the true det, n.dir / dir_z, differs from it by 24 v m^2 from the products
 *    and sums and by 12 e m + 6 e^2 from x - X; and K differs from the line's point at tau by at
 *    most L (1 + 2^-20) along the major axis; so n.K differs from n.Q by at most
 *        L (1 + 2^-20) (2^-24 m^2 + 24 v m^2 + 12 e m + 6 e^2) + 6 e L^2
 *        < 2^-21.9 L^3 + 40 e L^2 < 2^-21.9 L^3 + 2^-28.6 L^2.
 * 3. Else t is right: by the lemma "no clamp" (wide_leaf.h), the line's point at t is within
 *    d = 12 v m^3 / |det| + 14 v D < 2^-23.3 L + 28 v D of a point of the triangle. (Where the edge
 *    functions are computed in a longer type, they are right in full.) If tau is in S, then a t
 *    that is not is clamped to a key between both; between two points near a triangle, which is
 *    convex, the line is as near to it: K is within the larger of d and e. n.K differs from n.Q by
 *    at most 6 d L^2 < 2^-20.7 L^3 + 2^-28.5 L^2.
 *    tau is in S where e + 3 v D is less than the padding of P', 2^-44 of its largest |coordinate|,
 *    hence where that is at least SPLIT_AWAY and |org| <= SPLIT_NEAR: 2 (7.01 * 5 + 4) v < 127 v.
 * 4. Else both may be clamped to the same end of S, where axis k ends it: less than (e + 11.1 v D) /
 *    |dir_k| after tau, so K is within 15.2 v D (1 + r) of Q, r the largest |dir| by the least that
 *    is not 0 (one that is 0 ends nothing). Where that is less than 2^-21, parts are grown by more;
 *    other rays take the general walk, which grows boxes by as much (accel_wide_split_growth).
 * So n.K differs from n.Q by less than 2^-20 L^3 + 2^-28 L^2 (SPLIT_SLAB), which also has room for
 * n as computed, off by 6 v L^2, and for the sums with it; and the part that K is in, or nearest to
 * which it is, grown by SPLIT_PAD = 2^-20, holds K. What its slabs are rounded by, 3 v D, is less.
 * Rays whose products with dir may underflow, and from farther away, are only known to have K in
 * P': then, as for points, boxes are grown by the longest side of P' of any triangle that is cut
 * (`reach`), so that each part is as large as P'. Scales are such that nothing else underflows.
 */
#ifndef ACCEL_WIDE_SPLIT_H
#define ACCEL_WIDE_SPLIT_H

#include "wide.h"

/* See above. */
#if !defined(SPLIT_SLAB) /* a test makes them too small */
#define SPLIT_SLAB(side) ((side) * (side) * ((side)*0x1p-20 + 0x1p-28))
#endif
#if !defined(SPLIT_PAD)
#define SPLIT_PAD 0x1p-20
#endif
#define SPLIT_AWAY 0.25
#define SPLIT_NEAR 4.0
#define SPLIT_FAR  0x1p16

/* The shortest triangle that is cut, and the scales of trees that have some. */
#define SPLIT_LEAST 0x1p-10
#define SPLIT_SCALE 0x1p300

/* Which triangles are cut, into how many parts. */
struct wide_split {
    const struct primitives *prims;
    const struct wide *w;
    accel_box bounds; /* of the scene, scaled */
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

/* Does a tree whose triangles are cut pass the ray in its fast walks, though it comes from farther
 * away than SPLIT_NEAR? far: the sum of |org|, scaled. */
bool accel_wide_split_serves(double far, const double dir[3]);

/* How many times a line through the scene meets a triangle's box in vain, and more. Both the build
 * and what is told before it (estimate.c) ask whether it is too often. */
#define SPLIT_OVERLAP 8.0
#define SPLIT_BUDGET  0.6

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
