#!/bin/sh
# platform.sh: runs the tests of a platform and keeps the result as a row (make test-s390x)
#
#     tools/build/platform.sh NAME 'COMPILER FLAGS' 'HOW IT RUNS' COMMAND...
#
# COMMAND ends in a line `N passed, N failed[, N skipped]`. The row is in build/platforms/NAME.txt;
# it has no date, so that equal results are equal files. make platform-table prints all rows.

name=$1 compiler=$2 how=$3
shift 3
mkdir -p build/platforms
out=build/platforms/$name
"$@" >"$out.log" 2>&1
status=$?
cat "$out.log"
version=$(${compiler%% *} -dumpfullversion 2>/dev/null | grep '^[0-9.]*$' ||
    ${compiler%% *} -v 2>&1 | sed -n '1s/.*version \([0-9.]*[0-9]\).*/\1/p')
[ $status -eq 0 ] || grep -q '^[0-9]* passed, [1-9][0-9]* failed' "$out.log" || ended='did not end'
start="| $name | ${compiler%% *} $version ${compiler#"${compiler%% *}"} | $how |"
tail -n 1 "$out.log" | awk -v start="$start" -v ended="$ended" '
    /^[0-9]+ passed, [0-9]+ failed/ { passed = $1; failed = $3; skipped = $5 }
    END {
        gsub(/ +/, " ", start)
        printf "%s %d | %s | %d |\n", start, passed, ended != "" ? ended : failed + 0, skipped
    }' >"$out.txt"
exit $status
