/* SPDX-License-Identifier: Apache-2.0 */
#include "order.h"

enum { DIGIT_BITS = 8, DIGITS = 1 << DIGIT_BITS };

static uint32_t digit(uint64_t key, int shift)
{
    return (uint32_t)(key >> shift & (DIGITS - 1));
}

/* One pass of radix sort. False if all have the same digit, and nothing was copied. */
static bool pass(const struct keyed *from, struct keyed *to, size_t count, int shift)
{
    size_t at[DIGITS] = {0}, sum = 0;
    for (size_t i = 0; i < count; i++)
        at[digit(from[i].key, shift)]++;
    if (at[digit(from[0].key, shift)] == count)
        return false;
    for (int d = 0; d < DIGITS; d++) {
        const size_t here = at[d];
        at[d] = sum;
        sum += here;
    }
    for (size_t i = 0; i < count; i++)
        to[at[digit(from[i].key, shift)]++] = from[i];
    return true;
}

bool accel_order_by_key(struct memory *m, struct keyed *at, size_t count)
{
    if (count < 2)
        return true;
    struct keyed *other = accel_memory_resize(m, NULL, 0, count * sizeof *other);
    if (!other)
        return false;
    struct keyed *from = at, *to = other;
    for (int shift = 0; shift < 64; shift += DIGIT_BITS) {
        if (!pass(from, to, count, shift))
            continue;
        struct keyed *swapped = from;
        from = to;
        to = swapped;
    }
    for (size_t i = 0; from != at && i < count; i++)
        at[i] = from[i];
    accel_memory_resize(m, other, count * sizeof *other, 0);
    return true;
}

/* Two zero bits after every bit. */
static uint64_t spread(uint64_t x)
{
    x = (x | x << 32) & 0x1f00000000ffff;
    x = (x | x << 16) & 0x1f0000ff0000ff;
    x = (x | x << 8) & 0x100f00f00f00f00f;
    x = (x | x << 4) & 0x10c30c30c30c30c3;
    return (x | x << 2) & 0x1249249249249249;
}

uint64_t accel_order_morton(const accel_box *unit)
{
    uint64_t code = 0;
    for (int k = 0; k < 3; k++)
        code |= spread((uint64_t)(0x1p19 * (0.5 * unit->lo[k] + 0.5 * unit->hi[k]))) << k;
    return code;
}
