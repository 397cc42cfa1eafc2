#!/bin/sh
# check_header.sh: checks each promise that the header makes to its users (make check-promises)
#
# Compiles small programs that include sparse_local.h in different ways, and runs them. Checks that
# need a compiler that is not installed are skipped. So are those that compile for long, unless
# PROMISES=all is set (make check-promises). The last line is `N passed, N failed, N skipped`.

cd "$(dirname "$0")/../.." || exit 1
dir=build/promises
rm -rf $dir
mkdir -p $dir || exit 1
. tests/lib/checks.sh
skipped=0

cc=${CC:-cc}
cxx=${CXX:-g++}
# Without optimization and without SIMD, where that is not what a promise is about: most of the time
# of this script is that of the compilers.
both="-O0 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -I."
light=-DSL_NO_SIMD
all=-DSL_WITH_ALL # most promises are checked of the core, check_pack_builds.sh checks the packs
c99="-std=c99 $both -Wstrict-prototypes -Wmissing-prototypes"
cxx11="-x c++ -std=c++11 $both"
libs=-lm

# promise_of COMPILER TEXT COMMAND: check TEXT COMMAND, skipped if the compiler is not installed.
promise_of() {
    if command -v "$1" >/dev/null 2>&1; then
        check "$2" "$3"
    else
        skipped=$((skipped + 1))
        echo "skipped  $2: $1 is not installed"
    fi
}

# thorough TEXT COMMAND: a promise that is checked only if PROMISES=all.
thorough() {
    if [ "$PROMISES" = all ]; then
        check "$1" "$2"
    else
        skipped=$((skipped + 1))
        echo "skipped  $1: make check-promises"
    fi
}

# builds PROGRAM COMPILER ARGUMENT ...: compiles a program and runs it. gcc and clang only check the
# syntax unless PROMISES=all: other targets run what they make.
builds() {
    result=$1
    shift
    case $PROMISES$1 in
    gcc | clang*) "$@" -fsyntax-only ;;
    *) "$@" -o "$result" $libs && "$result" ;;
    esac
}

# ---- the users, valid C99 and C++11 ----

cat >$dir/user.h <<'C'
/* user.h: factors and solves a path of 3 vertices: A = tridiag(-1, 2, -1), b = (0, 0, 4),
 * x = (1, 2, 3) */
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

# first the declarations, then the bodies, then both again
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

cat >$dir/rows.c <<'C'
/* rows.c: errors of a submatrix are named in rows of A, with stats and without */
#include "sparse_local.h"
#include <math.h>
static int wrong(sl_status status, sl_status wanted, const sl_stats *s, sl_int row,
                 sl_int column) {
    return status != wanted || s->error.row != row || s->error.column != column;
}
int main(void) {
    const sl_int p[] = {0, 2, 4, 6, 7}, i[] = {0, 1, 1, 2, 2, 3, 3};
    const sl_int rows[] = {3, 2}, fixed[] = {0, 1};
    double x[] = {2, -1, 2, -1, 2, -1, 2};
    const sl_csc A = {4, 4, p, i, x};
    sl_symbolic *S = NULL, *T = NULL;
    sl_factor *F = NULL, *G = NULL;
    sl_fixed *D = NULL;
    sl_options natural = {0};
    sl_stats s = {0};
    int failed = 0;
    natural.ordering = SL_ORDERING_NATURAL;
    if (sl_symbolic_create(&S, &A, &natural, NULL) != SL_OK) return 1;
    if (sl_factor_create(&F, S, &A, NULL, NULL) != SL_OK) return 1;
    x[5] = NAN;
    failed += wrong(sl_factor_submatrix(&T, &G, F, &A, rows, 2, NULL, &s), SL_ERR_NOT_FINITE, &s,
                    3, 2);
    failed += sl_factor_submatrix(&T, &G, F, &A, rows, 2, NULL, NULL) != SL_ERR_NOT_FINITE;
    x[5] = x[6] = 0;
    failed += wrong(sl_fixed_create(&D, &A, fixed, 2, NULL, &s), SL_ERR_PIVOT, &s,
                    3, -1);
    failed += sl_fixed_create(&D, &A, fixed, 2, NULL, NULL) != SL_ERR_PIVOT;
    sl_factor_free(F);
    sl_symbolic_free(S);
    return failed;
}
C
cat >$dir/isa.c <<'C'
/* isa.c: checks which instruction sets are refused: all but plain C or, with an argument, AVX-512
 */
