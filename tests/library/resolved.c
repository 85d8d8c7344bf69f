/* SPDX-License-Identifier: Apache-2.0
 *
 * The resolved config of a structure builds the same again, and numbers of configs are read and
 * written the same, whatever the host's locale and rounding mode. The locales are made by ctest,
 * which names their place in LOCPATH.
 */
#include <locale.h>
#include <stdlib.h>
#include <string.h>

#include "cmocka_all.h"
#include "compare.h"
#include "modes.h"
#include "core/number.h"

/* The second has a decimal comma, the third one of two bytes. */
static const char *const locales[] = {"C", "de_DE.UTF-8", "ps_AF.UTF-8"};
enum { LOCALES = sizeof locales / sizeof *locales, ROUNDINGS = 4 };

static void enter_locale(size_t i)
{
    if (!setlocale(LC_ALL, locales[i % LOCALES]))
        fail_msg("no locale %s: run this test by ctest, or make it with localedef in LOCPATH",
                 locales[i % LOCALES]);
    const char *radix = localeconv()->decimal_point;
    assert_int_equal(strcmp(radix, ".") == 0, i % LOCALES == 0);
}

static void leave_locale(void)
{
    setlocale(LC_ALL, "C");
}

/* Builds as a host in this locale and mode would. */
static accel *build_in(const accel_scene *scene, const char *config, size_t locale, size_t mode)
{
    accel *a;
    accel_error error;
    enter_locale(locale);
    mode_enter(&modes[mode % MODES]);
    accel_build(&a, scene, config, NULL, &error);
    mode_leave();
    leave_locale();
    if (error.status != ACCEL_OK)
        fail_msg("%s in locale %s, rounding %s: %s", config, locales[locale % LOCALES],
                 modes[mode % MODES].name, error.text);
    return a;
}

static accel_info describe(const accel *a)
{
    accel_info info;
    accel_describe(a, &info);
    return info;
}

/* ----------------------------------------------------------------- numbers ---- */

static uint64_t bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static double any_double(struct rng *d)
{
    double x;
    do {
        const uint64_t bits = rng_bits(d);
        memcpy(&x, &bits, sizeof x);
    } while (!isfinite(x));
    return rng_chance(d, 0.3) ? floor(rng_unit(d) * 1e6) / 1e3 : x;
}

/* accel_number_text prints as %g does in the C locale; accel_number_parse is the inverse. */
static void test_numbers(void **state)
{
    (void)state;
    struct rng d = rng_from(test_seed(), 1);
    for (uint64_t i = 0; i < scaled_count(200000); i++) {
        const double x = any_double(&d);
        const int digits = 1 + (int)rng_below(&d, 17);
        char expected[40];
        double back = 0;
        snprintf(expected, sizeof expected, "%.*g", digits, x);
        enter_locale(i);
        const struct number_text shortened = accel_number_text(x, digits),
                                 exact = accel_number_text_exact(x);
        const bool parsed = accel_number_parse(exact.at, strlen(exact.at), &back);
        leave_locale();
        assert_string_equal(shortened.at, expected);
        if (!parsed || bits_of(back) != bits_of(x))
            fail_msg("%a is printed as %s and read as %a", x, exact.at, back);
    }
}

/* Writes a number in an unusual way: zeros before and after, the point moved, some digits. */
static void spell(struct rng *d, char *to, size_t size)
{
    const int before = (int)rng_below(d, 30), behind = (int)rng_below(d, 900);
    int used = snprintf(to, size, "%s", rng_chance(d, 0.2) ? "-" : "");
    const bool zeros = rng_chance(d, 0.3);
    for (int i = 0; i < before; i++)
        to[used++] = (char)('0' + (zeros ? 0 : rng_below(d, 10)));
    to[used++] = '.';
    for (int i = 0; i < behind; i++)
        to[used++] = (char)('0' + (zeros && i < behind / 2 ? 0 : rng_below(d, 10)));
    to[used++] = '0';
    snprintf(to + used, size - (size_t)used, "e%d", (int)rng_below(d, 700) - 350);
}

/* Half-way between two doubles, to the last digit, and then a little more. */
static void spell_middle(struct rng *d, char *to, size_t size)
{
    const int exponent = (int)rng_below(d, 60) - 30;
    const uint64_t odd = rng_bits(d) >> 10 | 1; /* 54 bits: the middle, unless leading bits are 0 */
    const double low = ldexp((double)(odd >> 1), exponent + 1), half = ldexp(1.0, exponent);
    char text[200];
    snprintf(text, sizeof text, "%.120Lf", (long double)low + (long double)half);
    snprintf(to, size, "%s%s", text, rng_chance(d, 0.5) ? "" : "000000000000000000000000000001");
}

