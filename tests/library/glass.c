/* SPDX-License-Identifier: Apache-2.0
 *
 * Rays that go on from a hit on a sphere: into it, out of it, and grazing, from where double says
 * the hit was. None may meet the crossing that it starts at again, none may lose the far side. The
 * judge knows the crossings of the ray as given to 113 bits (exact_sphere_left). Asked are spheres
 * of the library and balls of a host (the header's example), in every kind and form.
 */
#include <stdlib.h>
#include <string.h>

#include "cmocka_all.h"
#include "compare.h"
#include "header_ball.inc"
#include "oracle.h"

/* Where the spheres are, and how large. */
struct place {
    const char *name;
    double radius, offset;
};

static const struct place places[] = {
    {"radius 1 at 0", 1, 0},           {"radius 1 at 1e3", 1, 1e3},
    {"radius 1e-3 at 1e3", 1e-3, 1e3}, {"radius 1e6 at 0", 1e6, 0},
    {"radius 1e6 at 1e6", 1e6, 1e6},   {"radius 1 at 1e9", 1, 1e9},
    {"radius 1e-160 at 0", 1e-160, 0}, {"radius 1e160 at 0", 1e160, 0},
};

/* The header's ball squares lengths as they are. */
static bool host_reaches(const struct place *p)
{
    return p->radius > 1e-100 && p->radius < 1e100;
}

/* The way that a ray goes on. Outward and inward as seen from the computed point. */
enum way { OUTWARD, INWARD, REFLECTED, REFRACTED, GRAZING_OUT, GRAZING_IN, TANGENT, WAYS };

static const char *const way_names[WAYS] = {"outward",     "inward",     "reflected", "refracted",
                                            "grazing out", "grazing in", "tangent"};

enum { SPHERES = 30 };

/* One place's spheres twice: some overlap, so a ray within one meets others. */
struct bench {
    struct test_scene scene; /* of the library */
    struct forms native, host;
    accel *judge;
    struct ball balls[SPHERES]; /* of the host */
};

/* What came of the rays of one way. */
struct count {
    uint64_t rays, far_sides, passed, undecided, repeated, lost, off;
};

/* ---------------------------------------------------------------------- vectors ---- */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void normalize(double a[3])
{
    double largest = fmax(fabs(a[0]), fmax(fabs(a[1]), fabs(a[2])));
    for (int k = 0; k < 3; k++)
        a[k] /= largest;
    largest = sqrt(dot(a, a));
    for (int k = 0; k < 3; k++)
        a[k] /= largest;
}

static void any_direction(struct rng *d, double out[3])
{
    do {
        for (int k = 0; k < 3; k++)
            out[k] = rng_range(d, -1, 1);
    } while (dot(out, out) > 1 || dot(out, out) < 0.01);
    normalize(out);
}

/* ----------------------------------------------------------------------- scenes ---- */

static void make_balls(struct bench *b, const struct place *p, struct rng *d)
{
    for (int i = 0; i < SPHERES; i++) {
        for (int k = 0; k < 3; k++)
            b->balls[i].centre[k] = p->offset + p->radius * rng_range(d, -4, 4);
        b->balls[i].radius = p->radius * rng_range(d, 0.5, 1.5);
    }
}

static struct forms build_host_forms(const struct ball *balls)
{
    static accel_box boxes[SPHERES];
    for (int i = 0; i < SPHERES; i++) {
        for (int k = 0; k < 3; k++) {
            boxes[i].lo[k] = balls[i].centre[k] - balls[i].radius;
            boxes[i].hi[k] = balls[i].centre[k] + balls[i].radius;
        }
    }
    const accel_geometry g = {
        .type = ACCEL_OBJECTS,
        .objects = {
            .boxes = boxes, .count = SPHERES, .intersect = intersect_ball, .user = (void *)balls}};
    struct test_scene s;
    scene_open(&s);
    s.scene = (accel_scene){&g, 1};
    const struct forms f = build_forms(&s);
    return f;
}

static void open_bench(struct bench *b, const struct place *p, struct rng *d)
{
    make_balls(b, p, d);
    scene_open(&b->scene);
    struct part *part = scene_part(&b->scene, ACCEL_SPHERES);
    for (int i = 0; i < SPHERES; i++)
        part_sphere(part, b->balls[i].centre, b->balls[i].radius);
    scene_close(&b->scene);
    b->native = build_forms(&b->scene);
    b->host = build_host_forms(b->balls);
    b->judge = must_build(&b->scene, "linear");
}

