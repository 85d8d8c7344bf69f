/* SPDX-License-Identifier: Apache-2.0
 *
 * SCENE: a name of the catalogue with its options, or a file. A word before ':' that names a
 * built-in scene wins over a file of that name: write ./teapots for the file.
 */
#include "scene.h"

#include "catalogue.h"
#include "generator.h"
#include "core/error.h"
#include "core/words.h"
#include "tool/file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_OPTIONS = 8 };

static const accel_option case_options[] = {
    {.key = "seed",
     .meaning = "another number, another scene, where it is random",
     .min = 0.0,
     .max = 0x1p53,
     .standard = 1.0,
     .whole = true},
};

/* What a SCENE means: a generator, a case, or a file where both are NULL. */
typedef struct meaning {
    const struct generator *generator;
    const struct scene_maker *maker;
    accel_kind_info info;        /* of either */
    double values[MOST_OPTIONS]; /* of its options */
} meaning;

/* False: no built-in scene has this name. */
static bool find_name(meaning *m, struct word name)
{
    *m = (meaning){0};
    for (size_t i = 0; generators[i] != NULL; i++) {
        if (accel_word_is(name, generators[i]->info.name)) {
            m->generator = generators[i];
            m->info = generators[i]->info;
        }
    }
    for (const struct scene_maker *maker = scene_makers; maker->name != NULL; maker++) {
        if (accel_word_is(name, maker->name)) {
            m->maker = maker;
            m->info =
                (accel_kind_info){.name = maker->name, .options = case_options, .option_count = 1};
        }
    }
    return m->info.name != NULL;
}

static void complain_of_setting(const accel_kind_info *info, enum setting_fault fault,
                                const struct setting *s, accel_error *error)
{
    if (fault == SETTING_UNKNOWN) {
        const char *hint = info->option_count == 0  ? ", it has none"
                           : s->likely.word == NULL ? "; 'accel kinds' lists them"
                                                    : "; nearest is ";
        snprintf(error->text, sizeof error->text,
                 "scene %s: unknown key '%.*s'%s%s; nothing was made", info->name,
                 (int)accel_error_cut(s->key.at, s->key.size, 60), s->key.at, hint,
                 s->likely.word == NULL ? "" : s->likely.word);
        return;
    }
    const accel_option *option = &info->options[s->option];
    snprintf(error->text, sizeof error->text,
             "scene %s: %s=%.*s %s; allowed is one %snumber from %.17g to %.17g; "
             "nothing was made",
             info->name, option->key, (int)accel_error_cut(s->value.at, s->value.size, 60),
             s->value.at, fault == SETTING_TWICE ? "is given twice" : "is out of range",
             option->whole ? "whole " : "", option->min, option->max);
}

/* The position of a key in the table, or the number of options. */
static size_t option_at(const accel_kind_info *info, const char *key)
{
    size_t i = 0;
    while (i < info->option_count && strcmp(info->options[i].key, key) != 0) {
        i++;
    }
    return i;
}

/* Scenes that have both a smallest and a largest size need them in order. */
static bool in_order(const accel_kind_info *info, const double *values, unsigned seen,
                     accel_error *error)
{
    const size_t min = option_at(info, "min"), max = option_at(info, "max");
    if (min == info->option_count || max == info->option_count || values[min] <= values[max]) {
        return true;
    }
    snprintf(error->text, sizeof error->text,
             "scene %s: min=%g%s is above max=%g%s; nothing was made", info->name, values[min],
             seen >> min & 1 ? "" : " (the default)", values[max],
             seen >> max & 1 ? "" : " (the default)");
    return false;
}

/* Reads what follows the name: "" or ":key=value[,key=value]...". */
static bool read_options(const accel_kind_info *info, const char *text, double *values,
                         accel_error *error)
{
    for (size_t i = 0; i < info->option_count; i++) {
        values[i] = info->options[i].standard;
    }
    struct settings settings = {0};
    while (*text != '\0') {
        struct setting setting;
        text++;
        const enum setting_fault fault =
            accel_settings_take(&settings, info, &text, values, &setting);
        if (fault != SETTING_FINE) {
            complain_of_setting(info, fault, &setting, error);
            return false;
        }
    }
    return in_order(info, values, settings.given, error);
}

/* A name without dot and slash that is no file was meant as a built-in scene. */
static bool looks_built_in(const char *text, struct word name)
{
    return access(text, F_OK) != 0 && (name.size > 0 || *text == '\0') &&
           memchr(name.at, '.', name.size) == NULL && memchr(name.at, '/', name.size) == NULL;
}

static void say_unknown(struct word name, accel_error *error)
{
    struct nearest likely = {.found = name};
    for (size_t i = 0; generators[i] != NULL; i++) {
        accel_nearest_offer(&likely, generators[i]->info.name);
    }
    for (const struct scene_maker *maker = scene_makers; maker->name != NULL; maker++) {
        accel_nearest_offer(&likely, maker->name);
    }
    snprintf(error->text, sizeof error->text,
             "scene '%.*s' is neither a file nor a built-in scene; %s%s; nothing was loaded",
             (int)accel_error_cut(name.at, name.size, 100), name.at,
             likely.word == NULL ? "'accel kinds' lists those" : "nearest is ",
             likely.word == NULL ? "" : likely.word);
}

static bool understand(meaning *m, const char *name, accel_error *error)
{
    *error = (accel_error){.status = ACCEL_BAD_ARGUMENT};
    const char *at = name;
    const struct word word = accel_settings_name(&at);
    if (find_name(m, word)) {
        return read_options(&m->info, at, m->values, error);
    }
    if (looks_built_in(name, word)) {
        say_unknown(word, error);
        return false;
    }
    return true;
}

bool scene_understood(const char *name, accel_error *error)
{
    meaning m;
    return understand(&m, name, error) && (m.info.name != NULL || file_there(name, error));
}

bool load_scene(struct loaded *out, const char *name, load_progress *progress, void *user,
                accel_error *error)
{
    *out = (struct loaded){0};
    meaning m;
    if (!understand(&m, name, error)) {
        return false;
    }
    if (m.info.name == NULL) {
        return load_file(out, name, progress, user, error);
    }
    if (m.maker != NULL) {
        case_load(out, m.maker, (uint64_t)m.values[0]);
        return true;
    }
    if (m.generator->generate(out, m.values)) {
        return true;
    }
    unload_scene(out);
    snprintf(error->text, sizeof error->text, "scene %s: out of memory; nothing was made",
             m.info.name);
    error->status = ACCEL_NO_MEMORY;
    return false;
}
