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

/* How the line of that page begins that names the report's files. */
static const char list[] = "<!-- files: ";

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
    /* not earlier: a second signal, in another thread, would end the process before it is done */
    signal(number, SIG_DFL);
    raise(number);
}

static void watch(void)
{
    static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
    const struct sigaction action = {.sa_handler = remove_and_end};
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

/* The names of the files of the report in `path`, each between spaces; NULL: it holds none. To be
 * freed. */
static char *former_files(const char *path)
{
    char name[4096], *line = NULL, *found = NULL;
    snprintf(name, sizeof name, "%.4000s/index.html", path);
    FILE *file = fopen(name, "r");
    if (file == NULL) {
        return NULL;
    }
    size_t room = 0;
    bool is = getline(&line, &room, file) > 0 && strncmp(line, mark, sizeof mark - 1) == 0;
    while (is && found == NULL && getline(&line, &room, file) > 0) {
        found = strncmp(line, list, sizeof list - 1) == 0 ? strdup(line) : NULL;
    }
    free(line);
    fclose(file);
    return found;
}

static bool is_former(const char *former, const char *name)
{
    char between[300];
    snprintf(between, sizeof between, " %s ", name);
    return former != NULL && strchr(name, ' ') == NULL && strstr(former, between) != NULL;
}

/* What keeps a new report from taking the folder's place: anything that no report has made. */
static const char *why_not_replaced(const char *path, char text[200])
{
    DIR *folder = opendir(path);
    if (folder == NULL) {
        return strerror(errno);
    }
    char *former = former_files(path);
    const char *trouble = NULL;
    for (const struct dirent *e = readdir(folder); e != NULL && trouble == NULL;
         e = readdir(folder)) {
        if (strcmp(e->d_name, ".") == 0 || strcmp(e->d_name, "..") == 0 ||
            is_former(former, e->d_name)) {
            continue;
        }
        trouble = "the folder is there and holds no report";
        if (former != NULL) {
            snprintf(text, 200, "the folder holds '%.100s', which no report has made", e->d_name);
            trouble = text;
        }
    }
    free(former);
    closedir(folder);
    return trouble;
}

/* `path` without slashes at its end: can a folder be moved there? */
static const char *why_not(const char *path, char text[200])
{
    const char *slash = strrchr(path, '/'), *last = slash == NULL ? path : slash + 1;
    if (strcmp(last, "") == 0 || strcmp(last, ".") == 0 || strcmp(last, "..") == 0) {
        return "give the folder a name";
    }
    struct stat status, parent;
    if (lstat(path, &status) != 0) {
        return errno == ENOENT ? NULL : strerror(errno);
    }
    if (!S_ISDIR(status.st_mode)) {
        return S_ISLNK(status.st_mode) ? "it is a symbolic link, not a folder"
                                       : "it is a file, not a folder";
    }
    char above[4096];
    snprintf(above, sizeof above, "%.4000s/..", path);
    if (stat(above, &parent) != 0 || parent.st_dev != status.st_dev) {
        return "a file system is mounted there; give a folder in it";
    }
    return why_not_replaced(path, text);
}

static const char *make_temporary(accel_folder *folder)
{
    snprintf(folder->temporary, sizeof folder->temporary, "%s.XXXXXX", folder->path);
    if (mkdtemp(folder->temporary) == NULL) {
        folder->temporary[0] = '\0';
        return strerror(errno);
    }
    const mode_t mask = umask(0);
    umask(mask);
    chmod(folder->temporary, 0777 & ~mask);
    return NULL;
}

bool accel_folder_open(accel_folder *folder, const char *path, accel_error *error)
{
    *folder = (accel_folder){.temporary = ""};
    size_t length = strlen(path);
    while (length > 1 && path[length - 1] == '/') {
        length--;
    }
    if (length == 0 || length >= sizeof folder->path) {
        return fail("-o DIR", length == 0 ? "the name is empty" : "the name is too long", error);
    }
    memcpy(folder->path, path, length);
    char text[200];
    const char *trouble = why_not(folder->path, text);
    trouble = trouble == NULL ? make_temporary(folder) : trouble;
    if (trouble != NULL) {
        return fail(path, trouble, error);
    }
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

void accel_folder_list(FILE *page)
{
    fputs(list, page);
    for (int i = 0; i < file_count; i++) {
        fprintf(page, "%s ", files[i]);
    }
    fputs("-->\n", page);
}

/* The former report, now under the temporary name. */
static void remove_former(const char *path)
{
    DIR *folder = opendir(path);
    char *former = former_files(path);
    for (const struct dirent *e = folder == NULL ? NULL : readdir(folder); e != NULL;
         e = readdir(folder)) {
        if (is_former(former, e->d_name)) {
            unlinkat(dirfd(folder), e->d_name, 0);
        }
    }
    free(former);
    if (folder != NULL) {
        closedir(folder);
    }
    rmdir(path);
}

bool accel_folder_commit(accel_folder *folder, accel_error *error)
{
    char text[200];
    const char *trouble = why_not(folder->path, text);
    if (trouble == NULL && rename(folder->temporary, folder->path) != 0) {
        /* over nothing or an empty folder; a former report changes places with the new one */
        if ((errno == ENOTEMPTY || errno == EEXIST) &&
            renameat2(AT_FDCWD, folder->temporary, AT_FDCWD, folder->path, RENAME_EXCHANGE) == 0) {
            unfinished = NULL;
            remove_former(folder->temporary);
        } else {
            trouble = strerror(errno);
        }
    }
    if (trouble != NULL) {
        fail(folder->path, trouble, error);
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
