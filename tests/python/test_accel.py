# SPDX-License-Identifier: Apache-2.0
"""The installed Python package: `ctest -L python`, which runs install.sh.

Answers are judged by linear search, by the command, and by numpy; layouts by a C program.
"""
import gc
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest

import numpy as np

import accel
from accel import _library

KINDS = ("bvh", "octree", "hoo", "grid", "bsp", "auto")
VERTICES = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], float)
FACES = np.array([[0, 1, 2]], np.uint32)


def soup(count, size=0.1, seed=1):
    """Triangles whose corners share no vertex, about the unit box."""
    random = np.random.default_rng(seed)
    middle = random.uniform(0, 1, (count, 1, 3))
    vertices = (middle + random.uniform(-size, size, (count, 3, 3))).reshape(-1, 3)
    return vertices, np.arange(3 * count).reshape(-1, 3)


def directed(count, seed=2):
    random = np.random.default_rng(seed)
    return random.uniform(-0.5, 1.5, (count, 3)), random.normal(size=(count, 3))


def run(code, **environment):
    return subprocess.run([sys.executable, "-c", code], env={**os.environ, **environment},
                          capture_output=True, text=True)


class Layout(unittest.TestCase):
    def setUp(self):
        text = subprocess.run([os.environ["ACCEL_TEST_LAYOUT"]], check=True, capture_output=True,
                              text=True).stdout
        self.lines = {line.split()[0]: [int(n) for n in line.split()[1:]]
                      for line in text.splitlines()}

    def of_structure(self, name):
        """Its size and fields as ctypes or numpy has them, in the program's words."""
        dtypes = {"accel_ray": accel.RAY, "accel_hit": accel.HIT}
        if name in dtypes:
            dtype = dtypes[name]
            found = {f"{name}.{field.replace('skip_', 'skip.')}": [at, kind.itemsize]
                     for field, (kind, at) in dtype.fields.items()}
            return {name: [dtype.itemsize], **found}
        structure = getattr(_library, name)
        fields = [field for field, _ in structure._fields_]
        if name == "accel_geometry":
            fields = ["type", "triangles", "spheres"]
        found = {f"{name}.{field}": [getattr(structure, field).offset,
                                     getattr(structure, field).size] for field in fields}
        return {name: [_library.ctypes.sizeof(structure)], **found}

    def test_structures(self):
        names = [name for name in self.lines if name.startswith("accel_") and "." not in name]
        self.assertEqual(len(names), 11)
        for name in names:
            expected = {key: value for key, value in self.lines.items()
                        if key.split(".")[0] == name}
            self.assertEqual(self.of_structure(name), expected)
        self.assertEqual(accel.ID.itemsize, self.lines["accel_id"][0])

    def test_constants(self):
        c = _library
        self.assertEqual(self.lines["statuses"], [c.OK, c.BAD_ARGUMENT, c.BAD_CONFIG, c.NO_MEMORY,
                                                  c.TOO_LARGE, c.CANCELLED, c.BROKEN])
        self.assertEqual(self.lines["types"], [c.TRIANGLES, c.SPHERES])
        self.assertEqual(self.lines["version"], list(c.VERSION))


