/* SPDX-License-Identifier: Apache-2.0
 *
 * Parts of the mesh readers alone: numbers of text in every form, against strtod, also where the
 * process has a locale with another point; faces of many corners, which must be covered by their
 * triangles and by nothing else.
 */
#include "mesh/mesh.h"
#include "mesh/polygon.h"
#include "mesh/text.h"
#include "random.h"

#include <float.h>
#include <locale.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { NUMBERS = 200000, POLYGONS = 3000, MOST_CORNERS = 80 };

static struct random numbers;

/* Below `limit`. */
static uint32_t whole(uint32_t limit)
{
    return (uint32_t)(random_bits(&numbers) % limit);
}

static double real(double low, double high)
{
    return low + (high - low) * (double)(random_bits(&numbers) >> 11) / 0x1p53;
}

/* ---------------------------------------------------------------- numbers ---- */

static mesh_text text_of(const char *text)
{
    return (mesh_text){.at = text, .begin = text, .end = text + strlen(text), .line = 1};
}

/* In the C locale. */
static double expected(const char *text)
{
    const locale_t c = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    const locale_t before = uselocale(c);
    const double number = strtod(text, NULL);
    uselocale(before);
    freelocale(c);
    return number;
}

static void check_number(const char *word)
{
    mesh_text text = text_of(word);
    double number;
    const double right = expected(word);
    const bool fine = mesh_take_number(&text, &number);
    if (fine != (fabs(right) <= DBL_MAX)) {
        fail_msg("'%s' is %s", word, fine ? "taken" : "refused");
    }
    if (fine && memcmp(&number, &right, sizeof number) != 0) {
        fail_msg("'%s' is %a, not %a", word, number, right);
    }
}

static void check_word(const char *word, bool right)
{
    mesh_text text = text_of(word);
    double number;
    const bool fine = mesh_take_number(&text, &number);
    if (fine != right || text.at != (right ? text.end : word)) {
        fail_msg("'%s' is %s, %d characters", word, fine ? "taken" : "refused",
                 (int)(text.at - word));
    }
}

/* Digits with a point among them or none, and an exponent or none. */
static void random_word(char *word)
{
    const uint32_t digits = 1 + whole(25), point = whole(digits + 8);
    char *to = word + sprintf(word, "%s", whole(4) == 0 ? "-" : whole(9) == 0 ? "+" : "");
    for (uint32_t i = 0; i < digits; i++) {
        to += sprintf(to, "%s%c", i == point ? "." : "", (char)('0' + whole(10)));
    }
    if (whole(3) == 0) {
        sprintf(to, "%c%s%u", whole(2) == 0 ? 'e' : 'E', whole(2) == 0 ? "-" : "",
                whole(whole(4) == 0 ? 340 : 24));
    }
}

/* Any double, and the middle between it and the next one. */
static void check_near_double(void)
{
    char word[1200];
    const uint64_t bits = random_bits(&numbers);
    double number;
    memcpy(&number, &bits, sizeof number);
    if (!isfinite(number)) {
        return;
    }
    snprintf(word, sizeof word, "%.17g", number);
    check_number(word);
    snprintf(word, sizeof word, "%.*g", (int)(1 + whole(20)), number);
    check_number(word);
    const double next = nextafter(number, INFINITY);
    if (isfinite(next)) {
        /* exact in 64 bits */
        snprintf(word, sizeof word, "%.800Lg", ((long double)number + (long double)next) / 2);
        check_number(word);
    }
}

static void test_numbers(void **state)
{
    (void)state;
    char word[100];
    for (int i = 0; i < NUMBERS; i++) {
        random_word(word);
        check_number(word);
    }
    /* written with a point whatever the locale is */
    const locale_t c = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    const locale_t before = uselocale(c);
    for (int i = 0; i < NUMBERS / 10; i++) {
        check_near_double();
    }
    uselocale(before);
    freelocale(c);
}

static void test_words(void **state)
{
    (void)state;
    static const char *const right[] = {"0",     "-0",    "+1",     "1.",
                                        ".5",    "-.5e1", "1e3",    "1E+3",
                                        "1.e-3", "00012", "1e0009", "123456789012345678901"};
    static const char *const wrong[] = {"",       ".",     "-",     "+.",       "e5",    "1e",
                                        "1e+",    "--1",   "1.2.3", "nan",      "inf",   "0x1",
                                        "1,5",    "1e999", "1d3",   "1f",       "1e5.0", "NaN(1)",
                                        "-1e400", "0x",    "1_000", "\302\2401"};
    for (size_t i = 0; i < sizeof right / sizeof right[0]; i++) {
        check_word(right[i], true);
    }
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        check_word(wrong[i], false);
    }
}

