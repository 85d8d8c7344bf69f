/* SPDX-License-Identifier: Apache-2.0
 *
 * Rays as text: hex floats go out, any number that strtod takes comes in.
 */
#include "ray_text.h"

#include <ctype.h>
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void write_ray(const accel_ray *ray, char text[RAY_TEXT])
{
    const double numbers[8] = {ray->org[0], ray->org[1], ray->org[2], ray->dir[0],
                               ray->dir[1], ray->dir[2], ray->tmin,   ray->tmax};
    int length = 0;
    for (int i = 0; i < 8; i++) {
        length += snprintf(text + length, (size_t)(RAY_TEXT - length), "%s%a", i == 0 ? "" : " ",
                           numbers[i]);
    }
    if (ray->skip.geom != ACCEL_NONE) {
        snprintf(text + length, (size_t)(RAY_TEXT - length), " %" PRIu32 " %" PRIu32,
                 ray->skip.geom, ray->skip.prim);
    }
}

/* Words may be of any length: strtod and strtoull end at the blank, the comma or the end behind. */
static bool read_number(const char *word, size_t length, double *out)
{
    char *end;
    *out = strtod(word, &end);
    return end == word + length && !isspace((unsigned char)word[0]);
}

static bool read_id(const char *word, size_t length, uint32_t *out)
{
    char *end;
    errno = 0;
    const unsigned long long value = strtoull(word, &end, 10);
    *out = (uint32_t)value;
    return isdigit((unsigned char)word[0]) && end == word + length && errno == 0 &&
           value <= UINT32_MAX;
}

static bool read_ray_word(const char *word, size_t length, int i, accel_ray *ray)
{
    if (i >= 8) {
        return read_id(word, length, i == 8 ? &ray->skip.geom : &ray->skip.prim);
    }
    double *const numbers[8] = {&ray->org[0], &ray->org[1], &ray->org[2], &ray->dir[0],
                                &ray->dir[1], &ray->dir[2], &ray->tmin,   &ray->tmax};
    return read_number(word, length, numbers[i]);
}

bool ray_from_text(const char *text, accel_ray *ray)
{
    *ray = (accel_ray){.tmax = (double)INFINITY, .skip = {ACCEL_NONE, ACCEL_NONE}};
    int words = 0;
    while (*(text += strspn(text, " \t,")) != '\0') {
        const size_t length = strcspn(text, " \t,");
        if (words == 10 || !read_ray_word(text, length, words, ray)) {
            return false;
        }
        words++;
        text += length;
    }
    return words == 6 || words == 8 || words == 10;
}
