/* SPDX-License-Identifier: Apache-2.0
 *
 * Every kind, with its defaults and with each of its options, gives the answers of `linear`, bit
 * for bit: nearest, any, all hits in order, boxes at a point. One argument names the test, such
 * as scales or special-rays.
 */
#include <stdlib.h>
#include <string.h>

#include "cmocka_all.h"
#include "compare.h"

/* Options see one ray in SHARE, and one in SHARE scenes of more than LARGE primitives. */
enum { SHARE = 8, LARGE = 50000 };

/* One scene with one family of rays, and what linear says. */
struct job {
    const struct scene_maker *maker;
    const struct ray_family *family;
    uint64_t seed, count; /* of the scene; of rays */
    struct test_scene scene;
    accel_ray *rays;
    struct answer *answers;
    accel_info info; /* of the judge */
};

/* Structures that need more than this for a scene of a test have gone astray. */
static const size_t most_bytes = (size_t)1 << 30;

/* accel_all and accel_point are asked for every fourth ray. */
static bool is_deep(uint64_t i)
{
    return i % 4 == 0;
}

/* A pile of one primitive is judged by that primitive alone, any other scene by linear. */
static uint32_t copies(const struct scene_maker *m)
{
    return m->make == make_coincident ? (uint32_t)m->param : 0;
}

static accel *build_judge(const struct job *j)
{
    if (copies(j->maker) == 0)
        return must_build(&j->scene, "linear");
    struct test_scene one;
    scene_make(&one, scene_maker_find("copies-1"), j->seed);
    accel *judge = must_build(&one, "linear");
    scene_free(&one);
    return judge;
}

static void prepare(struct job *j)
{
    scene_make(&j->scene, j->maker, j->seed);
    j->rays = must_resize(NULL, j->count * sizeof *j->rays);
    j->answers = must_resize(NULL, j->count * sizeof *j->answers);
    accel *judge = build_judge(j);
    struct rng d = rng_from(j->seed, 2);
    for (uint64_t i = 0; i < j->count; i++) {
        j->rays[i] = j->family->make(&j->scene.target, judge, &d, i);
        j->answers[i] = copies(j->maker)
                            ? ask_pile(judge, &j->rays[i], copies(j->maker), is_deep(i))
                            : ask(judge, &j->rays[i], is_deep(i));
        if (!leaves_rightly(&j->scene, &j->rays[i], &j->answers[i]))
            j->answers[i].illegal = "hits what it leaves";
        if (!same_answer(&j->answers[i], &j->answers[i])) {
            report_failure(&(struct failure){j->maker->name, j->family->name, j->seed, i, "linear",
                                             &j->rays[i], &j->answers[i], &j->answers[i]},
                           &j->scene);
            fail();
        }
    }
    accel_describe(judge, &j->info);
    accel_free(judge);
}

static void finish(struct job *j)
{
    scene_free(&j->scene);
    free(j->rays);
    free(j->answers);
}

/* Raw hits before their box, of solvers that are wrong by more than their boxes are padded: the
 * header exempts them. They must stay rare, or the test would test nothing. */
static bool is_exempt(const struct job *j, uint64_t i)
{
    return j->answers[i].outside > 0;
}

static void check_exempt(const struct job *j)
{
    uint64_t exempt = 0;
    for (uint64_t i = 0; i < j->count; i++)
        exempt += is_exempt(j, i);
    if (exempt * 100 > j->count)
        fail_msg("%s, rays %s: %llu of %llu rays are exempt", j->maker->name, j->family->name,
                 (unsigned long long)exempt, (unsigned long long)j->count);
}

/* Shoots the rays first, first + step, ... */
static void shoot(const struct job *j, const accel *a, const char *config, uint64_t first,
                  uint64_t step)
{
    uint32_t wrong = 0;
    for (uint64_t i = first; i < j->count; i += step) {
        const struct answer found = ask(a, &j->rays[i], is_deep(i));
        if (is_exempt(j, i) || same_answer(&found, &j->answers[i]))
            continue;
        if (wrong++ == 0)
            report_failure(&(struct failure){j->maker->name, j->family->name, j->seed, i, config,
                                             &j->rays[i], &j->answers[i], &found},
                           &j->scene);
    }
    if (wrong > 0)
        fail_msg("%s on %s (seed %llu), rays %s: %u of %llu answers differ from linear", config,
                 j->maker->name, (unsigned long long)j->seed, j->family->name, wrong,
                 (unsigned long long)((j->count - first + step - 1) / step));
}

/* What rays have built is as right as what was built before. */
static void validate_grown(const struct job *j, const accel *a, const char *config)
{
    accel_info info;
    accel_error error;
    accel_describe(a, &info);
    if (info.lazy_bytes > 0 && accel_validate(a, &error) != ACCEL_OK)
        fail_msg("%s on %s (seed %llu), after the rays: %s", config, j->maker->name,
                 (unsigned long long)j->seed, error.text);
}

/* What a structure takes that holds nothing. */
static double empty_bytes(const char *config)
{
    struct test_scene none;
    accel_info info;
    scene_make(&none, scene_maker_find("empty"), 1);
    accel *a = must_build(&none, config);
    accel_describe(a, &info);
    accel_free(a);
    scene_free(&none);
    return (double)info.bytes;
}

/* What was left out is counted alike by all. A pile takes 200 bytes for each copy beside what an
 * empty structure takes, and a little for the first cell; not where an option asks for more. */
