/* SPDX-License-Identifier: Apache-2.0
 *
 * The cost of a choice: time and error over depth, leaf size, cluster distance and density, with
 * what `auto` chooses beside each curve.
 */
#include "report_runs.h"

#include <string.h>

static const char csv_name[] = "choice.csv";
static const char columns[] =
    "scene,panel,kind,option,position,value,config,rays,wrong,share,shown,ns_per_ray,build_seconds,"
    "seconds_with_build,nodes,tests,bytes";

enum { MOST_VALUES = 9, MOST_CURVES = 4 };

/* Rays that seconds_with_build adds to the build. */
#define MANY_RAYS 1e6

/* One option and its curves: a panel. Position 0 of a curve is auto, 1.. are the values. */
static const struct panel {
    const char *option, *title;
    const char *values[MOST_VALUES]; /* NULL-ended */
    const char *kinds[MOST_CURVES];  /* NULL-ended */
} panels[] = {
    {"leaf",
     "leaf size",
     {"1", "2", "4", "8", "16", "32", "64", NULL},
     {"octree", "hoo", "bsp", NULL}},
    {"depth",
     "depth",
     {"2", "4", "6", "8", "10", "14", "20", NULL},
     {"octree", "hoo", "bsp", NULL}},
    {"connectivity",
     "cluster distance",
     {"0", "0.25", "0.5", "1", "2", "4", "16", NULL},
     {"hoo", "hug", NULL}},
    {"density",
     "cells per primitive",
     {"0.25", "0.5", "1", "2", "4", "8", "16", NULL},
     {"grid", "hug", NULL}},
};

enum { PANELS = sizeof panels / sizeof panels[0] };

static const char *const scenes[] = {"teapots", "cubes:gap=4"};

enum { SCENES = sizeof scenes / sizeof scenes[0] };

/* Where a figure is that the page tells: how far auto is from the best of its curve. */
typedef struct regret {
    double worst;    /* of all curves */
    char where[160]; /* config whose value is better */
} regret;

static bool has_kind(const char *name)
{
    size_t kinds;
    const accel_kind_info *const *kind = accel_kinds(&kinds);
    for (size_t k = 0; k < kinds; k++) {
        if (strcmp(kind[k]->name, name) == 0) {
            return true;
        }
    }
    return false;
}

static void write_row(FILE *csv, const char *scene, const struct panel *p, const char *kind,
                      int position, const char *value, const struct run *run)
{
    /* a scene's name or a config may hold commas, a CSV without quotes none */
    fprintf(csv, "%s,%s,%s,%s,%d,%s,%s,%zu,%zu,%.3e,%.3e,%.1f,%.6f,%.4f,%.2f,%.2f,%.0f\n", scene,
            p->title, kind, p->option, position, value, run->name, run->rays, run->wrong,
            (double)run->wrong / (double)(run->rays > 0 ? run->rays : 1),
            report_shown(run->wrong, run->rays), run->ns, run->build,
            run->build + 1e-9 * MANY_RAYS * run->ns, run->nodes, run->tests, run->bytes);
}

static bool run_curve(struct reporting *r, FILE *csv, const struct ground *g, size_t scene,
                      const struct panel *p, const char *kind, double each, regret *worst)
{
    struct run run;
    if (!run_config(&run, r, g, kind, each)) {
        return false;
    }
    write_row(csv, scenes[scene], p, kind, 0, "auto", &run);
    const double standard = run.ns;
    for (int i = 0; p->values[i] != NULL; i++) {
        char config[80];
        snprintf(config, sizeof config, "%s:%s=%s", kind, p->option, p->values[i]);
        if (!run_config(&run, r, g, config, each)) {
            return false;
        }
        write_row(csv, scenes[scene], p, kind, i + 1, p->values[i], &run);
        if (standard / run.ns > worst->worst) {
            worst->worst = standard / run.ns;
            snprintf(worst->where, sizeof worst->where, "%s on %s", config, scenes[scene]);
        }
    }
    return true;
}

/* The kind auto, for a line across all panels of a scene. */
static bool run_auto(struct reporting *r, FILE *csv, const struct ground *g, size_t scene,
                     double each)
{
    static const struct panel all = {.title = "all", .option = "none"};
    struct run run;
    if (!run_config(&run, r, g, "auto", each)) {
        return false;
    }
    write_row(csv, scenes[scene], &all, "auto", 0, "auto", &run);
    return true;
}

static bool run_scene(struct reporting *r, FILE *csv, size_t scene, size_t rays, double each,
                      regret *worst)
{
    struct ground g;
    if (!ground_make(&g, r, scenes[scene], GROUND_BOUNCES, rays, 0.2)) {
        return false;
    }
    bool fine = run_auto(r, csv, &g, scene, each);
    for (size_t p = 0; fine && p < PANELS; p++) {
        progress_show(&r->progress, panels[p].title, (double)p / PANELS);
        for (size_t k = 0; fine && k < MOST_CURVES && panels[p].kinds[k] != NULL; k++) {
            fine = !has_kind(panels[p].kinds[k]) ||
                   run_curve(r, csv, &g, scene, &panels[p], panels[p].kinds[k], each, worst);
        }
    }
    ground_free(&g);
    return fine;
}

/* -------------------------------------------------------------------- plots ---- */

static void write_words(FILE *to, const char *const *words, size_t most)
{
    for (size_t i = 0; i < most && words[i] != NULL; i++) {
        fprintf(to, "%s ", words[i]);
    }
}

/* The panels as gnuplot's arrays. */
static void write_panels(FILE *to)
{
    fprintf(to, "array titles[%d]\narray values[%d]\narray curves[%d]\n", PANELS, PANELS, PANELS);
    for (int p = 0; p < PANELS; p++) {
        fprintf(to, "titles[%d] = '%s'\nvalues[%d] = '", p + 1, panels[p].title, p + 1);
        write_words(to, panels[p].values, MOST_VALUES);
        fprintf(to, "'\ncurves[%d] = '", p + 1);
        write_words(to, panels[p].kinds, MOST_CURVES);
        fprintf(to, "'\n");
    }
}

static bool draw(struct reporting *r)
{
    char given[2000];
    FILE *to = fmemopen(given, sizeof given, "w");
    if (to == NULL) {
        complain(r->command, "no memory for choice.svg; nothing was written");
        return false;
    }
    write_panels(to);
    fclose(to);
    return plot_draw(r, "choice", "choice", PLOT_FORMS, given);
}

static bool fill_page(struct reporting *r, size_t rays, const regret *worst)
{
    return page_set(r, "choice", "%s", worst->where) && page_set(r, "choice.rays", "%zu", rays) &&
           page_set(r, "choice.factor", "%.2f", worst->worst);
}

bool report_choice(struct reporting *r, double seconds)
{
    if (!report_has_structures(r)) {
        return true;
    }
    FILE *csv = report_csv(r, csv_name, columns);
    if (csv == NULL) {
        return false;
    }
    /* about 140 structures, each judged once and timed in five turns, 1.5 us for each ray, and a
     * tenth of a second for a build */
    const double each = seconds / 140.0 - 0.06;
    const double fits = each / (6.0 * 1.5e-6);
    const size_t rays = fits < 1000.0 ? 1000 : fits > 100000.0 ? 100000 : (size_t)fits;
    regret worst = {.worst = 0.0};
    for (size_t s = 0; s < SCENES; s++) {
        if (!run_scene(r, csv, s, rays, fmax(each, 0.0), &worst)) {
            fclose(csv);
            return false;
        }
    }
    return report_csv_close(r, csv, csv_name) && draw(r) && fill_page(r, rays, &worst);
}
