/* layout.c: planar layouts of a surface: faces at rest, their maps, systems */
#include "layout.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "planar_triangle.h"
#include "tools/matrix/sparse_product.h"

void layout_free(layout *l) {
    sl_factor_free(l->F);
    sl_symbolic_free(l->S);
    sl_work_free(l->work);
    free(l->grad);
    free(l->area);
    free(l->fixed);
    free(l->Ap);
    free(l->Ai);
    free(l->Ax);
    free(l->at);
    memset(l, 0, sizeof *l);
}

/* ---- faces at rest ---- */

static double distance(const double *a, const double *b) {
    return hypot(b[0] - a[0], b[1] - a[1]);
}

/* The face in its plane, with its longest edge as base where it has to be raised. `least`: the
 * length of the base of a face without length. */
static planar_triangle face_at_rest(const mesh *m, const sl_int *face, double least, bool *raised) {
    planar_triangle t = planar_triangle_of(m, face);
    int top = 0;
    double base = 0;
    for (int k = 0; k < 3; k++) {
        const double length = distance(t.x[(k + 1) % 3], t.x[(k + 2) % 3]);
        top = length > base ? k : top;
        base = fmax(base, length);
    }
    const double height = base > 0 ? t.x[1][0] * t.x[2][1] / base : 0;
    *raised = !(height >= LAYOUT_THINNEST * base && base > LAYOUT_THINNEST * least);
    if (*raised) {
        const double *o = t.x[(top + 1) % 3], *e = t.x[(top + 2) % 3], *p = t.x[top];
        const bool is_point = !(base > LAYOUT_THINNEST * least);
        const double product = (p[0] - o[0]) * (e[0] - o[0]) + (p[1] - o[1]) * (e[1] - o[1]);
        const double along = is_point ? 0.5 : product / base / base;
        base = is_point ? LAYOUT_THINNEST * least : base;
        t.x[(top + 1) % 3][0] = t.x[(top + 1) % 3][1] = t.x[(top + 2) % 3][1] = 0;
        t.x[(top + 2) % 3][0] = base;
        t.x[top][0] = fmin(1, fmax(0, along)) * base;
        t.x[top][1] = is_point ? base : LAYOUT_THINNEST * base;
    }
    return t;
}

static void measure(layout *l) {
    const mesh *m = l->m;
    double longest = 0;
    for (size_t c = 0; c < 3 * (size_t)m->n_faces; c++) {
        const double *a = m->xyz + 3 * (size_t)m->faces[c];
        const double *b = m->xyz + 3 * (size_t)m->faces[c / 3 * 3 + (c + 1) % 3];
        longest = fmax(longest, hypot(distance(a, b), b[2] - a[2]));
    }
    for (size_t f = 0; f < (size_t)m->n_faces; f++) {
        bool raised;
        const planar_triangle t =
            face_at_rest(m, m->faces + 3 * f, longest > 0 ? longest : 1, &raised);
        const double *a = t.x[0], *b = t.x[1], *c = t.x[2];
        const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        l->raised += raised;
        l->area[f] = twice / 2;
        l->whole += twice / 2;
        for (int k = 0; k < 3; k++) {
            const double *from = t.x[(k + 1) % 3], *to = t.x[(k + 2) % 3];
            l->grad[6 * f + 2 * (size_t)k] = (from[1] - to[1]) / twice;
            l->grad[6 * f + 2 * (size_t)k + 1] = (to[0] - from[0]) / twice;
        }
    }
}

/* ---- the pattern ---- */

/* The 21 entries of a face: for each corner its block's lower triangle, then for each pair of
 * corners the four entries below the diagonal. */
enum { PER_FACE = 21 };

static void entries_of_face(sl_int rows[PER_FACE], sl_int cols[PER_FACE], const sl_int *face) {
    int k = 0;
    for (int i = 0; i < 3; i++) {
        for (int e = 0; e < 3; e++, k++) { /* (0,0), (1,0), (1,1) */
            rows[k] = 2 * face[i] + (e > 0);
            cols[k] = 2 * face[i] + (e > 1);
        }
    }
    for (int i = 0; i < 3; i++) {
        const sl_int u = face[(i + 1) % 3], v = face[(i + 2) % 3];
        for (int e = 0; e < 4; e++, k++) {
            rows[k] = 2 * (u > v ? u : v) + e / 2;
            cols[k] = 2 * (u > v ? v : u) + e % 2;
        }
    }
}

static sl_status copy_pattern(layout *l, const sl_csc *A) {
    const size_t n = (size_t)A->n_cols, nnz = (size_t)A->p[n];
    l->Ap = (sl_int *)malloc((n + 1) * sizeof *l->Ap);
    l->Ai = (sl_int *)malloc((nnz + 1) * sizeof *l->Ai);
    l->Ax = (double *)calloc(nnz + 1, sizeof *l->Ax);
    if (l->Ap == NULL || l->Ai == NULL || l->Ax == NULL) {
        return SL_ERR_MEMORY;
    }
    memcpy(l->Ap, A->p, (n + 1) * sizeof *l->Ap);
    memcpy(l->Ai, A->i, nnz * sizeof *l->Ai);
    return SL_OK;
}

