/* run.mjs: runs a test program for WASI under node, each test in an instance of its own */
//
//     node tests/lib/wasi/run.mjs PROGRAM
//
// The program, linked with tests/lib/cmocka/cmocka.h, runs the test with the number in SL_ONE_TEST;
// for -1 its exit status is the number of its tests.

import { readFileSync } from 'node:fs';
import { WASI } from 'node:wasi';

const program = await WebAssembly.compile(readFileSync(process.argv[2]));

/* The exit status of a new instance; -1 if it trapped. */
async function run(test) {
    const wasi = new WASI({
        version: 'preview1',
        args: [process.argv[2]],
        env: { ...process.env, SL_ONE_TEST: String(test) },
        preopens: { '/': process.cwd() },
        returnOnExit: true,
    });
    const imports = { wasi_snapshot_preview1: wasi.wasiImport };
    const instance = await WebAssembly.instantiate(program, imports);
    try {
        return wasi.start(instance);
    } catch (error) {
        console.log(`${error}\n[  FAILED  ] 1 test(s).`);
        return -1;
    }
}

const tests = await run(-1);
let failed = tests <= 0;
for (let test = 0; test < tests; test++) {
    failed = (await run(test)) !== 0 || failed;
}
process.exit(failed ? 1 : 0);
