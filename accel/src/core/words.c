/* SPDX-License-Identifier: Apache-2.0 */
#include "words.h"

#include <string.h>

#include "number.h"

/* Words are compared up to here. */
enum { LONGEST = 40 };

bool accel_word_is(struct word word, const char *text)
{
    return strlen(text) == word.size && memcmp(word.at, text, word.size) == 0;
}

/* The word up to the first of `ends`, and moves *at there. */
static struct word take(const char **at, const char *ends)
{
    const struct word w = {*at, strcspn(*at, ends)};
    *at += w.size;
    return w;
}

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

/* Levenshtein's distance, row by row (Wagner and Fischer 1974); b has at most LONGEST characters.
 */
static size_t edit_distance(struct word a, struct word b)
{
    size_t row[LONGEST + 1];
    for (size_t j = 0; j <= b.size; j++)
        row[j] = j;
    for (size_t i = 1; i <= a.size; i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= b.size; j++) {
            const size_t replaced = diagonal + (lower(a.at[i - 1]) != lower(b.at[j - 1]));
            diagonal = row[j];
            row[j] = least(replaced, least(row[j], row[j - 1]) + 1);
        }
    }
    return row[b.size];
}

static bool begins(struct word w, const char *text)
{
    for (size_t i = 0; i < w.size; i++)
        if (lower(w.at[i]) != lower(text[i]))
            return false;
    return w.size > 0;
}

void accel_nearest_offer(struct nearest *nearest, const char *legal)
{
    const size_t size = strlen(legal);
    const struct word found = {nearest->found.at, least(nearest->found.size, LONGEST)};
    const size_t distance = nearest->found.size <= size && begins(nearest->found, legal)
                                ? 0
                                : edit_distance(found, (struct word){legal, least(size, LONGEST)});
    if (distance <= (found.size + 2) / 3 && (!nearest->word || distance < nearest->distance)) {
        nearest->word = legal;
        nearest->distance = distance;
    }
}

struct word accel_settings_name(const char **at)
{
    return take(at, ":");
}

static size_t find_option(const accel_kind_info *table, struct setting *s)
{
    s->likely = (struct nearest){.found = s->key};
    size_t i = 0;
    for (; i < table->option_count && !accel_word_is(s->key, table->options[i].key); i++)
        accel_nearest_offer(&s->likely, table->options[i].key);
    return i;
}

static bool find_word(const accel_option *o, struct setting *s, double *out)
{
    s->likely = (struct nearest){.found = s->value};
    for (size_t i = 0; o->words[i]; i++) {
        if (accel_word_is(s->value, o->words[i])) {
            *out = (double)i;
            return true;
        }
        accel_nearest_offer(&s->likely, o->words[i]);
    }
    return false;
}

static bool read_value(const accel_option *o, struct setting *s, double *out)
{
    if (isnan(o->standard) && accel_word_is(s->value, "auto")) {
        *out = (double)NAN;
        return true;
    }
    if (o->words)
        return find_word(o, s, out);
    double x;
    if (!accel_number_parse(s->value.at, s->value.size, &x) || !(x >= o->min && x <= o->max) ||
        (o->whole && x != floor(x)))
        return false;
    *out = x;
    return true;
}

enum setting_fault accel_settings_take(struct settings *settings, const accel_kind_info *table,
                                       const char **at, double *values, struct setting *out)
{
    out->key = take(at, "=,");
    const bool whole = **at == '=';
    *at += whole;
    out->value = whole ? take(at, ",") : (struct word){*at, 0};
    out->option = find_option(table, out);
    if (out->option == table->option_count)
        return SETTING_UNKNOWN;
    const unsigned bit = 1u << out->option;
    if (settings->given & bit)
        return SETTING_TWICE;
    settings->given |= bit;
    if (!whole)
        return SETTING_EMPTY;
    const accel_option *option = &table->options[out->option];
    return read_value(option, out, &values[out->option]) ? SETTING_FINE : SETTING_VALUE;
}
