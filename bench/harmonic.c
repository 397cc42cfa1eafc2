/* harmonic.c: what do denser patterns of one mesh cost: harmonic, biharmonic and triharmonic systems? */
#include "bench.h"
void bench_harmonic(bench_run *run) { (void)run; }
