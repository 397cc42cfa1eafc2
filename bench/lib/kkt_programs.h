/* kkt_programs.h: KKT systems of quadratic programs: OSQP's seven classes, sparse QPs, MPC, PDEs */
#ifndef BENCH_KKT_PROGRAMS_H
#define BENCH_KKT_PROGRAMS_H

#include "bench.h"

/* K = [P + s I, A'; A, -1/r I], as operator splitting (OSQP) factors it once for each r and then
 * solves with it in every iteration; 1e3 r for equations. */
typedef enum kkt_kind {
    KKT_RANDOM,
    KKT_EQUALITY,
    KKT_PORTFOLIO,
    KKT_LASSO,
    KKT_SVM,
    KKT_HUBER,
    KKT_CONTROL,
    KKT_SPARSE,
    KKT_MPC,
    KKT_PDE,
    KKT_KINDS
} kkt_kind;

const char *kkt_name(kkt_kind kind);

/** The lower triangle of K; size: 0, the smaller one, or 1. */
sl_matrix *kkt_matrix(kkt_kind kind, int size);

#endif
