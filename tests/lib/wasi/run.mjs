/* run.mjs: runs a test program for WASI under node, each test in a process of its own */
//
//     node tests/lib/wasi/run.mjs PROGRAM [TEST]
//
// The program, linked with tests/lib/cmocka/cmocka.h, runs the test with the number in SL_ONE_TEST;
// for -1 its exit status is the number of its tests. Without TEST, all tests run one after the
// other. Node 20 can crash in its own code, whichever of its compilers made the program, where its
// collector runs beside it (hence --single-threaded-gc in the Makefile), and after several
// instances in one process.

import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { WASI } from 'node:wasi';

/* Where the tests' files go (tests/lib/run.sh), by the name that the program is told. */
const temporary = process.env.TMPDIR ? { [process.env.TMPDIR]: process.env.TMPDIR } : {};

/* The exit status of an instance; 1 if it trapped. */
async function run(program, test) {
    const wasi = new WASI({
        version: 'preview1',
        args: [program],
        env: { ...process.env, SL_ONE_TEST: String(test) },
        preopens: { '/': process.cwd(), ...temporary },
        returnOnExit: true,
    });
    const imports = { wasi_snapshot_preview1: wasi.wasiImport };
    const code = await WebAssembly.compile(readFileSync(program));
    const instance = await WebAssembly.instantiate(code, imports);
    try {
        return wasi.start(instance);
    } catch (error) {
        console.log(`${error}\n[  FAILED  ] 1 test(s).`);
        return 1;
    }
}

const [program, only] = process.argv.slice(2);
if (only !== undefined) {
    process.exit(await run(program, only));
}
const tests = await run(program, -1);
let failed = tests <= 0;
for (let test = 0; test < tests; test++) {
    const words = [...process.execArgv, process.argv[1], program, String(test)];
    failed = spawnSync(process.execPath, words, { stdio: 'inherit' }).status !== 0 || failed;
}
process.exit(failed ? 1 : 0);
