/* SPDX-License-Identifier: Apache-2.0
 *
 * What a kind of structure is to the rest of the library: one static table of functions.
 * A new kind is one file that fills an `accel_kind`, and one line in kinds.h.
 */
#ifndef ACCEL_KIND_H
#define ACCEL_KIND_H

#include "build.h"
#include "cost.h"
#include "structure.h"

struct query;

/* Kinds at most. */
enum { MAX_KINDS = 16 };

struct accel_kind {
    accel_kind_info info; /* name, summary, options; the first member: see kinds */
    struct kind_cost cost;
    size_t size; /* of the kind's struct */
    /* Only of a kind that stands for others: picks one of them, over a->prims.bounded. */
    bool (*choose)(struct build *build, const struct accel_kind **kind);
    /* Builds over a->prims.bounded, which is not empty; reads a->option and writes back what auto
     * became; fills the counts in a->info. False: build->error says why, `release` cleans up. */
    bool (*build)(struct build *build);
    /* Offers to the query every primitive that could win: see query.h. */
    void (*walk)(const struct accel *a, struct query *q);
    /* Only of a kind that builds on after accel_build: adds what there is now to the counts, also
     * while other threads query. */
    void (*describe)(const struct accel *a, accel_info *info);
    /* Checks the invariants of the file's head. False: *error says what is broken. */
    bool (*validate)(const struct accel *a, accel_error *error);
    /* Frees what build allocated, also after a build that failed half-way. */
    void (*release)(struct accel *a);
};

/* Adds a note if an option was given that the form that is built does not read. */
void accel_note_idle_option(struct build *build, size_t option, const char *form);

/* The kinds, NULL-ended; each is the `info` of an accel_kind. */
extern const accel_kind_info *const accel_kind_list[];

#endif
