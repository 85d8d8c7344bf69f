/* SPDX-License-Identifier: Apache-2.0
 *
 * Work against size: nodes and tests per ray, time, build and memory from 10^3 to 10^7 triangles;
 * and against the gap between two clusters, as in the paper's table 1.
 */
#include "report_runs.h"

#include <string.h>

static const char csv_name[] = "size.csv", gap_name[] = "gap.csv";
static const char title[] = "Work against size, against gaps; memory";
static const char columns[] = "scene,primitives,contender,peer,rays,wrong,ns_per_ray,nodes,tests,"
                              "build_seconds,seconds_with_build,bytes_per_primitive";
static const char gap_columns[] =
    "scene,gap,contender,peer,rays,wrong,ns_per_ray,nodes,tests,build_seconds,seconds_with_build,"
    "bytes_per_primitive";

/* Rays that seconds_with_build adds to the build; up to what size linear is asked. */
#define MANY_RAYS   1e6
#define LINEAR_SIZE 12000

/* Teapots of 10^3, 10^4, ... triangles; the first LEAST are always run. */
static const char *const sizes[] = {"teapots:quads=1", "teapots:quads=4", "teapots:quads=13",
                                    "teapots:quads=41", "teapots:quads=129"};
static const int gaps[] = {0, 1, 4, 16, 64, 256};

enum {
    SIZES = sizeof sizes / sizeof sizes[0],
    GAPS = sizeof gaps / sizeof gaps[0],
    LEAST = 2,
    LEAST_RAYS = 1000,
    MOST_RAYS = 50000
};

/* What the words say: of the largest scene that was run. */
typedef struct summary {
    uint64_t primitives;
    struct run fastest, slowest_build; /* of ours, linear left out */
    struct run peer;                   /* the fastest; its name is empty where there is none */
    double built;                      /* seconds of all builds */
} summary;

static void sum_up(summary *s, const struct run *run)
{
    s->built += run->build;
    if (strcmp(run->name, "linear") == 0) {
        return;
    }
    struct run *best = run->peer ? &s->peer : &s->fastest;
    if (best->name[0] == '\0' || run->ns < best->ns) {
        *best = *run;
    }
    if (!run->peer && run->build > s->slowest_build.build) {
        s->slowest_build = *run;
    }
}

static void write_row(FILE *csv, const char *scene, uint64_t primitives, double x,
                      const struct run *run)
{
    fprintf(csv, "%s,%.0f,%s,%d,%zu,%zu,%.1f,%.2f,%.2f,%.6f,%.4f,%.1f\n", scene, x, run->name,
            run->peer, run->rays, run->wrong, run->ns, run->nodes, run->tests, run->build,
            run->build + 1e-9 * MANY_RAYS * run->ns,
            run->bytes / (double)(primitives > 0 ? primitives : 1));
}

/* Every form of ours, and the peers. */
static bool run_all(struct reporting *r, FILE *csv, const char *scene, double x, size_t rays,
                    double seconds, summary *s)
{
    struct ground g;
    if (!ground_make(&g, r, scene, x < 0.0 ? GROUND_BOUNCES : GROUND_PHOTONS, rays,
                     0.01 * seconds)) {
        return false;
    }
    const uint64_t primitives = scene_primitives(&g.loaded.scene);
    const struct forms forms = forms_of_kinds(NULL);
    bool fine = true;
    *s = (summary){.primitives = primitives};
    for (size_t i = 0; fine && i < forms.count; i++) {
        struct run run;
        if (strcmp(forms.at[i], "linear") == 0 && primitives > LINEAR_SIZE) {
            continue;
        }
        progress_show(&r->progress, scene, (double)i / (double)forms.count);
        const bool linear = strcmp(forms.at[i], "linear") == 0;
        fine = run_config(&run, r, &g, forms.at[i], (linear ? 0.002 : 0.02) * seconds);
        if (fine) {
            write_row(csv, scene, primitives, x < 0.0 ? (double)primitives : x, &run);
            sum_up(s, &run);
        }
    }
    struct run peers[MOST_PEERS];
    const size_t count = fine ? run_peers(peers, &g) : 0;
    for (size_t i = 0; i < count; i++) {
        write_row(csv, scene, primitives, x < 0.0 ? (double)primitives : x, &peers[i]);
        sum_up(s, &peers[i]);
    }
    ground_free(&g);
    return fine;
}

