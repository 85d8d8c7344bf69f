/* SPDX-License-Identifier: Apache-2.0
 *
 * What a signal handler may do is unlink and rmdir, but not read a folder: so the names of its
 * files are kept.
 */
#include "unfinished.h"

#include <fcntl.h>
#include <pthread.h>
#include <stdlib.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const char *volatile unfinished;
static volatile sig_atomic_t is_folder, file_count;
static char files[MOST_FILES][FILE_NAME];
static pid_t owner;

static void remove_folder(const char *path)
{
    const int folder = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) {
        return;
    }
    for (int i = 0; i < file_count; i++) {
        unlinkat(folder, files[i], 0);
    }
    close(folder);
    rmdir(path);
}

void unfinished_remove(void)
{
    const char *path = unfinished;
    if (path == NULL || getpid() != owner) {
        return;
    }
    if (is_folder) {
        remove_folder(path);
    } else {
        unlink(path);
    }
    unfinished = NULL;
}

static void remove_and_end(int number)
{
    unfinished_remove();
    /* not earlier: a second signal, in another thread, would end the process before it is done */
    signal(number, SIG_DFL);
    raise(number);
}

/* Would it end the process if nobody watched it? */
static bool ends(int number)
{
    static const int harmless[] = {SIGCHLD, SIGCONT, SIGTSTP, SIGTTIN, SIGTTOU, SIGURG, SIGWINCH};
    for (size_t i = 0; i < sizeof harmless / sizeof harmless[0]; i++) {
        if (number == harmless[i]) {
            return false;
        }
    }
    struct sigaction now;
    return sigaction(number, NULL, &now) == 0 && (now.sa_flags & SA_SIGINFO) == 0 &&
           now.sa_handler == SIG_DFL;
}

/* Of SIGKILL and SIGSTOP sigaction refuses to hear. */
static void watch(void)
{
    static bool watching;
    struct sigaction action = {.sa_handler = remove_and_end};
    sigfillset(&action.sa_mask);
    for (int number = 1; number <= SIGRTMAX && !watching; number++) {
        if (ends(number)) {
            sigaction(number, &action, NULL);
        }
    }
    if (!watching) {
        atexit(unfinished_remove);
    }
    watching = true;
}

void unfinished_start(const char *path, bool folder)
{
    is_folder = folder;
    file_count = 0;
    owner = getpid();
    unfinished = path;
    watch();
}

bool unfinished_name(const char *file)
{
    for (int i = 0; i < file_count; i++) {
        if (strcmp(files[i], file) == 0) {
            return true;
        }
    }
    if (file_count == MOST_FILES || strlen(file) >= FILE_NAME) {
        return false;
    }
    strcpy(files[file_count], file);
    file_count = file_count + 1;
    return true;
}

const char *unfinished_file(int i)
{
    return i < file_count ? files[i] : NULL;
}

void unfinished_done(void)
{
    unfinished = NULL;
}

void signals_hold(sigset_t *before)
{
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, before);
}

void signals_go_on(const sigset_t *before)
{
    pthread_sigmask(SIG_SETMASK, before, NULL);
}
