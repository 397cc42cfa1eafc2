/* use.ts: a use of each type of the package, compiled and not run */
import load, {Analysis, Factor, HeapArray, Matrix, Constraints, Plan, SparseLocal, SparseLocalError} from "sparse-local";

async function use(bytes: ArrayBuffer): Promise<number> {
    const sl: SparseLocal = await load(bytes);
    const A: Matrix = sl.fromTriplets(2, [0, 1], Int32Array.of(0, 1), [1, 2]);
    const S: Analysis = sl.analyze({n: 2, p: A.p, i: A.i}, {ordering: "natural", triangle: "lower"});
    const F: Factor = S.factor(A, {definite: true, nullPivots: "refuse"});
    const b: HeapArray<Float64Array> = sl.float64(2), rows: HeapArray<Int32Array> = sl.int32(1);
    b.view.set([1, 2]);
    const x: Float64Array = F.solve(b), f: Float32Array = F.solve(b, new Float32Array(2));
    const P: Plan = F.plan(rows, null), Q: Constraints = F.constraints([0]);
    P.solve([1], b, F);
    const z: Float64Array = P.solve([1], null, F);
    Q.add([1]).release([0]).refactor();
    F.refactor(A).rankUpdate({p: [0, 1], i: [0], x: [1]}, null).changeEntries([0], [0], [1]);
    const y: Float64Array = Q.solve(null, [1], {plan: P}), growth: number = F.stats.growth;
    try {
        F.localSolve([0], [1], [1], [0]);
    } catch (error) {
        if (error instanceof SparseLocalError && error.status === "PIVOT") return error.row;
    }
    for (const object of [A, S, F, P, Q, b, rows]) object.dispose();
    return x[0] + z[0] + f[0] + y[0] + growth + sl.bytes;
}
export default use;
