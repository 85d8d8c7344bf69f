/* SPDX-License-Identifier: Apache-2.0
 *
 * Any scene, any kind with any options, any rays: the answers are linear's, bit for bit, in
 * whatever floating-point mode; the structure passes accel_validate before and after the rays; its
 * resolved config builds the same again; a build without memory or that is cancelled holds nothing,
 * and its progress never falls.
 */
#include <string.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include "compare.h"
#include "decode.h"
#include "modes.h"

enum { MOST_RAYS = 16, MOST_BYTES = 1 << 21 };

/* ------------------------------------------------------------------ clock ---- */

/* Builds look at the clock to tell how far they are, every few milliseconds. Here time passes at
 * each look, so that small builds tell as well, and the same on every machine. The linker sends
 * calls of clock_gettime here. */
static long hurry; /* nanoseconds for each look, or 0: the real clock */

int __wrap_clock_gettime(clockid_t clock, struct timespec *now);
int __real_clock_gettime(clockid_t clock, struct timespec *now);

int __wrap_clock_gettime(clockid_t clock, struct timespec *now)
{
    static struct timespec made;
    if (!hurry)
        return __real_clock_gettime(clock, now);
    made.tv_nsec += hurry;
    made.tv_sec += made.tv_nsec / 1000000000;
    made.tv_nsec %= 1000000000;
    *now = made;
    return 0;
}

/* ------------------------------------------------------------------ trial ---- */

/* The hooks' user: a heap, the first member, and what the progress was. */
struct watch {
    struct heap heap;
    char phase[60];
    double done;
    uint64_t calls, stop_at;
};

/* One scene, config and rays. */
struct trial {
    struct decoder d;
    struct host_scene host;
    char config[CONFIG_ROOM];
    const struct mode *mode;
    struct watch judge_watch;
    accel *judge;
    accel_ray rays[MOST_RAYS];
    struct answer answers[MOST_RAYS]; /* the judge's */
    uint32_t ray_count;
    uint8_t fate, when; /* what goes wrong with the first build, at which call */
};

static bool watch_progress(void *user, const char *phase, double done)
{
    struct watch *w = user;
    if (strcmp(w->phase, phase) != 0) {
        snprintf(w->phase, sizeof w->phase, "%s", phase);
        w->done = 0.0;
    }
    if (!(done >= w->done && done <= 1.0))
        broken("progress of phase '%s' goes from %.17g to %.17g", phase, w->done, done);
    w->done = done;
    return ++w->calls != w->stop_at;
}

static struct watch watch_start(void)
{
    return (struct watch){.heap = {.most = MOST_BYTES}};
}

static accel_status build(const struct trial *t, const char *config, struct watch *w, accel **out,
                          accel_error *error)
{
    const accel_hooks hooks = {.user = w,
                               .resize = heap_resize,
                               .progress = watch_progress,
                               .pilot = t->rays,
                               .pilot_count = t->ray_count};
    *out = (accel *)&hooks;
    mode_enter(t->mode);
    hurry = 6000000;
    const accel_status status = accel_build(out, &t->host.made.scene, config, &hooks, error);
    hurry = 0;
    if (!mode_leave_kept(t->mode))
        broken("%s: the build leaves another floating-point mode", config);
    if (status != error->status)
        broken("%s: status %d, but the error's is %d", config, (int)status, (int)error->status);
    if ((status == ACCEL_OK) != (*out != NULL))
        broken("%s: status %d, but what is built is %p", config, (int)status, (void *)*out);
    if (status != ACCEL_OK)
        check_text(error->text);
    return status;
}

static void validate(const struct trial *t, const accel *a, const char *when)
{
    accel_error error;
    mode_enter(t->mode);
    const accel_status status = accel_validate(a, &error);
    mode_leave();
    if (status != ACCEL_OK)
        broken("%s, %s, %s: %s", t->config, t->mode->name, when, error.text);
}

static struct answer ask_in_mode(const struct trial *t, const accel *a, const accel_ray *ray)
{
    mode_enter(t->mode);
    const struct answer answer = ask(a, ray, true);
    mode_leave();
    return answer;
}

/* ---------------------------------------------------------- nested queries ---- */

/* What the next callback asks of the structure that asks it; NULL: nothing. */
static const accel *asked;

static void intersect_and_ask(accel_probe *probe)
{
    const accel *a = asked;
    asked = NULL;
    if (a)
        accel_any(a, probe->ray, NULL);
    test_object_intersect(probe);
}

