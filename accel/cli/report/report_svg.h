/* SPDX-License-Identifier: Apache-2.0
 *
 * See report_svg.c.
 */
#ifndef ACCEL_CLI_REPORT_SVG_H
#define ACCEL_CLI_REPORT_SVG_H

#include <stdbool.h>
#include <stddef.h>

/* Makes the text of a plot shorter in place; leaves it alone where its groups do not match. */
void svg_shrink(char *svg);

#endif
