"""Builds the shared library with cargo, and a wheel that carries it: for every Python 3 of this platform.

FOOTPOINT_PREBUILT names a library file to carry instead, for packagers.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:
    from wheel.bdist_wheel import bdist_wheel

CRATE = Path(__file__).resolve().parent.parent
LIBRARY = {"win32": "footpoint.dll", "darwin": "libfootpoint.dylib"}.get(sys.platform, "libfootpoint.so")


def cargo() -> Path:
    """The library, built with the command of cmake/cargo.cmake, so that one directory of cargo serves both. The crate types are
    named because cargo leaves link-time optimisation out when there is an rlib among them."""
    command = os.environ.get("CARGO", "cargo")
    if shutil.which(command) is None:
        raise SystemExit("cargo is needed to build footpoint: install Rust 1.89 or newer, or let FOOTPOINT_PREBUILT name a built library")
    target = Path(os.environ.get("CARGO_TARGET_DIR", CRATE / "target")).resolve()
    subprocess.run([command, "rustc", "--release", "--locked", "--lib", "--crate-type", "cdylib,staticlib", "--features", "",
                    "--target-dir", str(target)], cwd=CRATE, check=True)
    return target / "release" / LIBRARY


class Build(build_py):
    def run(self):
        super().run()
        prebuilt = os.environ.get("FOOTPOINT_PREBUILT")
        place = Path("footpoint") if self.editable_mode else Path(self.build_lib) / "footpoint"
        place.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(prebuilt or cargo(), place / LIBRARY)


class Wheel(bdist_wheel):
    def finalize_options(self):
        super().finalize_options()
        self.root_is_pure = False

    def get_tag(self):
        return ("py3", "none", super().get_tag()[2])


class WithLibrary(Distribution):
    def has_ext_modules(self):
        return True


version = re.search(r'^version = "(.+)"', (CRATE / "Cargo.toml").read_text(encoding="utf-8"), re.M).group(1)
setup(version=version, distclass=WithLibrary, cmdclass={"build_py": Build, "bdist_wheel": Wheel})
