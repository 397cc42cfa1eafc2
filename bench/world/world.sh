#!/bin/sh
# world.sh: projects of others, with their own solver and with ours (make world)
#
#     bench/world/world.sh SOURCES PAGE [NAME ...]
#
# SOURCES  a folder with a checkout NAME of each project that is to be built; others are left out
# PAGE     the table, Markdown: rows of the projects that run are replaced, other rows are kept
# NAME     projects; none: all that have a recipe
# RECIPES  folder of the recipes; default: bench/world/recipes
# OUT      where copies are patched and built; default: build/world
# BUILT    not empty: what the last run has built is run again, as while a recipe is written
# LIBRARY  the object of sparse_local.h with all packs; default: made in OUT
# LIBS     what LIBRARY needs, such as -lmetis; default: nothing
# CC CXX PYTHON JOBS  compilers, Python with NumPy, SciPy and pytest, compilations at a time
#
# README.md says what a recipe is. The last line counts projects, `N passed, N failed`: one fails if
# a step fails, if none of its own tests or fewer than with theirs pass, or if a feature differs.

here=$PWD
lib=$(cd "$(dirname "$0")/lib" && pwd) || exit 1
recipes=$(cd "${RECIPES:-$(dirname "$0")/recipes}" && pwd) || exit 1
: "${OUT:=build/world}" "${CC:=cc}" "${CXX:=c++}" "${PYTHON:=python3}" "${JOBS:=2}"
[ $# -ge 2 ] && [ -d "$1" ] || { echo "world.sh: no folder '$1'; set SOURCES" && exit 1; }
sources=$(cd "$1" && pwd)
page=$2
shift 2
mkdir -p "$OUT" || exit 1
out=$(cd "$OUT" && pwd)
LIBRARY=$(realpath -m "${LIBRARY:-$out/sparse_local.o}")

# ---- for the recipes ----

# The checkout of another project that a recipe needs, by its name.
checkout() {
    [ -d "$sources/$1" ] || { echo "no checkout of $1 in $sources" >&2 && return 1; }
    echo "$sources/$1"
}

# Compiles C or C++ with what the side needs: our headers for ours. WORLD_OURS chooses in programs.
flags() {
    echo "-O2 -w -I$lib"
    [ "$side" = theirs ] || echo "-DWORLD_OURS -I$here -I$here/tools/adapters"
}
library() { [ "$side" = theirs ] || echo "$LIBRARY" $LIBS; }
c() { $CC -std=gnu99 $(flags) "$@" $(library) -lm; }
cxx() { $CXX -std=c++20 $(flags) "$@" $(library); }
cxx_object() { $CXX -std=c++20 $(flags) -c "$@"; }

# Builds a project by CMake in $dir/build: its targets, then the options of the configuration.
cmake_build() {
    targets=$1
    shift
    flags=$(echo $(flags)) libraries="$(library) -lm"
    # in the environment a compiler may be two words, as `ccache gcc`
    CC=$CC CXX=$CXX cmake -S "$src" -B "$dir/build" -DCMAKE_BUILD_TYPE= \
        -DCMAKE_C_FLAGS="$flags" -DCMAKE_CXX_FLAGS="$flags" \
        -DCMAKE_C_STANDARD_LIBRARIES="$libraries" \
        -DCMAKE_CXX_STANDARD_LIBRARIES="$libraries" "$@" &&
        cmake --build "$dir/build" -j "$JOBS" --target $targets
}

# Counts the tests of logs of GoogleTest, Catch2, pytest or ctest on stdin: `passed/all`.
count_tests() {
    awk '
        /^\[  PASSED  \] [0-9]+ test/ { passed += $4; all += $4 }
        /^ *[0-9]+ FAILED TESTS?$/ { all += $1 }
        /^test cases:/ {
            gsub(/\|/, " ")
            all += $3
            for (i = 4; i < NF; i++) if ($(i + 1) == "passed") passed += $i
        }
        /^All tests passed \(.* in [0-9]+ test cases?\)/ {
            sub(/.* in /, "")
            passed += $1; all += $1
        }
        /^=* *([0-9]+ [a-z]+,? ?)+ in [0-9.]+s/ {
            for (i = 1; i < NF; i++) {
                if ($(i + 1) ~ /^passed/) { passed += $i; all += $i }
                if ($(i + 1) ~ /^(failed|error)/) all += $i
            }
        }
        /tests passed, [0-9]+ tests? failed out of [0-9]+/ { passed += $NF - $4; all += $NF }
        END { print passed + 0 "/" all + 0 }'
}

# ---- the driver ----

# Runs a step of the recipe on the side; its output goes to a file of the side.
step() {
    ("$1") >"$dir/$1.out" 2>"$dir/$1.err" </dev/null && return 0 # in a shell of its own: it may cd
    echo "    $1 with $side: FAILED, see $dir/$1.out and .err"
    tail -n "${TAIL:-10}" "$dir/$1.err" | sed 's/^/        /'
    return 1
}

# Features of ours that equal those of theirs: the difference has at most $1 of the norm.
compare() {
    most=$1
    shift
    awk -v most="$most" '
        /^time / { next }
        !($1 in size) { size[$1]; order[++features] = $1 }
        FILENAME == ARGV[1] { value[$1, ++many[$1]] = $2; size[$1] += $2 * $2; next }
        {
            k = ++ours[$1]
            difference[$1] += ($2 - value[$1, k]) ^ 2
            if ($2 !~ /^[-+]?[0-9.]+(e[-+]?[0-9]+)?$/) bad[$1] = 1
        }
        END {
            for (f = 1; f <= features; f++) {
                name = order[f]
                relative = sqrt(difference[name] / (size[name] > 0 ? size[name] : 1))
                equal = many[name] > 0 && many[name] == ours[name] && !bad[name] && relative <= most
                printf "    %s: %d numbers, differ by %.1e%s\n", name, many[name], relative,
                    equal ? "" : ", NOT EQUAL" >"/dev/stderr"
                passed += equal
            }
            print passed + 0 "/" features + 0
        }' "$1" "$2"
}

# The least time of each side over its runs, ours divided by theirs.
ratio() {
    awk '
        /^time / { if (!(FILENAME in least) || $2 < least[FILENAME]) least[FILENAME] = $2 }
        END { if (least[ARGV[1]] > 0) printf "%.2g\n", least[ARGV[2]] / least[ARGV[1]] }' "$1" "$2"
}

lines_changed() {
    diff -rNU0 "$work/theirs/src" "$work/ours/src" | grep -c '^+[^+]\|^+$\|^+++[^ ]'
}

# A side: a copy of the checkout, patched if it is ours, built.
make_side() {
    side=$1 dir=$work/$1 src=$work/$1/src
    rm -rf "$dir"
    mkdir -p "$src"
    (cd "$sources/$name" && tar cf - --exclude .git .) | (cd "$src" && tar xf -) || return 1
    [ "$side" = ours ] || return 0
    [ -f "$recipes/$name.patch" ] || return 0
    patch -d "$src" -p1 --no-backup-if-mismatch <"$recipes/$name.patch" >"$dir/patch" ||
        { cat "$dir/patch" && return 1; }
}

on() { side=$1 dir=$work/$1 src=$work/$1/src; }

# Prints what happens, and leaves the row of the table in $work/row.
project() {
    name=$1 work=$out/$1 has_tests=yes
    . "$recipes/$name.sh"
    is=$(git -C "$sources/$name" rev-parse HEAD 2>/dev/null | cut -c 1-7)
    echo "$name at ${is:-an unknown commit}"
    [ "$is" = "$commit" ] || echo "    the recipe was written for $commit"
    row() { printf '| %s | %s | %s | %s | %s | %s |\n' "$name" "${is:-?}" "$@" >"$work/row"; }
    if [ -z "$BUILT" ]; then
        if ! { make_side theirs && make_side ours; }; then
            row - "the patch does not apply" - -
            return 1
        fi
        lines_changed >"$work/changed"
        for side in theirs ours; do
            on $side
            step build || { row "$(cat "$work/changed")" "no build with $side" - - && return 1; }
        done
    fi
    rm -f "$work"/*/times
    changed=$(cat "$work/changed")
    theirs=1 ours=1 tests=none
    if [ "$has_tests" = yes ]; then
        for side in theirs ours; do
            on $side
            step own
        done
        theirs=$(count_tests <"$work/theirs/own.out") ours=$(count_tests <"$work/ours/own.out")
        tests="$theirs, $ours"
    fi
    echo "    own tests: $tests"
    for turn in 1 2; do
        for side in theirs ours; do
            on $side
            step features && step size && grep '^time ' "$dir/size.out" >>"$dir/times" || {
                row "$changed" "$tests" "stopped with $side" - && return 1
            }
        done
    done
    equal=$(compare 1e-8 "$work/theirs/features.out" "$work/ours/features.out" 2>"$work/compare")
    times=$(ratio "$work/theirs/times" "$work/ours/times")
    size=$(compare 1e-6 "$work/theirs/size.out" "$work/ours/size.out" 2>>"$work/compare")
    [ "$size" = "1/1" ] || times=
    cat "$work/compare"
    echo "    features equal: $equal; time: $times, $timed"
    row "$changed" "$tests" "$equal" "${times:--}, $timed"
    [ -n "$times" ] && [ "${equal%/*}" = "${equal#*/}" ] &&
        [ "${theirs%/*}" -gt 0 ] && [ "${ours%/*}" -ge "${theirs%/*}" ]
}

