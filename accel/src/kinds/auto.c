/* SPDX-License-Identifier: Apache-2.0
 *
 * auto: picks a kind for the scene, then is that kind.
 *
 * Method: build every kind over a sample of the scene (auto_sample.h), trace a pilot of rays
 * through each, count nodes, tests and calls of host objects, and predict
 *
 *     time = build(n) + rays * (ray + node * nodes + test * tests + call * calls)
 *
 * with the kind's cost figures (cost.h) and the way its counts grow from the sample's size to n.
 * Counts, not clocks, so the choice is the same on every machine and run. A small sample and few
 * rays come first; those that take no more than twice as long as the best of them are tried again
 * with more. A kind that would lose even if each ray came to its hit at once is not tried. The
 * selector's idea is from Subramanian and Fussell, "Automatic Termination Criteria for Ray Tracing
 * Hierarchies", GI 1991, and Hapala, Karlik and Havran, "When It Makes Sense to Use Uniform Grids
 * for Ray Tracing", 2011: build, measure, decide.
 *
 * The pilot: the host's rays where it gives some (accel_hooks.pilot), else rays from random points
 * of a box three times as large as the scene's towards random points of that; and from what those
 * hit, rays in random directions: what a path tracer or photon map will ask.
 *
 * Cost: tens of milliseconds; more where most primitives lie in one place. Bad at: scenes whose
 * structure a sample does not show; hosts whose later rays are unlike the pilot.
 */
#include "../core/kind.h"
#include "../auto/auto_sample.h"
#include "../core/config.h"
#include "../core/number.h"

#include <stdio.h>

/* What is tried in turn: primitives of the sample, and first rays of the pilot; of more that the
 * host gives, every so many-th. */
static const struct round {
    size_t sample, pilot;
} rounds[2] = {{512, 64}, {4096, 256}};

/* What takes so many times as long as the best in one round is not in the next. */
#define HOPELESS 2.0

/* Below this many seconds of predicted linear search, choosing costs more than it can save. */
#define WORTH_CHOOSING 0.005

enum { RAYS };

static const accel_option options[] = {
    [RAYS] = {.key = "rays",
              .meaning = "how many rays will come: few favour a cheap build",
              .min = 0,
              .max = 1e15,
              .standard = 1e7},
};

/* What is known of one kind. */
struct candidate {
    const struct accel_kind *kind;
    double nodes, tests, calls; /* per ray of the pilot */
    double seconds;             /* predicted for the whole scene */
    bool tried;                 /* else these are the least that it would take */
};

/* What is the same for all kinds. */
struct chooser {
    struct build *build;
    const struct round *round; /* under way */
    bool twice;                /* is there more than the first round's sample? */
    accel_hooks hooks;         /* of the builds over the sample; the chooser is their user */
    struct sample sample;
    double triangles; /* share of the primitives */
    double objects;   /* share of the primitives */
    double call;      /* nanoseconds of a call of an object, mean */
    double hits;      /* share of the pilot's rays, the same in every kind; 0 until one was tried */
    struct candidate known[MAX_KINDS]; /* the best first */
    size_t count;                      /* of them */
};

/* ------------------------------------------------------------------------- pilot ---- */

