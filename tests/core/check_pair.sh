#!/bin/sh
# check_pair.sh: the header as two files, sparse_local.h and sparse_local.c, against the single one
#
#     tests/core/check_pair.sh FOLDER HEADER          (make check-pair, make check-release)
#
# FOLDER has the two files and HEADER is the single header; both are used from an empty folder. A
# stranger's project of several files, in C and in C++, is built with chosen packs, with both.
# CC   the C compiler, default cc; CXX  the C++ compiler, default g++
# OPT  of the objects that are compared, default -O2; -O0 takes a tenth of the time

pair=$(cd "$1" && pwd) && single=$(cd "$(dirname "$2")" && pwd)/$(basename "$2") || exit 1
cd "$(dirname "$0")/../.." || exit 1
. tests/lib/checks.sh
checks_folder pair
cc=${CC:-cc} cxx=${CXX:-g++} opt=${OPT:--O2}
c99='-std=c99 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -Wstrict-prototypes'
cxx11='-std=c++11 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror'
packs='-DSL_WITH_CHANGE -DSL_WITH_INVERSE -DSL_WITH_ACCURACY'
cd "$dir" && mkdir project single || exit 1
cp "$pair"/sparse_local.[ch] project
cp "$single" single/sparse_local.h

# ---- what a user sees ----

printf '#include "sparse_local.h"\n' >include.c
for flags in '' "$packs" -DSL_WITH_ALL -DSL_API=mine; do
    check "the same declarations and macros${flags:+: }$flags" "
        for what in '-E -P' '-E -dM'; do
            $cc -std=c99 \$what $flags -Iproject include.c >two.txt &&
            $cc -std=c99 \$what $flags -Isingle include.c >one.txt &&
            [ -s one.txt ] && diff one.txt two.txt || exit 1
        done"
done
check 'a call without its pack is an error that names the macro' "
    printf 'int f(void);\nint f(void) { return sl_selected_free(0); }\n' >>include.c &&
    ! $cc -std=c99 -Iproject -fsyntax-only include.c 2>errors &&
    grep -q sl_selected_free_needs_SL_WITH_INVERSE errors"

# ---- the C file ----

# The same flags, the same code: objdump prints each section. Without optimization a warning can
# change how gcc folds an expression.
printf '#define SPARSE_LOCAL_IMPLEMENTATION\n#include "sparse_local.h"\n' >single/bodies.c
for flags in '' "$packs" -DSL_WITH_ALL; do
    check "without a warning the symbols and the code of the single header, $opt${flags:+ }$flags" "
        $cc $c99 $opt $flags -c project/sparse_local.c -o two.o &&
        $cc $c99 $opt $flags -c single/bodies.c -o one.o &&
        nm one.o >one.txt && nm two.o >two.txt && grep -q ' T sl_factor_create' one.txt &&
        diff one.txt two.txt &&
        objdump -s one.o | sed 1,3d >one.txt && objdump -s two.o | sed 1,3d >two.txt &&
        grep -q 'section .text' one.txt && cmp one.txt two.txt"
done
quiet='-Wno-unknown-warning-option -Wno-enum-float-conversion'
if command -v clang >/dev/null; then
    for flags in '' "$packs" -DSL_WITH_ALL; do
        check "clang: C99 without a warning${flags:+: }$flags" \
            "clang $c99 $quiet $flags -fsyntax-only project/sparse_local.c"
    done
else
    echo 'skipped  clang is not installed'
fi
check "$cxx: the C file as C++11 without a warning" \
    "$cxx -x c++ $cxx11 -DSL_WITH_ALL -fsyntax-only project/sparse_local.c"
check 'renamed' "cp project/sparse_local.c project/other_name.c &&
    $cc -std=c99 -DSL_NO_SIMD -fsyntax-only project/other_name.c && rm project/other_name.c"
check 'a header of another version is refused' "
    mkdir older && cp project/sparse_local.c older &&
    sed 's/VERSION_MINOR [0-9]*/VERSION_MINOR 99/' project/sparse_local.h >older/sparse_local.h &&
    ! $cc -std=c99 -fsyntax-only older/sparse_local.c 2>errors &&
    grep -q 'sparse_local.h is of another version' errors"

# ---- a project: two files in C, one in C++ ----

