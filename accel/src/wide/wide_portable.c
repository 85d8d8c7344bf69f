/* SPDX-License-Identifier: Apache-2.0
 *
 * The walks of wide trees in plain C: what the others are judged by, and what works everywhere.
 */
#include "wide_isa.h"

typedef struct begins {
    float at[WIDE];
} begins;

struct node_ray {
    float inverse[3], offset[3], tmin, limit;
    uint32_t near[3]; /* side of the near plane */
};

static inline void node_ray_limit(struct node_ray *n, float limit)
{
    n->limit = limit;
}

static inline struct node_ray node_ray_from(const struct wide_ray *r, float limit)
{
    struct node_ray n;
    for (int k = 0; k < 3; k++) {
        n.inverse[k] = r->inverse[k];
        n.offset[k] = r->offset[k];
        n.near[k] = r->near[k];
    }
    n.tmin = r->tmin;
    n.limit = limit;
    return n;
}

static inline uint32_t node_meets(const struct node_ray *n, const struct wide_node *node, begins *b)
{
    float end[WIDE], *begin = b->at;
    uint32_t meets = 0;
    for (int i = 0; i < WIDE; i++) {
        begin[i] = n->tmin;
        end[i] = n->limit;
    }
    for (int k = 0; k < 3; k++) {
        const float *near = node->plane[k][n->near[k]], *far = node->plane[k][1 - n->near[k]];
        for (int i = 0; i < WIDE; i++) {
            const float t0 = near[i] * n->inverse[k] + n->offset[k];
            const float t1 = far[i] * n->inverse[k] + n->offset[k];
            begin[i] = t0 > begin[i] ? t0 : begin[i];
            end[i] = t1 < end[i] ? t1 : end[i];
        }
    }
    for (uint32_t i = 0; i < WIDE; i++)
        meets |= (uint32_t)(begin[i] <= end[i] * (1.0f + WIDE_STEPS * 0x1p-23f)) << i;
    return meets;
}

static inline void begins_store(const begins *b, uint32_t out[WIDE])
{
    memcpy(out, b->at, sizeof b->at);
}

static inline uint32_t *push_children(uint32_t *top, uint32_t meets, const struct wide_node *node)
{
    for (; meets != 0; meets &= meets - 1)
        *top++ = node->child[__builtin_ctz(meets)];
    return top;
}

static inline double coordinate(const struct wide_block *b, uint32_t i, uint32_t corner,
                                uint32_t axis)
{
    const uint32_t place = (3 * corner + axis) * b->count + i;
    const void *data = wide_block_data(b);
    return b->type == WIDE_DOUBLES ? ((const double *)data)[place]
                                   : (double)((const float *)data)[place];
}

/* May the triangle be hit? The same edge functions as accel_triangle_hit, in the same order. */
static inline bool may_hit(const struct leaf_ray *l, const struct wide_block *b, uint32_t i)
{
    double x[3], y[3];
    for (uint32_t c = 0; c < 3; c++) {
        const double z = coordinate(b, i, c, l->axis[2]) - l->org[2];
        x[c] = coordinate(b, i, c, l->axis[0]) - l->org[0] - l->shear[0] * z;
        y[c] = coordinate(b, i, c, l->axis[1]) - l->org[1] - l->shear[1] * z;
    }
    const double e0 = x[2] * y[1] - y[2] * x[1];
    const double e1 = x[0] * y[2] - y[0] * x[2];
    const double e2 = x[1] * y[0] - y[1] * x[0];
    return !((e0 < 0 || e1 < 0 || e2 < 0) && (e0 > 0 || e1 > 0 || e2 > 0));
}

static inline bool leaf_test(struct wide_fast *f, const struct wide_block *b, bool any)
{
    const struct leaf_ray *l = &f->leaf;
    bool better = false;
    for (uint32_t i = 0; i < b->count && !(any && better); i++)
        if (may_hit(l, b, i))
            better |= accel_wide_test_slowly(f, b, i);
    return better;
}

#include "wide_fast.h"

static bool works_here(void)
{
    return true;
}

const struct wide_isa accel_wide_portable = {
    .name = "portable",
    .works_here = works_here,
    .rule = {.lanes = 2, .pool = false, .node_cost = 2.0},
    .closest = closest,
    .any = any,
    .walk = walk,
    .find_box = accel_wide_find_box,
};