class Answers(unittest.TestCase):
    def test_kinds_give_the_bits_of_linear(self):
        vertices, faces = soup(500)
        spheres = np.random.default_rng(3).uniform(0.01, 0.2, (50, 4))
        scene = accel.Mesh(vertices, faces), accel.Spheres(spheres[:, :3], spheres[:, 3])
        origins, directions = directed(2000)
        with accel.Accelerator(*scene, config="linear") as linear:
            hits = linear.closest(origins, directions)
            self.assertGreater(np.count_nonzero(hits["geom"] == 0), 100)
            self.assertGreater(np.count_nonzero(hits["geom"] == 1), 10)
            self.assertGreater(np.count_nonzero(hits["geom"] == accel.NONE), 100)
            found = linear.all(origins[:200], directions[:200])
        for kind in KINDS:
            with self.subTest(kind), accel.Accelerator(*scene, config=kind) as a:
                a.validate()
                self.assertEqual(a.closest(origins, directions).tobytes(), hits.tobytes())
                np.testing.assert_array_equal(a.any(origins, directions), hits["t"] < np.inf)
                for mine, its in zip(a.all(origins[:200], directions[:200]), found):
                    self.assertEqual(mine.tobytes(), its.tobytes())

    def test_the_command_gives_the_same(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            vertices, faces = soup(300)
            origins, directions = directed(500)
            rays = accel.rays(origins, directions, -0.25, 3.5)
            mesh = "".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in vertices.tolist())
            mesh += "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in faces.tolist())
            (folder / "mesh.obj").write_text(mesh)
            (folder / "rays.txt").write_text("".join(
                " ".join(repr(x) for x in [*r["org"].tolist(), *r["dir"].tolist(),
                                           float(r["tmin"]), float(r["tmax"])]) + "\n"
                for r in rays))
            subprocess.run([os.environ["ACCEL_TEST_COMMAND"], "trace", folder / "mesh.obj", "-q",
                            "--rays", folder / "rays.txt", "-o", folder / "hits.txt"], check=True)
            with accel.Scene(vertices, faces) as scene:
                hits = scene.closest(rays)
            lines = (folder / "hits.txt").read_text().splitlines()
            self.assertEqual(len(lines), len(hits))
            self.assertGreater(lines.count("miss"), 10)
            self.assertLess(lines.count("miss"), 490)
            for line, hit in zip(lines, hits):
                mine = (int(hit["geom"]), int(hit["prim"]), *map(float, (hit["t"], hit["u"],
                                                                       hit["v"])))
                if line == "miss":
                    self.assertEqual(mine[:3], (accel.NONE, accel.NONE, np.inf))
                else:
                    words = line.split()
                    self.assertEqual(mine, (*map(int, words[:2]), *map(float, words[2:])))

    def test_all_against_numpy(self):
        vertices, faces = soup(400, 0.5)
        origins, directions = directed(100)
        a, b, c = (vertices[faces[:, k]] for k in range(3))
        with accel.Scene(vertices, faces) as scene:
            hits, index = scene.all(origins, directions)
            where, rays, triangles = scene.intersects_location(origins, directions)
        self.assertGreater(len(hits), 200)
        np.testing.assert_array_equal(rays, index)
        np.testing.assert_array_equal(triangles, hits["prim"])
        for i, (o, d) in enumerate(zip(origins, directions)):
            p = np.cross(d, c - a)
            scale = np.einsum("ij,ij->i", p, b - a)
            q = np.cross(o - a, b - a)
            u, v = np.einsum("ij,ij->i", o - a, p) / scale, q @ d / scale
            t = np.einsum("ij,ij->i", c - a, q) / scale
            inside = np.minimum(np.minimum(u, v), 1 - u - v)
            self.assertTrue(np.all(np.abs(inside) > 1e-11), "rays at an edge decide nothing")
            mine = hits[index == i]
            inside = np.flatnonzero((inside > 0) & (t > 0))
            np.testing.assert_array_equal(mine["prim"], inside[np.argsort(t[inside])])
            np.testing.assert_allclose(mine["t"], np.sort(t[inside]), rtol=1e-9, atol=1e-12)
            np.testing.assert_allclose(where[index == i], o + mine["t"][:, None] * d)

    def test_many_rays(self):
        rays = accel.rays(*directed(150000))
        with accel.Scene(*soup(50)) as scene:
            hits, hit = scene.closest(rays), scene.any(rays)
            parts = [scene.closest(rays[i:i + 1000]) for i in range(0, len(rays), 1000)]
        self.assertEqual(hits.tobytes(), np.concatenate(parts).tobytes())
        np.testing.assert_array_equal(hit, hits["t"] < np.inf)

    def test_pilot(self):
        rays = accel.rays(*directed(300))
        with accel.Scene(*soup(1000), pilot=rays) as scene:
            self.assertIn("pilot of 256", " ".join(scene.describe()["notes"]))

    def test_spheres(self):
        for spheres in (accel.Spheres([[0, 0, 0], [0, 0, 5]], [1, 2]), accel.Spheres(
                [[0, 0, 0, 1], [0, 0, 5, 2]])):
            with accel.Accelerator(spheres) as a:
                hits, _ = a.all([0, 0, -3], [0, 0, 1])
                self.assertEqual(hits["t"].tolist(), [2, 4, 6, 10])
                self.assertEqual(hits["prim"].tolist(), [0, 0, 1, 1])

    def test_points(self):
        random = np.random.default_rng(4)
        vertices, faces = soup(300, 0.3)
        points = random.uniform(0, 1, (100, 3))
        corners = vertices[faces]
        low, high = corners.min(axis=1), corners.max(axis=1)
        expected = [(j, i) for j, p in enumerate(points)
                    for i in np.flatnonzero(np.all((low <= p) & (p <= high), axis=1))]
        self.assertGreater(len(expected), 50)
        for kind in KINDS:
            with accel.Scene(vertices, faces, config=kind) as scene:
                ids, index = scene.points(points)
                self.assertEqual(list(zip(index, ids["prim"])), expected)
                self.assertEqual(set(ids["geom"]), {0})

    def test_trimesh_names(self):
        origins, directions = [[0.25, 0.25, 5], [9, 9, 5]], [[0, 0, -1], [0, 0, -1]]
        with accel.Scene(VERTICES, FACES) as scene:
            self.assertEqual(scene.intersects_first(origins, directions).tolist(), [0, -1])
            self.assertEqual(scene.intersects_any(origins, directions).tolist(), [True, False])
            for multiple in (True, False):
                where, rays, triangles = scene.intersects_location(origins, directions, multiple)
                self.assertEqual(where.tolist(), [[0.25, 0.25, 0]])
                self.assertEqual((rays.tolist(), triangles.tolist()), ([0], [0]))

    def test_interval_and_skip(self):
        with accel.Scene(np.concatenate([VERTICES, VERTICES - [0, 0, 1]]),
                         [[0, 1, 2], [3, 4, 5]]) as scene:
            o, d = [[0.25, 0.25, 5]], [0, 0, -1]
            first = scene.closest(o, d)
            self.assertEqual(first["t"].tolist(), [5])
            self.assertEqual(scene.closest(o, d, skip=first)["t"].tolist(), [6])
            self.assertEqual(scene.closest(o, d, tmin=5)["t"].tolist(), [6])
            self.assertEqual(scene.any(o, d, tmax=[5, 5.5]).tolist(), [False, True])

    def test_refused_rays_are_counted(self):
        counts = accel.Counts()
        with accel.Scene(VERTICES, FACES) as scene:
            hit = scene.any([[0.25, 0.25, 1], [np.nan, 0, 0]], [0, 0, -1], counts=counts)
        self.assertEqual((hit.tolist(), counts.refused), ([True, False], 1))


