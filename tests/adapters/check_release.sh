#!/bin/bash
# check_release.sh: each file of a release is used in an empty folder, by itself
#
#     tests/adapters/check_release.sh FOLDER          (make check-release)
#
# FOLDER is build/release. CC and PYTHON come from the Makefile. The last line is `N passed, N
# failed`.

release=$(cd "$1" && pwd) || exit 1
cd "$(dirname "$0")/../.." || exit 1
. tests/lib/checks.sh
checks_folder release
CC=${CC:-cc} PYTHON=${PYTHON:-python3}
cd "$dir" || exit 1
empty() {
    rm -rf "$dir/use" && mkdir "$dir/use" && cd "$dir/use" || exit 1
}

tarball=$(find "$release" -maxdepth 1 -name 'sparse_local-*.tar.gz' ! -name '*-manual*')
version=$(basename "$tarball" .tar.gz | sed 's/^sparse_local-//')
check "the checksums" "cd $release && sha256sum --check --strict SHA256SUMS"
check "the contents name each file with its license and checksum" \
    "cd $release && find * -type f ! -name SHA256SUMS ! -name CONTENTS.md | sort >$dir/files &&
     sed -n 's/^| \([^ ]*[.][^ ]*\) .* MIT.* | [0-9]* | \([0-9a-f]*\) |\$/\2  \1/p' \
         CONTENTS.md >$dir/sums &&
     cut -c 67- $dir/sums | cmp - $dir/files && sha256sum --check --strict $dir/sums"
check "the notes are on this version" \
    "head -n 1 $release/NOTES.md | grep -F 'sparse_local $version'"
mkdir source
check "the tarball" "tar -C source --strip-components 1 -xzf $tarball"

# ---- headers: the program of the README ----

awk '/^```c$/ { inside = 1; next } /^```/ { inside = 0 } inside' source/README.md >readme.c
for header in sparse_local.h sparse_local_core.h; do
    check "$header: the README's program" \
        "empty && cp $release/$header $release/sparse_local_mesh.h . &&
         sed 's/sparse_local[.]h/$header/' ../readme.c >readme.c &&
         $CC -O1 -DSL_NO_SIMD readme.c -o readme -lm &&
     ./readme <../source/tools/examples/hill.obj"
done
check "sparse_local_flat.h: pasted into the README's program" \
    "empty && cp $release/sparse_local_mesh.h . &&
     { echo '#define SPARSE_LOCAL_IMPLEMENTATION'; cat $release/sparse_local_flat.h
     sed '/sparse_local.h\"/d; /SPARSE_LOCAL_IMPLEMENTATION/d' ../readme.c; } >readme.c &&
     $CC -O1 -DSL_NO_SIMD readme.c -o readme -lm &&
     ./readme <../source/tools/examples/hill.obj"

# ---- the tarball ----

check "the header of the tarball is the one beside it" \
    "cmp source/sparse_local.h $release/sparse_local.h"
check "make header in the tarball gives the same header" \
    "cd source && make --no-print-directory header && cmp sparse_local.h $release/sparse_local.h"
check "a test from the tarball" \
    "cd source && make --no-print-directory -s build/tests/core/test_solve &&
     build/tests/core/test_solve"

# ---- the manual, the wheel and the npm package ----

check "the manual has its pages" \
    "empty && tar -xzf $release/*-manual.tar.gz && grep -q '<h1' manual/index.html &&
     test -f manual/api.html -a -f manual/errors.html -a -f manual/search.js"
check "the tags of the wheels" \
    "$PYTHON -B $PWD/source/tools/python/wheel_tag.py --check $release/python/*.whl"
check "the wheel for this system, with NumPy and SciPy of the system" \
    "empty && $PYTHON -m pip install --quiet --root-user-action=ignore --no-index --no-deps \
         --disable-pip-version-check --only-binary=:all: --find-links $release/python \
         --target site sparse_local &&
     PYTHONPATH=site $PYTHON -B -c 'if True:
         import numpy as np, scipy.sparse as sp, sparse_local
         A = sp.diags([-np.ones(9), 2.1 * np.ones(10), -np.ones(9)], [-1, 0, 1], format=\"csc\")
         b = np.zeros(10); b[3] = 1
         F = sparse_local.Factor(A)
         assert abs(A @ F.solve(b) - b).max() < 1e-14
         assert F.local([3], [1.0], [5])[0] == F.solve(b)[5]'"
check "the npm package" \
    "empty && mkdir -p node_modules/sparse-local &&
     tar -C node_modules/sparse-local --strip-components 1 -xzf $release/*.tgz &&
     awk '/^...js\$/ { inside = 1; next } /^...\$/ { inside = 0 } inside' \
         node_modules/sparse-local/README.md >use.mjs &&
     node use.mjs | grep -q '0[.]25'"

checks_end
