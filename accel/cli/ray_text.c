/* SPDX-License-Identifier: Apache-2.0
 *
 * Rays as text: hex floats go out, any number that strtod takes comes in.
 */
#include "ray_text.h"

#include "words.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

void accel_write_ray(const accel_ray *ray, char text[ACCEL_RAY_TEXT])
{
    const double numbers[8] = {ray->org[0], ray->org[1], ray->org[2], ray->dir[0],
                               ray->dir[1], ray->dir[2], ray->tmin,   ray->tmax};
    int length = 0;
    for (int i = 0; i < 8; i++) {
        length += snprintf(text + length, (size_t)(ACCEL_RAY_TEXT - length), "%s%a",
                           i == 0 ? "" : " ", numbers[i]);
    }
    if (ray->skip.geom != ACCEL_NONE) {
        snprintf(text + length, (size_t)(ACCEL_RAY_TEXT - length), " %" PRIu32 " %" PRIu32,
                 ray->skip.geom, ray->skip.prim);
    }
}

static bool read_ray_word(const char *word, int i, accel_ray *ray)
{
    uint64_t id = 0;
    if (i >= 8) {
        const bool fine = accel_read_whole(word, 0, UINT32_MAX, &id);
        *(i == 8 ? &ray->skip.geom : &ray->skip.prim) = (uint32_t)id;
        return fine;
    }
    double *const numbers[8] = {&ray->org[0], &ray->org[1], &ray->org[2], &ray->dir[0],
                                &ray->dir[1], &ray->dir[2], &ray->tmin,   &ray->tmax};
    return accel_read_exact(word, numbers[i]);
}

bool accel_read_ray(const char *text, accel_ray *ray)
{
    *ray = (accel_ray){.tmax = (double)INFINITY, .skip = {ACCEL_NONE, ACCEL_NONE}};
    int words = 0;
    while (*(text += strspn(text, " \t,")) != '\0') {
        char word[60];
        const size_t length = strcspn(text, " \t,");
        if (length >= sizeof word || words == 10) {
            return false;
        }
        memcpy(word, text, length);
        word[length] = '\0';
        if (!read_ray_word(word, words, ray)) {
            return false;
        }
        words++;
        text += length;
    }
    return words == 6 || words == 8 || words == 10;
}