class Arrays(unittest.TestCase):
    def test_layouts_give_the_same(self):
        vertices, faces = soup(200)
        vertices = vertices.astype(np.float32)
        origins, directions = directed(300)
        with accel.Scene(vertices.astype(float), faces) as scene:
            expected = scene.closest(origins, directions).tobytes()
        wide = np.zeros((len(vertices), 5), np.float32)
        wide[:, 1:4] = vertices
        packed = np.zeros(12 * len(vertices) + 1, np.uint8)
        packed[1:] = vertices.view(np.uint8).ravel()
        for name, v in (("float", vertices), ("rows", wide[:, 1:4]), ("columns", np.asfortranarray(
                vertices)), ("backward", vertices[::-1].copy()[::-1]),
                ("big-endian", vertices.astype(">f8")), ("list", vertices.tolist()),
                ("unaligned", packed[1:].view(np.float32).reshape(-1, 3))):
            for f in (faces, faces.astype(np.uint32), faces.astype(np.int16), np.asfortranarray(
                    faces), faces.tolist()):
                with self.subTest(name), accel.Scene(v, f) as scene:
                    self.assertEqual(scene.closest(origins, directions).tobytes(), expected)
        with accel.Scene(vertices, faces) as scene:
            rays = np.zeros((300, 2), accel.RAY)
            rays[:, 0] = accel.rays(origins, directions)
            self.assertEqual(scene.closest(rays[:, 0]).tobytes(), expected)
            self.assertEqual(scene.closest(np.asfortranarray(origins), directions).tobytes(),
                             expected)

    def test_no_copies(self):
        mesh = np.zeros((8, 4))
        self.assertTrue(np.shares_memory(accel.Mesh(mesh[:, :3], FACES).vertices, mesh))
        self.assertTrue(np.shares_memory(accel.Mesh(VERTICES, FACES).faces, FACES))
        self.assertTrue(np.shares_memory(accel.Spheres(mesh).spheres, mesh))
        rays = accel.rays(VERTICES, VERTICES + 1)
        self.assertIs(accel._arrays.take_rays(rays, None, 0.0, np.inf, None), rays)

    def test_empty(self):
        for config in ("linear",) + KINDS:
            with accel.Scene(np.empty((0, 3)), [], config=config) as scene:
                self.assertEqual(scene.any([[0, 0, 0]], [0, 0, 1]).tolist(), [False])
                self.assertEqual(scene.closest([], []).shape, (0,))
                self.assertEqual([len(x) for x in scene.all([], [])], [0, 0])
                self.assertEqual([len(x) for x in scene.points([])], [0, 0])
                self.assertEqual([len(x) for x in scene.intersects_location([], [])], [0, 0, 0])
        with accel.Accelerator() as a:
            self.assertEqual(a.describe()["primitives"], 0)

    def test_shapes(self):
        with accel.Scene(VERTICES, FACES) as scene:
            self.assertEqual(scene.closest([0.25, 0.25, 1], [0, 0, -1]).shape, ())
            self.assertEqual(scene.any([0.25, 0.25, 1], np.ones((4, 5, 3))).shape, (4, 5))

    def refused(self, text, function, *arguments, **options):
        with self.assertRaisesRegex(ValueError, text):
            function(*arguments, **options)

    def test_refused(self):
        self.refused(r"vertices: the shape is \(3, 2\)", accel.Scene, VERTICES[:, :2], FACES)
        self.refused(r"vertices: the shape is \(3,\)", accel.Scene, VERTICES[0], FACES)
        self.refused("vertices: the dtype is complex128", accel.Scene, VERTICES * 1j, FACES)
        self.refused("vertices: an integer beyond", accel.Scene, [[2**60 + 1, 0, 0]], FACES)
        self.refused(r"faces: the shape is \(1, 4\)", accel.Scene, VERTICES, [[0, 1, 2, 0]])
        self.refused("faces: the dtype is float64", accel.Scene, VERTICES, FACES * 1.0)
        self.refused("faces: indices from -1", accel.Scene, VERTICES, [[0, 1, -1]])
        self.refused("faces: indices from 0 to 4294967298", accel.Scene, VERTICES,
                     [[0, 1, 2**32 + 2]])
        self.refused(r"radii: the shape is \(2,\)", accel.Spheres, VERTICES, [1, 2])
        self.refused("int is no geometry", accel.Accelerator, 3)
        with accel.Scene(VERTICES, FACES) as scene:
            for query in (scene.closest, scene.any, scene.all):
                self.refused(r"origins: the shape is \(2,\)", query, [0, 0], [0, 0, 1])
                self.refused("the counts are", query, VERTICES, VERTICES[:2])
                self.refused("directions: the dtype is <U1", query, VERTICES, [["a", "b", "c"]])
                self.refused("origins without directions", query, VERTICES)
                self.refused("holds its own tmin", query, accel.rays(VERTICES, VERTICES), tmax=1)
                self.refused("skip: the dtype is int64", query, VERTICES, VERTICES, skip=[1, 2, 3])
            self.refused(r"points: the shape is \(3, 2\)", scene.points, VERTICES[:, :2])


