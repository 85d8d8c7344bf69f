/* SPDX-License-Identifier: Apache-2.0
 *
 * The run of accel check: threads take blocks of rays, ask every structure, and compare.
 *
 * What is expected is linear's answer where linear judges the ray, and otherwise what the first
 * structure says; where another one disagrees with it, linear is asked after all and decides.
 */
#include "check.h"

#include "tool/threads.h"

#include <stdatomic.h>
#include <stdlib.h>

/* Rays taken at once; and disagreements that linear decides before the first structure's word
 * stands in for it: with more of them the result is clear, and linear takes long. */
enum { BLOCK = 64, MOST_DECIDED = 1000 };

/* What one thread found out about one structure. */
typedef struct tally {
    uint64_t family_hits[FAMILIES], refused, outside, mismatches, by_query[QUERIES], first;
} tally;

/* What the threads share. */
typedef struct run {
    struct check *check;
    atomic_uint_fast64_t next;    /* block to take */
    atomic_uint_fast64_t decided; /* disagreements that linear decided */
    atomic_bool failed;           /* no memory */
    tally *tallies;               /* of every thread and structure */
} run;

uint64_t check_family_rays(uint64_t count, uint64_t family)
{
    return (count + FAMILIES - 1 - family) / FAMILIES;
}

bool check_judged(const struct check *check, uint64_t index)
{
    const uint64_t family = index % FAMILIES, j = index / FAMILIES;
    const uint64_t all = check_family_rays(check->ray_count, family);
    const uint64_t some = check_family_rays(check->judged_count, family);
    return (j + 1) * some / all > j * some / all;
}

struct question check_question(const struct check *check, uint64_t index)
{
    struct question question = {.ray = rays_make(&check->rays, index)};
    question.lists = index / FAMILIES % LISTS_EVERY == 0;
    for (int k = 0; k < 3; k++) {
        question.point[k] = question.ray.org[k];
    }
    accel_hit hit;
    if (question.lists && accel_closest(check->suspects[0].structure, &question.ray, &hit, NULL)) {
        for (int k = 0; k < 3; k++) {
            question.point[k] += hit.t * question.ray.dir[k];
        }
    }
    return question;
}

/* Of a raw hit before its object's box the header says that kinds need not agree on the closest. */
static void count(tally *t, uint64_t index, const struct answers *got, unsigned differences,
                  bool outside)
{
    t->family_hits[index % FAMILIES] += got->found;
    t->outside += outside;
    differences &= outside ? ~(unsigned)DIFFERS_CLOSEST : ~0u;
    if (differences == 0) {
        return;
    }
    t->mismatches++;
    t->first = index < t->first ? index : t->first;
    for (int i = 0; i < QUERIES; i++) {
        t->by_query[i] += differences >> i & 1;
    }
}

static bool all_agree(const struct check *check, const struct question *question,
                      const struct answers *answers)
{
    /* the first structure's accel_any is compared with its own accel_closest */
    for (size_t i = 0; i < check->suspect_count; i++) {
        if (answers_differ(question, &answers[0], &answers[i]) != 0) {
            return false;
        }
    }
    return true;
}

void check_ask(const accel *a, const struct question *question, accel_query *query,
               struct answers *answers)
{
    answers_ask(a, &question->ray, query, answers);
    if (question->lists) {
        answers_ask_lists(a, &question->ray, question->point, query, answers);
    }
}

void check_ask_judge(const struct check *check, const struct question *question, accel_query *query,
                     struct answers *answers)
{
    answers_ask_judge(check->judge, &question->ray, query, answers);
    if (question->lists) {
        answers_ask_lists(check->judge, &question->ray, question->point, query, answers);
    }
}

/* What a structure says to a block of rays at once. */
struct batch {
    accel_hit hits[BLOCK];
    bool flags[BLOCK];
};

static void ask_batches(const struct check *check, uint64_t from, uint64_t to,
                        struct batch *batches)
{
    accel_ray rays[BLOCK];
    for (uint64_t i = from; i < to; i++) {
        rays[i - from] = rays_make(&check->rays, i);
    }
    for (size_t s = 0; s < check->suspect_count; s++) {
        const accel *a = check->suspects[s].structure;
        accel_closest_n(a, rays, batches[s].hits, to - from, NULL);
        accel_any_n(a, rays, batches[s].flags, to - from, NULL);
    }
}

