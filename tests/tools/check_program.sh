#!/bin/sh
# check_program.sh: runs sparse-local as a user does: help, results, refusals (make test)
#
#     PROGRAM=build/sparse-local tests/tools/check_program.sh
#
# Exit statuses of the program: 0 success, 1 bad data, 2 bad command line. The last line of output
# is `N passed, N failed`.

program=${PROGRAM:-build/sparse-local}
. "$(dirname "$0")/../lib/checks.sh"
checks_folder program

# What the program printed last.
details() {
    head -n 20 "$dir/out" "$dir/err"
}

# gives STATUS PATTERN ARGUMENT ...: the program run with these arguments, and with --verbose if it
# is to succeed, exits with STATUS. Its
# standard output matches PATTERN and its standard error is empty; if STATUS is not 0, its standard
# error matches PATTERN.
gives() {
    wanted=$1 pattern=$2
    shift 2
    case $wanted$1 in
    0-* | 0help) "$program" "$@" >"$dir/out" 2>"$dir/err" </dev/null ;;
    0*) "$program" "$@" --verbose >"$dir/out" 2>"$dir/err" </dev/null ;;
    *) "$program" "$@" >"$dir/out" 2>"$dir/err" </dev/null ;;
    esac
    status=$?
    ok=0
    [ "$status" -eq "$wanted" ] || ok=1
    if [ "$wanted" -eq 0 ]; then
        grep -q -e "$pattern" "$dir/out" || ok=1
        ! grep -q -v '[0-9]% after [0-9]* s, about' "$dir/err" || ok=1 # progress on a busy machine
    else
        grep -q -e "$pattern" "$dir/err" || ok=1
    fi
    record $ok "sparse-local $*: status $status, expected $wanted and: $pattern"
}

# Help.

gives 0 'usage: sparse-local COMMAND' --help
gives 0 'generated surface' help
gives 2 'usage: sparse-local COMMAND'
gives 2 'unknown command frobnicate$' frobnicate
gives 2 'unknown command heta; did you mean heat?' heta sphere:1
gives 2 'unknown command geodesics; did you mean geodesic?' help geodesics
gives 0 'usage: sparse-local heat ' help heat
gives 0 '^sparse-local [0-9]*[.][0-9]*[.][0-9]*\(-dev\)\{0,1\}$' --version
gives 2 'unknown option --radis; did you mean --radius?' geodesic sphere:1 --radis 3
gives 2 'pictures are PNG files; end the name in .png' adf sphere:1 --png "$dir/x.jpg"
gives 2 'pictures are PNG files; end the name in .png' reach sphere:1 --pattern "$dir/x.svg"
gives 2 'pictures are SVG files; end the name in .svg' reach sphere:1 --tree "$dir/x.png"
gives 2 'pictures are SVG files; end the name in .svg' edit hills:9x9 --svg "$dir/x.pdf"
# all commands but query, which takes no mesh
commands=$("$program" --help | sed -n '/^  query /d; s/^  \([a-z]*\) .*/\1/p')
for command in $commands; do
    gives 0 "usage: sparse-local $command " "$command" --help
    awk 'length > 100 { exit 1 }' "$dir/out"
    record $? "$command --help: no line beyond 100 characters"
    gives 2 'unknown option --frobnicate' "$command" sphere:1 --frobnicate
    gives 2 'needs MESH' "$command"
    [ "$command" = view ] || # its further operands are tables
        gives 2 'unexpected operand' "$command" sphere:1 sphere:1 sphere:1 sphere:1
    gives 1 'no-such-file.obj: cannot be opened' "$command" "$dir/no-such-file.obj"
    gives 1 'sphere:99: a size is out of range' "$command" sphere:99
done

# Results.

gives 0 'Euler characteristic 2$' info sphere:2
gives 0 'border loops 1, Euler characteristic 1$' info --mesh-only grid:9x9
gives 0 '^12 ' heat sphere:3 --from 5 --at 12
gives 0 'wanted 3 of 162 vertices' heat sphere:2 --from=5,7 --at=1-3
gives 0 'auto-diffusion of 162 of 162' adf sphere:2 --out "$dir/a.ply.gz" --png "$dir/a.png" \
    --csv "$dir/a.csv"
[ "$(wc -l <"$dir/a.csv")" -eq 163 ] && [ "$(head -c 4 "$dir/a.png" | tail -c 3)" = PNG ]
record $? "adf writes a table of 162 rows and a PNG file"
gives 0 'auto-diffusion of 162 of 162' adf "$dir/a.ply.gz" --csv "$dir/b.csv"
cmp -s "$dir/a.csv" "$dir/b.csv"
record $? "adf of a written mesh gives the same numbers"
gives 0 'signatures of 2 of 162 vertices at 5 times' hks sphere:2 --times 5 --at 3,4 \
    --csv "$dir/h.csv"
gives 0 'differ by at most' pairs sphere:2 --count 20 --svg "$dir/p.svg"
grep -q 'means: one tree .*, two trees .*, all in one call .*; medians: one tree' "$dir/out"
record $? "pairs compares means with means"
gives 0 'would take .* estimated from 3 solves' adf sphere:2 --at 3,4,5
gives 0 'would take .* estimated from 5 solves' adf sphere:2
gives 0 'patch of 10 of 162' reach sphere:2 --patch 10 \
    --png "$dir/r.png" --separators "$dir/s.png" \
    --tree "$dir/t.svg" --pattern "$dir/q.png" --graph "$dir/g.svg"
