/* SPDX-License-Identifier: Apache-2.0
 *
 * Stiff and extreme cases: every scene of the catalogue but the harmless and every family of rays,
 * asked of every form of ours, of Embree and of stock POV-Ray where they know the scene.
 *
 * The scenes and rays are those of the tests, from the same generators, in the same counts where
 * the time allows.
 */
#include "report_cases.h"

#include "tool/quantile.h"

#include <stdlib.h>
#include <string.h>

static const char columns[] =
    "test,case,scene,judge,contender,peer,rays,decided,wrong,decided_rounded,wrong_rounded,"
    "ns_per_ray,cost";

/* Rays for a case; POV-Ray is asked about scenes up to this size. */
enum { LEAST_RAYS = 16, MOST_RAYS = 20000, MOST_VARIANTS = 12, POVRAY_SIZE = 2500 };

/* The tables under way. */
typedef struct cases {
    struct reporting *r;
    FILE *csv;
    struct case_row rows[MOST_CASES];
    size_t count;
    struct field generic; /* on the generic scene: names and times only */
    struct field field;   /* on the present one */
    /* sums over the variants of the present case */
    size_t wrong[MOST_FORMS + MOST_PEERS];
    size_t single[MOST_FORMS + MOST_PEERS];
    double ns[MOST_FORMS + MOST_PEERS];
    bool povray; /* it is installed */
} cases;

/* ------------------------------------------------------------------ one case ---- */

/* Adds the answers of one variant. */
static void add_variant(cases *x, struct case_row *row, const struct exam *e)
{
    row->judge = e->judge;
    row->rays += e->set.count;
    row->decided += e->decided;
    row->decided_peer += e->decided_peer;
    row->decided_single += e->peers ? e->decided_single : 0;
    row->peers = e->peers;
    for (size_t c = 0; c < x->field.count; c++) {
        x->wrong[c] += exam_wrong(e, &x->field.at[c]);
        if (x->field.at[c].peer) {
            x->single[c] += exam_wrong_single(e, &x->field.at[c]);
        }
        x->ns[c] += x->field.ns[c] * (double)e->set.count;
    }
}

/* Nanoseconds of a ray, over the variants. */
static double case_ns(const cases *x, const struct case_row *row, size_t c)
{
    return x->ns[c] / (double)(row->rays > 0 ? row->rays : 1);
}

/* The time of each form over its time on the generic scene. */
static void compare_cost(const cases *x, struct case_row *row)
{
    double cost[MOST_FORMS];
    size_t count = 0;
    for (size_t c = 0; c < x->field.count; c++) {
        if (x->field.at[c].peer || strcmp(x->field.at[c].name, "linear") == 0) {
            continue;
        }
        cost[count] = case_ns(x, row, c) / x->generic.ns[c];
        if (cost[count] > row->cost_worst) {
            row->cost_worst = cost[count];
            snprintf(row->worst, sizeof row->worst, "%s", x->field.at[c].name);
        }
        count++;
    }
    sort_values(cost, count);
    row->cost_middle = count > 0 ? cost[count / 2] : 0.0;
}

/* Fewest of the two builds of Embree, fast or robust. */
static size_t fewest(const cases *x, const size_t *wrong, bool robust)
{
    size_t least = SIZE_MAX;
    for (size_t c = 0; c < x->field.count; c++) {
        const struct bench_contender *at = &x->field.at[c];
        if (at->peer && (strstr(at->name, "robust") != NULL) == robust) {
            least = wrong[c] < least ? wrong[c] : least;
        }
    }
    return least == SIZE_MAX ? 0 : least;
}

static void write_rows(const cases *x, const struct case_row *row)
{
    for (size_t c = 0; c < x->field.count; c++) {
        const struct bench_contender *at = &x->field.at[c];
        const double ns = case_ns(x, row, c);
        fprintf(x->csv, "%s,%s,%s,%s,%s,%d,%zu,%zu,%zu,%zu,%zu,%.1f,%.3f\n", row->test, row->name,
                row->scene != NULL ? row->scene : row->name, judge_names[row->judge], at->name,
                at->peer, row->rays, at->peer ? row->decided_peer : row->decided, x->wrong[c],
                at->peer ? row->decided_single : row->decided,
                at->peer ? x->single[c] : x->wrong[c], ns, ns / x->generic.ns[c]);
    }
    if (row->povray.ran) {
        const struct povray *p = &row->povray;
        const size_t wrong = p->lost + p->false_hits + p->off;
        fprintf(x->csv, "%s,%s,%s,%s,POV-Ray,1,%zu,%zu,%zu,%zu,%zu,0,0\n", row->test, row->name,
                row->name, judge_names[row->judge], p->asked, p->asked, wrong, p->asked, wrong);
    }
}

