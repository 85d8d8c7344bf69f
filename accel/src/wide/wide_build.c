/* SPDX-License-Identifier: Apache-2.0
 *
 * The life of a wide tree: see wide.h.
 */
#include "wide_isa.h"
#include "wide_split.h"

#include "../core/box.h"

/* Coordinates up to here leave all edge functions finite: see wide_leaf.h. */
#define FAST_COORDINATE 0x1p300

static double largest_of(const accel_box *bounds)
{
    double largest = 0.0;
    for (int k = 0; k < 3; k++)
        largest = fmax(largest, fmax(fabs(bounds->lo[k]), fabs(bounds->hi[k])));
    return largest;
}

static float down(double x)
{
    const float f = (float)x;
    return (double)f <= x ? f : nextafterf(f, -(float)INFINITY);
}

static float up(double x)
{
    const float f = (float)x;
    return (double)f >= x ? f : nextafterf(f, (float)INFINITY);
}

struct wide_item accel_wide_item_of(const struct wide *w, const accel_box *box, uint32_t id)
{
    struct wide_item item = {.id = id};
    for (int k = 0; k < 3; k++) {
        item.lo[k] = down(box->lo[k] * w->scale);
        item.hi[k] = up(box->hi[k] * w->scale);
    }
    return item;
}

static bool allocate(struct build *build, struct wide_binary_tree *tree)
{
    struct memory *m = &build->a->memory;
    const size_t n = tree->count;
    tree->items = accel_memory_resize(m, NULL, 0, n * sizeof *tree->items);
    tree->nodes =
        tree->items ? accel_memory_resize(m, NULL, 0, (2 * n - 1) * sizeof *tree->nodes) : NULL;
    return tree->nodes || accel_build_no_memory(build);
}

static void release(struct build *build, struct wide_binary_tree *tree)
{
    struct memory *m = &build->a->memory;
    const size_t n = tree->count;
    if (tree->items)
        accel_memory_resize(m, tree->items, n * sizeof *tree->items, 0);
    if (tree->nodes)
        accel_memory_resize(m, tree->nodes, (2 * n - 1) * sizeof *tree->nodes, 0);
}

/* How many items there will be. */
static uint32_t count_items(const struct wide_split *s)
{
    const struct ids *ids = &s->prims->bounded;
    uint32_t sum = 0;
    for (size_t i = 0; i < ids->count; i++)
        sum += wide_split_pieces(s, ids->at[i]);
    return sum;
}

bool accel_wide_build(struct build *build, struct wide *w, const struct wide_isa *isa,
                      enum wide_cut cut, const struct clustering *clusters)
{
    const struct primitives *p = &build->a->prims;
    struct wide_split split;
    struct wide_binary_tree tree = {.clusters = clusters, .split = &split};
    const double largest = largest_of(&p->bounds);
    w->isa = isa;
    w->scale = wide_scale(largest);
    w->fast = largest <= FAST_COORDINATE;
    accel_build_phase(build, "tree");
    bool fine = accel_wide_split(build, w, &split);
    tree.count = fine ? count_items(&split) : 0;
    fine = fine && allocate(build, &tree) && accel_wide_grow(build, w, isa->rule, cut, &tree);
    accel_wide_split_free(build, &split);
    if (fine) {
        if (accel_wide_holds_all(w, p))
            w->boxes = accel_primitives_leave_boxes(&build->a->memory, &build->a->prims);
        accel_build_phase(build, "layout");
        fine = accel_wide_emit(build, w, isa->rule, &tree);
    }
    release(build, &tree);
    return fine;
}

void accel_wide_free(struct memory *m, struct wide *w)
{
    if (w->memory)
        accel_memory_resize(m, w->memory, w->bytes, 0);
    w->memory = NULL;
}
