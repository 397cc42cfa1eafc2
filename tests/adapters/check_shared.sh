#!/bin/sh
# check_shared.sh: checks what the compiled libraries of `make shared` export (make test-shared)
#
# CC, VERSION and SOVERSION come from the Makefile. The last line is `N passed, N failed`.

cd "$(dirname "$0")/../.." || exit 1
lib=build/lib
dir=build/check_shared
mkdir -p $dir || exit 1
. tests/lib/checks.sh

# Functions that the header declares: sl_NAME( after SL_API, which may be on the line before.
sed -n '/^#ifndef SPARSE_LOCAL_H/,/^#endif \/\* SPARSE_LOCAL_H/p' sparse_local.h | tr '\n' ' ' |
    sed 's/\/\*[^*]*\*\+\([^/*][^*]*\*\+\)*\///g' | grep -o 'SL_API [^;(]*[( ]' |
    grep -o 'sl_[a-z_0-9]*($' | tr -d '(' | sort -u >$dir/declared
nm -D --defined-only $lib/libsparse_local.so | awk '$2 != "A" { sub(/@.*/, "", $3); print $3 }' |
    sort -u >$dir/exported
nm -g --defined-only $lib/libsparse_local.a | awk 'NF == 3 { print $3 }' | sort -u >$dir/archived
cat >$dir/user.c <<'C'
#include "sparse_local.h"
int main(void) {
    return sl_version() != SL_VERSION || sl_stats_size() != sizeof(sl_stats);
}
C

check "the header declares more than 80 functions" '[ $(wc -l <$dir/declared) -gt 80 ]'
check "the shared library exports what the header declares, nothing else" \
    'diff $dir/declared $dir/exported'
check "the archive defines the same" 'diff $dir/declared $dir/archived'
check "the soname is libsparse_local.so.$SOVERSION" \
    'readelf -d $lib/libsparse_local.so | grep -F "[libsparse_local.so.$SOVERSION]"'
check "the version script has the version of the soname" \
    'grep -F "SPARSE_LOCAL_$SOVERSION {" tools/packaging/libsparse_local.map &&
    nm -D $lib/libsparse_local.so | grep -q "sl_version@@SPARSE_LOCAL_$SOVERSION"'
check "the links lead to libsparse_local.so.$VERSION" \
    '[ "$(readlink $lib/libsparse_local.so)" = libsparse_local.so.$VERSION ] &&
    [ "$(readlink $lib/libsparse_local.so.$SOVERSION)" = libsparse_local.so.$VERSION ]'
check "the library needs the C library only" \
    '! readelf -d $lib/libsparse_local.so | grep NEEDED | grep -v -e "libc\.so" -e "libm\.so" \
    -e "ld-linux"'
check "a program over the shared library runs" \
    '$CC -I. $dir/user.c -o $dir/user -L$lib -lsparse_local &&
    LD_LIBRARY_PATH=$lib $dir/user'
check "a program over the archive runs" \
    '$CC -I. $dir/user.c -o $dir/user $lib/libsparse_local.a -lm && $dir/user'
check "SL_API may be chosen by the user" \
    'printf "#define SL_API __attribute__((visibility(\"hidden\"))) extern\n%s\n%s\n" \
    "#define SPARSE_LOCAL_IMPLEMENTATION" "#include \"sparse_local.h\"" >$dir/hidden.c &&
    $CC -O0 -DSL_NO_SIMD -fPIC -shared -I. $dir/hidden.c -o $dir/hidden.so -lm &&
    [ -z "$(nm -D --defined-only $dir/hidden.so | grep " sl_")" ]'

checks_end
