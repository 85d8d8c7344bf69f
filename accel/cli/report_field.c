/* SPDX-License-Identifier: Apache-2.0
 *
 * All who take part in an exam, built and timed.
 */
#include "machine.h"
#include "report_exam.h"

#include <stdlib.h>

enum { TURNS = 5, TIMED_RAYS = 2000 };

/* The diagonal of the scene's box. */
static double length_of(const struct test_scene *s)
{
    double square = 0.0;
    for (int k = 0; k < 3; k++) {
        square += pow(s->box.hi[k] - s->box.lo[k], 2.0);
    }
    return sqrt(square);
}

bool accel_field_build(accel_field *field, accel_reporting *r, const accel_exam *exam)
{
    const accel_forms forms = accel_forms_of_kinds(NULL);
    field->count = 0;
    for (size_t i = 0; i < forms.count; i++) {
        accel *a = accel_report_build(r, &exam->scene->scene, forms.at[i]);
        if (a == NULL) {
            return false;
        }
        field->at[field->count] = accel_exam_ours(a, forms.at[i]);
        field->at[field->count++].build_seconds = r->built;
    }
    if (exam->peers) {
        field->count += accel_bench_peers(field->at + field->count, &exam->scene->scene,
                                          length_of(exam->scene));
    }
    return true;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void accel_field_time(accel_field *field, const accel_exam *exam)
{
    double ns[ACCEL_MOST_FORMS + ACCEL_MOST_PEERS][TURNS];
    for (int turn = 0; turn < TURNS; turn++) {
        for (size_t c = 0; c < field->count; c++) {
            accel_ray_set set = field->at[c].peer ? exam->peer_set : exam->set;
            set.count = set.count < TIMED_RAYS ? set.count : TIMED_RAYS;
            const double start = accel_machine_seconds();
            field->at[c].trace(&field->at[c], &set);
            ns[c][turn] = 1e9 * (accel_machine_seconds() - start) / (double)(set.count + 1);
        }
    }
    for (size_t c = 0; c < field->count; c++) {
        qsort(ns[c], TURNS, sizeof ns[c][0], compare);
        field->ns[c] = ns[c][TURNS / 2];
    }
}

void accel_field_free(accel_field *field)
{
    for (size_t c = 0; c < field->count; c++) {
        field->at[c].end(&field->at[c]);
    }
    field->count = 0;
}
