/* parts.h: half solves: the factors of P A P' = L D L' applied one by one, full and local */
#ifndef SLI_ACCURACY_PARTS_H
#define SLI_ACCURACY_PARTS_H

#include "../../public/parts.h"
#include "../solve/plan.h"

/* A call in progress. One vector over one reach serves all parts: q has it as both of its reaches.
 * The kernel of the backward sweep divides by D; it is given steps whose columns are those of their
 * supernode, and as many ones. */
typedef struct sli_parts {
    const sl_factor *F;
    unsigned parts;
    int is_product;
    sli_query q;
    unsigned char *memory; /* vectors of a block */
    sli_step *steps;       /* those of the reach, for the backward kernel */
    double *ones;          /* as many as the widest supernode has columns */
    sl_int *identity;      /* 0, 1, ..., for a side in the order of the reach */
} sli_parts;

/* The query of a call: a side without its permutation has all rows of the reach. */
static sli_query sli_parts_query(const sli_query *from, const sli_reach *R, int takes_bset,
                                 int gives_xset) {
    sli_query q = *from;
    q.forward = q.backward = *R;
    q.is_shared = 1;
    q.b_repeats = takes_bset && from->b_repeats;
    q.nb = takes_bset ? from->nb : R->columns;
    q.nx = gives_xset ? from->nx : R->columns;
    q.b_index = takes_bset ? from->b_index : NULL;
    q.x_index = gives_xset ? from->x_index : NULL;
    return q;
}

static void sli_parts_layout(sli_parts *p, sli_block *b, sl_int nrhs) {
    p->memory = SLI_TAKE(b, unsigned char, sli_vectors_bytes(&p->q, nrhs, 8));
    p->steps = SLI_TAKE(b, sli_step, p->q.backward.count);
    p->ones = SLI_TAKE(b, double, p->q.backward.widest);
    p->identity = SLI_TAKE(b, sl_int, p->q.forward.columns);
}

static void sli_parts_fill(sli_parts *p) {
    const sli_reach *R = &p->q.backward;
    sl_int k;
    for (k = 0; k < R->count; k++) {
        p->steps[k] = R->steps[k];
        p->steps[k].column = SLI_TILE * R->steps[k].first_tile;
    }
    for (k = 0; k < R->widest; k++) {
        p->ones[k] = 1.0;
    }
    for (k = 0; k < R->columns; k++) {
        p->identity[k] = k;
    }
    p->q.b_index = p->q.b_index == NULL ? p->identity : p->q.b_index;
    p->q.x_index = p->q.x_index == NULL ? p->identity : p->q.x_index;
}

/* x := D x or D^-1 x in the columns of one step; solves have applied 2x2 pivots already. */
static void sli_parts_scale_step(const sli_parts *p, const sli_step *step, double *row,
                                 sl_int lanes) {
    const sl_factor *F = p->F;
    sl_int k, r;
    for (k = step->column; k < step->column + sli_step_columns(step); k++, row += lanes) {
        const int pair = F->E == NULL ? (int)SLI_PAIR_NONE : F->S->pairs[k];
        const double d = pair != SLI_PAIR_NONE       ? 1.0
                         : p->parts & SL_PART_SQRT_D ? sqrt(F->D[k])
                                                     : F->D[k];
        const int is_null = sli_is_skipped(F, k);
        for (r = 0; r < lanes; r++) {
            if (is_null) {
                row[r] = 0.0;
            } else if (!p->is_product) {
                row[r] /= d;
            } else if (pair == SLI_PAIR_FIRST) {
                const double u = row[r], v = row[lanes + r];
                row[r] = F->D[k] * u + F->E[k] * v;
                row[lanes + r] = F->E[k] * u + F->D[k + 1] * v;
            } else {
                row[r] *= d;
            }
        }
    }
}

static void sli_parts_scale(const sli_parts *p, double *x, sl_int lanes) {
    const sli_reach *R = &p->q.backward;
    sl_int s;
    if (!p->is_product && p->F->E != NULL) {
        sli_pairs_apply(p->F, R, x, lanes);
    }
    for (s = 0; s < R->count; s++) {
        sli_parts_scale_step(p, &R->steps[s], x + (ptrdiff_t)R->steps[s].base * lanes, lanes);
    }
}

/* Column j of supernode s in a product: x(i) += l(i,j) x(j) for its rows i, or
 * x(j) += l(i,j) x(i). */
