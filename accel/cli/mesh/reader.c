/* SPDX-License-Identifier: Apache-2.0
 *
 * What the readers of all formats share: see reader.h.
 */
#include "reader.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The way of errors is the only one, and as long as they are. */
__attribute__((format(printf, 3, 0))) static bool refuse(mesh_reader *r, const char *where,
                                                         const char *format, va_list arguments)
{
    char trouble[250];
    vsnprintf(trouble, sizeof trouble, format, arguments);
    r->error->status = ACCEL_BAD_ARGUMENT;
    snprintf(r->error->text, sizeof r->error->text, "%.180s%s: %s; nothing was loaded",
             r->source->name, where, trouble);
    return false;
}

bool mesh_refuse_line(mesh_reader *r, uint64_t line, const char *format, ...)
{
    char where[32];
    snprintf(where, sizeof where, ":%llu", (unsigned long long)line);
    va_list arguments;
    va_start(arguments, format);
    refuse(r, where, format, arguments);
    va_end(arguments);
    return false;
}

bool mesh_refuse_byte(mesh_reader *r, const char *at, const char *format, ...)
{
    char where[40];
    snprintf(where, sizeof where, ", byte %llu", (unsigned long long)(at - r->source->bytes) + 1);
    va_list arguments;
    va_start(arguments, format);
    refuse(r, where, format, arguments);
    va_end(arguments);
    return false;
}

bool mesh_refuse(mesh_reader *r, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    refuse(r, "", format, arguments);
    va_end(arguments);
    return false;
}

bool mesh_refuse_memory(mesh_reader *r)
{
    mesh_refuse(r, "does not fit into memory, or has more than 4294967294 vertices or triangles");
    r->error->status = ACCEL_NO_MEMORY;
    return false;
}

bool mesh_expect(mesh_reader *r, const char *wanted)
{
    char found[MESH_FOUND_TEXT];
    return mesh_refuse_line(r, r->text.line, "found %s, allowed is %s", mesh_found(&r->text, found),
                            wanted);
}

void mesh_note(mesh_reader *r, const char *format, ...)
{
    char *note = r->out->note;
    const size_t length = strlen(note), capacity = sizeof r->out->note;
    const int more = snprintf(note + length, capacity - length, "%s", length == 0 ? "" : "; ");
    va_list arguments;
    va_start(arguments, format);
    if (length + (size_t)more < capacity) {
        vsnprintf(note + length + (size_t)more, capacity - length - (size_t)more, format,
                  arguments);
    }
    va_end(arguments);
}

void mesh_note_rest(mesh_reader *r, const char *at)
{
    const char *const end = r->source->bytes + r->source->size;
    const char *first = at;
    while (first < end && mesh_is(*first, MESH_BLANK | MESH_LINE_END)) {
        first++;
    }
    if (first < end) {
        mesh_note(r, "its last %llu bytes, behind the mesh, are not read",
                  (unsigned long long)(end - first));
    }
}

bool mesh_indices_add(mesh_indices *indices, uint32_t item)
{
    if (indices->count == indices->capacity) {
        const size_t capacity = 2 * indices->capacity + 16;
        uint32_t *items = indices->count >= UINT32_MAX - 1
                              ? NULL
                              : realloc(indices->items, capacity * sizeof *items);
        if (items == NULL) {
            return false;
        }
        indices->items = items;
        indices->capacity = capacity;
    }
    indices->items[indices->count++] = item;
    return true;
}

/* Remembers a face of which triangles stand from `triangle` on, for mesh_cut_late. */
static bool remember_late(mesh_reader *r, size_t triangle)
{
    if (r->late_count == r->late_room) {
        const size_t capacity = 2 * r->late_room + 16;
        mesh_late *late = realloc(r->late, capacity * sizeof *late);
        if (late == NULL) {
            return mesh_refuse_memory(r);
        }
        r->late = late;
        r->late_room = capacity;
    }
    r->late[r->late_count++] =
        (mesh_late){triangle, r->late_corners.count, (uint32_t)r->face.count};
    for (size_t i = 0; i < r->face.count; i++) {
        if (!mesh_indices_add(&r->late_corners, r->face.items[i])) {
            return mesh_refuse_memory(r);
        }
    }
    return true;
}

static bool cut(mesh_reader *r, const uint32_t *corners, uint32_t count, size_t triangle)
{
    if (mesh_cut(&r->cutter, r->mesh.numbers, corners, count, r->mesh.indices + 3 * triangle)) {
        return true;
    }
    return r->cutter.work <= r->cutter.most_work
               ? mesh_refuse_memory(r)
               : mesh_refuse(r,
                             "its concave faces have too many corners, one of them %lu: cutting "
                             "them into triangles takes too long",
                             (unsigned long)count);
}

/* A face of more than three corners: a fan first, which stays where it can only be cut later. */
static bool add_polygon(mesh_reader *r, uint64_t place)
{
    const uint32_t *corners = r->face.items;
    const size_t triangle = r->mesh.index_count / 3;
    bool there = true;
    for (size_t i = 0; i < r->face.count; i++) {
        there = there && corners[i] < r->mesh.number_count / 3;
    }
    for (size_t i = 1; i + 1 < r->face.count; i++) {
        mesh_add_triangle(r, (const uint32_t[3]){corners[0], corners[i], corners[i + 1]}, place);
    }
    if (r->mesh.failed) {
        return mesh_refuse_memory(r);
    }
    return there ? cut(r, corners, (uint32_t)r->face.count, triangle) : remember_late(r, triangle);
}

bool mesh_add_face(mesh_reader *r, uint64_t place)
{
    bool fine = true;
    if (r->face.count == 3) {
        mesh_add_triangle(r, r->face.items, place);
    } else if (r->face.count < 3) {
        r->out->left_out++;
    } else {
        fine = add_polygon(r, place);
    }
    r->face.count = 0;
    return fine;
}

bool mesh_cut_late(mesh_reader *r)
{
    for (size_t i = 0; i < r->late_count; i++) {
        const mesh_late *late = &r->late[i];
        if (!cut(r, r->late_corners.items + late->corner, late->corner_count, late->triangle)) {
            return false;
        }
    }
    return true;
}

bool mesh_add_geometry(mesh_reader *r)
{
    if (r->mesh.index_count == 0 && !r->mesh.failed) {
        free(r->mesh.numbers);
        free(r->mesh.indices);
        r->mesh = (struct growing){0};
        return true;
    }
    return loaded_add(r->out, ACCEL_TRIANGLES, &r->mesh) || mesh_refuse_memory(r);
}
