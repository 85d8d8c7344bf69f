/* SPDX-License-Identifier: Apache-2.0
 *
 * Making rays and having them judged, on all processors.
 */
#include "report_exam.h"

#include "tool/threads.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* Rays whose time tells that of the others; fewer where one takes long. */
enum { PILOT = 24, SHORT_PILOT = 3, LARGE_SCENE = 10000 };

const char *const judge_names[] = {"113 bits", "closedness", "linear", "integers"};

/* ------------------------------------------------------------ scene and rays ---- */

static uint64_t seed_of(const struct exam_subject *subject)
{
    return subject->seed == 0 ? 1 : subject->seed;
}

static void make_scene_of(const struct exam_subject *subject, struct test_scene *s)
{
    if (subject->leaks != NULL) {
        leak_make(s, subject->leaks, seed_of(subject));
    } else if (subject->known != NULL) {
        known_make(s, subject->known);
    } else {
        scene_make(s, subject->maker, seed_of(subject));
    }
}

/* A ray along an integer line, and the first that it hits; its `under` is 0 where it hits nothing.
 * Scenes are those in which no line hits more than ALL. */
static accel_ray integer_ray(const struct test_scene *s, struct rng *d, struct first *first)
{
    enum { ALL = 300 };
    struct crossing all[ALL];
    struct line line;
    const accel_ray ray = lattice_line(s, d, &line);
    const uint32_t count = lattice_crossings(s, &line, false, all, ALL);
    *first = (struct first){.tie_count = 0};
    for (uint32_t i = 0; i < count && first->tie_count < MOST_TIES; i++) {
        if ((__int128)all[i].over * all[0].under == (__int128)all[0].over * all[i].under) {
            first->crossing = all[0];
            first->ties[first->tie_count++] = (accel_id){all[i].geom, all[i].prim};
        }
    }
    return ray;
}

/* One ray: t is a whole number of eighths. A peer may name any of the triangles where it is hit. */
static void make_known(struct exam *e, const struct known *c)
{
    struct first *first = &e->exact[0];
    *first = (struct first){.tie_count = c->hit ? c->triangles : 0};
    if (c->hit) {
        first->crossing =
            (struct crossing){.over = (int64_t)(8.0 * c->t), .under = 4, .prim = c->prim};
    }
    for (uint32_t i = 0; i < first->tie_count; i++) {
        first->ties[i] = (accel_id){0, i};
    }
    e->set.rays[0] = known_ray(c);
    e->set.count = 1;
}

static void make_rays(struct exam *e, const struct exam_subject *subject, size_t count)
{
    struct rng d = rng_from(seed_of(subject), 2);
    e->set.count = 0;
    if (subject->known != NULL) {
        make_known(e, subject->known);
        return;
    }
    for (uint64_t i = 0; e->set.count < count && i < 8 * (uint64_t)count; i++) {
        accel_ray *ray = &e->set.rays[e->set.count];
        if (subject->leaks != NULL) {
            e->set.count += leak_ray(subject->leaks, e->scene, &d, i, ray);
        } else if (subject->integers) {
            *ray = integer_ray(e->scene, &d, &e->exact[e->set.count]);
            e->set.count++;
        } else {
            *ray = subject->family->make(&e->scene->target, e->linear, &d, i);
            e->set.count++;
        }
    }
}

/* Of what Embree makes its own copy: finite triangles and spheres. */
static bool suits_peers(const struct test_scene *s)
{
    bool any = false;
    for (uint32_t g = 0; g < s->count; g++) {
        if (s->part[g].type == ACCEL_OBJECTS) {
            return false;
        }
        any |= s->part[g].count > 0;
    }
    return any;
}

/* Triangles and spheres alone, all of them valid: what the oracle knows. */
static bool suits_oracle(const struct test_scene *s, const accel *linear)
{
    accel_info info;
    accel_describe(linear, &info);
    for (uint32_t g = 0; g < s->count; g++) {
        if (s->part[g].type == ACCEL_OBJECTS) {
            return false;
        }
    }
    return info.skipped == 0;
}

/* ------------------------------------------------------------------ judging ---- */

/* Shared by the threads. */
typedef struct judging {
    const struct test_scene *scene;
    const accel_ray *rays;
    struct judgement *out;
    size_t count;
    atomic_size_t next; /* ray that nobody has taken */
} judging;

static void judge_some(void *user, unsigned thread)
{
    (void)thread;
    judging *j = user;
    for (size_t i = atomic_fetch_add(&j->next, 1); i < j->count;
         i = atomic_fetch_add(&j->next, 1)) {
        j->out[i] = oracle_judge(j->scene, &j->rays[i]);
    }
}

static struct judgement *judge_all(const struct test_scene *scene, const accel_ray *rays,
                                   size_t count)
{
    judging j = {.scene = scene, .rays = rays, .count = count};
    j.out = malloc((count + 1) * sizeof *j.out);
    if (j.out != NULL) {
        threads_run(threads_available(), judge_some, &j);
    }
    return j.out;
}

static double single(double x)
{
    return (double)(float)x;
}

static accel_ray single_ray(const accel_ray *ray)
{
    accel_ray r = *ray;
    for (int k = 0; k < 3; k++) {
        r.org[k] = single(r.org[k]);
        r.dir[k] = single(r.dir[k]);
    }
    r.tmin = single(r.tmin);
    r.tmax = single(r.tmax);
    return r;
}

static void round_scene(struct test_scene *s)
{
    for (uint32_t g = 0; g < s->count; g++) {
        struct part *p = &s->part[g];
        const size_t width = p->type == ACCEL_TRIANGLES ? 9 : 4;
        for (size_t i = 0; p->type != ACCEL_OBJECTS && i < width * p->count; i++) {
            p->data[i] = single(p->data[i]);
        }
    }
}

