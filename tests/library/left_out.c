/* SPDX-License-Identifier: Apache-2.0
 *
 * What a scene has no need of is not built, and accel_describe says so, with bytes and seconds: no
 * tree above one cluster, lists for short clusters, no callbacks for triangles, no empty cells.
 */
#include <string.h>

#include "cmocka_all.h"
#include "compare.h"

static const char *const all_kinds[] = {"linear", "grid", "hug", "octree",
                                        "hoo",    "bsp",  "bvh", NULL};

/* Something that is left out, of which scene, by which kinds. */
static const struct expected {
    const char *scene, *words;
    const char *const *kinds; /* NULL-ended configs */
    bool saves;               /* bytes */
    bool absent;              /* no kind may say so */
} expectations[] = {
    {"ball-mesh", "only triangles: no callback path", all_kinds, false, false},
    {"ball-mesh", "one geometry: no table", all_kinds, true, false},
    {"ball-mesh", "one cluster: no tree above", (const char *const[]){"hoo:form=classic", NULL},
     true, false},
    {"ball-mesh", "one cluster: no grid above", (const char *const[]){"hug", NULL}, true, false},
    {"ball-mesh", "cells are empty: not stored",
     (const char *const[]){"grid", "hug", "octree:form=classic", "hoo:form=classic", "bsp", NULL},
     true, false},
    {"ball-mesh", "in the leaves alone", (const char *const[]){"octree", "hoo", "bvh", NULL}, true,
     false},
    {"one-sphere", "few primitives: a list",
     (const char *const[]){"octree:form=classic", "bsp", NULL}, true, false},
    {"one-sphere", "few primitives: a leaf", (const char *const[]){"octree", "hoo", "bvh", NULL},
     true, false},
    {"one-sphere", "only triangles", all_kinds, false, true},
    {"mixed", "only triangles", all_kinds, false, true},
    {"mixed", "one geometry", all_kinds, false, true},
};

/* An option that the form does not read is named. */
static void idle_options_are_named(void **state)
{
    (void)state;
    static const char *const said[][2] = {
        {"octree:form=wide,root=scene", "root has no effect with form=wide"},
        {"octree:leaf=8,isa=portable", "isa has no effect with form=classic"},
        {"hoo:form=wide,lazy=on", "lazy has no effect with form=wide"},
        {"hoo:form=classic,part=100", "part has no effect with lazy=off"},
        {"hug:cells=9", "cells has no effect with form=density"},
        {"hug:form=paper,density=3", "density has no effect with form=paper"},
        {"hoo:leaf=8", NULL},
        {"octree", NULL},
        {"hug", NULL},
    };
    struct test_scene s;
    scene_make(&s, scene_maker_find("one-sphere"), test_seed());
    for (size_t i = 0; i < sizeof said / sizeof *said; i++) {
        accel *a;
        accel_info info;
        accel_error error;
        bool found = false, any = false;
        char kind[16] = "";
        memcpy(kind, said[i][0], strcspn(said[i][0], ":"));
        if (!kind_is_there(kind))
            continue;
        assert_int_equal(accel_build(&a, &s.scene, said[i][0], NULL, &error), ACCEL_OK);
        accel_describe(a, &info);
        for (uint32_t k = 0; k < info.note_count; k++) {
            any = any || strstr(info.notes[k], "no effect");
            found = found || (said[i][1] && strcmp(info.notes[k], said[i][1]) == 0);
        }
        if (any != (said[i][1] != NULL) || found != any)
            fail_msg("%s: notes", said[i][0]);
        accel_free(a);
    }
    scene_free(&s);
}

static void check(const struct expected *e, const struct test_scene *s, const char *kind)
{
    accel *a = must_build(s, kind);
    accel_info info;
    accel_describe(a, &info);
    bool said = false;
    for (uint32_t i = 0; i < info.left_out_count; i++) {
        const size_t length = strlen(info.left_out[i].what);
        assert_true(length > 0 && length < sizeof info.left_out[i].what - 1);
        assert_true(info.left_out[i].seconds >= 0 && info.left_out[i].seconds < 100.0);
        if (!strstr(info.left_out[i].what, e->words))
            continue;
        said = true;
        assert_true(e->saves == (info.left_out[i].bytes > 0));
        assert_true(e->saves == (info.left_out[i].seconds > 0));
    }
    if (said == e->absent)
        fail_msg("%s of %s %s '%s'", kind, e->scene, said ? "says" : "does not say", e->words);
    accel_free(a);
}

static bool config_is_there(const char *config)
{
    char kind[20];
    snprintf(kind, sizeof kind, "%.*s", (int)strcspn(config, ":"), config);
    return kind_is_there(kind);
}

static void test_expectations(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof expectations / sizeof *expectations; i++) {
        struct test_scene s;
        scene_make(&s, scene_maker_find(expectations[i].scene), test_seed());
        for (const char *const *kind = expectations[i].kinds; *kind; kind++)
            if (config_is_there(*kind))
                check(&expectations[i], &s, *kind);
        scene_free(&s);
    }
}

/* Two balls far apart and one triangle alone: octrees for the balls, a tree above, and a list. */
static void test_short_cluster(void **state)
{
    (void)state;
    static const double left[3] = {-100.0, 0.0, 0.0}, right[3] = {100.0, 0.0, 0.0};
    static const double alone[3][3] = {{0.0, 50.0, 0.0}, {0.1, 50.0, 0.0}, {0.0, 50.1, 0.0}};
    static const char *const configs[][2] = {
        {"hoo:form=classic", "1 of 3 clusters are short: lists"},
        {"hug:form=density", "1 of 3 clusters are short: items"},
    };
    struct test_scene s;
    scene_open(&s);
    struct part *p = scene_part(&s, ACCEL_TRIANGLES);
    ball_mesh(p, left, 1.0, 3);
    ball_mesh(p, right, 1.0, 3);
    part_triangle(p, alone[0], alone[1], alone[2]);
    scene_close(&s);
    for (size_t i = 0; i < sizeof configs / sizeof *configs; i++) {
        const struct expected list = {"two balls", configs[i][1], NULL, true, false};
        const struct expected tree = {"two balls", "one cluster", NULL, true, true};
        char config[60];
        snprintf(config, sizeof config, "%s,connectivity=0,octaves=64", configs[i][0]);
        if (!config_is_there(configs[i][0]))
            continue;
        check(&list, &s, config);
        check(&tree, &s, config);
    }
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_expectations),
        cmocka_unit_test(test_short_cluster),
        cmocka_unit_test(idle_options_are_named),
    };
    return cmocka_run_group_tests_name("left_out", tests, NULL, NULL);
}
