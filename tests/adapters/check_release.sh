#!/bin/bash
# check_release.sh: each file of a release is used in an empty folder, by itself
#
#     tests/adapters/check_release.sh FOLDER          (make check-release)
#
# FOLDER is build/release. CC, CXX, PYTHON and WINE come from the Makefile. The tests that this one
# calls are those of the tarball. The last line is `N passed, N failed`.

release=$(cd "$1" && pwd) || exit 1
cd "$(dirname "$0")/../.." || exit 1
. tests/lib/checks.sh
checks_folder release
CC=${CC:-cc} CXX=${CXX:-g++} PYTHON=${PYTHON:-python3}
cd "$dir" || exit 1
# empty [FILE ...]: an empty folder with these files of the release, which count as used
empty() {
    rm -rf "$dir/use" && mkdir "$dir/use" && cd "$dir/use" || exit 1
    used "$@" && for file in "$@"; do cp "$release/$file" . || exit 1; done
}
used() {
    for file in "$@"; do
        [ -f "$release/$file" ] && echo "$file" >>"$dir/used" || exit 1
    done
}
# without REASON FILE ...: these files are not used here
without() {
    echo "skipped  ${*:2}: $1"
    used "${@:2}"
}
in_release() { (cd "$release" && find . -type f | sed 's/^..//' | grep "$1"); }

tarball=$(find "$release" -maxdepth 1 -name 'sparse_local-*.tar.gz' ! -name '*-manual*')
version=$(basename "$tarball" .tar.gz | sed 's/^sparse_local-//')
check "the checksums" "used SHA256SUMS && cd $release && sha256sum --check --strict SHA256SUMS"
check "the contents name each file with its license and checksum" \
    "used CONTENTS.md && cd $release &&
     find * -type f ! -name SHA256SUMS ! -name CONTENTS.md | sort >$dir/files &&
     sed -n 's/^| \([^ ]*[.][^ ]*\) .* MIT.* | [0-9]* | \([0-9a-f]*\) |\$/\2  \1/p' \
         CONTENTS.md >$dir/sums &&
     cut -c 67- $dir/sums | cmp - $dir/files && sha256sum --check --strict $dir/sums"
check "the notes are on this version" \
    "used NOTES.md && head -n 1 $release/NOTES.md | grep -F 'sparse_local $version'"
mkdir source
check "the tarball" "used ${tarball##*/} && tar -C source --strip-components 1 -xzf $tarball"

# ---- headers: the program of the README ----

awk '/^```c$/ { inside = 1; next } /^```/ { inside = 0 } inside' source/README.md >readme.c
for header in sparse_local.h sparse_local_core.h; do
    check "$header: the README's program" \
        "empty $header sparse_local_mesh.h &&
         sed 's/sparse_local[.]h/$header/' ../readme.c >readme.c &&
         $CC -O1 -DSL_NO_SIMD readme.c -o readme -lm &&
     ./readme <../source/tools/examples/hill.obj"
done
check "sparse_local_flat.h: pasted into the README's program" \
    "empty sparse_local_flat.h sparse_local_mesh.h &&
     { echo '#define SPARSE_LOCAL_IMPLEMENTATION'; cat sparse_local_flat.h
     sed '/sparse_local.h\"/d; /SPARSE_LOCAL_IMPLEMENTATION/d' ../readme.c; } >readme.c &&
     $CC -O1 -DSL_NO_SIMD readme.c -o readme -lm &&
     ./readme <../source/tools/examples/hill.obj"
check "sparse_local_core.h: more lines of comments than in the header with all packs" \
    "[ \$(grep -c '^ *[/ ][*]' $release/sparse_local_core.h) -gt \
       \$(grep -c '^ *[/ ][*]' $release/sparse_local.h) ]"

# ---- the header as two files ----

used pair/sparse_local.h pair/sparse_local.c
check "pair: the calls, the code and the bits of the header, in a project of C and C++" \
    "CC='$CC' source/tests/core/check_pair.sh $release/pair $release/sparse_local.h"

# ---- adapters, each with the header beside it ----

mkdir bodies
printf '#define SPARSE_LOCAL_IMPLEMENTATION\n#include "sparse_local.h"\n' >bodies/bodies.c
check "the bodies with all packs, for the adapters" \
    "cp $release/sparse_local.h bodies && cd bodies &&
     $CC -std=c99 -O1 -DSL_NO_SIMD -DSL_WITH_ALL -c bodies.c"
