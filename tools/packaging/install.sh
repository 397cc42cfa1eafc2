#!/bin/sh
# install.sh: copies what users of the library need to its place, or removes it (make install)
#
#     tools/packaging/install.sh install | uninstall
#
# Run in the root of the repository after `make shared`. Read from the environment: VERSION,
# SOVERSION, PREFIX, LIBDIR, INCLUDEDIR; DESTDIR, put before all of them; PRIVATE_LIBS, what a
# static link needs besides -lm; HOME_URL, as in the Makefile; PROGRAM, installed if it exists.

set -e
include=$DESTDIR$INCLUDEDIR
lib=$DESTDIR$LIBDIR
cmake=$lib/cmake/sparse_local
man=$DESTDIR$PREFIX/share/man/man1
bin=$DESTDIR$PREFIX/bin
pkgconfig="$lib/pkgconfig/sparse_local.pc $lib/pkgconfig/sparse_local_compiled.pc"
headers="sparse_local.h tools/adapters/sparse_local.hpp tools/adapters/sparse_local_eigen.hpp
tools/adapters/sparse_local_geometry_central.hpp tools/adapters/sparse_local_qdldl.h
tools/adapters/sparse_local_mesh.h tools/adapters/sparse_local_symmetric.h"

if [ "$1" = uninstall ]; then
    for header in $headers; do
        rm -f "$include/${header##*/}"
    done
    rm -f "$lib/libsparse_local.a" "$lib/libsparse_local.so" "$lib/libsparse_local.so.$SOVERSION" \
        "$lib/libsparse_local.so.$VERSION" "$man/sparse-local.1" "$bin/sparse-local"
    rm -f $pkgconfig "$cmake/sparse_local-config.cmake" \
        "$cmake/sparse_local-config-version.cmake" "$cmake/sparse_local-targets.cmake"
    [ ! -d "$cmake" ] || rmdir "$cmake"
    exit 0
fi

url=$(printf '%s' "$HOME_URL" | sed 's/[&|]/\\&/g')
# Fills in the variables of a template.
fill() {
    sed -e "s|@PREFIX@|$PREFIX|g" -e "s|@LIBDIR@|$LIBDIR|g" -e "s|@INCLUDEDIR@|$INCLUDEDIR|g" \
        -e "s|@VERSION@|$VERSION|g" -e "s|@SOVERSION@|$SOVERSION|g" \
        -e "s|@PRIVATE_LIBS@|$PRIVATE_LIBS|g" -e "s|@HOME_URL@|$url|; /^URL: \$/d" "$1"
}

mkdir -p "$include" "$lib/pkgconfig" "$cmake" "$man"
for header in $headers; do
    install -m 644 "$header" "$include/${header##*/}"
done
install -m 644 build/lib/libsparse_local.a "$lib/libsparse_local.a"
install -m 755 "build/lib/libsparse_local.so.$VERSION" "$lib/libsparse_local.so.$VERSION"
ln -sf "libsparse_local.so.$VERSION" "$lib/libsparse_local.so.$SOVERSION"
ln -sf "libsparse_local.so.$VERSION" "$lib/libsparse_local.so"
for file in $pkgconfig; do
    fill "tools/packaging/${file##*/}.in" >"$file"
done
fill tools/packaging/sparse_local-targets.cmake.in >"$cmake/sparse_local-targets.cmake"
fill tools/packaging/sparse_local-config-version.cmake.in \
    >"$cmake/sparse_local-config-version.cmake"
cp tools/packaging/sparse_local-config.cmake "$cmake/sparse_local-config.cmake"
install -m 644 tools/packaging/sparse-local.1 "$man/sparse-local.1"
if [ -x "$PROGRAM" ]; then
    mkdir -p "$bin"
    install -m 755 "$PROGRAM" "$bin/sparse-local"
fi
echo "installed sparse_local $VERSION below $DESTDIR$PREFIX"
