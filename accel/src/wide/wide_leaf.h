/* SPDX-License-Identifier: Apache-2.0
 *
 * Several triangles of a block at once, in double: the test of triangle.c, operation by operation
 * in the same order, so that what a lane computes has the same bits. Included by the file of an
 * instruction set after `lanes`, LANES of doubles, and their operations.
 *
 * Lemma "no clamp". The rule of query.h clamps t into S(P'). Let v = 2^-53, C the largest
 * |coordinate| of a triangle, L the longest side of its box, D = 8 C. If
 * 1. the three edge functions e, as computed, have one strict sign,
 * 2. |det| and |scaled| lie within (2^-900, 2^900),
 * 3. |det| >= L^3 / C,
 * 4. |org| <= 7 C on every axis, hence |vertex - org| <= D,
 * then t lies in S(P') before that is cut to (tmin, tmax), so its clamped value is t if that is
 * inside (tmin, tmax), and no hit otherwise: the box need not be asked.
 * Proof. Write X for what a sheared coordinate would be without rounding, and x for it as computed:
 * |x - X| <= 4.01 v D + v |x|, as |shear| <= 1. With weights w = e / (sum of e), exactly,
 *     o_x + t d_x - sum w p_x = - sum w X + (error of t) d_x.
 * The error of t is at most 9.1 v D / |d_z|: three roundings in each z, three in each term of
 * `scaled`, whose factors e have one sign, two in det, one in the quotient.
 * The exact edge functions E of the computed points fulfil sum E x = 0, and |e - E| <= 4 v m^2 with
 * m the largest |x| or |y|: so |sum w x| <= 12 v m^3 / |det|. The computed points hold the origin
 * between them, for the sign of e is right where it is not 0; hence |x| is at most the difference
 * of two of them, and m <= 2 L + 8.1 v D = 2 L + 65 v C. So, in units of v C, |o_x + t d_x - sum w
 * p_x| is at most
 * - for L >= 4096: 12 * 8.2 from m^3 / |det|, 33 from x - X, 73 from t: 205;
 * - for L >= 128: 12 * 15.8, 33 and 73: 296;
 * - for L < 128: m itself, which |sum w x| does not exceed, 321, 33 and 73: 427;
 * and 73 on the major axis, where only t has an error. sum w p_x lies between the vertices, and P'
 * begins 2^-44 C = 512 v C before the first of them, but for v (C + 2^-44 C) by which that is
 * rounded. What the slabs are rounded by, 3 v, is less than the growth of S, 8 v, relatively. An
 * axis with d = 0 asks the same of o_x itself. Underflow, or flushing to zero, adds at most 2^-1022
 * to any term, and by 2. C is at least 2^-455.
 */
#include "../primitive/sphere.h"

/* Which lanes hold something of a block, from the `from`-th on. */
static inline uint32_t lanes_there(const struct wide_block *b, uint32_t from)
{
    return b->count - from < LANES ? (1u << (b->count - from)) - 1 : (1u << LANES) - 1;
}

struct corners {
    lanes x[3], y[3], z[3]; /* sheared, as struct sheared in triangle.c */
};

static inline void shear_corner(const struct leaf_ray *l, lanes px, lanes py, lanes pz,
                                struct corners *c, uint32_t i)
{
    const lanes z = lanes_sub(pz, lanes_all(l->org[2]));
    c->x[i] = lanes_sub(lanes_sub(px, lanes_all(l->org[0])), lanes_mul(lanes_all(l->shear[0]), z));
    c->y[i] = lanes_sub(lanes_sub(py, lanes_all(l->org[1])), lanes_mul(lanes_all(l->shear[1]), z));
    c->z[i] = z;
}

/* Keeps the hit of one lane if it is the best so far. */
static inline bool take(struct wide_fast *f, double t, uint32_t id, const double *e1,
                        const double *e2, const double *det, uint32_t lane)
{
    if (t > f->best || (t == f->best && id >= f->id))
        return false;
    f->best = f->t = t;
    f->id = id;
    f->u = e1[lane];
    f->v = e2[lane];
    f->weights = det[lane];
    return true;
}