[ "$(grep -c '<text' "$dir/g.svg")" -eq 960 ] && grep -q '>161</text>' "$dir/g.svg"
record $? "the graph has a number at each corner"
gives 1 '642 vertices, at most 500' reach sphere:3 --graph "$dir/g.svg"
for file in p.svg r.png s.png t.svg q.png; do
    [ -s "$dir/$file" ]
    record $? "$file was drawn"
done

gives 0 'entries read of the region.s inverse: [1-9]' heat grid:60x60 --from 1830 --at 1831,1890 \
    --region
gives 0 '; [1-9][0-9]* of the region.s inverse$' geodesic grid:60x60 --from 1830 --radius 0.1 \
    --region
gives 2 'param is unwrap --method harmonic now' param grid:9x9
gives 2 'only for distances within --radius' geodesic sphere:2 --region
gives 0 'from each of 2 sources' geodesic grid:60x60 --from 1830,1835 --radius 0.1 --each --region \
    --csv "$dir/e.csv"
awk -F, '$1 == 1830 && $2 == 1835 { a = $3 } $1 == 1835 && $2 == 1830 { b = $3 }
    END { exit !(a > 0.07 && a < 0.1 && b > 0.07 && b < 0.1 && (a - b)^2 < 0.005^2) }' "$dir/e.csv"
record $? "geodesic --each: the distance is the same both ways, about 5 edges of 1/59"
gives 2 '--each: writes only --csv' geodesic sphere:2 --each --png "$dir/each.png"
gives 0 'at 3 times' hks sphere:2 --times 3 --threads 2 --csv "$dir/h2.csv"
"$program" hks sphere:2 --times 3 --csv "$dir/h1.csv" >"$dir/out" 2>"$dir/err" &&
    cmp -s "$dir/h1.csv" "$dir/h2.csv"
record $? "hks gives the same numbers with one thread and with two"

# A speck that comes first, and a sphere: distances are those of the larger part, from its first
# vertex, and vertices that no path reaches have no value in any file.

"$program" heat sphere:0 --out "$dir/speck.obj" >"$dir/out" 2>&1
"$program" heat sphere:2 --out "$dir/ball.obj" >"$dir/out" 2>&1
both() { # the speck at x = $1
    awk -v x="$1" 'FNR == 1 && NR > 1 { ball = 1 }
        $1 == "v" { if (ball) print $1, $2, $3, $4; else print $1, $2 / 9 + x, $3 / 9, $4 / 9 }
        $1 == "f" { print $1, $2 + 12 * ball, $3 + 12 * ball, $4 + 12 * ball }' \
        "$dir/speck.obj" "$dir/ball.obj"
}
both 3 >"$dir/two.obj"
both 1e4 >"$dir/lost.obj"
gives 0 '^There is no value of distance at 12 of 174 vertices.$' geodesic "$dir/two.obj" \
    --out "$dir/two.gltf" --csv "$dir/two.csv"
awk -F, 'NR == 2 { first = $1; zero = $2 } END { exit NR != 163 || first != 12 || zero != 0 }' \
    "$dir/two.csv"
record $? "geodesic starts in the largest part"
grep -q '_HAS_DISTANCE' "$dir/two.gltf"
record $? "glTF says which vertices have no distance"
gives 0 'no value of heat at 11 of 174 vertices, of log10_heat at 173.$' heat "$dir/two.obj" \
    --from 0 --at 0,12-173 --out "$dir/two.glb"
gives 0 'no value of site at 162 of 174 vertices.$' geodesic "$dir/two.obj" --voronoi --from 3,7 \
    --out "$dir/two.ply" --csv "$dir/two.csv"
[ "$(wc -l <"$dir/two.csv")" -eq 13 ]
record $? "the table of cells has no row for a vertex without a site"
"$program" geodesic "$dir/two.obj" --from 0 --view 90,0 --png "$dir/two.png" >"$dir/out" \
    2>"$dir/err"
[ ! -s "$dir/err" ]
record $? "a picture of two small parts is not called empty"
"$program" adf "$dir/lost.obj" --png "$dir/lost.png" >"$dir/out" 2>"$dir/err"
grep -q 'there is almost nothing in the picture: the mesh covers 1 of [0-9]*00 pixels' "$dir/err"
record $? "a picture of a mesh that is a speck in it warns"

# By default at most five lines, each a sentence; counts of distances are sums.

for words in 'heat star:3' 'adf star:3' 'hks star:3' 'pairs star:3 --count 9' 'reach star:3' \
    'geodesic star:3 --exact sphere' 'geodesic star:3 --voronoi --from random:3' \
    'geodesic star:3 --each --from 1,2' 'vectors star:3 --log' \
    'edit hills:9x9 --edits 9' 'info star:3'; do
    "$program" $words >"$dir/out" 2>"$dir/err"
    awk '!/^[A-Z0-9].*[.]$/ { exit 1 } END { exit NR < 1 || NR > 5 }' "$dir/out"
    record $? "$words prints one to five sentences"
done
for words in '' '--raw' '--radius 0.2' '--from 0,5,9' '--each --from 0,5' \
    '--each --from 7 --radius 0.3'; do
    for mesh in grid:20x20 star:3 "$dir/two.obj"; do
        "$program" geodesic $mesh $words --csv "$dir/sums.csv" >"$dir/out" 2>"$dir/err"
        rows=$(($(wc -l <"$dir/sums.csv") - 1))
        awk -v rows=$rows '/^Of / { sum = $4 + $11 + $18 + $22; ok = $2 == rows && sum == rows }
            /^All / { ok = $2 == rows } END { exit !ok }' "$dir/out"
        record $? "geodesic $mesh $words: the counts of distances add up to the $rows of the table"
    done