write_page() {
    {
        cat "$lib/page_head.md"
        {
            [ ! -f "$page" ] || grep '^| [^ ]* | [0-9a-f?]\{1,7\} |' "$page"
            cat "$out"/rows/* 2>/dev/null
        } | awk '{ row[$2] = $0 } END { for (name in row) print row[name] }' | LC_ALL=C sort -f
    } >"$out/page.md"
    cp "$out/page.md" "$page"
}

make_library() {
    [ "$LIBRARY" != "$out/sparse_local.o" ] || [ "$LIBRARY" -nt "$here/sparse_local.h" ] ||
        $CC -std=c99 -O2 -w -fPIC -DSL_WITH_ALL -DSPARSE_LOCAL_IMPLEMENTATION -x c \
            -c "$here/sparse_local.h" -o "$LIBRARY"
}

make_library || exit 1
[ $# -gt 0 ] || set -- $(cd "$recipes" && ls | sed -n 's/\.sh$//p')
rm -rf "$out/rows"
mkdir -p "$out/rows"
passed=0 failed=0
for name; do
    if [ ! -f "$recipes/$name.sh" ]; then
        echo "$name: no recipe in $recipes"
        failed=$((failed + 1))
        continue
    fi
    if [ ! -d "$sources/$name" ]; then
        echo "$name: skipped, no checkout in $sources"
        continue
    fi
    if (project "$name"); then passed=$((passed + 1)); else failed=$((failed + 1)); fi
    cp "$out/$name/row" "$out/rows/$name"
done
write_page
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
