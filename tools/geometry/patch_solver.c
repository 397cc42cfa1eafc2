/* patch_solver.c: Poisson problems on a patch by local solves with the factor of the whole mesh */
#include "patch_solver.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "laplacian.h"

void patch_solver_free(patch_solver *s) {
    sl_matrix_free(s->N);
    sl_plan_free(s->patch_plan);
    sl_plan_free(s->interface_plan);
    sl_region_free(s->region);
    sl_work_free(s->work);
    free(s->scratch);
    memset(s, 0, sizeof *s);
}

static int by_number(const void *a, const void *b) {
    const sl_int x = *(const sl_int *)a, y = *(const sl_int *)b;
    return (x > y) - (x < y);
}

/* SL_OK if no vertex of the patch is given twice. A plan would accept it and add up the values. */
static sl_status check_vertices(const submesh *p) {
    const size_t n = (size_t)p->m.n_vertices;
    sl_int *sorted = (sl_int *)malloc((n + 1) * sizeof *sorted);
    sl_status status = sorted != NULL ? SL_OK : SL_ERR_MEMORY;
    if (sorted != NULL) {
        memcpy(sorted, p->vertices, n * sizeof *sorted);
        qsort(sorted, n, sizeof *sorted, by_number);
        for (size_t k = 1; k < n; k++) {
            status = sorted[k] == sorted[k - 1] ? SL_ERR_ARGUMENT : status;
        }
    }
    free(sorted);
    return status;
}

/* Creates both plans, confined to a region if it is not NULL. On error *patch_plan and
 * *interface_plan are NULL. */
static sl_status make_plans(sl_plan **patch_plan, sl_plan **interface_plan, const submesh *p,
                            const sl_symbolic *S, const sl_region *region, sl_stats *stats) {
    sl_options opt;
    memset(&opt, 0, sizeof opt);
    opt.region = region;
    *patch_plan = *interface_plan = NULL;
    sl_int *interface = (sl_int *)malloc(((size_t)p->n_interface + 1) * sizeof *interface);
    sl_status status = interface != NULL ? SL_OK : SL_ERR_MEMORY;
    for (sl_int k = 0; k < p->n_interface && interface != NULL; k++) {
        interface[k] = p->vertices[p->interface[k]];
    }
    if (status == SL_OK) {
        status = sl_plan_create(patch_plan, S, p->vertices, p->m.n_vertices, p->vertices,
                                p->m.n_vertices, &opt, stats);
    }
    if (status == SL_OK && p->n_interface > 0) {
        status = sl_plan_create(interface_plan, S, interface, p->n_interface, p->vertices,
                                p->m.n_vertices, &opt, NULL);
    }
    if (status != SL_OK) {
        sl_plan_free(*patch_plan);
        *patch_plan = NULL;
    }
    free(interface);
    return status;
}

sl_status patch_solver_create(patch_solver *out, const sl_symbolic *S, const sl_factor *F,
                              const submesh *p) {
    memset(out, 0, sizeof *out);
    out->F = F;
    out->p = p;
    size_t n = (size_t)p->m.n_vertices;
    out->scratch = (double *)malloc((4 * n * PATCH_SOLVER_MAX_RHS + 1) * sizeof *out->scratch);
    sl_status status = SL_ERR_MEMORY;
    if (out->scratch != NULL && laplacian_cotangent_of(&out->N, &p->m, p->lengths, 1)) {
        status = sl_work_create(&out->work, NULL);
    }
    if (status == SL_OK) {
        status = check_vertices(p);
    }
    if (status == SL_OK) {
        status = make_plans(&out->patch_plan, &out->interface_plan, p, S, NULL, &out->stats);
    }
    if (status != SL_OK) {
        patch_solver_free(out);
    }
    return status;
}

sl_status patch_solver_use_region(patch_solver *s, const sl_symbolic *S) {
    sl_region *region = NULL;
    sl_plan *patch_plan = NULL, *interface_plan = NULL;
    sl_stats stats = s->stats;
    if (s->region != NULL) {
        return SL_OK;
    }
    sl_status status =
        sl_region_create(&region, s->F, s->p->vertices, s->p->m.n_vertices, NULL, NULL, &stats);
    if (status == SL_OK) {
        status = make_plans(&patch_plan, &interface_plan, s->p, S, region, &stats);
    }
    if (status != SL_OK) {
        sl_region_free(region);
        return status;
    }
    sl_plan_free(s->patch_plan);
    sl_plan_free(s->interface_plan);
    s->patch_plan = patch_plan;
    s->interface_plan = interface_plan;
    s->region = region;
    s->stats = stats;
    return SL_OK;
}

sl_status patch_solver_solve_mesh(patch_solver *s, double *X, const double *B, sl_int nrhs) {
    size_t n = (size_t)s->p->m.n_vertices;
    return sl_plan_solve(s->patch_plan, s->F, X, n, B, n, nrhs, s->work);
}

