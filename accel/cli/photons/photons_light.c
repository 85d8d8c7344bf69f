/* SPDX-License-Identifier: Apache-2.0
 *
 * The lights of a scene, and reading one that a user typed.
 */
#include "photons.h"

#include "photons_vector.h"
#include "tool/words.h"

#include <string.h>

/* A rectangle parallel to the floor, around x and z, that shines down. */
static struct light ceiling(double lo_x, double lo_z, double wide, double deep, double y)
{
    return (struct light){
        .corner = {lo_x, y, lo_z}, .edge = {{wide, 0.0, 0.0}, {0.0, 0.0, deep}}, .power = 1.0};
}

uint32_t scene_lights(const char *name, const accel_scene *scene, struct light lights[MOST_LIGHTS])
{
    accel_box box;
    scene_box(scene, &box);
    double size[3];
    vector_subtract(size, box.hi, box.lo);
    if (strcspn(name, ":") == 5 && memcmp(name, "cubes", 5) == 0) {
        /* both clusters are as high as they are wide */
        const double side = size[1], y = box.hi[1] + 0.5 * side;
        lights[0] = ceiling(box.lo[0], box.lo[2], side, side, y);
        lights[1] = ceiling(box.hi[0] - side, box.lo[2], side, side, y);
        return 2;
    }
    const double diagonal = sqrt(vector_dot(size, size));
    const double whole = diagonal > 0.0 ? diagonal : 1.0; /* a flat scene has a light as well */
    lights[0] = ceiling(box.lo[0], box.lo[2], size[0] > 0.0 ? size[0] : whole,
                        size[2] > 0.0 ? size[2] : whole, box.hi[1] + 0.25 * whole);
    return 1;
}

const char *light_read(const char *text, struct light *light)
{
    double *const parts[] = {light->corner, light->edge[0], light->edge[1], &light->power};
    light->power = 1.0;
    for (int part = 0; part < 4 && (part < 3 || *text != '\0'); part++) {
        const size_t length = strcspn(text, ":");
        if (!read_numbers(text, length, parts[part], part < 3 ? 3 : 1)) {
            return "it is not CORNER:EDGE:EDGE[:POWER] with x,y,z for the first three";
        }
        text += length + (text[length] == ':' && part < 3);
    }
    double normal[3];
    vector_cross(normal, light->edge[0], light->edge[1]);
    if (*text != '\0') {
        return "it goes on after its power";
    }
    if (!(light->power > 0.0)) {
        return "its power is not positive";
    }
    const double square = vector_dot(normal, normal);
    return square > 0.0 && isfinite(square) ? NULL : "its edges span no area";
}
