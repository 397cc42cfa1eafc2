/* test_live.mjs: a page of view --live in headless Chromium: values, a drag, times of frames */
//
//     node tests/web/test_live.mjs CHROMIUM PAGE [FIELD=TABLE.csv ...]
//
// Each table is what the program computed from the first marked vertex of the page; its second column
// is compared with the field. Then the source is dragged, and times are printed. There is no network.

import {readFileSync} from "node:fs";
import {pathToFileURL} from "node:url";
import {resolve} from "node:path";
import {open} from "./browser.mjs";

const [chromium, path, ...tables] = process.argv.slice(2);
const page = await open(chromium, pathToFileURL(resolve(path)).href,
    ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--host-resolver-rules=MAP * ~NOTFOUND"]);
let failed = 0, passed = 0;
function check(condition, what) {
    if (condition) passed++;
    else failed++;
    if (!condition) console.log(`FAILED   ${what}`);
}
const spread = list => list.sort((a, b) => a - b) && `${list[0].toFixed(1)} to ${list[list.length >> 1].toFixed(1)}`;

try {
    const ready = await page.wait("globalThis.live?.ready", 120);
    const [n, bytes] = await page.value("[position.length / 3, live.bytes()]");
    console.log(`${n} vertices: analysis and factors in ${ready.toFixed(0)} ms, heap of ${(bytes / 1e6).toFixed(0)} MB`);
    check(await page.value("gl.getError()") === 0, "no error of WebGL");

    /* the fields are those of the program */
    for (const [name, file] of tables.map(t => t.split("="))) {
        await page.value(`element("field").selectedIndex = fields.findIndex(f => f.live === "${name}");
            live.update(live.source())`);
        const values = await page.value(`Array.from(fields.find(f => f.live === "${name}").value)`);
        let worst = 0, most = 0, count = 0;
        for (const line of readFileSync(file, "utf8").split("\n").slice(1).filter(text => text !== "")) {
            const [v, wanted] = line.split(",").map(Number);
            /* heat relative to itself, over many decades; the others relative to the largest */
            const error = Math.abs(values[v] - wanted);
            worst = Math.max(worst, name === "heat" ? error / Math.max(Math.abs(wanted), 1e-200) : error);
            most = Math.max(most, Math.abs(wanted));
            count++;
        }
        if (name !== "heat") worst /= most;
        console.log(`${name}: ${count} values differ by at most ${worst.toExponential(1)} from those of the program`);
        check(count === n && worst < 1e-6, `${name} is that of the program`);
    }

    /* the harmonic field keeps its values and its maximum principle */
    await page.value(`element("field").selectedIndex = fields.findIndex(f => f.live === "harmonic"); live.update(live.source())`);
    const ends = await page.value(`{ const h = fields.find(f => f.live === "harmonic").value;
        [h[data.marked[0]], h[data.marked[1]], Math.min(...h.subarray(0, 5000)), Math.max(...h.subarray(0, 5000))] }`);
    check(Math.abs(ends[0] - 1) < 1e-8 && Math.abs(ends[1]) < 1e-8, `the harmonic field holds 1 and 0, not ${ends}`);
    check(ends[2] > -1e-6 && ends[3] < 1 + 1e-6, `the harmonic field is between them: ${ends}`);

    /* a drag of the dot moves the source, and the camera stays; one elsewhere turns the page */
    await page.value(`element("field").selectedIndex = fields.findIndex(f => f.live === "heat"); live.update(live.source())`);
    const first = await page.value("live.source()"), turned = await page.value("turn.join()");
    const [x, y] = await page.value("live.place(live.source())");
    await page.value("live.times.length = 0");
    await page.mouse("mousePressed", x, y);
    for (let k = 1; k <= 40; k++) await page.mouse("mouseMoved", x + 2 * k * Math.cos(k / 20), y + k);
    await page.mouse("mouseReleased", x + 80 * Math.cos(2), y + 40);
    const moved = await page.value("live.source()"), frames = await page.value("live.times.length");
    check(moved !== first && frames > 3, `the drag moved the source from ${first} to ${moved} in ${frames} frames`);
    const [u, v] = await page.value("live.place(live.source())");
    check(Math.hypot(u - x - 80 * Math.cos(2), v - y - 40) < 20, `the source is under the pointer: ${[u - x, v - y]}`);
    check(!(await page.value("picked.concat(data.marked)")).includes(first), "its dot went along");
    check(await page.value("turn.join()") === turned, "the drag did not turn the page");
    check(await page.value(`{ const u = fields[element("field").selectedIndex].value;
        u.indexOf(u.reduce((a, b) => Math.max(a, b))) }`) === moved, "heat is largest at the source");
    await page.mouse("mousePressed", 200, 60);
    await page.mouse("mouseMoved", 230, 80);
    await page.mouse("mouseReleased", 230, 80);
    check(await page.value("turn.join()") !== turned && await page.value("live.source()") === moved,
        "a drag elsewhere turns the page");

    /* times: the source goes from vertex to vertex, a frame each */
    for (const name of ["heat", "distance", "harmonic"]) {
        const times = await page.value(`(async () => {
            element("field").selectedIndex = fields.findIndex(f => f.live === "${name}");
            const list = [];
            for (let k = 0; k < 40; k++) {
                await new Promise(requestAnimationFrame);
                list.push(live.update((live.source() + 7919) % ${n}));
            }
            return list.slice(10);
        })()`);
        console.log(`${name}: ${spread(times.map(t => t[0]))} ms to solve, ${spread(times.map(t => t[1]))} ms to color ` +
            `and to draw in software (shortest to median of ${times.length})`);
    }
    check(await page.value("gl.getError()") === 0, "no error of WebGL at the end");
    check(page.exceptions.length === 0, page.exceptions.join("\n"));
} finally {
    await page.close();
}
console.log(`${passed} checks of the page passed, ${failed} failed`);
process.exitCode = failed > 0 ? 1 : 0;
