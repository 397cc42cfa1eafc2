/* test_package.mjs: the npm package under node: solves, changes, arrays, memory, errors */
//
//     node tests/web/test_package.mjs FOLDER_OF_THE_PACKAGE

import {readFileSync} from "node:fs";
import {pathToFileURL} from "node:url";
import {test, check, near, thrown, end} from "./harness.mjs";

const folder = pathToFileURL(`${process.argv[2]}/`);
const {load, default: loadToo, SparseLocalError, HeapArray, Matrix, Factor, inOwnNames} =
    await import(new URL("node.js", folder));
const bytes = readFileSync(new URL("sparse_local.wasm", folder));
const sl = await load();

/* ---- systems, and answers of dense elimination ---- */

/* I + Laplacian of a grid, with edges of random weights, the lower triangle as triplets. */
function grid(width, height, shift = 1) {
    const rows = [], columns = [], values = [];
    let random = 1;
    const add = (i, j, x) => { rows.push(i); columns.push(j); values.push(x); };
    for (let k = 0; k < width * height; k++) {
        add(k, k, shift);
        for (const next of [k % width < width - 1 ? k + 1 : -1, k + width < width * height ? k + width : -1]) {
            if (next < 0) continue;
            random = (random * 16807) % 2147483647;
            const w = 0.5 + random / 2147483647;
            add(next, k, -w);
            add(k, k, w);
            add(next, next, w);
        }
    }
    return {n: width * height, rows, columns, values};
}

const matrixOf = g => sl.fromTriplets(g.n, g.rows, g.columns, g.values);

function dense(g) {
    const A = Array.from({length: g.n}, () => new Float64Array(g.n));
    g.rows.forEach((i, k) => {
        A[i][g.columns[k]] += g.values[k];
        if (i !== g.columns[k]) A[g.columns[k]][i] += g.values[k];
    });
    return A;
}

function denseSolve(given, b) {
    const A = given.map(row => row.slice()), x = Float64Array.from(b), n = b.length;
    for (let k = 0; k < n; k++) {
        for (let i = k + 1; i < n; i++) {
            const factor = A[i][k] / A[k][k];
            for (let j = k; j < n; j++) A[i][j] -= factor * A[k][j];
            x[i] -= factor * x[k];
        }
    }
    for (let k = n - 1; k >= 0; k--) {
        for (let j = k + 1; j < n; j++) x[k] -= A[k][j] * x[j];
        x[k] /= A[k][k];
    }
    return x;
}

const g = grid(9, 7), n = g.n, D = dense(g), A = matrixOf(g);
const b = Float64Array.from({length: n}, (_, k) => Math.sin(k)), x = denseSolve(D, b);
const F = sl.factor(A, {definite: true});

/* ---- solves ---- */

test("an instance has a version and a heap", () => {
    check(/^\d+\.\d+\.\d+$/.test(sl.version) && sl.bytes > 0 && load === loadToo);
    check(JSON.parse(readFileSync(new URL("package.json", folder))).version.split("-")[0] === sl.version);
});

test("a matrix from triplets is in compressed columns", () => {
    check(A instanceof Matrix && A.n === n && A.p[n] === A.x.length && A.i.length === A.x.length);
    let sum = 0;
    for (const value of A.x) sum += value;
    near([sum], [g.values.reduce((a, v) => a + v)]);
});

test("a full solve of one column, and of three", () => {
    near(F.solve(b), x);
    near(F.solve(Array.from(b)), x);
    const three = new Float64Array(3 * n);
    for (let c = 0; c < 3; c++) three.set(b.map(v => (c + 1) * v), c * n);
    const X = F.solve(three);
    for (let c = 0; c < 3; c++) near(X.subarray(c * n, (c + 1) * n), x.map(v => (c + 1) * v));
    check(F.solve([]).length === 0);
});

test("results go where they are wanted", () => {
    const given = new Float64Array(n), single = new Float32Array(n), list = new Array(n).fill(0), same = b.slice();
    check(F.solve(b, given) === given && F.solve(b, single) === single);
    near(given, x);
    near(single, x, 1e-6);
    near(F.solve(b, list), x);
    near(F.solve(same, same), x);
});