static void ask_from_callbacks(struct trial *t)
{
    for (uint32_t g = 0; g < t->host.made.count; g++)
        if (t->host.made.geometry[g].type == ACCEL_OBJECTS)
            t->host.made.geometry[g].objects.intersect = intersect_and_ask;
}

/* ------------------------------------------------------------------ judge ---- */

struct order {
    const struct trial *t;
    const accel_ray *ray;
    accel_hit first, last;
    uint32_t count;
};

static bool is_native(const struct trial *t, const accel_hit *hit)
{
    return t->host.made.geometry[hit->geom].type != ACCEL_OBJECTS;
}

static bool in_order(void *user, const accel_hit *hit)
{
    struct order *o = user;
    if (!(hit->t > o->ray->tmin && hit->t < o->ray->tmax))
        broken("linear: a hit at %a outside its interval", hit->t);
    if (o->count++ == 0)
        o->first = *hit;
    else if (is_native(o->t, hit) && is_native(o->t, &o->last) &&
             (hit->t < o->last.t ||
              (hit->t == o->last.t && (hit->geom < o->last.geom ||
                                       (hit->geom == o->last.geom && hit->prim <= o->last.prim)))))
        broken("linear: a hit at %a comes after one at %a", hit->t, o->last.t);
    o->last = *hit;
    return o->count < KEPT;
}

/* What the other kinds cannot tell of the judge, as they ask the same code: the first of all hits
 * is the nearest, all are in order, and before the nearest there is none. */
static void check_judge(const struct trial *t, const accel_ray *ray, const struct answer *answer)
{
    struct order o = {.t = t, .ray = ray};
    accel_ray before = *ray;
    before.tmax = answer->closest.t;
    mode_enter(t->mode);
    accel_all(t->judge, ray, in_order, &o, NULL);
    const bool any =
        answer->hit && is_native(t, &answer->closest) && accel_any(t->judge, &before, NULL);
    mode_leave();
    if (answer->illegal)
        broken("linear: %s", answer->illegal);
    if (answer->hit != (o.count > 0) ||
        (answer->hit && memcmp(&o.first, &answer->closest, sizeof o.first) != 0))
        broken("linear: the first of all hits is not the nearest");
    if (any)
        broken("linear: a hit before the nearest");
}

static void prepare_judge(struct trial *t)
{
    accel_error error;
    t->judge_watch = watch_start();
    if (build(t, "linear", &t->judge_watch, &t->judge, &error) != ACCEL_OK)
        broken("linear: %s", error.text);
}

/* The rays, each with what the judge says: the next one may start from there. */
static void prepare_rays(struct trial *t)
{
    const accel_hit *last = NULL;
    const accel_ray *last_ray = NULL;
    while (t->d.bytes.left > 0 && t->ray_count < MOST_RAYS) {
        accel_ray *ray = &t->rays[t->ray_count];
        struct answer *answer = &t->answers[t->ray_count++];
        *ray = decode_ray(&t->d, last_ray, last);
        *answer = ask_in_mode(t, t->judge, ray);
        check_judge(t, ray, answer);
        if (answer->hit) {
            last = &answer->closest;
            last_ray = ray;
        }
    }
}

/* ------------------------------------------------------------ comparisons ---- */

static void complain(const struct trial *t, uint32_t i, const struct answer *found)
{
    const struct failure f = {"fuzz", "agree", 0, i, t->config, &t->rays[i], &t->answers[i], found};
    fprintf(stderr, "mode: %s\n", t->mode->name);
    report_failure(&f, &t->host.made);
    broken("%s, %s, ray %u: not the answer of linear", t->config, t->mode->name, i);
}

/* Where a raw hit lies before its object's box, kinds may differ: the header says so. */
static void check_answers(struct trial *t, const accel *a)
{
    for (uint32_t i = 0; i < t->ray_count; i++) {
        asked = i % 2 ? a : NULL;
        const struct answer found = ask_in_mode(t, a, &t->rays[i]);
        asked = NULL;
        if (found.illegal || (t->answers[i].outside == 0 && !same_answer(&found, &t->answers[i])))
            complain(t, i, &found);
    }
}

static void check_boxes(const struct trial *t, const accel *a)
{
    for (uint32_t g = 0; g <= t->host.made.count; g++) {
        const uint32_t count = g < t->host.made.count ? t->host.made.part[g].count : 0;
        for (uint32_t i = 0; i <= count; i++) {
            accel_box mine = {{0}, {0}}, its = {{0}, {0}};
            const bool there = accel_padded_box(a, (accel_id){g, i}, &mine);
            if (there != accel_padded_box(t->judge, (accel_id){g, i}, &its) ||
                (there && memcmp(&mine, &its, sizeof mine) != 0))
                broken("%s: the box of %u/%u is not that of linear", t->config, g, i);
        }
    }
}

