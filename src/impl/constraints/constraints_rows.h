/* constraints_rows.h: rows pinned together: up to 8 of them share a sweep */
#ifndef SLI_CONSTRAINTS_ROWS_H
#define SLI_CONSTRAINTS_ROWS_H

#include "constraints_capacitance.h"

/* Up to so many rows are swept one by one. */
#define SLI_CONSTRAINTS_SINGLY 4

/* Sweeps the k-th block of rows, which starts at the first-th of the sorted ones, and makes its
 * pins. They follow those of P in the caller's order. */
static sl_status sli_constraints_sweep_block(sl_constraints *P, sli_inverse_block *q, sl_int k,
                                             sl_int first, sl_stats *stats) {
    const uint64_t *order = q->kept.order + first;
    const sli_forward *f = &q->sweeps[k].forward;
    const double one = 1.0;
    sl_status status = SL_OK;
    sl_int j, i;
    sli_swept_block_make(&q->sweeps[k], q->F, &q->kept, first, (sl_int)q->kept.block_size[k], NULL);
    for (j = 0; j < q->sweeps[k].block_size && status == SL_OK; j++) {
        const sl_int *row = &q->kept.rows[sli_value(order[j])];
        const sli_equality e = sli_equality_of(row, &one, 1);
        sli_pin **pin = &P->pins[P->n_pins + sli_value(order[j])];
        status = j > 0 && sli_key(order[j]) == sli_key(order[j - 1]) /* twice: no lane of its own */
                     ? sli_fail_at(stats, SL_ERR_PIVOT, *row, -1, 0.0, sli_pinned_twice)
                     : sli_pin_create(pin, P, &e, 0, stats);
        if (status == SL_OK) {
            sli_pin_clear_nulls(P, *pin, &f->reach, f->y, f->lanes);
        }
    }
    sli_forward_divide(q->F, f, q->divided);
    for (j = 0; j < q->sweeps[k].block_size && status == SL_OK; j++) {
        sli_pin *pin = P->pins[P->n_pins + sli_value(order[j])];
        sli_intersection m = sli_intersection_of(&pin->R, &f->reach);
        while (sli_intersection_next(&m)) {
            for (i = 0; i < m.count; i++) {
                const ptrdiff_t from = (ptrdiff_t)(m.in_b + i) * f->lanes + j;
                pin->y[m.in_a + i] = f->y[from];
                pin->u[m.in_a + i] = q->divided[from];
            }
        }
    }
    return status;
}

/* Fills the entries of K between pin p and the rows of a block. sums: of their lanes. */
static void sli_constraints_fill_entries(const sl_constraints *P, const sli_inverse_block *q,
                                         sl_int p, const sli_swept_block *b, const double *sums) {
    sl_int j;
    for (j = 0; j < b->block_size; j++) {
        const sl_int r = P->n_pins + sli_value(q->kept.order[b->first + j]);
        P->K[(size_t)sli_max(p, r) * (size_t)P->capacity + (size_t)sli_min(p, r)] =
            sums[j] + sli_pin_nulls_dot(P->pins[p], P->pins[r]) / P->delta;
    }
}

/* Makes the pins of all rows of q, whose sweeps are all kept, and factors their rows of K. */
static sl_status sli_constraints_push_blocks(sl_constraints *P, sli_inverse_block *q,
                                             sl_stats *stats) {
    SLI_ALIGNED(double sums[SLI_LANES_MAX * SLI_LANES_MAX]);
    sl_status status = SL_OK;
    sl_int k, m, j, first = 0;
    for (k = 0; k < q->kept.n_blocks && status == SL_OK; k++) {
        const sli_swept_block *b = &q->sweeps[k];
        status = sli_constraints_sweep_block(P, q, k, first, stats);
        for (j = 0; j < P->n_pins && status == SL_OK; j++) {
            sli_pin_dot(P->pins[j], &b->forward.reach, b->forward.y, b->forward.lanes, sums);
            sli_constraints_fill_entries(P, q, j, b, sums);
        }
        for (m = 0; m <= k && status == SL_OK; m++) {
            const sli_swept_block *a = &q->sweeps[m];
            sli_cross_sums(q->F, &a->forward, &b->forward, q->divided, sums);
            for (j = 0; j < a->block_size; j++) {
                sli_constraints_fill_entries(P, q,
                                             P->n_pins + sli_value(q->kept.order[a->first + j]), b,
                                             sums + SLI_LANES_MAX * j);
            }
        }
        first += b->block_size;
    }
    for (k = 0; k < q->kept.count && status == SL_OK; k++) {
        status = sli_constraints_factor(P, P->n_pins + k);
        if (status != SL_OK) {
            (void)sli_constraints_refuse(P, status, q->kept.rows[k], 1, stats);
        }
    }
    return status;
}

/* Pins rows. On error P is as before. */
static sl_status sli_constraints_push_rows(sl_constraints *P, const sl_int *rows, sl_int count,
                                           sl_stats *stats) {
    const double one = 1.0;
    const sl_int before = P->n_pins;
    sl_work W = sli_work_own(&P->allocator);
    sl_status status = sli_constraints_grow(P, count);
    sl_int done = 0, k;
    while (done < count && status == SL_OK) {
        sl_int m = sli_min(count - done, SLI_LANES_MAX * SLI_BLOCK_KEPT);
        sli_inverse_block q;
        if (m <= SLI_CONSTRAINTS_SINGLY) {
            const sli_equality e = sli_equality_of(&rows[done], &one, 1);
            status = sli_constraints_push(P, &e, stats);
            done++;
            continue;
        }
        for (;; m = m / 2) { /* so many that all sweeps are kept */
            q = sli_inverse_all_pairs_of(P->F, rows + done, m);
            status = sli_work_stages(&W, sli_inverse_block_stages, 2, &q);
            if (status != SL_OK || q.kept.n_blocks <= SLI_BLOCK_KEPT) {
                break;
            }
        }
        SLI_ZERO(P->pins + P->n_pins, m);
        status = status == SL_OK ? sli_constraints_push_blocks(P, &q, stats) : status;
        for (k = P->n_pins; k < P->n_pins + m; k++) {
            if (status == SL_OK) {
                sli_constraints_count_nulls(P, P->pins[k], 1);
            } else if (P->pins[k] != NULL) {
                sli_pin_free(P, P->pins[k]);
            }
        }
        P->n_pins += status == SL_OK ? m : 0;
        done += m;
    }
    while (status != SL_OK && P->n_pins > before) {
        sli_pin *last = P->pins[--P->n_pins];
        sli_constraints_count_nulls(P, last, 0);
        sli_pin_free(P, last);
    }
    sli_free(&W.allocator, W.block);
    return status;
}

#endif
