/* SPDX-License-Identifier: Apache-2.0
 *
 * The kind bvh: see bvh.h.
 */
#include "bvh.h"

enum { LEAF };

static const accel_option options[] = {
    [LEAF] = {.key = "leaf",
              .meaning = "primitives that a leaf may hold without being split",
              .min = 1,
              .max = 1e9,
              .standard = NAN,
              .whole = true},
};

static void describe(struct build *build, const struct bvh *b)
{
    const size_t vertices = b->refs.count * 9 * sizeof(double);
    const size_t made = b->refs.count * (sizeof *b->refs.at + sizeof(accel_box));
    if (b->triangles)
        build_left_out(build, vertices, vertices,
                       "only triangles: vertices in the order of the leaves, none in the scene's");
    if (b->nodes.count == 0)
        build_left_out(build, sizeof *b->nodes.at, made, "few primitives: a list, no tree");
}

static bool build(struct build *build)
{
    struct bvh *b = (struct bvh *)build->a;
    if (!bvh_build(build, b, b->base.option[LEAF]))
        return false;
    array_trim(&b->base.memory, &b->nodes);
    b->base.info.nodes = b->nodes.count;
    b->base.info.leaves = b->nodes.count + 1;
    b->base.info.references = b->refs.count;
    describe(build, b);
    return true;
}

static void visit(const accel *a, struct query *q, struct boxtree_child leaf)
{
    const struct bvh *b = (const struct bvh *)a;
    const uint32_t *ids = b->refs.at + leaf.first;
    if (b->triangles && !q->point)
        query_test_triangles(q, ids, b->triangles + 9 * (size_t)leaf.first, leaf.count);
    else
        query_test_list(q, ids, leaf.count);
}

static void walk(const accel *a, struct query *q)
{
    const struct bvh *b = (const struct bvh *)a;
    if (!query_meets(q, query_box(q, &b->box)))
        return;
    if (b->root.count > 0)
        visit(a, q, b->root);
    else
        boxtree_walk(a, b->nodes.at, q, visit);
}

static bool validate(const accel *a, accel_error *error)
{
    return bvh_validate((const struct bvh *)a, error);
}

static void release(accel *a)
{
    struct bvh *b = (struct bvh *)a;
    if (b->triangles)
        memory_resize(&a->memory, b->triangles, 9 * sizeof(double) * b->refs.count, 0);
    array_free(&a->memory, &b->nodes);
    array_free(&a->memory, &b->refs);
}

const struct accel_kind bvh_kind = {
    .info = {.name = "bvh",
             .summary = "binary hierarchy of boxes by the surface-area heuristic",
             .options = options,
             .option_count = sizeof options / sizeof *options},
    .cost = {.build = 41,
             .ray = 58,
             .node = 17,
             .triangle = 2.5,
             .other = 22,
             .mesh = 0.65,
             .growth = GROWS_LIKE_LOG},
    .size = sizeof(struct bvh),
    .build = build,
    .walk = walk,
    .validate = validate,
    .release = release,
};
