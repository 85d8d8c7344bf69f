/* SPDX-License-Identifier: Apache-2.0
 *
 * Scenes of triangles as text in POV-Ray's scene description language, so that POV-Ray and this
 * project trace the same numbers.
 *
 * mesh2: POV-Ray keeps the vertices of a mesh as float, so they are rounded here; nine digits name
 * a float exactly. A mesh gets a normal for each vertex, the sum over the triangles of its geometry
 * that have a corner at that very place, weighted by area; POV-Ray shades with it and does not
 * let it move a hit.
 *
 * Triangles: POV-Ray keeps the corners of a single triangle as double; 17 digits name a double
 * exactly. They are data, not calls of a macro of the includer's: POV-Ray opens the file of a macro
 * anew for every call from another file (the teapots: 0.3 s to parse instead of 5 s).
 */
#include "sdl.h"

#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A vertex in the order of its place. */
typedef struct place {
    double at[3];
    uint32_t vertex;
} place;

static bool triangles_fit(const accel_triangles *mesh, uint32_t geometry, double limit,
                          accel_error *error)
{
    if (mesh->count == 0) {
        snprintf(error->text, sizeof error->text,
                 "geometry %" PRIu32 " has no triangles, which POV-Ray refuses", geometry);
        return false;
    }
    for (uint32_t prim = 0; prim < mesh->count; prim++) {
        for (int corner = 0; corner < 3; corner++) {
            double at[3];
            scene_vertex(mesh, prim, corner, at);
            if (!(fabs(at[0]) <= limit && fabs(at[1]) <= limit && fabs(at[2]) <= limit)) {
                snprintf(error->text, sizeof error->text,
                         "geometry %" PRIu32 ", triangle %" PRIu32 " has a coordinate that is not "
                         "a number or is beyond %g, which POV-Ray cannot read",
                         geometry, prim, limit);
                return false;
            }
        }
    }
    return true;
}

bool sdl_fits(const accel_scene *scene, enum sdl_form form, accel_error *error)
{
    const double limit = form == SDL_MESH2 ? (double)FLT_MAX : DBL_MAX;
    for (uint32_t i = 0; i < scene->count; i++) {
        if (scene->geometries[i].type != ACCEL_TRIANGLES) {
            snprintf(error->text, sizeof error->text,
                     "geometry %" PRIu32 " is not of triangles, the only ones to be exported", i);
            return false;
        }
        if (!triangles_fit(&scene->geometries[i].triangles, i, limit, error)) {
            return false;
        }
    }
    if (scene->count == 0) {
        snprintf(error->text, sizeof error->text, "the scene has no triangles");
    }
    return scene->count != 0;
}

static bool same_float(const double a[3], const double b[3])
{
    return (float)a[0] == (float)b[0] && (float)a[1] == (float)b[1] && (float)a[2] == (float)b[2];
}

static bool is_lost_as_float(const accel_triangles *mesh, uint32_t prim)
{
    double at[3][3];
    bool lost = false;
    for (int corner = 0; corner < 3; corner++) {
        scene_vertex(mesh, prim, corner, at[corner]);
    }
    for (int corner = 0; corner < 3; corner++) {
        const double *a = at[corner], *b = at[(corner + 1) % 3];
        if (memcmp(a, b, sizeof at[0]) == 0) {
            return false;
        }
        lost = lost || same_float(a, b);
    }
    return lost;
}

uint64_t sdl_lost_as_float(const accel_scene *scene)
{
    uint64_t lost = 0;
    for (uint32_t i = 0; i < scene->count; i++) {
        const accel_triangles *mesh = &scene->geometries[i].triangles;
        for (uint32_t prim = 0; prim < mesh->count; prim++) {
            lost += is_lost_as_float(mesh, prim);
        }
    }
    return lost;
}

static int compare_places(const void *a, const void *b)
{
    const place *p = a, *q = b;
    for (int k = 0; k < 3; k++) {
        if (p->at[k] != q->at[k]) {
            return p->at[k] < q->at[k] ? -1 : 1;
        }
    }
    return (p->vertex > q->vertex) - (p->vertex < q->vertex);
}

static bool same_place(const place *a, const place *b)
{
    return a->at[0] == b->at[0] && a->at[1] == b->at[1] && a->at[2] == b->at[2];
}

static void vertex_at(const accel_triangles *mesh, uint32_t vertex, double out[3])
{
    const accel_triangles alone = {.vertices = mesh->vertices,
                                   .vertices_are_float = mesh->vertices_are_float,
                                   .vertex_stride = mesh->vertex_stride,
                                   .vertex_count = mesh->vertex_count,
                                   .indices = (const uint32_t[3]){vertex, vertex, vertex},
                                   .count = 1};
    scene_vertex(&alone, 0, 0, out);
}

/* first[v] becomes the lowest vertex at the place of v. Returns false where memory runs out. */
static bool find_first_at_place(const accel_triangles *mesh, uint32_t *first)
{
    const uint32_t count = mesh->vertex_count;
    place *places = malloc(count * sizeof *places);
    if (places == NULL) {
        return false;
    }
    for (uint32_t i = 0; i < count; i++) {
        vertex_at(mesh, i, places[i].at);
        places[i].vertex = i;
    }
    qsort(places, count, sizeof *places, compare_places);
    uint32_t lowest = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (i == 0 || !same_place(&places[i - 1], &places[i])) {
            lowest = places[i].vertex;
        }
        first[places[i].vertex] = lowest;
    }
    free(places);
    return true;
}

