/* SPDX-License-Identifier: Apache-2.0 */
#include "shapes.h"

#include <string.h>

const struct shape shapes[] = {
    {"sphere", SHAPE_FINITE | SHAPE_SOLID, "sphere { @p, @r", NULL},
    {"box", SHAPE_FINITE | SHAPE_SOLID, "box { @p, @o", NULL},
    {"cylinder", SHAPE_FINITE | SHAPE_SOLID, "cylinder { @p, @o, @r [open]", NULL},
    {"cone", SHAPE_FINITE | SHAPE_SOLID, "cone { @p, @u, @o, @r [open]", NULL},
    {"torus", SHAPE_FINITE | SHAPE_SOLID | SHAPE_STURM, "torus { @r, @r", NULL},
    {"superellipsoid", SHAPE_FINITE | SHAPE_SOLID, "superellipsoid { <3 * @r, 3 * @r>", NULL},
    {"ovus", SHAPE_FINITE | SHAPE_SOLID | SHAPE_STURM, NULL, write_ovus},
    {"prism", SHAPE_FINITE | SHAPE_SOLID | SHAPE_STURM, NULL, write_prism},
    {"lathe", SHAPE_FINITE | SHAPE_SOLID | SHAPE_STURM | SHAPE_LOOSE, NULL, write_lathe},
    {"sor", SHAPE_FINITE | SHAPE_SOLID | SHAPE_STURM | SHAPE_LOOSE, NULL, write_sor},
    {"sphere_sweep", SHAPE_FINITE | SHAPE_SOLID, NULL, write_sphere_sweep},
    {"text", SHAPE_FINITE, NULL, write_text_object}, /* its inside may go on to the left */
    {"blob", SHAPE_FINITE | SHAPE_SOLID | SHAPE_STURM | SHAPE_HIERARCHY, NULL, write_blob},
    {"blob_negative", SHAPE_FINITE | SHAPE_STURM | SHAPE_HIERARCHY, NULL, write_blob_negative},
    {"julia_fractal", SHAPE_FINITE, NULL, write_julia_fractal},
    {"isosurface", SHAPE_FINITE, NULL, write_isosurface},
    {"height_field", SHAPE_FINITE | SHAPE_HIERARCHY,
     "height_field { function 9, 7 { 0.5 + 0.5 * sin(x * 9 * @s) * cos(y * 9 * @s) } "
     "[water_level @u / 2] [smooth] translate -0.5 scale 1.6",
     NULL},
    {"disc", SHAPE_FINITE, "disc { @p, @d, @r[, 0.1 * @u]", NULL},
    {"polygon", SHAPE_FINITE, NULL, write_polygon},
    {"triangle", SHAPE_FINITE | SHAPE_PATCH, "triangle { @p, @o, @o", NULL},
    {"smooth_triangle", SHAPE_FINITE | SHAPE_PATCH, NULL, write_smooth_triangle},
    {"bicubic_patch", SHAPE_FINITE | SHAPE_PATCH, NULL, write_bicubic_patch},
    {"mesh", SHAPE_FINITE | SHAPE_PATCH | SHAPE_HIERARCHY, NULL, write_mesh},
    {"mesh_closed", SHAPE_FINITE | SHAPE_HIERARCHY, NULL, write_mesh_closed},
    {"mesh2", SHAPE_FINITE | SHAPE_HIERARCHY, NULL, write_mesh2},
    {"parametric", SHAPE_FINITE | SHAPE_PATCH,
     "parametric { function { (0.4 + 0.6 * @u + 0.2 * cos(v)) * cos(u) }, "
     "function { @r * sin(v) + 0.1 * u }, function { (0.5 + 0.3 * cos(v)) * sin(u) } "
     "<0, 0>, <6.3 * @u, 3.2> contained_by { box { -1.2, 1.2 * @u } } "
     "max_gradient 3 accuracy 0.02 [precompute 6, x, y, z]",
     NULL},
    {"plane", 0, "plane { @d, @s", NULL},
    {"quadric", 0, NULL, write_quadric},
    {"poly", SHAPE_STURM, NULL, write_poly},
};

const int shape_count = (int)(sizeof shapes / sizeof shapes[0]);

int shape_named(const char *name)
{
    for (int i = 0; i < shape_count; i++) {
        if (strcmp(shapes[i].name, name) == 0) {
            return i;
        }
    }
    return -1;
}
