/* SPDX-License-Identifier: Apache-2.0
 *
 * glTF 2.0, as text and as GLB, over the JSON library jansson: the default scene, or the first one,
 * at rest. Each primitive of triangles is a geometry for each node that shows it. An extension that
 * the file requires and that could change the triangles is refused by its name.
 */
#include "gltf.h"

#include "bytes.h"

#include <stdlib.h>
#include <string.h>

enum { CHUNK_JSON = 0x4E4F534A, CHUNK_BINARY = 0x004E4942 };

/* Text of a JSON document. */
typedef struct span {
    const char *bytes;
    size_t size;
} span;

/* Finds the document and the binary chunk of a GLB. */
static bool open_glb(gltf *g, span *json)
{
    const struct mesh_source *source = g->r->source;
    const char *const begin = source->bytes;
    const uint32_t version = source->size < 20 ? 0 : mesh_bytes32(begin + 4, false);
    const uint64_t size = source->size < 20 ? 0 : mesh_bytes32(begin + 8, false);
    if (version != 2 || size > source->size) {
        return mesh_refuse(g->r,
                           "is a GLB of version %lu and %llu bytes, of which %zu are there; "
                           "allowed is version 2",
                           (unsigned long)version, (unsigned long long)size, source->size);
    }
    for (uint64_t at = 12, chunk = 0; at + 8 <= size; chunk++) {
        const uint64_t length = mesh_bytes32(begin + at, false);
        const uint32_t type = mesh_bytes32(begin + at + 4, false);
        if (length > size - at - 8 || (chunk == 0) != (type == CHUNK_JSON)) {
            return mesh_refuse_byte(g->r, begin + at,
                                    "a chunk of %llu bytes and type %08lx, "
                                    "allowed is first JSON, and what is there",
                                    (unsigned long long)length, (unsigned long)type);
        }
        if (chunk == 0) {
            *json = (span){begin + at + 8, (size_t)length};
        } else if (type == CHUNK_BINARY && g->chunk == NULL) {
            g->chunk = begin + at + 8;
            g->chunk_size = (size_t)length;
        }
        at += 8 + length;
    }
    mesh_note_rest(g->r, begin + size);
    return json->bytes != NULL || mesh_refuse(g->r, "is a GLB without a JSON chunk");
}

static bool parse(gltf *g, span json)
{
    json_error_t error;
    while (json.size > 0 && json.bytes[json.size - 1] == '\0') {
        json.size--;
    }
    g->root = json_loadb(json.bytes, json.size, JSON_REJECT_DUPLICATES, &error);
    if (g->root == NULL) {
        char text[MESH_FOUND_TEXT];
        return mesh_refuse_line(g->r, (uint64_t)(error.line < 1 ? 1 : error.line),
                                "no JSON in column %d: %s", error.column,
                                mesh_quote(error.text, strlen(error.text), text));
    }
    return json_is_object(g->root) || mesh_refuse(g->r, "is JSON, but no object");
}

/* Does the extension only concern what is seen of triangles? */
static bool is_harmless(const char *extension)
{
    static const char *const beginnings[] = {
        "KHR_materials_", "KHR_texture_",         "EXT_texture_", "MSFT_texture_",
        "KHR_lights_",    "EXT_lights_",          "KHR_xmp",      "KHR_animation_",
        "KHR_audio",      "KHR_mesh_quantization"};
    for (size_t i = 0; i < sizeof beginnings / sizeof beginnings[0]; i++) {
        if (strncmp(extension, beginnings[i], strlen(beginnings[i])) == 0) {
            return true;
        }
    }
    return false;
}

/* Refuses what is required and not understood; notes what is used and passed over. */
static bool check_extensions(gltf *g, const char *key, bool required)
{
    const json_t *list = json_object_get(g->root, key);
    char text[MESH_FOUND_TEXT];
    for (size_t i = 0; i < json_array_size(list); i++) {
        const char *name = json_string_value(json_array_get(list, i));
        if (name == NULL) {
            return mesh_refuse(g->r, "%s[%zu] is no name", key, i);
        }
        g->is_quantized = g->is_quantized || strcmp(name, "KHR_mesh_quantization") == 0;
        if (is_harmless(name)) {
            continue;
        }
        if (required) {
            return mesh_refuse(g->r, "requires the extension %s, which is not supported",
                               mesh_quote(name, strlen(name), text));
        }
        mesh_note(g->r, "its extension %s is passed over", mesh_quote(name, strlen(name), text));
    }
    return true;
}

static bool check_version(gltf *g)
{
    const json_t *asset = json_object_get(g->root, "asset");
    const char *version = json_string_value(json_object_get(asset, "version"));
    const char *least = json_string_value(json_object_get(asset, "minVersion"));
    char text[MESH_FOUND_TEXT];
    if (version == NULL || strncmp(version, "2.", 2) != 0) {
        return mesh_refuse(g->r, "is glTF of version %s, allowed is 2.0",
                           version == NULL ? "none" : mesh_quote(version, strlen(version), text));
    }
    return least == NULL || strcmp(least, "2.0") == 0 ||
           mesh_refuse(g->r, "requires glTF of version %s, allowed is 2.0",
                       mesh_quote(least, strlen(least), text));
}

