/* SPDX-License-Identifier: Apache-2.0
 *
 * The config string "kind[:key=value[,key=value]...]": parsed against the kinds' option tables.
 */
#ifndef ACCEL_CONFIG_H
#define ACCEL_CONFIG_H

#include "kind.h"

/* Finds the kind and fills option[] with the given values and the defaults of the others.
 * NULL if the string is not legal: *error names the culprit, what is allowed and the nearest
 * legal word. */
const struct accel_kind *accel_config_parse(const char *config, double option[MAX_OPTIONS],
                                            accel_error *error);

/* Writes the config string that names this kind with these options. */
void accel_config_print(const struct accel_kind *kind, const double option[MAX_OPTIONS], char *text,
                        size_t size);

#endif
