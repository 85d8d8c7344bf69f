/* SPDX-License-Identifier: Apache-2.0
 *
 * Rays as text: a line is a ray just where its words are 6, 8 or 10 numbers as strtod and the
 * headers say, and has their bits; a ray that is written is read again; of a file the same lines
 * are empty, rays, or neither.
 */
#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"
#include "scenes/ray_lines.h"
#include "scenes/ray_text.h"

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
    char text[RAY_TEXT];
    accel_ray again;
    memset(text, 'x', sizeof text);
    write_ray(&ray, text);
    if (!memchr(text, '\0', sizeof text))
        broken("the text of a ray does not end");
    if (ray.skip.geom == ACCEL_NONE)
        ray.skip.prim = ACCEL_NONE;
    if (!ray_from_text(text, &again) || !same_ray(&ray, &again))
        broken("'%s' is not read as it was written", text);
}

/* A line by itself, with blanks and commas between its words. */
static void check_line(const char *line)
{
    accel_ray found, expected;
    char *copy = strdup(line);
    if (!copy)
        return;
    const bool is_ray = ray_from_text(line, &found);
    if (is_ray != expect_ray(copy, &expected))
        broken("'%s' is %s", line, is_ray ? "taken as a ray" : "refused");
    if (is_ray && !same_ray(&found, &expected))
        broken("'%s' is another ray", line);
    if (is_ray)
        check_again(found);
    free(copy);
}

/* ------------------------------------------------------------------- file ---- */

enum { MOST_WORDS = 10 };

static const char blanks[] = " \t\v\f", between[] = " \t\v\f,;";

/* A line's words, with a blank behind each, and what is before each of them and behind the last. */
struct cut {
    char *text;
    char gap[MOST_WORDS + 1];
    int words;
};

/* A comma or a semicolon with or without blanks; a blank where there is none; 0 for more than one.
 */
static char kind_of_gap(const char *gap, size_t length)
{
    char kind = ' ';
    for (size_t i = 0; i < length; i++)
        if (!strchr(blanks, gap[i]))
            kind = kind == ' ' ? gap[i] : '\0';
    return kind;
}

/* False: there are too many words. */
static bool cut_line(const char *line, struct cut *c)
{
    char *to = c->text;
    for (c->words = 0;; c->words++) {
        const size_t gap = strspn(line, between);
        c->gap[c->words] = kind_of_gap(line, gap);
        line += gap;
        *to = '\0';
        if (*line == '\0')
            return true;
        if (c->words == MOST_WORDS)
            return false;
        const size_t word = strcspn(line, between);
        memcpy(to, line, word);
        to[word] = ' ';
        to += word + 1;
        line += word;
    }
}

/* Words in threes and pairs, alike within. */
static bool expect_gaps(const struct cut *c)
{
    char inner = '\0';
    bool fine = c->gap[0] == ' ';
    for (int i = 1; i <= c->words; i++) {
        const bool within = i < c->words && i != 3 && i != 6 && i != 8;
        fine = fine && c->gap[i] != '\0' && (!within || !inner || inner == c->gap[i]);
        inner = within ? c->gap[i] : inner;
    }
    return fine;
}

static bool expect_names(const char *line)
{
    int words = 0;
    for (const char *at = line + strspn(line, between); *at != '\0'; words++) {
        const char *end = at + strcspn(at, between);
        char *number_end;
        strtod(at, &number_end);
        if ((!isalpha((unsigned char)*at) && !strchr("\"'_", *at)) || number_end == end)
            return false;
        at = end + strspn(end, between);
    }
    return words > 0;
}

/* What the line is; *begun: a line that was not empty was there before. */
static enum ray_line expect_line(const char *line, bool *begun, accel_ray *ray)
{
    struct cut c = {.text = malloc(strlen(line) + 2)};
    const bool first = !*begun, empty = line[strspn(line, blanks)] == '\0';
    if (!c.text)
        broken("no memory");
    *begun = *begun || !empty;
    const bool names = !empty && first && expect_names(line);
    const bool is_ray = cut_line(line, &c) && expect_gaps(&c) && expect_ray(c.text, ray);
    free(c.text);
    return empty || names ? RAY_LINES_END : is_ray ? RAY_LINE : NO_RAY_LINE;
}

/* Takes the next line of the file, without its comment. False: a zero is in it. */
static bool next_line(const char **at, const char *end, char *line)
{
    size_t size = 0;
    while (*at + size < end && (*at)[size] != '\n' && (*at)[size] != '\r')
        size++;
    memcpy(line, *at, size);
    line[size] = '\0';
    const bool whole = strlen(line) == size;
    line[strcspn(line, "#")] = '\0';
    *at += size;
    if (*at < end)
        *at += end - *at > 1 && (*at)[0] == '\r' && (*at)[1] == '\n' ? 2 : 1;
    return whole;
}

/* What comes next in the file, of what the lines are one by one. */
static enum ray_line expect_next(const char **at, const char *end, char *line, bool *begun,
                                 accel_ray *ray)
{
    while (*at < end) {
        if (!next_line(at, end, line))
            return NO_RAY_LINE;
        const enum ray_line found = expect_line(line, begun, ray);
        if (found != RAY_LINES_END)
            return found;
    }
    return RAY_LINES_END;
}

static void check_file(const char *bytes, size_t size)
{
    char *copy = malloc(size + 1), *line = malloc(size + 1);
    if (!copy || !line)
        broken("no memory");
    memcpy(copy, bytes, size);
    struct ray_lines lines =
        ray_lines_start(&(struct file){.path = "rays", .bytes = copy, .size = size});
    const char *at = bytes + (lines.at - copy), *end = bytes + size;
    enum ray_line found;
    bool begun = false;
    do {
        accel_ray ray, expected;
        found = next_ray(&lines, &ray);
        if (found != expect_next(&at, end, line, &begun, &expected))
            broken("line %zu, '%s', is taken as %d", lines.number, line, (int)found);
        if (found == RAY_LINE && !same_ray(&ray, &expected))
            broken("line %zu, '%s', is another ray", lines.number, line);
    } while (found == RAY_LINE);
    free(copy);
    free(line);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    char *text = malloc(size + 1), *next;
    if (!text || size == 0) {
        free(text);
        return 0;
    }
    memcpy(text, bytes, size);
    text[size] = '\0';
    check_file(text, size);
    for (char *line = text; line; line = next) {
        next = strchr(line, '\n');
        if (next)
            *next++ = '\0';
        check_line(line);
    }
    free(text);
    return 0;
}
