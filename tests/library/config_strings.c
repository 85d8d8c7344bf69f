/* SPDX-License-Identifier: Apache-2.0
 *
 * The config string: every key of every kind, good and bad; the texts of errors; the description
 * builds the same structure again.
 */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "cmocka_all.h"
#include "compare.h"

static struct test_scene scene;

static int open_scene(void **state)
{
    (void)state;
    scene_make(&scene, scene_maker_find("mixed"), 1);
    return 0;
}

static int close_scene(void **state)
{
    (void)state;
    scene_free(&scene);
    return 0;
}

static void accept(const char *config)
{
    accel *a = NULL;
    accel_error error;
    if (accel_build(&a, &scene.scene, config, NULL, &error) != ACCEL_OK)
        fail_msg("'%s' was refused: %s", config, error.text);
    assert_non_null(a);
    assert_int_equal(error.status, ACCEL_OK);
    assert_string_equal(error.text, "");
    accel_free(a);
}

/* One line that starts in lower case and says what became of the structure. */
static void check_style(const accel_error *e)
{
    const size_t size = strlen(e->text);
    assert_true(size > 10 && size < sizeof e->text);
    assert_null(strchr(e->text, '\n'));
    assert_true(e->text[0] >= 'a' && e->text[0] <= 'z');
    assert_true(e->text[size - 1] != '.');
    assert_non_null(strstr(e->text, "othing was built"));
}

/* `words`: what the text must name, ended by NULL. */
static void refuse(const char *config, const char *const *words)
{
    accel *a = (accel *)&a;
    accel_error error;
    const accel_status status = accel_build(&a, &scene.scene, config, NULL, &error);
    if (status != ACCEL_BAD_CONFIG)
        fail_msg("'%s' gave status %d: %s", config, (int)status, error.text);
    assert_null(a);
    assert_int_equal(error.status, ACCEL_BAD_CONFIG);
    check_style(&error);
    for (; *words; words++)
        if (!strstr(error.text, *words))
            fail_msg("'%s': the text does not name '%s': %s", config, *words, error.text);
    assert_int_equal(accel_build(&a, &scene.scene, config, NULL, NULL), ACCEL_BAD_CONFIG);
}

#define REFUSE(config, ...) refuse(config, (const char *const[]){__VA_ARGS__, NULL})

static const accel_kind_info *const *all_kinds(size_t *count)
{
    return accel_kinds(count);
}

static void test_table(void **state)
{
    (void)state;
    size_t count;
    const accel_kind_info *const *kind = all_kinds(&count);
    assert_true(count > 0);
    assert_null(kind[count]);
    for (size_t i = 0; i < count; i++) {
        assert_true(strlen(kind[i]->name) > 0 && strlen(kind[i]->summary) > 0);
        for (size_t j = 0; j < i; j++)
            assert_string_not_equal(kind[i]->name, kind[j]->name);
        for (size_t o = 0; o < kind[i]->option_count; o++) {
            const accel_option *option = &kind[i]->options[o];
            assert_true(strlen(option->key) > 0 && strlen(option->meaning) > 0);
            assert_true(option->words || option->min < option->max);
            for (size_t p = 0; p < o; p++)
                assert_string_not_equal(option->key, kind[i]->options[p].key);
        }
    }
}

static void test_defaults(void **state)
{
    (void)state;
    accept(NULL);
    accept("");
    accept(ACCEL_DEFAULT_CONFIG);
}

static void try_words(const char *kind, const accel_option *o)
{
    char text[120], longer[60];
    for (size_t w = 0; o->words[w]; w++) {
        snprintf(text, sizeof text, "%s:%s=%s", kind, o->key, o->words[w]);
        accept(text);
        snprintf(longer, sizeof longer, "%sx", o->words[w]);
        snprintf(text, sizeof text, "%s:%s=%s", kind, o->key, longer);
        REFUSE(text, o->key, longer, o->words[w], "did you mean");
    }
    snprintf(text, sizeof text, "%s:%s=7", kind, o->key);
    REFUSE(text, o->key, "7", o->words[0]);
}

static void try_number(const char *kind, const accel_option *o, double value, bool good)
{
    char text[120], number[40];
    snprintf(number, sizeof number, "%.15g", value);
    snprintf(text, sizeof text, "%s:%s=%s", kind, o->key, number);
    if (good)
        accept(text);
    else
        REFUSE(text, o->key, number, "allowed is");
}

