/* SPDX-License-Identifier: Apache-2.0
 *
 * The walks of wide trees with AVX2 and FMA: 8 boxes at once, 4 triangles in double.
 */
#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

#include "../core/contract.h"
#include "../core/build.h"
#include "../core/cost.h"
#include "../core/structure.h"
#include "../primitive/query.h"
#include "wide_isa.h"

#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2,fma,bmi,lzcnt,popcnt"))),                 \
                             apply_to = function)
#else
#pragma GCC push_options
/* The fused operations of the set are there to tempt it. */
#pragma GCC optimize("fp-contract=off")
#pragma GCC target("avx2,fma,bmi,lzcnt,popcnt")
#endif

/* Where children begin, in two halves: no float below is negative where it matters, so all compare
 * as the integers that their bits are, which takes less time, and to which steps can be added. */
typedef struct begins {
    __m256i half[2];
} begins;

struct node_ray {
    __m256 inverse[3], offset[3];
    __m256i tmin, limit;
    size_t near[3]; /* bytes from the planes of a node to the near ones */
};

static inline void node_ray_limit(struct node_ray *n, float limit)
{
    n->limit = _mm256_castps_si256(_mm256_set1_ps(limit));
}

static inline struct node_ray node_ray_from(const struct wide_ray *r, float limit)
{
    struct node_ray n;
    for (uint32_t k = 0; k < 3; k++) {
        n.inverse[k] = _mm256_set1_ps(r->inverse[k]);
        n.offset[k] = _mm256_set1_ps(r->offset[k]);
        n.near[k] = 128 * k + 64 * r->near[k];
    }
    n.tmin = _mm256_castps_si256(_mm256_set1_ps(r->tmin));
    node_ray_limit(&n, limit);
    return n;
}

/* Where the planes at so many bytes are crossed. */
static inline __m256i crossing(const struct node_ray *n, const char *planes, size_t at, int k)
{
    return _mm256_castps_si256(
        _mm256_fmadd_ps(_mm256_load_ps((const float *)(planes + at)), n->inverse[k], n->offset[k]));
}

/* Eight of the children: bits of those that are missed. */
static inline __m256i half_misses(const struct node_ray *n, const char *at, __m256i *begin)
{
    const size_t *near = n->near;
    const __m256i a =
        _mm256_max_epi32(_mm256_max_epi32(crossing(n, at, near[0], 0), crossing(n, at, near[1], 1)),
                         _mm256_max_epi32(crossing(n, at, near[2], 2), n->tmin));
    const __m256i z = _mm256_min_epi32(
        _mm256_min_epi32(crossing(n, at, 64 - near[0], 0), crossing(n, at, 320 - near[1], 1)),
        _mm256_min_epi32(crossing(n, at, 576 - near[2], 2), n->limit));
    *begin = a;
    return _mm256_cmpgt_epi32(a, _mm256_add_epi32(z, _mm256_set1_epi32(WIDE_STEPS)));
}

static inline uint32_t node_meets(const struct node_ray *n, const struct wide_node *node, begins *b)
{
    const char *at = (const char *)node->plane;
    const __m256i low = half_misses(n, at, &b->half[0]),
                  high = half_misses(n, at + 32, &b->half[1]);
    const uint32_t misses = (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(low)) |
                            (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(high)) << 8;
    return misses ^ 0xffff;
}

static inline void begins_store(const begins *b, uint32_t out[WIDE])
{
    _mm256_store_si256((__m256i *)(void *)out, b->half[0]);
    _mm256_store_si256((__m256i *)(void *)(out + 8), b->half[1]);
}

/* For each set of eight, the numbers of its members, a byte each, in order. */
/* clang-format off */
#define MEMBER(set, i) ((uint64_t)(i) * ((set) >> (i) & 1) << 8 * __builtin_popcount((set) & ((1 << (i)) - 1)))
#define MEMBERS(set) MEMBER(set, 1) | MEMBER(set, 2) | MEMBER(set, 3) | MEMBER(set, 4) | MEMBER(set, 5) | \
                     MEMBER(set, 6) | MEMBER(set, 7)
