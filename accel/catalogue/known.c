/* SPDX-License-Identifier: Apache-2.0 */
#include "known.h"

const struct known known_cases[] = {
    /* Three corners on one line: no ray hits it. */
    {"one-line",
     "pbrt-v4, Triangle.BadCases",
     {-1113.45459f, -79.049614f, -56.2431908f, -1113.45459f, -87.0922699f, -56.2431908f,
      -1113.45459f, -79.2090149f, -56.2431908f},
     1,
     {-1081.47925f, 99.9999542f, 87.7701111f},
     {-32.1072998f, -183.355865f, -144.607635f},
     0.9999f,
     false,
     0,
     0},
    /* Exactly through the edge x + y = 1 that two overlapping triangles share. */
    {"shared-edge",
     "VK-GL-CTS 446",
     {0x1p+0, 0, -0x1p+0, 0, 0x1p+0, -0x1p+0, 0x1.90759p-2, 0x1.37c53ap-1, -0x1.af3846p-2, 0,
      0x1p+0, -0x1p+0, 0x1p+0, 0, -0x1p+0, 0x1.1ef418p-2, 0x1.6a74ep-1, -0x1.9f568ep-1},
     2,
     {0x1.e1p-1, 0x1.fp-5, 0},
     {0, 0, -1},
     INFINITY,
     true,
     0,
     1},
    /* On the diagonal of a square of two triangles. */
    {"diagonal",
     "Oblikovati 2146",
     {-5, -5, 0, 5, -5, 0, 5, 5, 0, -5, -5, 0, 5, 5, 0, -5, 5, 0},
     2,
     {0, 0, 9.0},
     {3, 3, -8},
     INFINITY,
     true,
     0,
     1.125},
    {NULL, NULL, {0}, 0, {0}, {0}, 0, false, 0, 0},
};

void known_make(struct test_scene *s, const struct known *c)
{
    scene_open(s);
    struct part *p = scene_part(s, ACCEL_TRIANGLES);
    for (uint32_t i = 0; i < c->triangles; i++) {
        const double *t = c->vertices + 9 * i;
        part_triangle(p, t, t + 3, t + 6);
    }
    scene_close(s);
}

accel_ray known_ray(const struct known *c)
{
    accel_ray ray = accel_ray_from(c->org, c->dir);
    ray.tmax = c->tmax;
    return ray;
}