cat >project/system.h <<'C'
#include "sparse_local.h"
#ifdef __cplusplus
extern "C" {
#endif
/* A = L + 0.01 I of a grid of width x width points, and its analysis and factor */
sl_status make_factor(sl_int width, sl_symbolic **S, sl_factor **F, sl_stats *stats);
#ifdef __cplusplus
}
#endif
C
cat >project/system.c <<'C'
#include "system.h"
#include <stdlib.h>
sl_status make_factor(sl_int width, sl_symbolic **S, sl_factor **F, sl_stats *stats) {
    const sl_int n = width * width;
    sl_int *p = malloc((size_t)(n + 1) * sizeof *p), *i = malloc(3 * (size_t)n * sizeof *i);
    double *x = malloc(3 * (size_t)n * sizeof *x);
    sl_csc A = {n, n, p, i, x};
    sl_status status = SL_ERR_MEMORY;
    if (p && i && x) {
        p[0] = 0;
        for (sl_int j = 0; j < n; j++) {
            sl_int k = p[j];
            i[k] = j, x[k++] = 4.01;
            if ((j + 1) % width) i[k] = j + 1, x[k++] = -1;
            if (j + width < n) i[k] = j + width, x[k++] = -1;
            p[j + 1] = k;
        }
        status = sl_symbolic_create(S, &A, NULL, stats);
        if (!status) status = sl_factor_create(F, *S, &A, NULL, stats);
    }
    free(p), free(i), free(x);
    return status;
}
C
cat >project/main.c <<'C'
#include "system.h"
#include <stdio.h>
enum { WIDTH = 60, N = WIDTH * WIDTH };
int main(void) {
    static double b[N], x[N], d[N], v[2] = {0.5, -0.5};
    const sl_int bset[2] = {7, 1234}, xset[3] = {0, 99, N - 1}, rows[2] = {3, 4}, Vp[2] = {0, 2};
    const double local_b[2] = {1, -3};
    double local_x[3];
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats;
    char text[300];
    sl_csc V;
    V.n_rows = N, V.n_cols = 1, V.p = Vp, V.i = rows, V.x = v;
    b[7] = 1, b[1234] = -3;
    sl_status status = make_factor(WIDTH, &S, &F, &stats);
    if (!status) status = sl_factor_rank_update(F, &V, NULL, NULL, &stats);
    if (!status) status = sl_factor_solve(F, x, N, b, N, 1, NULL);
    if (!status)
        status = sl_local_solve(F, bset, 2, xset, 3, local_x, 3, local_b, 2, 1, NULL, &stats);
    if (!status) status = sl_inverse_diagonal(F, d, NULL, 0, NULL, &stats);
    sl_error_text(text, sizeof text, status, &stats);
    printf("%s\n", text);
    for (int k = 0; k < N; k++)
        printf("%a %a\n", x[k], d[k]);
    for (int k = 0; k < 3; k++)
        if (local_x[k] < x[xset[k]] || local_x[k] > x[xset[k]]) status = SL_ERR_ARGUMENT;
    sl_factor_free(F);
    sl_symbolic_free(S);
    return status != SL_OK;
}
C
cp project/system.[ch] project/main.c single

for from in single project; do
    bodies=bodies.c
    [ $from = single ] || bodies=sparse_local.c
    check "$from: a project in C" "cd $from && $cc $c99 $packs -O1 -c main.c system.c &&
        $cc -std=c99 $opt $packs -c $bodies -o bodies.o &&
        $cc main.o system.o bodies.o -o in_c -lm && ./in_c >in_c.txt && head -n 1 in_c.txt"
    check "$from: its main function in C++" "cd $from &&
        $cxx -x c++ $cxx11 $packs -O1 -c main.c -o main_cxx.o &&
        $cxx main_cxx.o system.o bodies.o -o in_cxx -lm && ./in_cxx >in_cxx.txt"
done
check 'the same bits, by the pair and by the single header' '
    [ "$(wc -l <project/in_c.txt)" -eq 3601 ] && cmp project/in_c.txt single/in_c.txt &&
    cmp project/in_cxx.txt single/in_cxx.txt && cmp project/in_c.txt project/in_cxx.txt'
check 'SL_STATIC: a private copy in one file, which includes the C file' '
    cd project && { echo "#define SL_STATIC"; echo "#include \"sparse_local.c\""
    sed "/include .system.h/d" system.c; sed "/include .system.h/d" main.c; } >all.c &&
    '"$cc -std=c99 -O1 -Wall -Wextra -Werror $packs -DSL_NO_SIMD all.c -o all -lm"' &&
    ./all | head -n 1 && nm all | grep " T sl_factor" >exported; [ ! -s exported ]'
checks_end
