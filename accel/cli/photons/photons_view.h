/* SPDX-License-Identifier: Apache-2.0
 *
 * The irradiance that a camera sees: one receiver for each pixel that shows a surface.
 */
#ifndef ACCEL_CLI_PHOTONS_VIEW_H
#define ACCEL_CLI_PHOTONS_VIEW_H

#include "camera.h"
#include "tool/image.h"
#include "photons.h"

/* A camera's receivers. Ended by view_free. */
struct view {
    uint32_t width, height;     /* pixels */
    struct receiver *receivers; /* on the side of the surface that the camera sees */
    uint32_t *pixels;           /* of each receiver; rows from the top */
    size_t count;               /* of receivers */
};

/* One ray through the middle of each pixel. Returns false when memory runs out. */
bool view_make(struct view *view, const accel *a, const accel_scene *scene,
               const struct camera *camera);

void view_free(struct view *view);

/* Writes irradiance[i] of each receiver: where the output's name ends in .png as a gray picture,
 * 1 - exp(-E / mean E) with the transfer curve of sRGB; otherwise as OpenEXR with the channel Y,
 * which is E in float. Pixels without a surface are 0. Returns false and fills error->text
 * otherwise. */
bool view_write(const struct view *view, const double *irradiance, struct output *output,
                accel_error *error);

#endif