/* As strtod reads in the C locale. */
static void test_spellings(void **state)
{
    (void)state;
    struct rng d = rng_from(test_seed(), 2);
    char text[1200];
    for (uint64_t i = 0; i < scaled_count(100000); i++) {
        double found = 0;
        if (i % 2 == 0)
            spell(&d, text, sizeof text);
        else
            spell_middle(&d, text, sizeof text);
        const double expected = strtod(text, NULL);
        enter_locale(i);
        const bool parsed = accel_number_parse(text, strlen(text), &found);
        leave_locale();
        if (!parsed || bits_of(found) != bits_of(expected))
            fail_msg("%s is read as %a, not as %a", text, found, expected);
    }
}

/* -------------------------------------------------------- configs of nothing ---- */

/* A legal number of many digits. */
static double any_legal(struct rng *d, const accel_option *o)
{
    const double lo = o->min > 0 ? o->min : 1e-9;
    double x;
    do {
        const double part = rng_unit(d);
        x = rng_chance(d, 0.1)   ? o->max
            : rng_chance(d, 0.1) ? o->min
                                 : exp2(log2(lo) * (1 - part) + log2(o->max) * part);
        x = o->whole ? floor(x) : x;
    } while (!(x >= o->min && x <= o->max));
    return x;
}

/* A config of a kind: some of its options, in another order; value[]: what each must become. */
static void any_config(struct rng *d, const accel_kind_info *kind, char *text, size_t size,
                       double *value)
{
    int used = snprintf(text, size, "%s", kind->name);
    const size_t n = kind->option_count;
    const uint32_t turn = n > 0 ? rng_below(d, (uint32_t)n) : 0;
    bool any = false;
    for (size_t i = 0; i < n; i++) {
        const size_t at = (i + turn) % n;
        const accel_option *o = &kind->options[at];
        uint32_t words = 0;
        value[at] = o->standard;
        if (rng_chance(d, 0.3))
            continue;
        while (o->words && o->words[words])
            words++;
        value[at] = o->words ? rng_below(d, words) : any_legal(d, o);
        used += snprintf(text + used, size - (size_t)used, "%c%s=", any ? ',' : ':', o->key);
        used += o->words
                    ? snprintf(text + used, size - (size_t)used, "%s", o->words[(int)value[at]])
                    : snprintf(text + used, size - (size_t)used, "%.17g", value[at]);
        any = true;
    }
}

/* Does the config name every option with its value? */
static void check_config(const accel_kind_info *kind, const char *config, const double *value)
{
    const char *at = config + strlen(kind->name);
    for (size_t i = 0; i < kind->option_count; i++) {
        const accel_option *o = &kind->options[i];
        char head[60];
        snprintf(head, sizeof head, "%c%s=", i == 0 ? ':' : ',', o->key);
        if (strncmp(at, head, strlen(head)) != 0)
            fail_msg("%s: no %s", config, head);
        at += strlen(head);
        const size_t size = strcspn(at, ",");
        char text[60];
        snprintf(text, sizeof text, "%.*s", (int)size, at);
        at += size;
        if (isnan(value[i]) ? strcmp(text, "auto") != 0
            : o->words      ? strcmp(text, o->words[(int)value[i]]) != 0
                            : strtod(text, NULL) != value[i])
            fail_msg("%s: %s is not %a", config, o->key, value[i]);
    }
    assert_string_equal(at, "");
}

static void test_configs(void **state)
{
    (void)state;
    const accel_scene nothing = {NULL, 0};
    struct rng d = rng_from(test_seed(), 3);
    size_t kinds;
    const accel_kind_info *const *kind = accel_kinds(&kinds);
    for (uint64_t i = 0; i < scaled_count(40000); i++) {
        const accel_kind_info *k = kind[rng_below(&d, (uint32_t)kinds)];
        char text[600];
        double value[40];
        any_config(&d, k, text, sizeof text, value);
        accel *a = build_in(&nothing, text, i, i / LOCALES);
        const accel_info first = describe(a);
        accel_free(a);
        if (strcmp(k->name, "auto") == 0)
            continue; /* it is another kind by then */
        check_config(k, first.config, value);
        a = build_in(&nothing, first.config, i / 2, i / 3);
        const accel_info second = describe(a);
        accel_free(a);
        assert_string_equal(first.config, second.config);
    }
}

