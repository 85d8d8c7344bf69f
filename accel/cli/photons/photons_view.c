/* SPDX-License-Identifier: Apache-2.0 */
#include "photons_view.h"

#include "photons_surface.h"
#include "tool/words.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool view_make(struct view *view, const accel *a, const accel_scene *scene,
               const struct camera *camera)
{
    const size_t pixels = (size_t)camera->width * camera->height;
    *view = (struct view){.width = camera->width,
                          .height = camera->height,
                          .receivers = malloc(pixels * sizeof(struct receiver)),
                          .pixels = malloc(pixels * sizeof(uint32_t))};
    if (view->receivers == NULL || view->pixels == NULL) {
        view_free(view);
        return false;
    }
    for (size_t i = 0; i < pixels; i++) {
        const accel_ray ray =
            camera_ray(camera, (double)(i % camera->width), (double)(i / camera->width));
        accel_hit hit;
        if (accel_closest(a, &ray, &hit, NULL)) {
            const struct surface surface = surface_at(scene, &ray, &hit);
            struct receiver *receiver = &view->receivers[view->count];
            memcpy(receiver->at, surface.at, sizeof receiver->at);
            memcpy(receiver->normal, surface.normal, sizeof receiver->normal);
            view->pixels[view->count++] = (uint32_t)i;
        }
    }
    return true;
}

void view_free(struct view *view)
{
    free(view->receivers);
    free(view->pixels);
    *view = (struct view){.count = 0};
}

static bool write_exr(const struct view *view, const double *irradiance, struct output *output,
                      accel_error *error)
{
    static const char *const names[] = {"Y", NULL};
    struct image image;
    if (!image_make(&image, view->width, view->height, names)) {
        snprintf(error->text, sizeof error->text, "out of memory; nothing was written");
        return false;
    }
    for (size_t i = 0; i < view->count; i++) {
        const float narrow = (float)irradiance[i];
        memcpy(&image.channels[0].bits[view->pixels[i]], &narrow, sizeof narrow);
    }
    const bool fine = image_write_exr(&image, output, error);
    image_free(&image);
    return fine;
}

/* 0..1 linear to 0..255 by the curve of sRGB. */
static unsigned char gray(double linear)
{
    const double curved =
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
    return (unsigned char)(255.0 * curved + 0.5);
}

static bool write_png(const struct view *view, const double *irradiance, struct output *output,
                      accel_error *error)
{
    unsigned char *pixels = calloc((size_t)view->width * view->height, 3);
    if (pixels == NULL) {
        snprintf(error->text, sizeof error->text, "out of memory; nothing was written");
        return false;
    }
    double mean = 0.0;
    for (size_t i = 0; i < view->count; i++) {
        mean += irradiance[i] / (double)view->count;
    }
    for (size_t i = 0; i < view->count; i++) {
        const double part = mean > 0.0 ? irradiance[i] / mean : 0.0;
        memset(pixels + 3 * (size_t)view->pixels[i], gray(1.0 - exp(-part)), 3);
    }
    const bool fine = png_write(pixels, view->width, view->height, output, error);
    free(pixels);
    return fine;
}

bool view_write(const struct view *view, const double *irradiance, struct output *output,
                accel_error *error)
{
    return ends_with(output->path, ".png") ? write_png(view, irradiance, output, error)
                                           : write_exr(view, irradiance, output, error);
}