done
"$program" view sphere:2 --out - >"$dir/page.html" 2>"$dir/err" &&
    "$program" view sphere:2 --out "$dir/v.html" >"$dir/out" 2>&1 &&
    cmp -s "$dir/page.html" "$dir/v.html"
record $? "view --out - writes the page, and nothing else, to standard output"
"$program" adf sphere:2 --csv - 2>"$dir/err" | cmp -s - "$dir/a.csv" &&
    grep -q '^The auto' "$dir/err"
record $? "--csv - writes the table to standard output, and the rest to standard error"

# Vectors (test_vector_heat.c): on a plane a vector stays as it is, and a logarithm is x - x0.

gives 0 'from 1 vertex to 25 of 25' vectors grid:5x5 --from 12 --vectors 0.6,-0.8,9 \
    --csv "$dir/v.csv" --png "$dir/v.png" --out "$dir/v.ply"
awk -F, 'NR > 1 && !(($2 - 0.6)^2 + ($3 + 0.8)^2 + $4^2 < 1e-20) { bad++ }
    END { exit NR != 26 || bad }' "$dir/v.csv" && [ -s "$dir/v.png" ]
record $? "vectors transports a vector over a plane"
grep -a -q 'property .* z' "$dir/v.ply"
record $? "vectors writes its vectors as fields"
gives 0 '^logarithm  from 1 vertex to [1-9] of 25' vectors grid:5x5 --from 12 --log --radius 0.33 \
    --csv "$dir/v.csv" --png "$dir/v.png"
"$program" vectors grid:5x5 --from 12 --log --out "$dir/v.obj" >"$dir/out" 2>"$dir/err"
awk 'BEGIN { v = -1 }
    FILENAME ~ /obj$/ { if ($1 == "v") { v++; x[v] = $2; y[v] = $3 } next }
    { split($0, c, ",") }
    c[1] ~ /^[0-9]/ && !((c[2] - x[c[1]] + x[12])^2 + (c[3] - y[c[1]] + y[12])^2 < 1e-20) { bad++ }
    END { exit bad || v != 24 }' "$dir/v.obj" "$dir/v.csv"
record $? "vectors --log gives differences of positions on a plane"
gives 0 'transport  from 2 vertices to 162 of 162' vectors sphere:2 --from 4,9 --csv "$dir/v.csv" \
    --vectors 2,0,0:0,0,1
gives 2 '2 vectors for 4 sources' vectors sphere:2 --from 1-4 \
    --vectors 2,0,0:0,0,1
gives 2 'separated by colons' vectors sphere:2 --vectors 2,0
gives 2 'separated by colons' vectors sphere:2 --vectors 1,0,0:0,0,1
gives 2 'separated by colons' vectors sphere:2 --vectors 1,0,nan
gives 1 'nothing of the vector is tangent' vectors grid:5x5 --vectors 0,0,1
gives 2 'give one of them' vectors sphere:2 --log --vectors 1,0,0
gives 2 'expected one vertex' vectors sphere:2 --log --from 1,2
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 3 4\n' >"$dir/unlike.obj"
"$program" vectors "$dir/unlike.obj" >"$dir/out" 2>"$dir/err" &&
    grep -q 'warning: 1 edges have three or more faces or faces of unlike' "$dir/err"
record $? "vectors warns of faces that are not oriented alike"

# Deformations (test_deform.c).

printf 'grab 0,5\ngrab 100\nmove 1 0 0.2 0\nframe\nrelease 0\nframe\n' >"$dir/moves"
gives 0 'pins       3 grabbed, .* ms each; 2 released' deform sphere:2 --script "$dir/moves" \
    --verbose --check --steps "$dir/steps.csv" --frames "$dir/frame"
[ "$(wc -l <"$dir/steps.csv")" -eq 7 ] && [ -s "$dir/frame0000.png" ] && [ -s "$dir/frame0001.png" ]
record $? "deform writes a row per step and a picture per frame"
printf 'grab 0,5\nmove 0 0 0 0.1\n' >"$dir/moves"
# Near a vertex two others, at 1e-7 of the edges: the squared system of biharmonic has no digits.
"$program" geodesic sphere:2 --from face:40,1e-7,1e-7 --out "$dir/thin.obj" >/dev/null 2>&1
"$program" geodesic "$dir/thin.obj" --from face:40,1e-7,5e-8 --out "$dir/thin.obj" >/dev/null 2>&1
printf 'grab 0-3\ngrab 9\nmove 1 0.1 0.2 0\nframe\n' >"$dir/pull"
"$program" deform "$dir/thin.obj" --script "$dir/pull" --method biharmonic --check \
    >"$dir/out" 2>"$dir/err"
record $? "a new factor agrees with biharmonic displacements of thin faces"
grep -q '^system     The squared system has too few digits' "$dir/out"
record $? "thin faces take the mixed system"
gives 0 '^upward     z, because' deform hills:9x9 --script "$dir/moves" --png "$dir/deform.png"

# Edits (test_edit.c).

gives 0 '^  weight .* [0-9]' edit hills:30x30 --edits 50 --csv "$dir/edits.csv" \
    --svg "$dir/edits.svg"