/* Adds the triangle's normal, twice its area long, to those of its corners' places. */
static void add_normal(const accel_triangles *mesh, uint32_t prim, const uint32_t *first,
                       double (*normals)[3])
{
    double a[3], b[3], c[3], u[3], v[3];
    scene_vertex(mesh, prim, 0, a);
    scene_vertex(mesh, prim, 1, b);
    scene_vertex(mesh, prim, 2, c);
    for (int k = 0; k < 3; k++) {
        u[k] = b[k] - a[k];
        v[k] = c[k] - a[k];
    }
    for (int k = 0; k < 3; k++) {
        const int y = (k + 1) % 3, z = (k + 2) % 3;
        const double part = u[y] * v[z] - u[z] * v[y];
        for (int corner = 0; corner < 3; corner++) {
            normals[first[mesh->indices[3 * (size_t)prim + (size_t)corner]]][k] += part;
        }
    }
}

/* POV-Ray takes any vector but zero. */
static void write_normal(FILE *file, const double n[3])
{
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (length > 0.0 && length <= DBL_MAX) {
        fprintf(file, ",\n<%.5f,%.5f,%.5f>", n[0] / length, n[1] / length, n[2] / length);
    } else {
        fprintf(file, ",\n<0,1,0>");
    }
}

static bool write_normals(FILE *file, const accel_triangles *mesh)
{
    const uint32_t count = mesh->vertex_count;
    uint32_t *first = malloc(count * sizeof *first);
    double(*normals)[3] = calloc(count, sizeof *normals);
    const bool fine = first != NULL && normals != NULL && find_first_at_place(mesh, first);
    if (fine) {
        for (uint32_t prim = 0; prim < mesh->count; prim++) {
            add_normal(mesh, prim, first, normals);
        }
        fprintf(file, "normal_vectors {\n%" PRIu32, count);
        for (uint32_t i = 0; i < count; i++) {
            write_normal(file, normals[first[i]]);
        }
        fprintf(file, "\n}\n");
    }
    free(normals);
    free(first);
    return fine;
}

static bool write_mesh2(FILE *file, const accel_triangles *mesh)
{
    fprintf(file, "mesh2 {\nvertex_vectors {\n%" PRIu32, mesh->vertex_count);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        double at[3];
        vertex_at(mesh, i, at);
        fprintf(file, ",\n<%.9g,%.9g,%.9g>", (double)(float)at[0], (double)(float)at[1],
                (double)(float)at[2]);
    }
    fprintf(file, "\n}\n");
    if (!write_normals(file, mesh)) {
        return false;
    }
    fprintf(file, "face_indices {\n%" PRIu32, mesh->count);
    for (uint32_t i = 0; i < mesh->count; i++) {
        const uint32_t *corners = mesh->indices + 3 * (size_t)i;
        fprintf(file, ",\n<%" PRIu32 ",%" PRIu32 ",%" PRIu32 ">", corners[0], corners[1],
                corners[2]);
    }
    fprintf(file, "\n}\n}\n");
    return true;
}

static void write_corners(FILE *file, const accel_triangles *mesh, uint32_t prim,
                          const char *separator)
{
    double a[3], b[3], c[3];
    scene_vertex(mesh, prim, 0, a);
    scene_vertex(mesh, prim, 1, b);
    scene_vertex(mesh, prim, 2, c);
    fprintf(file, "%s{<%.17g,%.17g,%.17g>,<%.17g,%.17g,%.17g>,<%.17g,%.17g,%.17g>}", separator,
            a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]);
}

/* Row T of Corners: the corners of triangle T of the scene; geometry G has the triangles from
 * First[G] on, up to First[G + 1]. */
static void write_triangles(FILE *file, const accel_scene *scene)
{
    uint64_t first = 0;
    fprintf(file, "#declare First = array[%" PRIu32 "] {0", scene->count + 1);
    for (uint32_t i = 0; i < scene->count; i++) {
        first += scene->geometries[i].triangles.count;
        fprintf(file, ",%" PRIu64, first);
    }
    fprintf(file, "}\n#declare Corners = array[%" PRIu64 "][3] {", first);
    const char *separator = "\n";
    for (uint32_t i = 0; i < scene->count; i++) {
        const accel_triangles *mesh = &scene->geometries[i].triangles;
        for (uint32_t prim = 0; prim < mesh->count; prim++) {
            write_corners(file, mesh, prim, separator);
            separator = ",\n";
        }
    }
    fprintf(file, "\n}\n");
}

static bool write_meshes(FILE *file, const accel_scene *scene)
{
    fprintf(file, "#declare Geometry = array[%" PRIu32 "]\n", scene->count);
    for (uint32_t i = 0; i < scene->count; i++) {
        fprintf(file, "#declare Geometry[%" PRIu32 "] = ", i);
        if (!write_mesh2(file, &scene->geometries[i].triangles)) {
            return false;
        }
    }
    return true;
}

bool sdl_write(FILE *file, const accel_scene *scene, enum sdl_form form)
{
    fprintf(file, "// %" PRIu64 " triangles in %" PRIu32 " geometries, written by accel export.\n",
            scene_primitives(scene), scene->count);
    if (form == SDL_MESH2) {
        return write_meshes(file, scene);
    }
    write_triangles(file, scene);
    return true;
}
