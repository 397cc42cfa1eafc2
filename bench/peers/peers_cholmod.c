/* peers_cholmod.c: CHOLMOD in a given permutation and with orderings of its own */
#include "peers_cholmod.h"

#include <cblas.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void peer_must(int passed, const char *doing) {
    if (!passed) {
        fprintf(stderr, "bench: CHOLMOD failed: %s\n", doing);
        exit(2);
    }
}

/* The caller's lower triangle, not copied. CHOLMOD does not write to its input but has no const. */
static cholmod_sparse wrap(const sl_csc *A) {
    cholmod_sparse C;
    memset(&C, 0, sizeof C);
    C.nrow = C.ncol = (size_t)A->n_rows;
    C.nzmax = (size_t)A->p[A->n_cols];
    memcpy(&C.p, &A->p, sizeof A->p);
    memcpy(&C.i, &A->i, sizeof A->i);
    memcpy(&C.x, &A->x, sizeof A->x);
    C.stype = -1;
    C.itype = CHOLMOD_INT;
    C.xtype = CHOLMOD_REAL;
    C.dtype = CHOLMOD_DOUBLE;
    C.sorted = 1;
    C.packed = 1;
    return C;
}

static cholmod_factor *analyze(peer_cholmod *peer, cholmod_solver *s) {
    cholmod_factor *L = cholmod_analyze_p(&peer->A, peer->perm, NULL, 0, &s->common);
    peer_must(L != NULL, "analysis");
    return L;
}

static void factor(peer_cholmod *peer, cholmod_solver *s) {
    peer_must(cholmod_factorize(&peer->A, s->L, &s->common) && s->common.status == CHOLMOD_OK,
              "factorization");
}

