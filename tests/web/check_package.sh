#!/bin/sh
# check_package.sh: the npm package: its tests, README, example, types, tarball, and a page in
# headless Chromium (make test-npm)
#
#     PACKAGE=build/npm/package tests/web/check_package.sh
#
# What needs tsc or Chromium is skipped without them. The last line is `N passed, N failed`.

here=$(dirname "$0")
. "$here/../lib/checks.sh"
checks_folder package
details() {
    head -n 40 "$dir/out"
}

# The package as npm installs it from the tarball, in a project of its own.
mkdir -p "$dir/node_modules" && tar -xzf "$PACKAGE"/../sparse-local-*.tgz -C "$dir/node_modules" &&
    mv "$dir/node_modules/package" "$dir/node_modules/sparse-local"
record $? 'the tarball has the folder package'
installed=$dir/node_modules/sparse-local
(cd "$PACKAGE" && find . -type f | sort) >"$dir/wanted"
(cd "$installed" && find . -type f | sort) | cmp -s - "$dir/wanted"
record $? 'the tarball has the files of the package'

node "$here/test_package.mjs" "$installed" >"$dir/out" 2>&1
record $? 'the tests of the package'
passed=$((passed + $(sed -n '$s/^\([0-9]*\) passed.*/\1/p' "$dir/out") - 1))

# The program of the README, and what it says about itself.
awk '/^```js/ { inside = 1; next } /^```/ { inside = 0 } inside' "$installed/README.md" \
    >"$dir/readme.mjs"
node "$dir/readme.mjs" >"$dir/out" 2>&1 &&
    tr -d '\n ' <"$dir/out" | sed 's/Float64Array([0-9]*)//g' >"$dir/said" &&
    grep -q '^\[1,1,1\]\[0.25\]\[0.1428571428571[0-9]*\]\[1.666666666666[0-9]*,5,2.5\]$' "$dir/said"
record $? 'the program of the README'

node "$installed/heat.js" >"$dir/out" 2>&1 &&
    awk '/^[0-9.]* is / { same = $1 == $3 } /^1.000000 -1.000000$/ { ends = 1 }
        END { exit !(same && ends) }' "$dir/out"
record $? 'the example of a grid'

skipped=0
if command -v tsc >/dev/null 2>&1; then
    types() {
        (cd "$dir" && tsc --strict --noEmit --target es2022 --module es2022 \
            --moduleResolution node use.ts) >"$dir/out" 2>&1
    }
    cp "$here/use.ts" "$dir/use.ts" && types
    record $? 'the types of the package'
    # a compiler older than `using` has no dispose of its own: this is what `using` calls
    { echo 'import {Factor} from "sparse-local";'
      echo 'export const end = (F: Factor): void => F[Symbol.dispose]();'; } >"$dir/use.ts" && types
    record $? 'the types have Symbol.dispose'
    sed 's/F.solve(b)/F.solve("b")/' "$here/use.ts" >"$dir/use.ts"
    ! types && grep -q 'use.ts.*error TS' "$dir/out"
    record $? 'a wrong type is an error'
else
    echo 'skipped: no tsc, so that the types of the package are not checked'
    skipped=$((skipped + 1))
fi

browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome)
if [ -n "$browser" ]; then
    node "$here/test_page.mjs" "$browser" "$installed" >"$dir/out" 2>&1
    record $? 'a page in Chromium'
    sed 's/^/page: /' "$dir/out"
else
    echo 'skipped: no Chromium, so that no page is tried'
    skipped=$((skipped + 1))
fi

echo "$passed passed, $failed failed$([ $skipped -eq 0 ] || echo ", $skipped skipped")"
[ $failed -eq 0 ]
