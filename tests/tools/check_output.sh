#!/bin/sh
# check_output.sh: sparse-local never loses output silently (make test)
#
#     PROGRAM=build/sparse-local tests/tools/check_output.sh
#
# Full disks, closed streams, files that are not plain files, signals. The last line of output is
# `N passed, N failed`.

program=${PROGRAM:-build/sparse-local}
case $program in /*) ;; *) program=$PWD/$program ;; esac
. "$(dirname "$0")/../lib/checks.sh"
checks_folder output

details() {
    ls -l "$dir/files"
    [ ! -s "$dir/err" ] || head -n 20 "$dir/err"
}

# expect STATUS PATTERN TEXT: the last $status is STATUS, and standard error matches PATTERN; an
# empty PATTERN: standard error is empty.
expect() {
    ok=0
    [ "$status" -eq "$1" ] || ok=1
    if [ -n "$2" ]; then
        grep -q -e "$2" "$dir/err" || ok=1
    else
        [ ! -s "$dir/err" ] || ok=1
    fi
    record $ok "$3: status $status, expected $1 and: ${2:-no message}"
}

# no_temporary TEXT: no temporary file is left.
no_temporary() {
    ! ls "$dir/files" | grep -q '\.tmp'
    record $? "$1: no temporary file is left"
}

mkdir "$dir/files" "$dir/kept"
cd "$dir/files" || exit 1

# uncounted COMMAND ...: with counts of its own, which are dropped. What make cov builds adds to its
# counts when it ends: a limit would damage them, and another user cannot write those of root.
uncounted() {
    rm -rf "$dir/counts"
    mkdir -m 777 "$dir/counts"
    GCOV_PREFIX="$dir/counts" "$@"
}

# Standard output, full or closed.

lost='sparse-local: standard output could not be written completely'
commands=$("$program" --help | sed -n 's/^  \([a-z]*\) .*/\1/p')
[ -n "$commands" ]
record $? "there are commands"
"$program" save sphere:2 --out "$dir/kept/sphere.slf" >/dev/null 2>"$dir/err"
record $? "save writes a file"
echo '0;1;1' >"$dir/kept/question" # b is 1 in row 0; x is wanted in row 1
printf 'grab 0\ngrab 7\nmove 0 1 0 0\nframe\n' >"$dir/kept/moves"

# run COMMAND: with operands that suit it.
run() {
    case $1 in
    save) "$program" save sphere:2 --out saved.slf ;;
    view) "$program" view sphere:2 --out page.html ;;
    query) "$program" query "$dir/kept/sphere.slf" <"$dir/kept/question" ;;
    deform) "$program" deform sphere:2 --script "$dir/kept/moves" ;;
    *) "$program" "$1" sphere:2 ;;
    esac
}

if [ -c /dev/full ]; then
    "$program" --help >/dev/full 2>"$dir/err"
    status=$?
    expect 1 "$lost" "--help on a full disk"
    for command in $commands; do
        "$program" "$command" --help >/dev/full 2>"$dir/err"
        status=$?
        expect 1 "$lost" "$command --help on a full disk"
        run "$command" >/dev/full 2>"$dir/err"
        status=$?
        expect 1 "$lost" "$command on a full disk"
    done
    "$program" hks no-such-file.obj >/dev/full 2>"$dir/err"
    status=$?
    expect 1 'no-such-file.obj: cannot be opened' "an error without output on a full disk"
fi
"$program" --help >&- 2>"$dir/err"
status=$?
expect 1 "$lost" "--help on a closed standard output"
for command in $commands; do
    "$program" "$command" --help >&- 2>"$dir/err"
    status=$?
    expect 1 "$lost" "$command --help on a closed standard output"
    run "$command" >&- 2>"$dir/err"
    status=$?
    expect 1 "$lost" "$command on a closed standard output"
done

# Files that are opened while standard streams are closed take no printed text.
"$program" adf sphere:2 --csv a.csv --out a.obj >"$dir/out" 2>"$dir/err"
status=$?
expect 0 '' "adf writes files"
cp a.csv a.obj "$dir/kept"
rm a.csv a.obj
"$program" adf sphere:2 --csv a.csv --out a.obj <&- >&- 2>"$dir/err"
status=$?
expect 1 "$lost" "adf writes files while standard input and output are closed"
cmp -s a.csv "$dir/kept/a.csv" && cmp -s a.obj "$dir/kept/a.obj"
record $? "files written while standard output is closed are complete"
"$program" adf sphere:2 --csv a.csv --out a.obj <&- >&- 2>&-
status=$?
: >"$dir/err"
expect 1 '' "adf writes files while all standard streams are closed"
cmp -s a.csv "$dir/kept/a.csv" && cmp -s a.obj "$dir/kept/a.obj"
record $? "files written while all standard streams are closed are complete"

# A full disk, here a limit on the size of files: the old file is left, and a new one is not begun.

