#!/bin/sh
# check_exchange.sh: a processor of the other byte order loads what this one saved, and the other
# way round: equal answers, and the same bytes once the file is back (make test-exchange)
#
#     HERE=build/tests/core/exchange THERE='qemu-s390x build/s390x/tests/core/exchange' \
#         tests/core/check_exchange.sh

. "$(dirname "$0")/../lib/checks.sh"
checks_folder exchange

details() {
    cat "$dir/err"
}

# exchange NAME FIRST SECOND: SECOND loads what FIRST has saved, and FIRST what SECOND then saves.
exchange() {
    for storage in double float; do
        $2 $storage "$dir/a.slf" 2>"$dir/err" &&
            $3 $storage "$dir/b.slf" "$dir/a.slf" 2>>"$dir/err"
        record $? "$1: $storage, equal answers"
        $2 $storage "$dir/c.slf" "$dir/b.slf" 2>>"$dir/err" && cmp "$dir/a.slf" "$dir/c.slf"
        record $? "$1: $storage, the same bytes once they are back"
        [ "$(head -c 12 "$dir/a.slf" | od -An -tx1)" != "$(head -c 12 "$dir/b.slf" | od -An -tx1)" ]
        record $? "$1: $storage, each has its own byte order"
    done
}

exchange 'saved here, loaded there' "$HERE" "$THERE"
exchange 'saved there, loaded here' "$THERE" "$HERE"
checks_end
