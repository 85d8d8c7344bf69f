/* SPDX-License-Identifier: Apache-2.0
 *
 * Wavefront OBJ ("Object Files", Advanced Visualizer manual, version 3.0, appendix B1): faces,
 * which may come before their vertices. Texture coordinates, normals and all that is drawn with a
 * face is passed over. Points, lines and curves are left out; surfaces, other files and unknown
 * statements are refused. The weight of a vertex is for curves: it does not move the corner of a
 * face.
 *
 * Each object or group that has faces is a geometry, a run of faces under one name; of several ones
 * each keeps the vertices that it uses, in the order in which it uses them.
 */
#include "reader.h"

#include <stdlib.h>
#include <string.h>

/* The file under way. */
typedef struct obj {
    mesh_reader *r;
    size_t *parts; /* the first triangle of each part but the first one */
    size_t part_count, part_room;
} obj;

/* Reads what follows the keyword, up to the end of the line or of the comment. */
typedef bool read_statement(obj *o);

static read_statement vertex, face, points, polyline, curve, part, skip, surface, other_file;

static const struct {
    const char *keyword;
    read_statement *read;
    bool is_text; /* any text may follow, with '#' and '\' in it */
} statements[] = {
    {"v", vertex, false},      {"f", face, false},      {"vn", skip, false},
    {"vt", skip, false},       {"g", part, true},       {"o", part, true},
    {"s", skip, true},         {"usemtl", skip, true},  {"mtllib", skip, true},
    {"l", polyline, false},    {"p", points, false},    {"fo", face, false},
    {"vp", skip, false},       {"vc", skip, false},     {"curv", curve, false},
    {"curv2", skip, false},    {"cdc", curve, false},   {"surf", surface, false},
    {"bsp", surface, false},   {"bzp", surface, false}, {"cdp", surface, false},
    {"cstype", skip, false},   {"deg", skip, false},    {"bmat", skip, false},
    {"step", skip, false},     {"parm", skip, false},   {"trim", skip, false},
    {"hole", skip, false},     {"scrv", skip, false},   {"sp", skip, false},
    {"end", skip, false},      {"con", skip, false},    {"res", skip, false},
    {"mg", skip, true},        {"bevel", skip, true},   {"c_interp", skip, true},
    {"d_interp", skip, true},  {"lod", skip, true},     {"shadow_obj", skip, true},
    {"trace_obj", skip, true}, {"ctech", skip, true},   {"stech", skip, true},
    {"maplib", skip, true},    {"usemap", skip, true},  {"call", other_file, true},
    {"csh", other_file, true},
};

enum { STATEMENTS = sizeof statements / sizeof statements[0] };

/* The position of a statement in the table, or STATEMENTS. */
static int find_statement(const char *word, size_t length)
{
    int i = 0;
    while (i < STATEMENTS && !mesh_same_word(word, length, statements[i].keyword)) {
        i++;
    }
    return i;
}

/* Skips a line of free text. One that ends with a backslash goes on with the next one, unless that
 * is a statement: names of folders end so as well. */
static void skip_text(mesh_text *text)
{
    bool more = true;
    while (more) {
        const char *const begin = text->at;
        mesh_skip_line(text);
        const char *last = text->at;
        while (last > begin && mesh_is(last[-1], MESH_BLANK)) {
            last--;
        }
        more = last > begin && last[-1] == '\\' && text->at < text->end;
        if (more) {
            mesh_text next = *text;
            const char *word;
            mesh_take_line_end(&next);
            mesh_skip_blanks(&next);
            const size_t length = mesh_take_word(&next, &word);
            more = length != 0 && find_statement(word, length) == STATEMENTS;
        }
        if (more) {
            mesh_take_line_end(text);
        }
    }
}