static void set_up(cholmod_solver *s, int supernodal) {
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

/* Converts the supernodal factor to a simplicial one without the zeros of relaxed amalgamation.
 * The result is that of CHOLMOD's own simplicial factorization, in a fraction of its time. */
static void make_simplicial(peer_cholmod *peer) {
    cholmod_common *c = &peer->simplicial.common;
    cholmod_factor *L = cholmod_copy_factor(peer->supernodal.L, c);
    peer_must(L != NULL, "memory");
    peer_must(cholmod_change_factor(L->xtype, 0, 0, 1, 1, L, c) &&
                  cholmod_resymbol(&peer->A, NULL, 0, 1, L, c),
              "from supernodal to simplicial");
    peer->simplicial.L = L;
    peer_must(!L->is_super && !L->is_ll && L->xtype == peer->A.xtype,
              "a simplicial LDL' is needed");
    peer_must((double)L->nzmax <= 1.001 * peer->supernodal.common.lnz + 1, "a packed L is needed");
}

static peer_cholmod *create(const cholmod_sparse *A, const sl_int *perm) {
    peer_cholmod *peer = calloc(1, sizeof *peer);
    peer_must(peer != NULL, "memory");
    size_t n = A->nrow;
    openblas_set_num_threads(1);
    peer->A = *A;
    peer->perm = malloc((n + 1) * sizeof *peer->perm);
    peer_must(peer->perm != NULL, "memory");
    memcpy(peer->perm, perm, n * sizeof *perm);
    set_up(&peer->supernodal, 1);
    set_up(&peer->simplicial, 0);
    peer->supernodal.L = analyze(peer, &peer->supernodal);
    const size_t before = peer->supernodal.common.memory_inuse;
    peer->analysis = cholmod_copy_factor(peer->supernodal.L, &peer->supernodal.common);
    peer_must(peer->analysis != NULL, "memory");
    const size_t analysis = peer->supernodal.common.memory_inuse - before;
    factor(peer, &peer->supernodal);
    peer->peak = (double)(peer->supernodal.common.memory_usage - analysis);
    make_simplicial(peer);
    peer->b = cholmod_zeros(n, 1, A->xtype, &peer->simplicial.common);
    peer->bset =
        cholmod_allocate_sparse(n, 1, n, 0, 1, 0, CHOLMOD_PATTERN, &peer->simplicial.common);
    peer_must(peer->b && peer->bset, "memory");
    if (n > 0) {
        /* the first call allocates the inverse permutation and the workspaces */
        sl_int first = 0;
        double zero = 0;
        (void)peer_cholmod_local(peer, &first, 1, &zero);
    }
    return peer;
}

peer_cholmod *peer_cholmod_create(const sl_csc *A, const sl_int *perm) {
    const cholmod_sparse wrapped = wrap(A);
    return create(&wrapped, perm);
}

peer_cholmod *peer_cholmod_create_complex(const sl_hermitian *H, const sl_int *perm) {
    const sl_csc pattern = {H->n, H->n, H->p, H->i, H->x};
    cholmod_sparse wrapped = wrap(&pattern);
    wrapped.xtype = CHOLMOD_COMPLEX;
    return create(&wrapped, perm);
}

static void release(cholmod_solver *s) {
    cholmod_free_factor(&s->L, &s->common);
    cholmod_free_dense(&s->X, &s->common);
    cholmod_free_dense(&s->Y, &s->common);
    cholmod_free_dense(&s->E, &s->common);
    cholmod_finish(&s->common);
}

void peer_cholmod_free(peer_cholmod *peer) {
    cholmod_free_dense(&peer->b, &peer->simplicial.common);
    cholmod_free_sparse(&peer->bset, &peer->simplicial.common);
    cholmod_free_sparse(&peer->xset, &peer->simplicial.common);
    cholmod_free_factor(&peer->first, &peer->supernodal.common);
    cholmod_free_factor(&peer->analysis, &peer->supernodal.common);
    release(&peer->simplicial);
    release(&peer->supernodal);
    free(peer->perm);
    free(peer);
}

double peer_cholmod_peak(const peer_cholmod *peer) {
    return peer->peak;
}

void peer_cholmod_analyze(peer_cholmod *peer) {
    cholmod_factor *L = analyze(peer, &peer->supernodal);
    cholmod_free_factor(&L, &peer->supernodal.common);
}

void peer_cholmod_values(peer_cholmod *peer, const double *x) {
    memcpy(&peer->A.x, &x, sizeof x);
}

void peer_cholmod_factor(peer_cholmod *peer) {
    factor(peer, &peer->supernodal);
}

void peer_cholmod_factor_simplicial(peer_cholmod *peer) {
    factor(peer, &peer->simplicial);
}

void peer_cholmod_first_ready(peer_cholmod *peer) {
    cholmod_free_factor(&peer->first, &peer->supernodal.common);
    peer->first = cholmod_copy_factor(peer->analysis, &peer->supernodal.common);
    peer_must(peer->first != NULL, "memory");
}

void peer_cholmod_first(peer_cholmod *peer) {
    peer_must(cholmod_factorize(&peer->A, peer->first, &peer->supernodal.common),
              "first factorization");
}

void peer_cholmod_threads(int count) {
    openblas_set_num_threads(count);
}

static const double *solve(cholmod_solver *s, const double *B, sl_int nrhs) {
    cholmod_dense b;
    memset(&b, 0, sizeof b);
    b.nrow = b.d = s->L->n;
    b.ncol = (size_t)nrhs;
    b.nzmax = b.nrow * b.ncol;
    memcpy(&b.x, &B, sizeof B);
    b.xtype = s->L->xtype;
    b.dtype = CHOLMOD_DOUBLE;
    peer_must(cholmod_solve2(CHOLMOD_A, s->L, &b, NULL, &s->X, NULL, &s->Y, &s->E, &s->common),
              "solve");
    return s->X->x;
}

const double *peer_cholmod_solve(peer_cholmod *peer, const double *B, sl_int nrhs) {
    return solve(&peer->supernodal, B, nrhs);
}

const double *peer_cholmod_solve_simplicial(peer_cholmod *peer, const double *B, sl_int nrhs) {
    return solve(&peer->simplicial, B, nrhs);
}

const double *peer_cholmod_local(peer_cholmod *peer, const sl_int *bset, sl_int nb,
                                 const double *b) {
    cholmod_solver *s = &peer->simplicial;
    int *p = peer->bset->p, *i = peer->bset->i;
    double *values = peer->b->x;
    p[0] = 0;
    p[1] = nb;
    for (sl_int k = 0; k < nb; k++) {
        i[k] = bset[k];
        values[bset[k]] = b[k];
    }
    peer_must(cholmod_solve2(CHOLMOD_A, s->L, peer->b, peer->bset, &s->X, &peer->xset, &s->Y, &s->E,
                             &s->common),
              "solve with Bset");
    return s->X->x;
}

double peer_cholmod_nnz(const peer_cholmod *peer) {
    return peer->supernodal.common.lnz;
}

const char *peer_cholmod_kernels(void) {
    return openblas_get_corename();
}

/* ---- CHOLMOD with an ordering of its own ---- */

struct peer_cholmod_own {
    cholmod_sparse A;
    cholmod_solver solver;
};

peer_cholmod_own *peer_cholmod_own_create(const sl_csc *A, peer_cholmod_ordering ordering) {
    peer_cholmod_own *peer = calloc(1, sizeof *peer);
    peer_must(peer != NULL, "memory");
    cholmod_solver *s = &peer->solver;
    openblas_set_num_threads(1);
    peer->A = wrap(A);
    cholmod_start(&s->common);
    if (ordering == PEER_CHOLMOD_METIS) {
        s->common.nmethods = 1;
        s->common.method[0].ordering = CHOLMOD_METIS;
    }
    s->L = cholmod_analyze(&peer->A, &s->common);
    peer_must(s->L != NULL, "analysis with its own ordering");
    peer_cholmod_own_factor(peer);
    return peer;
}

void peer_cholmod_own_free(peer_cholmod_own *peer) {
    if (peer) {
        release(&peer->solver);
        free(peer);
    }
}

void peer_cholmod_own_factor(peer_cholmod_own *peer) {
    cholmod_solver *s = &peer->solver;
    peer_must(cholmod_factorize(&peer->A, s->L, &s->common) && s->common.status == CHOLMOD_OK,
              "factorization with its own ordering");
}

const double *peer_cholmod_own_solve(peer_cholmod_own *peer, const double *B, sl_int nrhs) {
    return solve(&peer->solver, B, nrhs);
}

double peer_cholmod_own_nnz(const peer_cholmod_own *peer) {
    return peer->solver.common.lnz;
}

double peer_cholmod_own_flops(const peer_cholmod_own *peer) {
    return peer->solver.common.fl;
}

int peer_cholmod_own_is_supernodal(const peer_cholmod_own *peer) {
    return peer->solver.L->is_super;
}

const char *peer_cholmod_own_ordering(const peer_cholmod_own *peer) {
    const int ordering = peer->solver.L->ordering;
    return ordering == CHOLMOD_METIS    ? "METIS"
           : ordering == CHOLMOD_AMD    ? "AMD"
           : ordering == CHOLMOD_NESDIS ? "NESDIS"
                                        : "another ordering";
}
