/* SPDX-License-Identifier: Apache-2.0 */
#include "cluster_parts.h"

uint32_t accel_parts_root(struct parts *p, uint32_t part)
{
    struct cluster *at = p->part.at;
    while (at[part].first != part) {
        at[part].first = at[at[part].first].first;
        part = at[part].first;
    }
    return part;
}

uint32_t accel_parts_join(struct parts *p, uint32_t a, uint32_t b)
{
    const uint32_t low = a < b ? a : b, high = a < b ? b : a;
    struct cluster *root = &p->part.at[low], *other = &p->part.at[high];
    if (other->count > root->count)
        root->size_class = other->size_class;
    box_add(&root->box, &other->box);
    root->count += other->count;
    other->first = low;
    return low;
}

bool accel_parts_new(struct parts *p, uint32_t size_class, uint32_t *number)
{
    if (!array_extend(&p->build->a->memory, &p->part, 1))
        return accel_build_no_memory(p->build);
    *number = (uint32_t)p->part.count - 1;
    p->part.at[*number] = (struct cluster){box_empty(), *number, 0, size_class};
    return true;
}

double accel_parts_cost(const struct parts *p, const accel_box *box, double count)
{
    const accel_box unit = frame_box(&p->sizes.frame, box);
    return accel_parts_unit_cost(p, &unit, count);
}

double accel_parts_unit_cost(const struct parts *p, const accel_box *unit, double count)
{
    return box_area(unit) * (p->build->a->prims.test_cost + COST_NODE * log2(count));
}
