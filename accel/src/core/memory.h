/* SPDX-License-Identifier: Apache-2.0
 *
 * Memory of one structure: every block goes through the caller's hook, and sizes are given both
 * ways, so the byte count is exact and a test can make the n-th allocation fail. Arrays grow by
 * half, so growing costs amortised constant time per element.
 */
#ifndef ACCEL_MEMORY_H
#define ACCEL_MEMORY_H

#include <stdbool.h>
#include <stddef.h>

struct memory {
    void *(*resize)(void *user, void *old, size_t from, size_t to); /* accel_hooks.resize */
    void *user;                                                     /* accel_hooks.user */
    size_t bytes;                                                   /* held now */
    size_t peak;                                                    /* held at most so far */
    size_t refused; /* the size that could not be had, 0 if all went well */
    size_t limit;   /* most that may be held, accel_hooks.memory_limit; 0: no limit */
    size_t wanted;  /* what would have been held with what the limit refused; 0: it refused nothing */
};

/* The hook that stands for none: realloc and free. */
void *accel_memory_system(void *user, void *old, size_t from, size_t to);

/* Allocates (old NULL), resizes or frees (to 0). NULL if there is none; old is then as before. */
void *accel_memory_resize(struct memory *m, void *old, size_t from, size_t to);

/* Gives `*at`, an array of `*capacity` elements of `size` bytes, room for `need` of them. */
bool accel_memory_room(struct memory *m, void **at, size_t *capacity, size_t need, size_t size);

/* A growable array: at[0 .. count - 1] are in use, there is room for `capacity`. Zero is empty. */
#define ARRAY_OF(type)                                                                             \
    struct {                                                                                       \
        type *at;                                                                                  \
        size_t count, capacity;                                                                    \
    }

#define array_reserve(m, a, need)                                                                  \
    accel_memory_room((m), (void **)&(a)->at, &(a)->capacity, (need), sizeof *(a)->at)

/* Makes `more` new elements at the end; their content is undefined. */
#define array_extend(m, a, more)                                                                   \
    (array_reserve((m), (a), (a)->count + (more)) && ((a)->count += (more), true))

/* Gives back the room that is not used. */
#define array_trim(m, a)                                                                           \
    do {                                                                                           \
        void *trimmed_ = accel_memory_resize((m), (a)->at, (a)->capacity * sizeof *(a)->at,        \
                                             (a)->count * sizeof *(a)->at);                        \
        if (trimmed_ || (a)->count == 0) {                                                         \
            (a)->at = trimmed_;                                                                    \
            (a)->capacity = (a)->count;                                                            \
        }                                                                                          \
    } while (0)

#define array_free(m, a)                                                                           \
    do {                                                                                           \
        accel_memory_resize((m), (a)->at, (a)->capacity * sizeof *(a)->at, 0);                     \
        (a)->at = NULL;                                                                            \
        (a)->count = (a)->capacity = 0;                                                            \
    } while (0)

#endif
