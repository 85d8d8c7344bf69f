/* SPDX-License-Identifier: Apache-2.0 */
#include "compare.h"

#include <stdlib.h>
#include <string.h>

#include "cmocka_all.h"

uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t size)
{
    const unsigned char *at = bytes;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ at[i]) * 0x100000001b3u;
    return hash;
}

static uint64_t hash_hit(uint64_t hash, const accel_hit *h)
{
    hash = hash_bytes(hash, &h->t, sizeof h->t);
    hash = hash_bytes(hash, &h->u, sizeof h->u);
    hash = hash_bytes(hash, &h->v, sizeof h->v);
    hash = hash_bytes(hash, &h->geom, sizeof h->geom);
    return hash_bytes(hash, &h->prim, sizeof h->prim);
}

uint64_t answer_hash(uint64_t hash, const struct answer *a)
{
    const unsigned char flags[2] = {a->hit, a->any};
    hash = hash_bytes(hash, flags, sizeof flags);
    if (a->hit)
        hash = hash_hit(hash, &a->closest);
    hash = hash_bytes(hash, &a->all, sizeof a->all);
    return hash_bytes(hash, &a->ids, sizeof a->ids);
}

static bool leaves(const accel_ray *ray, const accel_hit *hit)
{
    return ray->skip.geom == hit->geom && ray->skip.prim == hit->prim;
}

/* Enters the lists. */
static void hash_lists(const accel_ray *ray, const struct answers *from, struct answer *to)
{
    to->left = 0;
    to->all = to->ids = HASH_START;
    to->all_count = from->all_count;
    to->id_count = from->point_count;
    for (uint32_t i = 0; i < from->all_count; i++) {
        to->left += leaves(ray, &from->all[i]);
        to->all = hash_hit(to->all, &from->all[i]);
    }
    for (uint32_t i = 0; i < from->point_count; i++) {
        const accel_id *id = &from->point[i];
        if (i > 0 &&
            (id->geom < id[-1].geom || (id->geom == id[-1].geom && id->prim <= id[-1].prim)))
            to->illegal = "accel_point: out of order";
        to->ids = hash_bytes(to->ids, id, sizeof *id);
    }
}

/* Whether the header says that a ray is refused. */
static bool must_refuse(const accel_ray *ray)
{
    bool zero = true, finite = true;
    for (int k = 0; k < 3; k++) {
        zero = zero && ray->dir[k] == 0.0;
        finite = finite && isfinite(ray->org[k]) && isfinite(ray->dir[k]);
    }
    return zero || !finite || isnan(ray->tmin) || isnan(ray->tmax);
}

/* Each query of a ray that is refused is counted, and ends before the first node. */
static void check_refused(const accel_ray *ray, const accel_query *q, uint64_t queries,
                          struct answer *to)
{
    const bool refused = must_refuse(ray);
    if (q->refused != (refused ? queries : 0))
        to->illegal = refused ? "not refused" : "refused";
    else if (refused && (q->nodes > 0 || q->tests > 0))
        to->illegal = "refused after a walk";
}

struct answer ask(const accel *a, const accel_ray *ray, bool deep)
{
    struct answers all;
    accel_query q = {.user = NULL};
    answers_ask(a, ray, &q, &all);
    struct answer to = {.hit = all.found,
                        .any = all.any,
                        .closest = all.closest,
                        .all = HASH_START,
                        .ids = HASH_START,
                        .left = all.found && leaves(ray, &all.closest)};
    if (!all.untouched)
        to.illegal = "accel_closest: a miss wrote to *hit";
    if (to.any != to.hit)
        to.illegal = "accel_any and accel_closest disagree";
    check_refused(ray, &q, 2, &to);
    if (deep) {
        answers_ask_lists(a, ray, ray->org, &q, &all);
        hash_lists(ray, &all, &to);
        if (all.ended != (to.all_count < KEPT))
            to.illegal = "accel_all: wrong return value";
        if ((to.all_count > 0) != to.hit)
            to.illegal = "accel_all and accel_closest disagree";
    }
    to.refused = q.refused;
    to.outside = q.outside;
    return to;
}

