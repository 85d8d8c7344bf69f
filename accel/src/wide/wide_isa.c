/* SPDX-License-Identifier: Apache-2.0
 *
 * What the walks of all instruction sets share: the list of them, and the whole rule for the few
 * triangles that the lanes cannot decide.
 */
#include "wide_isa.h"

#include "../core/box.h"
#include "../primitive/triangle.h"

#if defined(__x86_64__) && defined(__GNUC__)
#define X86 1
extern const struct wide_isa accel_wide_avx512, accel_wide_avx2;
#endif

const struct wide_isa *const accel_wide_isas[] = {
#if defined(X86)
    &accel_wide_avx512, &accel_wide_avx2,
#endif
    &accel_wide_portable, NULL};

static void prepare(struct wide_fast *f)
{
    accel_query_prepare(&f->q, f->a, f->caller);
    f->prepared = true;
}

bool accel_wide_test_slowly(struct wide_fast *f, const struct wide_block *b, unsigned i)
{
    const uint32_t id = wide_block_ids(b)[i];
    double vertices[9], t, u, v;
    if (id == f->skip)
        return false;
    if (!f->prepared)
        prepare(f);
    accel_wide_vertices(b, i, vertices);
    if (!accel_triangle_hit(&f->q, vertices, &t, &u, &v) || isnan(t))
        return false;
    const accel_box box = accel_wide_triangle_box(b, i);
    const struct interval s = query_box(&f->q, &box);
    if (!(s.a <= s.z))
        return false;
    const double key = t < s.a ? s.a : t > s.z ? s.z : t;
    if (!(f->tmin < key && key < f->tmax) || key > f->best || (key == f->best && id >= f->id))
        return false;
    f->best = key;
    f->id = id;
    f->u = u;
    f->v = v;
    return true;
}