cat >raii.cpp <<'C'
#include "sparse_local.hpp"
int main() { // A = [2 -1; -1 2], b = (1, 1), x = (1, 1)
    const sl_int p[] = {0, 2, 3}, i[] = {0, 1, 1};
    const double a[] = {2, -1, 2};
    const sl_csc A = {2, 2, p, i, a};
    sl::Symbolic S(A);
    sl::Factor F(S, A);
    std::vector<double> x, y, b(2, 1.0);
    F.solve(x, b);
    sl::Plan P(S, {1}, {0}); // b = (0, 3), x = (1, 2)
    P.solve(y, F, {3.0});
    return !(x[0] > 1 - 1e-14 && x[0] < 1 + 1e-14 && y[0] > 1 - 1e-14 && y[0] < 1 + 1e-14);
}
C
check "sparse_local.hpp: a full and a local solve" \
    "empty sparse_local.h sparse_local.hpp && $CXX -std=c++11 -Wall -Wextra -Werror -O1 -I. \
         ../raii.cpp ../bodies/bodies.o -o raii && ./raii"
check "sparse_local.hpp: the bodies in the same file" \
    "empty sparse_local.h sparse_local.hpp && $CXX -std=c++11 -Wall -Wextra -Werror -O0 -I. \
         -DSL_NO_SIMD -DSPARSE_LOCAL_IMPLEMENTATION ../raii.cpp -o raii && ./raii"
cat >symmetric.c <<'C'
#define SL_WITH_ALL
#include "sparse_local.h"
#include "sparse_local_symmetric.h"
int main(void) { /* A = [0 2; 2 0], b = (2, 4), x = (2, 1) */
    const sl_int p[] = {0, 1, 1}, i[] = {1};
    const double a[] = {2}, b[] = {2, 4};
    double x[2] = {0, 0};
    sl_csc A = {2, 2, p, i, a};
    sl_symmetric *S;
    sl_inertia inertia;
    if (sl_symmetric_create(&S, &A, NULL, NULL) || sl_symmetric_solve(S, x, 2, b, 2, 1, NULL) ||
        sl_symmetric_inertia(S, &inertia, NULL))
        return 1;
    sl_symmetric_free(S);
    return !(x[0] == 2 && x[1] == 1 && inertia.positive == 1 && inertia.negative == 1);
}
C
check "sparse_local_symmetric.h: an indefinite system" \
    "empty sparse_local.h sparse_local_symmetric.h && $CC -std=c99 -Wall -Wextra -Werror -O1 -I. \
         ../symmetric.c ../bodies/bodies.o -o symmetric -lm && ./symmetric"
cat >qdldl.c <<'C'
#include "qdldl.h"
int main(void) { /* A = [2 -1; -1 2], its upper triangle; x = (1, 1) */
    const QDLDL_int p[] = {0, 1, 3}, i[] = {0, 0, 1};
    const QDLDL_float a[] = {2, -1, 2};
    QDLDL_int work[6], Lnz[2], etree[2], Lp[3], Li[1];
    QDLDL_float Lx[1], D[2], Dinv[2], numbers[2], x[2] = {1, 1};
    QDLDL_bool marks[2];
    if (QDLDL_etree(2, p, i, work, Lnz, etree) != 1) return 1;
    if (QDLDL_factor(2, p, i, a, Lp, Li, Lx, D, Dinv, Lnz, etree, marks, work, numbers) != 2)
        return 2;
    QDLDL_solve(2, Lp, Li, Lx, Dinv, x);
    return !(x[0] > 1 - 1e-14 && x[0] < 1 + 1e-14 && x[1] > 1 - 1e-14 && x[1] < 1 + 1e-14);
}
C
check "sparse_local_qdldl.h: a program that includes qdldl.h" \
    "empty sparse_local.h sparse_local_qdldl.h && cp sparse_local_qdldl.h qdldl.h &&
     $CC -std=c99 -Wall -Wextra -Werror -O1 -I. -DSPARSE_LOCAL_QDLDL_IMPLEMENTATION ../qdldl.c \
         ../bodies/bodies.o -o qdldl -lm && ./qdldl"
if echo '#include <Eigen/SparseCore>' | $CXX -I/usr/include/eigen3 -E -x c++ - >eigen.i 2>&1; then
    awk '/^```cpp$/ { inside = 1; next } /^```/ { inside = 0 } inside' \
        source/tools/docs/doors.md >eigen.cpp
    check "sparse_local_eigen.hpp: the manual's program" \
        "empty sparse_local.h sparse_local_eigen.hpp && $CXX -O0 -DSL_NO_SIMD -I. \
             -I/usr/include/eigen3 ../eigen.cpp -o eigen && ./eigen"
    cat >central.cpp <<'C'
