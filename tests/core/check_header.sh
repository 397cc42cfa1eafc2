#!/bin/sh
# check_header.sh: one check for every promise that the header makes to who includes it (make check-promises)
#
# Compiles small users of sparse_local.h in the ways a stranger would, and runs them. A compiler that is not installed
# is skipped. Ends in a line `N passed, N failed, N skipped`.

cd "$(dirname "$0")/.." || exit 1
dir=build/promises
rm -rf $dir
mkdir -p $dir || exit 1
passed=0 failed=0 skipped=0

cc=${CC:-cc}
cxx=${CXX:-g++}
both="-O1 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -I."
c99="-std=c99 $both -Wstrict-prototypes -Wmissing-prototypes"
cxx11="-x c++ -std=c++11 $both"
libs="-lmetis -lm"

# promise TEXT COMMAND: the promise holds if the command succeeds; it may be a list, in one string.
promise() {
    if (eval "$2") >$dir/log 2>&1; then
        passed=$((passed + 1))
        echo "ok       $1"
    else
        failed=$((failed + 1))
        echo "FAILED   $1"
        echo "    $2" | sed 's/^/    /'
        head -n 40 $dir/log | sed 's/^/    /'
    fi
}

# promise_of COMPILER TEXT COMMAND: only where that compiler is installed.
promise_of() {
    if command -v "$1" >/dev/null 2>&1; then
        promise "$2" "$3"
    else
        skipped=$((skipped + 1))
        echo "skipped  $2: no $1 here"
    fi
}

# ---- the users: C99 and C++11 alike ----

cat >$dir/user.h <<'C'
/* user.h: factors and solves a path of 3 vertices, A = tridiag(-1, 2, -1), b = (0, 0, 4), x = (1, 2, 3) */
#include "sparse_local.h"
#include <math.h>
#include <stdlib.h>

#define OR_FAIL(call) \
    if ((call) != SL_OK) return 1

static int use_sparse_local(void) {
    const sl_int p[] = {0, 2, 4, 5}, i[] = {0, 1, 1, 2, 2}, bset[] = {2}, xset[] = {0};
    const double x[] = {2, -1, 2, -1, 2}, b[] = {0, 0, 4}, one_b = 4;
    double full[3] = {0, 0, 0}, one_x = 0;
    sl_csc A;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_plan *P = NULL;
    A.n_rows = 3;
    A.n_cols = 3;
    A.p = p;
    A.i = i;
    A.x = x;
    OR_FAIL(sl_symbolic_create(&S, &A, NULL, NULL));
    OR_FAIL(sl_factor_create(&F, S, &A, NULL, NULL));
    OR_FAIL(sl_factor_solve(F, full, 3, b, 3, 1, NULL));
    OR_FAIL(sl_plan_create(&P, S, bset, 1, xset, 1, NULL, NULL));
    OR_FAIL(sl_plan_solve(P, F, &one_x, 1, &one_b, 1, 1, NULL));
    sl_plan_free(P);
    sl_factor_free(F);
    sl_symbolic_free(S);
    return !(fabs(full[0] - 1) < 1e-12 && fabs(full[2] - 3) < 1e-12 && fabs(one_x - 1) < 1e-12);
}
C

cat >$dir/one.c <<'C'
#define SPARSE_LOCAL_IMPLEMENTATION
#include "user.h"
int main(void) {
    return use_sparse_local();
}
C

cat >$dir/bodies.c <<'C'
#define SPARSE_LOCAL_IMPLEMENTATION
#include "sparse_local.h"
C

cat >$dir/user.c <<'C'
#include "user.h"
int main(void) {
    return use_sparse_local();
}
C

# declarations first, the bodies later, and everything once more
cat >$dir/twice.c <<'C'
#include "sparse_local.h"
#include "sparse_local.h"
#define SPARSE_LOCAL_IMPLEMENTATION
#include "sparse_local.h"
#include "sparse_local.h"
#include "user.h"
int main(void) {
    return use_sparse_local();
}
C

cat >$dir/static_a.c <<'C'
#define SL_STATIC
#include "user.h"
int other(void);
int main(void) {
    return use_sparse_local() || other();
}
C

cat >$dir/static_b.c <<'C'
#define SL_STATIC
#include "user.h"
int other(void);
int other(void) {
    return use_sparse_local();
}
C

# ---- C ----

promise "plain cc -O2, no -march, no -std" \
    "$cc -O2 -I. $dir/one.c -o $dir/one $libs && $dir/one"
for compiler in gcc clang; do
    promise_of $compiler "$compiler: C99 without a warning" \
        "$compiler $c99 $dir/one.c -o $dir/one_$compiler $libs && $dir/one_$compiler"
    promise_of $compiler "$compiler: C11 and C17 without a warning" \
        "$compiler $c99 -std=c11 -fsyntax-only $dir/one.c && $compiler $c99 -std=c17 -fsyntax-only $dir/one.c"
done
promise "two source files, one with the bodies" \
    "$cc $c99 -c $dir/bodies.c -o $dir/bodies.o && $cc $c99 $dir/user.c $dir/bodies.o -o $dir/two $libs && $dir/two"
