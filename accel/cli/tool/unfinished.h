/* SPDX-License-Identifier: Apache-2.0
 *
 * The file or folder that is under way: removed when a signal ends the process before it is done.
 *
 * Every signal that would end the process is watched; one that is ignored, as by nohup, stays
 * ignored. The process then dies by that signal. A child forks off with the same handlers but owns
 * nothing. Nothing can be done against SIGKILL: it leaves the temporary name behind, which is never
 * the name that the user gave.
 */
#ifndef ACCEL_CLI_UNFINISHED_H
#define ACCEL_CLI_UNFINISHED_H

#include <signal.h>
#include <stdbool.h>

enum { MOST_FILES = 64, FILE_NAME = 64 };

/* Starts to watch a file, or a folder with the files to be named. One at a time in a process; the
 * name is not copied. */
void unfinished_start(const char *path, bool is_folder);

/* Names a file in the folder, once is enough. False: too many or too long. */
bool unfinished_name(const char *file);

/* The names so far, in order; NULL from the last on. */
const char *unfinished_file(int i);

/* Nothing is under way any more: it is in its place, or is to be kept. */
void unfinished_done(void);

/* Removes it. */
void unfinished_remove(void);

/* Keeps all signals waiting until they are let go on, for what must not be half done. */
void signals_hold(sigset_t *before);
void signals_go_on(const sigset_t *before);

#endif
