/* SPDX-License-Identifier: Apache-2.0 */
#include "error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* The character of UTF-8 (RFC 3629) that begins here, and its bytes: 0 if none does. */
static size_t decode(const unsigned char *at, uint32_t *code)
{
    static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    const size_t bytes = at[0] < 0x80   ? 1
                         : at[0] < 0xc0 ? 0
                         : at[0] < 0xe0 ? 2
                         : at[0] < 0xf0 ? 3
                         : at[0] < 0xf8 ? 4
                                        : 0;
    *code = bytes > 1 ? at[0] & (0x7fu >> bytes) : at[0];
    for (size_t i = 1; i < bytes; i++) {
        if ((at[i] & 0xc0) != 0x80)
            return 0;
        *code = *code << 6 | (at[i] & 0x3f);
    }
    const bool surrogate = *code >= 0xd800 && *code <= 0xdfff;
    return bytes > 0 && *code >= least[bytes] && *code <= 0x10ffff && !surrogate ? bytes : 0;
}

/* No control characters, which a terminal would obey, nor those that end a line or turn the
 * direction of writing. */
static bool is_printable(uint32_t code)
{
    return code >= 0x20 && !(code >= 0x7f && code < 0xa0) && code != 0x200e && code != 0x200f &&
           !(code >= 0x2028 && code <= 0x202e) && !(code >= 0x2066 && code <= 0x2069);
}

static void make_printable(char *text)
{
    const unsigned char *from = (const unsigned char *)text;
    char *to = text;
    while (*from) {
        uint32_t code;
        const size_t bytes = decode(from, &code);
        if (bytes > 0 && is_printable(code)) {
            memmove(to, from, bytes);
            to += bytes;
        } else {
            *to++ = '?';
        }
        from += bytes > 0 ? bytes : 1;
    }
    *to = '\0';
}

size_t accel_error_cut(const char *word, size_t size, size_t most)
{
    if (size <= most)
        return size;
    size_t end = most;
    while (end > 0 && most - end < 4 && ((unsigned char)word[end] & 0xc0) == 0x80)
        end--;
    return end;
}

accel_status accel_error_set(accel_error *error, accel_status status, const char *format, ...)
{
    if (error->status != ACCEL_OK)
        return error->status;
    error->status = status;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error->text, sizeof error->text, format, arguments);
    va_end(arguments);
    make_printable(error->text);
    return status;
}