test("arrays in the heap are used in place", () => {
    const at = sl.float64(n), to = sl.float64(n), views = [at.view, to.view];
    at.view.set(b);
    check(F.solve(at, to) === to);
    near(to.view, x);
    check(views[0] === at.view && views[1] === to.view);
    to.view.fill(0);
    F.solve(at.view, to.view);
    near(to.view, x);
    F.solve(at, at);
    near(at.view, x);
    at.dispose();
    to.dispose();
    to.dispose();
});

test("a local solve is the full one on its rows", () => {
    const bset = [3, 40], xset = Int32Array.of(5, 0, 62), full = new Float64Array(n);
    full[3] = 2;
    full[40] = -1;
    const all = F.solve(full), P = F.plan(bset, xset);
    check(P.nb === 2 && P.nx === 3);
    const local = P.solve([2, -1]);
    xset.forEach((row, k) => check(local[k] === all[row]));
    near(F.localSolve(bset, [2, -1], xset), local, 0);
    near(F.plan(bset, null).solve([2, -1]), all, 0);
    near(F.localSolve(null, full, xset, new Float64Array(3)), local, 0);
    near(P.solve([2, -1, 4, -2]).subarray(3), local.map(v => 2 * v));
    near(F.plan([], [1]).solve([]), [0]);
    const held = sl.float64(3);
    P.solve([2, -1], held);
    near(held.view, local, 0);
    held.dispose();
    P.dispose();
});

test("one analysis serves several factors, and their plans", () => {
    const S = sl.analyze({n, p: A.p, i: A.i}), twice = {n, p: A.p.slice(), i: A.i.slice(), x: A.x.map(v => 2 * v)};
    const F1 = S.factor(A), F2 = S.factor(twice), perm = Array.from(S.perm).sort((i, j) => i - j);
    check(perm.every((row, k) => row === k));
    S.dispose();
    near(F2.solve(b), x.map(v => v / 2));
    const P = F1.plan([7], [9]);
    near(P.solve([1], new Float64Array(1), F2), P.solve([1]).map(v => v / 2));
    F2.refactor(A);
    near(F2.solve(b), x);
});

test("orders, triangles and purposes give the same solution", () => {
    const upper = sl.fromTriplets(n, g.columns, g.rows, g.values), S = sl.analyze(A);
    for (const [M, options] of [[A, {ordering: "mindeg"}], [A, {ordering: "natural"}], [A, {perm: S.perm}],
        [A, {purpose: "one factor"}], [upper, {}], [upper, {triangle: "upper"}], [A, {blockSize: 3}]]) {
        near(sl.factor(M, options).solve(b), x, 1e-11);
    }
});

test("statistics of a factor", () => {
    const s = F.stats;
    check(s.positive === n && s.negative === 0 && s.null === 0);
    check(s.nnzL >= A.x.length && s.nnzPanels >= n && s.bytes > 8 * n && s.supernodes > 0 && s.growth >= 1);
});

test("a singular Laplacian", () => {
    const L = matrixOf(grid(9, 7, 0)), mass = new Float64Array(n).fill(1), Z = sl.factor(L, {nullPivots: "skip", mass});
    check(Z.stats.null === 1);
    const u = Z.solve(b), mean = b.reduce((sum, v) => sum + v) / n;
    near([u.reduce((sum, v) => sum + v)], [0], 1e300);
    const back = dense(grid(9, 7, 0)).map(row => row.reduce((sum, v, k) => sum + v * u[k], 0));
    near(back, b.map(v => v - mean), 1e-11);
});

/* ---- changes ---- */

test("a change by entries, by columns, and back", () => {
    const C = sl.factor(A), E = dense(g), P = C.plan(null, [30]);
    E[10][10] += 3;
    E[11][11] += 3;
    E[10][11] -= 3;
    E[11][10] -= 3;
    C.changeEntries([10, 11, 11], [10, 11, 10], [3, 3, -3]);
    near(C.solve(b), denseSolve(E, b), 1e-11);
    near(P.solve(b), [denseSolve(E, b)[30]], 1e-11);
    const V = {p: [0, 2], i: [10, 11], x: [1, -1]};
    C.rankUpdate(V, [-3]);
    near(C.solve(b), x, 1e-11);
    C.rankUpdate({p: Int32Array.of(0, 1, 2), i: [0, 5], x: [2, 3]});
    E[10][10] -= 3;
    E[11][11] -= 3;
    E[10][11] += 3;
    E[11][10] += 3;
    E[0][0] += 4;
    E[5][5] += 9;
    near(C.solve(b), denseSolve(E, b), 1e-11);
});

