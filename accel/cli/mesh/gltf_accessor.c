/* SPDX-License-Identifier: Apache-2.0
 *
 * Accessors: numbers of any type and stride, normalized or not, with sparse replacements.
 */
#include "gltf.h"

#include "bytes.h"

#include <stdlib.h>
#include <string.h>

/* Numbers to read, some nanoseconds each: with the binary files of 8 GiB that are read at most, all
 * of it four times over. */
#define MOST_WORK ((uint64_t)1 << 33)

static size_t size_of(int type)
{
    return type == 5120 || type == 5121   ? 1
           : type == 5122 || type == 5123 ? 2
           : type == 5125 || type == 5126 ? 4
                                          : 0;
}

static int components_of(const char *type)
{
    return type == NULL                  ? 0
           : strcmp(type, "SCALAR") == 0 ? 1
           : strcmp(type, "VEC2") == 0   ? 2
           : strcmp(type, "VEC3") == 0   ? 3
           : strcmp(type, "VEC4") == 0   ? 4
           : strcmp(type, "MAT4") == 0   ? 16
                                         : 0;
}

/* A component as the number that it stands for. */
static double component(const char *at, int type, bool normalized)
{
    double number, most = 1.0;
    switch (type) {
    case 5120:
        number = (double)(int8_t)*at, most = 127.0;
        break;
    case 5121:
        number = (double)(uint8_t)*at, most = 255.0;
        break;
    case 5122:
        number = (double)(int16_t)mesh_bytes16(at, false), most = 32767.0;
        break;
    case 5123:
        number = (double)mesh_bytes16(at, false), most = 65535.0;
        break;
    case 5125:
        number = (double)mesh_bytes32(at, false), most = 4294967295.0;
        break;
    default:
        return mesh_float(at, false);
    }
    if (!normalized) {
        return number;
    }
    return number < -most ? -1.0 : number / most;
}

/* The place of its bytes; *stride becomes what the view says, if anything. */
static bool find_bytes(gltf *g, gltf_accessor *a, uint64_t view, uint64_t offset)
{
    const uint64_t size = (uint64_t)a->components * size_of(a->type);
    a->stride = (size_t)size;
    /* of what length is known only with the stride */
    if (gltf_view(g, view, 0, 0, &a->stride, &a->object) == NULL) {
        return false;
    }
    if (a->stride < size || a->count > GLTF_MOST / 256) {
        return gltf_refuse(g, &a->object, "has elements of %llu bytes every %zu bytes",
                           (unsigned long long)size, a->stride);
    }
    a->bytes = gltf_view(g, view, offset, a->count == 0 ? 0 : (a->count - 1) * a->stride + size,
                         NULL, &a->object);
    return a->bytes != NULL;
}

bool gltf_open_accessor(gltf *g, uint64_t index, gltf_accessor *a)
{
    uint64_t type, view, offset;
    *a = (gltf_accessor){0};
    if (!gltf_find(g, "accessors", index, &a->object) ||
        !gltf_whole(g, &a->object, a->object.json, "componentType", GLTF_REQUIRED, 65535, &type) ||
        !gltf_whole(g, &a->object, a->object.json, "count", GLTF_REQUIRED, UINT32_MAX - 2,
                    &a->count) ||
        !gltf_whole(g, &a->object, a->object.json, "bufferView", GLTF_MOST, GLTF_MOST - 1, &view) ||
        !gltf_whole(g, &a->object, a->object.json, "byteOffset", 0, GLTF_MOST, &offset)) {
        return false;
    }
    a->type = (int)type;
    a->components = components_of(json_string_value(json_object_get(a->object.json, "type")));
    a->normalized = json_is_true(json_object_get(a->object.json, "normalized"));
    if (size_of(a->type) == 0 || a->components == 0) {
        return gltf_refuse(g, &a->object,
                           "has componentType %d or a type that is not read, allowed are 5120 to "
                           "5123, 5125, 5126, and SCALAR, VEC2, VEC3, VEC4, MAT4",
                           a->type);
    }
    return view == GLTF_MOST || find_bytes(g, a, view, offset);
}

