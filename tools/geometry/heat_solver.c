/* heat_solver.c: the two factors of the heat method on a mesh: of M + t L and of L */
#include "heat_solver.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "laplacian.h"
#include "patch_solver.h"

void heat_solver_free(heat_solver *s) {
    sl_factor_free(s->heat);
    sl_factor_free(s->poisson);
    if (s->poisson_S != s->S) {
        sl_symbolic_free(s->poisson_S);
    }
    sl_symbolic_free(s->S);
    sl_work_free(s->work);
    incidence_free(&s->inc);
    memset(s, 0, sizeof *s);
}

static sl_status factor(sl_factor **out, sl_symbolic **S, const sl_matrix *A, sl_pivots null_pivots,
                        const sl_options *opt) {
    const sl_csc view = sl_matrix_view(A);
    sl_options own;
    memset(&own, 0, sizeof own);
    if (opt != NULL) {
        own.allocator = opt->allocator;
    }
    sl_status status = *S == NULL ? sl_symbolic_create(S, &view, &own, NULL) : SL_OK;
    own.pivots = null_pivots;
    own.consistency_tolerance = PATCH_SOLVER_CONSISTENCY;
    return status == SL_OK ? sl_factor_create(out, *S, &view, &own, NULL) : status;
}

/* What needs no factor. */
static sl_status prepare(heat_solver *out, const mesh *m, const double *lengths) {
    if (!mesh_faces_are_in_range(m)) {
        return SL_ERR_ARGUMENT;
    }
    out->m = m;
    return incidence_create_of(&out->inc, m, lengths) ? sl_work_create(&out->work, NULL)
                                                      : SL_ERR_MEMORY;
}

/* Both sheets of a double cover count: u and b then halve alike, and distances are the same. */
static sl_status create(heat_solver *out, const mesh *m, const double *lengths, double t,
                        const sl_options *opt) {
    sl_matrix *A = NULL, *L = NULL;
    memset(out, 0, sizeof *out);
    if (!(t > 0 && t <= 1e200)) {
        return SL_ERR_ARGUMENT;
    }
    out->t = t;
    sl_status status = prepare(out, m, lengths);
    if (status == SL_OK && (!laplacian_system_of(&A, m, lengths, 1, t) ||
                            !laplacian_cotangent_of(&L, m, lengths, 1))) {
        status = SL_ERR_MEMORY;
    }
    if (status == SL_OK) {
        status = factor(&out->heat, &out->S, A, SL_PIVOTS_NONZERO, opt);
    }
    if (status == SL_OK) {
        out->poisson_S = out->S;
        status = factor(&out->poisson, &out->S, L, SL_PIVOTS_SKIP_NULL, opt);
    }
    sl_matrix_free(A);
    sl_matrix_free(L);
    if (status != SL_OK) {
        heat_solver_free(out);
    }
    return status;
}

sl_status heat_solver_create(heat_solver *out, const mesh *m, double t, const sl_options *opt) {
    return create(out, m, NULL, t, opt);
}

sl_status heat_solver_create_intrinsic(heat_solver *out, const intrinsic *a, double t,
                                       const sl_options *opt) {
    return create(out, &a->m, a->lengths, t, opt);
}

/* What the check of factors uses, of n numbers each. */
typedef struct check_vectors {
    double *mass; /* diagonal of M */
    double *y, *x, *b, *Lx;
    double *size; /* of the terms of a row of L x */
} check_vectors;

/* Lx = L x, and the sum of the magnitudes of the terms in each row. */
static void multiply(check_vectors *v, const sl_csc *L) {
    memset(v->Lx, 0, (size_t)L->n_cols * sizeof *v->Lx);
    memset(v->size, 0, (size_t)L->n_cols * sizeof *v->size);
    for (sl_int j = 0; j < L->n_cols; j++) {
        for (sl_int p = L->p[j]; p < L->p[j + 1]; p++) {
            const sl_int i = L->i[p];
            v->Lx[i] += L->x[p] * v->x[j];
            v->size[i] += fabs(L->x[p] * v->x[j]);
            if (i != j) {
                v->Lx[j] += L->x[p] * v->x[i];
                v->size[j] += fabs(L->x[p] * v->x[i]);
            }
        }
    }
}

/* Whether row i of M x + t L x is b, to 6 digits of its terms. */
static bool agrees(const check_vectors *v, size_t i, double mass, double t) {
    const double size = mass * fabs(v->x[i]) + t * v->size[i] + fabs(v->b[i]);
    return fabs(mass * v->x[i] + t * v->Lx[i] - v->b[i]) <= 1e-6 * size;
}

