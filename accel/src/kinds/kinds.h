/* SPDX-License-Identifier: Apache-2.0
 *
 * KIND(name, parts): the kinds, in the order of `accel kinds`, linear first and auto last, and the
 * folders that each is made of besides core and primitive, so that a library may be built with only
 * some (accel/sources.cmake). A new kind is its file in this folder and one line here.
 */
KIND(linear, )
KIND(grid, grid)
KIND(hug, hug grid cluster)
KIND(octree, octree wide)
KIND(hoo, hoo octree cluster wide)
KIND(bsp, bsp)
KIND(bvh, wide)
KIND(auto, auto)
