/* peers_cholmod.c: CHOLMOD in its best setting for a given permutation */
#include "peers.h"

#include <cblas.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <suitesparse/cholmod.h>

typedef struct side {
    cholmod_common common;
    cholmod_factor *L;
    cholmod_dense *X, *Y, *E; /* kept from solve to solve */
} side;

struct peer_cholmod {
    cholmod_sparse A;
    sl_int *perm;
    side super, simple;
    cholmod_factor *plan, *first; /* supernodal: analysed only; of the latest first factorization */
    cholmod_dense *b;             /* n x 1, read at Bset only */
    double peak;                  /* bytes of the supernodal analysis and factorization */
    cholmod_sparse *bset;         /* a column of n rows */
    cholmod_sparse *xset;
};

static void must(int good, const char *doing) {
    if (!good) {
        fprintf(stderr, "bench: CHOLMOD failed: %s\n", doing);
        exit(2);
    }
}

static cholmod_factor *analyse(peer_cholmod *peer, side *s) {
    cholmod_factor *L = cholmod_analyze_p(&peer->A, peer->perm, NULL, 0, &s->common);
    must(L != NULL, "analysis");
    return L;
}

static void factor(peer_cholmod *peer, side *s) {
    must(cholmod_factorize(&peer->A, s->L, &s->common) && s->common.status == CHOLMOD_OK,
         "factorization");
}

static void set_up(side *s, int supernodal) {
    cholmod_common *c = &s->common;
    cholmod_start(c);
    c->nmethods = 1;
    c->method[0].ordering = CHOLMOD_GIVEN;
    c->postorder = 1;
    c->print = 0;
    c->supernodal = supernodal ? CHOLMOD_SUPERNODAL : CHOLMOD_SIMPLICIAL;
    c->final_ll = supernodal;
    c->final_pack = 1;
    c->final_asis = supernodal;
}

/* The simplicial factor, made of the supernodal one and freed of its relaxation's zeros: what CHOLMOD's own simplicial
 * factorization gives, in a fraction of its time. */
static void make_simple(peer_cholmod *peer) {
    cholmod_common *c = &peer->simple.common;
    cholmod_factor *L = cholmod_copy_factor(peer->super.L, c);
    must(L != NULL, "memory");
    must(cholmod_change_factor(CHOLMOD_REAL, 0, 0, 1, 1, L, c) &&
             cholmod_resymbol(&peer->A, NULL, 0, 1, L, c),
         "from supernodal to simplicial");
    peer->simple.L = L;
    must(!L->is_super && !L->is_ll && L->xtype == CHOLMOD_REAL, "a simplicial LDL' was asked for");
    must((double)L->nzmax <= 1.001 * peer->super.common.lnz + 1, "a packed L was asked for");
}

peer_cholmod *peer_cholmod_create(const sl_csc *A, const sl_int *perm) {
    peer_cholmod *peer = calloc(1, sizeof *peer);
    must(peer != NULL, "memory");
    size_t n = (size_t)A->n_rows;
    openblas_set_num_threads(1);
    peer->A.nrow = peer->A.ncol = n;
    peer->A.nzmax = (size_t)A->p[n];
    /* CHOLMOD does not write to its input, but has no const there */
    memcpy(&peer->A.p, &A->p, sizeof A->p);
    memcpy(&peer->A.i, &A->i, sizeof A->i);
    memcpy(&peer->A.x, &A->x, sizeof A->x);
    peer->A.stype = -1;
    peer->A.itype = CHOLMOD_INT;
    peer->A.xtype = CHOLMOD_REAL;
    peer->A.dtype = CHOLMOD_DOUBLE;
    peer->A.sorted = 1;
    peer->A.packed = 1;
    peer->perm = malloc((n + 1) * sizeof *peer->perm);
    must(peer->perm != NULL, "memory");
    memcpy(peer->perm, perm, n * sizeof *perm);
    set_up(&peer->super, 1);
    set_up(&peer->simple, 0);
    peer->super.L = analyse(peer, &peer->super);
    const size_t before = peer->super.common.memory_inuse;
    peer->plan = cholmod_copy_factor(peer->super.L, &peer->super.common);
    must(peer->plan != NULL, "memory");
    const size_t plan = peer->super.common.memory_inuse - before;
    factor(peer, &peer->super);
    peer->peak = (double)(peer->super.common.memory_usage - plan);
    make_simple(peer);
    peer->b = cholmod_zeros(n, 1, CHOLMOD_REAL, &peer->simple.common);
    peer->bset = cholmod_allocate_sparse(n, 1, n, 0, 1, 0, CHOLMOD_PATTERN, &peer->simple.common);
    must(peer->b && peer->bset, "memory");
    if (n > 0) {
        /* the first call makes the inverse permutation and the workspaces */
        sl_int first = 0;
        double zero = 0;
        (void)peer_cholmod_local(peer, &first, 1, &zero);
    }
    return peer;
}

