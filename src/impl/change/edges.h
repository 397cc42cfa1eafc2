/* edges.h: changes given by entries of A, as rank-one changes */
#ifndef SLI_CHANGE_EDGES_H
#define SLI_CHANGE_EDGES_H

#include "rank.h"

/* A symmetric change by d at (i, j) and (j, i) is -d v v' with v = c e_i - e_j / c, and d c^2 and
 * d / c^2 added to the diagonal. Where the edges of a graph change, c = 1 cancels the changes of
 * the diagonal. Where that leaves d in a row whose entry of the diagonal is much less, the row
 * would lose its digits: then c^2 is about the root of a_ii / a_jj, so that the split follows the
 * scales of A. c is a power of 2: it rounds nothing. */

/* A row can lose so much and keep all but one hexadecimal digit. */
#define SLI_EDGES_HEAVY 16.0

SLI_COLD static void sli_edges_layout(void *data, sli_block *b) {
    sli_rank *q = (sli_rank *)data;
    const uint64_t count = (uint64_t)q->n_entries;
    q->p = SLI_TAKE(b, sl_int, 3 * count + 1);
    q->i = SLI_TAKE(b, sl_int, 4 * count);
    q->x = SLI_TAKE(b, double, 4 * count);
    q->sigma = SLI_TAKE(b, double, 3 * count);
    q->order = SLI_TAKE(b, uint64_t, 2 * count);
    q->order_scratch = SLI_TAKE(b, uint64_t, 2 * count);
    q->diagonal = SLI_TAKE(b, double, 2 * count);
}

/* Appends sigma v v' with v = c e_i - e_j / c, or v = c e_i if j = -1. */
static void sli_edges_add(sli_rank *q, sl_int i, sl_int j, double c, double sigma) {
    sl_int *end = &q->p[q->V.n_cols + 1];
    *end = q->p[q->V.n_cols];
    q->i[*end] = i;
    q->x[(*end)++] = c;
    if (j != -1) {
        q->i[*end] = j;
        q->x[(*end)++] = -1.0 / c;
    }
    q->sigma[q->V.n_cols++] = sigma;
}

/* Sorts the entries by their two pivots, the earlier one first. */
static void sli_edges_sort(sli_rank *q) {
    const sl_int *iperm = q->S->iperm;
    sl_int k, pass;
    for (pass = 0; pass < 2; pass++) {
        for (k = 0; k < q->n_entries; k++) {
            const sl_int e = pass == 0 ? k : sli_value(q->order[k]);
            const sl_int a = iperm[q->entry_rows[e]], b = iperm[q->entry_columns[e]];
            q->order[k] = sli_keyed(pass == 0 ? sli_max(a, b) : sli_min(a, b), e);
        }
        sli_sort(q->order, q->n_entries, q->order_scratch);
    }
}

/* c of a change by d at (i, j). */
static double sli_edges_balance(const sli_rank *q, sl_int i, sl_int j, double d) {
    const double at_i = sli_update_magnitude(q->u.F, q->S->iperm[i]),
                 at_j = sli_update_magnitude(q->u.F, q->S->iperm[j]);
    int first, second;
    if (!(fabs(d) > SLI_EDGES_HEAVY * fmin(at_i, at_j))) {
        return 1.0;
    }
    (void)frexp(at_i, &first);
    (void)frexp(at_j, &second);
    return ldexp(1.0, (first - second) / 4);
}

/* Appends the edges; returns how many changes of the diagonal they leave in q->diagonal. */
static sl_int sli_edges_add_all(sli_rank *q) {
    const sl_int *iperm = q->S->iperm;
    uint64_t *rows = q->order_scratch;
    sl_int k, terms = 0;
    for (k = 0; k < q->n_entries;) {
        const sl_int e = sli_value(q->order[k]);
        const sl_int i = q->entry_rows[e], j = q->entry_columns[e];
        const sl_int low = sli_min(iperm[i], iperm[j]), high = sli_max(iperm[i], iperm[j]);
        double sum = 0.0, c;
        for (; k < q->n_entries; k++) {
            const sl_int f = sli_value(q->order[k]);
            const sl_int a = iperm[q->entry_rows[f]], b = iperm[q->entry_columns[f]];
            if (sli_min(a, b) != low || sli_max(a, b) != high) {
                break;
            }
            sum += q->deltas[f];
        }
        c = i != j && q->is_balanced ? sli_edges_balance(q, i, j, sum) : 1.0;
        if (i != j && sum != 0.0) {
            sli_edges_add(q, i, j, c, -sum);
        }
        rows[terms] = sli_keyed(iperm[i], terms);
        q->diagonal[terms++] = sum * c * c;
        if (i != j) {
            rows[terms] = sli_keyed(iperm[j], terms);
            q->diagonal[terms++] = sum / c / c;
        }
    }
    return terms;
}

