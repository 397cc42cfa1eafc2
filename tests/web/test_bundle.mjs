/* test_bundle.mjs: a folder with index.html, served by this machine, gives its answer in headless Chromium */
//
//     node tests/web/test_bundle.mjs CHROMIUM FOLDER

import {createServer} from "node:http";
import {existsSync, readFileSync} from "node:fs";
import {extname, join, normalize} from "node:path";
import {open} from "./browser.mjs";

const [chromium, folder] = process.argv.slice(2);
const types = {".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript", ".wasm": "application/wasm"};
const server = createServer((request, answer) => {
    const name = normalize(new URL(request.url, "http://localhost").pathname), file = join(folder, name);
    const found = extname(file) in types && existsSync(file);
    answer.writeHead(found ? 200 : 404, {"content-type": found ? types[extname(file)] : "text/plain"});
    answer.end(found ? readFileSync(file) : "");
});
await new Promise(resolve => { server.listen(0, "127.0.0.1", resolve); });
const page = await open(chromium, `http://127.0.0.1:${server.address().port}/index.html`);
try {
    const answer = await page.wait("document.body.dataset.test");
    console.log(answer);
    process.exitCode = answer === "value 0.25" ? 0 : 1;
} finally {
    await page.close();
    server.close();
}
