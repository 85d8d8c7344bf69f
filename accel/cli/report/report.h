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

/* A report under way. */
struct reporting {
    const struct command *command;
    struct folder folder;     /* where all of it is written */
    FILE *page;               /* index.html */
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

/* Writes the head of the page: what this is, on which machine. */
void page_open(struct reporting *r);

/* Ends the page; false: the disk took no more. */
bool page_close(struct reporting *r);

/* Starts a section. */
void page_title(struct reporting *r, const char *id, const char *title);

/* A paragraph; its text is HTML. */
void page_text(struct reporting *r, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Writes text with &, < and > as HTML wants them. */
void page_escaped(struct reporting *r, const char *text);

/* Shows NAME.svg with what it shows in words, and a link to the figures in CSV. */
bool page_plot(struct reporting *r, const char *name, const char *csv, const char *caption);

/* -------------------------------------------------------------------- plots ---- */

/* A program for gnuplot. */
struct plot {
    FILE *script; /* to write to */
    char name[40];
};

/* Why gnuplot cannot be run, or NULL. */
const char *plot_missing(void);

/* Starts a program that draws NAME.svg in the folder, with the style of all plots set. False: said.
 */
bool plot_open(struct reporting *r, struct plot *plot, const char *name, int width, int height);

/* Has gnuplot draw it. False: that has failed, and that has been said. */
bool plot_close(struct reporting *r, struct plot *plot);

/* How a contender is drawn in all plots: "lc rgb '#0072B2' pt 7". By kind, or for peers. */
const char *plot_style(const char *name);

/* ------------------------------------------------------------------ figures ---- */

/* Is there a kind but linear and auto? Otherwise says so on the page, under the title. */
bool report_has_structures(struct reporting *r, const char *id, const char *title);

/* Opens NAME in the folder and writes the names of its columns. False: said. */
FILE *report_csv(struct reporting *r, const char *name, const char *columns);

/* Closes it. False: said. */
bool report_csv_close(struct reporting *r, FILE *csv, const char *name);

/* What share of n answers is shown where none of n is wrong. */
double report_shown(size_t wrong, size_t n);

/* Builds, shows progress, complains where that fails. */
accel *report_build(struct reporting *r, const accel_scene *scene, const char *config);

#endif
