/* SPDX-License-Identifier: Apache-2.0
 *
 * PLY: what follows the header. Elements may stand in any order; faces and tristrips give
 * triangles, edges are left out and counted, all else is passed over. In text an instance of an
 * element begins and ends a line, but may take several.
 */
#include "ply.h"

#include "bytes.h"

#include <stdlib.h>
#include <string.h>

/* The file under way. */
typedef struct body {
    mesh_reader *r;
    const ply *p;
    const char *at;       /* of what is binary */
    double place[3];      /* of the vertex under way */
    uint32_t strip[3];    /* the last corners of the strip under way */
    uint64_t strip_count; /* since it began */
} body;

static uint64_t place_of(const body *b)
{
    return b->p->form == PLY_TEXT ? b->r->text.line : (uint64_t)(b->at - b->r->source->bytes) + 1;
}

/* Refuses what is at this place. */
static bool wrong(body *b, double found, const char *wanted)
{
    return b->p->form == PLY_TEXT
               ? mesh_refuse_line(b->r, b->r->text.line, "found %.17g, allowed is %s", found,
                                  wanted)
               : mesh_refuse_byte(b->r, b->at, "found %.17g, allowed is %s", found, wanted);
}

static size_t left(const body *b)
{
    return (size_t)(b->r->source->bytes + b->r->source->size - b->at);
}

static double binary_number(const char *at, ply_type type, bool big)
{
    switch (type) {
    case PLY_INT8:
        return (double)(int8_t)*at;
    case PLY_UINT8:
        return (double)(uint8_t)*at;
    case PLY_INT16:
        return (double)(int16_t)mesh_bytes16(at, big);
    case PLY_UINT16:
        return (double)mesh_bytes16(at, big);
    case PLY_INT32:
        return (double)(int32_t)mesh_bytes32(at, big);
    case PLY_UINT32:
        return (double)mesh_bytes32(at, big);
    case PLY_INT64:
        return (double)(int64_t)mesh_bytes64(at, big);
    case PLY_UINT64:
        return (double)mesh_bytes64(at, big);
    case PLY_FLOAT:
        return mesh_float(at, big);
    default:
        return mesh_double(at, big);
    }
}

/* Takes a number, binary or text. False: refused. */
static inline bool take_number(body *b, ply_type type, double *number)
{
    mesh_reader *r = b->r;
    if (b->p->form == PLY_TEXT) {
        return mesh_skip_space(&r->text) && mesh_take_number(&r->text, number)
                   ? true
                   : mesh_expect(r, "a decimal number in the range of double");
    }
    if (left(b) < ply_size(type)) {
        return mesh_refuse(r, "the file ends before all that its PLY header promises");
    }
    *number = binary_number(b->at, type, b->p->form == PLY_BIG);
    b->at += ply_size(type);
    return true;
}

/* Passes over a number, or a word in its place. */
static bool skip_number(body *b, ply_type type)
{
    const char *ignored;
    if (b->p->form == PLY_TEXT) {
        return mesh_skip_space(&b->r->text) ? mesh_take_word(&b->r->text, &ignored) > 0
                                            : mesh_expect(b->r, "a number");
    }
    if (left(b) < ply_size(type)) {
        return mesh_refuse(b->r, "the file ends before all that its PLY header promises");
    }
    b->at += ply_size(type);
    return true;
}

/* Takes the count of a list, and compares it with what is left of the file. */
static bool take_list_count(body *b, const ply_property *property, uint64_t *count)
{
    double number;
    if (!take_number(b, property->list, &number)) {
        return false;
    }
    const bool text = b->p->form == PLY_TEXT;
    const size_t there =
        text ? (size_t)(b->r->text.end - b->r->text.at) / 2 : left(b) / ply_size(property->type);
    if (!(number >= 0.0 && number <= (double)there) || number != (double)(uint64_t)number) {
        return wrong(b, number, "a list's count that the rest of the file can hold");
    }
    *count = (uint64_t)number;
    return true;
}

static bool skip_list(body *b, const ply_property *property)
{
    uint64_t count;
    if (!take_list_count(b, property, &count)) {
        return false;
    }
    if (b->p->form != PLY_TEXT) {
        b->at += count * ply_size(property->type);
        return true;
    }
    for (; count > 0; count--) {
        if (!skip_number(b, property->type)) {
            return false;
        }
    }
    return true;
}

/* Adds a corner to the strip; every one from the third on makes a triangle with the two before, and
 * every other triangle is turned round. */
static void add_to_strip(body *b, uint32_t corner)
{
    b->strip[b->strip_count < 2 ? b->strip_count : 2] = corner;
    if (++b->strip_count < 3) {
        return;
    }
    const bool odd = b->strip_count % 2 == 0;
    const uint32_t triangle[3] = {b->strip[odd], b->strip[!odd], corner};
    mesh_add_triangle(b->r, triangle, place_of(b));
    b->strip[0] = b->strip[1];
    b->strip[1] = corner;
}

static bool take_corners(body *b, const ply_property *property, bool strips)
{
    uint64_t count;
    double index;
    if (!take_list_count(b, property, &count)) {
        return false;
    }
    b->strip_count = 0;
    for (; count > 0; count--) {
        if (!take_number(b, property->type, &index)) {
            return false;
        }
        if (strips && index == -1.0) {
            b->strip_count = 0;
            continue;
        }
        if (!(index >= 0.0 && index < (double)UINT32_MAX) || index != (double)(uint32_t)index) {
            return wrong(b, index, "the number of a vertex");
        }
        if (strips) {
            add_to_strip(b, (uint32_t)index);
        } else if (!mesh_indices_add(&b->r->face, (uint32_t)index)) {
            return mesh_refuse_memory(b->r);
        }
    }
    return true;
}

