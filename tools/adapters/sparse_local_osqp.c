/* sparse_local_osqp.c: a direct linear-system solver for OSQP 1.0, in place of QDLDL
 *
 * OSQP's build takes it without a changed line:
 *
 *     cmake -S osqp -B build -DCMAKE_PROJECT_osqp_INCLUDE=.../sparse_local_osqp.cmake
 *
 * That file compiles this one into the library, and lets two of OSQP's files call it:
 * algebra_libs.c init_linsys_solver_sparse_local for init_linsys_solver_qdldl, osqp_api.c
 * codegen_src_sparse_local for codegen_src. This file has the bodies of sparse_local.h, of which no
 * name is exported.
 *
 *     K = [P + sigma I, A'; A, -diag(1/rho)]
 *
 * is analyzed once for each setup and once for each polish, and factored again for each new rho, P
 * or A without an allocation. Solves allocate nothing. Numbers are double, also where OSQP's are
 * float. QDLDL stays in the library, for generated code and for derivatives, which factor another
 * matrix. */
#include "osqp.h"

#include "lin_alg.h"
#include "printing.h"
#include "qdldl_interface.h"
#include "types.h"
#ifdef OSQP_CODEGEN
#include "codegen.h"
#endif

#ifndef SL_OSQP_LINKED /* defined: the bodies are linked */
#define SL_STATIC
#define SPARSE_LOCAL_IMPLEMENTATION
#endif
#include "sparse_local.h"

/* What OSQP's type LinSysSolver points to. */
typedef struct sl_osqp {
    LinSysSolver osqp; /* what OSQP calls */
    sl_int n, m;       /* variables, constraints */
    OSQPInt polishing;
    sl_csc K; /* the lower triangle; sigma is an entry of its own beside the diagonal of P */
    double *Kx;
    sl_int *P_at, *A_at;  /* where the entries of P and A are in Kx */
    OSQPFloat *rho_inv;   /* m */
    double *x;            /* n + m */
    void *values, *lists; /* the blocks of all these arrays */
    sl_symbolic *S;
    sl_factor *F;
    sl_work *W;
} sl_osqp;

#ifdef OSQP_CUSTOM_MEMORY
static void *sl_osqp_allocate(void *context, size_t bytes) {
    (void)context;
    return c_malloc(bytes);
}

static void sl_osqp_release(void *context, void *block) {
    (void)context;
    c_free(block);
}
#endif

static sl_options sl_osqp_options(void) {
    sl_options opt;
    sl_options_init(&opt, sizeof opt);
#ifdef OSQP_CUSTOM_MEMORY
    opt.allocator.allocate = sl_osqp_allocate;
    opt.allocator.release = sl_osqp_release;
#endif
    opt.triangle = SL_TRIANGLE_LOWER;
    opt.null_tolerance = -1.0; /* K is quasi-definite, and ADMM corrects what small pivots lose */
    opt.growth_limit = -1.0;
    return opt;
}

static const char *sl_osqp_name(LinSysSolver *self) {
    (void)self;
    return "sparse_local";
}

static void sl_osqp_update_settings(LinSysSolver *self, const OSQPSettings *settings) {
    (void)self;
    (void)settings;
}

static void sl_osqp_warm_start(LinSysSolver *self, const OSQPVectorf *x) {
    (void)self;
    (void)x;
}

static void sl_osqp_free(LinSysSolver *self) {
    sl_osqp *s = (sl_osqp *)self;
    sl_work_free(s->W);
    sl_factor_free(s->F);
    sl_symbolic_free(s->S);
    c_free(s->values);
    c_free(s->lists);
    c_free(s);
}

/* b is the right-hand side. After a polish it becomes K^-1 b; otherwise x~ and z~ = z - y / rho +
 * nu / rho, of which b has z - y / rho. */
