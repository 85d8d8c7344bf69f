/* SPDX-License-Identifier: Apache-2.0 */
#include "camera_argument.h"

#include "tool/image.h"
#include "tool/words.h"

#include <string.h>

static bool read_camera(const char *text, double eye[3], double at[3], double *fov)
{
    const char *first = strchr(text, ':');
    const char *second = first == NULL ? NULL : strchr(first + 1, ':');
    return second != NULL && read_numbers(text, (size_t)(first - text), eye, 3) &&
           read_numbers(first + 1, (size_t)(second - first - 1), at, 3) &&
           read_number(second + 1, strlen(second + 1), fov);
}

static bool read_size(const char *text, uint32_t *width, uint32_t *height)
{
    double w, h;
    const char *x = strchr(text, 'x');
    if (x == NULL || !read_number(text, (size_t)(x - text), &w) ||
        !read_number(x + 1, strlen(x + 1), &h) || w != floor(w) || h != floor(h) || w < 1.0 ||
        h < 1.0 || w > 65536.0 || h > 65536.0 || w * h > MOST_PIXELS) {
        return false;
    }
    *width = (uint32_t)w;
    *height = (uint32_t)h;
    return true;
}

bool camera_argument(const struct command *command, const char *size, const char *text,
                     const accel_scene *scene, struct camera *camera)
{
    uint32_t width = 640, height = 480;
    double eye[3], at[3], fov = 40.0;
    if (size != NULL && !read_size(size, &width, &height)) {
        complain(command,
                 "--size is '%.60s'; allowed is WxH, up to 65536 each and 2^26 pixels; "
                 "nothing was written",
                 size);
        return false;
    }
    accel_box box;
    scene_box(scene, &box);
    camera_frame(&box, eye, at);
    if ((text != NULL && !read_camera(text, eye, at, &fov)) ||
        !camera_make(camera, eye, at, fov, width, height)) {
        complain(command,
                 "camera '%.100s' is no camera; allowed is ex,ey,ez:ax,ay,az:degrees, two "
                 "points that differ and degrees between 0 and 180; nothing was written",
                 text == NULL ? "(default)" : text);
        return false;
    }
    return true;
}