static size_t rays_for(double seconds)
{
    /* 16 contenders, six passes, 1 us for each ray, in about a tenth of the time */
    const double fits = 0.1 * seconds / (16.0 * 6.0 * 1e-6);
    return fits < LEAST_RAYS ? LEAST_RAYS : fits > MOST_RAYS ? MOST_RAYS : (size_t)fits;
}

/* Ten times as many triangles as long as they fit. */
static bool run_sizes(struct reporting *r, FILE *csv, double seconds, summary *s)
{
    const double end = seconds_now() + seconds;
    for (size_t i = 0; i < SIZES; i++) {
        const double start = seconds_now();
        if (!run_all(r, csv, sizes[i], -1.0, rays_for(seconds), seconds, s)) {
            return false;
        }
        /* builds take a little more than ten times as long, rays less than twice */
        const double next = 2.0 * (seconds_now() - start) + 15.0 * s->built;
        if (i + 1 >= LEAST && seconds_now() + next > end) {
            break;
        }
    }
    return true;
}

static bool run_gaps(struct reporting *r, FILE *csv, double seconds, summary *s)
{
    for (size_t i = 0; i < GAPS; i++) {
        char scene[40];
        snprintf(scene, sizeof scene, "cubes:gap=%d", gaps[i]);
        if (!run_all(r, csv, scene, gaps[i], rays_for(seconds), seconds / GAPS, s)) {
            return false;
        }
    }
    return true;
}

/* -------------------------------------------------------------------- plots ---- */

/* What a panel shows. */
struct panel {
    const char *title; /* its unit */
    const char *value; /* by gnuplot, of the columns */
    bool peers;        /* known of peers too */
};

static const struct panel size_panels[] = {
    {"nodes visited per ray", "$8", false},
    {"triangles tested per ray", "$9", false},
    {"ns per ray", "$7", true},
    {"build, ns per triangle", "1e9*$10/$2", true},
    {"build and 10⁶ rays, seconds", "$11", true},
    {"bytes per triangle", "$12", true},
};

static const struct panel gap_panels[] = {
    {"nodes visited per ray", "$8", false},
    {"triangles tested per ray", "$9", false},
    {"ns per ray", "$7", true},
};

static const struct drawn_peer {
    const char *name, *title, *style;
} drawn_peers[] = {
    {"medium", "Embree fast", "lc rgb '#882255' pt 1"},
    {"medium robust", "Embree robust", "lc rgb '#882255' pt 2"},
};

static void draw_panel(FILE *script, const char *csv, const struct panel *p, const char *x)
{
    const struct forms forms = forms_of_kinds(NULL);
    fprintf(script, "set title '%s' offset 0,-0.5\nplot ", p->title);
    for (size_t i = 0; p->peers && i < 2; i++) {
        fprintf(script, "'%s' using (strcol(3)[13:] eq '%s' ? %s : NaN):(%s) with linespoints %s, ",
                csv, drawn_peers[i].name, x, p->value, drawn_peers[i].style);
    }
    for (size_t i = 0; i < forms.count; i++) {
        fprintf(script, "'%s' using (strcol(3) eq '%s' ? %s : NaN):(%s) with linespoints %s, ", csv,
                forms.at[i], x, p->value, plot_style(forms.at[i]));
    }
    fprintf(script, "NaN\n");
}

static void draw_key(FILE *script, double height)
{
    const struct forms forms = forms_of_kinds(NULL);
    fprintf(script,
            "unset title\nunset xlabel\nunset ylabel\nunset border\nunset tics\nunset grid\n"
            "unset logscale\nset xrange [0:1]\nset yrange [0:1]\nset origin 0.05,0\n"
            "set size 0.9,%g\nset key horizontal Left reverse center center samplen 2\nplot ",
            height);
    for (size_t i = 0; i < 2; i++) {
        fprintf(script, "NaN with linespoints %s title '%s', ", drawn_peers[i].style,
                drawn_peers[i].title);
    }
    for (size_t i = 0; i < forms.count; i++) {
        fprintf(script, "NaN with linespoints %s title '%s', ", plot_style(forms.at[i]),
                forms.at[i]);
    }
    fprintf(script, "NaN\nunset multiplot\n");
}

static void start(FILE *script)
{
    fprintf(script, "set multiplot\nset logscale xy\nunset mxtics\nunset mytics\nset tmargin 0\n"
                    "set bmargin 0\nset lmargin 0\nset rmargin 0\nset format y '10^{%%T}'\n");
}

