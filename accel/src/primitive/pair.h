/* SPDX-License-Identifier: Apache-2.0
 *
 * Two doubles side by side: SSE2 registers where there are any, else plain C, with the same bits.
 * Maximum and minimum return the second operand if either is NaN.
 */
#ifndef ACCEL_PAIR_H
#define ACCEL_PAIR_H

#include <stdint.h>

#if defined(__SSE2__)

#include <emmintrin.h>

typedef __m128d pair;

static inline pair pair_both(double x)
{
    return _mm_set1_pd(x);
}

static inline pair pair_of(double x, double y)
{
    return _mm_set_pd(y, x);
}

static inline pair pair_load(const double at[2])
{
    return _mm_loadu_pd(at);
}

static inline void pair_store(double at[2], pair p)
{
    _mm_storeu_pd(at, p);
}

static inline pair pair_sub(pair p, pair q)
{
    return _mm_sub_pd(p, q);
}

static inline pair pair_mul(pair p, pair q)
{
    return _mm_mul_pd(p, q);
}

static inline pair pair_max(pair p, pair q)
{
    return _mm_max_pd(p, q);
}

static inline pair pair_min(pair p, pair q)
{
    return _mm_min_pd(p, q);
}

/* Bit i: p[i] <= q[i]. */
static inline uint32_t pair_at_most(pair p, pair q)
{
    return (uint32_t)_mm_movemask_pd(_mm_cmple_pd(p, q));
}

/* Bit i: p[i] < q[i]. */
static inline uint32_t pair_below(pair p, pair q)
{
    return (uint32_t)_mm_movemask_pd(_mm_cmplt_pd(p, q));
}

#else

typedef struct {
    double at[2];
} pair;

static inline pair pair_both(double x)
{
    return (pair){{x, x}};
}

static inline pair pair_of(double x, double y)
{
    return (pair){{x, y}};
}

static inline pair pair_load(const double at[2])
{
    return (pair){{at[0], at[1]}};
}

static inline void pair_store(double at[2], pair p)
{
    at[0] = p.at[0];
    at[1] = p.at[1];
}

static inline pair pair_sub(pair p, pair q)
{
    return (pair){{p.at[0] - q.at[0], p.at[1] - q.at[1]}};
}

static inline pair pair_mul(pair p, pair q)
{
    return (pair){{p.at[0] * q.at[0], p.at[1] * q.at[1]}};
}

static inline pair pair_max(pair p, pair q)
{
    return (pair){{p.at[0] > q.at[0] ? p.at[0] : q.at[0], p.at[1] > q.at[1] ? p.at[1] : q.at[1]}};
}

static inline pair pair_min(pair p, pair q)
{
    return (pair){{p.at[0] < q.at[0] ? p.at[0] : q.at[0], p.at[1] < q.at[1] ? p.at[1] : q.at[1]}};
}

/* Bit i: p[i] <= q[i]. */
static inline uint32_t pair_at_most(pair p, pair q)
{
    return (uint32_t)(p.at[0] <= q.at[0]) | (uint32_t)(p.at[1] <= q.at[1]) << 1;
}

/* Bit i: p[i] < q[i]. */
static inline uint32_t pair_below(pair p, pair q)
{
    return (uint32_t)(p.at[0] < q.at[0]) | (uint32_t)(p.at[1] < q.at[1]) << 1;
}

#endif

#endif
