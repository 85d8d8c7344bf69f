/* SPDX-License-Identifier: Apache-2.0
 *
 * The header alone is strict C11, and the whole of it links from the shared library.
 */
#include "accel/accel.h"

static bool no_hit(void *user, const accel_hit *hit)
{
    (void)user;
    (void)hit;
    return false;
}

static bool no_id(void *user, accel_id id)
{
    (void)user;
    (void)id;
    return false;
}

int main(void)
{
    accel *a;
    accel_error error;
    accel_info info;
    accel_box box;
    accel_hit hit;
    size_t count;
    const accel_scene scene = {NULL, 0};
    const double org[3] = {0, 0, 0}, dir[3] = {0, 0, 1};
    const accel_ray ray = accel_ray_from(org, dir);
    if (accel_build(&a, &scene, NULL, NULL, &error) != ACCEL_OK || !accel_kinds(&count) ||
        accel_validate(a, &error) != ACCEL_OK)
        return 1;
    accel_describe(a, &info);
    const bool found = accel_closest(a, &ray, &hit, NULL) || accel_any(a, &ray, NULL) ||
                       !accel_all(a, &ray, no_hit, NULL, NULL) ||
                       !accel_point(a, org, no_id, NULL, NULL) ||
                       accel_padded_box(a, ray.skip, &box);
    accel_free(a);
    return found;
}
