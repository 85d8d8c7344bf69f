/* SPDX-License-Identifier: Apache-2.0
 *
 * An output folder that appears whole or not at all.
 *
 * A signal handler may unlink but not read a folder, so the names of all files are kept.
 */
#include "report_folder.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The first line of a report's page: what tells a former report from a folder of something else. */
static const char mark[] = "<!DOCTYPE html><!-- accel report -->";

enum { MOST_FILES = 64 };

/* For the signal handler: the folder to remove, and its files. */
static const char *volatile unfinished;
static char files[MOST_FILES][64];
static volatile sig_atomic_t file_count;

static void remove_unfinished(void)
{
    const char *path = unfinished;
    const int folder = path == NULL ? -1 : open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) {
        return;
    }
    for (int i = 0; i < file_count; i++) {
        unlinkat(folder, files[i], 0);
    }
    close(folder);
    rmdir(path);
    unfinished = NULL;
}

static void remove_and_end(int number)
{
    remove_unfinished();
    /* the handler was reset when it was called: this ends the process as the signal means */
    raise(number);
}

static void watch(void)
{
    static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
    const struct sigaction action = {.sa_handler = remove_and_end, .sa_flags = (int)SA_RESETHAND};
    for (size_t i = 0; i < sizeof signals / sizeof signals[0]; i++) {
        sigaction(signals[i], &action, NULL);
    }
    atexit(remove_unfinished);
}

static bool fail(const char *path, const char *trouble, accel_error *error)
{
    error->status = ACCEL_BAD_ARGUMENT;
    snprintf(error->text, sizeof error->text, "cannot write %.200s: %s; nothing was written", path,
             trouble);
    return false;
}

static bool holds_report(const char *path)
{
    char name[4096], line[sizeof mark] = "";
    snprintf(name, sizeof name, "%.4000s/index.html", path);
    FILE *file = fopen(name, "r");
    if (file == NULL) {
        return false;
    }
    const bool is = fgets(line, sizeof line, file) != NULL && strcmp(line, mark) == 0;
    fclose(file);
    return is;
}

static bool is_empty(const char *path)
{
    DIR *folder = opendir(path);
    int entries = 0;
    while (folder != NULL && readdir(folder) != NULL) {
        entries++;
    }
    if (folder != NULL) {
        closedir(folder);
    }
    return entries == 2;
}

static const char *why_not(const char *path)
{
    struct stat status;
    if (stat(path, &status) != 0) {
        return errno == ENOENT ? NULL : strerror(errno);
    }
    if (!S_ISDIR(status.st_mode)) {
        return "it is a file, not a folder";
    }
    return is_empty(path) || holds_report(path) ? NULL : "the folder is there and holds no report";
}

bool accel_folder_open(accel_folder *folder, const char *path, accel_error *error)
{
    *folder = (accel_folder){.path = path};
    size_t length = strlen(path);
    while (length > 1 && path[length - 1] == '/') {
        length--;
    }
    if (length == 0 || length > sizeof folder->temporary - 8) {
        return fail(path, length == 0 ? "the name is empty" : "the name is too long", error);
    }
    const char *trouble = why_not(path);
    if (trouble != NULL) {
        return fail(path, trouble, error);
    }
    snprintf(folder->temporary, sizeof folder->temporary, "%.*s.XXXXXX", (int)length, path);
    if (mkdtemp(folder->temporary) == NULL) {
        trouble = strerror(errno);
        folder->temporary[0] = '\0';
        return fail(path, trouble, error);
    }
    const mode_t mask = umask(0);
    umask(mask);
    chmod(folder->temporary, 0777 & ~mask);
    file_count = 0;
    unfinished = folder->temporary;
    watch();
    return true;
}

static void remember(const char *name)
{
    for (int i = 0; i < file_count; i++) {
        if (strcmp(files[i], name) == 0) {
            return;
        }
    }
    if (file_count < MOST_FILES) {
        snprintf(files[file_count], sizeof files[0], "%.63s", name);
        file_count = file_count + 1;
    }
}

FILE *accel_folder_file(accel_folder *folder, const char *name, const char *mode)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%.64s", folder->temporary, name);
    remember(name);
    return fopen(path, mode);
}

void accel_folder_remove(accel_folder *folder, const char *name)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%.64s", folder->temporary, name);
    unlink(path);
}

/* The former report, now under the temporary name: its files may be more than ours. */
static void remove_former(const char *path)
{
    DIR *folder = opendir(path);
    if (folder == NULL) {
        return;
    }
    for (const struct dirent *e = readdir(folder); e != NULL; e = readdir(folder)) {
        unlinkat(dirfd(folder), e->d_name, 0);
    }
    closedir(folder);
    rmdir(path);
}

bool accel_folder_commit(accel_folder *folder, accel_error *error)
{
    /* over nothing or an empty folder; a former report changes places with the new one */
    bool done = rename(folder->temporary, folder->path) == 0;
    if (!done && (errno == ENOTEMPTY || errno == EEXIST) && holds_report(folder->path)) {
        done = renameat2(AT_FDCWD, folder->temporary, AT_FDCWD, folder->path, RENAME_EXCHANGE) == 0;
        if (done) {
            unfinished = NULL;
            remove_former(folder->temporary);
        }
    }
    if (!done) {
        fail(folder->path, strerror(errno), error);
        accel_folder_abandon(folder);
        return false;
    }
    unfinished = NULL;
    return true;
}

void accel_folder_abandon(accel_folder *folder)
{
    remove_unfinished();
    folder->temporary[0] = '\0';
}
