/* SPDX-License-Identifier: Apache-2.0
 *
 * The plots and the page of the report on illumination.
 */
#include "report_light.h"

#include <string.h>

static const char *const scenes[] = {"plates", "teapots"};
static const char *const titles[] = {"lit square over a black floor", "nine teapots and a floor"};

/* The rows of a column of panels: RMSE above, bias below. */
static const struct panel {
    const char *label;
    int column; /* of the figure in the CSV */
} panels[] = {{"RMSE / mean irradiance", 11}, {"bias / mean irradiance", 12}};

/* How radii and estimators are drawn; columns 2 and 3 tell them apart by their order. */
static const struct curve {
    const char *estimator, *title, *style;
    int radius;
} curves[] = {
    {"paths", "discs, small radius", "lc rgb '#56B4E9' pt 9", 0},
    {"paths", "discs, middle radius (4 times)", "lc rgb '#0072B2' pt 7", 1},
    {"paths", "discs, large radius (16 times)", "lc rgb '#000000' pt 5", 2},
    {"nearest", "100 nearest photons in the middle radius", "lc rgb '#E69F00' pt 13", 1},
};

enum { CURVES = sizeof curves / sizeof curves[0] };

static void start_panels(FILE *script)
{
    fprintf(script, "set multiplot\nset logscale xy\nunset mxtics\nunset mytics\nset tmargin 0\n"
                    "set bmargin 0\nset lmargin 0\nset rmargin 0\nset size 0.41,0.32\n"
                    "set yrange [1e-3:6]\nset xrange [4e-3:2e2]\n"
                    "inside(s) = strcol(1) eq s\n"
                    /* bias that noise hides stands at the noise */
                    "shown(c) = c == 12 && $12 < $13 ? $13 : column(c)\n");
}

static void start_panel(FILE *script, size_t scene, size_t row)
{
    fprintf(script,
            "set origin %g,%g\nset title '%s' offset 0,-0.5\nset ylabel '%s' offset 1,0\n"
            "set xlabel '%s' offset 0,0.5\nset format x '%s'\nset format y '%s'\n",
            0.08 + 0.48 * (double)scene, row == 0 ? 0.61 : 0.24, row == 0 ? titles[scene] : "",
            scene == 0 ? panels[row].label : "",
            row == 1 ? "seconds: build, photons and estimate" : "", row == 1 ? "10^{%T}" : "",
            scene == 0 ? "10^{%T}" : "");
}

/* Common to all panels: the error of the reference, the slope of noise, arrows down where noise
 * hides the bias. */
static void draw_guides(FILE *script, size_t scene, size_t row, const char *which)
{
    fprintf(script, "plot f%zu with lines lc rgb '#999999' dt 2, ", scene);
    if (row == 0) {
        fprintf(script, "0.03/sqrt(x) with lines lc rgb '#999999' dt 3, ");
    } else {
        fprintf(script,
                "'%s' using (inside('%s') && $12 < $13 && (%s) ? $10 : NaN):13:(0):(-0.4*$13) with "
                "vectors filled size graph 0.01,25 lc rgb '#999999', ",
                ACCEL_LIGHT_CSV, scenes[scene], which);
    }
}

static void start_key(FILE *script)
{
    fprintf(script,
            "unset title\nunset xlabel\nunset ylabel\nunset border\nunset tics\nunset grid\n"
            "unset logscale\nset xrange [0:1]\nset yrange [0:1]\nset origin 0.05,0\n"
            "set size 0.9,0.12\nset key horizontal Left reverse center center samplen 2 font "
            "',12'\nplot ");
}

static void end_key(FILE *script)
{
    fprintf(script, "NaN with lines lc rgb '#999999' dt 2 title 'error of the reference', NaN with "
                    "lines lc rgb '#999999' dt 3 title 'slope of noise'\nunset multiplot\n");
}

/* The radius of a curve is the n-th that the scene has by paths: told by its value relative to the
 * first one, which is a power of 4. */