/* Takes a coordinate: a float in text is the float that it is in the binary form. */
static inline bool take_coordinate(body *b, ply_type type, double *number)
{
    if (b->p->form != PLY_TEXT || type != PLY_FLOAT) {
        return take_number(b, type, number);
    }
    return (mesh_skip_space(&b->r->text) && mesh_take_float(&b->r->text, number)) ||
           mesh_expect(b->r, "a decimal number in the range of double");
}

static bool take_property(body *b, const ply_element *e, const ply_property *property)
{
    if (property->use < PLY_CORNERS) {
        return take_coordinate(b, property->type, &b->place[property->use]);
    }
    if (property->use == PLY_CORNERS && e->role != PLY_OTHER) {
        return take_corners(b, property, e->role == PLY_STRIPS);
    }
    return property->list == PLY_NONE ? skip_number(b, property->type) : skip_list(b, property);
}

/* Takes an instance of an element. */
static bool take_instance(body *b, const ply_element *e)
{
    mesh_reader *r = b->r;
    if (b->p->form == PLY_TEXT) {
        mesh_skip_space(&r->text);
    }
    const uint64_t place = place_of(b);
    for (size_t k = e->first; k < e->first + e->property_count; k++) {
        if (!take_property(b, e, &b->p->properties[k])) {
            return false;
        }
    }
    if (e->role == PLY_VERTEX) {
        grow_vertex(&r->mesh, b->place[0], b->place[1], b->place[2]);
    } else if (e->role == PLY_FACE && !mesh_add_face(r, place)) {
        return false;
    }
    mesh_tick(r);
    if (b->p->form != PLY_TEXT || e->property_count == 0) {
        return true;
    }
    mesh_skip_blanks(&r->text);
    return mesh_at_line_end(&r->text) ||
           mesh_expect(r, "the end of the line, behind all that the header promises of it");
}

/* The least that an instance takes: bytes, or characters of numbers and what is between them. */
static size_t least_size(const body *b, const ply_element *e)
{
    size_t size = 0;
    for (size_t k = e->first; k < e->first + e->property_count; k++) {
        const ply_property *property = &b->p->properties[k];
        size += b->p->form == PLY_TEXT
                    ? 2
                    : ply_size(property->list == PLY_NONE ? property->type : property->list);
    }
    return size;
}

static bool is_fixed(const body *b, const ply_element *e)
{
    bool fixed = true;
    for (size_t k = e->first; k < e->first + e->property_count; k++) {
        fixed = fixed && b->p->properties[k].list == PLY_NONE;
    }
    return fixed;
}

static bool take_element(body *b, const ply_element *e)
{
    const bool text = b->p->form == PLY_TEXT;
    const size_t least = least_size(b, e);
    /* behind the last number of a text there may be nothing */
    const size_t there = text ? (size_t)(b->r->text.end - b->r->text.at) + 1 : left(b);
    char name[MESH_FOUND_TEXT];
    if (least != 0 && e->count > there / least) {
        return mesh_refuse(
            b->r,
            "its PLY header promises %llu of element %s, but the %llu bytes that are "
            "left cannot hold them",
            (unsigned long long)e->count, mesh_quote(e->name, e->name_length, name),
            (unsigned long long)(text ? there - 1 : there));
    }
    b->r->out->left_out += e->role == PLY_EDGE ? e->count : 0;
    if (least == 0 || (!text && e->role != PLY_VERTEX && is_fixed(b, e))) {
        b->at += text ? 0 : e->count * least;
        return true;
    }
    for (uint64_t i = 0; i < e->count; i++) {
        if (!take_instance(b, e)) {
            return false;
        }
    }
    return true;
}

static bool take_body(mesh_reader *r, const ply *p)
{
    body b = {.r = r, .p = p, .at = r->text.at};
    for (size_t i = 0; i < p->element_count; i++) {
        if (!take_element(&b, &p->elements[i])) {
            return false;
        }
    }
    const uint64_t vertices = r->mesh.number_count / 3;
    if (r->mesh.failed) {
        return mesh_refuse_memory(r);
    }
    if (r->largest > vertices) {
        const char *const trouble = "a face refers to vertex %llu, but the file has %llu, counted "
                                    "from 0";
        return p->form == PLY_TEXT ? mesh_refuse_line(r, r->largest_place, trouble,
                                                      (unsigned long long)r->largest - 1,
                                                      (unsigned long long)vertices)
                                   : mesh_refuse_byte(r, r->source->bytes + r->largest_place - 1,
                                                      trouble, (unsigned long long)r->largest - 1,
                                                      (unsigned long long)vertices);
    }
    mesh_note_rest(r, p->form == PLY_TEXT ? r->text.at : b.at);
    return mesh_cut_late(r) && mesh_add_geometry(r);
}

bool mesh_read_ply(mesh_reader *r)
{
    ply p = {0};
    const bool fine = ply_read_header(r, &p) && take_body(r, &p);
    free(p.elements);
    free(p.properties);
    return fine;
}
