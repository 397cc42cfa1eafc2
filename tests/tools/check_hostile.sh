#!/bin/sh
# check_hostile.sh: command lines and inputs that are meant to break sparse-local (make test)
#
#     PROGRAM=build/sparse-local tests/tools/check_hostile.sh
#
# Each is refused with a message that names the option, the file or the line. The last line of
# output is `N passed, N failed`.

program=${PROGRAM:-build/sparse-local}
case $program in /*) ;; *) program=$PWD/$program ;; esac
. "$(dirname "$0")/../lib/checks.sh"
checks_folder hostile
cd "$dir" || exit 1

details() {
    head -c 2000 err
}

# refuses STATUS PATTERN ARGUMENT ...: one line on standard error, which matches PATTERN, and one
# more where help is offered; no output.
refuses() {
    wanted=$1 pattern=$2
    shift 2
    "$program" "$@" >out 2>err </dev/null
    status=$?
    [ "$status" -eq "$wanted" ] && grep -q -e "$pattern" err && [ ! -s out ] &&
        [ "$(wc -l <err)" -le 2 ]
    record $? "sparse-local $*: status $status, expected $wanted and: $pattern"
}

long=$(printf '%5000s' '' | tr ' ' A)

# Lists of vertices.

for list in ' 3' ' -3' '0, -3' '0-+3' '+3' '' ',' '1,' '1,,2' 'all,1' 'random' "$long"; do
    refuses 2 '--from: ".*" is not a list of vertices such as 3,17,100-200' heat sphere:1 \
        --from "$list"
done
for list in 162 99999999999999999999 0-2147483648; do
    refuses 1 '--at: there is no vertex' adf sphere:2 --at "$list"
done
for list in random: random:0 random:-1 'random: 3' random:43 random:3x random:99999999999999999999
do
    refuses 2 'expected a number from 1 to 42' adf sphere:1 --at "$list"
done

# Options.

refuses 2 '--times A*: not an integer from 0 to 2^31-1' hks sphere:1 --times "$long"
refuses 2 '--view .*: expected azimuth,elevation' adf sphere:1 --png x.png --view nan,3
refuses 2 '--view .*: expected azimuth,elevation' adf sphere:1 --png x.png --view 3,inf
for size in 4294967304x100 100x4294967304 ' 8x8' 8x8x 8x -8x8 0x8; do
    refuses 2 '--size .*: expected WxH' adf sphere:1 --png x.png --size "$size"
done
refuses 2 '--scale 4294967297: expected 1 to 4' adf sphere:1 --png x.png --scale 4294967297

# Outputs.

refuses 2 '--csv and --png: the same file ./x' adf sphere:1 --csv x --png ./x
echo 'the old content' >x
ln -s x y
refuses 2 '--out and --poisson: the same file y' save sphere:1 --out x --poisson y
[ "$(cat x)" = 'the old content' ]
record $? 'two outputs in one file: it is as it was'
"$program" adf sphere:1 --csv /dev/null --png /dev/null >out 2>err
record $? 'two outputs in /dev/null'
refuses 1 '^sparse-local: \.\.\.A*: cannot be written: ' adf sphere:1 --csv "$long"
refuses 1 '^sparse-local: \.\.\.A*.obj: cannot be opened$' info "$long.obj"
printf 'grab 0\nframe\n' >still
mkdir frames
"$program" deform sphere:1 --script still --frames frames/ >out 2>err && [ -s frames/0000.png ]
record $? 'deform: a folder as the prefix of frames'
refuses 1 'no/x0000.png: cannot be written' deform sphere:1 --script still --frames no/x

# Questions.

"$program" save sphere:2 --out f.slf >out 2>err
# asks PATTERN QUESTION: it is refused with its line
asks() {
    printf "# a comment\n$2\n" | "$program" query f.slf >out 2>err
    [ $? -eq 1 ] && [ ! -s out ] && grep -q -e "^sparse-local: line 2: $1" err
    record $? "query refuses $2"
}
asks 'B: "x" is not a list' 'x;1;1'
asks 'X: " -3" is not a list' '1;1; -3'
asks 'B: "random:3" is not a list' 'random:3;1;1'
asks 'B: there is no vertex 162' '162;1;1'
asks 'X: a row is repeated' '1;1;3,5,3'
asks 'B: a row is repeated' '1,1;1;3'
asks 'a zero byte' '1;1;1\0002'
"$program" query f.slf </dev/zero >out 2>err
[ $? -eq 1 ] && grep -q 'line 1: a zero byte' err
record $? 'query refuses an endless line'

# Meshes.

printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 1 1\nf 1 1 2\nf 2 2 2\n' >same.obj
timeout 60 "$program" edit same.obj --edits 20 --kinds flip,split,collapse,remesh --patch 5 \
    >out 2>err
record $? 'edits of faces that name a vertex twice come to an end'
printf 'v 0 0 0\nv 1e150 0 0\nv 0 1e150 0\nf 1 2 3\n' >far.obj
for command in heat adf pairs geodesic vectors edit; do
    refuses 1 'the time .* is not between 0 and 1e200' "$command" far.obj
done
refuses 1 'the time .* is not between 0 and 1e200' save far.obj --out o.slf --poisson p.slf
refuses 2 '--count: expected at most' pairs sphere:1 --count 2147483647

# Little memory: what is missing is said, and nothing else is blamed for it. A sanitized program
# reserves terabytes.

# within KILOBYTES ARGUMENT ...: runs the program with this much memory.
within() {
    (
        ulimit -v "$1"
        shift
        "$program" "$@" >out 2>err
    )
    status=$?
}

# A compressed file that expands a thousand times is refused before it takes 128 MB, a polygon of
# 800,000 corners before it takes long.
awk 'BEGIN { for (k = 0; k < 3000000; k++) printf "%50s\n", "" }' | gzip -9 >bomb.obj.gz
(
    ulimit -v 200000 2>/dev/null
    "$program" info bomb.obj.gz >out 2>err
)
grep -q 'bomb.obj.gz: .*expands to more than [67][0-9] MB' err ||
    grep -q 'AddressSanitizer' err # which reserves terabytes
record $? 'a file that expands a thousand times is refused'
refuses 1 'expands to more than 9 MB' info bomb.obj.gz --max-memory 9
refuses 2 'max-memory 0: not a finite number above 0' info sphere:1 --max-memory 0
awk 'BEGIN {
    for (k = 0; k < 800000; k++) print "v", k < 400000 ? k : 799999 - k, k < 400000 ? k % 2 : -5, 0
    printf "f"
    for (k = 1; k <= 800000; k++) printf " %d", k
    print ""
}' >comb.obj
refuses 1 'polygons of 800000 corners that are not convex' info comb.obj

least=1000 # with which the program is loaded
while within $least --help 2>/dev/null && [ $status -ne 0 ] && [ $least -lt 200000 ]; do
    least=$((least + 500))
done
for command in heat adf hks pairs reach unwrap geodesic vectors edit info; do
    for more in 0 1000 2000 4000 8000; do
        [ $least -lt 200000 ] || continue
        within $((least + more)) "$command" hills:60x60
        [ $status -eq 0 ] ||
            { [ $status -eq 1 ] && grep -q -e 'memory' -e 'warning' err &&
                ! grep -q -e 'all edges have no' -e 'length is 0' -e 'memory (vertex' err; }
        record $? "$command with $more kB of memory more than to begin: status $status"
    done
done
printf 'v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n' >point.obj
"$program" info point.obj --mesh-only --verbose >out 2>err
[ $? -eq 0 ] && grep -q '^angles  *none' out && ! grep -q nan out
record $? 'info: no face has an area'

checks_end
