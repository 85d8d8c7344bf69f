/* SPDX-License-Identifier: Apache-2.0
 *
 * Builds that fail: every allocation in turn, cancelled at progress calls, silent for too long.
 * Nothing is held afterwards, nothing is handed out, and a build that got through is right. Where
 * rays build, they are answered as ever.
 */
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "cmocka_all.h"
#include "compare.h"

/* An allocator that checks the sizes that it is given, always moves a block, poisons what is freed
 * and fails as told. */
struct checker {
    size_t held, blocks;
    uint64_t calls;   /* that ask for memory */
    uint64_t fail_at; /* the call that fails, from 1; 0: none */
    bool fail_on;     /* all after it fail as well */
    bool wrong;       /* a size or a block was not what was handed out */
};

struct head {
    size_t size;
    uint64_t magic;
};

static const uint64_t magic = 0x616c6c6f63617465;

static void release(struct checker *c, struct head *h)
{
    c->held -= h->size;
    c->blocks--;
    memset(h, 0xdd, sizeof *h + h->size);
    free(h);
}

static void *checked(void *user, void *old, size_t from, size_t to)
{
    struct checker *c = user;
    struct head *h = old ? (struct head *)old - 1 : NULL;
    if (h ? h->magic != magic || h->size != from : from != 0)
        c->wrong = true;
    if (to == 0) {
        if (h)
            release(c, h);
        return NULL;
    }
    c->calls++;
    if (c->fail_at && (c->calls == c->fail_at || (c->fail_on && c->calls > c->fail_at)))
        return NULL;
    struct head *made = must_resize(NULL, sizeof *made + to);
    *made = (struct head){to, magic};
    memset(made + 1, 0xcc, to);
    c->held += to;
    c->blocks++;
    if (h) {
        memcpy(made + 1, old, from < to ? from : to);
        release(c, h);
    }
    return made + 1;
}

static uint64_t hash_answers(const accel *a, const struct test_scene *s)
{
    struct rng d = rng_from(5, 5);
    uint64_t hash = HASH_START;
    for (uint64_t i = 0; i < 50; i++) {
        const accel_ray ray = ray_families->make(&s->target, a, &d, i);
        const struct answer answer = ask(a, &ray, true);
        hash = answer_hash(hash, &answer);
    }
    return hash;
}

static void check_clean(const struct checker *c, const char *config, uint64_t at)
{
    if (c->held != 0 || c->blocks != 0 || c->wrong)
        fail_msg("%s, allocation %llu failing: %zu bytes in %zu blocks are left%s", config,
                 (unsigned long long)at, c->held, c->blocks, c->wrong ? ", a size was wrong" : "");
}

/* Returns whether the build got through. */
static bool build_failing(const struct test_scene *s, const char *config, struct checker *c,
                          uint64_t expected)
{
    const accel_hooks hooks = {.user = c, .resize = checked};
    const uint64_t at = c->fail_at;
    accel *a = (accel *)&a;
    accel_error error;
    const accel_status status = accel_build(&a, &s->scene, config, &hooks, &error);
    assert_int_equal(status, error.status);
    if (status == ACCEL_OK) {
        c->fail_at = 0;
        assert_int_equal(accel_validate(a, &error), ACCEL_OK);
        assert_int_equal(hash_answers(a, s), expected);
        accel_free(a);
    } else {
        assert_int_equal(status, ACCEL_NO_MEMORY);
        assert_null(a);
        if (!strstr(error.text, "no memory for") || !strstr(error.text, "bytes") ||
            !strstr(error.text, "nothing was built") || !strstr(error.text, "phase") ||
            !strpbrk(error.text, "123456789"))
            fail_msg("%s: %s", config, error.text);
    }
    check_clean(c, config, at);
    return status == ACCEL_OK;
}