static bool draw_size(struct reporting *r)
{
    struct plot plot;
    if (!plot_open(r, &plot, "size", 960, 640)) {
        return false;
    }
    start(plot.script);
    fprintf(plot.script, "set xrange [4e2:2e7]\nset format x '10^{%%T}'\nset size 0.25,0.3\n");
    for (size_t i = 0; i < 6; i++) {
        fprintf(plot.script, "set origin %g,%g\nset xlabel '%s' offset 0,0.5\n",
                0.06 + 0.32 * (double)(i % 3), i < 3 ? 0.64 : 0.23, i < 3 ? "" : "triangles");
        draw_panel(plot.script, csv_name, &size_panels[i], "$2");
    }
    draw_key(plot.script, 0.13);
    return plot_close(r, &plot);
}

static bool draw_gap(struct reporting *r)
{
    struct plot plot;
    if (!plot_open(r, &plot, "gap", 960, 400)) {
        return false;
    }
    start(plot.script);
    /* a gap of 0 has no logarithm: it stands at 1/4 */
    fprintf(plot.script, "set xrange [0.18:400]\nset xtics ('0' 0.25,'1' 1,'4' 4,'16' 16,'64' 64,"
                         "'256' 256)\nset size 0.25,0.46\n");
    for (size_t i = 0; i < 3; i++) {
        fprintf(plot.script, "set origin %g,0.42\nset xlabel 'gap, cluster sides' offset 0,0.3\n",
                0.06 + 0.32 * (double)i);
        draw_panel(plot.script, gap_name, &gap_panels[i], "($2 > 0 ? $2 : 0.25)");
    }
    draw_key(plot.script, 0.2);
    return plot_close(r, &plot);
}

/* How a peer compares: nothing where there is none. */
static void write_peer(char *to, size_t capacity, const summary *s)
{
    to[0] = '\0';
    if (s->peer.name[0] != '\0') {
        snprintf(to, capacity,
                 " %s traces %.1f times as fast as the fastest of ours (<code>%s</code>).",
                 s->peer.name, s->fastest.ns / s->peer.ns, s->fastest.name);
    }
}

static bool write_page(struct reporting *r, const summary *size, const summary *gap)
{
    char caption[1200], gap_caption[1200], peer[300];
    write_peer(peer, sizeof peer, size);
    snprintf(caption, sizeof caption,
             "Number of triangles against work for each ray, time, build, both together, and "
             "memory. A hierarchy needs a few nodes more for ten times the triangles. <b>Where we "
             "lose:</b> at %llu triangles,%s The slowest of our builds is <code>%s</code> with "
             "%.2f s; <code>%s</code> builds in %.2f s.",
             (unsigned long long)size->primitives, peer, size->slowest_build.name,
             size->slowest_build.build, size->fastest.name, size->fastest.build);
    write_peer(peer, sizeof peer, gap);
    snprintf(gap_caption, sizeof gap_caption,
             "The gap between two clusters against work for each ray. <b>Where we lose:</b> fewer "
             "nodes are not less time by themselves: compare the first panel with the last. At the "
             "largest gap,%s",
             peer);
    page_title(r, "size", title);
    page_text(r,
              "The same scene, nine teapots and a floor, cut into more and more triangles; "
              "and two clusters of cubes, farther and farther apart, as in the first table of "
              "the paper on hierarchies of octrees. Rays are diffuse bounces; for the gap "
              "photons from a light over each cluster, half of them reflected. Linear search "
              "is asked up to %d triangles; of the larger scenes it judges a sample.",
              LINEAR_SIZE);
    return page_plot(r, "size", csv_name, caption) && page_plot(r, "gap", gap_name, gap_caption);
}

static bool write_figures(struct reporting *r, const char *name, const char *names,
                          bool (*run)(struct reporting *, FILE *, double, summary *),
                          double seconds, summary *s)
{
    FILE *csv = report_csv(r, name, names);
    if (csv == NULL) {
        return false;
    }
    if (!run(r, csv, seconds, s)) {
        fclose(csv);
        return false;
    }
    return report_csv_close(r, csv, name);
}

bool report_size(struct reporting *r, double seconds)
{
    if (!report_has_structures(r, "size", title)) {
        return true;
    }
    summary gap, size;
    return write_figures(r, gap_name, gap_columns, run_gaps, 0.2 * seconds, &gap) &&
           write_figures(r, csv_name, columns, run_sizes, 0.8 * seconds, &size) && draw_size(r) &&
           draw_gap(r) && write_page(r, &size, &gap);
}