struct answer ask_pile(const accel *one, const accel_ray *ray, uint32_t copies, bool deep)
{
    struct answer to = ask(one, ray, deep);
    struct answers pile;
    const uint32_t kept = copies < KEPT ? copies : KEPT;
    if (to.all_count > 1)
        to.illegal = "the primitive of a pile is hit twice";
    if (!deep)
        return to;
    pile.all_count = to.hit ? kept : 0;
    pile.point_count = to.id_count > 0 ? kept : 0;
    for (uint32_t i = 0; i < kept; i++) {
        pile.all[i] = to.closest;
        pile.all[i].prim = i;
        pile.point[i] = (accel_id){0, i};
    }
    hash_lists(ray, &pile, &to);
    return to;
}

/* Crossings of a host object are not known here. */
bool leaves_rightly(const struct test_scene *s, const accel_ray *ray, const struct answer *a)
{
    const uint32_t geom = ray->skip.geom;
    if (geom >= s->count || s->part[geom].type == ACCEL_OBJECTS)
        return true;
    return a->left <= (s->part[geom].type == ACCEL_SPHERES ? 1 : 0);
}

bool same_answer(const struct answer *a, const struct answer *b)
{
    return !a->illegal && !b->illegal && a->hit == b->hit && a->any == b->any && a->all == b->all &&
           a->ids == b->ids && a->refused == b->refused &&
           (!a->hit || (hash_hit(HASH_START, &a->closest) == hash_hit(HASH_START, &b->closest) &&
                        memcmp(&a->closest.t, &b->closest.t, sizeof a->closest.t) == 0 &&
                        a->closest.geom == b->closest.geom && a->closest.prim == b->closest.prim));
}

/* ---------------------------------------------------------------- configs ---- */

static void add_config(struct tested **list, size_t *count, const char *kind, const char *key,
                       const char *value, bool form)
{
    *list = must_resize(*list, (*count + 1) * sizeof **list);
    struct tested *t = &(*list)[(*count)++];
    /* parts are there only where lazy is on */
    const bool part = key && strcmp(key, "part") == 0;
    t->standard = !key;
    t->form = form || (part && strcmp(value, "1") == 0);
    if (key)
        snprintf(t->config, sizeof t->config, "%s:%s%s=%s", kind, part ? "lazy=on," : "", key,
                 value);
    else
        snprintf(t->config, sizeof t->config, "%s", kind);
}

/* Both ends of the range, and two values between, evenly by ratio where the range is wide. */
static double middle(const accel_option *o, double part)
{
    const double lo = o->min, hi = o->max;
    const double x = lo >= 0 && hi > 100 * (lo + 1) ? pow(lo + 1, 1 - part) * pow(hi + 1, part) - 1
                                                    : lo + part * (hi - lo);
    return o->whole ? floor(x) : x;
}

static void add_numbers(struct tested **list, size_t *count, const char *kind,
                        const accel_option *o)
{
    const double value[] = {o->min, middle(o, 0.15), middle(o, 0.3), middle(o, 0.6), o->max};
    for (size_t i = 0; i < sizeof value / sizeof *value; i++) {
        char text[40];
        snprintf(text, sizeof text, "%.15g", value[i]);
        if (i == 0 || value[i] > value[i - 1])
            add_config(list, count, kind, o->key, text, false);
    }
}

static size_t keep_turns(struct tested *list, size_t count)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        if (list[i].form || takes_turn(i))
            list[kept++] = list[i];
    return kept;
}

size_t tested_configs(struct tested **list)
{
    size_t kinds, count = 0;
    const accel_kind_info *const *kind = accel_kinds(&kinds);
    *list = NULL;
    for (size_t i = 0; i < kinds; i++) {
        add_config(list, &count, kind[i]->name, NULL, NULL, true);
        for (size_t j = 0; j < kind[i]->option_count; j++) {
            const accel_option *o = &kind[i]->options[j];
            for (size_t w = 0; o->words && o->words[w]; w++)
                add_config(list, &count, kind[i]->name, o->key, o->words[w],
                           (double)w != o->standard);
            if (!o->words)
                add_numbers(list, &count, kind[i]->name, o);
        }
    }
    return keep_turns(*list, count);
}

