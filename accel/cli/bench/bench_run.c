/* SPDX-License-Identifier: Apache-2.0
 *
 * Judging and timing the contenders of accel bench.
 *
 * Every answer of every structure is compared before anything is timed. Times are processor time
 * of one thread; the contenders take turns set by set, so that whatever else the machine does falls
 * on all of them.
 */
#include "bench.h"
#include "answers.h"
#include "tool/machine.h"
#include "tool/quantile.h"

#include <stdio.h>
#include <string.h>

static bool same(const struct ray_set *set, size_t i, bool found, const accel_hit *hit)
{
    const accel_hit *expected = &set->hits[i];
    return found == (expected->geom != ACCEL_NONE) && (!found || same_hit(expected, hit));
}

static bool report(const struct bench *b, const char *name, const struct ray_set *set, size_t i)
{
    const accel_ray *r = &set->rays[i];
    printf(
        "DIFFERENT: %s: %s and %s do not agree on %s ray %zu, from (%a %a %a) along (%a %a %a)\n",
        b->scene_name, name, b->reference_name, set->name, i, r->org[0], r->org[1], r->org[2],
        r->dir[0], r->dir[1], r->dir[2]);
    return false;
}

size_t ask_batch(const accel *a, const struct ray_set *set, size_t i, accel_query *query,
                 struct batch_answers *out)
{
    out->count = set->count - i < BATCH ? set->count - i : BATCH;
    return set->any ? accel_any_n(a, set->rays + i, out->flags, out->count, query)
                    : accel_closest_n(a, set->rays + i, out->hits, out->count, query);
}

/* One that answers batches. */
static bool judge_batches(struct bench *b, struct bench_contender *c, int s)
{
    const struct ray_set *set = &b->sets[s];
    accel_query query = {0};
    struct batch_answers got;
    for (size_t i = 0; i < set->count; i += BATCH) {
        ask_batch(c->state, set, i, &query, &got);
        for (size_t j = 0; j < got.count; j++) {
            const bool found = set->any ? got.flags[j] : got.hits[j].geom != ACCEL_NONE;
            if (!same(set, i + j, found, set->any ? &set->hits[i + j] : &got.hits[j])) {
                return report(b, c->name, set, i + j);
            }
        }
    }
    c->nodes[s] = (double)query.nodes / (double)set->count;
    c->tests[s] = (double)query.tests / (double)set->count;
    return true;
}

/* One of our structures, on all rays of a set. */
static bool judge_structure(struct bench *b, struct bench_contender *c, int s, const accel *a,
                            size_t step)
{
    const struct ray_set *set = &b->sets[s];
    accel_query query = {0};
    size_t asked = 0;
    for (size_t i = 0; i < set->count; i += step, asked++) {
        accel_hit hit;
        const bool found = accel_closest(a, &set->rays[i], &hit, set->any ? NULL : &query);
        if (!same(set, i, found, &hit) ||
            (set->any && accel_any(a, &set->rays[i], &query) != found)) {
            return report(b, c != NULL ? c->name : "linear", set, i);
        }
    }
    if (c != NULL && asked > 0) {
        c->nodes[s] = (double)query.nodes / (double)asked;
        c->tests[s] = (double)query.tests / (double)asked;
    }
    return true;
}

/* A peer's answers: another primitive, a hit for a miss or a miss for a hit. */
static void count_wrong(const struct bench *b, struct bench_contender *c, int s)
{
    const struct ray_set *set = &b->sets[s];
    c->wrong[s] = 0;
    for (size_t i = 0; i < set->count; i++) {
        const accel_id got = c->ask(c, set, i);
        const accel_hit *hit = &set->hits[i];
        const bool found = hit->geom != ACCEL_NONE;
        const bool agrees =
            found == (got.geom != ACCEL_NONE) &&
            (!found || set->any || (got.geom == hit->geom && got.prim == hit->prim));
        c->wrong[s] += !agrees;
    }
}

bool bench_judge(struct bench *b, const accel *linear, size_t sample, struct progress *progress)
{
    for (int s = 0; s < SETS; s++) {
        const size_t count = b->sets[s].count;
        const size_t step = count > sample ? count / sample : 1;
        const size_t judged = (count + step - 1) / step;
        b->judged = judged > b->judged ? judged : b->judged;
        progress->what = "linear";
        progress_show(progress, b->sets[s].name, -1.0);
        if (count > 0 && !judge_structure(b, NULL, s, linear, step)) {
            return false;
        }
        for (size_t c = 0; count > 0 && c < b->count; c++) {
            progress->what = b->at[c].name;
            progress_show(progress, "judged", -1.0);
            if (b->at[c].peer) {
                count_wrong(b, &b->at[c], s);
            } else if (b->at[c].batch ? !judge_batches(b, &b->at[c], s)
                                      : !judge_structure(b, &b->at[c], s, b->at[c].state, 1)) {
                return false;
            }
        }
    }
    progress->what = NULL;
    progress_clear(progress);
    return true;
}

bool bench_time(struct bench *b, struct progress *progress)
{
    for (unsigned turn = 0; turn < b->repeats; turn++) {
        for (int s = 0; s < SETS; s++) {
            const struct ray_set *set = &b->sets[s];
            for (size_t c = 0; set->count > 0 && c < b->count; c++) {
                struct bench_contender *contender = &b->at[c];
                const double start = machine_seconds();
                const size_t found = contender->trace(contender, set);
                contender->ns[s][turn] = 1e9 * (machine_seconds() - start) / (double)set->count;
                if (!contender->peer && found != set->found) {
                    return report(b, contender->name, set, 0);
                }
            }
            progress->what = b->scene_name;
            progress_show(progress, "timed", (turn + s * 0.25) / b->repeats);
        }
    }
    progress->what = NULL;
    progress_clear(progress);
    for (size_t c = 0; c < b->count; c++) {
        for (int s = 0; s < SETS; s++) {
            sort_values(b->at[c].ns[s], b->repeats);
        }
    }
    return true;
}

double bench_ns(const struct bench *b, size_t c, int set, double part)
{
    return quantile(b->at[c].ns[set], b->repeats, part);
}