/* A mesh is the same in a process whose point is a comma. */
static void test_locale(void **state)
{
    (void)state;
    static const char gltf[] =
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0,"
        "\"translation\":[0.1,1.5e-3,0.30000000000000004]}],\"meshes\":[{\"primitives\":[{"
        "\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{\"componentType\":5126,\"count\":3,"
        "\"type\":\"VEC3\"}]}";
    static const char obj[] = "v 0.1 1.5e-3 0.30000000000000004\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const struct {
        const char *name, *text;
    } files[] = {{"a.gltf", gltf}, {"a.obj", obj}};
    if (setlocale(LC_ALL, "de_DE.UTF-8") == NULL) {
        fail_msg("no locale de_DE.UTF-8: run this test by ctest");
    }
    assert_string_equal(localeconv()->decimal_point, ",");
    for (int i = 0; i < 2; i++) {
        struct loaded loaded = {0};
        accel_error error;
        const struct mesh_source source = {.name = files[i].name,
                                           .bytes = files[i].text,
                                           .size = strlen(files[i].text),
                                           .memory = 1 << 20};
        if (!mesh_load(&loaded, &source, &error)) {
            fail_msg("%s", error.text);
        }
        double at[3];
        scene_vertex(&loaded.geometries[0].triangles, 0, 0, at);
        assert_true(at[0] == 0.1 && at[1] == 1.5e-3 && at[2] == 0.30000000000000004);
        unload_scene(&loaded);
    }
    test_numbers(NULL);
    setlocale(LC_ALL, "C");
}

/* A few bytes may ask for any number of zeros, and of copies. */
static void test_memory(void **state)
{
    (void)state;
    static const struct {
        const char *text, *words;
    } files[] = {
        {"{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
         "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"mode\":5}]}],"
         "\"accessors\":[{\"componentType\":5126,\"count\":4000000000,\"type\":\"VEC3\"}]}",
         "accessors[0] has 4000000000 elements, which do not fit into memory"},
        {"{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"mesh\":0},"
         "{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
         "\"accessors\":[{\"componentType\":5126,\"count\":30000,\"type\":\"VEC3\"}]}",
         "shows 2 meshes of 20000 triangles together, which take 1 MB of memory, but 1 MB are "
         "free"}};
    for (int i = 0; i < 2; i++) {
        struct loaded loaded = {0};
        accel_error error;
        const struct mesh_source source = {.name = "a.gltf",
                                           .bytes = files[i].text,
                                           .size = strlen(files[i].text),
                                           .memory = 1 << 20};
        assert_false(mesh_load(&loaded, &source, &error));
        if (strstr(error.text, files[i].words) == NULL) {
            fail_msg("%s", error.text);
        }
        unload_scene(&loaded);
    }
}

/* --------------------------------------------------------------- polygons ---- */

/* A polygon in the plane. */
typedef struct polygon {
    double at[MOST_CORNERS][2];
    uint32_t count;
} polygon;

