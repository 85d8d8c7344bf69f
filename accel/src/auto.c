/* SPDX-License-Identifier: Apache-2.0
 *
 * auto: picks a kind for the scene, then is that kind.
 *
 * Method: build every kind over a sample of the scene, trace a pilot of rays through each, count
 * nodes and tests, and predict
 *
 *     time = build(n) + rays * (ray + node * nodes + test * tests)
 *
 * with the kind's cost figures and the way its counts grow from the sample's size to n. Counts, not
 * clocks, so the choice is the same on every machine and run. The selector's idea is from
 * Subramanian and Fussell, "Automatic Termination Criteria for Ray Tracing Hierarchies", GI 1991,
 * and Hapala, Karlik and Havran, "When It Makes Sense to Use Uniform Grids for Ray Tracing", 2011:
 * build, measure, decide.
 *
 * A sample is thinner than the scene, so rays would pass where they should hit: each sampled
 * primitive is scaled about its centre by sqrt(n / sample), which keeps the sum of surfaces.
 * Host objects are sampled by their boxes; their callbacks are not called.
 *
 * Cost: a few milliseconds to tens of them, whatever the scene. Bad at: scenes whose structure a
 * sample of SAMPLE primitives does not show.
 */
#include "kind.h"
#include "box.h"
#include "config.h"

#include <stdio.h>
#include <string.h>

enum { SAMPLE = 4096, PILOT = 256 };

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

/* The sample as a scene of at most three geometries. */
struct sample {
    ARRAY_OF(double) vertices;  /* of the triangles */
    ARRAY_OF(uint32_t) indices; /* of the triangles: 0, 1, 2, ... */
    ARRAY_OF(double) spheres;   /* centre, radius */
    ARRAY_OF(accel_box) boxes;  /* of the objects */
    accel_geometry geometry[3]; /* in that order */
    accel_scene scene;
    accel_box box; /* around all */
};

/* What is known of one kind. */
struct candidate {
    const struct accel_kind *kind;
    double nodes, tests; /* per ray of the pilot */
    double seconds;      /* predicted for the whole scene */
};

/* A sampled object stands for its box: hit in the middle of the part inside. */
static void hit_box(accel_probe *probe)
{
    const accel_box *box = (const accel_box *)probe->user + probe->prim;
    double a = probe->ray->tmin, z = probe->ray->tmax;
    for (int k = 0; k < 3; k++) {
        const double t0 = (box->lo[k] - probe->ray->org[k]) / probe->ray->dir[k];
        const double t1 = (box->hi[k] - probe->ray->org[k]) / probe->ray->dir[k];
        a = fmax(a, fmin(t0, t1));
        z = fmin(z, fmax(t0, t1));
    }
    if (a <= z)
        accel_report(probe, 0.5 * (a + z), 0.0, 0.0);
}

static double scaled(double x, double centre, double scale)
{
    return centre + scale * (x - centre);
}

static bool add_triangle(struct memory *m, struct sample *s, const double *from, double scale)
{
    if (!array_extend(m, &s->vertices, 9) || !array_extend(m, &s->indices, 3))
        return false;
    double *to = s->vertices.at + s->vertices.count - 9;
    for (int i = 0; i < 9; i++) {
        const double *x = from + i % 3;
        to[i] = scaled(from[i], x[0] / 3 + x[3] / 3 + x[6] / 3, scale);
    }
    for (size_t i = s->indices.count - 3; i < s->indices.count; i++)
        s->indices.at[i] = (uint32_t)i;
    return true;
}

static bool add_sphere(struct memory *m, struct sample *s, const double *from, double scale)
{
    if (!array_extend(m, &s->spheres, 4))
        return false;
    double *to = s->spheres.at + s->spheres.count - 4;
    memcpy(to, from, 4 * sizeof *to);
    to[3] *= scale;
    return true;
}

