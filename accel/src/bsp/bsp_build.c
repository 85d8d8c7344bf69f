/* SPDX-License-Identifier: Apache-2.0
 *
 * Building a kd-tree: top-down, depth first.
 *
 * Plane: the one of lowest surface-area cost among the sides of the boxes in the cell, as in Wald
 * and Havran, "On building fast kd-Trees for Ray Tracing, and on doing that in O(N log N)", 2006;
 * in a large cell among planes at equal distances and the two that cut off what is empty, as in
 * Hunt, Mark and Stoll, "Fast kd-tree Construction with an Adaptive Error-Bounded Heuristic", 2006.
 * A plane stands one double outside the side that it belongs to: cells are closed, so on the side
 * it would list that box in both halves. Boxes are not clipped to triangles: the invariant wants
 * every cell that P' meets.
 *
 * End of growth: after Havran, a number of splits in a row that may fail to lower the cost; and a
 * budget of references, which a cell hands down in proportion, so that it bounds the whole tree. A
 * depth that grows with log n, as Havran has it, saved no time beside these and cut off small
 * things in large scenes; only the walk's stack bounds it. Where the leaf size is left to the
 * builder, every subtree that a leaf would beat by predicted cost is then collapsed, bottom-up.
 */
#include "bsp.h"
#include "../core/frame.h"

#include <string.h>

/* A split that cuts off empty space is preferred by this share of its cost. */
#define EMPTY_BONUS 0.2

/* References that a tree may have, in multiples of its primitives; splits in a row that may fail to
 * lower the cost; the largest cell whose boxes are sorted; planes tried per axis in larger ones. */
enum { BUDGET = 8, LOOKAHEAD = 3, SWEEP = 24, BINS = 64 };

/* What is the same for all cells. */
struct grower {
    struct build *build;
    struct bsp *bsp;
    const accel_box *boxes;   /* padded, by id */
    struct bsp_rule rule;     /* with the depth filled in */
    double scale;             /* power of two that takes the scene's extent to about 1 */
    struct ids stack;         /* the ids of the cells on the way down */
    double done;              /* volume finished, as a share of the root */
    uint32_t cut_short;       /* cells that the budget did not let split */
    uint32_t starts[3][BINS]; /* lower sides by bin and axis, of the cell at hand */
    uint32_t ends[3][BINS];   /* upper sides */
    double lower[SWEEP];      /* lower sides in order, of the cell at hand */
    double upper[SWEEP];      /* upper sides */
};

/* One cell to grow. */
struct task {
    accel_box box;   /* the cell */
    size_t begin;    /* its ids in grower.stack */
    uint32_t count;  /* of them, more than 0 */
    uint32_t depth;  /* of the cell */
    uint32_t failed; /* splits in a row that did not lower the cost */
    double budget;   /* references that it may become */
};

/* A plane, and the tests that it leaves to expect if the split is the last. */
struct split {
    double plane;
    double tests;
    int axis; /* -1: there is none */
};

/* A finished subtree. */
struct subtree {
    double cost;     /* predicted, given that the cell is met */
    uint32_t height; /* levels below */
};

static const accel_box *box_of(const struct grower *g, const struct task *t, uint32_t i)
{
    return &g->boxes[g->stack.at[t->begin + i]];
}

/* ------------------------------------------------------------------- planes ---- */

/* What the cost of a plane across one axis needs of the cell. */
struct slices {
    double lo, hi;    /* the cell on this axis */
    double base, per; /* chance of a slice: base + per * length */
    int axis;
};

static struct slices slices_of(const struct grower *g, const accel_box *cell, int axis)
{
    double side[3];
    for (int k = 0; k < 3; k++)
        side[k] = g->scale * (cell->hi[k] - cell->lo[k]);
    const double a = side[(axis + 1) % 3], b = side[(axis + 2) % 3];
    const double inverse = 1.0 / (a * b + (a + b) * side[axis]);
    return (struct slices){cell->lo[axis], cell->hi[axis], a * b * inverse,
                           g->scale * (a + b) * inverse, axis};
}

/* The chance that a ray through the cell meets the slice of this length. 1 where surfaces do not
 * tell. */
static double chance(const struct slices *s, double length)
{
    const double ratio = s->base + s->per * length;
    return ratio >= 0.0 && ratio <= 1.0 ? ratio : 1.0;
}

