/* SPDX-License-Identifier: Apache-2.0
 *
 * octree: one octree over the whole scene, in one of two forms.
 *
 * classic: after Glassner, "Space Subdivision for Fast Ray Tracing", IEEE CG&A 4(10), 1984: cells
 * are halved, and list what meets them. Encoding, invariant, cost and what it is bad at: octree.h.
 * Bad at clusters far apart: from the root down to each of them there is a chain of cells with one
 * child, and a cubic root around few distant things is mostly empty.
 *
 * wide: a wide tree (wide/wide.h) cut along the three axes in turn, where the cost is lowest; a
 * primitive goes to the octant of its centre.
 */
#include "../core/kind.h"
#include "../octree/octree.h"
#include "../wide/wide_form.h"

struct octree_kind {
    accel base;
    struct octree_pool pool; /* of the classic form */
    struct octree tree;
    struct wide wide; /* of the wide form */
};

enum { FORM, LEAF, DEPTH, ROOT, ISA };

static const char *const roots[] = {"cube", "scene", NULL};

static const accel_option options[] = {
    [FORM] = WIDE_FORM_OPTION("leaf, depth or root"),
    [LEAF] = OCTREE_LEAF_OPTION,
    [DEPTH] = OCTREE_DEPTH_OPTION,
    [ROOT] = {.key = "root", .meaning = "shape of the classic root cell", .words = roots},
    [ISA] = WIDE_ISA_OPTION,
};

/* The cube around a box, with the same centre; it contains the box whatever the rounding. */
static accel_box cube_around(const accel_box *b)
{
    double side = 0.0;
    for (int k = 0; k < 3; k++)
        side = fmax(side, b->hi[k] - b->lo[k]);
    accel_box cube = *b;
    for (int k = 0; k < 3; k++) {
        const double middle = b->lo[k] + 0.5 * (b->hi[k] - b->lo[k]);
        cube.lo[k] = fmin(b->lo[k], middle - 0.5 * side);
        cube.hi[k] = fmax(b->hi[k], middle + 0.5 * side);
    }
    return cube;
}

static bool build_classic(struct build *build, struct octree_kind *o)
{
    const struct primitives *p = &o->base.prims;
    const accel_box tight = p->bounds;
    const accel_box root = o->base.option[ROOT] == 0 ? cube_around(&tight) : tight;
    const struct octree_rule rule = {o->base.option[LEAF], o->base.option[DEPTH]};
    accel_build_phase(build, "octree");
    if (!accel_octree_build(build, &o->pool, &o->tree, p->bounded.at, p->bounded.count, &root, rule,
                            0, 1))
        return false;
    accel_octree_pool_trim(&o->base.memory, &o->pool);
    accel_octree_note_empty(build, &o->pool);
    accel_octree_note_lists(build, &o->pool, &o->tree, 1);
    o->base.info.nodes = o->pool.nodes;
    o->base.info.leaves = o->pool.leaves;
    o->base.info.references = o->pool.refs.count;
    return true;
}

static bool build(struct build *build)
{
    struct octree_kind *o = (struct octree_kind *)build->a;
    double *option = o->base.option;
    const bool classic = !isnan(option[LEAF]) || !isnan(option[DEPTH]) || option[ROOT] != 0;
    option[FORM] = wide_form_resolve(option[FORM], classic);
    if (option[FORM] == WIDE_FORM_CLASSIC) {
        accel_note_idle_option(build, ISA, "form=classic");
        return build_classic(build, o);
    }
    for (size_t i = LEAF; i <= ROOT; i++)
        accel_note_idle_option(build, i, "form=wide");
    return accel_wide_form_build(build, &o->wide, &option[ISA], WIDE_BY_OCTANTS, NULL);
}

static void walk(const accel *a, struct query *q)
{
    const struct octree_kind *o = (const struct octree_kind *)a;
    if (o->wide.base)
        accel_wide_form_walk(&o->wide, q);
    else
        accel_octree_walk(&o->pool, &o->tree, q);
}

static bool validate(const accel *a, accel_error *error)
{
    const struct octree_kind *o = (const struct octree_kind *)a;
    if (o->wide.base)
        return accel_wide_validate(a, &o->wide, error);
    return accel_octree_validate(a, &o->pool, &o->tree, a->prims.bounded.at, a->prims.bounded.count,
                                 error);
}

static void release(accel *a)
{
    struct octree_kind *o = (struct octree_kind *)a;
    accel_octree_pool_free(&a->memory, &o->pool);
    accel_wide_free(&a->memory, &o->wide);
}

const struct accel_kind accel_octree_kind = {
    .info = {.name = "octree",
             .summary = "one octree over the scene",
             .options = options,
             .option_count = sizeof options / sizeof *options},
    .cost = COST_OCTREE,
    .size = sizeof(struct octree_kind),
    .build = build,
    .walk = walk,
    .validate = validate,
    .release = release,
};
