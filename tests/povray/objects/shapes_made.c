/* SPDX-License-Identifier: Apache-2.0
 *
 * Shapes with a number of points, coefficients or components.
 */
#include "shapes.h"

#include <string.h>

static int draw_count(struct writer *w, int least, int most)
{
    return least + (int)rng_below(&w->rng, (uint32_t)(most - least + 1));
}

static const char *pick(struct writer *w, const char *const *texts, int count)
{
    return texts[rng_below(&w->rng, (uint32_t)count)];
}

#define PICK(w, texts) pick(w, texts, (int)(sizeof(texts) / sizeof(texts)[0]))

static void write_pair(struct writer *w, const double at[2])
{
    write_text(w, ", <%.9g, %.9g>", at[0], at[1]);
}

static void vector_between(const double a[3], const double b[3], double ab[3])
{
    for (int i = 0; i < 3; i++) {
        ab[i] = b[i] - a[i];
    }
}

static void vector_cross(const double a[3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        c[i] = a[j] * b[k] - a[k] * b[j];
    }
}

/* ---- splines ---- */

/* The corners of a closed curve: a star, or anything. */
static void draw_contour(struct writer *w, int count, double at[][2])
{
    const bool star = rng_chance(&w->rng, 0.6);

    for (int i = 0; i < count; i++) {
        const double r = rng_range(&w->rng, 0.2, 1.0);
        const double turn = 6.283185307 * i / count;
        at[i][0] = star ? r * cos(turn) : draw_number(w, -0.9, 0.9);
        at[i][1] = star ? r * sin(turn) : draw_number(w, -0.9, 0.9);
    }
}

static void write_contour_bezier(struct writer *w, int count, double at[][2])
{
    for (int i = 0; i < count; i++) {
        double control[2];
        write_pair(w, at[i]);
        for (int k = 0; k < 2; k++) {
            control[0] = draw_number(w, -1.0, 1.0);
            control[1] = draw_number(w, -1.0, 1.0);
            write_pair(w, control);
        }
        write_pair(w, at[(i + 1) % count]);
    }
}

/* One or two contours, of which splines have each a control point before, cubic ones one after. */
void write_prism(struct writer *w)
{
    static const char *const splines[] = {"linear", "quadratic", "cubic", "bezier"};
    const char *spline = PICK(w, splines);
    const bool conic = rng_chance(&w->rng, 0.35);
    const bool bezier = spline[0] == 'b', before = spline[0] == 'q' || spline[0] == 'c';
    const bool after = spline[0] == 'c';
    const int contours = draw_count(w, 1, 2), count = draw_count(w, 4, 8);
    const double low = conic ? draw_number(w, -0.6, 0.5) : draw_number(w, -0.8, 0.0);
    double at[8][2], control[1][2];

    write_text(w, "prism { %s_spline %s_sweep %.9g, %.9g, %d", spline, conic ? "conic" : "linear",
               low, low + 0.2 + rng_unit(&w->rng),
               contours * (bezier ? 4 * count : count + 1 + before + after));
    for (int k = 0; k < contours; k++) {
        draw_contour(w, count, at);
        if (bezier) {
            write_contour_bezier(w, count, at);
            continue;
        }
        for (int i = -before; i <= count + after; i++) {
            draw_contour(w, 1, control);
            write_pair(w, i < 0 || i > count ? control[0] : at[i % count]);
        }
    }
    write_pattern(w, " [open]");
}

/* Splines leave the points that they go through. */
void write_lathe(struct writer *w)
{
    static const char *const splines[] = {"linear", "quadratic", "cubic", "bezier"};
    const char *spline = PICK(w, splines);
    const bool bezier = spline[0] == 'b', sorted = rng_chance(&w->rng, 0.5);
    const int count = bezier ? 4 * draw_count(w, 1, 3) : draw_count(w, 4, 8);

    write_text(w, "lathe { %s_spline %d", spline, count);
    for (int i = 0; i < count; i++) {
        double at[2];
        at[0] = draw_number(w, 0.0, 1.0);
        at[1] = draw_number(w, -1.0, 1.0);
        at[1] = sorted ? (at[1] + 2.0 * i) / count - 1.0 : at[1];
        write_pair(w, at);
    }
}

