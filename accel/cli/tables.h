/* SPDX-License-Identifier: Apache-2.0
 *
 * Between the parts of accel tables: rows, and running them on one scene.
 */
#ifndef ACCEL_CLI_TABLES_H
#define ACCEL_CLI_TABLES_H

#include "output.h"
#include "trials.h"

#include <stdio.h>

/* A line of a table. */
typedef struct accel_table_row {
    /* A CONFIG. A '?' for the value of leaf or density stands for the fastest of seven, which are
     * tried with a tenth of the photons: every kind is tuned by the same search. */
    const char *config;
    int base;     /* the line that this one's time is divided by */
    double paper; /* seconds in the paper, or 0 */
} accel_table_row;

/* What a row came to on one scene; all 0 where it was left out. */
typedef struct accel_table_result {
    double seconds;      /* median */
    double nodes, tests; /* per ray */
} accel_table_result;

enum { ACCEL_MOST_ROWS = 20 };

/* What the user asked for. */
typedef struct accel_table_request {
    unsigned table;            /* 0: all */
    bool quick, quiet;         /* flags */
    uint64_t photons, repeats; /* 0: default */
    uint64_t threads;
    const char *csv_name; /* file to write as well, or NULL */
    FILE *csv;            /* open, or NULL */
} accel_table_request;

/* Names the rows whose kind is not compiled in: they are left out. */
void accel_table_missing(const accel_table_row *rows, size_t count);

/* Runs the rows on one scene and prints them. Fills results[i] for row i. Returns the exit code. */
int accel_table_run(const accel_command *command, const accel_table_request *r, const char *scene,
                    const accel_table_row *rows, size_t count, uint64_t photons,
                    accel_table_result *results);

#endif
