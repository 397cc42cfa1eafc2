/* pivot_search.h: a multifrontal factorization that only selects 1x1 and 2x2 pivots by values */
#ifndef SLI_PIVOTS_PIVOT_SEARCH_H
#define SLI_PIVOTS_PIVOT_SEARCH_H

#include "../analysis/structure.h"
#include "../factor/factor_types.h"

/* Pivots are selected by threshold partial pivoting [DR83]: no entry of L exceeds
 * 1 / SLI_PIVOT_THRESHOLD. Where no column of a front has such a pivot, those that remain are
 * delayed: they become columns of the parent's front. At a root all rows are columns, and every
 * finite column has one. */
#define SLI_PIVOT_THRESHOLD 0.01

/* What a front passes to its parent: a lower triangle, column-major. */
typedef struct sli_contribution {
    void *block;    /* owns index and values */
    sl_int delayed; /* columns that come first and could not be eliminated */
    sl_int count;   /* rows */
    sl_int *index;  /* count: columns of L */
    double *values; /* count x count */
} sli_contribution;

/* A front as a dense column-major matrix. The columns of its pivots are complete; of the others
 * only the lower triangle is used. */
typedef struct sli_dense_front {
    sl_int rows, columns; /* rows and columns are numbered alike; the columns come first */
    sl_int *index;        /* rows: columns of L */
    double *values;       /* rows x rows */
    double *D, *E;        /* columns: the pivots found, E as in sl_factor */
} sli_dense_front;

typedef struct sli_pivot_search {
    const sl_symbolic *S;
    sl_allocator allocator;
    sli_contribution *contributions; /* n_supers */
    sl_int *local;                   /* n: the row of each column of L in the current front */
    sl_int *order;                   /* n: the columns of S in the order of elimination */
    unsigned char *is_first;         /* n: by position in order, is it the first of a pair? */
    sl_int selected;                 /* length of order */
    sl_int delayed;                  /* how often a column was delayed */
    void *front_block;               /* memory of the current front; grows */
    size_t front_size;
} sli_pivot_search;

SLI_INLINE double *sli_dense_column(const sli_dense_front *f, sl_int j) {
    return f->values + (size_t)f->rows * (size_t)j;
}

/* The largest magnitude in rows first .. last-1 of a column, except rows a and b, and its row. */
static double sli_column_max(const double *column, sl_int first, sl_int last, sl_int a, sl_int b,
                             sl_int *row) {
    double most = 0.0;
    sl_int i;
    for (i = first; i < last; i++) {
        const double size = fabs(column[i]);
        if (size > most && i != a && i != b) {
            most = size;
            *row = i;
        }
    }
    return most;
}

/* Tests column c after k pivots. Returns the size of an acceptable pivot, 1 or 2 with *partner, or
 * 0. */
static int sli_pivot_test(const sli_dense_front *f, sl_int k, sl_int c, sl_int *partner) {
    const double *column = sli_dense_column(f, c), *other;
    sl_int t = -1, row = -1;
    double e, most, rest, a, b, room, rest_t;
    e = sli_column_max(column, k, f->columns, c, c, &t);
    rest = sli_column_max(column, f->columns, f->rows, c, c, &row);
    most = e > rest ? e : rest;
    if (fabs(column[c]) >= SLI_PIVOT_THRESHOLD * most && (column[c] != 0.0 || most == 0.0)) {
        return 1;
    }
    if (t == -1) {
        return 0;
    }
    other = sli_dense_column(f, t);
    rest = sli_column_max(column, k, f->rows, c, t, &row) / e;
    rest_t = sli_column_max(other, k, f->rows, c, t, &row) / e;
    a = column[c] / e;
    b = other[t] / e;
    /* |D^-1| = [|b| 1; 1 |a|] / (e |a b - 1|). If a b overflows, both are pivots alone, up to
     * rounding. */
    room = fabs(a * b - 1.0) / SLI_PIVOT_THRESHOLD;
    *partner = t;
    return 2 * (room <= DBL_MAX && fabs(b) * rest + rest_t <= room &&
                rest + fabs(a) * rest_t <= room);
}