static void sli_column_multiply(const sl_factor *F, sl_int s, sl_int j, int is_transposed,
                                double *x, sl_int lanes) {
    const sli_step *step = &F->S->steps[s];
    const sl_int *rows = F->S->rows + F->S->rows_begin[s];
    double *xj = x + (ptrdiff_t)(step->base + j) * lanes;
    sl_int i, r;
    for (i = j + 1; i < step->width + step->below; i++) {
        const double l = sli_entry(F, step->panel + sli_panel_at(step->width, i, j));
        double *xi =
            x + (ptrdiff_t)(i < step->width ? step->base + i : rows[i - step->width]) * lanes;
        for (r = 0; r < lanes; r++) {
            if (is_transposed) {
                xj[r] += l * xi[r];
            } else {
                xi[r] += l * xj[r];
            }
        }
    }
}

/* x := L x or L' x in place: a column is read before it is written if L takes the last one first,
 * and L' the first one. */
SLI_HOT static void sli_lower_multiply(const sl_factor *F, int is_transposed, double *x,
                                       sl_int lanes) {
    const sl_symbolic *S = F->S;
    sl_int at, s, k, j;
    for (at = 0; at < S->n_supers; at++) {
        s = is_transposed ? at : S->n_supers - 1 - at;
        for (k = 0; k < S->steps[s].width; k++) {
            j = is_transposed ? k : S->steps[s].width - 1 - k;
            sli_column_multiply(F, s, j, is_transposed, x, lanes);
        }
    }
}

/* Applies the parts to one packed block. */
static void sli_parts_apply(const sli_parts *p, const sli_vectors *v, int kind) {
    const sl_factor *F = p->F;
    sli_reach R = p->q.backward;
    const sl_int lanes = (sl_int)1 << kind;
    if (p->is_product && p->parts & SL_PART_LT) {
        sli_lower_multiply(F, 1, v->x, lanes);
    }
    if (!p->is_product && p->parts & SL_PART_L) {
        sli_forward_sweep(F, kind, &R, v->x, v->scratch);
    }
    if (p->parts & (SL_PART_D | SL_PART_SQRT_D)) {
        sli_parts_scale(p, v->x, lanes);
    }
    if (p->is_product && p->parts & SL_PART_L) {
        sli_lower_multiply(F, 0, v->x, lanes);
    }
    if (!p->is_product && p->parts & SL_PART_LT) {
        R.steps = p->steps;
        R.plain = NULL; /* D is read by the columns of the steps */
        sli_backward_sweep(F, kind, &R, p->ones, v->x, v->scratch);
    }
}

/* Checks what does not depend on sizes. */
SLI_NOINLINE static sl_status sli_parts_check(const sl_factor *F, unsigned parts) {
    const unsigned both = SL_PART_D | SL_PART_SQRT_D;
    sl_status status = sli_argument(parts >= 2u * SL_PART_PT ? "parts has a bit that is not known"
                                    : (parts & both) == both ? "parts has both D and sqrt(D)"
                                                             : NULL);
    status = status == SL_OK ? sli_factor_has_numbers(F) : status;
    if (status == SL_OK && parts & SL_PART_SQRT_D && F->stats.factor.negative > 0) {
        status = sli_refuse(SL_ERR_PIVOT, "SL_PART_SQRT_D with a pivot below 0");
    }
    return status == SL_OK && parts & SL_PART_SQRT_D && F->E != NULL
               ? sli_refuse(SL_ERR_UNSUPPORTED, "SL_PART_SQRT_D with 2x2 pivots")
               : status;
}

/* Runs a call whose query is set. */
static sl_status sli_parts_run(sli_parts *p, const sli_rhs *rhs, sl_work *W) {
    const sl_int nrhs = rhs->nrhs;
    sl_status status = sli_rhs_check(rhs, p->q.nx, p->q.nb);
    sli_block b = {NULL, 0};
    sl_work own;
    sl_int r;
    status = status == SL_OK ? sli_parts_check(p->F, p->parts) : status;
    if (status != SL_OK || nrhs == 0 || p->q.nx == 0) {
        return status;
    }
    own = sli_work_own(&p->F->allocator);
    W = W == NULL ? &own : W;
    sli_parts_layout(p, &b, nrhs);
    status = sli_work_block(W, &b);
    if (status == SL_OK) {
        sli_parts_layout(p, &b, nrhs);
        sli_parts_fill(p);
    }
    for (r = 0; r < nrhs && status == SL_OK; r += sli_min(8, nrhs - r)) {
        const sli_rhs block = sli_rhs_part(rhs, r, sli_min(8, nrhs - r));
        const sli_vectors v = sli_vectors_of(&p->q, block.nrhs, p->memory);
        sli_pack(p->F, &p->q, v.y, &block);
        sli_parts_apply(p, &v, sli_lanes_kind(block.nrhs));
        sli_unpack(p->F, &p->q, &block, v.x);
    }
    sli_free(&own.allocator, own.block);
    return status;
}

