/* SPDX-License-Identifier: Apache-2.0
 *
 * The lines of a file of rays. Lines may be empty, and what follows '#' is a comment. The first
 * line that is neither may name the columns, without any number. Lines end with LF, CR LF or CR; a
 * byte-order mark may come before them.
 *
 * Between the numbers are blanks, or a comma or a semicolon with or without blanks. Within an
 * origin, a direction and each pair it is the same: where commas are points, "0,5 1 2" is refused
 * and not taken for four numbers.
 */
#ifndef ACCEL_CLI_RAY_LINES_H
#define ACCEL_CLI_RAY_LINES_H

#include "tool/file.h"

/* A walk over the lines. */
struct ray_lines {
    char *at, *end; /* the text that is left, and a byte behind it that can be written */
    char *line;     /* the last one, with a zero at its end */
    size_t number;  /* of the last line, counted from 1 */
    bool begun;     /* a ray or the names of columns have been there */
};

/* Starts at the first line of a file, whose bytes are overwritten. */
struct ray_lines ray_lines_start(const struct file *file);

/* What next_ray found. */
enum ray_line { RAY_LINES_END, RAY_LINE, NO_RAY_LINE };

/* Takes lines up to the next ray, or to one that is no ray. */
enum ray_line next_ray(struct ray_lines *lines, accel_ray *ray);

#endif
