/* SPDX-License-Identifier: Apache-2.0
 *
 * The walks of wide trees with AVX-512: 16 boxes at once, 8 triangles in double, whose shared
 * vertices are moved and sheared once.
 */
#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

#include "../core/contract.h"
#include "../core/build.h"
#include "../core/cost.h"
#include "../core/structure.h"
#include "../primitive/query.h"
#include "wide_isa.h"

#define FEATURES "avx512f,avx512vl,avx512dq,avx512bw,avx2,fma,bmi,lzcnt,popcnt"

#if defined(__clang__)
#pragma clang attribute push(__attribute__((target(FEATURES))), apply_to = function)
#else
#pragma GCC push_options
/* The fused operations of the set are there to tempt it. */
#pragma GCC optimize("fp-contract=off")
#pragma GCC target("avx512f,avx512vl,avx512dq,avx512bw,avx2,fma,bmi,lzcnt,popcnt")
#endif

/* Where children begin: no float below is negative where it matters, so all compare as the integers
 * that their bits are, which takes less time, and to which steps can be added. */
typedef __m512i begins;

struct node_ray {
    __m512 inverse[3], offset[3];
    __m512i tmin, limit;
    size_t near[3]; /* bytes from the planes of a node to the near ones */
};

static inline void node_ray_limit(struct node_ray *n, float limit)
{
    n->limit = _mm512_castps_si512(_mm512_set1_ps(limit));
}

static inline struct node_ray node_ray_from(const struct wide_ray *r, float limit)
{
    struct node_ray n;
    for (uint32_t k = 0; k < 3; k++) {
        n.inverse[k] = _mm512_set1_ps(r->inverse[k]);
        n.offset[k] = _mm512_set1_ps(r->offset[k]);
        n.near[k] = 128 * k + 64 * r->near[k];
    }
    n.tmin = _mm512_castps_si512(_mm512_set1_ps(r->tmin));
    node_ray_limit(&n, limit);
    return n;
}

/* Where the planes at so many bytes are crossed. */
static inline __m512i crossing(const struct node_ray *n, const char *planes, size_t at, int k)
{
    return _mm512_castps_si512(
        _mm512_fmadd_ps(_mm512_load_ps((const float *)(planes + at)), n->inverse[k], n->offset[k]));
}

static inline uint32_t node_meets(const struct node_ray *n, const struct wide_node *node, begins *b)
{
    const char *at = (const char *)node->plane;
    const size_t *near = n->near;
    const __m512i a =
        _mm512_max_epi32(_mm512_max_epi32(crossing(n, at, near[0], 0), crossing(n, at, near[1], 1)),
                         _mm512_max_epi32(crossing(n, at, near[2], 2), n->tmin));
    const __m512i z = _mm512_min_epi32(
        _mm512_min_epi32(crossing(n, at, 64 - near[0], 0), crossing(n, at, 320 - near[1], 1)),
        _mm512_min_epi32(crossing(n, at, 576 - near[2], 2), n->limit));
    *b = a;
    return _mm512_cmple_epi32_mask(a, _mm512_add_epi32(z, _mm512_set1_epi32(WIDE_STEPS)));
}

static inline void begins_store(const begins *b, uint32_t out[WIDE])
{
    _mm512_store_si512(out, *b);
}

static inline uint32_t *push_children(uint32_t *top, uint32_t meets, const struct wide_node *node)
{
    const __m512i words = _mm512_load_si512(node->child);
    _mm512_storeu_si512(top, _mm512_maskz_compress_epi32((__mmask16)meets, words));
    return top + __builtin_popcount(meets);
}

#define LANES 8
typedef __m512d lanes;
static inline lanes lanes_sub(lanes a, lanes b)
{
    return _mm512_sub_pd(a, b);
}
static inline lanes lanes_mul(lanes a, lanes b)
{
    return _mm512_mul_pd(a, b);
}
static inline lanes lanes_add(lanes a, lanes b)
{
    return _mm512_add_pd(a, b);
}
static inline lanes lanes_div(lanes a, lanes b)
{
    return _mm512_div_pd(a, b);
}
static inline lanes lanes_min(lanes a, lanes b)
{
    return _mm512_min_pd(a, b);
}
static inline lanes lanes_max(lanes a, lanes b)
{
    return _mm512_max_pd(a, b);
}
static inline lanes lanes_abs(lanes a)
{
    return _mm512_abs_pd(a);
}
static inline lanes lanes_all(double x)
{
    return _mm512_set1_pd(x);
}
static inline void lanes_store(double *at, lanes a)
{
    _mm512_store_pd(at, a);
}

