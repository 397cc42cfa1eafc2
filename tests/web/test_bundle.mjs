/* test_bundle.mjs: a folder with index.html, served by this machine, gives its answer in headless Chromium */
//
//     node tests/web/test_bundle.mjs CHROMIUM FOLDER

import {existsSync} from "node:fs";
import {extname, join, normalize} from "node:path";
import {report} from "./served_page.mjs";

const [chromium, folder] = process.argv.slice(2);
const types = {".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript", ".wasm": "application/wasm"};
await report(chromium, "index.html", path => {
    const type = types[extname(path)], file = join(folder, normalize(path));
    return type && existsSync(file) ? [type, file] : undefined;
}, text => text === "value 0.25");
