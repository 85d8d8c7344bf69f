/* SPDX-License-Identifier: Apache-2.0
 *
 * OFF, as Geomview reads it (Phillips, "Geomview Manual", 1.9): [ST][C][N][4][n]OFF, text and
 * binary. A vertex and a face each begin and end a line, but may take several; colours, normals and
 * texture coordinates are passed over, but all vertices must have as many of them. A vertex of 4OFF
 * is homogeneous. Edges are only counted by the format, and not read.
 */
#include "reader.h"

#include "bytes.h"
#include "off.h"

#include <string.h>

/* What the first word says. */
typedef struct header {
    bool texture, colour, normal, four, dimension, binary;
    bool unclear; /* noff: NOFF or nOFF? */
    uint64_t vertices, faces;
} header;

/* Takes [ST][C][N][4][n]OFF, which a digit may follow. */
static bool take_keyword(mesh_text *text, header *h)
{
    const char *at = text->at;
    size_t left = (size_t)(text->end - at);
    if (left >= 2 && mesh_same_word(at, 2, "st")) {
        h->texture = true, at += 2, left -= 2;
    }
    if (left >= 1 && (*at == 'C' || *at == 'c')) {
        h->colour = true, at++, left--;
    }
    if (left >= 1 && *at == 'N') {
        h->normal = true, at++, left--;
    }
    if (left >= 1 && *at == '4') {
        h->four = true, at++, left--;
    }
    if (left >= 1 && *at == 'n') {
        h->dimension = true, at++, left--;
    }
    if (left < 3 || !mesh_same_word(at, 3, "off") ||
        !(mesh_word_ends(text, at + 3) || mesh_is(at[3], MESH_DIGIT))) {
        return false;
    }
    h->unclear = h->dimension && *at == 'o';
    text->at = at + 3;
    return true;
}

bool mesh_is_off(const mesh_text *start)
{
    mesh_text text = *start;
    header h = {0};
    return mesh_skip_space(&text) && take_keyword(&text, &h);
}

/* Takes the two or three counts: the number of edges may lack where one line has the others. */
static bool take_counts(mesh_reader *r, header *h)
{
    mesh_text *text = &r->text;
    uint64_t edges;
    mesh_skip_space(text);
    const uint64_t line = text->line;
    if (!mesh_take_count(text, &h->vertices) || !mesh_skip_space(text) ||
        !mesh_take_count(text, &h->faces)) {
        return mesh_expect(r, "the numbers of vertices, faces and edges");
    }
    if (text->line == line) {
        mesh_skip_blanks(text);
    } else {
        mesh_skip_space(text);
    }
    if (!mesh_at_line_end(text) && !mesh_take_count(text, &edges)) {
        return mesh_expect(r, "the number of edges");
    }
    mesh_skip_blanks(text);
    return mesh_at_line_end(text) || mesh_expect(r, "the end of the line");
}

/* What cannot be there must not be waited for. */
static bool check_counts(mesh_reader *r, const header *h, const char *at, uint64_t least_vertex,
                         uint64_t least_face)
{
    const uint64_t there = (uint64_t)(r->source->bytes + r->source->size - at) + 1;
    if (h->vertices <= there / least_vertex && h->faces <= there / least_face) {
        return true;
    }
    return mesh_refuse(r,
                       "its OFF header promises %llu vertices and %llu faces, but the %llu bytes "
                       "that are left cannot hold them",
                       (unsigned long long)h->vertices, (unsigned long long)h->faces,
                       (unsigned long long)(there - 1));
}

/* Divides by the fourth of homogeneous coordinates, and adds the vertex. */
static bool add_vertex(mesh_reader *r, const header *h, double place[4])
{
    if (h->four) {
        if (place[3] == 0.0) {
            return mesh_refuse(
                r, "vertex %llu, counted from 0, is at infinity: its fourth number is 0",
                (unsigned long long)(r->mesh.number_count / 3));
        }
        for (int k = 0; k < 3; k++) {
            place[k] /= place[3];
        }
    }
    grow_vertex(&r->mesh, place[0], place[1], place[2]);
    return true;
}

/* Takes what else is on the line; each word must be a number. */
static bool skip_numbers(mesh_reader *r, uint64_t *count)
{
    double ignored;
    *count = 0;
    while (mesh_skip_blanks(&r->text), !mesh_at_line_end(&r->text)) {
        if (!mesh_take_number(&r->text, &ignored)) {
            return mesh_expect(r, "a number or the end of the line");
        }
        ++*count;
    }
    return true;
}

