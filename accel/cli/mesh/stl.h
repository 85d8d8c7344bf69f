/* SPDX-License-Identifier: Apache-2.0
 *
 * Which of the two forms of STL is it, if any?
 */
#ifndef ACCEL_CLI_MESH_STL_H
#define ACCEL_CLI_MESH_STL_H

#include "text.h"

/* Does it begin with a solid, its name, and a facet or its end? */
bool mesh_is_text_stl(const mesh_text *start);

/* Is the file as long as a binary header says? */
bool mesh_is_binary_stl(const char *bytes, size_t size);

#endif