void write_sor(struct writer *w)
{
    const int count = draw_count(w, 4, 8);
    double height = -1.0;

    write_text(w, "sor { %d", count);
    for (int i = 0; i < count; i++) {
        const double at[2] = {draw_number(w, 0.0, 1.0), height};
        write_pair(w, at);
        height += rng_range(&w->rng, 0.05, 0.5);
    }
    write_pattern(w, " [open]");
}

void write_sphere_sweep(struct writer *w)
{
    static const char *const splines[] = {"linear_spline", "cubic_spline", "b_spline"};
    const char *spline = PICK(w, splines);
    const int count = draw_count(w, spline[0] == 'l' ? 2 : 4, 7);
    const bool loop = rng_chance(&w->rng, 0.2);

    write_text(w, "sphere_sweep { %s %d", spline, count);
    for (int i = 0; i < count; i++) {
        write_pattern(w, loop ? ", <@s, @s, 0>, 0.1 + @u / 5" : ", @p, 0.5 * @r");
    }
    write_pattern(w, " [tolerance 0.001]");
}

/* ---- patches ---- */

void write_polygon(struct writer *w)
{
    const int contours = draw_count(w, 1, 2), count = draw_count(w, 3, 7);
    const bool flat = rng_chance(&w->rng, 0.5);
    double at[7][2];

    write_text(w, "polygon { %d", contours * (count + 1));
    for (int k = 0; k < contours; k++) {
        draw_contour(w, count, at);
        for (int i = 0; i <= count; i++) {
            const double *p = at[i % count];
            const double v[3] = {p[0], flat ? 0.0 : p[1], flat ? p[1] : 0.0};
            write_text(w, ", ");
            write_vector(w, v);
        }
    }
}

/* Three corners of a triangle that is not too thin, and its normal. */
static void draw_triangle(struct writer *w, double corner[3][3], double normal[3])
{
    double ab[3], ac[3], square;

    do {
        square = 0.0;
        for (int i = 0; i < 3; i++) {
            draw_point(w, 0.9, corner[i]);
        }
        vector_between(corner[0], corner[1], ab);
        vector_between(corner[0], corner[2], ac);
        vector_cross(ab, ac, normal);
        for (int i = 0; i < 3; i++) {
            square += normal[i] * normal[i];
        }
    } while (square < 0.01);
}

static void write_corners(struct writer *w, bool smooth)
{
    double corner[3][3], normal[3], bent[3];

    draw_triangle(w, corner, normal);
    write_text(w, smooth ? "smooth_triangle { " : "triangle { ");
    for (int i = 0; i < 3; i++) {
        write_text(w, i > 0 ? ", " : "");
        write_vector(w, corner[i]);
        draw_point(w, 0.04, bent);
        for (int k = 0; k < 3; k++) {
            bent[k] += normal[k];
        }
        if (smooth) {
            write_text(w, ", ");
            write_vector(w, bent);
        }
    }
}

void write_smooth_triangle(struct writer *w)
{
    write_corners(w, true);
}

void write_bicubic_patch(struct writer *w)
{
    const int type = draw_count(w, 0, 1), u = draw_count(w, 0, 3), v = draw_count(w, 0, 3);

    write_text(w, "bicubic_patch { type %d flatness 0.01 u_steps %d v_steps %d", type, u, v);
    for (int i = 0; i < 16; i++) {
        double at[3];
        draw_point(w, 0.8, at);
        at[0] = 0.6 * (i % 4 - 1.5) + 0.4 * at[0];
        at[2] = 0.6 * ((i - i % 4) / 4 - 1.5) + 0.4 * at[2];
        write_text(w, ", ");
        write_vector(w, at);
    }
}

