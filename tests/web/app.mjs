/* app.mjs: what check_bundlers.sh bundles: a solve whose answer the page keeps, and node prints */
import {load} from "sparse-local";

const sl = await load(globalThis.wasmBytes);
const A = sl.fromTriplets(3, [0, 1, 1, 2, 2], [0, 0, 1, 1, 2], [2, -1, 2, -1, 2]);
const answer = `value ${sl.factor(A).plan([0], [2]).solve([1])[0]}`;
if (globalThis.document) document.body.dataset.test = answer;
else console.log(answer);