/* The places and the numbers that sparse replaces. */
typedef struct replacement {
    const char *indices, *values;
    uint64_t count;
    int type; /* of an index */
} replacement;

static bool open_sparse(gltf *g, const gltf_accessor *a, json_t *sparse, replacement *s)
{
    const uint64_t size = (uint64_t)a->components * size_of(a->type);
    json_t *indices = json_object_get(sparse, "indices"),
           *values = json_object_get(sparse, "values");
    uint64_t type, index_view, index_offset, value_view, value_offset;
    if (!gltf_whole(g, &a->object, sparse, "count", GLTF_REQUIRED, a->count, &s->count) ||
        !gltf_whole(g, &a->object, indices, "componentType", GLTF_REQUIRED, 65535, &type) ||
        !gltf_whole(g, &a->object, indices, "bufferView", GLTF_REQUIRED, GLTF_MOST, &index_view) ||
        !gltf_whole(g, &a->object, indices, "byteOffset", 0, GLTF_MOST, &index_offset) ||
        !gltf_whole(g, &a->object, values, "bufferView", GLTF_REQUIRED, GLTF_MOST, &value_view) ||
        !gltf_whole(g, &a->object, values, "byteOffset", 0, GLTF_MOST, &value_offset)) {
        return false;
    }
    if (type != 5121 && type != 5123 && type != 5125) {
        return gltf_refuse(g, &a->object,
                           "has sparse indices of componentType %llu, allowed are "
                           "5121, 5123 and 5125",
                           (unsigned long long)type);
    }
    s->type = (int)type;
    s->indices =
        gltf_view(g, index_view, index_offset, s->count * size_of(s->type), NULL, &a->object);
    s->values = s->indices == NULL
                    ? NULL
                    : gltf_view(g, value_view, value_offset, s->count * size, NULL, &a->object);
    return s->values != NULL;
}

static void read_element(const gltf_accessor *a, const char *at, double *numbers)
{
    for (int k = 0; k < a->components; k++) {
        numbers[k] = component(at + (size_t)k * size_of(a->type), a->type, a->normalized);
    }
}

static bool replace(gltf *g, const gltf_accessor *a, const replacement *s, double *numbers)
{
    const size_t size = (size_t)a->components * size_of(a->type);
    double last = -1.0;
    for (uint64_t i = 0; i < s->count; i++) {
        const double index = component(s->indices + i * size_of(s->type), s->type, false);
        if (!(index > last && index < (double)a->count)) {
            return gltf_refuse(g, &a->object,
                               "has sparse indices that do not rise, or that are "
                               "beyond its %llu elements",
                               (unsigned long long)a->count);
        }
        last = index;
        read_element(a, s->values + i * size, numbers + (size_t)index * (size_t)a->components);
    }
    return true;
}

bool gltf_read_accessor(gltf *g, const gltf_accessor *a, double *numbers)
{
    g->work += a->count * (uint64_t)a->components;
    if (g->work > MOST_WORK) {
        return gltf_refuse(g, &a->object,
                           "and others are used so often that reading takes too long");
    }
    json_t *sparse = json_object_get(a->object.json, "sparse");
    const size_t components = (size_t)a->components;
    if (a->bytes == NULL) {
        memset(numbers, 0, a->count * components * sizeof *numbers);
    } else {
        for (uint64_t i = 0; i < a->count; i++) {
            read_element(a, a->bytes + i * a->stride, numbers + i * components);
        }
    }
    replacement s;
    return sparse == NULL || (open_sparse(g, a, sparse, &s) && replace(g, a, &s, numbers));
}

double *gltf_load_accessor(gltf *g, const gltf_accessor *a)
{
    const uint64_t bytes = a->count * (uint64_t)a->components * sizeof(double);
    double *numbers = bytes > g->r->source->memory ? NULL : malloc((size_t)bytes + 1);
    if (numbers == NULL) {
        gltf_refuse(g, &a->object, "has %llu elements, which do not fit into memory",
                    (unsigned long long)a->count);
    } else if (!gltf_read_accessor(g, a, numbers)) {
        free(numbers);
        numbers = NULL;
    }
    return numbers;
}
