/* SPDX-License-Identifier: Apache-2.0 */
#include "config.h"

#include <stdio.h>
#include <string.h>

#include "number.h"

enum { MAX_LIST = 300 };

/* A part of the config string. */
struct word {
    const char *at;
    size_t size;
};

static bool same(struct word w, const char *text)
{
    return strlen(text) == w.size && memcmp(w.at, text, w.size) == 0;
}

/* The word up to the first of `ends`, and moves *at there. */
static struct word take(const char **at, const char *ends)
{
    const struct word w = {*at, strcspn(*at, ends)};
    *at += w.size;
    return w;
}

/* How much of a word a complaint shows. */
static int shown(struct word w)
{
    enum { MOST = 40 };
    return (int)accel_error_cut(w.at, w.size, MOST);
}

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

/* Levenshtein's distance between a word in upper or lower case and a text in lower case, both cut
 * to 31 characters. */
static size_t distance(struct word w, const char *text)
{
    size_t row[32], n = strlen(text) < 31 ? strlen(text) : 31, m = w.size < 31 ? w.size : 31;
    for (size_t j = 0; j <= n; j++)
        row[j] = j;
    for (size_t i = 1; i <= m; i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= n; j++) {
            const size_t replaced = diagonal + (lower(w.at[i - 1]) != text[j - 1]);
            const size_t removed = row[j] + 1, added = row[j - 1] + 1;
            diagonal = row[j];
            row[j] = replaced < removed ? replaced : removed;
            row[j] = row[j] < added ? row[j] : added;
        }
    }
    return row[n];
}

/* The legal words of one place, gathered for a complaint. */
struct choice {
    struct word wrong;   /* what was found */
    const char *nearest; /* legal word that is most like it, or NULL: none is near */
    size_t best;         /* its distance */
    char list[MAX_LIST]; /* all of them, with commas */
};

static void choice_add(struct choice *c, const char *text)
{
    const size_t d = distance(c->wrong, text), used = strlen(c->list);
    const size_t compared = c->wrong.size < 31 ? c->wrong.size : 31;
    if (d <= (compared + 2) / 3 && (!c->nearest || d < c->best)) {
        c->nearest = text;
        c->best = d;
    }
    snprintf(c->list + used, sizeof c->list - used, "%s%s", used ? ", " : "", text);
}

/* "..., allowed are a, b, c; did you mean 'b'?" */
static void complain(accel_error *error, const char *what, const struct choice *c)
{
    if (c->nearest)
        accel_error_set(error, ACCEL_BAD_CONFIG,
                        "config: %s '%.*s', allowed are %s; did you mean '%s'? Nothing was built",
                        what, shown(c->wrong), c->wrong.at, c->list, c->nearest);
    else
        accel_error_set(error, ACCEL_BAD_CONFIG, "config: %s '%.*s', %s%s; nothing was built", what,
                        shown(c->wrong), c->wrong.at,
                        *c->list ? "allowed are " : "but none is allowed", c->list);
}

static const struct accel_kind *find_kind(struct word name, accel_error *error)
{
    struct choice c = {.wrong = name};
    for (size_t i = 0; accel_kind_list[i]; i++) {
        if (same(name, accel_kind_list[i]->name))
            return (const struct accel_kind *)accel_kind_list[i];
        choice_add(&c, accel_kind_list[i]->name);
    }
    complain(error, "unknown kind", &c);
    return NULL;
}

static int find_option(const struct accel_kind *kind, struct word key, accel_error *error)
{
    struct choice c = {.wrong = key};
    for (size_t i = 0; i < kind->info.option_count; i++) {
        if (same(key, kind->info.options[i].key))
            return (int)i;
        choice_add(&c, kind->info.options[i].key);
    }
    char what[64];
    snprintf(what, sizeof what, "%s has no option", kind->info.name);
    complain(error, what, &c);
    return -1;
}

static bool parse_word(const accel_option *o, struct word value, double *out, accel_error *error)
{
    struct choice c = {.wrong = value};
    for (size_t i = 0; o->words[i]; i++) {
        if (same(value, o->words[i])) {
            *out = (double)i;
            return true;
        }
        choice_add(&c, o->words[i]);
    }
    char what[64];
    snprintf(what, sizeof what, "%s cannot be", o->key);
    complain(error, what, &c);
    return false;
}

static bool parse_number(const accel_option *o, struct word value, double *out, accel_error *error)
{
    if (accel_number_parse(value.at, value.size, out) && *out >= o->min && *out <= o->max &&
        (!o->whole || *out == floor(*out)))
        return true;
    accel_error_set(error, ACCEL_BAD_CONFIG,
                    "config: %s is '%.*s', allowed is %s from %s to %s%s; nothing was built",
                    o->key, shown(value), value.at, o->whole ? "a whole number" : "a number",
                    accel_number_text(o->min, 6).at, accel_number_text(o->max, 6).at,
                    isnan(o->standard) ? " or auto" : "");
    return false;
}

static bool parse_value(const accel_option *o, struct word value, double *out, accel_error *error)
{
    if (isnan(o->standard) && same(value, "auto")) {
        *out = (double)NAN;
        return true;
    }
    return o->words ? parse_word(o, value, out, error) : parse_number(o, value, out, error);
}

/* One "key=value". */
static bool parse_setting(const struct accel_kind *kind, const char **at, double *option,
                          bool *given, accel_error *error)
{
    const struct word key = take(at, "=,");
    const int i = find_option(kind, key, error);
    if (i < 0)
        return false;
    if (given[i]) {
        accel_error_set(error, ACCEL_BAD_CONFIG,
                        "config: %s is given twice, once is allowed; nothing was built",
                        kind->info.options[i].key);
        return false;
    }
    given[i] = true;
    if (**at != '=') {
        accel_error_set(error, ACCEL_BAD_CONFIG,
                        "config: %s has no value, '%s=...' is allowed; nothing was built",
                        kind->info.options[i].key, kind->info.options[i].key);
        return false;
    }
    ++*at;
    return parse_value(&kind->info.options[i], take(at, ","), &option[i], error);
}

const struct accel_kind *accel_config_parse(const char *config, double option[MAX_OPTIONS],
                                            accel_error *error)
{
    const char *at = config && *config ? config : ACCEL_DEFAULT_CONFIG;
    const struct accel_kind *kind = find_kind(take(&at, ":"), error);
    if (!kind)
        return NULL;
    bool given[MAX_OPTIONS] = {false};
    for (size_t i = 0; i < kind->info.option_count; i++)
        option[i] = kind->info.options[i].standard;
    while (*at) {
        ++at;
        if (!parse_setting(kind, &at, option, given, error))
            return NULL;
    }
    return kind;
}

void accel_config_print(const struct accel_kind *kind, const double option[MAX_OPTIONS], char *text,
                        size_t size)
{
    int used = snprintf(text, size, "%s", kind->info.name);
    for (size_t i = 0; i < kind->info.option_count && (size_t)used < size; i++) {
        const accel_option *o = &kind->info.options[i];
        char value[32];
        if (isnan(option[i]))
            snprintf(value, sizeof value, "auto");
        else if (o->words)
            snprintf(value, sizeof value, "%s", o->words[(int)option[i]]);
        else
            snprintf(value, sizeof value, "%s", accel_number_text_exact(option[i]).at);
        used += snprintf(text + used, size - (size_t)used, "%c%s=%s", i == 0 ? ':' : ',', o->key,
                         value);
    }
}
