#!/bin/sh
# test_page.sh: writes the figures in tests/README.md (make test-page)
#
# Between the lines `<!-- runs -->` and `<!-- end of runs -->` the counts of make test-figures, and
# between those of evidence the table of make evidence. Platforms have a page of their own: make
# platform-table.
set -eu
page=tests/README.md
new=$(mktemp)
trap 'rm -f "$new"' EXIT

{
    sed '/<!-- runs -->/q' "$page"
    echo '| figure | value |'
    echo '|---|---|'
    ${MAKE:-make} -s --no-print-directory test-figures | awk '
        /^corpus / { sub(/:.*/, "", $2)
                     print "| corpus `" $2 "` | " $3 " inputs, " $5 " bytes |"; next }
        { count = $1 " programs, " $4 " tests"
          sub(/^[0-9]+ programs of [0-9]+ /, ""); print "| " $0 " | " count " |" }'
    sed -n '/<!-- end of runs -->/,/<!-- evidence -->/p' "$page"
    tests/lib/evidence.sh --table
    sed -n '/<!-- end of evidence -->/,$p' "$page"
} >"$new"
cat "$new" >"$page"
