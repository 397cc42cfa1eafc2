/* sparse_local_web.c: the calls of the npm package: pointers and numbers in, a status out */

/* JavaScript has neither sl_csc nor sl_options. A matrix comes as its arrays, options are set
 * before the call that reads them, and what a call makes is fetched after it. There is one thread,
 * hence one workspace, one set of options and one of statistics. After an error web_text returns
 * the text of the library. */

#define SPARSE_LOCAL_IMPLEMENTATION
#define SL_STATIC
#define SL_WITH_CHANGE
#define SL_WITH_CONSTRAINTS
#include "sparse_local.h"

#include <stdlib.h>
#include <string.h>

#define WEB_EXPORT(name) __attribute__((export_name(#name)))

static sl_options options;
static sl_stats stats;
static sl_status failed;
static sl_work *work;
static void *made;
static char text[512];

/* The workspace of all solves. NULL: there is no memory, and solves try to allocate one. */
static sl_work *workspace(void) {
    if (work == NULL && sl_work_create(&work, NULL) != SL_OK) {
        work = NULL;
    }
    return work;
}

/* Keeps the status for web_text. Calls without statistics leave the row at -1. */
static sl_status keep(sl_status status) {
    failed = status;
    return status;
}

static void forget(void) {
    made = NULL;
    stats.error.row = stats.error.column = -1;
    stats.error.value = 0;
}

/* ---- memory, errors, options ---- */

WEB_EXPORT(web_version) int web_version(void) {
    return sl_version();
}

WEB_EXPORT(web_allocate) void *web_allocate(size_t bytes) {
    return malloc(bytes);
}

WEB_EXPORT(web_release) void web_release(void *block) {
    free(block);
}

/** What the last call has made; JavaScript owns it. */
WEB_EXPORT(web_made) void *web_made(void) {
    return made;
}

/** The sentence of the library on the last error; of a status of no call: its name. */
WEB_EXPORT(web_text) const char *web_text(sl_status status) {
    if (status == failed) {
        (void)sl_error_text(text, sizeof text, status, NULL);
        return text;
    }
    return sl_status_string(status);
}

WEB_EXPORT(web_error_row) sl_int web_error_row(void) {
    return stats.error.row;
}

WEB_EXPORT(web_error_column) sl_int web_error_column(void) {
    return stats.error.column;
}

WEB_EXPORT(web_error_value) double web_error_value(void) {
    return stats.error.value;
}

/** The options of the next analysis and factorization; perm and mass: n numbers or NULL. */
WEB_EXPORT(web_options)
void web_options(int triangle, int ordering, const sl_int *perm, sl_int block_size, int purpose,
                 int pivots, const double *mass) {
    memset(&options, 0, sizeof options);
    options.triangle = (sl_triangle)triangle;
    options.ordering = (sl_ordering)ordering;
    options.perm = perm;
    options.block_size = block_size;
    options.purpose = (sl_purpose)purpose;
    options.pivots = (sl_pivots)pivots;
    options.mass = mass;
}

/* ---- matrices ---- */

WEB_EXPORT(web_triplets)
sl_status web_triplets(sl_int n, sl_int count, const sl_int *i, const sl_int *j, const double *x) {
    sl_matrix *M = NULL;
    forget();
    const sl_status status = sl_matrix_from_triplets(&M, n, n, count, i, j, x, NULL, &stats);
    made = M;
    return keep(status);
}

/** Positions, rows and values of a matrix: which = 0, 1, 2. */
WEB_EXPORT(web_matrix_array) const void *web_matrix_array(const sl_matrix *M, int which) {
    const sl_csc A = sl_matrix_view(M);
    return which == 0 ? (const void *)A.p : which == 1 ? (const void *)A.i : (const void *)A.x;
}

WEB_EXPORT(web_matrix_free) void web_matrix_free(sl_matrix *M) {
    sl_matrix_free(M);
}

/* ---- analysis, factor ---- */

WEB_EXPORT(web_analyze)
sl_status web_analyze(sl_int n, const sl_int *p, const sl_int *i) {
    const sl_csc A = {n, n, p, i, NULL};
    sl_symbolic *S = NULL;
    forget();
    const sl_status status = sl_symbolic_create(&S, &A, &options, &stats);
    made = S;
    return keep(status);
}

WEB_EXPORT(web_perm) const sl_int *web_perm(const sl_symbolic *S) {
    return sl_symbolic_view(S).perm;
}

WEB_EXPORT(web_analysis_free) void web_analysis_free(sl_symbolic *S) {
    sl_symbolic_free(S);
}

WEB_EXPORT(web_factor)
sl_status web_factor(const sl_symbolic *S, sl_int n, const sl_int *p, const sl_int *i,
                     const double *x) {
    const sl_csc A = {n, n, p, i, x};
    sl_factor *F = NULL;
    forget();
    const sl_status status = sl_factor_create(&F, S, &A, &options, &stats);
    made = F;
    return keep(status);
}

WEB_EXPORT(web_refactor)
sl_status web_refactor(sl_factor *F, sl_int n, const sl_int *p, const sl_int *i, const double *x) {
    const sl_csc A = {n, n, p, i, x};
    forget();
    return keep(sl_factor_refactor(F, &A, &stats));
}

