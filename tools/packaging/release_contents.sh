#!/bin/bash
# release_contents.sh: what a release contains: file, what it is, licences, bytes, SHA-256
#
#     tools/packaging/release_contents.sh FOLDER          (make release)
#
# The license of a file is that of LICENSE; beside it stand those of libraries that a compiler has
# linked into it. Ends with 1 if it does not know a file, so that none is published without being
# looked at. HOME_URL comes from the Makefile.

cd "$1" || exit 1
license=$(head -n 1 "$OLDPWD/LICENSE" | cut -d' ' -f1)
status=0
# what FILE: one line on it, and the licences of what is linked in
describe() {
    linked=
    case $1 in
    sparse_local.h) what='the header' ;;
    sparse_local_core.h) what='the core alone, to be read: with its comments' ;;
    sparse_local_flat.h) what='the header without self-inclusion, to be pasted into another file' ;;
    pair/sparse_local.h) what='the header as two files: the declarations' ;;
    pair/sparse_local.c) what='the header as two files: the bodies' ;;
    *.cmake) what=$(sed -n '1s/^# [^:]*: //p' "$1") ;;
    *.c | *.h | *.hpp) what=$(sed -n '1s/^.. [^:]*: //p' "$1") ;;
    python/*manylinux*.whl) what='the Python package for Linux with glibc' ;;
    python/*musllinux*.whl) what='the Python package for Linux with musl' ;;
    python/*win*.whl)
        what='the Python package for 64-bit Windows'
        linked='; MinGW-w64 runtime: ZPL-2.1 and permissive ones'
        linked+='; libgcc: GPL-3.0 with the GCC Runtime Library Exception'
        ;;
    python/*.tar.gz) what='the source distribution of the Python package' ;;
    *-manual.tar.gz) what='the manual; begin with manual/index.html' ;;
    *.tar.gz) what='the repository' ;;
    *.tgz)
        what='the npm package'
        linked='; wasi-libc: MIT and other permissive ones'
        linked+='; compiler-rt: Apache-2.0 with LLVM exceptions'
        ;;
    NOTES.md) what='what is new' ;;
    *)
        echo "release_contents.sh: what is $1?" >&2
        status=1
        ;;
    esac
}

echo "# What this release contains"
[ -z "$HOME_URL" ] || printf '\nHome: %s\n' "$HOME_URL"
cat <<'TEXT'

For C take sparse_local.h, whose first page says how it is used, and for meshes sparse_local_mesh.h.
If you would rather compile a .c file, take the folder pair. For C++ and Eigen put the .hpp files
beside sparse_local.h. The manual needs no network. The repository has all sources, the tests, and
the packages for Octave and MATLAB.

Python, if NumPy is installed; pip takes the right file of the folder python:

    pip install --no-index --find-links python sparse_local

JavaScript, and the checksums of all files; the table leaves out itself and SHA256SUMS:

    npm install ./sparse-local-VERSION.tgz
    sha256sum --check SHA256SUMS
TEXT
printf '\n| file | what it is | license | bytes | SHA-256 |\n|---|---|---|---|---|\n'
for file in $(find . -type f ! -name SHA256SUMS ! -name CONTENTS.md | sed 's/^..//' | sort); do
    describe "$file"
    sum=$(sha256sum "$file" | cut -d' ' -f1)
    echo "| $file | $what | $license$linked | $(wc -c <"$file") | $sum |"
done
exit $status
