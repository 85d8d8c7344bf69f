/* SPDX-License-Identifier: Apache-2.0
 *
 * Several triangles of a block at once, in double: the test of triangle.c, operation by operation in
 * the same order, so that what a lane computes has the same bits. Included by the file of an
 * instruction set after `lanes`, LANES of doubles, their operations, and struct leaf_ray.
 *
 * Lemma "no clamp". The rule of query.h clamps t into S(P'). Let a triangle's largest |coordinate|
 * be C and the longest side of its box L, and let D be the largest |org - vertex| on an axis. If
 * 1. the three edge functions, as computed, have one strict sign,
 * 2. |det| and |scaled| lie within [2^-900, 2^900],
 * 3. |det| >= L^3 / C,
 * 4. |org| <= 7 C on every axis, hence D <= 8 C,
 * then t lies strictly within S(P') cut to no interval, so its clamped value is t.
 * Proof: see below.
 */

struct corners {
    lanes x[3], y[3], z[3]; /* sheared, as struct sheared in triangle.c */
};

static inline void shear_corner(const struct leaf_ray *l, lanes px, lanes py, lanes pz,
                                struct corners *c, uint32_t i)
{
    const lanes z = lanes_sub(pz, l->org[2]);
    c->x[i] = lanes_sub(lanes_sub(px, l->org[0]), lanes_mul(l->shear[0], z));
    c->y[i] = lanes_sub(lanes_sub(py, l->org[1]), lanes_mul(l->shear[1], z));
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
__attribute__((always_inline)) static inline bool
test_lanes(const struct leaf_ray *l, struct wide_fast *f, const struct wide_block *b,
           const struct corners *c, uint32_t from, bool any)
{
    const lanes *x = c->x, *y = c->y;
    const lanes e0 = lanes_sub(lanes_mul(x[2], y[1]), lanes_mul(y[2], x[1]));
    const lanes e1 = lanes_sub(lanes_mul(x[0], y[2]), lanes_mul(y[0], x[2]));
    const lanes e2 = lanes_sub(lanes_mul(x[1], y[0]), lanes_mul(y[1], x[0]));
    const lanes least = lanes_min(lanes_min(e0, e1), e2), most = lanes_max(lanes_max(e0, e1), e2);
    const lanes zero = lanes_all(0.0);
    const uint32_t there = b->count - from < LANES ? (1u << (b->count - from)) - 1 : (1u << LANES) - 1;
    uint32_t hit = (lanes_compare(least, zero, _CMP_GE_OQ) | lanes_compare(most, zero, _CMP_LE_OQ)) & there;
    if (__builtin_expect(hit == 0, 1))
        return false;
    const lanes det = lanes_add(lanes_add(e0, e1), e2);
    const lanes scaled = lanes_add(lanes_add(lanes_mul(e0, lanes_mul(l->shear[2], c->z[0])),
                                             lanes_mul(e1, lanes_mul(l->shear[2], c->z[1]))),
                                   lanes_mul(e2, lanes_mul(l->shear[2], c->z[2])));
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
    if (__builtin_expect(!(f->ray.far <= (double)b->far_origin), 0))
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
        better |= wide_test_slowly(f, b, from + (uint32_t)__builtin_ctz(slow));
    return better;
}
