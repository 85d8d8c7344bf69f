/* SPDX-License-Identifier: Apache-2.0 */
#include "cluster_touching.h"

/* Groups that one cell may have. */
enum { CROWD = 32 };

/* A box's part in a cell, and how far it may be from what it touches. */
struct part {
    float lo[3], hi[3], gap;
};

bool accel_touching_reserve(struct memory *m, struct touching *t, size_t boxes)
{
    return accel_cells_reserve(m, &t->cells, boxes) && array_reserve(m, &t->groups, boxes);
}

uint32_t accel_touching_root(struct touching *t, uint32_t group)
{
    struct group *at = t->groups.at;
    while (at[group].parent != group) {
        at[group].parent = at[at[group].parent].parent;
        group = at[group].parent;
    }
    return group;
}

static void unite(struct touching *t, uint32_t a, uint32_t b)
{
    a = accel_touching_root(t, a);
    b = accel_touching_root(t, b);
    if (a < b)
        t->groups.at[b].parent = a;
    else
        t->groups.at[a].parent = b;
}

/* One axis of a box's part in a cell of the grid. */
static inline void clip(struct part *p, int k, const accel_box *unit, double cells, uint32_t cell,
                        double reach)
{
    const double lo = unit->lo[k] * cells - cell, hi = unit->hi[k] * cells - cell;
    p->lo[k] = (float)(lo > -reach ? lo : -reach);
    p->hi[k] = (float)(hi < 1.0 + reach ? hi : 1.0 + reach);
}

static bool touches(const struct group *g, const struct part *p)
{
    bool apart = false; /* no branches: nobody can guess them */
    for (int k = 0; k < 3; k++)
        apart |= (p->lo[k] - g->hi[k] > p->gap) | (g->lo[k] - p->hi[k] > p->gap);
    return !apart;
}

/* Grows the part around a group. True if it became larger. */
static bool grow(struct part *p, const struct group *g)
{
    bool larger = false;
    for (int k = 0; k < 3; k++) {
        larger |= (g->lo[k] < p->lo[k]) | (g->hi[k] > p->hi[k]);
        p->lo[k] = g->lo[k] < p->lo[k] ? g->lo[k] : p->lo[k];
        p->hi[k] = g->hi[k] > p->hi[k] ? g->hi[k] : p->hi[k];
    }
    return larger;
}

/* Takes the groups that the part touches, or all, out of a cell's list, growing the part around
 * them. Returns one of them, joined with the others, or ACCEL_NONE. */
static uint32_t gather(struct touching *t, uint32_t *list, struct part *p, bool all)
{
    uint32_t found = ACCEL_NONE;
    for (bool again = true; again;) {
        again = false;
        for (uint32_t *at = list; *at != ACCEL_NONE;) {
            struct group *g = &t->groups.at[*at];
            t->visits++;
            if (!all && !touches(g, p)) {
                at = &g->next;
                continue;
            }
            again |= grow(p, g);
            if (found == ACCEL_NONE)
                found = *at;
            else
                unite(t, found, *at);
            *at = g->next;
        }
    }
    return found;
}

static size_t length(const struct touching *t, uint32_t list)
{
    size_t n = 0;
    for (; list != ACCEL_NONE; list = t->groups.at[list].next)
        n++;
    return n;
}

static uint32_t new_group(struct memory *m, struct touching *t)
{
    if (t->groups.count == ACCEL_NONE || !array_extend(m, &t->groups, 1))
        return ACCEL_NONE;
    const uint32_t made = (uint32_t)t->groups.count - 1;
    t->groups.at[made].parent = made;
    return made;
}

/* Enters a part into a cell; *group is its group so far, or ACCEL_NONE, and becomes this one. */
static bool enter_cell(struct memory *m, struct touching *t, uint64_t key, struct part *p,
                       uint32_t *group)
{
    struct cell_slot *slot = accel_cells_at(m, &t->cells, key);
    if (!slot)
        return false;
    t->visits++;
    uint32_t list = slot->value;
    uint32_t mine = gather(t, &list, p, false);
    if (mine == ACCEL_NONE && length(t, list) >= CROWD)
        mine = gather(t, &list, p, true);
    if (mine == ACCEL_NONE && (mine = new_group(m, t)) == ACCEL_NONE)
        return false;
    struct group *g = &t->groups.at[mine];
    memcpy(g->lo, p->lo, sizeof g->lo);
    memcpy(g->hi, p->hi, sizeof g->hi);
    g->next = list;
    slot->value = mine;
    if (*group != ACCEL_NONE)
        unite(t, *group, mine);
    *group = mine;
    return true;
}

uint32_t accel_touching_enter(struct memory *m, struct touching *t, const accel_box *unit,
                              struct touch_rule rule)
{
    const struct span s = span_of(unit, rule.octave, rule.reach);
    const double cells = (double)(1u << rule.octave);
    struct part p = {.gap = (float)(2.0 * rule.reach)};
    uint32_t group = ACCEL_NONE, c[3];
    for (c[2] = s.first[2]; c[2] <= s.last[2]; c[2]++) {
        clip(&p, 2, unit, cells, c[2], rule.reach);
        for (c[1] = s.first[1]; c[1] <= s.last[1]; c[1]++) {
            clip(&p, 1, unit, cells, c[1], rule.reach);
            for (c[0] = s.first[0]; c[0] <= s.last[0]; c[0]++) {
                clip(&p, 0, unit, cells, c[0], rule.reach);
                struct part grown = p;
                const uint64_t key = cell_key(rule.class, rule.octave, c[0], c[1], c[2]);
                if (!enter_cell(m, t, key, &grown, &group))
                    return ACCEL_NONE;
            }
        }
    }
    return group;
}

/* Joins `group` with those of a cell's list that the part touches. */
static void join_list(struct touching *t, uint32_t list, const struct part *p, uint32_t group)
{
    t->visits++;
    for (; list != ACCEL_NONE; list = t->groups.at[list].next) {
        t->visits++;
        if (touches(&t->groups.at[list], p))
            unite(t, group, list);
    }
}

void accel_touching_join(struct touching *t, const accel_box *unit, struct touch_rule rule,
                         uint32_t group)
{
    const struct span s = span_of(unit, rule.octave, rule.reach);
    const double cells = (double)(1u << rule.octave);
    struct part p = {.gap = (float)(2.0 * rule.reach)};
    uint32_t c[3];
    for (c[2] = s.first[2]; c[2] <= s.last[2]; c[2]++) {
        clip(&p, 2, unit, cells, c[2], rule.reach);
        for (c[1] = s.first[1]; c[1] <= s.last[1]; c[1]++) {
            clip(&p, 1, unit, cells, c[1], rule.reach);
            for (c[0] = s.first[0]; c[0] <= s.last[0]; c[0]++) {
                clip(&p, 0, unit, cells, c[0], rule.reach);
                const uint64_t key = cell_key(rule.class, rule.octave, c[0], c[1], c[2]);
                join_list(t, cells_get(&t->cells, key), &p, group);
            }
        }
    }
}

void accel_touching_free(struct memory *m, struct touching *t)
{
    accel_cells_free(m, &t->cells);
    array_free(m, &t->groups);
}
