/* SPDX-License-Identifier: Apache-2.0
 *
 * What the fuzz targets share. A target is one file with LLVMFuzzerTestOneInput; libFuzzer drives
 * it (tests/fuzz.sh), or corpus.c, which any compiler builds, with the inputs of corpus/.
 *
 * Any bytes are a legal input. What must hold for all of them is said by broken().
 */
#ifndef TESTS_FUZZ_H
#define TESTS_FUZZ_H

#include "accel/accel.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

/* Something did not hold: prints it and aborts, so that the input is kept. */
__attribute__((format(printf, 1, 2))) _Noreturn void broken(const char *format, ...);

/* Bytes that are taken one after another; those past the end are zero. */
struct bytes {
    const uint8_t *at;
    size_t left;
};

static inline uint8_t take(struct bytes *b)
{
    if (b->left == 0)
        return 0;
    b->left--;
    return *b->at++;
}

/* 0 <= i < n <= 256. */
static inline uint32_t take_below(struct bytes *b, uint32_t n)
{
    return take(b) % n;
}

/* Ends in broken() unless an error's text is one line that a terminal may be shown: not empty,
 * valid UTF-8, no control characters. */
void check_text(const char *text);

/* Did two builds make the same? All but the times and what queries built is compared. */
bool same_build(const accel_info *a, const accel_info *b);

/* An allocator that holds `most` bytes at a time, and refuses its fail_at-th call, counted from 1,
 * and with `fail_on` all calls after it. It checks every size that it is told, and always moves a
 * block. For accel_hooks.resize. */
struct heap {
    size_t held, blocks, most;
    uint64_t calls, fail_at;
    bool fail_on;
};
void *heap_resize(void *user, void *old, size_t from, size_t to);

/* Ends in broken() unless all was freed. */
void heap_check_empty(const struct heap *h, const char *when);

#endif