[ "$(grep -c '^[0-9]*,check,' "$dir/edits.csv")" -eq 1 ] && grep -q '</svg>' "$dir/edits.svg"
record $? "edit writes a table and a plot"
gives 0 '^  split .* [0-9]' edit hills:30x30 --edits 30 --kinds flip,split,collapse,remesh --patch 9
gives 2 'do not go with split' edit hills:9x9 --kinds pin,split

# Pages for a browser (test_view.c, and check_view.sh in one).

gives 0 'v.html: 162 vertices, 320 faces, 5 fields' view sphere:2 "$dir/h1.csv" "$dir/a.csv" \
    "$dir/a.csv" --out "$dir/v.html"
gives 2 'out FILE is missing' view sphere:2
gives 2 'expected x, y, z or auto' view sphere:2 --up w --out "$dir/v.html"
gives 1 'h1.csv:14: vertex 12 is not one of the 12 vertices' view sphere:0 "$dir/h1.csv" \
    --out "$dir/v.html"

# Saved factors.

gives 0 'f.slf: [0-9.]* MB, 162 rows' save sphere:2 --out "$dir/f.slf"
gives 0 'positive, 0 negative, 0 null, 0 regularized' info "$dir/f.slf"
printf '# heat from 5\n\n5;1;12,5\r\n5,12;1,0;12,5\n0-2;1,2,3;all' >"$dir/questions"
for checks in --flush --trusted --verify; do
    "$program" query "$dir/f.slf" $checks <"$dir/questions" >"$dir/out" 2>"$dir/err" &&
        [ "$(awk -F, '{ printf "%d ", NF }' "$dir/out")" = '2 2 162 ' ]
    record $? "query $checks answers each question in a line"
done
[ "$(sed -n 1p "$dir/out")" = "$(sed -n 2p "$dir/out")" ] && [ -s "$dir/out" ]
record $? "query: rows of b with the value 0 change nothing"
for question in '5;1' '5;1;2;3' '5;1,2;3' '5;;3' '5;x;3' '5;nan;3' '5;1,;3'; do
    echo "$question" >"$dir/questions"
    "$program" query "$dir/f.slf" <"$dir/questions" >"$dir/out" 2>"$dir/err"
    [ $? -eq 1 ] && grep -q 'line 1' "$dir/err"
    record $? "query refuses $question"
done
gives 2 'exclude each other' query "$dir/f.slf" --trusted --verify
gives 2 'needs FILE.slf' query
# a saved factor in place of a mesh
"$program" adf sphere:2 --scaled-time 1 --at 7,100 >"$dir/out" 2>"$dir/err"
of_mesh=$(grep '^[0-9]* [0-9.e+-]*$' "$dir/out")
"$program" adf "$dir/f.slf" --at 7,100 >"$dir/out" 2>"$dir/err"
[ -n "$of_mesh" ] && [ "$of_mesh" = "$(grep '^[0-9]* [0-9.e+-]*$' "$dir/out")" ]
record $? 'adf: a saved factor gives the values of its mesh'
gives 0 'auto-diffusion of 162 of 162 vertices, t as it was saved' adf "$dir/f.slf"
gives 0 'wanted 2 of 162 vertices, t as it was saved' heat "$dir/f.slf" --from 3 --at 4,5 --region
gives 0 'differ by at most' pairs "$dir/f.slf" --count 20
gives 2 'has its own time' adf "$dir/f.slf" --time 1
# a selected inverse and a region in the file
gives 0 'with the selected inverse and a region: made in' save sphere:2 --scaled-time 1 --selected \
    --region 5-20 --out "$dir/r.slf"
gives 0 '^selected inverse  *162   columns' info "$dir/r.slf"
gives 0 '^region  *[0-9]*   rows, [1-9][0-9]* of them on its boundary' info "$dir/r.slf"
printf '5;1;12,5\n5,12;1,0;12,5\n6-8;1,2,3;20\n5;1;100\nall;1;3\n' >"$dir/questions"
"$program" query "$dir/f.slf" <"$dir/questions" >"$dir/out" 2>"$dir/err" &&
    "$program" query "$dir/r.slf" <"$dir/questions" >"$dir/out2" 2>"$dir/err" &&
    [ "$(wc -l <"$dir/out2")" -eq 5 ] && paste -d, "$dir/out" "$dir/out2" |
    awk -F, 'BEGIN { bad = 1 } { bad = 0; for (k = 1; k <= NF / 2; k++) {
            d = $k - $(k + NF / 2); if (d > 1e-12 || -d > 1e-12) exit 1 } } END { exit bad }' &&
    [ "$(tail -n 2 "$dir/out")" = "$(tail -n 2 "$dir/out2")" ]
record $? 'query: a region gives the answers of the factor; other rows are solved without it'
"$program" save sphere:2 --scaled-time 2 --out "$dir/g.slf" >"$dir/out" 2>"$dir/err" &&
    "$program" hks "$dir/r.slf" "$dir/g.slf" --at 7,100 >"$dir/out" 2>"$dir/err" &&
    "$program" adf "$dir/g.slf" --at 7,100 >"$dir/out2" 2>"$dir/err" &&
    [ "$(grep -c '^[0-9]* [0-9.]* [0-9.]*$' "$dir/out")" -eq 2 ] &&
    [ "$(sed -n 's/^7 [0-9.]* //p' "$dir/out")" = "$(sed -n 's/^7 //p' "$dir/out2")" ]
