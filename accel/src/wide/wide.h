/* SPDX-License-Identifier: Apache-2.0
 *
 * The wide tree: up to 16 boxes a node in float, leaves of a few primitives side by side, walked by
 * the widest instructions there are. What the fast forms of several kinds are made of. After Wald,
 * Benthin and Boulos, "Getting Rid of Packets", 2008, and Dammertz, Hanika and Keller, "Shallow
 * Bounding Volume Hierarchies for Fast SIMD Ray Tracing of Incoherent Rays", 2008.
 *
 * Encoding: one block of memory holds nodes, 448 bytes each at multiples of 64, and leaves, which
 * are runs of blocks (wide_block) at multiples of 16. A word names either: its offset in units of
 * 16 bytes, with the top bit set for a leaf. A node's boxes are in scaled coordinates, which lie in
 * [-1, 1]: the scene's times a power of two, so that neither float's range nor the units of the
 * scene matter.
 *
 * Invariant: every bounded primitive is in a leaf, in exactly one but for triangles that are cut
 * (wide_split.h). A child's box contains the padded boxes P' of all primitives below, or of what is
 * cut those parts that are below, moved out by WIDE_PAD: see wide_ray.h for what that pays for.
 *
 * Cost: about 40 bytes a triangle of a mesh, 60 if its vertices are no floats. Bad at: what is
 * smaller than 2^-23 of the scene is told apart by no node, so a ray that goes there tests all that
 * is there.
 */
#ifndef ACCEL_WIDE_H
#define ACCEL_WIDE_H

#include "../core/build.h"
#include "../core/cost.h"
#include "../core/structure.h"
#include "../primitive/query.h"

/* Children of a node at most; levels of a tree at most; primitives of a block at most. */
enum { WIDE = 16, WIDE_MAX_DEPTH = 96, WIDE_BLOCK = 8 };

/* By how much boxes are moved out, in scaled coordinates. */
#if !defined(WIDE_PAD) /* a test makes it too small */
#define WIDE_PAD 0x1.1p-23f
#endif

#define WIDE_LEAF 0x80000000u

/* The words come first: they are wanted last, but by then are there. */
struct wide_node {
    uint32_t child[WIDE];    /* words; children with the smallest surface last */
    float plane[3][2][WIDE]; /* axis, lower or upper side, child; no child: infinity, -infinity */
};

/* What a block holds. */
enum wide_type {
    WIDE_POOL,         /* triangles over shared float vertices */
    WIDE_POOL_DOUBLES, /* triangles over shared double vertices */
    WIDE_FLOATS,       /* triangles, their own float vertices */
    WIDE_DOUBLES,      /* triangles, their own double vertices */
    WIDE_SPHERES,      /* spheres */
    WIDE_LIST          /* ids of objects */
};

/* The head of a block. After it:
 * WIDE_POOL: float x[vertices], y[vertices], z[vertices]; uint8_t corner[3][WIDE_BLOCK]; ids
 * WIDE_POOL_DOUBLES: the same with double
 * WIDE_FLOATS, WIDE_DOUBLES: the coordinates, [3 * corner + axis][count]; ids
 * WIDE_SPHERES: double x[count], y[count], z[count], r[count]; ids
 * WIDE_LIST: ids
 * where ids is uint32_t[count]. */
struct wide_block {
    uint8_t type, count, vertices;
    uint8_t last;     /* the leaf ends here */
    uint32_t size;    /* bytes to the next block */
    float least_det;  /* triangles with a smaller determinant take the general test: wide_leaf.h */
    float far_origin; /* so do rays from farther away than this, to triangles and spheres */
};

struct wide_isa;
struct wide_split;
struct clustering;

struct wide {
    unsigned char *base; /* the nodes and leaves, aligned to 64 */
    void *memory;        /* the block around it */
    size_t bytes;        /* of that block */
    size_t used;         /* bytes of nodes and leaves */
    uint32_t root;       /* a word */
    double scale;        /* scaled coordinates are the scene's times this, a power of two */
    double reach;        /* longest side of a triangle that is cut, scaled; 0: none is */
    bool fast;           /* coordinates are such that no edge function overflows: see wide_leaf.h */
    uint32_t depth;      /* levels of nodes */
    uint64_t nodes, leaves, blocks;
    uint64_t references; /* primitives in leaves, one that is cut in each of them */
    const struct wide_isa *isa;
    size_t boxes;  /* bytes of boxes and ids that were freed before the layout */
    uint64_t seal; /* of the nodes and leaves: see seal.h */
};

/* Do the leaves hold all that is known of the primitives? Then nothing else keeps it. */
static inline bool accel_wide_holds_all(const struct wide *w, const struct primitives *p)
{
    return w->fast && p->only_triangles && p->unbounded.count == 0;
}

static inline const struct wide_node *wide_node_at(const struct wide *w, uint32_t word)
{
    return (const struct wide_node *)(w->base + 16 * (size_t)word);
}

static inline const struct wide_block *wide_leaf_at(const struct wide *w, uint32_t word)
{
    return (const struct wide_block *)(w->base + 16 * (size_t)(word & ~WIDE_LEAF));
}

