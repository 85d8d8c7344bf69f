/* SPDX-License-Identifier: Apache-2.0
 *
 * How many cells a grid gets, by the predicted cost of a line through its box.
 *
 * The surface-area heuristic (MacDonald and Booth, 1990), applied to grids: a line crosses the
 * planes of an axis in proportion to the area of the box's face, and tests an item if it meets the
 * block of cells that list it, in proportion to the block's surface; that an item is met in
 * several cells costs a look in the mailbox. Large sets are judged by a sample. Cost: a few
 * operations per item of the sample and density tried, of which there are log2(128 n).
 */
#include "grid.h"

/* In visits of a node: beginning a walk, a step from cell to cell, a reference found in the
 * mailbox, an item that is a grid. Measured against the octree's walk. */
#define BEGIN_COST   3.0
#define STEP_COST    0.4
#define MAILBOX_COST 0.1
#define GRID_COST    6.0

/* Densities that are tried: from one cell in all to this many cells per item, by factors of 2. */
#define MAX_DENSITY 128.0

/* Items that are looked at for each density tried. */
enum { SAMPLE = 8192 };

/* Cells along an axis, so that stepping through empty ones stays cheap beside any test. */
enum { MAX_CELLS = 8192 };

/* Bricks that a grid over `count` items may have, at 12 bytes each. The constants here and below
 * let a few large items have some cells. */
static double brick_budget(size_t count)
{
    return 2.0 * (double)count + 64.0;
}

double grid_reference_budget(size_t count)
{
    return 10.0 * (double)count + 256.0;
}

/* What is the same for all densities tried. */
struct planner {
    const struct primitives *p;
    const struct grid_pool *pool;
    const accel_box *box;
    struct grid_items items;
    double side[3]; /* the box's extents, the longest being 1 */
};

/* What a resolution makes of the items. */
struct outcome {
    double references; /* in all */
    double tests;      /* expected of a line through the box, in units of cost */
};

/* Far below any cell: an axis that is thinner than this share of the longest is one cell. */
#define FLAT 0x1p-20

static void measure_box(struct planner *s)
{
    double longest = 0.0;
    for (int k = 0; k < 3; k++)
        longest = fmax(longest, s->box->hi[k] - s->box->lo[k]);
    for (int k = 0; k < 3; k++) {
        const double extent = s->box->hi[k] - s->box->lo[k];
        s->side[k] = extent > FLAT * longest ? extent / longest : FLAT;
    }
}

/* The side of a cube of which `cells` fill the axes that are not thin. */
static double cube_side(const double side[3], const bool thin[3], double cells)
{
    double logs = -log2(cells), thick = 0.0;
    for (int k = 0; k < 3; k++) {
        logs += thin[k] ? 0.0 : log2(side[k]);
        thick += thin[k] ? 0.0 : 1.0;
    }
    return exp2(logs / fmax(thick, 1.0));
}

/* Divides a box into about `cells` cubes: an axis thinner than a cube is one cell. */
static void divide(const double side[3], double cells, uint32_t out[3])
{
    bool thin[3];
    for (int k = 0; k < 3; k++)
        thin[k] = side[k] <= FLAT;
    double cube = cube_side(side, thin, cells);
    for (int pass = 0; pass < 2; pass++) {
        int thinnest = 0;
        for (int k = 1; k < 3; k++)
            if (thin[thinnest] || (!thin[k] && side[k] < side[thinnest]))
                thinnest = k;
        if (thin[thinnest] || side[thinnest] >= cube)
            break;
        thin[thinnest] = true;
        cube = cube_side(side, thin, cells);
    }
    for (int k = 0; k < 3; k++) {
        const double n = thin[k] ? 1.0 : floor(side[k] / cube + 0.5);
        out[k] = n < 1.0 ? 1 : n < MAX_CELLS ? (uint32_t)n : MAX_CELLS;
    }
}