/* What peers are given: the oracle's word on scene and rays in single precision. */
static bool judge_single(struct exam *e, const struct exam_subject *subject)
{
    struct test_scene *rounded = malloc(sizeof *rounded);
    accel_ray *rays = malloc((e->set.count + 1) * sizeof *rays);
    if (rounded != NULL && rays != NULL) {
        make_scene_of(subject, rounded);
        round_scene(rounded);
        for (size_t i = 0; i < e->set.count; i++) {
            rays[i] = single_ray(&e->set.rays[i]);
        }
        e->single = judge_all(rounded, rays, e->set.count);
        scene_free(rounded);
    }
    free(rounded);
    free(rays);
    return e->single != NULL;
}

/* Of all rays, or of those that a peer can be asked. */
static size_t count_decided(const struct exam *e, const struct judgement *j, bool peer)
{
    size_t decided = 0;
    for (size_t i = 0; i < e->set.count; i++) {
        decided +=
            (j == NULL || j[i].verdict != UNDECIDED) && (!peer || peer_asked(&e->set.rays[i]));
    }
    return decided;
}

static bool make_peer_set(struct exam *e)
{
    e->peer_set =
        (struct ray_set){.name = "peers", .rays = malloc((e->set.count + 1) * sizeof(accel_ray))};
    if (e->peer_set.rays == NULL) {
        return false;
    }
    for (size_t i = 0; i < e->set.count; i++) {
        if (peer_reaches(&e->set.rays[i]) && peer_asked(&e->set.rays[i])) {
            e->peer_set.rays[e->peer_set.count++] = e->set.rays[i];
        }
    }
    return true;
}

/* Rays at which a host object reports a hit before its box are left out: the header exempts
 * them. */
static void ask_linear(struct exam *e)
{
    size_t kept = 0;
    for (size_t i = 0; i < e->set.count; i++) {
        accel_query query = {.user = NULL};
        accel_hit hit = {.geom = ACCEL_NONE};
        const bool found = accel_closest(e->linear, &e->set.rays[i], &hit, &query);
        if (query.outside > 0) {
            continue;
        }
        e->set.found += found;
        e->set.rays[kept] = e->set.rays[i];
        e->set.hits[kept++] = hit;
    }
    e->set.count = kept;
}

static bool judge_rays(struct exam *e, const struct exam_subject *subject)
{
    ask_linear(e);
    if (e->peers && !make_peer_set(e)) {
        return false;
    }
    if (e->judge == BY_ORACLE) {
        e->right = judge_all(e->scene, e->set.rays, e->set.count);
        if (e->right == NULL || (e->peers && !judge_single(e, subject))) {
            return false;
        }
    }
    e->decided = count_decided(e, e->right, false);
    e->decided_peer = e->peers ? count_decided(e, e->right, true) : 0;
    e->decided_single = e->peers ? count_decided(e, e->single, true) : 0;
    return true;
}

/* Passes of linear over the rays, by all who judge and time; what the passes of all others take
 * for each ray, about. */
#define LINEAR_PASSES  8.0
#define OTHERS_SECONDS 1.2e-4

/* Rays that about fit into the time, from the time of the first few. */
static size_t choose_count(const struct exam *e, double seconds, size_t least, size_t most)
{
    double start = seconds_now();
    if (e->judge == BY_ORACLE) {
        free(judge_all(e->scene, e->set.rays, e->set.count));
    }
    const double judged = seconds_now() - start;
    accel_hit hit;
    start = seconds_now();
    for (size_t i = 0; i < e->set.count; i++) {
        accel_closest(e->linear, &e->set.rays[i], &hit, NULL);
    }
    const double asked = seconds_now() - start;
    const double each = (2.0 * judged + LINEAR_PASSES * asked) / (double)(e->set.count + 1);
    const double fits = seconds / (each + OTHERS_SECONDS);
    return fits > (double)most ? most : fits < (double)least ? least : (size_t)fits;
}

bool exam_make(struct exam *e, struct exam_subject subject, double seconds, size_t least,
               size_t most)
{
    accel_error error;
    *e = (struct exam){.scene = malloc(sizeof *e->scene)};
    e->set = (struct ray_set){.name = "catalogue",
                              .rays = malloc((most + PILOT) * sizeof(accel_ray)),
                              .hits = malloc((most + PILOT) * sizeof(accel_hit))};
    e->exact = malloc((most + PILOT) * sizeof *e->exact);
    if (e->scene == NULL || e->set.rays == NULL || e->set.hits == NULL || e->exact == NULL) {
        free(e->scene);
        e->scene = NULL;
        return false;
    }
    make_scene_of(&subject, e->scene);
    e->peers = suits_peers(e->scene);
    e->judge = subject.leaks != NULL                       ? BY_HIT
               : subject.integers || subject.known != NULL ? BY_INTEGERS
                                                           : BY_ORACLE;
    if (accel_build(&e->linear, &e->scene->scene, "linear", NULL, &error) != ACCEL_OK) {
        return false;
    }
    if (e->judge == BY_ORACLE && !suits_oracle(e->scene, e->linear)) {
        e->judge = BY_LINEAR;
        e->peers = false;
    }
    make_rays(e, &subject, scene_size(e->scene) > LARGE_SCENE ? SHORT_PILOT : PILOT);
    make_rays(e, &subject, choose_count(e, seconds, least, most));
    return judge_rays(e, &subject);
}

void exam_free(struct exam *e)
{
    accel_free(e->linear);
    if (e->scene != NULL) {
        scene_free(e->scene);
    }
    free(e->scene);
    free(e->right);
    free(e->single);
    free(e->exact);
    free_set(&e->set);
    free_set(&e->peer_set);
}
