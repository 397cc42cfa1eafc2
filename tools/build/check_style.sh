#!/bin/sh
# check_style.sh: lengths of lines and public comments, wording of headers and texts (make style)
#
#     tools/build/check_style.sh
#
# Run in the root of the repository. Each violation is printed as file:line, rule and text. Any
# violation makes the exit status 1. Columns are bytes: sources are ASCII.

max_columns=100
max_comment=40  # lines of a comment in src/public; what is longer belongs in tools/docs
max_contract=14 # mean lines of the contracts: the comments of functions in src/public
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
    awk -v max=$max_comment -v max_contract=$max_contract '
        FNR == 1 { inside = contract = 0 }
        !inside && /^ *\/\*/ { inside = 1; lines = 0 }
        inside { lines++ }
        inside && /\*\// {
            inside = 0
            contract = lines
            if (lines > max) printf "%s:%d: a comment of %d lines\n", FILENAME, FNR, lines
            next
        }
        !inside && contract && /^SL_API .*\(/ { total += contract; count++ }
        !inside { contract = 0 }
        END {
            if (total > max_contract * count)
                printf "src/public: contracts have %.1f lines on average\n", total / count
        }' src/public/*.h
    grep -nEw -e "$phrases" src/public/*.h README.md tools/docs/*.md \
        tools/docs/do/*.md | sed 's/$/ (wording)/'
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
