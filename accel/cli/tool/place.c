/* SPDX-License-Identifier: Apache-2.0
 *
 * Where a name leads: links, descriptors, and names for what is not finished.
 */
#include "place.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_LINKS = 40, MOST_TRIES = 100, LETTERS = 6, LONGEST_BASE = 200 };

/* -------------------------------------------------------------------- names ---- */

/* Length of the folder's name in front of the last name, its slash included. */
static size_t folder_length(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash == NULL ? 0 : (size_t)(slash + 1 - path);
}

/* The descriptor that a path such as /dev/fd/1 or /proc/self/fd/1 names in this process, or -1. */
static int own_descriptor(const char *path)
{
    static const char *const own[] = {"/proc/self/fd", "/proc/thread-self/fd"};
    const size_t length = folder_length(path);
    const char *number = path + length;
    char folder[MOST_PATH] = ".", real[MOST_PATH], wanted[MOST_PATH];
    if (*number == '\0' || strlen(number) > 9 || number[strspn(number, "0123456789")] != '\0') {
        return -1;
    }
    if (length > 0) {
        snprintf(folder, sizeof folder, "%.*s", (int)length, path);
    }
    for (size_t i = 0; i < sizeof own / sizeof own[0] && realpath(folder, real) != NULL; i++) {
        if (realpath(own[i], wanted) != NULL && strcmp(real, wanted) == 0) {
            return atoi(number);
        }
    }
    return -1;
}

/* Puts what a link says in its place. */
static bool put_link(char path[MOST_PATH], const char *link)
{
    const size_t kept = *link == '/' ? 0 : folder_length(path);
    if (kept + strlen(link) >= MOST_PATH) {
        errno = ENAMETOOLONG;
        return false;
    }
    strcpy(path + kept, link);
    return true;
}

/* Follows the links at the end of a path, also those that lead to nothing, up to a descriptor of
 * this process, whose number becomes *own. False: errno says why not. */
static bool follow(char path[MOST_PATH], int *own)
{
    char link[MOST_PATH];
    for (int i = 0; i < MOST_LINKS; i++) {
        *own = own_descriptor(path);
        const ssize_t length = *own >= 0 ? -1 : readlink(path, link, sizeof link - 1);
        if (length < 0) {
            return true;
        }
        link[length] = '\0';
        if (!put_link(path, link)) {
            return false;
        }
    }
    errno = ELOOP;
    return false;
}

/* ------------------------------------------------------------- what is there ---- */

static const char *take_descriptor(struct place *place, int own)
{
    const int flags = fcntl(own, F_GETFL);
    place->kind = PLACE_STREAM;
    if (flags >= 0 && (flags & O_ACCMODE) == O_RDONLY) {
        return "it is closed or only open to be read";
    }
    place->descriptor = flags < 0 ? -1 : fcntl(own, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    return place->descriptor < 0 ? strerror(errno) : NULL;
}

/* A pipe waits here for its reader. */
static const char *open_stream(struct place *place, const char *name, const struct stat *status)
{
    if (S_ISBLK(status->st_mode)) {
        return "it is a block device";
    }
    place->kind = PLACE_STREAM;
    place->descriptor = open(name, O_WRONLY | O_NOCTTY | O_CLOEXEC);
    return place->descriptor < 0 ? strerror(errno) : NULL;
}

/* To open it is the only question about a file's mode, flags and mount that has an answer. */
static const char *try_file(struct place *place, const char *name, const struct stat *status)
{
    struct stat real;
    const int descriptor = open(name, O_WRONLY | O_NOCTTY | O_CLOEXEC);
    if (descriptor < 0) {
        return strerror(errno);
    }
    close(descriptor);
    place->kind = PLACE_FILE;
    const bool same = lstat(place->path, &real) == 0 && real.st_dev == status->st_dev &&
                      real.st_ino == status->st_ino;
    return same ? NULL : "it leads to a file without a name";
}

const char *place_find(struct place *place, const char *name)
{
    *place = (struct place){.kind = PLACE_NEW, .descriptor = -1};
    if (strcmp(name, "-") == 0) {
        return take_descriptor(place, STDOUT_FILENO);
    }
    if (*name == '\0' || strlen(name) >= MOST_PATH) {
        return *name == '\0' ? "the name is empty" : strerror(ENAMETOOLONG);
    }
    /* the kernel first: it may forbid to follow a link that readlink can read */
    struct stat status;
    const bool there = stat(name, &status) == 0;
    int own = -1;
    strcpy(place->path, name);
    if ((!there && errno != ENOENT) || !follow(place->path, &own)) {
        return strerror(errno);
    }
    if (own >= 0) {
        return take_descriptor(place, own);
    }
    if (!there) {
        return NULL;
    }
    if (S_ISDIR(status.st_mode)) {
        place->kind = PLACE_FOLDER;
        return NULL;
    }
    return S_ISREG(status.st_mode) ? try_file(place, name, &status)
                                   : open_stream(place, name, &status);
}

/* -------------------------------------------------------------- not finished ---- */

/* Ends the name with letters that nobody can foresee. */
static bool draw_letters(char *end)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
    unsigned char drawn[LETTERS];
    if (getentropy(drawn, sizeof drawn) != 0) {
        return false;
    }
    for (int i = 0; i < LETTERS; i++) {
        end[i] = letters[drawn[i] % (sizeof letters - 1)];
    }
    return true;
}

/* Not by mkstemp: a new file gets the mode that the umask, or the folder's access list, says. */
static int make(char *name, bool folder, mode_t mode)
{
    char *end = name + strlen(name) - LETTERS;
    for (int i = 0; i < MOST_TRIES; i++) {
        if (!draw_letters(end)) {
            return -1;
        }
        const int made =
            folder ? mkdir(name, mode) : open(name, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        if (made >= 0 || errno != EEXIST) {
            return made;
        }
    }
    return -1;
}

int place_make(const struct place *place, bool folder, char temporary[MOST_PATH])
{
    const bool is_new = place->kind == PLACE_NEW;
    const size_t kept = folder_length(place->path);
    const int length = place->kind == PLACE_FOLDER
                           ? snprintf(temporary, MOST_PATH, "%s/unfinished.XXXXXX", place->path)
                           : snprintf(temporary, MOST_PATH, "%.*s%.*s.XXXXXX", (int)kept,
                                      place->path, LONGEST_BASE, place->path + kept);
    if (length >= MOST_PATH) {
        errno = ENAMETOOLONG;
        return -1;
    }
    const mode_t mode = folder ? 0777 : 0666;
    const int made = make(temporary, folder, is_new ? mode : mode & 0700);
    if (made >= 0 || place->kind != PLACE_FILE ||
        (errno != EACCES && errno != EPERM && errno != EROFS)) {
        return made;
    }
    const char *elsewhere = getenv("TMPDIR");
    snprintf(temporary, MOST_PATH, "%.4000s/accel.XXXXXX",
             elsewhere == NULL || *elsewhere == '\0' ? "/tmp" : elsewhere);
    return make(temporary, folder, 0600);
}
