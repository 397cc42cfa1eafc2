#!/bin/sh
# check_style.sh: line lengths of all sources, wording of public headers and README (make style)
#
#     tools/build/check_style.sh
#
# Run in the root of the repository. Each violation is printed as file:line, rule and text. Any
# violation makes the exit status 1. Columns are bytes: sources are ASCII.

max_columns=100
# Turns of phrase that are not plain technical English. A phrase belongs here only if it has no use
# that is worth keeping.
phrases='stands|tells|comes to|goes on|such as are|aside|wishes|of it,|that is none|so long as that'

sources=$(find src tests tools bench -type f \( -name '*.[ch]' -o -name '*.[ch]pp' -o -name '*.sh' \
    -o -name '*.awk' -o -name '*.py' \) | LC_ALL=C sort)
export LC_ALL=C

# shellcheck disable=SC2086 # file names have no blanks
{
    awk -v max=$max_columns '
        length($0) > max {
            printf "%s:%d: %d columns, at most %d: %.60s...\n", FILENAME, FNR, length($0), max, $0
        }
        /[^\t -~]/ { printf "%s:%d: not ASCII: %.60s\n", FILENAME, FNR, $0 }' $sources
    grep -nEw -e "$phrases" src/public/*.h README.md /dev/null | sed 's/$/ (wording)/'
} | {
    count=0
    while IFS= read -r line; do
        printf '%s\n' "$line"
        count=$((count + 1))
    done
    [ $count -eq 0 ] && echo "style: $(echo "$sources" | wc -l) files, in order" && exit 0
    echo "$count violation(s)"
    exit 1
}