static void close_bench(struct bench *b)
{
    free_forms(&b->native);
    free_forms(&b->host);
    accel_free(b->judge);
    scene_free(&b->scene);
}

/* ------------------------------------------------------------------------- rays ---- */

/* From a camera 2 to 2000 radii away. */
static accel_ray first_ray(const struct bench *b, struct rng *d)
{
    const struct ball *ball = &b->balls[rng_below(d, SPHERES)];
    double from[3], to[3], dir[3];
    any_direction(d, from);
    any_direction(d, to);
    const double far = rng_power(d, 1, 11), within = rng_unit(d);
    for (int k = 0; k < 3; k++) {
        from[k] = ball->centre[k] + far * ball->radius * from[k];
        dir[k] = ball->centre[k] + within * ball->radius * to[k] - from[k];
    }
    if (rng_chance(d, 0.5))
        normalize(dir);
    return accel_ray_from(from, dir);
}

/* A direction of cosine `up` to the normal. */
static void lean(struct rng *d, const double normal[3], double up, double out[3])
{
    double along[3], part;
    any_direction(d, along);
    part = dot(along, normal);
    for (int k = 0; k < 3; k++)
        along[k] -= part * normal[k];
    normalize(along);
    for (int k = 0; k < 3; k++)
        out[k] = sqrt(1 - up * up) * along[k] + up * normal[k];
}

/* By the law of Snell, or reflected. */
static void bend(const double dir[3], const double normal[3], double index, double out[3])
{
    const double cosine = -dot(dir, normal), ratio = cosine > 0 ? 1 / index : index;
    const double square = 1 - ratio * ratio * (1 - cosine * cosine);
    const bool reflected = index == 0 || square < 0;
    const double away = reflected ? 2 * cosine : ratio * cosine - copysign(sqrt(square), cosine);
    for (int k = 0; k < 3; k++)
        out[k] = (reflected ? 1 : ratio) * dir[k] + away * normal[k];
}

static accel_ray next_ray(const struct bench *b, struct rng *d, const accel_ray *ray,
                          const accel_hit *hit, enum way way)
{
    double at[3], normal[3], dir[3], old[3];
    for (int k = 0; k < 3; k++) {
        old[k] = ray->dir[k];
        at[k] = ray->org[k] + hit->t * ray->dir[k];
        normal[k] = at[k] - b->balls[hit->prim].centre[k];
    }
    normalize(old);
    normalize(normal);
    const double slight = rng_power(d, -56, -3);
    switch (way) {
    case OUTWARD:
    case INWARD:
        any_direction(d, dir);
        if ((dot(dir, normal) > 0) != (way == OUTWARD))
            for (int k = 0; k < 3; k++)
                dir[k] = -dir[k];
        break;
    case REFLECTED:
        bend(old, normal, 0, dir);
        break;
    case REFRACTED:
        bend(old, normal, 1.5, dir);
        break;
    default:
        lean(d, normal, way == GRAZING_OUT ? slight : way == GRAZING_IN ? -slight : 0, dir);
    }
    if (rng_chance(d, 0.3)) {
        const double length = rng_power(d, -20, 20);
        for (int k = 0; k < 3; k++)
            dir[k] *= length;
    }
    accel_ray next = accel_ray_from(at, dir);
    next.skip = (accel_id){hit->geom, hit->prim};
    return next;
}

/* ----------------------------------------------------------------------- judging ---- */

/* Hits of the sphere that the ray leaves. */
struct own {
    uint32_t prim, count;
    double t[4];
};

static bool gather(void *user, const accel_hit *hit)
{
    struct own *o = user;
    if (hit->prim == o->prim && o->count < 4)
        o->t[o->count++] = hit->t;
    return true;
}

static struct own own_hits(const accel *a, const accel_ray *ray)
{
    struct own o = {.prim = ray->skip.prim};
    accel_all(a, ray, gather, &o, NULL);
    return o;
}

static void complain(const accel_ray *r, const char *what)
{
    fprintf(stderr, "%s: ray %a %a %a  %a %a %a, leaves %u\n", what, r->org[0], r->org[1],
            r->org[2], r->dir[0], r->dir[1], r->dir[2], r->skip.prim);
}