static void check_counts(const struct trial *t, const accel_info *info)
{
    accel_info judge;
    accel_describe(t->judge, &judge);
    if (info->primitives != judge.primitives || info->skipped != judge.skipped ||
        info->degenerate != judge.degenerate || info->unbounded != judge.unbounded ||
        memcmp(info->skipped_ids, judge.skipped_ids, sizeof judge.skipped_ids) != 0)
        broken("%s: what was left out is counted otherwise than by linear", t->config);
}

/* The resolved config builds the same again. */
static void check_again(const struct trial *t, const accel_info *info)
{
    struct watch w = watch_start();
    accel *a;
    accel_info again;
    accel_error error;
    if (build(t, info->config, &w, &a, &error) != ACCEL_OK)
        broken("%s, resolved to %s: %s", t->config, info->config, error.text);
    accel_describe(a, &again);
    accel_free(a);
    heap_check_empty(&w.heap, info->config);
    if (strcmp(again.kind, info->kind) != 0 || strcmp(again.config, info->config) != 0 ||
        again.nodes != info->nodes || again.leaves != info->leaves ||
        again.references != info->references || again.depth != info->depth ||
        again.size_classes != info->size_classes || again.clusters != info->clusters)
        broken(
            "%s, %s, resolved to %s, which builds %s: %llu and %llu nodes, %llu and %llu leaves, "
            "%llu and %llu references",
            t->config, t->mode->name, info->config, again.config, (unsigned long long)info->nodes,
            (unsigned long long)again.nodes, (unsigned long long)info->leaves,
            (unsigned long long)again.leaves, (unsigned long long)info->references,
            (unsigned long long)again.references);
}

/* ------------------------------------------------------------------ builds ---- */

/* A build whose when-th allocation fails, or all from there on, or that is cancelled. Lazy parts
 * are built by the rays, with the same heap. */
static void check_misfortune(struct trial *t)
{
    struct watch w = watch_start();
    accel *a;
    accel_error error;
    if (t->fate == 3) {
        w.stop_at = 1 + t->when;
    } else {
        w.heap.fail_at = 1 + t->when;
        w.heap.fail_on = t->fate == 2;
    }
    const accel_status status = build(t, t->config, &w, &a, &error);
    const bool stopped = w.stop_at > 0 && w.calls >= w.stop_at;
    if (stopped ? status != ACCEL_CANCELLED
                : status != ACCEL_OK && (status != ACCEL_NO_MEMORY || w.heap.calls == 0))
        broken("%s, fate %d at %d: %s", t->config, t->fate, t->when, error.text);
    if (status == ACCEL_OK) {
        check_answers(t, a);
        w.heap.fail_at = 0;
        validate(t, a, "after rays without memory");
        check_answers(t, a);
        accel_free(a);
    }
    heap_check_empty(&w.heap, t->config);
}

static void check_build(struct trial *t)
{
    struct watch w = watch_start();
    accel *a;
    accel_info info;
    accel_error error;
    const accel_status status = build(t, t->config, &w, &a, &error);
    if (status == ACCEL_NO_MEMORY) {
        heap_check_empty(&w.heap, t->config);
        return;
    }
    if (status != ACCEL_OK)
        broken("%s: %s", t->config, error.text);
    accel_describe(a, &info);
    check_counts(t, &info);
    check_again(t, &info);
    check_boxes(t, a);
    validate(t, a, "before the rays");
    check_answers(t, a);
    validate(t, a, "after the rays");
    accel_describe(a, &info);
    if (info.bytes != w.heap.held)
        broken("%s: %llu bytes by its count, %zu by the heap's", t->config,
               (unsigned long long)info.bytes, w.heap.held);
    accel_free(a);
    heap_check_empty(&w.heap, t->config);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    struct trial t = {.d = decode_start(bytes, size)};
    const uint8_t how = take(&t.d.bytes);
    t.mode = &modes[how & 32 ? how >> 2 & 7 : 0];
    t.fate = how & 3;
    t.when = take(&t.d.bytes);
    decode_config(&t.d, t.config);
    decode_scene(&t.d, &t.host);
    if (how & 64)
        ask_from_callbacks(&t);
    prepare_judge(&t);
    prepare_rays(&t);
    if (t.fate != 0)
        check_misfortune(&t);
    check_build(&t);
    accel_free(t.judge);
    heap_check_empty(&t.judge_watch.heap, "linear");
    host_scene_free(&t.host);
    return 0;
}
