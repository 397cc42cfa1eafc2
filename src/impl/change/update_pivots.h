/* update_pivots.h: the state of a rank-k change, and the pivots that it changes */
#ifndef SLI_CHANGE_UPDATE_PIVOTS_H
#define SLI_CHANGE_UPDATE_PIVOTS_H

#include "change_kernels.h"
#include "update_loss.h"
#include "../analysis/reach.h"
#include "../solve/query.h"

/* L D L' + W M W' = K N K' for W of n x k, column by column [DH01]. With the row y of W and the
 * column l of L that belong to pivot d:
 *
 *     e = d + y' M y,  W := W - l y',  l := l + W b  with b = M y / e,  M := M - M y y' M / e.
 *
 * e is the new pivot. W loses row and column, and is nonzero on the paths of its columns only. M is
 * kept as U diag(alpha) U' with a unit upper triangular U, and updated in this form [Bie76]: so its
 * signs stay those of the changes, and rounding is that of k changes one after the other, times
 * what L^-1 W has grown to: W is swept by the old L alone. */

/* The state of a change. Vectors in a compact vector of their reach, interleaved. */
typedef struct sli_update {
    sl_factor *F;
    const sl_csc *V; /* the vectors: columns of an n x count matrix in the rows of A */
    const double *sigma;
    double sign;     /* of all pivots, 1 or -1; 0: they have both signs */
    int keeps;       /* there is a trial, which keeps what the pass needs */
    int keeps_signs; /* a pivot that changes its sign is refused */
    int is_trial;    /* pivots are checked, and not changed */
    int is_tried;    /* the trial of this pass has succeeded */
    sl_int lanes;    /* that hold the vectors of the pass */
    int kind;
    double most;   /* the largest sum of magnitudes that a pivot of the pass was computed from */
    double loss;   /* of digits in a pivot, which later ones multiply: of pivots of both signs */
    double swept;  /* of several vectors: alpha y^2 of L^-1 W over the sum for the pivot, at most */
    double lost;   /* by the worst row, relative to the magnitudes that are left of it */
    double fall;   /* by at most this much the pass changes the largest |a| */
    sl_int row;    /* the pivot whose row it changes most */
    double least;  /* a smaller pivot may be null, and is refused where it was larger */
    double top;    /* the largest new pivot */
    double low;    /* the least one, where .. */
    int are_usual; /* .. the extremes have shown that all can be taken */
    double entry;  /* the largest |a| that is known of the columns of the pass */
    double growth; /* the largest growth of rows in them */
    sli_reach R;
    sl_int pivot; /* the pivot that was refused, and its value */
    double value;

    sli_ranks *state;
    sli_step *steps; /* of the reach */
    sl_int *rows;
    double *x;             /* lanes for each column of the reach */
    double *gain;          /* for each column: what the pass adds to its sum of magnitudes */
    double *panel;         /* of the current step: in L or, if it has one column, .. */
    double *column;        /* .. a copy with padding */
    double *local;         /* [tile][lane][8]: the rows of the current step */
    double *c;             /* 2 lanes for each column of the current step: y and -b, or .. */
    double *e, *magnitude; /* .. of the reach, if there is a trial, with the new pivots */
    double *trial;         /* of a trial: the compact vector before it */
    sli_rank_one *path;    /* of one vector: the supernodes of its path, .. */
    double *vectors;       /* .. and their vectors */
    ptrdiff_t ahead;       /* bytes that their changes prefetch ahead */
} sli_update;

/* The kernel for passes of `count` vectors. One vector takes another kernel (path.h) where all
 * pivots have one sign. */
SLI_INLINE int sli_update_kind(sl_int count) {
    return count == 1 ? SLI_NRHS_2 : sli_lanes_kind(count);
}

