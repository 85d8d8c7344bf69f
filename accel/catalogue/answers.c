/* SPDX-License-Identifier: Apache-2.0 */
#include "answers.h"

#include <string.h>

bool same_hit(const accel_hit *a, const accel_hit *b)
{
    return memcmp(&a->t, &b->t, sizeof a->t) == 0 && memcmp(&a->u, &b->u, sizeof a->u) == 0 &&
           memcmp(&a->v, &b->v, sizeof a->v) == 0 && a->geom == b->geom && a->prim == b->prim;
}

static bool keep_hit(void *user, const accel_hit *hit)
{
    struct answers *answers = user;
    answers->all[answers->all_count++] = *hit;
    return answers->all_count < KEPT;
}

static bool keep_id(void *user, accel_id id)
{
    struct answers *answers = user;
    answers->point[answers->point_count++] = id;
    return answers->point_count < KEPT;
}

void answers_ask_judge(const accel *judge, const accel_ray *ray, accel_query *query,
                       struct answers *answers)
{
    const accel_hit nothing = {-1.0, -2.0, -3.0, 4, 5};
    answers->closest = nothing;
    answers->all_count = 0;
    answers->point_count = 0;
    answers->ended = true;
    answers->found = accel_closest(judge, ray, &answers->closest, query);
    answers->any = answers->found;
    answers->untouched = answers->found || same_hit(&answers->closest, &nothing);
}

void answers_ask(const accel *a, const accel_ray *ray, accel_query *query, struct answers *answers)
{
    answers_ask_judge(a, ray, query, answers);
    answers->any = accel_any(a, ray, query);
}

void answers_ask_lists(const accel *a, const accel_ray *ray, const double point[3],
                       accel_query *query, struct answers *answers)
{
    answers->ended = accel_all(a, ray, keep_hit, answers, query);
    accel_point(a, point, keep_id, answers, query);
}

static bool same_list(const struct answers *expected, const struct answers *got)
{
    bool same = expected->all_count == got->all_count;
    for (uint32_t i = 0; same && i < expected->all_count; i++) {
        same = same_hit(&expected->all[i], &got->all[i]);
    }
    return same;
}

static bool same_ids(const struct answers *expected, const struct answers *got)
{
    bool same = expected->point_count == got->point_count;
    for (uint32_t i = 0; same && i < expected->point_count; i++) {
        same = expected->point[i].geom == got->point[i].geom &&
               expected->point[i].prim == got->point[i].prim;
    }
    return same;
}

unsigned answers_differ(const struct question *question, const struct answers *expected,
                        const struct answers *got)
{
    unsigned differences = 0;
    if (expected->found != got->found || !got->untouched ||
        (got->found && !same_hit(&expected->closest, &got->closest))) {
        differences |= DIFFERS_CLOSEST;
    }
    if (expected->found != got->any) {
        differences |= DIFFERS_ANY;
    }
    if (question->lists && !same_list(expected, got)) {
        differences |= DIFFERS_ALL;
    }
    if (question->lists && !same_ids(expected, got)) {
        differences |= DIFFERS_POINT;
    }
    return differences;
}
