/* SPDX-License-Identifier: Apache-2.0
 *
 * The wide form of a kind: the parts that all kinds that have it share.
 */
#ifndef ACCEL_WIDE_FORM_H
#define ACCEL_WIDE_FORM_H

#include "wide_isa.h"

extern const char *const accel_wide_isa_words[], *const accel_wide_form_words[];

/* The words of the option `form`, by index. */
enum { WIDE_FORM_WIDE, WIDE_FORM_CLASSIC };

/* Of a kind that has both; the wide one does without some options. */
#define WIDE_FORM_OPTION(without)                                                                  \
    {                                                                                              \
        .key = "form", .meaning = "auto: wide, but classic with " without,                         \
        .words = accel_wide_form_words, .standard = NAN                                            \
    }

/* The form that is built; `classic`: options are given that only that one has. */
static inline double wide_form_resolve(double form, bool classic)
{
    return isnan(form) ? (classic ? WIDE_FORM_CLASSIC : WIDE_FORM_WIDE) : form;
}

#define WIDE_ISA_OPTION                                                                            \
    {                                                                                              \
        .key = "isa", .meaning = "instruction set of the walks; auto: the best that is there",     \
        .words = accel_wide_isa_words, .standard = NAN                                             \
    }

/* Builds the tree and fills in build->a->info; *isa is the option's value. */
bool accel_wide_form_build(struct build *build, struct wide *w, const double *isa,
                           enum wide_cut cut, const struct clustering *clusters);

void accel_wide_form_walk(const struct wide *w, struct query *q);

#endif
