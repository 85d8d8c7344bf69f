/* SPDX-License-Identifier: Apache-2.0
 *
 * What the readers of all formats share: the mesh under way, its faces, and the line that says why
 * a file is refused. The first refusal stays.
 */
#ifndef ACCEL_CLI_MESH_READER_H
#define ACCEL_CLI_MESH_READER_H

#include "mesh.h"
#include "polygon.h"
#include "loaded.h"
#include "text.h"

/* A face whose corners were not all there when it was read: it is cut again at the end. */
typedef struct mesh_late {
    size_t triangle; /* the first of its triangles */
    size_t corner;   /* the first of its corners in mesh_reader.late_corners */
    uint32_t corner_count;
} mesh_late;

/* A growing array of indices. */
typedef struct mesh_indices {
    uint32_t *items;
    size_t count, capacity;
} mesh_indices;

/* A mesh file under way. */
typedef struct mesh_reader {
    const struct mesh_source *source;
    struct loaded *out;
    accel_error *error;
    mesh_text text;      /* of text formats */
    struct growing mesh; /* vertices and triangles of the geometry under way */
    mesh_indices face;   /* corners of the face under way */
    mesh_cutter cutter;  /* for faces of more than three */
    mesh_late *late;     /* `late_count` of them */
    size_t late_count, late_room;
    mesh_indices late_corners;
    uint64_t largest;       /* corner plus one of all faces so far */
    uint64_t largest_place; /* line or byte of its face */
    uint64_t ticks;
} mesh_reader;

/* Reads one format. False: refused. */
typedef bool mesh_read(mesh_reader *r);
mesh_read mesh_read_obj, mesh_read_ply, mesh_read_stl, mesh_read_off, mesh_read_gltf;

/* Refuse the file: "NAME:LINE: ...", "NAME, byte N: ..." or "NAME: ...", and what happened. Return
 * false. */
bool mesh_refuse_line(mesh_reader *r, uint64_t line, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
bool mesh_refuse_byte(mesh_reader *r, const char *at, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
bool mesh_refuse(mesh_reader *r, const char *format, ...) __attribute__((format(printf, 2, 3)));
bool mesh_refuse_memory(mesh_reader *r);

/* Refuses what text has at this place: "found ..., allowed is WANTED". */
bool mesh_expect(mesh_reader *r, const char *wanted);

/* Adds to the note that goes with the mesh. */
void mesh_note(mesh_reader *r, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Notes bytes from `at` on that are not read, where there are others than blanks. */
void mesh_note_rest(mesh_reader *r, const char *at);

/* To be called for each element: shows progress now and then. */
static inline void mesh_tick(mesh_reader *r)
{
    if ((++r->ticks & 0xffff) == 0 && r->source->progress != NULL) {
        r->source->progress(r->source->user, "reading");
    }
}

/* Adds an item. False: no memory, or more than 2^32 - 2. */
bool mesh_indices_add(mesh_indices *indices, uint32_t item);

/* Adds a triangle whose corners may be beyond the vertices that are there until now. `place` is its
 * line or byte. */
static inline void mesh_add_triangle(mesh_reader *r, const uint32_t corners[3], uint64_t place)
{
    for (int k = 0; k < 3; k++) {
        if (corners[k] >= r->largest) {
            r->largest = (uint64_t)corners[k] + 1;
            r->largest_place = place;
        }
    }
    grow_triangle(&r->mesh, corners[0], corners[1], corners[2]);
}

/* Makes triangles of the corners in r->face, and empties it. A face of one or two is counted as
 * left out. False: refused. */
bool mesh_add_face(mesh_reader *r, uint64_t place);

/* After the last vertex: cuts the faces that came before their corners. The largest corner must
 * have been compared with the vertices. */
bool mesh_cut_late(mesh_reader *r);

/* Hands the mesh over as one geometry, where it has triangles; it then is empty. */
bool mesh_add_geometry(mesh_reader *r);

#endif
