/* SPDX-License-Identifier: Apache-2.0
 *
 * Changes of the input whose effect on the answer is known without any oracle: scaling by powers of
 * two, mirrors, turned axes, another order of the primitives, more primitives, longer directions,
 * cut rays.
 */
#include <stdlib.h>
#include <string.h>

#include "cmocka_all.h"
#include "compare.h"

enum { RAYS = 300 };

/* All hits of one ray. */
struct list {
    accel_hit at[KEPT];
    uint32_t count;
};

static bool store(void *user, const accel_hit *hit)
{
    struct list *l = user;
    l->at[l->count++] = *hit;
    return l->count < KEPT;
}

static void all_hits(const accel *a, const accel_ray *ray, struct list *l)
{
    l->count = 0;
    accel_all(a, ray, store, l, NULL);
    accel_hit hit;
    const bool found = accel_closest(a, ray, &hit, NULL);
    assert_int_equal(found, l->count > 0);
    assert_true(!found || memcmp(&hit, l->at, sizeof hit) == 0);
}

/* What was done to a scene. */
struct change {
    const char *name;
    int scale;      /* coordinates times 2^scale */
    int lengthen;   /* directions times 2^lengthen */
    bool mirror[3]; /* axes */
    int turn;       /* axis k becomes axis (k + turn) % 3 */
    bool shuffle;   /* the primitives come in another order */
    bool twice;     /* the scene comes twice */
    bool more;      /* other primitives are added behind */
    uint64_t round; /* another order, another number */
    uint64_t rays;  /* 0 stands for RAYS */
};

static void move_point(const struct change *c, const double *from, double *to)
{
    for (int k = 0; k < 3; k++)
        to[(k + c->turn) % 3] = ldexp(c->mirror[k] ? -from[k] : from[k], c->scale);
}

static void move_primitive(const struct change *c, struct part *to, const struct part *from,
                           uint32_t i)
{
    double x[9];
    if (from->type == ACCEL_TRIANGLES) {
        for (size_t corner = 0; corner < 3; corner++)
            move_point(c, from->data + 9 * (size_t)i + 3 * corner, x + 3 * corner);
        part_triangle(to, x, x + 3, x + 6);
    } else {
        move_point(c, from->data + 4 * (size_t)i, x);
        part_sphere(to, x, ldexp(from->data[4 * (size_t)i + 3], c->scale));
    }
}

/* order[i]: where primitive i of a part comes from. */
static void make_order(uint32_t *order, uint32_t count, bool shuffle, struct rng *d)
{
    for (uint32_t i = 0; i < count; i++)
        order[i] = i;
    for (uint32_t i = count; shuffle && i > 1; i--) {
        const uint32_t j = rng_below(d, i), kept = order[i - 1];
        order[i - 1] = order[j];
        order[j] = kept;
    }
}

/* A changed scene; maps its ids back to those of the original. */
struct changed {
    struct test_scene scene;
    uint32_t *order[8]; /* by geometry of the original */
    uint32_t parts;     /* geometries of the original */
};

static void change_scene(struct changed *to, const struct test_scene *from, const struct change *c)
{
    struct rng d = rng_from(test_seed() + c->round, 51);
    scene_open(&to->scene);
    to->parts = from->count;
    assert_true(from->count <= 8);
    for (uint32_t copy = 0; copy <= (uint32_t)c->twice; copy++) {
        for (uint32_t g = 0; g < from->count; g++) {
            const struct part *p = &from->part[g];
            struct part *made = scene_part(&to->scene, p->type);
            if (copy == 0)
                to->order[g] = must_resize(NULL, p->count * sizeof **to->order);
            if (copy == 0)
                make_order(to->order[g], p->count, c->shuffle, &d);
            for (uint32_t i = 0; i < p->count; i++)
                move_primitive(c, made, p, to->order[g][i]);
        }
    }
    if (c->more)
        make_shards(&to->scene, &d, 100);
    scene_close(&to->scene);
}

static void free_changed(struct changed *c)
{
    scene_free(&c->scene);
    for (uint32_t g = 0; g < c->parts; g++)
        free(c->order[g]);
}

static accel_ray change_ray(const struct change *c, const accel_ray *ray)
{
    accel_ray moved = *ray;
    struct change direction = *c;
    direction.scale = c->lengthen;
    move_point(c, ray->org, moved.org);
    move_point(&direction, ray->dir, moved.dir);
    return moved;
}

