/* SPDX-License-Identifier: Apache-2.0
 *
 * The list of built-in scenes and the parser of their options. A word before ':' that names a
 * built-in scene wins over a file of that name: write ./teapots for the file.
 */
#include "scene_build.h"

#include "words.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_OPTIONS = 8 };

static const accel_generator *const generators[] = {
    &accel_generator_cubes, &accel_generator_teapots, &accel_generator_stadium,
    &accel_generator_soup,  &accel_generator_spheres, &accel_generator_nested,
    &accel_generator_same,  &accel_generator_one,     &accel_generator_empty,
};

enum { GENERATORS = sizeof generators / sizeof generators[0] };

const accel_kind_info *const *accel_scene_kinds(size_t *count)
{
    static const accel_kind_info *const kinds[GENERATORS] = {
        &accel_generator_cubes.info, &accel_generator_teapots.info, &accel_generator_stadium.info,
        &accel_generator_soup.info,  &accel_generator_spheres.info, &accel_generator_nested.info,
        &accel_generator_same.info,  &accel_generator_one.info,     &accel_generator_empty.info,
    };
    *count = GENERATORS;
    return kinds;
}

static bool same_word(const char *text, size_t length, const char *word)
{
    return strlen(word) == length && memcmp(text, word, length) == 0;
}

static const accel_generator *find_generator(const char *name, size_t length)
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
        accel_nearest_offer(text, key_length, info->options[i].key, &nearest, &distance);
        i++;
    }
    if (i == info->option_count) {
        snprintf(error->text, sizeof error->text,
                 "scene %s: unknown key '%.*s'%s%s; nothing was made", info->name, (int)key_length,
                 text, nearest == NULL ? ", it has none" : "; nearest is ",
                 nearest == NULL ? "" : nearest);
        return false;
    }
    const accel_option *option = &info->options[i];
    const char *value = equals == NULL ? "" : equals + 1;
    const size_t value_length = equals == NULL ? 0 : length - key_length - 1;
    double number = 0.0;
    if ((*seen & 1u << i) != 0 || !accel_read_number(value, value_length, &number) ||
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

static bool read_options(const accel_kind_info *info, const char *text, double *values,
                         accel_error *error)
{
    for (size_t i = 0; i < info->option_count; i++) {
        values[i] = info->options[i].standard;
    }
    unsigned seen = 0;
    for (;;) {
        const size_t length = strcspn(text, ",");
        if (!read_option(info, text, length, values, &seen, error)) {
            return false;
        }
        if (text[length] == '\0') {
            return true;
        }
        text += length + 1;
    }
}

/* A name without dot and slash that is no file was meant as a built-in scene. */
static bool looks_built_in(const char *name, size_t length)
{
    return access(name, F_OK) != 0 && length > 0 && memchr(name, '.', length) == NULL &&
           memchr(name, '/', length) == NULL;
}

static void say_unknown(const char *name, size_t length, accel_error *error)
{
    const char *nearest = NULL;
    size_t distance = SIZE_MAX;
    for (size_t i = 0; i < GENERATORS; i++) {
        accel_nearest_offer(name, length, generators[i]->info.name, &nearest, &distance);
    }
    snprintf(error->text, sizeof error->text,
             "scene '%.*s' is neither a file nor a built-in scene; nearest is %s; "
             "nothing was loaded",
             (int)(length > 100 ? 100 : length), name, nearest);
}

static bool run_generator(accel_loaded *out, const accel_generator *generator, const char *options,
                          accel_error *error)
{
    double values[MOST_OPTIONS];
    if (*options != '\0' && !read_options(&generator->info, options + 1, values, error)) {
        return false;
    }
    for (size_t i = 0; *options == '\0' && i < generator->info.option_count; i++) {
        values[i] = generator->info.options[i].standard;
    }
    if (generator->generate(out, values)) {
        return true;
    }
    accel_unload_scene(out);
    snprintf(error->text, sizeof error->text, "scene %s: out of memory; nothing was made",
             generator->info.name);
    error->status = ACCEL_NO_MEMORY;
    return false;
}

bool accel_load_scene(accel_loaded *out, const char *name, accel_load_progress *progress,
                      void *user, accel_error *error)
{
    *out = (accel_loaded){0};
    *error = (accel_error){.status = ACCEL_BAD_ARGUMENT};
    const size_t length = strcspn(name, ":");
    const accel_generator *generator = find_generator(name, length);
    if (generator != NULL) {
        return run_generator(out, generator, name + length, error);
    }
    if (looks_built_in(name, length)) {
        say_unknown(name, length, error);
        return false;
    }
    return accel_load_file(out, name, progress, user, error);
}