static void draw_curve(FILE *script, size_t scene, size_t row, const struct curve *c,
                       const char *structure, const char *style)
{
    fprintf(script,
            "'%s' using (inside('%s') && strcol(2) eq '%s' && int(floor(log($3/r%zu)/log(4)+0.5)) "
            "== %d && strcol(6) eq '%s' ? $10 : NaN):(shown(%d)) with linespoints lw 1.3 %s, ",
            ACCEL_LIGHT_CSV, scenes[scene], c->estimator, scene, c->radius, structure,
            panels[row].column, style);
}

/* Finds the smallest radius, the largest number of photons and the error of the reference. */
static void measure(FILE *script)
{
    for (size_t s = 0; s < 2; s++) {
        fprintf(script,
                "stats '%s' using (strcol(1) eq '%s' ? $3 : NaN) name 'S' nooutput\nr%zu = S_min\n"
                "stats '%s' using (strcol(1) eq '%s' ? $4 : NaN) name 'S' nooutput\nn%zu = S_max\n"
                "stats '%s' using (strcol(1) eq '%s' ? $14 : NaN) name 'S' nooutput\n"
                "f%zu = S_max > 0 ? S_max : NaN\n",
                ACCEL_LIGHT_CSV, scenes[s], s, ACCEL_LIGHT_CSV, scenes[s], s, ACCEL_LIGHT_CSV,
                scenes[s], s);
    }
}

/* The kinds in the figures: all but linear. */
static size_t timed_kinds(const char **names, size_t most)
{
    size_t kinds, count = 0;
    const accel_kind_info *const *kind = accel_kinds(&kinds);
    for (size_t k = 0; k < kinds && count < most; k++) {
        if (strcmp(kind[k]->name, "linear") != 0) {
            names[count++] = kind[k]->name;
        }
    }
    return count;
}

enum { MOST_KINDS = 32 };

/* A curve for each structure at the middle radius, or for each radius through one structure. */
static bool draw(struct reporting *r, const char *name, bool by_structure)
{
    struct plot plot;
    if (!plot_open(r, &plot, name, 900, 700)) {
        return false;
    }
    const char *kinds[MOST_KINDS];
    const size_t count = timed_kinds(kinds, MOST_KINDS);
    const char *one = kinds[count > 4 ? 3 : 0];
    measure(plot.script);
    start_panels(plot.script);
    for (size_t panel = 0; panel < 4; panel++) {
        const size_t scene = panel % 2, row = panel / 2;
        start_panel(plot.script, scene, row);
        char which[200];
        snprintf(which, sizeof which,
                 by_structure ? "strcol(2) eq 'paths' && int(floor(log($3/r%zu)/log(4)+0.5)) == 1"
                              : "%zu < 2 && strcol(6) eq '%s'",
                 scene, one);
        draw_guides(plot.script, scene, row, which);
        for (size_t i = 0; i < (by_structure ? count : CURVES); i++) {
            draw_curve(plot.script, scene, row, by_structure ? &curves[1] : &curves[i],
                       by_structure ? kinds[i] : one,
                       by_structure ? plot_style(kinds[i]) : curves[i].style);
        }
        fprintf(plot.script, "NaN\n");
    }
    start_key(plot.script);
    for (size_t i = 0; i < (by_structure ? count : CURVES); i++) {
        fprintf(plot.script, "NaN with linespoints lw 1.3 %s title '%s', ",
                by_structure ? plot_style(kinds[i]) : curves[i].style,
                by_structure ? kinds[i] : curves[i].title);
    }
    end_key(plot.script);
    return plot_close(r, &plot);
}

