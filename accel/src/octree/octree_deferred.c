/* SPDX-License-Identifier: Apache-2.0
 *
 * Building a part of an octree while rays wait for it, as octree_deferred.h describes.
 *
 * A part is grown in a build of its own, which has its own account of memory, then moved into one
 * block: [part | words | later | references | ids]. Nothing that other threads can see changes
 * until the block is complete.
 */
#include "octree_deferred.h"

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
    to->deferred.at =
        place(&at, from->deferred.at, from->deferred.count * sizeof *from->deferred.at);
    to->refs.at = place(&at, from->refs.at, from->refs.count * sizeof *from->refs.at);
    to->deferred_ids.at =
        place(&at, from->deferred_ids.at, from->deferred_ids.count * sizeof(uint32_t));
    const uint32_t *ids = to->deferred_ids.at;
    for (size_t i = 0; i < to->deferred.count; i++) {
        to->deferred.at[i].ids = ids;
        ids += to->deferred.at[i].count;
    }
}

static struct octree_part *pack(struct memory *m, const struct octree_pool *pool)
{
    const size_t bytes = sizeof(struct octree_part) + pool->words.count * sizeof *pool->words.at +
                         pool->deferred.count * sizeof *pool->deferred.at +
                         (pool->refs.count + pool->deferred_ids.count) * sizeof(uint32_t);
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
make_part(const struct octree_lazy *lazy, const struct octree_deferred *deferred,
          const accel_box *tree)
{
    static const accel_hooks no_hooks = {.user = NULL};
    accel own = {.kind = lazy->a->kind, .memory = account(lazy), .prims = lazy->a->prims};
    accel_error error = {.status = ACCEL_OK};
    struct build build = {.a = &own,
                          .memory = &own.memory,
                          .info = &own.info,
                          .kind = lazy->a->info.kind,
                          .hooks = &no_hooks,
                          .error = &error,
                          .phase = "later"};
    struct octree_pool pool = {.nodes = 0};
    struct octree_cell root;
    bool refused;
    struct octree_part *part = NULL;
    if (accel_octree_grow_part(&build, &pool, &root, lazy, deferred, tree, &refused))
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
                                                 const struct octree_deferred *deferred,
                                                 const accel_box *tree)
{
    const fenv_t callers = environment_enter();
    struct octree_part *part = make_part(lazy, deferred, tree);
    environment_leave(&callers);
    return part;
}

/* While there is no memory, every entry would pay for a build in vain. */
static bool is_worth_a_try(struct octree_deferred *deferred)
{
    if (atomic_load_explicit(&deferred->retries, memory_order_relaxed) == 0)
        return true;
    const unsigned n = atomic_fetch_add_explicit(&deferred->retries, 1, memory_order_relaxed);
    return (n & (n - 1)) == 0;
}

static void turn_away(struct octree_deferred *deferred)
{
    unsigned none = 0;
    atomic_compare_exchange_strong_explicit(&deferred->retries, &none, 1, memory_order_relaxed,
                                            memory_order_relaxed);
}

/* Makes the part known. If another thread was quicker, frees it and returns the other one. */
static const struct octree_part *publish(const struct octree_lazy *lazy,
                                         struct octree_deferred *deferred, struct octree_part *part)
{
    const uintptr_t address = (uintptr_t)part, marked = address | octree_mark(address);
    uintptr_t other = 0;
    if (!atomic_compare_exchange_strong_explicit(&deferred->built, &other, marked,
                                                 memory_order_acq_rel, memory_order_acquire)) {
        free_part(lazy, part);
        return (const struct octree_part *)(other & ~(uintptr_t)OCTREE_MARK);
    }
    atomic_store_explicit(&deferred->check, ~marked, memory_order_release);
    return part;
}

const struct octree_part *accel_octree_build_part(const struct octree_lazy *lazy,
                                                  struct octree_deferred *deferred,
                                                  const accel_box *tree)
{
    if (!is_worth_a_try(deferred))
        return NULL;
    struct octree_part *part = make_part_as_in_build(lazy, deferred, tree);
    if (part)
        return publish(lazy, deferred, part);
    turn_away(deferred);
    return NULL;
}

bool accel_octree_part_is_sound(const struct octree_deferred *deferred,
                                const struct octree_part **part)
{
    const uintptr_t check = atomic_load_explicit(&deferred->check, memory_order_acquire);
    const uintptr_t built = atomic_load_explicit(&deferred->built, memory_order_acquire);
    const uintptr_t address = built & ~(uintptr_t)OCTREE_MARK;
    *part = check ? (const struct octree_part *)address : NULL;
    return (!check || check == ~built) && built == (address | octree_mark(address));
}

bool accel_octree_count(const struct octree_deferred *deferred, struct octree_census *census)
{
    const struct octree_part *part = octree_part_of(deferred);
    if (!part) {
        census->unbuilt += deferred->owned;
        return false;
    }
    const struct octree_pool *pool = &part->pool;
    census->nodes += pool->nodes;
    census->leaves += pool->leaves;
    census->references += pool->refs.count;
    census->bytes += part->bytes;
    census->depth = part->depth > census->depth ? part->depth : census->depth;
    census->refused |= part->refused;
    for (size_t i = 0; i < pool->deferred.count; i++)
        accel_octree_count(&pool->deferred.at[i], census);
    return true;
}

void accel_octree_free_parts(const struct octree_lazy *lazy, struct octree_deferred *deferred)
{
    struct octree_part *part = octree_part_of(deferred);
    if (!part)
        return;
    for (size_t i = 0; i < part->pool.deferred.count; i++)
        accel_octree_free_parts(lazy, &part->pool.deferred.at[i]);
    free_part(lazy, part);
}