static bool add_box(struct memory *m, struct sample *s, const accel_box *from, double scale)
{
    if (!array_extend(m, &s->boxes, 1))
        return false;
    accel_box *to = s->boxes.at + s->boxes.count - 1;
    for (int k = 0; k < 3; k++) {
        const double centre = from->lo[k] + 0.5 * (from->hi[k] - from->lo[k]);
        to->lo[k] = scaled(from->lo[k], centre, scale);
        to->hi[k] = scaled(from->hi[k], centre, scale);
    }
    return true;
}

static bool add(struct memory *m, struct sample *s, const struct primitives *p, uint32_t id,
                double scale)
{
    const struct geometry *g = primitives_geometry(p, id);
    const size_t i = id - g->first;
    switch (g->type) {
    case ACCEL_TRIANGLES:
        return add_triangle(m, s, g->data + 9 * i, scale);
    case ACCEL_SPHERES:
        return add_sphere(m, s, g->data + 4 * i, scale);
    case ACCEL_OBJECTS:
        break;
    }
    return add_box(m, s, &p->box[id], scale);
}

static void make_scene(struct sample *s)
{
    s->geometry[0] = (accel_geometry){.type = ACCEL_TRIANGLES,
                                      .triangles = {.vertices = s->vertices.at,
                                                    .vertex_count = (uint32_t)s->vertices.count / 3,
                                                    .indices = s->indices.at,
                                                    .count = (uint32_t)s->indices.count / 3}};
    s->geometry[1] = (accel_geometry){
        .type = ACCEL_SPHERES,
        .spheres = {.spheres = s->spheres.at, .count = (uint32_t)s->spheres.count / 4}};
    s->geometry[2] = (accel_geometry){.type = ACCEL_OBJECTS,
                                      .objects = {.boxes = s->boxes.at,
                                                  .count = (uint32_t)s->boxes.count,
                                                  .intersect = hit_box,
                                                  .user = s->boxes.at}};
    s->scene = (accel_scene){s->geometry, 3};
}

/* Every (n / SAMPLE)-th primitive. */
static bool take_sample(struct build *build, struct sample *s)
{
    const struct primitives *p = &build->a->prims;
    const size_t n = p->bounded.count, count = n < SAMPLE ? n : SAMPLE;
    const double scale = sqrt((double)n / (double)count);
    s->box = box_empty();
    for (size_t i = 0; i < count; i++) {
        const uint32_t id = p->bounded.at[i * n / count];
        box_add(&s->box, &p->box[id]);
        if (!add(&build->a->memory, s, p, id, scale))
            return build_no_memory(build);
    }
    make_scene(s);
    return true;
}

static void free_sample(struct memory *m, struct sample *s)
{
    array_free(m, &s->vertices);
    array_free(m, &s->indices);
    array_free(m, &s->spheres);
    array_free(m, &s->boxes);
}