/* The cells of axis k from the one that holds lo to the one that holds hi, both inclusive. */
static double span(const struct planner *s, int k, double scale, uint32_t cells, double lo,
                   double hi)
{
    const double last = cells - 1;
    double first = floor((lo - s->box->lo[k]) * scale), end = floor((hi - s->box->lo[k]) * scale);
    first = !(first > 0.0) ? 0.0 : first < last ? first : last;
    end = !(end < last) ? last : end > 0.0 ? end : 0.0;
    return end - first + 1.0;
}

static double surface(const double side[3])
{
    return side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
}

/* Looks at every `stride`-th item. */
static struct outcome look(const struct planner *s, const uint32_t cells[3], size_t stride)
{
    struct outcome sum = {0.0, 0.0};
    double scale[3], side[3], looked = 0.0;
    for (int k = 0; k < 3; k++)
        scale[k] = cells[k] / (s->box->hi[k] - s->box->lo[k]);
    const double whole = surface(s->side);
    for (size_t i = 0; i < s->items.count; i += stride, looked++) {
        const uint32_t ref = s->items.at[i];
        const accel_box *b = grid_item_box(s->p, s->pool, ref);
        double block = 1.0;
        for (int k = 0; k < 3; k++) {
            const double cut =
                cells[k] > 1 ? span(s, k, scale[k], cells[k], b->lo[k], b->hi[k]) : 1;
            side[k] = s->side[k] * cut / cells[k];
            block *= cut;
        }
        sum.references += block;
        sum.tests += surface(side) / whole * (ref < s->p->count ? s->p->test_cost : GRID_COST);
    }
    const double share = (double)s->items.count / looked;
    return (struct outcome){sum.references * share, sum.tests * share};
}

static double predicted_cost(const struct planner *s, const uint32_t cells[3], struct outcome o)
{
    const double whole = surface(s->side);
    double steps = 1.0, cell[3];
    for (int k = 0; k < 3; k++) {
        steps += (cells[k] - 1) * s->side[(k + 1) % 3] * s->side[(k + 2) % 3] / whole;
        cell[k] = s->side[k] / cells[k];
    }
    return BEGIN_COST + STEP_COST * steps + o.tests +
           MAILBOX_COST * o.references * surface(cell) / whole;
}

bool grid_plan_fits(const struct grid_plan *plan, size_t count)
{
    double bricks = 1.0;
    for (int k = 0; k < 3; k++)
        bricks *= (plan->cells[k] + GRID_BRICK - 1) / GRID_BRICK;
    return bricks <= brick_budget(count);
}

/* The plan for one density. Its cost is infinite if it is over a budget. */
static struct grid_plan plan_density(const struct planner *s, double density, size_t stride)
{
    const size_t count = s->items.count;
    struct grid_plan plan = {.density = density, .cost = (double)INFINITY};
    divide(s->side, fmax(1.0, density * (double)count), plan.cells);
    if (!grid_plan_fits(&plan, count))
        return plan;
    const struct outcome o = look(s, plan.cells, stride);
    if (o.references <= grid_reference_budget(count))
        plan.cost = predicted_cost(s, plan.cells, o);
    return plan;
}

static struct grid_plan cheapest(const struct planner *s, size_t stride)
{
    const double count = (double)s->items.count;
    struct grid_plan best = {.density = 0.0, .cost = (double)INFINITY};
    for (double density = MAX_DENSITY; density * count > 0.5; density *= 0.5) {
        const struct grid_plan plan = plan_density(s, density, stride);
        if (!(plan.cost > best.cost))
            best = plan;
    }
    return best;
}

void grid_coarsen(struct grid_plan *plan)
{
    const double share = 0.79; /* of an axis: half the cells */
    for (int k = 0; k < 3; k++) {
        const uint32_t fewer = (uint32_t)(share * plan->cells[k]);
        plan->cells[k] = fewer > 1 ? fewer : 1;
    }
    plan->coarser = true;
}

struct grid_plan grid_plan(const struct primitives *p, const struct grid_pool *pool,
                           const accel_box *box, struct grid_items items, double density)
{
    struct planner s = {.p = p, .pool = pool, .box = box, .items = items};
    measure_box(&s);
    const size_t stride = items.count / SAMPLE + 1;
    if (isnan(density))
        return cheapest(&s, stride);
    return plan_density(&s, density, stride);
}
