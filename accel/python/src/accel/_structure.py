# SPDX-License-Identifier: Apache-2.0
"""A structure and its queries.

It is freed by close(), at the end of a `with`, or with the object; a query that is under way in
another thread then ends first: the last one frees.
"""
import contextlib
import ctypes
import threading
import weakref

import numpy as np

from . import _library as c
from ._arrays import Mesh, Spheres, rays as make_rays, real, take_rays
from ._errors import check

_CHUNK = 1 << 16  # rays between two looks at signals


def _geometry(value):
    if isinstance(value, (Mesh, Spheres)):
        return value
    if hasattr(value, "vertices") and hasattr(value, "faces"):  # such as trimesh.Trimesh
        return Mesh(value.vertices, value.faces)
    raise ValueError(f"{type(value).__name__} is no geometry; allowed are Mesh, Spheres, and what "
                     "has vertices and faces")


class _Watched:
    """A callback whose exception ends the call of the library, and goes on after it."""

    def __init__(self, prototype, function):
        self.trouble = None
        self.function = function
        self.callback = prototype(self._call)

    def _call(self, *arguments):
        try:
            return self.function(*arguments)
        except BaseException as trouble:  # KeyboardInterrupt among them
            self.trouble = trouble
            return False

    def end(self):
        if self.trouble is not None:
            raise self.trouble


def _build(geometries, config, memory_limit, threads, pilot, progress):
    if not isinstance(config, str) or "\0" in config:
        raise ValueError(f"config: {config!r} is no string without NUL")
    if memory_limit < 0 or threads < 0:
        raise ValueError("memory_limit and threads are not negative")
    array = (c.accel_geometry * max(1, len(geometries)))()
    for slot, geometry in zip(array, geometries):
        geometry.fill(slot)

    # Also without a `progress`: it lets Ctrl-C in.
    def step(_, phase, done):
        return progress is None or progress(phase.decode(), done) is not False

    watched = _Watched(c.PROGRESS, step)
    hooks = c.accel_hooks(progress=watched.callback, memory_limit=memory_limit, threads=threads)
    if pilot is not None:
        pilot = take_rays(pilot, None, 0.0, np.inf, None)
        hooks.pilot, hooks.pilot_count = pilot.ctypes.data, pilot.size
    handle, error = ctypes.c_void_p(), c.accel_error()
    status = c.library.accel_build(ctypes.byref(handle), c.accel_scene(array, len(geometries)),
                                   config.encode(), hooks, ctypes.byref(error))
    if watched.trouble is not None and handle.value:
        c.library.accel_free(handle)
    watched.end()
    check(status, error)
    return handle.value


