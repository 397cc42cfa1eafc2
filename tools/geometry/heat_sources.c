/* heat_sources.c: what several sources give off so that all of them are equally warm */
#include "heat_sources.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_STEPS = 100 };

/* Of the mean square of 1 - u. Directions of gradients need no more digits. */
static const double tolerance = 1e-10;

static double dot(const double *x, const double *y, sl_int n) {
    double sum = 0;
    for (sl_int k = 0; k < n; k++) {
        sum += x[k] * y[k];
    }
    return sum;
}

/* Conjugate gradients for G b = 1, where G is the part of the inverse of M + t L in the rows and
 * columns of the sources. r, p, q: scratch of count. */
static sl_status iterate(double *b, const heat_solver *s, const sl_plan *plan, sl_int count,
                         double *scratch) {
    double *r = scratch, *p = r + count, *q = p + count, before = count;
    sl_status status = SL_OK;
    for (sl_int k = 0; k < count; k++) {
        b[k] = 0;
        r[k] = p[k] = 1;
    }
    for (int step = 0; step < MOST_STEPS && status == SL_OK; step++) {
        status = sl_plan_solve(plan, s->heat, q, (size_t)count, p, (size_t)count, 1, s->work);
        const double curvature = status == SL_OK ? dot(p, q, count) : 0;
        const double length = curvature > 0 ? before / curvature : 0;
        for (sl_int k = 0; k < count; k++) {
            b[k] += length * p[k];
            r[k] -= length * q[k];
        }
        const double after = dot(r, r, count);
        if (!(after > tolerance * count) || length == 0) {
            break;
        }
        for (sl_int k = 0; k < count; k++) {
            p[k] = r[k] + after / before * p[k];
        }
        before = after;
    }
    return status;
}

sl_status heat_sources_balance(double *b, const heat_solver *s, const sl_region *region,
                               const sl_int *sources, sl_int count) {
    sl_plan *plan = NULL;
    sl_options opt = {0};
    double *scratch = (double *)malloc(3 * ((size_t)count + 1) * sizeof *scratch);
    opt.region = region;
    sl_status status = scratch != NULL ? SL_OK : SL_ERR_MEMORY;
    if (status == SL_OK) {
        status = sl_plan_create(&plan, s->S, sources, count, sources, count, &opt, NULL);
    }
    if (status == SL_OK) {
        status = iterate(b, s, plan, count, scratch);
    }
    sl_plan_free(plan);
    free(scratch);
    return status;
}