/* The triangles of a block from the `from`-th on. True if the best hit became better. */
__attribute__((always_inline)) static inline bool test_triangles(struct wide_fast *f,
                                                                 const struct wide_block *b,
                                                                 const struct corners *c,
                                                                 uint32_t from, bool any)
{
    const struct leaf_ray *l = &f->leaf;
    const lanes *x = c->x, *y = c->y;
    const lanes e0 = lanes_sub(lanes_mul(x[2], y[1]), lanes_mul(y[2], x[1]));
    const lanes e1 = lanes_sub(lanes_mul(x[0], y[2]), lanes_mul(y[0], x[2]));
    const lanes e2 = lanes_sub(lanes_mul(x[1], y[0]), lanes_mul(y[1], x[0]));
    const lanes least = lanes_min(lanes_min(e0, e1), e2), most = lanes_max(lanes_max(e0, e1), e2);
    const lanes zero = lanes_all(0.0);
    const uint32_t *ids = wide_block_ids(b) + from;
    const uint32_t there = lanes_there(b, from) & ~lanes_with_id(ids, f->skip);
    uint32_t hit = (lanes_at_most(zero, least) | lanes_at_most(most, zero)) & there;
    if (__builtin_expect(hit == 0, 1))
        return false;
    const lanes det = lanes_add(lanes_add(e0, e1), e2), shear = lanes_all(l->shear[2]);
    const lanes scaled = lanes_add(lanes_add(lanes_mul(e0, lanes_mul(shear, c->z[0])),
                                             lanes_mul(e1, lanes_mul(shear, c->z[1]))),
                                   lanes_mul(e2, lanes_mul(shear, c->z[2])));
    const lanes t = lanes_div(scaled, det);
    const lanes size = lanes_abs(det), numerator = lanes_abs(scaled);
    const uint32_t strict = lanes_less(zero, least) | lanes_less(most, zero);
    const uint32_t safe = lanes_less(lanes_all(0x1p-900), lanes_min(size, numerator)) &
                          lanes_less(lanes_max(size, numerator), lanes_all(0x1p900));
    const uint32_t large = lanes_at_most(lanes_all((double)b->least_det), size);
    const uint32_t inside = lanes_less(lanes_all(f->tmin), t) & lanes_less(t, lanes_all(f->tmax)) &
                            lanes_at_most(t, lanes_all(f->best));
    uint32_t decided = strict & safe & large;
    if (__builtin_expect(!(l->far <= (double)b->far_origin), 0))
        decided = 0;
    uint32_t slow = hit & ~decided;
    hit &= decided & inside;
    bool better = false;
    if (hit) {
        _Alignas(64) double ts[LANES], e1s[LANES], e2s[LANES], dets[LANES];
        lanes_store(ts, t);
        lanes_store(e1s, e1);
        lanes_store(e2s, e2);
        lanes_store(dets, det);
        for (; hit && !(any && better); hit &= hit - 1) {
            const uint32_t i = (uint32_t)__builtin_ctz(hit);
            better |= take(f, ts[i], ids[i], e1s, e2s, dets, i);
        }
    }
    for (; __builtin_expect(slow != 0, 0) && !(any && better); slow &= slow - 1)
        better |= accel_wide_test_slowly(f, b, from + (uint32_t)__builtin_ctz(slow));
    return better;
}

/* Several spheres of a block: the roots of sphere.c, operation by operation.
 *
 * Lemma "no clamp" of spheres. With C the largest |coordinate| of a sphere's box, r its radius, if
 * 1. r^2 - n^2, the discriminant as computed, is not negative, and all squares are in sphere.c's
 *    safe range,
 * 2. |org| <= 7 C on every axis, and r >= 2^-40 C,
 * 3. root^2 >= 2^-44 r^2 a, for the root with which c is divided,
 * then both t lie in S(P') before that is cut to (tmin, tmax): what matters of the sphere is the
 * first t inside, as it is.
 *
 * Let F = org - centre, |F| <= 13.9 C in space, f the same as computed, N the point of the line
 * that is nearest to the centre, t0 where that is, h^2 = r^2 - n^2. In units of v = 2^-53: the
 * computed n differs from N by 8 |f| along the line, which enters its square squared only, and by
 * 3 |f| in any direction. So N^2 + h^2 - r^2 is at most 6 |f| r + 12 r^2, and (11 |f|)^2 v.
 * - second = root / a lies at t0 +- h but for 13 |f| + 9 r, along the line. A point that lies e
 *   farther along it than the surface leaves that by at most e h / r + e^2 / 2r: in all, with h <=
 *   r, 3 |f| + 6 r + 13 |f| + 9 r <= 238 C, and 4 C of squares, as r >= 2^-40 C.
 * - first = c / root. As root times (b -+ s) / a differs from c by at most 10 |f|^2 + 4 |f| r + 12
 *   r^2 (of c 4 |f|^2 + 2 r^2, of b^2 6 |f|^2, of a n^2 4 |f| r + 4 r^2, of a h^2 6 r^2), first
 *   differs from it by that over |root| / |dir|, which is at least h, and if |f| > 2 r at least
 *   0.86 |f|: then by 18 |f|, else off the surface by (20 + 4 + 12 / 2) |f|, less than 61 C; and by
 *   2 |f|, 4 |f| + 3 r for b and s, 3 |f| + 6 r as above: in all less than 386 C. Its square over
 *   2 r is at most 4 C by 3.
 * P' begins 512 C before the sphere, but for 3 C by which the box is rounded; what the slabs are
 * rounded by is less than the growth of S.
 *
 * Of the sphere that the ray leaves only second counts, if b > 0; else that is at most 0, so at
 * most tmin, and no hit: the rule of sphere.c, but where the ray grazes it. */