static inline lanes lanes_sqrt(lanes a)
{
    return _mm512_sqrt_pd(a);
}
/* a, which is not negative, with the sign of b. */
static inline lanes lanes_with_sign(lanes a, lanes b)
{
    return _mm512_or_pd(a, _mm512_and_pd(_mm512_set1_pd(-0.0), b));
}
static inline uint32_t lanes_less(lanes a, lanes b)
{
    return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ);
}
static inline uint32_t lanes_at_most(lanes a, lanes b)
{
    return _mm512_cmp_pd_mask(a, b, _CMP_LE_OQ);
}
/* Which of eight ids are this one. */
static inline uint32_t lanes_with_id(const uint32_t *ids, uint32_t id)
{
    return _mm256_cmpeq_epi32_mask(_mm256_loadu_si256((const __m256i *)(const void *)ids),
                                   _mm256_set1_epi32((int)id));
}

#include "wide_leaf.h"

/* A row of packed coordinates: of one corner and axis. */
static inline __m512d row(const struct wide_block *b, uint32_t number)
{
    const size_t place = number * (size_t)b->count;
    const __mmask8 there = (__mmask8)((1u << b->count) - 1);
    if (b->type >= WIDE_DOUBLES)
        return _mm512_maskz_loadu_pd(there, (const double *)wide_block_data(b) + place);
    return _mm512_cvtps_pd(_mm256_maskz_loadu_ps(there, (const float *)wide_block_data(b) + place));
}

static inline struct corners load_packed(const struct leaf_ray *l, const struct wide_block *b)
{
    struct corners c;
    for (uint32_t i = 0; i < 3; i++)
        shear_corner(l, row(b, 3 * i + l->axis[0]), row(b, 3 * i + l->axis[1]),
                     row(b, 3 * i + l->axis[2]), &c, i);
    return c;
}

/* Coordinates of up to 16 vertices. */
struct vertices {
    __m512d low, high;
};

static inline struct vertices pool_row(const struct wide_block *b, uint32_t axis, __mmask16 there)
{
    const size_t place = axis * (size_t)b->vertices;
    if (b->type != WIDE_POOL) {
        const double *at = (const double *)wide_block_data(b) + place;
        return (struct vertices){_mm512_maskz_loadu_pd((__mmask8)there, at),
                                 _mm512_maskz_loadu_pd((__mmask8)(there >> 8), at + 8)};
    }
    const __m512 all = _mm512_maskz_loadu_ps(there, (const float *)wide_block_data(b) + place);
    return (struct vertices){_mm512_cvtps_pd(_mm512_castps512_ps256(all)),
                             _mm512_cvtps_pd(_mm512_extractf32x8_ps(all, 1))};
}

static inline __m512d pick(const struct vertices *v, __m512i corner)
{
    return _mm512_permutex2var_pd(v->low, corner, v->high);
}

static inline struct corners load_pool(const struct leaf_ray *l, const struct wide_block *b)
{
    const uint32_t size = b->type == WIDE_POOL ? sizeof(float) : sizeof(double), n = b->vertices;
    const uint8_t *corner = (const uint8_t *)wide_block_data(b) + 3 * size * n;
    const __mmask16 there = (__mmask16)((1u << n) - 1);
    struct corners low, high, c;
    const struct vertices px = pool_row(b, l->axis[0], there), py = pool_row(b, l->axis[1], there),
                          pz = pool_row(b, l->axis[2], there);
    shear_corner(l, px.low, py.low, pz.low, &low, 0);
    shear_corner(l, px.high, py.high, pz.high, &high, 0);
    const struct vertices x = {low.x[0], high.x[0]}, y = {low.y[0], high.y[0]},
                          z = {low.z[0], high.z[0]};
    for (uint32_t i = 0; i < 3; i++) {
        const __m512i which = _mm512_cvtepu8_epi64(
            _mm_loadl_epi64((const __m128i *)(const void *)(corner + WIDE_BLOCK * i)));
        c.x[i] = pick(&x, which);
        c.y[i] = pick(&y, which);
        c.z[i] = pick(&z, which);
    }
    return c;
}

__attribute__((always_inline)) static inline bool leaf_test(struct wide_fast *f,
                                                            const struct wide_block *b, bool any)
{
    const struct leaf_ray *l = &f->leaf;
    if (__builtin_expect(b->type >= WIDE_SPHERES, 0)) {
        const struct spheres s = {{row(b, 0), row(b, 1), row(b, 2)}, row(b, 3)};
        return test_spheres(f, b, &s, 0, any);
    }
    const struct corners c = b->type <= WIDE_POOL_DOUBLES ? load_pool(l, b) : load_packed(l, b);
    return test_triangles(f, b, &c, 0, any);
}

#include "wide_fast.h"

#include "wide_batch.h"

/* By the instructions of the set, so only to be called where they are. */
__attribute__((noinline)) CONTRACT_CHECK(contract_kept);

#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

static bool works_here(void)
{
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") && contract_kept();
}

const struct wide_isa accel_wide_avx512 = {
    .name = "avx512",
    .works_here = works_here,
    .rule = {.lanes = 8, .pool = true, .node_cost = COST_WIDE_NODE},
    .closest = closest,
    .any = any,
    .walk = walk,
    .closest_n = closest_n,
    .any_n = any_n,
    .find_box = accel_wide_find_box,
};

#endif