static void fail_each(const struct test_scene *s, const char *config)
{
    struct checker count = {.held = 0};
    accel *judge = must_build(s, "linear");
    const uint64_t expected = hash_answers(judge, s);
    accel_free(judge);
    assert_true(build_failing(s, config, &count, expected));
    const uint64_t step = count.calls / scaled_count(150) + 1;
    bool failed = false;
    for (uint64_t at = 1; at <= count.calls; at += step) {
        for (int on = 0; on < 2; on++) {
            struct checker c = {.fail_at = at, .fail_on = on};
            failed |= !build_failing(s, config, &c, expected);
        }
    }
    assert_true(failed);
}

static void test_memory(void **state)
{
    (void)state;
    static const char *const scenes[] = {"mixed", "degenerate", "lattice", "empty", "two-objects"};
    struct tested *list;
    const size_t count = tested_configs(&list);
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct test_scene s;
        scene_make(&s, scene_maker_find(scenes[i]), test_seed());
        for (size_t j = 0; j < count; j++)
            fail_each(&s, list[j].config);
        scene_free(&s);
    }
    free(list);
}

/* ------------------------------------------------------- memory while rays build ---- */

/* Queries, with `c` failing from now on as it is told; then, memory being back, until all is built
 * that those rays build. */
static void grow_failing(const struct test_scene *s, const char *config, struct checker *c,
                         uint64_t expected, accel_info *end)
{
    enum { PATIENCE = 12 };
    const accel_hooks hooks = {.user = c, .resize = checked};
    const struct checker told = *c;
    accel *a;
    c->fail_at = 0;
    assert_int_equal(accel_build(&a, &s->scene, config, &hooks, NULL), ACCEL_OK);
    c->fail_at = told.fail_at > 0 ? c->calls + told.fail_at : 0;
    const uint64_t built = c->calls;
    assert_int_equal(hash_answers(a, s), expected);
    c->calls -= built;
    c->fail_at = 0;
    assert_int_equal(accel_validate(a, NULL), ACCEL_OK);
    const uint64_t needed = c->calls;
    for (int i = 0; i < PATIENCE; i++)
        assert_int_equal(hash_answers(a, s), expected);
    c->calls = needed;
    accel_describe(a, end);
    assert_int_equal(end->bytes, c->held);
    accel_free(a);
    check_clean(c, config, told.fail_at);
}

static void grow_failing_each(const struct test_scene *s, const char *config)
{
    accel *judge = must_build(s, "linear");
    const uint64_t expected = hash_answers(judge, s);
    accel_free(judge);
    struct checker count = {.held = 0};
    accel_info whole, now;
    grow_failing(s, config, &count, expected, &whole);
    assert_true(count.calls > 0 && whole.lazy_bytes > 0);
    const uint64_t step = count.calls / scaled_count(150) + 1;
    for (uint64_t at = 1; at <= count.calls; at += step) {
        for (int on = 0; on < 2; on++) {
            struct checker c = {.fail_at = at, .fail_on = on};
            grow_failing(s, config, &c, expected, &now);
            if (now.nodes != whole.nodes || now.references != whole.references ||
                now.bytes != whole.bytes || now.unbuilt_primitives != whole.unbuilt_primitives)
                fail_msg("%s, allocation %llu of the rays failing: another structure", config,
                         (unsigned long long)at);
        }
    }
}

static void test_memory_of_rays(void **state)
{
    (void)state;
    static const char *const scenes[] = {"mixed", "lattice", "shards", "two-objects"};
    static const char *const configs[] = {"hoo:lazy=on", "hoo:lazy=on,part=1",
                                          "hoo:lazy=on,part=30", "hoo:lazy=on,connectivity=0"};
    if (!kind_is_there("hoo"))
        skip();
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct test_scene s;
        scene_make(&s, scene_maker_find(scenes[i]), test_seed());
        for (size_t j = 0; j < sizeof configs / sizeof *configs; j++)
            grow_failing_each(&s, configs[j]);
        scene_free(&s);
    }
}

