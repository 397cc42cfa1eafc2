#!/bin/bash
# size.sh: sizes and compile times of the core, of packs and of all; checks limits (make size)
#
#     [SIZE=full] tools/build/size.sh
#
# Compiled by gcc -O2: the core, the core with all packs, and the core without AVX-512, in plain C
# and without null spaces; then the core in plain C by -O0, as for development. SIZE=full adds the
# core with each pack alone, as the difference to the core; a pack that implies others has them in
# it. A header is that of make header PACKS=. The time is processor time; its share is that of the
# header with all packs. Limits are on bytes: headers, and the text of the objects, the latter only
# on x86-64, where the kernels of AVX2, AVX-512 and plain C are in it. Of all packs the stack is
# limited, too: a frame, and a chain of calls.

cd "$(dirname "$0")/../.." || exit 1
header_limit=1372750      # sparse_local.h
core_header_limit=896500  # the core, with the comments of the implementation
core_text_limit=330800
singular_text_limit=304400 # the core without null spaces
all_text_limit=762200
frame_limit=28000
chain_limit=36000
# What there is to know (count.sh). Limits are lowered, never raised: what needs room removes first.
calls_limit=86           # public calls
options_limit=24         # fields of sl_options
constants_limit=201      # tuning constants
functions_limit=1812     # functions of src
long_functions_limit=0   # functions above 60 lines
wide_functions_limit=36  # functions of more than 6 parameters
folder_limit=23          # files in a folder of src/impl

export CCACHE_DISABLE=1
dir=build/size
mkdir -p $dir || exit 1
printf '#define SPARSE_LOCAL_IMPLEMENTATION\n#include "sparse_local.h"\n' >$dir/bodies.c
TIMEFORMAT=%U
failed=0

# check WHAT NUMBER LIMIT [UNIT]
check() {
    [ "$2" -le "$3" ] && return
    echo "size: $1 has $2 ${4-bytes}, the limit is $3"
    failed=1
}

# selection OPTION ...: the bytes of a header that amalgamate writes
selection() {
    build/amalgamate "$@" src/sparse_local.in.h $dir/sparse_local_size.h LICENSE || exit 1
    wc -c <$dir/sparse_local_size.h
}

# compile FLAG ...: sets text and seconds
compile() {
    seconds=$( { time gcc -std=c99 -O2 -I. "$@" -c $dir/bodies.c -o $dir/bodies.o \
        2>$dir/messages; } 2>&1 ) || {
        cat $dir/messages
        exit 1
    }
    text=$(size $dir/bodies.o | awk 'NR == 2 { print $1 }')
}

# row NAME HEADER TEXT SECONDS [SIGN]: kB, and the share of the time of all packs. HEADER may be -.
# Without SIGN the row is in $dir/sizes.csv, too.
row() {
    [ -n "$5" ] || echo "$1,${2/-/},$3,$4" >>$dir/sizes.csv
    awk -v name="$1" -v header="$2" -v text="$3" -v seconds="$4" -v all="$all_seconds" \
        -v sign="$5" 'BEGIN {
            kB = header == "-" ? "-" : sprintf("%" sign ".0f", header / 1000)
            printf "%-20s %10s %" sign "10.0f %" sign "10.1f %" sign "10.2f\n", name, kB,
                   text / 1000, seconds, seconds / all
        }'
}

header=$(grep -v "^ \* Home: " sparse_local.h | wc -c) # HOME_URL is the publisher's
core_header=$(selection --packs '')
read_header=$(selection --comments --packs '')
rm -f $dir/bodies.ci
graph=-fcallgraph-info=su # from gcc 10 on
gcc $graph -E - </dev/null >/dev/null 2>&1 || graph=
compile -DSL_WITH_ALL $graph -Wsuggest-attribute=cold
# Loops of a user who calls what always ends in cold code would be compiled for few bytes, too.
if grep SL_API $dir/messages; then
    echo 'size: a public call that is taken for cold, or the way to it'
    failed=1
fi
all_text=$text all_seconds=$seconds
echo 'what,header_bytes,object_bytes,compile_s' >$dir/sizes.csv
printf '%-20s %10s %10s %10s %10s\n' '' 'header kB' 'object kB' 'compile s' 'of all'
compile
core_text=$text core_seconds=$seconds
row core "$core_header" "$text" "$seconds"
if [ "$SIZE" = full ]; then
    packs=$(tr -c 'A-Z_\n' '\n' <src/sparse_local.in.h | sed -n 's/^SL_WITH_//p' | sort -u)
    for pack in $packs; do
        compile -DSL_WITH_"$pack"
        bytes=$(selection --packs "$pack")
        row "  $pack" $((bytes - core_header)) $((text - core_text)) \
            "$(echo "$seconds $core_seconds" | awk '{ print $1 - $2 }')" +
    done
fi
row 'all' "$header" "$all_text" "$all_seconds"
for variant in SL_NO_AVX512 SL_NO_SIMD SL_NO_SINGULAR; do
    compile -D$variant
    row "core $variant" - "$text" "$seconds"
done
singular_text=$text # of the last one
compile -O0 -DSL_NO_SIMD
row 'core -O0 SL_NO_SIMD' - "$text" "$seconds"

check sparse_local.h "$header" $header_limit
check 'the header of the core, with comments,' "$read_header" $core_header_limit
case $(gcc -dumpmachine) in
x86_64-*)
    check 'the object of the core' "$core_text" $core_text_limit
    check 'the object of the core without null spaces' "$singular_text" $singular_text_limit
    check 'the object with all packs' "$all_text" $all_text_limit
    ;;
esac
[ -z "$graph" ] || awk -v frame_limit=$frame_limit -v chain_limit=$chain_limit \
    -f tools/build/stack.awk $dir/bodies.ci || failed=1
counts=$(tools/build/count.sh) || exit 1
printf '\n%-20s %10s %10s\n' '' number limit
while read -r name number; do
    limit=${name}_limit
    printf '%-20s %10s %10s\n' "$name" "$number" "${!limit}"
    check src "$number" "${!limit}" "$name"
done <<<"$counts"
[ $failed -eq 0 ] &&
    echo "size: header $header of $header_limit bytes, core $read_header of $core_header_limit;" \
        "objects: all $all_text of $all_text_limit, core $core_text of $core_text_limit"
exit $failed
