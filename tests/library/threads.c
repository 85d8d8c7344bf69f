/* SPDX-License-Identifier: Apache-2.0
 *
 * Threads: many query one structure, many build at the same time, some with small stacks; many
 * enter what is not built yet.
 */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cmocka_all.h"
#include "compare.h"

enum { THREADS = 16 };

/* One thread's work. */
struct worker {
    const struct test_scene *scene;
    const accel *a;     /* NULL: builds its own of `config` */
    const char *config; /* what to build */
    uint64_t hash;      /* of the answers */
    accel_status status;
};

static uint64_t hash_answers(const accel *a, const struct test_scene *s)
{
    struct rng d = rng_from(9, 9);
    uint64_t hash = HASH_START;
    for (uint64_t i = 0; i < scaled_count(150); i++) {
        const accel_ray ray = ray_families->make(&s->target, a, &d, i);
        const struct answer answer = ask(a, &ray, true);
        hash = answer_hash(hash, &answer);
    }
    return hash;
}

static void *work(void *user)
{
    struct worker *w = user;
    accel *own = NULL;
    if (!w->a)
        w->status = accel_build(&own, &w->scene->scene, w->config, NULL, NULL);
    if (w->status == ACCEL_OK)
        w->hash = hash_answers(w->a ? w->a : own, w->scene);
    accel_free(own);
    return NULL;
}

static void run(struct worker *workers, size_t count, size_t stack)
{
    pthread_t thread[THREADS];
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    if (stack)
        assert_int_equal(pthread_attr_setstacksize(&attributes, stack), 0);
    for (size_t i = 0; i < count; i++)
        assert_int_equal(pthread_create(&thread[i], &attributes, work, &workers[i]), 0);
    for (size_t i = 0; i < count; i++)
        pthread_join(thread[i], NULL);
    pthread_attr_destroy(&attributes);
}

static void check(const struct worker *workers, size_t count, uint64_t expected)
{
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(workers[i].status, ACCEL_OK);
        if (workers[i].hash != expected)
            fail_msg("%s: thread %zu answers differently", workers[i].config, i);
    }
}

static uint64_t judge_hash(const struct test_scene *s)
{
    accel *judge = must_build(s, "linear");
    const uint64_t hash = hash_answers(judge, s);
    accel_free(judge);
    return hash;
}

static void query_together(const struct test_scene *s, const char *config, uint64_t expected)
{
    accel *a = must_build(s, config);
    static const size_t counts[] = {2, 5, THREADS};
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
        struct worker workers[THREADS];
        for (size_t i = 0; i < counts[c]; i++)
            workers[i] = (struct worker){s, a, config, 0, ACCEL_OK};
        run(workers, counts[c], 0);
        check(workers, counts[c], expected);
    }
    accel_free(a);
}

static void build_together(const struct test_scene *s, const char *config, uint64_t expected)
{
    struct worker workers[4];
    accel *a = must_build(s, config);
    for (size_t i = 0; i < 4; i++)
        workers[i] = (struct worker){s, i == 0 ? a : NULL, config, 0, ACCEL_OK};
    run(workers, 4, 0);
    check(workers, 4, expected);
    accel_free(a);
}

/* All configs, or the forms alone. */
static void try_together(const char *scene, bool all)
{
    struct test_scene s;
    struct tested *list;
    const size_t count = tested_configs(&list);
    scene_make(&s, scene_maker_find(scene), test_seed());
    const uint64_t expected = judge_hash(&s);
    for (size_t i = 0; i < count; i++) {
        if (!all && !list[i].form)
            continue;
        query_together(&s, list[i].config, expected);
        build_together(&s, list[i].config, expected);
    }
    scene_free(&s);
    free(list);
}

static void test_together(void **state)
{
    (void)state;
    try_together("mixed", true);
    try_together("stack", false);
    try_together("twins", false);
}

/* ---------------------------------------------------- structures that rays build ---- */

/* One of those that start together. */
struct crowd {
    pthread_barrier_t *start;
    const accel *a;
    const accel_ray *rays;
    uint64_t first; /* where it begins, so that some build the same and some do not */
    uint64_t hash;  /* of the answers, in whatever order */
};

