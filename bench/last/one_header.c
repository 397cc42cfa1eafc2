/* one_header.c: the table of functions of the version that is found as sparse_local.h
 *
 * Compiled once for each version, with LAST_TABLE and LAST_NAME. Only calls and options are used
 * that all versions have in the same form.
 */
#define SPARSE_LOCAL_IMPLEMENTATION
#include "sparse_local.h"

#include "last.h"

#include <stdlib.h>
#include <string.h>

typedef struct state {
    last_matrix A;
    sl_options options; /* of the given order */
    sl_symbolic *S;
    sl_factor *F;
    sl_work *W;
} state;

static sl_csc csc(const last_matrix *A) {
    sl_csc view;
    memset(&view, 0, sizeof view);
    view.n_rows = view.n_cols = A->n;
    view.p = A->p;
    view.i = A->i;
    view.x = A->x;
    return view;
}

static sl_isa isa_of(last_isa isa) {
    return isa == LAST_ISA_SCALAR   ? SL_ISA_SCALAR
           : isa == LAST_ISA_AVX2   ? SL_ISA_AVX2
           : isa == LAST_ISA_AVX512 ? SL_ISA_AVX512
                                    : SL_ISA_AUTO;
}

static sl_options options_of(last_isa isa, last_purpose purpose) {
    sl_options options;
    memset(&options, 0, sizeof options);
    options.isa = isa_of(isa);
    options.purpose = purpose == LAST_ONE_FACTOR ? SL_PURPOSE_ONE_FACTOR : SL_PURPOSE_MANY_SOLVES;
    return options;
}

static int order_of(int *order, const last_matrix *A, last_purpose purpose) {
    const sl_csc view = csc(A);
    const sl_options options = options_of(LAST_ISA_AUTO, purpose);
    sl_symbolic *S;
    const sl_status status = sl_symbolic_create(&S, &view, &options, NULL);
    if (status == SL_OK) {
        memcpy(order, sl_symbolic_view(S).perm, (size_t)A->n * sizeof *order);
    }
    sl_symbolic_free(S);
    return (int)status;
}

static int open_state(void **out, const last_matrix *A, const int *order, last_isa isa) {
    state *s = (state *)calloc(1, sizeof *s);
    *out = s;
    if (!s) {
        return (int)SL_ERR_MEMORY;
    }
    const sl_csc view = csc(A);
    s->A = *A;
    s->options = options_of(isa, LAST_MANY_SOLVES);
    s->options.ordering = SL_ORDERING_GIVEN;
    s->options.perm = order;
    sl_status status = sl_symbolic_create(&s->S, &view, &s->options, NULL);
    if (status == SL_OK) {
        status = sl_factor_create(&s->F, s->S, &view, &s->options, NULL);
    }
    if (status == SL_OK) {
        status = sl_work_create(&s->W, NULL);
    }
    return (int)status;
}

static void close_state(void *given) {
    state *s = (state *)given;
    if (s) {
        sl_work_free(s->W);
        sl_factor_free(s->F);
        sl_symbolic_free(s->S);
        free(s);
    }
}

static long long entries(const void *given) {
    const sl_symbolic_arrays arrays = sl_symbolic_view(((const state *)given)->S);
    return (long long)arrays.panel_begin[arrays.n_supers];
}

static int plan_create(void **out, const void *given, const last_query *q) {
    sl_plan *plan;
    const sl_status status = sl_plan_create(&plan, ((const state *)given)->S, q->bset, q->nb,
                                            q->xset, q->nx, NULL, NULL);
    *out = plan;
    return (int)status;
}

static void plan_free(void *plan) {
    sl_plan_free((sl_plan *)plan);
}

static int plan_solve(const void *given, const void *plan, const last_query *q, double *X,
                      const double *B, int nrhs) {
    const state *s = (const state *)given;
    return (int)sl_plan_solve((const sl_plan *)plan, s->F, X, (size_t)q->nx, B, (size_t)q->nb, nrhs,
                              s->W);
}

static int one_shot(const void *given, const last_query *q, double *X, const double *B, int nrhs) {
    const state *s = (const state *)given;
    return (int)sl_local_solve(s->F, q->bset, q->nb, q->xset, q->nx, X, (size_t)q->nx, B,
                               (size_t)q->nb, nrhs, s->W, NULL);
}

static int full(const void *given, double *X, const double *B, int nrhs) {
    const state *s = (const state *)given;
    return (int)sl_factor_solve(s->F, X, (size_t)s->A.n, B, (size_t)s->A.n, nrhs, s->W);
}

static int refactor(void *given) {
    state *s = (state *)given;
    const sl_csc view = csc(&s->A);
    return (int)sl_factor_refactor(s->F, &view, NULL);
}

static int factor(const void *given) {
    const state *s = (const state *)given;
    const sl_csc view = csc(&s->A);
    sl_factor *F;
    const sl_status status = sl_factor_create(&F, s->S, &view, &s->options, NULL);
    sl_factor_free(F);
    return (int)status;
}

static int cold(const void *given, last_purpose purpose, double *X, const double *B) {
    const state *s = (const state *)given;
    const sl_csc view = csc(&s->A);
    sl_options options = options_of(LAST_ISA_AUTO, purpose);
    options.isa = s->options.isa;
    sl_symbolic *S;
    sl_factor *F = NULL;
    sl_status status = sl_symbolic_create(&S, &view, &options, NULL);
    if (status == SL_OK) {
        status = sl_factor_create(&F, S, &view, &options, NULL);
    }
    if (status == SL_OK) {
        status = sl_factor_solve(F, X, (size_t)s->A.n, B, (size_t)s->A.n, 1, s->W);
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
    return (int)status;
}

extern const last_header LAST_TABLE;
const last_header LAST_TABLE = {LAST_NAME, SL_VERSION,  order_of,  open_state, close_state,
                                entries,   plan_create, plan_free, plan_solve, one_shot,
                                full,      refactor,    factor,    cold};
