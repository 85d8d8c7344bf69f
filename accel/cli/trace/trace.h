/* SPDX-License-Identifier: Apache-2.0
 *
 * Between the parts of accel trace: the image of hits and the text of hits.
 */
#ifndef ACCEL_CLI_TRACE_H
#define ACCEL_CLI_TRACE_H

#include "camera.h"
#include "tool/image.h"
#include "structure.h"

/* A structure, its scene, and how to work. */
struct tracing {
    const accel_scene *scene;
    const accel *structure;
    unsigned threads;
    struct progress progress;
};

/* The geometric normal at a hit, unit length, as the winding of a triangle has it; 0 where a
 * triangle is so thin that it has none. */
void hit_normal(const accel_scene *scene, const accel_ray *ray, const accel_hit *hit,
                double normal[3]);

/* Traces one ray for each pixel into the channels of an image (tool/image.h). Returns false
 * when memory runs out. */
bool trace_image(struct tracing *tracing, const struct camera *camera, struct image *image);

/* The same, as a picture to look at: 3 bytes for each pixel, freed by the caller; NULL when memory
 * runs out. */
unsigned char *trace_picture(struct tracing *tracing, const struct camera *camera);

/* Traces the rays of a file, one for each line, into a text with one line for each. Returns false
 * and fills error->text otherwise. */
bool trace_text(struct tracing *tracing, const char *path, FILE *out, accel_error *error);

#endif