/* The i-th number of a fixed sequence in [0, 1): Steele, Lea and Flood's SplitMix, OOPSLA 2014. */
static double uniform(uint64_t i)
{
    uint64_t z = (i + 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

static double between(const accel_box *b, int k, uint64_t i)
{
    return b->lo[k] + uniform(i) * (b->hi[k] - b->lo[k]);
}

/* Half the pilot are lines between random points of the box, half leave where those hit, in a
 * random direction: what a path tracer or photon map will ask. */
static void fly_pilot(const accel *a, const accel_box *box, struct candidate *c)
{
    accel_query q = {0};
    for (uint64_t i = 0; i < PILOT / 2; i++) {
        double from[3], dir[3];
        for (int k = 0; k < 3; k++) {
            from[k] = between(box, k, 9 * i + (uint64_t)k);
            dir[k] = between(box, k, 9 * i + 3 + (uint64_t)k) - from[k];
        }
        accel_ray ray = accel_ray_from(from, dir);
        accel_hit hit;
        const bool found = accel_closest(a, &ray, &hit, &q);
        for (int k = 0; k < 3; k++) {
            ray.org[k] = found ? from[k] + hit.t * dir[k] : from[k];
            ray.dir[k] = uniform(9 * i + 6 + (uint64_t)k) - 0.5;
        }
        if (found)
            ray.skip = (accel_id){hit.geom, hit.prim};
        accel_closest(a, &ray, &hit, &q);
    }
    c->nodes = (double)q.nodes / PILOT;
    c->tests = (double)q.tests / PILOT;
}

/* How a count grows when the primitives grow from `from` to `to`. */
static double growth(enum kind_growth how, double from, double to)
{
    switch (how) {
    case GROWS_LIKE_LOG:
        return log2(to + 2) / log2(from + 2);
    case GROWS_LIKE_CUBE_ROOT:
        return cbrt(to / from);
    case GROWS_LIKE_N:
        break;
    }
    return to / from;
}

static double predict(const struct build *build, const struct candidate *c)
{
    const struct kind_cost *cost = &c->kind->cost;
    const struct primitives *p = &build->a->prims;
    const double n = (double)p->bounded.count, from = n < SAMPLE ? n : SAMPLE;
    const double nodes = c->nodes * growth(cost->growth, from, n);
    const double tests =
        c->tests * (cost->growth == GROWS_LIKE_N ? growth(cost->growth, from, n) : 1.0);
    const double ray = cost->ray + cost->node * nodes + cost->test * p->test_cost * tests;
    return 1e-9 * (cost->build * n * log2(n + 2) + build->a->option[RAYS] * ray);
}

static bool try_kind(struct build *build, const struct sample *s, struct candidate *c)
{
    accel *a;
    struct memory *m = &build->a->memory;
    const accel_hooks hooks = {.user = build->hooks->user, .resize = build->hooks->resize};
    if (accel_build(&a, &s->scene, c->kind->info.name, &hooks, build->error) != ACCEL_OK)
        return false;
    fly_pilot(a, &s->box, c);
    m->peak = m->bytes + a->memory.peak > m->peak ? m->bytes + a->memory.peak : m->peak;
    accel_free(a);
    c->seconds = predict(build, c);
    return true;
}

/* The two best of all kinds that may be chosen. */
static bool try_kinds(struct build *build, const struct sample *s, struct candidate best[2])
{
    best[0].seconds = best[1].seconds = (double)INFINITY;
    for (size_t i = 0; kinds[i]; i++) {
        struct candidate c = {.kind = (const struct accel_kind *)kinds[i]};
        if (c.kind->choose)
            continue;
        if (!try_kind(build, s, &c))
            return false;
        if (c.seconds < best[0].seconds) {
            best[1] = best[0];
            best[0] = c;
        } else if (c.seconds < best[1].seconds) {
            best[1] = c;
        }
        if (!build_tick(build, (double)(i + 1) / 8))
            return false;
    }
    return true;
}

static bool choose(struct build *build, const struct accel_kind **kind)
{
    const struct accel_kind *linear = (const struct accel_kind *)kinds[0];
    const struct primitives *p = &build->a->prims;
    const double rays = build->a->option[RAYS], n = (double)p->bounded.count;
    const double tests = 1e-9 * rays * n * linear->cost.test * p->test_cost;
    *kind = linear;
    if (tests < WORTH_CHOOSING) {
        build_note(build, "auto: linear; %g rays over %g primitives do not pay for a structure",
                   rays, n);
        return true;
    }
    struct sample s = {.scene = {NULL, 0}};
    struct candidate best[2] = {{.kind = NULL}};
    const bool fine = take_sample(build, &s) && try_kinds(build, &s, best);
    free_sample(&build->a->memory, &s);
    if (!fine)
        return false;
    *kind = best[0].kind;
    build_note(build,
               "auto: %s; predicted %.3g s for %g rays, %.1f nodes and %.1f tests each; next %s",
               best[0].kind->info.name, best[0].seconds, rays, best[0].nodes, best[0].tests,
               best[1].kind ? best[1].kind->info.name : "none");
    return true;
}

const struct accel_kind auto_kind = {
    .info = {.name = "auto",
             .summary = "the kind with the lowest predicted time for this scene",
             .options = options,
             .option_count = sizeof options / sizeof *options},
    .size = sizeof(accel),
    .choose = choose,
};