void write_mesh(struct writer *w)
{
    const int count = draw_count(w, 1, 12);

    write_text(w, "mesh { ");
    for (int i = 0; i < count; i++) {
        write_corners(w, rng_chance(&w->rng, 0.3));
        write_text(w, " } ");
    }
}

/* The six corners of an octahedron, each on its half axis. */
static void draw_octahedron(struct writer *w, double corner[6][3])
{
    for (int i = 0; i < 6; i++) {
        for (int k = 0; k < 3; k++) {
            corner[i][k] = 0.0;
        }
        corner[i][i / 2] = draw_number(w, 0.2, 1.0) * (i % 2 == 0 ? 1.0 : -1.0);
    }
}

static const int octahedron[8][3] = {{0, 2, 4}, {0, 2, 5}, {0, 3, 4}, {0, 3, 5},
                                     {1, 2, 4}, {1, 2, 5}, {1, 3, 4}, {1, 3, 5}};

void write_mesh_closed(struct writer *w)
{
    double corner[6][3];

    draw_octahedron(w, corner);
    write_text(w, "mesh { ");
    for (int f = 0; f < 8; f++) {
        for (int i = 0; i < 3; i++) {
            write_text(w, i == 0 ? "triangle { " : ", ");
            write_vector(w, corner[octahedron[f][i]]);
        }
        write_text(w, " } ");
    }
    write_pattern(w, "inside_vector @d");
}

void write_mesh2(struct writer *w)
{
    double corner[6][3];

    draw_octahedron(w, corner);
    write_text(w, "mesh2 { vertex_vectors { 6");
    for (int i = 0; i < 6; i++) {
        write_text(w, ", ");
        write_vector(w, corner[i]);
    }
    write_text(w, " } ");
    if (rng_chance(&w->rng, 0.3)) {
        write_text(w, "normal_vectors { 6, x, -x, y, -y, z, -z } ");
    }
    write_text(w, "face_indices { 8");
    for (int f = 0; f < 8; f++) {
        write_text(w, ", <%d, %d, %d>", octahedron[f][0], octahedron[f][1], octahedron[f][2]);
    }
    write_pattern(w, " } inside_vector @d");
}

/* ---- by formulas ---- */

void write_ovus(struct writer *w)
{
    const double bottom = draw_number(w, 0.2, 0.7);

    write_text(w, "ovus { %.9g, %.9g", bottom, bottom * rng_range(&w->rng, 0.1, 1.95));
}

static void write_components(struct writer *w, bool negative)
{
    const int count = draw_count(w, 1, 5);

    for (int i = 0; i < count; i++) {
        const bool less = rng_chance(&w->rng, 0.3) != (negative && i == 0);
        write_text(w, " ");
        write_pattern(w, rng_chance(&w->rng, 0.5) ? "sphere { @p, 1.2 * @r, "
                                                  : "cylinder { @p, @o, 0.8 * @r, ");
        write_number(w, rng_range(&w->rng, 0.4, 2.0) * (less ? -1.0 : 1.0));
        write_pattern(w, " [scale <1, 0.5 + @u, 1.3>] [rotate @a] [translate @p / 2] }");
    }
}

void write_blob(struct writer *w)
{
    write_text(w, "blob { threshold %.9g", draw_number(w, 0.1, 0.7));
    write_components(w, false);
}

/* Solid everywhere but around components of negative strength. */
void write_blob_negative(struct writer *w)
{
    write_text(w, "blob { threshold %.9g", -draw_number(w, 0.05, 0.7));
    write_components(w, true);
}

/* Of all kinds: terms are often 0, and often cancel. */
void write_quadric(struct writer *w)
{
    const bool mixed = rng_chance(&w->rng, 0.3);

    write_text(w, "quadric { ");
    for (int i = 0; i < 9; i++) {
        const double x = draw_number(w, -2.0, 2.0), kind = rng_unit(&w->rng);
        const bool zero = kind < 0.25 || (i / 3 == 1 && !mixed);
        const double term = zero ? 0.0 : kind < 0.5 ? (x < 0.0 ? -1.0 : 1.0) : x;
        write_text(w, i % 3 == 0 ? "<%.9g" : ", %.9g", term);
        write_text(w, i % 3 == 2 ? ">, " : "");
    }
    write_number(w, draw_number(w, -1.0, 1.0));
}

