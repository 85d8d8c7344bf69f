/* SPDX-License-Identifier: Apache-2.0
 *
 * The control points of the Utah teapot: see teapot_patches.c.
 */
#ifndef ACCEL_CLI_TEAPOT_PATCHES_H
#define ACCEL_CLI_TEAPOT_PATCHES_H

#include <stdint.h>

enum { TEAPOT_PATCHES = 32, TEAPOT_POINTS = 306 };

/* Four rows of four indices, counted from 1, into teapot_points. */
extern const uint16_t teapot_patches[TEAPOT_PATCHES][16];

extern const double teapot_points[TEAPOT_POINTS][3];

#endif