static void try_range(const char *kind, const accel_option *o)
{
    static const char *const bad[] = {"",    " 1",  "1 ",   "0x1", "inf", "nan", "1e",
                                      "e1",  "--1", "1,5",  ".",   "+",   "-",   "1..2",
                                      "1;2", "1=1", "AUTO", "1d0", "1e+", "1'0", "١"};
    char text[120];
    try_number(kind, o, o->min, true);
    try_number(kind, o, o->max, true);
    try_number(kind, o, o->min - fmax(1, fabs(o->min)), false);
    try_number(kind, o, o->max + fmax(1, fabs(o->max)), false);
    if (o->whole)
        try_number(kind, o, o->min + 0.5, false);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        snprintf(text, sizeof text, "%s:%s=%s", kind, o->key, bad[i]);
        REFUSE(text, strchr(bad[i], ',') ? kind : o->key, "allowed");
    }
}

static void try_option(const char *kind, const accel_option *o)
{
    char text[200], wrong[60];
    if (o->words)
        try_words(kind, o);
    else
        try_range(kind, o);
    snprintf(text, sizeof text, "%s:%s=auto", kind, o->key);
    if (isnan(o->standard))
        accept(text);
    else
        REFUSE(text, o->key, "auto");
    snprintf(text, sizeof text, "%s:%s", kind, o->key);
    REFUSE(text, o->key, "no value");
    snprintf(wrong, sizeof wrong, "%sq", o->key);
    snprintf(text, sizeof text, "%s:%s=1", kind, wrong);
    char mean[80];
    snprintf(mean, sizeof mean, "did you mean '%s'", o->key);
    REFUSE(text, wrong, kind, mean);
}

static void test_options(void **state)
{
    (void)state;
    size_t count;
    const accel_kind_info *const *kind = all_kinds(&count);
    for (size_t i = 0; i < count; i++)
        for (size_t o = 0; o < kind[i]->option_count; o++)
            try_option(kind[i]->name, &kind[i]->options[o]);
}

/* A legal value as text. */
static const char *legal_value(const accel_option *o, char text[40])
{
    if (o->words)
        return o->words[0];
    snprintf(text, 40, "%.15g", o->min);
    return text;
}

static void test_repeats(void **state)
{
    (void)state;
    size_t count;
    const accel_kind_info *const *kind = all_kinds(&count);
    for (size_t i = 0; i < count; i++) {
        for (size_t j = 0; j < kind[i]->option_count; j++) {
            const accel_option *o = &kind[i]->options[j];
            char text[200], buffer[40];
            const char *value = legal_value(o, buffer);
            snprintf(text, sizeof text, "%s:%s=%s,%s=%s", kind[i]->name, o->key, value, o->key,
                     value);
            REFUSE(text, o->key, "twice");
            snprintf(text, sizeof text, "%s:%s=%s,", kind[i]->name, o->key, value);
            REFUSE(text, kind[i]->name);
            snprintf(text, sizeof text, "%s:%s=%s:", kind[i]->name, o->key, value);
            REFUSE(text, o->key);
        }
    }
}

/* A word that is like no legal one: there is nothing to be suggested. */
static void suggest_nothing(const char *config)
{
    accel *a;
    accel_error error;
    assert_int_equal(accel_build(&a, &scene.scene, config, NULL, &error), ACCEL_BAD_CONFIG);
    assert_null(strstr(error.text, "did you mean"));
    assert_non_null(strstr(error.text, "allowed are linear"));
    check_style(&error);
}

static void test_kinds(void **state)
{
    (void)state;
    size_t count;
    const accel_kind_info *const *kind = all_kinds(&count);
    for (size_t i = 0; i < count; i++) {
        char text[60], mean[60];
        snprintf(text, sizeof text, "%s%c", kind[i]->name, 'z');
        snprintf(mean, sizeof mean, "did you mean '%s'", kind[i]->name);
        REFUSE(text, text, "unknown kind", mean, "linear");
        for (char *c = text; *c; c++)
            *c = (char)toupper((unsigned char)*c);
        REFUSE(text, text, "unknown kind", mean);
        snprintf(text, sizeof text, "%s:", kind[i]->name);
        REFUSE(text, kind[i]->name);
        snprintf(text, sizeof text, "%s:nokey=1", kind[i]->name);
        REFUSE(text, "nokey", kind[i]->name);
        snprintf(text, sizeof text, " %s", kind[i]->name);
        REFUSE(text, "unknown kind");
    }
    suggest_nothing("nothinglike");
    suggest_nothing("xyz");
    REFUSE(":", "unknown kind");
    REFUSE("OCTREE", "OCTREE", "unknown kind");
    REFUSE(",", "unknown kind");
    REFUSE("=", "unknown kind");
}