static double turn(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static bool cross(const double a[2], const double b[2], const double c[2], const double d[2])
{
    return (turn(a, b, c) > 0) != (turn(a, b, d) > 0) && (turn(c, d, a) > 0) != (turn(c, d, b) > 0);
}

static void star(polygon *p)
{
    p->count = 4 + whole(MOST_CORNERS - 4);
    for (uint32_t i = 0; i < p->count; i++) {
        const double angle = 6.283185307179586 * (i + real(0.1, 0.9)) / p->count;
        const double radius = real(0.1, 1);
        p->at[i][0] = radius * cos(angle);
        p->at[i][1] = radius * sin(angle);
    }
}

/* May the side from corner i go by way of `apex`? */
static bool is_free(const polygon *p, uint32_t i, const double apex[2])
{
    const uint32_t next = (i + 1) % p->count;
    for (uint32_t k = 0; k < p->count; k++) {
        const uint32_t end = (k + 1) % p->count;
        const bool at_i = k == i || end == i, at_next = k == next || end == next;
        if ((!at_i && cross(p->at[i], apex, p->at[k], p->at[end])) ||
            (!at_next && cross(apex, p->at[next], p->at[k], p->at[end]))) {
            return false;
        }
    }
    return turn(p->at[i], apex, p->at[next]) != 0.0;
}

/* One that goes round itself in any way: sides are bent to random places. */
static void grown(polygon *p)
{
    const uint32_t wanted = 4 + whole(MOST_CORNERS - 4);
    *p = (polygon){{{0, 0}, {1, 0}, {0, 1}}, 3};
    for (int tries = 0; tries < 5000 && p->count < wanted; tries++) {
        const uint32_t i = whole(p->count);
        const double apex[2] = {real(-1, 2), real(-1, 2)};
        if (is_free(p, i, apex)) {
            memmove(p->at[i + 2], p->at[i + 1], (p->count - i - 1) * sizeof *p->at);
            memcpy(p->at[i + 1], apex, sizeof apex);
            p->count++;
        }
    }
}

static void add(polygon *p, double x, double y)
{
    p->at[p->count][0] = x;
    p->at[p->count++][1] = y;
}

/* Whole numbers, with corners on straight sides: a comb. */
static void comb(polygon *p)
{
    p->count = 0;
    const int teeth = 1 + (int)whole(15);
    for (int i = 0; i < teeth; i++) {
        add(p, 4 * i, 0);
        add(p, 4 * i + 1, 0);
        add(p, 4 * i + 1, 3 + whole(3));
        add(p, 4 * i + 3, whole(3) + 1.0);
    }
    add(p, 4 * teeth, 0);
    add(p, 4 * teeth, -1);
    add(p, 2 * teeth, -1);
    add(p, 0, -1);
}

/* A square with square holes, each with a bridge from one corner of the large one, so that this
 * corner is there once more for each hole, and a corner of each hole twice. */
static void keyholes(polygon *p)
{
    const int holes = 1 + (int)whole(6);
    p->count = 0;
    add(p, 0, 0);
    add(p, 10, 0);
    add(p, 10, 10);
    add(p, 0, 10);
    for (int i = holes; i > 0; i--) {
        const double angle = 1.5 * (i - real(0.4, 0.6)) / holes, far = real(3, 8);
        const double x = far * cos(angle), y = far * sin(angle), size = real(0.05, 0.8) / holes;
        add(p, 0, 0);
        add(p, x, y);
        add(p, x, y + size);
        add(p, x + size, y + size);
        add(p, x + size, y);
        add(p, x, y);
    }
}

/* Corners begin anywhere, in either direction. */
static void shuffle(polygon *p)
{
    const polygon from = *p;
    const uint32_t first = whole(p->count);
    const bool backwards = whole(2) == 0;
    for (uint32_t i = 0; i < p->count; i++) {
        const uint32_t to = (first + (backwards ? p->count - i : i)) % p->count;
        memcpy(p->at[to], from.at[i], sizeof from.at[i]);
    }
}

/* Puts it into a plane in space, far away and large or small. Plain ones keep their numbers, so
 * that corners on a line stay there. */
static void put_in_space(const polygon *p, bool plain, double (*vertices)[3])
{
    const double size = plain ? 1 : pow(10, real(-3, 4)), far = plain ? 0 : size * real(0, 100);
    double u[3], v[3];
    for (int k = 0; k < 3; k++) {
        u[k] = plain ? k == 0 : real(-1, 1);
        v[k] = plain ? k == 1 : real(-1, 1);
    }
    for (uint32_t i = 0; i < p->count; i++) {
        for (int k = 0; k < 3; k++) {
            vertices[i][k] = far + size * (u[k] * p->at[i][0] + v[k] * p->at[i][1]);
        }
    }
}

static double add_area(const double *a, const double *b, const double *c, double sum[3])
{
    double square = 0;
    for (int k = 0; k < 3; k++) {
        const int y = (k + 1) % 3, z = (k + 2) % 3;
        const double part = (b[y] - a[y]) * (c[z] - a[z]) - (b[z] - a[z]) * (c[y] - a[y]);
        sum[k] += part;
        square += part * part;
    }
    return sqrt(square);
}

/* Every side is one of a triangle, every other edge one of two that pass it in opposite ways. */
static void check_edges(uint32_t count, const uint32_t *triangles)
{
    static int passes[MOST_CORNERS][MOST_CORNERS];
    memset(passes, 0, sizeof passes);
    for (uint32_t i = 0; i < 3 * (count - 2); i++) {
        passes[triangles[i]][triangles[i % 3 == 2 ? i - 2 : i + 1]]++;
    }
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t k = 0; k < count; k++) {
            const int wanted = k == (i + 1) % count ? 1 : i == (k + 1) % count ? 0 : -1;
            assert_true(wanted < 0 ? passes[i][k] == passes[k][i] && passes[i][k] <= 1
                                   : passes[i][k] == wanted);
        }
    }
}

