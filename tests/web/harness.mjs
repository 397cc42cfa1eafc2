/* harness.mjs: named tests of the package; the last line is `N passed, N failed` */

let passed = 0, failed = 0;

export function test(name, body) {
    try {
        body();
        passed++;
    } catch (error) {
        failed++;
        console.log(`FAILED   ${name}\n    ${error.stack.split("\n").join("\n    ")}`);
    }
}

export function check(condition, what = "a check failed") {
    if (!condition) throw new Error(what);
}

export function near(x, y, tolerance = 1e-12) {
    check(x.length === y.length, `${x.length} numbers, not ${y.length}`);
    const size = Math.max(...Array.from(y, Math.abs), 1e-300);
    for (let k = 0; k < y.length; k++) {
        check(Math.abs(x[k] - y[k]) <= tolerance * size, `number ${k} is ${x[k]}, not ${y[k]}`);
    }
}

/* The error that body throws. */
export function thrown(body) {
    try {
        body();
    } catch (error) {
        return error;
    }
    throw new Error("no error was thrown");
}

export function end() {
    console.log(`${passed} passed, ${failed} failed`);
    process.exitCode = failed > 0 ? 1 : 0;
}
