/* loss.h: a bound on what entries of the inverse lose when they are computed from other entries */
#ifndef SLI_INVERSE_LOSS_H
#define SLI_INVERSE_LOSS_H

#include "traversal_run.h"

/* Selected inversion computes z_jj = 1/d_j + l' Z l from a column l of L and entries Z of the rows
 * below, and a solve in a region ends with the same product. An error E in Z becomes l' E l. If
 * pivots of both signs let L grow, l' Z l cancels and l' E l does not: the error grows with the
 * square of pivot growth, that of a solve with growth itself. With
 *
 *     s_j^2 = 1/|d_j| + (sum of |l_ij| s_i over the rows below)^2
 *
 * |z_jk| <= s_j s_k for all entries of a front, and errors of epsilon s_i s_k in the rows below
 * become ones of about epsilon s_j s_k. Scaling A by rows and columns scales both sides alike;
 * growth does not notice a bad column beside large entries. In 27,000 random systems
 * (tests/lib/judge_systems.h), wherever selected inversion lost 100 times what a solve did, its
 * error was at most epsilon max s^2. So it is used if that is small beside an entry of the inverse:
 * that of the row with the largest s. Meshes with constraints pass with a shift of 1e-2, where
 * growth is 200, and fail with 1e-4.
 *
 * A tree whose pivots have one sign is definite, and the bound not needed: it would multiply along
 * long paths. */
#define SLI_LOSS_LIMIT 1e-10  /* beyond it entries are computed in another way; */
#define SLI_LOSS_REFUSED 1e-8 /* a region has none, and is refused */

/* The supernodes to judge: a list in postorder, or all from `first` on. */
typedef struct sli_loss {
    const sl_factor *F;
    const sl_int *supers, *parent; /* count: as in a traversal; NULL: there is no list */
    sl_int first, count;
    /* of rows below outside of these supernodes: the square of their s; 0: there are none */
    double outside;
    double limit;   /* relative to the largest entry */
    sl_off *begin;  /* count + 1: offsets of the fronts in s */
    double *s;      /* of the columns and the rows below of each supernode */
    double *y, *up; /* a front: of the diagonal entry */
} sli_loss;

/* Does D have both signs, so that entries may be lost? */
SLI_INLINE int sli_has_both_signs(const sl_factor *F) {
    return F->stats.factor.positive > 0 && F->stats.factor.negative > 0;
}

SLI_INLINE sl_int sli_loss_super(const sli_loss *q, sl_int k) {
    return q->supers == NULL ? q->first + k : q->supers[k];
}

/* The position of the parent of the k-th supernode, or -1. */
SLI_INLINE sl_int sli_loss_parent(const sli_loss *q, sl_int k) {
    const sl_int up =
        q->supers == NULL ? q->F->S->super_parent[q->first + k] - q->first : q->parent[k];
    return up >= 0 && up < q->count ? up : -1;
}

/* Doubles of the front of a supernode: whole tiles. */
SLI_INLINE sl_off sli_loss_height(const sli_step *step) {
    return (sl_off)SLI_TILE * sli_tiles(step->width + step->below);
}

static void sli_loss_layout(sli_loss *q, sli_block *b) {
    const sl_symbolic *S = q->F->S;
    const uint64_t tallest = (uint64_t)SLI_TILE * (uint64_t)sli_tiles(S->tallest);
    uint64_t size = 0;
    sl_int k;
    for (k = 0; k < q->count; k++) {
        size += (uint64_t)sli_loss_height(&S->steps[sli_loss_super(q, k)]);
    }
    q->begin = SLI_TAKE(b, sl_off, (uint64_t)q->count + 1);
    q->s = SLI_TAKE(b, double, size);
    q->y = SLI_TAKE(b, double, tallest);
    q->up = SLI_TAKE(b, double, tallest);
}

/* The supernodes of a traversal. */
static void sli_loss_layout_traversal(sli_loss *q, sli_block *b, const sl_factor *F,
                                      const sli_traversal *traversal) {
    q->F = F;
    q->limit = SLI_LOSS_LIMIT;
    q->supers = traversal->supers;
    q->parent = traversal->forest.parent;
    q->count = traversal->forest.count;
    sli_loss_layout(q, b);
}

/* A tile of a column of L in another storage or without padding, as doubles. */
SLI_NOINLINE static const double *sli_loss_widen(const sl_factor *F, sl_off at, sl_int rows,
                                                 double *room) {
    sl_int r;
    for (r = 0; r < SLI_TILE; r++) {
        room[r] = r < rows ? sli_entry(F, at + r) : 0.0;
    }
    return room;
}

/* Column j of row tile t of a supernode, in double; room: for a tile in another storage. Entries on
 * and above the diagonal and in the padding are 0. */
SLI_INLINE const double *sli_loss_tile(const sl_factor *F, const sli_step *step, sl_int t, sl_int j,
                                       double *room) {
    const sl_off at = step->panel + sli_tile_offset(step->width, t) + (sl_off)SLI_TILE * j;
    return F->type->entry == NULL && step->width > 1
               ? (const double *)F->values + at
               : sli_loss_widen(F, at, step->width + step->below - SLI_TILE * t, room);
}

