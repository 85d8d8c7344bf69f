/* SPDX-License-Identifier: Apache-2.0
 *
 * How a finished file gets to its place: by rename where the new file can be made like the old one,
 * otherwise by a copy that damages nothing as long as the disk has room.
 *
 * The copy first takes the room, then writes what is longer than the old content, which can be cut
 * off again, and only then over the old content, which takes no more room. Until all of that is on
 * disk the finished file stays where it is.
 */
#include "place.h"
#include "unfinished.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <sys/xattr.h>
#include <unistd.h>

/* --------------------------------------------------------------------- copy ---- */

/* A pipe that somebody else has set not to wait. */
static bool wait_for(int to)
{
    struct pollfd one = {.fd = to, .events = POLLOUT};
    return errno == EINTR || (errno == EAGAIN && (poll(&one, 1, -1) >= 0 || errno == EINTR));
}

/* Copies bytes `at` to `end` of a file to where `to` stands. False: errno says why not. */
static bool copy(int from, off_t at, off_t end, int to, off_t *done)
{
    char bytes[1 << 16];
    for (*done = 0; at < end;) {
        const off_t left = end - at;
        const ssize_t got =
            pread(from, bytes, left < (off_t)sizeof bytes ? (size_t)left : sizeof bytes, at);
        if (got <= 0 && errno != EINTR) {
            return false;
        }
        for (ssize_t given = 0; given < got;) {
            const ssize_t written = write(to, bytes + given, (size_t)(got - given));
            if (written < 0 && !wait_for(to)) {
                return false;
            }
            given += written > 0 ? written : 0;
            *done += written > 0 ? written : 0;
        }
        at += got > 0 ? got : 0;
    }
    return true;
}

/* Devices and pipes have nothing to be synchronised. */
static bool on_disk(int descriptor)
{
    return fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS;
}

static void cut(int descriptor, off_t size)
{
    const int kept = errno;
    if (ftruncate(descriptor, size) != 0) {
        /* what was appended stays: nothing better can be done */
    }
    errno = kept;
}

/* Is there room? Where the file system cannot tell, the copy will. */
static bool has_room(int to, off_t size)
{
    return size == 0 || fallocate(to, FALLOC_FL_KEEP_SIZE, 0, size) == 0 ||
           (errno != ENOSPC && errno != EDQUOT && errno != EFBIG);
}

static enum placed copy_into(int from, int to)
{
    struct stat fresh, old;
    off_t done;
    if (fstat(from, &fresh) != 0 || fstat(to, &old) != 0) {
        return NOT_PLACED;
    }
    const off_t common = fresh.st_size < old.st_size ? fresh.st_size : old.st_size;
    if (!has_room(to, fresh.st_size) || lseek(to, common, SEEK_SET) < 0 ||
        (fresh.st_size > old.st_size &&
         !(copy(from, common, fresh.st_size, to, &done) && on_disk(to)))) {
        cut(to, old.st_size);
        return NOT_PLACED;
    }
    return lseek(to, 0, SEEK_SET) == 0 && copy(from, 0, common, to, &done) &&
                   ftruncate(to, fresh.st_size) == 0 && on_disk(to)
               ? PLACED
               : HALF_PLACED;
}

/* --------------------------------------------------------------------- move ---- */

/* Attributes other than those that the system gives to every file. */
static bool has_attributes(const char *names, ssize_t size)
{
    static const char common[] = "security.";
    for (ssize_t i = 0; i < size; i += (ssize_t)strlen(names + i) + 1) {
        if (strncmp(names + i, common, sizeof common - 1) != 0) {
            return true;
        }
    }
    return size < 0 && errno != ENOTSUP;
}

bool place_dress(int descriptor, const char *path, const struct stat *old)
{
    char names[4096];
    struct stat fresh;
    /* the owner before the mode, which a change of owner may clear */
    const bool owned = fstat(descriptor, &fresh) == 0 &&
                       ((fresh.st_uid == old->st_uid && fresh.st_gid == old->st_gid) ||
                        fchown(descriptor, old->st_uid, old->st_gid) == 0);
    /* but for setuid and setgid, which writing clears */
    const bool moded = fchmod(descriptor, old->st_mode & 01777) == 0;
    return owned && moded && !has_attributes(names, flistxattr(descriptor, names, sizeof names)) &&
           !has_attributes(names, listxattr(path, names, sizeof names));
}

/* Where nothing stands: what somebody else puts there meanwhile is not replaced unseen. */
static bool place_first(const char *temporary, const char *path)
{
    if (renameat2(AT_FDCWD, temporary, AT_FDCWD, path, RENAME_NOREPLACE) == 0) {
        return true;
    }
    /* not every file system knows it */
    return (errno == EINVAL || errno == ENOSYS) && rename(temporary, path) == 0;
}

static enum placed place(int descriptor, const char *temporary, const char *path)
{
    struct stat old;
    if (lstat(path, &old) != 0) {
        if (errno != ENOENT) {
            return NOT_PLACED;
        }
        if (place_first(temporary, path)) {
            return PLACED;
        }
        if (errno != EEXIST || lstat(path, &old) != 0) {
            return NOT_PLACED;
        }
    }
    if (!S_ISREG(old.st_mode)) {
        errno = EEXIST;
        return NOT_PLACED;
    }
    if (old.st_nlink == 1 && place_dress(descriptor, path, &old) && rename(temporary, path) == 0) {
        return PLACED;
    }
    const int to = open(path, O_WRONLY | O_NOFOLLOW | O_NOCTTY | O_CLOEXEC);
    if (to < 0) {
        return NOT_PLACED;
    }
    enum placed placed = copy_into(descriptor, to);
    if (close(to) != 0 && placed == PLACED) {
        placed = HALF_PLACED;
    }
    if (placed == PLACED) {
        unlink(temporary);
    }
    return placed;
}

enum placed place_file(int descriptor, const char *temporary, const char *path)
{
    if (!on_disk(descriptor)) {
        return NOT_PLACED;
    }
    sigset_t before;
    signals_hold(&before);
    const enum placed placed = place(descriptor, temporary, path);
    const int trouble = errno;
    if (placed != NOT_PLACED) {
        unfinished_done();
    }
    signals_go_on(&before);
    errno = trouble;
    return placed;
}

/* ------------------------------------------------------------------- stream ---- */

/* Cuts off what has been appended to a file, unless somebody else has written there as well. */
static void take_back(int stream, const struct stat *before, off_t *done)
{
    struct stat now;
    if (fstat(stream, &now) == 0 && now.st_size == before->st_size + *done) {
        cut(stream, before->st_size);
        lseek(stream, before->st_size, SEEK_SET);
        *done = 0;
    }
}

const char *place_stream(int descriptor, int stream, uint64_t *arrived)
{
    struct stat whole, before;
    sigset_t signals;
    off_t done = 0;
    if (fstat(descriptor, &whole) != 0 || fstat(stream, &before) != 0) {
        return strerror(errno);
    }
    const bool is_file = S_ISREG(before.st_mode);
    if (is_file) {
        signals_hold(&signals);
    }
    const char *trouble =
        copy(descriptor, 0, whole.st_size, stream, &done) && (!is_file || on_disk(stream))
            ? NULL
            : strerror(errno);
    if (is_file) {
        if (trouble != NULL) {
            take_back(stream, &before, &done);
        }
        signals_go_on(&signals);
    }
    *arrived = (uint64_t)done;
    return trouble;
}
