/* SPDX-License-Identifier: Apache-2.0
 *
 * Work against size: nodes and tests per ray, time, build and memory from 10^3 to 10^7 triangles;
 * and against the gap between two clusters, as in the paper's table 1.
 */
#include "report_runs.h"

#include <inttypes.h>
#include <string.h>

static const char csv_name[] = "size.csv", gap_name[] = "gap.csv";
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

static bool fill_page(struct reporting *r, const summary *size, const summary *gap)
{
    char size_peer[300], gap_peer[300];
    write_peer(size_peer, sizeof size_peer, size);
    write_peer(gap_peer, sizeof gap_peer, gap);
    return page_set(r, "size", "%" PRIu64, size->primitives) &&
           page_set(r, "size.linear", "%d", LINEAR_SIZE) &&
           page_set(r, "size.peer", "%s", size_peer) &&
           page_set(r, "size.slowest", "%s", size->slowest_build.name) &&
           page_set(r, "size.slowest.seconds", "%.2f", size->slowest_build.build) &&
           page_set(r, "size.fastest", "%s", size->fastest.name) &&
           page_set(r, "size.fastest.seconds", "%.2f", size->fastest.build) &&
           page_set(r, "gap.peer", "%s", gap_peer);
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
    if (!report_has_structures(r)) {
        return true;
    }
    summary gap, size;
    return write_figures(r, gap_name, gap_columns, run_gaps, 0.2 * seconds, &gap) &&
           write_figures(r, csv_name, columns, run_sizes, 0.8 * seconds, &size) &&
           plot_draw(r, "size", "size", PLOT_FORMS, "") &&
           plot_draw(r, "gap", "gap", PLOT_FORMS, "") && fill_page(r, &size, &gap);
}
