/* SPDX-License-Identifier: Apache-2.0
 *
 * Hits of the rays of a text file, one line for each: "geom prim t u v" or "miss". Numbers have 17
 * digits, which name a double exactly.
 */
#include "trace.h"

#include "file.h"
#include "ray_text.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static void write_hit(const accel_tracing *tracing, const accel_ray *ray, FILE *out)
{
    accel_hit hit;
    if (accel_closest(tracing->structure, ray, &hit, NULL)) {
        fprintf(out, "%" PRIu32 " %" PRIu32 " %.17g %.17g %.17g\n", hit.geom, hit.prim, hit.t,
                hit.u, hit.v);
    } else {
        fprintf(out, "miss\n");
    }
}

static bool trace_line(const accel_tracing *tracing, const accel_file *file, const char *line,
                       size_t number, FILE *out, accel_error *error)
{
    accel_ray ray;
    if (accel_read_ray(line, &ray)) {
        write_hit(tracing, &ray, out);
        return true;
    }
    error->status = ACCEL_BAD_ARGUMENT;
    snprintf(error->text, sizeof error->text,
             "%.200s:%zu: '%.80s' is no ray; allowed is ox oy oz dx dy dz [tmin tmax [geom prim]]; "
             "nothing was written",
             file->path, number, line);
    return false;
}

bool accel_trace_text(accel_tracing *tracing, const char *path, FILE *out, accel_error *error)
{
    accel_file file;
    if (!accel_file_read(&file, path, error)) {
        return false;
    }
    bool fine = true;
    char *line = file.bytes;
    char *const end = file.bytes + file.size;
    for (size_t number = 1; fine && line < end; number++) {
        char *stop = memchr(line, '\n', (size_t)(end - line));
        stop = stop == NULL ? end : stop;
        *stop = '\0';
        line[strcspn(line, "\r")] = '\0';
        fine = trace_line(tracing, &file, line, number, out, error);
        accel_progress_show(&tracing->progress, "tracing",
                            (double)(line - file.bytes) / (double)file.size);
        line = stop + 1;
    }
    accel_progress_clear(&tracing->progress);
    free(file.bytes);
    return fine;
}
