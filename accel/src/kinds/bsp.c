/* SPDX-License-Identifier: Apache-2.0
 *
 * The kind bsp and its walk: see bsp.h.
 *
 * The walk carries the part of the ray inside the cell down as raw values of t: a plane cuts the
 * near half's end and the far half's begin. So what it compares is S of the cell, grown only then.
 *
 * Why no hit is missed: let t' be the key of a hit of a primitive, in S(P'). If on every axis t'
 * lies in the grown interval of what the cell and P' share there, the same holds for a child that
 * lists the primitive: on the plane's axis the shared range lies on one side, or the plane cuts it
 * into two whose grown intervals overlap at the plane's own t. It holds at the root, which contains
 * P'. And what the cell and P' share has an interval inside S of the cell.
 */
#include "../core/kind.h"
#include "../bsp/bsp.h"

/* A cell to visit later: the part of the ray inside it. */
struct waiting {
    double a, z;
    uint32_t node;
};

/* Where the plane cuts the ray: the half that the ray comes to first ends at `end`, the other one
 * begins at `begin`. */
struct crossing {
    double end, begin;
};

static inline struct crossing cross(const struct query *q, const struct bsp_node *node, uint32_t k,
                                    bool common)
{
    const double inf = (double)INFINITY;
    if (!common && q->parallel >> k & 1)
        return (struct crossing){q->org[k] <= node->plane ? inf : -inf,
                                 q->org[k] >= node->plane ? -inf : inf};
    const double t = (node->plane - q->org[k]) * q->inv[k];
    return (struct crossing){common ? t * (1.0 + QUERY_SLACK) : t, t};
}

/* Must a cell be visited, given the part of the ray inside it? */
static inline bool meets(const struct query *q, double a, double z, double cap, bool common)
{
    return common ? a <= z && a <= cap : query_meets(q, query_interval(q, a, z));
}

/* Goes on from an inner node: the part of the ray inside its cell is *in. The half to visit next
 * replaces *in; one to visit after it is put on the stack, whose new depth is returned. False in
 * *any if there is none. */
static inline uint32_t enter(const struct bsp *b, const struct query *q, struct waiting *in,
                             struct waiting *stack, uint32_t depth, double cap, bool common,
                             bool *any)
{
    const struct bsp_node *node = &b->nodes.at[in->node];
    const uint32_t k = node->bits & BSP_AXIS, swap = q->sign >> k & 1;
    const uint32_t half[2] = {in->node + 1, node->first};
    const struct crossing c = cross(q, node, k, common);
    const struct waiting near = {in->a, c.end < in->z ? c.end : in->z, half[swap]};
    const struct waiting far = {c.begin > in->a ? c.begin : in->a, in->z, half[swap ^ 1]};
    const bool near_empty = node->bits & (uint32_t)BSP_LOWER_EMPTY << swap;
    const bool far_empty = node->bits & (uint32_t)BSP_UPPER_EMPTY >> swap;
    const bool near_met = !near_empty && meets(q, near.a, near.z, cap, common);
    const bool far_met = !far_empty && meets(q, far.a, far.z, cap, common);
    *any = near_met || far_met;
    *in = near_met ? near : far;
    if (near_met && far_met)
        stack[depth++] = far;
    return depth;
}

/* Visits the cells below the root, where the ray is inside from in.a to in.z. */
__attribute__((always_inline)) static inline void walk_as(const struct bsp *b, struct query *q,
                                                          struct waiting in, bool common)
{
    struct waiting stack[BSP_MAX_DEPTH];
    uint32_t depth = 0;
    double cap = query_cap(q);
    for (;;) {
        const struct bsp_node *node = &b->nodes.at[in.node];
        bool any = false;
        if ((node->bits & BSP_AXIS) != BSP_LEAF) {
            q->nodes++;
            depth = enter(b, q, &in, stack, depth, cap, common, &any);
        } else {
            accel_query_test_list(q, b->refs.at + node->first, node->count);
            if (query_done(q))
                return;
            cap = query_cap(q);
        }
        while (!any) {
            if (depth == 0)
                return;
            in = stack[--depth];
            any = meets(q, in.a, in.z, cap, common);
        }
    }
}

static void walk(const accel *a, struct query *q)
{
    const struct bsp *b = (const struct bsp *)a;
    const struct interval in = query_slabs(q, &b->box);
    if (!query_meets(q, query_interval(q, in.a, in.z)))
        return;
    if (query_common(q))
        walk_as(b, q,
                (struct waiting){in.a > q->begin ? in.a : q->begin, in.z * (1.0 + QUERY_SLACK), 0},
                true);
    else
        walk_as(b, q, (struct waiting){in.a, in.z, 0}, false);
}

/* ------------------------------------------------------------------ the kind ---- */

enum { LEAF, DEPTH };

static const accel_option options[] = {
    [LEAF] = {.key = "leaf",
              .meaning = "primitives that a cell may hold without being split",
              .min = 1,
              .max = 1e9,
              .standard = NAN,
              .whole = true},
    [DEPTH] = {.key = "depth",
               .meaning = "levels below the root",
               .min = 0,
               .max = BSP_MAX_DEPTH,
               .standard = NAN,
               .whole = true},
};

static bool build(struct build *build)
{
    struct bsp *b = (struct bsp *)build->a;
    accel_build_phase(build, "bsp");
    if (!accel_bsp_build(build, b, (struct bsp_rule){b->base.option[LEAF], b->base.option[DEPTH]}))
        return false;
    array_trim(&b->base.memory, &b->nodes);
    array_trim(&b->base.memory, &b->refs);
    return true;
}

static bool validate(const accel *a, accel_error *error)
{
    return accel_bsp_validate((const struct bsp *)a, error);
}

static void release(accel *a)
{
    struct bsp *b = (struct bsp *)a;
    array_free(&a->memory, &b->nodes);
    array_free(&a->memory, &b->refs);
}

const struct accel_kind accel_bsp_kind = {
    .info = {.name = "bsp",
             .summary = "kd-tree by the surface-area heuristic",
             .options = options,
             .option_count = sizeof options / sizeof *options},
    .cost = COST_BSP,
    .size = sizeof(struct bsp),
    .build = build,
    .walk = walk,
    .validate = validate,
    .release = release,
};