record $? 'hks: a saved factor gives the values of adf'
"$program" adf "$dir/r.slf" --csv "$dir/a1.csv" >"$dir/out" 2>"$dir/err" &&
    "$program" adf sphere:2 --scaled-time 1 --csv "$dir/a2.csv" >"$dir/out" 2>"$dir/err" &&
    paste -d, "$dir/a1.csv" "$dir/a2.csv" | awk -F, 'NR > 1 { d = $2 / $4 - 1
        if (d > 1e-12 || -d > 1e-12) exit 1 } END { exit NR != 163 }'
record $? 'adf: the selected inverse of a file has the values of the mesh'
gives 0 'at the times of 2 files' hks "$dir/r.slf" "$dir/g.slf" --csv "$dir/h.csv"
[ "$(wc -l <"$dir/h.csv")" -eq 163 ] && head -n 1 "$dir/h.csv" | grep -q '^vertex,.*r.slf,.*g.slf$'
record $? 'hks: a column for each file'
"$program" save sphere:1 --out "$dir/small.slf" >"$dir/out" 2>"$dir/err"
gives 1 'small.slf has 42' hks "$dir/f.slf" "$dir/small.slf"
gives 2 'has its own time' hks "$dir/f.slf" --times 3
gives 2 'no mesh for --laplacian and --like' hks "$dir/f.slf" --like 3
gives 2 'has no mesh for --out and --png' hks "$dir/f.slf" --png "$dir/x.png"
gives 2 'expected one mesh, or files' hks "$dir/f.slf" sphere:2
gives 2 'expected one mesh, or files' hks sphere:2 "$dir/f.slf"
gives 1 'there is no vertex 162' save sphere:2 --region 162 --out "$dir/x.slf"
gives 2 'has no mesh for --out and --png' heat "$dir/f.slf" --png "$dir/x.png"
gives 2 'has no mesh for --radius' heat "$dir/f.slf" --radius 1
gives 1 'there is no vertex 162' adf "$dir/f.slf" --at 162
gives 1 'none.slf: .*there is no such file' adf "$dir/none.slf"
# both factors of the heat method, also of an intrinsic triangulation and where the time is raised
same_distances() {
    mesh=$1 options=$2
    shift 2
    # shellcheck disable=SC2086
    "$program" save "$mesh" $options --out "$dir/heat.slf" --poisson "$dir/poisson.slf" \
        >"$dir/out" 2>"$dir/err" &&
        "$program" geodesic "$mesh" $options "$@" --csv "$dir/made.csv" >"$dir/out" 2>"$dir/err" &&
        "$program" geodesic "$mesh" "$@" --heat "$dir/heat.slf" --poisson "$dir/poisson.slf" \
            --csv "$dir/mapped.csv" >"$dir/out2" 2>"$dir/err" &&
        [ "$(wc -l <"$dir/made.csv")" -gt 100 ] && cmp "$dir/made.csv" "$dir/mapped.csv" &&
        [ "$(sed -n 's/.*; \(time [^;]*\);.*/\1/p' "$dir/out")" = \
            "$(sed -n 's/.*; \(time [^;]*\);.*/\1/p' "$dir/out2")" ]
    record $? "geodesic $mesh $*: the bits of files are those of the mesh"
}
same_distances grid:40x40 '--scaled-time 2' --from 820
same_distances grid:40x40 '' --from 820 --radius 0.3 --region
same_distances star:4 '--laplacian auto'
same_distances sphere:3 '' --voronoi --from random:9
"$program" save star:4 --laplacian cotangent --out "$dir/heat.slf" --poisson "$dir/poisson.slf" \
    >"$dir/out" 2>"$dir/err" &&
    "$program" geodesic star:4 --laplacian cotangent --csv "$dir/made.csv" --verbose \
        >"$dir/out" 2>"$dir/err" && grep -q 'raised to' "$dir/out" &&
    "$program" geodesic star:4 --laplacian cotangent --heat "$dir/heat.slf" \
        --poisson "$dir/poisson.slf" --csv "$dir/mapped.csv" >"$dir/out" 2>"$dir/err" &&
    cmp "$dir/made.csv" "$dir/mapped.csv"
record $? 'save --poisson raises the time as geodesic does'
gives 1 'not the factors of this mesh' geodesic star:4 --laplacian intrinsic --heat \
    "$dir/heat.slf" --poisson "$dir/poisson.slf"
gives 1 'not the factors of this mesh' geodesic star:4 --laplacian cotangent --heat \
    "$dir/poisson.slf" --poisson "$dir/heat.slf"
gives 1 'not the factors of this mesh' geodesic star:4 --laplacian cotangent --heat \
    "$dir/heat.slf" --poisson "$dir/heat.slf"
gives 1 'not the factors of this mesh' geodesic sphere:2 --heat "$dir/heat.slf" --poisson \
    "$dir/poisson.slf"
gives 2 'give both or none' geodesic sphere:2 --heat "$dir/heat.slf"
gives 2 'has its own time' geodesic sphere:2 --heat "$dir/heat.slf" --poisson "$dir/poisson.slf" \
    --time 1
gives 1 'none.slf: .*cannot be read' geodesic sphere:2 --heat "$dir/none.slf" --poisson \
    "$dir/poisson.slf"