/* Exchanges rows and columns i and j of the pivots' part. */
static void sli_dense_swap(sli_dense_front *f, sl_int i, sl_int j) {
    double *a = sli_dense_column(f, i), *b = sli_dense_column(f, j);
    const sl_int index = f->index[i];
    sl_int k;
    if (i == j) {
        return;
    }
    for (k = 0; k < f->rows; k++) {
        const double keep = a[k];
        a[k] = b[k];
        b[k] = keep;
    }
    for (k = 0; k < f->columns; k++) {
        double *column = sli_dense_column(f, k);
        const double keep = column[i];
        column[i] = column[j];
        column[j] = keep;
    }
    f->index[i] = f->index[j];
    f->index[j] = index;
}

/* Eliminates `size` columns from k on: their columns become those of L, and the remaining columns
 * are updated. */
static void sli_dense_eliminate(sli_dense_front *f, sl_int k, int size) {
    double *u = sli_dense_column(f, k), *v = u;
    const double inverse = u[k] == 0.0 ? 0.0 : 1.0 / u[k];
    sl_int i, j;
    sli_pair_steps steps;
    SLI_CLEAR(steps);
    f->D[k] = u[k];
    f->E[k] = 0.0;
    if (size == 2) {
        v = sli_dense_column(f, k + 1);
        f->E[k] = u[k + 1];
        f->D[k + 1] = v[k + 1];
        f->E[k + 1] = 0.0;
        steps = sli_pair_eliminate(u[k], v[k + 1], u[k + 1]);
    }
    for (j = k + size; j < f->columns; j++) { /* x is symmetric: row j of it is in both columns */
        double *column = sli_dense_column(f, j);
        double x = inverse * u[j], y;
        if (size == 2) {
            sli_pair_solve(&steps, u[j], v[j], &x, &y);
            for (i = k + 2; i < f->rows; i++) {
                column[i] -= u[i] * x + v[i] * y;
            }
        } else if (x != 0.0) {
            for (i = k + 1; i < f->rows; i++) {
                column[i] -= u[i] * x;
            }
        }
    }
    for (i = k + size; i < f->rows; i++) {
        if (size == 2) {
            sli_pair_solve(&steps, u[i], v[i], &u[i], &v[i]);
        } else {
            u[i] *= inverse;
        }
    }
}

/* Selects and eliminates pivots while there are acceptable ones. Returns how many columns were
 * eliminated. */
static sl_int sli_dense_factor(sli_pivot_search *p, sli_dense_front *f) {
    sl_int k = 0, c = 0, failures = 0;
    while (k < f->columns && failures < f->columns - k) {
        sl_int partner = -1;
        const int size = sli_pivot_test(f, k, c, &partner);
        failures = size == 0 ? failures + 1 : 0;
        if (size > 0) {
            sli_dense_swap(f, k, c);
            if (size == 2) {
                sli_dense_swap(f, k + 1, partner == k ? c : partner);
            }
            sli_dense_eliminate(f, k, size);
            p->is_first[p->selected] = (unsigned char)(size == 2);
            p->order[p->selected++] = f->index[k];
            if (size == 2) {
                p->is_first[p->selected] = 0;
                p->order[p->selected++] = f->index[k + 1];
            }
            k += size;
        }
        c = c + 1 < f->columns ? sli_max(c + 1, k) : k;
    }
    return k;
}

/* Subtracts L D L' of the first `pivots` columns, four at a time, from the rows below the columns.
 */
