/* SPDX-License-Identifier: Apache-2.0
 *
 * What figures depend on: processor, compiler, version; and the clock that they are taken by.
 */
#ifndef ACCEL_CLI_MACHINE_H
#define ACCEL_CLI_MACHINE_H

#include <stddef.h>

/* The processor's name as the system gives it, without a line end. */
void machine_processor(char *text, size_t size);

/* Compiler, its flags, version and commit, in one line. */
const char *machine_build(void);

/* Seconds of processor time of the calling thread. */
double machine_seconds(void);

/* The same of all threads together: what a build takes that may use others. */
double machine_seconds_of_all(void);

#endif
