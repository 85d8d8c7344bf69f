/* SPDX-License-Identifier: Apache-2.0 */
#include "wide_form.h"

#include <string.h>

const char *const accel_wide_isa_words[] = {"avx512", "avx2", "portable", NULL};
const char *const accel_wide_form_words[] = {"wide", "classic", NULL};

/* The set that is asked for; without a word, or where that is not to be had, the best there is. */
static const struct wide_isa *choose_isa(struct build *build, double option)
{
    const char *wanted = isnan(option) ? NULL : accel_wide_isa_words[(int)option];
    size_t i = 0;
    while (!accel_wide_isas[i]->works_here())
        i++;
    for (size_t j = i; wanted && accel_wide_isas[j]; j++)
        if (strcmp(accel_wide_isas[j]->name, wanted) == 0)
            return accel_wide_isas[j];
    if (wanted)
        accel_build_note(build, "isa=%s is not to be had here: %s instead", wanted,
                         accel_wide_isas[i]->name);
    return accel_wide_isas[i];
}

/* Keeps nothing of the scene that the leaves hold. */
static void leave(struct build *build, const struct wide *w)
{
    struct memory *m = &build->a->memory;
    const size_t before = m->bytes + w->boxes;
    accel_primitives_leave(m, &build->a->prims);
    accel_build_left_out(
        build, before - m->bytes, before,
        "only triangles: their vertices stand in the leaves alone, their boxes nowhere");
}

bool accel_wide_form_build(struct build *build, struct wide *w, const double *isa,
                           enum wide_cut cut, const struct clustering *clusters)
{
    const struct primitives *p = &build->a->prims;
    accel_info *info = &build->a->info;
    if (!accel_wide_build(build, w, choose_isa(build, *isa), cut, clusters))
        return false;
    info->nodes = w->nodes;
    info->leaves = w->leaves;
    info->references = w->references;
    info->depth = w->depth;
    if (w->reach > 0.0)
        accel_build_note(build,
                         "boxes of triangles lie across each other: large ones are in several "
                         "leaves, %.2f references a primitive",
                         (double)w->references / (double)p->bounded.count);
    if (w->nodes == 0)
        accel_build_left_out(build, sizeof(struct wide_node), w->bytes,
                             "few primitives: a leaf, no tree");
    build->a->fast = w->fast ? w : NULL;
    if (accel_wide_holds_all(w, p))
        leave(build, w);
    return true;
}

void accel_wide_form_walk(const struct wide *w, struct query *q)
{
    if (!w->fast || !w->isa->walk(w, q))
        accel_wide_walk(w, q);
}
