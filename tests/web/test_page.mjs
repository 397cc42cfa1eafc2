/* test_page.mjs: a page that uses the npm package, served by this machine, in headless Chromium */
//
//     node tests/web/test_page.mjs CHROMIUM FOLDER_OF_THE_PACKAGE

import {join} from "node:path";
import {report} from "./served_page.mjs";

const [chromium, folder] = process.argv.slice(2);
const files = {
    "/page.html": ["text/html", new URL("page.html", import.meta.url)],
    "/sparse_local.js": ["text/javascript", join(folder, "sparse_local.js")],
    "/sparse_local.wasm": ["application/wasm", join(folder, "sparse_local.wasm")]};
await report(chromium, "page.html", path => files[path],
    text => text.startsWith("value 0.25, field 5, error PIVOT, worker 0.25;"));