static OSQPInt sl_osqp_solve(LinSysSolver *self, OSQPVectorf *b, OSQPInt iteration) {
    sl_osqp *s = (sl_osqp *)self;
    const size_t n = (size_t)s->n, size = n + (size_t)s->m;
    OSQPFloat *v = OSQPVectorf_data(b);
    size_t k;
    sl_status status;
    (void)iteration;
#ifdef OSQP_USE_FLOAT
    for (k = 0; k < size; k++) {
        s->x[k] = (double)v[k];
    }
    status = sl_factor_solve(s->F, s->x, size, s->x, size, 1, s->W);
#else
    status = sl_factor_solve(s->F, s->x, size, v, size, 1, s->W);
#endif
    if (status != SL_OK && status != SL_ERR_NOT_FINITE) {
        return 1;
    }
    for (k = 0; k < n; k++) {
        v[k] = (OSQPFloat)s->x[k];
    }
    for (; k < size; k++) {
        v[k] = s->polishing ? (OSQPFloat)s->x[k] : v[k] + s->rho_inv[k - n] * (OSQPFloat)s->x[k];
    }
    return 0;
}

/* What a step has come to, of which the last one is a factorization: K must have n positive pivots,
 * as P + sigma I + A' diag(rho) A is then positive definite. */
static OSQPInt sl_osqp_error(const sl_osqp *s, sl_status status, const sl_stats *stats) {
    char text[200];
    if (status == SL_OK && stats->factor.positive >= s->n) {
        return OSQP_NO_ERROR;
    }
    if (status == SL_OK || status == SL_ERR_PIVOT) {
        c_eprint("The KKT matrix has not %d positive pivots. The problem seems to be non-convex",
                 (int)s->n);
        return OSQP_NONCVX_ERROR;
    }
    (void)sl_error_text(text, sizeof text, status, stats);
    c_eprint("KKT matrix: %s", text);
    return status == SL_ERR_MEMORY ? OSQP_MEM_ALLOC_ERROR : OSQP_LINSYS_SOLVER_INIT_ERROR;
}

static OSQPInt sl_osqp_refactor(sl_osqp *s) {
    sl_stats stats;
    const sl_status status = sl_factor_refactor(s->F, &s->K, &stats);
    return sl_osqp_error(s, status, &stats) != OSQP_NO_ERROR;
}

/* New values of M at `count` indices, or of all its entries if index is NULL. */
static void sl_osqp_put(sl_osqp *s, const sl_int *at, const OSQPMatrix *M, const OSQPInt *index,
                        OSQPInt count) {
    const OSQPFloat *x = OSQPMatrix_get_x(M);
    OSQPInt k;
    for (k = 0; k < count; k++) {
        const OSQPInt p = index == OSQP_NULL ? k : index[k];
        s->Kx[at[p]] = (double)x[p];
    }
}

/* -1 / rho, the last m entries of K; without rho_vec all have the same. */
static void sl_osqp_put_rho(sl_osqp *s, const OSQPVectorf *rho_vec, OSQPFloat rho) {
    const OSQPFloat *each = rho_vec == OSQP_NULL ? OSQP_NULL : OSQPVectorf_data(rho_vec);
    double *diagonal = s->Kx + s->K.p[s->n];
    sl_int k;
    for (k = 0; k < s->m; k++) {
        s->rho_inv[k] = (OSQPFloat)1.0 / (each == OSQP_NULL ? rho : each[k]);
        diagonal[k] = -(double)s->rho_inv[k];
    }
}

static OSQPInt sl_osqp_update_matrices(LinSysSolver *self, const OSQPMatrix *P,
                                       const OSQPInt *P_index, OSQPInt P_count, const OSQPMatrix *A,
                                       const OSQPInt *A_index, OSQPInt A_count) {
    sl_osqp *s = (sl_osqp *)self;
    sl_osqp_put(s, s->P_at, P, P_index, P_count);
    sl_osqp_put(s, s->A_at, A, A_index, A_count);
    return sl_osqp_refactor(s);
}