sl_status patch_solver_apply(const patch_solver *s, double *Y, const double *X, sl_int nrhs) {
    const sl_csc N = sl_matrix_view(s->N);
    size_t n = (size_t)N.n_rows;
    return sl_csc_multiply(&N, SL_AS_SYMMETRIC, Y, n, X, n, nrhs);
}

static double dot(const double *a, const double *b, size_t n) {
    double sum = 0;
    for (size_t k = 0; k < n; k++) {
        sum += a[k] * b[k];
    }
    return sum;
}

/* Z = L^-1 R for an R that is 0 off the interface, by one local solve. */
static sl_status precondition(patch_solver *s, double *Z, const double *R, sl_int nrhs) {
    const submesh *p = s->p;
    size_t n = (size_t)p->m.n_vertices, rows = (size_t)p->n_interface;
    double *on_interface = s->scratch + 3 * n * PATCH_SOLVER_MAX_RHS;
    for (size_t c = 0; c < (size_t)nrhs; c++) {
        for (size_t k = 0; k < rows; k++) {
            on_interface[c * rows + k] = R[c * n + (size_t)p->interface[k]];
        }
    }
    return sl_plan_solve(s->interface_plan, s->F, Z, n, on_interface, rows, nrhs, s->work);
}

/* The state of one right-hand side. */
typedef struct column {
    double rho;  /* r'z of the last step */
    double stop; /* stop when ||r|| is at most this */
    bool done;
} column;

/* R = B - N X; off the interface it is rounding error. Returns whether every column is done. */
static bool residual(const patch_solver *s, double *R, const double *X, const double *B,
                     sl_int nrhs, column *columns, double tolerance) {
    const sl_csc N = sl_matrix_view(s->N);
    size_t n = (size_t)N.n_rows;
    bool all = true;
    if (sl_csc_residual(&N, R, n, NULL, X, n, B, n, nrhs) != SL_OK) {
        return true;
    }
    for (size_t c = 0; c < (size_t)nrhs; c++) {
        columns[c].rho = 0;
        columns[c].stop = tolerance * sqrt(dot(B + c * n, B + c * n, n));
        columns[c].done = !(sqrt(dot(R + c * n, R + c * n, n)) > columns[c].stop);
        all = all && columns[c].done;
    }
    return all;
}

/* One step of conjugate gradients for each column that is not done. D: search directions; Z: L^-1
 * R, overwritten by N D. Returns whether every column is done. */
static bool step(const patch_solver *s, double *X, double *R, double *D, double *Z, sl_int nrhs,
                 column *columns) {
    size_t n = (size_t)s->p->m.n_vertices;
    bool all = true;
    for (size_t c = 0; c < (size_t)nrhs; c++) {
        double *x = X + c * n, *r = R + c * n, *d = D + c * n, *z = Z + c * n;
        if (columns[c].done) {
            continue;
        }
        double rho = dot(r, z, n), beta = columns[c].rho > 0 ? rho / columns[c].rho : 0;
        for (size_t k = 0; k < n; k++) {
            d[k] = z[k] + beta * d[k];
        }
        columns[c].rho = rho;
        columns[c].done = patch_solver_apply(s, z, d, 1) != SL_OK;
        double curvature = dot(d, z, n);
        if (columns[c].done || !(rho > 0 && curvature > 0)) {
            columns[c].done = true;
            continue;
        }
        double alpha = rho / curvature;
        for (size_t k = 0; k < n; k++) {
            x[k] += alpha * d[k];
            r[k] -= alpha * z[k];
        }
        columns[c].done = !(sqrt(dot(r, r, n)) > columns[c].stop);
        all = all && columns[c].done;
    }
    return all;
}

sl_status patch_solver_solve_patch(patch_solver *s, double *X, const double *B, sl_int nrhs,
                                   double tolerance, int *solves) {
    size_t n = (size_t)s->p->m.n_vertices;
    double *R = s->scratch, *D = R + n * PATCH_SOLVER_MAX_RHS, *Z = D + n * PATCH_SOLVER_MAX_RHS;
    column columns[PATCH_SOLVER_MAX_RHS];
    int most = *solves;
    *solves = 0;
    if (nrhs < 0 || nrhs > PATCH_SOLVER_MAX_RHS) {
        return SL_ERR_ARGUMENT;
    }
    *solves = 1;
    sl_status status = patch_solver_solve_mesh(s, X, B, nrhs);
    if (status != SL_OK || s->p->n_interface == 0) {
        return status;
    }
    bool done = residual(s, R, X, B, nrhs, columns, tolerance);
    memset(D, 0, n * (size_t)nrhs * sizeof *D);
    while (!done && *solves < most && status == SL_OK) {
        status = precondition(s, Z, R, nrhs);
        if (status == SL_OK) {
            done = step(s, X, R, D, Z, nrhs, columns);
            ++*solves;
        }
    }
    return status;
}