/* Turns the hits of the changed scene back into those of the original, in its order. Hits of what
 * was added, and of the second copy, go. */
static int by_order(const void *x, const void *y)
{
    const accel_hit *a = x, *b = y;
    if (a->t != b->t)
        return a->t < b->t ? -1 : 1;
    if (a->geom != b->geom)
        return a->geom < b->geom ? -1 : 1;
    return a->prim < b->prim ? -1 : a->prim > b->prim;
}

static void change_back(const struct changed *to, const struct change *c, struct list *l)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < l->count; i++) {
        accel_hit h = l->at[i];
        if (h.geom >= to->parts)
            continue;
        h.t = ldexp(h.t, c->lengthen - c->scale);
        h.prim = to->order[h.geom][h.prim];
        l->at[kept++] = h;
    }
    l->count = kept;
    qsort(l->at, kept, sizeof *l->at, by_order);
}

/* All bits but the signs of zeros, which a mirror changes. */
static bool same_lists(const struct list *a, const struct list *b)
{
    for (uint32_t i = 0; i < a->count && i < b->count; i++) {
        const accel_hit *x = &a->at[i], *y = &b->at[i];
        if (x->t != y->t || x->u != y->u || x->v != y->v || x->geom != y->geom ||
            x->prim != y->prim)
            return false;
    }
    return a->count == b->count;
}

/* Every copy must hit as its original does, and ties go to the first: so half of the hits are of
 * originals, each just before its copy. */
static bool is_doubled(const struct changed *to, const struct list *l)
{
    for (uint32_t i = 0; i + 1 < l->count; i++) {
        uint32_t copies = 0;
        for (uint32_t j = 0; j < l->count; j++)
            copies += l->at[j].prim == l->at[i].prim && l->at[j].t == l->at[i].t &&
                      l->at[j].geom % to->parts == l->at[i].geom % to->parts;
        if (copies != 2)
            return false;
    }
    return l->count == 0 || l->at[0].geom < to->parts;
}

static void complain(const char *kind, const char *scene, const struct change *c,
                     const accel_ray *r, const struct list *expected, const struct list *found)
{
    fprintf(stderr, "ray %a %a %a  %a %a %a\n", r->org[0], r->org[1], r->org[2], r->dir[0],
            r->dir[1], r->dir[2]);
    for (int side = 0; side < 2; side++) {
        const struct list *l = side ? found : expected;
        fprintf(stderr, "  %s: %u hits", side ? "changed" : "original", l->count);
        for (uint32_t i = 0; i < l->count && i < 6; i++)
            fprintf(stderr, ", %u/%u t=%a u=%a v=%a", l->at[i].geom, l->at[i].prim, l->at[i].t,
                    l->at[i].u, l->at[i].v);
        fputc('\n', stderr);
    }
    fail_msg("%s on %s, %s: the hits differ", kind, scene, c->name);
}

static void try_kind(const char *kind, const char *name, const struct test_scene *s,
                     const struct changed *to, const struct change *c)
{
    accel *a = must_build(s, kind), *b = must_build(&to->scene, kind);
    struct rng d = rng_from(test_seed(), 52);
    const uint64_t rays = scaled_count(c->rays ? c->rays : RAYS);
    uint64_t hits = 0;
    for (uint64_t i = 0; i < rays; i++) {
        struct list expected, found;
        const accel_ray ray = ray_families->make(&s->target, a, &d, i);
        const accel_ray moved = change_ray(c, &ray);
        all_hits(a, &ray, &expected);
        all_hits(b, &moved, &found);
        if (c->twice && !is_doubled(to, &found))
            complain(kind, name, c, &ray, &expected, &found);
        change_back(to, c, &found);
        if (!same_lists(&expected, &found))
            complain(kind, name, c, &ray, &expected, &found);
        hits += expected.count;
    }
    assert_true(hits > rays / 4);
    accel_free(a);
    accel_free(b);
}

