/* SPDX-License-Identifier: Apache-2.0 */
#include "config.h"

#include <stdio.h>
#include <string.h>

#include "number.h"
#include "words.h"

/* How much of a word a complaint shows. */
static int shown(struct word w)
{
    enum { MOST = 40 };
    return (int)accel_error_cut(w.at, w.size, MOST);
}

/* The legal words of one place, for a complaint. */
struct choice {
    struct nearest likely;
    char list[300]; /* all of them, with commas */
};

static void choice_list(struct choice *c, const char *text)
{
    const size_t used = strlen(c->list);
    snprintf(c->list + used, sizeof c->list - used, "%s%s", used ? ", " : "", text);
}

/* "..., allowed are a, b, c; did you mean 'b'?" */
static void complain(accel_error *error, const char *what, const struct choice *c)
{
    const struct word found = c->likely.found;
    if (c->likely.word)
        accel_error_set(error, ACCEL_BAD_CONFIG,
                        "config: %s '%.*s', allowed are %s; did you mean '%s'? Nothing was built",
                        what, shown(found), found.at, c->list, c->likely.word);
    else
        accel_error_set(error, ACCEL_BAD_CONFIG, "config: %s '%.*s', %s%s; nothing was built", what,
                        shown(found), found.at, *c->list ? "allowed are " : "it has none", c->list);
}

static const struct accel_kind *find_kind(struct word name, accel_error *error)
{
    struct choice c = {.likely = {.found = name}};
    for (size_t i = 0; accel_kind_list[i]; i++) {
        if (accel_word_is(name, accel_kind_list[i]->name))
            return (const struct accel_kind *)accel_kind_list[i];
        accel_nearest_offer(&c.likely, accel_kind_list[i]->name);
        choice_list(&c, accel_kind_list[i]->name);
    }
    complain(error, "unknown kind", &c);
    return NULL;
}

static void complain_of_key(const accel_kind_info *kind, const struct setting *s,
                            accel_error *error)
{
    struct choice c = {.likely = s->likely};
    char what[64];
    for (size_t i = 0; i < kind->option_count; i++)
        choice_list(&c, kind->options[i].key);
    snprintf(what, sizeof what, "%s has no option", kind->name);
    complain(error, what, &c);
}

static void complain_of_value(const accel_option *o, const struct setting *s, accel_error *error)
{
    struct choice c = {.likely = s->likely};
    char what[64];
    if (o->words) {
        for (size_t i = 0; o->words[i]; i++)
            choice_list(&c, o->words[i]);
        snprintf(what, sizeof what, "%s cannot be", o->key);
        complain(error, what, &c);
        return;
    }
    accel_error_set(error, ACCEL_BAD_CONFIG,
                    "config: %s is '%.*s', allowed is %s from %s to %s%s; nothing was built",
                    o->key, shown(s->value), s->value.at, o->whole ? "a whole number" : "a number",
                    accel_number_text(o->min, 6).at, accel_number_text(o->max, 6).at,
                    isnan(o->standard) ? " or auto" : "");
}

/* False: said. */
static bool accept(const accel_kind_info *kind, enum setting_fault fault, const struct setting *s,
                   accel_error *error)
{
    if (fault == SETTING_UNKNOWN) {
        complain_of_key(kind, s, error);
    } else if (fault != SETTING_FINE) {
        const accel_option *o = &kind->options[s->option];
        if (fault == SETTING_TWICE)
            accel_error_set(error, ACCEL_BAD_CONFIG,
                            "config: %s is given twice, once is allowed; nothing was built",
                            o->key);
        else if (fault == SETTING_EMPTY)
            accel_error_set(error, ACCEL_BAD_CONFIG,
                            "config: %s has no value, '%s=...' is allowed; nothing was built",
                            o->key, o->key);
        else
            complain_of_value(o, s, error);
    }
    return fault == SETTING_FINE;
}

const struct accel_kind *accel_config_parse(const char *config, double option[MAX_OPTIONS],
                                            accel_error *error)
{
    const char *at = config && *config ? config : ACCEL_DEFAULT_CONFIG;
    const struct accel_kind *kind = find_kind(accel_settings_name(&at), error);
    if (!kind)
        return NULL;
    struct settings given = {0};
    for (size_t i = 0; i < kind->info.option_count; i++)
        option[i] = kind->info.options[i].standard;
    while (*at) {
        ++at;
        struct setting s;
        if (!accept(&kind->info, accel_settings_take(&given, &kind->info, &at, option, &s), &s,
                    error))
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
