/* SPDX-License-Identifier: Apache-2.0
 *
 * Leaves whose blocks are packed, LANES primitives at a time: included by the file of an
 * instruction set without vertex pools, after wide_leaf.h and coordinates(block, row, i): LANES of
 * a row of a block's coordinates, from the i-th on; what lies behind the last is not used.
 */
static inline struct corners load_corners(const struct leaf_ray *l, const struct wide_block *b,
                                          uint32_t from)
{
    struct corners c;
    for (uint32_t i = 0; i < 3; i++)
        shear_corner(l, coordinates(b, 3 * i + l->axis[0], from),
                     coordinates(b, 3 * i + l->axis[1], from),
                     coordinates(b, 3 * i + l->axis[2], from), &c, i);
    return c;
}

static inline struct spheres load_spheres(const struct wide_block *b, uint32_t from)
{
    return (struct spheres){
        {coordinates(b, 0, from), coordinates(b, 1, from), coordinates(b, 2, from)},
        coordinates(b, 3, from)};
}

__attribute__((noinline)) static bool leaf_test(struct wide_fast *f, const struct wide_block *b,
                                                bool any)
{
    bool better = false;
    for (uint32_t i = 0; i < b->count && !(any && better); i += LANES) {
        if (b->type >= WIDE_SPHERES) {
            const struct spheres s = load_spheres(b, i);
            better |= test_spheres(f, b, &s, i, any);
        } else {
            const struct corners c = load_corners(&f->leaf, b, i);
            better |= test_triangles(f, b, &c, i, any);
        }
    }
    return better;
}
