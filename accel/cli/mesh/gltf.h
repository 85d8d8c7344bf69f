/* SPDX-License-Identifier: Apache-2.0
 *
 * Between the parts of the reader of glTF 2.0 (Khronos Group, "glTF 2.0 Specification", 2021).
 */
#ifndef ACCEL_CLI_MESH_GLTF_H
#define ACCEL_CLI_MESH_GLTF_H

#include "reader.h"

#include <jansson.h>

/* An object of one of the lists at the top, with its name for messages: LIST[INDEX]. */
typedef struct gltf_object {
    json_t *json;
    const char *list;
    size_t index;
} gltf_object;

/* The bytes of a buffer; those of a file or a text are `owned`. */
typedef struct gltf_buffer {
    const char *bytes;
    char *owned;
    size_t size;
} gltf_buffer;

/* A map from a node to the scene: the upper three rows. */
typedef struct gltf_matrix {
    double m[3][4];
} gltf_matrix;

/* A mesh as it stands in the scene. */
typedef struct gltf_placed {
    size_t node, mesh;
} gltf_placed;

/* A primitive of triangles. Where its vertices are is read when it is placed: many primitives may
 * share them. */
typedef struct gltf_primitive {
    json_t *json;
    uint32_t *triangles; /* three corners for each of `triangle_count` */
    uint32_t vertex_count, triangle_count;
} gltf_primitive;

typedef struct gltf_mesh {
    bool read;
    gltf_primitive *primitives; /* `count` of them */
    size_t count;
    uint64_t triangles, bytes; /* of all of them, where they are placed once */
    uint64_t left_out;         /* points and lines of others */
} gltf_mesh;

/* The joints of a skin: a matrix for each, from the mesh to the scene. */
typedef struct gltf_skin {
    gltf_object object;
    gltf_matrix *joints; /* `count` of them; NULL: not needed until now */
    size_t count;
} gltf_skin;

/* The file under way. */
typedef struct gltf {
    mesh_reader *r;
    json_t *root;
    const char *chunk; /* the binary chunk, or NULL */
    size_t chunk_size;
    gltf_buffer *buffers; /* of `buffer_count`; those not needed until now are without bytes */
    size_t buffer_count;
    gltf_mesh *meshes; /* of `mesh_count` */
    size_t mesh_count;
    gltf_skin *skins; /* of `skin_count` */
    size_t skin_count;
    gltf_matrix *matrices; /* from each node to the scene, of `node_count` */
    bool *reached;         /* the nodes that are in the scene */
    size_t node_count;
    gltf_placed *placed; /* `placed_count` of them, in order */
    size_t placed_count, placed_room;
    uint64_t bytes;    /* of memory that triangles of meshes take, before they are placed */
    uint64_t work;     /* numbers that have been read from accessors */
    bool is_quantized; /* coordinates may be whole numbers */
} gltf;

/* An accessor: numbers in a buffer. */
typedef struct gltf_accessor {
    gltf_object object;
    uint64_t count;    /* of elements */
    int type;          /* of a component: 5120 to 5126 */
    int components;    /* of an element */
    bool normalized;   /* whole numbers stand for -1 to 1, or 0 to 1 */
    const char *bytes; /* of element 0, or NULL: all are zero */
    size_t stride;     /* from element to element */
} gltf_accessor;

/* ---- gltf_json.c: what the objects say; every one refuses what is wrong ---- */

/* LIST[INDEX] at the top. */
bool gltf_find(gltf *g, const char *list, uint64_t index, gltf_object *found);

/* The length of a list at the top. */
size_t gltf_count(const gltf *g, const char *list);

#define GLTF_REQUIRED UINT64_MAX
#define GLTF_MOST     ((uint64_t)1 << 53)

/* A whole number from 0 to `most`, or `standard` where it is not given, which GLTF_REQUIRED
 * refuses. `json` is `object` or a part of it. */
bool gltf_whole(gltf *g, const gltf_object *object, json_t *json, const char *key,
                uint64_t standard, uint64_t most, uint64_t *number);

/* `count` finite numbers; *given says whether they are there. */
bool gltf_numbers(gltf *g, const gltf_object *object, const char *key, size_t count,
                  double *numbers, bool *given);

/* A list, or NULL with *fine false where it is none. */
json_t *gltf_list(gltf *g, const gltf_object *object, json_t *json, const char *key, bool *fine);

/* "LIST[INDEX] TROUBLE". */
bool gltf_refuse(gltf *g, const gltf_object *object, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* ---- gltf_accessor.c ---- */

bool gltf_open_accessor(gltf *g, uint64_t index, gltf_accessor *accessor);

/* Writes count * components numbers, sparse ones in their place. Refused where many readings of
 * shared accessors take too long. */
bool gltf_read_accessor(gltf *g, const gltf_accessor *accessor, double *numbers);

/* Allocates as many, which the caller frees, and reads. NULL: refused. */
double *gltf_load_accessor(gltf *g, const gltf_accessor *accessor);

/* ---- gltf_buffer.c ---- */

/* `size` bytes from `offset` on of a buffer view, or NULL: refused. */
const char *gltf_view(gltf *g, uint64_t view, uint64_t offset, uint64_t size, size_t *stride,
                      const gltf_object *user);

/* ---- gltf_scene.c ---- */

/* Fills matrices, reached and placed. */
bool gltf_walk(gltf *g);

gltf_matrix gltf_product(const gltf_matrix *a, const gltf_matrix *b);
void gltf_apply(const gltf_matrix *a, const double place[3], double out[3]);

/* The matrix of 16 numbers, column by column. */
gltf_matrix gltf_from_columns(const double columns[16]);

/* ---- gltf_mesh.c ---- */

/* Reads the primitives of a mesh, once. NULL: refused. */
const gltf_mesh *gltf_read_mesh(gltf *g, size_t index);

/* ---- gltf_shape.c ---- */

/* Are the numbers of an accessor coordinates? Opens it as those of a primitive. */
bool gltf_open_places(gltf *g, const gltf_object *mesh, json_t *primitive, gltf_accessor *a);

/* Writes where the vertices of a primitive are in the scene: moved by morph targets, then by skin
 * or matrix. */
bool gltf_place(gltf *g, const gltf_placed *placed, const gltf_primitive *primitive,
                double *places);

#endif