#define SETS_4(set) MEMBERS(set), MEMBERS(set + 1), MEMBERS(set + 2), MEMBERS(set + 3)
#define SETS_16(set) SETS_4(set), SETS_4(set + 4), SETS_4(set + 8), SETS_4(set + 12)
#define SETS_64(set) SETS_16(set), SETS_16(set + 16), SETS_16(set + 32), SETS_16(set + 48)
static const uint64_t members[256] = {SETS_64(0), SETS_64(64), SETS_64(128), SETS_64(192)};
/* clang-format on */

/* Puts the members of a set of eight words behind each other. Writes eight. */
static inline uint32_t *push_half(uint32_t *top, uint32_t set, const uint32_t words[8])
{
    const __m256i all = _mm256_load_si256((const __m256i *)(const void *)words);
    const __m256i which =
        _mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)(const void *)&members[set]));
    _mm256_storeu_si256((__m256i *)(void *)top, _mm256_permutevar8x32_epi32(all, which));
    return top + __builtin_popcount(set);
}

static inline uint32_t *push_children(uint32_t *top, uint32_t meets, const struct wide_node *node)
{
    top = push_half(top, meets & 0xff, node->child);
    return push_half(top, meets >> 8, node->child + 8);
}

/* Four coordinates of a block of packed triangles: of one corner and axis, from the i-th on. */
static inline __m256d coordinates(const struct wide_block *b, uint32_t row, uint32_t i)
{
    const size_t place = row * (size_t)b->count + i;
    if (b->type >= WIDE_DOUBLES)
        return _mm256_loadu_pd((const double *)wide_block_data(b) + place);
    return _mm256_cvtps_pd(_mm_loadu_ps((const float *)wide_block_data(b) + place));
}

#define LANES 4
typedef __m256d lanes;
static inline lanes lanes_sub(lanes a, lanes b)
{
    return _mm256_sub_pd(a, b);
}
static inline lanes lanes_mul(lanes a, lanes b)
{
    return _mm256_mul_pd(a, b);
}
static inline lanes lanes_add(lanes a, lanes b)
{
    return _mm256_add_pd(a, b);
}
static inline lanes lanes_div(lanes a, lanes b)
{
    return _mm256_div_pd(a, b);
}
static inline lanes lanes_min(lanes a, lanes b)
{
    return _mm256_min_pd(a, b);
}
static inline lanes lanes_max(lanes a, lanes b)
{
    return _mm256_max_pd(a, b);
}
static inline lanes lanes_abs(lanes a)
{
    return _mm256_andnot_pd(_mm256_set1_pd(-0.0), a);
}
static inline lanes lanes_all(double x)
{
    return _mm256_set1_pd(x);
}
static inline void lanes_store(double *at, lanes a)
{
    _mm256_store_pd(at, a);
}

static inline lanes lanes_sqrt(lanes a)
{
    return _mm256_sqrt_pd(a);
}
/* a, which is not negative, with the sign of b. */
static inline lanes lanes_with_sign(lanes a, lanes b)
{
    return _mm256_or_pd(a, _mm256_and_pd(_mm256_set1_pd(-0.0), b));
}
static inline uint32_t lanes_less(lanes a, lanes b)
{
    return (uint32_t)_mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_LT_OQ));
}
static inline uint32_t lanes_at_most(lanes a, lanes b)
{
    return (uint32_t)_mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_LE_OQ));
}
/* Which of four ids are this one. */
static inline uint32_t lanes_with_id(const uint32_t *ids, uint32_t id)
{
    const __m128i four = _mm_loadu_si128((const __m128i *)(const void *)ids);
    return (uint32_t)_mm_movemask_ps(
        _mm_castsi128_ps(_mm_cmpeq_epi32(four, _mm_set1_epi32((int)id))));
}

#include "wide_leaf.h"

#include "wide_packed.h"

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
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
           __builtin_cpu_supports("bmi") && contract_kept();
}

const struct wide_isa accel_wide_avx2 = {
    .name = "avx2",
    .works_here = works_here,
    .rule = {.lanes = 4, .pool = false, .node_cost = COST_WIDE_NODE},
    .closest = closest,
    .any = any,
    .walk = walk,
    .closest_n = closest_n,
    .any_n = any_n,
    .find_box = accel_wide_find_box,
};

#endif