static sl_status sli_factor_part(const sl_factor *F, unsigned parts, int is_product,
                                 const sli_rhs *rhs, sl_work *W) {
    sli_query all;
    sli_parts p;
    if (F == NULL) {
        return sli_argument("F is NULL");
    }
    SLI_CLEAR(p);
    all = sli_query_all(F->S);
    p.F = F;
    p.parts = parts;
    p.is_product = is_product;
    p.q = sli_parts_query(&all, &all.forward, (parts & SL_PART_P) != 0, (parts & SL_PART_PT) != 0);
    return sli_parts_run(&p, rhs, W);
}

static sl_status sli_plan_part(const sl_plan *P, const sl_factor *F, unsigned parts,
                               const sli_rhs *rhs, sl_work *W) {
    const unsigned ends = parts & ~(unsigned)(SL_PART_D | SL_PART_SQRT_D);
    const int is_forward = ends == (SL_PART_P | SL_PART_L);
    sli_parts p;
    sl_status status =
        sli_argument(F == NULL ? "F is NULL"
                     : !is_forward && ends != (SL_PART_LT | SL_PART_PT)
                         ? "parts of a plan are P and L, or L' and P', each with or without D"
                         : NULL);
    if (status == SL_OK && F->S != P->query.S) {
        status = sli_query_refuse_analysis();
    }
    if (status == SL_OK && P->query.ending != NULL) {
        status = sli_refuse_region();
    }
    if (status != SL_OK) {
        return status;
    }
    SLI_CLEAR(p);
    p.F = F;
    p.parts = parts;
    p.q = sli_parts_query(&P->query, is_forward ? &P->query.forward : &P->query.backward,
                          is_forward, !is_forward);
    return sli_parts_run(&p, rhs, W);
}

SL_API sl_status sl_factor_solve_part(const sl_factor *F, const sl_plan *plan, unsigned parts,
                                      double *X, size_t ldx, const double *B, size_t ldb,
                                      sl_int nrhs, sl_work *W) {
    const sli_rhs rhs = sli_rhs_of(X, ldx, B, ldb, nrhs);
    return plan == NULL ? sli_factor_part(F, parts, 0, &rhs, W)
                        : sli_plan_part(plan, F, parts, &rhs, W);
}

SL_API sl_status sl_factor_multiply_part(const sl_factor *F, unsigned parts, double *X, size_t ldx,
                                         const double *B, size_t ldb, sl_int nrhs, sl_work *W) {
    const sli_rhs rhs = sli_rhs_of(X, ldx, B, ldb, nrhs);
    return sli_factor_part(F, parts, 1, &rhs, W);
}

SL_API sl_status sl_plan_columns(const sl_plan *P, sl_part part, sl_int *columns, sl_int capacity,
                                 sl_int *count) {
    const sli_reach *R;
    sl_int s, k, at = 0;
    sl_status status = sli_argument(P == NULL                         ? "P is NULL"
                                    : count == NULL                   ? "count is NULL"
                                    : capacity < 0                    ? "capacity is below 0"
                                    : capacity > 0 && columns == NULL ? "columns is NULL"
                                    : part != SL_PART_L && part != SL_PART_LT
                                        ? "part is neither SL_PART_L nor SL_PART_LT"
                                        : NULL);
    if (status == SL_OK && P->query.ending != NULL) {
        status = sli_refuse_region();
    }
    if (status != SL_OK) {
        return status;
    }
    R = part == SL_PART_L ? &P->query.forward : &P->query.backward;
    for (s = 0; s < R->count; s++) {
        for (k = 0; k < sli_step_columns(&R->steps[s]) && at < capacity; k++) {
            columns[at++] = R->steps[s].column + k;
        }
    }
    *count = R->columns;
    return SL_OK;
}

#endif