bool kind_is_there(const char *name)
{
    size_t count;
    const accel_kind_info *const *kind = accel_kinds(&count);
    for (size_t i = 0; i < count; i++)
        if (strcmp(kind[i]->name, name) == 0)
            return true;
    return false;
}

/* --------------------------------------------------------------- failures ---- */

void print_answer(FILE *f, const char *who, const struct answer *a)
{
    fprintf(f, "  %-8s", who);
    if (a->hit)
        fprintf(f, " hit %u/%u t=%a u=%a v=%a", a->closest.geom, a->closest.prim, a->closest.t,
                a->closest.u, a->closest.v);
    else
        fprintf(f, " miss");
    fprintf(f, ", any %d, all %u (%016llx), ids %u (%016llx), refused %llu%s%s\n", a->any,
            a->all_count, (unsigned long long)a->all, a->id_count, (unsigned long long)a->ids,
            (unsigned long long)a->refused, a->illegal ? "; " : "", a->illegal ? a->illegal : "");
}

static void print_ray(FILE *f, const accel_ray *r)
{
    fprintf(f, "ray %a %a %a  %a %a %a  %a %a  %u %u\n", r->org[0], r->org[1], r->org[2], r->dir[0],
            r->dir[1], r->dir[2], r->tmin, r->tmax, r->skip.geom, r->skip.prim);
}

void report_failure(const struct failure *f, const struct test_scene *s)
{
    char name[200];
    snprintf(name, sizeof name, "failed-%s-%s-%llu.replay", f->scene, f->family,
             (unsigned long long)f->index);
    fprintf(stderr, "scene %s, seed %llu, rays %s, number %llu, config %s\n", f->scene,
            (unsigned long long)f->seed, f->family, (unsigned long long)f->index, f->config);
    print_ray(stderr, f->ray);
    print_answer(stderr, "linear", f->expected);
    print_answer(stderr, "found", f->found);
    FILE *out = fopen(name, "w");
    if (!out) {
        perror(name);
        return;
    }
    fprintf(out, "config %s\n", f->config);
    print_ray(out, f->ray);
    scene_write(out, s);
    fclose(out);
    fprintf(stderr, "  run again: replay %s\n", name);
}

accel *must_build(const struct test_scene *s, const char *config)
{
    accel *a;
    accel_error error;
    if (accel_build(&a, &s->scene, config, NULL, &error) != ACCEL_OK)
        fail_msg("%s: %s", config, error.text);
    return a;
}

struct forms build_forms(const struct test_scene *s)
{
    struct forms f = {NULL, NULL, 0};
    const size_t configs = tested_configs(&f.of);
    f.a = must_resize(NULL, configs * sizeof(accel *));
    for (size_t i = 0; i < configs; i++) {
        if (!f.of[i].form)
            continue;
        f.of[f.count] = f.of[i];
        f.a[f.count++] = must_build(s, f.of[i].config);
    }
    return f;
}

void free_forms(struct forms *f)
{
    for (size_t i = 0; i < f->count; i++)
        accel_free(f->a[i]);
    free(f->a);
    free(f->of);
}

uint64_t test_seed(void)
{
    const char *text = getenv("ACCEL_TEST_SEED");
    return text ? strtoull(text, NULL, 10) : 20260101;
}

void *pool_resize(void *user, void *old, size_t from, size_t to)
{
    struct pool *p = user;
    if (to > from && p->held - from + to > p->most)
        return NULL;
    void *block = to ? realloc(old, to) : NULL;
    if (to && !block)
        return NULL;
    if (!to)
        free(old);
    p->blocks += (size_t)(!old && to) - (size_t)(old && !to);
    p->held = p->held - from + to;
    p->peak = p->held > p->peak ? p->held : p->peak;
    return block;
}