static bool vertex(obj *o)
{
    mesh_text *text = &o->r->text;
    double numbers[8];
    int count = 0;
    mesh_skip_blanks(text);
    while (!mesh_at_line_end(text)) {
        if (count == 8) {
            return mesh_refuse_line(o->r, text->line,
                                    "a vertex of more than 8 numbers, allowed are "
                                    "x y z, a weight and a colour");
        }
        if (!mesh_take_number(text, &numbers[count++])) {
            return mesh_expect(o->r, "a decimal number in the range of double");
        }
        mesh_skip_blanks(text);
    }
    if (count < 3 || count == 5) {
        return mesh_refuse_line(o->r, text->line,
                                "a vertex of %d numbers, allowed are x y z, a "
                                "weight and a colour",
                                count);
    }
    grow_vertex(&o->r->mesh, numbers[0], numbers[1], numbers[2]);
    return true;
}

/* Takes what may follow the vertex of a corner: /vt, //vn or /vt/vn, where a number may lack. */
static bool skip_references(mesh_text *text)
{
    int64_t ignored;
    for (int i = 0; i < 2 && text->at < text->end && *text->at == '/'; i++) {
        text->at++;
        mesh_take_integer(text, &ignored);
    }
    return mesh_word_ends(text, text->at);
}

/* Takes a corner and adds it to the face. */
static bool corner(obj *o)
{
    mesh_reader *r = o->r;
    mesh_text *text = &r->text;
    const int64_t vertices = (int64_t)(r->mesh.number_count / 3);
    const char *const begin = text->at;
    int64_t index;
    if (!mesh_take_integer(text, &index) || !skip_references(text)) {
        text->at = begin;
        return mesh_expect(r, "a corner v, v/vt, v//vn or v/vt/vn of whole numbers");
    }
    if (index == 0 || index < -vertices || index >= (int64_t)UINT32_MAX) {
        return mesh_refuse_line(
            r, text->line,
            "a face refers to vertex %lld where there are %lld, allowed is 1 to "
            "their number, or -1 for the last one and so on",
            (long long)index, (long long)vertices);
    }
    return mesh_indices_add(&r->face, (uint32_t)(index < 0 ? vertices + index : index - 1)) ||
           mesh_refuse_memory(r);
}

static bool face(obj *o)
{
    mesh_text *text = &o->r->text;
    const uint64_t line = text->line;
    mesh_skip_blanks(text);
    while (!mesh_at_line_end(text)) {
        if (!corner(o)) {
            return false;
        }
        mesh_skip_blanks(text);
    }
    /* with its last line cut off, a file lacks its last corners */
    if (o->r->face.count == 0 || (o->r->face.count < 3 && text->at == text->end)) {
        return mesh_refuse_line(o->r, line, "a face of %d corners, allowed are 3 or more",
                                (int)o->r->face.count);
    }
    return mesh_add_face(o->r, line);
}

static uint64_t count_words(mesh_text *text)
{
    uint64_t count = 0;
    const char *ignored;
    mesh_skip_blanks(text);
    for (; !mesh_at_line_end(text); count++) {
        mesh_take_word(text, &ignored);
        mesh_skip_blanks(text);
    }
    return count;
}

static bool points(obj *o)
{
    o->r->out->left_out += count_words(&o->r->text);
    return true;
}

static bool polyline(obj *o)
{
    const uint64_t corners = count_words(&o->r->text);
    o->r->out->left_out += corners == 0 ? 0 : corners == 1 ? 1 : corners - 1;
    return true;
}

static bool curve(obj *o)
{
    o->r->out->left_out++;
    return skip(o);
}

static bool skip(obj *o)
{
    const char *ignored;
    while (mesh_skip_blanks(&o->r->text), !mesh_at_line_end(&o->r->text)) {
        mesh_take_word(&o->r->text, &ignored);
    }
    return true;
}

static bool surface(obj *o)
{
    return mesh_refuse_line(o->r, o->r->text.line,
                            "found a free-form surface, allowed are faces of straight sides");
}

static bool other_file(obj *o)
{
    return mesh_refuse_line(o->r, o->r->text.line,
                            "found a call of another file or program, which is not followed");
}