/* The i-th number of a fixed sequence in [0, 1): Steele, Lea and Flood's SplitMix, OOPSLA 2014. */
static double uniform(uint64_t i)
{
    uint64_t z = (i + 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

/* First ray i of the pilot when nobody gives one. */
static accel_ray line(const accel_box *box, uint64_t i)
{
    double from[3], dir[3];
    for (int k = 0; k < 3; k++) {
        const double size = box->hi[k] - box->lo[k];
        from[k] = box->lo[k] - size + 3.0 * uniform(9 * i + (uint64_t)k) * size;
        dir[k] = box->lo[k] + uniform(9 * i + 3 + (uint64_t)k) * size - from[k];
    }
    return accel_ray_from(from, dir);
}

static size_t pilot_count(const struct chooser *c)
{
    const size_t given = c->build->hooks->pilot_count;
    return given > 0 && given < c->round->pilot ? given : c->round->pilot;
}

static accel_ray first_ray(const struct chooser *c, size_t i)
{
    const accel_hooks *hooks = c->build->hooks;
    if (hooks->pilot_count == 0)
        return line(&c->sample.box, i);
    accel_ray ray = hooks->pilot[i * hooks->pilot_count / pilot_count(c)];
    ray.skip = (accel_id){ACCEL_NONE, ACCEL_NONE}; /* it names a primitive of the scene */
    return ray;
}

/* Rays between two looks at the clock: linear search may take a millisecond for so many. */
enum { RAYS_A_TICK = 32 };

/* Traces the pilot; fills in the counts. False if the build is cancelled. */
static bool trace_pilot(struct chooser *c, const accel *a, struct candidate *kind)
{
    accel_query q = {0};
    const size_t count = pilot_count(c);
    double rays = 0.0, hits = 0.0;
    c->sample.calls = 0;
    for (size_t i = 0; i < count; i++, rays++) {
        const accel_ray ray = first_ray(c, i);
        accel_hit hit;
        if (i % RAYS_A_TICK == 0 && !accel_build_tick(c->build, 0.0))
            return false;
        if (!accel_closest(a, &ray, &hit, &q))
            continue;
        hits++;
        double from[3], dir[3];
        for (int k = 0; k < 3; k++) {
            from[k] = ray.org[k] + hit.t * ray.dir[k];
            dir[k] = uniform(9 * i + 6 + (uint64_t)k) - 0.5;
        }
        accel_ray next = accel_ray_from(from, dir);
        next.skip = (accel_id){hit.geom, hit.prim};
        hits += accel_closest(a, &next, &hit, &q);
        rays++;
    }
    c->hits = hits / rays;
    kind->nodes = (double)q.nodes / rays;
    kind->tests = (double)q.tests / rays;
    kind->calls = (double)c->sample.calls / rays;
    return true;
}

/* -------------------------------------------------------------------- prediction ---- */

/* How a count grows when the primitives grow from `from` to `to`. */
static double growth(enum kind_growth how, double from, double to)
{
    switch (how) {
    case GROWS_LIKE_LOG:
        return log2(to + 2) / log2(from + 2);
    case GROWS_LIKE_FIFTH_ROOT:
        return pow(to / from, 0.2);
    case GROWS_LIKE_N:
        break;
    }
    return to / from;
}

/* Nanoseconds of a ray. */
static double predict_ray(const struct chooser *c, const struct candidate *k)
{
    const struct kind_cost *cost = &k->kind->cost;
    const double n = (double)c->build->a->prims.bounded.count, from = (double)c->sample.count;
    const double grown = growth(cost->growth, from, n);
    const double nodes = k->nodes * grown;
    const double tests = k->tests * (cost->growth == GROWS_LIKE_N ? grown : 1.0);
    const double test = c->triangles * cost->triangle + (1.0 - c->triangles) * cost->other;
    return cost->ray + cost->node * nodes + test * tests + c->call * k->calls;
}

static double predict(const struct chooser *c, const struct candidate *k)
{
    const double n = (double)c->build->a->prims.bounded.count;
    const double rays = c->build->a->option[RAYS];
    return 1e-9 * (k->kind->cost.build * n * log2(n + 2) + rays * predict_ray(c, k));
}

/* The least that a kind may take, knowing the hits: a ray that hits visits a node and tests what it
 * hits; linear tests all. */
static struct candidate at_least(const struct chooser *c, const struct accel_kind *kind)
{
    struct candidate k = {.kind = kind, .nodes = c->hits, .tests = c->hits};
    k.calls = c->objects == 1.0 ? c->hits : 0.0;
    if (kind->cost.growth == GROWS_LIKE_N)
        k.tests = (double)c->sample.count;
    k.seconds = predict(c, &k);
    return k;
}

/* What the scene is made of. */
static void weigh_primitives(struct chooser *c)
{
    const struct primitives *p = &c->build->a->prims;
    double triangles = 0.0, objects = 0.0, calls = 0.0;
    for (uint32_t g = 0; g < p->geometry_count; g++) {
        const struct geometry *geometry = &p->geometry[g];
        if (geometry->type == ACCEL_TRIANGLES)
            triangles += geometry->count;
        if (geometry->type == ACCEL_OBJECTS) {
            objects += geometry->count;
            calls += geometry->count * (geometry->cost > 0.0 ? geometry->cost : COST_CALL);
        }
    }
    c->triangles = triangles / p->count;
    c->objects = objects / p->count;
    c->call = objects > 0.0 ? calls / objects : 0.0;
}

/* ------------------------------------------------------------------------ choice ---- */

static void *resize_of_host(void *user, void *old, size_t from, size_t to)
{
    const accel_hooks *host = ((struct chooser *)user)->build->hooks;
    return host->resize(host->user, old, from, to);
}

/* How far one kind's build is says nothing of the choice: what is told is how many are tried. */
static bool go_on(void *user, const char *phase, double done)
{
    (void)phase, (void)done;
    return accel_build_tick(((struct chooser *)user)->build, 0.0);
}

static accel_hooks hooks_of(struct chooser *c)
{
    const accel_hooks *host = c->build->hooks;
    const struct memory *m = &c->build->a->memory;
    return (accel_hooks){.user = c,
                         .resize = host->resize ? resize_of_host : NULL,
                         .progress = go_on,
                         .threads = 1, /* to start more takes longer */
                         .memory_limit = m->limit > m->bytes ? m->limit - m->bytes : m->limit > 0};
}

static bool try_kind(struct chooser *c, struct candidate *k)
{
    accel *a;
    accel_error error;
    struct memory *m = &c->build->a->memory;
    c->hooks = hooks_of(c);
    const accel_status status =
        accel_build(&a, &c->sample.scene, k->kind->info.name, &c->hooks, &error);
    if (status != ACCEL_OK) {
        if (status == ACCEL_NO_MEMORY && m->limit > 0)
            accel_error_set(
                c->build->error, status,
                "build auto: hooks.memory_limit allows %zu bytes, but to try %s in phase "
                "'choose' more are needed beside %zu; nothing was built",
                m->limit, k->kind->info.name, m->bytes);
        else if (status != ACCEL_CANCELLED) /* that has been told already, as the choice's own */
            *c->build->error = error;
        return false;
    }
    const bool fine = trace_pilot(c, a, k);
    m->peak = m->bytes + a->memory.peak > m->peak ? m->bytes + a->memory.peak : m->peak;
    accel_free(a);
    k->seconds = predict(c, k);
    return fine;
}

/* All kinds that may be chosen, those whose rays cost least to begin with first. */
static void list_kinds(struct chooser *c)
{
    for (size_t i = 0; accel_kind_list[i]; i++) {
        const struct accel_kind *kind = (const struct accel_kind *)accel_kind_list[i];
        if (kind->choose)
            continue;
        size_t at = c->count++;
        for (; at > 0 && kind->cost.ray < c->known[at - 1].kind->cost.ray; at--)
            c->known[at] = c->known[at - 1];
        c->known[at] = (struct candidate){.kind = kind};
    }
}

/* Tries the first `count` kinds again, as far as they may be best, and sorts them. */
static bool try_kinds(struct chooser *c, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        struct candidate k = at_least(c, c->known[i].kind);
        k.tried = i == 0 || k.seconds <= c->known[0].seconds;
        if (k.tried && !try_kind(c, &k))
            return false;
        size_t at = i;
        for (; at > 0 && k.seconds < c->known[at - 1].seconds; at--)
            c->known[at] = c->known[at - 1];
        c->known[at] = k;
        const double done = (double)(c->round - rounds) + (double)(i + 1) / (double)count;
        if (!accel_build_tick(c->build, done / (c->twice ? 2.0 : 1.0)))
            return false;
    }
    return true;
}

/* How many of the kinds, which are sorted, are worth another round. */
static size_t count_hopeful(const struct chooser *c)
{
    size_t count = 1;
    while (count < c->count && c->known[count].tried &&
           c->known[count].seconds <= HOPELESS * c->known[0].seconds)
        count++;
    return count;
}

/* One round of trying the first `count` kinds. */
static bool run_round(struct chooser *c, const struct round *round, size_t count)
{
    c->round = round;
    c->hits = 0.0;
    const bool fine = accel_sample_take(c->build, &c->sample, round->sample) && try_kinds(c, count);
    accel_sample_free(&c->build->a->memory, &c->sample);
    c->sample = (struct sample){.count = 0};
    return fine;
}

/* Sorts the kinds, the best first. */
static bool compare_kinds(struct chooser *c)
{
    list_kinds(c);
    c->twice = c->build->a->prims.bounded.count > rounds[0].sample;
    if (!run_round(c, &rounds[0], c->count))
        return false;
    const size_t hopeful = count_hopeful(c);
    return hopeful == 1 || !c->twice || run_round(c, &rounds[1], hopeful);
}

/* Rounded to tenths. */
static struct number_text tenths(double x)
{
    return accel_number_text(floor(10.0 * x + 0.5) / 10.0, 15);
}

/* Says what was chosen and why. */
static void explain(const struct chooser *c)
{
    const struct candidate *best = &c->known[0];
    const bool given = c->build->hooks->pilot_count > 0;
    accel_build_note(c->build,
                     "auto: %s; pilot of %zu %s and what leaves their hits: %s nodes, %s "
                     "tests, %s calls each",
                     best->kind->info.name, pilot_count(c),
                     given ? "rays of the host" : "random rays", tenths(best->nodes).at,
                     tenths(best->tests).at, tenths(best->calls).at);
    char list[160];
    int used = 0;
    for (size_t i = 0; i < c->count && used < (int)sizeof list; i++)
        used += snprintf(list + used, sizeof list - (size_t)used, " %s %s%s",
                         c->known[i].kind->info.name, c->known[i].tried ? "" : "over ",
                         accel_number_text(c->known[i].seconds, 3).at);
    accel_build_note(c->build, "auto: seconds for %s rays:%s",
                     accel_number_text(c->build->a->option[RAYS], 6).at, list);
}

/* Nanoseconds of testing a primitive, at most: every object's box is met. */
static double most_of_a_test(const struct chooser *c, const struct accel_kind *linear)
{
    return c->triangles * linear->cost.triangle + (1.0 - c->triangles) * linear->cost.other +
           c->objects * c->call;
}

static bool choose(struct build *build, const struct accel_kind **kind)
{
    const struct accel_kind *linear = (const struct accel_kind *)accel_kind_list[0];
    const double rays = build->a->option[RAYS], n = (double)build->a->prims.bounded.count;
    struct chooser c = {.build = build, .hits = 0.0};
    *kind = linear;
    weigh_primitives(&c);
    if (1e-9 * rays * n * most_of_a_test(&c, linear) < WORTH_CHOOSING) {
        accel_build_note(build,
                         "auto: linear; %s rays over %s primitives do not pay for a structure",
                         accel_number_text(rays, 6).at, accel_number_text(n, 6).at);
        return true;
    }
    if (!compare_kinds(&c))
        return false;
    *kind = c.known[0].kind;
    explain(&c);
    return true;
}

const struct accel_kind accel_auto_kind = {
    .info = {.name = "auto",
             .summary = "the kind with the lowest predicted time for this scene",
             .options = options,
             .option_count = sizeof options / sizeof *options},
    .size = sizeof(accel),
    .choose = choose,
};
