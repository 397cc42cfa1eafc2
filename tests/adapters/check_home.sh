#!/bin/bash
# check_home.sh: HOME_URL reaches header, packages and manual; without it there is no address. The
# version of the header reaches the packages
#
#     tests/adapters/check_home.sh          (make test-home)
#
# Works on a copy of the files that git knows. cmake, meson and npm's tools are used where they
# are installed. CC and PYTHON come from the Makefile. The last line is `N passed, N failed`.

cd "$(dirname "$0")/../.." || exit 1
. tests/lib/checks.sh
checks_folder home
export CC=${CC:-cc} PYTHON=${PYTHON:-python3}
home='https://example.org/sl?a=1&b=2'
mkdir "$dir/tree" "$dir/before"
git ls-files -z | xargs -0 cp --parents -t "$dir/tree"
cp -r "$dir/tree/." "$dir/before"
cd "$dir/tree" || exit 1
quiet="make --no-print-directory -s"

has() { # has FILE: the address, once
    [ "$(grep -cF "$home" "$1")" = 1 ] || { grep -nF "$home" "$1"; return 1; }
}

check "a tree without a home is as it was after make header" \
    "$quiet header && $quiet check-header && rm -rf build && diff -r . $dir/before"
check "an address that is none is refused, and nothing is written" \
    "! $quiet header HOME_URL='example.org' && rm -rf build && ! grep -rlF 'example.org' \
         sparse_local.h CMakeLists.txt meson.build tools/packaging/vcpkg tools/python"
check "check-header notices that the home is not in the files" \
    "$quiet header && ! $quiet check-header HOME_URL='$home'"
check "make header writes it, check-header agrees" \
    "$quiet header HOME_URL='$home' && $quiet check-header HOME_URL='$home'"
check "the header has it in its first lines, and compiles" \
    "has sparse_local.h && head -5 sparse_local.h | grep -F ' * Home: $home' &&
     echo '#include \"sparse_local.h\"' | $CC -std=c99 -fsyntax-only -I. -x c -"
check "the flat header and that of a few packs" \
    "$quiet header-flat HOME_URL='$home' && $quiet header PACKS=core HOME_URL='$home' &&
     has build/sparse_local_flat.h && has build/sparse_local_core.h"

# ---- packages ----

# What make install does, with a library that is empty.
installed() {
    VERSION=1 SOVERSION=1 PREFIX=/usr LIBDIR=/usr/lib INCLUDEDIR=/usr/include DESTDIR=$dir/to \
        tools/packaging/install.sh install
}

homepage_of() {
    python3 -c 'import json, sys; print(json.load(open(sys.argv[1]))["homepage"])' "$1"
}
check "vcpkg" "homepage_of tools/packaging/vcpkg/vcpkg.json | grep -Fx '$home'"
check "Conan" "has tools/packaging/conan/conanfile.py &&
    python3 -c 'import ast; ast.parse(open(\"tools/packaging/conan/conanfile.py\").read())'"
check "npm" "$quiet build/npm/package.json HOME_URL='$home' &&
    homepage_of build/npm/package.json | grep -Fx '$home'"
check "Python" "cp -r tools/python build/python-home && cd build/python-home &&
    $PYTHON -B setup.py -q egg_info && has sparse_local.egg-info/PKG-INFO &&
    grep -E '^(Home-page|Project-URL: Homepage)[:,] ' sparse_local.egg-info/PKG-INFO"
check "pkg-config, by make install" \
    "mkdir -p build/lib && touch build/lib/libsparse_local.{a,so,so.1} &&
     HOME_URL='$home' installed &&
     for name in sparse_local sparse_local_compiled; do
         grep -Fx 'URL: $home' $dir/to/usr/lib/pkgconfig/\$name.pc || exit 1
     done"
if command -v cmake >/dev/null; then
    check "CMake" "cmake -S . -B build/cmake-home &&
        grep -F '_HOMEPAGE_URL:STATIC=$home' build/cmake-home/CMakeCache.txt"
fi
if command -v meson >/dev/null; then
    check "meson" "meson setup build/meson-home &&
        grep -rF 'URL: $home' build/meson-home/meson-private/*.pc"
fi

# ---- the manual, the list of a release ----

check "the manual links to it on each page" \
    "$quiet docs HOME_URL='$home' &&
     ! grep -LF 'href=\"${home/&/&amp;}\">home' build/manual/*.html | grep ."
check "the list of a release" \
    "mkdir release && cp sparse_local.h release && HOME_URL='$home' \
         tools/packaging/release_contents.sh release >build/CONTENTS.md && has build/CONTENTS.md &&
     grep -F \"\$(sha256sum sparse_local.h | cut -d' ' -f1)\" build/CONTENTS.md | grep -F MIT"
check "a file that the list does not know is refused" \
    "touch release/stray && ! tools/packaging/release_contents.sh release; rm -r release"

# ---- and nothing without it ----

check "make header without a home takes it out of every file" \
    "$quiet header && rm -rf build && diff -r . $dir/before"
check "no package has an empty address" \
    "$quiet docs build/npm/package.json && ! grep -i homepage build/npm/package.json &&
     ! grep -F '>home</a>' build/manual/index.html && mkdir -p build/lib &&
     touch build/lib/libsparse_local.{a,so,so.1} && HOME_URL= installed &&
     ! grep -r URL $dir/to/usr/lib/pkgconfig"

# ---- the version ----

check "make header writes another version to the packages, Python's in its own spelling" \
    "sed -i 's/\\(SL_VERSION_PATCH\\) [0-9]*/\\1 77/' src/public/config.h &&
     ! $quiet check-header && $quiet header && $quiet check-header &&
     grep 'version: .*[.]77-dev.,' meson.build &&
     grep 'semver.*[.]77-dev\"' tools/packaging/vcpkg/vcpkg.json &&
     grep '^version.*[.]77[.]dev0\"' tools/python/pyproject.toml"
check "so it does with that of a release, without a suffix" \
    "sed -i 's/\\(SL_VERSION_SUFFIX\\) .*/\\1 \"\"/' src/public/config.h &&
     $quiet header && $quiet check-header && grep 'version: .*[.]77.,' meson.build &&
     grep 'semver.*[.]77\"' tools/packaging/vcpkg/vcpkg.json &&
     grep '^version.*[.]77\"' tools/python/pyproject.toml"

checks_end
