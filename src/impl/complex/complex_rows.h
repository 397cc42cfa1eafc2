/* complex_rows.h: plans whose sets count complex rows, the determinant */
#ifndef SLI_COMPLEX_COMPLEX_ROWS_H
#define SLI_COMPLEX_COMPLEX_ROWS_H

#include "hermitian.h"
#include "../factor/factor_query.h"
#include "../solve/plan.h"

/* The real rows of a set of complex rows. */
typedef struct sli_complex_set {
    const sl_int *rows; /* of the caller; NULL: all, if that is allowed */
    sl_int count;
    sl_int *real; /* 2 count */
} sli_complex_set;

/* Checks a set against the real rows n. A NULL set has no rows of its own. */
static sl_status sli_complex_check(sl_int n, const sli_complex_set *set) {
    return n % 2 != 0 ? sli_argument("the system is not that of a complex matrix: n is odd")
           : set->rows != NULL && set->count > SLI_ROWS_MAX / 2
               ? sli_refuse(SL_ERR_TOO_LARGE, "a set of more than 2^30 - 4 rows")
               : SL_OK;
}

static void sli_complex_layout(sli_complex_set *set, sli_block *b) {
    set->real = SLI_TAKE(b, sl_int, set->rows == NULL ? 0 : 2 * (size_t)set->count);
}

/* Two sets of complex rows. */
typedef struct sli_complex_sets {
    sli_complex_set first, second;
    unsigned char *memory;
} sli_complex_sets;

static sli_complex_sets sli_complex_sets_of(const sl_int *first, sl_int n_first,
                                            const sl_int *second, sl_int n_second) {
    sli_complex_sets c;
    SLI_CLEAR(c);
    c.first.rows = first;
    c.first.count = n_first;
    c.second.rows = second;
    c.second.count = n_second;
    return c;
}

/* Checks and expands one of the sets of a system of n complex rows. */
static sl_status sli_complex_fill(const sli_complex_set *set, sl_int n, sl_stats *stats) {
    sl_int k;
    for (k = 0; k < set->count && set->rows != NULL; k++) {
        const sl_int row = set->rows[k];
        if (row < 0 || row >= n) {
            return sli_refuse_row(stats, row);
        }
        set->real[2 * (size_t)k] = 2 * row;
        set->real[2 * (size_t)k + 1] = 2 * row + 1;
    }
    return SL_OK;
}

/* Allocates and expands the sets, whose rows are those of a real system of n rows. */
static sl_status sli_complex_sets_create(sli_complex_sets *c, sl_int n, const sl_allocator *a,
                                         sl_stats *stats) {
    sli_block b = {NULL, 0};
    sl_status status = sli_complex_check(n, &c->first);
    status = status == SL_OK ? sli_complex_check(n, &c->second) : status;
    SLI_LAYOUT(&b, a, status) {
        sli_complex_layout(&c->first, &b);
        sli_complex_layout(&c->second, &b);
    }
    if (status != SL_OK) {
        return status;
    }
    c->memory = b.base;
    status = sli_complex_fill(&c->first, n / 2, stats);
    status = status == SL_OK ? sli_complex_fill(&c->second, n / 2, stats) : status;
    if (status != SL_OK) {
        sli_free(a, c->memory);
    }
    return status;
}

/* The expanded set for a call that takes NULL for all rows: an empty set has no array. */
static const sl_int *sli_complex_real(const sli_complex_set *set) {
    return set->rows == NULL || set->count == 0 ? set->rows : set->real;
}

SL_API sl_status sl_complex_plan_create(sl_plan **out, const sl_symbolic *S, const sl_int *bset,
                                        sl_int nb, const sl_int *xset, sl_int nx,
                                        const sl_options *opt, sl_stats *stats) {
    const sl_allocator a = sli_allocator(opt);
    sli_complex_sets c;
    sl_status status;
    sli_stats_clear_error(stats);
    status = sli_begin(out);
    status = status == SL_OK
                 ? sli_argument(S == NULL ? "S is NULL" : sli_options_wrong(opt, SLI_READS_REGION))
                 : status;
    status = status == SL_OK ? sli_list(&bset, &nb, S->n / 2) : status;
    status = status == SL_OK ? sli_list(&xset, &nx, S->n / 2) : status;
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    c = sli_complex_sets_of(bset, nb, xset, nx);
    status = sli_complex_sets_create(&c, S->n, &a, stats);
    if (status == SL_OK) {
        status = sl_plan_create(out, S, sli_complex_real(&c.first), 2 * nb,
                                sli_complex_real(&c.second), 2 * nx, opt, stats);
        sli_free(&a, c.memory);
    }
    return sli_report(stats, status);
}

SL_API sl_status sl_complex_logdet(const sl_factor *F, double *log_abs_det, double *sign) {
    const sli_complex_set none = {NULL, 0, NULL};
    sl_status status = F == NULL ? SL_OK : sli_complex_check(F->S->n, &none);
    status = status == SL_OK ? sl_factor_logdet(F, log_abs_det, sign) : status;
    if (status == SL_OK) {
        *log_abs_det *= 0.5;
        *sign = F->stats.factor.negative / 2 % 2 == 0 ? 1.0 : -1.0;
    }
    return status;
}

#endif
