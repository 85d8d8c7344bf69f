/* SPDX-License-Identifier: Apache-2.0
 *
 * What the sections share: files of figures, builds.
 */
#include "report.h"

#include "tool/machine.h"

#include <errno.h>
#include <string.h>

bool report_has_structures(struct reporting *r)
{
    size_t kinds;
    const accel_kind_info *const *kind = accel_kinds(&kinds);
    for (size_t k = 0; k < kinds; k++) {
        if (strcmp(kind[k]->name, "linear") != 0 && strcmp(kind[k]->name, "auto") != 0) {
            return true;
        }
    }
    page_set(r, "bare", " ");
    return false;
}

FILE *report_csv(struct reporting *r, const char *name, const char *columns)
{
    FILE *csv = folder_write(&r->folder, name);
    if (csv == NULL) {
        complain(r->command, "cannot write %s: %s; nothing was written", name, strerror(errno));
        return NULL;
    }
    fprintf(csv, "%s\n", columns);
    return csv;
}

bool report_csv_close(struct reporting *r, FILE *csv, const char *name)
{
    const char *trouble = folder_close(&r->folder, csv);
    if (trouble != NULL) {
        complain(r->command, "cannot write %s: %s; nothing was written", name, trouble);
    }
    return trouble == NULL;
}

double report_shown(size_t wrong, size_t n)
{
    return (wrong > 0 ? (double)wrong : 1.0) / (double)(n > 0 ? n : 1);
}

accel *report_build(struct reporting *r, const accel_scene *scene, const char *config)
{
    accel *a;
    accel_error error;
    const accel_hooks hooks = {.user = &r->progress, .progress = progress_build, .threads = 1};
    const char *what = r->progress.what;
    r->progress.what = config;
    const double start = machine_seconds();
    const accel_status status = accel_build(&a, scene, config, &hooks, &error);
    r->built = machine_seconds() - start;
    r->progress.what = what;
    if (status == ACCEL_OK) {
        return a;
    }
    complain(r->command, "%s; nothing was written", error.text);
    return NULL;
}
