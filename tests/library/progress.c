/* SPDX-License-Identifier: Apache-2.0
 *
 * The progress of builds, whatever the machine's load: the clock that the library asks is this
 * file's, by which a second passes between two looks at it, so every report that could be made is
 * made. Progress is in 0..1, never falls in a phase, tells what is left of it, and no phase comes
 * twice.
 */
#define _DEFAULT_SOURCE /* MAP_NORESERVE */
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>

#include "cmocka_all.h"
#include "compare.h"

int clock_gettime(clockid_t clock, struct timespec *now)
{
    static time_t seconds;
    (void)clock;
    *now = (struct timespec){.tv_sec = ++seconds};
    return 0;
}

enum { MOST_PHASES = 20 };

struct phase {
    char name[40];
    double done;       /* last told */
    uint64_t told;     /* how often */
    uint64_t finished; /* how often that nearly all is done */
};

struct watch {
    struct phase phase[MOST_PHASES];
    size_t count;
    const char *wrong; /* NULL, or what */
    double before, told;
    char *arena, *end; /* addresses for the build's memory, and those not yet taken */
};

/* ----------------------------------------------------------------- memory ---- */

static const size_t arena_bytes = (size_t)1 << (sizeof(size_t) > 4 ? 33 : 29);

static void open_arena(struct watch *w)
{
    w->end = w->arena = mmap(NULL, arena_bytes, PROT_READ | PROT_WRITE,
                             MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    assert_true(w->arena != MAP_FAILED);
}

/* Each block lies above those before: what is told depends on none's address. */
static void *rising(void *user, void *old, size_t from, size_t to)
{
    struct watch *w = user;
    char *block = w->end;
    if (to == 0)
        return NULL;
    w->end += (to + 63) / 64 * 64;
    assert_true(w->end <= w->arena + arena_bytes);
    if (old)
        memcpy(block, old, from < to ? from : to);
    return block;
}

/* --------------------------------------------------------------- watching ---- */

static bool watch_progress(void *user, const char *name, double done)
{
    struct watch *w = user;
    struct phase *p = w->count > 0 ? &w->phase[w->count - 1] : NULL;
    if (!p || strcmp(p->name, name) != 0) {
        for (size_t i = 0; i < w->count; i++)
            if (strcmp(w->phase[i].name, name) == 0)
                w->wrong = "it comes again";
        assert_true(w->count < MOST_PHASES);
        p = &w->phase[w->count++];
        snprintf(p->name, sizeof p->name, "%s", name);
    }
    if (!(done >= p->done && done <= 1.0)) {
        w->wrong = "it fell or left 0..1";
        w->before = p->done;
        w->told = done;
        return false;
    }
    p->done = done;
    p->told++;
    p->finished += done > 0.99;
    return true;
}

/* Builds; no phase may say that it is done while much of it is left. */
static void watch_build(const struct test_scene *s, const char *name, const char *config)
{
    struct watch w = {.count = 0};
    const accel_hooks hooks = {.user = &w, .resize = rising, .progress = watch_progress};
    accel *a;
    accel_error error;
    open_arena(&w);
    const accel_status status = accel_build(&a, &s->scene, config, &hooks, &error);
    accel_free(a);
    munmap(w.arena, arena_bytes);
    if (w.wrong)
        fail_msg("%s on %s, phase '%s': %s (%g, then %g)", config, name, w.phase[w.count - 1].name,
                 w.wrong, w.before, w.told);
    if (status != ACCEL_OK || w.count == 0)
        fail_msg("%s on %s, %zu phases: %s", config, name, w.count, error.text);
    for (size_t i = 0; i < w.count; i++) {
        const struct phase *p = &w.phase[i];
        if (p->finished > 1 + p->told / 2)
            fail_msg("%s on %s, phase '%s': %llu of %llu times it tells that nearly all is done",
                     config, name, p->name, (unsigned long long)p->finished,
                     (unsigned long long)p->told);
    }
}

static const char *const more[] = {
    "hug:connectivity=0", "hug:form=paper",     "hug:form=paper,connectivity=0",
    "hug:density=30",     "hoo:connectivity=0", "octree:leaf=1",
    "octree:depth=8",     "bvh:isa=portable",   "bsp:leaf=1",
    "grid:density=9",
};

static void watch_scene(const struct test_scene *s, const char *name)
{
    struct tested *list;
    const size_t count = tested_configs(&list);
    for (size_t i = 0; i < count; i++)
        if (list[i].form)
            watch_build(s, name, list[i].config);
    free(list);
    for (size_t i = 0; i < sizeof more / sizeof *more; i++) {
        char kind[20];
        snprintf(kind, sizeof kind, "%.*s", (int)strcspn(more[i], ":"), more[i]);
        if (kind_is_there(kind))
            watch_build(s, name, more[i]);
    }
}

/* Balls of triangles of all sizes in each other and beside each other: clusters, some nested, some
 * with crowded cells. */
static void make_crowd(struct test_scene *s, uint32_t balls)
{
    struct rng d = rng_from(test_seed(), 1);
    scene_open(s);
    struct part *p = scene_part(s, ACCEL_TRIANGLES);
    for (uint32_t i = 0; i < balls; i++) {
        const double centre[3] = {rng_unit(&d), rng_unit(&d), rng_unit(&d)};
        ball_mesh(p, centre, exp2(-2 - 10 * rng_unit(&d)), 3);
    }
    scene_close(s);
}

static void test_catalogue(void **state)
{
    (void)state;
    static const char *const scenes[] = {"shards-100k", "copies-65536", "split-65536", "mixed"};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct test_scene s;
        scene_make(&s, scene_maker_find(scenes[i]), test_seed());
        watch_scene(&s, scenes[i]);
        scene_free(&s);
    }
}

static void test_crowd(void **state)
{
    (void)state;
    struct test_scene s;
    make_crowd(&s, (uint32_t)scaled_count(400));
    watch_scene(&s, "crowd");
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_catalogue),
        cmocka_unit_test(test_crowd),
    };
    return cmocka_run_group_tests_name("progress", tests, NULL, NULL);
}
