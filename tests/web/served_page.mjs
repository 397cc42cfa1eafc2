/* served_page.mjs: a page that this machine serves, in headless Chromium, and what it reports */
import {createServer} from "node:http";
import {readFileSync} from "node:fs";
import {open} from "./browser.mjs";

/** Opens /name and prints what the page leaves in document.body.dataset.test. find(path) returns
 *  the type and the file of a path, or nothing. Ends with 1 unless the report passes isRight. */
export async function report(chromium, name, find, isRight) {
    const server = createServer((request, answer) => {
        const [type, file] = find(new URL(request.url, "http://localhost").pathname) ?? [];
        answer.writeHead(type ? 200 : 404, {"content-type": type ?? "text/plain"});
        answer.end(type ? readFileSync(file) : "");
    });
    await new Promise(resolve => { server.listen(0, "127.0.0.1", resolve); });
    const page = await open(chromium, `http://127.0.0.1:${server.address().port}/${name}`);
    try {
        const text = await page.wait("document.body.dataset.test");
        console.log(text);
        process.exitCode = isRight(text) ? 0 : 1;
    } finally {
        await page.close();
        server.close();
    }
}
