/* edited_matrix.c: a symmetric matrix whose entries change one by one, also outside its pattern */
#include "edited_matrix.h"

#include <stdlib.h>
#include <string.h>

void edited_matrix_free(edited_matrix *m) {
    free(m->p);
    free(m->i);
    free(m->x);
    free(m->row_p);
    free(m->row_j);
    free(m->row_at);
    triplets_free(&m->more);
    memset(m, 0, sizeof *m);
}

static sl_int *integers(size_t count) {
    return (sl_int *)calloc(count + 1, sizeof(sl_int));
}

/* Lists the entries left of the diagonal by rows. */
static void index_rows(edited_matrix *m) {
    for (sl_int j = 0; j < m->n; j++) {
        for (sl_int k = m->p[j]; k < m->p[j + 1]; k++) {
            if (m->i[k] > j) {
                m->row_p[m->i[k] + 1]++;
            }
        }
    }
    for (sl_int v = 0; v < m->n; v++) {
        m->row_p[v + 1] += m->row_p[v];
    }
    for (sl_int j = 0; j < m->n; j++) {
        for (sl_int k = m->p[j]; k < m->p[j + 1]; k++) {
            if (m->i[k] > j) {
                const sl_int at = m->row_p[m->i[k]]++;
                m->row_j[at] = j;
                m->row_at[at] = k;
            }
        }
    }
    for (sl_int v = m->n; v > 0; v--) { /* each row_p is now the begin of the next row */
        m->row_p[v] = m->row_p[v - 1];
    }
    m->row_p[0] = 0;
}

bool edited_matrix_create(edited_matrix *out, const sl_csc *A) {
    const size_t n = (size_t)A->n_cols, count = (size_t)A->p[n];
    memset(out, 0, sizeof *out);
    for (sl_int j = 0; j < A->n_cols; j++) {
        for (sl_int k = A->p[j]; k < A->p[j + 1]; k++) {
            if (A->i[k] < j || A->i[k] >= A->n_rows || (k > A->p[j] && A->i[k] <= A->i[k - 1])) {
                return false;
            }
        }
    }
    out->n = A->n_cols;
    out->p = integers(n + 1);
    out->i = integers(count);
    out->x = (double *)malloc((count + 1) * sizeof(double));
    out->row_p = integers(n + 1);
    out->row_j = integers(count);
    out->row_at = integers(count);
    if (out->p == NULL || out->i == NULL || out->x == NULL || out->row_p == NULL ||
        out->row_j == NULL || out->row_at == NULL) {
        edited_matrix_free(out);
        return false;
    }
    memcpy(out->p, A->p, (n + 1) * sizeof(sl_int));
    memcpy(out->i, A->i, count * sizeof(sl_int));
    memcpy(out->x, A->x, count * sizeof(double));
    index_rows(out);
    return true;
}

sl_csc edited_matrix_view(const edited_matrix *m) {
    const sl_csc A = {m->n, m->n, m->p, m->i, m->x};
    return A;
}

/* Where the entry (i, j), i >= j, is stored; NULL: nowhere. */
static double *find(const edited_matrix *m, sl_int i, sl_int j) {
    sl_int low = m->p[j], high = m->p[j + 1];
    while (low < high) {
        const sl_int middle = low + (high - low) / 2;
        if (m->i[middle] < i) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    if (low < m->p[j + 1] && m->i[low] == i) {
        return m->x + low;
    }
    for (size_t k = 0; k < m->more.count; k++) {
        if (m->more.i[k] == i && m->more.j[k] == j) {
            return m->more.x + k;
        }
    }
    return NULL;
}

double edited_matrix_get(const edited_matrix *m, sl_int i, sl_int j) {
    const double *x = find(m, i > j ? i : j, i > j ? j : i);
    return x != NULL ? *x : 0;
}

bool edited_matrix_apply(edited_matrix *m, const entry_changes *changes) {
    for (size_t k = 0; k < changes->count; k++) {
        const sl_int a = changes->i[k], b = changes->j[k], i = a > b ? a : b, j = a > b ? b : a;
        if (find(m, i, j) == NULL && !triplets_add(&m->more, i, j, 0)) {
            return false;
        }
    }
    for (size_t k = 0; k < changes->count; k++) {
        const sl_int a = changes->i[k], b = changes->j[k];
        *find(m, a > b ? a : b, a > b ? b : a) += changes->x[k];
    }
    return true;
}

bool edited_matrix_row(const edited_matrix *m, sl_int v, triplets *row) {
    bool ok = true;
    for (sl_int k = m->row_p[v]; k < m->row_p[v + 1] && ok; k++) {
        const double x = m->x[m->row_at[k]];
        ok = x == 0 || triplets_add(row, v, m->row_j[k], x);
    }
    for (sl_int k = m->p[v]; k < m->p[v + 1] && ok; k++) {
        ok = m->i[k] == v || m->x[k] == 0 || triplets_add(row, v, m->i[k], m->x[k]);
    }
    for (size_t k = 0; k < m->more.count && ok; k++) {
        const sl_int i = m->more.i[k], j = m->more.j[k];
        ok = (i != v && j != v) || m->more.x[k] == 0 ||
             triplets_add(row, v, i == v ? j : i, m->more.x[k]);
    }
    return ok;
}

bool edited_matrix_whole(sl_matrix **out, const edited_matrix *m, const unsigned char *keep) {
    triplets list = {0, 0, NULL, NULL, NULL};
    bool ok = true;
    *out = NULL;
    for (sl_int j = 0; j < m->n && ok; j++) {
        for (sl_int k = m->p[j]; k < m->p[j + 1] && ok; k++) {
            const sl_int i = m->i[k];
            const bool stays = i == j || m->x[k] != 0 || (keep != NULL && (keep[i] || keep[j]));
            ok = !stays || triplets_add(&list, i, j, m->x[k]);
        }
    }
    for (size_t k = 0; k < m->more.count && ok; k++) {
        const sl_int i = m->more.i[k], j = m->more.j[k];
        const bool stays = m->more.x[k] != 0 || (keep != NULL && (keep[i] || keep[j]));
        ok = !stays || triplets_add(&list, i, j, m->more.x[k]);
    }
    if (!ok) {
        triplets_free(&list);
        return false;
    }
    return triplets_finish(out, m->n, m->n, &list, true) == SL_OK;
}
