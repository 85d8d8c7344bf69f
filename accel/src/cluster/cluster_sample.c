/* SPDX-License-Identifier: Apache-2.0
 *
 * A look at a scene before it is clustered: a sample of its primitives, scattered so that no order
 * in the list matters, tells how many primitives of a class share a cell of each octave, from how
 * many of the sample do: m of n primitives give about m * m / n pairs for each other primitive in a
 * cell, hundreds where that matters, enough to choose between octaves.
 *
 * A primitive whose cell is about its own size and holds hardly any other touches few; where that
 * is so for most, primitives are loose: clouds of spheres, soups, many scenes of a host's objects.
 * In a mesh a cell of a triangle's size holds a handful of others.
 */
#include "cluster_parts.h"
#include "../core/order.h"

/* One of so many primitives goes into the sample, within bounds. */
enum { SHARE = 64, SMALLEST = 512, LARGEST = 65536 };

/* Primitives that share a cell with another, on average, at most: where they are loose, and where
 * they touch, as parts are then split (cluster_bins.c). Few primitives are told apart well: there
 * it is at most one for each so many of the scene. */
enum { LOOSE_OTHERS = 160, LOOSE_PER_OTHER = 64, OTHERS = 320, PER_OTHER = 128 };

/* Where there are MANY, no more than this share may have a cell to themselves. */
enum { MANY = 4096 };
#define ISOLATED 0.25

/* Other primitives in a cell of its size, below which a primitive is likely to touch few. */
#define THIN 1.5

static struct memory *memory_of(const struct parts *p)
{
    return &p->build->a->memory;
}

static size_t sample_size(size_t total)
{
    const size_t share = total / SHARE;
    const size_t size = share < SMALLEST ? SMALLEST : share < LARGEST ? share : LARGEST;
    return size < total ? size : total;
}

/* The middles of the sample by size class and then along the curve, each with the octave of its
 * size. Positions follow the golden ratio, so that no order in the list matters. */
static bool scatter(const struct parts *p, struct keyed *at, size_t count)
{
    const uint64_t total = p->build->a->prims.bounded.count;
    for (size_t i = 0; i < count; i++) {
        const uint32_t share = (uint32_t)i * 2654435769u;
        const accel_box *box = parts_box(p, (share * total) >> 32);
        const accel_box unit = frame_box(&p->sizes.frame, box);
        const uint32_t octave = sizes_octave(&p->sizes, box);
        const uint64_t class = p->sizes.class_of[octave];
        at[i] = (struct keyed){class << 3 * CELLS_OCTAVES | accel_order_morton(&unit), octave};
    }
    return accel_order_by_key(memory_of(p), at, count) || accel_build_no_memory(p->build);
}

/* Who shares the cells of one octave. */
struct occupancy {
    double all;     /* others in the sample in the same cell, summed over the sample */
    double own;     /* the same over those of this size */
    size_t of_size; /* how many these are */
    size_t alone;   /* how many have none */
};

static struct occupancy occupancy_in(const struct keyed *at, size_t count, uint32_t octave)
{
    const uint32_t shift = 3 * (CELLS_OCTAVES - octave);
    struct occupancy c = {.all = 0.0};
    for (size_t first = 0, end; first < count; first = end) {
        size_t of_size = 0;
        for (end = first; end < count && (at[end].key ^ at[first].key) >> shift == 0; end++)
            of_size += at[end].value == octave;
        const double others = (double)(end - first - 1);
        c.all += others * (double)(end - first);
        c.alone += end - first == 1;
        c.own += others * (double)of_size;
        c.of_size += of_size;
    }
    return c;
}

/* The share of a class's primitives that have a cell of an octave to themselves. If the cells that
 * are not nearly empty were alike, exp(-others in the sample) of it would be alone in them. */
static double isolated(const struct occupancy *c, size_t count)
{
    const double chance = exp(-c->all / (double)count);
    return fmax((double)c->alone / (double)count - chance, 0.0);
}

/* Judges a class by its part of the sample, `scale` times as many in the scene: finds the coarsest
 * octave whose cells are as empty as wanted, or the finest where few are isolated. Returns how many
 * of the sample are loose. */
static size_t assess_class(const struct keyed *at, size_t count, double scale, uint32_t *octave)
{
    struct occupancy occupancy[CELLS_OCTAVES];
    size_t thin = 0, smaller = count, alone = 0;
    uint32_t octaves = 0;
    for (; octaves < CELLS_OCTAVES && alone < count; octaves++) {
        const struct occupancy c = occupancy_in(at, count, octaves);
        occupancy[octaves] = c;
        if (c.own * scale < THIN * (double)c.of_size)
            thin += c.of_size;
        smaller -= c.of_size;
        alone = c.alone;
    }
    thin += smaller; /* where all are alone, they are in smaller cells too */
    const double total = scale * (double)count;
    const double most = 2 * thin > count ? fmin(LOOSE_OTHERS, total / LOOSE_PER_OTHER)
                                         : fmin(OTHERS, total / PER_OTHER);
    uint32_t o = 0;
    while (o < octaves - 1 && occupancy[o].all * scale > most * (double)count)
        o++;
    while (o > 0 && total > MANY && isolated(&occupancy[o], count) > ISOLATED)
        o--;
    *octave = o;
    return thin;
}

static void assess(const struct parts *p, const struct keyed *at, size_t count,
                   struct parts_sample *sample)
{
    const double scale = (double)p->build->a->prims.bounded.count / (double)count;
    size_t thin = 0, first = 0;
    for (uint32_t class = 0; class < p->sizes.classes; class ++) {
        size_t end = first;
        while (end < count && at[end].key >> 3 * CELLS_OCTAVES == class)
            end++;
        sample->octave[class] = CELLS_OCTAVES - 1;
        if (end > first)
            thin += assess_class(at + first, end - first, scale, &sample->octave[class]);
        first = end;
    }
    sample->loose = 2 * thin > count;
}

bool accel_parts_sample(const struct parts *p, struct parts_sample *sample)
{
    const size_t count = sample_size(p->build->a->prims.bounded.count);
    struct keyed *at = accel_memory_resize(memory_of(p), NULL, 0, count * sizeof *at);
    if (!at)
        return accel_build_no_memory(p->build);
    const bool fine = scatter(p, at, count);
    if (fine)
        assess(p, at, count, sample);
    accel_memory_resize(memory_of(p), at, count * sizeof *at, 0);
    return fine;
}