/** 9 numbers: entries of L without and with padding, supernodes, bytes of analysis and factor,
 *  pivots above and below 0, null ones, and the growth. */
WEB_EXPORT(web_factor_stats) const double *web_factor_stats(const sl_factor *F) {
    static double number[9];
    stats.symbolic = sl_symbolic_view(sl_factor_view(F).symbolic).info;
    stats.factor = sl_factor_view(F).info;
    number[0] = (double)stats.symbolic.nnz_l;
    number[1] = (double)stats.symbolic.nnz_panels;
    number[2] = stats.symbolic.supernodes;
    number[3] = (double)stats.symbolic.bytes;
    number[4] = (double)stats.factor.bytes;
    number[5] = stats.factor.positive;
    number[6] = stats.factor.negative;
    number[7] = stats.factor.null;
    number[8] = stats.factor.growth;
    return number;
}

WEB_EXPORT(web_factor_free) void web_factor_free(sl_factor *F) {
    sl_factor_free(F);
}

/* ---- solves: B and X are column-major, without gaps between columns ---- */

WEB_EXPORT(web_solve)
sl_status web_solve(const sl_factor *F, sl_int n, double *X, const double *B, sl_int nrhs) {
    forget();
    return keep(sl_factor_solve(F, X, (size_t)n, B, (size_t)n, nrhs, workspace()));
}

/** bset, xset: NULL means all rows. */
WEB_EXPORT(web_plan)
sl_status web_plan(const sl_factor *F, const sl_int *bset, sl_int nb, const sl_int *xset,
                   sl_int nx) {
    sl_plan *P = NULL;
    forget();
    const sl_status status =
        sl_plan_create(&P, sl_factor_view(F).symbolic, bset, nb, xset, nx, NULL, &stats);
    made = P;
    return keep(status);
}

WEB_EXPORT(web_plan_solve)
sl_status web_plan_solve(const sl_plan *P, const sl_factor *F, double *X, sl_int nx,
                         const double *B, sl_int nb, sl_int nrhs) {
    forget();
    return keep(sl_plan_solve(P, F, X, (size_t)nx, B, (size_t)nb, nrhs, workspace()));
}

WEB_EXPORT(web_plan_free) void web_plan_free(sl_plan *P) {
    sl_plan_free(P);
}

WEB_EXPORT(web_local_solve)
sl_status web_local_solve(const sl_factor *F, const sl_int *bset, sl_int nb, const sl_int *xset,
                          sl_int nx, double *X, sl_int ldx, const double *B, sl_int ldb,
                          sl_int nrhs) {
    forget();
    return keep(sl_local_solve(F, bset, nb, xset, nx, X, (size_t)ldx, B, (size_t)ldb, nrhs,
                               workspace(), &stats));
}

/* ---- changes ---- */

/** V: n x k in compressed columns; sigma: k weights, or NULL. */
WEB_EXPORT(web_rank_update)
sl_status web_rank_update(sl_factor *F, sl_int n, sl_int k, const sl_int *p, const sl_int *i,
                          const double *x, const double *sigma) {
    const sl_csc V = {n, k, p, i, x};
    forget();
    return keep(sl_factor_rank_update(F, &V, sigma, workspace(), &stats));
}

WEB_EXPORT(web_change_entries)
sl_status web_change_entries(sl_factor *F, const sl_int *rows, const sl_int *columns,
                             const double *deltas, sl_int count) {
    forget();
    return keep(
        sl_factor_change_entries(F, NULL, rows, columns, deltas, count, workspace(), &stats));
}

/* ---- pins ---- */

WEB_EXPORT(web_constraints) sl_status web_constraints(const sl_factor *F) {
    sl_constraints *P = NULL;
    forget();
    const sl_status status = sl_constraints_create(&P, F, NULL);
    made = P;
    return keep(status);
}

WEB_EXPORT(web_constraints_add)
sl_status web_constraints_add(sl_constraints *P, const sl_int *rows, sl_int count) {
    forget();
    return keep(sl_constraints_add(P, rows, NULL, count, &stats));
}

WEB_EXPORT(web_constraints_release)
sl_status web_constraints_release(sl_constraints *P, const sl_int *indices, sl_int count) {
    forget();
    return keep(sl_constraints_release(P, indices, count, &stats));
}

WEB_EXPORT(web_constraints_refactor) sl_status web_constraints_refactor(sl_constraints *P) {
    forget();
    return keep(sl_constraints_refactor(P, &stats));
}

WEB_EXPORT(web_constraints_solve)
sl_status web_constraints_solve(const sl_constraints *P, const sl_plan *plan, double *X, sl_int ldx,
                                const double *B, sl_int ldb, const double *G, sl_int ldg,
                                sl_int nrhs) {
    forget();
    return keep(sl_constraints_solve(P, plan, X, (size_t)ldx, B, (size_t)ldb, G, (size_t)ldg, nrhs,
                                     workspace()));
}

WEB_EXPORT(web_constraints_free) void web_constraints_free(sl_constraints *P) {
    sl_constraints_free(P);
}
