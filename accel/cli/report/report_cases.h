/* SPDX-License-Identifier: Apache-2.0
 *
 * Between the parts of the report on stiff and extreme cases.
 */
#ifndef ACCEL_CLI_REPORT_CASES_H
#define ACCEL_CLI_REPORT_CASES_H

#include "report_exam.h"

/* What POV-Ray answered. */
struct povray {
    bool ran;     /* it has answered at all */
    size_t asked; /* rays */
    size_t lost;  /* hits that it misses */
    size_t false_hits;
    size_t off; /* hits more than a thousandth of t away */
};

/* The version of the stock POV-Ray of this machine, or NULL. */
const char *povray_version(struct reporting *r);

/* Asks it about the first `most` rays of the exam that are decided. False: it did not run. */
bool povray_ask(struct reporting *r, const struct exam *exam, size_t most, struct povray *out);

/* One row of the table. */
struct case_row {
    const char *test, *name, *meaning; /* as in the catalogue */
    const char *scene;                 /* where rays vary, their scene; else NULL */
    enum judge judge;
    size_t rays, decided;  /* over all variants */
    size_t forms;          /* of ours that were asked */
    size_t wrong;          /* of all of them together */
    bool peers;            /* Embree was asked */
    size_t fast, robust;   /* wrong answers of Embree's better build of each */
    size_t decided_peer;   /* rays that Embree can be asked and that are decided */
    size_t decided_single; /* rays that are decided of what it was given */
    size_t fast_single, robust_single;
    struct povray povray;
    double cost_middle; /* time per ray over that of the generic scene, median of forms */
    double cost_worst;  /* the same, most */
    char worst[64];     /* the form */
};

enum { MOST_CASES = 160 };

/* Fills the page. False: said. */
bool cases_page(struct reporting *r, const struct case_row *rows, size_t count);

#define ACCEL_CASES_CSV "cases.csv"

#endif
