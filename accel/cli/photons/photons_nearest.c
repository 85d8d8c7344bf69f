/* SPDX-License-Identifier: Apache-2.0
 *
 * The nearest photons, from a hashed lattice of cells as wide as the search radius: all photons
 * near a receiver lie in 27 cells. Photons are sorted by slot, so a slot is a run of the array.
 */
#include "photons.h"

#include "tool/threads.h"
#include "photons_vector.h"

#include <stdatomic.h>
#include <stdlib.h>

/* The photons, sorted by the slot of their cell. */
typedef struct lattice {
    const struct photons *photons;
    double cell;     /* its width */
    size_t slots;    /* a power of two */
    size_t *first;   /* slots + 1: where a slot's run begins */
    uint32_t *order; /* of the photons */
} lattice;

/* A photon near the receiver. */
typedef struct neighbour {
    double square; /* of the distance */
    uint32_t photon;
} neighbour;

/* The nearest photons so far, as a heap with the farthest on top. */
typedef struct nearest {
    neighbour *heap; /* room of them */
    uint32_t count, capacity;
} nearest;

/* The estimate under way. */
typedef struct estimate {
    lattice lattice;
    const struct photon_run *run;
    struct receivers receivers;
    double radius;
    uint32_t nearest;
    double *irradiance;
    atomic_size_t next;
    atomic_bool failed;
} estimate;

/* Far coordinates may share a cell number by rounding; cells are only where to look. */
static size_t slot_of(const lattice *l, const double at[3], const int step[3])
{
    static const uint64_t primes[3] = {0x9e3779b97f4a7c15u, 0xc2b2ae3d27d4eb4fu,
                                       0x165667b19e3779f9u};
    uint64_t hash = 0;
    for (int k = 0; k < 3; k++) {
        const double cell = fmax(-0x1p60, fmin(0x1p60, floor(at[k] / l->cell)));
        hash = (hash ^ (uint64_t)((int64_t)cell + step[k])) * primes[k];
    }
    return (size_t)(hash ^ hash >> 32) & (l->slots - 1);
}

static bool fill_lattice(lattice *l)
{
    static const int here[3] = {0, 0, 0};
    const size_t count = l->photons->count;
    l->slots = 1;
    while (l->slots < count) {
        l->slots *= 2;
    }
    l->first = calloc(l->slots + 1, sizeof *l->first);
    l->order = malloc((count + 1) * sizeof *l->order);
    if (l->first == NULL || l->order == NULL || count > UINT32_MAX) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        l->first[slot_of(l, l->photons->at[i].at, here)]++;
    }
    size_t sum = 0;
    for (size_t s = 0; s <= l->slots; s++) {
        sum += l->first[s];
        l->first[s] = sum;
    }
    for (size_t i = count; i-- > 0;) {
        l->order[--l->first[slot_of(l, l->photons->at[i].at, here)]] = (uint32_t)i;
    }
    return true;
}

static bool farther(const neighbour *a, const neighbour *b)
{
    return a->square > b->square || (a->square == b->square && a->photon > b->photon);
}

static void sink(nearest *n, neighbour item)
{
    uint32_t at = 0;
    for (;;) {
        uint32_t child = 2 * at + 1;
        if (child >= n->count) {
            break;
        }
        if (child + 1 < n->count && farther(&n->heap[child + 1], &n->heap[child])) {
            child++;
        }
        if (!farther(&n->heap[child], &item)) {
            break;
        }
        n->heap[at] = n->heap[child];
        at = child;
    }
    n->heap[at] = item;
}

static void keep(nearest *n, neighbour item)
{
    if (n->count == n->capacity) {
        if (farther(&n->heap[0], &item)) {
            sink(n, item);
        }
        return;
    }
    uint32_t at = n->count++;
    while (at > 0 && farther(&item, &n->heap[(at - 1) / 2])) {
        n->heap[at] = n->heap[(at - 1) / 2];
        at = (at - 1) / 2;
    }
    n->heap[at] = item;
}

static void search_slot(const estimate *e, const struct receiver *receiver, size_t slot, nearest *n)
{
    const lattice *l = &e->lattice;
    for (size_t i = l->first[slot]; i < l->first[slot + 1]; i++) {
        const struct photon *photon = &l->photons->at[l->order[i]];
        double apart[3];
        vector_subtract(apart, photon->at, receiver->at);
        const double square = vector_dot(apart, apart);
        if (square < e->radius * e->radius && vector_dot(photon->dir, receiver->normal) < 0.0) {
            keep(n, (neighbour){square, l->order[i]});
        }
    }
}

/* Two cells may share a slot: each slot is searched once. */
static void search(const estimate *e, const struct receiver *receiver, nearest *n)
{
    size_t seen[27];
    int seen_count = 0;
    n->count = 0;
    for (int i = 0; i < 27; i++) {
        const int step[3] = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
        const size_t slot = slot_of(&e->lattice, receiver->at, step);
        int k = 0;
        while (k < seen_count && seen[k] != slot) {
            k++;
        }
        if (k == seen_count) {
            seen[seen_count++] = slot;
            search_slot(e, receiver, slot, n);
        }
    }
}

static double density(const estimate *e, const nearest *n)
{
    const bool full = n->count == e->nearest;
    const double square = full ? n->heap[0].square : e->radius * e->radius;
    double power = 0.0;
    for (uint32_t i = full ? 1 : 0; i < n->count; i++) {
        const struct photon *photon = &e->lattice.photons->at[n->heap[i].photon];
        power += photon_power(e->run, photon->light);
    }
    return power / (acos(-1.0) * square);
}

static void work(void *user, unsigned thread)
{
    (void)thread;
    estimate *e = user;
    nearest n = {.heap = malloc(e->nearest * sizeof(neighbour)), .capacity = e->nearest};
    if (n.heap == NULL) {
        atomic_store(&e->failed, true);
        return;
    }
    size_t i;
    while ((i = atomic_fetch_add(&e->next, 1)) < e->receivers.count) {
        search(e, &e->receivers.at[i], &n);
        e->irradiance[i] = density(e, &n);
    }
    free(n.heap);
}

bool irradiance_nearest(const struct photons *photons, const struct photon_run *run,
                        struct receivers receivers, double radius, uint32_t nearest,
                        double *irradiance)
{
    estimate e = {.lattice = {.photons = photons, .cell = radius},
                  .run = run,
                  .receivers = receivers,
                  .radius = radius,
                  .nearest = nearest,
                  .irradiance = irradiance};
    bool fine = fill_lattice(&e.lattice);
    if (fine) {
        threads_run(run->threads, work, &e);
        fine = !atomic_load(&e.failed);
    }
    free(e.lattice.first);
    free(e.lattice.order);
    return fine;
}
