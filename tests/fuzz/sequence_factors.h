/* sequence_factors.h: the calls of fuzz_sequence.c that make analyses and factors */
#ifndef SL_FUZZ_SEQUENCE_FACTORS_H
#define SL_FUZZ_SEQUENCE_FACTORS_H

#include "sequence_model.h"

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
        opt.pivots = SL_PIVOTS_SKIP_NULL;
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
    sl_stats stats;
    stats.symbolic = sl_symbolic_view(s->S).info;
    PROMISE(stats.symbolic.nnz_a == s->p[s->n]);
    if (no_memory(sl_symbolic_scatter(s->S, scattered, &A, NULL))) {
        return;
    }
    for (int q = 0; q < ENTRIES; q++) {
        v.x[q] *= c[0] + c[1];
    }
    set_dense(s, &v);
    if (form % 2) {
        note_numbers(f, sl_factor_refactor_sums(&f->F, 1, c, terms, 2, NULL, NULL, NULL), &v);
        return;
    }
    free_factor(which);
    f->analysis = analysis;
    const sl_options opt = factor_options(in, f, DOMINANT);
    sl_status status;
    if (form / 2 % 2) {
        sl_factor *both[2];
        sl_int failed = -2;
        status = sl_factor_create_sums(both, 2, s->S, c, terms, 2, &opt, &failed, NULL);
        PROMISE((failed == -1) == (status == SL_OK));
        f->F = both[0];
        if (status == SL_OK) { /* the same matrices again, without an allocation */
            const sl_options run = threaded(opt.threads.count);
            PROMISE(sl_factor_refactor_sums(both, 2, c, terms, 2, &run, NULL, NULL) == SL_OK);
        }
        sl_factor_free(both[1]);
        PROMISE(f->F != NULL || no_memory(status));
        status = f->F ? SL_OK : status;
    } else {
        status = sl_factor_create_sums(&f->F, 1, s->S, c, terms, 2, &opt, NULL, NULL);
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
static void change_columns(input_t *in) {
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
    const sl_status status =
        sl_factor_change_entries(f->F, &A, NULL, columns, NULL, count, NULL, NULL);
    if (f->is_valid) {
        note_numbers(f, status, &v);
    } else {
        PROMISE(is_apart(status) || status == SL_ERR_NOT_FINITE);
    }
}

#endif
