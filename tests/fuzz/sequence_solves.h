/* sequence_solves.h: the calls of fuzz_sequence.c that solve: plans, workspaces, batches */
#ifndef SL_FUZZ_SEQUENCE_SOLVES_H
#define SL_FUZZ_SEQUENCE_SOLVES_H

#include "sequence_model.h"

static void create_plan(input_t *in) {
    plan_t *p = &plans[take(in) % PLANS];
    const int region = take(in) % (2 * REGIONS);
    free_plan(p);
    p->analysis = take(in) % ANALYSES;
    const analysis_t *s = &analyses[p->analysis];
    if (!s->S) {
        return;
    }
    take_set(in, s->n, &p->b);
    take_set(in, s->n, &p->x);
    sl_options opt = options();
    sl_stats stats;
    const int has_region = region < REGIONS && regions[region].R;
    opt.region = has_region ? regions[region].R : NULL;
    const sl_status status = sl_plan_create(&p->P, s->S, rows_of(&p->b), p->b.count, rows_of(&p->x),
                                            p->x.count, &opt, &stats);
    PROMISE((p->P != NULL) == (status == SL_OK));
    if (has_region && regions[region].analysis != p->analysis) {
        PROMISE(is_apart(status));
    } else {
        PROMISE(status == SL_OK || no_memory(status));
    }
    p->region = p->P && stats.plan.in_region ? region : -1;
}

/* Right-hand sides that are consistent for RIGID matrices where three rows of b in turn are of one
 * component: orthogonal to 1 and to the numbers of the rows. */
static void take_rigid_sides(input_t *in, const set_t *b, sl_int nrhs, double *B, double *full) {
    for (sl_int r = 0; r < nrhs; r++) {
        for (sl_int k = 0; k < b->count; k++) {
            B[k + SET * r] = 0.0;
        }
        for (sl_int k = 0; k + 2 < b->count; k += 3) {
            const sl_int *i = b->rows + k;
            const double w = r == 0 ? take_eighths(in) : 1.0 + r;
            for (int e = 0; e < 3; e++) {
                B[k + e + SET * r] = w * (i[(e + 2) % 3] - i[(e + 1) % 3]);
                full[i[e] + MOST * r] += B[k + e + SET * r];
            }
        }
    }
}

/* Fills B with eighths and adds it to the right-hand sides of the full solve. */
static void take_right_hand_sides(input_t *in, const set_t *b, sl_int nrhs, double *B,
                                  double *full) {
    memset(full, 0, MOST * RHS * sizeof *full);
    const int form = take(in), is_balanced = form % 2;
    if (form % 8 == 7) {
        take_rigid_sides(in, b, nrhs, B, full);
        return;
    }
    for (sl_int r = 0; r < nrhs; r++) {
        double sum = 0.0;
        for (sl_int k = 0; k < b->count; k++) {
            double value = r < 2 ? take_eighths(in) : B[k + SET * (r - 2)] + 0.125 * (k % 2);
            value = is_balanced && k + 1 == b->count ? -sum : value;
            B[k + SET * r] = value;
            full[b->rows[k] + MOST * r] += value;
            sum += value;
        }
    }
}

/* Solves a plan in one of the three ways. X is nx x nrhs with leading dimension SET. */
static sl_status solve_plan(const plan_t *p, const factor_t *f, int how, sl_int nrhs,
                            const double *B, double *X) {
    if (how == 0 && p->region < 0 && p->analysis == f->analysis) {
        return sl_local_solve(f->F, rows_of(&p->b), p->b.count, rows_of(&p->x), p->x.count, X, SET,
                              B, SET, nrhs, work, NULL);
    }
    if (how == 1) {
        double Bt[SET * RHS], Xt[SET * RHS];
        for (sl_int q = 0; q < p->b.count * RHS; q++) {
            Bt[q] = q % RHS < nrhs ? B[q / RHS + SET * (q % RHS)] : 0.0;
        }
        const sl_status status =
            sl_plan_solve(p->P, f->F, Xt, SL_ROWS(RHS), Bt, SL_ROWS(RHS), nrhs, work);
        for (sl_int q = 0; status == SL_OK && q < p->x.count * RHS; q++) {
            if (q % RHS < nrhs) {
                X[q / RHS + SET * (q % RHS)] = Xt[q];
            }
        }
        return status;
    }
    return sl_plan_solve(p->P, f->F, X, SET, B, SET, nrhs, how == 2 ? NULL : work);
}