/* Appends what remains on the diagonal. Returns whether that is much more than the entry of the
 * diagonal in a row of a definite matrix, where changes off the diagonal may be why. */
static int sli_edges_diagonal(sli_rank *q, sl_int terms) {
    const sl_factor *F = q->u.F;
    uint64_t *rows = q->order_scratch;
    const int has_edges = q->V.n_cols > 0 && q->u.sign != 0.0;
    sl_int k;
    int is_heavy = 0;
    sli_sort(rows, terms, q->order);
    for (k = 0; k < terms;) {
        const sl_int row = sli_key(rows[k]);
        double sum = 0.0, size = 0.0;
        for (; k < terms && sli_key(rows[k]) == row; k++) {
            sum += q->diagonal[sli_value(rows[k])];
            size += fabs(q->diagonal[sli_value(rows[k])]);
        }
        if (fabs(sum) > 8.0 * DBL_EPSILON * size) { /* the caller has rounded, too */
            sli_edges_add(q, q->S->perm[row], -1, 1.0, sum);
            is_heavy |= has_edges && !is_heavy && fabs(sum) > SLI_EDGES_HEAVY * fabs(F->D[row]) &&
                        fabs(sum) > SLI_EDGES_HEAVY * sli_update_magnitude(F, row);
        }
    }
    return is_heavy;
}

static void sli_edges_fill(void *data) {
    sli_rank *q = (sli_rank *)data;
    q->V.n_rows = q->S->n;
    q->V.n_cols = 0;
    q->V.p = q->p;
    q->V.i = q->i;
    q->V.x = q->x;
    q->p[0] = 0;
    q->is_balanced = 0;
    sli_edges_sort(q);
    if (sli_edges_diagonal(q, sli_edges_add_all(q))) {
        q->is_balanced = 1;
        q->V.n_cols = 0;
        sli_edges_sort(q);
        (void)sli_edges_diagonal(q, sli_edges_add_all(q));
    }
    q->u.V = &q->V;
    q->u.sigma = q->sigma;
}

static const sli_stage sli_edges_stages[3] = {{sli_edges_layout, sli_edges_fill},
                                              {sli_rank_layout_seeds, sli_rank_sort},
                                              {sli_rank_layout, NULL}};

/* Checks a list of entries. */
static sl_status sli_edges_check(const sl_factor *F, const sl_int *rows, const sl_int *columns,
                                 const double *deltas, sl_int count, sl_stats *stats) {
    sl_int k;
    const sl_status status = sli_argument(F == NULL                      ? "F is NULL"
                                          : count < 0                    ? "count is below 0"
                                          : count > 0 && rows == NULL    ? "rows is NULL"
                                          : count > 0 && columns == NULL ? "columns is NULL"
                                          : count > 0 && deltas == NULL  ? "deltas is NULL"
                                                                         : NULL);
    if (status != SL_OK) {
        return status;
    }
    if (count > INT32_MAX / 4) {
        return sli_refuse(SL_ERR_TOO_LARGE, "count is 2^29 or more");
    }
    for (k = 0; k < count; k++) {
        if (rows[k] < 0 || rows[k] >= F->S->n || columns[k] < 0 || columns[k] >= F->S->n) {
            return sli_fail_at(stats, SL_ERR_ARGUMENT, rows[k], columns[k], deltas[k],
                               "a row or column is out of range");
        }
        if (!sli_is_finite(deltas[k])) {
            return sli_fail_at(stats, SL_ERR_NOT_FINITE, rows[k], columns[k], deltas[k],
                               "a delta is not finite");
        }
    }
    return SL_OK;
}

#endif