static void sli_dense_update(const sli_dense_front *f, sl_int pivots) {
    sl_int i, j, k, m;
    for (j = f->columns; j < f->rows; j++) {
        double *to = sli_dense_column(f, j);
        for (k = 0; k < pivots; k += 4) {
            const double *l[4];
            double x[4];
            for (m = 0; m < 4; m++) {
                const sl_int c = sli_min(k + m, pivots - 1);
                l[m] = sli_dense_column(f, c);
                x[m] = k + m < pivots ? f->D[c] * l[m][j] : 0.0;
                if (k + m < pivots && f->E[c] != 0.0) {
                    x[m] += f->E[c] * sli_dense_column(f, c + 1)[j];
                } else if (k + m < pivots && c > 0 && f->E[c - 1] != 0.0) {
                    x[m] += f->E[c - 1] * sli_dense_column(f, c - 1)[j];
                }
            }
            for (i = j; i < f->rows; i++) {
                to[i] -= l[0][i] * x[0] + l[1][i] * x[1] + (l[2][i] * x[2] + l[3][i] * x[3]);
            }
        }
    }
}

/* Adds a value at a row and a column of the front. */
SLI_INLINE void sli_dense_add(const sli_dense_front *f, sl_int i, sl_int j, double value) {
    const sl_int low = sli_min(i, j), high = sli_max(i, j);
    sli_dense_column(f, low)[high] += value;
    if (high < f->columns && low != high) {
        sli_dense_column(f, high)[low] += value;
    }
}

/* Adds the entries of A in the columns of supernode s. */
static sl_status sli_search_load(const sli_pivot_search *p, const sl_csc *A, sl_int s,
                                 const sli_dense_front *f, sl_stats *stats) {
    const sl_symbolic *S = p->S;
    sl_int tile = sli_last_tile(S, s), i, j;
    sl_off m;
    for (m = S->scatter_begin[s + 1] - 1; m >= S->scatter_begin[s]; m--) {
        const sl_int from = S->scatter_from[m];
        if (!sli_is_finite(A->x[from])) {
            return sli_fail_at(stats, SL_ERR_NOT_FINITE, A->i[from], sli_column_of(A, from),
                               A->x[from], "an entry of A is not finite");
        }
        sli_scatter_map_pivots(S, s, m, &tile, &i, &j);
        sli_dense_add(f, p->local[i], p->local[j], A->x[from]);
    }
    return SL_OK;
}

static void sli_search_assemble(const sli_pivot_search *p, const sli_contribution *c,
                                const sli_dense_front *f) {
    sl_int i, j;
    for (j = 0; j < c->count; j++) {
        const double *column = c->values + (size_t)c->count * (size_t)j;
        const sl_int to = p->local[c->index[j]];
        for (i = j; i < c->count; i++) {
            sli_dense_add(f, p->local[c->index[i]], to, column[i]);
        }
    }
}

/* Makes an empty front of supernode s: the columns that its children delay, its own, and the rows
 * below. */
static sl_status sli_search_front(sli_pivot_search *p, sl_int s, sli_dense_front *f) {
    const sl_symbolic *S = p->S;
    sli_block b = {NULL, 0};
    sl_int c, k, at = 0;
    int pass;
    f->columns = S->steps[s].width;
    for (c = s - 1; c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
        f->columns += p->contributions[c].delayed;
    }
    f->rows = f->columns + S->steps[s].below;
    for (pass = 0; pass < 2; pass++) {
        f->index = SLI_TAKE(&b, sl_int, f->rows);
        f->D = SLI_TAKE(&b, double, f->columns);
        f->E = SLI_TAKE(&b, double, f->columns);
        f->values = SLI_TAKE(&b, double, (uint64_t)f->rows *(uint64_t)f->rows);
        if (b.used == SIZE_MAX) {                           /* untested: on 32 bits only */
            return sli_refuse(SL_ERR_TOO_LARGE, "a front"); /* untested: the same */
        }
        if (pass == 0 && b.used > p->front_size) {
            sli_free(&p->allocator, p->front_block);
            p->front_size = 0;
            p->front_block = sli_alloc(&p->allocator, b.used);
            if (p->front_block == NULL) {
                return sli_no_memory();
            }
            p->front_size = b.used;
        }
        b.base = (unsigned char *)p->front_block;
        b.used = 0;
    }
    for (c = s - 1; c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
        for (k = 0; k < p->contributions[c].delayed; k++) {
            f->index[at++] = p->contributions[c].index[k];
        }
    }
    for (k = 0; k < S->steps[s].width; k++) {
        f->index[at++] = S->super_first[s] + k;
    }
    for (k = 0; k < S->steps[s].below; k++) {
        f->index[at++] = S->rows[S->rows_begin[s] + k];
    }
    for (k = 0; k < f->rows; k++) {
        p->local[f->index[k]] = k;
    }
    SLI_ZERO(f->values, (size_t)f->rows * (size_t)f->rows);
    return SL_OK;
}