/* In each of the three ways to write one down; POV-Ray wants all coefficients in the first two. */
void write_poly(struct writer *w)
{
    const int order = draw_count(w, 2, 5);
    const int terms = (order + 1) * (order + 2) * (order + 3) / 6;
    const char *name = order == 3 ? "cubic" : order == 4 ? "quartic" : "poly";

    if (rng_chance(&w->rng, 0.3)) {
        write_text(w, "polynomial { %d, xyz(%d, 0, 0): 1, xyz(0, %d, 0): 1, xyz(0, 0, %d): 1",
                   order, order, order, order);
        write_pattern(w, ", xyz(1, 1, 0): @s, xyz(0, 0, 1): @s, xyz(0, 0, 0): @u - 1");
        return;
    }
    write_text(w, "%s { ", name);
    if (name[0] == 'p') {
        write_text(w, "%d, ", order);
    }
    write_text(w, "<");
    for (int i = 0; i < terms; i++) {
        const double x = draw_number(w, -1.0, 1.0);
        const bool zero = rng_chance(&w->rng, 0.6) && i < terms - 1;
        write_text(w, i > 0 ? ", %.9g" : "%.9g", zero ? 0.0 : x);
    }
    write_text(w, ">");
}

void write_isosurface(struct writer *w)
{
    static const char *const functions[] = {
        "x * x + y * y * 2 + z * z - @r",
        "abs(x) + abs(y) * 1.3 + abs(z) - 0.9",
        "sin(x * 5) + sin(y * 5) + sin(z * 5) - @s",
        "y - 0.3 * sin(6 * x) * cos(5 * z)",
        "-1 + 0 * x",
        "(sqrt(x * x + z * z) - 0.7) * (sqrt(x * x + z * z) - 0.7) + y * y - 0.1 * @r",
    };

    write_text(w, "isosurface { function { ");
    write_pattern(w, PICK(w, functions));
    write_pattern(w, rng_chance(&w->rng, 0.5) ? " } contained_by { box { @p, @o } }"
                                              : " } contained_by { sphere { @p, @r } }");
    write_text(w, " max_gradient %d", draw_count(w, 2, 9));
    write_pattern(w, " [open] [threshold @s / 4]");
    write_pattern(w, rng_chance(&w->rng, 0.5) ? " [all_intersections]" : " [max_trace 3]");
}

void write_julia_fractal(struct writer *w)
{
    static const char *const kinds[] = {
        "quaternion sqr",   "quaternion cube",  "hypercomplex sqr",      "hypercomplex cube",
        "hypercomplex exp", "hypercomplex sin", "hypercomplex pwr(2, 0)"};
    const int safe = 4, all = sizeof kinds / sizeof kinds[0];
    const char *kind = pick(w, kinds, w->dark ? all : safe);

    write_pattern(w, "julia_fractal { <@s, @s, @s, @s / 5> ");
    write_text(w, "%s max_iteration %d precision 15", kind, draw_count(w, 2, 7));
    write_pattern(w, " [slice <@s, @s, @s, 0.5 + @u>, @s / 3]");
}

void write_text_object(struct writer *w)
{
    static const char *const words[] = {"A", "box", "Ray", "ig", "&"};
    static const char *const fonts[] = {"internal 1", "ttf \"timrom.ttf\"", "ttf \"cyrvetic.ttf\""};
    const char *font = PICK(w, fonts);

    write_text(w, "text { %s \"%s\" ", font, PICK(w, words));
    write_pattern(w, "@r, 0[.1 * x] scale 1.2 translate <-0.7, -0.4, 0>");
}
