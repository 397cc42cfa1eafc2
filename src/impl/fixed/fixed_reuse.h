/* fixed_reuse.h: rows fixed at given values, by a factor of all rows: restriction or pins */
#ifndef SLI_FIXED_REUSE_H
#define SLI_FIXED_REUSE_H

#include "../change/choose.h"
#include "../change/constraints.h"
#include "../change/constraints_solve.h"
#include "../change/submatrix.h"
#include "../matrix/csc_products.h"
#include "fixed.h"

/* Seconds of the parts of new pins, measured on grids of 1e4 to 1e6 rows. */
#define SLI_CONSTRAINTS_ENTRY 0.12e-9   /* an entry of L in a forward sweep of one row, */
#define SLI_CONSTRAINTS_JOINT 0.26      /* the same for each row of a block, relative to that, */
#define SLI_CONSTRAINTS_BLOCK 1.05      /* and for a block that is not full */
#define SLI_CONSTRAINTS_PRODUCT 0.04e-9 /* a product of a sum with another pin */
#define SLI_CONSTRAINTS_NUMBER 1e-9     /* a number of the vectors of a new pin */
#define SLI_CONSTRAINTS_PIN 1e-6        /* a new pin */
#define SLI_CONSTRAINTS_DENSE 0.13e-9   /* a product in the factor of K */

/* Seconds of the ways to fix rows, measured on grids of 1e4 and 9e4 rows. */
#define SLI_FIXED_ANALYSIS 280e-9 /* an entry of A that is analyzed, ordering included */
#define SLI_FIXED_ROW 120e-9      /* a row of a restriction */
#define SLI_FIXED_COPY 1.2e-9     /* an entry of L that it copies */
#define SLI_FIXED_PROBE 2e-9      /* an entry of L, or of A, in a test solve with pins */
#define SLI_FIXED_PINS 3.0        /* of the seconds above: what pins took */
/* Pins may lose so many times epsilon, as a backward error. */
#define SLI_FIXED_LOST 1000.0

/* Was F computed from the values of A, and not changed since? */
static int sli_fixed_is_factor_of(const sl_factor *F, const sl_csc *A) {
    sl_factor as;
    if (sli_factor_fits(F, A) != SL_OK || F->E != NULL) {
        return 0;
    }
    as = *F;
    as.identity = sli_hash_words(F->S->identity, A->x, sli_nnz(A));
    sli_factor_identify_numbers(&as);
    return sli_hash_equals(as.identity, F->identity);
}

/* A choice under way. */
typedef struct sli_fixed_choice {
    const sl_factor *F;
    uint64_t *seeds, *scratch; /* n_fixed: the columns of the fixed rows */
    sl_int *uses;              /* n_supers: fixed rows in each subtree */
} sli_fixed_choice;

/* Estimates the ways, from counts. */
static void sli_fixed_count(const sli_fixed_choice *c, sl_fixed *D) {
    const sl_factor *F = c->F;
    const sl_symbolic *S = F->S;
    const double flop = sli_costs_of(F->kernels->isa)->flop, whole = sli_choose_refactor(F);
    const double share = (double)D->n_free / (S->n > 0 ? S->n : 1);
    const double entries = (double)S->scatter_begin[S->n_supers];
    const double fixed = D->n_fixed;
    double computed = 0.0, kept = 0.0;
    double pins =
        SLI_CONSTRAINTS_DENSE / 3.0 * (fixed * fixed * fixed) + SLI_CONSTRAINTS_PIN * fixed;
    sl_int kept_columns = 0, s, k;
    for (k = 0; k < D->n_fixed; k++) {
        c->seeds[k] = sli_keyed(S->iperm[D->fixed_rows[k]], 0);
    }
    sli_sort(c->seeds, D->n_fixed, c->scratch);
    SLI_ZERO(c->uses, S->n_supers);
    for (s = 0, k = 0; s < S->n_supers; s++) {
        const sl_int up = S->super_parent[s], width = S->steps[s].width;
        sl_int free_columns = width;
        double u;
        for (; k < D->n_fixed && sli_key(c->seeds[k]) < S->super_first[s + 1]; k++) {
            c->uses[s]++;
            free_columns--;
        }
        if (up != -1) {
            c->uses[up] += c->uses[s];
        }
        u = c->uses[s];
        if (u > 0.0) {
            pins += SLI_CONSTRAINTS_ENTRY *
                        fmin(u, SLI_CONSTRAINTS_JOINT * u + SLI_CONSTRAINTS_BLOCK) *
                        (double)sli_panel_size(width, S->steps[s].below) +
                    (SLI_CONSTRAINTS_NUMBER + SLI_CONSTRAINTS_PRODUCT / 2.0 * u) * width * u;
        }
        if (c->uses[s] == 0) {
            kept += SLI_FIXED_COPY * (double)(S->panel_begin[s + 1] - S->panel_begin[s]);
            kept_columns += width;
        } else if (free_columns > 0) {
            computed += (flop * sli_choose_front(S, s) + SLI_CHANGE_FRONT(flop)) * free_columns /
                        (double)width;
        }
    }
    D->info.seconds_submatrix = share * (whole + SLI_FIXED_ANALYSIS * entries);
    D->info.seconds_restriction =
        SLI_FIXED_ROW * D->n_free +
        (kept_columns < 0.4 * D->n_free ? share * whole : kept + computed); /* as restrictions do */
    pins =
        SLI_FIXED_PINS * pins + SLI_FIXED_PROBE * ((double)S->panel_begin[S->n_supers] + entries);
    D->info.seconds_pins = sli_constraints_check(F) == SL_OK && F->null.vectors == 1 ? pins : 0.0;
}