class Accelerator:
    """A structure over geometries: Mesh, Spheres, or what has vertices and faces.

    config: "auto", "bvh", "hoo:leaf=8", ...: `accel kinds` lists them. memory_limit: bytes, 0: no
    limit. threads: of the build, 0: one for each processor. pilot: first rays (RAY) for auto.
    progress(phase, done) returns False to cancel. counts: of queries, an accel.Counts each thread.
    """

    def __init__(self, *geometries, config="auto", memory_limit=0, threads=0, pilot=None,
                 progress=None):
        self._lock, self._running, self._closed = threading.Lock(), 0, False
        self._geometries = len(geometries)
        handle = _build([_geometry(g) for g in geometries], config, memory_limit, threads, pilot,
                        progress)
        self._handle = handle
        self._free = weakref.finalize(self, c.library.accel_free, handle)
        self._free.atexit = False  # threads may still query then

    def close(self):
        """Frees the structure; once the queries under way in other threads have ended."""
        with self._lock:
            self._closed = True
            if self._running == 0:
                self._free()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    @contextlib.contextmanager
    def _open(self):
        with self._lock:
            if self._closed:
                raise ValueError("the accelerator is closed")
            self._running += 1
        try:
            yield self._handle
        finally:
            with self._lock:
                self._running -= 1
                if self._closed and self._running == 0:
                    self._free()

    def _batch(self, function, rays, out, counts):
        with self._open() as handle:
            for start in range(0, rays.size, _CHUNK):
                function(handle, rays.ctypes.data + start * rays.itemsize,
                         out.ctypes.data + start * out.itemsize,
                         min(_CHUNK, rays.size - start), counts)
        return out

    def closest(self, origins, directions=None, tmin=0.0, tmax=np.inf, skip=None, counts=None):
        """The nearest hit of each ray, an array of HIT; a miss has t = inf and geom = prim = NONE.

        An array of RAY alone is taken as it is. Origins and directions are broadcast: one origin
        serves many directions."""
        rays = take_rays(origins, directions, tmin, tmax, skip)
        hits = np.zeros(rays.shape, c.HIT)  # u, v of a miss: accel.h promises nothing
        return self._batch(c.library.accel_closest_n, rays, hits, counts)

    def any(self, origins, directions=None, tmin=0.0, tmax=np.inf, skip=None, counts=None):
        """Whether each ray hits anything, an array of bool."""
        rays = take_rays(origins, directions, tmin, tmax, skip)
        return self._batch(c.library.accel_any_n, rays, np.zeros(rays.shape, np.bool_), counts)

    def _gather(self, function, prototype, visit, items):
        ends = []
        watched = _Watched(prototype, visit[0])
        with self._open() as handle:
            for i in range(items.size if items.dtype.names else items.size // 3):
                step = items.itemsize if items.dtype.names else 24
                function(handle, items.ctypes.data + i * step, watched.callback, None, visit[2])
                watched.end()
                ends.append(len(visit[1]))
        return ends

    def all(self, origins, directions=None, tmin=0.0, tmax=np.inf, skip=None, counts=None):
        """Every hit of every ray, in order of the rays and of (t, geom, prim): the hits, and for
        each the index of its ray. About a microsecond a hit, which come one by one."""
        rays, found = take_rays(origins, directions, tmin, tmax, skip), bytearray()

        def visit(_, hit):
            found.extend(ctypes.string_at(hit, c.HIT.itemsize))
            return True

        ends = self._gather(c.library.accel_all, c.VISIT_HIT, (visit, found, counts), rays)
        return np.frombuffer(found, c.HIT), _owners(ends, c.HIT.itemsize)

    def points(self, points, counts=None):
        """The primitives whose padded boxes hold each point, in order of the points and of (geom,
        prim): their ids, and for each the index of its point."""
        array, found = np.ascontiguousarray(real("points", points, 3)), []

        def visit(_, name):
            found.append((name.geom, name.prim))
            return True

        ends = self._gather(c.library.accel_point, c.VISIT_ID, (visit, found, counts), array)
        return np.array(found, c.ID), _owners(ends, 1)

    def describe(self):
        """What was built, as accel_info in accel.h says, in a dict."""
        info = c.accel_info()
        with self._open() as handle:
            c.library.accel_describe(handle, ctypes.byref(info))
            return _described(info)

    def validate(self):
        """Checks every invariant of the structure: BrokenError if memory was overwritten."""
        error = c.accel_error()
        with self._open() as handle:
            check(c.library.accel_validate(handle, ctypes.byref(error)), error)


def _owners(ends, size):
    counts = np.diff(np.array([0] + ends, np.int64)) // size
    return np.repeat(np.arange(len(ends)), counts)


def _described(info):
    out = {}
    for name, _ in info._fields_:
        value = getattr(info, name)
        if isinstance(value, (int, float)) and not name.endswith("_count"):
            out[name] = value
        elif isinstance(value, bytes):
            out[name] = value.decode("utf-8", "replace")
    out["skipped_ids"] = [(i.geom, i.prim) for i in info.skipped_ids[:min(info.skipped, 10)]]
    out["phases"] = {p.name.decode(): p.seconds for p in info.phases[:info.phase_count]}
    out["left_out"] = [{"what": p.what.decode("utf-8", "replace"), "bytes": p.bytes,
                        "seconds": p.seconds} for p in info.left_out[:info.left_out_count]]
    out["notes"] = [n.value.decode("utf-8", "replace") for n in info.notes[:info.note_count]]
    return out


class Scene(Accelerator):
    """One mesh, with the queries of trimesh's ray objects besides: ray_origins and ray_directions
    are (n, 3), triangles and rays are named by their index."""

    def __init__(self, vertices, faces, **options):
        super().__init__(Mesh(vertices, faces), **options)

    def intersects_first(self, ray_origins, ray_directions):
        """The triangle that each ray hits first, -1 for none."""
        hits = self.closest(ray_origins, ray_directions)
        return np.where(hits["prim"] == c.NONE, -1, hits["prim"].astype(np.int64))

    def intersects_any(self, ray_origins, ray_directions):
        """Whether each ray hits."""
        return self.any(ray_origins, ray_directions)

    def intersects_location(self, ray_origins, ray_directions, multiple_hits=True):
        """Where rays hit: (h, 3) locations, the index of the ray and of the triangle of each."""
        rays = np.atleast_1d(make_rays(ray_origins, ray_directions)).ravel()
        if multiple_hits:
            hits, index = self.all(rays)
        else:
            hits = self.closest(rays)
            index = np.flatnonzero(hits["prim"] != c.NONE)
            hits = hits[index]
        where = rays["org"][index] + hits["t"][:, None] * rays["dir"][index]
        return where, index, hits["prim"].astype(np.int64)
