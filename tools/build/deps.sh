#!/bin/sh
# deps.sh: installs missing dependencies of a make target with apt-get (make deps)
#
#     tools/build/deps.sh WHAT=PACKAGE ...
#
# WHAT is a header (metis.h), a command (g++) or the absolute path of a file (may contain *).
# PACKAGE is the Debian package that contains it. Installs as root, or with sudo if that needs no
# password; otherwise, or with DEPS_INSTALL=no, prints the command to run and fails.

# Only one instance runs at a time, even if make starts several.
mkdir -p build && exec 9>build/deps.lock
if command -v flock >/dev/null 2>&1; then flock 9; fi

missing=
for pair in "$@"; do
    what=${pair%%=*}
    case $what in
    /*) ls $what >/dev/null 2>&1 ;;
    *.h) echo "#include <$what>" | ${CC:-cc} -E -x c - >/dev/null 2>&1 ;;
    *) command -v "$what" >/dev/null 2>&1 ;;
    esac || missing="$missing ${pair#*=}"
done
[ -z "$missing" ] && exit 0

if ! command -v apt-get >/dev/null 2>&1; then
    echo "missing (names of the Debian packages):$missing" >&2
    echo "fix: install them with the package manager of this system" >&2
    exit 1
fi
as_root=
[ "$(id -u)" -eq 0 ] || as_root='sudo -n'
if [ "$DEPS_INSTALL" = no ] || ! $as_root true 2>/dev/null; then
    echo "missing:$missing" >&2
    echo "fix: run: sudo apt-get install$missing" >&2
    exit 1
fi

echo "installing:$missing"
export DEBIAN_FRONTEND=noninteractive
log=$(mktemp) || exit 1
trap 'rm -f "$log"' EXIT
{
    case $missing in
    *:arm64*) $as_root dpkg --add-architecture arm64 ;;
    esac &&
        $as_root apt-get update &&
        $as_root apt-get install -y --no-install-recommends $missing
} >"$log" 2>&1 && exit 0
tail -n 20 "$log" >&2
echo "fix: see the messages above, then run: apt-get install$missing" >&2
exit 1