test("pins hold rows", () => {
    const held = D.map((row, i) => i === 4 || i === 50 ? row.map((_, j) => i === j ? 1 : 0) : row), right = b.slice();
    right[4] = 2;
    right[50] = -1;
    const wanted = denseSolve(held, right), P = F.constraints([4, 50]);
    near(P.solve(b, [2, -1]), wanted, 1e-11);
    const same = b.slice();
    near(P.solve(same, [2, -1], {x: same}), wanted, 1e-11);
    const plan = F.plan([], [20, 4]), zero = P.solve(null, [2, -1]);
    near(P.solve(null, [2, -1], {plan}), [zero[20], 2], 1e-11);
    P.add([30]).release([0, 2]);
    check(P.count === 1);
    check(Math.abs(P.solve(b, [7])[50] - 7) < 1e-12);
    const G = sl.factor(A), Q = G.constraints([4, 50]);
    G.changeEntries([1], [1], [1]);
    check(thrown(() => Q.solve(null, [2, -1])).status === "STALE");
    Q.refactor();
    check(Math.abs(Q.solve(null, [2, -1])[4] - 2) < 1e-12);
    check(thrown(() => F.constraints([n])).row === n);
    check(F.constraints().count === 0);
});

/* ---- memory ---- */

test("the heap grows, and arrays in it stay", () => {
    const at = sl.float64(n), before = at.view, size = sl.bytes;
    before.set(b);
    const large = Array.from({length: 4}, () => sl.float64(4 << 20));
    check(sl.bytes > size && before.length === 0);
    near(at.view, b, 0);
    near(F.solve(at), x);
    const error = thrown(() => F.solve(at, before));
    check(error instanceof RangeError && /grown/.test(error.message));
    for (const array of large) array.dispose();
    at.dispose();
});

test("a result in the heap is there although the call made the heap grow", () => {
    const other = sl.fromTriplets(40000, ...Object.values(grid(200, 200)).slice(1)), to = sl.float64(40000);
    const raw = to.view, G = sl.factor(other);
    check(raw.length === 40000 || to.view.length === 40000);
    const u = G.solve(new Float64Array(40000).fill(1), to).view;
    near([Math.min(...u), Math.max(...u)], [1, 1], 1e-10);
});

test("objects are disposed of in any order, once or more", () => {
    const M = matrixOf(g), S = sl.analyze(M), G = S.factor(M), P = G.plan([1], [2]), Q = G.constraints([3]);
    const value = P.solve([1]);
    M.dispose();
    S.dispose();
    near(P.solve([1]), value, 0);
    G.dispose();
    G.dispose();
    check(Q.solve(null, [1], {plan: P})[0] !== 0);
    check(/Factor has been disposed of/.test(thrown(() => G.solve(b)).message));
    check(thrown(() => G.solve(b)).status === "STALE" && thrown(() => M.x).status === "STALE");
    check(/Factor has been disposed of/.test(thrown(() => P.solve([1])).message));
    P.dispose();
    Q.dispose();
    check(/Matrix has been disposed of/.test(thrown(() => M.x).message));
    const array = sl.int32(3);
    array.dispose();
    check(/disposed of/.test(thrown(() => array.view).message));
    check(/disposed of/.test(thrown(() => F.plan(array, null)).message));
});

test("calls of the same kind leave the heap as large as it was", () => {
    let size = 0;
    for (let k = 0; k < 400; k++) {
        const G = sl.factor(A), P = G.plan(null, [k % n]), Q = G.constraints([1]);
        P.solve(b);
        Q.solve(null, [1]);
        for (const object of [G, P, Q]) object.dispose();
        if (k === 100) size = sl.bytes;
    }
    check(sl.bytes === size);
});

/* ---- errors ---- */

