/* SPDX-License-Identifier: Apache-2.0
 *
 * Threads: many query one structure, many build at the same time, some with small stacks.
 */
#include <pthread.h>
#include <stdlib.h>

#include "cmocka_all.h"
#include "compare.h"

enum { THREADS = 16, RAYS = 150 };

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
    struct dice d = dice_from(9, 9);
    uint64_t hash = HASH_START;
    for (uint64_t i = 0; i < RAYS; i++) {
        const accel_ray ray = ray_families->make(s, a, &d, i);
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

static void test_together(void **state)
{
    (void)state;
    struct test_scene s;
    struct tested *list;
    const size_t count = tested_configs(&list);
    scene_make(&s, scene_maker_find("mixed"), test_seed());
    const uint64_t expected = judge_hash(&s);
    for (size_t i = 0; i < count; i++) {
        query_together(&s, list[i].config, expected);
        build_together(&s, list[i].config, expected);
    }
    scene_free(&s);
    free(list);
}

/* Sanitizers make frames larger. */
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
static const size_t small_stack = 1 << 20;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
static const size_t small_stack = 1 << 20;
#else
static const size_t small_stack = 128 << 10;
#endif
#else
static const size_t small_stack = 128 << 10;
#endif

/* Deep structures, built and walked on 128 KiB. */
static void test_small_stack(void **state)
{
    (void)state;
    static const char *const scenes[] = {"series", "nested-spheres", "sizes", "copies-512"};
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
        }
        scene_free(&s);
    }
    free(list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_together),
        cmocka_unit_test(test_small_stack),
    };
    return cmocka_run_group_tests_name("threads", tests, NULL, NULL);
}