static sl_status make_pattern(layout *l) {
    const size_t count = PER_FACE * (size_t)l->m->n_faces;
    sl_int *rows = (sl_int *)malloc((count + 1) * sizeof *rows);
    sl_int *cols = (sl_int *)malloc((count + 1) * sizeof *cols);
    sl_matrix *pattern = NULL;
    sl_status status = rows != NULL && cols != NULL ? SL_OK : SL_ERR_MEMORY;
    for (size_t f = 0; f < (size_t)l->m->n_faces && status == SL_OK; f++) {
        entries_of_face(rows + PER_FACE * f, cols + PER_FACE * f, l->m->faces + 3 * f);
    }
    if (status == SL_OK) {
        status = sl_matrix_from_triplets(&pattern, 2 * l->m->n_vertices, 2 * l->m->n_vertices,
                                         (sl_off)count, rows, cols, NULL, NULL, NULL);
    }
    const sl_csc A = sl_matrix_view(pattern);
    status = status == SL_OK ? copy_pattern(l, &A) : status;
    for (size_t k = 0; k < count && status == SL_OK; k++) {
        l->at[k] = csc_position(&A, rows[k], cols[k]);
    }
    sl_matrix_free(pattern);
    free(rows);
    free(cols);
    return status;
}

sl_status layout_create(layout *out, const mesh *m) {
    const size_t nf = (size_t)m->n_faces;
    memset(out, 0, sizeof *out);
    if (m->n_faces > INT32_MAX / PER_FACE || m->n_vertices > INT32_MAX / 2 - 8) {
        return SL_ERR_TOO_LARGE;
    }
    out->m = m;
    out->grad = (double *)malloc((6 * nf + 1) * sizeof *out->grad);
    out->area = (double *)malloc((nf + 1) * sizeof *out->area);
    out->at = (sl_int *)malloc((PER_FACE * nf + 1) * sizeof *out->at);
    out->fixed = (unsigned char *)calloc((size_t)m->n_vertices + 1, 1);
    sl_status status =
        out->grad != NULL && out->area != NULL && out->at != NULL && out->fixed != NULL
            ? sl_work_create(&out->work, NULL)
            : SL_ERR_MEMORY;
    if (status == SL_OK) {
        measure(out);
        status = make_pattern(out);
    }
    if (status != SL_OK) {
        layout_free(out);
    }
    return status;
}

/* ---- maps of faces ---- */

double layout_jacobian(double J[4], const layout *l, const double *uv, sl_int f) {
    const sl_int *v = l->m->faces + 3 * (size_t)f;
    const double *g = l->grad + 6 * (size_t)f, *o = uv + 2 * (size_t)v[0];
    const double *a = uv + 2 * (size_t)v[1], *b = uv + 2 * (size_t)v[2];
    for (int c = 0; c < 2; c++) { /* the gradients sum to 0 */
        J[2 * c] = (a[c] - o[c]) * g[2] + (b[c] - o[c]) * g[4];
        J[2 * c + 1] = (a[c] - o[c]) * g[3] + (b[c] - o[c]) * g[5];
    }
    return ((a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])) / (2 * l->area[f]);
}

void layout_scatter(double *g, const layout *l, const double G[4], sl_int f) {
    for (size_t k = 0; k < 3; k++) {
        const double *grad = l->grad + 6 * (size_t)f + 2 * k;
        double *at = g + 2 * (size_t)l->m->faces[3 * (size_t)f + k];
        at[0] += G[0] * grad[0] + G[1] * grad[1];
        at[1] += G[2] * grad[0] + G[3] * grad[1];
    }
}

double layout_flat_area(const layout *l, const double *uv) {
    double sum = 0, J[4];
    for (sl_int f = 0; f < l->m->n_faces; f++) {
        sum += l->area[f] * layout_jacobian(J, l, uv, f);
    }
    return sum;
}

sl_int layout_flipped(const layout *l, const double *uv) {
    sl_int count = 0;
    double J[4];
    for (sl_int f = 0; f < l->m->n_faces; f++) {
        count += !(layout_jacobian(J, l, uv, f) > 0);
    }
    return count;
}

void layout_normalize(const layout *l, double *uv) {
    const size_t n = (size_t)l->m->n_vertices;
    const double flat = layout_flat_area(l, uv);
    const double scale = flat > 0 && isfinite(l->whole / flat) ? sqrt(l->whole / flat) : 1;
    double mean[2] = {0, 0};
    for (size_t k = 0; k < 2 * n; k++) {
        mean[k % 2] += uv[k] / (double)n;
    }
    for (size_t k = 0; k < 2 * n; k++) {
        uv[k] = scale * (uv[k] - mean[k % 2]);
    }
}

/* ---- systems ---- */

