#!/bin/bash
# size.sh: prints the sizes of header and object and the compile time; checks limits (make size)
#
# Compiled by gcc -O2, in three variants: all kernels, without AVX-512, plain C only. The time is
# processor time. The limits are on the header and on the text of the object with all kernels; the
# second is checked only on x86-64.

cd "$(dirname "$0")/../.." || exit 1
header_limit=1245000 # bytes
text_limit=865000   # bytes: with the kernels of AVX2, AVX-512 and plain C

dir=build/size
mkdir -p $dir || exit 1
printf '#define SPARSE_LOCAL_IMPLEMENTATION\n#include "sparse_local.h"\n' >$dir/bodies.c
TIMEFORMAT=%U
failed=0

# check WHAT BYTES LIMIT
check() {
    [ "$2" -le "$3" ] && return
    echo "size: $1 has $2 bytes, the limit is $3"
    failed=1
}

header=$(wc -c <sparse_local.h)
printf '%-14s %12s %12s %12s\n' '' 'header kB' 'object kB' 'compile s'
for variant in SL_ALL_KERNELS SL_NO_AVX512 SL_NO_SIMD; do
    object=$dir/$variant.o
    seconds=$( { time gcc -std=c99 -O2 -I. -D$variant -c $dir/bodies.c -o $object; } 2>&1 ) || {
        echo "$seconds"
        exit 1
    }
    text=$(size $object | awk 'NR == 2 { print $1 }')
    [ $variant = SL_ALL_KERNELS ] && name='all kernels' full=$text || name=$variant
    awk -v name="$name" -v header="$header" -v text="$text" -v seconds="$seconds" \
        'BEGIN { printf "%-14s %12.0f %12.0f %12.1f\n", name, header / 1000, text / 1000, seconds }'
done
check sparse_local.h "$header" $header_limit
case $(gcc -dumpmachine) in
x86_64-*) check 'the object' "$full" $text_limit ;;
esac
[ $failed -eq 0 ] &&
    echo "size: header $header of $header_limit bytes, object $full of $text_limit bytes"
exit $failed