/* Compares a local solve with the full solve: the same bits, in a region the same to rounding. */
static void compare(const plan_t *p, const factor_t *f, sl_int nrhs, const double *X,
                    const double *full) {
    for (sl_int r = 0; r < nrhs; r++) {
        for (sl_int k = 0; k < p->x.count; k++) {
            const double local = X[k + SET * r], value = full[p->x.rows[k] + MOST * r];
            if (p->region < 0) {
                check_same(local, value);
            } else if (f->v.kind == DOMINANT) {
                PROMISE(fabs(local - value) <= tolerance(f) * largest(full + MOST * r, MOST));
            }
        }
    }
}

static void solve(input_t *in) {
    const plan_t *p = &plans[take(in) % PLANS];
    const factor_t *f = &factors[take(in) % FACTORS];
    const int how = take(in) % 4;
    const sl_int nrhs = take(in) % (RHS + 1);
    double B[SET * RHS], X[SET * RHS], full_b[MOST * RHS], full[MOST * RHS];
    if (!p->P || !f->F) {
        return;
    }
    take_right_hand_sides(in, &p->b, nrhs, B, full_b);
    const sl_status status = solve_plan(p, f, how, nrhs, B, X);
    if (no_memory(status)) {
        return;
    }
    if (p->analysis != f->analysis || !f->is_valid) {
        PROMISE(is_apart(status));
        return;
    }
    if (p->region >= 0) { /* its region has to be that of this matrix */
        const int is_same = memcmp(regions[p->region].a, f->v.a, sizeof f->v.a) == 0;
        PROMISE(is_same || is_apart(status));
        PROMISE(status == SL_OK || is_apart(status) || status == SL_ERR_INCONSISTENT ||
                status == SL_ERR_NOT_FINITE);
    }
    left = -1; /* the full solve is the reference */
    const sl_status reference = sl_factor_solve(f->F, full, MOST, full_b, MOST, nrhs, work);
    if (reference == SL_OK && status == SL_OK) {
        compare(p, f, nrhs, X, full);
    }
    if (p->region < 0 && p->x.count > 0) {
        PROMISE(status == reference || (reference == SL_ERR_NOT_FINITE && status == SL_OK &&
                                        f->v.kind == WILD)); /* in rows that are not wanted */
    }
    int all_consistent = 1;
    for (sl_int r = 0; r < nrhs && f->v.kind != WILD; r++) {
        all_consistent &=
            !is_singular(f->v.kind) || f->has_mass || is_consistent(f, full_b + MOST * r);
        if (reference == SL_OK) {
            check_solution(f, full + MOST * r, full_b + MOST * r, tolerance(f));
        }
    }
    if (f->v.kind != WILD) {
        PROMISE(reference == (all_consistent ? SL_OK : SL_ERR_INCONSISTENT));
    }
}

/* Solves, entries and estimates of the right-hand side 0, so that it is consistent. p: NULL, or a
 * plan of the analysis. Returns the first status of a call that lacked memory. */
static sl_status solve_zeros(const factor_t *f, const plan_t *p, sl_int nrhs, sl_work *W) {
    const sl_csc A = view(&analyses[f->analysis], f->v.x);
    double B[SET * RHS], X[SET * RHS], full[MOST * RHS], rcond;
    sl_stats stats;
    sl_status status[7] = {SL_OK};
    memset(X, 0, sizeof X);
    memset(B, 0, sizeof B);
    memset(full, 0, sizeof full);
    status[0] = sl_factor_solve(f->F, full, MOST, full, MOST, nrhs, W);
    status[1] = sl_factor_refine(f->F, &A, X, SET, B, SET, nrhs, 0, W, &stats);
    status[2] = sl_factor_rcond(f->F, &A, &rcond, W);
    status[3] = sl_inverse_diagonal(f->F, X, NULL, SL_ALL, W, NULL);
    if (A.n_cols > 0) {
        const sl_int row = A.n_cols / 2;
        status[4] = sl_local_solve(f->F, &row, 1, NULL, A.n_cols, X, SET, B, SET, nrhs, W, NULL);
    }
    if (p != NULL) {
        status[5] = sl_plan_solve(p->P, f->F, X, SET, B, SET, nrhs, W);
        status[6] = sl_plan_solve_regularized(p->P, f->F, X, SET, B, SET, nrhs, 2, W, NULL);
    }
    for (int k = 0; k < 7; k++) {
        if (no_memory(status[k])) {
            return SL_ERR_MEMORY;
        }
        PROMISE(status[k] == SL_OK ||
                (k == 6 && status[k] == SL_ERR_INACCURATE) || /* by epsilon * growth */
                (k >= 5 && p->region >= 0 && is_apart(status[k])));
    }
    return SL_OK;
}

