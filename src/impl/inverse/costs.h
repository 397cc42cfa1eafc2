/* costs.h: what steps cost, by which the packs choose between methods: measured, a row for each
 * instruction set */
#ifndef SLI_INVERSE_COSTS_H
#define SLI_INVERSE_COSTS_H

#include "../kernels/dispatch.h"

/* `make measure-costs` prints a row of the machine that it runs on, but for `change`, which was
 * fitted to changes on grids of 1e4 and 1e5 rows and 20^3. */
typedef struct sli_costs {
    /* A forward sweep of 1, 2, 4, 8 lanes over an entry of L, the compilation of the reach
     * included. The unit is that of one lane. */
    double lanes[4];
    /* A front of the inverse of h rows, in the same unit: for the front, for each of the h^2
     * entries that are moved, and for each flop of the factorization's front (the inverse needs
     * twice as many). */
    double inverse_front, inverse_entry, inverse_flop;
    /* Seconds of a flop in a front of a factorization. */
    double flop;
    /* An entry of L in a pass of rank-one changes of 1, 2, 4, 8 lanes. The unit is that of one,
     * where all pivots have one sign. */
    double change[4];
} sli_costs;

/* In the order of sli_isa_row. Lanes were measured on grids of 1e4 to 1e6 vertices (Zen 4), the
 * inverse on the same and on 25^3 (Zen 5), flops on grids of 1e4 and 1e5. NEON was not measured:
 * its row is that of AVX2, but for the flop. */
static const sli_costs sli_costs_table[SLI_ISAS] = {
    {{1.0, 1.3, 1.9, 3.3}, 2000.0, 4.0, 0.35, 0.08e-9, {1.0, 2.1, 3.2, 5.8}},  /* others */
    {{1.0, 1.2, 3.8, 8.6}, 2000.0, 4.0, 2.2, 0.155e-9, {1.0, 2.0, 4.0, 8.0}},  /* plain C */
    {{1.0, 1.3, 1.9, 3.3}, 2000.0, 4.0, 0.35, 0.024e-9, {1.0, 2.1, 3.2, 5.8}}, /* AVX2 */
    {{1.0, 1.2, 1.9, 2.1}, 2000.0, 4.0, 0.2, 0.014e-9, {1.0, 2.1, 2.9, 4.6}}}; /* AVX-512 */

SLI_INLINE const sli_costs *sli_costs_of(sl_isa isa) {
    return &sli_costs_table[sli_isa_row(isa)];
}

/* A forward sweep of two lanes over an entry of L, relative to one lane, as it was measured for
 * single pairs on grids of 900 to 5e5 rows; and the entries from which L comes from memory. */
#define SLI_PAIR_CACHED 1.7
#define SLI_PAIR_READ 1.25
#define SLI_PAIR_LARGE 5e5

/* Seconds of the parts of a change, fitted to grids of 1e4 and 1e5 rows: what does not depend on
 * the instruction set, and what takes as long as some flops in a front. */
#define SLI_CHANGE_ENTRY 0.27e-9 /* an entry of L in a pass of rank-one changes */
#define SLI_CHANGE_HIDDEN 15e-12 /* so much of each of its flops passes while L is read */
#define SLI_CHANGE_PIVOT(flop) (4e-9 + 100.0 * (flop))     /* a pivot that one vector changes */
#define SLI_CHANGE_FRONT(flop) (0.4e-6 + 20000.0 * (flop)) /* a front, beside its flops */
#define SLI_CHANGE_VISIT(flop) (0.4e-6 + 3000.0 * (flop))  /* a descendant that updates a front */
#define SLI_CHANGE_INPUT 2.5e-9                            /* an entry of A */

/* In entries of L in a pass of one vector: such a pass, another one, and for each vector the search
 * for the best passes; the gains of an entry where pivots have both signs; the copy of one
 * of so many entries; and, in the pass alone, a pass that is tried first. */
#define SLI_CHANGE_PATH 800.0
#define SLI_CHANGE_PASS 3000.0
#define SLI_CHANGE_SPLIT 500.0
#define SLI_CHANGE_GAINS 2.0
#define SLI_CHANGE_LOG(entries) ((entries) <= 65536 ? 0.7 : 1.5)
#define SLI_CHANGE_TRIAL 1.5

/* Seconds of a factorization that keeps subtrees: of a flop and of a front that are computed; to
 * copy a supernode and each entry of it. */
#define SLI_REUSE_FLOP 0.1e-9
#define SLI_REUSE_FRONT 400e-9
#define SLI_REUSE_SUPER 150e-9
#define SLI_REUSE_ENTRY 0.5e-9

#endif
