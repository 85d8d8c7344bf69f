/* SPDX-License-Identifier: Apache-2.0
 *
 * A floating-point type for what double cannot decide.
 */
#ifndef ACCEL_QUAD_H
#define ACCEL_QUAD_H

#include <float.h>

/* Holds the product of two doubles exactly, with room in the exponent for a product of three. */
#if defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 quad;
#elif LDBL_MANT_DIG >= 106 && LDBL_MAX_EXP >= 4096
typedef long double quad;
#else
#error "accel needs a floating-point type of 106 bits or more: __float128 or long double"
#endif

#endif
