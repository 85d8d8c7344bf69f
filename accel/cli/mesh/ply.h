/* SPDX-License-Identifier: Apache-2.0
 *
 * The header of a PLY file, between its reader and that of what follows.
 */
#ifndef ACCEL_CLI_MESH_PLY_H
#define ACCEL_CLI_MESH_PLY_H

#include "reader.h"

/* Types of numbers. */
typedef enum ply_type {
    PLY_NONE,
    PLY_INT8,
    PLY_UINT8,
    PLY_INT16,
    PLY_UINT16,
    PLY_INT32,
    PLY_UINT32,
    PLY_INT64,
    PLY_UINT64,
    PLY_FLOAT,
    PLY_DOUBLE
} ply_type;

/* What an element is to the mesh. */
typedef enum ply_role { PLY_OTHER, PLY_VERTEX, PLY_FACE, PLY_STRIPS, PLY_EDGE } ply_role;

/* What a property is to its element: x, y and z of a vertex are 0, 1 and 2. */
enum { PLY_CORNERS = 3, PLY_UNUSED = 4 };

typedef struct ply_property {
    ply_type type;
    ply_type list; /* of the count of a list, or PLY_NONE */
    int use;       /* 0, 1, 2, PLY_CORNERS or PLY_UNUSED */
} ply_property;

typedef struct ply_element {
    const char *name; /* `name_length` characters in the file */
    size_t name_length;
    ply_role role;
    uint64_t count;
    uint64_t line;                /* of the header */
    size_t first, property_count; /* in ply.properties */
} ply_element;

typedef struct ply {
    ply_element *elements; /* `element_count` of them */
    size_t element_count, element_room;
    ply_property *properties; /* of all elements, `property_count` of them */
    size_t property_count, property_room;
    enum { PLY_TEXT, PLY_LITTLE, PLY_BIG } form;
} ply;

/* Bytes of a number; 0 for PLY_NONE. */
size_t ply_size(ply_type type);

/* Reads the header from r->text, up to what follows it. False: refused. */
bool ply_read_header(mesh_reader *r, ply *p);

#endif
