/* pivot_suspects.h: pivots that the tolerance may have missed, where null pivots are refused */
#ifndef SLI_FACTOR_PIVOT_SUSPECTS_H
#define SLI_FACTOR_PIVOT_SUSPECTS_H

#include "components.h"
#include "pivot_check.h"
#include "storage_type.h"

/* The rounding error that the heaviest rows of a matrix may cause in a pivot, relative to their
 * diagonal entries. Over 80,000 meshes with weak bridges and slivers, pivots of the wrong sign
 * stayed below (128 + n/4) epsilon. The factor 16 leaves a margin. */
static double sli_null_rounding(sl_int n) {
    return 16.0 * (64.0 + n / 8) * DBL_EPSILON;
}

/* Where null pivots are refused: may a root of the elimination forest be a null pivot that the
 * tolerance missed, because its rounding error comes from heavier rows? Reads D only, and counts
 * the pivots for the report. */
static int sli_null_is_suspected(sl_factor *F) {
    const sl_symbolic *S = F->S;
    const double rounding = sli_null_rounding(S->n);
    sl_int root, first;
    if (F->rule.replaces || F->rule.null_tolerance < 0.0) {
        return 0;
    }
    sli_count_pivots(F, S->n);
    if (F->E == NULL && F->stats.factor.pivot_min > rounding * F->stats.factor.pivot_max) {
        return 0; /* no pivot is */
    }
    for (root = S->n_supers - 1; root >= 0; root = first - 1) {
        const sl_int last = S->super_first[root + 1] - 1;
        const double size = fabs(F->D[last]);
        first = S->first_descendant[root];
        if (size <= rounding * F->stats.factor.pivot_max) { /* of all trees */
            const sl_int begin = S->super_first[first];
            if (size <= rounding * sli_spread_of(F->D + begin, last + 1 - begin).most) {
                return 1;
            }
        }
    }
    return 0;
}

/* n times `size` bytes in which pivots are judged; NULL: there is no memory. */
SLI_COLD static void *sli_judge_memory(sl_factor *F, sl_int n, size_t size) {
    sli_block b = {NULL, 0};
    if (F->work.is_worker) {
        F->work.is_worker = 2;
        return NULL;
    }
    (void)sli_take(&b, (uint64_t)n, size);
    return sli_block_alloc(&b, &F->allocator) == SL_OK ? b.base : NULL;
}

/* Refuses pivot k, which there is no memory to judge. */
SLI_COLD static sl_status sli_judge_not(const sl_factor *F, sl_int k, sli_failure *failure) {
    (void)sli_fail(failure, SL_ERR_PIVOT, F->S->super_of[k], k, -1, F->D[k]);
    failure->bound = -1.0;
    return failure->status;
}

/* The bytes a row that sli_null_suspects_find works in. */
#define SLI_SUSPECT_ROW (sizeof(sli_null_row) + sizeof(double) + sizeof(sl_int))

/* Does it fit in L? */
static int sli_null_suspect_fits(const sl_factor *F) {
    const sl_off entries = F->S->panel_begin[F->S->n_supers] >> F->type->half;
    return (double)entries * (double)F->type->value_bytes >= (double)F->S->n * SLI_SUSPECT_ROW;
}

/* Lists the last pivots that are suspected, of components that have constants as a null vector:
 * *list, of the allocator; NULL: none. Returns their number. Overwrites L unless L is too short. */
SLI_COLD static sl_int sli_null_suspects_find(sl_factor *F, const sli_source *from, sl_int **list,
                                              sli_failure *failure) {
    const sl_symbolic *S = F->S;
    const double rounding = sli_null_rounding(S->n);
    void *room = sli_null_suspect_fits(F) ? NULL : sli_judge_memory(F, S->n, SLI_SUSPECT_ROW);
    sli_null_row *rows = (sli_null_row *)(room == NULL ? F->values : room);
    double *most = (double *)(void *)(rows + S->n); /* n: of a last pivot: the heaviest one */
    sl_int *last = (sl_int *)(void *)(most + S->n), k, count = 0;
    sli_null_walk w;
    if (room == NULL && !sli_null_suspect_fits(F)) {
        (void)sli_judge_not(F, S->n - 1, failure);
        return 0;
    }
    w = sli_null_walk_begin(S, 0, rows, NULL, NULL);
    sli_null_add_map(&w, S, from, NULL);
    sli_null_components(&w, S, NULL, last, most);
    for (k = 0; k < S->n; k++) {
        const double size = fabs(F->D[k]) > rows[k].size ? fabs(F->D[k]) : rows[k].size;
        most[last[k]] = size > most[last[k]] ? size : most[last[k]];
    }
    for (k = 0; k < S->n; k++) { /* last[0 .. count-1] := the list */
        if (last[k] == k && most[k] <= DBL_MAX && fabs(F->D[k]) <= rounding * most[k]) {
            last[count++] = k;
        }
    }
    if (count > 0) {
        *list = (sl_int *)sli_judge_memory(F, count, sizeof(sl_int));
        if (*list == NULL) {
            (void)sli_judge_not(F, last[0], failure);
            count = 0;
        }
        for (k = 0; k < count; k++) {
            (*list)[k] = last[k];
        }
    }
    sli_free(&F->allocator, room);
    return count;
}

#endif
