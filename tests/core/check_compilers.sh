#!/bin/sh
# check_compilers.sh: the header by each installed compiler, old ones too (make test-compilers)
#
#     tests/core/check_compilers.sh [COMPILER ...]
#
# Without arguments gcc-7 to gcc-16 and clang-7 to clang-22, as far as they are installed. Each
# compiles the core and all packs with -O2, without a warning, and runs programs over both: one of
# the core, and tests/abi/client.c, which uses the packs. The last line is `N passed, N failed`.
# gcc 11 takes pointers that a layout has set for uninitialized; that warning is left to newer ones.

cd "$(dirname "$0")/../.." || exit 1
dir=build/compilers
rm -rf $dir
mkdir -p $dir || exit 1
. tests/lib/checks.sh

compilers=$*
if [ -z "$compilers" ]; then
    for version in $(seq 7 22); do
        for compiler in gcc-$version clang-$version; do
            command -v $compiler >/dev/null 2>&1 && compilers="$compilers $compiler"
        done
    done
fi

printf '#define SPARSE_LOCAL_IMPLEMENTATION\n#include "sparse_local.h"\n' >$dir/bodies.c
cat >$dir/core.c <<'C'
#include "sparse_local.h"
int main(void) {
    const sl_int p[] = {0, 2, 4, 5}, i[] = {0, 1, 1, 2, 2};
    const double x[] = {2, -1, 2, -1, 2}, b[] = {0, 0, 4};
    double full[3] = {0, 0, 0};
    const sl_csc A = {3, 3, p, i, x};
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    int failed = sl_symbolic_create(&S, &A, NULL, NULL) != SL_OK;
    failed |= sl_factor_create(&F, S, &A, NULL, NULL) != SL_OK;
    failed |= sl_factor_solve(F, full, 3, b, 3, 1, NULL) != SL_OK;
    sl_factor_free(F);
    sl_symbolic_free(S);
    return failed || full[0] < 0.999 || full[0] > 1.001;
}
C

for compiler in $compilers; do
    quiet=
    case $compiler in *gcc*) quiet=-Wno-maybe-uninitialized ;; esac
    build="$compiler -std=c99 -O2 -Wall -Wextra $quiet -Werror -I."
    check "$compiler: the core" \
        "$build $dir/core.c $dir/bodies.c -o $dir/core -lm && $dir/core"
    check "$compiler: all packs" \
        "$build -DSL_WITH_ALL -DABI_HEADER='\"sparse_local.h\"' tests/abi/client.c $dir/bodies.c \
             -o $dir/all -lm && $dir/all"
done
checks_end
