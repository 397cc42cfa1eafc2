/* node.js: the package in node, whose fetch reads no files */
import {readFile} from "node:fs/promises";
import {pathToFileURL} from "node:url";
import {load as loadFetched} from "./sparse_local.js";

export * from "./sparse_local.js";

/** As load of sparse_local.js; files are read from the disk, and text is a URL beside the working folder. */
export async function load(source = new URL("./sparse_local.wasm", import.meta.url)) {
    const url = typeof source === "string" ? new URL(source, pathToFileURL(`${process.cwd()}/`)) : source;
    return loadFetched(url instanceof URL && url.protocol === "file:" ? await readFile(url) : url);
}

export default load;
