/* SPDX-License-Identifier: Apache-2.0
 *
 * Four floats at once, in the vectors of gcc and clang: of use where boxes are added up. What those
 * have no operator for stands here, with a plain body for processors other than x86-64.
 */
#ifndef ACCEL_FOUR_H
#define ACCEL_FOUR_H

#include <stdint.h>
#include <string.h>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

typedef float four __attribute__((vector_size(16)));
typedef int32_t four_int __attribute__((vector_size(16)));

static inline four four_all(float x)
{
    return (four){x, x, x, x};
}

/* Three floats and 0, from where a fourth may be read too. */
static inline four four_of_three(const float *at)
{
    four_int x;
    memcpy(&x, at, sizeof x);
    return (four)(x & (four_int){-1, -1, -1, 0});
}

/* a < b ? a : b in each lane. */
static inline four four_min(four a, four b)
{
#if defined(__SSE2__)
    return _mm_min_ps(a, b);
#else
    for (int i = 0; i < 4; i++)
        a[i] = a[i] < b[i] ? a[i] : b[i];
    return a;
#endif
}

/* a > b ? a : b in each lane. */
static inline four four_max(four a, four b)
{
#if defined(__SSE2__)
    return _mm_max_ps(a, b);
#else
    for (int i = 0; i < 4; i++)
        a[i] = a[i] > b[i] ? a[i] : b[i];
    return a;
#endif
}

#endif
