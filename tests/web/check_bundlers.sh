#!/bin/sh
# check_bundlers.sh: the npm package goes through bundlers, and their pages solve (make test-npm)
#
#     PACKAGE=build/npm/package [BUNDLERS=FOLDER] tests/web/check_bundlers.sh
#
# esbuild, webpack and vite are looked for in node_modules/.bin of BUNDLERS, then in the path; those
# that are not there are skipped, and so are pages without Chromium. The last line is
# `N passed, N failed`.

here=$(realpath "$(dirname "$0")")
. "$here/../lib/checks.sh"
checks_folder bundlers
details() {
    head -n 20 "$dir/out" | cut -c 1-200
}
[ -z "$BUNDLERS" ] || PATH=$(realpath "$BUNDLERS")/node_modules/.bin:$PATH
wasm=$(realpath "$PACKAGE")/sparse_local.wasm
mkdir -p "$dir/node_modules" && cp -r "$PACKAGE" "$dir/node_modules/sparse-local"
cp "$here/app.mjs" "$dir" && cd "$dir" || exit 1
echo '{"name": "app", "private": true}' >package.json
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome)
skipped=0
skip() {
    echo "skipped: $1"
    skipped=$((skipped + 1))
}

# page NAME FOLDER SCRIPT: the page of a bundle, if there is a browser.
page() {
    [ -f "$2/index.html" ] ||
        echo "<body><script type=module src=\"./$3\"></script></body>" >"$2/index.html"
    if [ -n "$browser" ]; then
        node "$here/test_bundle.mjs" "$browser" "$2" >out 2>&1
        record $? "$1: its page solves"
    else
        skip "no Chromium, so that the page of $1 is not tried"
    fi
}

# bundled NAME FOLDER: code for browsers alone, and the module beside it.
bundled() {
    ! grep -rqF 'node:fs' "$2" && find "$2" -name '*.wasm' | grep -q . &&
        find "$2" -name '*.wasm' ! -exec cmp -s "$wasm" {} \; -print >out && [ ! -s out ]
    record $? "$1: no module of node, and WebAssembly as in the package"
}

if command -v esbuild >/dev/null 2>&1; then
    # esbuild copies no files by URL: the module is put beside the bundle, or into it
    esbuild app.mjs --bundle --format=esm --outfile=es/app.js >out 2>&1 && cp "$wasm" es
    record $? 'esbuild for browsers'
    bundled esbuild es
    page esbuild es app.js
    { echo 'import bytes from "sparse-local/sparse_local.wasm";'
      echo 'globalThis.wasmBytes = bytes; await import("./app.mjs");'; } >inside.mjs
    esbuild inside.mjs --bundle --format=esm --target=es2022 --loader:.wasm=binary \
        --outfile=inside/app.mjs >out 2>&1 &&
        [ "$(node inside/app.mjs 2>>out)" = 'value 0.25' ]
    record $? 'esbuild with the module in the bundle'
    esbuild app.mjs --bundle --format=esm --platform=node --outfile=node/app.mjs >out 2>&1 &&
        cp "$wasm" node && [ "$(node node/app.mjs 2>>out)" = 'value 0.25' ]
    record $? 'esbuild for node'
else
    skip 'no esbuild'
fi

if command -v webpack >/dev/null 2>&1; then
    webpack --mode production --entry ./app.mjs -o "$dir/wp" >out 2>&1 && ls wp/*.wasm >>out 2>&1
    record $? 'webpack copies the module'
    bundled webpack wp
    page webpack wp main.js
else
    skip 'no webpack'
fi

if command -v vite >/dev/null 2>&1; then
    echo '<body><script type="module" src="./app.mjs"></script></body>' >index.html
    vite build --base ./ --outDir vt --assetsInlineLimit 0 --target esnext >out 2>&1 &&
        ls vt/assets/*.wasm >>out 2>&1
    record $? 'vite copies the module'
    bundled vite vt
    page vite vt
else
    skip 'no vite'
fi

echo "$passed passed, $failed failed$([ $skipped -eq 0 ] || echo ", $skipped skipped")"
[ $failed -eq 0 ]