#include "sparse_local.h"
#include <stddef.h>
int main(int argc, char **argv) {
    const sl_int p[] = {0, 1}, i[] = {0};
    const double x[] = {2};
    sl_csc A;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_options options = {0};
    sl_stats stats = {0};
    int k, failed = 0;
    (void)argv;
    A.n_rows = A.n_cols = 1;
    A.p = p;
    A.i = i;
    A.x = x;
    if (sl_symbolic_create(&S, &A, NULL, NULL) != SL_OK) return 1;
    failed += sl_factor_create(&F, S, &A, NULL, &stats) != SL_OK;
    failed += argc == 1 && stats.factor.isa != SL_ISA_SCALAR;
    sl_factor_free(F);
    for (k = SL_ISA_SCALAR + 1; k < 32; k++) {
        if (argc > 1 && k != SL_ISA_AVX512) continue;
        options.isa = (sl_isa)k;
        failed += sl_factor_create(&F, S, &A, &options, NULL) != SL_ERR_UNSUPPORTED || F != NULL;
    }
    options.isa = SL_ISA_SCALAR;
    failed += sl_factor_create(&F, S, &A, &options, NULL) != SL_OK;
    sl_factor_free(F);
    sl_symbolic_free(S);
    return failed;
}
C
# The ends of the names of kernels: avx2|avx512|...
simd=$(sed -n 's/^#ifdef SLI_INL_WORDS_//p' sparse_local.h | grep -v SCALAR |
    tr 'A-Z\n' 'a-z|')none

# Fails if there is any input: symbols, macros or lines that should not exist.
none() {
    found=$(cat)
    [ -z "$found" ] || { echo "$found"; return 1; }
}

# ---- C ----

# The objects of the bodies that several promises use.
bodies=$dir/bodies.o
check "the bodies compile alone" "$cc $c99 $all -fno-pie -c $dir/bodies.c -o $bodies"
thorough "plain cc -O2 file.c -lm: no -march, no -std, no other library" \
    "$cc -O2 -I. $dir/one.c -o $dir/one $libs && $dir/one"
for compiler in gcc clang; do
    promise_of $compiler "$compiler: C99 without a warning" \
        "builds $dir/one_$compiler $compiler $c99 $dir/one.c"
    promise_of $compiler "$compiler: C11 and C17 without a warning" \
        "$compiler $c99 -std=c11 -fsyntax-only $dir/one.c &&
         $compiler $c99 -std=c17 -fsyntax-only $dir/one.c"
done
check "two source files, one with the bodies" \
    "$cc $c99 -no-pie -fno-pie $dir/user.c $bodies -o $dir/two $libs && $dir/two"
check "included again and again in one file" \
    "$cc $c99 $light $dir/twice.c -o $dir/twice $libs && $dir/twice"
check "SL_STATIC in two files linked together" \
    "$cc $c99 $light $dir/static_a.c $dir/static_b.c -o $dir/static $libs && $dir/static"
check "SL_NO_METIS overrides SL_METIS and needs no METIS" \
    "$cc $c99 $light -DSL_METIS -DSL_NO_METIS $dir/one.c -o $dir/no_metis -lm && $dir/no_metis"
thorough "SL_METIS adds METIS" \
    "$cc $c99 -DSL_METIS $dir/one.c -o $dir/metis -lmetis -lm && $dir/metis"
check "a copy in a shared library is hidden by default, also if it is declared before" \
    "for file in bodies twice; do
         $cc $c99 $light -fPIC -shared $dir/\$file.c -o $dir/libcopy.so -lm || exit 1
         nm -D --defined-only $dir/libcopy.so | awk '\$3 ~ /^sl_/' | none || exit 1
     done"
thorough "SL_API: a shared library exports the public functions, and nothing else" \
    "$cc $c99 $all -fvisibility=hidden -fPIC -DSL_API='__attribute__((visibility(\"default\")))' \
         -shared $dir/bodies.c -o $dir/libsl.so -lm &&
     nm -D --defined-only $dir/libsl.so | grep -q ' T sl_factor_create' &&
     nm -D --defined-only $dir/libsl.so | awk '\$3 !~ /^sl_/' | none"
