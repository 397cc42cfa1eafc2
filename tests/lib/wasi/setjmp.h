/* setjmp.h: empty, for WASI, which has none; tests/lib/cmocka/cmocka.h does without it */
