/* SPDX-License-Identifier: Apache-2.0
 *
 * A stream of stdio around a descriptor and the errno of its first failure.
 */
#include "sink.h"

#include <errno.h>
#include <stdlib.h>
#include <sys/types.h>
#include <unistd.h>

typedef struct sink {
    int descriptor;
    int *trouble;
} sink;

/* Takes all, or fails: what stdio asks of it. */
static ssize_t take(void *cookie, const char *bytes, size_t count)
{
    const sink *s = cookie;
    size_t done = 0;
    while (done < count && *s->trouble == 0) {
        const ssize_t written = write(s->descriptor, bytes + done, count - done);
        if (written < 0 && errno != EINTR) {
            *s->trouble = errno;
        }
        done += written > 0 ? (size_t)written : 0;
    }
    return *s->trouble == 0 ? (ssize_t)done : 0;
}

static int end(void *cookie)
{
    sink *s = cookie;
    const bool fine = close(s->descriptor) == 0;
    if (!fine && *s->trouble == 0) {
        *s->trouble = errno;
    }
    free(s);
    return fine ? 0 : -1;
}

FILE *sink_open(int descriptor, int *trouble)
{
    sink *s = malloc(sizeof *s);
    if (s == NULL) {
        return NULL;
    }
    *s = (sink){descriptor, trouble};
    FILE *file = fopencookie(s, "w", (cookie_io_functions_t){.write = take, .close = end});
    if (file == NULL) {
        free(s);
    }
    return file;
}

bool sink_close(FILE *file, int *trouble)
{
    const bool written = fflush(file) == 0 && !ferror(file);
    const bool closed = fclose(file) == 0;
    if (written && closed) {
        return true;
    }
    *trouble = *trouble == 0 ? EIO : *trouble;
    return false;
}
