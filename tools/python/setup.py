"""setup.py: compiles sparse_local.h to the shared library inside the package.

CC, CFLAGS and LDFLAGS are read from the environment; CFLAGS come after -O2. The system of the
library is that of the compiler: CC=x86_64-w64-mingw32-gcc makes a DLL. wheel_tag.py gives a wheel
the tag that its library allows.
"""
import os
import shlex
import shutil
import subprocess
import sys

from setuptools import setup
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist
from setuptools.dist import Distribution

HERE = os.path.dirname(os.path.abspath(__file__))
SOURCES = {"sparse_local.h": "../..", "sparse_local.c": "../packaging", "LICENSE": "../.."}
COMPILER = shlex.split(os.environ.get("CC", "cc")) + ["-O2"]


def target_system():
    """windows, darwin, or another system, by the words of the compiler."""
    try:
        said = subprocess.run(COMPILER + ["-dumpmachine"], capture_output=True, text=True).stdout
    except OSError:
        sys.exit("setup.py: there is no compiler %s; CC=gcc or CC=clang chooses one" % COMPILER[0])
    for system in ("windows", "mingw", "darwin", "linux"):
        if system in said:
            return system.replace("mingw", "windows")
    return sys.platform.replace("win32", "windows")


def source(name):
    """The path of a file: in the repository, or beside setup.py in a source distribution."""
    inside = os.path.join(HERE, "csrc", name)
    return inside if os.path.exists(inside) else os.path.join(HERE, SOURCES[name], name)


class Build(build_py):
    def run(self):
        super().run()
        system = target_system()
        name = {"windows": "sparse_local.dll", "darwin": "libsparse_local.dylib"}
        target = os.path.join(self.build_lib, "sparse_local",
                              name.get(system, "libsparse_local.so"))
        os.makedirs(os.path.dirname(target), exist_ok=True)
        compiled = target + ".o"
        compiler = COMPILER + shlex.split(os.environ.get("CFLAGS", ""))
        more = shlex.split(os.environ.get("LDFLAGS", ""))
        # A DLL needs no flag for its addresses, nor -lm; without -static it may need DLLs of the
        # compiler, which are not beside it.
        kind, libraries = ["-fPIC", "-fvisibility=hidden"], ["-lm"]
        if system == "windows":
            kind, libraries = ["-DSL_SHARED"], ["-static"]
        # in two steps, of which ccache remembers the first
        for command in (["-std=c99"] + kind + ["-I", os.path.dirname(source("sparse_local.h")),
                         "-c", source("sparse_local.c"), "-o", compiled],
                        ["-shared", compiled, "-o", target] + more + libraries):
            print(" ".join(compiler + command))
            subprocess.check_call(compiler + command)
        os.remove(compiled)
        shutil.copy(source("LICENSE"), os.path.dirname(target))


class SourceDistribution(sdist):
    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        os.makedirs(os.path.join(base_dir, "csrc"), exist_ok=True)
        for name in SOURCES:
            shutil.copy(source(name), os.path.join(base_dir, "csrc", name))


class WithLibrary(Distribution):
    def has_ext_modules(self):
        return True


commands = {"build_py": Build, "sdist": SourceDistribution}
try:
    from wheel.bdist_wheel import bdist_wheel

    class Wheel(bdist_wheel):
        """The library is called by ctypes: a wheel serves every Python of its platform."""

        def get_tag(self):
            return ("py3", "none", super().get_tag()[2])

    commands["bdist_wheel"] = Wheel
except ImportError:
    pass

setup(cmdclass=commands, distclass=WithLibrary)