/* Offers a plane with so many boxes that meet each half. */
static void offer(const struct slices *s, double plane, uint32_t below, uint32_t above,
                  struct split *best)
{
    if (!(s->lo < plane && plane < s->hi))
        return;
    double tests = chance(s, plane - s->lo) * below + chance(s, s->hi - plane) * above;
    if (below == 0 || above == 0)
        tests *= 1.0 - EMPTY_BONUS;
    if (tests < best->tests)
        *best = (struct split){plane, tests, s->axis};
}

static uint32_t bin_of(const struct slices *s, double x)
{
    const double place = (x - s->lo) / (s->hi - s->lo) * BINS;
    return place >= BINS ? BINS - 1 : place > 0.0 ? (uint32_t)place : 0;
}

/* Counts the sides of all boxes by bin; the sides of their union go into *all. */
static void fill_bins(struct grower *g, const struct task *t, const struct slices s[3],
                      accel_box *all)
{
    memset(g->starts, 0, sizeof g->starts);
    memset(g->ends, 0, sizeof g->ends);
    *all = box_empty();
    for (uint32_t i = 0; i < t->count; i++) {
        const accel_box *b = box_of(g, t, i);
        box_add(all, b);
        for (int k = 0; k < 3; k++) {
            g->starts[k][bin_of(&s[k], b->lo[k])]++;
            g->ends[k][bin_of(&s[k], b->hi[k])]++;
        }
    }
}

/* Offers planes at equal distances, and those next to the union of all boxes. */
static void find_binned(struct grower *g, const struct task *t, struct split *best)
{
    const struct slices s[3] = {slices_of(g, &t->box, 0), slices_of(g, &t->box, 1),
                                slices_of(g, &t->box, 2)};
    accel_box all;
    fill_bins(g, t, s, &all);
    for (int k = 0; k < 3; k++) {
        uint32_t below = 0, above = t->count;
        offer(&s[k], all.lo[k], 0, t->count, best);
        offer(&s[k], all.hi[k], t->count, 0, best);
        for (uint32_t b = 1; b < BINS; b++) {
            below += g->starts[k][b - 1];
            above -= g->ends[k][b - 1];
            offer(&s[k], s[k].lo + (s[k].hi - s[k].lo) * b / BINS, below, above, best);
        }
    }
}

static void sort(double *x, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++) {
        const double moved = x[i];
        uint32_t at = i;
        for (; at > 0 && moved < x[at - 1]; at--)
            x[at] = x[at - 1];
        x[at] = moved;
    }
}

/* Offers the planes next to every side of a box: below a lower side lies no box that begins there,
 * above an upper side none that ends there. */
static void sweep(struct grower *g, const struct task *t, int axis, struct split *best)
{
    const struct slices s = slices_of(g, &t->box, axis);
    const uint32_t n = t->count;
    for (uint32_t i = 0; i < n; i++) {
        g->lower[i] = box_of(g, t, i)->lo[axis];
        g->upper[i] = box_of(g, t, i)->hi[axis];
    }
    sort(g->lower, n);
    sort(g->upper, n);
    for (uint32_t i = 0, ended = 0; i < n; i++) {
        while (ended < n && g->upper[ended] < g->lower[i])
            ended++;
        if (i == 0 || g->lower[i - 1] < g->lower[i])
            offer(&s, g->lower[i], i, n - ended, best);
    }
    for (uint32_t i = 0, begun = 0; i < n; i++) {
        while (begun < n && g->lower[begun] <= g->upper[i])
            begun++;
        if (i + 1 == n || g->upper[i] < g->upper[i + 1])
            offer(&s, g->upper[i], begun, n - i - 1, best);
    }
}

/* Moves a plane that stands on the side of a box just off it, into the half without the box. */
static void step_off(const struct grower *g, const struct task *t, struct split *s)
{
    const int k = s->axis;
    const double inf = (double)INFINITY;
    bool on_lower = false, on_upper = false;
    for (uint32_t i = 0; i < t->count; i++) {
        const accel_box *b = box_of(g, t, i);
        on_lower = on_lower || b->lo[k] == s->plane;
        on_upper = on_upper || b->hi[k] == s->plane;
    }
    double off = s->plane;
    if (on_lower && !on_upper)
        off = nextafter(s->plane, -inf);
    else if (on_upper)
        off = nextafter(s->plane, inf);
    if (t->box.lo[k] < off && off < t->box.hi[k])
        s->plane = off;
}

/* ------------------------------------------------------------------ growing ---- */

static double leaf_cost(const struct grower *g, uint32_t count)
{
    return g->build->a->prims.test_cost * count;
}

