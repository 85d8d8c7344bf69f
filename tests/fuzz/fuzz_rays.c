/* SPDX-License-Identifier: Apache-2.0
 *
 * Rays as text: each line is a ray just where its words are 6, 8 or 10 numbers as strtod and the
 * header say, and has their bits; and a ray that is written is read again.
 */
#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"
#include "ray_text.h"

static bool is_separator(char c)
{
    return c == ' ' || c == '\t' || c == ',';
}

static bool expect_number(const char *word, double *x)
{
    char *end;
    *x = strtod(word, &end);
    return end != word && *end == '\0' && !isspace((unsigned char)*word);
}

static bool expect_id(const char *word, uint32_t *id)
{
    errno = 0;
    const unsigned long long x = strtoull(word, NULL, 10);
    *id = (uint32_t)x;
    return word[strspn(word, "0123456789")] == '\0' && errno == 0 && x <= UINT32_MAX;
}

static bool expect_word(const char *word, int i, accel_ray *ray)
{
    if (i >= 8)
        return i < 10 && expect_id(word, i == 8 ? &ray->skip.geom : &ray->skip.prim);
    return expect_number(word, i < 3   ? &ray->org[i]
                               : i < 6 ? &ray->dir[i - 3]
                               : i < 7 ? &ray->tmin
                                       : &ray->tmax);
}

/* What the line is, if it is a ray; cuts it into its words. */
static bool expect_ray(char *line, accel_ray *ray)
{
    const double nowhere[3] = {0.0, 0.0, 0.0};
    *ray = accel_ray_from(nowhere, nowhere);
    int words = 0;
    for (char *at = line; *at != '\0'; words++) {
        while (is_separator(*at))
            at++;
        if (*at == '\0')
            break;
        char *word = at;
        while (*at != '\0' && !is_separator(*at))
            at++;
        const char end = *at;
        *at = '\0';
        if (!expect_word(word, words, ray))
            return false;
        at += end != '\0';
    }
    return words == 6 || words == 8 || words == 10;
}

/* The same bits, or both NaN. */
static bool same_number(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

static bool same_ray(const accel_ray *a, const accel_ray *b)
{
    bool same = same_number(a->tmin, b->tmin) && same_number(a->tmax, b->tmax) &&
                a->skip.geom == b->skip.geom && a->skip.prim == b->skip.prim;
    for (int k = 0; k < 3; k++)
        same = same && same_number(a->org[k], b->org[k]) && same_number(a->dir[k], b->dir[k]);
    return same;
}

/* A ray that skips nothing is written without its skip. */
static void check_again(accel_ray ray)
{
    char text[ACCEL_RAY_TEXT];
    accel_ray again;
    memset(text, 'x', sizeof text);
    accel_write_ray(&ray, text);
    if (!memchr(text, '\0', sizeof text))
        broken("the text of a ray does not end");
    if (ray.skip.geom == ACCEL_NONE)
        ray.skip.prim = ACCEL_NONE;
    if (!accel_read_ray(text, &again) || !same_ray(&ray, &again))
        broken("'%s' is not read as it was written", text);
}

static void check_line(char *line)
{
    accel_ray found, expected;
    char *copy = strdup(line);
    if (!copy)
        return;
    const bool is_ray = accel_read_ray(line, &found);
    if (is_ray != expect_ray(copy, &expected))
        broken("'%s' is %s", line, is_ray ? "taken as a ray" : "refused");
    if (is_ray && !same_ray(&found, &expected))
        broken("'%s' is another ray", line);
    if (is_ray)
        check_again(found);
    free(copy);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    char *text = malloc(size + 1), *next;
    if (!text)
        return 0;
    if (size > 0)
        memcpy(text, bytes, size);
    text[size] = '\0';
    for (char *line = text; line; line = next) {
        next = strchr(line, '\n');
        if (next)
            *next++ = '\0';
        check_line(line);
    }
    free(text);
    return 0;
}
