/* SPDX-License-Identifier: Apache-2.0
 *
 * What the headers of PLY, OFF and binary STL files promise, compared with the bytes that are
 * there.
 *
 * assimp reads a truncated PLY or OFF file without complaint as far as it goes, and believes a
 * count of four billion until memory ends. Here every element of a PLY body is walked, text or
 * binary, in one pass without any allocation; OFF needs as many numbers as its counts say, and its
 * faces vertices that are there: assimp takes the last one instead of another. Formats
 * without counts (OBJ, text STL but for its last word) cannot be checked this way.
 */
#include "scene_file.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { MOST_ELEMENTS = 32, MOST_PROPERTIES = 64 };

/* A property of a PLY element: a number, or a list of them with its count in front. */
typedef struct property {
    int list_size; /* bytes of the count; 0 where it is no list */
    int size;      /* bytes of a number */
} property;

/* An element of a PLY header. */
typedef struct element {
    uint64_t count;
    bool is_face; /* named face */
    property properties[MOST_PROPERTIES];
    int property_count;
} element;

/* A PLY header as far as counting needs it. */
typedef struct ply {
    element elements[MOST_ELEMENTS];
    int element_count;
    bool text, big_endian, ended;
} ply;

/* A place in the bytes that are left. */
typedef struct rest {
    const char *at, *end;
} rest;

static bool skip(rest *r, uint64_t count)
{
    if (count > (uint64_t)(r->end - r->at)) {
        return false;
    }
    r->at += count;
    return true;
}

/* Takes the next line, without its end and at most `room` - 1 bytes of it. */
static bool take_line(rest *r, char *line, size_t room)
{
    if (r->at == r->end) {
        return false;
    }
    size_t length = 0;
    while (r->at < r->end && *r->at != '\n') {
        if (length < room - 1 && *r->at != '\r') {
            line[length++] = *r->at;
        }
        r->at++;
    }
    line[length] = '\0';
    skip(r, 1);
    return true;
}

static void skip_spaces(rest *r)
{
    while (r->at < r->end && isspace((unsigned char)*r->at)) {
        r->at++;
    }
}

/* Takes the next word of text and reads it as a count; false where the text ends. */
static bool take_word(rest *r, uint64_t *count)
{
    skip_spaces(r);
    if (r->at == r->end) {
        return false;
    }
    /* the bytes end with a zero, at which strtoull stops */
    *count = isdigit((unsigned char)*r->at) ? strtoull(r->at, NULL, 10) : 0;
    while (r->at < r->end && !isspace((unsigned char)*r->at)) {
        r->at++;
    }
    return true;
}

