/* saved_inverses.h: regions and selected inverses read from a file, against made anew */
#ifndef BENCH_SAVED_INVERSES_H
#define BENCH_SAVED_INVERSES_H

#include "bench.h"

/** Saves the factor of a system with the region of a patch and with a selected inverse in a file of
 *  run->out_dir, checks that what is read has the same bits, and adds rows for both. */
void bench_saved_inverses(bench_run *run, bench_report *report, const bench_system *system);

#endif