/* Build, photons and estimate of the largest run, one on the other, for each structure. */
static bool draw_parts(struct reporting *r)
{
    static const struct {
        const char *sum, *colour, *title;
    } layers[] = {
        {"$7+$8+$9", "#E69F00", "estimate"},
        {"$7+$8", "#0072B2", "photons"},
        {"$7", "#444444", "build"},
    };
    struct plot plot;
    if (!plot_open(r, &plot, "light-parts", 900, 360)) {
        return false;
    }
    const char *kinds[MOST_KINDS];
    const size_t count = timed_kinds(kinds, MOST_KINDS);
    measure(plot.script);
    fprintf(plot.script, "L = '");
    for (size_t i = 0; i < count; i++) {
        fprintf(plot.script, "%s%s", i > 0 ? " " : "", kinds[i]);
    }
    fprintf(plot.script,
            "'\nat(s) = sum [i=1:words(L)] (word(L,i) eq s ? i : 0)\n"
            "set multiplot\nset style fill solid 1.0 noborder\nset boxwidth 0.7\n"
            "set tmargin 0\nset bmargin 0\nset lmargin 0\nset rmargin 0\nset size 0.4,0.66\n"
            "set xrange [0.3:words(L)+0.7]\nset yrange [0:*]\nset xtics ('' 1)\n"
            "set for [i=1:words(L)] xtics add (word(L,i) i)\nset grid noxtics\n");
    for (size_t s = 0; s < 2; s++) {
        fprintf(plot.script,
                "set origin %g,0.2\nset title sprintf('%s, %%.0e photons', n%zu)\n"
                "set ylabel '%s' offset 1,0\nplot ",
                0.08 + 0.48 * (double)s, titles[s], s, s == 0 ? "seconds" : "");
        for (size_t i = 0; i < 3; i++) {
            fprintf(plot.script,
                    "'%s' using (strcol(1) eq '%s' && strcol(2) eq 'paths' && $4 == n%zu && "
                    "int(floor(log($3/r%zu)/log(4)+0.5)) == 1 ? at(strcol(6)) : NaN):(%s) with "
                    "boxes lc rgb '%s'%s",
                    ACCEL_LIGHT_CSV, scenes[s], s, s, layers[i].sum, layers[i].colour,
                    i < 2 ? ", " : "\n");
        }
    }
    start_key(plot.script);
    for (size_t i = 0; i < 3; i++) {
        fprintf(plot.script, "NaN with boxes lc rgb '%s' title '%s'%s", layers[i].colour,
                layers[i].title, i < 2 ? ", " : "\n");
    }
    fprintf(plot.script, "unset multiplot\n");
    return plot_close(r, &plot);
}

bool light_page(struct reporting *r, const char *slowest)
{
    if (!draw(r, "light", true) || !draw(r, "light-radius", false) || !draw_parts(r)) {
        return false;
    }
    page_title(r, "light", ACCEL_LIGHT_TITLE);
    page_text(
        r,
        "Photons shot from a light are traced through the scene; the light that falls on a point "
        "is estimated from the photon paths that cross a disc around it (Lastra et al. 2002). All "
        "structures store the same photons, bit for bit (checked here), so the error is the same "
        "for all; a faster structure moves its curve to the left. Errors are measured over 16 "
        "seeds at 64 points, and relative to the mean. <b>RMSE</b> is the error of one run; "
        "<b>bias</b> is what stays in the mean of many runs, because a disc blurs. What is right "
        "is known from elsewhere: for the plates by the form factor, a closed form, for the "
        "teapots by paths from the points to the light; the dashed line is the standard error of "
        "that. Search through all objects (<code>linear</code>) would take hours and is left out.");
    return page_plot(r, "light", ACCEL_LIGHT_CSV,
                     "Total time against RMSE (above) and bias (below); 10<sup>3</sup> "
                     "photons left, ten times more at each point; discs of the middle "
                     "radius. An arrow down: the bias is below what noise lets one see. "
                     "<b>Where we lose:</b> a structure that suits the scene badly pays at "
                     "every number of photons; none makes the estimate better.") &&
           page_plot(r, "light-radius", ACCEL_LIGHT_CSV,
                     "The same through one structure, for radii and for the nearest-photons "
                     "estimate. A large disc is calm at once and then stays wrong by its "
                     "bias; a small one needs more photons. <b>Where we lose:</b> with a "
                     "fixed radius every curve ends at its bias; more photons are then "
                     "wasted.") &&
           page_plot(r, "light-parts", ACCEL_LIGHT_CSV, slowest);
}
