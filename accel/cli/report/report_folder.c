/* SPDX-License-Identifier: Apache-2.0
 *
 * The folder of a report: what of a former one may be replaced, and how it is.
 */
#include "report_folder.h"

#include "tool/sink.h"
#include "tool/unfinished.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The first line of a report's page: what tells a former report from a folder of something else. */
static const char mark[] = "<!DOCTYPE html><!-- accel report -->";

/* How the line of that page begins that names the report's files. */
static const char list[] = "<!-- files: ";

static const char page[] = "index.html";

enum { MOST_TEXT = 200 };

static bool fail(const struct folder *folder, const char *trouble, const char *state,
                 accel_error *error)
{
    error->status = ACCEL_BAD_ARGUMENT;
    snprintf(error->text, sizeof error->text, "cannot write %.150s: %s; %s", folder->name, trouble,
             state);
    return false;
}

/* Names a file in a folder. False: too long, and errno says so. */
static bool join(char path[MOST_PATH], const char *folder, const char *name)
{
    const bool fits = (size_t)snprintf(path, MOST_PATH, "%s/%s", folder, name) < MOST_PATH;
    if (!fits) {
        errno = ENAMETOOLONG;
    }
    return fits;
}

/* ---------------------------------------------------------------- former report ---- */

/* The names of the files of the report in `path`, each between spaces; NULL: it holds none. To be
 * freed. */
static char *former_files(const char *path)
{
    char name[MOST_PATH], *line = NULL, *found = NULL;
    FILE *file = join(name, path, page) ? fopen(name, "re") : NULL;
    if (file == NULL) {
        return NULL;
    }
    size_t capacity = 0;
    const bool is =
        getline(&line, &capacity, file) > 0 && strncmp(line, mark, sizeof mark - 1) == 0;
    while (is && found == NULL && getline(&line, &capacity, file) > 0) {
        found = strncmp(line, list, sizeof list - 1) == 0 ? strdup(line) : NULL;
    }
    free(line);
    fclose(file);
    return found;
}

/* Has the former report made it? Nobody but the user makes a folder or a link of that name. */
static bool is_former(const char *former, int folder, const char *name)
{
    char between[300];
    struct stat status;
    snprintf(between, sizeof between, " %s ", name);
    return former != NULL && strchr(name, ' ') == NULL && strstr(former, between) != NULL &&
           fstatat(folder, name, &status, AT_SYMLINK_NOFOLLOW) == 0 && S_ISREG(status.st_mode);
}

/* What keeps a new report out of a folder: anything that no report has made, but for `own`. */
static const char *why_not(const char *path, const char *own, char text[MOST_TEXT])
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
            strcmp(e->d_name, own) == 0 || is_former(former, dirfd(folder), e->d_name)) {
            continue;
        }
        trouble = "the folder is there and holds no report";
        if (former != NULL) {
            snprintf(text, MOST_TEXT, "the folder holds '%.100s', which no report has made",
                     e->d_name);
            trouble = text;
        }
    }
    free(former);
    closedir(folder);
    return trouble;
}

/* ------------------------------------------------------------------------- open ---- */

static const char *find_place(struct folder *folder, char text[MOST_TEXT])
{
    char path[MOST_PATH];
    size_t length = strlen(folder->name);
    while (length > 1 && folder->name[length - 1] == '/') {
        length--;
    }
    if (length >= sizeof path) {
        return strerror(ENAMETOOLONG);
    }
    snprintf(path, sizeof path, "%.*s", (int)length, folder->name);
    struct stat status;
    if (strcmp(path, "-") == 0 || (stat(path, &status) == 0 && !S_ISDIR(status.st_mode))) {
        return "it is a file, not a folder";
    }
    const char *trouble = place_find(&folder->place, path);
    if (trouble == NULL && folder->place.kind == PLACE_FOLDER) {
        trouble = why_not(folder->place.path, "", text);
    }
    return trouble;
}

/* Signals wait, so that none comes between the folder and its watch. */
static const char *make_temporary(struct folder *folder)
{
    sigset_t before;
    signals_hold(&before);
    const bool made = place_make(&folder->place, true, folder->temporary) == 0;
    const char *trouble = made ? NULL : strerror(errno);
    if (made) {
        unfinished_start(folder->temporary, true);
    }
    signals_go_on(&before);
    return trouble;
}

bool folder_open(struct folder *folder, const char *path, accel_error *error)
{
    char text[MOST_TEXT];
    *folder = (struct folder){.name = path};
    const char *trouble = find_place(folder, text);
    trouble = trouble == NULL ? make_temporary(folder) : trouble;
    return trouble == NULL || fail(folder, trouble, "nothing was written", error);
}

/* ------------------------------------------------------------------------ files ---- */

FILE *folder_write(struct folder *folder, const char *name)
{
    char path[MOST_PATH];
    if (!join(path, folder->temporary, name)) {
        return NULL;
    }
    if (!unfinished_name(name)) {
        errno = EMFILE;
        return NULL;
    }
    const int descriptor = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    FILE *file = descriptor < 0 ? NULL : sink_open(descriptor, &folder->trouble);
    if (file == NULL && descriptor >= 0) {
        close(descriptor);
    }
    return file;
}

