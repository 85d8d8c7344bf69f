/* SPDX-License-Identifier: Apache-2.0
 *
 * Floating-point modes of a host: rounding, and what becomes of subnormal numbers.
 */
#ifndef TESTS_MODES_H
#define TESTS_MODES_H

#include <stdbool.h>

struct mode {
    const char *name;
    int rounding;   /* FE_TONEAREST, ... */
    unsigned flush; /* FTZ and DAZ, bits of x86's MXCSR; without effect elsewhere */
};

enum { MODES = 8 };
extern const struct mode modes[MODES];

/* Sets the mode; mode_leave goes back to the default. Nothing that may fail runs between. */
void mode_enter(const struct mode *m);
void mode_leave(void);

/* The same. False if the mode was no longer what mode_enter had set. */
bool mode_leave_kept(const struct mode *m);

#endif