/* Counts what all placed meshes take, before any of it is made. */
static bool check_memory(gltf *g)
{
    uint64_t triangles = 0, bytes = 0;
    for (size_t i = 0; i < g->placed_count; i++) {
        const gltf_mesh *mesh = gltf_read_mesh(g, g->placed[i].mesh);
        if (mesh == NULL) {
            return false;
        }
        g->r->out->left_out += mesh->left_out;
        triangles += mesh->triangles;
        bytes += mesh->bytes;
    }
    return bytes <= g->r->source->memory ||
           mesh_refuse(g->r,
                       "shows %zu meshes of %llu triangles together, which take %llu MB of memory, "
                       "but %llu MB are free: free some",
                       g->placed_count, (unsigned long long)triangles,
                       (unsigned long long)(bytes >> 20),
                       (unsigned long long)(g->r->source->memory >> 20));
}

/* Moves the vertices that are used to the front, in their order, and renumbers the corners. */
static bool keep_used(struct growing *mesh)
{
    const size_t vertices = mesh->number_count / 3;
    uint32_t *own = calloc(vertices + 1, sizeof *own);
    if (own == NULL) {
        return false;
    }
    for (size_t i = 0; i < mesh->index_count; i++) {
        own[mesh->indices[i]] = 1;
    }
    uint32_t used = 0;
    for (size_t i = 0; i < vertices; i++) {
        if (own[i] != 0) {
            memmove(mesh->numbers + 3 * (size_t)used, mesh->numbers + 3 * i, 3 * sizeof(double));
            own[i] = used++;
        }
    }
    for (size_t i = 0; i < mesh->index_count; i++) {
        mesh->indices[i] = own[mesh->indices[i]];
    }
    free(own);
    mesh->number_count = 3 * (size_t)used;
    double *numbers = realloc(mesh->numbers, mesh->number_count * sizeof *numbers);
    mesh->numbers = numbers == NULL ? mesh->numbers : numbers;
    return true;
}

static bool add_primitive(gltf *g, const gltf_placed *placed, const gltf_primitive *p)
{
    struct growing *mesh = &g->r->mesh;
    mesh->number_count = 3 * (size_t)p->vertex_count;
    mesh->index_count = 3 * (size_t)p->triangle_count;
    mesh->numbers = malloc(mesh->number_count * sizeof *mesh->numbers);
    mesh->indices = malloc(mesh->index_count * sizeof *mesh->indices);
    if (mesh->numbers == NULL || mesh->indices == NULL) {
        return mesh_refuse_memory(g->r);
    }
    memcpy(mesh->indices, p->triangles, mesh->index_count * sizeof *mesh->indices);
    if (g->r->source->progress != NULL) {
        g->r->source->progress(g->r->source->user, "reading");
    }
    if (!gltf_place(g, placed, p, mesh->numbers)) {
        return false;
    }
    if (mesh->index_count < p->vertex_count && !keep_used(mesh)) {
        return mesh_refuse_memory(g->r);
    }
    return mesh_add_geometry(g->r);
}

static bool add_meshes(gltf *g)
{
    for (size_t i = 0; i < g->placed_count; i++) {
        const gltf_mesh *mesh = gltf_read_mesh(g, g->placed[i].mesh);
        for (size_t k = 0; k < mesh->count; k++) {
            const gltf_primitive *p = &mesh->primitives[k];
            if (!add_primitive(g, &g->placed[i], p)) {
                return false;
            }
        }
    }
    return true;
}

static bool read_scene(gltf *g)
{
    g->buffer_count = gltf_count(g, "buffers");
    g->mesh_count = gltf_count(g, "meshes");
    g->buffers = calloc(g->buffer_count + 1, sizeof *g->buffers);
    g->meshes = calloc(g->mesh_count + 1, sizeof *g->meshes);
    g->skin_count = gltf_count(g, "skins");
    g->skins = calloc(g->skin_count + 1, sizeof *g->skins);
    if (g->buffers == NULL || g->meshes == NULL || g->skins == NULL) {
        return mesh_refuse_memory(g->r);
    }
    return gltf_walk(g) && check_memory(g) && add_meshes(g);
}

static void free_all(gltf *g)
{
    for (size_t i = 0; g->buffers != NULL && i < g->buffer_count; i++) {
        free(g->buffers[i].owned);
    }
    for (size_t i = 0; g->meshes != NULL && i < g->mesh_count; i++) {
        for (size_t k = 0; k < g->meshes[i].count; k++) {
            free(g->meshes[i].primitives[k].triangles);
        }
        free(g->meshes[i].primitives);
    }
    for (size_t i = 0; g->skins != NULL && i < g->skin_count; i++) {
        free(g->skins[i].joints);
    }
    free(g->skins);
    free(g->buffers);
    free(g->meshes);
    free(g->matrices);
    free(g->reached);
    free(g->placed);
    json_decref(g->root);
}

bool mesh_read_gltf(mesh_reader *r)
{
    gltf g = {.r = r};
    const mesh_text *text = &r->text;
    span json = {text->at, (size_t)(text->end - text->at)};
    const bool binary = r->source->size >= 4 && memcmp(r->source->bytes, "glTF", 4) == 0;
    const bool fine = (!binary || (json.bytes = NULL, open_glb(&g, &json))) && parse(&g, json) &&
                      check_version(&g) && check_extensions(&g, "extensionsRequired", true) &&
                      check_extensions(&g, "extensionsUsed", false) && read_scene(&g);
    free_all(&g);
    return fine;
}