static inline const struct wide_block *wide_next_block(const struct wide_block *b)
{
    return (const struct wide_block *)((const unsigned char *)b + b->size);
}

static inline const void *wide_block_data(const struct wide_block *b)
{
    return b + 1;
}

/* Where a block's ids stand. */
static inline const uint32_t *wide_block_ids(const struct wide_block *b)
{
    const unsigned char *at = (const unsigned char *)(b + 1);
    switch (b->type) {
    case WIDE_POOL:
        return (const uint32_t *)(at + 12 * b->vertices + 3 * WIDE_BLOCK);
    case WIDE_POOL_DOUBLES:
        return (const uint32_t *)(at + 24 * b->vertices + 3 * WIDE_BLOCK);
    case WIDE_FLOATS:
        return (const uint32_t *)(at + 36 * b->count);
    case WIDE_DOUBLES:
        return (const uint32_t *)(at + 72 * b->count);
    case WIDE_SPHERES:
        return (const uint32_t *)(at + 32 * b->count);
    }
    return (const uint32_t *)at;
}

/* The vertices of the i-th triangle of a block: 9 doubles, as primitives keep them. */
void accel_wide_vertices(const struct wide_block *b, unsigned i, double out[9]);

/* The i-th sphere of a block: x, y, z, r. */
static inline void wide_sphere(const struct wide_block *b, unsigned i, double out[4])
{
    for (unsigned c = 0; c < 4; c++)
        out[c] = ((const double *)wide_block_data(b))[c * b->count + i];
}

/* P' of the i-th triangle of a block, with the bits that the build gave it. */
accel_box accel_wide_triangle_box(const struct wide_block *b, unsigned i);

/* P' of a triangle by its id: false if no leaf holds it. Goes through the whole tree. */
bool accel_wide_find_box(const struct wide *w, uint32_t id, accel_box *box);

/* The power of two that takes the largest coordinate into [1/2, 1). */
static inline double wide_scale(double largest)
{
    int exponent;
    if (largest == 0.0)
        return 1.0;
    frexp(largest, &exponent);
    return ldexp(1.0, exponent < -999 ? 999 : -exponent);
}

/* What leaves look like and cost. */
struct wide_rule {
    unsigned lanes;  /* primitives that a leaf tests at once */
    bool pool;       /* share vertices */
    float node_cost; /* of a visit: see cost.h */
};

/* How the binary tree is cut. */
enum wide_cut {
    WIDE_BY_COST,    /* anywhere */
    WIDE_BY_OCTANTS, /* three levels in turn along three axes: an octree whose planes lie where the
                        cost is lowest, as in Whang et al., "Octree-R", 1995 */
};

/* Builds the tree over all bounded primitives with isa's leaves. With `clusters` no node below the
 * ones that part clusters holds primitives of two. */
bool accel_wide_build(struct build *build, struct wide *w, const struct wide_isa *isa,
                      enum wide_cut cut, const struct clustering *clusters);

void accel_wide_free(struct memory *m, struct wide *w);

/* Any query by the general rule of query.h, on any ray. */
void accel_wide_walk(const struct wide *w, struct query *q);

/* Tests a leaf's primitives by the general rule. */
void accel_wide_test_leaf(const struct wide *w, struct query *q, uint32_t word);

/* Checks the invariant. */
bool accel_wide_validate(const accel *a, const struct wide *w, accel_error *error);

/* ------------------------------------------------------- the binary tree it is collapsed from ----
 */

/* A primitive under construction, or a part of it: its padded box, scaled, rounded outward. */
struct wide_item {
    float lo[3];
    uint32_t id;
    float hi[3];
    uint32_t unused;
};

/* A node of the binary tree. A tree over n items lies in 2n - 1 places: the node, the left subtree,
 * the right one. */
struct wide_binary {
    float lo[3], hi[3];
    uint32_t first, count;  /* its items */
    uint32_t right;         /* place of the right child, 0 if the node has no children */
    uint8_t slots;          /* children of one wide node that the subtree can make use of */
    bool leaf;              /* as one child it is a leaf, not a wide node */
    uint8_t left_of_all;    /* slots of its own wide node that the left side gets */
    uint8_t left[WIDE + 1]; /* the same of j slots of another's; 0: j - 1 are as good */
};

struct wide_binary_tree {
    const struct clustering *clusters; /* or NULL */
    const struct wide_split *split;
    struct wide_item *items;   /* in the order of the leaves */
    struct wide_binary *nodes; /* 2n - 1 places; 0 is the root */
    uint32_t count;            /* n, parts of triangles included */
};

/* Grows it, and decides by dynamic programming which of its nodes become wide nodes and leaves. */
bool accel_wide_grow(struct build *build, const struct wide *w, struct wide_rule rule,
                     enum wide_cut cut, struct wide_binary_tree *tree);

/* A primitive's box or a cluster's, scaled, rounded outward. */
struct wide_item accel_wide_item_of(const struct wide *w, const accel_box *box, uint32_t id);

/* Lays out nodes and leaves. */
bool accel_wide_emit(struct build *build, struct wide *w, struct wide_rule rule,
                     const struct wide_binary_tree *tree);

#endif
