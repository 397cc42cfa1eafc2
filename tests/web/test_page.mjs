/* test_page.mjs: a page that uses the npm package, served by this machine, in headless Chromium */
//
//     node tests/web/test_page.mjs CHROMIUM FOLDER_OF_THE_PACKAGE

import {createServer} from "node:http";
import {readFileSync} from "node:fs";
import {join} from "node:path";
import {open} from "./browser.mjs";

const [chromium, folder] = process.argv.slice(2);
const files = {
    "/page.html": ["text/html", new URL("page.html", import.meta.url)],
    "/sparse_local.js": ["text/javascript", join(folder, "sparse_local.js")],
    "/sparse_local.wasm": ["application/wasm", join(folder, "sparse_local.wasm")]};
const server = createServer((request, answer) => {
    const [type, file] = files[request.url] ?? [];
    answer.writeHead(type ? 200 : 404, {"content-type": type ?? "text/plain"});
    answer.end(type ? readFileSync(file) : "");
});
await new Promise(resolve => { server.listen(0, "127.0.0.1", resolve); });
const page = await open(chromium, `http://127.0.0.1:${server.address().port}/page.html`);
try {
    const report = await page.wait("document.body.dataset.test");
    console.log(report);
    process.exitCode = report.startsWith("value 0.25, field 5, error PIVOT, worker 0.25;") ? 0 : 1;
} finally {
    await page.close();
    server.close();
}