test("an error has the text of the library, its status and its place", () => {
    const error = thrown(() => sl.factor(sl.fromTriplets(2, [0, 1, 1], [0, 0, 1], [1, 1, 1])));
    check(error instanceof SparseLocalError && error instanceof Error && error.name === "SparseLocalError");
    check(error.status === "PIVOT" && error.row === 1 && error.message.startsWith("refused pivot"));
    check(/nullPivots: "skip"/.test(error.message) && !/options[.]pivots|SL_/.test(error.message), error.message);
    const cases = [
        [() => sl.fromTriplets(2, [0, 5], [0, 0], [1, 1]), "ARGUMENT", 5],
        [() => sl.factor({n: 2, p: [0, 1, 2], i: [0, 7], x: [1, 1]}), "MALFORMED", 7],
        [() => sl.factor({n: 2, p: [0, 1, 2], i: [0, 1], x: [1, NaN]}), "NOT_FINITE", 1],
        [() => sl.factor({n: 2, p: [0, 1, 2], i: [0, 1], x: [1, -1]}, {definite: true}), "PIVOT", 1],
        [() => F.refactor({n, p: [0, ...new Array(n).fill(1)], i: [0], x: [1]}), "OTHER_PATTERN", -1],
        [() => F.plan([n], null), "ARGUMENT", n],
        [() => F.localSolve([-1], [1], [0]), "ARGUMENT", -1],
        [() => F.changeEntries([0], [n], [1]), "ARGUMENT", 0],
        [() => F.changeEntries([0], [n - 1], [1]), "OTHER_PATTERN", -2],
        [() => sl.factor(A, {perm: new Int32Array(n)}), "ARGUMENT", -2],
        [() => sl.factor(A).plan([0], null).solve([1], new Float64Array(n), sl.factor(A)), "MISMATCH", -1],
        [() => F.solve(b.map(() => NaN)), "NOT_FINITE", -1]];
    cases.forEach(([body, status, row], k) => {
        const e = thrown(body);
        check(e instanceof SparseLocalError, `case ${k}: ${e.stack}`);
        check(e.status === status && (row === -2 || e.row === row), `case ${k}: ${e.status} ${e.row} ${e.message}`);
        check(e.message.length > 10, `case ${k}: ${e.message}`);
    });
    near(F.solve(b), x); /* and the factor is as before */
});

