/* SPDX-License-Identifier: Apache-2.0
 *
 * Exact answers: wrong answers against time per ray, for every form of every kind and for Embree,
 * on scenes from harmless to hostile.
 */
#include "report.h"

#include "report_exam.h"

#include <stdlib.h>
#include <string.h>

enum { LEAST_RAYS = 300, MOST_RAYS = 100000 };

/* Rays that the second plot adds to the build. */
#define MANY_RAYS 1e6

static const char csv_name[] = "exact.csv";
static const char columns[] =
    "scene,contender,peer,input,judge,primitives,rays,decided,wrong,share,shown,ns_per_ray,"
    "build_seconds,seconds_with_build";

/* A scene of this section. */
typedef struct subject {
    const char *maker; /* in the catalogue; NULL: leaks */
    int leaks;         /* index of the ball in leak_balls */
    const char *name;  /* in the figures */
    bool random;       /* rays that aim at nothing; else the catalogue's mix */
} subject;

static const subject subjects[] = {
    {"shards", 0, "random-rays", true},
    {"shards", 0, "shards", false},
    {"shift-1e3", 0, "shift-1e3", false},
    {"shift-1e6", 0, "shift-1e6", false},
    {"shift-1e9", 0, "shift-1e9", false},
    {"shift-1e12", 0, "shift-1e12", false},
    {"shift-1e15", 0, "shift-1e15", false},
    {"scale-1e-12", 0, "scale-1e-12", false},
    {"slivers", 0, "slivers", false},
    {"sizes", 0, "sizes", false},
    {NULL, 0, "leaks", false},
    {NULL, 1, "leaks-1e5", false},
};

enum { SUBJECTS = sizeof subjects / sizeof subjects[0] };

/* How Embree's time compares over all scenes. */
typedef struct comparison {
    double ratio;  /* time of our fastest over that of Embree's, on the harmless first scene */
    size_t scenes; /* compared */
    size_t lower;  /* of them: Embree has fewer than 1 in 1000 wrong, as the scene was given */
} comparison;

/* One scene under way. */
typedef struct examined {
    struct reporting *r;
    comparison *all;
    const subject *subject;
    struct exam exam;
    struct field field;
    FILE *csv;
} examined;

static void write_row(const examined *x, size_t c, const char *input, size_t decided, size_t wrong)
{
    const double ns = x->field.ns[c];
    fprintf(x->csv, "%s,%s,%d,%s,%s,%llu,%zu,%zu,%zu,%.3e,%.3e,%.1f,%.6f,%.4f\n", x->subject->name,
            x->field.at[c].name, x->field.at[c].peer, input, judge_names[x->exam.judge],
            (unsigned long long)scene_size(x->exam.scene), x->exam.set.count, decided, wrong,
            decided > 0 ? (double)wrong / (double)decided : 0.0, report_shown(wrong, decided), ns,
            x->field.at[c].build_seconds, x->field.at[c].build_seconds + 1e-9 * MANY_RAYS * ns);
}

static void judge_all(examined *x)
{
    for (size_t c = 0; c < x->field.count; c++) {
        const size_t wrong = exam_wrong(&x->exam, &x->field.at[c]);
        write_row(x, c, "given", x->field.at[c].peer ? x->exam.decided_peer : x->exam.decided,
                  wrong);
        if (x->field.at[c].peer) {
            write_row(x, c, "rounded", x->exam.decided_single,
                      exam_wrong_single(&x->exam, &x->field.at[c]));
        } else {
            x->r->judged += x->exam.set.count;
            x->r->wrong += wrong;
        }
    }
}

/* Rays that aim at nothing in particular: of the mix every sixth. */
static accel_ray random_ray(const struct ray_target *s, const accel *judge, struct rng *d,
                            uint64_t i)
{
    (void)i;
    return ray_families->make(s, judge, d, 0);
}

static const struct ray_family random_rays = {"random",   "random", "rays that aim at nothing",
                                              random_ray, 0,        NULL};

/* The peers of a scene against the best of ours. */
static void compare_peers(const examined *x)
{
    double ours = (double)INFINITY, theirs = (double)INFINITY, share = 1.0;
    for (size_t c = 0; c < x->field.count; c++) {
        const double ns = x->field.ns[c];
        *(x->field.at[c].peer ? &theirs : &ours) = fmin(x->field.at[c].peer ? theirs : ours, ns);
        if (x->field.at[c].peer) {
            share = fmin(share, (double)exam_wrong(&x->exam, &x->field.at[c]) /
                                    fmax(1.0, (double)x->exam.decided_peer));
        }
    }
    if (x->exam.peers && isfinite(theirs) && theirs > 0.0) {
        x->all->ratio = x->all->scenes == 0 ? ours / theirs : x->all->ratio;
        x->all->lower += share < 1e-3;
        x->all->scenes++;
    }
}

static bool run_subject(struct reporting *r, const subject *s, FILE *csv, double seconds,
                        comparison *all)
{
    examined x = {.r = r, .subject = s, .csv = csv, .all = all};
    const struct exam_subject on = {.maker = s->maker != NULL ? scene_maker_find(s->maker) : NULL,
                                    .family = s->random ? &random_rays : ray_families,
                                    .leaks = s->maker == NULL ? &leak_balls[s->leaks] : NULL};
    bool fine = exam_make(&x.exam, on, seconds, LEAST_RAYS, MOST_RAYS);
    if (!fine) {
        complain(r->command, "no memory for the rays of %s; nothing was written", s->name);
    } else if ((fine = field_build(&x.field, r, &x.exam))) {
        field_time(&x.field, &x.exam);
        judge_all(&x);
        compare_peers(&x);
    }
    field_free(&x.field);
    exam_free(&x.exam);
    return fine;
}

/* -------------------------------------------------------------------- plots ---- */

static bool draw(struct reporting *r)
{
    return plot_draw(r, "exact", "exact", PLOT_FORMS,
                     "over = 'ns_per_ray'\nlabel = 'ns per ray'\nlo = 20\nhi = 1e5\n") &&
           plot_draw(r, "exact-build", "exact", PLOT_FORMS,
                     "over = 'seconds_with_build'\nlabel = 'seconds, build and 10⁶ rays'\n"
                     "lo = 0.02\nhi = 100\n") &&
           plot_draw(r, "exact-far", "exact-far", PLOT_FORMS,
                     r->wrong == 0 ? "ours = \"all kinds of ours:\\nnone wrong (< 1/N)\"\n"
                                   : "ours = 'hoo'\n");
}

static bool fill_page(struct reporting *r, const comparison *all)
{
    return page_set(r, "exact", " ") &&
           (all->scenes == 0 || (page_set(r, "exact.ratio", "%.1f", all->ratio) &&
                                 page_set(r, "exact.lower", "%zu", all->lower) &&
                                 page_set(r, "exact.scenes", "%zu", all->scenes)));
}

bool report_exact(struct reporting *r, double seconds)
{
    FILE *csv = report_csv(r, csv_name, columns);
    if (csv == NULL) {
        return false;
    }
    comparison all = {.scenes = 0};
    for (size_t i = 0; i < SUBJECTS; i++) {
        progress_show(&r->progress, subjects[i].name, (double)i / SUBJECTS);
        if (!run_subject(r, &subjects[i], csv, seconds / SUBJECTS, &all)) {
            fclose(csv);
            return false;
        }
    }
    return report_csv_close(r, csv, csv_name) && draw(r) && fill_page(r, &all);
}
