/* SPDX-License-Identifier: Apache-2.0
 *
 * accel_validate on structures whose memory was overwritten: every block that was allocated, by
 * single bits and by more. It ends, reads nothing that is not there (sanitizers watch), and calls
 * no structure sound that answers otherwise than before. What was not overwritten is sound, in
 * every floating-point mode and whatever mode it was built in.
 */
#include <stdlib.h>
#include <string.h>

#include "cmocka_all.h"
#include "compare.h"
#include "modes.h"

/* ----------------------------------------------------------------- blocks ---- */

struct block {
    unsigned char *at;
    size_t size;
};

/* All that a structure holds. */
struct blocks {
    struct block *at;
    size_t count, room;
};

static void forget(struct blocks *b, const void *at)
{
    for (size_t i = 0; i < b->count; i++)
        if (b->at[i].at == at) {
            b->at[i] = b->at[--b->count];
            return;
        }
}

static void *tracked(void *user, void *old, size_t from, size_t to)
{
    struct blocks *b = user;
    (void)from;
    if (old)
        forget(b, old);
    if (to == 0) {
        free(old);
        return NULL;
    }
    if (b->count == b->room) {
        b->room = 2 * b->room + 16;
        b->at = must_resize(b->at, b->room * sizeof *b->at);
    }
    b->at[b->count] = (struct block){must_resize(old, to), to};
    return b->at[b->count++].at;
}

/* ----------------------------------------------------------------- damage ---- */

enum { MOST_BYTES = 200 };

/* Sorts of damage. */
enum sort { BIT, WORD, MORE, SORTS };
static const char *const sort_names[SORTS] = {"single bits", "single words", "more"};

/* Bytes of one block that were overwritten. */
struct wound {
    struct block block; /* where */
    size_t from, size;  /* which of its bytes */
    unsigned char before[MOST_BYTES];
    const char *how;
};

static void begin(struct wound *w, const struct block *b, size_t at, size_t size)
{
    w->block = *b;
    w->from = at;
    w->size = size < b->size - at ? size : b->size - at;
    memcpy(w->before, b->at + at, w->size);
}

static void flip_bit(struct wound *w, const struct block *b, struct rng *d)
{
    begin(w, b, (size_t)(rng_unit(d) * (double)b->size), 1);
    b->at[w->from] ^= (unsigned char)(1u << rng_below(d, 8));
    w->how = "a bit flipped";
}

/* Overwrites whole words with the byte; 256: with random ones. */
static void write_words(struct wound *w, const struct block *b, struct rng *d, size_t size,
                        int byte)
{
    begin(w, b, (size_t)(rng_unit(d) * (double)b->size) & ~(size_t)3, size);
    for (size_t i = 0; i < w->size; i++)
        b->at[w->from + i] = (unsigned char)(byte < 256 ? (uint32_t)byte : rng_below(d, 256));
    w->how = byte == 256 ? "random words" : byte ? "words of ones" : "words of zeros";
}

/* Copies bytes from another place of the block: what is there is often legal. */
static void copy_words(struct wound *w, const struct block *b, struct rng *d)
{
    const size_t from = (size_t)(rng_unit(d) * (double)b->size) & ~(size_t)3;
    begin(w, b, (size_t)(rng_unit(d) * (double)b->size) & ~(size_t)3, 4u << rng_below(d, 4));
    w->size = w->size < b->size - from ? w->size : b->size - from;
    memmove(b->at + w->from, b->at + from, w->size);
    w->how = "words from elsewhere in the block";
}

/* What no check of ranges can see: a double's sign, its neighbour, infinity; an index's neighbour.
 */
static void change_word(struct wound *w, const struct block *b, struct rng *d)
{
    const size_t size = b->size < 8 || rng_chance(d, 0.3) ? 4 : 8;
    uint64_t word = 0;
    begin(w, b, (size_t)(rng_unit(d) * (double)(b->size / size)) * size, size);
    memcpy(&word, b->at + w->from, w->size);
    switch (rng_below(d, 5)) {
    case 0:
        word ^= 0x8000000000000000;
        break;
    case 1:
        word++;
        break;
    case 2:
        word--;
        break;
    case 3:
        word = 0;
        break;
    default:
        word = 0x7ff0000000000000;
    }
    memcpy(b->at + w->from, &word, w->size);
    w->how = "a word changed";
}

static void hurt(struct wound *w, const struct blocks *blocks, struct rng *d, enum sort sort)
{
    const struct block *b = &blocks->at[rng_below(d, (uint32_t)blocks->count)];
    if (sort == BIT)
        flip_bit(w, b, d);
    else if (sort == WORD)
        change_word(w, b, d);
    else if (rng_chance(d, 0.3))
        copy_words(w, b, d);
    else
        write_words(w, b, d, 4u << rng_below(d, 6), (int[]){0, 255, 256, 256}[rng_below(d, 4)]);
}

static void heal(const struct wound *w)
{
    memcpy(w->block.at + w->from, w->before, w->size);
}

/* -------------------------------------------------------------- structures ---- */

enum { RAYS = 48 };

/* Rays of all families in turn, made while the structure is whole. */
static void make_rays(accel_ray *rays, const accel *a, const struct test_scene *s)
{
    struct rng d = rng_from(test_seed(), 3);
    const struct ray_family *f = ray_families;
    for (uint64_t i = 0; i < RAYS; i++) {
        rays[i] = f->make(&s->target, a, &d, i);
        f = f[1].name ? f + 1 : ray_families;
    }
}

static uint64_t hash_answers(const accel *a, const accel_ray *rays)
{
    uint64_t hash = HASH_START;
    for (uint64_t i = 0; i < RAYS; i++) {
        const struct answer answer = ask(a, &rays[i], true);
        hash = answer_hash(hash, &answer);
    }
    return hash;
}