static uint64_t crowd_rays(void)
{
    return scaled_count(300);
}

static void *join_crowd(void *user)
{
    struct crowd *w = user;
    const uint64_t count = crowd_rays();
    pthread_barrier_wait(w->start);
    for (uint64_t i = 0; i < count; i++) {
        const struct answer answer = ask(w->a, &w->rays[(w->first + i) % count], true);
        w->hash += answer_hash(HASH_START, &answer);
    }
    return NULL;
}

/* Describes and validates what others are building. */
static void *watch_crowd(void *user)
{
    struct crowd *w = user;
    uint64_t built = 0;
    pthread_barrier_wait(w->start);
    for (int i = 0; i < 20; i++) {
        accel_info info;
        accel_error error;
        accel_describe(w->a, &info);
        w->hash += info.lazy_bytes < built;
        built = info.lazy_bytes;
        w->hash += accel_validate(w->a, &error) != ACCEL_OK;
    }
    return NULL;
}

static accel_info grow_by(const struct test_scene *s, const char *config, size_t threads,
                          const accel_ray *rays, uint64_t expected)
{
    struct crowd crowd[THREADS + 1];
    pthread_t thread[THREADS + 1];
    pthread_barrier_t start;
    accel *a = must_build(s, config);
    pthread_barrier_init(&start, NULL, (unsigned)threads + 1);
    for (size_t i = 0; i <= threads; i++) {
        crowd[i] = (struct crowd){&start, a, rays, i / 2 * 31, 0};
        assert_int_equal(
            pthread_create(&thread[i], NULL, i < threads ? join_crowd : watch_crowd, &crowd[i]), 0);
    }
    for (size_t i = 0; i <= threads; i++)
        pthread_join(thread[i], NULL);
    pthread_barrier_destroy(&start);
    for (size_t i = 0; i <= threads; i++)
        if (crowd[i].hash != (i < threads ? expected : 0))
            fail_msg("%s: thread %zu of %zu %s", config, i, threads,
                     i < threads ? "answers differently" : "saw a broken structure");
    accel_info info;
    accel_describe(a, &info);
    accel_free(a);
    return info;
}

/* However many threads, the answers are linear's and the structure is the same. */
static void grow_together(const struct test_scene *s, const char *config, const accel_ray *rays,
                          uint64_t expected)
{
    const accel_info alone = grow_by(s, config, 1, rays, expected);
    for (int turn = 0; turn < 3; turn++) {
        const accel_info info = grow_by(s, config, turn == 0 ? 2 : THREADS, rays, expected);
        assert_int_equal(info.nodes, alone.nodes);
        assert_int_equal(info.leaves, alone.leaves);
        assert_int_equal(info.references, alone.references);
        assert_int_equal(info.depth, alone.depth);
        assert_int_equal(info.bytes, alone.bytes);
        assert_int_equal(info.unbuilt_primitives, alone.unbuilt_primitives);
    }
}

static void test_grow_together(void **state)
{
    (void)state;
    static const char *const scenes[] = {"shards", "mixed", "terrain"};
    static const char *const configs[] = {"hoo:lazy=on", "hoo:lazy=on,part=1",
                                          "hoo:lazy=on,part=50", "hoo:lazy=on,connectivity=0"};
    if (!kind_is_there("hoo"))
        skip();
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct test_scene s;
        accel_ray *rays = must_resize(NULL, crowd_rays() * sizeof *rays);
        scene_make(&s, scene_maker_find(scenes[i]), test_seed());
        accel *judge = must_build(&s, "linear");
        struct rng d = rng_from(test_seed(), 3);
        uint64_t expected = 0;
        for (uint64_t r = 0; r < crowd_rays(); r++) {
            rays[r] = ray_families->make(&s.target, judge, &d, r);
            const struct answer answer = ask(judge, &rays[r], true);
            expected += answer_hash(HASH_START, &answer);
        }
        for (size_t j = 0; j < sizeof configs / sizeof *configs; j++)
            grow_together(&s, configs[j], rays, expected);
        free(rays);
        accel_free(judge);
        scene_free(&s);
    }
}

