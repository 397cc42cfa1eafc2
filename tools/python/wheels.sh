#!/bin/bash
# wheels.sh: the source distribution, and of it a wheel for each platform, with its tag
#
#     tools/python/wheels.sh SOURCE OUTPUT PLATFORM ...      (make wheels)
#
# SOURCE is a copy of tools/python with csrc. A PLATFORM is manylinux, musllinux or windows. CC,
# for manylinux, PYTHON and SOURCE_DATE_EPOCH come from the Makefile; ccache, if it is in CC,
# serves all. manylinux: old_glibc.c lets the library run with glibc 2.14. windows: clang, since
# the kernels for AVX are left out by gcc of MinGW, with the libraries of MinGW's gcc. Each
# library is stripped. METIS is in none.

set -e
here=$(cd "$(dirname "$0")" && pwd)
out=$(mkdir -p "$2" && cd "$2" && pwd)
source=$(cd "$1" && pwd)
shift 2
ccache=
case $CC in ccache*) ccache=ccache ;; esac
work=$out/work # a folder that stays the same, so that ccache knows the files
trap 'rm -rf "$work"' EXIT
export PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_ROOT_USER_ACTION=ignore
rm -rf "$work" "$out"/*.whl "$out"/*.tar.gz
mkdir "$work"

# quietly COMMAND ...: its output only if it fails
quietly() {
    "$@" >"$work/log" 2>&1 || {
        cat "$work/log"
        exit 1
    }
}

cd "$source"
quietly $PYTHON -c 'import sys, setuptools.build_meta as b; b.build_sdist(sys.argv[1])' "$out"
# Times and owner in it are fixed, so that the same files give the same bytes.
sdist=$(echo "$out"/*.tar.gz)
tar -C "$work" -xzf "$sdist"
(cd "$work" && tar --sort=name --owner=0 --group=0 --numeric-owner --mode=u=rwX,go=rX \
    --mtime="@$SOURCE_DATE_EPOCH" -cf - sparse_local-*) | gzip -9n >"$work/sdist"
mv "$work/sdist" "$sdist"
echo "$sdist"
for platform in "$@"; do
    unset CFLAGS
    export LDFLAGS="-s -Wl,--version-script=$here/../packaging/libsparse_local.map"
    case $platform in
    manylinux)
        compiler=$CC
        $CC -O2 -fPIC -fno-builtin -c "$here/../packaging/old_glibc.c" -o "$work/old_glibc.o"
        LDFLAGS="$LDFLAGS $work/old_glibc.o"
        ;;
    musllinux) compiler="$ccache musl-gcc" ;;
    windows)
        compiler="$ccache clang --target=x86_64-w64-mingw32"
        libgcc=$(x86_64-w64-mingw32-gcc -print-libgcc-file-name)
        LDFLAGS="-s -Wl,--no-insert-timestamp -L$(dirname "$libgcc")"
        ;;
    *)
        echo "wheels.sh: no platform $platform"
        exit 1
        ;;
    esac
    mkdir "$work/$platform"
    tar -C "$work/$platform" -xzf "$sdist"
    CC=$compiler quietly $PYTHON -m pip wheel --no-index --no-deps --no-build-isolation \
        --wheel-dir "$work/$platform" "$work/$platform"/sparse_local-*/
    wheel=$($PYTHON -B "$here/wheel_tag.py" "$work/$platform"/*.whl)
    mv "$wheel" "$out"
    $PYTHON -B "$here/wheel_tag.py" --check "$out/${wheel##*/}"
done