#include "sparse_local_geometry_central.hpp"
// as that of geometry-central
template <class T> struct LinearSolver {
    typedef Eigen::Matrix<T, Eigen::Dynamic, 1> V;
    explicit LinearSolver(const Eigen::SparseMatrix<T> &A) : nRows(A.rows()), nCols(A.cols()) {}
    virtual ~LinearSolver() {}
    virtual void solve(V &x, const V &b) = 0;
    virtual V solve(const V &b) = 0;
    Eigen::Index nRows, nCols;
};
int main() {
    Eigen::SparseMatrix<double> A(2, 2);
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) A.insert(i, j) = i == j ? 2 : -1;
    sl::PositiveDefiniteSolver<double, LinearSolver<double>> solver(A);
    LinearSolver<double> &base = solver;
    return (base.solve(Eigen::VectorXd::Ones(2)) - Eigen::VectorXd::Ones(2)).norm() > 1e-14;
}
C
    check "sparse_local_geometry_central.hpp: its class in place of geometry-central's" \
        "empty sparse_local.h sparse_local_eigen.hpp sparse_local_geometry_central.hpp &&
         $CXX -std=c++11 -O0 -DSL_WITH_ALL -I. -I/usr/include/eigen3 ../central.cpp \
             ../bodies/bodies.o -o central && ./central"
else
    without "needs Eigen" sparse_local_eigen.hpp sparse_local_geometry_central.hpp
fi

# A made-up project osqp, with the calls of OSQP's two files that are compiled otherwise.
mkdir -p osqp/algebra/builtin osqp/src osqp/include
cp source/tests/adapters/osqp_interface.h osqp/include
for header in osqp lin_alg types printing qdldl_interface codegen; do
    echo '#include "osqp_interface.h"' >osqp/include/$header.h
done
cat >osqp/CMakeLists.txt <<'CMAKE'
cmake_minimum_required(VERSION 3.19)
project(osqp C)
set(OSQP_ALGEBRA_BUILTIN ON)
add_library(OSQPLIB algebra/builtin/algebra_libs.c src/osqp_api.c)
target_include_directories(OSQPLIB PUBLIC include)
target_link_libraries(OSQPLIB PUBLIC m)
add_executable(use use.c)
target_link_libraries(use OSQPLIB)
CMAKE
cat >osqp/algebra/builtin/algebra_libs.c <<'C'
#include "qdldl_interface.h"
OSQPInt make_solver(qdldl_solver **s, const OSQPMatrix *P, const OSQPMatrix *A,
                    const OSQPSettings *settings);
OSQPInt make_solver(qdldl_solver **s, const OSQPMatrix *P, const OSQPMatrix *A,
                    const OSQPSettings *settings) {
    return init_linsys_solver_qdldl(s, P, A, OSQP_NULL, settings, 1);
}
C
cat >osqp/src/osqp_api.c <<'C'
#include "codegen.h"
OSQPInt write_code(OSQPSolver *solver);
OSQPInt write_code(OSQPSolver *solver) { return codegen_src("", "", solver, 0); }
C
cat >osqp/use.c <<'C'
#include "osqp.h"
#include <stdlib.h>
struct OSQPVectorf { OSQPFloat x[2]; };
struct OSQPMatrix { OSQPInt m, n, p[2], i[1]; OSQPFloat x[1]; };
#define OF(m) (((struct OSQPMatrix *)(size_t)M)->m)
OSQPFloat *OSQPVectorf_data(const OSQPVectorf *v) { return (OSQPFloat *)(size_t)v->x; }
OSQPInt OSQPMatrix_get_m(const OSQPMatrix *M) { return OF(m); }
OSQPInt OSQPMatrix_get_n(const OSQPMatrix *M) { return OF(n); }
OSQPInt *OSQPMatrix_get_p(const OSQPMatrix *M) { return OF(p); }
OSQPInt *OSQPMatrix_get_i(const OSQPMatrix *M) { return OF(i); }
OSQPFloat *OSQPMatrix_get_x(const OSQPMatrix *M) { return OF(x); }
char printed[300];
void *c_malloc(size_t bytes) { return malloc(bytes); }
void *c_calloc(size_t count, size_t bytes) { return calloc(count, bytes); }
void c_free(void *block) { free(block); }
/* QDLDL's, which are not called */
OSQPInt init_linsys_solver_qdldl(qdldl_solver **s, const OSQPMatrix *P, const OSQPMatrix *A,
                                 const OSQPVectorf *rho_vec, const OSQPSettings *settings,
                                 OSQPInt polishing) {
    return (void)s, (void)P, (void)A, (void)rho_vec, (void)settings, (void)polishing, 99;
}
void free_linsys_solver_qdldl(qdldl_solver *s) { (void)s; }
OSQPInt codegen_src(const char *folder, const char *prefix, OSQPSolver *solver, OSQPInt embedded) {
    return (void)folder, (void)prefix, (void)solver, (void)embedded, 99;
}
OSQPInt make_solver(qdldl_solver **s, const OSQPMatrix *P, const OSQPMatrix *A,
                    const OSQPSettings *settings);
