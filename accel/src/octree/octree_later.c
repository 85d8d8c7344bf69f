/* SPDX-License-Identifier: Apache-2.0
 *
 * Building a part of an octree while rays wait for it, as octree_later.h describes.
 *
 * A part is grown in a build of its own, which has its own account of memory, then moved into one
 * block: [part | words | later | references | ids]. Nothing that other threads can see changes
 * until the block is complete.
 */
#include "octree_later.h"

#include <string.h>

#include "../core/environment.h"

/* The hooks of the structure, but an account of its own. */
static struct memory account(const struct octree_lazy *lazy)
{
    return (struct memory){.resize = lazy->a->memory.resize, .user = lazy->a->memory.user};
}

/* Copies bytes to *at and moves that behind them. */
static void *place(char **at, const void *from, size_t bytes)
{
    void *to = *at;
    if (bytes > 0)
        memcpy(to, from, bytes);
    *at += bytes;
    return to;
}

static void place_pool(struct octree_pool *to, const struct octree_pool *from, char *at)
{
    *to = *from;
    to->words.at = place(&at, from->words.at, from->words.count * sizeof *from->words.at);
    to->later.at = place(&at, from->later.at, from->later.count * sizeof *from->later.at);
    to->refs.at = place(&at, from->refs.at, from->refs.count * sizeof *from->refs.at);
    to->later_ids.at = place(&at, from->later_ids.at, from->later_ids.count * sizeof(uint32_t));
    const uint32_t *ids = to->later_ids.at;
    for (size_t i = 0; i < to->later.count; i++) {
        to->later.at[i].ids = ids;
        ids += to->later.at[i].count;
    }
}

static struct octree_part *pack(struct memory *m, const struct octree_pool *pool)
{
    const size_t bytes = sizeof(struct octree_part) + pool->words.count * sizeof *pool->words.at +
                         pool->later.count * sizeof *pool->later.at +
                         (pool->refs.count + pool->later_ids.count) * sizeof(uint32_t);
    struct octree_part *part = accel_memory_resize(m, NULL, 0, bytes);
    if (!part || (uintptr_t)part & OCTREE_MARK) { /* aligned worse than malloc does */
        accel_memory_resize(m, part, part ? bytes : 0, 0);
        return NULL;
    }
    part->bytes = bytes;
    place_pool(&part->pool, pool, (char *)(part + 1));
    return part;
}

/* In the environment of builds: see environment.h. */
__attribute__((noinline)) static struct octree_part *
make_part(const struct octree_lazy *lazy, const struct octree_later *later, const accel_box *tree)
{
    static const accel_hooks no_hooks = {.user = NULL};
    accel own = {.kind = lazy->a->kind, .memory = account(lazy), .prims = lazy->a->prims};
    accel_error error = {.status = ACCEL_OK};
    struct build build = {.a = &own, .hooks = &no_hooks, .error = &error, .phase = "later"};
    struct octree_pool pool = {.nodes = 0};
    struct octree_cell root;
    bool refused;
    struct octree_part *part = NULL;
    if (accel_octree_grow_part(&build, &pool, &root, lazy, later, tree, &refused))
        part = pack(&own.memory, &pool);
    accel_octree_pool_free(&own.memory, &pool);
    if (part) {
        part->root = root;
        part->refused = refused;
        part->depth = own.info.depth;
    }
    return part;
}

static void free_part(const struct octree_lazy *lazy, struct octree_part *part)
{
    struct memory m = account(lazy);
    accel_memory_resize(&m, part, part->bytes, 0);
}

/* The structure must not depend on the mode in which some ray is traced. */
static struct octree_part *make_part_as_in_build(const struct octree_lazy *lazy,
                                                 const struct octree_later *later,
                                                 const accel_box *tree)
{
    const fenv_t callers = environment_enter();
    struct octree_part *part = make_part(lazy, later, tree);
    environment_leave(&callers);
    return part;
}

/* While there is no memory, every entry would pay for a build in vain. */
static bool is_worth_a_try(struct octree_later *later)
{
    if (atomic_load_explicit(&later->turned_away, memory_order_relaxed) == 0)
        return true;
    const unsigned n = atomic_fetch_add_explicit(&later->turned_away, 1, memory_order_relaxed);
    return (n & (n - 1)) == 0;
}

static void turn_away(struct octree_later *later)
{
    unsigned none = 0;
    atomic_compare_exchange_strong_explicit(&later->turned_away, &none, 1, memory_order_relaxed,
                                            memory_order_relaxed);
}

/* Makes the part known. If another thread was quicker, frees it and returns the other one. */
static const struct octree_part *publish(const struct octree_lazy *lazy, struct octree_later *later,
                                         struct octree_part *part)
{
    const uintptr_t address = (uintptr_t)part, marked = address | octree_mark(address);
    uintptr_t other = 0;
    if (!atomic_compare_exchange_strong_explicit(&later->built, &other, marked,
                                                 memory_order_acq_rel, memory_order_acquire)) {
        free_part(lazy, part);
        return (const struct octree_part *)(other & ~(uintptr_t)OCTREE_MARK);
    }
    atomic_store_explicit(&later->check, ~marked, memory_order_release);
    return part;
}

const struct octree_part *accel_octree_build_part(const struct octree_lazy *lazy,
                                                  struct octree_later *later, const accel_box *tree)
{
    if (!is_worth_a_try(later))
        return NULL;
    struct octree_part *part = make_part_as_in_build(lazy, later, tree);
    if (part)
        return publish(lazy, later, part);
    turn_away(later);
    return NULL;
}

bool accel_octree_part_is_sound(const struct octree_later *later, const struct octree_part **part)
{
    const uintptr_t check = atomic_load_explicit(&later->check, memory_order_acquire);
    const uintptr_t built = atomic_load_explicit(&later->built, memory_order_acquire);
    const uintptr_t address = built & ~(uintptr_t)OCTREE_MARK;
    *part = check ? (const struct octree_part *)address : NULL;
    return (!check || check == ~built) && built == (address | octree_mark(address));
}

bool accel_octree_count(const struct octree_later *later, struct octree_census *census)
{
    const struct octree_part *part = octree_part_of(later);
    if (!part) {
        census->unbuilt += later->owned;
        return false;
    }
    const struct octree_pool *pool = &part->pool;
    census->nodes += pool->nodes;
    census->leaves += pool->leaves;
    census->references += pool->refs.count;
    census->bytes += part->bytes;
    census->depth = part->depth > census->depth ? part->depth : census->depth;
    census->refused |= part->refused;
    for (size_t i = 0; i < pool->later.count; i++)
        accel_octree_count(&pool->later.at[i], census);
    return true;
}

void accel_octree_free_parts(const struct octree_lazy *lazy, struct octree_later *later)
{
    struct octree_part *part = octree_part_of(later);
    if (!part)
        return;
    for (size_t i = 0; i < part->pool.later.count; i++)
        accel_octree_free_parts(lazy, &part->pool.later.at[i]);
    free_part(lazy, part);
}