/* Keeps what is left of a front after `pivots` columns for its parent. */
static sl_status sli_search_keep(sli_pivot_search *p, sl_int s, const sli_dense_front *f,
                                 sl_int pivots) {
    sli_contribution *c = &p->contributions[s];
    sli_block b = {NULL, 0};
    sl_status status = SL_OK;
    sl_int j;
    c->delayed = f->columns - pivots;
    c->count = f->rows - pivots;
    p->delayed += c->delayed;
    SLI_LAYOUT(&b, &p->allocator, status) {
        c->index = SLI_TAKE(&b, sl_int, c->count);
        c->values = SLI_TAKE(&b, double, (uint64_t)c->count *(uint64_t)c->count);
    }
    if (status != SL_OK) {
        return status;
    }
    c->block = b.base;
    SLI_COPY(c->index, f->index + pivots, c->count);
    for (j = 0; j < c->count; j++) {
        memcpy(c->values + (size_t)c->count * (size_t)j + j,
               sli_dense_column(f, pivots + j) + pivots + j,
               (size_t)(c->count - j) * sizeof(double));
    }
    return SL_OK;
}

/* Selects the pivots of supernode s and of what its children delayed. */
SLI_HOT static sl_status sli_search_supernode(sli_pivot_search *p, const sl_csc *A, sl_int s,
                                              sl_stats *stats) {
    const sl_symbolic *S = p->S;
    sli_dense_front f;
    sl_status status = sli_search_front(p, s, &f);
    sl_int c, k;
    if (status == SL_OK) {
        status = sli_search_load(p, A, s, &f, stats);
    }
    if (status != SL_OK) {
        return status;
    }
    for (c = s - 1; c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
        sli_search_assemble(p, &p->contributions[c], &f);
        sli_free(&p->allocator, p->contributions[c].block);
        p->contributions[c].block = NULL;
    }
    k = sli_dense_factor(p, &f);
    if (S->super_parent[s] != -1) {
        sli_dense_update(&f, k);
        return sli_search_keep(p, s, &f, k);
    }
    for (; k < f.columns; k++) { /* not finite: the factorization refuses them */
        p->is_first[p->selected] = 0;
        p->order[p->selected++] = f.index[k];
    }
    return SL_OK;
}

/* Selects all pivots of a matrix that has the analyzed pattern. p has its memory. */
static sl_status sli_search_run(sli_pivot_search *p, const sl_csc *A, sl_stats *stats) {
    sl_status status = SL_OK;
    sl_int s;
    SLI_ZERO(p->contributions, p->S->n_supers);
    for (s = 0; s < p->S->n_supers && status == SL_OK; s++) {
        status = sli_search_supernode(p, A, s, stats);
    }
    for (s = 0; s < p->S->n_supers; s++) {
        sli_free(&p->allocator, p->contributions[s].block);
    }
    sli_free(&p->allocator, p->front_block);
    SLI_ASSERT(status != SL_OK || p->selected == p->S->n);
    return status;
}

#endif
