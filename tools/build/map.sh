#!/bin/sh
# map.sh: what is in each file of src, tests, tools and bench, by its first line (make map)
#
#     tools/build/map.sh [FOLDER ...]

[ $# -gt 0 ] || set -- src tests tools bench
find "$@" -type f \( -name '*.[ch]' -o -name '*.[ch]pp' -o -name '*.sh' -o -name '*.awk' \
    -o -name '*.py' -o -name '*.mk' -o -name '*.mjs' \) -printf '%h %p\n' |
    LC_ALL=C sort | cut -d ' ' -f 2 | xargs awk '
    FNR == 1 { is_printed = 0 }
    is_printed || /^#!/ { next }
    {
        is_printed = 1
        folder = name = FILENAME
        sub("/[^/]*$", "", folder)
        sub("^.*/", "", name)
        gsub(/^(\/\*|\/\/|#|""") *| *(\*\/|""")$/, "")
        if (index($0, name ": ") == 1) $0 = substr($0, length(name) + 3)
        if (folder != last) print (last == "" ? "" : "\n") folder
        last = folder
        printf "  %-26s %s\n", name, $0
    }'