/* How many wounds of each sort were told, and how many mattered not. */
static struct tally {
    uint64_t broken, sound;
} tally[SORTS];

struct patient {
    const struct test_scene *scene;
    const char *name, *config;
    accel *a;
    struct blocks blocks;
    accel_ray rays[RAYS];
    uint64_t expected; /* hash of its answers */
};

static void examine(struct patient *p, const struct wound *w, size_t wounds, enum sort sort)
{
    accel_error error;
    const accel_status status = accel_validate(p->a, &error);
    tally[sort].broken += status == ACCEL_BROKEN;
    tally[sort].sound += status == ACCEL_OK;
    assert_int_equal(status, error.status);
    assert_true(status == ACCEL_BROKEN || status == ACCEL_OK);
    if (status == ACCEL_OK && hash_answers(p->a, p->rays) != p->expected)
        fail_msg(
            "%s on %s: called sound, but answers otherwise after %zu wounds; the first: %s in a "
            "block of %zu bytes, %zu of them from byte %zu on",
            p->config, p->name, wounds, w->how, w->block.size, w->size, w->from);
    if (status == ACCEL_BROKEN && strlen(error.text) < 10)
        fail_msg("%s on %s: '%s'", p->config, p->name, error.text);
}

static void hurt_and_examine(struct patient *p, struct rng *d, enum sort sort)
{
    enum { MOST_WOUNDS = 3 };
    struct wound w[MOST_WOUNDS];
    const size_t wounds = sort == MORE ? 1 + rng_below(d, MOST_WOUNDS) : 1;
    for (size_t i = 0; i < wounds; i++)
        hurt(&w[i], &p->blocks, d, sort);
    examine(p, w, wounds, sort);
    for (size_t i = wounds; i-- > 0;)
        heal(&w[i]);
}

static void open_patient(struct patient *p, const struct test_scene *s, const char *name,
                         const char *config)
{
    *p = (struct patient){.scene = s, .name = name, .config = config};
    const accel_hooks hooks = {.user = &p->blocks, .resize = tracked};
    accel_error error;
    if (accel_build(&p->a, &s->scene, config, &hooks, &error) != ACCEL_OK)
        fail_msg("%s on %s: %s", config, name, error.text);
    make_rays(p->rays, p->a, s);
    p->expected = hash_answers(p->a, p->rays);
}

static void close_patient(struct patient *p)
{
    accel_error error;
    if (accel_validate(p->a, &error) != ACCEL_OK)
        fail_msg("%s on %s, healed: %s", p->config, p->name, error.text);
    assert_int_equal(hash_answers(p->a, p->rays), p->expected);
    accel_free(p->a);
    /* where a wound made a part look as if it was not built, rays built it, and healing lost that
     */
    assert_true(p->blocks.count == 0 || strstr(p->config, "lazy=on"));
    while (p->blocks.count > 0)
        tracked(&p->blocks, p->blocks.at[0].at, p->blocks.at[0].size, 0);
    free(p->blocks.at);
}

static void try_config(const struct test_scene *s, const char *name, const char *config,
                       uint64_t wounds)
{
    struct patient p;
    struct rng d = rng_from(test_seed(), 7);
    open_patient(&p, s, name, config);
    for (uint64_t i = 0; i < wounds; i++)
        hurt_and_examine(&p, &d, (enum sort)(i % SORTS));
    close_patient(&p);
}

/* Beside every form: many clusters, small leaves, many parts. */
static const char *const more[] = {
    "hug:connectivity=0",
    "hug:form=paper,connectivity=0",
    "hug:octaves=1",
    "hug:density=1e-3",
    "hoo:connectivity=0",
    "hoo:form=classic,connectivity=0",
    "hoo:octaves=1,leaf=1",
    "hoo:lazy=on,connectivity=0",
    "hoo:lazy=on,part=30",
    "hoo:lazy=on,part=1,leaf=1",
    "octree:root=scene,leaf=1",
    "octree:depth=4",
    "bvh:isa=portable",
    "octree:form=classic",
    "bsp:leaf=1",
    "bsp:depth=0",
    "grid:density=100",
};

static bool config_is_there(const char *config)
{
    char kind[20];
    snprintf(kind, sizeof kind, "%.*s", (int)strcspn(config, ":"), config);
    return kind_is_there(kind);
}

static void test_damage(void **state)
{
    (void)state;
    static const char *const scenes[] = {
        "mixed",          "shards", "thicket",      "degenerate",   "lattice",       "series",
        "nested-spheres", "twins",  "one-triangle", "scale-1e-310", "huge-and-tiny", "stack"};
    const uint64_t wounds = scaled_count(180);
    struct tested *list;
    const size_t count = tested_configs(&list);
    memset(tally, 0, sizeof tally);
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct test_scene s;
        scene_make(&s, scene_maker_find(scenes[i]), test_seed());
        for (size_t j = 0; j < count; j++)
            if (list[j].form)
                try_config(&s, scenes[i], list[j].config, wounds);
        for (size_t j = 0; j < sizeof more / sizeof *more; j++)
            if (config_is_there(more[j]))
                try_config(&s, scenes[i], more[j], wounds);
        scene_free(&s);
    }
    free(list);
    for (int sort = 0; sort < SORTS; sort++) {
        print_message("%s: %llu told, %llu of no consequence\n", sort_names[sort],
                      (unsigned long long)tally[sort].broken,
                      (unsigned long long)tally[sort].sound);
        assert_true(tally[sort].broken > tally[sort].sound);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_damage)};
    return cmocka_run_group_tests_name("damage", tests, NULL, NULL);
}