/* Does a solve with pins lose digits? Solves for a random b, and looks at the residual of the free
 * rows. */
static sl_status sli_fixed_probe(const sl_fixed *D, const sl_csc *A, const sl_constraints *P,
                                 int *is_good) {
    const size_t n = (size_t)D->n;
    uint64_t random = 1;
    sli_block b = {NULL, 0};
    double *x = NULL, *r = NULL, *sums = NULL, *zeros = NULL, size, error = 0.0;
    sl_status status = SL_OK;
    sl_int k;
    *is_good = 0;
    SLI_LAYOUT(&b, &D->allocator, status) {
        x = SLI_TAKE(&b, double, n);
        r = SLI_TAKE(&b, double, n);
        sums = SLI_TAKE(&b, double, n);
        zeros = SLI_TAKE(&b, double, D->n_fixed);
    }
    if (status != SL_OK) {
        return status;
    }
    for (k = 0; k < D->n; k++) {
        r[k] = sli_random(&random);
    }
    SLI_ZERO(zeros, D->n_fixed);
    status = sl_constraints_solve(P, NULL, x, n, r, n, zeros, (size_t)D->n_fixed, 1, NULL);
    if (status == SL_OK) {
        size = sli_csc_norm(A, D->triangle, sums) * sli_largest(x, D->n) + 1.0; /* of b */
        sli_add_product(A, D->triangle, -1.0, r, n, x, n, 1);
        for (k = 0; k < D->n_free; k++) {
            error = fmax(error, fabs(r[D->free_rows[k]]));
        }
        *is_good = error <= SLI_FIXED_LOST * P->F->rule.epsilon * size;
    }
    sli_free(&D->allocator, b.base);
    return status;
}

/* Fixes the rows by pins, if those hold every component of a singular A and lose no digits. On
 * error, or if they do not, there are none. */
static sl_status sli_fixed_pin(sl_fixed *D, const sl_factor *F, const sl_csc *A, sl_stats *stats) {
    const sl_options only_memory = sli_options_with(&D->allocator);
    sl_constraints *P = NULL;
    int is_good = 0;
    sl_status status = sl_constraints_create(&P, F, &only_memory);
    status = status == SL_OK ? sl_constraints_add(P, D->fixed_rows, D->n_fixed, stats) : status;
    if (status == SL_OK && P->n_used == F->null.count) {
        status = sli_fixed_probe(D, A, P, &is_good);
    }
    if (is_good) {
        D->pins = P;
        D->info.method = SL_FIXED_PINS;
    } else {
        sl_constraints_free(P);
    }
    return status;
}

/* Makes the factor of the free rows from F. On error there is none. */
static sl_status sli_fixed_restrict(sl_fixed *D, const sl_factor *F, const sl_csc *A,
                                    sl_stats *stats) {
    const sl_options only_memory = sli_options_with(&D->allocator);
    D->info.method = SL_FIXED_RESTRICTION;
    return sl_factor_submatrix(&D->S, &D->F, F, A, D->free_rows, D->n_free, &only_memory, stats);
}