static void end_case(cases *x, struct case_row *row)
{
    for (size_t c = 0; c < x->field.count; c++) {
        if (!x->field.at[c].peer) {
            row->forms++;
            row->wrong += x->wrong[c];
        }
    }
    if (row->peers) {
        row->fast = fewest(x, x->wrong, false);
        row->robust = fewest(x, x->wrong, true);
        row->fast_single = fewest(x, x->single, false);
        row->robust_single = fewest(x, x->single, true);
    }
    x->r->judged += row->rays * row->forms;
    x->r->wrong += row->wrong;
    compare_cost(x, row);
    write_rows(x, row);
}

/* The first variant of a scene with the mix of rays. Without any time, closed meshes alone: to
 * start POV-Ray takes longer than all the rest. */
static bool suits_povray(const struct case_row *row, const struct exam *e, uint64_t seed,
                         double seconds)
{
    const uint64_t size = scene_size(e->scene);
    return row->scene == NULL && seed == 1 && e->judge != BY_LINEAR && size > 0 &&
           size <= POVRAY_SIZE && (seconds > 0.0 || strcmp(row->test, "closed") == 0);
}

/* One variant of a case; the first one is asked of POV-Ray as well. */
static bool run_variant(cases *x, struct case_row *row, struct exam_subject on, double seconds,
                        size_t most)
{
    struct exam e;
    bool fine = exam_make(&e, on, seconds, most < LEAST_RAYS ? most : LEAST_RAYS, most);
    if (!fine) {
        complain(x->r->command, "no memory for the rays of %s; nothing was written", row->name);
    }
    fine = fine && field_build(&x->field, x->r, &e);
    if (fine) {
        field_time(&x->field, &e);
        add_variant(x, row, &e);
        if (x->povray && suits_povray(row, &e, on.seed, seconds)) {
            povray_ask(x->r, &e, seconds < 1.0 ? 200 : 1000, &row->povray);
        }
    }
    exam_free(&e);
    return fine;
}

static bool run_case(cases *x, struct case_row row, struct exam_subject on, uint32_t variants,
                     double seconds, size_t most)
{
    if (x->count == MOST_CASES) {
        complain(x->r->command, "more than %d cases; nothing was written", MOST_CASES);
        return false;
    }
    memset(x->wrong, 0, sizeof x->wrong);
    memset(x->single, 0, sizeof x->single);
    memset(x->ns, 0, sizeof x->ns);
    progress_show(&x->r->progress, row.name, -1.0);
    const double end = seconds_now() + seconds;
    const uint32_t tries = variants > MOST_VARIANTS ? MOST_VARIANTS : variants > 0 ? variants : 1;
    for (uint32_t i = 0; i < tries && (i == 0 || seconds_now() < end); i++) {
        field_free(&x->field);
        on.seed = i + 1;
        if (!run_variant(x, &row, on, seconds / tries, most)) {
            return false;
        }
    }
    end_case(x, &row);
    field_free(&x->field);
    x->rows[x->count++] = row;
    return true;
}

/* ----------------------------------------------------------------- all cases ---- */

/* The times that costs are relative to. */
static bool run_generic(cases *x, double seconds)
{
    struct exam e;
    const struct exam_subject on = {.maker = scene_maker_find("shards"), .family = ray_families};
    bool fine = exam_make(&e, on, seconds, 200, 2000);
    if (!fine) {
        complain(x->r->command, "no memory; nothing was written");
    }
    fine = fine && field_build(&x->generic, x->r, &e);
    if (fine) {
        field_time(&x->generic, &e);
        field_free(&x->generic);
    }
    exam_free(&e);
    return fine;
}

