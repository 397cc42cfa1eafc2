#!/bin/sh
# check_view.sh: the page of sparse-local view in headless Chromium: it draws, turns and answers a
# click (make test-view)
#
#     PROGRAM=build/sparse-local tests/tools/check_view.sh
#
# The last line of output is `N passed, N failed`.

program=$PROGRAM
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome)
if [ -z "$browser" ]; then
    echo 'no Chromium: skipped'
    echo '0 passed, 0 failed, 1 skipped'
    exit 0
fi
. "$(dirname "$0")/../lib/checks.sh"
checks_folder view

details() {
    echo "$report"
}

# page FILE: what the page reports on itself, see the end of view_page.html. No network.
page() {
    "$browser" --headless --no-sandbox --disable-gpu-sandbox --use-angle=swiftshader \
        --enable-unsafe-swiftshader --window-size=800,600 --user-data-dir="$dir/profile" \
        --host-resolver-rules='MAP * ~NOTFOUND' --virtual-time-budget=60000 --dump-dom \
        "file://$1#test" 2>"$dir/err" | sed -n 's/.*<body data-test="\([^"]*\)".*/\1/p'
}

# number NAME: that of the report.
number() {
    echo "$report" | sed -n "s/.*$1=\([0-9]*\).*/\1/p"
}

# shows FILE VERTICES: draws, turns, and finds a vertex of the mesh.
shows() {
    report=$(page "$1")
    [ "$(number drawn)" -gt 10000 ]
    record $? "$1: much of the window is drawn"
    [ "$(number changed)" -gt 10000 ]
    record $? "$1: turning changes the picture"
    [ "$(number error)" = 0 ]
    record $? "$1: no error of WebGL"
    vertex=$(echo "$report" | sed -n 's/.*error=[0-9]* vertex \([0-9]*\).*/\1/p')
    [ "${vertex:--1}" -ge 0 ] && [ "$vertex" -lt "$2" ]
    record $? "$1: a click finds a vertex"
}

"$program" heat sphere:3 --from 5 --scaled-time 20 --csv "$dir/heat.csv" >"$dir/out" 2>&1 &&
    "$program" view sphere:3 "$dir/heat.csv" --out "$dir/sphere.html" >"$dir/out" 2>&1
report=$(cat "$dir/out")
record $? 'view writes a page'
shows "$dir/sphere.html" 642
value=$(awk -F, -v v="$vertex" '$1 == v { printf "%.6g", $2 }' "$dir/heat.csv")
case $report in
*"vertex $vertex: $value"*) record 0 ;;
*) record 1 "the value of vertex $vertex is $value" ;;
esac

# Heat opens on the logarithm, distances open on a linear scale, both on the side of the source.
# A long path stays in its box.
long=$dir/a_name_of_a_mesh_that_is_longer_than_the_box_in_which_the_page_shows_it_without_a_blank
opens() {
    report=$(page "$1")
    case $report in
    *"scale=$2 shown=$3 over=0 "*) record 0 ;;
    *) record 1 "$1 opens with scale=$2 shown=$3 over=0" ;;
    esac
}
for v in 0 3 11; do
    "$program" geodesic sphere:4 --from $v --csv "$dir/geodesic.csv" >"$dir/out" 2>&1
    "$program" heat sphere:4 --from $v --csv "$long.csv" --out "$long.ply" >"$dir/out" 2>&1
    "$program" view "$long.ply" "$long.csv" --out "$dir/heat.html" >"$dir/out" 2>&1
    opens "$dir/heat.html" logarithm true
    "$program" view sphere:4 "$dir/geodesic.csv" --out "$dir/distance.html" >"$dir/out" 2>&1
    opens "$dir/distance.html" linear true
done
# A field with values of both signs, nearly all of them small, opens on quantiles.
awk 'BEGIN {
    print "vertex,u"
    for (v = 0; v < 642; v++) print v "," (v / 642) ^ 50 * (v % 2 ? -1 : 1)
}' >"$dir/signs.csv"
"$program" view sphere:3 "$dir/signs.csv" --from 5 --out "$dir/signs.html" >"$dir/out" 2>&1
opens "$dir/signs.html" quantiles true
"$program" view sphere:3 --out "$dir/bare.html" >"$dir/out" 2>&1
opens "$dir/bare.html" linear false

# Tables of several commands are fields of one page.
for command in adf hks geodesic; do
    "$program" $command sphere:3 --csv "$dir/$command.csv" >"$dir/out" 2>&1
done
"$program" view sphere:3 "$dir/heat.csv" "$dir/adf.csv" "$dir/hks.csv" "$dir/geodesic.csv" \
    --out "$dir/fields.html" >"$dir/out" 2>&1
report=$(cat "$dir/out")
record $? 'view writes a page of four tables'
shows "$dir/fields.html" 642
columns=$(cat "$dir/heat.csv" "$dir/adf.csv" "$dir/hks.csv" "$dir/geodesic.csv" |
    awk -F, '/^vertex,/ { n += NF - 1 } END { print n }')
[ "$(number fields)" = "$columns" ]
record $? "the page has the $columns fields of the four tables"
[ "$(number recolored)" -gt 10000 ]
record $? 'another field has other colors'
last=$(awk -F, -v v="$vertex" '$1 == v { printf "%.6g", $NF }' "$dir/geodesic.csv")
first=$(awk -F, -v v="$vertex" '$1 == v { printf "%.6g", $2 }' "$dir/heat.csv")
case $report in
*" vertex $vertex: $first"*"last vertex $vertex: $last"*) record 0 ;;
*) record 1 "vertex $vertex has $first in the first field and $last in the last one" ;;
esac

# as many faces as a scan has
"$program" view hills:318x318 --up z --out "$dir/hills.html" >"$dir/out" 2>&1
report=$(cat "$dir/out")
record $? 'view writes a page of 200 thousand faces'
shows "$dir/hills.html" 101124

checks_end
