#!/bin/bash
# check_install.sh: projects of strangers over the installed or the embedded library
#
#     tests/adapters/check_install.sh [PART ...]          (make check-install)
#
# PART is install, pkg-config, cmake, meson or recipes; default: all. Every project is built in a
# temporary folder outside the tree. CC, CXX and VERSION come from the Makefile. A part whose tool
# is not installed is skipped. The last line is `N passed, N failed, N skipped`.

cd "$(dirname "$0")/../.." || exit 1
root=$PWD
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
passed=0 failed=0 skipped=0
parts=${*:-install pkg-config cmake meson recipes}
CC=${CC:-cc}
export CC CXX

# check TEXT COMMAND ...: COMMAND is a function or a program; its output is shown if it fails.
# set -e has no effect inside a condition, and so the command is not one.
check() {
    local text=$1 status
    shift
    (
        set -e
        "$@"
    ) >"$dir/log" 2>&1
    status=$?
    if [ $status -eq 0 ]; then
        passed=$((passed + 1))
        echo "ok       $text"
    else
        failed=$((failed + 1))
        echo "FAILED   $text"
        tail -n 30 "$dir/log" | sed 's/^/    /'
    fi
}

wanted() {
    [[ " $parts " == *" $1 "* ]] || return 1
    [ -z "$2" ] || command -v "$2" >/dev/null 2>&1 && return 0
    skipped=$((skipped + 1))
    echo "skipped  $1: $2 is not installed"
    return 1
}

# ---- the stranger's programs ----

