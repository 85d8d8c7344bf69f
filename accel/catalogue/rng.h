/* SPDX-License-Identifier: Apache-2.0
 *
 * Random numbers for scenes and rays: the n-th number of a seed is a mix of n and the seed alone
 * (SplitMix64: Steele, Lea and Flood, OOPSLA 2014), so every compiler, order and thread count draws
 * the same ones.
 */
#ifndef CASES_RNG_H
#define CASES_RNG_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

struct rng {
    uint64_t seed, drawn; /* drawn: how many numbers so far */
};

static inline uint64_t rng_mix(uint64_t x)
{
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return x ^ x >> 31;
}

static inline struct rng rng_from(uint64_t seed, uint64_t stream)
{
    return (struct rng){rng_mix(seed) ^ rng_mix(stream + 0x632be59bd9b4e019u), 0};
}

static inline uint64_t rng_bits(struct rng *d)
{
    return rng_mix(d->seed + 0x9e3779b97f4a7c15u * ++d->drawn);
}

/* 0 <= x < 1, a multiple of 2^-53. */
static inline double rng_unit(struct rng *d)
{
    return (double)(rng_bits(d) >> 11) * 0x1p-53;
}

static inline double rng_range(struct rng *d, double lo, double hi)
{
    return lo + rng_unit(d) * (hi - lo);
}

/* 0 <= i < n. */
static inline uint32_t rng_below(struct rng *d, uint32_t n)
{
    return (uint32_t)((rng_bits(d) >> 32) * n >> 32);
}

static inline bool rng_chance(struct rng *d, double p)
{
    return rng_unit(d) < p;
}

/* 2^x with x from lo to hi: no libm function whose last bit differs between systems. */
static inline double rng_power(struct rng *d, int lo, int hi)
{
    const int e = lo + (int)rng_below(d, (uint32_t)(hi - lo));
    return ldexp(1.0 + rng_unit(d), e);
}

#endif
