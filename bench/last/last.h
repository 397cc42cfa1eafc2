/* last.h: one version of the header behind a table of functions, and matrices without its types */
#ifndef BENCH_LAST_H
#define BENCH_LAST_H

#include <stddef.h>

/* An sl_csc: the lower triangle of a symmetric matrix. */
typedef struct last_matrix {
    int n;
    const int *p, *i;
    const double *x;
} last_matrix;

/* The rows where b is known and those where x is wanted. */
typedef struct last_query {
    const int *bset, *xset;
    int nb, nx;
} last_query;

typedef enum last_isa { LAST_ISA_AUTO, LAST_ISA_SCALAR, LAST_ISA_AVX2, LAST_ISA_AVX512 } last_isa;

/* Which order an analysis finds. */
typedef enum last_purpose { LAST_MANY_SOLVES, LAST_ONE_FACTOR } last_purpose;

/** What is done with one version. Each function returns 0, or the version's sl_status. X and B are
 *  column-major, as many rows as the query or the matrix has.
 */
typedef struct last_header {
    const char *name; /* the commit, or "this" */
    int version;      /* SL_VERSION */

    /* Writes the version's own order of A, n rows. */
    int (*order)(int *order, const last_matrix *A, last_purpose purpose);

    /* Analyzes and factors A, which must outlive the state, in the given order. entries: doubles
     * that are stored for L. *out is freed with close, after an error, too. */
    int (*open)(void **out, const last_matrix *A, const int *order, last_isa isa);
    void (*close)(void *state);
    long long (*entries)(const void *state);

    int (*plan_create)(void **out, const void *state, const last_query *q);
    void (*plan_free)(void *plan);
    int (*plan_solve)(const void *state, const void *plan, const last_query *q, double *X,
                      const double *B, int nrhs);
    int (*one_shot)(const void *state, const last_query *q, double *X, const double *B, int nrhs);
    int (*full)(const void *state, double *X, const double *B, int nrhs);

    int (*refactor)(void *state);
    int (*factor)(const void *state); /* makes a factor and releases it */
    /* From the matrix to a first solution in the version's own order. */
    int (*cold)(const void *state, last_purpose purpose, double *X, const double *B);
} last_header;

#endif
