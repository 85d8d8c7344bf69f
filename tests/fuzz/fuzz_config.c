/* SPDX-License-Identifier: Apache-2.0
 *
 * Config strings: legal is what the header's grammar and the tables of accel_kinds say, in every
 * floating-point mode, and nothing else; a refusal is one printable line; what is built says what
 * builds it again.
 */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "case_scene.h"
#include "fuzz.h"
#include "modes.h"

enum { MOST_BYTES = 1 << 22, MOST_GIVEN = 32 };

/* ---------------------------------------------------------------- grammar ---- */

static const accel_kind_info *find_kind(const char *name, size_t length)
{
    size_t count;
    const accel_kind_info *const *kind = accel_kinds(&count);
    for (size_t i = 0; i < count; i++)
        if (strlen(kind[i]->name) == length && memcmp(kind[i]->name, name, length) == 0)
            return kind[i];
    return NULL;
}

static int find_option(const accel_kind_info *k, const char *key, size_t length)
{
    for (size_t i = 0; i < k->option_count; i++)
        if (strlen(k->options[i].key) == length && memcmp(k->options[i].key, key, length) == 0)
            return (int)i;
    return -1;
}

static size_t digits(const char **at)
{
    const size_t n = strspn(*at, "0123456789");
    *at += n;
    return n;
}

/* [sign]digits[.digits][e[sign]digits], with a digit before or behind the point. */
static bool is_number(const char *text)
{
    text += *text == '+' || *text == '-';
    size_t n = digits(&text);
    if (*text == '.') {
        text++;
        n += digits(&text);
    }
    if (n > 0 && (*text == 'e' || *text == 'E')) {
        text++;
        text += *text == '+' || *text == '-';
        n = digits(&text);
    }
    return n > 0 && *text == '\0';
}

static bool is_value(const accel_option *o, const char *text)
{
    if (isnan(o->standard) && strcmp(text, "auto") == 0)
        return true;
    for (size_t i = 0; o->words && o->words[i]; i++)
        if (strcmp(text, o->words[i]) == 0)
            return true;
    if (o->words || !is_number(text))
        return false;
    const double x = strtod(text, NULL);
    return x >= o->min && x <= o->max && (!o->whole || x == floor(x));
}

/* "key=value", of which each key may be given once. */
static bool is_setting(const accel_kind_info *k, const char *text, bool given[MOST_GIVEN])
{
    const char *equals = strchr(text, '=');
    const int i = equals ? find_option(k, text, (size_t)(equals - text)) : -1;
    if (i < 0 || given[i])
        return false;
    given[i] = true;
    return is_value(&k->options[i], equals + 1);
}

static bool is_legal(const char *config)
{
    bool given[MOST_GIVEN] = {false};
    if (*config == '\0')
        return true;
    const size_t length = strcspn(config, ":");
    const accel_kind_info *k = find_kind(config, length);
    bool legal = k != NULL;
    for (const char *at = config + length; legal && *at != '\0';) {
        const size_t size = strcspn(++at, ",");
        char *setting = must_resize(NULL, size + 1);
        memcpy(setting, at, size);
        setting[size] = '\0';
        legal = is_setting(k, setting, given);
        free(setting);
        at += size;
    }
    return legal;
}

/* ------------------------------------------------------------------ scene ---- */

/* A cluster of triangles, one of spheres, a large triangle and an object. */
static void make_scene(struct test_scene *s)
{
    scene_open(s);
    struct part *p = scene_part(s, ACCEL_TRIANGLES);
    for (int i = 0; i < 8; i++) {
        const double x = i % 2, y = i / 2 % 2, z = i / 4;
        part_triangle(p, (const double[]){x, y, z}, (const double[]){x + 1, y, z},
                      (const double[]){x, y + 0.5, z + 0.25});
    }
    part_triangle(p, (const double[]){-50, -50, 0}, (const double[]){50, -50, 0},
                  (const double[]){0, 50, 1});
    p = scene_part(s, ACCEL_SPHERES);
    for (int i = 0; i < 4; i++)
        part_sphere(p, (const double[]){30 + 0.1 * i, 30 - 0.1 * (i % 2), 2}, 0.05);
    p = scene_part(s, ACCEL_OBJECTS);
    part_object(p, &(accel_box){{-1, -1, -1}, {1, 1, 1}}, CRATE,
                (const double[]){-1, -1, -1, 1, 1, 1});
    scene_close(s);
}

static const accel_scene *fixed_scene(void)
{
    static struct test_scene s;
    if (s.count == 0)
        make_scene(&s);
    return &s.scene;
}

/* ------------------------------------------------------------------ builds ---- */

/* Builds in a mode, and describes what was built. */
static accel_status build(const char *config, const struct mode *mode, accel_info *info,
                          accel_error *error)
{
    struct heap heap = {.most = MOST_BYTES};
    const accel_hooks hooks = {.user = &heap, .resize = heap_resize};
    const accel_scene *scene = fixed_scene();
    accel *a;
    mode_enter(mode);
    const accel_status status = accel_build(&a, scene, config, &hooks, error);
    mode_leave();
    if (a)
        accel_describe(a, info);
    accel_free(a);
    heap_check_empty(&heap, "build");
    return status;
}

static void check_again(const char *config, const struct mode *mode, const accel_info *info)
{
    accel_info again;
    accel_error error;
    if (build(info->config, mode, &again, &error) != ACCEL_OK)
        broken("%s, resolved to %s: %s", config, info->config, error.text);
    if (!same_build(info, &again))
        broken("%s, resolved to %s, builds something else: %s", config, info->config, again.config);
}

static void check(const char *config, const struct mode *mode, bool legal)
{
    accel_info info;
    accel_error error;
    const accel_status status = build(config, mode, &info, &error);
    if (legal != (status == ACCEL_OK || status == ACCEL_NO_MEMORY))
        broken("'%s', %s, is %s, but: %s", config, mode->name, legal ? "legal" : "not legal",
               status == ACCEL_OK ? "built" : error.text);
    if (!legal && status != ACCEL_BAD_CONFIG)
        broken("'%s', %s: status %d", config, mode->name, (int)status);
    if (status == ACCEL_OK)
        check_again(config, mode, &info);
    else
        check_text(error.text);
}

/* In the default mode, and in one that the length chooses. */
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    char *config = must_resize(NULL, size + 1);
    if (size > 0)
        memcpy(config, bytes, size);
    config[size] = '\0';
    const bool legal = is_legal(config);
    check(config, &modes[0], legal);
    check(config, &modes[size % MODES], legal);
    free(config);
    return 0;
}
