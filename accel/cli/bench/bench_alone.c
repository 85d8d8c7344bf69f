/* SPDX-License-Identifier: Apache-2.0
 *
 * In place of bench_embree.c where Embree is not installed.
 */
#include "bench.h"

size_t bench_peers(struct bench_contender *peers, const accel_scene *scene, double length)
{
    (void)peers;
    (void)scene;
    (void)length;
    return 0;
}

const char *bench_no_peers(void)
{
    return "this build has no peers: libembree-dev was not there when it was configured";
}
