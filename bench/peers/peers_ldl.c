/* peers_ldl.c: SuiteSparse's LDL in the order of AMD, on a matrix that is permuted once */
#include "peers_ldl.h"

#include <amd.h>
#include <ldl.h>
#include <stdlib.h>
#include <string.h>

#include "bench/lib/bench.h"

struct peer_ldl {
    const sl_csc *A;
    int n, nnz;
    int *perm, *iperm;
    int *p, *i, *from; /* the upper triangle of P A P', and where its entries are in A */
    int *begin, *parent, *count, *flag, *pattern; /* of L; scratch */
    int *rows;
    double *C, *L, *D, *y; /* values; y: n of scratch */
};

static void must(int held, const char *doing) {
    bench_must(held ? SL_OK : SL_ERR_PIVOT, doing);
}

void peer_amd_order(const sl_csc *A, sl_int *perm) {
    const int status = amd_order(A->n_cols, A->p, A->i, perm, NULL, NULL);
    must(status == AMD_OK || status == AMD_OK_BUT_JUMBLED, "AMD");
}

/* Fills the upper triangle of P A P' by columns. */
static void permute(peer_ldl *s) {
    const sl_csc *A = s->A;
    int *next = s->flag;
    memset(s->p, 0, ((size_t)s->n + 1) * sizeof *s->p);
    for (int pass = 0; pass < 2; pass++) {
        for (int j = 0; j < s->n; j++) {
            for (int q = A->p[j]; q < A->p[j + 1]; q++) {
                const int a = s->iperm[A->i[q]], b = s->iperm[j], column = a > b ? a : b;
                if (pass == 0) {
                    s->p[column + 1]++;
                } else {
                    s->from[next[column]] = q;
                    s->i[next[column]++] = a > b ? b : a;
                }
            }
        }
        for (int j = 0; j < s->n && pass == 0; j++) {
            next[j] = s->p[j];
            s->p[j + 1] += s->p[j];
        }
    }
}

peer_ldl *peer_ldl_create(const sl_csc *A) {
    peer_ldl *s = bench_alloc(1, sizeof *s);
    const size_t n = (size_t)A->n_cols, nnz = (size_t)A->p[n];
    int *ints = bench_alloc(7 * n + 2 + 2 * nnz, sizeof *ints);
    double *reals = bench_alloc(2 * n + nnz, sizeof *reals);
    memset(s, 0, sizeof *s);
    s->A = A;
    s->n = A->n_cols;
    s->nnz = A->p[n];
    s->perm = ints;
    s->iperm = s->perm + n;
    s->parent = s->iperm + n;
    s->count = s->parent + n;
    s->flag = s->count + n;
    s->p = s->flag + n;
    s->begin = s->p + n + 1;
    s->i = s->begin + n + 1;
    s->from = s->i + nnz;
    s->C = reals;
    s->D = reals + nnz;
    s->y = s->D + n;
    peer_amd_order(A, s->perm);
    for (int k = 0; k < s->n; k++) {
        s->iperm[s->perm[k]] = k;
    }
    permute(s);
    ldl_symbolic(s->n, s->p, s->i, s->begin, s->parent, s->count, s->flag, NULL, NULL);
    s->rows = bench_alloc((size_t)s->begin[n] + n, sizeof *s->rows);
    s->pattern = s->rows + s->begin[n];
    s->L = bench_alloc((size_t)s->begin[n], sizeof *s->L);
    return s;
}

void peer_ldl_free(peer_ldl *s) {
    if (s) {
        free(s->perm);
        free(s->C);
        free(s->rows);
        free(s->L);
        free(s);
    }
}

void peer_ldl_factor(peer_ldl *s) {
    for (int q = 0; q < s->nnz; q++) {
        s->C[q] = s->A->x[s->from[q]];
    }
    must(ldl_numeric(s->n, s->p, s->i, s->C, s->begin, s->parent, s->count, s->rows, s->L, s->D,
                     s->y, s->pattern, s->flag, NULL, NULL) == s->n,
         "LDL");
}

void peer_ldl_solve(peer_ldl *s, double *x, const double *b) {
    for (int k = 0; k < s->n; k++) {
        s->y[k] = b[s->perm[k]];
    }
    ldl_lsolve(s->n, s->y, s->begin, s->rows, s->L);
    ldl_dsolve(s->n, s->y, s->D);
    ldl_ltsolve(s->n, s->y, s->begin, s->rows, s->L);
    for (int k = 0; k < s->n; k++) {
        x[s->perm[k]] = s->y[k];
    }
}

double peer_ldl_nnz(const peer_ldl *s) {
    return (double)s->begin[s->n] + s->n;
}