FILE *folder_read(struct folder *folder, const char *name)
{
    char path[MOST_PATH];
    return join(path, folder->temporary, name) ? fopen(path, "re") : NULL;
}

const char *folder_close(struct folder *folder, FILE *file)
{
    return sink_close(file, &folder->trouble) ? NULL : strerror(folder->trouble);
}

void folder_remove(struct folder *folder, const char *name)
{
    char path[MOST_PATH];
    if (join(path, folder->temporary, name)) {
        unlink(path);
    }
}

static bool is_there(const struct folder *folder, const char *name)
{
    char path[MOST_PATH];
    return join(path, folder->temporary, name) && access(path, F_OK) == 0;
}

void folder_list(const struct folder *folder, FILE *to)
{
    fputs(list, to);
    for (int i = 0; unfinished_file(i) != NULL; i++) {
        if (is_there(folder, unfinished_file(i))) {
            fprintf(to, "%s ", unfinished_file(i));
        }
    }
    fputs("-->\n", to);
}

/* ----------------------------------------------------------------------- commit ---- */

/* Is all of it on disk? */
static bool synchronise(const struct folder *folder)
{
    bool fine = true;
    for (int i = 0; fine && unfinished_file(i) != NULL; i++) {
        char path[MOST_PATH];
        if (is_there(folder, unfinished_file(i))) {
            const int file = join(path, folder->temporary, unfinished_file(i))
                                 ? open(path, O_WRONLY | O_CLOEXEC)
                                 : -1;
            fine = file >= 0 && (fsync(file) == 0 || errno == EINVAL);
            fine = file >= 0 && close(file) == 0 && fine;
        }
    }
    return fine;
}

/* Moves one file in, with mode and owner of the one that it replaces. */
static bool move_in(const struct folder *folder, const char *name)
{
    char from[MOST_PATH], to[MOST_PATH];
    struct stat old;
    if (!join(from, folder->temporary, name) || !join(to, folder->place.path, name)) {
        return false;
    }
    if (lstat(to, &old) == 0) {
        const int file = open(from, O_WRONLY | O_CLOEXEC);
        if (file >= 0) {
            place_dress(file, to, &old);
            close(file);
        }
    }
    return rename(from, to) == 0;
}

/* The page last. False: errno says why, and only *moved of them are in. */
static bool move_all_in(const struct folder *folder, int *moved)
{
    *moved = 0;
    for (int i = 0; unfinished_file(i) != NULL; i++) {
        const char *name = unfinished_file(i);
        if (strcmp(name, page) != 0 && is_there(folder, name)) {
            if (!move_in(folder, name)) {
                return false;
            }
            ++*moved;
        }
    }
    return move_in(folder, page);
}

/* Removes what the former report had and this one has not. */
static void remove_former(const struct folder *folder, const char *former)
{
    DIR *at = opendir(folder->place.path);
    for (const struct dirent *e = at == NULL ? NULL : readdir(at); e != NULL; e = readdir(at)) {
        bool is_new = false;
        for (int i = 0; unfinished_file(i) != NULL; i++) {
            is_new = is_new || strcmp(unfinished_file(i), e->d_name) == 0;
        }
        if (!is_new && is_former(former, dirfd(at), e->d_name)) {
            unlinkat(dirfd(at), e->d_name, 0);
        }
    }
    if (at != NULL) {
        closedir(at);
    }
}

/* Into the folder that is there. */
static bool replace(const struct folder *folder, accel_error *error)
{
    char text[MOST_TEXT];
    const char *own = strrchr(folder->temporary, '/');
    const char *trouble = why_not(folder->place.path, own == NULL ? "" : own + 1, text);
    if (trouble != NULL) {
        return fail(folder, trouble, "nothing was written", error);
    }
    char *former = former_files(folder->place.path);
    int moved;
    const bool fine = move_all_in(folder, &moved);
    if (!fine) {
        fail(folder, strerror(errno),
             moved == 0 ? "nothing was written" : "it holds files of two reports", error);
    } else if (former != NULL) {
        remove_former(folder, former);
    }
    free(former);
    return fine;
}

static bool place(const struct folder *folder, accel_error *error)
{
    struct stat status;
    if (lstat(folder->place.path, &status) == 0) {
        return replace(folder, error);
    }
    if (rename(folder->temporary, folder->place.path) != 0) {
        return fail(folder, strerror(errno), "nothing was written", error);
    }
    unfinished_done();
    return true;
}

bool folder_commit(struct folder *folder, accel_error *error)
{
    sigset_t before;
    if (!synchronise(folder)) {
        fail(folder, strerror(errno), "nothing was written", error);
        folder_abandon(folder);
        return false;
    }
    signals_hold(&before);
    const bool fine = place(folder, error);
    folder_abandon(folder);
    signals_go_on(&before);
    return fine;
}

void folder_abandon(struct folder *folder)
{
    unfinished_remove();
    folder->temporary[0] = '\0';
}
