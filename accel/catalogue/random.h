/* SPDX-License-Identifier: Apache-2.0
 *
 * Counter-based random numbers: Philox 4x32-10 of Random123 (Salmon et al., SC 2011). A sequence is
 * named by (seed, stream, index), so that any thread can make any ray without the ones before it.
 */
#ifndef ACCEL_CLI_RANDOM_H
#define ACCEL_CLI_RANDOM_H

#include <Random123/philox.h>
#include <stdint.h>

/* A sequence of random numbers. */
struct random {
    philox4x32_key_t key;     /* the seed */
    philox4x32_ctr_t counter; /* index, stream, position in the sequence */
    philox4x32_ctr_t block;   /* four words at this position */
    unsigned left;            /* pairs of words in `block` not handed out yet */
};

static inline struct random random_start(uint64_t seed, uint32_t stream, uint64_t index)
{
    return (struct random){
        .key = {{(uint32_t)seed, (uint32_t)(seed >> 32)}},
        .counter = {{(uint32_t)index, (uint32_t)(index >> 32), stream, 0}},
    };
}

/* 64 random bits. */
static inline uint64_t random_bits(struct random *random)
{
    if (random->left == 0) {
        random->block = philox4x32(random->counter, random->key);
        random->counter.v[3]++;
        random->left = 2;
    }
    random->left--;
    const uint32_t *pair = random->block.v + 2 * random->left;
    return (uint64_t)pair[0] << 32 | pair[1];
}

/* Uniform in [0, 1): a multiple of 2^-53. */
static inline double random_unit(struct random *random)
{
    return (double)(random_bits(random) >> 11) * 0x1p-53;
}

/* Uniform in [lo, hi), up to rounding. */
static inline double random_in(struct random *random, double lo, double hi)
{
    return lo + (hi - lo) * random_unit(random);
}

#endif