gives 2 'the same file' save sphere:1 --out "$dir/x.slf" --poisson "$dir/x.slf"
# large blocks in files
"$program" save hills:250x250 --out "$dir/memory.slf" >"$dir/out" 2>"$dir/err" &&
    "$program" save hills:250x250 --out "$dir/disk.slf" --scratch "$dir" >"$dir/out" 2>"$dir/err" &&
    cmp "$dir/memory.slf" "$dir/disk.slf"
record $? 'save --scratch writes the same bytes'
[ "$(find "$dir" -name 'sparse-local.*')" = "" ]
record $? 'save --scratch leaves no file'
gives 1 'no file of 16777216 bytes' save sphere:1 --out "$dir/x.slf" --scratch "$dir/none"
rm -f "$dir/memory.slf" "$dir/disk.slf"
gives 0 'usage: sparse-local query ' query --help
gives 2 'out FILE is missing' save sphere:1
gives 1 'no/f.slf: cannot be written: No such file' save sphere:1 --out "$dir/no/f.slf"
gives 1 'none.slf: .*there is no such file' query "$dir/none.slf"
head -c 5000 "$dir/f.slf" >"$dir/cut.slf"
gives 1 'cut.slf: .*truncated' query "$dir/cut.slf"
gives 1 'not a saved factor' query "$program"

# Meshes that are not surfaces, and degenerate ones, are handled without a crash.

{
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nv 9 9 9\n'
    printf 'f 1 2 3\nf 1 2 4\nf 2 1 5\nf 1 1 2\nf 1 2 2\n'
} >"$dir/fan.obj"
gives 0 'not manifold 1' info "$dir/fan.obj"
gives 0 'auto-diffusion of 6 of 6' adf "$dir/fan.obj" --png "$dir/fan.png" --out "$dir/fan2.obj"
gives 0 'wanted 6 of 6' heat "$dir/fan.obj" --png "$dir/fan.png"
gives 0 'patch of 5 of 6' reach "$dir/fan.obj" --png "$dir/fan.png" --pattern "$dir/q.png" \
    --tree "$dir/t.svg"
gives 0 'pairs of 6 vertices' pairs "$dir/fan.obj" --count 30
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n' >"$dir/flat.obj"
gives 0 'without area 1' info "$dir/flat.obj"
gives 0 'auto-diffusion of 3 of 3' adf "$dir/flat.obj"

# Faces with vertices of their own: a square of two triangles.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv 0 1 1e-9\nf 1 2 3\nf 4 5 6\n' \
    >"$dir/soup.obj"
"$program" info --mesh-only "$dir/soup.obj" >"$dir/out" 2>"$dir/err" &&
    grep -q 'warning: .*soup.obj: 1 of 6 vertices have the coordinates of others' "$dir/err"
record $? "vertices at the same place are warned of"
gives 0 '1 vertices are merged with others; 0 faces' info "$dir/soup.obj" --weld
gives 0 '2 vertices are merged with others; 0 faces' geodesic --weld=1e-6 "$dir/soup.obj"
gives 0 '0 vertices are merged with others; 0 faces' adf sphere:1 --weld
gives 0 'The heat of 1 source' heat "$dir/soup.obj" --weld --from 3,1 --weld-map "$dir/map.csv" \
    --csv "$dir/soup.csv"
awk -F, 'NR > 1 && $2 > 4 { bad = 1 } $1 == 1 { one = $2 } $1 == 3 { three = $2 }
    END { exit NR != 7 || bad || one != three }' "$dir/map.csv"
record $? "--weld-map has a row for each vertex of the file, and --from counts those"
gives 2 'weld-map: only with --weld' info "$dir/soup.obj" --weld-map "$dir/map.csv"
gives 2 'f.slf: a saved factor has no mesh for --weld' heat "$dir/f.slf" --weld
gives 2 'f.slf: a saved factor has no mesh for --weld' info "$dir/f.slf" --weld
gives 2 'weld -1: not a finite number of 0 or more' info --weld=-1 "$dir/soup.obj"

# Sources in faces, on edges, at corners, and near points in space.

for from in face:40,0.2,0.3 face:40,0,0.5 face:40,1,0 point:0.31,0.42,0.1 point:0.5,0.5,9; do
    gives 0 '^source     in face' geodesic grid:20x20 --from "$from" --exact plane
    sed -n 's/^The errors .* at most \([^,]*\),.*/\1/p' "$dir/out" |
        awk '{ good = $1 < 0.03 } END { exit !good }'
    record $? "distances from $from"
done
# In a plane distances are exact, but for 0.03 edges and where fronts meet.
for from in 4950 0-99,9900-9999 4950,2020,7070; do
    gives 0 '^The errors .* at most 0.00[0-3]' geodesic grid:100x100 --from $from --exact plane
done
gives 1 'there is no such face; the last one is 721' geodesic grid:20x20 --from face:800,0,0
gives 2 'U and V are 0 or more' geodesic grid:20x20 --from face:8,0.7,0.7
gives 2 'expected face:F,U,V or point:X,Y,Z' geodesic grid:20x20 --from face:8,0.7
gives 2 'expected face:F,U,V or point:X,Y,Z' geodesic grid:20x20 --from point:1,2,3x

# What a file has beside triangles stays from OBJ to OBJ, and else is named.

printf 'g top\nusemtl red\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1 2 3 4\n' \
    >"$dir/quad.obj"
for ending in ply vtk glb; do
    gives 0 "quad.$ending has triangles only; left out of .*: 1 group, materials, text.*polyg" \
        adf "$dir/quad.obj" --out "$dir/quad.$ending"
