#!/bin/sh
# check_abi.sh: compares the declarations of the header with those of the last release, the names of
# adapters, Python, JavaScript and Octave with those of each release, and links programs compiled
# with one header to the library of the other (make abi)
#
#     tests/abi/check_abi.sh [record]
#
# tests/abi/sparse_local-VERSION.h is a release as a compiler sees it: names, types, values of enums
# and structs, without comments and bodies; names-VERSION.txt has the names of the rest, as names.py
# prints them. `record` writes those of this version, at a release. Before 1.0, between releases
# (-dev) and with no record differences are printed; in a release, or with SL_ABI_STRICT=1, they
# fail. New calls, new values at the end of an enum, options and statistics in the place of reserved
# ones, and parameters that may be left out, after the others or by name, are no differences.
# client.c uses only what the oldest record has. CC and VERSION come from the Makefile; ABI_OLD is
# another header to compare with.
# The last line is `N passed, N failed, N skipped`.

cd "$(dirname "$0")/../.." || exit 1
dir=build/abi
rm -rf $dir
mkdir -p $dir || exit 1
. tests/lib/checks.sh
cc=${CC:-cc}
new=$dir/new.h

# declarations HEADER: what HEADER declares, as C that needs no other file of ours.
declarations() {
    echo '#include <stddef.h>'
    echo '#include <stdint.h>'
    printf '#define SL_WITH_ALL\n#include "%s"\n' "$1" | $cc -I. -E -dD -x c - | awk '
        /^# [0-9]+ "/ { ours = $3 ~ /sparse_local[^\/]*\.h"$/; next }
        !ours || /^ *$/ { next }
        /^#(undef|define) (SL_(WITH|HEADER|API|WARN|STATIC|VERSION)|SPARSE_LOCAL)/ { next }
        /^#define [a-zA-Z_0-9]+_needs_|^#define sl_/ { next }
        /^#define SL_/ || !/^#/ { gsub(/__attribute__\(\(warn_unused_result\)\) /, ""); print }'
}

# describe HEADER RESULT: RESULT.abi, the types of all functions, structs and enums of HEADER. The
# structs with reserved fields are described field by field: its type, and its place as the size of
# an array.
describe() {
    {
        echo "#include \"$1\""
        tr '\n' ' ' <"$1" | grep -o 'extern [^;(]*(' | grep -o 'sl_[a-z_0-9]*($' | tr -d '(' |
            sort -u | sed 's/.*/extern __typeof__(\&&) call_&; __typeof__(\&&) call_& = 0;/'
        grep -oE '^\} sl_[a-z0-9_]+;|^typedef [a-z0-9_]+ sl_[a-z0-9_]+;' "$1" |
            grep -oE 'sl_[a-z0-9_]+;' | tr -d ';' | sort -u |
            sed 's/.*/extern & *type_&; & *type_& = 0;/'
        awk '
            /^typedef struct sl_(options|stats|saved_set|[a-z]+_arrays) \{/ {
                type = $3
                printf "char size_%s[sizeof(%s)];\n", type, type
            }
            /^\}/ { type = "" }
            type && /;$/ && !/reserved\[/ {
                field = $NF
                gsub(/^\*+|[;\[].*/, "", field)
                printf "char place_%s_%s[offsetof(%s, %s) + 1];\n", type, field, type, field
                printf "__typeof__(&((%s *)0)->%s) type_%s_%s;\n", type, field, type, field
            }' "$1"
    } >"$2.c" && $cc -g -fPIC -shared -I. "$2.c" -o "$2.so" &&
        abidw --no-corpus-path --no-comp-dir-path --no-show-locs "$2.so" >"$2.abi"
}

# same OLD NEW: whether all of OLD is in NEW as it was, macros included; prints what is not.
same() {
    grep '^#define' "$2" >$dir/macros
    ! grep '^#define' "$1" | grep -vxFf $dir/macros &&
        describe "$1" $dir/a && describe "$2" $dir/b &&
        abidiff --no-added-syms --suppressions tests/abi/reserved.abignore $dir/a.abi $dir/b.abi
}

# differs TEXT SED: a change of the declarations is noticed.
differs() {
    sed "$2" $new >$dir/changed.h
    check "noticed: $1" "! cmp -s $new $dir/changed.h && ! same $new $dir/changed.h"
}

# links COMPILED_WITH LIBRARY: the client runs.
links() {
    $cc -std=c99 -DABI_HEADER="\"$1\"" -I. tests/abi/client.c -o $dir/client "$2" -lm &&
        LD_LIBRARY_PATH=$(dirname "$2") $dir/client
}

# names ROOT [RECORD...]: the names of the tree ROOT, or what they break of the records.
names() {
    python3 -B tests/abi/names.py "$@"
}

declarations sparse_local.h >$new || exit 1
if [ "$1" = record ]; then
    {
        echo "/* sparse_local-$VERSION.h: what version $VERSION declares, as a compiler sees it */"
        cat $new
    } >tests/abi/sparse_local-$VERSION.h
    echo "tests/abi/sparse_local-$VERSION.h: $(grep -c 'extern ' $new) functions"
    names . >$dir/names.txt || exit 1
    {
        echo "# names-$VERSION.txt: what version $VERSION names beside the header, from names.py"
        cat $dir/names.txt
    } >tests/abi/names-$VERSION.txt
    echo "tests/abi/names-$VERSION.txt: $(wc -l <$dir/names.txt) names"
    exit
fi

check "the declarations are complete: the client compiles with them alone" \
    "$cc -std=c99 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -DABI_HEADER='\"$new\"' -I. \
         tests/abi/client.c"
check "they name all functions" \
    "[ \$(grep -c 'extern ' $new) -gt 80 ] && [ \$(grep -c '^typedef' $new) -gt 40 ]"
old=${ABI_OLD:-$(ls tests/abi/sparse_local-*.h 2>/dev/null | sort -V | tail -n 1)}
[ -n "$old" ] || echo 'no release is recorded yet (make abi-record): compared with itself'
old=${old:-$new}
skipped=0
changed=

details() {
    cat $dir/report
}

# compared RECORD STATUS: RECORD is kept if STATUS is 0. If not, that fails in a release.
compared() {
    if [ "$2" -eq 0 ]; then
        echo "ok       all of $1 is declared as it was"
        passed=$((passed + 1))
        return
    fi
    case $VERSION,$SL_ABI_STRICT in
    0.*, | *-dev,)
        echo "changed since $1, before a release:"
        details | sed 's/^/    /'
        ;;
    *) record 1 "all of $1 is declared as it was" ;;
    esac
}

