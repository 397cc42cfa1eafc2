#!/bin/sh
# check_live.sh: pages of sparse-local view --live in headless Chromium (make test-live)
#
#     PROGRAM=build/sparse-local [LIVE_MESH=hills:318x318] tests/web/check_live.sh
#
# The fields are compared with those of the commands heat and geodesic, and the source is dragged.
# LIVE_MESH is tried in place of the others. The last line of output is `N passed, N failed`.

program=$PROGRAM
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome)
if [ -z "$browser" ]; then
    echo 'skipped: no Chromium'
    echo '0 passed, 0 failed, 1 skipped'
    exit 0
fi
here=$(dirname "$0")
. "$here/../lib/checks.sh"
checks_folder live
details() {
    head -n 40 "$dir/out"
}

# try MESH SOURCE OPTIONS: a page, and what the program computes with the same time.
try() {
    mesh=$1 from=$2
    shift 2
    "$program" view "$mesh" --live --from "$from" "$@" --out "$dir/live.html" >"$dir/out" 2>&1
    record $? "$mesh: view writes a live page"
    time=$(sed -n 's/^live: {time: \([^,]*\),.*/\1/p' "$dir/live.html")
    if [ "${from%,*}" = "$from" ]; then
        # one source: geodesic gives the distances from it
        "$program" heat "$mesh" --from "$from" --time "$time" "$@" --csv "$dir/heat.csv" \
            >"$dir/out" 2>&1 &&
            "$program" geodesic "$mesh" --raw --from "$from" --time "$time" "$@" \
                --csv "$dir/distance.csv" >"$dir/out" 2>&1
        record $? "$mesh: the program computes heat and distances"
        set -- "heat=$dir/heat.csv" "distance=$dir/distance.csv"
    else
        set --
    fi
    node "$here/test_live.mjs" "$browser" "$dir/live.html" "$@" >"$dir/out" 2>&1
    record $? "$mesh: the page in Chromium"
    sed "s/^/$mesh: /" "$dir/out"
}

if [ -n "$LIVE_MESH" ]; then
    try "$LIVE_MESH" "${LIVE_FROM:-50000}"
else
    try hills:80x80 3240
    try torus:60x24 700 --laplacian cotangent
    try sphere:4 5,1000
fi

checks_end
