/* heat_solver.c: the two factors of the heat method on a mesh: of M + t L and of L */
#include "heat_solver.h"

#include <stdlib.h>
#include <string.h>

#include "laplacian.h"
#include "patch_solver.h"

void heat_solver_free(heat_solver *s) {
    sl_factor_free(s->heat);
    sl_factor_free(s->poisson);
    sl_symbolic_free(s->S);
    sl_work_free(s->work);
    incidence_free(&s->inc);
    memset(s, 0, sizeof *s);
}

static sl_status factor(sl_factor **out, sl_symbolic **S, const sl_matrix *A,
                        sl_null_pivots null_pivots) {
    const sl_csc view = sl_matrix_view(A);
    sl_options opt;
    memset(&opt, 0, sizeof opt);
    opt.null_pivots = null_pivots;
    opt.consistency_tolerance = PATCH_SOLVER_CONSISTENCY;
    sl_status status = *S == NULL ? sl_symbolic_create(S, &view, NULL, NULL) : SL_OK;
    return status == SL_OK ? sl_factor_create(out, *S, &view, &opt, NULL) : status;
}

/* Both sheets of a double cover count: u and b then halve alike, and distances are the same. */
static sl_status create(heat_solver *out, const mesh *m, const double *lengths, double t) {
    sl_matrix *A = NULL, *L = NULL;
    memset(out, 0, sizeof *out);
    if (!(t > 0 && t <= 1e200)) {
        return SL_ERR_ARGUMENT;
    }
    for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) {
        if (m->faces[k] < 0 || m->faces[k] >= m->n_vertices) {
            return SL_ERR_ARGUMENT;
        }
    }
    out->m = m;
    out->t = t;
    sl_status status = SL_ERR_MEMORY;
    if (incidence_create_of(&out->inc, m, lengths) && laplacian_system_of(&A, m, lengths, 1, t) &&
        laplacian_cotangent_of(&L, m, lengths, 1)) {
        status = sl_work_create(&out->work, NULL);
    }
    if (status == SL_OK) {
        status = factor(&out->heat, &out->S, A, SL_NULL_PIVOT_REFUSE);
    }
    if (status == SL_OK) {
        status = factor(&out->poisson, &out->S, L, SL_NULL_PIVOT_SKIP);
    }
    sl_matrix_free(A);
    sl_matrix_free(L);
    if (status != SL_OK) {
        heat_solver_free(out);
    }
    return status;
}

sl_status heat_solver_create(heat_solver *out, const mesh *m, double t) {
    return create(out, m, NULL, t);
}

sl_status heat_solver_create_intrinsic(heat_solver *out, const intrinsic *a, double t) {
    return create(out, &a->m, a->lengths, t);
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
