/* SPDX-License-Identifier: Apache-2.0
 *
 * Which format is it? And what is done before and after its reader.
 */
#include "mesh.h"

#include "off.h"
#include "reader.h"
#include "stl.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Corners compared with ears, at a few nanoseconds each: enough for a spiral of 65,536 corners. */
#define MOST_CUTTING ((uint64_t)1 << 32)

/* The text of a file, behind its byte-order mark. */
static mesh_text text_of(const char *bytes, size_t size)
{
    const bool marked = size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0;
    return (mesh_text){
        .at = bytes + (marked ? 3 : 0), .begin = bytes, .end = bytes + size, .line = 1};
}

static bool is_ply(const mesh_text *start)
{
    mesh_text text = *start;
    if (!mesh_skip_space(&text) || !mesh_take_this(&text, "ply")) {
        return false;
    }
    mesh_skip_blanks(&text);
    return mesh_at_line_end(&text);
}

static bool is_gltf(const mesh_text *start)
{
    mesh_text text = *start;
    if (text.end - text.begin >= 4 && memcmp(text.begin, "glTF", 4) == 0) {
        return true;
    }
    return mesh_skip_space(&text) && *text.at == '{' &&
           memmem(text.at, (size_t)(text.end - text.at), "\"asset\"", 7) != NULL;
}

/* Do statements that no other format has come before anything else: a vertex of three numbers, or
 * the name of a library of materials? */
static bool is_obj(const mesh_text *start)
{
    static const char *const before[] = {"o", "g", "s", "vn", "vt", "usemtl"};
    mesh_text text = *start;
    text.comment = '#';
    for (bool known = true; known && mesh_skip_space(&text); mesh_skip_line(&text)) {
        const char *word;
        double number;
        const size_t length = mesh_take_word(&text, &word);
        if (mesh_same_word(word, length, "v")) {
            for (int k = 0; k < 3 && known; k++) {
                mesh_skip_blanks(&text);
                known = mesh_take_number(&text, &number);
            }
            return known;
        }
        if (mesh_same_word(word, length, "mtllib")) {
            return true;
        }
        known = false;
        for (size_t i = 0; i < sizeof before / sizeof before[0]; i++) {
            known = known || mesh_same_word(word, length, before[i]);
        }
    }
    return false;
}

static enum mesh_format by_name(const char *name)
{
    static const struct {
        const char *ending;
        enum mesh_format format;
    } endings[] = {{".obj", MESH_OBJ}, {".ply", MESH_PLY},   {".stl", MESH_STL},
                   {".off", MESH_OFF}, {".gltf", MESH_GLTF}, {".glb", MESH_GLTF}};
    const size_t length = strlen(name);
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; i++) {
        const size_t size = strlen(endings[i].ending);
        if (length >= size && strcasecmp(name + length - size, endings[i].ending) == 0) {
            return endings[i].format;
        }
    }
    return MESH_OTHER;
}

static enum mesh_format by_content(const mesh_text *text)
{
    mesh_text commented = *text;
    commented.comment = '#';
    if (is_ply(text)) {
        return MESH_PLY;
    }
    if (is_gltf(text)) {
        return MESH_GLTF;
    }
    if (mesh_is_binary_stl(text->begin, (size_t)(text->end - text->begin)) ||
        mesh_is_text_stl(text)) {
        return MESH_STL;
    }
    if (mesh_is_off(&commented)) {
        return MESH_OFF;
    }
    return is_obj(text) ? MESH_OBJ : MESH_OTHER;
}

enum mesh_format mesh_recognise(const char *name, const char *bytes, size_t size)
{
    const mesh_text text = text_of(bytes, size);
    const enum mesh_format format = by_content(&text);
    return format == MESH_OTHER ? by_name(name) : format;
}

static bool is_utf16(const struct mesh_source *source)
{
    return source->size >= 2 &&
           (memcmp(source->bytes, "\xFF\xFE", 2) == 0 || memcmp(source->bytes, "\xFE\xFF", 2) == 0);
}

static void free_reader(mesh_reader *r)
{
    free(r->mesh.numbers);
    free(r->mesh.indices);
    free(r->face.items);
    free(r->late);
    free(r->late_corners.items);
    mesh_cutter_free(&r->cutter);
}

static bool finish(mesh_reader *r)
{
    if (r->out->scene.count == 0) {
        return mesh_refuse(r, "holds no triangle; %llu points and lines are there",
                           (unsigned long long)r->out->left_out);
    }
    if (r->cutter.not_simple != 0) {
        mesh_note(r, "%llu faces cross themselves, and are cut somehow",
                  (unsigned long long)r->cutter.not_simple);
    }
    return true;
}

static bool is_gzip(const struct mesh_source *source)
{
    return source->size >= 2 && memcmp(source->bytes, "\x1f\x8b", 2) == 0;
}

/* Without its reader: what is no mesh in any of the formats. */
static bool read_as(mesh_reader *r, enum mesh_format format)
{
    static mesh_read *const readers[] = {[MESH_OBJ] = mesh_read_obj,
                                         [MESH_PLY] = mesh_read_ply,
                                         [MESH_STL] = mesh_read_stl,
                                         [MESH_OFF] = mesh_read_off,
                                         [MESH_GLTF] = mesh_read_gltf};
    if (format == MESH_OTHER) {
        return mesh_refuse(r, "is no OBJ, PLY, STL, OFF or glTF file");
    }
    if (is_utf16(r->source) && !mesh_is_binary_stl(r->source->bytes, r->source->size)) {
        return mesh_refuse(r, "is text in UTF-16, allowed is UTF-8");
    }
    if (is_gzip(r->source) && !mesh_is_binary_stl(r->source->bytes, r->source->size)) {
        return mesh_refuse(r, "is compressed by gzip, allowed is what it holds");
    }
    return readers[format](r) && finish(r);
}

bool mesh_load(struct loaded *out, const struct mesh_source *source, accel_error *error)
{
    mesh_reader r = {.source = source,
                     .out = out,
                     .error = error,
                     .text = text_of(source->bytes, source->size),
                     .cutter.most_work = MOST_CUTTING};
    const bool fine = read_as(&r, mesh_recognise(source->name, source->bytes, source->size));
    free_reader(&r);
    return fine;
}
