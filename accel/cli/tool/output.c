/* SPDX-License-Identifier: Apache-2.0
 *
 * One output file from its opening to its place.
 */
#include "output.h"

#include "sink.h"
#include "unfinished.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

static bool fail(const struct output *output, const char *trouble, const char *state,
                 accel_error *error)
{
    error->status = ACCEL_BAD_ARGUMENT;
    snprintf(error->text, sizeof error->text, "cannot write %.150s: %s; %s", output->path, trouble,
             state);
    return false;
}

bool output_failed(const struct output *output, const char *otherwise, accel_error *error)
{
    return fail(output, output->trouble != 0 ? strerror(output->trouble) : otherwise,
                "nothing was written", error);
}

/* Signals wait, so that none comes between the file and its watch. */
static const char *make_temporary(struct output *output)
{
    sigset_t before;
    signals_hold(&before);
    const bool stream = output->place.kind == PLACE_STREAM;
    output->descriptor = stream ? memfd_create("accel", MFD_CLOEXEC)
                                : place_make(&output->place, false, output->temporary);
    const char *trouble = output->descriptor < 0 ? strerror(errno) : NULL;
    if (trouble == NULL && !stream) {
        unfinished_start(output->temporary, false);
    }
    signals_go_on(&before);
    return trouble;
}

static const char *open_output(struct output *output, const char *path)
{
    const char *trouble = place_find(&output->place, path);
    if (trouble == NULL) {
        trouble = output->place.kind == PLACE_FOLDER ? "it is a directory" : make_temporary(output);
    }
    if (trouble != NULL) {
        return trouble;
    }
    output->file = sink_open(output->descriptor, &output->trouble);
    return output->file == NULL ? strerror(errno) : NULL;
}

bool output_open(struct output *output, const char *path, accel_error *error)
{
    *output = (struct output){.path = strcmp(path, "-") == 0 ? "standard output" : path,
                              .descriptor = -1};
    const char *trouble = open_output(output, path);
    if (trouble == NULL) {
        return true;
    }
    fail(output, trouble, "nothing was written", error);
    output_abandon(output);
    return false;
}

static bool commit_stream(const struct output *output, accel_error *error)
{
    uint64_t done = 0;
    char state[60] = "nothing was written";
    fflush(stdout); /* what was printed before stands before it */
    const char *trouble = place_stream(output->descriptor, output->place.descriptor, &done);
    if (done > 0) {
        snprintf(state, sizeof state, "only the first %" PRIu64 " bytes were written", done);
    }
    return trouble == NULL || fail(output, trouble, state, error);
}

static bool commit_file(const struct output *output, accel_error *error)
{
    char state[300] = "nothing was written";
    const enum placed placed =
        place_file(output->descriptor, output->temporary, output->place.path);
    const char *trouble = strerror(errno);
    if (placed == HALF_PLACED) {
        snprintf(state, sizeof state, "its old content is damaged, the new one is in %.250s",
                 output->temporary);
    }
    return placed == PLACED || fail(output, trouble, state, error);
}

bool output_commit(struct output *output, accel_error *error)
{
    bool fine = fflush(output->file) == 0 && !ferror(output->file) && output->trouble == 0;
    if (!fine) {
        output_failed(output, "the device took no more", error);
    } else if (output->place.kind == PLACE_STREAM) {
        fine = commit_stream(output, error);
    } else {
        fine = commit_file(output, error);
    }
    output_abandon(output);
    return fine;
}

/* Nothing is left to be removed of what is in its place. */
void output_abandon(struct output *output)
{
    unfinished_remove();
    if (output->file != NULL) {
        fclose(output->file);
    } else if (output->descriptor >= 0) {
        close(output->descriptor);
    }
    if (output->place.descriptor >= 0) {
        close(output->place.descriptor);
    }
    *output = (struct output){.descriptor = -1, .place.descriptor = -1};
}
