/* osqp_interface.h: what sparse_local_osqp.c includes of OSQP 1.0, as far as it uses it
 *
 * Stands for osqp.h, lin_alg.h, types.h, printing.h, qdldl_interface.h and codegen.h. With
 * `make test-osqp` the same file is compiled with OSQP's own. */
#ifndef SL_TESTS_ADAPTERS_OSQP_INTERFACE_H
#define SL_TESTS_ADAPTERS_OSQP_INTERFACE_H

#include <stddef.h>
#include <stdio.h>

#ifdef OSQP_USE_LONG
typedef long long OSQPInt;
#else
typedef int OSQPInt;
#endif
#ifdef OSQP_USE_FLOAT
typedef float OSQPFloat;
#else
typedef double OSQPFloat;
#endif

#define OSQP_NULL 0
enum { OSQP_DIRECT_SOLVER = 1 };
enum {
    OSQP_NO_ERROR = 0,
    OSQP_LINSYS_SOLVER_INIT_ERROR = 3,
    OSQP_NONCVX_ERROR = 4,
    OSQP_MEM_ALLOC_ERROR = 5
};

/* The test counts allocations, and lets them fail. */
#define OSQP_CUSTOM_MEMORY
void *c_malloc(size_t bytes);
void *c_calloc(size_t count, size_t bytes);
void c_free(void *block);

/* Messages go to the test. */
#define c_eprint(...) (void)snprintf(printed, sizeof printed, __VA_ARGS__)
extern char printed[300];

typedef struct OSQPVectorf OSQPVectorf;
typedef struct OSQPMatrix OSQPMatrix;
OSQPFloat *OSQPVectorf_data(const OSQPVectorf *v);
OSQPInt OSQPMatrix_get_m(const OSQPMatrix *M);
OSQPInt OSQPMatrix_get_n(const OSQPMatrix *M);
OSQPInt *OSQPMatrix_get_p(const OSQPMatrix *M);
OSQPInt *OSQPMatrix_get_i(const OSQPMatrix *M);
OSQPFloat *OSQPMatrix_get_x(const OSQPMatrix *M);

typedef struct OSQPSettings {
    OSQPFloat rho, sigma;
} OSQPSettings;

typedef struct linsys_solver LinSysSolver;
struct linsys_solver {
    int type;
    const char *(*name)(LinSysSolver *self);
    OSQPInt (*solve)(LinSysSolver *self, OSQPVectorf *b, OSQPInt iteration);
    void (*update_settings)(LinSysSolver *self, const OSQPSettings *settings);
    void (*warm_start)(LinSysSolver *self, const OSQPVectorf *x);
    OSQPInt (*adjoint_derivative)(LinSysSolver *self);
    void (*free)(LinSysSolver *self);
    OSQPInt (*update_matrices)(LinSysSolver *self, const OSQPMatrix *P, const OSQPInt *P_index,
                               OSQPInt P_count, const OSQPMatrix *A, const OSQPInt *A_index,
                               OSQPInt A_count);
    OSQPInt (*update_rho_vec)(LinSysSolver *self, const OSQPVectorf *rho_vec, OSQPFloat rho);
    OSQPInt nthreads;
};

typedef struct OSQPData {
    OSQPMatrix *P, *A;
} OSQPData;
typedef struct OSQPWorkspace {
    OSQPData *data;
    LinSysSolver *linsys_solver;
    OSQPVectorf *rho_vec;
} OSQPWorkspace;
typedef struct OSQPSolver {
    OSQPSettings *settings;
    OSQPWorkspace *work;
} OSQPSolver;

/* QDLDL, for generated code. */
#define OSQP_CODEGEN
typedef struct qdldl qdldl_solver;
OSQPInt init_linsys_solver_qdldl(qdldl_solver **s, const OSQPMatrix *P, const OSQPMatrix *A,
                                 const OSQPVectorf *rho_vec, const OSQPSettings *settings,
                                 OSQPInt polishing);
void free_linsys_solver_qdldl(qdldl_solver *s);
OSQPInt codegen_src(const char *folder, const char *prefix, OSQPSolver *solver, OSQPInt embedded);

/* As those of QDLDL and of OSQP, by other names: OSQP is compiled so that it calls them. */
OSQPInt init_linsys_solver_sparse_local(qdldl_solver **s, const OSQPMatrix *P, const OSQPMatrix *A,
                                        const OSQPVectorf *rho_vec, const OSQPSettings *settings,
                                        OSQPInt polishing);
OSQPInt codegen_src_sparse_local(const char *folder, const char *prefix, OSQPSolver *solver,
                                 OSQPInt embedded);

#endif
