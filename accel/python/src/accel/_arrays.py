# SPDX-License-Identifier: Apache-2.0
"""Arrays as the library takes them: as they are where the layout allows, else copied once.

Numbers are taken only where a double holds them exactly; shapes that do not fit are ValueErrors.
"""
import numpy as np

from . import _library as c


def real(name, values, last, dtypes=(np.float64,)):
    """An array of doubles (or of another of dtypes) with a last axis of that length."""
    array = np.asarray(values)
    if array.size == 0 and array.ndim == 1 and not array.dtype.names:
        array = np.empty((0, last))
    if array.ndim == 0 or array.shape[-1] != last:
        raise ValueError(f"{name}: the shape is {array.shape}; allowed is (..., {last})")
    return numbers(name, array, dtypes)


def numbers(name, values, dtypes=(np.float64,)):
    array = np.asarray(values)
    if array.dtype in dtypes and array.dtype.isnative:
        return array
    if array.dtype.kind not in "iuf" or array.dtype.itemsize > 8:
        raise ValueError(f"{name}: the dtype is {array.dtype}; allowed are integers and floats of "
                         "up to 64 bits")
    doubles = array.astype(np.float64)
    if array.dtype.kind in "iu" and array.size and np.abs(doubles).max() > 2.0**53:
        raise ValueError(f"{name}: an integer beyond 2^53, which no double may hold; nothing was "
                         "rounded")
    return doubles


def rows(name, values, width, dtypes=(np.float64,)):
    """(n, width) with rows that lie `strides[0]` bytes apart, as the library's strides say."""
    array = real(name, values, width, dtypes)
    if array.ndim != 2:
        raise ValueError(f"{name}: the shape is {array.shape}; allowed is (n, {width})")
    size = array.dtype.itemsize
    fits = (array.flags.aligned and array.strides[1] == size and array.strides[0] >= width * size
            and array.strides[0] % size == 0)
    if len(array) > c.NONE:
        raise ValueError(f"{name}: {len(array)} rows; allowed are {c.NONE}")
    return array if fits else np.ascontiguousarray(array)


def indices(name, values):
    """(m, 3) indices as uint32, C order."""
    array = np.asarray(values)
    if array.size == 0 and array.ndim == 1:
        array = np.empty((0, 3), np.uint32)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name}: the shape is {array.shape}; allowed is (m, 3)")
    if array.dtype.kind not in "iu":
        raise ValueError(f"{name}: the dtype is {array.dtype}; allowed are integers")
    if array.size and (array.min() < 0 or array.max() > c.NONE):
        raise ValueError(f"{name}: indices from {array.min()} to {array.max()}; allowed are 0 to "
                         f"{c.NONE}")
    if len(array) > c.NONE:
        raise ValueError(f"{name}: {len(array)} rows; allowed are {c.NONE}")
    return np.require(array, np.uint32, ["C", "A"])


class Mesh:
    """Triangles: vertices (n, 3) in double or float, faces (m, 3) of indices."""

    def __init__(self, vertices, faces):
        self.vertices = rows("vertices", vertices, 3, (np.float64, np.float32))
        self.faces = indices("faces", faces)

    def fill(self, geometry):
        v = self.vertices
        geometry.type = c.TRIANGLES
        geometry.triangles = c.accel_triangles(
            v.ctypes.data, v.dtype == np.float32, v.strides[0] if len(v) > 1 else 0, len(v),
            self.faces.ctypes.data, len(self.faces))


class Spheres:
    """Spheres: centres (n, 3) and radii (n,) or one radius; or one array (n, 4), taken as it is."""

    def __init__(self, centres, radii=None):
        if radii is None:
            self.spheres = rows("spheres", centres, 4)
            return
        centres = rows("centres", centres, 3)
        radii = numbers("radii", radii)
        if radii.shape not in ((), (len(centres),)):
            raise ValueError(f"radii: the shape is {radii.shape}; allowed is ({len(centres)},)")
        self.spheres = np.empty((len(centres), 4))
        self.spheres[:, :3], self.spheres[:, 3] = centres, radii

    def fill(self, geometry):
        s = self.spheres
        geometry.type = c.SPHERES
        geometry.spheres = c.accel_spheres(s.ctypes.data, s.strides[0] if len(s) > 1 else 0, len(s))


def rays(origins, directions, tmin=0.0, tmax=np.inf, skip=None):
    """Rays as the library takes them, an array of RAY. Everything is broadcast; skip: hits or ids,
    the primitives that the rays leave."""
    origins, directions = real("origins", origins, 3), real("directions", directions, 3)
    tmin, tmax = numbers("tmin", tmin), numbers("tmax", tmax)
    if skip is not None:
        skip = np.asarray(skip)
        if not {"geom", "prim"} <= set(skip.dtype.names or ()):
            raise ValueError(f"skip: the dtype is {skip.dtype}; allowed are HIT and ID")
    shapes = [origins.shape[:-1], directions.shape[:-1], tmin.shape, tmax.shape,
              () if skip is None else skip.shape]
    try:
        shape = np.broadcast_shapes(*shapes)
    except ValueError:
        raise ValueError("origins, directions, tmin, tmax, skip: the counts are "
                         f"{', '.join(map(str, shapes))}; they have to go together") from None
    out = np.empty(shape, c.RAY)
    out["org"], out["dir"], out["tmin"], out["tmax"] = origins, directions, tmin, tmax
    out["skip_geom"] = c.NONE if skip is None else skip["geom"]
    out["skip_prim"] = c.NONE if skip is None else skip["prim"]
    return out


def take_rays(origins, directions, tmin, tmax, skip):
    """An array of RAY as it is, or one made of its parts."""
    if directions is not None:
        return rays(origins, directions, tmin, tmax, skip)
    if not isinstance(origins, np.ndarray) or origins.dtype != c.RAY:
        raise ValueError("rays: origins without directions have to be an array of dtype RAY")
    if skip is not None or np.any(tmin != 0.0) or np.any(tmax != np.inf):
        raise ValueError("rays: an array of RAY holds its own tmin, tmax and skip")
    return np.require(origins, c.RAY, ["C", "A"])
