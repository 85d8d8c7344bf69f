/* SPDX-License-Identifier: Apache-2.0 */
#include "words.h"

#include "core/number.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

bool ends_with(const char *name, const char *ending)
{
    const size_t length = strlen(name), own = strlen(ending);
    return length > own && strcmp(name + length - own, ending) == 0;
}

bool read_number(const char *text, size_t length, double *out)
{
    return accel_number_parse(text, length, out) && isfinite(*out);
}

bool read_numbers(const char *text, size_t length, double *out, size_t count)
{
    const char *end = text + length;
    for (size_t i = 0; i + 1 < count; i++) {
        const char *comma = memchr(text, ',', (size_t)(end - text));
        if (comma == NULL || !read_number(text, (size_t)(comma - text), &out[i])) {
            return false;
        }
        text = comma + 1;
    }
    return read_number(text, (size_t)(end - text), &out[count - 1]);
}

bool read_whole(const char *text, uint64_t min, uint64_t max, uint64_t *out)
{
    if (!isdigit((unsigned char)text[0])) {
        return false;
    }
    char *end;
    errno = 0;
    const unsigned long long value = strtoull(text, &end, 10);
    if (errno != 0 || *end != '\0' || value < min || value > max) {
        return false;
    }
    *out = value;
    return true;
}