# A program in a new folder: $1 header or compiled. It solves [2 1; 1 2] x = (3, 3), x = (1, 1).
stranger() {
    mkdir -p "$dir/$2"
    cd "$dir/$2"
    [ "$1" = compiled ] || echo '#define SPARSE_LOCAL_IMPLEMENTATION' >main.c
    cat >>main.c <<'C'
#include <sparse_local.h>
int main(void) {
    const sl_int p[] = {0, 2, 3}, i[] = {0, 1, 1};
    const double a[] = {2, 1, 2};
    double x[] = {3, 3};
    const sl_csc A = {2, 2, p, i, a};
    sl_symbolic *S = 0;
    sl_factor *F = 0;
    if (sl_symbolic_create(&S, &A, 0, 0) || sl_factor_create(&F, S, &A, 0, 0) ||
        sl_factor_solve(F, x, 2, x, 2, 1, 0)) {
        return 1;
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
    return x[0] < 0.999 || x[0] > 1.001 || x[1] < 0.999 || x[1] > 1.001;
}
C
}

# A CMake project: $1 header or compiled, $2 folder, $3 its line that finds the library, and more
# arguments of cmake.
cmake_stranger() {
    local target=sparse_local::sparse_local kind=$1 folder=$2 line=$3
    shift 3
    [ "$kind" = header ] || target=sparse_local::compiled
    stranger "$kind" "$folder"
    cat >CMakeLists.txt <<C
cmake_minimum_required(VERSION 3.14)
project(stranger C)
$line
add_executable(app main.c)
target_link_libraries(app $target)
C
    cmake -S . -B b "$@"
    cmake --build b
    ./b/app
}

# Is the library of a stranger's build compiled with -O$1? The last -O of its command counts.
library_has() {
    grep '"command".*tools/packaging/sparse_local\.c' b/compile_commands.json >commands
    test "$(grep -o ' -O[0-9a-z]*' commands | tail -n 1)" = "$1"
}

# The library is optimized in a Debug build, and with the switch not.
optimized_by_cmake() {
    stranger compiled optimized
    printf '%s\n' 'cmake_minimum_required(VERSION 3.14)' 'project(stranger C)' \
        "add_subdirectory(\"$root\" sparse_local)" 'add_executable(app main.c)' \
        'target_link_libraries(app sparse_local::compiled)' >CMakeLists.txt
    for type in Debug ''; do
        cmake -S . -B b -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DCMAKE_BUILD_TYPE=$type
        library_has ' -O2'
    done
    cmake -S . -B b -DCMAKE_BUILD_TYPE=Debug -DSPARSE_LOCAL_OPTIMIZE=OFF
    library_has ''
}

installed_by_make() {
    make --no-print-directory -C "$root" install PREFIX="$dir/prefix" DESTDIR=
    test -f "$dir/prefix/include/sparse_local_eigen.hpp"
    test -f "$dir/prefix/include/sparse_local_geometry_central.hpp"
    test -f "$dir/prefix/include/sparse_local_qdldl.h"
    test -f "$dir/prefix/include/sparse_local_mesh.h"
    test -f "$dir/prefix/include/sparse_local_symmetric.h"
    test -f "$dir/prefix/share/man/man1/sparse-local.1"
    if echo '#include <png.h>' | "${CC:-cc}" -E -x c - >/dev/null 2>&1; then
        "$dir/prefix/bin/sparse-local" --version | grep -F "$VERSION"
    fi
}

# With DESTDIR the files name PREFIX only; uninstall removes every file.
staged() {
    make --no-print-directory -C "$root" install PREFIX=/opt/x DESTDIR="$dir/stage"
    test -f "$dir/stage/opt/x/lib/libsparse_local.so"
    if grep -r "$dir" "$dir/stage/opt/x/lib/pkgconfig" "$dir/stage/opt/x/lib/cmake"; then
        return 1
    fi
    grep -x 'prefix=/opt/x' "$dir/stage/opt/x/lib/pkgconfig/sparse_local.pc"
    make --no-print-directory -C "$root" uninstall PREFIX=/opt/x DESTDIR="$dir/stage"
    test -z "$(find "$dir/stage" ! -type d)"
}

if wanted install; then
    check "make install" installed_by_make
    check "make install with DESTDIR, make uninstall" staged
else
    installed_by_make >"$dir/log" 2>&1 || cat "$dir/log"
fi

# ---- pkg-config ----

by_pkg_config() {
    local package=sparse_local
    [ "$1" = header ] || package=sparse_local_compiled
    export PKG_CONFIG_PATH=$dir/prefix/lib/pkgconfig
    stranger "$1" "pc-$1"
    test "$(pkg-config --modversion $package)" = "$VERSION"
    $CC -O0 -DSL_NO_SIMD main.c $(pkg-config --cflags --libs $package) -o app
    LD_LIBRARY_PATH=$dir/prefix/lib ./app
}

if wanted pkg-config pkg-config; then
    check "pkg-config: header" by_pkg_config header
    check "pkg-config: compiled library" by_pkg_config compiled
fi

# ---- CMake ----

refuses_version() {
    stranger compiled refused
    printf '%s\n' 'cmake_minimum_required(VERSION 3.14)' 'project(stranger C)' \
        "find_package(sparse_local $1 CONFIG REQUIRED)" >CMakeLists.txt
    if cmake -S . -B b -DCMAKE_PREFIX_PATH="$dir/prefix"; then
        return 1
    fi
    grep -q "version: $VERSION" "$dir/log"
}

moved() {
    local status
    mv "$dir/prefix" "$dir/moved"
    set +e
    (
        set -e
        cmake_stranger compiled cmake-moved "find_package(sparse_local REQUIRED)" \
            -DCMAKE_PREFIX_PATH="$dir/moved"
    )
    status=$?
    mv "$dir/moved" "$dir/prefix"
    return $status
}

# The project's own installation, with a shared library, and a stranger over it.
installed_by_cmake() {
    cmake -S "$root" -B "$dir/own" -DBUILD_SHARED_LIBS=ON -DSPARSE_LOCAL_SIMD=OFF \
        -DCMAKE_BUILD_TYPE=Debug -DCMAKE_INSTALL_PREFIX="$dir/cmake-prefix" \
        -DCMAKE_INSTALL_LIBDIR=lib
    cmake --build "$dir/own"
    cmake --install "$dir/own"
    test -f "$dir/cmake-prefix/lib/libsparse_local.so.$VERSION"
    cmake_stranger "$1" "cmake-own-$1" "find_package(sparse_local ${VERSION%.*} REQUIRED)" \
        -DCMAKE_PREFIX_PATH="$dir/cmake-prefix"
}

# What the project installs serves those who ask for an earlier version with the same first number.
later_version() {
    rm -rf "$dir/cmake-later"
    cp -r "$dir/cmake-prefix" "$dir/cmake-later"
    sed -i "s/$VERSION/${VERSION%%.*}.99.0/g" \
        "$dir/cmake-later/lib/cmake/sparse_local/sparse_local-config-version.cmake"
    cmake_stranger header cmake-later "find_package(sparse_local ${VERSION%.*} REQUIRED)" \
        -DCMAKE_PREFIX_PATH="$dir/cmake-later" -DCMAKE_C_FLAGS=-DSL_NO_SIMD
}

# METIS is linked if it is installed and asked for.
with_metis() {
    cmake_stranger header cmake-metis "add_subdirectory(\"$root\" sparse_local)" \
        -DSPARSE_LOCAL_METIS=ON -DSPARSE_LOCAL_SIMD=OFF -DCMAKE_BUILD_TYPE=Debug
    nm -u b/app | grep -q METIS_
}

if wanted cmake cmake; then
    fetch="include(FetchContent)
FetchContent_Declare(sparse_local SOURCE_DIR \"$root\")
FetchContent_MakeAvailable(sparse_local)"
    plain="-DSPARSE_LOCAL_SIMD=OFF -DCMAKE_BUILD_TYPE=Debug"
    prefix=-DCMAKE_PREFIX_PATH=$dir/prefix
    check "find_package: header" cmake_stranger header cmake-header \
        "find_package(sparse_local ${VERSION%.*} REQUIRED)" $prefix -DCMAKE_C_FLAGS=-DSL_NO_SIMD
    check "find_package: compiled library" cmake_stranger compiled cmake-compiled \
        "find_package(sparse_local $VERSION EXACT REQUIRED)" $prefix
    check "find_package: version 0.0 is refused" refuses_version 0.0
    check "find_package: a later version is refused" refuses_version 99
    check "find_package: after the installation was moved" moved
    check "add_subdirectory: header" cmake_stranger header sub-header \
        "add_subdirectory(\"$root\" sparse_local)" $plain
    check "add_subdirectory: compiled library" cmake_stranger compiled sub-compiled \
        "add_subdirectory(\"$root\" sparse_local)" $plain
    check "the library is optimized in Debug builds" optimized_by_cmake
    check "FetchContent of a local folder" cmake_stranger header fetch "$fetch" $plain
    check "cmake --install, then find_package: compiled" installed_by_cmake compiled
    check "find_package: a later version with the same first number is taken" later_version
    check "cmake --install, then find_package: header" cmake_stranger header cmake-own-header \
        "find_package(sparse_local REQUIRED)" -DCMAKE_PREFIX_PATH="$dir/cmake-prefix"
    if [ -e /usr/include/metis.h ]; then check "add_subdirectory with METIS" with_metis; fi
fi

# ---- meson ----

by_meson() {
    local name=sparse_local
    [ "$1" = header ] || name=sparse_local_compiled
    stranger "$1" "meson-$1"
    mkdir -p subprojects/sparse_local
    cp -r "$root/sparse_local.h" "$root/meson.build" "$root/meson_options.txt" \
        "$root/tools" subprojects/sparse_local
    cat >meson.build <<C
project('stranger', 'c')
lib = dependency('$name', fallback: ['sparse_local', '${name}_dep'])
executable('app', 'main.c', dependencies: lib)
C
    meson setup b -Dsparse_local:simd=false --buildtype=debug
    [ "$1" = header ] || library_has ' -O2'
    meson compile -C b
    ./b/app
}

# The switch of the subproject.
debugged_by_meson() {
    cd "$dir/meson-compiled"
    rm -rf b
    meson setup b -Dsparse_local:optimize=false --buildtype=debug
    library_has ' -O0'
}

if wanted meson meson; then
    check "meson subproject: header" by_meson header
    check "meson subproject: compiled library, optimized" by_meson compiled
    check "meson subproject: not optimized, by its option" debugged_by_meson
fi

# ---- recipes, the manual page ----

# The names of the commands are those of main.c.
same_commands() {
    sed -n 's/^\.It Cm //p' tools/packaging/sparse-local.1 >"$dir/commands"
    sed -n 's/^    {"\([a-z]*\)", ".*/\1/p' tools/cli/main.c | diff - "$dir/commands" &&
        sed -n 's/^    {"[a-z]*", "\(.*\)", command_.*/\1/p' tools/cli/main.c |
        while read -r summary; do
            grep -xF "$summary" tools/packaging/sparse-local.1 || exit 1
        done
}

if wanted recipes; then
    check "the manual page has the commands of sparse-local" same_commands
    check "vcpkg.json is JSON" python3 -m json.tool tools/packaging/vcpkg/vcpkg.json
    check "the Conan recipe is Python" python3 -c \
        'import ast; ast.parse(open("tools/packaging/conan/conanfile.py").read())'
fi
if wanted recipes mandoc; then
    check "mandoc finds nothing in the manual page" \
        mandoc -T lint -W error tools/packaging/sparse-local.1
fi

echo "$passed passed, $failed failed, $skipped skipped"
[ $failed -eq 0 ]