/* Sanitizers make frames larger. */
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
static const size_t small_stack = 1 << 20;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) ||                         \
    __has_feature(memory_sanitizer)
static const size_t small_stack = 1 << 20;
#else
static const size_t small_stack = 128 << 10;
#endif
#else
static const size_t small_stack = 128 << 10;
#endif

/* Deep structures, built and walked on 128 KiB; or walked alone, and built by what walks, on half.
 */
static void test_small_stack(void **state)
{
    (void)state;
    static const char *const scenes[] = {"series",           "nested-spheres", "nested-boxes",
                                         "nested-triangles", "sizes",          "copies-512"};
    struct tested *list;
    const size_t count = tested_configs(&list);
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct test_scene s;
        scene_make(&s, scene_maker_find(scenes[i]), test_seed());
        const uint64_t expected = judge_hash(&s);
        for (size_t j = 0; j < count; j++) {
            struct worker w = {&s, NULL, list[j].config, 0, ACCEL_OK};
            run(&w, 1, small_stack);
            check(&w, 1, expected);
            w.a = must_build(&s, list[j].config);
            run(&w, 1, small_stack / 2);
            check(&w, 1, expected);
            accel_free((accel *)w.a);
        }
        scene_free(&s);
    }
    free(list);
}

/* Answers and the work that they took: the same if the structure is. */
static uint64_t hash_work(const accel *a, const struct test_scene *s)
{
    struct rng d = rng_from(9, 9);
    uint64_t hash = HASH_START;
    for (uint64_t i = 0; i < scaled_count(2000); i++) {
        const accel_ray ray = ray_families->make(&s->target, a, &d, i);
        accel_query query = {0};
        accel_hit hit = {.prim = 0};
        accel_closest(a, &ray, &hit, &query);
        hash = 31 * hash + 7 * query.nodes + query.tests + hit.prim;
    }
    return hash;
}

/* A build by several threads makes what one makes. */
static void test_team(void **state)
{
    (void)state;
    static const char *const configs[] = {"bvh", "octree", "hoo", "bvh:isa=portable"};
    struct test_scene s;
    scene_make(&s, scene_maker_find("shards-100k"), test_seed());
    for (size_t i = 0; i < sizeof configs / sizeof *configs; i++) {
        char kind[20];
        uint64_t expected = 0;
        snprintf(kind, sizeof kind, "%.*s", (int)strcspn(configs[i], ":"), configs[i]);
        for (unsigned threads = 1; threads < 9 && kind_is_there(kind); threads += 1 + threads / 3) {
            const accel_hooks hooks = {.threads = threads};
            accel *a;
            accel_error error;
            if (accel_build(&a, &s.scene, configs[i], &hooks, &error) != ACCEL_OK)
                fail_msg("%s with %u threads: %s", configs[i], threads, error.text);
            const uint64_t hash = hash_work(a, &s);
            accel_free(a);
            expected = threads == 1 ? hash : expected;
            if (hash != expected)
                fail_msg("%s: %u threads build something else than one", configs[i], threads);
        }
    }
    scene_free(&s);
}

static bool stop_in_tree(void *user, const char *phase, double done)
{
    int *left = user;
    return strcmp(phase, "tree") != 0 || done == 0.0 || --*left > 0;
}

/* One that is cancelled waits for all of its threads. */
static void test_team_stops(void **state)
{
    (void)state;
    struct test_scene s;
    scene_make(&s, scene_maker_find("shards-100k"), test_seed());
    for (int calls = 1; calls < 6 && kind_is_there("bvh"); calls++) {
        int left = calls;
        const accel_hooks hooks = {.user = &left, .progress = stop_in_tree, .threads = 4};
        accel *a;
        const accel_status status = accel_build(&a, &s.scene, "bvh", &hooks, NULL);
        assert_int_equal(status, left > 0 ? ACCEL_OK : ACCEL_CANCELLED);
        accel_free(a);
    }
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_together),    cmocka_unit_test(test_grow_together),
        cmocka_unit_test(test_small_stack), cmocka_unit_test(test_team),
        cmocka_unit_test(test_team_stops),
    };
    return cmocka_run_group_tests_name("threads", tests, NULL, NULL);
}