static bool take_vertices(mesh_reader *r, const header *h)
{
    uint64_t more = 0, more_at_first = 0;
    for (uint64_t i = 0; i < h->vertices; i++) {
        double place[4] = {0};
        for (int k = 0; k < (h->four ? 4 : 3); k++) {
            if (!mesh_skip_space(&r->text) || !mesh_take_number(&r->text, &place[k])) {
                return mesh_expect(r, "a decimal number in the range of double");
            }
        }
        if (!add_vertex(r, h, place) || !skip_numbers(r, &more)) {
            return false;
        }
        more_at_first = i == 0 ? more : more_at_first;
        if (more != more_at_first) {
            return mesh_refuse_line(r, r->text.line,
                                    "a vertex with %llu numbers behind its coordinates, where the "
                                    "first one has %llu",
                                    (unsigned long long)more, (unsigned long long)more_at_first);
        }
        mesh_tick(r);
    }
    return true;
}

/* Adds a corner to the face. */
static bool add_corner(mesh_reader *r, uint64_t line, int64_t index, uint64_t vertices)
{
    if (index < 0 || (uint64_t)index >= vertices) {
        return mesh_refuse_line(r, line,
                                "a face refers to vertex %lld, but the file has %llu, "
                                "counted from 0",
                                (long long)index, (unsigned long long)vertices);
    }
    return mesh_indices_add(&r->face, (uint32_t)index) || mesh_refuse_memory(r);
}

static bool take_corners(mesh_reader *r, const header *h)
{
    mesh_text *text = &r->text;
    uint64_t corners;
    if (!mesh_skip_space(text) || !mesh_take_count(text, &corners)) {
        return mesh_expect(r, "the number of a face's corners");
    }
    for (; corners > 0; corners--) {
        mesh_skip_space(text);
        const char *const begin = text->at;
        int64_t index;
        if (!mesh_take_integer(text, &index) || !mesh_word_ends(text, text->at)) {
            text->at = begin;
            return mesh_expect(r, "the number of a vertex");
        }
        if (!add_corner(r, text->line, index, h->vertices)) {
            return false;
        }
    }
    return true;
}

static bool take_faces(mesh_reader *r, const header *h)
{
    for (uint64_t i = 0; i < h->faces; i++) {
        uint64_t colours;
        if (!take_corners(r, h) || !skip_numbers(r, &colours)) {
            return false;
        }
        if (colours > 4) {
            return mesh_refuse_line(
                r, r->text.line,
                "a face with %llu numbers behind its corners, allowed are up to "
                "4 of a colour",
                (unsigned long long)colours);
        }
        if (!mesh_add_face(r, r->text.line)) {
            return false;
        }
        mesh_tick(r);
    }
    return true;
}

static bool read_text(mesh_reader *r, header *h)
{
    if (!take_counts(r, h) || !check_counts(r, h, r->text.at, h->four ? 8 : 6, 2) ||
        !take_vertices(r, h) || !take_faces(r, h)) {
        return false;
    }
    mesh_skip_space(&r->text);
    mesh_note_rest(r, r->text.at);
    return true;
}

/* Binary: what is left of the file. */
typedef struct rest {
    const char *at, *end;
} rest;

static bool take_whole(mesh_reader *r, rest *b, uint64_t *number)
{
    if (b->end - b->at < 4) {
        return mesh_refuse(r, "the file ends before all that its OFF header promises");
    }
    const uint32_t bits = mesh_bytes32(b->at, true);
    if (bits > INT32_MAX) {
        return mesh_refuse_byte(r, b->at, "found %d, allowed are whole numbers from 0 on",
                                (int)(int32_t)bits);
    }
    *number = bits;
    b->at += 4;
    return true;
}

static bool take_binary_vertices(mesh_reader *r, const header *h, rest *b)
{
    const int coordinates = h->four ? 4 : 3;
    const size_t size = 4 * (size_t)(coordinates + (h->normal ? 3 : 0) + (h->colour ? 4 : 0) +
                                     (h->texture ? 2 : 0));
    for (uint64_t i = 0; i < h->vertices; i++, b->at += size) {
        double place[4];
        if ((size_t)(b->end - b->at) < size) {
            return mesh_refuse(r, "the file ends before all that its OFF header promises");
        }
        for (int k = 0; k < coordinates; k++) {
            place[k] = mesh_float(b->at + 4 * k, true);
        }
        if (!add_vertex(r, h, place)) {
            return false;
        }
        mesh_tick(r);
    }
    return true;
}

