/* SPDX-License-Identifier: Apache-2.0
 *
 * The subcommands, one file each. main.c lists them.
 */
#ifndef ACCEL_CLI_COMMANDS_H
#define ACCEL_CLI_COMMANDS_H

#include "tool/options.h"

extern const struct command command_kinds;
extern const struct command command_info;
extern const struct command command_check;
extern const struct command command_trace;
extern const struct command command_diff;
extern const struct command command_export;
extern const struct command command_bench;
extern const struct command command_lazy;
extern const struct command command_clusters;
extern const struct command command_photons;
extern const struct command command_tables;
extern const struct command command_report;

#endif
