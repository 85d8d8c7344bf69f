/* SPDX-License-Identifier: Apache-2.0
 *
 * What accel bench prints: the head, a table for each scene, the same figures as CSV, and how far
 * `auto` is from the best choice.
 */
#include "bench.h"
#include "tool/machine.h"

#include <inttypes.h>
#include <string.h>

/* The rays that auto assumes unless told otherwise. */
#define AUTO_RAYS 1e7

/* ------------------------------------------------------------------------ head ---- */

static void print_origin(FILE *to)
{
    char processor[256];
    machine_processor(processor, sizeof processor);
    fprintf(to, "# %s\n# %s\n", processor, machine_build());
}

static void print_head(const struct bench *b, bool peers)
{
    print_origin(stdout);
    printf("# processor time of one thread; ns per ray: median of %u turns (quartiles), at most "
           "%" PRIu64 " rays of each kind\n",
           b->repeats, b->asked);
    if (peers && bench_no_peers() != NULL) {
        printf("# %s\n", bench_no_peers());
    } else if (peers) {
        printf("# Embree: single precision, no primitive is skipped; 'other' counts its answers "
               "that name another primitive than ours or none\n");
    }
}

static void print_csv_head(FILE *csv)
{
    print_origin(csv);
    fprintf(csv, "scene,contender,rays,count,build_seconds,bytes,nodes,tests,ns_quartile1,"
                 "ns_median,ns_quartile3,other_answers,primitives,triangles\n");
}

/* ----------------------------------------------------------------------- table ---- */

static void print_row(const struct bench *b, size_t c)
{
    const struct bench_contender *x = &b->at[c];
    const double n = (double)scene_primitives(&b->loaded.scene);
    printf("%-26s %9.1f %7.1f", x->name, 1e3 * x->build_seconds, n > 0 ? x->bytes / n : 0.0);
    for (int s = 0; s < SETS; s++) {
        if (b->sets[s].count == 0) {
            continue;
        }
        printf("  %6.0f (%.0f-%.0f)", bench_ns(b, c, s, 0.5), bench_ns(b, c, s, 0.25),
               bench_ns(b, c, s, 0.75));
        if (x->peer) {
            printf(" other %zu", x->wrong[s]);
        } else {
            printf(" %.1f+%.1f", x->nodes[s], x->tests[s]);
        }
    }
    printf("\n");
}

static void print_table(const struct bench *b)
{
    printf("\n%s: %" PRIu64 " primitives; every answer of ours judged: equal to %s, of each kind "
           "of rays %zu by linear\n",
           b->scene_name, scene_primitives(&b->loaded.scene), b->reference_name, b->judged);
    printf("%-26s %9s %7s", "", "build ms", "B/prim");
    for (int s = 0; s < SETS; s++) {
        if (b->sets[s].count > 0) {
            printf("  %s ns nodes+tests", b->sets[s].name);
        }
    }
    printf("\n");
    for (size_t c = 0; c < b->count; c++) {
        print_row(b, c);
    }
}

static uint64_t triangles_of(const accel_scene *scene)
{
    uint64_t sum = 0;
    for (uint32_t g = 0; g < scene->count; g++) {
        sum += scene->geometries[g].type == ACCEL_TRIANGLES
                   ? geometry_primitives(&scene->geometries[g])
                   : 0;
    }
    return sum;
}

static void print_csv(const struct bench *b, FILE *csv)
{
    for (size_t c = 0; c < b->count; c++) {
        const struct bench_contender *x = &b->at[c];
        for (int s = 0; s < SETS; s++) {
            if (b->sets[s].count == 0) {
                continue;
            }
            fprintf(csv,
                    "\"%s\",\"%s\",%s,%zu,%.6f,%.0f,%.3f,%.3f,%.3f,%.3f,%.3f,%zu,%" PRIu64
                    ",%" PRIu64 "\n",
                    b->scene_name, x->name, b->sets[s].name, b->sets[s].count, x->build_seconds,
                    x->bytes, x->nodes[s], x->tests[s], bench_ns(b, c, s, 0.25),
                    bench_ns(b, c, s, 0.5), bench_ns(b, c, s, 0.75), x->wrong[s],
                    scene_primitives(&b->loaded.scene), triangles_of(&b->loaded.scene));
        }
    }
}

/* ---------------------------------------------------------------------- regret ---- */

/* Build and AUTO_RAYS rays, an even mix of the kinds that were timed. */
static double total_seconds(const struct bench *b, size_t c)
{
    double sum = 0.0;
    int sets = 0;
    for (int s = 0; s < SETS; s++) {
        if (b->sets[s].count > 0) {
            sum += bench_ns(b, c, s, 0.5);
            sets++;
        }
    }
    return b->at[c].build_seconds + 1e-9 * AUTO_RAYS * sum / sets;
}

/* What auto lost by its choice, its own time included, against the best of the others. */
static void note_regret(struct bench_output *out, const struct bench *b)
{
    const struct bench_contender *chosen = NULL, *best = NULL;
    double chosen_seconds = 0.0, best_seconds = (double)INFINITY;
    for (size_t c = 0; c < b->count; c++) {
        const double seconds = total_seconds(b, c);
        if (strcmp(b->at[c].name, "auto") == 0) {
            chosen = &b->at[c];
            chosen_seconds = seconds;
        } else if (!b->at[c].peer && !b->at[c].batch && seconds < best_seconds) {
            best = &b->at[c];
            best_seconds = seconds;
        }
    }
    if (chosen == NULL || best == NULL) {
        return;
    }
    const double regret = fmax(1.0, chosen_seconds / best_seconds);
    if (out->table) {
        printf("auto: chose %s, %.3f s with its choice and %g rays; best of the others is %s, "
               "%.3f s: regret %.3f\n",
               chosen->kind, chosen_seconds, AUTO_RAYS, best->name, best_seconds, regret);
    }
    out->regret_sum += regret;
    out->regret_count++;
    if (regret > out->regret_worst) {
        out->regret_worst = regret;
        out->regret_scene = b->scene_name;
    }
}

void bench_print(struct bench_output *out, const struct bench *b)
{
    if (!out->headed && out->table) {
        print_head(b, out->peers);
    }
    if (!out->headed && out->csv != NULL) {
        print_csv_head(out->csv);
    }
    out->headed = true;
    if (out->table) {
        print_table(b);
    }
    note_regret(out, b);
    if (out->csv != NULL) {
        print_csv(b, out->csv);
    }
}

void bench_print_sum(const struct bench_output *out)
{
    if (out->table && out->regret_count > 1) {
        printf("\nauto over %zu scenes: mean regret %.3f, worst %.3f (%s)\n", out->regret_count,
               out->regret_sum / (double)out->regret_count, out->regret_worst, out->regret_scene);
    }
}