static void release(side *s) {
    cholmod_free_factor(&s->L, &s->common);
    cholmod_free_dense(&s->X, &s->common);
    cholmod_free_dense(&s->Y, &s->common);
    cholmod_free_dense(&s->E, &s->common);
    cholmod_finish(&s->common);
}

void peer_cholmod_free(peer_cholmod *peer) {
    cholmod_free_dense(&peer->b, &peer->simple.common);
    cholmod_free_sparse(&peer->bset, &peer->simple.common);
    cholmod_free_sparse(&peer->xset, &peer->simple.common);
    cholmod_free_factor(&peer->first, &peer->super.common);
    cholmod_free_factor(&peer->plan, &peer->super.common);
    release(&peer->simple);
    release(&peer->super);
    free(peer->perm);
    free(peer);
}

double peer_cholmod_peak(const peer_cholmod *peer) {
    return peer->peak;
}

void peer_cholmod_analyse(peer_cholmod *peer) {
    cholmod_factor *L = analyse(peer, &peer->super);
    cholmod_free_factor(&L, &peer->super.common);
}

void peer_cholmod_values(peer_cholmod *peer, const double *x) {
    memcpy(&peer->A.x, &x, sizeof x);
}

void peer_cholmod_factor(peer_cholmod *peer) {
    factor(peer, &peer->super);
}

void peer_cholmod_factor_simple(peer_cholmod *peer) {
    factor(peer, &peer->simple);
}

void peer_cholmod_first_ready(peer_cholmod *peer) {
    cholmod_free_factor(&peer->first, &peer->super.common);
    peer->first = cholmod_copy_factor(peer->plan, &peer->super.common);
    must(peer->first != NULL, "memory");
}

void peer_cholmod_first(peer_cholmod *peer) {
    must(cholmod_factorize(&peer->A, peer->first, &peer->super.common), "first factorization");
}

void peer_cholmod_threads(int count) {
    openblas_set_num_threads(count);
}

static const double *solve(peer_cholmod *peer, side *s, const double *B, sl_int nrhs) {
    cholmod_dense b;
    memset(&b, 0, sizeof b);
    b.nrow = b.d = peer->A.nrow;
    b.ncol = (size_t)nrhs;
    b.nzmax = b.nrow * b.ncol;
    memcpy(&b.x, &B, sizeof B);
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    must(cholmod_solve2(CHOLMOD_A, s->L, &b, NULL, &s->X, NULL, &s->Y, &s->E, &s->common), "solve");
    return s->X->x;
}

const double *peer_cholmod_solve(peer_cholmod *peer, const double *B, sl_int nrhs) {
    return solve(peer, &peer->super, B, nrhs);
}

const double *peer_cholmod_solve_simple(peer_cholmod *peer, const double *B, sl_int nrhs) {
    return solve(peer, &peer->simple, B, nrhs);
}

const double *peer_cholmod_local(peer_cholmod *peer, const sl_int *bset, sl_int nb,
                                 const double *b) {
    side *s = &peer->simple;
    int *p = peer->bset->p, *i = peer->bset->i;
    double *values = peer->b->x;
    p[0] = 0;
    p[1] = nb;
    for (sl_int k = 0; k < nb; k++) {
        i[k] = bset[k];
        values[bset[k]] = b[k];
    }
    must(cholmod_solve2(CHOLMOD_A, s->L, peer->b, peer->bset, &s->X, &peer->xset, &s->Y, &s->E,
                        &s->common),
         "solve with Bset");
    return s->X->x;
}

double peer_cholmod_nnz(const peer_cholmod *peer) {
    return peer->super.common.lnz;
}

const char *peer_cholmod_kernels(void) {
    return openblas_get_corename();
}
