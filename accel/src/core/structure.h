/* SPDX-License-Identifier: Apache-2.0
 *
 * The parts that every structure has.
 */
#ifndef ACCEL_STRUCTURE_H
#define ACCEL_STRUCTURE_H

#include "accel/accel.h"
#include "memory.h"
#include "../primitive/primitives.h"

struct wide;

/* Options of a kind at most. */
enum { MAX_OPTIONS = 12 };

/* A kind's own struct embeds it as its first member. */
struct accel {
    const struct accel_kind *kind; /* how it was built, how it is walked */
    struct memory memory;          /* what it holds */
    struct primitives prims;       /* what it is built over */
    double option[MAX_OPTIONS];    /* by the kind's option index; NAN stands for auto */
    accel_info info;               /* as accel_describe hands it out */
    const struct wide *fast;       /* the tree that answers closest and any queries, or NULL */
    uint64_t seal[2];              /* over all above, and over what the kind adds: see seal.h. What
                                      changes after accel_build lies in blocks of its own */
};

#endif
