/* SPDX-License-Identifier: Apache-2.0
 *
 * Scenes of triangles as text in POV-Ray's scene description language: see sdl.c.
 */
#ifndef ACCEL_CLI_SDL_H
#define ACCEL_CLI_SDL_H

#include "scenes/scene.h"

#include <stdio.h>

/* The forms in which a scene can be written. */
enum sdl_form {
    SDL_MESH2 = 0, /* an array Geometry of mesh2 objects */
    SDL_TRIANGLES  /* arrays Corners and First */
};

/* Says whether `scene` can be written in `form`; otherwise fills error->text with one line. */
bool sdl_fits(const accel_scene *scene, enum sdl_form form, accel_error *error);

/* How many triangles have corners at three places, but as float no more than two. */
uint64_t sdl_lost_as_float(const accel_scene *scene);

/* Writes `scene`, which must fit. Returns false where memory runs out; errors of the file stay in
 * the file, for ferror. */
bool sdl_write(FILE *file, const accel_scene *scene, enum sdl_form form);

#endif