done
"$program" adf "$dir/quad.obj" --out "$dir/kept.obj" >"$dir/out" 2>&1 &&
    ! grep -q 'left out' "$dir/out"
record $? "from OBJ to OBJ nothing is left out"
gives 0 'ply has triangles only; left out of .*: 1 more values of each vertex' adf "$dir/quad.ply" \
    --out "$dir/again.ply"
gives 0 'ply has triangles only; left out of .*: data at points and cells' adf "$dir/quad.vtk" \
    --out "$dir/again.ply"
point='AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA'
part='{"attributes":{"POSITION":0,"NORMAL":0}}'
printf '{"asset":{"version":"2.0"},"meshes":[{"primitives":[%s,%s]}],"materials":[{}],
    "nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"accessors":[{"bufferView":0,"componentType":5126,
    "count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{
    "byteLength":36,"uri":"data:application/octet-stream;base64,%s"}]}' \
    "$part" "$part" "$point" >"$dir/parts.gltf"
"$program" adf "$dir/parts.gltf" --out "$dir/parts.obj" >"$dir/out" 2>"$dir/err"
grep -q 'left out of .*: the division into 2 primitives, materials, normals' "$dir/out"
record $? "the primitives of glTF are named"

# Curves along edges, and lists from files.

printf '3 5,7 # three\n\n9-11' >"$dir/list"
"$program" geodesic grid:20x20 --from "@$dir/list" --csv "$dir/listed.csv" >/dev/null 2>&1
"$program" geodesic grid:20x20 --from 3,5,7,9-11 --csv "$dir/typed.csv" >/dev/null 2>&1
cmp -s "$dir/listed.csv" "$dir/typed.csv"
record $? "--from @FILE is the list in the file"
gives 1 'none: ' geodesic grid:20x20 --from "@$dir/none"
gives 2 'not a list of vertices' geodesic grid:20x20 --from "curve:3,x"
gives 2 'a curve is one source' geodesic grid:20x20 --from curve:3,5 --each
gives 1 'no path along edges joins vertex 3 to' geodesic "$dir/two.obj" --from curve:3,100
gives 2 'no mesh for --radius and curves' heat "$dir/f.slf" --from curve:3,5
gives 0 '^curve      of 3 edges through 5 vertices' geodesic grid:20x20 --from 'curve:0,1,2;60,61'
# A curve of some 20 edges of length 0.15 passes nearer to the vertices beside it than its own do.
"$program" geodesic sphere:3 --from curve:3,400,600 --verbose --csv "$dir/curve.csv" >"$dir/out"
"$program" geodesic sphere:3 --from "$(awk -F, '$2 == 0 { printf "%s%d", n++ ? "," : "", $1 }' \
    "$dir/curve.csv")" --csv "$dir/dots.csv" >/dev/null
awk -F, 'FNR == 1 { next } FNR == NR { dots[$1] = $2; next }
    { over = $2 - dots[$1]; bad = bad || over > 0.05 * 0.15; less += over < -0.05 * 0.15 }
    END { exit bad || less < 10 }' "$dir/dots.csv" "$dir/curve.csv"
record $? "distances from a curve are shorter than those from its vertices"
# An edge gives off its length, one half at each end.
"$program" heat grid:20x20 --from curve:60,61 --csv "$dir/edge.csv" >/dev/null 2>&1
"$program" heat grid:20x20 --from 60,61 --csv "$dir/ends.csv" >/dev/null 2>&1
awk -F, 'FNR == 1 { next } FNR == NR { ends[$1] = $2; next } { r = $2 / ends[$1] }
    FNR == 2 { ratio = r } { bad = bad || r / ratio > 1 + 1e-12 || r / ratio < 1 - 1e-12 }
    END { exit bad || ratio < 0.4 / 19 || ratio > 0.6 / 19 }' "$dir/ends.csv" "$dir/edge.csv"
record $? "the heat of a curve is its length"

# On a sphere the logarithm of a vertex far away has the length of the way to it.

for raw in '' --raw; do
    "$program" vectors sphere:4 --from 0 --log $raw --csv "$dir/log.csv" >"$dir/out" 2>"$dir/err"
    "$program" geodesic sphere:4 --from 0 --csv "$dir/distance.csv" >"$dir/more" 2>&1
    awk -F, -v raw="$raw" 'FNR == 1 { next } FNR == NR { distance[$1] = $2; next }
        { off = sqrt($2 * $2 + $3 * $3 + $4 * $4) - distance[$1]; off = off < 0 ? -off : off
          worst = off > worst ? off : worst }
        END { exit !(raw == "" ? worst < 0.05 : worst > 0.3) }' "$dir/distance.csv" "$dir/log.csv"
    record $? "lengths of logarithms $raw beside distances"
done
! grep -q 'straightened paths' "$dir/out"
record $? "with --raw logarithms are not compared with paths"

# A mesh from a pipe, of any format.

"$program" adf sphere:2 --out "$dir/pipe.obj" --csv "$dir/pipe.csv" >/dev/null
for ending in obj ply vtk glb gltf obj.gz ply.gz; do
    "$program" adf sphere:2 --out "$dir/pipe.$ending" >/dev/null &&
        "$program" info --mesh-only - <"$dir/pipe.$ending" | grep -q 'has 162 vertices'
    record $? "a mesh in the format $ending is read from standard input"
done
for text in 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' \
    'solid\nfacet\nvertex 0 0 0 vertex 1 0 0 vertex 0 1 0\nendloop\nendsolid\n'; do
    printf "$text" | "$program" info --mesh-only - | grep -q ' 1 faces'
    record $? "$text is read from standard input"