static void sli_update_layout(sli_update *u, sli_block *b, const sli_reach *R, sl_int lanes,
                              int has_trial) {
    const uint64_t many = (uint64_t)lanes;
    uint64_t columns;
    u->state = SLI_TAKE(b, sli_ranks, 1);
    u->steps = SLI_TAKE(b, sli_step, R->count);
    u->rows = SLI_TAKE(b, sl_int, R->n_rows);
    u->x = SLI_TAKE(b, double, many *(uint64_t)R->columns);
    u->gain = SLI_TAKE(b, double, R->columns);
    u->column = SLI_TAKE(b, double, SLI_TILE *(uint64_t)sli_tiles(R->tallest));
    u->local = SLI_TAKE(b, double, many *SLI_TILE *((uint64_t)sli_tiles(R->tallest) + 4));
    u->keeps = has_trial;
    columns = (uint64_t)(has_trial ? R->columns : R->widest + SLI_TILE);
    u->c = SLI_TAKE(b, double, SLI_TILE + 2 * many * columns);
    u->e = SLI_TAKE(b, double, has_trial ? R->columns : 0);
    u->magnitude = SLI_TAKE(b, double, has_trial ? R->columns : 0);
    u->trial = SLI_TAKE(b, double, has_trial ? many *(uint64_t)R->columns : 0);
}

/* Finds the panel of a step. */
static void sli_update_open(sli_update *u, const sli_step *step) {
    u->panel = (double *)u->F->values + step->panel;
    if (step->width == 1) {
        sli_column_pad(u->panel, step->below, u->column);
        u->panel = u->column;
    }
}

/* Puts it back. */
static void sli_update_close(sli_update *u, const sli_step *step) {
    if (step->width == 1) {
        SLI_COPY((double *)u->F->values + step->panel, u->column, 1 + step->below);
    }
}

/* Is pivot k, now d, null? magnitude: of its change alone. */
static int sli_update_is_null(const sl_factor *F, sl_int k, double d, double magnitude) {
    const double tolerance = sli_rule_tolerance(&F->rule, k);
    const double known = F->extents[F->S->super_of[k]].magnitude;
    if (sli_is_null(d, magnitude, tolerance)) {
        return 1;
    }
    return sli_is_null(d, magnitude + known, tolerance) &&
           sli_is_null(d, magnitude + sli_update_magnitude(F, k), tolerance);
}

/* Counts a pivot that changed from d to e. */
SLI_INLINE void sli_update_count(sl_factor_info *info, double d, double e) {
    const double size = fabs(e);
    info->positive += (e > 0.0) - (d > 0.0);
    info->negative += (e < 0.0) - (d < 0.0);
    info->pivot_min = size < info->pivot_min ? size : info->pivot_min;
    info->pivot_max = size > info->pivot_max ? size : info->pivot_max;
}

/* Where a pivot grows, what is added to a row of L cancels the row: the error is that of the old
 * row, times the new pivot. An entry of the row is at most the root of the largest |l d l| over
 * |d|, which is not 0: a factor with null pivots is not changed. */
static double sli_update_cancelled(const sl_factor *F, double d, double e) {
    const sl_factor_info *info = &F->stats.factor;
    const double largest = fmax(info->growth, 1.0) * fmax(info->entry_max, F->history.scale);
    return fabs(e) > 4.0 * fabs(d) ? fabs(e) * sqrt(largest / fabs(d)) : 0.0;
}

/* Takes pivot k from d to e. magnitude: the sum of the magnitudes that e was computed from. */
SLI_COLD static sl_status sli_update_take(sli_update *u, sl_int k, double e, double magnitude) {
    sl_factor *F = u->F;
    const double d = F->D[k];
    u->value = e;
    u->pivot = k;
    if (!u->is_tried && !sli_is_finite(e)) {
        return sli_refuse(SL_ERR_NOT_FINITE, NULL); /* sli_rank_run names the pivot */
    }
    if (!u->is_tried &&
        (fabs(e) < DBL_MIN || (u->keeps_signs && (e < 0.0) != (d < 0.0)) ||
         (fabs(e) < fabs(d) && (fabs(e) <= u->least || sli_update_is_null(F, k, e, magnitude))))) {
        return sli_refuse(SL_ERR_PIVOT, NULL);
    }
    if (!u->is_trial) {
        u->most = fmax(u->most, fmax(magnitude, sli_update_cancelled(F, d, e)));
        u->top = fabs(e) > u->top ? fabs(e) : u->top;
        sli_update_count(&F->stats.factor, d, e);
        F->D[k] = e;
    }
    return SL_OK;
}

