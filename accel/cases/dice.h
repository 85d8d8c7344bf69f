/* SPDX-License-Identifier: Apache-2.0
 *
 * Random numbers for scenes and rays: the n-th number of a seed is a mix of n and the seed alone
 * (SplitMix64: Steele, Lea and Flood, OOPSLA 2014), so every compiler, order and thread count draws
 * the same ones.
 */
#ifndef CASES_DICE_H
#define CASES_DICE_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

struct dice {
    uint64_t seed, drawn; /* drawn: how many numbers so far */
};

static inline uint64_t dice_mix(uint64_t x)
{
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return x ^ x >> 31;
}

static inline struct dice dice_from(uint64_t seed, uint64_t stream)
{
    return (struct dice){dice_mix(seed) ^ dice_mix(stream + 0x632be59bd9b4e019u), 0};
}

static inline uint64_t dice_bits(struct dice *d)
{
    return dice_mix(d->seed + 0x9e3779b97f4a7c15u * ++d->drawn);
}

/* 0 <= x < 1, a multiple of 2^-53. */
static inline double dice_unit(struct dice *d)
{
    return (double)(dice_bits(d) >> 11) * 0x1p-53;
}

static inline double dice_range(struct dice *d, double lo, double hi)
{
    return lo + dice_unit(d) * (hi - lo);
}

/* 0 <= i < n. */
static inline uint32_t dice_below(struct dice *d, uint32_t n)
{
    return (uint32_t)((dice_bits(d) >> 32) * n >> 32);
}

static inline bool dice_chance(struct dice *d, double p)
{
    return dice_unit(d) < p;
}

/* 2^x with x from lo to hi: no libm function whose last bit differs between systems. */
static inline double dice_power(struct dice *d, int lo, int hi)
{
    const int e = lo + (int)dice_below(d, (uint32_t)(hi - lo));
    return ldexp(1.0 + dice_unit(d), e);
}

#endif