/* Is there no memory? After all other errors another way is tried, which says what is wrong. */
SLI_INLINE int sli_fixed_is_over(sl_status status) {
    return status == SL_ERR_MEMORY || status == SL_ERR_TOO_LARGE;
}

SLI_COLD static sl_status sli_fixed_take(sl_fixed *D, const sl_factor *F, const sl_csc *A,
                                         sl_stats *stats) {
    sli_fixed_choice c;
    sli_block b = {NULL, 0};
    sl_status status = SL_OK;
    if (!sli_fixed_is_factor_of(F, A)) {
        return SL_OK;
    }
    SLI_CLEAR(c);
    c.F = F;
    SLI_LAYOUT(&b, &D->allocator, status) {
        c.seeds = SLI_TAKE(&b, uint64_t, D->n_fixed);
        c.scratch = SLI_TAKE(&b, uint64_t, D->n_fixed);
        c.uses = SLI_TAKE(&b, sl_int, F->S->n_supers);
    }
    if (status != SL_OK) {
        return status;
    }
    sli_fixed_count(&c, D);
    sli_free(&D->allocator, b.base);
    if (D->info.seconds_pins > 0.0 &&
        D->info.seconds_pins <= fmin(D->info.seconds_restriction, D->info.seconds_submatrix)) {
        status = sli_fixed_pin(D, F, A, stats);
    }
    if (!sli_fixed_is_over(status) && D->pins == NULL &&
        D->info.seconds_restriction <= D->info.seconds_submatrix) {
        status = sli_fixed_restrict(D, F, A, stats);
    }
    return sli_fixed_is_over(status) ? status : SL_OK;
}

/* Copies a block from layout `from` to layout `to`. */
static void sli_fixed_copy(double *to, sli_dense t, const double *from, sli_dense f, sl_int rows,
                           sl_int columns) {
    sl_int k, r;
    for (k = 0; k < rows; k++) {
        for (r = 0; r < columns; r++) {
            to[(size_t)k * t.row + (size_t)r * t.column] =
                from == NULL ? 0.0 : from[(size_t)k * f.row + (size_t)r * f.column];
        }
    }
}

/* Pins take columns only: others are copied, 8 at a time. */
static sl_status sli_fixed_solve_pins(const sl_fixed *D, const sli_rhs *rhs, const double *G,
                                      size_t ldg, sl_work *W) {
    const sl_constraints *P = (const sl_constraints *)D->pins;
    const size_t n = (size_t)D->n, m = (size_t)D->n_fixed;
    sli_block b = {NULL, 0};
    double *X = NULL, *held = NULL;
    sl_status status = SL_OK;
    sl_int r, count;
    if (rhs->B != NULL && ((rhs->ldx | rhs->ldb | ldg) & SL_ROW_MAJOR) == 0) {
        return sl_constraints_solve(P, NULL, rhs->X, rhs->ldx, rhs->B, rhs->ldb, G, ldg, rhs->nrhs,
                                    W);
    }
    SLI_LAYOUT(&b, &D->allocator, status) {
        X = SLI_TAKE(&b, double, 8 * (uint64_t)n);
        held = SLI_TAKE(&b, double, 8 * (uint64_t)m);
    }
    for (r = 0; r < rhs->nrhs && status == SL_OK; r += count) {
        const sli_dense x = sli_dense_by_columns(n), h = sli_dense_by_columns(m);
        const sli_dense g = sli_dense_of(ldg);
        sli_rhs part;
        count = sli_min(8, rhs->nrhs - r);
        part = sli_rhs_part(rhs, r, count);
        sli_fixed_copy(X, x, part.B, sli_dense_of(part.ldb), D->n, count);
        sli_fixed_copy(held, h, m == 0 ? NULL : G + (size_t)r * g.column, g, D->n_fixed, count);
        status = sl_constraints_solve(P, NULL, X, n, X, n, held, m, count, W);
        if (status == SL_OK) {
            sli_fixed_copy(part.X, sli_dense_of(part.ldx), X, x, D->n, count);
        }
    }
    sli_free(&D->allocator, b.base);
    return status;
}

static void sli_fixed_release(sl_fixed *D) {
    sl_constraints_free((sl_constraints *)D->pins);
}

static const sli_fixed_ways sli_fixed_reuse = {sli_fixed_take, sli_fixed_solve_pins,
                                               sli_fixed_release};

#endif
