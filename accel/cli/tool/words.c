/* SPDX-License-Identifier: Apache-2.0
 *
 * Nearest word by edit distance (Wagner and Fischer 1974), and strict numbers. The process never
 * calls setlocale, so strtod reads the C locale's numbers.
 */
#include "words.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { LONGEST_WORD = 40, LONGEST_NUMBER = 60 };

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

bool ends_with(const char *name, const char *ending)
{
    const size_t length = strlen(name), own = strlen(ending);
    return length > own && strcmp(name + length - own, ending) == 0;
}

static bool same_letter(char a, char b)
{
    return tolower((unsigned char)a) == tolower((unsigned char)b);
}

/* Insertions, deletions and replacements that turn a into b. */
static size_t edit_distance(const char *a, size_t a_length, const char *b, size_t b_length)
{
    size_t row[LONGEST_WORD + 1];
    for (size_t j = 0; j <= b_length; j++) {
        row[j] = j;
    }
    for (size_t i = 1; i <= a_length; i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= b_length; j++) {
            const size_t replaced = diagonal + (same_letter(a[i - 1], b[j - 1]) ? 0 : 1);
            diagonal = row[j];
            row[j] = least(replaced, least(row[j], row[j - 1]) + 1);
        }
    }
    return row[b_length];
}

void nearest_offer(const char *typed, size_t length, const char *word, const char **best,
                   size_t *distance)
{
    const size_t word_length = strlen(word);
    const bool begun = length > 0 && length < word_length && strncasecmp(typed, word, length) == 0;
    const size_t here = begun ? 0
                              : edit_distance(typed, least(length, LONGEST_WORD), word,
                                              least(word_length, LONGEST_WORD));
    if (here < *distance && here <= (least(length, LONGEST_WORD) + 2) / 3) {
        *distance = here;
        *best = word;
    }
}

bool read_number(const char *text, size_t length, double *out)
{
    char copy[LONGEST_NUMBER + 1];
    if (length == 0 || length > LONGEST_NUMBER || strspn(text, "+-.0123456789eE") < length) {
        return false;
    }
    memcpy(copy, text, length);
    copy[length] = '\0';
    char *end;
    const double value = strtod(copy, &end);
    if (*end != '\0' || end == copy || value - value != 0.0) {
        return false;
    }
    *out = value;
    return true;
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