static int size_of_type(const char *name)
{
    static const struct {
        const char *name;
        int size;
    } types[] = {{"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},
                 {"short", 2}, {"ushort", 2},  {"int16", 2},  {"uint16", 2},
                 {"int", 4},   {"uint", 4},    {"int32", 4},  {"uint32", 4},
                 {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++) {
        if (strcmp(name, types[i].name) == 0) {
            return types[i].size;
        }
    }
    return 0;
}

static bool read_property(ply *p, const char *line)
{
    char list[16], item[16];
    element *e = p->element_count == 0 ? NULL : &p->elements[p->element_count - 1];
    if (e == NULL || e->property_count == MOST_PROPERTIES) {
        return false;
    }
    property *made = &e->properties[e->property_count++];
    if (sscanf(line, "property list %15s %15s", list, item) == 2) {
        *made = (property){size_of_type(list), size_of_type(item)};
        return made->list_size != 0 && made->size != 0;
    }
    if (sscanf(line, "property %15s", item) == 1) {
        *made = (property){0, size_of_type(item)};
    }
    return made->size != 0;
}

static bool read_element(ply *p, const char *line)
{
    unsigned long long count;
    if (p->element_count == MOST_ELEMENTS || sscanf(line, "element %*s %llu", &count) != 1 ||
        strchr(line, '-') != NULL) {
        return false;
    }
    p->elements[p->element_count++] =
        (element){.count = count, .is_face = strncmp(line, "element face ", 13) == 0};
    return true;
}

static bool read_ply_line(ply *p, const char *line)
{
    if (strncmp(line, "format ", 7) == 0) {
        p->text = strncmp(line + 7, "ascii", 5) == 0;
        p->big_endian = strncmp(line + 7, "binary_big_endian", 17) == 0;
        return p->text || p->big_endian || strncmp(line + 7, "binary_little_endian", 20) == 0;
    }
    if (strncmp(line, "element ", 8) == 0) {
        return read_element(p, line);
    }
    if (strncmp(line, "property ", 9) == 0) {
        return read_property(p, line);
    }
    p->ended = strcmp(line, "end_header") == 0;
    return p->ended || strncmp(line, "comment", 7) == 0 || strncmp(line, "obj_info", 8) == 0 ||
           strcmp(line, "ply") == 0 || line[0] == '\0';
}

static uint64_t binary_count(const ply *p, const char *at, int size)
{
    uint64_t count = 0;
    for (int i = 0; i < size; i++) {
        const int from = p->big_endian ? i : size - 1 - i;
        count = count << 8 | (unsigned char)at[from];
    }
    return count;
}

/* The next line that holds a word. */
static bool take_body_line(rest *r, rest *line)
{
    while (r->at < r->end) {
        const char *stop = memchr(r->at, '\n', (size_t)(r->end - r->at));
        *line = (rest){r->at, stop == NULL ? r->end : stop};
        r->at = stop == NULL ? r->end : stop + 1;
        while (line->at < line->end && isspace((unsigned char)*line->at)) {
            line->at++;
        }
        if (line->at < line->end) {
            return true;
        }
    }
    return false;
}

/* Takes the words of one property in text. */
static bool skip_words(const property *made, rest *line)
{
    uint64_t count = 1, ignored;
    bool fine = made->list_size == 0 || take_word(line, &count);
    for (; fine && count > 0; count--) {
        fine = take_word(line, &ignored);
    }
    return fine;
}

/* One instance of an element is one line with just its words. */
static bool skip_text(const element *e, rest *r)
{
    rest line;
    uint64_t ignored;
    bool fine = take_body_line(r, &line);
    for (int k = 0; fine && k < e->property_count; k++) {
        fine = skip_words(&e->properties[k], &line);
    }
    return fine && !take_word(&line, &ignored);
}

static bool skip_binary(const ply *p, const element *e, rest *r)
{
    for (int k = 0; k < e->property_count; k++) {
        const property *made = &e->properties[k];
        uint64_t count = 1;
        if (made->list_size != 0) {
            const char *at = r->at;
            if (!skip(r, (uint64_t)made->list_size)) {
                return false;
            }
            count = binary_count(p, at, made->list_size);
        }
        if (count > UINT32_MAX || !skip(r, count * (uint64_t)made->size)) {
            return false;
        }
    }
    return true;
}

/* The number of instances of `e` that are there. */
static uint64_t skip_element(const ply *p, const element *e, rest *r)
{
    if (e->property_count == 0) {
        return e->count;
    }
    for (uint64_t i = 0; i < e->count; i++) {
        if (!(p->text ? skip_text(e, r) : skip_binary(p, e, r))) {
            return i;
        }
    }
    return e->count;
}

static const char *check_ply(rest r, uint64_t *faces, char text[200])
{
    ply p = {0};
    char line[200];
    for (int number = 1; !p.ended; number++) {
        if (!take_line(&r, line, sizeof line)) {
            return "its PLY header has no end_header: is it truncated";
        }
        if (!read_ply_line(&p, line)) {
            snprintf(text, 200, "its PLY header cannot be read in line %d", number);
            return text;
        }
    }
    for (int i = 0; i < p.element_count; i++) {
        const uint64_t there = skip_element(&p, &p.elements[i], &r);
        *faces = p.elements[i].is_face ? p.elements[i].count : *faces;
        if (there < p.elements[i].count) {
            snprintf(text, 200,
                     "its PLY header promises %llu of element %d, but only %llu are there",
                     (unsigned long long)p.elements[i].count, i + 1, (unsigned long long)there);
            return text;
        }
    }
    return NULL;
}

/* Removes comments, which go from '#' to the end of the line, and empty lines: assimp counts them
 * as faces. Returns the new end. */
static char *strip_comments(char *from, const char *end)
{
    char *to = from;
    bool comment = false, empty = true;
    for (; from < end; from++) {
        comment = *from == '#' || (comment && *from != '\n');
        if (comment || (empty && isspace((unsigned char)*from))) {
            continue;
        }
        *to++ = *from;
        empty = *from == '\n';
    }
    *to = '\0';
    return to;
}

/* Takes one face; *outside becomes true where a corner is none of the vertices. */
static bool take_face(rest *line, uint64_t vertices, bool *outside)
{
    uint64_t corners, corner;
    bool fine = take_word(line, &corners);
    for (; fine && corners > 0; corners--) {
        skip_spaces(line);
        const bool negative = line->at < line->end && *line->at == '-';
        fine = take_word(line, &corner);
        *outside = *outside || (fine && (negative || corner >= vertices));
    }
    return fine;
}

static const char *check_off(rest r, uint64_t *promised, char text[200])
{
    uint64_t ignored, vertices = 0, faces = 0;
    take_word(&r, &ignored);
    if (!take_word(&r, &vertices) || !take_word(&r, &faces) || !take_word(&r, &ignored)) {
        return "its OFF header has no counts: is it truncated";
    }
    bool fine = true, outside = false;
    rest line;
    for (uint64_t i = 0; fine && i < vertices; i++) {
        fine = take_body_line(&r, &line) && take_word(&line, &ignored) &&
               take_word(&line, &ignored) && take_word(&line, &ignored);
    }
    for (uint64_t i = 0; fine && i < faces; i++) {
        fine = take_body_line(&r, &line) && take_face(&line, vertices, &outside);
    }
    *promised = faces;
    if (fine && outside) {
        return "a face refers to a vertex that is not there";
    }
    snprintf(text, 200,
             "its OFF header promises %llu vertices and %llu faces, but the file ends "
             "before them",
             (unsigned long long)vertices, (unsigned long long)faces);
    return fine ? NULL : text;
}

static const char *check_stl(rest r, uint64_t *faces, char text[200])
{
    const uint64_t size = (uint64_t)(r.end - r.at);
    uint32_t count = 0;
    if (size >= 84) {
        memcpy(&count, r.at + 80, sizeof count);
    }
    if (size >= 84 && size == 84 + 50 * (uint64_t)count) {
        *faces = count;
        return NULL;
    }
    if (size < 5 || strncasecmp(r.at, "solid", 5) != 0) {
        snprintf(text, 200, "its STL header promises %llu triangles, but the file has %llu bytes",
                 (unsigned long long)count, (unsigned long long)size);
        return text;
    }
    const uint64_t last = size < 400 ? size : 400;
    return memmem(r.end - last, last, "endsolid", 8) == NULL
               ? "its STL text has no endsolid: is it truncated"
               : NULL;
}

static bool ends_with(const char *path, const char *extension)
{
    const size_t length = strlen(path), ending = strlen(extension);
    return length >= ending && strcasecmp(path + length - ending, extension) == 0;
}

const char *accel_file_counts(accel_mesh_file *mesh, char text[200])
{
    accel_file *file = &mesh->file;
    const bool off = ends_with(file->path, ".off");
    if (off) {
        file->size = (size_t)(strip_comments(file->bytes, file->bytes + file->size) - file->bytes);
    }
    const rest all = {file->bytes, file->bytes + file->size};
    if (ends_with(file->path, ".ply")) {
        return check_ply(all, &mesh->faces, text);
    }
    if (off) {
        return check_off(all, &mesh->faces, text);
    }
    return ends_with(file->path, ".stl") ? check_stl(all, &mesh->faces, text) : NULL;
}