static OSQPInt sl_osqp_update_rho_vec(LinSysSolver *self, const OSQPVectorf *rho_vec,
                                      OSQPFloat rho) {
    sl_osqp *s = (sl_osqp *)self;
    sl_osqp_put_rho(s, rho_vec, rho);
    return sl_osqp_refactor(s);
}

/* Takes the arrays from two blocks. Returns whether there was memory. */
static int sl_osqp_arrays(sl_osqp *s, size_t P_count, size_t A_count) {
    const size_t n = (size_t)s->n, m = (size_t)s->m, count = n + m + P_count + A_count;
    sl_int *next;
    s->values = c_malloc((count + n + m) * sizeof(double) + m * sizeof(OSQPFloat));
    s->lists = c_calloc(count + (n + m + 1) + P_count + A_count, sizeof(sl_int));
    if (s->values == OSQP_NULL || s->lists == OSQP_NULL) {
        return 0;
    }
    s->Kx = (double *)s->values;
    s->x = s->Kx + count;
    s->rho_inv = (OSQPFloat *)(void *)(s->x + n + m);
    next = (sl_int *)s->lists;
    s->K.n_rows = s->K.n_cols = (sl_int)(n + m);
    s->K.p = next;
    s->K.i = next += n + m + 1;
    s->K.x = s->Kx;
    s->P_at = next += count;
    s->A_at = next + P_count;
    return 1;
}

/* The pattern of K, and where the entries of P and A are in it. A column of the first n has sigma,
 * then the entries of its row of P, the upper triangle, then those of its column of A. */
static void sl_osqp_pattern(sl_osqp *s, const OSQPMatrix *P, const OSQPMatrix *A) {
    const OSQPInt *Pp = OSQPMatrix_get_p(P), *Pi = OSQPMatrix_get_i(P);
    const OSQPInt *Ap = OSQPMatrix_get_p(A), *Ai = OSQPMatrix_get_i(A);
    sl_int *Kp = (sl_int *)s->lists, *Ki = Kp + s->n + s->m + 1, j, at = 0;
    OSQPInt p;
    for (p = 0; p < Pp[s->n]; p++) {
        Kp[Pi[p]]++;
    }
    for (j = 0; j < s->n + s->m; j++) {
        const sl_int count = j < s->n ? 1 + Kp[j] + (sl_int)(Ap[j + 1] - Ap[j]) : 1;
        Kp[j] = at + 1; /* where the next entry comes, behind the diagonal */
        Ki[at] = j;
        at += count;
    }
    Kp[j] = at;
    for (j = 0; j < s->n; j++) { /* sorts the rows of P */
        for (p = Pp[j]; p < Pp[j + 1]; p++) {
            s->P_at[p] = Kp[Pi[p]];
            Ki[Kp[Pi[p]]++] = j;
        }
    }
    for (j = 0; j < s->n; j++) {
        for (p = Ap[j]; p < Ap[j + 1]; p++) {
            s->A_at[p] = Kp[j];
            Ki[Kp[j]++] = s->n + (sl_int)Ai[p];
        }
    }
    for (j = s->n + s->m; j > s->n;
         j--) { /* each is behind its column: that is where the next begins */
        Kp[j] = Kp[j - 1];
    }
    for (; j > 0; j--) {
        Kp[j] = Kp[j - 1];
    }
    Kp[0] = 0;
}

/* Analysis, factorization, and a first solve, after which solves allocate nothing. */
static OSQPInt sl_osqp_begin(sl_osqp *s) {
    const sl_options opt = sl_osqp_options();
    const size_t size = (size_t)s->n + (size_t)s->m;
    size_t k;
    sl_stats stats;
    sl_status status = sl_symbolic_create(&s->S, &s->K, &opt, &stats);
    status = status == SL_OK ? sl_factor_create(&s->F, s->S, &s->K, &opt, &stats) : status;
    for (k = 0; k < size; k++) {
        s->x[k] = 0.0;
    }
    if (status == SL_OK) {
        status = sl_work_create(&s->W, &opt);
    }
    if (status == SL_OK) {
        status = sl_factor_solve(s->F, s->x, size, s->x, size, 1, s->W);
    }
    return sl_osqp_error(s, status, &stats);
}