/* ---------------------------------------------------------------- progress ---- */

struct watch {
    struct checker memory; /* the first member: the hooks share their user */
    uint64_t calls, stop_at;
    char phase[60];
    double done;
    bool wrong;          /* done was not in 0..1, or fell */
    const char *awaited; /* a phase, or NULL */
    uint64_t heard;      /* calls in it */
    struct timespec last;
    double longest; /* processor time between two calls, in seconds */
};

static double since(struct timespec *last)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    const double seconds =
        (double)(now.tv_sec - last->tv_sec) + 1e-9 * (double)(now.tv_nsec - last->tv_nsec);
    *last = now;
    return seconds;
}

static bool watch_progress(void *user, const char *phase, double done)
{
    struct watch *w = user;
    w->longest = fmax(w->longest, since(&w->last));
    if (strcmp(phase, w->phase) != 0) {
        snprintf(w->phase, sizeof w->phase, "%s", phase);
        w->done = 0;
    }
    if (!(done >= w->done && done <= 1.0))
        w->wrong = true;
    w->done = done;
    w->heard += w->awaited && strcmp(phase, w->awaited) == 0;
    return ++w->calls != w->stop_at;
}

static accel_status build_watched(const struct test_scene *s, const char *config, struct watch *w,
                                  accel_error *error)
{
    const accel_hooks hooks = {.user = w, .resize = checked, .progress = watch_progress};
    accel *a;
    since(&w->last);
    w->longest = 0;
    const accel_status status = accel_build(&a, &s->scene, config, &hooks, error);
    w->longest = fmax(w->longest, since(&w->last));
    accel_free(a);
    check_clean(&w->memory, config, 0);
    if (w->wrong)
        fail_msg("%s: progress fell or left 0..1 in phase '%s'", config, w->phase);
    return status;
}

/* Ten milliseconds are promised, about; sanitizers, this checking allocator and a busy machine
 * make everything slower. MemorySanitizer follows each byte that the allocator fills and moves. */
#if defined(__has_feature)
#if __has_feature(memory_sanitizer)
static const double longest_silence = 1;
#define KNOWS_LONGEST_SILENCE
#endif
#endif
#if !defined(KNOWS_LONGEST_SILENCE)
static const double longest_silence = 0.25;
#endif

static void cancel_each(const struct test_scene *s, const char *config)
{
    struct watch all = {.calls = 0};
    accel_error error;
    assert_int_equal(build_watched(s, config, &all, &error), ACCEL_OK);
    if (all.longest > longest_silence)
        fail_msg("%s: no progress for %.3f seconds", config, all.longest);
    for (uint64_t at = 1; at < all.calls; at += at < 4 ? 1 : all.calls / 6 + 1) {
        struct watch w = {.stop_at = at};
        const accel_status status = build_watched(s, config, &w, &error);
        if (w.calls < at)
            continue; /* this time the build was faster */
        assert_int_equal(status, ACCEL_CANCELLED);
        assert_int_equal(w.calls, at);
        if (!strstr(error.text, "cancelled in phase") || !strstr(error.text, "nothing was built"))
            fail_msg("%s: %s", config, error.text);
        if (w.longest > longest_silence)
            fail_msg("%s: cancelled after %.3f seconds", config, w.longest);
    }
}

static void test_cancel(void **state)
{
    (void)state;
    static const char *const scenes[] = {"shards-100k", "copies-65536"};
    size_t count;
    const accel_kind_info *const *kind = accel_kinds(&count);
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct test_scene s;
        scene_make(&s, scene_maker_find(scenes[i]), test_seed());
        for (size_t j = 0; j < count; j++)
            cancel_each(&s, kind[j]->name);
        scene_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_memory),
        cmocka_unit_test(test_memory_of_rays),
        cmocka_unit_test(test_cancel),
    };
    return cmocka_run_group_tests_name("failing_builds", tests, NULL, NULL);
}
