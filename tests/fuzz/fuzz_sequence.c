/* fuzz_sequence.c: takes a sequence of calls on a pool of objects from any bytes, with allocations
 * that fail in between; compares every answer with dense matrices */
#include "sequence_saved.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { STEPS = 60 };

/* ---- the calls ---- */

static void create_analysis(input_t *in) {
    const int which = take(in) % ANALYSES, choices = take(in), density = take(in) % 16;
    analysis_t *s = &analyses[which];
    free_analysis(which);
    s->n = take(in) % (MOST + 1);
    sl_int stored = 0, perm[MOST];
    for (sl_int j = 0; j < s->n; j++) {
        s->p[j] = stored;
        for (sl_int i = choices % 2 ? 0 : j; i < (choices % 2 ? j + 1 : s->n); i++) {
            if (i == j || take(in) % 16 < density) {
                s->i[stored++] = i;
            }
        }
        perm[j] = s->n - 1 - j;
    }
    s->p[s->n] = stored;
    sl_options opt = options();
    opt.ordering = choices / 2 % 4 == 0   ? SL_ORDERING_GIVEN
                   : choices / 2 % 4 == 1 ? SL_ORDERING_NATURAL
                   : choices / 2 % 4 == 2 ? SL_ORDERING_MINDEG
                                          : SL_ORDERING_ND;
    opt.perm = opt.ordering == SL_ORDERING_GIVEN ? perm : NULL;
    opt.relaxation = (sl_relaxation)(choices / 8 % 2);
    const sl_csc A = view(s, NULL);
    const sl_status status = sl_symbolic_create(&s->S, &A, &opt, NULL);
    PROMISE((s->S != NULL) == (status == SL_OK));
    PROMISE(status == SL_OK || no_memory(status));
}

/* A factorization of the kinds that the model knows succeeds. One that lacked memory changes
 * nothing, and one that met a null pivot has no numbers. */
static void note_numbers(factor_t *f, sl_status status, const values_t *v) {
    if (no_memory(status)) {
        return;
    }
    PROMISE(status == SL_OK || v->kind == WILD);
    f->is_valid = status == SL_OK;
    f->v = *v;
}

/* The null vectors of LAPLACIAN and RIGID matrices, one that is none, and zeros: they make room for
 * two null vectors in each of four components. */
static const double *null_columns(const analysis_t *s) {
    static double z[MOST * COLUMNS];
    memset(z, 0, sizeof z);
    for (sl_int i = 0; i < s->n; i++) {
        z[i] = 1.0;
        z[i + s->n] = i;
        z[i + 2 * s->n] = (i * i) % 7;
    }
    return z;
}

static sl_options factor_options(input_t *in, factor_t *f, kind_t kind) {
    const analysis_t *s = &analyses[f->analysis];
    const int choices = take(in);
    sl_options opt = threaded(choices % 4);
    opt.isa = choices / 4 % 2 ? SL_ISA_SCALAR : SL_ISA_AUTO;
    opt.method = (sl_method)(choices / 8 % 3);
    f->is_float = choices / 64 % 2;
    opt.storage = f->is_float ? SL_STORAGE_FLOAT : SL_STORAGE_DOUBLE;
    f->has_mass = f->has_columns = 0;
    if (kind == LAPLACIAN) {
        opt.null_pivots = SL_NULL_PIVOT_SKIP;
        f->has_columns = choices / 128 % 2;
        f->has_mass = choices / 32 % 2;
        opt.mass = f->has_mass ? f->mass : NULL;
        opt.null_vector = f->has_columns ? null_columns(s) : NULL;
        opt.null_vector_count = f->has_columns ? COLUMNS : 0;
    }
    for (sl_int k = 0; k < MOST; k++) {
        f->mass[k] = 1.0 + k % 3;
    }
    return opt;
}

static void create_factor(input_t *in) {
    const int which = take(in) % FACTORS;
    factor_t *f = &factors[which];
    values_t v;
    free_factor(which);
    f->analysis = take(in) % ANALYSES;
    const analysis_t *s = &analyses[f->analysis];
    const kind_t kind = (kind_t)(take(in) % 3);
    if (!s->S) {
        return;
    }
    const sl_options opt = factor_options(in, f, kind);
    take_values(in, s, f->has_columns ? RIGID : kind, &v);
    const sl_csc A = view(s, v.x);
    const sl_status status = sl_factor_create(&f->F, s->S, &A, &opt, NULL);
    PROMISE((f->F != NULL) == (status == SL_OK));
    note_numbers(f, status, &v);
}