static void test_hostile(void **state)
{
    (void)state;
    enum { SIZE = 100000 };
    char *text = must_resize(NULL, SIZE + 1);
    memset(text, 'x', SIZE);
    text[SIZE] = '\0';
    REFUSE(text, "unknown kind");
    memcpy(text, "auto:", 5); /* the only kind with options that is always compiled */
    REFUSE(text, "auto");
    memcpy(text, "auto:rays=", 10);
    REFUSE(text, "rays");
    memset(text + 10, '9', SIZE - 10);
    REFUSE(text, "rays");
    REFUSE("auto:rays=1e99999999999999999999", "rays");
    REFUSE("auto:rays=%s%n%d", "rays", "%s%n%d");
    REFUSE("%s%n:%n", "%s%n");
    free(text);
}

static uint64_t hash_answers(const accel *a)
{
    struct rng d = rng_from(7, 7);
    uint64_t hash = HASH_START;
    for (uint64_t i = 0; i < 200; i++) {
        const accel_ray ray = ray_families->make(&scene.target, a, &d, i);
        const struct answer answer = ask(a, &ray, true);
        hash = answer_hash(hash, &answer);
    }
    return hash;
}

/* What the description says builds the same structure again, and says the same again. */
static void test_description(void **state)
{
    (void)state;
    struct tested *list;
    const size_t count = tested_configs(&list);
    for (size_t i = 0; i < count; i++) {
        accel_info one, two;
        accel *a = must_build(&scene, list[i].config);
        accel_describe(a, &one);
        accel *b = must_build(&scene, one.config);
        accel_describe(b, &two);
        if (strcmp(one.config, two.config) != 0)
            fail_msg("%s: '%s', built again: '%s'", list[i].config, one.config, two.config);
        assert_int_equal(strncmp(one.config, one.kind, strlen(one.kind)), 0);
        assert_string_equal(one.kind, two.kind);
        assert_int_equal(one.nodes, two.nodes);
        assert_int_equal(one.leaves, two.leaves);
        assert_int_equal(one.references, two.references);
        assert_int_equal(one.depth, two.depth);
        assert_int_equal(one.clusters, two.clusters);
        assert_int_equal(hash_answers(a), hash_answers(b));
        accel_free(a);
        accel_free(b);
    }
    free(list);
}

static void check_info(const accel_info *i)
{
    assert_true(i->bytes > 0 && i->peak_bytes >= i->bytes);
    assert_true(i->phase_count > 0 && i->phase_count <= ACCEL_INFO_PHASES);
    double sum = 0;
    for (uint32_t p = 0; p < i->phase_count; p++) {
        assert_true(strlen(i->phases[p].name) > 0 && i->phases[p].seconds >= 0);
        sum += i->phases[p].seconds;
    }
    assert_true(i->seconds >= 0 && sum <= i->seconds * 1.01 + 1e-4);
    assert_true(i->note_count <= ACCEL_INFO_NOTES);
    for (uint32_t n = 0; n < i->note_count; n++)
        assert_true(strlen(i->notes[n]) > 0 && strlen(i->notes[n]) < sizeof i->notes[n] - 1);
}

static void test_info(void **state)
{
    (void)state;
    struct tested *list;
    const size_t count = tested_configs(&list);
    for (size_t i = 0; i < count; i++) {
        struct pool pool = {.most = SIZE_MAX};
        const accel_hooks hooks = {.user = &pool, .resize = pool_resize};
        accel *a;
        accel_info info;
        assert_int_equal(accel_build(&a, &scene.scene, list[i].config, &hooks, NULL), ACCEL_OK);
        accel_describe(a, &info);
        check_info(&info);
        assert_int_equal(info.primitives, scene_size(&scene));
        assert_int_equal(info.unbounded, 2);
        assert_int_equal(info.skipped, 0);
        assert_int_equal(info.bytes, pool.held);
        assert_int_equal(info.peak_bytes, pool.peak);
        accel_free(a);
        assert_int_equal(pool.held, 0);
    }
    free(list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_table),       cmocka_unit_test(test_defaults),
        cmocka_unit_test(test_options),     cmocka_unit_test(test_repeats),
        cmocka_unit_test(test_kinds),       cmocka_unit_test(test_hostile),
        cmocka_unit_test(test_description), cmocka_unit_test(test_info),
    };
    return cmocka_run_group_tests_name("config_strings", tests, open_scene, close_scene);
}