/* Takes `count` pivots from k on, as a kernel computed them, and adds to what their rows have lost.
 * magnitudes: the sums of magnitudes; NULL: of one vector. Nearly always the extremes show that all
 * of them can be taken. */
static sl_status sli_update_take_all(sli_update *u, sl_int k, sl_int count, const double *e,
                                     const double *magnitudes) {
    sl_factor *F = u->F;
    sl_factor_info *info = &F->stats.factor;
    const double known = F->extents[F->S->super_of[k]].magnitude;
    double *const loss = u->sign != 0.0 && !u->is_trial ? F->history.loss + k : NULL;
    double *D = F->D + k, least = DBL_MAX, top = 0.0, most = 0.0;
    int are_usual = 1, shrink = 0;
    sl_status status = SL_OK;
    sl_int j;
    for (j = 0; j < count; j++) {
        const double d = D[j], size = fabs(e[j]), before = fabs(d);
        const double magnitude = magnitudes != NULL ? magnitudes[j] : before + fabs(e[j] - d);
        are_usual &= (size <= 4.0 * before) & ((e[j] < 0.0) == (d < 0.0));
        shrink |= size < before;
        least = size < least ? size : least;
        top = size > top ? size : top;
        most = magnitude > most ? magnitude : most;
        if (loss != NULL) {
            loss[j] += magnitude;
        }
    }
    if (are_usual && least >= DBL_MIN && top <= DBL_MAX &&
        (!shrink || u->is_tried ||
         (least > u->least && !sli_is_null(least, most + known, F->rule.null_tolerance)))) {
        u->low = least < u->low ? least : u->low;
        u->top = top > u->top ? top : u->top;
        u->most = most > u->most ? most : u->most;
        if (!u->is_trial) {
            SLI_COPY(D, e, count);
            info->pivot_min = least < info->pivot_min ? least : info->pivot_min;
            info->pivot_max = top > info->pivot_max ? top : info->pivot_max;
        }
        return SL_OK;
    }
    u->are_usual = 0;
    for (j = 0; j < count && status == SL_OK; j++) {
        const double d = D[j], size = fabs(e[j]);
        const double magnitude = magnitudes != NULL ? magnitudes[j] : fabs(d) + fabs(e[j] - d);
        if (e[j] != d || magnitude != size) {
            status = sli_update_take(u, k + j, e[j], magnitude);
        }
    }
    return status;
}

/* Notes what the rows of a vector that makes their a_kk smaller have lost, after its pass: no other
 * row has less left of it. The change of a_kk counts, from which that of the pivot may differ by
 * many digits. Nearly always the pivot shows that a row has not lost more than drift says. */
static void sli_update_lose(sli_update *u, sl_int v) {
    const sl_factor *F = u->F;
    const sl_csc *V = u->V;
    const double sigma = u->sigma == NULL ? 1.0 : u->sigma[v];
    const double bar = fmax(SLI_LOSS_SMALL, F->history.drift * (2.0 / DBL_EPSILON));
    sl_int p;
    for (p = V->p[v]; p < V->p[v + 1] && u->sign * sigma < 0.0; p++) {
        const sl_int k = F->S->iperm[V->i[p]];
        double *loss = &F->history.loss[k];
        if (V->x[p] == 0.0) {
            continue;
        }
        *loss += fabs(sigma) * V->x[p] * V->x[p];
        if (*loss > fmax(bar, u->lost) * fabs(F->D[k])) {
            u->lost = fmax(u->lost, *loss / sli_update_magnitude(F, k));
        }
    }
}

#endif
