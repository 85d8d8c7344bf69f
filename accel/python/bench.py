#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Nanoseconds per ray from Python, and beside it C's `accel bench` on the same mesh.

    bench.py MESH.off [KIND] [--command build/accel] [-n RAYS] [--repeats N]

Python's rays are of a kind of their own: from a sphere around the mesh to points of its triangles.
`array` hands over an array of RAY, `parts` origins and directions, which are copied into one;
processor time, medians. So `array` less what C takes is what Python costs, but for the rays'
difference: `one` is the same array asked by a single call of the library.
"""
import argparse
import statistics
import subprocess
import sys
import time

import numpy as np

import accel
from accel import _library


def read_off(path):
    """A mesh of triangles in OFF."""
    with open(path, encoding="ascii") as file:
        words = [line.split("#")[0].split() for line in file]
    words = [word for line in words for word in line]
    if not words or words[0] != "OFF":
        sys.exit(f"bench.py: {path} is no OFF file")
    n, m = int(words[1]), int(words[2])
    vertices = np.array(words[4:4 + 3 * n], np.float64).reshape(n, 3)
    faces = np.array(words[4 + 3 * n:4 + 3 * n + 4 * m], np.int64).reshape(m, 4)
    if np.any(faces[:, 0] != 3):
        sys.exit(f"bench.py: {path} holds other faces than triangles")
    return vertices, faces[:, 1:]


def rays_at(vertices, faces, count):
    random = np.random.default_rng(1)
    middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    radius = np.linalg.norm(vertices - middle, axis=1).max()
    away = random.normal(size=(count, 3))
    origins = middle + 2 * radius * away / np.linalg.norm(away, axis=1)[:, None]
    targets = vertices[faces[random.integers(0, len(faces), count)]].mean(axis=1)
    return origins, targets - origins


def nanoseconds(query, count, repeats):
    times = []
    for _ in range(repeats):
        start = time.process_time_ns()
        query()
        times.append((time.process_time_ns() - start) / count)
    return statistics.median(times)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("mesh")
    parser.add_argument("kind", nargs="?", default="bvh")
    parser.add_argument("--command", help="the accel command, for C's times")
    parser.add_argument("-n", "--count", type=int, default=100000)
    parser.add_argument("--repeats", type=int, default=5)
    a = parser.parse_args()
    vertices, faces = read_off(a.mesh)
    origins, directions = rays_at(vertices, faces, a.count)
    rays = accel.rays(origins, directions)
    hits = np.empty(len(rays), accel.HIT)
    with accel.Scene(vertices, faces, config=a.kind) as scene:
        def one():
            _library.library.accel_closest_n(scene._handle, rays.ctypes.data, hits.ctypes.data,
                                             len(rays), None)

        for name, query in (("closest, one", one),
                            ("closest, array", lambda: scene.closest(rays)),
                            ("closest, parts", lambda: scene.closest(origins, directions)),
                            ("any, array", lambda: scene.any(rays)),
                            ("any, parts", lambda: scene.any(origins, directions))):
            print(f"{name:16}{nanoseconds(query, a.count, a.repeats):9.1f} ns a ray")
    if a.command:
        sys.stdout.flush()
        subprocess.run([a.command, "bench", a.mesh, "-a", a.kind, "--batch", "-q", "-n",
                        str(a.count), "--repeats", str(a.repeats)], check=True)


if __name__ == "__main__":
    main()
