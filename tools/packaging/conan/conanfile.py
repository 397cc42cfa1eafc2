# conanfile.py: recipe of Conan 2 for the header: conan create tools/packaging/conan
import os
import re

from conan import ConanFile
from conan.tools.files import copy

ROOT = os.path.join("..", "..", "..")


class SparseLocal(ConanFile):
    name = "sparse_local"
    license = "MIT"
    description = "Factors a sparse symmetric matrix once and then solves locally, in one C header"
    package_type = "header-library"
    settings = "os", "arch", "compiler", "build_type"
    no_copy_source = True

    def set_version(self):
        with open(os.path.join(self.recipe_folder, ROOT, "sparse_local.h")) as header:
            numbers = re.findall(r"#define SL_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", header.read())
        self.version = ".".join(numbers[:3])

    def export_sources(self):
        root = os.path.join(self.recipe_folder, ROOT)
        adapters = os.path.join(root, "tools", "adapters")
        copy(self, "sparse_local.h", root, self.export_sources_folder)
        copy(self, "LICENSE", root, self.export_sources_folder)
        copy(self, "*.hpp", adapters, self.export_sources_folder)
        copy(self, "*.h", adapters, self.export_sources_folder)

    def package(self):
        include = os.path.join(self.package_folder, "include")
        copy(self, "*.h", self.source_folder, include)
        copy(self, "*.hpp", self.source_folder, include)
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))

    def package_id(self):
        self.info.clear()

    def package_info(self):
        self.cpp_info.bindirs = []
        self.cpp_info.libdirs = []
        self.cpp_info.set_property("cmake_file_name", "sparse_local")
        self.cpp_info.set_property("cmake_target_name", "sparse_local::sparse_local")
        self.cpp_info.set_property("pkg_config_name", "sparse_local")
        if self.settings.get_safe("os") in ("Linux", "FreeBSD"):
            self.cpp_info.system_libs = ["m"]
