/* SPDX-License-Identifier: Apache-2.0
 *
 * A camera as a user types it: --size WxH and --camera E:A:F.
 */
#ifndef ACCEL_CLI_CAMERA_ARGUMENT_H
#define ACCEL_CLI_CAMERA_ARGUMENT_H

#include "camera.h"
#include "tool/options.h"
#include "scenes/scene.h"

/* Makes the camera; NULL stands for 640x480, and for one that frames the scene with 40 degrees.
 * Otherwise complains and returns false. */
bool camera_argument(const struct command *command, const char *size, const char *text,
                     const accel_scene *scene, struct camera *camera);

#endif
