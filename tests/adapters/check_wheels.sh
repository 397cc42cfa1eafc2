#!/bin/bash
# check_wheels.sh: wheels have the tag that pip wants, and each works on its platform
#
#     tests/adapters/check_wheels.sh FOLDER [CHROOT]      (make test-wheels)
#
# FOLDER has what make wheels made. Where a compiler for a platform is missing, or Wine, its
# library is not run. CHROOT is an older Debian with NumPy and pip (make old-debian): pip there
# installs the wheel and solves. CC, PYTHON, WINE and SOURCE_DATE_EPOCH come from the Makefile. The
# last line is `N passed, N failed`.

wheels=$(cd "$1" && pwd) || exit 1
chroot=$2
cd "$(dirname "$0")/../.." || exit 1
. tests/lib/checks.sh
checks_folder wheels
root=$PWD
CC=${CC:-cc} PYTHON=${PYTHON:-python3}
pip="$PYTHON -m pip --disable-pip-version-check"
install="$pip install --quiet --root-user-action=ignore --no-index --no-deps"
tag="$PYTHON -B $root/tools/python/wheel_tag.py"
cd "$dir" || exit 1

cat >solve.py <<'END'
import sys
import numpy as np
import sparse_local
n = 100
k = np.arange(n)
values = np.r_[np.full(n, 2.1), np.full(n - 1, -1.0)]
A = sparse_local.from_triplets(n, np.r_[k, k[1:]], np.r_[k, k[:-1]], values)
F, b = sparse_local.Factor(A), np.cos(k)
x = F.solve(b)
r = b - 2.1 * x
r[1:] += x[:-1]
r[:-1] += x[1:]
assert abs(r).max() < 1e-13
F.save(sys.argv[1])
assert (sparse_local.Factor.load(sys.argv[1], map=True).solve(b) == x).all()
print(sparse_local.library_path())
END

# accepts TAG WHEEL: would pip install it on a system with this tag?
accepts() {
    rm -rf target
    $install --platform "$1" --only-binary=:all: --target target "$2"
}