struct spheres {
    lanes centre[3], radius;
};

static inline bool take_sphere(struct wide_fast *f, const double t[2], uint32_t id)
{
    const double near = t[0] < t[1] ? t[0] : t[1], far = t[0] < t[1] ? t[1] : t[0];
    const double first = f->tmin < near && near < f->tmax ? near : far;
    if (!(f->tmin < first && first < f->tmax) || first > f->best ||
        (first == f->best && id >= f->id))
        return false;
    f->best = f->t = first;
    f->id = id;
    f->u = f->v = 0.0;
    f->weights = 1.0;
    return true;
}

__attribute__((always_inline)) static inline bool test_spheres(struct wide_fast *f,
                                                               const struct wide_block *b,
                                                               const struct spheres *s,
                                                               uint32_t from, bool any)
{
    const double *org = f->caller->org, *dir = f->caller->dir;
    const lanes minus = lanes_all(-0.0), r = s->radius, a = lanes_all(f->leaf.square);
    const lanes f0 = lanes_sub(lanes_all(org[0]), s->centre[0]);
    const lanes f1 = lanes_sub(lanes_all(org[1]), s->centre[1]);
    const lanes f2 = lanes_sub(lanes_all(org[2]), s->centre[2]);
    const lanes d0 = lanes_all(dir[0]), d1 = lanes_all(dir[1]), d2 = lanes_all(dir[2]);
    const lanes along =
        lanes_add(lanes_add(lanes_mul(f0, d0), lanes_mul(f1, d1)), lanes_mul(f2, d2));
    const lanes square =
        lanes_add(lanes_add(lanes_mul(f0, f0), lanes_mul(f1, f1)), lanes_mul(f2, f2));
    const lanes rr = lanes_mul(r, r), sum = lanes_add(square, rr);
    const lanes back = lanes_sub(minus, along), part = lanes_div(back, a);
    const lanes n0 = lanes_add(f0, lanes_mul(part, d0));
    const lanes n1 = lanes_add(f1, lanes_mul(part, d1));
    const lanes n2 = lanes_add(f2, lanes_mul(part, d2));
    const lanes discriminant = lanes_sub(
        rr, lanes_add(lanes_add(lanes_mul(n0, n0), lanes_mul(n1, n1)), lanes_mul(n2, n2)));
    const uint32_t *ids = wide_block_ids(b) + from;
    const uint32_t there = lanes_there(b, from), left = lanes_with_id(ids, f->skip) & there;
    const uint32_t safe =
        f->leaf.safe ? lanes_less(lanes_all(0x1p-400), sum) & lanes_less(sum, lanes_all(0x1p400))
                     : 0;
    const uint32_t grazes =
        left & lanes_less(lanes_abs(discriminant), lanes_mul(lanes_all(SPHERE_GRAZING), rr));
    uint32_t slow = (there & ~safe) | grazes;
    uint32_t hit = lanes_at_most(lanes_all(0.0), discriminant) & there & ~slow;
    if (__builtin_expect((hit | slow) == 0, 1))
        return false;
    const lanes root =
        lanes_add(back, lanes_with_sign(lanes_sqrt(lanes_mul(a, discriminant)), back));
    const lanes one = lanes_div(lanes_sub(square, rr), root), other = lanes_div(root, a);
    const uint32_t large =
        lanes_at_most(lanes_mul(lanes_mul(lanes_all(0x1p-44), rr), a), lanes_mul(root, root));
    const uint32_t decided = f->leaf.far <= (double)b->far_origin ? large : 0;
    const uint32_t ahead = ~left | lanes_less(lanes_all(0.0), back);
    _Alignas(64) double ones[LANES], others[LANES];
    bool better = false;
    slow |= hit & ~decided;
    lanes_store(ones, one);
    lanes_store(others, other);
    for (hit &= decided & ahead; hit && !(any && better); hit &= hit - 1) {
        const uint32_t i = (uint32_t)__builtin_ctz(hit);
        const double t[2] = {left >> i & 1 ? others[i] : ones[i], others[i]};
        better |= take_sphere(f, t, ids[i]);
    }
    for (; slow != 0 && !(any && better); slow &= slow - 1)
        better |= accel_wide_test_slowly(f, b, from + (uint32_t)__builtin_ctz(slow));
    return better;
}