# limited FILE ARGUMENT ...: the program cannot write FILE, as an existing file and as a new one.
limited() {
    file=$1
    shift
    for kind in old new; do
        rm -f "$file"
        [ $kind = new ] || echo 'the old content' >"$file"
        (
            ulimit -f 1
            uncounted "$program" "$@" >/dev/null 2>"$dir/err"
        )
        status=$?
        expect 1 "$file: could not be written completely" "$kind $file, limited"
        if [ $kind = old ]; then
            [ "$(cat "$file")" = 'the old content' ]
        else
            [ ! -e "$file" ]
        fi
        record $? "$kind $file, limited, is as it was"
    done
    rm -f "$file"
}
limited l.csv adf sphere:4 --csv l.csv
limited l.csv hks sphere:3 --csv l.csv
limited l.csv pairs sphere:3 --count 1000 --csv l.csv
limited l.csv heat sphere:4 --csv l.csv
limited l.csv reach sphere:4 --csv l.csv
limited l.csv unwrap sphere:4 --csv l.csv
limited l.csv geodesic sphere:4 --csv l.csv
limited l.csv geodesic sphere:4 --from 1,2,3 --each --csv l.csv
limited l.csv deform sphere:4 --script "$dir/kept/moves" --csv l.csv
limited l.ply adf sphere:4 --out l.ply
limited l.obj adf sphere:4 --out l.obj
limited l.ply.gz adf sphere:4 --out l.ply.gz
limited l.png adf sphere:4 --png l.png
limited l.svg reach sphere:2 --graph l.svg
limited l.svg reach sphere:4 --tree l.svg
limited l.svg pairs sphere:3 --count 1000 --svg l.svg
"$program" adf sphere:4 --out m.ply >"$dir/out" 2>"$dir/err"
cp m.ply "$dir/kept"
(
    ulimit -f 4
    uncounted "$program" hks m.ply --out m.ply >/dev/null 2>"$dir/err"
)
status=$?
expect 1 'm.ply: could not be written completely' "a mesh over itself, limited"
cmp -s m.ply "$dir/kept/m.ply"
record $? "a mesh over itself, limited, is as it was"
(
    ulimit -f 1
    for k in 1 2 3 4 5 6 7 8 9; do
        uncounted "$program" geodesic --help || exit 1
    done >"$dir/out" 2>"$dir/err"
)
status=$?
expect 1 "$lost" "help into a file, limited"
no_temporary "limited size"
"$program" hks m.ply --out m.ply >"$dir/out" 2>"$dir/err"
status=$?
expect 0 '' "a mesh over itself"
"$program" info m.ply >"$dir/out" 2>"$dir/err"
status=$?
expect 0 '' "the mesh written over itself is read"

# What the target is.

ln -s a.csv link.csv
echo 'the old content' >a.csv
chmod 640 a.csv
"$program" adf sphere:2 --csv link.csv >"$dir/out" 2>"$dir/err"
status=$?
expect 0 '' "through a symbolic link"
[ -L link.csv ] && cmp -s a.csv "$dir/kept/a.csv"
record $? "a symbolic link remains, and its file is written"
case $(ls -l a.csv) in -rw-r-----*) true ;; *) false ;; esac
record $? "an existing file keeps its permissions"
(
    umask 027
    "$program" adf sphere:2 --csv new.csv >"$dir/out" 2>"$dir/err"
)
case $(ls -l new.csv) in -rw-r-----*) cmp -s new.csv "$dir/kept/a.csv" ;; *) false ;; esac
record $? "a new file has the permissions of the umask"
ln -s nowhere.csv dangling.csv
"$program" adf sphere:2 --csv dangling.csv >"$dir/out" 2>"$dir/err"
[ -L dangling.csv ] && cmp -s nowhere.csv "$dir/kept/a.csv"
record $? "a symbolic link to a missing file creates it"
mkfifo fifo.csv
cat fifo.csv >"$dir/kept/fifo" &
"$program" adf sphere:2 --csv fifo.csv >"$dir/out" 2>"$dir/err"
status=$?
wait $!
expect 0 '' "into a FIFO"
[ -p fifo.csv ] && cmp -s "$dir/kept/fifo" "$dir/kept/a.csv"
record $? "a FIFO remains and carries the table"
if [ -c /dev/full ]; then
    ln -s /dev/full full.csv
    ln -s /dev/full full.ply
    "$program" adf sphere:2 --csv full.csv >"$dir/out" 2>"$dir/err"
    status=$?
    expect 1 'full.csv: could not be written completely: ' "a table into a full device"
    "$program" adf sphere:2 --out full.ply >"$dir/out" 2>"$dir/err"
    status=$?
    expect 1 'full.ply: could not be written completely' "a mesh into a full device"
    [ -c /dev/full ] && [ -L full.csv ]
    record $? "the device and the link to it remain"