thorough "SL_VERIFY" \
    "$cc $c99 -DSL_VERIFY $dir/one.c -o $dir/verify $libs && $dir/verify"
thorough "-O3" "$cc -O3 -I. $dir/one.c -o $dir/o3 $libs && $dir/o3"
# gcc 12 once did, with the options that many users set: factorizations took 1.25 of the time.
case $(uname -m) in
x86_64)
    thorough "-O3 -march=x86-64-v4: no sum of the product of fronts is on the stack" \
        "$cc -O3 -march=x86-64-v4 -I. -S $dir/bodies.c -o $dir/product.s &&
         sed -n '/^sli_product_avx512:/,/cfi_endproc/p' $dir/product.s >$dir/product &&
         grep -q 'vfnmadd.*%zmm' $dir/product && ! grep 'vmovap.*%zmm.*(%rsp)' $dir/product"
    ;;
esac

promise_of tcc "tcc: a compiler without the extensions of gcc and clang" \
    "tcc -Wall -Werror -I. $dir/one.c -o $dir/one_tcc $libs && $dir/one_tcc &&
     tcc -I. $dir/static_a.c $dir/static_b.c -o $dir/static_tcc $libs && $dir/static_tcc"

check "-ffast-math refuses the bodies, not the declarations" \
    "$cc -O1 -I. -ffast-math -fsyntax-only $dir/user.c &&
     $cc -Ofast -I. -fsyntax-only $dir/user.c &&
     for flag in -ffast-math -Ofast -ffinite-math-only; do
         ! $cc -O1 -I. \$flag -fsyntax-only $dir/bodies.c 2>$dir/refused &&
             grep -q 'NaN' $dir/refused || exit 1
     done"

# refused MESSAGE COMMAND: the compiler fails, and says MESSAGE.
refused() {
    message=$1
    shift
    ! "$@" 2>$dir/refused && grep -q "$message" $dir/refused || { cat $dir/refused; return 1; }
}

# ---- where the header lies and what it is called: it includes itself by the name in SL_HEADER ----

x=$dir/third_party/x
mkdir -p $x
cp sparse_local.h $x/sparse_local.h
sed 's|"sparse_local.h"|"third_party/x/sparse_local.h"|' $dir/user.h >$dir/user_in_folder.h
sed 's|user.h|user_in_folder.h|' $dir/one.c >$dir/in_folder.c
sed 's|"sparse_local.h"|<sparse_local.h>|' $dir/user.h >$dir/user_angled.h
sed 's|user.h|user_angled.h|' $dir/one.c >$dir/angled.c
strict="-O0 -Wall -Wextra -Wpedantic -Werror"
for compiler in gcc clang tcc $cxx clang++; do
    case $compiler in
    tcc) how="-c -o $dir/included.o" ;;
    *++*) how="-x c++ -std=c++11 $strict -fsyntax-only" ;;
    *) how="-std=c99 $strict -fsyntax-only" ;;
    esac
    promise_of $compiler "$compiler: included through a folder, which is on the path or not" \
        "$compiler $how $dir/in_folder.c && $compiler $how -I$dir -I$x $dir/in_folder.c"
    promise_of $compiler "$compiler: included as <sparse_local.h>" \
        "$compiler $how -I$x $dir/angled.c"
done

# SL_CONFIG_HEADER gives a program a pack, and the bodies no SIMD
printf '#ifndef MINE_H\n#define MINE_H\n%s\n%s\n#endif\n' '#define SL_NO_SIMD' \
    '#define SL_WITH_INVERSE' >$dir/mine.h
