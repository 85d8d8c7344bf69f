# SPDX-License-Identifier: Apache-2.0
"""Compiles the library, the CMake project one folder up, and puts libaccel.so into the wheel.

Everything but the package itself is made in temporary folders, so the source stays as it is.
"""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile

from setuptools import setup
from setuptools.command.build_py import build_py
from setuptools.dist import Distribution
try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:
    from wheel.bdist_wheel import bdist_wheel

HERE = pathlib.Path(__file__).resolve().parent
LIBRARY = HERE.parent


def version():
    """The library's: its one place is the header."""
    header = LIBRARY / "include" / "accel" / "accel.h"
    if not header.exists():
        raise SystemExit(f"accel: no {header}: the package is built within accel's source tree")
    numbers = re.findall(r"^#define ACCEL_VERSION_(?:MAJOR|MINOR|PATCH) +(\d+)$",
                         header.read_text(encoding="utf-8"), re.M)
    return ".".join(numbers)


def compile_library(target):
    if shutil.which("cmake") is None:
        raise SystemExit("accel: cmake 3.25 or newer and a C compiler are needed; no cmake found")
    environment = dict(os.environ)
    environment.setdefault("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["cmake", "-S", str(LIBRARY), "-B", folder, "-DCMAKE_BUILD_TYPE=Release",
                        "-DACCEL_COMMAND=OFF", "-DACCEL_INSTALL=OFF",
                        f"-DCMAKE_LIBRARY_OUTPUT_DIRECTORY={folder}/out"],
                       check=True, env=environment)
        subprocess.run(["cmake", "--build", folder, "--target", "accel_shared"],
                       check=True, env=environment)
        shutil.copyfile(f"{folder}/out/libaccel.so", target)  # what the link points to


class BuildWithLibrary(build_py):
    def run(self):
        super().run()
        base = HERE / "src" if getattr(self, "editable_mode", False) else pathlib.Path(self.build_lib)
        target = base / "accel" / "libaccel.so"
        target.parent.mkdir(parents=True, exist_ok=True)
        compile_library(target)


class PlatformWheel(bdist_wheel):
    """Any Python 3, this platform: the library is no extension module."""

    def get_tag(self):
        return ("py3", "none", super().get_tag()[2])


class BinaryDistribution(Distribution):
    def has_ext_modules(self):
        return True


with tempfile.TemporaryDirectory() as scratch:
    setup(version=version(), distclass=BinaryDistribution,
          cmdclass={"build_py": BuildWithLibrary, "bdist_wheel": PlatformWheel},
          options={"build": {"build_base": scratch}, "egg_info": {"egg_base": scratch}})