promise "included again and again in one file" \
    "$cc $c99 $dir/twice.c -o $dir/twice $libs && $dir/twice"
promise "SL_STATIC in two files linked together" \
    "$cc $c99 $dir/static_a.c $dir/static_b.c -o $dir/static $libs && $dir/static"
promise "SL_NO_METIS needs no METIS" \
    "$cc $c99 -DSL_NO_METIS $dir/one.c -o $dir/no_metis -lm && $dir/no_metis"
promise "SL_VERIFY" \
    "$cc $c99 -DSL_VERIFY $dir/one.c -o $dir/verify $libs && $dir/verify"
promise "-O0 and -O3" \
    "$cc -O0 -I. $dir/one.c -o $dir/o0 $libs && $dir/o0 && $cc -O3 -I. $dir/one.c -o $dir/o3 $libs && $dir/o3"

promise "-ffast-math refuses the bodies, not the declarations" \
    "$cc -O1 -I. -ffast-math -fsyntax-only $dir/user.c && $cc -Ofast -I. -fsyntax-only $dir/user.c &&
     for flag in -ffast-math -Ofast -ffinite-math-only; do
         ! $cc -O1 -I. \$flag -fsyntax-only $dir/bodies.c 2>$dir/refused && grep -q 'NaN' $dir/refused || exit 1
     done"

# ---- C++ ----

for compiler in $cxx clang++; do
    promise_of $compiler "$compiler: C++11 without a warning, user and bodies" \
        "$compiler $cxx11 $dir/one.c -o $dir/one_cxx $libs && $dir/one_cxx"
    promise_of $compiler "$compiler: C++11 user of bodies in C" \
        "$cc $c99 -c $dir/bodies.c -o $dir/bodies.o &&
         $compiler $cxx11 -c $dir/user.c -o $dir/user_cxx.o &&
         $compiler $dir/user_cxx.o $dir/bodies.o -o $dir/mixed $libs && $dir/mixed"
done
promise_of $cxx "$cxx: SL_STATIC in two C++11 files linked together" \
    "$cxx $cxx11 $dir/static_a.c $dir/static_b.c -o $dir/static_cxx $libs && $dir/static_cxx"
promise_of $cxx "$cxx: C++17 and C++20" \
    "$cxx $cxx11 -std=c++17 -fsyntax-only $dir/one.c && $cxx $cxx11 -std=c++20 -fsyntax-only $dir/one.c"

# ---- what it leaves behind ----

# Fails if awk prints anything: the symbols or macros that should not be.
none() {
    found=$(cat)
    [ -z "$found" ] || { echo "$found"; return 1; }
}

promise "the bodies define sl_ symbols, their helpers sli_ ones, and nothing else" \
    "$cc $c99 -fno-pie -c $dir/bodies.c -o $dir/bodies.o &&
     nm --defined-only $dir/bodies.o | awk '\$2 ~ /[A-Z]/ && \$3 !~ /^sl_/ || \$3 !~ /^(sli?_|\\.)/' | none"
promise "no mutable globals" \
    "$cc $c99 -fno-pie -c $dir/bodies.c -o $dir/bodies.o && nm --defined-only $dir/bodies.o | awk '\$2 ~ /[BbDdCcSsGg]/' | none"

# Macros that the header itself has defined and not taken back, the guards of its parts aside: -dD keeps #define and
# #undef, and the line markers say whose they are.
cat >$dir/macros.awk <<'AWK'
/^# [0-9]+ "/ { ours = $3 ~ /sparse_local\.h"$/ }
ours && $1 == "#define" { name = $2; sub(/\(.*/, "", name); left[name] = 1 }
$1 == "#undef" { delete left[$2] }
END { for (name in left) if (name !~ allowed && name !~ /^SLI_[A-Z0-9_]*_H$/) print "left behind: " name }
AWK
promise "a user sees SL_ macros alone" \
    "$cc -std=c99 -I. -E -dD $dir/user.c | awk -v allowed='^(SL_|SPARSE_LOCAL_H\$)' -f $dir/macros.awk | none"
promise "the bodies leave SL_ macros alone" \
    "$cc -std=c99 -I. -E -dD $dir/bodies.c | awk -v allowed='^(SL_|SPARSE_LOCAL_)' -f $dir/macros.awk | none"

# ---- the README ----

# Every ```c block with a main is a program: block 1 to $dir/readme_1.c, and so on.
if [ -f README.md ]; then
    awk -v dir=$dir '
        /^```c$/ { file = dir "/readme_" ++n ".c"; printf "" >file; inside = 1; next }
        /^```/ { inside = 0 }
        inside { print >file }' README.md
    for block in $dir/readme_*.c; do
        grep -q 'int main' "$block" 2>/dev/null || continue
        name=$(basename "$block" .c)
        promise "README.md: $name compiles and runs" \
            "$cc -std=c99 -O1 -Wall -Wextra -I. $block -o $dir/$name $libs && (cd $dir && ./$name)"
    done
fi

echo "$passed passed, $failed failed, $skipped skipped"
[ $failed -eq 0 ]