class Life(unittest.TestCase):
    def test_errors(self):
        with self.assertRaisesRegex(accel.ConfigError, "octre"):
            accel.Scene(VERTICES, FACES, config="octre")
        with self.assertRaises(accel.ArgumentError):
            accel.Scene(VERTICES, [[0, 1, 3]])
        with self.assertRaisesRegex(accel.MemoryLimitError, "1000"):
            accel.Scene(*soup(1000), memory_limit=1000)
        self.assertTrue(issubclass(accel.MemoryLimitError, MemoryError))
        with self.assertRaises(accel.Cancelled):
            accel.Scene(*soup(20000), config="bsp", progress=lambda phase, done: False)

        def stop(phase, done):
            raise KeyboardInterrupt
        with self.assertRaises(KeyboardInterrupt):
            accel.Scene(*soup(20000), config="bsp", progress=stop)

    def test_describe(self):
        with accel.Scene([*VERTICES, [np.nan, 0, 0]], [[0, 1, 2], [0, 1, 3], [0, 0, 1]],
                         config="bvh") as scene:
            info = scene.describe()
        self.assertEqual((info["kind"], info["primitives"], info["skipped"], info["degenerate"]),
                         ("bvh", 3, 1, 1))
        self.assertEqual(info["skipped_ids"], [(0, 1)])
        self.assertIn("copy", info["phases"])
        self.assertTrue(all(p["what"] for p in info["left_out"]))

    def test_closed(self):
        scene = accel.Scene(VERTICES, FACES)
        scene.close()
        scene.close()
        for use in (scene.describe, scene.validate, lambda: scene.any(VERTICES, VERTICES)):
            with self.assertRaisesRegex(ValueError, "closed"):
                use()

    def test_freed_once_and_in_time(self):
        """Counts what is freed, by close, by collection, and after a query that is under way."""
        real, freed = _library.library.accel_free, []

        class Counting:
            def __getattr__(self, name):
                return getattr(_library_real, name)

            @staticmethod
            def accel_free(handle):
                freed.append(handle)
                real(handle)

        _library_real = _library.library
        _library.library = Counting()
        try:
            with accel.Scene(VERTICES, FACES) as scene:
                pass
            self.assertEqual(len(freed), 1)
            del scene
            gc.collect()
            self.assertEqual(len(freed), 1)
            accel.Scene(VERTICES, FACES)
            gc.collect()
            self.assertEqual(len(freed), 2)
            scene = accel.Scene(VERTICES, FACES)
            with scene._open():
                scene.close()
                self.assertEqual(len(freed), 2)
            self.assertEqual(len(freed), 3)
        finally:
            _library.library = _library_real

    def test_the_callers_arrays_may_go(self):
        vertices, faces = soup(300)
        origins, directions = directed(100)
        with accel.Scene(vertices, faces) as scene:
            expected = scene.closest(origins, directions).tobytes()
            vertices[:] = 0
            faces[:] = 0
            self.assertEqual(scene.closest(origins, directions).tobytes(), expected)

    def test_threads(self):
        origins, directions = directed(20000)
        with accel.Scene(*soup(2000), config="hoo:lazy=on") as scene:
            answers = [None] * 4

            def ask(i):
                answers[i] = scene.closest(origins, directions).tobytes()
            threads = [threading.Thread(target=ask, args=(i,)) for i in range(4)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
        with accel.Scene(*soup(2000), config="bvh") as scene:
            expected = scene.closest(origins, directions).tobytes()
        self.assertEqual(answers, [expected] * 4)

    def test_closed_while_threads_query(self):
        rays = accel.rays(*directed(20000))
        for _ in range(5):
            scene, ends, started = accel.Scene(*soup(2000)), [], threading.Barrier(4)

            def ask():
                started.wait()
                try:
                    while True:
                        scene.any(rays)
                except ValueError as closed:
                    ends.append(str(closed))
            threads = [threading.Thread(target=ask) for _ in range(3)]
            for thread in threads:
                thread.start()
            started.wait()
            scene.close()
            for thread in threads:
                thread.join()
            self.assertEqual(ends, ["the accelerator is closed"] * 3)


class Library(unittest.TestCase):
    def test_bundled(self):
        folder = pathlib.Path(accel.__file__).parent
        self.assertTrue((folder / "libaccel.so").exists())
        self.assertTrue(folder.is_relative_to(os.environ["ACCEL_TEST_BUNDLED"]))
        self.assertEqual(pathlib.Path(_library.library._name), folder / "libaccel.so")

    def test_environment(self):
        self.assertEqual(run("import accel", ACCEL_LIBRARY=_library.library._name).returncode, 0)
        for path, text in (("/no/such.so", "/no/such.so cannot be used"),
                           ("libm.so.6", "libm.so.6 cannot be used")):
            found = run("import accel", ACCEL_LIBRARY=path)
            self.assertEqual(found.returncode, 1)
            self.assertIn(f"ImportError: accel: {text}", found.stderr)

    def test_bench(self):
        script = pathlib.Path(__file__).parents[2] / "accel" / "python" / "bench.py"
        with tempfile.TemporaryDirectory() as folder:
            mesh = pathlib.Path(folder) / "mesh.off"
            mesh.write_text("OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
                            "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n")
            found = subprocess.run([sys.executable, script, mesh, "bvh", "-n", "100", "--repeats",
                                    "1", "--command", os.environ["ACCEL_TEST_COMMAND"]],
                                   capture_output=True, text=True)
        self.assertEqual((found.returncode, found.stderr), (0, ""))
        self.assertEqual(found.stdout.count("ns a ray\n"), 5)
        self.assertIn("bounce", found.stdout)


if __name__ == "__main__":
    unittest.main()