/* Is the cell a leaf before any split is tried? Where cost decides, a node alone may cost more. */
static bool small_enough(const struct grower *g, const struct task *t)
{
    return t->depth >= g->rule.depth ||
           (isnan(g->rule.leaf) ? leaf_cost(g, t->count) <= COST_NODE : t->count <= g->rule.leaf);
}

/* Finds a split. False if there is none that may be made. */
static bool find_split(struct grower *g, struct task *t, struct split *s)
{
    *s = (struct split){0.0, (double)INFINITY, -1};
    if (t->count > SWEEP)
        find_binned(g, t, s);
    else
        for (int k = 0; k < 3; k++)
            sweep(g, t, k, s);
    if (s->axis < 0)
        return false;
    step_off(g, t, s);
    const double cost = COST_NODE + g->build->a->prims.test_cost * s->tests;
    t->failed = cost < leaf_cost(g, t->count) ? 0 : t->failed + 1;
    return t->failed <= LOOKAHEAD;
}

static bool meets_half(const accel_box *b, const struct split *s, int half)
{
    return half ? b->hi[s->axis] >= s->plane : b->lo[s->axis] <= s->plane;
}

static uint32_t count_half(const struct grower *g, const struct task *t, const struct split *s,
                           int half)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < t->count; i++)
        count += meets_half(box_of(g, t, i), s, half);
    return count;
}

/* Puts the ids of one half on the stack. */
static bool push_half(struct grower *g, const struct task *t, const struct split *s, int half,
                      uint32_t count)
{
    size_t at = g->stack.count;
    if (!array_extend(&g->build->a->memory, &g->stack, count))
        return accel_build_no_memory(g->build);
    for (uint32_t i = 0; i < t->count; i++)
        if (meets_half(box_of(g, t, i), s, half))
            g->stack.at[at++] = g->stack.at[t->begin + i];
    return true;
}

static double volume_share(uint32_t depth)
{
    return ldexp(1.0, -(int)depth);
}

/* Reports progress after a look at some boxes. */
static bool tick(struct grower *g, uint32_t looked_at)
{
    return build_step(g->build, looked_at, fmin(g->done, 1.0));
}

static bool finish(struct grower *g, uint32_t depth)
{
    g->done += volume_share(depth);
    return tick(g, SWEEP);
}

static bool make_leaf(struct grower *g, const struct task *t, uint32_t node, struct subtree *out)
{
    struct bsp *b = g->bsp;
    const size_t first = b->refs.count;
    if (first + t->count > ACCEL_NONE) {
        accel_error_set(g->build->error, ACCEL_TOO_LARGE,
                        "build bsp: more than 4294967295 references; nothing was built, allow more "
                        "primitives per leaf or less depth");
        return false;
    }
    if (!array_extend(&b->base.memory, &b->refs, t->count))
        return accel_build_no_memory(g->build);
    memcpy(b->refs.at + first, g->stack.at + t->begin, t->count * sizeof(uint32_t));
    b->nodes.at[node] =
        (struct bsp_node){.count = t->count, .first = (uint32_t)first, .bits = BSP_LEAF};
    *out = (struct subtree){leaf_cost(g, t->count), 0};
    return finish(g, t->depth);
}

static bool grow(struct grower *g, struct task *t, struct subtree *out);

/* Grows one half of a cell, if it holds anything. */
static bool grow_half(struct grower *g, const struct task *t, const struct split *s, int half,
                      const uint32_t count[2], struct subtree *out)
{
    *out = (struct subtree){0.0, 0};
    if (count[half] == 0)
        return finish(g, t->depth + 1);
    const size_t begin = g->stack.count;
    struct task child = {t->box,      begin,
                         count[half], t->depth + 1,
                         t->failed,   t->budget * count[half] / ((double)count[0] + count[1])};
    *(half ? &child.box.lo[s->axis] : &child.box.hi[s->axis]) = s->plane;
    if (!push_half(g, t, s, half, count[half]) || !tick(g, t->count) || !grow(g, &child, out))
        return false;
    g->stack.count = begin;
    const struct slices slices = slices_of(g, &t->box, s->axis);
    out->cost *= chance(&slices, child.box.hi[s->axis] - child.box.lo[s->axis]);
    return true;
}

