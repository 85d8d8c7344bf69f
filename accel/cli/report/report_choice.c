/* SPDX-License-Identifier: Apache-2.0
 *
 * The cost of a choice: time and error over depth, leaf size, cluster distance and density, with
 * what `auto` chooses beside each curve.
 */
#include "report_runs.h"

#include <string.h>

static const char csv_name[] = "choice.csv", title[] = "The cost of a choice";
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
static const char *const titles[] = {"nine teapots and a floor", "two clusters of cubes"};

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

/* The curves of one panel in one row; column: what is drawn. */
static void draw_curves(FILE *script, const char *scene, const struct panel *p, int column)
{
    for (size_t k = 0; k < MOST_CURVES && p->kinds[k] != NULL; k++) {
        char condition[200];
        snprintf(condition, sizeof condition,
                 "strcol(1) eq '%s' && strcol(2) eq '%s' && strcol(3) eq '%s'", scene, p->title,
                 p->kinds[k]);
        const char *style = plot_style(p->kinds[k]);
        fprintf(script,
                "'%s' using (%s && $5 > 0 ? $5 : NaN):%d with linespoints lw 1.3 %s, "
                "'%s' using (%s && $5 == 0 ? 0 : NaN):%d with points ps 1.3 %s, ",
                csv_name, condition, column, style, csv_name, condition, column, style);
    }
}

static void draw_panel(FILE *script, size_t panel, size_t row)
{
    const struct panel *p = &panels[panel];
    const bool errors = row == SCENES;
    fprintf(script, "set origin %g,%g\nset size 0.2,%g\nset xtics ('auto' 0",
            0.075 + 0.236 * (double)panel,
            errors     ? 0.19
            : row == 0 ? 0.68
                       : 0.39,
            errors ? 0.1 : 0.23);
    int count = 0;
    for (; p->values[count] != NULL; count++) {
        fprintf(script, ",'%s' %d", p->values[count], count + 1);
    }
    fprintf(script,
            ") rotate by -45\nset xrange [-0.5:%d.5]\nset title '%s' offset 0,-0.5\n"
            "set ylabel \"%s\" offset 1,0\nset xlabel '%s' offset 0,0.4\n",
            count, row == 0 ? p->title : "",
            panel > 0  ? ""
            : errors   ? "share\\nwrong"
            : row == 0 ? "ns per ray\\nnine teapots"
                       : "ns per ray\\ntwo clusters of cubes",
            errors ? p->title : "");
    fprintf(script, "set yrange %s\nset format y '%s'\nset format x \"%s\"\n",
            errors ? "[1e-7:1]" : "[*:3e4]", panel > 0 ? "" : "10^{%T}", errors ? "%g" : "");
    fprintf(script, errors ? "set ytics 1e3\n" : "set ytics autofreq\n");
    fprintf(script, "plot ");
    if (errors) {
        fprintf(script,
                "'%s' using (strcol(2) eq '%s' && $9 == 0 ? $5 : NaN):11:(0):(-0.9*$11) with "
                "vectors filled size graph 0.02,25 lc rgb '#999999', ",
                csv_name, p->title);
        draw_curves(script, scenes[0], p, 11);
    } else {
        fprintf(script, "a%zu with lines lc rgb '#000000' dt 2, ", row);
        draw_curves(script, scenes[row], p, 12);
    }
    fprintf(script, "NaN\n");
}

static void draw_key(FILE *script)
{
    static const char *const kinds[] = {"octree", "hoo", "bsp", "bvh", "grid", "hug"};
    fprintf(script,
            "unset title\nunset xlabel\nunset ylabel\nunset border\nunset tics\nunset grid\n"
            "unset logscale\nset xrange [0:1]\nset yrange [0:1]\nset origin 0.05,0\n"
            "set size 0.9,0.08\nset key horizontal Left reverse center center samplen 2\nplot ");
    for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++) {
        fprintf(script, "NaN with linespoints lw 1.3 %s title '%s', ", plot_style(kinds[k]),
                kinds[k]);
    }
    fprintf(script, "NaN with lines lc rgb '#000000' dt 2 title 'kind auto'\nunset multiplot\n");
}

static bool draw(struct reporting *r)
{
    struct plot plot;
    if (!plot_open(r, &plot, "choice", 980, 780)) {
        return false;
    }
    for (size_t s = 0; s < SCENES; s++) {
        fprintf(plot.script,
                "stats '%s' using (strcol(1) eq '%s' && strcol(3) eq 'auto' ? $12 : NaN) name 'S' "
                "nooutput\na%zu = S_max\n",
                csv_name, scenes[s], s);
    }
    fprintf(plot.script, "set multiplot\nset logscale y\nunset mytics\nset tmargin 0\n"
                         "set bmargin 0\nset lmargin 0\nset rmargin 0\n");
    for (size_t row = 0; row <= SCENES; row++) {
        for (size_t panel = 0; panel < PANELS; panel++) {
            draw_panel(plot.script, panel, row);
        }
    }
    draw_key(plot.script);
    return plot_close(r, &plot);
}

static bool write_page(struct reporting *r, size_t rays, const regret *worst)
{
    char caption[900];
    page_title(r, "choice", title);
    page_text(r,
              "Structures have options, and papers tune them. No option has to be given here: "
              "at its left each curve begins with what the structure chooses by itself "
              "(auto); the dashed line is the kind <code>auto</code>, which chooses the "
              "structure too. Rays: up to %zu diffuse bounces, as in a path tracer.",
              rays);
    snprintf(caption, sizeof caption,
             "Options against time per ray (%s above, %s in the middle) and against the share of "
             "wrong answers (below; an arrow down: none). No option changes an answer. "
             "<b>Where we lose:</b> where an own choice is worst, <code>%s</code> is %.2f times as "
             "fast.",
             titles[0], titles[1], worst->where, worst->worst);
    return page_plot(r, "choice", csv_name, caption);
}

bool report_choice(struct reporting *r, double seconds)
{
    if (!report_has_structures(r, "choice", title)) {
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
    return report_csv_close(r, csv, csv_name) && draw(r) && write_page(r, rays, &worst);
}