/* -------------------------------------------------------------- structures ---- */

static uint64_t hash_answers(const accel *a, const struct test_scene *s)
{
    struct rng d = rng_from(9, 9);
    uint64_t hash = HASH_START;
    for (uint64_t i = 0; i < 40; i++) {
        const accel_ray ray = ray_families->make(&s->target, a, &d, i);
        const struct answer answer = ask(a, &ray, true);
        hash = answer_hash(hash, &answer);
    }
    return hash;
}

static void check_same(const char *name, const char *config, const accel *a, const accel *b)
{
    const accel_info x = describe(a), y = describe(b);
    if (strcmp(x.config, y.config) != 0 || strcmp(x.kind, y.kind) != 0 || x.nodes != y.nodes ||
        x.leaves != y.leaves || x.references != y.references || x.depth != y.depth ||
        x.clusters != y.clusters || x.size_classes != y.size_classes || x.bytes != y.bytes ||
        x.skipped != y.skipped || x.degenerate != y.degenerate)
        fail_msg("%s on %s: %s has %llu nodes, %llu leaves, %llu references, %llu bytes; built "
                 "again: %s, %llu, %llu, %llu, %llu",
                 config, name, x.config, (unsigned long long)x.nodes, (unsigned long long)x.leaves,
                 (unsigned long long)x.references, (unsigned long long)x.bytes, y.config,
                 (unsigned long long)y.nodes, (unsigned long long)y.leaves,
                 (unsigned long long)y.references, (unsigned long long)y.bytes);
}

/* Built plainly, in a locale and mode, and from what that says of itself, in others. */
static void build_again(const struct test_scene *s, const char *name, const char *config,
                        size_t turn)
{
    accel *plain = must_build(s, config);
    accel *first = build_in(&s->scene, config, turn + 1, turn + 1);
    const accel_info info = describe(first);
    accel *second = build_in(&s->scene, info.config, turn / 2, turn / 3);
    accel_error error;
    mode_enter(&modes[(turn + 2) % MODES]);
    const accel_status sound = accel_validate(first, &error);
    mode_leave();
    if (sound != ACCEL_OK)
        fail_msg("%s on %s, built rounding %s, checked rounding %s: %s", config, name,
                 modes[(turn + 1) % MODES].name, modes[(turn + 2) % MODES].name, error.text);
    /* lazy ones are built by that */
    const uint64_t expected = hash_answers(plain, s);
    if (hash_answers(first, s) != expected || hash_answers(second, s) != expected)
        fail_msg("%s on %s: built again it answers otherwise", config, name);
    check_same(name, config, plain, first);
    check_same(name, config, first, second);
    accel_free(plain);
    accel_free(first);
    accel_free(second);
}

static void test_structures(void **state)
{
    (void)state;
    static const char *const scenes[] = {"shards", "mixed",        "degenerate", "copies-512",
                                         "series", "lattice",      "slivers",    "scale-1e-310",
                                         "stack",  "nested-boxes", "split-64",   "two-triangles",
                                         "fan",    "scale-1e300",  "empty"};
    struct tested *list;
    size_t turn = 0;
    const size_t count = tested_configs(&list);
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct test_scene s;
        scene_make(&s, scene_maker_find(scenes[i]), test_seed());
        for (size_t j = 0; j < count; j++)
            build_again(&s, scenes[i], list[j].config, turn++);
        scene_free(&s);
    }
    free(list);
}

/* Many small scenes of the default configs. */
static void test_small_scenes(void **state)
{
    (void)state;
    size_t kinds;
    const accel_kind_info *const *kind = accel_kinds(&kinds);
    for (uint64_t i = 0; i < scaled_count(400); i++) {
        struct test_scene s;
        struct rng d = rng_from(test_seed(), i);
        scene_open(&s);
        make_shards(&s, &d, 1 + rng_below(&d, 60));
        scene_close(&s);
        for (size_t k = 0; k < kinds; k++)
            build_again(&s, "shards", kind[k]->name, i + k);
        scene_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_numbers),      cmocka_unit_test(test_spellings),
        cmocka_unit_test(test_configs),      cmocka_unit_test(test_structures),
        cmocka_unit_test(test_small_scenes),
    };
    return cmocka_run_group_tests_name("resolved", tests, NULL, NULL);
}
