/* SPDX-License-Identifier: Apache-2.0
 *
 * Prints what the compiler makes of the structures that the Python package declares again: a line
 * "name size" for each, and "name.field offset size" for each of its fields.
 */
#include <accel/accel.h>

#include <stdio.h>

#define TYPE(type) printf(#type " %zu\n", sizeof(type))
#define FIELD(type, field)                                                                         \
    printf(#type "." #field " %zu %zu\n", offsetof(type, field), sizeof(((type *)NULL)->field))

static void scenes(void)
{
    TYPE(accel_triangles);
    FIELD(accel_triangles, vertices);
    FIELD(accel_triangles, vertices_are_float);
    FIELD(accel_triangles, vertex_stride);
    FIELD(accel_triangles, vertex_count);
    FIELD(accel_triangles, indices);
    FIELD(accel_triangles, count);
    TYPE(accel_spheres);
    FIELD(accel_spheres, spheres);
    FIELD(accel_spheres, stride);
    FIELD(accel_spheres, count);
    TYPE(accel_geometry);
    FIELD(accel_geometry, type);
    FIELD(accel_geometry, triangles);
    FIELD(accel_geometry, spheres);
    TYPE(accel_scene);
    FIELD(accel_scene, geometries);
    FIELD(accel_scene, count);
    TYPE(accel_hooks);
    FIELD(accel_hooks, user);
    FIELD(accel_hooks, resize);
    FIELD(accel_hooks, progress);
    FIELD(accel_hooks, pilot);
    FIELD(accel_hooks, pilot_count);
    FIELD(accel_hooks, memory_limit);
    FIELD(accel_hooks, threads);
}

static void queries(void)
{
    TYPE(accel_error);
    FIELD(accel_error, status);
    FIELD(accel_error, text);
    TYPE(accel_id);
    FIELD(accel_id, geom);
    FIELD(accel_id, prim);
    TYPE(accel_ray);
    FIELD(accel_ray, org);
    FIELD(accel_ray, dir);
    FIELD(accel_ray, tmin);
    FIELD(accel_ray, tmax);
    FIELD(accel_ray, skip.geom);
    FIELD(accel_ray, skip.prim);
    TYPE(accel_hit);
    FIELD(accel_hit, t);
    FIELD(accel_hit, u);
    FIELD(accel_hit, v);
    FIELD(accel_hit, geom);
    FIELD(accel_hit, prim);
    TYPE(accel_query);
    FIELD(accel_query, user);
    FIELD(accel_query, nodes);
    FIELD(accel_query, tests);
    FIELD(accel_query, refused);
    FIELD(accel_query, outside);
}

static void description(void)
{
    TYPE(accel_info);
    FIELD(accel_info, kind);
    FIELD(accel_info, config);
    FIELD(accel_info, primitives);
    FIELD(accel_info, skipped);
    FIELD(accel_info, degenerate);
    FIELD(accel_info, unbounded);
    FIELD(accel_info, skipped_ids);
    FIELD(accel_info, size_classes);
    FIELD(accel_info, clusters);
    FIELD(accel_info, nodes);
    FIELD(accel_info, leaves);
    FIELD(accel_info, references);
    FIELD(accel_info, depth);
    FIELD(accel_info, bytes);
    FIELD(accel_info, peak_bytes);
    FIELD(accel_info, unbuilt_clusters);
    FIELD(accel_info, unbuilt_primitives);
    FIELD(accel_info, lazy_bytes);
    FIELD(accel_info, seconds);
    FIELD(accel_info, phase_count);
    FIELD(accel_info, phases);
    FIELD(accel_info, left_out_count);
    FIELD(accel_info, left_out);
    FIELD(accel_info, note_count);
    FIELD(accel_info, notes);
}

int main(void)
{
    scenes();
    queries();
    description();
    printf("statuses %d %d %d %d %d %d %d\n", ACCEL_OK, ACCEL_BAD_ARGUMENT, ACCEL_BAD_CONFIG,
           ACCEL_NO_MEMORY, ACCEL_TOO_LARGE, ACCEL_CANCELLED, ACCEL_BROKEN);
    printf("types %d %d\n", ACCEL_TRIANGLES, ACCEL_SPHERES);
    printf("version %d %d\n", ACCEL_VERSION_MAJOR, ACCEL_VERSION_MINOR);
    return 0;
}
