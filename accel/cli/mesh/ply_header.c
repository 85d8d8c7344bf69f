/* SPDX-License-Identifier: Apache-2.0
 *
 * The header of a PLY file (Turk, "The PLY Polygon File Format", 1994).
 *
 * Its lines end as the first one does, which tells a binary file's first byte from a line's end.
 * The names of numbers are those of that paper, those with sizes, and of 64 bits int64 and uint64.
 */
#include "ply.h"

#include <stdlib.h>
#include <string.h>

size_t ply_size(ply_type type)
{
    static const unsigned char sizes[] = {0, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return sizes[type];
}

static ply_type type_of(const char *word, size_t length)
{
    static const struct {
        const char *name;
        ply_type type;
    } types[] = {{"char", PLY_INT8},     {"uchar", PLY_UINT8},   {"short", PLY_INT16},
                 {"ushort", PLY_UINT16}, {"int", PLY_INT32},     {"uint", PLY_UINT32},
                 {"float", PLY_FLOAT},   {"double", PLY_DOUBLE}, {"int8", PLY_INT8},
                 {"uint8", PLY_UINT8},   {"int16", PLY_INT16},   {"uint16", PLY_UINT16},
                 {"int32", PLY_INT32},   {"uint32", PLY_UINT32}, {"int64", PLY_INT64},
                 {"uint64", PLY_UINT64}, {"float32", PLY_FLOAT}, {"float64", PLY_DOUBLE}};
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++) {
        if (mesh_same_word(word, length, types[i].name)) {
            return types[i].type;
        }
    }
    return PLY_NONE;
}

/* Takes the next word of the line; an empty one where it ends. */
static size_t take_word(mesh_reader *r, const char **word)
{
    mesh_skip_blanks(&r->text);
    return mesh_take_word(&r->text, word);
}

static bool take_type(mesh_reader *r, bool whole, ply_type *type)
{
    mesh_text *text = &r->text;
    mesh_skip_blanks(text);
    const char *const begin = text->at;
    const char *word;
    const size_t length = mesh_take_word(text, &word);
    *type = type_of(word, length);
    if (*type != PLY_NONE && !(whole && *type >= PLY_FLOAT)) {
        return true;
    }
    text->at = begin;
    return mesh_expect(r, whole
                              ? "the whole type of a list's count: uchar, int, uint32 and the like"
                              : "a type: char, uchar, short, ushort, int, uint, float, double, "
                                "int8 to uint64, float32 or float64");
}

static ply_role role_of(const char *name, size_t length)
{
    static const struct {
        const char *name;
        ply_role role;
    } roles[] = {
        {"vertex", PLY_VERTEX}, {"face", PLY_FACE}, {"tristrips", PLY_STRIPS}, {"edge", PLY_EDGE}};
    for (size_t i = 0; i < sizeof roles / sizeof roles[0]; i++) {
        if (mesh_same_word(name, length, roles[i].name)) {
            return roles[i].role;
        }
    }
    return PLY_OTHER;
}

static bool has_role(const ply *p, ply_role role)
{
    for (size_t i = 0; i < p->element_count; i++) {
        if (p->elements[i].role == role) {
            return true;
        }
    }
    return false;
}

static bool take_element(mesh_reader *r, ply *p)
{
    ply_element made = {.line = r->text.line, .first = p->property_count};
    made.name_length = take_word(r, &made.name);
    mesh_skip_blanks(&r->text);
    if (made.name_length == 0 || !mesh_take_count(&r->text, &made.count)) {
        return mesh_expect(r, "'element NAME COUNT', a count from 0 to 10^18");
    }
    made.role = role_of(made.name, made.name_length);
    if (made.role != PLY_OTHER && has_role(p, made.role)) {
        return mesh_refuse_line(r, made.line, "a second element of the same name, allowed is one");
    }
    if (p->element_count == p->element_room) {
        const size_t capacity = 2 * p->element_room + 8;
        ply_element *elements = realloc(p->elements, capacity * sizeof *elements);
        if (elements == NULL) {
            return mesh_refuse_memory(r);
        }
        p->elements = elements;
        p->element_room = capacity;
    }
    p->elements[p->element_count++] = made;
    return true;
}

/* What the property is to its element. */
static int use_of(const ply_element *e, const ply_property *property, const char *name,
                  size_t length)
{
    if (property->list != PLY_NONE) {
        return mesh_same_word(name, length, "vertex_indices") ||
                       mesh_same_word(name, length, "vertex_index")
                   ? PLY_CORNERS
                   : PLY_UNUSED;
    }
    if (e->role == PLY_VERTEX && length == 1 && (name[0] | 32) >= 'x' && (name[0] | 32) <= 'z') {
        return (name[0] | 32) - 'x';
    }
    return PLY_UNUSED;
}

static bool is_used(const ply *p, const ply_element *e, int use)
{
    for (size_t i = e->first; i < p->property_count; i++) {
        if (p->properties[i].use == use) {
            return true;
        }
    }
    return false;
}

static bool add_property(mesh_reader *r, ply *p, ply_property made)
{
    if (p->property_count == p->property_room) {
        const size_t capacity = 2 * p->property_room + 16;
        ply_property *properties = realloc(p->properties, capacity * sizeof *properties);
        if (properties == NULL) {
            return mesh_refuse_memory(r);
        }
        p->properties = properties;
        p->property_room = capacity;
    }
    p->properties[p->property_count++] = made;
    return true;
}