/* A factor of c0 A + c1 A, alone or in a batch, or a refactorization with it. */
static void combine(input_t *in) {
    const int form = take(in), which = take(in) % FACTORS;
    factor_t *f = &factors[which];
    const int analysis = form % 2 ? f->analysis : take(in) % ANALYSES;
    const analysis_t *s = &analyses[analysis];
    double scattered[ENTRIES];
    const double c[4] = {take(in) / 64.0 + 0.25, 0.5, 1.0, 0.25};
    const double *terms[2] = {scattered, scattered};
    values_t v;
    if (!s->S || (form % 2 && (!f->F || f->has_mass || f->v.kind != DOMINANT))) {
        return;
    }
    take_values(in, s, DOMINANT, &v);
    const sl_csc A = view(s, v.x);
    PROMISE(sl_symbolic_entries(s->S) == s->p[s->n]);
    if (no_memory(sl_symbolic_scatter(s->S, scattered, &A, NULL))) {
        return;
    }
    for (int q = 0; q < ENTRIES; q++) {
        v.x[q] *= c[0] + c[1];
    }
    set_dense(s, &v);
    if (form % 2) {
        note_numbers(f, sl_factor_refactor_combination(f->F, c, terms, 2, NULL), &v);
        return;
    }
    free_factor(which);
    f->analysis = analysis;
    const sl_options opt = factor_options(in, f, DOMINANT);
    sl_status status;
    if (form / 2 % 2) {
        sl_factor *both[2];
        sl_int failed = -2;
        status = sl_batch_factor(both, 2, s->S, c, terms, 2, &opt, &failed, NULL);
        PROMISE((failed == -1) == (status == SL_OK));
        f->F = both[0];
        if (status == SL_OK) { /* the same matrices again, without an allocation */
            const sl_options run = threaded(opt.threads.count);
            PROMISE(sl_batch_refactor(both, 2, c, terms, 2, &run, NULL, NULL) == SL_OK);
        }
        sl_factor_free(both[1]);
        PROMISE(f->F != NULL || no_memory(status));
        status = f->F ? SL_OK : status;
    } else {
        status = sl_factor_create_combination(&f->F, s->S, c, terms, 2, &opt, NULL);
    }
    PROMISE((f->F != NULL) == (status == SL_OK));
    note_numbers(f, status, &v);
}

static void refactor(input_t *in) {
    factor_t *f = &factors[take(in) % FACTORS];
    const int form = take(in);
    values_t v;
    if (!f->F) {
        return;
    }
    const analysis_t *s = &analyses[f->analysis];
    take_values(in, s, form % 8 == 0 && !f->has_mass ? WILD : f->v.kind, &v);
    const sl_csc A = view(s, v.x);
    note_numbers(f, sl_factor_refactor(f->F, &A, NULL), &v);
}

