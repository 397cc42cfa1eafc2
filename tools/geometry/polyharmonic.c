/* polyharmonic.c: harmonic, biharmonic and triharmonic systems M + t (L M^-1)^(k-1) L of a mesh */
#include "polyharmonic.h"

#include <math.h>
#include <stdlib.h>

#include "laplacian.h"
#include "tools/matrix/sparse_product.h"
#include "tools/matrix/triplets.h"

/* Returns M^-1 L, with the rows of L divided by mass; NULL on error. Frees L. */
static sl_matrix *rows_divided(sl_matrix *L, const double *mass) {
    triplets list = {0, 0, NULL, NULL, NULL};
    sl_matrix *N = NULL;
    const sl_csc A = sl_matrix_view(L);
    bool ok = true;
    for (sl_int j = 0; j < A.n_cols && ok; j++) {
        for (sl_int p = A.p[j]; p < A.p[j + 1] && ok; p++) {
            ok = triplets_add(&list, A.i[p], j, A.x[p] / mass[A.i[p]]);
        }
    }
    if (ok) {
        ok = triplets_finish(&N, A.n_rows, A.n_cols, &list, true) == SL_OK;
    } else {
        triplets_free(&list);
    }
    sl_matrix_free(L);
    return ok ? N : NULL;
}

/* Lower triangle of (L M^-1)^(k-1) L, k >= 2. */
static bool power(sl_matrix **out, const mesh *m, int k, const double *mass) {
    sl_matrix *L = NULL, *all = NULL, *N = NULL;
    *out = NULL;
    bool ok = laplacian_cotangent(&L, m);
    sl_csc A = sl_matrix_view(L);
    ok = ok && csc_expand_symmetric(&all, &A) && csc_expand_symmetric(&N, &A);
    sl_matrix_free(L);
    if (ok) {
        N = rows_divided(N, mass);
        ok = N != NULL;
    }
    for (int step = 1; step < k && ok; step++) { /* all := all M^-1 L */
        sl_matrix *next;
        const sl_csc left = sl_matrix_view(all), right = sl_matrix_view(N);
        ok = csc_product(&next, &left, &right);
        sl_matrix_free(all);
        all = next;
    }
    if (ok) {
        A = sl_matrix_view(all);
        ok = csc_symmetric_part(out, &A);
    }
    sl_matrix_free(N);
    sl_matrix_free(all);
    return ok;
}

/* The lumped masses; NULL: a face index is out of range, or out of memory. */
static double *masses_of(const mesh *m) {
    double *mass = (double *)malloc(((size_t)m->n_vertices + 1) * sizeof *mass);
    bool ok = mass != NULL;
    for (size_t c = 0; c < 3 * (size_t)m->n_faces && ok; c++) {
        ok = m->faces[c] >= 0 && m->faces[c] < m->n_vertices;
    }
    if (!ok) {
        free(mass);
        return NULL;
    }
    laplacian_mass(mass, m);
    return mass;
}

bool polyharmonic_energy(sl_matrix **out, const mesh *m, int k) {
    *out = NULL;
    if (k < 1 || k > POLYHARMONIC_MAX_ORDER) {
        return false;
    }
    if (k == 1) {
        return laplacian_cotangent(out, m);
    }
    double *mass = masses_of(m);
    bool ok = mass != NULL && power(out, m, k, mass);
    free(mass);
    return ok;
}

bool polyharmonic_system(sl_matrix **out, const mesh *m, int k, double t) {
    *out = NULL;
    if (k < 1 || k > POLYHARMONIC_MAX_ORDER || !(t >= 0 && t <= 1e200)) {
        return false;
    }
    if (k == 1) {
        return laplacian_system(out, m, t);
    }
    double *mass = masses_of(m);
    sl_matrix *P = NULL;
    triplets list = {0, 0, NULL, NULL, NULL};
    bool ok = mass != NULL && power(&P, m, k, mass);
    const sl_csc A = sl_matrix_view(P);
    for (sl_int j = 0; j < A.n_cols && ok; j++) {
        ok = triplets_add(&list, j, j, mass[j]);
        for (sl_int p = A.p[j]; p < A.p[j + 1] && ok; p++) {
            ok = triplets_add(&list, A.i[p], j, t * A.x[p]);
        }
    }
    sl_matrix_free(P);
    free(mass);
    if (!ok) {
        triplets_free(&list);
        return false;
    }
    return triplets_finish(out, m->n_vertices, m->n_vertices, &list, true) == SL_OK;
}
