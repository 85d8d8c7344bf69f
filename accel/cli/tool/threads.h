/* SPDX-License-Identifier: Apache-2.0
 *
 * A crew of threads that run one function together and end together.
 */
#ifndef ACCEL_CLI_THREADS_H
#define ACCEL_CLI_THREADS_H

/* One thread's part; `thread` is 0 for the calling one. */
typedef void thread_work(void *user, unsigned thread);

/* Runs work(user, 0) here and work(user, 1 .. threads - 1) beside it, and waits for all. Where the
 * system gives fewer threads the rest is not run: work must be shared out as it is taken. */
void threads_run(unsigned threads, thread_work *work, void *user);

/* Processors that this process may use. */
unsigned threads_available(void);

#endif
