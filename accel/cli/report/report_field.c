/* SPDX-License-Identifier: Apache-2.0
 *
 * All who take part in an exam, built and timed.
 */
#include "tool/machine.h"
#include "tool/quantile.h"
#include "report_exam.h"

enum { TURNS = 5, TIMED_RAYS = 2000, FEWEST_TIMED = 16 };

/* The diagonal of the scene's box. */
static double length_of(const struct test_scene *s)
{
    double square = 0.0;
    for (int k = 0; k < 3; k++) {
        square += pow(s->target.box.hi[k] - s->target.box.lo[k], 2.0);
    }
    return sqrt(square);
}

bool field_build(struct field *field, struct reporting *r, const struct exam *exam)
{
    const struct forms forms = forms_of_kinds(NULL);
    field->count = 0;
    for (size_t i = 0; i < forms.count; i++) {
        accel *a = report_build(r, &exam->scene->scene, forms.at[i]);
        if (a == NULL) {
            return false;
        }
        field->at[field->count] = exam_ours(a, forms.at[i]);
        field->at[field->count++].build_seconds = r->built;
    }
    if (exam->peers) {
        field->count +=
            bench_peers(field->at + field->count, &exam->scene->scene, length_of(exam->scene));
    }
    return true;
}

/* Nanoseconds of a ray; few rays are traced again and again. */
static double time_rays(const struct bench_contender *c, const struct ray_set *set)
{
    const size_t count = set->count > 0 ? set->count : 1;
    const size_t passes = (FEWEST_TIMED + count - 1) / count;
    const double start = machine_seconds();
    for (size_t i = 0; i < passes; i++) {
        c->trace(c, set);
    }
    return 1e9 * (machine_seconds() - start) / (double)(passes * count);
}

void field_time(struct field *field, const struct exam *exam)
{
    double ns[MOST_FORMS + MOST_PEERS][TURNS];
    for (int turn = 0; turn < TURNS; turn++) {
        for (size_t c = 0; c < field->count; c++) {
            struct ray_set set = field->at[c].peer ? exam->peer_set : exam->set;
            set.count = set.count < TIMED_RAYS ? set.count : TIMED_RAYS;
            ns[c][turn] = time_rays(&field->at[c], &set);
        }
    }
    for (size_t c = 0; c < field->count; c++) {
        sort_values(ns[c], TURNS);
        field->ns[c] = ns[c][TURNS / 2];
    }
}

void field_free(struct field *field)
{
    for (size_t c = 0; c < field->count; c++) {
        field->at[c].end(&field->at[c]);
    }
    field->count = 0;
}