static void try_change(const char *name, const struct change *c)
{
    struct test_scene s;
    struct changed to;
    struct tested *list;
    const size_t configs = tested_configs(&list);
    scene_make(&s, scene_maker_find(name), test_seed());
    change_scene(&to, &s, c);
    for (size_t k = 0; k < configs; k++)
        if (list[k].form)
            try_kind(list[k].config, name, &s, &to, c);
    free(list);
    free_changed(&to);
    scene_free(&s);
}

static void test_scales(void **state)
{
    (void)state;
    static const int power[] = {1, -1, 10, -10, 40, -40, 100, -100, 200, -200};
    for (size_t i = 0; i < sizeof power / sizeof *power; i++) {
        char name[60];
        snprintf(name, sizeof name, "scaled by 2^%d", power[i]);
        try_change("scale-1", &(struct change){.name = name, .scale = power[i]});
        snprintf(name, sizeof name, "scaled by 2^%d, directions as well", power[i]);
        try_change("scale-1",
                   &(struct change){.name = name, .scale = power[i], .lengthen = power[i]});
    }
}

static void test_lengths(void **state)
{
    (void)state;
    static const int power[] = {500, -500};
    for (size_t i = 0; i < 2; i++) {
        char name[60];
        snprintf(name, sizeof name, "directions times 2^%d", power[i]);
        try_change("scale-1", &(struct change){.name = name, .lengthen = power[i], .rays = 2500});
        try_change("sizes", &(struct change){.name = name, .lengthen = power[i], .rays = 2500});
    }
}

/* Far beyond where the square of a length is a double. */
static void test_spheres(void **state)
{
    (void)state;
    static const int power[] = {250, -250, 700, -700, 900, -900};
    for (size_t i = 0; i < sizeof power / sizeof *power; i++) {
        char name[60];
        snprintf(name, sizeof name, "scaled by 2^%d", power[i]);
        try_change("one-sphere", &(struct change){.name = name, .scale = power[i]});
        snprintf(name, sizeof name, "directions times 2^%d", power[i]);
        try_change("one-sphere", &(struct change){.name = name, .lengthen = power[i]});
    }
}

static void test_mirrors(void **state)
{
    (void)state;
    static const char *const scenes[] = {"scale-1", "sizes", "ball-mesh", "lattice", "slivers"};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        try_change(scenes[i], &(struct change){.name = "mirrored in x", .mirror = {true}});
        try_change(scenes[i],
                   &(struct change){.name = "mirrored in y and z", .mirror = {false, true, true}});
    }
}

/* Not for rays along a diagonal, which the shear test sees along another axis. */
static void test_turns(void **state)
{
    (void)state;
    try_change("scale-1", &(struct change){.name = "axes turned once", .turn = 1});
    try_change("sizes", &(struct change){.name = "axes turned twice", .turn = 2});
}

static void test_orders(void **state)
{
    (void)state;
    static const char *const scenes[] = {"scale-1", "ball-mesh", "lattice", "twins"};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        try_change(scenes[i], &(struct change){.name = "shuffled", .shuffle = true});
        try_change(scenes[i], &(struct change){.name = "twice", .twice = true});
        try_change(scenes[i], &(struct change){.name = "more behind", .more = true});
    }
}

/* The same ids win, whatever the order of building. */
static void test_ties(void **state)
{
    (void)state;
    static const char *const scenes[] = {"stack", "twins"};
    for (uint64_t round = 0; round < 10; round++) {
        char name[60];
        snprintf(name, sizeof name, "shuffle number %d", (int)round);
        for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++)
            try_change(scenes[i], &(struct change){
                                      .name = name, .shuffle = true, .round = round, .rays = 250});
    }
}

/* ------------------------------------------------------------------- cut rays ---- */

/* Each next hit by a query of its own, from the last t on, gives the list; ties come with it. */
static void check_next(const accel *a, const char *kind, const accel_ray *ray,
                       const struct list *all)
{
    accel_ray rest = *ray;
    accel_hit hit;
    uint32_t i = 0;
    while (accel_closest(a, &rest, &hit, NULL)) {
        if (i == all->count || memcmp(&hit, &all->at[i], sizeof hit) != 0)
            fail_msg("%s: the next hit is not number %u of all", kind, i);
        rest.tmin = hit.t;
        while (i < all->count && all->at[i].t == hit.t)
            i++;
    }
    assert_int_equal(i, all->count);
}

