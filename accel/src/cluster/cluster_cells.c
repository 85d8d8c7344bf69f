/* SPDX-License-Identifier: Apache-2.0 */
#include "cluster_cells.h"

enum { SMALLEST_ROOM = 64 };

static bool grow(struct memory *m, struct cells *c, size_t room)
{
    const struct cells old = *c;
    struct cell_slot *slot = room > SIZE_MAX / sizeof *slot
                                 ? NULL
                                 : accel_memory_resize(m, NULL, 0, room * sizeof *slot);
    if (!slot)
        return false;
    for (size_t i = 0; i < room; i++)
        slot[i] = (struct cell_slot){0, ACCEL_NONE};
    c->slot = slot;
    c->room = room;
    for (size_t i = 0; i < old.room; i++)
        if (old.slot[i].value != ACCEL_NONE)
            *cells_probe(c, old.slot[i].key) = old.slot[i];
    accel_memory_resize(m, old.slot, old.room * sizeof *slot, 0);
    return true;
}

bool accel_cells_reserve(struct memory *m, struct cells *c, size_t count)
{
    size_t room = SMALLEST_ROOM;
    while (room / 2 < count)
        room *= 2;
    return grow(m, c, room);
}

struct cell_slot *accel_cells_at(struct memory *m, struct cells *c, uint64_t key)
{
    if (2 * c->used >= c->room && !grow(m, c, c->room ? 2 * c->room : SMALLEST_ROOM))
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
    accel_memory_resize(m, c->slot, c->room * sizeof *c->slot, 0);
    *c = (struct cells){0};
}
