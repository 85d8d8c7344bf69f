/* SPDX-License-Identifier: Apache-2.0
 *
 * The table of stiff and extreme cases. What other programs did wrong is told by their own sources
 * and reports and marked so; every count is measured.
 */
#include "report_cases.h"

#include <string.h>

/* What a test is about, and what is known from elsewhere. */
static const struct topic {
    const char *test, *title;
    const char *told; /* with its source */
} topics[] = {
    {"sizes", "sizes from 1e-12 to 1",
     "tinybvh's double BVH drops triangles whose determinant is below 1e-7: with a direction of "
     "length 1 those with edges below about 3e-4 (tiny_bvh.h:8183)"},
    {"scales", "scales",
     "POV-Ray: a triangle nearer than 1e-6 or farther than 1e7 is a miss "
     "(shape/mesh.cpp:1059)"},
    {"offsets", "far from the origin",
     "false hits at huge coordinates (embree#416); POV-Ray's boxes and box rays are float "
     "(bounding/boundingbox.h:83)"},
    {"slivers", "slivers, grazing rays",
     "a hit at t = 12,291 on a triangle whose corners are all nearer than 600 (embree#387)"},
    {"reported", "rays on which others failed",
     "reported by users of pbrt-v4, of Vulkan's conformance tests, of Oblikovati; the rest of this "
     "test is among the slivers"},
    {"degenerate", "degenerate and invalid primitives",
     "Embree skips them silently (rtcCommitScene.md:43); NaN in a BVH: endless loop "
     "(devil_ray#62)"},
    {"coincident", "coincident primitives",
     "recursion until the stack or 34 GB are gone (jbehley/octree#6, mlpack#4020); 256 copies "
     "overflow a count (pbrt-v2#33)"},
    {"nested", "one centre, nested", "same centroids blow up builders (hoverinc#81, pbrt-v3#182)"},
    {"series", "geometric series",
     "a tree 256 deep on a stack of 64 (tinybvh PR#192; madmann91/bvh#108)"},
    {"lattice", "faces on planes of a lattice",
     "-0.0 picks the wrong octant (tinybvh PR#282); 0 times infinity on a box's face "
     "(NVIDIA/warp#1530)"},
    {"closed", "closed meshes and fans",
     "leaks at a vertex in robust mode, agreed (embree#174, #181)"},
    {"speck", "a speck in a large scene", "a uniform grid puts it all into one cell"},
    {"huge-and-tiny", "huge and tiny, unbounded",
     "POV-Ray: beyond 1e7 nothing is hit, above 2e10 nothing is bounded (configcore.h:153)"},
    {"ties", "ties",
     "POV-Ray: the first visited wins (bounding/boundingbox.cpp:473); OptiX: ids at "
     "shared edges vary from run to run (forum 110450)"},
    {"few", "nothing, one, two of the same", "empty scenes crash builders (tinybvh#111, #274)"},
    {"special-rays", "zeros, subnormal, huge, infinite, NaN",
     "POV-Ray's BSP: an axis-parallel ray in a splitting plane ends the walk "
     "(bounding/bsptree.cpp:132)"},
    {"surface-origins", "origins on what is to be hit",
     "0 times infinity in the slab test (madmann91/bvh#9, #20)"},
    {"interval-ends", "interval ends at a hit",
     "Embree: no guarantees at tnear and tfar (rtcIntersect1.md:57)"},
    {"direction-lengths", "directions of any length",
     "Radiance takes a length below 1e-7 for 0 (raytrace.c:610)"},
    {"secondary-rays", "rays that leave a hit",
     "self-hits and offsets against them (povray#121, mitsuba3 "
     "PR#1871)"},
    {"odd-objects", "host objects that report oddly", "outside what Embree and POV-Ray promise"},
    {"mix", "triangles, spheres, objects together", "-"},
};

enum { TOPICS = sizeof topics / sizeof topics[0] };

static void write_share(FILE *to, size_t wrong, size_t n)
{
    if (n == 0) {
        fprintf(to, "<td class=\"n\">-</td>");
    } else {
        const double share = 100.0 * (double)wrong / (double)n;
        fprintf(to, "<td class=\"n %s\">%zu <small>(%.*f %%)</small></td>",
                wrong > 0 ? "bad" : "good", wrong, share >= 1.0 ? 0 : 2, share);
    }
}

