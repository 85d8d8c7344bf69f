/* SPDX-License-Identifier: Apache-2.0
 *
 * STL (3D Systems, "StereoLithography Interface Specification", 1989), binary and text. Normals,
 * attributes and names are passed over. Each solid of a text is a geometry.
 *
 * Text is told by its first words and not by 'solid' alone, with which binary files begin as well.
 */
#include "reader.h"

#include "bytes.h"
#include "stl.h"

enum { HEADER = 84, FACET = 50 };

/* Does the text go on with this word, in any case? Then takes it. */
static bool take(mesh_text *text, const char *wanted)
{
    const mesh_text before = *text;
    if (mesh_skip_space(text) && mesh_take_this(text, wanted)) {
        return true;
    }
    *text = before;
    return false;
}

/* The word may be written as two: 'end' and the rest of it. */
static bool take_end(mesh_text *text, const char *wanted)
{
    const mesh_text before = *text;
    if (take(text, wanted) || (take(text, "end") && take(text, wanted + 3))) {
        return true;
    }
    *text = before;
    return false;
}

static bool take_facet_begin(mesh_text *text)
{
    const mesh_text before = *text;
    if (take(text, "facet") && (take(text, "normal") || take(text, "outer"))) {
        return true;
    }
    *text = before;
    return false;
}

/* The name goes on to the end of the line, or up to the first facet. */
static void skip_name(mesh_text *text)
{
    const char *ignored;
    while (mesh_skip_blanks(text), !mesh_at_line_end(text)) {
        const mesh_text before = *text;
        if (take_facet_begin(text)) {
            *text = before;
            return;
        }
        mesh_take_word(text, &ignored);
    }
}

/* The header of a binary file may hold any words, but the count behind it has a zero byte where
 * there are less than 2^24 triangles. */
static bool begins_as_text(mesh_text *text)
{
    const bool zero =
        text->end - text->begin >= HEADER && memchr(text->begin + HEADER - 4, 0, 4) != NULL;
    return !zero && take(text, "solid");
}

bool mesh_is_text_stl(const mesh_text *start)
{
    mesh_text text = *start;
    if (!begins_as_text(&text)) {
        return false;
    }
    skip_name(&text);
    return take_facet_begin(&text) || take_end(&text, "endsolid");
}

bool mesh_is_binary_stl(const char *bytes, size_t size)
{
    return size >= HEADER && (size - HEADER) % FACET == 0 &&
           (size - HEADER) / FACET == mesh_bytes32(bytes + HEADER - 4, false);
}

/* Refuses what is there in place of `wanted`. */
static bool expect(mesh_reader *r, const char *wanted)
{
    mesh_skip_space(&r->text);
    return mesh_expect(r, wanted);
}

static bool take_vertex(mesh_reader *r)
{
    double place[3];
    if (!take(&r->text, "vertex")) {
        return expect(r, "'vertex', three times in a loop");
    }
    for (int k = 0; k < 3; k++) {
        if (!mesh_skip_space(&r->text) || !mesh_take_number(&r->text, &place[k])) {
            return mesh_expect(r, "a decimal number in the range of double");
        }
    }
    grow_vertex(&r->mesh, place[0], place[1], place[2]);
    return true;
}

/* The normal is not read: many writers put no numbers there. */
static bool take_loop_begin(mesh_reader *r)
{
    mesh_text *text = &r->text;
    const char *ignored;
    take(text, "facet");
    if (take(text, "normal")) {
        for (int k = 0; k < 3; k++) {
            if (!mesh_skip_space(text) || mesh_take_word(text, &ignored) == 0) {
                return expect(r, "three numbers of a normal");
            }
        }
    }
    return (take(text, "outer") || expect(r, "'outer loop'")) &&
           (take(text, "loop") || expect(r, "'loop' behind 'outer'"));
}

static bool take_facet(mesh_reader *r)
{
    const uint64_t line = r->text.line;
    const uint32_t first = (uint32_t)(r->mesh.number_count / 3);
    if (!take_loop_begin(r)) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        if (!take_vertex(r)) {
            return false;
        }
    }
    mesh_add_triangle(r, (const uint32_t[3]){first, first + 1, first + 2}, line);
    mesh_tick(r);
    return (take_end(&r->text, "endloop") || expect(r, "'endloop' behind three vertices")) &&
           (take_end(&r->text, "endfacet") || expect(r, "'endfacet'"));
}

static bool is_next_facet(const mesh_text *text)
{
    mesh_text ahead = *text;
    return take(&ahead, "facet");
}

static bool read_text(mesh_reader *r)
{
    mesh_text *text = &r->text;
    while (take(text, "solid")) {
        skip_name(text);
        while (is_next_facet(text)) {
            if (!take_facet(r)) {
                return false;
            }
        }
        if (!take_end(text, "endsolid")) {
            return expect(r, "'facet' or 'endsolid'");
        }
        mesh_skip_line(text);
        if (!mesh_add_geometry(r)) {
            return false;
        }
    }
    mesh_note_rest(r, text->at);
    return true;
}

static bool read_binary(mesh_reader *r)
{
    const char *at = r->source->bytes + HEADER;
    const uint64_t size = r->source->size;
    const uint64_t count = size < HEADER ? 0 : mesh_bytes32(at - 4, false);
    const uint64_t there = size < HEADER ? 0 : (size - HEADER) / FACET;
    if (size < HEADER || count > there) {
        return mesh_refuse(r,
                           "its STL header promises %llu triangles, but the file has %llu bytes, "
                           "which hold %llu, and is no text of 'solid', 'facet' and so on",
                           (unsigned long long)count, (unsigned long long)size,
                           (unsigned long long)there);
    }
    for (uint64_t i = 0; i < count; i++, at += FACET) {
        const uint32_t first = (uint32_t)(r->mesh.number_count / 3);
        for (int v = 1; v <= 3; v++) {
            const char *vertex = at + 12 * v;
            grow_vertex(&r->mesh, mesh_float(vertex, false), mesh_float(vertex + 4, false),
                        mesh_float(vertex + 8, false));
        }
        mesh_add_triangle(r, (const uint32_t[3]){first, first + 1, first + 2}, 0);
        mesh_tick(r);
    }
    mesh_note_rest(r, at);
    return mesh_add_geometry(r);
}

/* What begins as text does and is too short for its binary header is text with a fault. */
static bool is_text(const mesh_reader *r)
{
    const size_t size = r->source->size;
    mesh_text text = r->text;
    return mesh_is_text_stl(&text) ||
           (begins_as_text(&text) &&
            (size < HEADER ||
             (size - HEADER) / FACET < mesh_bytes32(r->source->bytes + HEADER - 4, false)));
}

bool mesh_read_stl(mesh_reader *r)
{
    const bool binary = mesh_is_binary_stl(r->source->bytes, r->source->size);
    return !binary && is_text(r) ? read_text(r) : read_binary(r);
}
