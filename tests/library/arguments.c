/* SPDX-License-Identifier: Apache-2.0
 *
 * What hosts get wrong: a NULL where something has to be is refused or told; copies of a probe
 * report as the probe does; whatever is in a config, errors are one line of printable UTF-8.
 */
#include <locale.h>
#include <stdlib.h>
#include <string.h>
#include <wchar.h>
#include <wctype.h>

#include "cmocka_all.h"
#include "compare.h"

/* ------------------------------------------------------------------- NULL ---- */

static bool count_hit(void *user, const accel_hit *hit)
{
    (void)hit;
    ++*(uint32_t *)user;
    return true;
}

static bool count_id(void *user, accel_id id)
{
    (void)id;
    ++*(uint32_t *)user;
    return true;
}

/* Each query without one of its arguments: refused, counted, and without a hit. */
static void refuse_queries(const accel *a, const accel_ray *ray)
{
    accel_query q = {.user = NULL};
    accel_hit hit;
    uint32_t visited = 0;
    assert_false(accel_closest(NULL, ray, &hit, &q) || accel_closest(a, NULL, &hit, &q) ||
                 accel_closest(NULL, NULL, NULL, &q) || accel_closest(NULL, ray, &hit, NULL));
    assert_int_equal(q.refused, 3);
    assert_false(accel_any(NULL, ray, &q) || accel_any(a, NULL, &q) || accel_any(a, NULL, NULL));
    assert_int_equal(q.refused, 5);
    assert_true(accel_all(NULL, ray, count_hit, &visited, &q) &&
                accel_all(a, NULL, count_hit, &visited, &q) &&
                accel_all(a, ray, NULL, &visited, &q) && accel_all(a, ray, NULL, NULL, NULL));
    assert_int_equal(q.refused, 8);
    assert_true(accel_point(NULL, ray->org, count_id, &visited, &q) &&
                accel_point(a, NULL, count_id, &visited, &q) &&
                accel_point(a, ray->org, NULL, &visited, &q));
    assert_int_equal(q.refused, 11);
    assert_int_equal(visited, 0);
    assert_true(q.nodes == 0 && q.tests == 0);
    assert_true(accel_any(a, ray, &q));
    assert_true(accel_closest(a, ray, NULL, &q)); /* whether there is one */
    assert_int_equal(q.refused, 11);
}

static void test_null_in_queries(void **state)
{
    (void)state;
    static const double org[3] = {0, 0, -3}, dir[3] = {0, 0, 1}, centre[3] = {0, 0, 0};
    struct test_scene s;
    struct tested *list;
    const size_t count = tested_configs(&list);
    const accel_ray ray = accel_ray_from(org, dir);
    scene_open(&s);
    part_sphere(scene_part(&s, ACCEL_SPHERES), centre, 1.0);
    scene_close(&s);
    for (size_t i = 0; i < count; i++) {
        accel *a = must_build(&s, list[i].config);
        refuse_queries(a, &ray);
        accel_free(a);
    }
    scene_free(&s);
    free(list);
}

static void test_null_elsewhere(void **state)
{
    (void)state;
    const accel_scene nothing = {NULL, 0};
    size_t count;
    const accel_kind_info *const *kind = accel_kinds(&count);
    assert_ptr_equal(accel_kinds(NULL), kind);
    assert_null(kind[count]);
    accel_error error;
    accel_info info;
    accel_box box;
    assert_int_equal(accel_validate(NULL, &error), ACCEL_BAD_ARGUMENT);
    assert_non_null(strstr(error.text, "NULL"));
    assert_int_equal(accel_validate(NULL, NULL), ACCEL_BAD_ARGUMENT);
    memset(&info, 0x55, sizeof info);
    accel_describe(NULL, &info);
    assert_string_equal(info.kind, "");
    assert_true(info.primitives == 0 && info.phase_count == 0 && info.config[0] == '\0');
    assert_false(accel_padded_box(NULL, (accel_id){0, 0}, &box));
    assert_false(accel_report(NULL, 1.0, 0.0, 0.0));
    accel *a;
    assert_int_equal(accel_build(&a, &nothing, NULL, NULL, NULL), ACCEL_OK);
    accel_describe(a, NULL);
    assert_false(accel_padded_box(a, (accel_id){0, 0}, NULL));
    accel_free(a);
    accel_free(NULL);
}

/* ------------------------------------------------------------------ probes ---- */

/* Reports three hits: by the probe, by a copy, by a copy of a copy that is elsewhere in memory. */
static void report_by_copies(accel_probe *probe)
{
    accel_probe copy = *probe, *other = must_resize(NULL, sizeof *other);
    *other = copy;
    const double t = 3.0 + probe->prim;
    accel_report(probe, t, 1.0, 0.0);
    accel_report(&copy, t - 0.5, 2.0, 0.0);
    accel_report(other, t - 0.25, 3.0, 0.0);
    free(other);
}

