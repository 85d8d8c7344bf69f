/* SPDX-License-Identifier: Apache-2.0
 *
 * Contenders of an exam, and what of their answers is wrong.
 */
#include "answers.h"
#include "report_exam.h"

/* What Embree's rays may hold: it ends the program at others (ray.h: valid, FLT_LARGE). */
#define PEER_RANGE 1.844e18

bool peer_reaches(const accel_ray *ray)
{
    for (int k = 0; k < 3; k++) {
        if (!(fabs(ray->org[k]) <= PEER_RANGE) || !(fabs(ray->dir[k]) <= PEER_RANGE)) {
            return false;
        }
    }
    return !isnan(ray->tmin) && !isnan(ray->tmax);
}

/* Embree has no hits behind the origin: such a ray is not its fault. */
bool peer_asked(const accel_ray *ray)
{
    return !(ray->tmin < 0.0);
}

static size_t trace_ours(const struct bench_contender *c, const struct ray_set *set)
{
    size_t found = 0;
    accel_hit hit;
    for (size_t i = 0; i < set->count; i++) {
        found += accel_closest(c->state, &set->rays[i], &hit, NULL);
    }
    return found;
}

static void end_ours(struct bench_contender *c)
{
    accel_free(c->state);
}

struct bench_contender exam_ours(accel *a, const char *config)
{
    accel_info info;
    accel_describe(a, &info);
    struct bench_contender c = {.state = a,
                                .build_seconds = info.seconds,
                                .bytes = (double)info.bytes,
                                .trace = trace_ours,
                                .end = end_ours};
    snprintf(c.name, sizeof c.name, "%.63s", config);
    return c;
}

/* One answer of ours: the same bits as linear's, and right. */
static bool is_right(const struct exam *e, const struct bench_contender *c, size_t i)
{
    accel_hit hit;
    const accel_hit *linear = &e->set.hits[i];
    const bool found = accel_closest(c->state, &e->set.rays[i], &hit, NULL);
    const bool same = found == (linear->geom != ACCEL_NONE) && (!found || same_hit(&hit, linear)) &&
                      accel_any(c->state, &e->set.rays[i], NULL) == found;
    switch (e->judge) {
    case BY_HIT:
        return same && found;
    case BY_INTEGERS:
        return same && found == (e->exact[i].crossing.under != 0) &&
               (!found || crossing_is(&e->exact[i].crossing, &hit));
    case BY_ORACLE:
        return same && oracle_agrees(&e->right[i], found, &hit);
    default:
        return same;
    }
}

/* One of those that are hit first, or nothing where nothing is. */
static bool is_tie(const struct first *first, accel_id got)
{
    for (uint32_t i = 0; i < first->tie_count; i++) {
        if (first->ties[i].geom == got.geom && first->ties[i].prim == got.prim) {
            return true;
        }
    }
    return first->tie_count == 0 && got.geom == ACCEL_NONE;
}

/* One answer of a peer. */
static bool names_right(const struct exam *e, const struct judgement *right,
                        const struct bench_contender *peer, size_t i)
{
    const accel_ray *ray = &e->set.rays[i];
    if (!peer_asked(ray)) {
        return true;
    }
    const accel_id none = {ACCEL_NONE, ACCEL_NONE};
    const accel_id got = peer_reaches(ray) ? peer->ask(peer, &e->set, i) : none;
    const bool found = got.geom != ACCEL_NONE;
    if (e->judge == BY_HIT) {
        return found;
    }
    if (e->judge == BY_INTEGERS) {
        return is_tie(&e->exact[i], got);
    }
    if (right[i].verdict != HIT) {
        return right[i].verdict == UNDECIDED || !found;
    }
    return found && got.geom == right[i].geom && got.prim == right[i].prim;
}

static size_t count_wrong(const struct exam *e, const struct judgement *right,
                          const struct bench_contender *c)
{
    size_t wrong = 0;
    for (size_t i = 0; i < e->set.count; i++) {
        wrong += c->peer ? !names_right(e, right, c, i) : !is_right(e, c, i);
    }
    return wrong;
}

size_t exam_wrong(const struct exam *e, const struct bench_contender *c)
{
    return count_wrong(e, e->right, c);
}

size_t exam_wrong_single(const struct exam *e, const struct bench_contender *c)
{
    return count_wrong(e, e->judge == BY_ORACLE ? e->single : NULL, c);
}
