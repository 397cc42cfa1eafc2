/* sparse_local.js: sparse symmetric systems, factored once and solved where asked, by WebAssembly */

/* load() makes an instance: a WebAssembly module with a memory of its own, its heap. All else are
 * methods of the instance and of the objects that it makes. Arguments that are arrays may be
 * - HeapArrays of the instance, or typed arrays of the right type over its memory: used in place;
 * - any other arrays of numbers: copied into the heap for the time of the call. */

const triangles = {auto: 0, lower: 1, upper: 2};
const orderings = {nd: 0, given: 3, natural: 4, mindeg: 5};
const purposes = {"many solves": 0, "one factor": 1};
const nullPivots = {refuse: 0, skip: 1};
const statuses = ["OK", "ARGUMENT", "MEMORY", "MALFORMED", "PIVOT", "NOT_FINITE", "TOO_LARGE",
    "UNSUPPORTED", "IO", "ORDERING", "MISMATCH", "INCONSISTENT", "INACCURATE", "OTHER_PATTERN", "STALE",
    "READ_ONLY"];
const OUT_OF_MEMORY = 2, STALE = 14;

/* What sentences of the library call by its names in C, and what that is here. A name that begins with
 * another one stands before it. */
const names = {
    "options.pivots = SL_PIVOTS_SKIP_NULL": 'nullPivots: "skip"',
    SL_PIVOTS_SKIP_NULL: 'nullPivots: "skip"',
    SL_PIVOTS_POSITIVE: "definite: true",
    ", without sl_symbolic_create_pivoted": "",
    " without sl_symbolic_create_pivoted": "",
    "sl_symbolic_create_pivoted factors it": "the C library factors it by 2x2 pivots",
    "sl_symbolic_create_pivoted avoids pivot growth": "2x2 pivots, which the C library has, avoid pivot growth",
    "options.null_vector or options.mass does": "mass does",
    "options.mass": "mass",
    "options.perm": "perm",
    "options.triangle": "triangle",
    "options.block_size": "blockSize",
    "beyond options.null_tolerance": "beyond rounding",
    "above options.error_limit": "above its limit",
    "exceeds options.growth_limit": "exceeds its limit",
    "of this row: options.null_vector": "of this row",
    sl_constraints_refactor: "refactor() of the constraints",
    "size_t counts": "the heap can hold"
};
const known = new RegExp(Object.keys(names)
    .map(name => `${/^\w/.test(name) ? "\\b" : ""}${name.replace(/[.]/g, "[.]")}\\b`).join("|"), "g");
/* What only C has: what names it gives way to the text of the status. */
const ofC = new RegExp("\\b(?:sl|SL)_|\\bMETIS_|\\b(?:options|stats|set|threads)[.]|\\b(?:options|set) is not|" +
    "\\b[A-Z][.](?:im|columns)\\b|\\bNULL\\b|\\bsize_t\\b|\\bld[a-z]\\b|[a-z]_[a-z]");

/* A sentence of the library in the names of this package, as its errors have it; exported for a test alone. */
export function inOwnNames(sentence) {
    const text = sentence.replace(known, name => names[name]);
    if (!ofC.test(text)) return text;
    const place = / \((?:row|column|line|value|errno) [^()]*\)$/.exec(text);
    return text.split(": ")[0] + (place ? place[0] : "");
}

/** What the library refuses: its own sentence, and where. */
export class SparseLocalError extends Error {
    constructor(message, status, row = -1, column = -1, value = 0) {
        super(message);
        this.name = "SparseLocalError";
        this.status = statuses[status] ?? String(status);
        this.row = row;
        this.column = column;
        this.value = value;
    }
}

/* ---- the heap ---- */

/** An array in the heap. Views of the heap lose their memory when it grows; `view` makes a new one
 *  then, and is otherwise the same object. */
