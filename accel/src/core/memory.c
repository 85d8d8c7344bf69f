/* SPDX-License-Identifier: Apache-2.0 */
#if defined(__linux__)
#define _DEFAULT_SOURCE
#include <sys/mman.h>
#endif

#include "memory.h"

#include <stdint.h>
#include <stdlib.h>

/* Asks for large pages within a large block: a build then spends less on the first touch of each
 * page, and rays on finding where they are. */
static void ask_for_large_pages(void *block, size_t bytes)
{
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    enum { LARGE_PAGE = 1 << 21, FEWEST_PAGES = 2 };
    const size_t before = (size_t)(-(uintptr_t)block % LARGE_PAGE);
    if (block && bytes >= before + FEWEST_PAGES * (size_t)LARGE_PAGE)
        madvise((char *)block + before, (bytes - before) / LARGE_PAGE * LARGE_PAGE, MADV_HUGEPAGE);
#else
    (void)block, (void)bytes;
#endif
}

void *accel_memory_system(void *user, void *old, size_t from, size_t to)
{
    (void)user;
    (void)from;
    if (to == 0) {
        free(old);
        return NULL;
    }
    void *block = realloc(old, to);
    ask_for_large_pages(block, to);
    return block;
}

void *accel_memory_resize(struct memory *m, void *old, size_t from, size_t to)
{
    if (from == to)
        return old;
    const size_t held = m->bytes - from;
    if (m->limit > 0 && to > from && (held > m->limit || to > m->limit - held)) {
        m->refused = to;
        m->wanted = to > SIZE_MAX - held ? SIZE_MAX : held + to;
        return NULL;
    }
    void *block = m->resize(m->user, old, from, to);
    if (!block && to != 0) {
        m->refused = to;
        m->wanted = 0;
        return NULL;
    }
    m->bytes = held + to;
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
        m->wanted = 0;
        return false;
    }
    void *block = accel_memory_resize(m, *at, *capacity * size, grown * size);
    if (!block)
        return false;
    *at = block;
    *capacity = grown;
    return true;
}
