/* SPDX-License-Identifier: Apache-2.0
 *
 * The list of built-in scenes and the parser of their options. A word before ':' that names a
 * built-in scene wins over a file of that name: write ./teapots for the file.
 */
#include "scene_build.h"

#include "tool/file.h"
#include "tool/words.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_OPTIONS = 8 };

static const struct generator *const generators[] = {
    &generator_cubes,  &generator_teapots, &generator_stadium, &generator_soup,  &generator_spheres,
    &generator_nested, &generator_same,    &generator_one,     &generator_empty,
};

enum { GENERATORS = sizeof generators / sizeof generators[0] };

const accel_kind_info *const *scene_kinds(size_t *count)
{
    static const accel_kind_info *const kinds[GENERATORS] = {
        &generator_cubes.info, &generator_teapots.info, &generator_stadium.info,
        &generator_soup.info,  &generator_spheres.info, &generator_nested.info,
        &generator_same.info,  &generator_one.info,     &generator_empty.info,
    };
    *count = GENERATORS;
    return kinds;
}

static bool same_word(const char *text, size_t length, const char *word)
{
    return strlen(word) == length && memcmp(text, word, length) == 0;
}

static const struct generator *find_generator(const char *name, size_t length)
{
    for (size_t i = 0; i < GENERATORS; i++) {
        if (same_word(name, length, generators[i]->info.name)) {
            return generators[i];
        }
    }
    return NULL;
}

/* Reads one "key=value" of `length` bytes. `seen` has a bit for each option read before. */
static bool read_option(const accel_kind_info *info, const char *text, size_t length,
                        double *values, unsigned *seen, accel_error *error)
{
    const char *equals = memchr(text, '=', length);
    const size_t key_length = equals == NULL ? length : (size_t)(equals - text);
    const char *nearest = NULL;
    size_t distance = SIZE_MAX;
    size_t i = 0;
    while (i < info->option_count && !same_word(text, key_length, info->options[i].key)) {
        nearest_offer(text, key_length, info->options[i].key, &nearest, &distance);
        i++;
    }
    if (i == info->option_count) {
        const char *hint = info->option_count == 0 ? ", it has none"
                           : nearest == NULL       ? "; 'accel kinds' lists them"
                                                   : "; nearest is ";
        snprintf(error->text, sizeof error->text,
                 "scene %s: unknown key '%.*s'%s%s; nothing was made", info->name,
                 (int)(key_length < 60 ? key_length : 60), text, hint,
                 nearest == NULL ? "" : nearest);
        return false;
    }
    const accel_option *option = &info->options[i];
    const char *value = equals == NULL ? "" : equals + 1;
    const size_t value_length = equals == NULL ? 0 : length - key_length - 1;
    double number = 0.0;
    if ((*seen & 1u << i) != 0 || !read_number(value, value_length, &number) ||
        !(number >= option->min && number <= option->max) ||
        (option->whole && number != floor(number))) {
        snprintf(error->text, sizeof error->text,
                 "scene %s: %s=%.*s %s; allowed is one %snumber from %.17g to %.17g; "
                 "nothing was made",
                 info->name, option->key, (int)value_length, value,
                 (*seen & 1u << i) != 0 ? "is given twice" : "is out of range",
                 option->whole ? "whole " : "", option->min, option->max);
        return false;
    }
    *seen |= 1u << i;
    values[i] = number;
    return true;
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
    unsigned seen = 0;
    while (*text != '\0') {
        const size_t length = strcspn(++text, ",");
        if (!read_option(info, text, length, values, &seen, error)) {
            return false;
        }
        text += length;
    }
    return in_order(info, values, seen, error);
}

/* A name without dot and slash that is no file was meant as a built-in scene. */
static bool looks_built_in(const char *name, size_t length)
{
    return access(name, F_OK) != 0 && (length > 0 || *name == '\0') &&
           memchr(name, '.', length) == NULL && memchr(name, '/', length) == NULL;
}

static void say_unknown(const char *name, size_t length, accel_error *error)
{
    const char *nearest = NULL;
    size_t distance = SIZE_MAX;
    for (size_t i = 0; i < GENERATORS; i++) {
        nearest_offer(name, length, generators[i]->info.name, &nearest, &distance);
    }
    snprintf(error->text, sizeof error->text,
             "scene '%.*s' is neither a file nor a built-in scene; %s%s; nothing was loaded",
             (int)(length > 100 ? 100 : length), name,
             nearest == NULL ? "'accel kinds' lists those" : "nearest is ",
             nearest == NULL ? "" : nearest);
}

/* What a SCENE means. */
typedef struct meaning {
    const struct generator *generator; /* NULL: a file */
    double values[MOST_OPTIONS];       /* of its options */
} meaning;

static bool understand(meaning *m, const char *name, accel_error *error)
{
    *error = (accel_error){.status = ACCEL_BAD_ARGUMENT};
    const size_t length = strcspn(name, ":");
    m->generator = find_generator(name, length);
    if (m->generator != NULL) {
        return read_options(&m->generator->info, name + length, m->values, error);
    }
    if (looks_built_in(name, length)) {
        say_unknown(name, length, error);
        return false;
    }
    return true;
}

bool scene_understood(const char *name, accel_error *error)
{
    meaning m;
    return understand(&m, name, error) && (m.generator != NULL || file_there(name, error));
}

bool load_scene(struct loaded *out, const char *name, load_progress *progress, void *user,
                accel_error *error)
{
    *out = (struct loaded){0};
    meaning m;
    if (!understand(&m, name, error)) {
        return false;
    }
    if (m.generator == NULL) {
        return load_file(out, name, progress, user, error);
    }
    if (m.generator->generate(out, m.values)) {
        return true;
    }
    unload_scene(out);
    snprintf(error->text, sizeof error->text, "scene %s: out of memory; nothing was made",
             m.generator->info.name);
    error->status = ACCEL_NO_MEMORY;
    return false;
}