done

# Refusals.

printf 'v 0 0 0\nv 1 0 0\n' >"$dir/points.obj"
for command in $commands; do
    gives 1 'points.obj: has no faces, only 2 vertices' "$command" "$dir/points.obj"
done
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\n\nf 1 2 4\n' >"$dir/index.obj"
gives 1 'index.obj:5: face 0: vertex 3 (counted from 0) is out of range: the mesh has 3 vertices' \
    info "$dir/index.obj"
printf 'solid\nvertex 0 0\n' >"$dir/cut.stl"
gives 1 'cut.stl:2: vertex: three numbers expected' info "$dir/cut.stl"
printf 'v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n' >"$dir/point.obj"
gives 1 'no default time' heat "$dir/point.obj"
gives 1 'there is no vertex 42; the last one is 41' heat sphere:1 --from 42
gives 2 'not a list of vertices' heat sphere:1 --from x
gives 2 'not a list of vertices' heat sphere:1 --from -3
gives 2 'expected a comma' heat sphere:1 --from 3.5
gives 2 'empty range' heat sphere:1 --from 7-3
gives 2 'one of them' heat sphere:1 --at 3 --radius 1
gives 2 'one of them' heat sphere:1 --time 3 --scaled-time 1
gives 2 'above 0' heat sphere:1 --time -3
gives 1 'not between 0 and 1e200' heat sphere:1 --time 1e300
gives 2 'not a finite number' heat sphere:1 --time nan
gives 2 'not an integer' pairs sphere:1 --count -1
gives 2 'needs T' heat sphere:1 --time
gives 2 'such as 800x600' adf sphere:1 --png "$dir/x.png" --size 8
gives 2 'such as 30,20' adf sphere:1 --png "$dir/x.png" --view 8
gives 2 'expected x, y, z or auto' adf sphere:1 --png "$dir/x.png" --up w
for scale in 0 5 2x -1 ''; do
    gives 2 'expected 1 to 4' adf sphere:1 --png "$dir/x.png" --scale "$scale"
done
gives 2 'at most 8000 pixels' adf sphere:1 --png "$dir/x.png" --size 4001x10 --scale 2
gives 1 'cannot be written' adf sphere:1 --png "$dir/no/x.png"
gives 1 'cannot be written' adf sphere:1 --csv "$dir/no/x.csv"
gives 1 'must end in .obj, .ply' adf sphere:1 --out "$dir/x.off"
gives 2 'a number from 1 to 42' adf sphere:1 --at random:43
for option in time scaled-time area-time radius; do
    gives 2 'above 0' heat sphere:1 --$option 0
    gives 2 'above 0' heat sphere:1 --$option -1
done
gives 2 'above 0' geodesic sphere:1 --radius 0
gives 2 'above 0' hks sphere:1 --first 0

# What is wrong with an output is found before the mesh is read.

for command in adf heat hks geodesic vectors unwrap reach deform; do
    gives 1 'no/x.png: cannot be written' "$command" "$dir/no-such-file.obj" --png "$dir/no/x.png"
    gives 1 'Is a directory' "$command" "$dir/no-such-file.obj" --csv "$dir"
    gives 1 'must end in .obj, .ply' "$command" "$dir/no-such-file.obj" --out "$dir/x.off"
    gives 2 'such as 800x600' "$command" "$dir/no-such-file.obj" --size 8
    gives 2 'such as 30,20' "$command" "$dir/no-such-file.obj" --view 8
    gives 2 'expected x, y, z or auto' "$command" "$dir/no-such-file.obj" --up w
done

# Vertices that were drawn are named; without --from all commands start at the same vertex.

gives 0 '^drawn      --at [0-9]*,[0-9]*,[0-9]*$' adf sphere:1 --at random:3
{
    printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\n'
    printf 'f 1 2 3\nf 2 3 5\nf 3 6 5\nf 2 5 4\n'
} >"$dir/late.obj"
"$program" heat "$dir/late.obj" --csv "$dir/h1.csv" >"$dir/out" 2>"$dir/err" &&
    "$program" heat "$dir/late.obj" --from 1 --csv "$dir/h2.csv" >"$dir/out" 2>"$dir/err" &&
    cmp -s "$dir/h1.csv" "$dir/h2.csv"
record $? "heat starts from the first vertex of a face with an area"
"$program" geodesic "$dir/late.obj" --csv "$dir/g.csv" >"$dir/out" 2>"$dir/err" &&
    grep -q '^1,0,' "$dir/g.csv"
record $? "geodesic starts there too"

# A picture says if auto chose z; it is the one that --up z gives.

for command in adf heat hks geodesic vectors reach unwrap; do
    gives 0 '^upward     z, because the mesh is a relief over the x-y plane' \
        "$command" hills:30x30 --png "$dir/auto.png"
    "$program" "$command" hills:30x30 --png "$dir/z.png" --up z >"$dir/out" 2>"$dir/err" &&
        ! grep -q upward "$dir/out" && cmp -s "$dir/auto.png" "$dir/z.png"
    record $? "$command draws with the z axis upward"
done
gives 0 'upward     z, because' view hills:30x30 --out "$dir/auto.html"
grep -q '^axes: \[[^,]*, [^,]*, 0, [^,]*, [^,]*, 0.93' "$dir/auto.html"
record $? "the page begins with the z axis upward"

checks_end
