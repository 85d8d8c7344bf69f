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

/* Two lanes, in which gcc and clang see what any processor has. */
#define LANES 2
typedef double lanes __attribute__((vector_size(16)));
typedef int64_t lanes_bits __attribute__((vector_size(16)));
static inline lanes lanes_sub(lanes a, lanes b)
{
    return a - b;
}
static inline lanes lanes_mul(lanes a, lanes b)
{
    return a * b;
}
static inline lanes lanes_add(lanes a, lanes b)
{
    return a + b;
}
static inline lanes lanes_div(lanes a, lanes b)
{
    return a / b;
}
static inline lanes lanes_min(lanes a, lanes b)
{
    return (lanes){a[0] < b[0] ? a[0] : b[0], a[1] < b[1] ? a[1] : b[1]};
}
static inline lanes lanes_max(lanes a, lanes b)
{
    return (lanes){a[0] > b[0] ? a[0] : b[0], a[1] > b[1] ? a[1] : b[1]};
}
static inline lanes lanes_abs(lanes a)
{
    return (lanes)((lanes_bits)a & INT64_MAX);
}
static inline lanes lanes_all(double x)
{
    return (lanes){x, x};
}
static inline void lanes_store(double *at, lanes a)
{
    memcpy(at, &a, sizeof a);
}
static inline lanes lanes_sqrt(lanes a)
{
    return (lanes){sqrt(a[0]), sqrt(a[1])};
}
/* a, which is not negative, with the sign of b. */
static inline lanes lanes_with_sign(lanes a, lanes b)
{
    return (lanes)((lanes_bits)a | ((lanes_bits)b & INT64_MIN));
}
static inline uint32_t lanes_less(lanes a, lanes b)
{
    return (uint32_t)(a[0] < b[0]) | (uint32_t)(a[1] < b[1]) << 1;
}
static inline uint32_t lanes_at_most(lanes a, lanes b)
{
    return (uint32_t)(a[0] <= b[0]) | (uint32_t)(a[1] <= b[1]) << 1;
}
/* Which of two ids are this one. */
static inline uint32_t lanes_with_id(const uint32_t *ids, uint32_t id)
{
    return (uint32_t)(ids[0] == id) | (uint32_t)(ids[1] == id) << 1;
}

#include "wide_leaf.h"

/* Two of a row of coordinates, from the i-th on. */
static inline lanes coordinates(const struct wide_block *b, uint32_t row, uint32_t i)
{
    const size_t place = row * (size_t)b->count + i;
    if (b->type >= WIDE_DOUBLES) {
        const double *at = (const double *)wide_block_data(b) + place;
        return (lanes){at[0], at[1]};
    }
    const float *at = (const float *)wide_block_data(b) + place;
    return (lanes){(double)at[0], (double)at[1]};
}

#include "wide_packed.h"

#include "wide_fast.h"

#include "wide_batch.h"

static bool works_here(void)
{
    return true;
}

const struct wide_isa accel_wide_portable = {
    .name = "portable",
    .works_here = works_here,
    .rule = {.lanes = 2, .pool = false, .node_cost = COST_WIDE_PORTABLE},
    .closest = closest,
    .any = any,
    .walk = walk,
    .closest_n = closest_n,
    .any_n = any_n,
    .find_box = accel_wide_find_box,
};