cat >$dir/configured.c <<'C'
#include "user.h"
int main(void) {
    return use_sparse_local() || sl_inverse_diagonal(NULL, NULL, NULL, 0, NULL, NULL) == SL_OK;
}
C
check "SL_CONFIG_HEADER: a header of the user's with the macros, for all files" \
    "mine='-DSL_CONFIG_HEADER=\"mine.h\"'
     $cc $c99 -I$dir \"\$mine\" $dir/configured.c -c -o $dir/configured.o &&
     $cc $c99 -I$dir \"\$mine\" $dir/bodies.c -c -o $dir/configured_bodies.o &&
     $cc $dir/configured.o $dir/configured_bodies.o -o $dir/configured $libs && $dir/configured &&
     nm $dir/configured_bodies.o | grep -E '_($simd)|sl_factor_rank_update' | none &&
     refused 'needs_SL_WITH_INVERSE' $cc $c99 -I$dir -fsyntax-only $dir/configured.c"

cp sparse_local.h $x/renamed.h
sed 's/SL_VERSION_MAJOR != [0-9]*/SL_VERSION_MAJOR != 99/' sparse_local.h >$x/other_version.h
printf '#define SPARSE_LOCAL_IMPLEMENTATION\n#include "third_party/x/renamed.h"\n' >$dir/renamed.c
sed 's|"sparse_local.h"|"third_party/x/renamed.h"|' $dir/user.h >$dir/user_renamed.h
sed 's|user.h|user_renamed.h|' $dir/one.c >$dir/one_renamed.c

rm $x/sparse_local.h
for compiler in gcc clang; do
    promise_of $compiler "$compiler: renamed, with SL_HEADER" \
        "builds $dir/renamed $compiler -std=c99 $strict $light -DSL_HEADER='\"renamed.h\"' \
             $dir/one_renamed.c"
    promise_of $compiler "$compiler: renamed, SL_HEADER missing or wrong: an #error says so" \
        "refused 'define SL_HEADER as its new name' $compiler -fsyntax-only $dir/renamed.c &&
         refused 'define SL_HEADER as its new name' \
             $compiler -fsyntax-only -DSL_HEADER='\"none.h\"' $dir/renamed.c &&
         refused 'names another file' \
             $compiler -fsyntax-only -DSL_HEADER='<math.h>' $dir/renamed.c &&
         refused 'names another version' \
             $compiler -fsyntax-only -DSL_HEADER='\"other_version.h\"' $dir/renamed.c"
done
check "each kernel template is in the header once" \
    "grep -o '^/\\* src/[^ ]*:' sparse_local.h | sort | uniq -d | none"
check "make header-flat: a header that is pasted into a source file" \
    "make --no-print-directory header-flat &&
     { echo '#define SPARSE_LOCAL_IMPLEMENTATION'; cat build/sparse_local_flat.h
       sed '/\"sparse_local.h\"/d' $dir/user.h
       echo 'int main(void) { return use_sparse_local(); }'; } >$dir/pasted.c &&
     ! grep -n 'include SL_HEADER' $dir/pasted.c &&
     $cc -std=c99 $strict $light $dir/pasted.c -o $dir/pasted $libs && $dir/pasted"

# ---- instruction sets ----

check "SL_NO_SIMD, SL_NO_THREAD_LOCAL: plain C kernels, others refused; rows of errors" \
    "$cc $c99 $all -DSL_NO_SIMD -DSL_NO_THREAD_LOCAL -c $dir/bodies.c -o $dir/no_simd.o &&
     nm $dir/no_simd.o | grep -E '_($simd)' | none &&
     $cc -I. $dir/user.c $dir/no_simd.o -o $dir/no_simd $libs && $dir/no_simd &&
     $cc -I. -DSL_WITH_ALL $dir/rows.c $dir/no_simd.o -o $dir/rows $libs && $dir/rows &&
     $cc -I. $dir/isa.c $dir/no_simd.o -o $dir/isa $libs && $dir/isa"
check "SL_NO_AVX512: leaves out only AVX-512" \
    "$cc $c99 $all -DSL_NO_AVX512 -c $dir/bodies.c -o $dir/no_avx512.o &&
     nm $dir/no_avx512.o | grep '_avx512' | none &&
     $cc -I. $dir/user.c $dir/no_avx512.o -o $dir/no_avx512 $libs && $dir/no_avx512 &&
     $cc -I. $dir/isa.c $dir/no_avx512.o -o $dir/isa $libs && $dir/isa avx512"
