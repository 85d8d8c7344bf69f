/* SPDX-License-Identifier: Apache-2.0
 *
 * Hits of the rays of a text file, one line for each ray: "geom prim t u v" or "miss". Numbers have
 * 17 digits, which name a double exactly.
 */
#include "trace.h"

#include "tool/file.h"
#include "scenes/ray_lines.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static void write_hit(const struct tracing *tracing, const accel_ray *ray, FILE *out,
                      accel_query *query)
{
    accel_hit hit;
    if (accel_closest(tracing->structure, ray, &hit, query)) {
        fprintf(out, "%" PRIu32 " %" PRIu32 " %.17g %.17g %.17g\n", hit.geom, hit.prim, hit.t,
                hit.u, hit.v);
    } else {
        fprintf(out, "miss\n");
    }
}

static bool refuse(const struct file *file, const struct ray_lines *lines, accel_error *error)
{
    error->status = ACCEL_BAD_ARGUMENT;
    snprintf(error->text, sizeof error->text,
             "%.200s:%zu: '%.80s' is no ray; allowed is ox oy oz dx dy dz [tmin tmax [geom prim]]; "
             "nothing was written",
             file->path, lines->number, lines->line);
    return false;
}

static bool trace_lines(struct tracing *tracing, const struct file *file, FILE *out,
                        accel_error *error)
{
    struct ray_lines lines = ray_lines_start(file);
    accel_ray ray;
    enum ray_line found;
    uint64_t rays = 0;
    accel_query query = {NULL, 0, 0, 0, 0};
    size_t first_refused = 0;
    while ((found = next_ray(&lines, &ray)) == RAY_LINE) {
        write_hit(tracing, &ray, out, &query);
        if (query.refused != 0 && first_refused == 0) {
            first_refused = lines.number;
        }
        progress_show(&tracing->progress, "tracing",
                      (double)(lines.at - file->bytes) / (double)file->size);
        rays++;
    }
    if (found == NO_RAY_LINE) {
        return refuse(file, &lines, error);
    }
    if (rays == 0) {
        error->status = ACCEL_BAD_ARGUMENT;
        snprintf(error->text, sizeof error->text, "%.200s: holds no ray; nothing was written",
                 file->path);
    }
    if (query.refused != 0) {
        progress_clear(&tracing->progress);
        fprintf(
            stderr,
            "accel trace: %.200s:%zu: %" PRIu64 " of %" PRIu64 " rays cannot be traced, this one "
            "first; allowed are finite numbers and a direction other than 0; they are written as "
            "misses\n",
            file->path, first_refused, (uint64_t)query.refused, rays);
    }
    return rays != 0;
}

bool trace_text(struct tracing *tracing, const char *path, FILE *out, accel_error *error)
{
    struct file file;
    if (!file_read(&file, path, error)) {
        return false;
    }
    const bool fine = trace_lines(tracing, &file, out, error);
    progress_clear(&tracing->progress);
    free(file.bytes);
    return fine;
}
