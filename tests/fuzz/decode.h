/* SPDX-License-Identifier: Apache-2.0
 *
 * A fuzzer's bytes as a config, a scene and rays. Most numbers lie on a small lattice, a few steps
 * of the last bit beside it, or were there before, so that planes, edges, boxes and ends of
 * intervals coincide all the time; some are any 64 bits.
 */
#ifndef TESTS_FUZZ_DECODE_H
#define TESTS_FUZZ_DECODE_H

#include "case_scene.h"
#include "fuzz.h"

enum { KNOWN = 64, MOST_PRIMITIVES = 200, MOST_PARTS = 8, CONFIG_ROOM = 256 };

struct decoder {
    struct bytes bytes;
    double step, offset; /* of the lattice */
    double number[KNOWN], point[KNOWN][3];
    uint32_t numbers, points; /* how many there were; the last KNOWN are known */
    double dir[3];            /* the last ray's direction */
};

/* A scene as a host has it, in arrays of just the size that they need. */
struct host_scene {
    struct test_scene made;
    void *vertices[MOST_PARTS];
};

struct decoder decode_start(const uint8_t *bytes, size_t size);

/* Any kind with any of its options, within their ranges. */
void decode_config(struct decoder *d, char config[CONFIG_ROOM]);

void decode_scene(struct decoder *d, struct host_scene *s);
void host_scene_free(struct host_scene *s);

/* The next ray, which may go on from the last hit: *last, or NULL. */
accel_ray decode_ray(struct decoder *d, const accel_ray *last_ray, const accel_hit *last);

/* The n-th double above x, or below. */
double step_bits(double x, int n);

#endif
