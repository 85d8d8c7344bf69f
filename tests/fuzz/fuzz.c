/* SPDX-License-Identifier: Apache-2.0 */
#include "fuzz.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void broken(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fprintf(stderr, "broken: ");
    vfprintf(stderr, format, arguments);
    fprintf(stderr, "\n");
    va_end(arguments);
    abort();
}

/* Bytes of the UTF-8 character at `at`, or 0 where there is none that may be printed. */
static size_t printable(const unsigned char *at)
{
    static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    if (*at < 0x80)
        return *at >= 0x20 && *at != 0x7f;
    const size_t size = *at >> 5 == 6 ? 2 : *at >> 4 == 14 ? 3 : *at >> 3 == 30 ? 4 : 0;
    uint32_t point = size ? *at & (0xffu >> (size + 1)) : 0;
    for (size_t i = 1; i < size; i++) {
        if (at[i] >> 6 != 2)
            return 0;
        point = point << 6 | (at[i] & 0x3fu);
    }
    const bool surrogate = point >= 0xd800 && point < 0xe000;
    return point >= 0xa0 && point >= least[size] && point < 0x110000 && !surrogate ? size : 0;
}

void check_text(const char *text)
{
    const unsigned char *at = (const unsigned char *)text;
    if (*at == '\0')
        broken("an error has no text");
    while (*at != '\0') {
        const size_t size = printable(at);
        if (size == 0)
            broken("byte 0x%02x of an error's text is not printable", *at);
        at += size;
    }
}

bool same_build(const accel_info *a, const accel_info *b)
{
    return strcmp(a->kind, b->kind) == 0 && strcmp(a->config, b->config) == 0 &&
           a->nodes == b->nodes && a->leaves == b->leaves && a->references == b->references &&
           a->depth == b->depth && a->size_classes == b->size_classes && a->clusters == b->clusters;
}

/* ------------------------------------------------------------------- heap ---- */

struct head {
    size_t size;
    size_t check; /* the same, inverted */
};

static void heap_free(struct heap *h, struct head *head)
{
    h->held -= head->size;
    h->blocks--;
    free(head);
}

static bool heap_refuses(struct heap *h, size_t from, size_t to)
{
    h->calls++;
    const bool full = to > from && h->held - from + to > h->most;
    const bool told =
        h->fail_at && (h->calls == h->fail_at || (h->fail_on && h->calls > h->fail_at));
    return full || told;
}

void *heap_resize(void *user, void *old, size_t from, size_t to)
{
    struct heap *h = user;
    struct head *head = old ? (struct head *)old - 1 : NULL;
    if (head ? head->size != from || head->check != ~from : from != 0)
        broken("the allocator is told that a block has %zu bytes, but it has %zu", from,
               head ? head->size : 0);
    if (to == 0) {
        if (head)
            heap_free(h, head);
        return NULL;
    }
    struct head *made = heap_refuses(h, from, to) ? NULL : malloc(sizeof *made + to);
    if (!made)
        return NULL;
    *made = (struct head){to, ~to};
    memset(made + 1, 0xcc, to);
    h->held += to;
    h->blocks++;
    if (head) {
        memcpy(made + 1, old, from < to ? from : to);
        heap_free(h, head);
    }
    return made + 1;
}

void heap_check_empty(const struct heap *h, const char *when)
{
    if (h->held != 0 || h->blocks != 0)
        broken("%s: %zu bytes in %zu blocks are left", when, h->held, h->blocks);
}
