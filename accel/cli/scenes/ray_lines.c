/* SPDX-License-Identifier: Apache-2.0
 *
 * The lines of a file of rays: see ray_lines.h.
 */
#include "ray_lines.h"

#include "ray_text.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

static const char separators[] = " \t\v\f,;";

struct ray_lines ray_lines_start(const struct file *file)
{
    const bool marked = file->size >= 3 && memcmp(file->bytes, "\xEF\xBB\xBF", 3) == 0;
    return (struct ray_lines){.at = file->bytes + (marked ? 3 : 0),
                              .end = file->bytes + file->size};
}

/* Shows zero bytes as '?'. True if there were none. */
static bool show_zeros(char *at, size_t size)
{
    bool whole = true;
    for (size_t i = 0; i < size; i++) {
        whole = whole && at[i] != '\0';
        at[i] = at[i] != '\0' ? at[i] : '?';
    }
    return whole;
}

/* Cuts off the next line and its comment. False: a zero byte is in it, behind which more may be. */
static bool take_line(struct ray_lines *lines)
{
    char *stop = lines->line = lines->at;
    while (stop < lines->end && *stop != '\n' && *stop != '\r') {
        stop++;
    }
    const bool two = stop + 1 < lines->end && stop[0] == '\r' && stop[1] == '\n';
    const bool whole = show_zeros(lines->line, (size_t)(stop - lines->line));
    lines->at = stop < lines->end ? stop + (two ? 2 : 1) : stop;
    lines->number++;
    *stop = '\0';
    lines->line[strcspn(lines->line, "#")] = '\0';
    return whole;
}

/* What is between two words: a blank, a comma or a semicolon; 0 where it is several of them. */
static char gap(const char *text, size_t length)
{
    char found = ' ';
    for (size_t i = 0; i < length; i++) {
        if (text[i] == ',' || text[i] == ';') {
            found = found == ' ' ? text[i] : 0;
            if (found == 0) {
                break;
            }
        }
    }
    return found;
}

/* Are two words that follow each other in one group of numbers: origin, direction, or a pair? */
static bool in_one_group(int word)
{
    return word != 0 && word != 3 && word != 6 && word != 8;
}

/* Is the same between all numbers of a group, nothing but blanks before the first number, and at
 * most one separator behind the last one? */
static bool are_alike(const char *line)
{
    char inner = 0;
    const char *at = line;
    for (int word = 0;; word++) {
        const size_t length = strspn(at, separators);
        const char between = gap(at, length);
        if (between == 0 || (word == 0 && between != ' ')) {
            return false;
        }
        if (at[length] == '\0') {
            return true;
        }
        if (in_one_group(word)) {
            inner = inner == 0 ? between : inner;
            if (between != inner) {
                return false;
            }
        }
        at += length;
        at += strcspn(at, separators);
    }
}

static void make_blanks(char *line)
{
    while (*(line += strcspn(line, separators)) != '\0') {
        *line++ = ' ';
    }
}

static bool read_ray(char *line, accel_ray *ray)
{
    if (!are_alike(line)) {
        return false;
    }
    make_blanks(line);
    return ray_from_text(line, ray);
}

/* Does every word begin with a letter or a quote, and is none a number? */
static bool names_columns(const char *line)
{
    const char *at = line + strspn(line, separators);
    const bool some = *at != '\0';
    for (; *at != '\0'; at += strspn(at, separators)) {
        char *end;
        strtod(at, &end);
        const size_t length = strcspn(at, separators);
        if (end == at + length || !(isalpha((unsigned char)*at) || strchr("\"'_", *at) != NULL)) {
            return false;
        }
        at += length;
    }
    return some;
}

enum ray_line next_ray(struct ray_lines *lines, accel_ray *ray)
{
    while (lines->at < lines->end) {
        if (!take_line(lines)) {
            return NO_RAY_LINE;
        }
        const bool empty = lines->line[strspn(lines->line, " \t\v\f")] == '\0';
        const bool names = !empty && !lines->begun && names_columns(lines->line);
        lines->begun = lines->begun || !empty;
        if (!empty && !names) {
            return read_ray(lines->line, ray) ? RAY_LINE : NO_RAY_LINE;
        }
    }
    return RAY_LINES_END;
}
