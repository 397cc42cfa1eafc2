#!/bin/sh
# pictures.sh: draws the pictures of the manual anew, by the commands in its pages
#
#     PROGRAM=build/sparse-local tools/docs/pictures.sh          (make pictures)
#
# Runs in the root of the repository each line of program.md and tutorial.md that is indented and
# begins with sparse-local. Pages of the command view are drawn if Chromium is there. The meshes of
# build/examples are those that the program of the tutorial writes.

set -e
mkdir -p build/pictures
pages='tools/docs/program.md tools/docs/tutorial.md'
# shellcheck disable=SC2086
grep -h '^    sparse-local ' $pages | while read -r _ words; do
    case $words in
    *--png* | *--separators*) words="$words --size 360x288" ;;
    esac
    echo "sparse-local $words"
    # shellcheck disable=SC2086
    "$PROGRAM" $words >build/pictures/out </dev/null
done

browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)
for page in view view_distance; do
    [ -z "$browser" ] || "$browser" --headless --no-sandbox --disable-gpu-sandbox \
        --use-angle=swiftshader --enable-unsafe-swiftshader --window-size=560,340 \
        --user-data-dir=build/pictures/profile --host-resolver-rules='MAP * ~NOTFOUND' \
        --virtual-time-budget=20000 --screenshot="tools/pictures/$page.png" \
        "file://$PWD/build/pictures/$page.html" 2>build/pictures/err
done
rm -rf build/pictures/profile
[ -n "$browser" ] || echo 'no Chromium: the pictures of view stay'
