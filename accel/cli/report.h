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
typedef struct accel_reporting {
    const accel_command *command;
    accel_folder folder;     /* where all of it is written */
    FILE *page;              /* index.html */
    accel_progress progress; /* shown while it runs */
    double seconds;          /* that the whole may take, about */
    double built;            /* processor time of the last accel_report_build */
    uint64_t judged;         /* answers of ours that were judged */
    uint64_t wrong;          /* of them */
} accel_reporting;

/* A section: takes about `seconds`. False: it has complained. */
typedef bool accel_report_section(accel_reporting *r, double seconds);

accel_report_section accel_report_exact, accel_report_cases, accel_report_light,
    accel_report_choice, accel_report_size;

/* --------------------------------------------------------------------- page ---- */

/* Writes the head of the page: what this is, on which machine. */
void accel_page_open(accel_reporting *r);

/* Ends the page; false: the disk took no more. */
bool accel_page_close(accel_reporting *r);

/* Starts a section. */
void accel_page_title(accel_reporting *r, const char *id, const char *title);

/* A paragraph; its text is HTML. */
void accel_page_text(accel_reporting *r, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Writes text with &, < and > as HTML wants them. */
void accel_page_escaped(accel_reporting *r, const char *text);

/* Shows NAME.svg with what it shows in words, and a link to the figures in CSV. */
bool accel_page_plot(accel_reporting *r, const char *name, const char *csv, const char *caption);

/* -------------------------------------------------------------------- plots ---- */

/* A program for gnuplot. */
typedef struct accel_plot {
    FILE *script; /* to write to */
    char name[40];
} accel_plot;

/* Why gnuplot cannot be run, or NULL. */
const char *accel_plot_missing(void);

/* Starts a program that draws NAME.svg in the folder, with the style of all plots set. False: said.
 */
bool accel_plot_open(accel_reporting *r, accel_plot *plot, const char *name, int width, int height);

/* Has gnuplot draw it. False: that has failed, and that has been said. */
bool accel_plot_close(accel_reporting *r, accel_plot *plot);

/* How a contender is drawn in all plots: "lc rgb '#0072B2' pt 7". By kind, or for peers. */
const char *accel_plot_style(const char *name);

/* ------------------------------------------------------------------ figures ---- */

/* Is there a kind but linear and auto? Otherwise says so on the page, under the title. */
bool accel_report_has_structures(accel_reporting *r, const char *id, const char *title);

/* Opens NAME in the folder and writes the names of its columns. False: said. */
FILE *accel_report_csv(accel_reporting *r, const char *name, const char *columns);

/* Closes it. False: said. */
bool accel_report_csv_close(accel_reporting *r, FILE *csv, const char *name);

/* What share of n answers is shown where none of n is wrong. */
double accel_report_shown(size_t wrong, size_t n);

/* Builds, shows progress, complains where that fails. */
accel *accel_report_build(accel_reporting *r, const accel_scene *scene, const char *config);

#endif
