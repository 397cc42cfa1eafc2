#!/bin/sh
# home.sh: writes home and version to the files of packages, or checks that they are there
#
#     tools/packaging/home.sh [--check] URL VERSION      (make header, make check-header)
#
# URL is HOME_URL of the Makefile. If it is empty, none of these files has an address. VERSION is
# that of src/public/config.h, with its suffix. Other packages are filled in when they are made:
# pkg-config files, package.json, the manual, the list of a release.

check=
if [ "$1" = --check ]; then
    check=yes
    shift
fi
case $1 in
'' | http://* | https://*) ;;
*) bad=yes ;;
esac
case $1 in
*[!-A-Za-z0-9._~:/?#@\&=+%,]*) bad=yes ;;
esac
if [ -n "$bad" ]; then
    echo "home.sh: $1 is not an address of the web" >&2
    exit 1
fi
home=$1
url=$(printf '%s' "$1" | sed 's/&/\\&/g')
version=$2
python_version=$(echo "$version" | sed 's/-dev$/.dev0/; s/-//')
cd "$(dirname "$0")/../.." || exit 1

# home_in FILE SCRIPT LINE [VERSION]: scripts of sed. SCRIPT removes the address; LINE, with an
# address, adds it; VERSION writes the version.
home_in() {
    new=$(mktemp) || exit 1
    sed -e "$2" "$1" | sed -e "${url:+$3}" -e "$4" >"$new"
    if ! cmp -s "$new" "$1"; then
        if [ -n "$check" ]; then
            echo "$1: not '$home' or not $version; fix: make header" >&2
            status=1
        else
            cat "$new" >"$1"
        fi
    fi
    rm -f "$new"
}

status=0
home_in tools/packaging/vcpkg/vcpkg.json '/^  "homepage": /d' \
    "/^  \"license\": /i\\  \"homepage\": \"$url\"," \
    "s/^\(  \"version-semver\": \"\)[^\"]*/\1$version/"
home_in tools/packaging/conan/conanfile.py '/^    homepage = /d' \
    "/^    license = /a\\    homepage = \"$url\""
home_in tools/python/pyproject.toml '/^urls = /d' "/^license = /a\\urls = { Homepage = \"$url\" }" \
    "s/^version = .*/version = \"$python_version\"/"
home_in CMakeLists.txt 's/^\(project(sparse_local .*\) HOMEPAGE_URL ".*" /\1 /' \
    "s|^\(project(sparse_local .*\) LANGUAGES|\1 HOMEPAGE_URL \"$url\" LANGUAGES|"
home_in meson.build "s/^home = '.*'/home = ''/" "s|^home = ''|home = '$url'|" \
    "s/^\(project(.* version: '\)[^']*/\1$version/"
exit $status
