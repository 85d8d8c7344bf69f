/* SPDX-License-Identifier: Apache-2.0
 *
 * How many cells a grid gets, by the predicted cost of a line through its box.
 *
 * The surface-area heuristic (MacDonald and Booth, 1990), applied to grids: a line crosses the
 * planes of an axis in proportion to the area of the box's face, and tests an item if it meets the
 * block of cells that list it, in proportion to the block's surface; that an item is met in
 * several cells costs a look in the mailbox. Large sets are judged by a sample. Cost: a few
 * operations per item of the sample and density tried, of which there are log8(256 n) + 5.
 */
#include "grid.h"

/* Densities that are tried: from about one cell in all to this many cells per item. */
#define MAX_DENSITY 128.0

/* Items that are looked at for each density tried. */
enum { SAMPLE = 8192 };

/* Cells along an axis, so that stepping through empty ones stays cheap beside any test. */
enum { MAX_CELLS = 8192 };

/* Factor on the bounds below for what the user asks for by number. */
#define GIVEN_ROOM 16.0

/* Bricks take 12 bytes, references 4. The constants let a few large items have some cells. */
double accel_grid_plan_references(const struct grid_plan *plan, size_t count)
{
    return plan->capacity * (10.0 * (double)count + 256.0);
}

bool accel_grid_plan_fits(const struct grid_plan *plan, size_t count)
{
    double bricks = 1.0;
    for (int k = 0; k < 3; k++)
        bricks *= (plan->cells[k] + GRID_BRICK - 1) / GRID_BRICK;
    return bricks <= plan->capacity * (2.0 * (double)count + 64.0);
}

/* What is the same for all densities tried. */
struct planner {
    const struct primitives *p;   /* the scene's */
    const struct grid_pool *pool; /* of the grids among the items */
    const accel_box *box;         /* of the grid */
    struct grid_items items;      /* what it is to be made of */
    double side[3];               /* the box's extents, the longest being 1 */
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

/* The cells of an axis from the one that holds lo to the one that holds hi, both inclusive. */
static double span(double origin, double scale, uint32_t cells, double lo, double hi)
{
    const double last = cells - 1, low = (lo - origin) * scale, high = (hi - origin) * scale;
    const uint32_t first = !(low > 0.0) ? 0 : low < last ? (uint32_t)low : cells - 1;
    const uint32_t end = !(high < last) ? cells - 1 : high > 0.0 ? (uint32_t)high : 0;
    return end - first + 1;
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
                cells[k] > 1 ? span(s->box->lo[k], scale[k], cells[k], b->lo[k], b->hi[k]) : 1.0;
            side[k] = s->side[k] * cut / cells[k];
            block *= cut;
        }
        sum.references += block;
        sum.tests += surface(side) / whole * (ref < s->p->count ? s->p->test_cost : COST_GRID_ITEM);
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
    return COST_GRID_BEGIN + COST_GRID_STEP * steps + o.tests +
           COST_GRID_MAILBOX * o.references * surface(cell) / whole;
}

/* The plan for one density. Its cost is infinite if it is out of bounds. */
static struct grid_plan plan_density(const struct planner *s, double density, double capacity,
                                     size_t stride)
{
    const size_t count = s->items.count;
    struct grid_plan plan = {.density = density, .cost = (double)INFINITY, .capacity = capacity};
    divide(s->side, fmax(1.0, density * (double)count), plan.cells);
    if (!accel_grid_plan_fits(&plan, count))
        return plan;
    const struct outcome o = look(s, plan.cells, stride);
    if (o.references <= accel_grid_plan_references(&plan, count))
        plan.cost = predicted_cost(s, plan.cells, o);
    plan.tests = o.tests;
    return plan;
}

/* Tries densities from `from` on, by factors of `step`, while there would be more than one cell. */
static struct grid_plan try_densities(const struct planner *s, double from, double to, double step,
                                      struct grid_plan best, size_t stride)
{
    for (double density = from; density >= to; density /= step) {
        const struct grid_plan plan = plan_density(s, density, 1.0, stride);
        if (!(plan.cost > best.cost))
            best = plan;
    }
    return best;
}

/* In two rounds: by large factors, then between the neighbours of the best. */
static struct grid_plan cheapest(const struct planner *s, size_t stride)
{
    const double one = 0.5 / (double)s->items.count;
    const struct grid_plan none = {.cost = (double)INFINITY};
    const struct grid_plan best = try_densities(s, MAX_DENSITY, one / 8.0, 8.0, none, stride);
    return try_densities(s, best.density * 4.0, best.density / 4.0, 2.0, best, stride);
}

double accel_grid_list_cost(const struct primitives *p, struct grid_items items)
{
    double sum = 0.0;
    for (size_t i = 0; i < items.count; i++)
        sum += items.at[i] < p->count ? p->test_cost : COST_GRID_ITEM;
    return sum;
}

struct grid_plan accel_grid_plan_given(const accel_box *box, uint32_t cells)
{
    struct planner s = {.box = box};
    struct grid_plan plan = {.capacity = GIVEN_ROOM};
    measure_box(&s);
    for (int k = 0; k < 3; k++)
        plan.cells[k] = s.side[k] > FLAT ? cells : 1;
    return plan;
}

void accel_grid_coarsen(struct grid_plan *plan)
{
    const double share = 0.79; /* of an axis: half the cells */
    for (int k = 0; k < 3; k++) {
        const uint32_t fewer = (uint32_t)(share * plan->cells[k]);
        plan->cells[k] = fewer > 1 ? fewer : 1;
    }
    plan->coarser = true;
}

void accel_grid_give_up(struct grid_plan *plan)
{
    plan->cells[0] = plan->cells[1] = plan->cells[2] = 1;
    plan->coarser = true;
}

struct grid_plan accel_grid_plan(const struct primitives *p, const struct grid_pool *pool,
                                 const accel_box *box, struct grid_items items, double density)
{
    struct planner s = {.p = p, .pool = pool, .box = box, .items = items};
    measure_box(&s);
    const size_t stride = items.count / SAMPLE + 1;
    if (isnan(density))
        return cheapest(&s, stride);
    return plan_density(&s, density, GIVEN_ROOM, stride);
}
