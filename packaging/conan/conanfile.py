"""Conan 2 recipe: conan create packaging/conan (needs cargo and cmake on the PATH; packaging/README.md)."""
import os

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout
from conan.tools.files import copy, rm, load
from conan.tools.microsoft import is_msvc


class FootpointConan(ConanFile):
    name = "footpoint"
    license = "MIT OR Apache-2.0"
    description = "NURBS point inversion and projection with a proof"
    topics = ("nurbs", "cad", "geometry", "projection")
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False]}
    default_options = {"shared": True}
    package_type = "library"
    # The interface is C: the C++ settings of the caller do not change the binary.
    languages = "C"

    @property
    def _root(self):
        return os.path.normpath(os.path.join(self.recipe_folder, "..", ".."))

    def set_version(self):
        lines = load(self, os.path.join(self._root, "Cargo.toml")).splitlines()
        self.version = next(line.split('"')[1] for line in lines if line.startswith("version = "))

    def export_sources(self):
        for pattern in ("Cargo.*", "build.rs", "cbindgen.toml", "CMakeLists.txt", "README.md", "LICENSE-*", "benches/*",
                        "cmake/*", "include/*", "src/*"):
            copy(self, pattern, self._root, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["FOOTPOINT_BUILD_TESTS"] = False
        toolchain.cache_variables["FOOTPOINT_BUILD_EXAMPLES"] = False
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build(target="footpoint_library")

    def package(self):
        copy(self, "LICENSE-*", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()
        folder = os.path.join(self.package_folder, "lib")
        if self.options.shared:
            rm(self, "footpoint.lib" if is_msvc(self) else "libfootpoint.a", folder)
        else:
            for pattern in ("libfootpoint.so*", "libfootpoint*.dylib", "*.dll.lib", "*.dll.a"):
                rm(self, pattern, folder)
            rm(self, "*.dll", os.path.join(self.package_folder, "bin"))

    def package_info(self):
        # The package's own files for CMake and pkg-config are right wherever it lies.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = [os.path.join("lib", "cmake", "footpoint")]
        self.cpp_info.libs = ["footpoint.dll" if is_msvc(self) and self.options.shared else "footpoint"]
        if not self.options.shared and self.settings.os in ("Linux", "FreeBSD"):
            self.cpp_info.system_libs = ["pthread", "gcc_s", "m", "dl"]