/* Makes the cell an inner node. */
static bool make_node(struct grower *g, const struct task *t, const struct split *s,
                      const uint32_t count[2], uint32_t node, struct subtree *out)
{
    struct subtree half[2];
    if (!grow_half(g, t, s, 0, count, &half[0]))
        return false;
    const uint32_t above = (uint32_t)g->bsp->nodes.count;
    if (!grow_half(g, t, s, 1, count, &half[1]))
        return false;
    g->bsp->nodes.at[node] =
        (struct bsp_node){.plane = s->plane,
                          .first = above,
                          .bits = (uint32_t)s->axis | (count[0] ? 0 : BSP_LOWER_EMPTY) |
                                  (count[1] ? 0 : BSP_UPPER_EMPTY)};
    const uint32_t height = half[0].height > half[1].height ? half[0].height : half[1].height;
    *out = (struct subtree){COST_NODE + half[0].cost + half[1].cost, height + 1};
    return true;
}

/* Does the budget allow the split? */
static bool affords(struct grower *g, const struct task *t, const uint32_t count[2])
{
    const bool fine = (double)count[0] + count[1] <= t->budget;
    g->cut_short += !fine;
    return fine;
}

/* Grows one cell. */
static bool grow(struct grower *g, struct task *t, struct subtree *out)
{
    struct bsp *b = g->bsp;
    struct split s;
    const size_t node = b->nodes.count, refs = b->refs.count;
    const double done = g->done;
    if (node >= ACCEL_NONE) {
        accel_error_set(
            g->build->error, ACCEL_TOO_LARGE,
            "build bsp: more than 4294967295 nodes; nothing was built, allow more primitives "
            "per leaf");
        return false;
    }
    if (!array_extend(&b->base.memory, &b->nodes, 1))
        return accel_build_no_memory(g->build);
    if (small_enough(g, t) || !find_split(g, t, &s))
        return make_leaf(g, t, (uint32_t)node, out);
    const uint32_t count[2] = {count_half(g, t, &s, 0), count_half(g, t, &s, 1)};
    if (!affords(g, t, count))
        return make_leaf(g, t, (uint32_t)node, out);
    if (!make_node(g, t, &s, count, (uint32_t)node, out))
        return false;
    if (!isnan(g->rule.leaf) || out->cost < leaf_cost(g, t->count))
        return true;
    b->nodes.count = node + 1;
    b->refs.count = refs;
    g->done = done;
    return make_leaf(g, t, (uint32_t)node, out);
}

static bool prepare(struct grower *g, struct task *root)
{
    const struct primitives *p = &g->build->a->prims;
    const accel_box all = p->bounds;
    g->boxes = p->box;
    g->scale = frame_of(&all).scale;
    g->bsp->box = all;
    if (isnan(g->rule.depth))
        g->rule.depth = BSP_MAX_DEPTH;
    *root = (struct task){.box = all,
                          .count = (uint32_t)p->bounded.count,
                          .budget = BUDGET * (double)p->bounded.count};
    if (!array_extend(&g->build->a->memory, &g->stack, p->bounded.count))
        return accel_build_no_memory(g->build);
    memcpy(g->stack.at, p->bounded.at, p->bounded.count * sizeof(uint32_t));
    return true;
}

/* Inner nodes and leaves by kind. */
static void describe(const struct grower *g, const struct subtree *root)
{
    accel_info *info = &g->build->a->info;
    const struct bsp *b = g->bsp;
    for (size_t i = 0; i < b->nodes.count; i++)
        info->leaves += b->nodes.at[i].bits == BSP_LEAF;
    info->nodes = b->nodes.count - info->leaves;
    info->references = b->refs.count;
    info->depth = root->height;
    const size_t empty = (size_t)(info->nodes + 1 - info->leaves);
    const size_t made = b->nodes.count * sizeof *b->nodes.at + b->refs.count * sizeof *b->refs.at;
    if (empty > 0)
        accel_build_left_out(g->build, empty * sizeof *b->nodes.at, made,
                             "%zu of %zu cells are empty: not stored", empty,
                             (size_t)info->nodes + 1);
    if (info->nodes == 0)
        accel_build_left_out(g->build, 2 * sizeof *b->nodes.at, made,
                             "few primitives: a list, no tree");
    if (g->cut_short > 0)
        accel_build_note(g->build, "bsp: the budget of %d references per primitive ended %u splits",
                         BUDGET, g->cut_short);
}

bool accel_bsp_build(struct build *build, struct bsp *bsp, struct bsp_rule rule)
{
    struct grower g = {.build = build, .bsp = bsp, .rule = rule};
    struct task task;
    struct subtree root;
    const bool fine = prepare(&g, &task) && grow(&g, &task, &root);
    array_free(&build->a->memory, &g.stack);
    if (fine)
        describe(&g, &root);
    return fine;
}
