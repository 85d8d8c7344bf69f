/* SPDX-License-Identifier: Apache-2.0
 *
 * Words, numbers and lines of text formats: see text.h.
 */
#include "text.h"

#include "core/number.h"

#include <ctype.h>
#include <float.h>
#include <stdio.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What counts and indices of too many digits become. */
#define TOO_LARGE UINT64_C(999999999999999999)

const unsigned char mesh_classes[256] = {
    [' '] = MESH_BLANK,     ['\t'] = MESH_BLANK,    ['\v'] = MESH_BLANK, ['\f'] = MESH_BLANK,
    ['\n'] = MESH_LINE_END, ['\r'] = MESH_LINE_END, ['0'] = MESH_DIGIT,  ['1'] = MESH_DIGIT,
    ['2'] = MESH_DIGIT,     ['3'] = MESH_DIGIT,     ['4'] = MESH_DIGIT,  ['5'] = MESH_DIGIT,
    ['6'] = MESH_DIGIT,     ['7'] = MESH_DIGIT,     ['8'] = MESH_DIGIT,  ['9'] = MESH_DIGIT,
    ['+'] = MESH_NUMBER,    ['-'] = MESH_NUMBER,    ['.'] = MESH_NUMBER, ['e'] = MESH_NUMBER,
    ['E'] = MESH_NUMBER,
};

bool mesh_joins(const mesh_text *text, const char *at)
{
    const char *next = at + 1;
    while (next < text->end && mesh_is(*next, MESH_BLANK)) {
        next++;
    }
    if (next == text->end) {
        return true;
    }
    if (!mesh_is(*next, MESH_LINE_END)) {
        return false;
    }
    mesh_text after = *text;
    after.at = next;
    mesh_take_line_end(&after);
    return at == text->begin || mesh_is(at[-1], MESH_BLANK) || after.at == text->end ||
           mesh_is(*after.at, MESH_BLANK | MESH_LINE_END);
}

void mesh_skip_rest(mesh_text *text)
{
    while (text->at < text->end) {
        if (mesh_is(*text->at, MESH_BLANK)) {
            text->at++;
        } else if (text->joins && *text->at == '\\' && mesh_joins(text, text->at)) {
            text->at++;
            while (!mesh_at_line_end(text)) {
                text->at++;
            }
            mesh_take_line_end(text);
        } else if (text->comment != 0 && *text->at == text->comment) {
            mesh_skip_line(text);
            return;
        } else {
            return;
        }
    }
}

void mesh_skip_line(mesh_text *text)
{
    while (!mesh_at_line_end(text)) {
        text->at++;
    }
}

bool mesh_skip_lines(mesh_text *text)
{
    while (text->at < text->end && mesh_is(*text->at, MESH_LINE_END)) {
        mesh_take_line_end(text);
        mesh_skip_blanks(text);
    }
    return text->at < text->end;
}

size_t mesh_take_word(mesh_text *text, const char **word)
{
    *word = text->at;
    while (!mesh_word_ends(text, text->at)) {
        text->at++;
    }
    return (size_t)(text->at - *word);
}

bool mesh_same_word(const char *word, size_t length, const char *wanted)
{
    for (size_t i = 0; i < length; i++) {
        if (wanted[i] == '\0' ||
            tolower((unsigned char)word[i]) != tolower((unsigned char)wanted[i])) {
            return false;
        }
    }
    return wanted[length] == '\0';
}

bool mesh_take_this(mesh_text *text, const char *wanted)
{
    const char *word;
    const size_t length = mesh_take_word(text, &word);
    const bool same = length != 0 && mesh_same_word(word, length, wanted);
    text->at = same ? text->at : word;
    return same;
}

bool mesh_take_number(mesh_text *text, double *number)
{
    const char *at = text->at;
    while (at < text->end && mesh_is(*at, MESH_DIGIT | MESH_NUMBER)) {
        at++;
    }
    if (!mesh_word_ends(text, at) ||
        !accel_number_parse(text->at, (size_t)(at - text->at), number) || !isfinite(*number)) {
        return false;
    }
    text->at = at;
    return true;
}

bool mesh_take_float(mesh_text *text, double *number)
{
    const char *const begin = text->at;
    uint64_t bits;
    if (!mesh_take_number(text, number)) {
        return false;
    }
    memcpy(&bits, number, sizeof bits);
    const double size = fabs(*number);
    if (size > (double)FLT_MAX || size < (double)FLT_MIN) {
        return true;
    }
    /* what is midway between floats as a double may not have been so before */
    const bool midway = (bits & UINT64_C(0x1fffffff)) == UINT64_C(0x10000000);
    char rewritten[NUMBER_REWRITTEN];
    if (midway && accel_number_rewrite(begin, (size_t)(text->at - begin), rewritten)) {
        *number = (double)strtof(rewritten, NULL);
    } else {
        *number = (double)(float)*number;
    }
    return true;
}

bool mesh_take_integer(mesh_text *text, int64_t *number)
{
    const char *at = text->at;
    const bool negative = at < text->end && *at == '-';
    at += at < text->end && (*at == '-' || *at == '+');
    const char *const begin = at;
    uint64_t digits = 0;
    for (; at < text->end && (unsigned char)(*at - '0') < 10; at++) {
        digits = 10 * digits + (unsigned char)(*at - '0');
    }
    if (at == begin) {
        return false;
    }
    digits = at - begin > 18 ? TOO_LARGE : digits;
    *number = negative ? -(int64_t)digits : (int64_t)digits;
    text->at = at;
    return true;
}

bool mesh_take_count(mesh_text *text, uint64_t *count)
{
    const char *const begin = text->at;
    int64_t number;
    if (begin == text->end || !mesh_is(*begin, MESH_DIGIT) || !mesh_take_integer(text, &number) ||
        number == (int64_t)TOO_LARGE || !mesh_word_ends(text, text->at)) {
        text->at = begin;
        return false;
    }
    *count = (uint64_t)number;
    return true;
}

const char *mesh_quote(const char *word, size_t length, char found[MESH_FOUND_TEXT])
{
    const size_t most = MESH_FOUND_TEXT - 6, shown = length < most ? length : most;
    char *to = found;
    *to++ = '\'';
    for (size_t i = 0; i < shown; i++) {
        *to++ = (char)(word[i] >= ' ' && word[i] <= '~' ? word[i] : '?');
    }
    snprintf(to, 5, "%s'", shown < length ? "..." : "");
    return found;
}

const char *mesh_found(const mesh_text *text, char found[MESH_FOUND_TEXT])
{
    if (text->at == text->end) {
        return "the end of the file";
    }
    if (mesh_at_line_end(text)) {
        return "the end of the line";
    }
    mesh_text copy = *text;
    const char *word;
    const size_t length = mesh_take_word(&copy, &word);
    return mesh_quote(word, length == 0 ? 1 : length, found);
}
