/* SPDX-License-Identifier: Apache-2.0 */
#include "cluster_cells.h"

enum { SMALLEST_ROOM = 64 };

static bool grow(struct memory *m, struct cells *c, size_t capacity)
{
    const struct cells old = *c;
    struct cell_slot *slot = capacity > SIZE_MAX / sizeof *slot
                                 ? NULL
                                 : accel_memory_resize(m, NULL, 0, capacity * sizeof *slot);
    if (!slot)
        return false;
    for (size_t i = 0; i < capacity; i++)
        slot[i] = (struct cell_slot){0, ACCEL_NONE};
    c->slot = slot;
    c->capacity = capacity;
    for (size_t i = 0; i < old.capacity; i++)
        if (old.slot[i].value != ACCEL_NONE)
            *cells_probe(c, old.slot[i].key) = old.slot[i];
    accel_memory_resize(m, old.slot, old.capacity * sizeof *slot, 0);
    return true;
}

bool accel_cells_reserve(struct memory *m, struct cells *c, size_t count)
{
    size_t capacity = SMALLEST_ROOM;
    while (capacity / 2 < count)
        capacity *= 2;
    return grow(m, c, capacity);
}

struct cell_slot *accel_cells_at(struct memory *m, struct cells *c, uint64_t key)
{
    if (2 * c->used >= c->capacity && !grow(m, c, c->capacity ? 2 * c->capacity : SMALLEST_ROOM))
        return NULL;
    struct cell_slot *s = cells_probe(c, key);
    if (s->value == ACCEL_NONE) {
        s->key = key;
        c->used++;
    }
    return s;
}

void accel_cells_free(struct memory *m, struct cells *c)
{
    accel_memory_resize(m, c->slot, c->capacity * sizeof *c->slot, 0);
    *c = (struct cells){0};
}
