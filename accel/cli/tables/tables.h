/* SPDX-License-Identifier: Apache-2.0
 *
 * Between the parts of accel tables: rows, and running them on one scene.
 */
#ifndef ACCEL_CLI_TABLES_H
#define ACCEL_CLI_TABLES_H

#include "tool/output.h"
#include "tool/trials.h"

#include <stdio.h>

/* A line of a table. */
struct table_row {
    /* A CONFIG. A '?' for the value of leaf or density stands for the fastest of seven, which are
     * tried with a tenth of the photons: every kind is tuned by the same search. */
    const char *config;
    int base;     /* the line that this one's time is divided by */
    double paper; /* seconds in the paper, or 0 */
};

/* What a row came to on one scene; all 0 where it was left out. */
struct table_result {
    double seconds;      /* median */
    double nodes, tests; /* per ray */
};

enum { MOST_ROWS = 20 };

/* What the user asked for. */
struct table_request {
    unsigned table;            /* 0: all */
    bool quick, quiet;         /* flags */
    uint64_t photons, repeats; /* 0: default */
    uint64_t threads;
    const char *csv_name; /* file to write as well, or NULL */
    FILE *csv;            /* open, or NULL */
};

/* Names the rows whose kind is not compiled in: they are left out. */
void table_missing(const struct table_row *rows, size_t count);

/* Runs the rows on one scene and prints them. Fills results[i] for row i. Returns the exit code. */
int table_run(const struct command *command, const struct table_request *r, const char *scene,
              const struct table_row *rows, size_t count, uint64_t photons,
              struct table_result *results);

#endif