/* Not the million copies where there is no time: every form takes half a minute to build them. */
static bool is_listed(const struct scene_maker *m, double each)
{
    return strcmp(m->test, "random") != 0 && (each > 2.0 || strcmp(m->name, "copies-1000000") != 0);
}

/* Scenes, families on each of their scenes, the lattice by integers, closed meshes. */
static size_t count_cases(void)
{
    size_t count = 3;
    for (const struct known *c = known_cases; c->name != NULL; c++) {
        count++;
    }
    for (const struct scene_maker *m = scene_makers; m->name != NULL; m++) {
        count += is_listed(m, 0.0);
    }
    for (const struct ray_family *f = ray_families + 1; f->name != NULL; f++) {
        for (size_t i = 0; f->scenes[i] != NULL; i++) {
            count++;
        }
    }
    return count;
}

static size_t at_most(uint32_t rays)
{
    return rays == 0 || rays > MOST_RAYS ? MOST_RAYS : rays;
}

static bool run_scenes(cases *x, double each)
{
    bool fine = true;
    for (const struct scene_maker *m = scene_makers; fine && m->name != NULL; m++) {
        if (is_listed(m, each)) {
            fine = run_case(
                x, (struct case_row){.test = m->test, .name = m->name, .meaning = m->meaning},
                (struct exam_subject){.maker = m, .family = ray_families}, m->variants, each,
                at_most(m->rays));
        }
    }
    return fine;
}

static bool run_families(cases *x, double each)
{
    bool fine = true;
    for (const struct ray_family *f = ray_families + 1; fine && f->name != NULL; f++) {
        for (size_t i = 0; fine && f->scenes[i] != NULL; i++) {
            fine = run_case(
                x,
                (struct case_row){
                    .test = f->test, .name = f->name, .meaning = f->meaning, .scene = f->scenes[i]},
                (struct exam_subject){.maker = scene_maker_find(f->scenes[i]), .family = f}, 0,
                each, at_most(f->rays));
        }
    }
    return fine;
}

/* Judges that need rays of their own. */
static bool run_known(cases *x, double each)
{
    bool fine = true;
    for (const struct known *c = known_cases; fine && c->name != NULL; c++) {
        fine = run_case(
            x, (struct case_row){.test = "reported", .name = c->name, .meaning = c->origin},
            (struct exam_subject){.known = c}, 0, each, 1);
    }
    return fine;
}

static bool run_special(cases *x, double each)
{
    static const char *const names[] = {"closed-mesh", "closed-mesh-1e5"};
    static const char *const meanings[] = {"closed sphere from inside, at vertices and edges",
                                           "the same, 1e5 off the origin"};
    bool fine =
        run_case(x,
                 (struct case_row){.test = "lattice",
                                   .name = "lattice-integers",
                                   .meaning = "integer lattice, judged by integers alone"},
                 (struct exam_subject){.maker = scene_maker_find("lattice"), .integers = true}, 0,
                 each, MOST_RAYS);
    for (size_t i = 0; fine && i < 2; i++) {
        fine = run_case(
            x, (struct case_row){.test = "closed", .name = names[i], .meaning = meanings[i]},
            (struct exam_subject){.leaks = &leak_balls[i]}, 0, each, MOST_RAYS);
    }
    return fine;
}

bool report_cases(struct reporting *r, double seconds)
{
    cases *x = calloc(1, sizeof *x);
    FILE *csv = report_csv(r, ACCEL_CASES_CSV, columns);
    if (x == NULL || csv == NULL) {
        free(x);
        return csv == NULL || complain(r->command, "no memory; nothing was written") == 0;
    }
    x->r = r;
    x->csv = csv;
    x->povray = povray_version(r) != NULL;
    const double each = seconds / (double)(count_cases() + 1);
    bool fine = run_generic(x, each) && run_scenes(x, each) && run_known(x, each) &&
                run_special(x, each) && run_families(x, each);
    field_free(&x->field);
    if (!fine) {
        fclose(csv);
    } else if ((fine = report_csv_close(r, csv, ACCEL_CASES_CSV))) {
        fine = cases_page(r, x->rows, x->count);
    }
    free(x);
    return fine;
}
