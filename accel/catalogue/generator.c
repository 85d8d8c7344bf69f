/* SPDX-License-Identifier: Apache-2.0 */
#include "generator.h"

#include <stddef.h>

const struct generator *const generators[] = {
    &generator_cubes, &generator_teapots, &generator_stadium,
    &generator_soup,  &generator_spheres, &generator_nested,
    &generator_same,  &generator_one,     NULL,
};