static void check_counts(const struct job *j, const accel *a, const struct tested *t)
{
    const char *config = t->config;
    accel_info info;
    accel_describe(a, &info);
    if (copies(j->maker)) {
        const double most = 200.0 * j->maker->param + 1024.0;
        if (t->form && (double)info.bytes > most + empty_bytes(config))
            fail_msg("%s on %s: %llu bytes", config, j->maker->name,
                     (unsigned long long)info.bytes);
        return;
    }
    if (info.primitives != scene_size(&j->scene) || info.skipped != j->info.skipped ||
        info.degenerate != j->info.degenerate || info.unbounded != j->info.unbounded ||
        memcmp(info.skipped_ids, j->info.skipped_ids, sizeof info.skipped_ids) != 0)
        fail_msg("%s on %s: what was left out is counted otherwise than by linear", config,
                 j->maker->name);
}

static void agree_one(const struct job *j, const struct tested *t, uint64_t first, uint64_t step)
{
    struct pool pool = {.most = most_bytes};
    const accel_hooks hooks = {.user = &pool, .resize = pool_resize};
    accel *a;
    accel_error error;
    if (accel_build(&a, &j->scene.scene, t->config, &hooks, &error) != ACCEL_OK)
        fail_msg("%s on %s (seed %llu): %s", t->config, j->maker->name, (unsigned long long)j->seed,
                 error.text);
    if (accel_validate(a, &error) != ACCEL_OK)
        fail_msg("%s on %s (seed %llu): %s", t->config, j->maker->name, (unsigned long long)j->seed,
                 error.text);
    check_counts(j, a, t);
    shoot(j, a, t->config, first, step);
    validate_grown(j, a, t->config);
    accel_free(a);
    assert_int_equal(pool.held, 0);
    assert_int_equal(pool.blocks, 0);
}

/* Was this what judged? Then a share of the rays will do as well. */
static bool is_judge(const struct job *j, const char *config)
{
    return strcmp(config, "linear") == 0 && copies(j->maker) == 0;
}

/* Does one option among many miss its turn? There are many variants of some scenes, and large ones
 * take long to build; below intensity 1 their forms take turns as well. */
static bool is_spared(const struct job *j, size_t i, bool form)
{
    const bool large = scene_size(&j->scene) > LARGE;
    if (form)
        return large && !takes_turn(i + j->seed);
    return (j->maker->variants || large) && (i + j->seed) % SHARE != 0;
}

/* Every kind and form sees every ray, the other options take turns: each sees a share of them. */
static void agree(const struct scene_maker *maker, const struct ray_family *family, uint64_t seed,
                  uint64_t count)
{
    struct tested *list;
    const size_t tested = tested_configs(&list);
    struct job j = {.maker = maker, .family = family, .seed = seed, .count = count};
    prepare(&j);
    check_exempt(&j);
    for (size_t i = 0; i < tested; i++) {
        const bool form = list[i].form && !is_judge(&j, list[i].config);
        if (is_spared(&j, i, form))
            continue;
        if (form)
            agree_one(&j, &list[i], 0, 1);
        else
            agree_one(&j, &list[i], count < SHARE ? 0 : i % SHARE, count < SHARE ? 1 : SHARE);
    }
    finish(&j);
    free(list);
}

/* Below intensity 1 either the variants of a scene take turns or its rays are fewer. */
static void test_scene(void **state)
{
    const struct scene_maker *maker = *state;
    const uint32_t variants = maker->variants ? maker->variants : 1;
    const uint64_t scaled = scaled_count(maker->rays);
    const uint64_t rays = variants > 1 && scaled < maker->rays ? maker->rays : scaled;
    for (uint32_t i = 0; i < variants; i++)
        if (takes_turn(i))
            agree(maker, ray_families, test_seed() + i, rays);
}

static void test_family(void **state)
{
    const struct ray_family *family = *state;
    uint64_t scenes = 0;
    while (family->scenes[scenes])
        scenes++;
    for (uint64_t i = 0; i < scenes; i++)
        agree(scene_maker_find(family->scenes[i]), family, test_seed(),
              scaled_count(family->rays / scenes));
}

static void add(struct CMUnitTest *list, size_t *count, const char *name, CMUnitTestFunction test,
                const void *what)
{
    list[(*count)++] = (struct CMUnitTest){name, test, NULL, NULL, (void *)(uintptr_t)what};
}

int main(int argc, char **argv)
{
    static struct CMUnitTest list[100];
    size_t count = 0;
    if (argc != 2) {
        fprintf(stderr,
                "usage: agree NAME of a test, a scene or a family of rays: see catalogue.h\n");
        return 2;
    }
    for (const struct scene_maker *m = scene_makers; m->name; m++)
        if (strcmp(argv[1], m->test) == 0 || strcmp(argv[1], m->name) == 0)
            add(list, &count, m->name, test_scene, m);
    for (const struct ray_family *f = ray_families + 1; f->name; f++)
        if (strcmp(argv[1], f->test) == 0 || strcmp(argv[1], f->name) == 0)
            add(list, &count, f->name, test_family, f);
    if (count == 0) {
        fprintf(stderr, "agree: no scene and no family of rays is called '%s'\n", argv[1]);
        return 2;
    }
    return _cmocka_run_group_tests(argv[1], list, count, NULL, NULL);
}
