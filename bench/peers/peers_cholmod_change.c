/* peers_cholmod_change.c: CHOLMOD's updates, downdates, and rows deleted and added */
#include "peers_cholmod.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct peer_change {
    cholmod_common *common;
    const sl_csc *A;
    cholmod_factor *L;
    sl_int *place; /* pivot of each row */
    int count;
    cholmod_sparse **updates; /* count, n x ranks */
    cholmod_sparse **rows;    /* count, n x 1 */
    sl_int *row_of;           /* count: pivots of the rows */
    cholmod_dense *b, *X, *Y, *E;
    cholmod_sparse *bset, *xset;
};

peer_change *peer_change_create(peer_cholmod *peer, const sl_csc *A, int count) {
    peer_change *c = calloc(1, sizeof *c);
    const size_t n = (size_t)A->n_rows;
    peer_must(c != NULL, "memory");
    c->common = &peer->simplicial.common;
    c->A = A;
    c->count = count;
    c->L = cholmod_copy_factor(peer->simplicial.L, c->common);
    c->place = malloc((n + 1) * sizeof *c->place);
    c->updates = calloc((size_t)count, sizeof *c->updates);
    c->rows = calloc((size_t)count, sizeof *c->rows);
    c->row_of = calloc((size_t)count, sizeof *c->row_of);
    c->b = cholmod_zeros(n, 1, CHOLMOD_REAL, c->common);
    c->bset = cholmod_allocate_sparse(n, 1, n, 0, 1, 0, CHOLMOD_PATTERN, c->common);
    peer_must(c->L && c->place && c->updates && c->rows && c->row_of && c->b && c->bset, "memory");
    const int *perm = c->L->Perm;
    for (size_t k = 0; k < n; k++) {
        c->place[perm[k]] = (sl_int)k;
    }
    return c;
}

void peer_change_free(peer_change *c) {
    for (int k = 0; k < c->count; k++) {
        cholmod_free_sparse(&c->updates[k], c->common);
        cholmod_free_sparse(&c->rows[k], c->common);
    }
    cholmod_free_factor(&c->L, c->common);
    cholmod_free_dense(&c->b, c->common);
    cholmod_free_dense(&c->X, c->common);
    cholmod_free_dense(&c->Y, c->common);
    cholmod_free_dense(&c->E, c->common);
    cholmod_free_sparse(&c->bset, c->common);
    cholmod_free_sparse(&c->xset, c->common);
    free(c->place);
    free(c->updates);
    free(c->rows);
    free(c->row_of);
    free(c);
}

void peer_change_prepare(peer_change *c, int k, const sl_int *rows, const sl_int *others, int ranks,
                         double w) {
    const size_t n = (size_t)c->A->n_rows, each = others ? 2 : 1;
    cholmod_sparse *C = cholmod_allocate_sparse(n, (size_t)ranks, each * (size_t)ranks, 1, 1, 0,
                                                CHOLMOD_REAL, c->common);
    peer_must(C != NULL, "memory");
    int *p = C->p, *i = C->i;
    double *x = C->x;
    for (int r = 0; r < ranks; r++) {
        const int a = c->place[rows[r]], at = r * (int)each;
        p[r] = at;
        p[r + 1] = at + (int)each;
        i[at] = a;
        x[at] = sqrt(w);
        if (others) {
            const int b = c->place[others[r]];
            i[at] = a < b ? a : b;
            i[at + 1] = a < b ? b : a;
            x[at + 1] = -sqrt(w);
        }
    }
    c->updates[k] = C;
}

void peer_change_update(peer_change *c, int k, int is_update) {
    peer_must(cholmod_updown(is_update, c->updates[k], c->L, c->common) &&
                  c->common->status == CHOLMOD_OK,
              "updown");
}

void peer_change_prepare_row(peer_change *c, int k, sl_int row) {
    const sl_csc *A = c->A;
    const size_t n = (size_t)A->n_rows;
    cholmod_triplet *list = cholmod_allocate_triplet(n, 1, n, 0, CHOLMOD_REAL, c->common);
    peer_must(list != NULL, "memory");
    int *i = list->i, *j = list->j;
    double *x = list->x;
    size_t count = 0;
    for (sl_int column = 0; column < A->n_cols; column++) {
        for (sl_int p = A->p[column]; p < A->p[column + 1]; p++) {
            if (A->i[p] == row || column == row) {
                i[count] = c->place[A->i[p] == row ? column : A->i[p]];
                j[count] = 0;
                x[count++] = A->x[p];
            }
        }
    }
    list->nnz = count;
    c->rows[k] = cholmod_triplet_to_sparse(list, 0, c->common);
    peer_must(c->rows[k] != NULL, "memory");
    cholmod_free_triplet(&list, c->common);
    c->row_of[k] = c->place[row];
}

void peer_change_delete_row(peer_change *c, int k) {
    peer_must(cholmod_rowdel((size_t)c->row_of[k], NULL, c->L, c->common) &&
                  c->common->status == CHOLMOD_OK,
              "rowdel");
}

void peer_change_add_row(peer_change *c, int k) {
    peer_must(cholmod_rowadd((size_t)c->row_of[k], c->rows[k], c->L, c->common) &&
                  c->common->status == CHOLMOD_OK,
              "rowadd");
}

double peer_change_local(peer_change *c, sl_int row) {
    int *p = c->bset->p, *i = c->bset->i;
    double *b = c->b->x;
    p[0] = 0;
    p[1] = 1;
    i[0] = row;
    b[row] = 1;
    peer_must(
        cholmod_solve2(CHOLMOD_A, c->L, c->b, c->bset, &c->X, &c->xset, &c->Y, &c->E, c->common),
        "solve with Bset");
    b[row] = 0;
    return ((const double *)c->X->x)[row];
}

const double *peer_change_solve(peer_change *c, const double *b) {
    memcpy(c->b->x, b, (size_t)c->A->n_rows * sizeof *b);
    peer_must(cholmod_solve2(CHOLMOD_A, c->L, c->b, NULL, &c->X, NULL, &c->Y, &c->E, c->common),
              "solve");
    memset(c->b->x, 0, (size_t)c->A->n_rows * sizeof *b);
    return c->X->x;
}
