#!/bin/sh
# check_pack_builds.sh: sparse_local.h with the core and one pack alone (make check-packs)
#
#     tests/core/check_pack_builds.sh core|all|PACK
#
# The bodies compile without a warning, as C99 by gcc and clang and as C++11, and with
# SL_NO_SINGULAR; each call that is declared has a body, and the other way round; and the header
# of this pack alone, as make header PACKS= writes it, compiles
# and solves a system. For core: each call of a pack is an error that names its macro, and the calls
# of all packs are those of the core and those that it names so.
# CC  the C compiler, default cc; CXX  the C++ compiler, default g++

. "$(dirname "$0")/../lib/checks.sh"
cd "$(dirname "$0")/../.." || exit 1
pack=$1
dir=build/packs/$pack
rm -rf "$dir"
mkdir -p "$dir" || exit 1
cc=${CC:-cc}
cxx=${CXX:-g++}
warnings='-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror'
# gcc finds unused functions only when it compiles; without SIMD that takes a third of the time.
c99="-std=c99 $warnings -Wstrict-prototypes -Wmissing-prototypes -O0 -I."
light=-DSL_NO_SIMD
case $pack in
core) flag=-DSL_WITH_NOTHING selected= ;;
all) flag=-DSL_WITH_ALL selected=$(sed -n 's/.*defined(SL_WITH_ALL).*//
    s/^#if.*defined(SL_WITH_\([A-Z]*\)).*/\1/p' src/sparse_local.in.h | sort -u |
    tr 'A-Z\n' 'a-z ') ;;
*) flag=-DSL_WITH_$(echo "$pack" | tr a-z A-Z) selected=$pack ;;
esac

cat >"$dir/bodies.c" <<'C'
#define SPARSE_LOCAL_IMPLEMENTATION
#include "sparse_local.h"
C
# A = tridiag(-1, 2, -1), b = (0, 0, 4), x = (1, 2, 3)
cat >"$dir/user.c" <<'C'
#define SPARSE_LOCAL_IMPLEMENTATION
#include HEADER
#include <math.h>
#include <string.h>
#define OR_FAIL(call) \
    if ((call) != SL_OK) return 1
int main(void) {
    const sl_int p[] = {0, 2, 4, 5}, i[] = {0, 1, 1, 2, 2}, bset[] = {2}, xset[] = {0};
    const double x[] = {2, -1, 2, -1, 2}, b[] = {0, 0, 4}, one_b = 4;
    double full[3] = {0, 0, 0}, one_x = 0;
    sl_csc A;
    sl_options options = {0};
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_plan *P = NULL;
    sl_stats stats;
    int failed;
    A.n_rows = A.n_cols = 3;
    A.p = p;
    A.i = i;
    A.x = x;
    OR_FAIL(sl_symbolic_create(&S, &A, NULL, NULL));
#ifndef SL_WITH_FLOAT
    options.storage = SL_STORAGE_FLOAT;
    if (sl_factor_create(&F, S, &A, &options, &stats) != SL_ERR_UNSUPPORTED) return 2;
    if (strcmp(stats.error.what, "options.storage needs SL_WITH_FLOAT") != 0) return 2;
#endif
#ifndef SL_WITH_COMPLEX
    options.storage = SL_STORAGE_COMPLEX;
    if (sl_factor_create(&F, S, &A, &options, &stats) != SL_ERR_UNSUPPORTED) return 4;
    if (strcmp(stats.error.what, "options.storage needs SL_WITH_COMPLEX") != 0) return 4;
#endif
    options.storage = SL_STORAGE_DOUBLE;
    OR_FAIL(sl_factor_create(&F, S, &A, &options, NULL));
    OR_FAIL(sl_factor_solve(F, full, 3, b, 3, 1, NULL));
    OR_FAIL(sl_plan_create(&P, S, bset, 1, xset, 1, NULL, NULL));
    OR_FAIL(sl_plan_solve(P, F, &one_x, 1, &one_b, 1, 1, NULL));
    (void)stats;
    failed = fabs(full[0] - 1) > 1e-12 || fabs(full[2] - 3) > 1e-12 || fabs(one_x - 1) > 1e-12;
    sl_plan_free(P);
    sl_factor_free(F);
    sl_symbolic_free(S);
    return failed;
}
C