/* Is the i-th answer of a batch that to the ray alone? */
static bool same_as_alone(const struct batch *batch, uint64_t i, const struct answers *alone)
{
    const accel_hit *hit = &batch->hits[i];
    return batch->flags[i] == alone->any && (hit->geom != ACCEL_NONE) == alone->found &&
           (!alone->found || same_hit(hit, &alone->closest));
}

/* `answers` has room for all structures and for the judge behind them. */
static void check_ray(run *r, uint64_t index, tally *tallies, const struct batch *batches,
                      struct answers *answers)
{
    const struct check *check = r->check;
    const struct question question = check_question(check, index);
    bool outside = false;
    for (size_t i = 0; i < check->suspect_count; i++) {
        accel_query query = {0};
        check_ask(check->suspects[i].structure, &question, &query, &answers[i]);
        tallies[i].refused += query.refused != 0;
        outside = outside || query.outside != 0;
    }
    const struct answers *expected = &answers[0];
    if (check_judged(check, index) || (!all_agree(check, &question, answers) &&
                                       atomic_fetch_add(&r->decided, 1) < MOST_DECIDED)) {
        struct answers *judged = &answers[check->suspect_count];
        accel_query query = {0};
        check_ask_judge(check, &question, &query, judged);
        expected = judged;
        outside = outside || query.outside != 0;
    }
    for (size_t i = 0; i < check->suspect_count; i++) {
        unsigned differences = answers_differ(&question, expected, &answers[i]);
        if (!same_as_alone(&batches[i], index % BLOCK, &answers[i])) {
            differences |= DIFFERS_BATCH;
        }
        count(&tallies[i], index, &answers[i], differences, outside);
    }
}

static void work(void *user, unsigned thread)
{
    run *r = user;
    struct check *check = r->check;
    struct answers *answers = malloc((check->suspect_count + 1) * sizeof *answers);
    struct batch *batches = malloc(check->suspect_count * sizeof *batches);
    if (answers == NULL || batches == NULL) {
        free(answers);
        free(batches);
        atomic_store(&r->failed, true);
        return;
    }
    tally *tallies = r->tallies + thread * check->suspect_count;
    for (;;) {
        const uint64_t from = atomic_fetch_add(&r->next, BLOCK);
        if (from >= check->ray_count) {
            break;
        }
        const uint64_t to = from + BLOCK < check->ray_count ? from + BLOCK : check->ray_count;
        ask_batches(check, from, to, batches);
        for (uint64_t i = from; i < to; i++) {
            check_ray(r, i, tallies, batches, answers);
        }
        if (thread == 0) {
            progress_show(&check->progress, "checking rays", (double)to / (double)check->ray_count);
        }
    }
    free(answers);
    free(batches);
}

static void add_tally(struct suspect *suspect, const tally *t)
{
    for (int i = 0; i < FAMILIES; i++) {
        suspect->family_hits[i] += t->family_hits[i];
        suspect->hits += t->family_hits[i];
    }
    suspect->refused += t->refused;
    suspect->outside += t->outside;
    suspect->mismatches += t->mismatches;
    suspect->first = t->first < suspect->first ? t->first : suspect->first;
    for (int i = 0; i < QUERIES; i++) {
        suspect->by_query[i] += t->by_query[i];
    }
}

bool check_run(struct check *check)
{
    const size_t count = check->threads * check->suspect_count;
    run r = {.check = check, .tallies = calloc(count, sizeof *r.tallies)};
    if (r.tallies == NULL) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        r.tallies[i].first = UINT64_MAX;
    }
    threads_run(check->threads, work, &r);
    progress_clear(&check->progress);
    for (size_t i = 0; i < count; i++) {
        add_tally(&check->suspects[i % check->suspect_count], &r.tallies[i]);
    }
    free(r.tallies);
    return !atomic_load(&r.failed);
}
