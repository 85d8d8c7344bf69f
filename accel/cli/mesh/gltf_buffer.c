/* SPDX-License-Identifier: Apache-2.0
 *
 * The bytes of a glTF: its binary chunk, a text in base 64 (RFC 4648), or a file beside it.
 */
#include "gltf.h"

#include <stdlib.h>
#include <string.h>

static int sextet(char c)
{
    return c >= 'A' && c <= 'Z'   ? c - 'A'
           : c >= 'a' && c <= 'z' ? c - 'a' + 26
           : c >= '0' && c <= '9' ? c - '0' + 52
           : c == '+'             ? 62
           : c == '/'             ? 63
                                  : -1;
}

/* Writes the bytes of a text in base 64. Returns their number, or SIZE_MAX where it is none. */
static size_t decode(const char *text, size_t length, char *bytes)
{
    while (length > 0 && text[length - 1] == '=') {
        length--;
    }
    unsigned bits = 0;
    size_t count = 0;
    for (size_t i = 0; i < length; i++) {
        const int value = sextet(text[i]);
        if (value < 0) {
            return SIZE_MAX;
        }
        bits = bits << 6 | (unsigned)value;
        if (i % 4 != 0) {
            bytes[count++] = (char)(bits >> (6 - 2 * (i % 4)));
        }
    }
    return length % 4 == 1 ? SIZE_MAX : count;
}

static bool take_data(gltf *g, const gltf_object *object, const char *uri, gltf_buffer *buffer)
{
    const char *comma = strchr(uri, ',');
    if (comma == NULL || comma - uri < 12 || memcmp(comma - 7, ";base64", 7) != 0) {
        return gltf_refuse(g, object, "has a uri of data that is not in base64");
    }
    const size_t length = strlen(comma + 1);
    buffer->owned = malloc(length + 1);
    if (buffer->owned == NULL) {
        return mesh_refuse_memory(g->r);
    }
    buffer->size = decode(comma + 1, length, buffer->owned);
    buffer->bytes = buffer->owned;
    return buffer->size != SIZE_MAX ||
           gltf_refuse(g, object, "has a uri of data that is not in base64");
}

static int hex(char c)
{
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
                                  : -1;
}

/* The name of a file in the same folder, %XX replaced; NULL where it is something else. To be freed
 * by the caller. */
static char *name_beside(const char *uri)
{
    uri += strncmp(uri, "./", 2) == 0 ? 2 : 0;
    char *name = malloc(strlen(uri) + 1);
    char *to = name;
    while (name != NULL && *uri != '\0') {
        const int high = *uri == '%' ? hex(uri[1]) : -1, low = high < 0 ? -1 : hex(uri[2]);
        *to++ = (char)(low < 0 ? *uri : high * 16 + low);
        uri += low < 0 ? 1 : 3;
    }
    if (name != NULL) {
        *to = '\0';
    }
    if (name != NULL && (strlen(name) != (size_t)(to - name) || strchr(name, '/') != NULL ||
                         *name == '\0' || strcmp(name, "..") == 0 || strcmp(name, ".") == 0)) {
        free(name);
        name = NULL;
    }
    return name;
}

static bool take_file(gltf *g, const gltf_object *object, const char *uri, gltf_buffer *buffer)
{
    const struct mesh_source *source = g->r->source;
    char quoted[MESH_FOUND_TEXT];
    char *name = name_beside(uri);
    if (name == NULL || source->beside == NULL) {
        free(name);
        return gltf_refuse(g, object, "refers to %s, allowed is a file in the folder of the glTF",
                           mesh_quote(uri, strlen(uri), quoted));
    }
    struct file file = {0};
    const bool fine = source->beside(source->user, &file, name, g->r->error);
    free(name);
    buffer->bytes = buffer->owned = file.bytes;
    buffer->size = file.size;
    return fine;
}

static bool take_buffer(gltf *g, const gltf_object *object, gltf_buffer *buffer)
{
    const json_t *uri = json_object_get(object->json, "uri");
    uint64_t length;
    if (!gltf_whole(g, object, object->json, "byteLength", GLTF_REQUIRED, GLTF_MOST, &length)) {
        return false;
    }
    bool fine = true;
    if (uri == NULL && object->index == 0 && g->chunk != NULL) {
        buffer->bytes = g->chunk;
        buffer->size = g->chunk_size;
    } else if (!json_is_string(uri)) {
        return gltf_refuse(g, object, "has no uri, and there is no binary chunk for it");
    } else if (strncmp(json_string_value(uri), "data:", 5) == 0) {
        fine = take_data(g, object, json_string_value(uri), buffer);
    } else {
        fine = take_file(g, object, json_string_value(uri), buffer);
    }
    if (!fine) {
        return false;
    }
    if (length > buffer->size) {
        return gltf_refuse(g, object, "has %llu bytes by its byteLength, but only %zu are there",
                           (unsigned long long)length, buffer->size);
    }
    buffer->size = (size_t)length;
    return true;
}

const char *gltf_view(gltf *g, uint64_t view, uint64_t offset, uint64_t size, size_t *stride,
                      const gltf_object *user)
{
    gltf_object object, of_buffer;
    uint64_t buffer, begin, length, step;
    if (!gltf_find(g, "bufferViews", view, &object) ||
        !gltf_whole(g, &object, object.json, "buffer", GLTF_REQUIRED, GLTF_MOST, &buffer) ||
        !gltf_whole(g, &object, object.json, "byteOffset", 0, GLTF_MOST, &begin) ||
        !gltf_whole(g, &object, object.json, "byteLength", GLTF_REQUIRED, GLTF_MOST, &length) ||
        !gltf_whole(g, &object, object.json, "byteStride", 0, 252, &step) ||
        !gltf_find(g, "buffers", buffer, &of_buffer)) {
        return NULL;
    }
    gltf_buffer *b = &g->buffers[buffer];
    if (b->bytes == NULL && !take_buffer(g, &of_buffer, b)) {
        return NULL;
    }
    if (begin > b->size || length > b->size - begin) {
        gltf_refuse(g, &object, "has bytes %llu to %llu of a buffer of %zu",
                    (unsigned long long)begin, (unsigned long long)(begin + length), b->size);
        return NULL;
    }
    if (offset > length || size > length - offset) {
        gltf_refuse(g, user, "needs bytes %llu to %llu of bufferViews[%zu], which has %llu",
                    (unsigned long long)offset, (unsigned long long)(offset + size), object.index,
                    (unsigned long long)length);
        return NULL;
    }
    if (stride != NULL && step != 0) {
        *stride = (size_t)step;
    }
    return b->bytes + begin + offset;
}
