/* bench.mjs: times of the npm package on the heat of a grid, beside cholesky-solve (make bench-npm) */
//
//     node tools/web/bench.mjs FOLDER_OF_THE_PACKAGE [FOLDER_WITH_NODE_MODULES] [SIDE]
//
// cholesky-solve and cuthill-mckee are taken from node_modules of the second folder, if it is given.
// cholesky-solve is timed in the order of the package, in the natural order of the grid, whose band is
// that of Cuthill and McKee, and up to 2e4 unknowns in the order of cuthill-mckee, as its README says.
// Times are the shortest ones, in milliseconds; both begin with a matrix in their own form.

import {createRequire} from "node:module";
import {pathToFileURL} from "node:url";

const [folder, peer, given] = process.argv.slice(2), side = Number(given ?? 316), n = side * side;
const {load} = await import(new URL("node.js", pathToFileURL(`${folder}/`)));

function time(body, count) {
    const times = [];
    let result;
    for (let k = 0; k < count; k++) {
        const began = performance.now();
        result = body(k);
        times.push(performance.now() - began);
    }
    return [Math.min(...times), result];
}

const rows = [], columns = [], values = [];
for (let k = 0; k < n; k++) {
    const next = [k % side < side - 1 ? k + 1 : n, k + side].filter(v => v < n);
    const degree = next.length + (k % side > 0 ? 1 : 0) + (k >= side ? 1 : 0);
    rows.push(k, ...next);
    columns.push(k, ...next.map(() => k));
    values.push(1 + degree, ...next.map(() => -1));
}
const b = Float64Array.from({length: n}, (_, k) => Math.sin(k));

console.log(`heat on a grid of ${n} unknowns, milliseconds${peer ? ", and their ratio to those of sparse-local" : ""}`);
function say(name, ms, ratio) {
    console.log(`${name.padEnd(40)}${ms.toPrecision(3).padStart(10)}${ratio ? ratio.toFixed(1).padStart(8) : ""}`);
}

const sl = await load(), A = sl.fromTriplets(n, rows, columns, values);
const [factored, F] = time(() => sl.factor(A), 5);
const [refactored] = time(() => F.refactor(A), 9);
const heapB = sl.float64(n), heapX = sl.float64(n);
heapB.view.set(b);
const x = F.solve(b), [copied] = time(() => F.solve(b, x), 25), [solved] = time(() => F.solve(heapB, heapX), 25);
const source = n >> 1, everywhere = F.plan([source], null), near = F.plan([source], [source + 1]);
const one = sl.float64(1), value = sl.float64(1);
one.view[0] = 1;
const [spread] = time(() => everywhere.solve(one, heapX), 25), [local] = time(() => near.solve(one, value), 999);
const edge = [[source, source + 1, source + 1], [source, source + 1, source]];
const [changed] = time(k => F.changeEntries(...edge, k % 2 ? [-1, -1, 1] : [1, 1, -1]), 21);
say("sparse-local: order and factor", factored);
say("sparse-local: refactor", refactored);
say("sparse-local: solve", solved);
say("sparse-local: solve, b and x copied", copied);
say("sparse-local: b in one row, x in all", spread);
say("sparse-local: b in one row, x in one", local);
say("sparse-local: one edge changed", changed);

if (peer) {
    const require = createRequire(pathToFileURL(`${peer}/`)), cholesky = require("cholesky-solve");
    const M = rows.map((row, k) => [columns[k], row, values[k]]);
    const dissection = Array.from(sl.analyze(A).perm), list = Array.from(b);
    for (const [name, order] of [["our order", () => dissection], ["natural order", () => undefined],
        ...(n > 2e4 ? [] : [["Cuthill-McKee", () => require("cuthill-mckee")(M, n)]])]) {
        const [prepared, solve] = time(() => cholesky.prepare(M, n, order()), 1), [took, y] = time(() => solve(list), 5);
        const error = y.reduce((most, v, k) => Math.max(most, Math.abs(v - x[k])), 0);
        if (!(error < 1e-8)) throw new Error(`solutions differ by ${error}`);
        say(`cholesky-solve, ${name}: factor`, prepared, prepared / factored);
        say(`cholesky-solve, ${name}: solve`, took, took / solved);
    }
}
