/* SPDX-License-Identifier: Apache-2.0
 *
 * The files of the report, as the build has put them into the command: the template of the page
 * (page.html) and gnuplot's programs (plots/).
 */
#ifndef ACCEL_CLI_REPORT_TEXT_H
#define ACCEL_CLI_REPORT_TEXT_H

/* A file; its text ends with a zero. */
struct report_text {
    const char *name; /* without folder */
    const unsigned char *text;
};

/* Ended by a NULL name. */
extern const struct report_text report_texts[];

/* The text of a file that is there. */
const char *report_text(const char *name);

#endif