/* With what calls took in another workspace reserved, they allocate nothing. */
static void reserve(input_t *in) {
    const plan_t *p = &plans[take(in) % PLANS];
    const factor_t *f = &factors[take(in) % FACTORS];
    const sl_int nrhs = take(in) % (RHS + 1);
    const sl_options opt = options();
    sl_work *trial = NULL;
    if (!f->F || !f->is_valid) {
        return;
    }
    p = p->P && p->analysis == f->analysis ? p : NULL;
    sl_status status = sl_work_create(&trial, &opt);
    status = status ? status : solve_zeros(f, p, nrhs, trial);
    status = status ? status : sl_work_reserve(work, sl_work_bytes(trial));
    sl_work_free(trial);
    if (no_memory(status)) {
        return;
    }
    const size_t bytes = sl_work_bytes(work);
    left = 0;
    has_failed = 0;
    PROMISE(solve_zeros(f, p, nrhs, work) == SL_OK);
    PROMISE(!has_failed && sl_work_bytes(work) == bytes);
}

/* sl_batch_solve on copies of the right-hand sides, by rows; the solutions go to the X of the
 * requests. */
static sl_status batch_by_rows(const sl_request *requests, int count, const sl_options *opt,
                               sl_int *failed) {
    static double X[REQUESTS][SET * RHS], B[REQUESTS][SET * RHS];
    sl_request rows[REQUESTS];
    memset(rows, 0, sizeof rows);
    for (int k = 0; k < count; k++) {
        rows[k] = requests[k];
        rows[k].X = X[k];
        rows[k].B = B[k];
        rows[k].ldx = rows[k].ldb = SL_ROWS(RHS);
        for (int q = 0; q < SET * RHS; q++) {
            B[k][q] = requests[k].B[q / RHS + SET * (q % RHS)];
            X[k][q] = 0.0;
        }
    }
    const sl_status status = sl_batch_solve(NULL, rows, count, opt, NULL, failed);
    for (int k = 0; k < count; k++) {
        for (int q = 0; q < SET * RHS; q++) {
            requests[k].X[q / RHS + SET * (q % RHS)] = X[k][q];
        }
    }
    return status;
}

/* A batch gives the bits of its solves. */
static void solve_batch(input_t *in) {
    static double X[REQUESTS][SET * RHS], Y[SET * RHS];
    double B[SET * RHS];
    sl_request requests[REQUESTS];
    sl_int failed = -2;
    int all_valid = 1, count = take(in) % (REQUESTS + 1);
    memset(requests, 0, sizeof requests);
    for (int q = 0; q < SET * RHS; q++) {
        B[q] = q < MOST ? take_eighths(in) : B[q - MOST] + q % 3;
    }
    for (int k = 0; k < count; k++) {
        const factor_t *f = &factors[take(in) % FACTORS];
        const int plan = take(in) % (2 * PLANS);
        if (!f->F) {
            return;
        }
        sl_request *q = &requests[k];
        q->factor = f->F;
        q->nrhs = take(in) % (RHS + 1);
        q->X = X[k];
        q->B = B;
        q->ldx = q->ldb = SET;
        const plan_t *p = plan < PLANS ? &plans[plan] : NULL;
        q->plan = p && p->P && p->region < 0 && p->analysis == f->analysis ? p->P : NULL;
        all_valid &= f->is_valid;
    }
    const int form = take(in);
    const sl_options opt = threaded(1 + form % 4);
    memset(X, 0, sizeof X);
    const sl_status status = form / 4 % 2
                                 ? batch_by_rows(requests, count, &opt, &failed)
                                 : sl_batch_solve(NULL, requests, count, &opt, NULL, &failed);
    PROMISE((failed == -1) == (status == SL_OK) || no_memory(status));
    PROMISE(all_valid || is_apart(status) || no_memory(status));
    PROMISE(!all_valid || status == SL_OK || status == SL_ERR_INCONSISTENT ||
            status == SL_ERR_NOT_FINITE || no_memory(status));
    left = -1;
    for (int k = 0; status == SL_OK && k < count; k++) {
        const sl_request *q = &requests[k];
        memset(Y, 0, sizeof Y);
        const sl_status alone =
            q->plan ? sl_plan_solve(q->plan, q->factor, Y, SET, B, SET, q->nrhs, work)
                    : sl_factor_solve(q->factor, Y, SET, B, SET, q->nrhs, work);
        PROMISE(alone == SL_OK);
        for (int e = 0; e < SET * RHS; e++) {
            check_same(X[k][e], Y[e]);
        }
    }
}

#endif
