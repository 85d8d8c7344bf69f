/* SPDX-License-Identifier: Apache-2.0 */
#include "photons_surface.h"

#include "photons_vector.h"

static void triangle_at(struct surface *out, const accel_triangles *mesh, const accel_hit *hit)
{
    double a[3], b[3], c[3];
    scene_vertex(mesh, hit->prim, 0, a);
    scene_vertex(mesh, hit->prim, 1, b);
    scene_vertex(mesh, hit->prim, 2, c);
    vector_subtract(b, b, a);
    vector_subtract(c, c, a);
    for (int k = 0; k < 3; k++) {
        out->at[k] = a[k] + (hit->u * b[k] + hit->v * c[k]);
    }
    vector_cross(out->normal, b, c);
}

static void sphere_at(struct surface *out, const double *sphere, const accel_ray *ray,
                      const accel_hit *hit)
{
    double on_ray[3];
    vector_add_scaled(on_ray, ray->org, hit->t, ray->dir);
    vector_subtract(out->normal, on_ray, sphere);
    vector_normalize(out->normal);
    vector_add_scaled(out->at, sphere, sphere[3], out->normal);
}

struct surface surface_at(const accel_scene *scene, const accel_ray *ray, const accel_hit *hit)
{
    struct surface out;
    const accel_geometry *geometry = &scene->geometries[hit->geom];
    if (geometry->type == ACCEL_TRIANGLES) {
        triangle_at(&out, &geometry->triangles, hit);
        vector_normalize(out.normal);
    } else {
        sphere_at(&out, scene_sphere(&geometry->spheres, hit->prim), ray, hit);
    }
    if (vector_dot(out.normal, ray->dir) > 0.0) {
        for (int k = 0; k < 3; k++) {
            out.normal[k] = -out.normal[k];
        }
    }
    return out;
}

static double triangle_area(const accel_triangles *mesh, uint32_t prim)
{
    double a[3], b[3], c[3], normal[3];
    scene_vertex(mesh, prim, 0, a);
    scene_vertex(mesh, prim, 1, b);
    scene_vertex(mesh, prim, 2, c);
    vector_subtract(b, b, a);
    vector_subtract(c, c, a);
    vector_cross(normal, b, c);
    return 0.5 * sqrt(vector_dot(normal, normal));
}

double scene_area(const accel_scene *scene)
{
    double area = 0.0;
    for (uint32_t g = 0; g < scene->count; g++) {
        const accel_geometry *geometry = &scene->geometries[g];
        for (uint32_t i = 0; geometry->type == ACCEL_TRIANGLES && i < geometry->triangles.count;
             i++) {
            area += triangle_area(&geometry->triangles, i);
        }
        for (uint32_t i = 0; geometry->type == ACCEL_SPHERES && i < geometry->spheres.count; i++) {
            const double radius = scene_sphere(&geometry->spheres, i)[3];
            area += 4.0 * acos(-1.0) * radius * radius;
        }
    }
    return area;
}
