/* sparse_local.d.ts: the types of the npm package */

/* For `using`: as in TypeScript's library since 5.2. */
declare global {
    interface SymbolConstructor {
        readonly dispose: unique symbol;
    }
}

/** Any array of numbers; typed arrays of the right type in the heap are used in place. */
export type Numbers = ArrayLike<number> | HeapArray;
/** Where a result is written: a HeapArray or Float64Array in the heap in place, others by a copy. */
export type Result = Float64Array | Float32Array | number[] | HeapArray<Float64Array>;

/** A symmetric matrix in compressed columns: one triangle, or both. */
export interface MatrixArrays {
    readonly n: number;
    readonly p: Numbers; /* n + 1 positions */
    readonly i: Numbers; /* p[n] rows */
    readonly x?: Numbers; /* p[n] values; an analysis needs none */
}

export interface FactorOptions {
    nullPivots?: "refuse" | "skip"; /* skip: singular Laplacians */
    mass?: Numbers; /* with skip: n weights m; the solution has sum m x = 0 in each component */
    definite?: boolean; /* refuse negative pivots */
}

export interface AnalysisOptions {
    triangle?: "auto" | "lower" | "upper";
    ordering?: "nd" | "mindeg" | "natural" | "given";
    perm?: Numbers; /* perm[k]: row that is pivot k */
    blockSize?: number; /* rows of a vertex that stay together */
    purpose?: "many solves" | "one factor";
}

export type Options = AnalysisOptions & FactorOptions;

export interface FactorStats {
    nnzL: number; /* entries of L */
    nnzPanels: number; /* the same with padding */
    supernodes: number;
    bytes: number;
    positive: number; /* pivots by sign */
    negative: number;
    null: number;
    growth: number;
}

/** What the library refuses: its own sentence, and the row, column and value where there is one. */
export class SparseLocalError extends Error {
    readonly status: "ARGUMENT" | "MEMORY" | "MALFORMED" | "PIVOT" | "NOT_FINITE" | "TOO_LARGE" | "UNSUPPORTED" |
        "IO" | "ORDERING" | "MISMATCH" | "INCONSISTENT" | "INACCURATE" | "OTHER_PATTERN" | "STALE" | "READ_ONLY";
    readonly row: number; /* -1: none */
    readonly column: number; /* -1: none */
    readonly value: number;
}

/** Objects in the heap are released by dispose(), in any order, or when nobody can reach them any
 *  more. */
interface Owned {
    dispose(): void;
    [Symbol.dispose](): void;
}

/** An array in the heap. `view` is a typed array over it; take it anew after each call that may
 *  allocate, because a heap that grows detaches its views. */
export class HeapArray<T extends Float64Array | Int32Array = Float64Array | Int32Array> implements Owned {
    private constructor();
    readonly length: number;
    readonly view: T;
    dispose(): void;
    [Symbol.dispose](): void;
}

export class Matrix implements Owned {
    private constructor();
    readonly n: number;
    readonly p: Int32Array; /* views, as HeapArray.view */
    readonly i: Int32Array;
    readonly x: Float64Array;
    dispose(): void;
    [Symbol.dispose](): void;
}

export class Analysis implements Owned {
    private constructor();
    readonly n: number;
    readonly perm: Int32Array; /* a copy */
    factor(A: MatrixArrays, options?: FactorOptions): Factor;
    dispose(): void;
    [Symbol.dispose](): void;
}

export class Factor implements Owned {
    private constructor();
    readonly n: number;
    readonly stats: FactorStats;
    /** New values, same pattern. Plans stay valid; pins need a refactor. */
    refactor(A: MatrixArrays): this;
    /** A x = b for one or more columns; x may be b. */
    solve(b: Numbers): Float64Array;
    solve<X extends Result>(b: Numbers, x: X): X;
    /** b is 0 outside of bset, x is wanted on xset; null: all rows. */
    plan(bset: Numbers | null, xset: Numbers | null): Plan;
    localSolve(bset: Numbers | null, b: Numbers, xset: Numbers | null): Float64Array;
    localSolve<X extends Result>(bset: Numbers | null, b: Numbers, xset: Numbers | null, x: X): X;
    /** A + V diag(sigma) V': V has k columns, each with the rows of one entry or edge of A. */
    rankUpdate(V: {p: Numbers, i: Numbers, x: Numbers}, sigma?: Numbers | null): this;
    /** a_ij and a_ji by deltas, each pair given once. */
    changeEntries(rows: Numbers, columns: Numbers, deltas: Numbers): this;
    constraints(rows?: Numbers): Constraints;
    dispose(): void;
    [Symbol.dispose](): void;
}

export class Plan implements Owned {
    private constructor();
    readonly factor: Factor;
    readonly nb: number;
    readonly nx: number;
    solve(b: Numbers, x?: null, factor?: Factor): Float64Array;
    solve<X extends Result>(b: Numbers, x: X, factor?: Factor): X;
    dispose(): void;
    [Symbol.dispose](): void;
}

export class Constraints implements Owned {
    private constructor();
    readonly factor: Factor;
    readonly count: number;
    add(rows: Numbers): this;
    release(indices: Numbers): this;
    /** After a change of the factor. */
    refactor(): this;
    /** x is `values` at the pins, A x = b in all other rows; b null: 0. */
    solve(b: Numbers | null, values: Numbers, more?: {plan?: Plan | null}): Float64Array;
    solve<X extends Result>(b: Numbers | null, values: Numbers, more: {x: X, plan?: Plan | null}): X;
    dispose(): void;
    [Symbol.dispose](): void;
}

/** What a file of a stranger may claim; by default what its length allows: four bytes for an entry, 2^20
 *  rows and 16 for each entry. Above: SparseLocalError with the status TOO_LARGE. */
export interface Limits {
    maxRows?: number;
    maxEntries?: number;
    maxBytes?: number;
}

/** A module with a heap of its own, which all its objects share. */
export class SparseLocal {
    private constructor();
    readonly version: string;
    readonly bytes: number; /* of the heap */
    float64(length: number): HeapArray<Float64Array>;
    int32(length: number): HeapArray<Int32Array>;
    /** A matrix from triplets; equal positions are summed. */
    fromTriplets(n: number, rows: Numbers, columns: Numbers, values: Numbers): Matrix;
    /** The matrix of a Matrix Market file: square, coordinate, real or integer; a symmetric one gives its
     *  lower triangle. Sizes are compared with the limits before memory is allocated. */
    readMatrix(source: string | BufferSource, limits?: Limits): Matrix;
    analyze(A: MatrixArrays, options?: AnalysisOptions): Analysis;
    factor(A: MatrixArrays, options?: Options): Factor;
}

/** Makes an instance; source: nothing for the file of the package, or a module, its bytes, its URL (as fetch
 *  takes it). */
export function load(source?: WebAssembly.Module | BufferSource | URL | string): Promise<SparseLocal>;
export default load;
