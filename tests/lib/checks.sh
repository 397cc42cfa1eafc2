# checks.sh: what the scripts of checks share: a folder that is removed, counts of checks
#
# A script sources it and ends in checks_end. It defines details, which prints more on a failed
# check, if it calls record, and sets $dir or calls checks_folder if it calls check.

passed=0 failed=0

# checks_folder NAME: makes a temporary folder $dir, a whole path.
checks_folder() {
    dir=$(mktemp -d "${SL_TMP:-${TMPDIR:-/tmp}}/$1.XXXXXX") || exit 1
    case $dir in /*) ;; *) dir=$PWD/$dir ;; esac
    trap 'rm -rf "$dir"' EXIT
}

# record STATUS TEXT: counts a check, which failed if STATUS is not 0.
record() {
    if [ "$1" -eq 0 ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED   $2"
        details | sed 's/^/    /'
    fi
}

# check TEXT COMMAND: counts a check, which failed if the command fails. COMMAND is one string; it
# may be a list.
check() {
    if (eval "$2") >"$dir/log" 2>&1; then
        passed=$((passed + 1))
        echo "ok       $1"
    else
        failed=$((failed + 1))
        echo "FAILED   $1"
        { echo "$2"; head -n 40 "$dir/log"; } | sed 's/^/    /'
    fi
}

# Prints the counts, the last line of a script. Its status is 0 if nothing failed.
checks_end() {
    echo "$passed passed, $failed failed"
    [ $failed -eq 0 ]
}
