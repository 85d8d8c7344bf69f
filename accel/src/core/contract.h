/* SPDX-License-Identifier: Apache-2.0
 *
 * What the compiler must keep: every operation is rounded to double, once and on its own. The
 * watertight test and the walks compute the same number in several places; where a product and a
 * sum are fused into one rounding (contraction) in one of them, rays slip through.
 *
 * CMake's build passes -ffp-contract=off. Flags that show themselves are refused here; gcc's
 * contraction, on by default without -std=c11, does not, so accel_build checks at run time.
 */
#ifndef ACCEL_CONTRACT_H
#define ACCEL_CONTRACT_H

#include <float.h>
#include <stdbool.h>

#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) ||     \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || FLT_EVAL_METHOD != 0
#error "accel needs IEEE double arithmetic: no -ffast-math, and SSE2 instead of x87 on 32-bit x86"
#endif

#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif

/* Defines a function: does what stands here round products and sums on their own? In every rounding
 * mode equal products are equal, and 2^60 swallows a third. The values are volatile, or the
 * compiler would compute the answer itself, without contraction. */
#define CONTRACT_CHECK(name)                                                                       \
    static bool name(void)                                                                         \
    {                                                                                              \
        const volatile double third = 1.0 / 3.0, large = 0x1p60;                                   \
        const double a = third, b = third, c = third, d = third, e = large;                        \
        return a * b - c * d == 0.0 && a + e - e != a;                                             \
    }                                                                                              \
    static bool name(void)

#endif
