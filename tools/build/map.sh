#!/bin/sh
# map.sh: what is in each file of src, tests, tools and bench, by its first comment (make map)
#
#     tools/build/map.sh [FOLDER ...]

[ $# -gt 0 ] || set -- src tests tools bench
find "$@" -type f \( -name '*.[ch]' -o -name '*.[ch]pp' -o -name '*.sh' -o -name '*.awk' \
    -o -name '*.py' -o -name '*.mk' -o -name '*.mjs' \) -printf '%h %p\n' |
    LC_ALL=C sort | cut -d ' ' -f 2 | xargs awk '
    function finish() {
        if (text == "") return
        if (index(text, name ": ") == 1) text = substr(text, length(name) + 3)
        if (folder != last) print (last == "" ? "" : "\n") folder
        last = folder
        printf "  %-26s %s\n", name, text
        text = ""
    }
    FNR == 1 { finish(); is_read = 0 }
    is_read || /^#!/ { next }
    {
        if (text == "") {
            folder = name = FILENAME
            sub("/[^/]*$", "", folder)
            sub("^.*/", "", name)
            is_c = /^\/\*/
        }
        # a comment of C goes to its end, or to an empty line
        is_read = !is_c || /\*\/$/ || /^ \*$/
        gsub(/^( *\*|\/\*|\/\/|#|""") *| *(\*\/|""")$/, "")
        text = text (text == "" || $0 == "" ? "" : " ") $0
    }
    END { finish() }'