/* The sphere's own crossings, alone: what was met or not against what there is. */
static void judge_own(struct count *c, const accel *a, const accel_ray *ray, const struct exact *e)
{
    const struct own o = own_hits(a, ray);
    const bool behind = e->last <= 0, ahead = e->verdict == HIT && e->t > e->off;
    c->rays++;
    c->far_sides += ahead;
    c->passed += e->verdict == NO_HIT;
    c->undecided += e->verdict == UNDECIDED && !behind;
    if (e->verdict == NO_HIT || behind) {
        if (o.count > 0 && c->repeated++ == 0)
            complain(ray, "repeated");
    } else if (ahead) {
        if (o.count == 0 && c->lost++ == 0)
            complain(ray, "lost");
        const quad off = o.count > 0 ? (quad)o.t[0] - e->t : 0;
        if ((o.count > 1 || off > e->off || -off > e->off) && c->off++ == 0)
            complain(ray, "off");
    }
}

/* Every structure gives linear's answer, which agrees with the judge of the whole scene. */
static void judge_scene(struct count *c, const struct bench *b, const struct forms *forms,
                        const accel_ray *ray)
{
    const struct judgement j = oracle_judge(&b->scene, ray);
    const struct answer expected = ask(forms->a[0], ray, true);
    for (size_t i = 0; i < forms->count; i++) {
        const struct answer found = ask(forms->a[i], ray, true);
        if (!same_answer(&expected, &found))
            fail_msg("%s: not what linear answers", forms->of[i].config);
    }
    if (forms == &b->native && !oracle_agrees(&j, expected.hit, &expected.closest) && c->off++ == 0)
        complain(ray, "wrong");
}

static void judge(struct count c[2], const struct bench *b, const struct place *p,
                  const accel_ray *ray, bool deep)
{
    const struct forms *forms[2] = {&b->native, &b->host};
    for (int host = 0; host <= host_reaches(p); host++) {
        const struct exact e =
            exact_sphere_left(ray, b->scene.part->data + 4 * (size_t)ray->skip.prim, !host);
        judge_own(&c[host], forms[host]->a[0], ray, &e);
        if (deep)
            judge_scene(&c[host], b, forms[host], ray);
    }
}

/* Goes on from hit to hit, each time in some way. */
static void shoot(const struct place *p, uint64_t count, struct count c[WAYS][2])
{
    struct rng d = rng_from(test_seed(), 93);
    struct bench b;
    open_bench(&b, p, &d);
    accel_ray ray = first_ray(&b, &d);
    for (uint64_t i = 0; i < count;) {
        accel_hit hit;
        const enum way way = (enum way)(i % WAYS);
        if (!accel_closest(b.judge, &ray, &hit, NULL) || rng_chance(&d, 0.02)) {
            ray = first_ray(&b, &d);
            continue;
        }
        ray = next_ray(&b, &d, &ray, &hit, way);
        judge(c[way], &b, p, &ray, i % 31 == 0);
        i++;
    }
    close_bench(&b);
}

static void print_count(const char *name, const char *who, const struct count *c)
{
    print_message("    %-11s %s %5llu rays, %5llu far sides, %4llu pass by, %4llu undecided; "
                  "%llu repeated, %llu lost, %llu off\n",
                  name, who, (unsigned long long)c->rays, (unsigned long long)c->far_sides,
                  (unsigned long long)c->passed, (unsigned long long)c->undecided,
                  (unsigned long long)c->repeated, (unsigned long long)c->lost,
                  (unsigned long long)c->off);
}

static void test_ways(void **state)
{
    (void)state;
    uint64_t wrong = 0;
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        struct count c[WAYS][2] = {{{0}}};
        shoot(&places[i], scaled_count(35000), c);
        print_message("  %s\n", places[i].name);
        for (int w = 0; w < WAYS; w++) {
            for (int host = 0; host <= host_reaches(&places[i]); host++) {
                const struct count *of = &c[w][host];
                print_count(way_names[w], host ? "host's" : "own   ", of);
                wrong += of->repeated + of->lost + of->off;
                if (w < GRAZING_OUT || !host)
                    assert_true(of->undecided * 1000 <= of->rays);
            }
            assert_true(w != INWARD || c[w]->far_sides == c[w]->rays);
        }
    }
    assert_int_equal(wrong, 0);
}

/* -------------------------------------------------------------------- intervals ---- */

/* The crossing that is left out is the same whatever the interval, so the other one is met in those
 * that hold it, with the same bits, and without skip there is one more. Not for rays that graze:
 * double does not know both of their crossings. */
