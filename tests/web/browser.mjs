/* browser.mjs: a page in headless Chromium, driven over a pipe: expressions, the mouse, no network */
import {spawn} from "node:child_process";
import {mkdtempSync, rmSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";

/** Opens a page. Returns what can be done with it; `close` ends the browser. */
export async function open(program, url, flags = []) {
    const profile = mkdtempSync(join(process.env.SL_TMP ?? tmpdir(), "chromium."));
    const browser = spawn(program, ["--headless", "--no-sandbox", "--disable-gpu-sandbox", "--remote-debugging-pipe",
        "--window-size=800,600", `--user-data-dir=${profile}`, ...flags, "about:blank"],
        {stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"]});
    const waiting = new Map(), exceptions = [];
    let text = "", count = 0, session;
    browser.stdio[4].on("data", bytes => {
        const messages = (text + bytes).split("\0");
        text = messages.pop();
        for (const message of messages.map(m => JSON.parse(m))) {
            if (message.method === "Runtime.exceptionThrown") {
                const {exception, text: what} = message.params.exceptionDetails;
                exceptions.push(exception?.description ?? what);
            }
            const call = waiting.get(message.id);
            waiting.delete(message.id);
            if (message.error) call?.reject(new Error(message.error.message));
            else call?.resolve(message.result);
        }
    });
    browser.on("exit", () => { for (const call of waiting.values()) call.reject(new Error("the browser has ended")); });
    const send = (method, params = {}) => new Promise((resolve, reject) => {
        waiting.set(++count, {resolve, reject});
        browser.stdio[3].write(`${JSON.stringify({id: count, method, params, sessionId: session})}\0`);
    });
    const {targetId} = await send("Target.createTarget", {url: "about:blank"});
    ({sessionId: session} = await send("Target.attachToTarget", {targetId, flatten: true}));
    await send("Runtime.enable");
    await send("Page.enable");
    await send("Page.navigate", {url});

    const value = async expression => {
        const {result, exceptionDetails} =
            await send("Runtime.evaluate", {expression, awaitPromise: true, returnByValue: true});
        if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
        return result.value;
    };
    return {
        value,
        exceptions,
        /** The value of an expression once it is not empty. */
        async wait(expression, seconds = 60) {
            for (const end = Date.now() + 1000 * seconds; Date.now() < end;) {
                const found = await value(`document.body && (${expression})`);
                if (found) return found;
                if (exceptions.length > 0) throw new Error(exceptions.join("\n"));
                await new Promise(resolve => { setTimeout(resolve, 50); });
            }
            throw new Error(`${expression} is empty after ${seconds} s`);
        },
        /** type: mousePressed, mouseMoved, mouseReleased. */
        mouse: (type, x, y) => send("Input.dispatchMouseEvent",
            {type, x, y, button: "left", buttons: type === "mouseReleased" ? 0 : 1, clickCount: 1}),
        async close() {
            await send("Browser.close").catch(() => {});
            await new Promise(resolve => { browser.exitCode === null ? browser.on("exit", resolve) : resolve(); });
            rmSync(profile, {recursive: true, force: true, maxRetries: 5});
        }
    };
}
