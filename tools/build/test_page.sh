#!/bin/sh
# test_page.sh: writes the figures in tests/README.md (make test-page)
#
# Between the lines `<!-- runs -->` and `<!-- end of runs -->`: the counts of make test-figures, the
# last run of each fuzzer, and coverage. What has not run in this checkout is left out. Platforms
# have a page of their own: make platform-table.
set -eu
page=tests/README.md
new=$(mktemp)
trap 'rm -f "$new"' EXIT

fuzzers() {
    for log in build/fuzz/*.log; do
        name=${log##*/}
        [ ! -e "$log" ] || awk -v name="${name%.log}" '
            /number_of_executed_units/ { runs = $2 }
            /^Done .* runs in/ { seconds = $5 }
            END { if (runs) printf "| fuzzer `%s`, last run | %d executions in %d s |\n",
                                   name, runs, seconds }' "$log"
    done
}

coverage() {
    [ ! -e build/cov/summary.txt ] ||
        awk '/^(lines|branches):/ { sub(":", "", $1); print "| coverage, " $1 " | " $2 " |" }' \
            build/cov/summary.txt
}

{
    sed '/<!-- runs -->/q' "$page"
    echo '| figure | value |'
    echo '|---|---|'
    ${MAKE:-make} -s --no-print-directory test-figures | awk '
        /^corpus / { sub(/:.*/, "", $2)
                     print "| corpus `" $2 "` | " $3 " inputs, " $5 " bytes |"; next }
        { count = $1 " programs, " $4 " tests"
          sub(/^[0-9]+ programs of [0-9]+ /, ""); print "| " $0 " | " count " |" }'
    fuzzers
    coverage
    sed -n '/<!-- end of runs -->/,$p' "$page"
} >"$new"
cat "$new" >"$page"
