/* heat.js: heat on a grid of 316 x 316 unknowns: a full solve, one value, a change, held rows */
import {load} from "sparse-local";

const side = 316, n = side * side, rows = [], columns = [], values = [];
function add(row, column, value) {
    rows.push(row);
    columns.push(column);
    values.push(value);
}
for (let k = 0; k < n; k++) { /* M + t L with M = I and t = 1, the lower triangle */
    add(k, k, 1);
    for (const next of [k % side < side - 1 ? k + 1 : n, k + side]) {
        if (next < n) {
            add(k, k, 1);
            add(next, next, 1);
            add(next, k, -1);
        }
    }
}

const clock = name => {
    const began = performance.now();
    return () => console.log(`${name}: ${(performance.now() - began).toFixed(2)} ms`);
};
let stop = clock("load");
const sl = await load();
stop();
stop = clock("matrix");
const A = sl.fromTriplets(n, Int32Array.from(rows), Int32Array.from(columns), Float64Array.from(values));
stop();
stop = clock("factor");
const F = sl.factor(A, {definite: true});
stop();

const source = n / 2, heat = sl.float64(n); /* in the heap: no copy */
stop = clock("heat of one source everywhere");
F.plan([source], null).solve([1], heat);
stop();
const near = F.plan([source], [source + 5]);
near.solve([1]);
stop = clock("heat of one source at one vertex");
const [x] = near.solve([1]);
stop();
console.log(`${x} is ${heat.view[source + 5]}`);

stop = clock("an edge that conducts ten times as much");
F.changeEntries([source, source + 1, source + 1], [source, source + 1, source], [9, 9, -9]);
stop();
console.log(`now ${near.solve([1])[0]}`);

const P = F.constraints([0, n - 1]);
stop = clock("a field that is 1 and -1 at two corners");
const field = P.solve(null, [1, -1]);
stop();
console.log(`${field[0].toFixed(6)} ${field[n - 1].toFixed(6)}`);