promise_of $cxx "$cxx: SL_NO_SIMD and SL_NO_AVX512 in C++11" \
    "$cxx $cxx11 -DSL_NO_SIMD -fsyntax-only $dir/one.c &&
     $cxx $cxx11 -DSL_NO_AVX512 -fsyntax-only $dir/one.c"

# ---- C++ ----

for compiler in $cxx clang++; do
    promise_of $compiler "$compiler: C++11 without a warning, user and bodies" \
        "builds $dir/one_cxx $compiler $cxx11 $dir/one.c"
    promise_of $compiler "$compiler: C++11 user of bodies in C" \
        "$compiler $cxx11 -fno-pie -c $dir/user.c -o $dir/user_cxx.o &&
         $compiler -no-pie $dir/user_cxx.o $bodies -o $dir/mixed $libs && $dir/mixed"
done
thorough "$cxx: SL_STATIC in two C++11 files linked together" \
    "$cxx $cxx11 $dir/static_a.c $dir/static_b.c -o $dir/static_cxx $libs && $dir/static_cxx"
promise_of $cxx "$cxx: C++17 and C++20" \
    "$cxx $cxx11 -std=c++17 -fsyntax-only $dir/one.c &&
     $cxx $cxx11 -std=c++20 -fsyntax-only $dir/one.c"

# ---- what it leaves behind ----

# Without optimization gcc keeps the unused functions of <cpuid.h>: __get_cpuid and the like.
# Statics inside a function need no prefix; gcc appends .N to their names.
check "the bodies define sl_ symbols, their helpers sli_ ones, and nothing else" \
    "nm --defined-only $bodies | grep -v ' t __get_cpuid' |
         awk '\$2 ~ /[A-Z]/ && \$3 !~ /^sl_/ || \$3 !~ /^(sli?_|\\.)|\\.[0-9]+\$/' | none"
check "no mutable globals but the last error of each thread; with SL_NO_THREAD_LOCAL none" \
    "nm --defined-only $bodies | awk '\$2 ~ /[BbDdCcSsGg]/ && \$3 != \"sli_last\"' | none &&
     objdump -t $bodies | grep -q '\.tbss.* sli_last\$' &&
     nm --defined-only $dir/no_simd.o | awk '\$2 ~ /[BbCcSsGg]/' | none"

# Macros that the header defines and does not undefine. -dD keeps #define and #undef; the line
# markers name the file that they are in.
cat >$dir/macros.awk <<'AWK'
/^# [0-9]+ "/ { ours = $3 ~ /sparse_local\.h"$/ }
# a call of a pack that is off, turned into an identifier that says so
/_needs_SL_WITH_/ { next }
ours && $1 == "#define" { name = $2; sub(/\(.*/, "", name); left[name] = 1 }
$1 == "#undef" { delete left[$2] }
END { for (name in left) if (name !~ allowed) print "left behind: " name }
AWK
check "the declarations define only SL_ macros" \
    "$cc -std=c99 -I. -E -dD $dir/user.c |
         awk -v allowed='^(SL_|SPARSE_LOCAL_H\$)' -f $dir/macros.awk | none"
for variant in SL_METIS SL_WITH_ALL SL_NO_AVX512 SL_NO_SIMD; do
    check "the bodies undefine all SLI_, SLV_ and SLW_ macros ($variant)" \
        "$cc -std=c99 -I. -D$variant -E -dD $dir/bodies.c |
         awk -v allowed='^(SL_|SPARSE_LOCAL_)' -f $dir/macros.awk | none"
done

# ---- the README ----

# Every ```c block that has a main is a program. Block n is written to $dir/readme_n.c.
if [ -f README.md ]; then
    awk -v dir=$dir '
        /^```c$/ { file = dir "/readme_" ++n ".c"; printf "" >file; inside = 1; next }
        /^```/ { inside = 0 }
        inside { print >file }' README.md
    for block in $dir/readme_*.c; do
        grep -q 'int main' "$block" 2>/dev/null || continue
        name=$(basename "$block" .c)
        check "README.md: $name compiles and runs" \
            "$cc $c99 $light -Itools/adapters $block -o $dir/$name $libs &&
             $dir/$name <tools/examples/hill.obj"
    done
fi

echo "$passed passed, $failed failed, $skipped skipped"
[ $failed -eq 0 ]