static void write_povray(FILE *to, const struct povray *p)
{
    if (!p->ran) {
        fprintf(to, "<td class=\"n\">-</td>");
        return;
    }
    const size_t wrong = p->lost + p->false_hits + p->off;
    fprintf(to, "<td class=\"n %s\">%zu of %zu", wrong > 0 ? "bad" : "good", wrong, p->asked);
    if (wrong > 0) {
        fprintf(to, "<br/><small>%zu lost, %zu false, %zu off</small>", p->lost, p->false_hits,
                p->off);
    }
    fprintf(to, "</td>");
}

static void write_row(FILE *to, const struct case_row *c)
{
    fprintf(to, "<tr><td><b>%s</b>", c->name);
    if (c->scene != NULL) {
        fprintf(to, " on %s", c->scene);
    }
    fprintf(to, "<br/><small>");
    page_escaped(to, c->meaning);
    fprintf(to, "</small></td><td class=\"n\">%zu<br/><small>%s</small></td>", c->decided,
            judge_names[c->judge]);
    write_share(to, c->fast, c->peers ? c->decided_peer : 0);
    write_share(to, c->robust, c->peers ? c->decided_peer : 0);
    write_share(to, c->robust_single, c->peers ? c->decided_single : 0);
    write_povray(to, &c->povray);
    fprintf(to, "<td class=\"n %s\">%zu</td>", c->wrong > 0 ? "bad" : "good", c->wrong);
    fprintf(to, "<td class=\"n\">%.2f<br/><small>%.1f %s</small></td></tr>\n", c->cost_middle,
            c->cost_worst, c->worst);
}

/* A topic and its cases; nothing where there are none. */
static size_t write_topic(FILE *to, const struct topic *t, const struct case_row *rows,
                          size_t count)
{
    size_t written = 0;
    for (size_t i = 0; i < count; i++) {
        if (strcmp(rows[i].test, t->test) != 0) {
            continue;
        }
        if (written++ == 0) {
            fprintf(to, "<tr><th colspan=\"8\">%s: %s <span class=\"told\">told: ", t->test,
                    t->title);
            page_escaped(to, t->told);
            fprintf(to, "</span></th></tr>\n");
        }
        write_row(to, &rows[i]);
    }
    return written;
}

/* Sums over all cases, for the words above the table. */
typedef struct totals {
    size_t asked, wrong;            /* ours */
    size_t cases, fast, robust;     /* asked of Embree; in how many one answer was wrong */
    size_t povray, povray_wrong;    /* the same of POV-Ray */
    const struct case_row *dearest; /* the most that a case costs us */
} totals;

static totals sum_up(const struct case_row *rows, size_t count)
{
    totals t = {.dearest = rows};
    for (size_t i = 0; i < count; i++) {
        const struct case_row *c = &rows[i];
        t.asked += c->rays * c->forms;
        t.wrong += c->wrong;
        t.cases += c->peers;
        t.fast += c->peers && c->fast > 0;
        t.robust += c->peers && c->robust > 0;
        t.povray += c->povray.ran;
        t.povray_wrong +=
            c->povray.ran && c->povray.lost + c->povray.false_hits + c->povray.off > 0;
        t.dearest = c->cost_worst > t.dearest->cost_worst ? c : t.dearest;
    }
    return t;
}

static bool write_rows(struct reporting *r, const struct case_row *rows, size_t count)
{
    FILE *to = page_value(r, "cases");
    for (size_t i = 0; to != NULL && i < TOPICS; i++) {
        write_topic(to, &topics[i], rows, count);
    }
    return page_value_end(r, to);
}

bool cases_page(struct reporting *r, const struct case_row *rows, size_t count)
{
    const totals t = sum_up(rows, count);
    const char *version = povray_version(r);
    return page_set(r, "cases.asked", "%zu", t.asked) &&
           page_set(r, "cases.wrong", "%zu", t.wrong) && page_set(r, "cases.fast", "%zu", t.fast) &&
           page_set(r, "cases.peers", "%zu", t.cases) &&
           page_set(r, "cases.robust", "%zu", t.robust) &&
           page_set(r, "cases.povray", "%s",
                    version != NULL ? version : "POV-Ray (not installed on this machine)") &&
           page_set(r, "cases.povray.asked", "%zu", t.povray) &&
           page_set(r, "cases.povray.wrong", "%zu", t.povray_wrong) &&
           page_set(r, "cases.dearest", "%s", t.dearest->name) &&
           page_set(r, "cases.dearest.cost", "%.0f", t.dearest->cost_worst) &&
           page_set(r, "cases.dearest.form", "%s", t.dearest->worst) && write_rows(r, rows, count);
}
