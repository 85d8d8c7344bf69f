/* SPDX-License-Identifier: Apache-2.0
 *
 * accel report: error against run time, as a page with plots and the figures behind them.
 *
 * The report is made of sections. Each gets a share of the time, chooses its counts by it, writes
 * its figures as CSV into the folder, has them plotted, and writes its part of the page.
 */
#ifndef ACCEL_CLI_REPORT_H
#define ACCEL_CLI_REPORT_H

#include "report_folder.h"
#include "structure.h"

/* What fills a gap of the page: HTML. */
struct page_value {
    const char *key;
    char *text;
    size_t length;
};

enum { PAGE_VALUES = 64 };

/* The page under way. */
struct page {
    FILE *file;
    struct page_value values[PAGE_VALUES];
    size_t count;
};

/* A report under way. */
struct reporting {
    const struct command *command;
    struct folder folder;     /* where all of it is written */
    struct page page;         /* index.html */
    struct progress progress; /* shown while it runs */
    double seconds;           /* that the whole may take, about */
    double built;             /* processor time of the last report_build */
    uint64_t judged;          /* answers of ours that were judged */
    uint64_t wrong;           /* of them */
};

/* A section: takes about `seconds`. False: it has complained. */
typedef bool report_section(struct reporting *r, double seconds);

report_section report_exact, report_cases, report_light, report_choice, report_size;

/* --------------------------------------------------------------------- page ---- */

/* Opens it, before anything long is computed. False: said. */
bool page_open(struct reporting *r);

/* Fills a gap of the page with HTML. A part of the page is there where it has set the gap of its
 * name. False: no memory, which has been said. */
bool page_set(struct reporting *r, const char *key, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The same for long text: a stream, or NULL, to be ended in any case. */
FILE *page_value(struct reporting *r, const char *key);
bool page_value_end(struct reporting *r, FILE *value);

/* Writes text with &, < and > as HTML wants them. */
void page_escaped(FILE *to, const char *text);

/* Writes the page. False: said. */
bool page_write(struct reporting *r);

/* Frees what belongs to it. */
void page_free(struct reporting *r);

/* -------------------------------------------------------------------- plots ---- */

/* Why gnuplot cannot be run, or NULL. */
const char *plot_missing(void);

/* Which contenders a plot shows: all kinds and forms, or the kinds but linear as they come. */
enum plot_forms { PLOT_FORMS, PLOT_KINDS };

/* Has gnuplot draw NAME.svg by plots/PROGRAM.gnuplot, after `given`, which sets what that asks for.
 * False: said. */
bool plot_draw(struct reporting *r, const char *name, const char *program, enum plot_forms forms,
               const char *given);

/* ------------------------------------------------------------------ figures ---- */

/* Is there a kind but linear and auto? Otherwise says so on the page. */
bool report_has_structures(struct reporting *r);

/* Opens NAME in the folder and writes the names of its columns. False: said. */
FILE *report_csv(struct reporting *r, const char *name, const char *columns);

/* Closes it. False: said. */
bool report_csv_close(struct reporting *r, FILE *csv, const char *name);

/* What share of n answers is shown where none of n is wrong. */
double report_shown(size_t wrong, size_t n);

/* Builds, shows progress, complains where that fails. */
accel *report_build(struct reporting *r, const accel_scene *scene, const char *config);

#endif