/* Finds t, the least-squares solution of t L x = b - M x for a solution x of the heat factor;
 * false: its other rows disagree. Without edges L is 0, and any t will do. */
static bool find_time(double *t, const check_vectors *v, size_t n) {
    double above = 0, below = 0;
    bool same = true;
    for (size_t i = 0; i < n; i++) {
        above += (v->b[i] - v->mass[i] * v->x[i]) * v->Lx[i];
        below += v->Lx[i] * v->Lx[i];
    }
    *t = below > 0 ? above / below : 1;
    for (size_t i = 0; i < n && same; i++) {
        same = agrees(v, i, v->mass[i], *t);
    }
    return same && *t > 0 && *t <= 1e200;
}

/* Checks both factors with right-hand sides of random size: M y for heat, L y for Poisson. */
static sl_status check(heat_solver *s, check_vectors *v, const sl_csc *L) {
    const size_t n = (size_t)L->n_cols;
    unsigned random = 1;
    for (size_t i = 0; i < n; i++) {
        random = random * 1103515245u + 12345u;
        v->y[i] = (double)(random >> 8 & 0xffff) / 65536 - 0.5;
        v->b[i] = v->mass[i] * v->y[i];
    }
    sl_status status = sl_factor_solve(s->heat, v->x, n, v->b, n, 1, s->work);
    if (status == SL_OK) {
        multiply(v, L);
        status = find_time(&s->t, v, n) ? SL_OK : SL_ERR_MALFORMED;
    }
    if (status == SL_OK) {
        memcpy(v->x, v->y, n * sizeof *v->x);
        multiply(v, L);
        memcpy(v->b, v->Lx, n * sizeof *v->b);
        status = sl_factor_solve(s->poisson, v->x, n, v->b, n, 1, s->work);
    }
    if (status == SL_OK) {
        multiply(v, L);
        for (size_t i = 0; i < n && status == SL_OK; i++) {
            status = agrees(v, i, 0, 1) ? SL_OK : SL_ERR_MALFORMED;
        }
    }
    return status;
}

sl_status heat_solver_adopt(heat_solver *out, const mesh *m, const double *lengths,
                            sl_saved_set *heat, sl_saved_set *poisson) {
    const size_t n = (size_t)m->n_vertices;
    check_vectors v;
    sl_matrix *L = NULL;
    memset(out, 0, sizeof *out);
    out->S = heat->symbolic;
    out->heat = heat->factor;
    out->poisson_S = poisson->symbolic;
    out->poisson = poisson->factor;
    heat->symbolic = poisson->symbolic = NULL;
    heat->factor = poisson->factor = NULL;
    sl_status status = out->heat != NULL && out->poisson != NULL ? SL_OK : SL_ERR_ARGUMENT;
    if (status == SL_OK && (sl_symbolic_view(out->S).n != m->n_vertices ||
                            sl_symbolic_view(out->poisson_S).n != m->n_vertices)) {
        status = SL_ERR_MALFORMED;
    }
    if (status == SL_OK) {
        status = prepare(out, m, lengths);
    }
    v.mass = (double *)malloc((6 * n + 1) * sizeof *v.mass);
    if (status == SL_OK && (v.mass == NULL || !laplacian_cotangent_of(&L, m, lengths, 1))) {
        status = SL_ERR_MEMORY;
    }
    if (status == SL_OK) {
        const sl_csc view = sl_matrix_view(L);
        laplacian_mass_of(v.mass, m, lengths, 1);
        v.y = v.mass + n;
        v.x = v.y + n;
        v.b = v.x + n;
        v.Lx = v.b + n;
        v.size = v.Lx + n;
        status = check(out, &v, &view);
    }
    sl_matrix_free(L);
    free(v.mass);
    if (status != SL_OK) {
        heat_solver_free(out);
    }
    return status;
}

sl_status heat_solver_set_time(heat_solver *s, double t) {
    sl_matrix *A = NULL;
    if (!(t > 0 && t <= 1e200)) {
        return SL_ERR_ARGUMENT;
    }
    if (!laplacian_system_of(&A, s->m, s->inc.lengths, 1, t)) {
        return SL_ERR_MEMORY;
    }
    const sl_csc view = sl_matrix_view(A);
    sl_status status = sl_factor_refactor(s->heat, &view, NULL);
    sl_matrix_free(A);
    s->t = t;
    return status;
}
