/* SPDX-License-Identifier: Apache-2.0 */
#include "memory.h"

#include <stdint.h>
#include <stdlib.h>

void *accel_memory_system(void *user, void *old, size_t from, size_t to)
{
    (void)user;
    (void)from;
    if (to == 0) {
        free(old);
        return NULL;
    }
    return realloc(old, to);
}

void *accel_memory_resize(struct memory *m, void *old, size_t from, size_t to)
{
    if (from == to)
        return old;
    void *block = m->resize(m->user, old, from, to);
    if (!block && to != 0) {
        m->refused = to;
        return NULL;
    }
    m->bytes = m->bytes - from + to;
    if (m->bytes > m->peak)
        m->peak = m->bytes;
    return block;
}

bool accel_memory_room(struct memory *m, void **at, size_t *capacity, size_t need, size_t size)
{
    if (need <= *capacity)
        return true;
    size_t grown = *capacity + *capacity / 2;
    if (grown < need)
        grown = need;
    if (grown > SIZE_MAX / size) {
        m->refused = SIZE_MAX;
        return false;
    }
    void *block = accel_memory_resize(m, *at, *capacity * size, grown * size);
    if (!block)
        return false;
    *at = block;
    *capacity = grown;
    return true;
}
