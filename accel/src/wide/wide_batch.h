/* SPDX-License-Identifier: Apache-2.0
 *
 * Many rays at once through a tree that the caches do not hold, included by the file of an
 * instruction set after wide_fast.h: some rays are under way together, and while one waits for
 * memory the others are walked. After Wald, Benthin and Boulos 2008 (single rays, wide nodes) and
 * Chen, Ailamaki, Gibbons and Mowry, "Improving Hash Join Performance Through Prefetching", 2004.
 *
 * A strand is one ray's walk between two steps: all that walk_closest and walk_any (wide_fast.h)
 * keep in their variables. A step is one node or one leaf, and ends by asking for the memory of the
 * next; by the time the strand's turn comes again that is there.
 *
 * Invariant: the steps of a strand are those of its ray's own walk, in their order. So every answer
 * and every count is that of the ray asked alone.
 *
 * Cost: BATCH_ROOM and BATCH_STRANDS strands on the stack, 50 KB in all. Bad at: trees that the
 * caches hold, where a ray of its own keeps more in registers: see WIDE_BATCH_BYTES.
 */

/* Strands at most, and words that wait in all of them together: a tree as deep as allowed leaves
 * room for two strands. */
enum { BATCH_STRANDS = 16, BATCH_ROOM = 4096 };

/* Words that a strand may stack; behind the last one an any walk writes WIDE. */
static inline uint32_t strand_room(const struct wide *w)
{
    return w->depth * (WIDE - 1) + WIDE + 2;
}

struct strand {
    struct wide_fast f;
    size_t number;        /* of its ray */
    float limit;          /* what a child must not begin behind */
    uint32_t word;        /* of the next step */
    waiting *stack, *top; /* of a closest walk */
    uint32_t *words;      /* top of an any walk, which stacks words from the same place on */
};

/* The rays of a call, and what is told of them. */
struct batch {
    const accel *a;
    const struct wide *w;
    const accel_ray *rays;
    accel_hit *hits; /* or NULL */
    bool *flags;     /* or NULL */
    size_t count, next;
    size_t found; /* rays that hit */
    accel_query *counters;
};

/* A node whole, or most leaves: how large a leaf is, its first bytes say. */
static inline void prefetch_all(const struct wide *w, uint32_t word)
{
    const unsigned char *at = w->base + 16 * (size_t)(word & ~WIDE_LEAF);
    const size_t bytes = word & WIDE_LEAF ? 256 : sizeof(struct wide_node);
    for (size_t i = 0; i < bytes; i += 64)
        __builtin_prefetch(at + i);
}

/* False: the walk has ended. */
static inline bool step_closest(const struct wide *w, struct strand *s)
{
    if (!(s->word & WIDE_LEAF)) {
        const struct wide_node *node = wide_node_at(w, s->word);
        const struct node_ray n = node_ray_from(&s->f.ray, s->limit);
        begins begin;
        const uint32_t meets = node_meets(&n, node, &begin);
        s->f.nodes++;
        if (meets != 0) {
            s->word = descend(w, node, meets, &begin, &s->top);
            prefetch_all(w, s->word);
            return true;
        }
    } else if (test_blocks(&s->f, wide_leaf_at(w, s->word), false)) {
        s->limit = wide_limit(&s->f.ray, s->f.best < s->f.tmax ? s->f.best : s->f.tmax);
    }
    do {
        if (s->top == s->stack)
            return false;
        s->word = (uint32_t) * --s->top;
    } while (*s->top >> 32 > bits_of(s->limit));
    prefetch_all(w, s->word);
    return true;
}