/* With the edges right, the areas of all triangles add up to that of the polygon; they do so
 * without their signs just where none of them is turned over, so that none covers another. A
 * product of coordinates is wrong by some units in its last place. */
static void check_polygon(mesh_cutter *cutter, const polygon *p, bool plain)
{
    double vertices[MOST_CORNERS][3], sum[3] = {0, 0, 0}, largest = 0, total = 0;
    uint32_t corners[MOST_CORNERS], triangles[3 * MOST_CORNERS];
    put_in_space(p, plain, vertices);
    for (uint32_t i = 0; i < p->count; i++) {
        corners[i] = i;
        for (int k = 0; k < 3; k++) {
            largest = fmax(largest, fabs(vertices[i][k]));
        }
    }
    assert_true(mesh_cut(cutter, vertices[0], corners, p->count, triangles));
    check_edges(p->count, triangles);
    for (uint32_t i = 0; i < p->count - 2; i++) {
        const uint32_t *t = triangles + (size_t)3 * i;
        total += add_area(vertices[t[0]], vertices[t[1]], vertices[t[2]], sum);
    }
    const double area = sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    const double allowed = 32 * p->count * DBL_EPSILON * largest * largest;
    if (!(fabs(total - area) <= allowed)) {
        for (uint32_t i = 0; i < p->count; i++) {
            print_message("%.17g %.17g\n", p->at[i][0], p->at[i][1]);
        }
        fail_msg("%u corners: its triangles cover %g, not %g", p->count, total, area);
    }
}

static void test_polygons(void **state)
{
    (void)state;
    static void (*const makers[])(polygon *) = {star, grown, comb, keyholes};
    mesh_cutter cutter = {0};
    for (int i = 0; i < POLYGONS * 4; i++) {
        polygon p;
        makers[i % 4](&p);
        shuffle(&p);
        check_polygon(&cutter, &p, i % 4 == 2 || whole(2) == 0);
        if (cutter.not_simple != 0) {
            fail_msg("polygon %d, which is simple, is taken for one that crosses itself", i);
        }
    }
    mesh_cutter_free(&cutter);
}

/* Those that are no polygons at all become as many triangles, and end. */
static void test_odd_polygons(void **state)
{
    (void)state;
    mesh_cutter cutter = {.most_work = 10000000};
    for (int i = 0; i < POLYGONS; i++) {
        double vertices[MOST_CORNERS][3];
        uint32_t corners[MOST_CORNERS], triangles[3 * MOST_CORNERS];
        const uint32_t count = 3 + whole(MOST_CORNERS - 3), kinds = 1 + whole(5);
        for (uint32_t k = 0; k < count; k++) {
            corners[k] = whole(count);
            for (int axis = 0; axis < 3; axis++) {
                const uint32_t kind = whole(kinds);
                vertices[k][axis] = kind == 0   ? (double)whole(3)
                                    : kind == 1 ? real(-1, 1)
                                    : kind == 2 ? real(-1, 1) * 1e300
                                    : kind == 3 ? real(-1, 1) * 1e-310
                                                : (double)NAN;
            }
        }
        assert_true(mesh_cut(&cutter, vertices[0], corners, count, triangles));
        for (uint32_t k = 0; k < 3 * (count - 2); k++) {
            assert_true(triangles[k] < count);
        }
    }
    mesh_cutter_free(&cutter);
}

int main(void)
{
    numbers = random_start(1, 0, 0);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_numbers),  cmocka_unit_test(test_words),
        cmocka_unit_test(test_locale),   cmocka_unit_test(test_memory),
        cmocka_unit_test(test_polygons), cmocka_unit_test(test_odd_polygons),
    };
    return cmocka_run_group_tests_name("mesh_parts", tests, NULL, NULL);
}
