/* SPDX-License-Identifier: Apache-2.0
 *
 * Sorting by 64-bit keys in linear time, and the keys that lay boxes along a space-filling curve.
 */
#ifndef ACCEL_ORDER_H
#define ACCEL_ORDER_H

#include "box.h"
#include "memory.h"

struct keyed {
    uint64_t key;
    uint32_t value;
};

/* Sorts by key; what has equal keys keeps its order. False: no memory, nothing changed. */
bool accel_order_by_key(struct memory *m, struct keyed *at, size_t count);

/* The place of a box's middle on the Morton curve, 19 bits for each axis: below 2^57. The box is
 * in units of a frame (frame.h). */
uint64_t accel_order_morton(const accel_box *unit);

#endif
