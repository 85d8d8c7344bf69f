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
 * p_x| is at most L >= 4096: 12 * 8.2 from m^3 / |det|, 33 from x - X, 73 from t: 205; L >=  128:
 * 12 * 15.8, 33 and 73: 296; L <   128: m itself, which |sum w x| does not exceed, 321, 33 and 73:
 * 427; and 73 on the major axis, where only t has an error. sum w p_x lies between the vertices,
 * and P' begins 2^-44 C = 512 v C before the first of them, but for v (C + 2^-44 C) by which that
 * is rounded. What the slabs are rounded by, 3 v, is less than the growth of S, 8 v, relatively. An
 * axis with d = 0 asks the same of o_x itself. Underflow, or flushing to zero, adds at most 2^-1022
 * to any term, and by 2. C is at least 2^-455.
 */

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
    if (id == f->skip || t > f->best || (t == f->best && id >= f->id))
        return false;
    f->best = t;
    f->id = id;
    f->u = e1[lane] / det[lane];
    f->v = e2[lane] / det[lane];
    return true;
}

/* The triangles of a block from the `from`-th on. True if the best hit became better. */
__attribute__((always_inline)) static inline bool test_lanes(struct wide_fast *f,
                                                             const struct wide_block *b,
                                                             const struct corners *c, uint32_t from,
                                                             bool any)
{
    const struct leaf_ray *l = &f->leaf;
    const lanes *x = c->x, *y = c->y;
    const lanes e0 = lanes_sub(lanes_mul(x[2], y[1]), lanes_mul(y[2], x[1]));
    const lanes e1 = lanes_sub(lanes_mul(x[0], y[2]), lanes_mul(y[0], x[2]));
    const lanes e2 = lanes_sub(lanes_mul(x[1], y[0]), lanes_mul(y[1], x[0]));
    const lanes least = lanes_min(lanes_min(e0, e1), e2), most = lanes_max(lanes_max(e0, e1), e2);
    const lanes zero = lanes_all(0.0);
    const uint32_t there =
        b->count - from < LANES ? (1u << (b->count - from)) - 1 : (1u << LANES) - 1;
    uint32_t hit =
        (lanes_compare(least, zero, _CMP_GE_OQ) | lanes_compare(most, zero, _CMP_LE_OQ)) & there;
    if (__builtin_expect(hit == 0, 1))
        return false;
    const lanes det = lanes_add(lanes_add(e0, e1), e2), shear = lanes_all(l->shear[2]);
    const lanes scaled = lanes_add(lanes_add(lanes_mul(e0, lanes_mul(shear, c->z[0])),
                                             lanes_mul(e1, lanes_mul(shear, c->z[1]))),
                                   lanes_mul(e2, lanes_mul(shear, c->z[2])));
    const lanes t = lanes_div(scaled, det);
    const lanes size = lanes_abs(det), numerator = lanes_abs(scaled);
    const uint32_t strict =
        lanes_compare(least, zero, _CMP_GT_OQ) | lanes_compare(most, zero, _CMP_LT_OQ);
    const uint32_t safe =
        lanes_compare(lanes_min(size, numerator), lanes_all(0x1p-900), _CMP_GT_OQ) &
        lanes_compare(lanes_max(size, numerator), lanes_all(0x1p900), _CMP_LT_OQ);
    const uint32_t large = lanes_compare(size, lanes_all((double)b->least_det), _CMP_GE_OQ);
    const uint32_t inside = lanes_compare(t, lanes_all(f->tmin), _CMP_GT_OQ) &
                            lanes_compare(t, lanes_all(f->tmax), _CMP_LT_OQ) &
                            lanes_compare(t, lanes_all(f->best), _CMP_LE_OQ);
    uint32_t decided = strict & safe & large;
    if (__builtin_expect(!(l->far <= (double)b->far_origin), 0))
        decided = 0;
    uint32_t slow = hit & ~decided;
    hit &= decided & inside;
    bool better = false;
    if (hit) {
        _Alignas(64) double ts[LANES], e1s[LANES], e2s[LANES], dets[LANES];
        const uint32_t *ids = wide_block_ids(b) + from;
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