void layout_assemble(layout *l, const double *P, double turn) {
    static const double identity[3] = {1, 0, 1};
    memset(l->Ax, 0, (size_t)l->Ap[2 * l->m->n_vertices] * sizeof *l->Ax);
    for (size_t f = 0; f < (size_t)l->m->n_faces; f++) {
        const double *g = l->grad + 6 * f, *p = P != NULL ? P + 3 * f : identity;
        const sl_int *at = l->at + PER_FACE * f, *v = l->m->faces + 3 * f;
        for (int i = 0; i < 3; i++) {
            const double w = l->area[f] * (g[2 * i] * g[2 * i] + g[2 * i + 1] * g[2 * i + 1]);
            for (int e = 0; e < 3; e++) {
                l->Ax[*at++] += w * p[e];
            }
        }
        for (int i = 0; i < 3; i++) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            const double w = l->area[f] * (g[2 * j] * g[2 * k] + g[2 * j + 1] * g[2 * k + 1]);
            /* corner k follows j; the row is that of the larger number */
            const double s = v[j] > v[k] ? turn : -turn;
            l->Ax[*at++] += w * p[0];
            l->Ax[*at++] += w * p[1] - s;
            l->Ax[*at++] += w * p[1] + s;
            l->Ax[*at++] += w * p[2];
        }
    }
}

/* The block of two corners with the gradients g and h: C(c, d) = sum of g(e) H(c e, d f) h(f). */
static void block_of(double C[4], const double *H, const double *g, const double *h) {
    for (int k = 0; k < 4; k++) {
        const double *row = H + 8 * (k / 2) + 2 * (k % 2);
        C[k] = g[0] * (row[0] * h[0] + row[1] * h[1]) + g[1] * (row[4] * h[0] + row[5] * h[1]);
    }
}

void layout_assemble_hessian(layout *l, const double *H) {
    double C[4];
    memset(l->Ax, 0, (size_t)l->Ap[2 * l->m->n_vertices] * sizeof *l->Ax);
    for (size_t f = 0; f < (size_t)l->m->n_faces; f++) {
        const double *g = l->grad + 6 * f, w = l->area[f];
        const sl_int *at = l->at + PER_FACE * f, *v = l->m->faces + 3 * f;
        for (int i = 0; i < 3; i++) {
            block_of(C, H + 16 * f, g + 2 * i, g + 2 * i);
            l->Ax[*at++] += w * C[0];
            l->Ax[*at++] += w * C[2];
            l->Ax[*at++] += w * C[3];
        }
        for (int i = 0; i < 3; i++) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            const int row = v[j] > v[k] ? j : k, column = v[j] > v[k] ? k : j;
            block_of(C, H + 16 * f, g + 2 * row, g + 2 * column);
            for (int e = 0; e < 4; e++) {
                l->Ax[*at++] += w * C[e];
            }
        }
    }
}

static sl_csc system_of(const layout *l) {
    const sl_int n = 2 * l->m->n_vertices;
    const sl_csc A = {n, n, l->Ap, l->Ai, l->Ax};
    return A;
}

void layout_add_diagonal(layout *l, sl_int vertex, double x) {
    const sl_csc A = system_of(l);
    for (sl_int row = 2 * vertex; row < 2 * vertex + 2; row++) {
        l->Ax[csc_position(&A, row, row)] += x;
    }
}

sl_status layout_multiply(const layout *l, double *y, const double *x) {
    const sl_csc A = system_of(l);
    const size_t n = (size_t)A.n_cols;
    return sl_csc_multiply(&A, SL_AS_SYMMETRIC, y, n, x, n, 1);
}

sl_status layout_factor(layout *l) {
    const sl_csc A = system_of(l);
    sl_options opt;
    memset(&opt, 0, sizeof opt);
    opt.null_tolerance = -1; /* conformal energies are nearly singular, and solved as they are */
    for (sl_int j = 0; j < A.n_cols; j++) {
        for (sl_int p = l->Ap[j]; p < l->Ap[j + 1]; p++) {
            if (l->fixed[j / 2] || l->fixed[l->Ai[p] / 2]) {
                l->Ax[p] = l->Ai[p] == j;
            }
        }
    }
    if (l->F != NULL) {
        return sl_factor_refactor(l->F, &A, &l->stats);
    }
    sl_status status = l->S != NULL ? SL_OK : sl_symbolic_create(&l->S, &A, NULL, &l->stats);
    return status == SL_OK ? sl_factor_create(&l->F, l->S, &A, &opt, &l->stats) : status;
}

sl_status layout_solve(const layout *l, double *x) {
    const size_t n = 2 * (size_t)l->m->n_vertices;
    for (size_t k = 0; k < n; k++) {
        x[k] = l->fixed[k / 2] ? 0 : x[k];
    }
    return sl_factor_solve(l->F, x, n, x, n, 1, l->work);
}

sl_status layout_minimize(layout *l, double *uv) {
    const size_t n = 2 * (size_t)l->m->n_vertices;
    double *step = (double *)malloc((n + 1) * sizeof *step);
    sl_status status = step != NULL ? layout_multiply(l, step, uv) : SL_ERR_MEMORY;
    status = status == SL_OK ? layout_factor(l) : status;
    status = status == SL_OK ? layout_solve(l, step) : status;
    for (size_t k = 0; k < n && status == SL_OK; k++) {
        uv[k] -= step[k];
    }
    free(step);
    return status;
}
