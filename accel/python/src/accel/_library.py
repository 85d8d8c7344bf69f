# SPDX-License-Identifier: Apache-2.0
"""libaccel.so by ctypes: where it is found, its structures as accel.h declares them.

Calls through ctypes release the interpreter's lock, so threads query at the same time. That the
layouts are the compiler's is checked by tests/python/layout.c, field by field.
"""
import ctypes
import ctypes.util
import os
import pathlib
from ctypes import (CFUNCTYPE, POINTER, Structure, Union, c_bool, c_char, c_char_p, c_double, c_int,
                    c_size_t, c_uint, c_uint32, c_uint64, c_void_p)

import numpy as np

VERSION = (0, 1)  # of the header that this file follows
NONE = 0xFFFFFFFF
TRIANGLES, SPHERES = 0, 1
(OK, BAD_ARGUMENT, BAD_CONFIG, NO_MEMORY, TOO_LARGE, CANCELLED, BROKEN) = range(7)

# Arrays of rays and hits are handed over as they are.
RAY = np.dtype([("org", np.float64, 3), ("dir", np.float64, 3), ("tmin", np.float64),
                ("tmax", np.float64), ("skip_geom", np.uint32), ("skip_prim", np.uint32)])
HIT = np.dtype([("t", np.float64), ("u", np.float64), ("v", np.float64), ("geom", np.uint32),
                ("prim", np.uint32)])
ID = np.dtype([("geom", np.uint32), ("prim", np.uint32)])


class accel_error(Structure):
    _fields_ = [("status", c_int), ("text", c_char * 500)]


class accel_triangles(Structure):
    _fields_ = [("vertices", c_void_p), ("vertices_are_float", c_bool), ("vertex_stride", c_size_t),
                ("vertex_count", c_uint32), ("indices", c_void_p), ("count", c_uint32)]


class accel_spheres(Structure):
    _fields_ = [("spheres", c_void_p), ("stride", c_size_t), ("count", c_uint32)]


class accel_objects(Structure):  # not offered here, but it makes the union as large as it is
    _fields_ = [("boxes", c_void_p), ("count", c_uint32), ("order", c_int), ("intersect", c_void_p),
                ("user", c_void_p), ("cost", c_double)]


class _Shape(Union):
    _fields_ = [("triangles", accel_triangles), ("spheres", accel_spheres),
                ("objects", accel_objects)]


class accel_geometry(Structure):
    _anonymous_ = ["shape"]
    _fields_ = [("type", c_int), ("shape", _Shape)]


class accel_scene(Structure):
    _fields_ = [("geometries", POINTER(accel_geometry)), ("count", c_uint32)]


PROGRESS = CFUNCTYPE(c_bool, c_void_p, c_char_p, c_double)
VISIT_HIT = CFUNCTYPE(c_bool, c_void_p, c_void_p)


class accel_hooks(Structure):
    _fields_ = [("user", c_void_p), ("resize", c_void_p), ("progress", PROGRESS),
                ("pilot", c_void_p), ("pilot_count", c_size_t), ("memory_limit", c_size_t),
                ("threads", c_uint)]


class accel_id(Structure):
    _fields_ = [("geom", c_uint32), ("prim", c_uint32)]


VISIT_ID = CFUNCTYPE(c_bool, c_void_p, accel_id)


class accel_query(Structure):
    """Counts of what queries did, added up; one per thread."""
    _fields_ = [("user", c_void_p), ("nodes", c_uint64), ("tests", c_uint64),
                ("refused", c_uint64), ("outside", c_uint64)]


class accel_phase(Structure):
    _fields_ = [("name", c_char_p), ("seconds", c_double)]


class accel_left_out(Structure):
    _fields_ = [("what", c_char * 112), ("bytes", c_uint64), ("seconds", c_double)]


class accel_info(Structure):
    _fields_ = [("kind", c_char_p), ("config", c_char * 256), ("primitives", c_uint64),
                ("skipped", c_uint64), ("degenerate", c_uint64), ("unbounded", c_uint64),
                ("skipped_ids", accel_id * 10), ("size_classes", c_uint32),
                ("clusters", c_uint32), ("nodes", c_uint64), ("leaves", c_uint64),
                ("references", c_uint64), ("depth", c_uint32), ("bytes", c_uint64),
                ("peak_bytes", c_uint64), ("unbuilt_clusters", c_uint32),
                ("unbuilt_primitives", c_uint64), ("lazy_bytes", c_uint64),
                ("seconds", c_double), ("phase_count", c_uint32), ("phases", accel_phase * 8),
                ("left_out_count", c_uint32), ("left_out", accel_left_out * 8),
                ("note_count", c_uint32), ("notes", (c_char * 160) * 12)]


def _declare(library):
    structure, error = c_void_p, POINTER(accel_error)
    query = POINTER(accel_query)
    for name, result, arguments in (
            ("accel_version", c_char_p, []),
            ("accel_build", c_int, [POINTER(structure), POINTER(accel_scene), c_char_p,
                                    POINTER(accel_hooks), error]),
            ("accel_free", None, [structure]),
            ("accel_closest_n", c_size_t, [structure, c_void_p, c_void_p, c_size_t, query]),
            ("accel_any_n", c_size_t, [structure, c_void_p, c_void_p, c_size_t, query]),
            ("accel_all", c_bool, [structure, c_void_p, VISIT_HIT, c_void_p, query]),
            ("accel_point", c_bool, [structure, c_void_p, VISIT_ID, c_void_p, query]),
            ("accel_describe", None, [structure, POINTER(accel_info)]),
            ("accel_validate", c_int, [structure, error])):
        function = getattr(library, name)
        function.restype, function.argtypes = result, arguments


def load():
    """The library: ACCEL_LIBRARY's, else the package's own, else the system's."""
    bundled = pathlib.Path(__file__).with_name("libaccel.so")
    path = os.environ.get("ACCEL_LIBRARY")
    if not path:
        path = str(bundled) if bundled.exists() else ctypes.util.find_library("accel")
    if not path:
        raise ImportError("accel: no libaccel.so: neither in the package nor the system's, and "
                          "ACCEL_LIBRARY is not set; `pip install ./accel/python` compiles one")
    try:
        library = ctypes.CDLL(path)
        _declare(library)
    except (OSError, AttributeError) as trouble:
        raise ImportError(f"accel: {path} cannot be used: {trouble}") from trouble
    version = library.accel_version().decode()
    if tuple(int(n) for n in version.split(".")[:2]) != VERSION:
        raise ImportError(f"accel: {path} is version {version}; this package needs "
                          f"{VERSION[0]}.{VERSION[1]}")
    return library, version


library, version = load()
