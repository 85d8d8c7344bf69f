/* SPDX-License-Identifier: Apache-2.0
 *
 * A pinhole camera whose rays another program can make again, bit for bit.
 *
 * With eye E, point A, upward vector (0,1,0), full horizontal field of view F in degrees and an
 * image of W x H pixels, in double and in this order:
 *
 *     w = (A - E) / |A - E|
 *     r = (-w.z, 0, w.x) / |...|              which is w x (0,1,0)
 *     u = (r.y w.z - r.z w.y, r.z w.x - r.x w.z, r.x w.y - r.y w.x)
 *                                             which is r x w
 *     h = tan(F * pi / 360)
 *
 * and for column i from the left and row j from the top, both counted from 0:
 *
 *     x = (2 (i + 0.5) / W - 1) h
 *     y = (1 - 2 (j + 0.5) / H) (h H / W)
 *     origin = E
 *     direction = (w + x r) + y u             which is not normalised
 *
 * Where A is straight above or below E, (0,1,0) is replaced by (0,0,1): r = (w.y, -w.x, 0) / |...|.
 *
 * Coordinates are right-handed: for POV-Ray take the same numbers; its image is not mirrored, as r
 * is computed and not left to the renderer.
 */
#ifndef ACCEL_CLI_CAMERA_H
#define ACCEL_CLI_CAMERA_H

#include <accel/accel.h>

/* A camera. Made by camera_make. */
struct camera {
    double eye[3];           /* E */
    double w[3], r[3], u[3]; /* forward, right, up; unit length */
    double h;                /* half the image's width at distance 1 */
    uint32_t width, height;  /* pixels */
};

/* Fails where eye and at are equal or not finite, or the field of view is not in (0, 180). */
bool camera_make(struct camera *camera, const double eye[3], const double at[3], double fov,
                 uint32_t width, uint32_t height);

/* Where a camera with 40 degrees frames the box: eye and at. */
void camera_frame(const accel_box *box, double eye[3], double at[3]);

/* The ray through column i, row j; fractions are allowed: pixel 0 is centred at 0. */
accel_ray camera_ray(const struct camera *camera, double i, double j);

#endif
