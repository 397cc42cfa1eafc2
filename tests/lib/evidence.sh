#!/bin/bash
# evidence.sh: what a release is tested with: targets and fuzzers, kept with the code they ran on
#
#     tests/lib/evidence.sh SECONDS [TARGET ...]      (make evidence)
#     tests/lib/evidence.sh --table [TARGET ...]      (make test-page)
#
# Runs each target, beside all fuzzers, each of which gets SECONDS in all. Without targets: all.
# A call goes on where the last one stopped: what has passed on this code, on any machine, is not
# run again, and a fuzzer gets the rest of its seconds. The code is a hash of what a target may
# read: src, tools, tests, bench, the Makefile and the header without pages, figures and results;
# without packages and adapters where C is tested; and without other tests for fuzzers.
#
# Results are in tests/evidence.tsv, a row for the last run of each target; logs are in
# build/evidence. Ends with the table, and with 1 if something failed or was not run.
# FUZZ_SLICE  seconds of a fuzzer after which its result is kept, 600

# First what continuous integration (.ci/run, .ci/nightly) does not run, or runs in part.
rare='judge cov mcdc test-msan valgrind test-i386 test-i386-x87 test-armhf test-s390x test-exchange
    test-ppc64le test-riscv64 test-musl test-tcc test-mingw test-mingw-clang test-wasm
    test-compilers check-promises test-pthreads test-no-singular
    test-python-build test-workers'
nightly='test-aarch64 sanitize test-clang test-cxx test-openmp test-no-metis test-packs check-pair
    test-clients test-npm test-view test-live test-wheels test-octave check-install'
often='size check-packs test-no-simd test-stack test-shared abi test-examples docs test-home
    test-adapters test-python races test'
# Of these, what compiles and runs C alone.
in_c=" judge cov mcdc valgrind sanitize races $(echo test-{msan,i386,i386-x87,armhf,s390x} \
    test-{exchange,ppc64le,riscv64,musl,tcc,mingw,mingw-clang,pthreads,openmp,no-singular} \
    test-{aarch64,clang,no-metis,packs,no-simd,stack}) "
file=tests/evidence.tsv
dir=build/evidence
tab=$(printf '\t')
make="${MAKE:-make} --no-print-directory"
jobs=$(getconf _NPROCESSORS_ONLN)

seconds=$1
shift
targets=${*:-$rare $nightly $often}
fuzzers=$(for f in tests/fuzz/fuzz_*.c; do [ ! -f "$f" ] || basename "$f" .c | sed s/fuzz_//; done)
all="$targets $(echo "$fuzzers" | sed 's/^./fuzz-&/')" # rows of the table
mkdir -p "$dir"

# ---- the code, and the machine ----

code_alone() {
    grep -v -e '[.]md$' -e "^$file\$" -e '^tools/docs/figures/' -e '^tools/pictures/' | sort -u
}
places='src tools tests bench Makefile sparse_local.h'
sums=$({ git ls-files -co --exclude-standard -- $places 2>/dev/null || find $places -type f; } |
    code_alone | xargs sha256sum 2>/dev/null)
# code_without PATHS: a hash of the files whose names do not begin so
code_without() {
    echo "$sums" | grep -v -E "^[0-9a-f]*  ($1)" | sha256sum | cut -c 1-12
}
others='tests/(adapters|abi|web|lib/evidence)|tools/(adapters|docs|octave|packaging|python|web)'
code_of_all=$(code_without none)
code_of_c=$(code_without "$others")
elsewhere='tests/(core|tools|lib/[^s])|tools/(build|cli|draw|examples)|bench' # but lib/saved_*.h
code_of_fuzzers=$(code_without "$others|$elsewhere")

# code_of TARGET
code_of() {
    case $1,$in_c in
    fuzz-*) echo "$code_of_fuzzers" ;;
    *,*" $1 "*) echo "$code_of_c" ;;
    *) echo "$code_of_all" ;;
    esac
}
commit=$(git rev-parse --short HEAD 2>/dev/null || echo none)
changed=$(git status --porcelain -- $places 2>/dev/null | cut -c 4- | code_alone)
commit=$commit${changed:+-changed}
processor=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo 2>/dev/null | head -n 1)
compiler=$(cc --version 2>/dev/null | sed 's: ([^)]*)::; q')
machine="${processor:-$(uname -m)}, $jobs cores, $compiler"

