/* SPDX-License-Identifier: Apache-2.0
 *
 * Rays as text: "ox oy oz dx dy dz [tmin tmax [geom prim]]", separated by blanks or commas.
 */
#ifndef ACCEL_CLI_RAY_TEXT_H
#define ACCEL_CLI_RAY_TEXT_H

#include <accel/accel.h>

/* Room for the text of a ray: eight hex floats of up to 25 bytes and two ids. */
enum { RAY_TEXT = 300 };

/* Writes a ray so that ray_from_text gives back its bits, but for the payload of a NaN. */
void write_ray(const accel_ray *ray, char text[RAY_TEXT]);

/* Reads a ray: without tmin and tmax, 0 and infinity. False where the text is something else. */
bool ray_from_text(const char *text, accel_ray *ray);

#endif