for kind in manylinux musllinux win_amd64; do
    wheel=$(echo "$wheels"/*-py3-none-$kind*.whl)
    check "$kind: name, WHEEL and RECORD are those of the library" "$tag --check $wheel"
    name=$(basename "$wheel" .whl)
    one=${name##*-}
    check "$kind: pip accepts ${one%%.*}" "accepts ${one%%.*} $wheel"
    check "$kind: pip refuses it elsewhere" "! accepts linux_armv7l $wheel"
    check "$kind: a wrong tag is refused" \
        "cp $wheel ${name%-*}-manylinux_2_5_x86_64.whl &&
         ! $tag --check ${name%-*}-manylinux_2_5_x86_64.whl"
    mkdir $kind && $PYTHON -m zipfile -e "$wheel" $kind
done
check "a newer system's tag is accepted, an older one's is not" \
    "accepts manylinux2014_x86_64 $wheels/*manylinux*.whl &&
     ! accepts manylinux_2_5_x86_64 $wheels/*manylinux*.whl"

# ---- the libraries ----

linux=manylinux/sparse_local/libsparse_local.so
musl=musllinux/sparse_local/libsparse_local.so
windows=win_amd64/sparse_local/sparse_local.dll
# Calls that the header declares, as sl_NAME( after SL_API, which may be on the line before
awk '/^SL_API/ || after { after = /^SL_API/; if (match($0, /sl_[a-z0-9_]+\(/)) {
    print substr($0, RSTART, RLENGTH - 1); after = 0 } }' "$root/sparse_local.h" | sort -u >declared
exported() {
    case $1 in
    *.dll) objdump -p "$1" ;;
    *) objdump -T "$1" | grep -v '\*UND\*' ;;
    esac | grep -o '\bsl_[a-z0-9_]*$' | sort -u
}
for library in $linux $musl $windows; do
    check "${library%%/*}: exports what the header declares" "exported $library | cmp - declared"
done
program="-std=gnu99 -O1 -Wall -Wextra -Werror -I$root $root/tests/adapters/use_library.c"
check "glibc: a C program loads the library" \
    "$CC $program -o use_glibc -ldl -lm && ./use_glibc $dir/$linux saved"
if command -v musl-gcc >/dev/null; then
    check "musl: a C program loads the library" \
        "musl-gcc $program -o use_musl -lm && ./use_musl $dir/$musl saved"
fi
if command -v x86_64-w64-mingw32-gcc >/dev/null && $WINE wineboot -i >/dev/null 2>&1; then
    check "Windows: a C program loads the DLL, in Wine" \
        "x86_64-w64-mingw32-gcc $program -o use_windows.exe &&
         $WINE use_windows.exe $windows saved"
fi

# ---- Python ----

if [ -d "$wheels-source" ]; then # what make wheels was made from; a release is without it
    check "the same files give the same source distribution" \
        "cp -r $wheels-source again && find again -exec touch {} + &&
         $root/tools/python/wheels.sh again $dir/sdist && cmp sdist/*.tar.gz $wheels/*.tar.gz"
fi

check "a fresh environment: pip installs the wheel by its tag, and it solves" \
    "$PYTHON -m venv --without-pip --system-site-packages fresh &&
     fresh/bin/python -m pip install --quiet --no-index --find-links $wheels --no-deps \
         --only-binary=:all: sparse_local &&
     fresh/bin/python -B solve.py saved | grep -F $dir/fresh/"
check "the source distribution: pip builds and installs it, without any other file" \
    "$PYTHON -m venv --without-pip --system-site-packages built &&
     CC='$CC' CFLAGS='-O0 -DSL_NO_SIMD' built/bin/python -m pip install --quiet --no-index \
         --no-deps --no-build-isolation $wheels/*.tar.gz &&
     built/bin/python -B solve.py saved | grep -F $dir/built/"
if echo '#include <metis.h>' | $CC -E -x c - >/dev/null 2>&1; then
    check "the source distribution: METIS by CFLAGS and LDFLAGS, which no tag allows" \
        "CC='$CC' CFLAGS='-O0 -DSL_NO_SIMD -DSL_METIS' LDFLAGS=-lmetis $pip wheel --quiet \
             --no-index --no-deps --no-build-isolation --wheel-dir metis $wheels/*.tar.gz &&
         ! $tag metis/*.whl && $install --target with_metis metis/*.whl &&
         PYTHONPATH=with_metis $PYTHON -B -c 'if True:
             import numpy as np, sparse_local as sl
             k = np.arange(9)
             F = sl.Factor(sl.from_triplets(9, k, k, k + 1.0), ordering=\"metis\")
             assert (F.solve(k + 1.0) == 1).all()'"
fi
for compiler in x86_64-w64-mingw32-gcc-win32 x86_64-w64-mingw32-gcc-posix; do
    command -v $compiler >/dev/null || continue
    check "the source distribution: $compiler makes a wheel for Windows" \
        "CC=$compiler CFLAGS='-O0 -DSL_NO_SIMD' $pip wheel --quiet --no-index --no-deps \
             --no-build-isolation --wheel-dir $compiler $wheels/*.tar.gz &&
         $tag $compiler/*.whl | grep win_amd64"
done
if [ -n "$chroot" ]; then
    # the library saves by /proc
    enter="unshare --mount --pid --fork chroot $chroot sh -ec"
    check "an older Debian: $(cat "$chroot/etc/debian_version"), $(ls "$chroot"/lib/*/libc-*.so)" \
        "rm -rf $chroot/tmp/wheels && mkdir $chroot/tmp/wheels &&
         cp $wheels/*manylinux*.whl solve.py $chroot/tmp/wheels &&
         $enter 'mount -t proc proc /proc && cd /tmp/wheels &&
             python3 -m pip --version && python3 -m pip install --no-index --no-deps \
                 --target site sparse_local-*.whl && PYTHONPATH=site python3 -B solve.py saved'"
fi

checks_end