fi
"$program" adf sphere:2 --csv /dev/null >"$dir/out" 2>"$dir/err"
status=$?
expect 0 '' "into /dev/null"
[ -c /dev/null ]
record $? "/dev/null remains"
"$program" adf sphere:2 --csv . >"$dir/out" 2>"$dir/err"
status=$?
expect 1 '\.: cannot be written: ' "a folder as target"
"$program" adf sphere:2 --csv '' >"$dir/out" 2>"$dir/err"
status=$?
expect 1 'cannot be written: ' "an empty name as target"
"$program" adf sphere:2 --csv no/x.csv >"$dir/out" 2>"$dir/err"
status=$?
expect 1 'no/x.csv: cannot be written: ' "a missing folder"
if [ -e /dev/stdout ]; then
    "$program" adf sphere:2 --csv /dev/stdout 2>"$dir/err" | cat >"$dir/out"
    grep -c , "$dir/out" >"$dir/count"
    "$program" adf sphere:2 --csv /dev/stdout >"$dir/out" 2>"$dir/err"
    status=$?
    expect 0 '' "a table to standard output, a file"
    [ "$(sed -n '/^vertex/,$p' "$dir/out" | cmp - "$dir/kept/a.csv" && echo same)" = same ] &&
        grep -q 'auto-diffusion of 162' "$dir/out" &&
        [ "$(grep -c , "$dir/out")" -eq "$(cat "$dir/count")" ]
    record $? "standard output has the report and then the table"
fi

# Folders and files without permission to write; root needs another user to be refused.
plain=
if [ "$(id -u)" -eq 0 ]; then
    plain='uncounted setpriv --reuid=65534 --regid=65534 --clear-groups'
    if chmod a+x "$dir" && $plain test -x "$dir/files" -a -x "$program" 2>/dev/null; then
        chown -R 65534:65534 "$dir/files"
    else
        plain=none
    fi
fi
if [ "$plain" != none ]; then
    mkdir locked
    echo 'the old content' >locked/open.csv
    chmod 666 locked/open.csv
    echo 'the old content' >shut.csv
    chmod 444 shut.csv
    [ -z "$plain" ] || chown 65534:65534 locked shut.csv locked/open.csv
    chmod 555 locked
    $plain "$program" adf sphere:2 --csv locked/new.csv >"$dir/out" 2>"$dir/err"
    status=$?
    expect 1 'locked/new.csv: cannot be written: ' "a new file in a read-only folder"
    $plain "$program" adf sphere:2 --csv locked/open.csv >"$dir/out" 2>"$dir/err"
    status=$?
    expect 0 '' "a writable file in a read-only folder"
    cmp -s locked/open.csv "$dir/kept/a.csv"
    record $? "a writable file in a read-only folder is written"
    $plain "$program" adf sphere:2 --csv shut.csv >"$dir/out" 2>"$dir/err"
    status=$?
    expect 1 'shut.csv: cannot be written: ' "a read-only file"
    [ "$(cat shut.csv)" = 'the old content' ]
    record $? "a read-only file is as it was"
    chmod 755 locked
    if [ -n "$plain" ]; then
        echo 'the old content' >others.csv # of root, in the folder of the other user
        chmod 666 others.csv
        $plain "$program" adf sphere:2 --csv others.csv >"$dir/out" 2>"$dir/err"
        status=$?
        expect 0 '' "a writable file of another user"
        cmp -s others.csv "$dir/kept/a.csv" && [ "$(ls -n others.csv | awk '{ print $3 }')" -eq 0 ]
        record $? "a writable file of another user keeps its owner"
    fi
fi
no_temporary "targets"

# Signals.

# The shell may have been started with SIGPIPE ignored, which it cannot undo.
sh -c 'kill -PIPE $$' 2>/dev/null
[ $? -eq 141 ] && broken=141 quiet='' || broken=1 quiet=$lost
# unread COMMAND: after COMMAND the program begins, when its reader is gone.
unread() {
    rm -f "$dir/gone"
    {
        eval "$1"
        while [ ! -e "$dir/gone" ]; do sleep 0.05; done
        "$program" pairs sphere:2 --count 5 2>"$dir/err"
        echo $? >"$dir/status"
    } | {
        exec <&-
        : >"$dir/gone"
    }
    status=$(cat "$dir/status")
}
unread :
expect "$broken" "$quiet" "a reader that is gone"
unread "trap '' PIPE"
expect 1 "$lost" "a reader that is gone, SIGPIPE ignored"

# interrupted SIGNAL: the program is killed while it has a file open.
interrupted() {
    echo 'the old content' >s.csv
    "$program" geodesic sphere:6 --from random:2000 --radius 0.5 --each --csv s.csv \
        >/dev/null 2>"$dir/err" &
    process=$!
    tries=0
    while ! ls | grep -q '^s.csv.tmp' && [ $tries -lt 600 ]; do
        sleep 0.05
        tries=$((tries + 1))
    done
    kill -"$1" $process
    wait $process 2>/dev/null
    status=$?
}
interrupted TERM
expect 143 '' "SIGTERM while a file is open"
[ "$(cat s.csv)" = 'the old content' ]
record $? "SIGTERM leaves the old file"
no_temporary "SIGTERM"
interrupted KILL
[ "$status" -eq 137 ] && [ "$(cat s.csv)" = 'the old content' ]
record $? "SIGKILL leaves the old file"

checks_end
