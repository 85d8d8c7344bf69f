/* SPDX-License-Identifier: Apache-2.0
 *
 * Is it an OFF file?
 */
#ifndef ACCEL_CLI_MESH_OFF_H
#define ACCEL_CLI_MESH_OFF_H

#include "text.h"

/* Does it begin with the word OFF and its prefixes? */
bool mesh_is_off(const mesh_text *start);

#endif
