// SPDX-License-Identifier: Apache-2.0
//
// The header alone is strict C++, in namespaces, twice.
#include "accel/accel.h"
#include "accel/accel.h"

int main()
{
    const double org[3] = {0, 0, 0}, dir[3] = {0, 0, 1};
    const accel_ray ray = accel_ray_from(org, dir);
    accel_geometry geometry = {};
    geometry.type = ACCEL_SPHERES;
    const accel_scene scene = {&geometry, 1};
    accel *a;
    accel_error error;
    if (accel_build(&a, &scene, "linear", nullptr, &error) != ACCEL_OK)
        return 1;
    const bool hit = accel_any(a, &ray, nullptr);
    accel_free(a);
    return hit;
}
