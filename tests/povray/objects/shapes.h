/* SPDX-License-Identifier: Apache-2.0
 *
 * Every type of object that POV-Ray 3.7 knows, each about as large as the unit sphere.
 *
 * What is left out, and why: `evaluate` of isosurfaces, as POV-Ray's test of such an object changes
 * it, so that its answers depend on how often it was asked. Functions of hypercomplex
 * julia_fractals are left out where there are lights: their bisection looks at other points than
 * their search (Iteration_HCompl_Func takes y for z), a ray has hundreds of hits on one, a shadow
 * ray takes them one by one, for hours.
 */
#ifndef OBJECTS_SHAPES_H
#define OBJECTS_SHAPES_H

#include "writer.h"

enum shape_trait {
    SHAPE_FINITE = 1, /* all of its surface is within some distance */
    SHAPE_SOLID = 2,  /* and so is what counts as its inside; not of a mesh, which leaks at edges */
    SHAPE_PATCH = 4,  /* POV-Ray takes it for a patch: it may neither clip nor bound */
    SHAPE_STURM = 8,  /* takes `sturm` */
    SHAPE_HIERARCHY = 16, /* takes `hierarchy` */
    SHAPE_LOOSE = 32 /* POV-Ray finds its hits anywhere if it is thin: it may have no bounds then */
};

struct shape {
    const char *name;
    int traits;
    const char *pattern; /* up to the modifiers; NULL: see write */
    void (*write)(struct writer *w);
};

extern const struct shape shapes[];
extern const int shape_count;

/* The shape of that name, or -1. */
int shape_named(const char *name);

/* shapes_made.c: those that no pattern describes. */
void write_poly(struct writer *w);
void write_prism(struct writer *w);
void write_lathe(struct writer *w);
void write_sor(struct writer *w);
void write_sphere_sweep(struct writer *w);
void write_polygon(struct writer *w);
void write_smooth_triangle(struct writer *w);
void write_bicubic_patch(struct writer *w);
void write_mesh(struct writer *w);
void write_mesh_closed(struct writer *w);
void write_mesh2(struct writer *w);
void write_blob(struct writer *w);
void write_blob_negative(struct writer *w);
void write_quadric(struct writer *w);
void write_isosurface(struct writer *w);
void write_julia_fractal(struct writer *w);
void write_text_object(struct writer *w);
void write_ovus(struct writer *w);

#endif
