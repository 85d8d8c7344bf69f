/* SPDX-License-Identifier: Apache-2.0
 *
 * The camera of camera.h. Sums and products stand in the order that the header states.
 */
#include "camera.h"

#define PI 3.14159265358979323846

static bool normalise(double v[3])
{
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3; k++) {
        v[k] /= length;
    }
    return length > 0.0 && isfinite(length);
}

bool camera_make(struct camera *camera, const double eye[3], const double at[3], double fov,
                 uint32_t width, uint32_t height)
{
    *camera = (struct camera){.h = tan(fov * PI / 360.0), .width = width, .height = height};
    double *w = camera->w, *r = camera->r, *u = camera->u;
    for (int k = 0; k < 3; k++) {
        camera->eye[k] = eye[k];
        w[k] = at[k] - eye[k];
    }
    const bool fine = normalise(w) && fov > 0.0 && fov < 180.0;
    r[0] = -w[2];
    r[2] = w[0];
    if (r[0] == 0.0 && r[2] == 0.0) {
        r[0] = w[1];
        r[1] = -w[0];
        r[2] = 0.0;
    }
    normalise(r);
    u[0] = r[1] * w[2] - r[2] * w[1];
    u[1] = r[2] * w[0] - r[0] * w[2];
    u[2] = r[0] * w[1] - r[1] * w[0];
    return fine;
}

void camera_frame(const accel_box *box, double eye[3], double at[3])
{
    /* the box's ball, radius 1, fills 40 degrees from distance 1/sin(20 deg) = 2.93 */
    static const double towards[3] = {0.5, 0.5, 0.7071067811865476};
    double square = 0.0;
    for (int k = 0; k < 3; k++) {
        const double half = 0.5 * box->hi[k] - 0.5 * box->lo[k];
        square += half * half;
        at[k] = 0.5 * box->lo[k] + 0.5 * box->hi[k];
    }
    const double distance = square > 0.0 ? 2.93 * sqrt(square) : 1.0;
    for (int k = 0; k < 3; k++) {
        eye[k] = at[k] + distance * towards[k];
    }
}

accel_ray camera_ray(const struct camera *camera, double i, double j)
{
    const double w = camera->width, h = camera->height;
    const double x = (2.0 * (i + 0.5) / w - 1.0) * camera->h;
    const double y = (1.0 - 2.0 * (j + 0.5) / h) * (camera->h * h / w);
    double direction[3];
    for (int k = 0; k < 3; k++) {
        direction[k] = (camera->w[k] + x * camera->r[k]) + y * camera->u[k];
    }
    return accel_ray_from(camera->eye, direction);
}
