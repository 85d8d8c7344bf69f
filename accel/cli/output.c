/* SPDX-License-Identifier: Apache-2.0
 *
 * Output files that appear whole or not at all.
 */
#include "output.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* For the signal handler: the file to remove. */
static const char *volatile unfinished;

static void remove_unfinished(int number)
{
    const char *path = unfinished;
    if (path != NULL) {
        unlink(path);
    }
    /* not earlier: a second signal, in another thread, would end the process before the unlink */
    signal(number, SIG_DFL);
    raise(number);
}

static void watch(const char *path)
{
    static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
    unfinished = path;
    struct sigaction action = {.sa_handler = path == NULL ? SIG_DFL : remove_unfinished};
    for (size_t i = 0; i < sizeof signals / sizeof signals[0]; i++) {
        sigaction(signals[i], &action, NULL);
    }
}

static bool fail(const char *path, const char *trouble, accel_error *error)
{
    error->status = ACCEL_BAD_ARGUMENT;
    snprintf(error->text, sizeof error->text, "cannot write %.200s: %s; nothing was written", path,
             trouble);
    return false;
}

/* mkstemp makes files that only their owner may read. */
static void give_usual_mode(int descriptor)
{
    const mode_t mask = umask(0);
    umask(mask);
    fchmod(descriptor, 0666 & ~mask);
}

static bool open_temporary(accel_output *output, accel_error *error)
{
    static const char ending[] = ".XXXXXX";
    const size_t length = strlen(output->path);
    output->temporary = malloc(length + sizeof ending);
    if (output->temporary == NULL) {
        return fail(output->path, "out of memory", error);
    }
    memcpy(output->temporary, output->path, length);
    memcpy(output->temporary + length, ending, sizeof ending);
    const int descriptor = mkstemp(output->temporary);
    if (descriptor < 0) {
        fail(output->path, strerror(errno), error);
        free(output->temporary);
        return false;
    }
    watch(output->temporary);
    give_usual_mode(descriptor);
    output->file = fdopen(descriptor, "wb");
    if (output->file == NULL) {
        fail(output->path, strerror(errno), error);
        close(descriptor);
        unlink(output->temporary);
        watch(NULL);
        free(output->temporary);
        return false;
    }
    return true;
}

/* The file that a link leads to takes its place in `path`: renaming would replace the link. */
static bool follow_link(accel_output *output, accel_error *error)
{
    struct stat status;
    if (lstat(output->path, &status) != 0 || !S_ISLNK(status.st_mode)) {
        return true;
    }
    output->target = realpath(output->path, NULL);
    if (output->target == NULL) {
        return fail(output->path, "it is a link that leads to no file", error);
    }
    output->path = output->target;
    return true;
}

bool accel_output_open(accel_output *output, const char *path, accel_error *error)
{
    *output = (accel_output){.path = path};
    struct stat status;
    if (stat(path, &status) == 0 && S_ISDIR(status.st_mode)) {
        return fail(path, "it is a directory", error);
    }
    if (stat(path, &status) == 0 && !S_ISREG(status.st_mode)) {
        output->file = fopen(path, "wb");
        return output->file != NULL || fail(path, strerror(errno), error);
    }
    if (!follow_link(output, error)) {
        return false;
    }
    if (!open_temporary(output, error)) {
        free(output->target);
        return false;
    }
    return true;
}

bool accel_output_commit(accel_output *output, accel_error *error)
{
    errno = 0;
    const bool written = fflush(output->file) == 0 && !ferror(output->file);
    const bool closed = fclose(output->file) == 0;
    output->file = NULL;
    if (!written || !closed ||
        (output->temporary != NULL && rename(output->temporary, output->path) != 0)) {
        fail(output->path, errno == 0 ? "the device took no more" : strerror(errno), error);
        accel_output_abandon(output);
        return false;
    }
    watch(NULL);
    free(output->temporary);
    free(output->target);
    return true;
}

void accel_output_abandon(accel_output *output)
{
    if (output->file != NULL) {
        fclose(output->file);
    }
    if (output->temporary != NULL) {
        unlink(output->temporary);
        watch(NULL);
        free(output->temporary);
    }
    free(output->target);
    *output = (accel_output){0};
}