OSQPInt write_code(OSQPSolver *solver);
int main(void) { /* a polish: K = [2 + sigma, 1; 1, -sigma], sigma = 1, b = (5, -1), x = (1, 2) */
    const OSQPMatrix P = {1, 1, {0, 1}, {0}, {2}}, A = {1, 1, {0, 1}, {0}, {1}};
    const OSQPSettings settings = {1, 1};
    OSQPVectorf b = {{5, -1}};
    qdldl_solver *made = NULL;
    if (make_solver(&made, &P, &A, &settings) != OSQP_NO_ERROR) return 1;
    LinSysSolver *solver = (LinSysSolver *)(void *)made;
    if (solver->solve(solver, &b, 0) != 0) return 2;
    solver->free(solver);
    return !(b.x[0] > 1 - 1e-14 && b.x[0] < 1 + 1e-14 && b.x[1] > 2 - 1e-14 && b.x[1] < 2 + 1e-14);
}
C
if command -v cmake >/dev/null; then
    check "sparse_local_osqp.c, .cmake: a project as OSQP takes them by one option" \
        "empty sparse_local.h sparse_local_osqp.c sparse_local_osqp.cmake &&
         CC='$CC' cmake -S ../osqp -B build \
             -DCMAKE_PROJECT_osqp_INCLUDE=\$PWD/sparse_local_osqp.cmake &&
         cmake --build build && build/use && nm -A build/libOSQPLIB.a 2>/dev/null |
             grep -q 'osqp_api.*U codegen_src_sparse_local'"
else
    without "needs cmake" sparse_local_osqp.c sparse_local_osqp.cmake
fi

# ---- the tarball ----

check "the header of the tarball is the one beside it" \
    "cmp source/sparse_local.h $release/sparse_local.h"
check "make header in the tarball gives the same header" \
    "cd source && make --no-print-directory header && cmp sparse_local.h $release/sparse_local.h"
check "a test from the tarball" \
    "cd source && make --no-print-directory -s build/tests/core/test_solve &&
     build/tests/core/test_solve"

# ---- the manual, the wheels and the npm package ----

cat >use.py <<'PYTHON'
import numpy as np, scipy.sparse as sp, sparse_local
A = sp.diags([-np.ones(9), 2.1 * np.ones(10), -np.ones(9)], [-1, 0, 1], format="csc")
b = np.zeros(10)
b[3] = 1
F = sparse_local.Factor(A)
assert abs(A @ F.solve(b) - b).max() < 1e-14
assert F.local([3], [1.0], [5])[0] == F.solve(b)[5]
PYTHON
check "the manual has its pages" \
    "empty \$(in_release manual) && tar -xzf *-manual.tar.gz && grep -q '<h1' manual/index.html &&
     test -f manual/api.html -a -f manual/errors.html &&
     node ../source/tests/web/test_search.mjs manual"
check "the wheel for this system, with NumPy and SciPy of the system" \
    "empty && used \$(in_release manylinux) && $PYTHON -m pip install --quiet --no-index --no-deps \
         --root-user-action=ignore --disable-pip-version-check --only-binary=:all: \
         --find-links $release/python --target site sparse_local &&
     PYTHONPATH=site $PYTHON -B ../use.py"
check "the source distribution" \
    "empty \$(in_release 'python/.*tar.gz') && $PYTHON -m pip install --quiet --no-index --no-deps \
         --root-user-action=ignore --disable-pip-version-check --no-build-isolation \
         --target site *.tar.gz && PYTHONPATH=site $PYTHON -B ../use.py"
check "all wheels: tags; the libraries, loaded where there is a compiler for them, or Wine" \
    "used \$(in_release '[.]whl') && $BASH source/tests/adapters/check_wheels.sh $release/python"
check "the npm package" \
    "empty \$(in_release '[.]tgz') && mkdir -p node_modules/sparse-local &&
     tar -C node_modules/sparse-local --strip-components 1 -xzf *.tgz &&
     awk '/^...js\$/ { inside = 1; next } /^...\$/ { inside = 0 } inside' \
         node_modules/sparse-local/README.md >use.mjs &&
     node use.mjs | grep -q '0[.]25'"

check "each file of the release is used, or it is said why not" \
    "in_release . | sort >files && sort -u used | diff - files"
checks_end