/* The header without comments, from the folder of the project. */
const header = readFileSync(new URL("../../sparse_local.h", import.meta.url), "utf8")
    .replace(/\/[*].*?[*]\//gs, "");
/* Names with a prefix, options, pointers and the fields of structs that JavaScript has not. */
const ofC = /\b(?:sl|SL|sli|SLI)_|\bMETIS_|\b(?:options|stats|set|threads)[.]|\b(?:options|set) is not|\bNULL\b|\bsize_t\b|\bld[a-z]\b|\w_\w|\b[A-Z][.](?:im|columns)\b/;

test("statuses are those of the header, also in the types", () => {
    const names = [...header.match(/typedef enum sl_status \{(.*?)\} sl_status;/s)[1].matchAll(/\bSL_(?:ERR_)?(\w+)/g)]
        .map(([, name]) => name);
    check(names.length === 16 && names[0] === "OK");
    names.forEach((name, k) => check(new SparseLocalError("", k).status === name, name));
    const types = readFileSync(new URL("sparse_local.d.ts", folder), "utf8");
    const typed = /readonly status: (.*?);/s.exec(types)[1].match(/\w+/g);
    check(typed.join() === names.slice(1).join(), typed.join());
});

test("live pages call only what there is", () => { /* test-live runs them, where there is Chromium */
    const page = readFileSync(new URL("../../tools/draw/view_live.js", import.meta.url), "utf8");
    const S = sl.analyze(A), objects = {sparse: sl, analysis: S, heatFactor: F, poisson: F, pins: F.constraints()};
    const calls = [...page.matchAll(/\b(sparse|analysis|heatFactor|poisson|pins)[.](\w+)\(/g)];
    check(calls.length > 7);
    for (const [call, object, name] of calls) check(typeof objects[object][name] === "function", call);
});

test("no sentence of the library keeps a name of C", () => {
    const texts = new Set([...header.matchAll(/"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*/g)]
        .map(([text]) => text.replace(/"\s*"|^"|"$/g, ""))
        .filter(text => text.includes(" ") && !text.includes("%") && !text.startsWith("sparse_local.h")));
    check(texts.size > 250 && texts.has("A is not square"));
    let named = 0;
    for (const text of texts) {
        const ours = inOwnNames(`status: ${text} (row 3)`);
        named += ofC.test(text);
        check(!ofC.test(ours) && /^status.* [(]row 3[)]$/s.test(ours), ours);
        check(ofC.test(text) || ours === `status: ${text} (row 3)`, ours);
    }
    check(named > 100);
});

test("wrong uses are refused in names of JavaScript", () => {
    const s = 6, L = matrixOf(grid(s, s, 0)), B = matrixOf(grid(s, s)), m = s * s, ones = new Float64Array(m).fill(1);
    const S = sl.factor(L, {nullPivots: "skip"}), G = sl.factor(B), C = G.constraints([3]), other = sl.factor(B);
    const failed = sl.factor(B), closed = sl.factor(B), indefinite = sl.fromTriplets(2, [0, 1], [0, 1], [1, -1]);
    const triangle = {n: 2, p: [0, 2, 4], i: [0, 1, 0, 1]};
    thrown(() => failed.refactor({n: m, p: B.p.slice(), i: B.i.slice(), x: new Float64Array(B.x.length)}));
    closed.dispose();
    G.refactor(B);
    const cases = [() => sl.factor(L), () => sl.factor(sl.fromTriplets(2, [0], [0], [1])),
        () => sl.factor(sl.fromTriplets(3, [1, 2, 2], [0, 0, 1], [1, 2, 3])), () => sl.factor(indefinite, {definite: true}),
        () => sl.factor({...triangle, x: [2, 1, 7, 2]}),
        () => sl.factor({...triangle, x: [2, NaN, NaN, 2]}), () => sl.factor({n: 2, p: [0, 2, 1], i: [0, 1], x: [1, 1]}),
        () => sl.factor({n: 2, p: [1, 1, 2], i: [0, 1], x: [1, 1]}), () => sl.factor(B, {blockSize: 5}),
        () => sl.factor(B, {blockSize: -1}), () => sl.factor(B, {perm: new Int32Array(m)}),
        () => sl.factor(L, {nullPivots: "skip", mass: ones.map(() => NaN)}),
        () => S.solve(ones), () => S.localSolve([3], [1], [4]), () => G.solve(ones.map(() => NaN)),
        () => G.plan([m], [0]), () => G.plan([0], [-1]), () => G.constraints([m]), () => G.constraints([3, 3]),
        () => sl.factor(indefinite).constraints([0]), () => C.solve(null, [1]), () => C.release([4]),
        () => G.refactor(L.n === m ? indefinite : L), () => G.changeEntries([0], [m - 1], [1]),
        () => G.changeEntries([0], [0], [-1e6]), () => G.changeEntries([0], [0], [NaN]),
        () => S.changeEntries([0], [0], [1]), () => G.rankUpdate({p: [0, 1], i: [m], x: [1]}),
        () => G.rankUpdate({p: [0, 1], i: [0], x: [NaN]}), () => G.plan([0], [1]).solve([1], null, other),
        () => failed.solve(ones), () => closed.solve(ones), () => closed.stats, () => sl.fromTriplets(2, [0, 5], [0, 0], [1, 1])];
    const said = new Set();
    cases.forEach((body, k) => {
        const {message} = thrown(body);
        check(!ofC.test(message) && message.length > 8, `case ${k}: ${message}`);
        said.add(message);
    });
    check(said.size > 25, `${said.size}`);
});

test("arguments that the library would read beyond their ends", () => {
    const short = new Float64Array(n - 1), cases = [
        [() => F.solve(short), /62 numbers are not a multiple of 63 rows/],
        [() => F.solve(b, short), /x: 63 numbers are wanted, not 62/],
        [() => F.solve(null, short), /b: an array is wanted/],
        [() => F.solve(5), /b: an array is wanted/],
        [() => F.plan([0], [1]).solve([1, 2], []), /x: 2 numbers/],
        [() => F.plan([0, 1], [1]).solve([1]), /not a multiple of 2/],
        [() => F.localSolve([0], [1], null, short), /x: 63/],
        [() => F.localSolve([0], [1], 5), /xset: an array is wanted/],
        [() => F.changeEntries([0], [], []), /columns: 1 numbers/],
        [() => F.rankUpdate({p: [0, 2], i: [0], x: [1, 1]}), /A.i: 2 numbers/],
        [() => F.rankUpdate({p: [0, 1], i: [0], x: [1]}, []), /sigma: 1 numbers/],
        [() => F.constraints([1]).solve(b, [1, 2]), /b: 126 numbers/],
        [() => sl.factor({n: 3, p: [0, 1], i: [0], x: [1]}), /A.p: 4 numbers/],
        [() => sl.factor({n: 1, p: [0, 2], i: [0], x: [1]}), /A.i: 2 numbers/],
        [() => sl.factor({n: 1, p: [0, 1], i: [0]}), /A.x: 1 numbers/],
        [() => sl.factor({n: 1.5, p: [0], i: [], x: []}), /A.n: 1.5 is not a count/],
        [() => sl.factor(5), /a matrix/],
        [() => sl.factor(A, {order: "natural"}), /order is none of triangle/],
        [() => sl.analyze(A, {mass: b}), /mass is none of triangle, ordering, perm, blockSize, purpose$/],
        [() => sl.analyze(A).factor(A, {triangle: "upper"}), /triangle is none of nullPivots, mass, definite$/],
        [() => sl.factor(A, {triangle: "both"}), /triangle: both is none of auto, lower, upper$/],
        [() => sl.factor(A, {ordering: "metis"}), /ordering: metis is none of nd,/],
        [() => sl.factor(A, {ordering: "given"}), /needs perm/],
        [() => sl.factor(A, {ordering: "nd", perm: g.rows}), /perm no other ordering/],
        [() => sl.factor(A, {mass: short}), /mass: 63/],
        [() => sl.fromTriplets(2, [0, 1], [0], [1, 1]), /columns: 2 numbers/],
        [() => sl.fromTriplets(2, [0], [0, 1], [1]), /columns: 1 numbers are wanted, not 2/],
        [() => sl.fromTriplets(2, [0], [0], [1, 1]), /values: 1 numbers/],
        [() => F.changeEntries([0], [0, 1], [1]), /columns: 1 numbers/],
        [() => F.plan([0.5], [1]), /bset: 0.5 is not a 32-bit integer/],
        [() => F.plan([0], [NaN]), /xset: NaN is not a 32-bit integer/],
        [() => F.constraints(new Float64Array([2 ** 32])), /rows: 4294967296 is not a 32-bit integer/],
        [() => sl.float64(-1), /length: -1/],
        [() => F.plan(sl.float64(2), null), /HeapArray of Int32Array/]];
    cases.forEach(([body, text], k) => {
        const e = thrown(body);
        check((e instanceof RangeError || e instanceof TypeError) && text.test(e.message), `case ${k}: ${e.message}`);
    });
    near(F.solve(b), x);
});

/* ---- files ---- */

const marketOf = (sizes, symmetry = "symmetric", field = "real") =>
    `%%MatrixMarket matrix coordinate ${field} ${symmetry}\n${sizes}`;

test("a Matrix Market file is the matrix that it holds", () => {
    const lines = Array.from(g.rows, (i, k) => `${i + 1} ${g.columns[k] + 1} ${g.values[k]}`);
    const text = marketOf(`% a comment\n%${"x".repeat(100000)}\n\n ${n} ${n} ${lines.length} \r\n${lines.join("\r\n")}\n`);
    for (const source of [text, new TextEncoder().encode(text), new TextEncoder().encode(text).buffer, "\uFEFF" + text]) {
        const M = sl.readMatrix(source, {maxRows: n, maxEntries: lines.length, maxBytes: 1e6});
        near(sl.factor(M).solve(b), x);
    }
    near(sl.factor(sl.readMatrix(marketOf("2 2 3\n1 1 4\n1 2 1D0\n2 2 4e0"))).solve([5, 5]), [1, 1]);
    near(sl.factor(sl.readMatrix(marketOf("2 2 4\n1 1 4\n1 2 1\n2 1 1\n2 2 4\n", "general", "integer"))).solve([5, 5]),
        [1, 1]);
    check(sl.readMatrix(marketOf("0 0 0\n")).n === 0);
});

test("what a file claims is refused before memory is allocated", () => {
    const hostile = marketOf("2000000000 2000000000 1\n1 1 1.0\n", "general");
    check(hostile.length === 78);
    const before = [sl.bytes, process.memoryUsage().rss];
    const cases = [[hostile, {}, "TOO_LARGE"], [marketOf("9 9 2000000000\n1 1 1\n"), {}, "IO"],
        [hostile, {maxBytes: 77}, "TOO_LARGE"], [marketOf("9 9 1\n1 1 1\n"), {maxRows: 8}, "TOO_LARGE"],
        [marketOf("9 9 2\n1 1 1\n2 2 1\n"), {maxEntries: 1}, "TOO_LARGE"],
        [marketOf("9 9 1e99\n1 1 1\n"), {}, "IO"], [marketOf("3 4 1\n1 1 1\n"), {}, "ARGUMENT"],
        [marketOf("2 2 2\n1 1 1\n"), {}, "IO"], [marketOf("2 2 1\n1 1 1\n2 2 1\n"), {}, "IO"],
        [marketOf("2 2 1\n3 1 1\n"), {}, "IO"], [marketOf("2 2 1\n1 1.5 1\n"), {}, "IO"],
        [marketOf("2 2 1\n1 1 x\n"), {}, "IO"], [marketOf("2 2 1\n1 1 1 1\n"), {}, "IO"],
        [marketOf("2 2\n"), {}, "IO"], [marketOf(""), {}, "IO"], ["", {}, "IO"], ["x".repeat(100), {}, "IO"],
        [marketOf("y".repeat(100000)), {}, "IO"],
        [marketOf("2 2 2\n1 2 1\n2 1 1\n"), {}, "MALFORMED"], [marketOf("1 1 1\n1 1\n", "general", "pattern"), {},
            "UNSUPPORTED"], [marketOf("1 1 1\n1 1 0\n", "skew-symmetric"), {}, "UNSUPPORTED"]];
    cases.forEach(([text, limits, status], k) => {
        const e = thrown(() => sl.readMatrix(text, limits));
        check(e instanceof SparseLocalError && e.status === status, `case ${k}: ${e.status} ${e.message}`);
    });
    check(sl.bytes === before[0] && process.memoryUsage().rss - before[1] < 5e7);
    check(thrown(() => sl.readMatrix(5)) instanceof TypeError);
    check(thrown(() => sl.readMatrix("", {rows: 5})) instanceof RangeError);
    check(thrown(() => sl.readMatrix("", {maxBytes: -1})) instanceof RangeError);
});

test("an empty system", () => {
    const E = sl.factor(sl.fromTriplets(0, [], [], []));
    check(E.solve([]).length === 0 && E.n === 0 && E.stats.positive === 0);
});

/* ---- instances ---- */

const others = [await load(bytes), await load(new WebAssembly.Module(bytes)),
    await load(new URL("sparse_local.wasm", folder)), await load(new URL("sparse_local.wasm", folder).href)];

test("instances from bytes, a module and URLs have heaps of their own", () => {
    for (const other of others) {
        const at = other.float64(n);
        at.view.set(b);
        near(F.solve(at), x); /* copied from the other heap */
        const G = other.factor(A), to = other.float64(n); /* A too */
        near(F.solve(b, to).view, x);
        near(G.solve(b), x);
        check(G instanceof Factor && at instanceof HeapArray);
    }
});

const refused = await load(Uint8Array.of(1, 2, 3)).catch(error => error);
const missing = await load(new URL("none.wasm", folder)).catch(error => error);
test("what is no module is refused", () => check(refused instanceof Error && missing instanceof Error));

const full = await load(bytes), kept = [];
test("memory that runs out is an error, and the instance lives on", () => {
    const error = thrown(() => { for (;;) kept.push(full.float64(1 << 26)); });
    check(error instanceof SparseLocalError && error.status === "MEMORY" && error.message.length > 5);
    kept.pop().dispose();
    near(full.factor({n: 1, p: [0, 1], i: [0], x: [4]}).solve([2]), [0.5]);
});

end();