/* As init_linsys_solver_qdldl of OSQP. */
OSQPInt init_linsys_solver_sparse_local(qdldl_solver **sp, const OSQPMatrix *P, const OSQPMatrix *A,
                                        const OSQPVectorf *rho_vec, const OSQPSettings *settings,
                                        OSQPInt polishing) {
    const OSQPInt n = OSQPMatrix_get_n(P), m = OSQPMatrix_get_m(A);
    const OSQPInt P_count = OSQPMatrix_get_p(P)[n], A_count = OSQPMatrix_get_p(A)[n];
    sl_osqp *s;
    OSQPInt j, error = OSQP_MEM_ALLOC_ERROR;
    *sp = OSQP_NULL;
    if ((double)n + (double)m + (double)P_count + (double)A_count > 2147483640.0) {
        c_eprint("The KKT matrix has 2^31 or more entries");
        return OSQP_LINSYS_SOLVER_INIT_ERROR;
    }
    s = (sl_osqp *)c_calloc(1, sizeof *s);
    if (s == OSQP_NULL) {
        return OSQP_MEM_ALLOC_ERROR;
    }
    s->osqp.type = OSQP_DIRECT_SOLVER;
    s->osqp.name = sl_osqp_name;
    s->osqp.solve = sl_osqp_solve;
    s->osqp.update_settings = sl_osqp_update_settings;
    s->osqp.warm_start = sl_osqp_warm_start;
    s->osqp.free = sl_osqp_free;
    s->osqp.update_matrices = sl_osqp_update_matrices;
    s->osqp.update_rho_vec = sl_osqp_update_rho_vec;
    s->osqp.nthreads = 1;
    s->n = (sl_int)n;
    s->m = (sl_int)m;
    s->polishing = polishing;
    if (sl_osqp_arrays(s, (size_t)P_count, (size_t)A_count)) {
        sl_osqp_pattern(s, P, A);
        for (j = 0; j < n; j++) {
            s->Kx[s->K.p[j]] = (double)settings->sigma;
        }
        sl_osqp_put(s, s->P_at, P, OSQP_NULL, P_count);
        sl_osqp_put(s, s->A_at, A, OSQP_NULL, A_count);
        sl_osqp_put_rho(s, rho_vec, polishing ? (OSQPFloat)1.0 / settings->sigma : settings->rho);
        error = sl_osqp_begin(s);
    }
    if (error == OSQP_NO_ERROR) {
        *sp = (qdldl_solver *)(void *)s;
    } else {
        sl_osqp_free(&s->osqp);
    }
    return error;
}

#ifdef OSQP_CODEGEN
/* As codegen_src of OSQP. Generated code solves with QDLDL and contains its factor, which is made
 * for it. */
OSQPInt codegen_src_sparse_local(const char *folder, const char *prefix, OSQPSolver *solver,
                                 OSQPInt embedded) {
    OSQPWorkspace *work = solver->work;
    LinSysSolver *ours = work->linsys_solver;
    const OSQPData *data = work->data;
    qdldl_solver *theirs = OSQP_NULL;
    OSQPInt error = OSQP_NO_ERROR;
    if (data->P != OSQP_NULL && data->A != OSQP_NULL) { /* codegen_src refuses others */
        error =
            init_linsys_solver_qdldl(&theirs, data->P, data->A, work->rho_vec, solver->settings, 0);
    }
    if (error == OSQP_NO_ERROR) {
        work->linsys_solver = (LinSysSolver *)(void *)theirs;
        error = codegen_src(folder, prefix, solver, embedded);
        work->linsys_solver = ours;
        free_linsys_solver_qdldl(theirs);
    }
    return error;
}
#endif