static bool part(obj *o)
{
    const size_t triangle = o->r->mesh.index_count / 3;
    const size_t before = o->part_count == 0 ? 0 : o->parts[o->part_count - 1];
    if (triangle == before) {
        return true;
    }
    if (o->part_count == o->part_room) {
        const size_t capacity = 2 * o->part_room + 16;
        size_t *parts = realloc(o->parts, capacity * sizeof *parts);
        if (parts == NULL) {
            return mesh_refuse_memory(o->r);
        }
        o->parts = parts;
        o->part_room = capacity;
    }
    o->parts[o->part_count++] = triangle;
    return true;
}

static bool statement(obj *o)
{
    mesh_text *text = &o->r->text;
    const char *const begin = text->at;
    const char *word;
    const size_t length = mesh_take_word(text, &word);
    const int i = find_statement(word, length);
    if (i == STATEMENTS) {
        text->at = begin;
        return mesh_expect(o->r, "a statement of OBJ: v, vt, vn, f, l, p, o, g, s, usemtl, mtllib "
                                 "or another one of its version 3.0");
    }
    if (!statements[i].read(o)) {
        return false;
    }
    if (statements[i].is_text) {
        text->at = word + length;
        skip_text(text);
    }
    return true;
}

static bool statement_list(obj *o)
{
    mesh_text *text = &o->r->text;
    while (text->at < text->end) {
        while (text->at < text->end && mesh_is(*text->at, MESH_BLANK)) {
            text->at++;
        }
        if (text->at < text->end && *text->at == '#') {
            skip_text(text);
        } else if (mesh_skip_blanks(text), !mesh_at_line_end(text) && !statement(o)) {
            return false;
        }
        mesh_take_line_end(text);
        mesh_tick(o->r);
    }
    return true;
}

/* Adds the triangles first up to end as a geometry. `own` has a place for each vertex of the file:
 * its number in the part `stamp[vertex] - 1`. */
static bool add_part(obj *o, const struct growing *all, size_t first, size_t end, uint32_t number,
                     uint32_t *own, uint32_t *stamp)
{
    struct growing *mesh = &o->r->mesh;
    for (size_t t = first; t < end; t++) {
        uint32_t corners[3];
        for (size_t k = 0; k < 3; k++) {
            const uint32_t vertex = all->indices[3 * t + k];
            if (stamp[vertex] != number + 1) {
                const double *at = &all->numbers[3 * (size_t)vertex];
                stamp[vertex] = number + 1;
                own[vertex] = grow_vertex(mesh, at[0], at[1], at[2]);
            }
            corners[k] = own[vertex];
        }
        grow_triangle(mesh, corners[0], corners[1], corners[2]);
    }
    return mesh_add_geometry(o->r);
}

static bool add_parts(obj *o)
{
    mesh_reader *r = o->r;
    if (o->part_count == 0) {
        return mesh_add_geometry(r);
    }
    const struct growing all = r->mesh;
    const size_t vertices = all.number_count / 3;
    uint32_t *own = malloc(vertices * sizeof *own + 1);
    uint32_t *stamp = calloc(vertices + 1, sizeof *stamp);
    bool fine = (own != NULL && stamp != NULL) || mesh_refuse_memory(r);
    r->mesh = (struct growing){0};
    for (size_t i = 0; i <= o->part_count && fine; i++) {
        const size_t first = i == 0 ? 0 : o->parts[i - 1];
        const size_t end = i == o->part_count ? all.index_count / 3 : o->parts[i];
        fine = add_part(o, &all, first, end, (uint32_t)i, own, stamp);
    }
    free(own);
    free(stamp);
    free(all.numbers);
    free(all.indices);
    return fine;
}

bool mesh_read_obj(mesh_reader *r)
{
    obj o = {.r = r};
    r->text.comment = '#';
    r->text.joins = true;
    bool fine = statement_list(&o);
    if (fine && r->mesh.failed) {
        fine = mesh_refuse_memory(r);
    }
    const uint64_t vertices = r->mesh.number_count / 3;
    if (fine && r->largest > vertices) {
        fine = mesh_refuse_line(r, r->largest_place,
                                "a face refers to vertex %llu, but the file has %llu",
                                (unsigned long long)r->largest, (unsigned long long)vertices);
    }
    fine = fine && mesh_cut_late(r) && add_parts(&o);
    free(o.parts);
    return fine;
}