static bool take_binary_face(mesh_reader *r, const header *h, rest *b)
{
    const char *const begin = b->at;
    uint64_t corners, index = 0, colours;
    if (!take_whole(r, b, &corners)) {
        return false;
    }
    for (; corners > 0; corners--) {
        if (!take_whole(r, b, &index)) {
            return false;
        }
        if (index >= h->vertices) {
            return mesh_refuse_byte(r, b->at - 4,
                                    "a face refers to vertex %llu, but the file has "
                                    "%llu, counted from 0",
                                    (unsigned long long)index, (unsigned long long)h->vertices);
        }
        if (!mesh_indices_add(&r->face, (uint32_t)index)) {
            return mesh_refuse_memory(r);
        }
    }
    if (!take_whole(r, b, &colours)) {
        return false;
    }
    if (colours > 4 || (uint64_t)(b->end - b->at) < 4 * colours) {
        return mesh_refuse_byte(r, b->at - 4,
                                "found a colour of %llu numbers, allowed are up to 4 "
                                "that are there",
                                (unsigned long long)colours);
    }
    b->at += 4 * colours;
    mesh_tick(r);
    return mesh_add_face(r, (uint64_t)(begin - r->source->bytes) + 1);
}

static bool read_binary(mesh_reader *r, header *h)
{
    mesh_take_line_end(&r->text);
    rest b = {r->text.at, r->text.end};
    uint64_t edges;
    if (!take_whole(r, &b, &h->vertices) || !take_whole(r, &b, &h->faces) ||
        !take_whole(r, &b, &edges) || !check_counts(r, h, b.at, 12, 8) ||
        !take_binary_vertices(r, h, &b)) {
        return false;
    }
    for (uint64_t i = 0; i < h->faces; i++) {
        if (!take_binary_face(r, h, &b)) {
            return false;
        }
    }
    mesh_note_rest(r, b.at);
    return true;
}

/* nOFF: the number of dimensions stands before the counts. */
static bool take_dimension(mesh_reader *r, const header *h)
{
    uint64_t dimensions;
    if (!h->dimension) {
        return true;
    }
    if (!mesh_skip_space(&r->text) || !mesh_take_count(&r->text, &dimensions)) {
        return mesh_expect(r, "the number of dimensions");
    }
    if (dimensions != 3 || h->four) {
        return mesh_refuse_line(r, r->text.line, "vertices of %llu dimensions%s, allowed are 3",
                                (unsigned long long)dimensions, h->four ? " and a divisor" : "");
    }
    return true;
}

/* Is the next word BINARY? Then takes it and the rest of the line. */
static bool take_binary(mesh_text *text)
{
    mesh_skip_blanks(text);
    if (!mesh_take_this(text, "binary")) {
        return false;
    }
    mesh_skip_line(text);
    return true;
}

bool mesh_read_off(mesh_reader *r)
{
    header h = {0};
    r->text.comment = '#';
    if (!mesh_skip_space(&r->text) || !take_keyword(&r->text, &h)) {
        if (mesh_at_line_end(&r->text) || !mesh_is(*r->text.at, MESH_DIGIT)) {
            return mesh_expect(r, "[ST][C][N][4][n]OFF, or the numbers of vertices, faces, edges");
        }
        h = (header){0};
    }
    if (h.unclear) {
        return mesh_refuse_line(r, r->text.line,
                                "found noff, allowed are NOFF, with normals, and nOFF, with a "
                                "number of dimensions");
    }
    h.binary = take_binary(&r->text);
    if (h.binary && h.dimension) {
        return mesh_refuse_line(r, r->text.line, "found nOFF BINARY, allowed is nOFF as text");
    }
    const bool fine = h.binary ? read_binary(r, &h) : take_dimension(r, &h) && read_text(r, &h);
    if (!fine) {
        return false;
    }
    return r->mesh.failed ? mesh_refuse_memory(r) : mesh_cut_late(r) && mesh_add_geometry(r);
}
