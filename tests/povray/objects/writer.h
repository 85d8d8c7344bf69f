/* SPDX-License-Identifier: Apache-2.0
 *
 * Writes POV-Ray's scene language with random numbers in it. All that is written is decided by the
 * rng alone; a writer without a file draws the same numbers and writes nothing.
 */
#ifndef OBJECTS_WRITER_H
#define OBJECTS_WRITER_H

#include "rng.h"

#include <stdio.h>

struct writer {
    FILE *out; /* NULL: write nothing */
    struct rng rng;
    int budget; /* shapes that the object may still have */
    bool dark;  /* the scene has no lights */
    int loose;  /* shapes written with SHAPE_LOOSE */
    int thin;   /* objects that were flattened */
};

/* Writes a pattern. Within it,
 *   @p  is a point within 0.8 of the origin along each axis     @s  a number from -1 to 1
 *   @r  a radius from 0.15 to 0.9                               @u  a number from 0 to 1
 *   @d  a direction that is not zero                            @a  a rotation, in degrees
 *   @c  a colour                                                @o  a point near the last @p or @o,
 *                                                               not the same
 * and [text] is written or not, one level deep. */
void write_pattern(struct writer *w, const char *pattern);

/* What follows draws nothing. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void write_text(struct writer *w, const char *format, ...);

void write_number(struct writer *w, double x);
void write_vector(struct writer *w, const double v[3]);

/* Random numbers that are often round, so that faces meet, lines are parallel, terms vanish. */
double draw_number(struct writer *w, double lo, double hi);
void draw_point(struct writer *w, double half_side, double point[3]);
void draw_direction(struct writer *w, double direction[3]);
void draw_rotation(struct writer *w, double degrees[3]);

#endif