/* Two halves of a ray find what the whole does. */
static void check_split(const accel *a, const char *kind, const accel_ray *ray,
                        const struct list *all)
{
    struct list first, second;
    accel_ray near = *ray, far = *ray;
    const double t = all->at[all->count / 2].t;
    near.tmax = t;
    far.tmin = nextafter(t, -(double)INFINITY);
    all_hits(a, &near, &first);
    all_hits(a, &far, &second);
    if (first.count + second.count != all->count ||
        memcmp(first.at, all->at, first.count * sizeof *first.at) != 0 ||
        memcmp(second.at, all->at + first.count, second.count * sizeof *first.at) != 0)
        fail_msg("%s: a ray split at t = %a finds %u + %u hits, the whole %u", kind, t, first.count,
                 second.count, all->count);
}

/* The interval is open: at its first hit's t a ray ends before the hit, or begins behind it; one
 * step further or nearer it finds it. */
static void check_ends(const accel *a, const char *config, const accel_ray *ray, bool *hit)
{
    const double inf = (double)INFINITY;
    accel_hit first, h;
    *hit = accel_closest(a, ray, &first, NULL);
    if (!*hit)
        return;
    accel_ray until = *ray, past = *ray, from = *ray, behind = *ray;
    until.tmax = behind.tmin = first.t;
    past.tmax = nextafter(first.t, inf);
    from.tmin = nextafter(first.t, -inf);
    if (accel_closest(a, &until, &h, NULL) || accel_any(a, &until, NULL) ||
        !accel_closest(a, &past, &h, NULL) || memcmp(&h, &first, sizeof h) != 0 ||
        !accel_any(a, &past, NULL) || !accel_closest(a, &from, &h, NULL) ||
        memcmp(&h, &first, sizeof h) != 0 || !accel_any(a, &from, NULL) ||
        (accel_closest(a, &behind, &h, NULL) && !(h.t > first.t)))
        fail_msg("%s: the interval's ends: ray %a %a %a  %a %a %a, t = %a", config, ray->org[0],
                 ray->org[1], ray->org[2], ray->dir[0], ray->dir[1], ray->dir[2], first.t);
}

static void test_ends(void **state)
{
    (void)state;
    static const char *const scenes[] = {"shards", "twins", "lattice", "slivers"};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct test_scene s;
        scene_make(&s, scene_maker_find(scenes[i]), test_seed());
        struct forms all = build_forms(&s);
        struct rng d = rng_from(test_seed(), 54);
        uint64_t hits = 0;
        const uint64_t count = scaled_count(5000);
        for (uint64_t r = 0; r < count; r++) {
            const accel_ray ray = ray_families->make(&s.target, all.a[0], &d, r);
            bool hit = false;
            for (size_t k = 1; k < all.count; k++)
                check_ends(all.a[k], all.of[k].config, &ray, &hit);
            hits += hit;
        }
        assert_true(hits > count / 10);
        free_forms(&all);
        scene_free(&s);
    }
}

static void test_cuts(void **state)
{
    (void)state;
    static const char *const scenes[] = {"mixed-key", "lattice", "twins", "nested-spheres"};
    size_t kinds;
    const accel_kind_info *const *kind = accel_kinds(&kinds);
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct test_scene s;
        scene_make(&s, scene_maker_find(scenes[i]), test_seed());
        for (size_t k = 0; k < kinds; k++) {
            accel *a = must_build(&s, kind[k]->name);
            struct rng d = rng_from(test_seed(), 53);
            for (uint64_t r = 0; r < RAYS; r++) {
                const accel_ray ray = ray_families->make(&s.target, a, &d, r);
                struct list all;
                all_hits(a, &ray, &all);
                if (all.count == 0 || all.count == KEPT)
                    continue;
                check_next(a, kind[k]->name, &ray, &all);
                check_split(a, kind[k]->name, &ray, &all);
            }
            accel_free(a);
        }
        scene_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_scales),  cmocka_unit_test(test_lengths),
        cmocka_unit_test(test_spheres), cmocka_unit_test(test_mirrors),
        cmocka_unit_test(test_turns),   cmocka_unit_test(test_orders),
        cmocka_unit_test(test_ties),    cmocka_unit_test(test_ends),
        cmocka_unit_test(test_cuts),
    };
    return cmocka_run_group_tests_name("metamorphic", tests, NULL, NULL);
}