static bool take_property(mesh_reader *r, ply *p)
{
    const uint64_t line = r->text.line;
    ply_property made = {0};
    if (p->element_count == 0) {
        return mesh_refuse_line(r, line, "a property before the first element");
    }
    ply_element *e = &p->elements[p->element_count - 1];
    const char *word;
    mesh_skip_blanks(&r->text);
    if (mesh_take_this(&r->text, "list") && !take_type(r, true, &made.list)) {
        return false;
    }
    if (!take_type(r, false, &made.type)) {
        return false;
    }
    const size_t length = take_word(r, &word);
    if (length == 0) {
        return mesh_expect(r, "the name of a property");
    }
    made.use = use_of(e, &made, word, length);
    if (made.use != PLY_UNUSED && is_used(p, e, made.use)) {
        return mesh_refuse_line(r, line, "a second property of the same name, allowed is one");
    }
    e->property_count++;
    return add_property(r, p, made);
}

static bool take_format(mesh_reader *r, ply *p, bool *given)
{
    static const char *const names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    const char *word;
    mesh_skip_blanks(&r->text);
    const char *const begin = r->text.at;
    const size_t length = mesh_take_word(&r->text, &word);
    for (int i = 0; i < 3; i++) {
        if (mesh_same_word(word, length, names[i]) && !*given) {
            const char *version;
            const size_t size = take_word(r, &version);
            *given = mesh_same_word(version, size, "1.0") || mesh_same_word(version, size, "1");
            p->form = i == 0 ? PLY_TEXT : i == 1 ? PLY_LITTLE : PLY_BIG;
        }
    }
    r->text.at = *given ? r->text.at : begin;
    return *given ||
           mesh_expect(r, "one of ascii, binary_little_endian and binary_big_endian, with "
                          "version 1.0");
}

/* Takes a line of the header but for its end. */
static bool take_line(mesh_reader *r, ply *p, bool *format, bool *ended)
{
    const char *word;
    mesh_skip_blanks(&r->text);
    const char *const begin = r->text.at;
    const size_t length = mesh_take_word(&r->text, &word);
    if (length == 0) {
        return r->text.at < r->text.end ||
               mesh_refuse_line(r, r->text.line,
                                "the file ends within its header, allowed is that "
                                "end_header comes first");
    }
    if (mesh_same_word(word, length, "comment") || mesh_same_word(word, length, "obj_info")) {
        mesh_skip_line(&r->text);
        return true;
    }
    *ended = mesh_same_word(word, length, "end_header");
    bool fine = *ended;
    if (mesh_same_word(word, length, "format")) {
        fine = (!*format || mesh_refuse_line(r, r->text.line, "a second format")) &&
               take_format(r, p, format);
    } else if (mesh_same_word(word, length, "element")) {
        fine = take_element(r, p);
    } else if (mesh_same_word(word, length, "property")) {
        fine = take_property(r, p);
    } else if (!*ended) {
        r->text.at = begin;
        return mesh_expect(r, "format, element, property, comment, obj_info or end_header");
    }
    mesh_skip_blanks(&r->text);
    return fine && (mesh_at_line_end(&r->text) || mesh_expect(r, "the end of the line"));
}

/* The end of the header's last line, in the way of the first one: CR LF is one end or CR and a byte
 * of what follows. */
static void take_last_end(mesh_text *text, bool only_cr)
{
    if (only_cr && text->at < text->end && *text->at == '\r') {
        text->at++;
        text->line++;
    } else {
        mesh_take_line_end(text);
    }
}

/* Does what the header says make a mesh? */
static bool check(mesh_reader *r, const ply *p)
{
    for (size_t i = 0; i < p->element_count; i++) {
        const ply_element *e = &p->elements[i];
        bool used[4] = {false};
        for (size_t k = e->first; k < e->first + e->property_count; k++) {
            used[p->properties[k].use & 3] |= p->properties[k].use < PLY_UNUSED;
        }
        if (e->role == PLY_VERTEX && !(used[0] && used[1] && used[2])) {
            return mesh_refuse_line(r, e->line, "vertices without a property x, y or z");
        }
        const bool faces = e->role == PLY_FACE || e->role == PLY_STRIPS;
        if (faces && e->count > 0 && !used[PLY_CORNERS]) {
            return mesh_refuse_line(r, e->line,
                                    "faces without a list vertex_indices or "
                                    "vertex_index");
        }
        if (!faces && e->count > 0 && used[PLY_CORNERS]) {
            return mesh_refuse_line(r, e->line,
                                    "an unknown element of vertices, allowed are face "
                                    "and tristrips");
        }
    }
    if (!has_role(p, PLY_VERTEX)) {
        return mesh_refuse(r, "its PLY header promises no element vertex");
    }
    return has_role(p, PLY_FACE) || has_role(p, PLY_STRIPS) ||
           mesh_refuse(r,
                       "holds no triangle: its PLY header promises no element face or tristrips");
}

bool ply_read_header(mesh_reader *r, ply *p)
{
    mesh_text *text = &r->text;
    bool format = false, ended = false;
    mesh_skip_space(text);
    if (!mesh_take_this(text, "ply")) {
        return mesh_expect(r, "'ply', with which every PLY file begins");
    }
    mesh_skip_blanks(text);
    if (!mesh_at_line_end(text)) {
        return mesh_expect(r, "the end of the line");
    }
    const bool only_cr = text->at + 1 < text->end && text->at[0] == '\r' && text->at[1] != '\n';
    while (!ended) {
        mesh_take_line_end(text);
        if (!take_line(r, p, &format, &ended)) {
            return false;
        }
    }
    take_last_end(text, only_cr);
    return (format || mesh_refuse(r, "its PLY header has no format")) && check(r, p);
}