# ---- what is named: adapters, Python, JavaScript, Octave ----

names . >$dir/names.txt || exit 1
for known in tests/abi/names-"${VERSION%%.*}".*.txt; do
    [ -f "$known" ] || continue
    names . "$known" >$dir/report 2>&1
    compared "$known" $?
done
check "names.py notices what breaks a name, and allows what adds one" \
    "python3 -B tests/abi/test_names.py"

# ---- what the header declares ----

if command -v abidiff >/dev/null 2>&1; then
    same "$old" $new >$dir/report
    status=$?
    [ $status -eq 0 ] || changed=1
    compared "$old" $status
    differs "an argument of another type" 's/\(sl_factor_logdet.*\)double \*log/\1float *log/'
    differs "a value of an enum" 's/SL_ERR_PIVOT,/SL_ERR_PIVOT = 17,/'
    differs "a field that moved" 's/^ *sl_int n_cols;/    sl_int n_more, n_cols;/'
    differs "a field of another type" 's/^ *double growth_limit;/    float growth_limit;/'
    differs "a struct that is longer" 's/^ *sl_off reserved\[/    sl_off more; &/'
    differs "an option before others" \
        's/^ *double growth_limit;/    sl_off more; &/; s/reserved\[16\]/reserved[15]/'
    differs "a macro of another value" 's/#define SL_ROW_MAJOR.*/#define SL_ROW_MAJOR 1/'
    differs "a call that is gone" 's/sl_factor_logdet/sl_factor_log_det/'
    sed 's/ SL_ERR_READ_ONLY/&, SL_ERR_NEW/; s/^extern int sl_version.*/& extern int sl_new(int x);/
        s/^ *sl_off reserved\[\([0-9]*\)/    sl_off new_count, reserved[\1 - 1/' $new >$dir/added.h
    check "not counted: a new call, a new status at the end, a reserved field that is used" \
        "[ \$(grep -c -e SL_ERR_NEW -e sl_new -e new_count $dir/added.h) -eq 4 ] &&
         same $new $dir/added.h"
else
    skipped=$((skipped + 1))
    echo "skipped: abidiff is not installed (make deps-abi)"
fi

# ---- what is linked ----

oldest=${ABI_OLD:-$(ls tests/abi/sparse_local-*.h 2>/dev/null | sort -V | head -n 1)}
oldest=${oldest:-$new}
version=$(basename "$oldest" .h | sed 's/^sparse_local-//')
if [ -n "$changed" ]; then
    skipped=$((skipped + 2))
    echo "skipped: programs of $version are not linked with what has changed"
else
    check "a program compiled with $oldest runs with this library" \
        "links $oldest build/lib/libsparse_local.so"
    if [ "$oldest" = $new ]; then
        check "a program compiled with the header itself runs with it" \
            "links sparse_local.h build/lib/libsparse_local.so"
    elif git show "v$version:sparse_local.h" >$dir/sparse_local.h 2>/dev/null; then
        check "a program compiled with this header runs with the library of $version" \
            "$cc -O0 -DSL_NO_SIMD -fPIC -shared -I$dir tools/packaging/sparse_local.c \
                 -o $dir/libsparse_local.so -lm && links $new $dir/libsparse_local.so"
    else
        skipped=$((skipped + 1))
        echo "skipped: the library of $version needs the tag v$version, which is not here"
    fi
fi

echo "$passed passed, $failed failed, $skipped skipped"
[ $failed -eq 0 ]