static void test_copied_probe(void **state)
{
    (void)state;
    static const accel_box boxes[2] = {{{-1, -1, 2}, {1, 1, 4}}, {{-1, -1, 3}, {1, 1, 5}}};
    static const double org[3] = {0, 0, 0}, dir[3] = {0, 0, 1};
    const accel_ray ray = accel_ray_from(org, dir);
    struct tested *list;
    const size_t count = tested_configs(&list);
    for (size_t i = 0; i < 2 * count; i++) {
        const accel_geometry g = {
            .type = ACCEL_OBJECTS,
            .objects = {boxes, 2, (accel_order)(i % 2), report_by_copies, NULL, 0}};
        accel *a;
        accel_hit hit;
        uint32_t visited = 0;
        assert_int_equal(accel_build(&a, &(accel_scene){&g, 1}, list[i / 2].config, NULL, NULL),
                         ACCEL_OK);
        assert_true(accel_closest(a, &ray, &hit, NULL));
        assert_true(hit.t == 2.5 && hit.u == 2.0 && hit.prim == 0);
        assert_true(accel_all(a, &ray, count_hit, &visited, NULL));
        assert_int_equal(visited, 6);
        accel_free(a);
    }
    free(list);
    accel_probe none = {.library = NULL};
    assert_false(accel_report(&none, 1.0, 0.0, 0.0));
}

/* ------------------------------------------------------------------- texts ---- */

/* By libc's own tables. Those of the directions of writing are no control characters there. */
static void check_printable(const char *text)
{
    mbstate_t state = {0};
    const char *at = text;
    wchar_t c;
    for (size_t size; (size = mbrtowc(&c, at, 8, &state)) != 0; at += size) {
        if (size > 8)
            fail_msg("no UTF-8 at byte %d: '%s'", (int)(at - text), text);
        if (iswcntrl((wint_t)c) || (c >= 0x202a && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069))
            fail_msg("the character %x at byte %d: '%s'", (unsigned)c, (int)(at - text), text);
    }
}

static const accel_error *refuse(const char *config)
{
    static accel_error error;
    const accel_scene nothing = {NULL, 0};
    accel *a;
    assert_int_equal(accel_build(&a, &nothing, config, NULL, &error), ACCEL_BAD_CONFIG);
    check_printable(error.text);
    if (!strstr(error.text, "othing was built"))
        fail_msg("the text is cut: '%s'", error.text);
    return &error;
}

#define SAYS(config, what)                                                                         \
    do {                                                                                           \
        const char *text_ = refuse(config)->text;                                                  \
        if (!strstr(text_, (what)))                                                                \
            fail_msg("no '%s' in '%s'", (what), text_);                                            \
    } while (0)

static void test_texts(void **state)
{
    (void)state;
    assert_non_null(setlocale(LC_CTYPE, "C.UTF-8"));
    SAYS("\033[31mhoo", "'?[31mhoo'");
    SAYS("h\noo", "'h?oo'");
    SAYS("auto:ra\tys=1", "'ra?ys'");
    SAYS("auto:rays=1\r2", "'1?2'");
    SAYS("auto:rays=\x7f", "'?'");
    SAYS("Gr\303\274n", "'Gr\303\274n'");           /* a letter */
    SAYS("\360\237\214\262", "'\360\237\214\262'"); /* a tree */
    SAYS("x\302\233"
         "31m",
         "'x?31m'");                       /* CSI of C1 */
    SAYS("x\342\200\256y", "'x?y'");       /* from right to left */
    SAYS("x\342\200\250y", "'x?y'");       /* line separator */
    SAYS("\303", "'?'");                   /* cut */
    SAYS("\303\274\274", "'\303\274?'");   /* one byte too many */
    SAYS("\300\257", "'?\?'");             /* overlong */
    SAYS("\355\240\200", "'?\?\?'");       /* half a surrogate pair */
    SAYS("\364\220\200\200", "'?\?\?\?'"); /* beyond Unicode */
    SAYS("\377\376", "'?\?'");
    SAYS("auto:rays=000000000000000000000000000000000000000\303\274",
         "'000000000000000000000000000000000000000'");
    SAYS("linear:000000000000000000000000000000000000000\303\274\303\274",
         "'000000000000000000000000000000000000000'");
    setlocale(LC_CTYPE, "C");
}

/* Legal configs with bytes of all sorts in them, and words of such. */
static void test_any_text(void **state)
{
    (void)state;
    static const char *const starts[] = {"", "auto:", "auto:rays=", "auto:rays=1,"};
    struct rng d = rng_from(test_seed(), 4);
    assert_non_null(setlocale(LC_CTYPE, "C.UTF-8"));
    for (uint64_t i = 0; i < scaled_count(30000); i++) {
        char text[700];
        const char *start = starts[rng_below(&d, 4)];
        const size_t from = strlen(start),
                     size = from + rng_below(&d, rng_chance(&d, 0.1) ? 600 : 60);
        memcpy(text, start, from);
        for (size_t j = from; j < size; j++)
            text[j] =
                (char)(rng_chance(&d, 0.5) ? 1 + rng_below(&d, 255) : 128 + rng_below(&d, 120));
        text[size] = '\0';
        text[from] = size > from ? '*' : '\0'; /* never legal */
        if (size > from)
            refuse(text);
    }
    setlocale(LC_CTYPE, "C");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_null_in_queries), cmocka_unit_test(test_null_elsewhere),
        cmocka_unit_test(test_copied_probe),    cmocka_unit_test(test_texts),
        cmocka_unit_test(test_any_text),
    };
    return cmocka_run_group_tests_name("arguments", tests, NULL, NULL);
}
