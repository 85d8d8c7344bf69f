/* SPDX-License-Identifier: Apache-2.0
 *
 * An oracle that shares nothing with the library: one primitive against one ray in 113 bits, with a
 * bound on how far an answer in double may be off. A pair is decided where the bound leaves no
 * doubt.
 *
 * Bounds, with u = 2^-53 (first order, then doubled). Let R be the largest coordinate of a vertex
 * relative to the origin. The shear test computes x = p - o - s z with |s| <= 1: one rounding for
 * each difference, one for s, one for the product, and a sum of size up to 2R, so x is off by at
 * most 6uR = D. An edge function a b - c d of such numbers is off by at most
 * D (|a| + |b| + |c| + |d|) + 3u (|ab| + |cd|) = B. With edge functions e_i and t = sum e_i z_i /
 * sum e_i, an error of d_i in each moves t by sum d_i (z_i - t) / sum e_i; the z_i themselves and
 * the last division add at most 10u max |z_i|. Where a number underflows each rounding adds up to
 * 2^-1074 instead. A t beyond double's range is nobody's: undecided.
 */
#ifndef CASES_EXACT_H
#define CASES_EXACT_H

#include "case_scene.h"

#if defined(__SIZEOF_FLOAT128__)
typedef __float128 quad;
#else
typedef long double quad; /* of 106 bits or more, or the library does not compile either */
#endif

enum verdict { NO_HIT, HIT, UNDECIDED };

struct exact {
    enum verdict verdict;
    quad t;           /* of a hit: exact but for 113 bits */
    quad off;         /* how far a t in double may be off; of an undecided pair see below */
    quad first, last; /* of an undecided pair: no t can lie outside */
};

struct exact exact_triangle(const accel_ray *ray, const double *vertices);

/* A quick way out, in double: true only where exact_triangle says NO_HIT. The double values of the
 * edge functions are within the bound B above of the exact ones, so where two of them are beyond 2B
 * with other signs, the exact ones are beyond B. Where that could over- or underflow it says
 * nothing. */
bool exact_misses(const accel_ray *ray, const double *vertices);

/* The two crossings, the lower first. Both are decided or none is. */
void exact_sphere(const accel_ray *ray, const double *sphere, struct exact out[2]);

/* Of a ray that leaves the sphere: the crossing farther from t = 0. `wide`: as the library has it,
 * which sees rays that graze in wider precision; otherwise as a callback in double may have it,
 * undecided also where the bound leaves open which one is farther. */
struct exact exact_sphere_left(const accel_ray *ray, const double *sphere, bool wide);

#endif
