#!/bin/sh
# run.sh: runs test programs, a few at a time, and adds up what they count (make test)
#
#     tests/lib/run.sh LOG_FOLDER PROGRAM ...
#
# Reads the closing lines of cmocka, or a line `N passed, N failed`. A program counts as one failure
# if it dies, fails without reporting a failure, or runs nothing. A program replay_NAME gets the
# inputs in tests/fuzz/corpus/NAME.
# RUN        command that runs a program: valgrind ..., qemu-aarch64 ...
# TEST_JOBS  programs at a time; default: the number of processors
# The last line is the sum, `N passed, N failed`. The exit status is 0 only if nothing failed and
# something passed.

# Prints the counts of passed, failed and skipped tests in a log. The FAILED line of cmocka counts
# the failed tests, its PASSED line the others.
count() {
    awk '
        /^\[  PASSED  \] [0-9]+ test/ { passed += $4 }
        /^\[  FAILED  \] [0-9]+ test/ { failed += $4 }
        /^\[  SKIPPED \] [0-9]+ test/ { skipped += $4 }
        /^[0-9]+ passed, [0-9]+ failed/ { passed += $1; failed += $3; skipped += $5 }
        END { print passed + 0, failed + 0, skipped + 0 }' "$1"
}

# Runs one program: writes its log and its counts, and prints a line, with the end of the log if
# something failed.
run_one() {
    name=${1##*/}
    log=$logs/$name.log
    begin=$(date +%s)
    case $name in
    replay_*) find "tests/fuzz/corpus/${name#replay_}" -type f -exec $RUN "$1" {} + ;;
    *) $RUN "$1" ;;
    esac >"$log" 2>&1 </dev/null
    status=$?
    seconds=$(($(date +%s) - begin))
    set -- $(count "$log")
    passed=$1 failed=$2 skipped=$3
    if [ "$failed" -eq 0 ] && { [ "$status" -ne 0 ] || [ $((passed + skipped)) -eq 0 ]; }; then
        failed=1
    fi
    echo "$passed $failed $skipped" >"$logs/$name.count"
    if [ "$failed" -eq 0 ]; then
        note=
        [ "$skipped" -eq 0 ] || note=" ($skipped skipped)"
        reasons=$(sed -n 's/^skipped:* */    skipped: /p' "$log" | sort -u)
        printf '%-24s %4d passed%s, %d s%s\n' "$name" "$passed" "$note" "$seconds" "${reasons:+
$reasons}"
    else
        # in one piece, so that programs at the same time do not mix their lines
        text=$(grep -v -e '^\[ RUN  ' -e '^\[       OK' "$log" | tail -n 60 | sed 's/^/    /')
        printf '%-24s %4d passed, %d FAILED, exit status %d, %d s; from %s:\n%s\n' \
            "$name" "$passed" "$failed" "$status" "$seconds" "$log" "$text"
    fi
}

if [ "$1" = --one ]; then
    logs=$2
    run_one "$3"
    exit 0
fi

logs=$1
shift
twice=$(printf '%s\n' "$@" | sed 's|.*/||' | sort | uniq -d)
[ -z "$twice" ] || { echo "run.sh: two programs have one name and one log: $twice" && exit 1; }
rm -rf "$logs"
mkdir -p "$logs/tmp" || exit 1
TMPDIR=$(cd "$logs/tmp" && pwd) # a program may change its folder
export TMPDIR SL_TMP="$TMPDIR"
jobs=${TEST_JOBS:-$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1)}
printf '%s\n' "$@" | xargs -n 1 -P "$jobs" "$0" --one "$logs" || exit 1

# A program without a count was not run to its end.
cat "$logs"/*.count | awk -v programs=$# '
    { passed += $1; failed += $2; skipped += $3; counted++ }
    END {
        failed += programs - counted
        printf "%d passed, %d failed", passed, failed
        if (skipped > 0) printf ", %d skipped", skipped
        printf "\n"
        exit !(failed == 0 && passed > 0)
    }'
