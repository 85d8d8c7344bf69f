/* SPDX-License-Identifier: Apache-2.0
 *
 * KIND(name, parts): the kinds, in the order of `accel kinds`, linear first and auto last, and the
 * parts that each is made of, whose files accel/sources.cmake finds, so that a library may be built
 * with only some. A new kind is its file and one line here.
 */
KIND(linear, linear)
KIND(grid, grid)
KIND(hug, hug grid cluster order)
KIND(octree, octree wide)
KIND(hoo, hoo octree cluster order wide)
KIND(bsp, bsp)
KIND(bvh, bvh wide)
KIND(auto, auto)