static bool try_intervals(const accel *a, const struct ball *ball, const accel_ray *ray,
                          struct rng *d)
{
    accel_ray line = *ray, with = *ray;
    line.tmin = -(double)INFINITY;
    const struct own kept = own_hits(a, &line);
    line.skip = (accel_id){ACCEL_NONE, ACCEL_NONE};
    struct own both = {.prim = ray->skip.prim};
    accel_all(a, &line, gather, &both, NULL);
    assert_true(kept.count <= 1);
    if (both.count < 2 ||
        (both.t[1] - both.t[0]) * sqrt(dot(ray->dir, ray->dir)) < ball->radius / 256)
        return false;
    assert_int_equal(kept.count, 1);
    const bool first = kept.t[0] == both.t[0];
    assert_true(kept.t[0] == both.t[first ? 0 : 1]);
    assert_true(fabs(both.t[first ? 1 : 0]) <= fabs(kept.t[0]));
    const double inf = (double)INFINITY, t[2] = {both.t[0], both.t[1]};
    const double ends[] = {-inf,
                           inf,
                           0,
                           t[0],
                           t[1],
                           nextafter(t[0], -inf),
                           nextafter(t[0], inf),
                           nextafter(t[1], -inf),
                           nextafter(t[1], inf),
                           (t[0] + t[1]) / 2};
    const uint32_t count = sizeof ends / sizeof *ends;
    for (int i = 0; i < 20; i++) {
        with.tmin = ends[rng_below(d, count)];
        with.tmax = ends[rng_below(d, count)];
        const struct own met = own_hits(a, &with);
        assert_int_equal(met.count, with.tmin < kept.t[0] && kept.t[0] < with.tmax);
        assert_true(met.count == 0 || met.t[0] == kept.t[0]);
    }
    return true;
}

static void test_intervals(void **state)
{
    (void)state;
    for (size_t p = 0; p < sizeof places / sizeof *places; p++) {
        struct rng d = rng_from(test_seed(), 94);
        struct bench b;
        open_bench(&b, &places[p], &d);
        uint64_t tried = 0;
        for (uint64_t i = 0; i < scaled_count(3000); i++) {
            const accel_ray ray = first_ray(&b, &d);
            const struct forms *forms =
                host_reaches(&places[p]) && i % 3 == 0 ? &b.host : &b.native;
            accel_hit hit;
            if (!accel_closest(b.judge, &ray, &hit, NULL))
                continue;
            const accel_ray next = next_ray(&b, &d, &ray, &hit, (enum way)(i % GRAZING_OUT));
            tried += try_intervals(forms->a[i % forms->count], &b.balls[next.skip.prim], &next, &d);
        }
        assert_true(tried > scaled_count(3000) / 2);
        close_bench(&b);
    }
}

/* ------------------------------------------------------------------ round and round ---- */

/* Total reflection within a sphere, ten thousand times: each chord has the length that its angle
 * gives it. */
static void go_round(const struct place *p, double cosine, bool host)
{
    struct rng d = rng_from(test_seed(), 95);
    struct bench b;
    open_bench(&b, p, &d);
    const accel *a = host ? b.host.a[0] : b.native.a[0];
    const struct ball *ball = b.balls;
    double at[3], normal[3], dir[3];
    any_direction(&d, normal);
    lean(&d, normal, -cosine, dir);
    for (int k = 0; k < 3; k++)
        at[k] = ball->centre[k] + ball->radius * normal[k];
    for (int i = 0; i < 10000; i++) {
        accel_ray ray = accel_ray_from(at, dir);
        ray.skip = (accel_id){0, 0};
        const struct own o = own_hits(a, &ray);
        assert_int_equal(o.count, 1);
        assert_true(fabs(o.t[0] / (-2 * ball->radius * dot(dir, normal)) - 1) < 0.01);
        for (int k = 0; k < 3; k++) {
            at[k] += o.t[0] * dir[k];
            normal[k] = (at[k] - ball->centre[k]) / ball->radius;
        }
        bend(dir, normal, 0, dir);
        normalize(dir);
    }
    close_bench(&b);
}

static void test_round(void **state)
{
    (void)state;
    for (int host = 0; host < 2; host++) {
        go_round(&places[1], 0.6, host);
        go_round(&places[1], 1e-3, host);
        go_round(&places[1], 2e-5, host);
        go_round(&places[4], 1e-6, host);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ways),
        cmocka_unit_test(test_intervals),
        cmocka_unit_test(test_round),
    };
    return cmocka_run_group_tests_name("glass", tests, NULL, NULL);
}
