#!/bin/sh
# evidence.sh: what a release is tested with, target by target, beside all fuzzers (make evidence)
#
#     tests/lib/evidence.sh SECONDS [TARGET ...]
#
# SECONDS: how long each fuzzer runs. Without targets: all of them. Each has a log in
# build/evidence, whose last line is printed. Fails if a target does. make test-page reads what all
# have left.

seconds=$1
shift
# First what continuous integration does not run, or runs in part.
targets=${*:-test cov mcdc judge test-msan valgrind platforms test-mingw test-mingw-clang test-wasm
    test-compilers sanitize races test-clang test-cxx test-openmp test-pthreads test-no-metis
    test-no-simd test-packs}
jobs=$(getconf _NPROCESSORS_ONLN)
make="${MAKE:-make} --no-print-directory"
mkdir -p build/evidence
failed=

say() {
    printf '%s  %-18s %s\n' "$(date +%H:%M)" "$1" "$(tail -n 1 "build/evidence/$1.log")"
}

# The fuzzers are built first: their time is that of their runs.
$make -j"$jobs" fuzz FUZZ_SECONDS=1 >build/evidence/fuzz.log 2>&1 || failed=' fuzz'
$make -j8 fuzz FUZZ_SECONDS="$seconds" >build/evidence/fuzz.log 2>&1 &
fuzzers=$!
for target in $targets; do
    # make hands variables on to all programs: elsewhere the judge is one test of many
    count=
    [ "$target" != judge ] || count=JUDGE_COUNT=1000000
    $make -j"$jobs" "$target" $count >"build/evidence/$target.log" 2>&1 </dev/null ||
        failed="$failed $target"
    say "$target"
done
wait $fuzzers || failed="$failed fuzz"
say fuzz
$make test-page
processor=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)
echo "machine: $processor, $jobs cores; $(cc --version | head -n 1)"
[ -z "$failed" ] || echo "failed:$failed"
[ -z "$failed" ]
