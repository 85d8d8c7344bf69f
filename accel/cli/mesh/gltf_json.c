/* SPDX-License-Identifier: Apache-2.0
 *
 * What the objects of a glTF say, each number within its range.
 */
#include "gltf.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

bool gltf_refuse(gltf *g, const gltf_object *object, const char *format, ...)
{
    char trouble[200];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(trouble, sizeof trouble, format, arguments);
    va_end(arguments);
    return mesh_refuse(g->r, "%s[%zu] %s", object->list, object->index, trouble);
}

size_t gltf_count(const gltf *g, const char *list)
{
    return json_array_size(json_object_get(g->root, list));
}

bool gltf_find(gltf *g, const char *list, uint64_t index, gltf_object *found)
{
    const size_t count = gltf_count(g, list);
    *found = (gltf_object){NULL, list, (size_t)index};
    if (index >= count) {
        return mesh_refuse(g->r, "something refers to %s[%llu], but there are %zu", list,
                           (unsigned long long)index, count);
    }
    found->json = json_array_get(json_object_get(g->root, list), (size_t)index);
    return json_is_object(found->json) || gltf_refuse(g, found, "is no object");
}

bool gltf_whole(gltf *g, const gltf_object *object, json_t *json, const char *key,
                uint64_t standard, uint64_t most, uint64_t *number)
{
    const json_t *value = json_object_get(json, key);
    if (value == NULL && standard != GLTF_REQUIRED) {
        *number = standard;
        return true;
    }
    if (value == NULL) {
        return gltf_refuse(g, object, "has no %s", key);
    }
    const double given = json_is_number(value) ? json_number_value(value) : -1.0;
    if (!(given >= 0.0 && given <= (double)most) || given != floor(given)) {
        return gltf_refuse(g, object, "has a %s that is no whole number from 0 to %llu", key,
                           (unsigned long long)most);
    }
    *number = (uint64_t)given;
    return true;
}

bool gltf_numbers(gltf *g, const gltf_object *object, const char *key, size_t count,
                  double *numbers, bool *given)
{
    const json_t *value = json_object_get(object->json, key);
    *given = value != NULL;
    if (value == NULL) {
        return true;
    }
    bool fine = json_array_size(value) == count;
    for (size_t i = 0; i < count && fine; i++) {
        const json_t *item = json_array_get(value, i);
        numbers[i] = json_number_value(item);
        fine = json_is_number(item) && isfinite(numbers[i]);
    }
    return fine || gltf_refuse(g, object, "has a %s that is not %zu numbers", key, count);
}

json_t *gltf_list(gltf *g, const gltf_object *object, json_t *json, const char *key, bool *fine)
{
    json_t *value = json_object_get(json, key);
    *fine = value == NULL || json_is_array(value) ||
            gltf_refuse(g, object, "has a %s that is no list", key);
    return *fine ? value : NULL;
}