# declared FLAG: the names of the public functions that are declared
declared() {
    printf '#include "sparse_local.h"\n' | $cc -std=c99 -I. "$1" -DSL_API=@ -E -P -x c - |
        tr '\n' ' ' | tr '@' '\n' | sed -n '1d
            s/__attribute__ *(([a-z_]*))//
            s/^[^(]*[^a-z0-9_]\(sl_[a-z0-9_]*\) *(.*/\1/p' | sort
}

# needed FLAG: the names of those that a macro says need a pack
needed() {
    printf '#include "sparse_local.h"\n' | $cc -std=c99 -I. "$1" -E -dM -x c - |
        sed -n 's/^#define \(sl_[a-z0-9_]*\)(\.\.\.) \1_needs_SL_WITH_.*/\1/p' | sort
}

# same: the two files of names agree
same() {
    diff "$1" "$2"
}

# ---- the header of all packs, with one of them on ----

object=$dir/bodies.o
check "$cc: C99 without a warning, plain C kernels" \
    "$cc $c99 $flag $light -c $dir/bodies.c -o $object"
if command -v clang >/dev/null 2>&1; then
    check 'clang: C99 without a warning, all kernels' "clang $c99 -Wno-enum-float-conversion \
        -Wno-unknown-warning-option $flag -fsyntax-only $dir/bodies.c"
else
    check "$cc: C99 without a warning, all kernels" "$cc $c99 $flag -c $dir/bodies.c -o $dir/simd.o"
fi
check 'without null spaces: C99 without a warning, plain C kernels' \
    "$cc $c99 $flag $light -DSL_NO_SINGULAR -c $dir/bodies.c -o $dir/no_singular.o"
case $pack in
core | all)
    check "$cc: C99 without a warning, all kernels" "$cc $c99 $flag -c $dir/bodies.c -o $dir/simd.o"
    ;;
esac
check "$cxx: C++11 without a warning" \
    "$cxx -x c++ -std=c++11 $warnings -O0 -I. $flag $light -fsyntax-only $dir/bodies.c"
declared "$flag" >"$dir/declared"
check 'each call that is declared has a body, and the other way round' \
    "nm --defined-only $object | sed -n 's/.* T //p' | sort >$dir/defined
     [ -s $dir/declared ] && same $dir/declared $dir/defined"

# ---- the header of this pack alone ----

# --check after writing: the same input gives the same bytes
header=$dir/sparse_local_$pack.h
check 'a header of this pack alone' \
    "build/amalgamate --packs '$selected' src/sparse_local.in.h $header LICENSE &&
     build/amalgamate --check --packs '$selected' src/sparse_local.in.h $header LICENSE"
check 'that header solves a system; options of other packs are refused' \
    "$cc $c99 -I$dir $light -DHEADER='\"sparse_local_$pack.h\"' $dir/user.c -o $dir/user -lm &&
     $dir/user"

# ---- calls of packs that are off ----

if [ "$pack" = core ]; then
    needed "$flag" >"$dir/needed"
    declared -DSL_WITH_ALL >"$dir/of_all"
    every=$(sed -n 's/^#define \(SL_WITH_[A-Z]*\)$/-D\1/p' src/public/packs.h | sort -u)
    check 'the calls of all packs are those of the core and those that it names' \
        "[ -s $dir/needed ] && sort -m $dir/declared $dir/needed >$dir/of_core &&
         same $dir/of_core $dir/of_all"
    echo '#include "sparse_local.h"' >"$dir/include.c"
    check 'all packs may be asked for beside one by name' \
        "$cc $c99 -DSL_WITH_ALL $(echo $every) -fsyntax-only $dir/include.c"
    check 'none of all packs is named as missing' '[ -z "$(needed -DSL_WITH_ALL)" ]'
    { echo '#include "sparse_local.h"'
      awk '{ print "int f" NR "(void);\nint f" NR "(void) { return (int)" $1 "(0); }" }' \
          "$dir/needed"; } >"$dir/calls.c"
    # an error for each of them, and no other one
    check 'each call of a pack is an error that names its macro' \
        "! $cc -std=c99 -I. $flag -fsyntax-only $dir/calls.c 2>$dir/errors &&
         sed -n 's/.*error: .\\(sl_[a-z0-9_]*\\)_needs_SL_WITH_[A-Z].*/\\1/p' $dir/errors |
             sort >$dir/refused && same $dir/needed $dir/refused &&
         [ \$(grep -c error: $dir/errors) -eq \$(wc -l <$dir/needed) ]"
fi
checks_end