# ---- results ----

# A row: target, code, status, passed, failed, skipped, commit, date, machine, seconds, remark

# row TARGET: its last result; empty if there is none
row() {
    [ ! -f "$file" ] || awk -F "$tab" -v target="$1" '$1 == target' "$file"
}

# keep TARGET STATUS PASSED FAILED SKIPPED SECONDS REMARK: a row in a file of its own, at once
keep() {
    [ "$2 $3 $4 $5" != 'passed 0 0 0' ] || set -- "$1" "$2" yes 0 0 "$6" "$7" # it does not count
    printf '%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\n' \
        "$1" "$(code_of "$1")" "$2" "$3" "$4" "$5" \
        "$commit" "$(date +%Y-%m-%d)" "$machine" "$6" "$7" >"$dir/new-$1" &&
        mv "$dir/new-$1" "$dir/$1.row"
}

# Puts the rows of $dir into the file, in place of older ones.
collect() {
    for new in "$dir"/*.row; do
        [ -f "$new" ] || continue
        target=$(basename "$new" .row)
        { [ ! -f "$file" ] || awk -F "$tab" -v target="$target" '$1 != target' "$file"
          cat "$new"; } | sort >"$dir/all" && mv "$dir/all" "$file" # whole, if this is killed
    done
}

# has_passed TARGET: on this code
has_passed() {
    row "$1" | awk -F "$tab" -v code="$(code_of "$1")" '{ yes = $2 == code && $3 == "passed" }
        END { exit !yes }'
}

# counts LOG: passed, failed and skipped tests: lines of run.sh and of scripts, of cmocka, of pytest
counts() {
    awk '
        /^[0-9]+ passed, [0-9]+ failed/ { passed += $1; failed += $3; skipped += $5; next }
        /^\[  PASSED  \] [0-9]+ test/ { passed += $4 }
        /^\[  FAILED  \] [0-9]+ test/ { failed += $4 }
        / in [0-9.]+s/ && / passed| failed/ {
            gsub(/[=,]/, "")
            for (k = 2; k <= NF; k++) {
                if ($k == "passed") passed += $(k - 1)
                if ($k == "failed" || $k ~ /^errors?$/) failed += $(k - 1)
                if ($k == "skipped") skipped += $(k - 1)
            }
        }
        END { print passed + 0, failed + 0, skipped + 0 }' "$1"
}

# remark TARGET LOG: what else a log says
remark() {
    case $1 in
    cov)
        awk '/^(lines|branches):/ { sub(":", "", $1); text = text ", " $1 " " $2 }
            END { print substr(text, 3) }' build/cov/summary.txt 2>/dev/null
        ;;
    mcdc)
        awk '/ conditions decide alone/ { met += $2; all += $4 }
            END { if (all) print met " of " all " conditions decide alone" }' "$2"
        ;;
    judge) echo '1,000,000 systems' ;;
    esac | tr '\t|' '  '
}

# ---- the table ----

# One line for each target: that of this code, or what was run before it.
table() {
    echo "Of commit $commit:"
    printf '\n| target | passed | failed | skipped | commit | date | machine | seconds | remark |\n'
    echo '|---|---|---|---|---|---|---|---|---|'
    for target in $all; do
        row "$target" | awk -F "$tab" -v target="$target" -v code="$(code_of "$target")" '
            { found = 1 }
            {
                if ($2 != code) $7 = "not run on this code; last on " $7
                if ($3 ~ /failed|skipped/) $11 = "**" $3 "** " $11
                printf "| `%s`", target
                for (k = 4; k <= 11; k++) printf " | %s", $k
                print " |"
            }
            END { if (!found) printf "| `%s` | | | | not run on this code | | | | |\n", target }'
    done
}
if [ "$seconds" = --table ]; then
    collect
    table
    exit 0
fi

# ---- fuzzers ----

# done_before NAME: executions and seconds of a fuzzer on this code, without a failure
done_before() {
    { row "fuzz-$1"; cat "$dir/fuzz-$1.row" 2>/dev/null; } |
        awk -F "$tab" -v code="$code_of_fuzzers" '
        $2 == code { runs = $3 == "failed" ? 0 : $4 + 0; spent = $3 == "failed" ? 0 : $10 + 0 }
        END { print runs + 0, spent + 0 }'
}

# fuzz_slice NAME: one more slice, added to what was done
fuzz_slice() {
    set -- "$1" $(done_before "$1")
    left=$((seconds - $3))
    [ "$left" -gt 0 ] || return 1
    slice=${FUZZ_SLICE:-600}
    [ "$left" -ge "$slice" ] || slice=$left
    rm -f "build/fuzz/$1.log"
    $make fuzz FUZZERS="tests/fuzz/fuzz_$1.c" FUZZ_SECONDS="$slice" >"$dir/fuzz-$1.log" 2>&1
    status=$?
    set -- "$1" "$2" "$3" $(awk '/number_of_executed_units/ { runs = $2 }
        /^Done .* runs? in/ { spent = $5 } END { print runs + 0, spent + 0 }' \
        "build/fuzz/$1.log" 2>/dev/null || echo 0 0)
    if [ $status -ne 0 ] || [ "$5" -eq 0 ]; then
        keep "fuzz-$1" failed "$(($2 + $4)) runs" 1 0 "$(($3 + $5))" "log: $dir/fuzz-$1.log"
        return 1
    fi
    now=passed
    [ $(($3 + $5)) -ge "$seconds" ] || now='not finished'
    keep "fuzz-$1" "$now" "$(($2 + $4)) runs" 0 0 "$(($3 + $5))" \
        "$([ "$now" = passed ] || echo "not finished: $seconds seconds are wanted")"
}

# All fuzzers at once, each slice by slice. They share what is built.
fuzz() {
    built=
    for name in $fuzzers; do
        [ "$(done_before "$name" | cut -d ' ' -f 2)" -lt "$seconds" ] || continue
        [ "$built" ] || $make -j"$jobs" fuzz FUZZ_SECONDS=1 >"$dir/fuzz.log" 2>&1
        built=yes
        while fuzz_slice "$name"; do :; done &
    done
    wait
}

# ---- targets ----

run() {
    begin=$(date +%s)
    # make hands variables on to all programs: elsewhere the judge is one test of many
    count=
    [ "$1" != judge ] || count=JUDGE_COUNT=1000000
    $make -j"$jobs" "$1" $count >"$dir/$1.log" 2>&1 </dev/null
    status=$?
    spent=$(($(date +%s) - begin))
    set -- "$1" $(counts "$dir/$1.log")
    if [ $status -ne 0 ]; then
        keep "$1" failed "$2" "$(($3 > 0 ? $3 : 1))" "$4" $spent \
            "$(tail -n 1 "$dir/$1.log" | tr '\t|' '  ' | cut -c 1-100)"
    elif grep -q "^$1: skipped" "$dir/$1.log"; then
        keep "$1" skipped "$2" "$3" "$4" $spent "$(sed -n "s/^$1: skipped[, ]*//p" "$dir/$1.log")"
    else
        keep "$1" passed "$2" "$3" "$4" $spent "$(remark "$1" "$dir/$1.log")"
    fi
    printf '%s  %-18s %s\n' "$(date +%H:%M)" "$1" "$(tail -n 1 "$dir/$1.log")"
}

collect
rm -f "$dir"/*.row
set -m # the fuzzers are a group of processes, which ends with this one
fuzz &
in_background=$!
set +m
trap 'kill -- -$in_background 2>/dev/null' EXIT
trap 'exit 130' INT TERM HUP
for target in $targets; do
    if has_passed "$target"; then
        printf '%s  %-18s has passed on this code\n' "$(date +%H:%M)" "$target"
    else
        run "$target"
        collect
    fi
done
wait $in_background
trap - EXIT
collect
rm -f "$dir"/*.row
$make test-page
table
missing=
for target in $all; do
    has_passed "$target" || missing="$missing $target"
done
[ -z "$missing" ] || echo "failed, or not run:$missing"
[ -z "$missing" ]
