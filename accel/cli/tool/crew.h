/* SPDX-License-Identifier: Apache-2.0
 *
 * A crew of threads that run one function together and end together.
 */
#ifndef ACCEL_CLI_CREW_H
#define ACCEL_CLI_CREW_H

/* One thread's part; `thread` is 0 for the calling one. */
typedef void crew_work(void *user, unsigned thread);

/* Runs work(user, 0) here and work(user, 1 .. threads - 1) beside it, and waits for all. Where the
 * system gives fewer threads the rest is not run: work must be shared out as it is taken. */
void crew(unsigned threads, crew_work *work, void *user);

/* Processors that this process may use. */
unsigned crew_size(void);

#endif