/* The same of any hit, with a word that is never taken at the bottom of the stack. */
static inline bool step_any(const struct wide *w, struct strand *s)
{
    if (!(s->word & WIDE_LEAF)) {
        const struct wide_node *node = wide_node_at(w, s->word);
        const struct node_ray n = node_ray_from(&s->f.ray, s->limit);
        begins begin;
        const uint32_t meets = node_meets(&n, node, &begin);
        s->f.nodes++;
        if (meets != 0) {
            const uint32_t last = 31 - (uint32_t)__builtin_clz(meets);
            s->word = node->child[last];
            s->words = push_children(s->words, meets ^ 1u << last, node);
            prefetch_all(w, s->word);
            return true;
        }
    } else if (test_blocks(&s->f, wide_leaf_at(w, s->word), true)) {
        return false;
    }
    s->word = *--s->words;
    if ((void *)s->words == (void *)s->stack)
        return false;
    prefetch_all(w, s->word);
    return true;
}

static inline void tell(struct batch *b, size_t number, bool found, const accel_hit *hit)
{
    b->found += found;
    if (b->flags)
        b->flags[number] = found;
    if (b->hits)
        b->hits[number] = found ? *hit : wide_no_hit();
}

static inline void end_strand(struct batch *b, const struct strand *s)
{
    const struct wide_fast *f = &s->f;
    accel_hit hit = wide_no_hit();
    end_fast(f);
    if (f->id != ACCEL_NONE && b->hits)
        hit = hit_of(f);
    tell(b, s->number, f->id != ACCEL_NONE, &hit);
}

/* A ray that is not one for these walks, by itself. */
__attribute__((noinline)) static void ask_alone(struct batch *b, size_t number, bool any)
{
    accel_hit hit;
    const accel_ray *ray = &b->rays[number];
    const bool found =
        any ? accel_any(b->a, ray, b->counters) : accel_closest(b->a, ray, &hit, b->counters);
    tell(b, number, found, &hit);
}

/* Lets a strand begin with the next ray. False: there is none left. */
static inline bool begin_strand(struct batch *b, struct strand *s, bool any)
{
    while (b->next < b->count) {
        s->number = b->next++;
        if (!begin_fast(&s->f, b->a, b->w, &b->rays[s->number], b->counters, any)) {
            ask_alone(b, s->number, any);
            continue;
        }
        if (any && __builtin_expect(s->f.id != ACCEL_NONE, 0)) {
            end_strand(b, s);
            continue;
        }
        s->limit = wide_limit(&s->f.ray, !any && s->f.best < s->f.tmax ? s->f.best : s->f.tmax);
        s->word = b->w->root;
        s->top = s->stack;
        s->words = (uint32_t *)s->stack;
        if (any)
            *s->words++ = s->word;
        return true;
    }
    return false;
}

__attribute__((always_inline)) static inline void walk_batch(struct batch *b, bool any)
{
    waiting room[BATCH_ROOM];
    struct strand strands[BATCH_STRANDS], *live[BATCH_STRANDS];
    const uint32_t each = strand_room(b->w);
    uint32_t count = 0;
    for (uint32_t i = 0; i < BATCH_STRANDS && (i + 1) * each <= BATCH_ROOM; i++) {
        live[count] = &strands[i];
        strands[i].stack = room + i * each;
        if (!begin_strand(b, live[count], any))
            break;
        count++;
    }
    while (count > 0) {
        for (uint32_t i = 0; i < count; i++) {
            struct strand *s = live[i];
            if (any ? step_any(b->w, s) : step_closest(b->w, s))
                continue;
            end_strand(b, s);
            if (!begin_strand(b, s, any))
                live[i--] = live[--count];
        }
    }
}

static size_t closest_n(const accel *a, const struct wide *w, const accel_ray *rays,
                        accel_hit *hits, size_t count, accel_query *counters)
{
    struct batch b = {a, w, rays, hits, NULL, count, 0, 0, counters};
    walk_batch(&b, false);
    return b.found;
}

static size_t any_n(const accel *a, const struct wide *w, const accel_ray *rays, bool *flags,
                    size_t count, accel_query *counters)
{
    struct batch b = {a, w, rays, NULL, flags, count, 0, 0, counters};
    walk_batch(&b, true);
    return b.found;
}