export class HeapArray {
    #heap; #Type; #view = null;
    constructor(heap, Type, length) {
        this.#heap = heap;
        this.#Type = Type;
        this.length = length;
        this.pointer = heap.allocate(length * Type.BYTES_PER_ELEMENT);
        heap.watch(this, "web_release", this.pointer);
    }
    get type() { return this.#Type; }
    get view() {
        if (this.pointer === 0) throw new SparseLocalError("the array has been disposed of", STALE);
        if (this.#view?.buffer !== this.#heap.memory.buffer) {
            this.#view = new this.#Type(this.#heap.memory.buffer, this.pointer, this.length);
        }
        return this.#view;
    }
    dispose() { this.#heap.release(this, "web_release"); }
    belongsTo(heap) { return heap === this.#heap; }
}

/* The exports of a module, and the arguments of one call at a time. */
class Heap {
    #base = 0; #size = 0; #used = 0; #more = []; #results = [];
    #unused;
    constructor(exports) {
        this.exports = exports;
        this.memory = exports.memory;
        this.#unused = new FinalizationRegistry(({name, pointer}) => exports[name](pointer));
    }

    allocate(bytes) {
        const pointer = this.exports.web_allocate(Math.max(bytes, 8)) >>> 0;
        if (pointer === 0) throw this.error(OUT_OF_MEMORY);
        return pointer;
    }

    /* An object whose pointer is released when nobody can reach it any more. */
    watch(object, name, pointer) { this.#unused.register(object, {name, pointer}, object); }

    release(object, name) {
        if (object.pointer === 0) return;
        this.#unused.unregister(object);
        this.exports[name](object.pointer);
        object.pointer = 0;
    }

    /* Room for an argument, until `done`. What the first block has no room for gets its own, and the
     * first block is as large at the next call. */
    room(bytes) {
        const at = this.#used;
        this.#used += (bytes + 15) & ~15;
        if (this.#used <= this.#size) return this.#base + at;
        const pointer = this.allocate(bytes);
        this.#more.push(pointer);
        return pointer;
    }

    done() {
        const wanted = this.#used;
        for (const pointer of this.#more) this.exports.web_release(pointer);
        if (this.#more.length > 0) {
            this.exports.web_release(this.#base);
            this.#base = this.exports.web_allocate(wanted) >>> 0;
            this.#size = this.#base === 0 ? 0 : wanted;
        }
        this.#more = [];
        this.#results = [];
        this.#used = 0;
    }

    /* The address of an array that is in the heap; -1: it is elsewhere. */
    #addressOf(array, Type, name) {
        if (array instanceof HeapArray && array.belongsTo(this)) {
            if (array.type !== Type) throw new TypeError(`${name}: a HeapArray of ${Type.name} is wanted`);
            return array.view.byteOffset; /* which refuses one that has been disposed of */
        }
        return ArrayBuffer.isView(array) && array.buffer === this.memory.buffer && array instanceof Type
            ? array.byteOffset : -1;
    }

    /* The address of an argument with `length` numbers; null: 0. */
    put(array, Type, length, name) {
        if (array === null || array === undefined) return 0;
        this.check(array, length, name);
        const at = this.#addressOf(array, Type, name);
        if (at >= 0) return at;
        const pointer = this.room(length * Type.BYTES_PER_ELEMENT);
        const from = array instanceof HeapArray ? array.view : array;
        if (Type === Int32Array && !(from instanceof Int32Array)) checkIntegers(from, length, name);
        this.view(Type, pointer, length).set(from.length === length ? from : from.slice(0, length));
        return pointer;
    }

    /* The address of a result; what is elsewhere is copied there when the call has succeeded. */
    place(array, length, name) {
        this.check(array, length, name);
        const at = this.#addressOf(array, Float64Array, name);
        return at >= 0 ? at : this.copy(array, this.room(8 * length), length);
    }

    /* The same for a result that is computed where an argument is. */
    placeAt(array, pointer, length, name) {
        if (this.#addressOf(array, Float64Array, name) < 0) this.copy(array, pointer, length);
        return pointer;
    }

    copy(array, pointer, length) {
        this.#results.push({array, pointer, length});
        return pointer;
    }

    view(Type, pointer, length) { return new Type(this.memory.buffer, pointer, length); }

    check(array, length, name) {
        if (typeof array?.length !== "number") throw new TypeError(`${name}: an array is wanted`);
        if (ArrayBuffer.isView(array) && array.buffer.byteLength === 0 && length > 0) {
            throw new RangeError(`${name}: the array is detached; the heap has grown since the view was ` +
                "made: take a new one from the HeapArray");
        }
        if (array.length < length) {
            throw new RangeError(`${name}: ${length} numbers are wanted, not ${array.length}`);
        }
    }

    error(status) {
        const bytes = new Uint8Array(this.memory.buffer, this.exports.web_text(status));
        let end = 0;
        while (bytes[end] !== 0) end++;
        return new SparseLocalError(inOwnNames(new TextDecoder().decode(bytes.slice(0, end))), status,
            this.exports.web_error_row(), this.exports.web_error_column(), this.exports.web_error_value());
    }

    /* Runs body, which puts arguments and returns a status, copies results, and returns what `make`
     * does. */
    call(body, make = () => undefined) {
        try {
            const status = body();
            if (status !== 0) throw this.error(status);
            for (const {array, pointer, length} of this.#results) {
                const at = this.view(Float64Array, pointer, length);
                if (array instanceof HeapArray) array.view.set(at);
                else if (ArrayBuffer.isView(array)) array.set(at);
                else for (let k = 0; k < length; k++) array[k] = at[k];
            }
            return make();
        } finally {
            this.done();
        }
    }
}

/* ---- arguments ---- */

function choice(table, value, name) {
    if (value === undefined) return 0;
    if (!Object.hasOwn(table, value)) {
        throw new RangeError(`${name}: ${value} is none of ${Object.keys(table).join(", ")}`);
    }
    return table[value];
}

function countOf(array, name) {
    if (typeof array?.length !== "number") throw new TypeError(`${name}: an array is wanted`);
    return array.length;
}

/* Typed arrays would round or wrap what is not a 32-bit integer. */
function checkIntegers(array, length, name) {
    for (let k = 0; k < length; k++) {
        if (array[k] !== (array[k] | 0)) throw new RangeError(`${name}: ${array[k]} is not a 32-bit integer`);
    }
}

/* Refuses arrays that are not as long as the first of several. */
function checkSame(count, arrays) {
    for (const [name, array] of Object.entries(arrays)) {
        if (countOf(array, name) !== count) {
            throw new RangeError(`${name}: ${count} numbers are wanted, not ${array.length}`);
        }
    }
}

function integer(value, name) {
    if (!Number.isInteger(value) || value < 0 || value > 0x7fffffff) {
        throw new RangeError(`${name}: ${value} is not a count`);
    }
    return value;
}

/* How many columns of `rows` numbers an array has; wanted: that they are given. */
function columnsOf(array, rows, name) {
    const length = countOf(array, name);
    if (rows === 0 ? length !== 0 : length % rows !== 0) {
        throw new RangeError(`${name}: ${length} numbers are not a multiple of ${rows} rows`);
    }
    return rows === 0 ? 0 : length / rows;
}

/* Where x is computed: in the place of b if it is b. */
function placeFor(heap, x, b, from, length) {
    return x === b ? heap.placeAt(x, from, length, "x") : heap.place(x, length, "x");
}

/* The addresses of the arrays of a matrix. */
function putMatrix(heap, A, withValues, columns = A?.n) {
    if (A === null || typeof A !== "object") throw new TypeError("A: a matrix {n, p, i, x} is wanted");
    integer(A.n, "A.n");
    heap.check(A.p, columns + 1, "A.p");
    const nnz = integer((A.p instanceof HeapArray ? A.p.view : A.p)[columns], "A.p[n]");
    return [heap.put(A.p, Int32Array, columns + 1, "A.p"), heap.put(A.i, Int32Array, nnz, "A.i"),
        withValues ? heap.put(A.x ?? [], Float64Array, nnz, "A.x") : 0];
}

const ofAnalysis = ["triangle", "ordering", "perm", "blockSize", "purpose"], ofFactor = ["nullPivots", "mass", "definite"];

/* Refuses names that are none of these. */
function checkNames(what, given, known) {
    for (const key of Object.keys(given)) {
        if (!known.includes(key)) throw new RangeError(`${what}: ${key} is none of ${known.join(", ")}`);
    }
}

/* Those of the options that are listed. */
function chosen(options, known) {
    return Object.fromEntries(Object.entries(options).filter(([key]) => known.includes(key)));
}

function setOptions(heap, options, n) {
    const skips = choice(nullPivots, options.nullPivots, "nullPivots") === 1;
    if (skips && options.definite) throw new RangeError('options: definite excludes nullPivots "skip"');
    const given = options.perm !== undefined && options.ordering === undefined ? "given" : options.ordering;
    if ((given === "given") !== Boolean(options.perm)) {
        throw new RangeError('options: ordering "given" needs perm, and perm no other ordering');
    }
    heap.exports.web_options(choice(triangles, options.triangle, "triangle"),
        choice(orderings, given, "ordering"), heap.put(options.perm, Int32Array, n, "perm"),
        options.blockSize ?? 0, choice(purposes, options.purpose, "purpose"),
        skips ? 2 : options.definite ? 1 : 0, heap.put(options.mass, Float64Array, n, "mass"));
}

/* ---- files of strangers ---- */

/* An error that this package finds itself. */
function refused(text, status) {
    return new SparseLocalError(text, statuses.indexOf(status));
}

/* Refuses a count above a limit; undefined: there is none. */
function checkLimit(count, most, what) {
    if (most !== undefined && count > integer(most, what)) {
        throw refused(`too large: ${count} is above ${what}, ${most}`, "TOO_LARGE");
    }
}

/* The next line of a text from `at` on that has words and is no comment, and where it ends. */
function nextLine(text, at) {
    while (at < text.length) {
        const found = text.indexOf("\n", at), end = found < 0 ? text.length : found;
        const words = text[at] === "%" ? "" : text.slice(at, Math.min(end, at + LINE)).trim();
        if (end - at > LINE && words !== "") throw refused("a line is too long", "IO");
        at = end + 1;
        if (words !== "") return {words: words.split(/\s+/), at};
    }
    return {words: [], at};
}
const LINE = 65536;

/* The triplets of a Matrix Market file of a square matrix. Sizes that its line of sizes claims are
 * compared with the limits, and with the length of the text, before arrays are made for them. */
function triplets(text, {maxRows, maxEntries}) {
    const banner = /^\uFEFF?%%MatrixMarket\s+matrix\s+(\S+)\s+(\S+)\s+(\S+)[ \t\r]*(?=\n)/i.exec(text);
    if (banner === null) throw refused("not a Matrix Market file of a matrix", "IO");
    const [format, field, symmetry] = banner.slice(1).map(word => word.toLowerCase());
    if (format !== "coordinate" || !["real", "integer"].includes(field) ||
        !["general", "symmetric", "hermitian"].includes(symmetry)) {
        throw refused(`not supported: a file of ${format} ${field} ${symmetry}`, "UNSUPPORTED");
    }
    let {words, at} = nextLine(text, banner[0].length);
    const [n, columns, count] = words.map(Number);
    if (words.length !== 3 || ![n, columns, count].every(size => Number.isSafeInteger(size) && size >= 0)) {
        throw refused("the line of sizes is malformed", "IO");
    }
    checkLimit(Math.max(n, columns), maxRows, "maxRows");
    checkLimit(count, maxEntries, "maxEntries");
    if (n !== columns) throw refused(`A is not square: ${n} x ${columns}`, "ARGUMENT");
    if (n > 0x7ffffff7 || n / 16 > 65536 + count) {
        throw refused("too large: more than 2^20 rows, and over 16 for each entry", "TOO_LARGE");
    }
    if (count > (text.length - at) / 4 + 1) throw refused("fewer entries than the file says", "IO");
    const rows = new Int32Array(count), cols = new Int32Array(count), values = new Float64Array(count);
    let below = false, above = false;
    for (let k = 0; k < count; k++) {
        ({words, at} = nextLine(text, at));
        const [i, j, value] = [words[0], words[1], words[2]?.replace(/d/i, "e")].map(Number);
        if (words.length !== 3 || !(i >= 1 && i <= n && j >= 1 && j <= n) || i % 1 + j % 1 !== 0 || Number.isNaN(value)) {
            throw refused(`entry ${k + 1} is missing, malformed or out of range; rows count from 1`, "IO");
        }
        const swaps = symmetry !== "general" && i < j;
        below ||= i > j;
        above ||= i < j;
        rows[k] = (swaps ? j : i) - 1;
        cols[k] = (swaps ? i : j) - 1;
        values[k] = value;
    }
    if (nextLine(text, at).words.length > 0) throw refused("more entries than the file says", "IO");
    if (symmetry !== "general" && below && above) {
        throw refused("both triangles of a symmetric matrix", "MALFORMED");
    }
    return {n, rows, cols, values};
}

/* ---- objects ---- */

class Owned {
    heap; pointer; #release;
    constructor(heap, release) {
        this.heap = heap;
        this.pointer = heap.exports.web_made() >>> 0;
        this.#release = release;
        heap.watch(this, release, this.pointer);
        for (const key of ["heap", "pointer"]) Object.defineProperty(this, key, {enumerable: false});
    }
    get alive() {
        if (this.pointer === 0) {
            throw new SparseLocalError(`the ${this.constructor.name} has been disposed of`, STALE);
        }
        return this.pointer;
    }
    dispose() { this.heap.release(this, this.#release); }
}
for (const Type of [Owned, HeapArray]) {
    if (Symbol.dispose) Type.prototype[Symbol.dispose] = Type.prototype.dispose;
}

/** A matrix in the heap; p, i and x are views of its arrays. */
export class Matrix extends Owned {
    constructor(heap, n) {
        super(heap, "web_matrix_free");
        this.n = n;
    }
    #array(Type, which, length) {
        return this.heap.view(Type, this.heap.exports.web_matrix_array(this.alive, which) >>> 0, length);
    }
    get p() { return this.#array(Int32Array, 0, this.n + 1); }
    get i() { return this.#array(Int32Array, 1, this.p[this.n]); }
    get x() { return this.#array(Float64Array, 2, this.p[this.n]); }
}

/** The analysis of a pattern, for any number of factors. */
export class Analysis extends Owned {
    constructor(heap, n) {
        super(heap, "web_analysis_free");
        this.n = n;
    }
    /** perm[k]: the row of A that is pivot k. */
    get perm() {
        return this.heap.view(Int32Array, this.heap.exports.web_perm(this.alive) >>> 0, this.n).slice();
    }
    factor(A, options = {}) {
        const {heap} = this;
        return heap.call(() => {
            checkNames("options", options, ofFactor);
            setOptions(heap, options, this.n);
            return heap.exports.web_factor(this.alive, A.n, ...putMatrix(heap, A, true));
        }, () => new Factor(heap, this.n));
    }
}

/** P A P' = L D L'. */
export class Factor extends Owned {
    constructor(heap, n) {
        super(heap, "web_factor_free");
        this.n = n;
    }

    get stats() {
        const x = this.heap.view(Float64Array, this.heap.exports.web_factor_stats(this.alive) >>> 0, 9);
        return {nnzL: x[0], nnzPanels: x[1], supernodes: x[2], bytes: x[3] + x[4], positive: x[5],
            negative: x[6], null: x[7], growth: x[8]};
    }

    /** New values, same pattern. */
    refactor(A) {
        const {heap} = this;
        heap.call(() => heap.exports.web_refactor(this.alive, A.n, ...putMatrix(heap, A, true)));
        return this;
    }

    /** A x = b for each column of b; x may be b. */
    solve(b, x = new Float64Array(countOf(b, "b"))) {
        const {heap, n} = this, nrhs = columnsOf(b, n, "b");
        return heap.call(() => {
            const from = heap.put(b, Float64Array, n * nrhs, "b");
            const to = placeFor(heap, x, b, from, n * nrhs);
            return heap.exports.web_solve(this.alive, n, to, from, nrhs);
        }, () => x);
    }

    /** Local solves: b is 0 outside of the rows bset, x is wanted in the rows xset; null: all rows. */
    plan(bset, xset) {
        const {heap, n} = this, nb = bset === null ? n : countOf(bset, "bset");
        const nx = xset === null ? n : countOf(xset, "xset");
        return heap.call(() => heap.exports.web_plan(this.alive, heap.put(bset, Int32Array, nb, "bset"), nb,
            heap.put(xset, Int32Array, nx, "xset"), nx), () => new Plan(heap, this, nb, nx));
    }

    /** One local solve without a plan. */
    localSolve(bset, b, xset, x) {
        const {heap, n} = this, nb = bset === null ? n : countOf(bset, "bset");
        const nx = xset === null ? n : countOf(xset, "xset"), nrhs = columnsOf(b, nb, "b");
        x ??= new Float64Array(nx * nrhs);
        return heap.call(() => {
            const to = heap.place(x, nx * nrhs, "x");
            return heap.exports.web_local_solve(this.alive, heap.put(bset, Int32Array, nb, "bset"), nb,
                heap.put(xset, Int32Array, nx, "xset"), nx, to, nx, heap.put(b, Float64Array, nb * nrhs, "b"),
                nb, nrhs);
        }, () => x);
    }

    /** A + V diag(sigma) V'; V: k columns {p, i, x}. */
    rankUpdate(V, sigma = null) {
        const {heap, n} = this, k = countOf(V?.p, "V.p") - 1;
        heap.call(() => heap.exports.web_rank_update(this.alive, n, k,
            ...putMatrix(heap, {...V, n}, true, k), heap.put(sigma, Float64Array, k, "sigma")));
        return this;
    }

    /** Entries (rows[k], columns[k]), and their mirror images, by deltas[k]. */
    changeEntries(rows, columns, deltas) {
        const {heap} = this, count = countOf(rows, "rows");
        checkSame(count, {columns, deltas});
        heap.call(() => heap.exports.web_change_entries(this.alive,
            heap.put(rows, Int32Array, count, "rows"), heap.put(columns, Int32Array, count, "columns"),
            heap.put(deltas, Float64Array, count, "deltas"), count));
        return this;
    }

    /** Rows whose values solves prescribe; the factor stays as it is. */
    constraints(rows = []) {
        const {heap} = this;
        const pins = heap.call(() => heap.exports.web_constraints(this.alive), () => new Constraints(heap, this));
        try {
            return pins.add(rows);
        } catch (error) {
            pins.dispose();
            throw error;
        }
    }
}

export class Plan extends Owned {
    constructor(heap, factor, nb, nx) {
        super(heap, "web_plan_free");
        this.factor = factor;
        this.nb = nb;
        this.nx = nx;
    }
    /** b: the rows of the b-set, column by column; of another factor over the same analysis if given. */
    solve(b, x, factor = this.factor) {
        const {heap, nb, nx} = this, nrhs = nb === 0 ? 1 : columnsOf(b, nb, "b");
        x ??= new Float64Array(nx * nrhs);
        return heap.call(() => {
            const from = heap.put(b, Float64Array, nb * nrhs, "b"), to = heap.place(x, nx * nrhs, "x");
            return heap.exports.web_plan_solve(this.alive, factor.alive, to, nx, from, nb, nrhs);
        }, () => x);
    }
}

export class Constraints extends Owned {
    constructor(heap, factor) {
        super(heap, "web_constraints_free");
        this.factor = factor;
        this.count = 0;
    }
    add(rows) {
        const {heap} = this, count = countOf(rows, "rows");
        heap.call(() => heap.exports.web_constraints_add(this.alive, heap.put(rows, Int32Array, count, "rows"),
            count));
        this.count += count;
        return this;
    }
    /** indices: numbers of pins, 0 the first; the others keep their order. */
    release(indices) {
        const {heap} = this, count = countOf(indices, "indices");
        heap.call(() => heap.exports.web_constraints_release(this.alive,
            heap.put(indices, Int32Array, count, "indices"), count));
        this.count -= count;
        return this;
    }
    /** After a change of the factor. */
    refactor() {
        this.heap.call(() => this.heap.exports.web_constraints_refactor(this.alive));
        return this;
    }
    /** x is `values` at the pins, and A x = b in all other rows; b null: 0. With a plan a local solve
     *  of its sets. */
    solve(b, values, {x, plan = null} = {}) {
        const {heap, count} = this, n = this.factor.n, nb = plan ? plan.nb : n, nx = plan ? plan.nx : n;
        const nrhs = count === 0 ? columnsOf(b ?? [], nb, "b") : columnsOf(values, count, "values");
        x ??= new Float64Array(nx * nrhs);
        return heap.call(() => {
            const from = heap.put(b ?? new Float64Array(nb * nrhs), Float64Array, nb * nrhs, "b");
            const to = placeFor(heap, x, b, from, nx * nrhs);
            return heap.exports.web_constraints_solve(this.alive, plan ? plan.alive : 0, to, nx, from, nb,
                heap.put(values, Float64Array, count * nrhs, "values"), count, nrhs);
        }, () => x);
    }
}

/** A module with its heap. */
export class SparseLocal {
    #heap;
    constructor(exports) {
        this.#heap = new Heap(exports);
    }
    get version() {
        const v = this.#heap.exports.web_version();
        return `${Math.floor(v / 10000)}.${Math.floor(v / 100) % 100}.${v % 100}`;
    }
    get bytes() { return this.#heap.memory.buffer.byteLength; }
    float64(length) { return new HeapArray(this.#heap, Float64Array, integer(length, "length")); }
    int32(length) { return new HeapArray(this.#heap, Int32Array, integer(length, "length")); }

    /** Sums equal positions; one triangle, or both. */
    fromTriplets(n, rows, columns, values) {
        const heap = this.#heap, count = countOf(rows, "rows");
        checkSame(count, {columns, values});
        return heap.call(() => heap.exports.web_triplets(integer(n, "n"), count,
            heap.put(rows, Int32Array, count, "rows"), heap.put(columns, Int32Array, count, "columns"),
            heap.put(values, Float64Array, count, "values")), () => new Matrix(heap, n));
    }
    /** The matrix of a Matrix Market file, as text or bytes: square, coordinate, real or integer. A
     *  symmetric file gives its lower triangle. Without limits the file may claim what its length allows. */
    readMatrix(source, limits = {}) {
        checkNames("limits", limits, ["maxRows", "maxEntries", "maxBytes"]);
        const isText = typeof source === "string";
        if (!isText && !ArrayBuffer.isView(source) && !(source instanceof ArrayBuffer)) {
            throw new TypeError("source: a text or bytes are wanted");
        }
        checkLimit(isText ? source.length : source.byteLength, limits.maxBytes, "maxBytes");
        const {n, rows, cols, values} = triplets(isText ? source : new TextDecoder().decode(source), limits);
        return this.fromTriplets(n, rows, cols, values);
    }
    analyze(A, options = {}) {
        const heap = this.#heap;
        return heap.call(() => {
            const [p, i] = putMatrix(heap, A, false);
            checkNames("options", options, ofAnalysis);
            setOptions(heap, options, A.n);
            return heap.exports.web_analyze(A.n, p, i);
        }, () => new Analysis(heap, A.n));
    }
    factor(A, options = {}) {
        checkNames("options", options, [...ofAnalysis, ...ofFactor]);
        const analysis = this.analyze(A, chosen(options, ofAnalysis));
        try {
            return analysis.factor(A, chosen(options, ofFactor));
        } finally {
            analysis.dispose(); /* the factor keeps what it needs */
        }
    }
}

async function fetched(url) {
    const answer = await fetch(url);
    if (!answer.ok) throw new Error(`${url}: ${answer.status} ${answer.statusText}`);
    return answer.arrayBuffer();
}

/** Makes an instance. source: a compiled module, its bytes or its URL; nothing: sparse_local.wasm
 *  beside this file. Bundlers look for this very form of the URL, and copy the file. */
export async function load(source = new URL("./sparse_local.wasm", import.meta.url)) {
    const isUrl = typeof source === "string" || source instanceof URL;
    const given = isUrl ? await fetched(source) : source;
    const module = given instanceof WebAssembly.Module ? given : await WebAssembly.compile(given);
    const imports = {};
    for (const {module: from, name} of WebAssembly.Module.imports(module)) {
        /* files, which the text of errors alone links in and never opens */
        (imports[from] ??= {})[name] = () => { throw new Error(`${name} is not there`); };
    }
    const {exports} = await WebAssembly.instantiate(module, imports);
    exports._initialize();
    return new SparseLocal(exports);
}

export default load;
