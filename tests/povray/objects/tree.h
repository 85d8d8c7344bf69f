/* SPDX-License-Identifier: Apache-2.0
 *
 * Objects made of shapes: CSG, transforms, clips, bounds, `inverse`, copies, and what is known of
 * how far they reach.
 */
#ifndef OBJECTS_TREE_H
#define OBJECTS_TREE_H

#include "writer.h"

/* Which sets of points are known to be bounded. */
struct extent {
    bool surface, inside, outside;
};

/* Of an object, and of what `inverse` makes of it: POV-Ray turns a union into an intersection of
 * inverted parts, an intersection into a merge, and leaves clips as they are. */
struct reach {
    struct extent own, inverse;
    bool clipped, bounded, linked; /* linked: clipped_by and bounded_by are one */
    int unbounded_parts;           /* of a union that POV-Ray takes apart: parts without bounds */
    bool takes_apart;
};

/* How many times each shape was written, in the order of shapes[]. */
extern int written_shapes[];

/* Writes an object with CSG up to that depth, of which one shape is `wanted` (-1: any), up to its
 * closing brace, which is left out. A plain one may clip and bound: it has no texture, no patch. */
struct reach write_tree(struct writer *w, int depth, int wanted, bool plain);

/* Some more modifiers. */
void write_modifiers(struct writer *w, struct reach *reach, int depth);

/* What POV-Ray's scene holds of it: how many objects without bounds at most. */
int unbounded_objects(const struct reach *reach);

#endif