/* New values in some columns only. Symmetric entries in other columns stay as they are stored. */
static void refactor_changed(input_t *in) {
    factor_t *f = &factors[take(in) % FACTORS];
    sl_int columns[MOST], count = 0;
    if (!f->F) {
        return;
    }
    const analysis_t *s = &analyses[f->analysis];
    values_t v = f->v;
    for (sl_int j = 0; j < s->n; j++) {
        const int byte = take(in);
        if (byte % 4 == 0) {
            columns[count++] = j;
            for (sl_int q = s->p[j]; q < s->p[j + 1]; q++) {
                if (v.kind == DOMINANT && s->i[q] == j && fabs(v.x[q]) < 1e6) {
                    v.x[q] *= 1.0 + byte / 64.0;
                }
                v.x[q] = v.kind == WILD ? take_wild(in) : v.x[q];
            }
        }
    }
    set_dense(s, &v);
    const sl_csc A = view(s, v.x);
    const sl_status status = sl_factor_refactor_changed(f->F, &A, columns, count, NULL);
    if (f->is_valid) {
        note_numbers(f, status, &v);
    } else {
        PROMISE(status == SL_ERR_STATE || status == SL_ERR_NOT_FINITE);
    }
}

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
        PROMISE(status == SL_ERR_STATE);
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
            sl_plan_solve_interleaved(p->P, f->F, Xt, RHS, Bt, RHS, nrhs, work);
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
        PROMISE(status == SL_ERR_STATE);
        return;
    }
    if (p->region >= 0) { /* its region has to be that of this matrix */
        const int is_same = memcmp(regions[p->region].a, f->v.a, sizeof f->v.a) == 0;
        PROMISE(is_same || status == SL_ERR_STATE);
        PROMISE(status == SL_OK || status == SL_ERR_STATE || status == SL_ERR_INCONSISTENT);
    }
    left = -1; /* the full solve is the reference */
    const sl_status reference = sl_factor_solve(f->F, full, MOST, full_b, MOST, nrhs, work);
    if (reference == SL_OK && status == SL_OK) {
        compare(p, f, nrhs, X, full);
    }
    if (p->region < 0 && p->x.count > 0) {
        PROMISE(status == reference);
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

/* inverse[i + MOST * j] of a DOMINANT factor */
static void dense_inverse(const factor_t *f, double *inverse) {
    for (sl_int j = 0; j < order_of(f); j++) {
        double unit[MOST] = {0.0};
        unit[j] = 1.0;
        (void)dense_solve(f->v.a, order_of(f), unit, inverse + MOST * j);
    }
}

static void check_diagonal(const factor_t *f, const set_t *set, const double *d) {
    double inverse[ENTRIES];
    if (f->v.kind == DOMINANT) {
        dense_inverse(f, inverse);
        for (sl_int k = 0; k < set->count; k++) {
            const double expected = inverse[set->rows[k] + MOST * set->rows[k]];
            PROMISE(fabs(d[k] - expected) <= tolerance(f) * fabs(expected));
        }
    }
}

static void create_selected(input_t *in) {
    const factor_t *f = &factors[take(in) % FACTORS];
    const int form = take(in);
    selected_t *z = &selected[take(in) % SELECTED];
    set_t set;
    double d[SET];
    if (!f->F) {
        return;
    }
    take_set(in, order_of(f), &set);
    sl_status status;
    if (form % 2 && z->Z) {
        status = sl_selected_refactor(z->Z, f->F, form % 4 == 1 ? work : NULL);
        if (z->analysis != f->analysis || !f->is_valid) {
            PROMISE(status == SL_ERR_STATE);
            return;
        }
    } else {
        const sl_options opt = threaded(form / 4 % 3);
        free_selected(z);
        status = sl_selected_create(&z->Z, f->F, rows_of(&set), set.count, &opt, NULL);
        PROMISE((z->Z != NULL) == (status == SL_OK));
        PROMISE(f->is_valid || status == SL_ERR_STATE);
    }
    PROMISE(status == SL_OK || no_memory(status) || !f->is_valid);
    if (status != SL_OK) {
        return;
    }
    z->analysis = f->analysis;
    z->is_float = f->is_float;
    memcpy(z->a, f->v.a, sizeof z->a);
    status = sl_selected_diagonal(z->Z, d, rows_of(&set), set.count, NULL);
    PROMISE(status == SL_OK || (form % 2 && status == SL_ERR_PATTERN));
    if (status == SL_OK) {
        check_diagonal(f, &set, d);
    }
}

static void create_region(input_t *in) {
    const int which = take(in) % REGIONS, factor = take(in) % FACTORS, form = take(in);
    const int other = take(in) % (2 * SELECTED);
    region_t *r = &regions[which];
    const factor_t *f = &factors[factor];
    const selected_t *z = other < SELECTED && selected[other].Z ? &selected[other] : NULL;
    set_t set;
    if (!f->F) {
        return;
    }
    sl_status status;
    const int is_new = form % 2 == 0 || !r->R;
    if (is_new) {
        sl_options opt = options();
        take_set(in, order_of(f), &set);
        opt.region_bytes = form & 2 ? (size_t)take(in) * 40 : 0;
        free_region(which);
        status =
            sl_region_create(&r->R, f->F, rows_of(&set), set.count, z ? z->Z : NULL, &opt, NULL);
        PROMISE((r->R != NULL) == (status == SL_OK));
    } else {
        status = sl_region_refactor(r->R, f->F, z ? z->Z : NULL, form & 2 ? work : NULL);
    }
    if (no_memory(status)) {
        return;
    }
    if (!f->is_valid || (!is_new && r->analysis != f->analysis)) {
        PROMISE(status == SL_ERR_STATE);
    } else if (f->has_mass && order_of(f) > 0) {
        PROMISE(status == SL_ERR_UNSUPPORTED || (z && status == SL_ERR_STATE));
    } else if (z && memcmp(z->a, f->v.a, sizeof z->a) != 0) {
        PROMISE(status == SL_ERR_STATE);
    } else {
        PROMISE(status == SL_OK || (z && status == SL_ERR_STATE));
    }
    if (status == SL_OK) {
        r->analysis = f->analysis;
        r->factor = factor;
        memcpy(r->a, f->v.a, sizeof r->a);
    }
}

/* The size of an entry of the inverse, for tolerances. */
static double entry_size(const double *inverse, sl_int i, sl_int j) {
    return sqrt(fabs(inverse[i + MOST * i] * inverse[j + MOST * j])) + fabs(inverse[i + MOST * j]);
}

static void invert(input_t *in) {
    const factor_t *f = &factors[take(in) % FACTORS];
    const int form = take(in);
    sl_work *W = form % 2 ? work : NULL;
    set_t rows, columns;
    double out[SET], block[SET * SET], inverse[ENTRIES], form_value = 0.0, b[SET], c[SET];
    if (!f->F) {
        return;
    }
    take_set(in, order_of(f), &rows);
    take_set(in, order_of(f), &columns);
    const sl_int pairs = rows.count < columns.count ? rows.count : columns.count;
    const sl_status expected = f->is_valid ? SL_OK : SL_ERR_STATE;
    const int is_known = f->is_valid && f->v.kind == DOMINANT;
    memset(inverse, 0, sizeof inverse);
    if (is_known) {
        dense_inverse(f, inverse);
    }
    sl_status status = sl_inverse_diagonal(f->F, out, rows_of(&rows), rows.count, W, NULL);
    PROMISE(status == expected || no_memory(status));
    if (status == SL_OK) {
        check_diagonal(f, &rows, out);
    }
    status = sl_inverse_pairs(f->F, out, rows.rows, columns.rows, pairs, W, NULL);
    PROMISE(status == expected || no_memory(status));
    for (sl_int k = 0; status == SL_OK && is_known && k < pairs; k++) {
        const sl_int i = rows.rows[k], j = columns.rows[k];
        PROMISE(fabs(out[k] - inverse[i + MOST * j]) <= tolerance(f) * entry_size(inverse, i, j));
    }
    status = sl_inverse_block(f->F, block, SET, rows.rows, rows.count, columns.rows, columns.count,
                              W, NULL);
    PROMISE(status == expected || no_memory(status));
    double exact = 0.0, size = 0.0;
    for (sl_int k = 0; k < SET; k++) {
        b[k] = 1.0 + k;
        c[k] = 3.0 - k;
    }
    for (sl_int l = 0; is_known && l < columns.count; l++) {
        for (sl_int k = 0; k < rows.count; k++) {
            const sl_int i = rows.rows[k], j = columns.rows[l];
            const double value = inverse[i + MOST * j], most = entry_size(inverse, i, j);
            PROMISE(status != SL_OK || fabs(block[k + SET * l] - value) <= tolerance(f) * most);
            exact += b[k] * c[l] * value;
            size += fabs(b[k] * c[l]) * most;
        }
    }
    status = sl_inverse_bilinear(f->F, &form_value, rows_of(&rows), b, rows.count,
                                 rows_of(&columns), c, columns.count, W, NULL);
    PROMISE(status == expected || no_memory(status));
    PROMISE(status != SL_OK || !is_known || fabs(form_value - exact) <= tolerance(f) * size);
}

static void query(input_t *in) {
    const factor_t *f = &factors[take(in) % FACTORS];
    double log_abs_det = 0.0, sign = 0.0, rcond = -1.0, B[MOST * RHS], X[MOST * RHS], b[MOST];
    sl_int count = -1, rows[MOST];
    sl_stats stats;
    if (!f->F) {
        return;
    }
    const analysis_t *s = &analyses[f->analysis];
    const sl_csc A = view(s, f->v.x);
    const sl_status expected = f->is_valid ? SL_OK : SL_ERR_STATE;
    PROMISE(sl_factor_null_rows(f->F, rows, MOST, &count) == expected);
    PROMISE(sl_factor_logdet(f->F, &log_abs_det, &sign) == expected);
    for (sl_int k = 0; k < MOST * RHS; k++) {
        B[k] = k < MOST ? take_eighths(in) : B[k - MOST] * 0.5 + 1.0;
        X[k] = 0.0;
    }
    sl_status status = sl_factor_rcond(f->F, &A, &rcond, work);
    PROMISE(status == expected || no_memory(status));
    const sl_int nrhs = take(in) % (RHS + 1);
    const sl_status refined = sl_factor_refine(f->F, &A, X, MOST, B, MOST, nrhs, 8, work, &stats);
    if (expected == SL_OK && refined == SL_ERR_INACCURATE) { /* inconsistent, or wild */
        PROMISE(f->v.kind != DOMINANT && !(stats.refine.backward_error <= 1e-8));
    } else {
        PROMISE(refined == expected || no_memory(refined));
    }
    if (f->is_valid && is_singular(f->v.kind)) {
        PROMISE(count == nullity_of(&f->v, s->n));
        PROMISE(status != SL_OK || (s->n == 0 ? rcond == 1.0 : rcond == 0.0));
    } else if (f->is_valid && f->v.kind == DOMINANT) {
        memset(b, 0, sizeof b);
        const double det = dense_solve(f->v.a, s->n, b, b);
        PROMISE(count == 0 && sign == (det < 0.0 ? -1.0 : 1.0));
        PROMISE(fabs(log_abs_det - log(fabs(det))) <= 1e-11 * (1.0 + fabs(log_abs_det)));
        PROMISE(status != SL_OK || (rcond > 0.0 && rcond <= 1.0 + 1e-9));
        PROMISE(refined != SL_OK || stats.refine.backward_error <= 4e-15);
        for (sl_int r = 0; refined == SL_OK && r < nrhs; r++) {
            check_solution(f, X + MOST * r, B + MOST * r, 1e-11);
        }
    }
    status = sl_factor_defects(f->F, X, MOST, B, MOST, nrhs, work);
    PROMISE(status == expected || no_memory(status));
}

/* What a reserve call has reserved for is solved without an allocation. */
static void reserve(input_t *in) {
    const plan_t *p = &plans[take(in) % PLANS];
    const factor_t *f = &factors[take(in) % FACTORS];
    const sl_int nrhs = take(in) % (RHS + 1);
    double B[SET * RHS], X[SET * RHS], full[MOST * RHS], rcond;
    sl_stats stats;
    memset(X, 0, sizeof X);
    if (!f->F || !f->is_valid) {
        return;
    }
    const sl_csc A = view(&analyses[f->analysis], f->v.x);
    sl_status status = sl_work_reserve_factor(work, f->F, nrhs);
    status = status ? status : sl_work_reserve_refine(work, f->F, nrhs);
    status = status ? status : sl_work_reserve_rcond(work, f->F);
    status = status ? status : sl_work_reserve_defects(work, f->F, nrhs);
    status = status ? status : sl_work_reserve_inverse(work, f->F, SET);
    status = status ? status : sl_work_reserve_block(work, f->F, SET, SET);
    status = status ? status : sl_work_reserve_local(work, analyses[f->analysis].S, 1, MOST, nrhs);
    const int is_planned = p->P && p->analysis == f->analysis;
    status = status || !is_planned ? status : sl_work_reserve_plan(work, p->P, nrhs);
    status = status || !is_planned ? status : sl_work_reserve_refined(work, p->P, nrhs);
    PROMISE(status == SL_OK || no_memory(status));
    if (status != SL_OK) {
        return;
    }
    const size_t bytes = sl_work_bytes(work);
    left = 0;
    has_failed = 0;
    memset(full, 0, sizeof full);
    memset(B, 0, sizeof B);
    PROMISE(sl_factor_solve(f->F, full, MOST, full, MOST, nrhs, work) == SL_OK);
    memset(full, 0, sizeof full);
    PROMISE(sl_factor_refine(f->F, &A, X, SET, B, SET, nrhs, 0, work, &stats) == SL_OK);
    PROMISE(sl_factor_rcond(f->F, &A, &rcond, work) == SL_OK);
    PROMISE(sl_inverse_diagonal(f->F, X, NULL, 0, work, NULL) == SL_OK);
    if (A.n_cols > 0) {
        const sl_int row = A.n_cols / 2;
        PROMISE(sl_local_solve(f->F, &row, 1, NULL, A.n_cols, X, SET, B, SET, nrhs, work, NULL) ==
                SL_OK);
    }
    if (is_planned) {
        status = sl_plan_solve(p->P, f->F, X, SET, B, SET, nrhs, work);
        PROMISE(status == SL_OK || (p->region >= 0 && status == SL_ERR_STATE));
        status = sl_plan_solve_refined(p->P, f->F, X, SET, B, SET, nrhs, 2, work, NULL);
        PROMISE(status == SL_OK || (p->region >= 0 && status == SL_ERR_STATE));
    }
    PROMISE(!has_failed && sl_work_bytes(work) == bytes);
}

/* sl_batch_solve_interleaved on copies of the right-hand sides; the solutions go to the X of the
 * requests. */
static sl_status batch_interleaved(const sl_request *requests, int count, const sl_options *opt,
                                   sl_int *failed) {
    static double X[REQUESTS][SET * RHS], B[REQUESTS][SET * RHS];
    sl_request rows[REQUESTS];
    memset(rows, 0, sizeof rows);
    for (int k = 0; k < count; k++) {
        rows[k] = requests[k];
        rows[k].X = X[k];
        rows[k].B = B[k];
        rows[k].ldx = rows[k].ldb = RHS;
        for (int q = 0; q < SET * RHS; q++) {
            B[k][q] = requests[k].B[q / RHS + SET * (q % RHS)];
            X[k][q] = 0.0;
        }
    }
    const sl_status status = sl_batch_solve_interleaved(NULL, rows, count, opt, NULL, failed);
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
                                 ? batch_interleaved(requests, count, &opt, &failed)
                                 : sl_batch_solve(NULL, requests, count, &opt, NULL, &failed);
    PROMISE((failed == -1) == (status == SL_OK) || no_memory(status));
    PROMISE(all_valid || status == SL_ERR_STATE || no_memory(status));
    PROMISE(!all_valid || status == SL_OK || status == SL_ERR_INCONSISTENT || no_memory(status));
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

static void release_one(input_t *in) {
    const int which = take(in), kind = take(in) % 6;
    if (kind == 0) {
        free_factor(which % FACTORS);
    } else if (kind == 1) {
        free_region(which % REGIONS);
    } else if (kind == 2) {
        free_selected(&selected[which % SELECTED]);
    } else if (kind == 3) {
        free_plan(&plans[which % PLANS]);
    } else if (kind == 4) {
        free_analysis(which % ANALYSES);
    } else { /* a new workspace, which has to grow */
        const sl_options opt = options();
        left = -1;
        sl_work_free(work);
        PROMISE(sl_work_create(&work, &opt) == SL_OK);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static void (*const calls[])(input_t * in) = {
        create_analysis, create_factor, create_factor, combine, refactor,    refactor_changed,
        create_plan,     create_plan,   solve,         solve,   solve,       create_selected,
        create_region,   invert,        query,         reserve, solve_batch, release_one};
    static void (*const more[])(input_t * in) = {solve_rows, multiply,       build_matrices,
                                                 look_into,  batch_diagonal, select_pairs,
                                                 copy,       reserve_others, copy_set};
    enum { CALLS = (int)(sizeof calls / sizeof calls[0]) };
    enum { MORE = (int)(sizeof more / sizeof more[0]) };
    if (size == 0) {
        return 0;
    }
    input_t in = {data, data + size};
    const sl_options opt = options();
    left = -1;
    blocks = 0;
    PROMISE(sl_work_create(&work, &opt) == SL_OK);
    create_analysis(&in);
    create_factor(&in);
    for (int step = 0; step < STEPS && in.at < in.end; step++) {
        const int byte = take(&in);
        has_failed = 0;
        const int may_fail = byte >= 13 * CALLS || byte / 8 == 18; /* one call in nine */
        left = may_fail ? take(&in) % 24 : -1;
        if (byte / 8 >= 18 && byte < 13 * CALLS) {
            more[byte % MORE](&in);
        } else {
            calls[byte % CALLS](&in);
        }
        left = -1;
    }
    for (int k = 0; k < ANALYSES; k++) {
        free_analysis(k);
    }
    sl_work_free(work);
    work = NULL;
    PROMISE(blocks == 0);
    return 0;
}