/* The sum of |l(r)| s(r) over a tile. */
SLI_INLINE double sli_loss_sum(const double *l, const double *s) {
    return ((fabs(l[0]) * s[0] + fabs(l[1]) * s[1]) + (fabs(l[2]) * s[2] + fabs(l[3]) * s[3])) +
           ((fabs(l[4]) * s[4] + fabs(l[5]) * s[5]) + (fabs(l[6]) * s[6] + fabs(l[7]) * s[7]));
}

/* x(r) -= L(r, j) y in the rows below column j. */
static void sli_loss_subtract(const sl_factor *F, const sli_step *step, sl_int j, double *x,
                              double y) {
    double room[SLI_TILE];
    sl_int t, r;
    for (t = j / SLI_TILE; t < sli_tiles(step->width + step->below); t++) {
        const double *l = sli_loss_tile(F, step, t, j, room);
        for (r = 0; r < SLI_TILE; r++) {
            x[SLI_TILE * (ptrdiff_t)t + r] -= l[r] * y;
        }
    }
}

/* (A^-1)_kk by a forward sweep along the path of pivot k. */
static double sli_loss_diagonal(const sli_loss *q, sl_int k) {
    const sl_factor *F = q->F;
    const sl_symbolic *S = F->S;
    sl_int s = S->super_of[k], up, j = k - S->super_first[s], i;
    double z = 0.0, *y = q->y, *next = q->up;
    SLI_ZERO(y, sli_loss_height(&S->steps[s]));
    y[j] = 1.0;
    for (; s != -1; s = up, j = 0) {
        const sli_step *step = &S->steps[s];
        double *t = y;
        for (; j < step->width; j++) {
            z += y[j] * (y[j] / F->D[step->column + j]);
            sli_loss_subtract(F, step, j, y, y[j]);
        }
        up = S->super_parent[s];
        if (up != -1) {
            SLI_ZERO(next, sli_loss_height(&S->steps[up]));
            for (i = 0; i < step->below; i++) {
                next[S->relative[S->rows_begin[s] + i]] = y[step->width + i];
            }
        }
        y = next;
        next = t;
    }
    return z;
}

/* What is known of the current tree. */
typedef struct sli_loss_tree {
    double most; /* the largest s .. */
    sl_int at;   /* .. and its pivot */
    int signs;   /* of its pivots: 1 and 2 */
} sli_loss_tree;

/* Is the loss in a tree small? False for NaN. */
static int sli_loss_judge(const sli_loss *q, const sli_loss_tree *tree) {
    const double loss = DBL_EPSILON * tree->most * tree->most;
    return (tree->signs != 3 && q->outside == 0.0) || loss <= q->limit * q->outside ||
           loss <= q->limit * fabs(sli_loss_diagonal(q, tree->at));
}

/* Computes s for the columns of the k-th supernode, whose rows below have it; before, it is 0. The
 * panel is read once, from its end. */
static void sli_loss_front(const sli_loss *q, sl_int k, sli_loss_tree *tree) {
    const sli_step *step = &q->F->S->steps[sli_loss_super(q, k)];
    double *s = q->s + q->begin[k], *sums = q->y, room[SLI_TILE];
    sl_int t, j;
    SLI_ZERO(sums, step->width);
    for (t = sli_tiles(step->width + step->below) - 1; t >= 0; t--) {
        for (j = sli_min(step->width, SLI_TILE * (t + 1)) - 1; j >= 0; j--) {
            const double d = q->F->D[step->column + j];
            sums[j] += sli_loss_sum(sli_loss_tile(q->F, step, t, j, room), s + SLI_TILE * t);
            if (j < SLI_TILE * t) {
                continue;
            }
            s[j] = sqrt(1.0 / fabs(d) + sums[j] * sums[j]);
            tree->signs |= fabs(d) == SLI_NULL_PIVOT ? 0 : d > 0.0 ? 1 : 2;
            if (!(s[j] <= tree->most)) { /* NaN stays */
                tree->most = s[j];
                tree->at = step->column + j;
            }
        }
    }
}

/* Is the loss small in every tree? */
static int sli_loss_is_small(sli_loss *q) {
    const sl_symbolic *S = q->F->S;
    sli_loss_tree tree = {0.0, 0, 0};
    sl_int k, i;
    int is_small = 1;
    q->begin[0] = 0;
    for (k = 0; k < q->count; k++) {
        q->begin[k + 1] = q->begin[k] + sli_loss_height(&S->steps[sli_loss_super(q, k)]);
    }
    SLI_ZERO(q->s, q->begin[q->count]);
    for (k = q->count - 1; k >= 0 && is_small; k--) {
        const sl_int s = sli_loss_super(q, k), up = sli_loss_parent(q, k);
        double *below = q->s + q->begin[k] + S->steps[s].width;
        if (k > 0) {
            sli_traverse_prefetch(q->F, sli_loss_super(q, k - 1));
        }
        if (up == -1 && tree.signs != 0) {
            is_small = sli_loss_judge(q, &tree);
            SLI_CLEAR(tree);
        }
        for (i = 0; i < S->steps[s].below; i++) {
            below[i] = up == -1 ? sqrt(q->outside)
                                : q->s[q->begin[up] + S->relative[S->rows_begin[s] + i]];
        }
        sli_loss_front(q, k, &tree);
    }
    return is_small && sli_loss_judge(q, &tree);
}

#endif
