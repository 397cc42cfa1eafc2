#!/bin/sh
# run.sh: runs test programs one after another and adds up what they count (make test)
#
#     tests/run.sh LOG_FOLDER PROGRAM ...
#
# Reads cmocka's closing lines, or a line `N passed, N failed`. A program that dies, or fails without counting a
# failure, counts as one; one that ran nothing too. A program replay_NAME gets the inputs of tests/corpus/NAME.
# RUN        what runs a program: valgrind ..., qemu-aarch64 ...
# The last line is the sum, `N passed, N failed`, and the exit status 0 only if nothing failed and something passed.

logs=$1
shift
rm -rf "$logs/tmp"
mkdir -p "$logs/tmp" || exit 1
export TMPDIR="$logs/tmp" SL_TMP="$logs/tmp"
all_passed=0 all_failed=0 all_skipped=0

# Prints passed, failed and skipped of a log. cmocka's FAILED line counts the failed ones, its PASSED line the others.
count() {
    awk '
        /^\[  PASSED  \] [0-9]+ test/ { passed += $4 }
        /^\[  FAILED  \] [0-9]+ test/ { failed += $4 }
        /^\[  SKIPPED \] [0-9]+ test/ { skipped += $4 }
        /^[0-9]+ passed, [0-9]+ failed/ { passed += $1; failed += $3; skipped += $5 }
        END { print passed + 0, failed + 0, skipped + 0 }' "$1"
}

for program in "$@"; do
    name=${program##*/}
    log=$logs/$name.log
    begin=$(date +%s)
    case $name in
    replay_*) find "tests/corpus/${name#replay_}" -type f -exec $RUN "$program" {} + ;;
    *) $RUN "$program" ;;
    esac >"$log" 2>&1 </dev/null
    status=$?
    seconds=$(($(date +%s) - begin))
    set -- $(count "$log")
    passed=$1 failed=$2 skipped=$3
    if [ "$failed" -eq 0 ] && { [ "$status" -ne 0 ] || [ $((passed + skipped)) -eq 0 ]; }; then failed=1; fi
    all_passed=$((all_passed + passed))
    all_failed=$((all_failed + failed))
    all_skipped=$((all_skipped + skipped))
    if [ "$failed" -eq 0 ]; then
        note=
        [ "$skipped" -eq 0 ] || note=" ($skipped skipped)"
        printf '%-24s %4d passed%s, %d s\n' "$name" "$passed" "$note" "$seconds"
    else
        printf '%-24s %4d passed, %d FAILED, exit status %d, %d s; from %s:\n' "$name" "$passed" "$failed" "$status" \
            "$seconds" "$log"
        grep -v -e '^\[ RUN  ' -e '^\[       OK' "$log" | tail -n 60 | sed 's/^/    /'
    fi
done

if [ "$all_skipped" -eq 0 ]; then
    echo "$all_passed passed, $all_failed failed"
else
    echo "$all_passed passed, $all_failed failed, $all_skipped skipped"
fi
[ "$all_failed" -eq 0 ] && [ "$all_passed" -gt 0 ]
