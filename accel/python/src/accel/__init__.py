# SPDX-License-Identifier: Apache-2.0
"""Exact ray-tracing acceleration structures: every kind returns the linear search's bits.

    import accel
    with accel.Scene(vertices, faces) as scene:
        hits = scene.closest(origins, directions)     # fields t, u, v, geom, prim
        shadowed = scene.any(points, to_light, tmax=1, skip=hits)

accel/include/accel/accel.h is the manual of what the answers mean.
"""
from ._arrays import Mesh, Spheres, rays
from ._errors import (ArgumentError, BrokenError, Cancelled, ConfigError, Error, MemoryLimitError,
                      TooLargeError)
from ._library import HIT, ID, NONE, RAY, accel_query as Counts, version as __version__
from ._structure import Accelerator, Scene

__all__ = ["Accelerator", "ArgumentError", "BrokenError", "Cancelled", "ConfigError", "Counts",
           "Error", "HIT", "ID", "MemoryLimitError", "Mesh", "NONE", "RAY", "Scene", "Spheres",
           "TooLargeError", "rays"]
