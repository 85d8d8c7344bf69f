/* SPDX-License-Identifier: Apache-2.0
 *
 * The subcommands, one file each. main.c lists them.
 */
#ifndef ACCEL_CLI_COMMANDS_H
#define ACCEL_CLI_COMMANDS_H

#include "options.h"

extern const accel_command accel_command_kinds;
extern const accel_command accel_command_info;
extern const accel_command accel_command_check;
extern const accel_command accel_command_trace;
extern const accel_command accel_command_diff;
extern const accel_command accel_command_export;
extern const accel_command accel_command_bench;
extern const accel_command accel_command_lazy;
extern const accel_command accel_command_clusters;
extern const accel_command accel_command_photons;
extern const accel_command accel_command_tables;
extern const accel_command accel_command_report;

#endif
