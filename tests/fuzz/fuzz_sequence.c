/* fuzz_sequence.c: takes a sequence of calls on a pool of objects from any bytes, with allocations
 * that fail in between; compares every answer with dense matrices */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "sparse_local.h"

#define PROMISE(condition) ((condition) ? (void)0 : abort())

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { MOST = 12, ENTRIES = MOST * MOST, RHS = 9, SET = 2 * MOST, STEPS = 60 };
enum { ANALYSES = 2, FACTORS = 3, PLANS = 3, SELECTED = 2, REGIONS = 2, REQUESTS = 3 };

typedef struct input_t {
    const uint8_t *at, *end;
} input_t;

static int take(input_t *in) {
    return in->at < in->end ? *in->at++ : 0;
}

/* ---- the pool: objects, and what the dense model knows of each ---- */

/* DOMINANT: strictly diagonally dominant, pivots of both signs. LAPLACIAN: null pivots are skipped.
 * WILD: anything, also values that are not finite; only equalities of bits are checked. */
typedef enum kind_t { DOMINANT = 0, LAPLACIAN, WILD } kind_t;

typedef struct analysis_t {
    sl_symbolic *S;
    sl_int n, p[MOST + 1], i[ENTRIES];
} analysis_t;

typedef struct values_t {
    kind_t kind;
    double x[ENTRIES]; /* in the order of the analyzed pattern */
    double a[ENTRIES]; /* dense, a[i + MOST * j] */
} values_t;

typedef struct factor_t {
    sl_factor *F;
    int analysis;
    int is_valid; /* it has numbers, those of v */
    int has_mass;
    double mass[MOST];
    values_t v;
} factor_t;

/* Rows of a set; NULL is passed if it is all of them. */
typedef struct set_t {
    sl_int count, rows[SET];
    int is_all;
} set_t;

typedef struct plan_t {
    sl_plan *P;
    int analysis;
    int region; /* -1: solves go to the roots */
    set_t b, x;
} plan_t;

typedef struct selected_t {
    sl_selected *Z;
    int analysis;
    double a[ENTRIES]; /* the matrix that it is of; it may outlive its factor */
} selected_t;

typedef struct region_t {
    sl_region *R;
    int analysis, factor;
    double a[ENTRIES];
} region_t;

static analysis_t analyses[ANALYSES];
static factor_t factors[FACTORS];
static plan_t plans[PLANS];
static selected_t selected[SELECTED];
static region_t regions[REGIONS];
static sl_work *work;

/* ---- memory: after `left` more allocations all fail, until the call ends ---- */

static long blocks;    /* allocated now */
static long left;      /* negative: no allocation fails */
static int has_failed; /* an allocation of this call failed */

static void *allocate(void *context, size_t bytes) {
    (void)context;
    if (left == 0) {
        has_failed = 1;
        return NULL;
    }
    left -= left > 0;
    void *block = malloc(bytes > 0 ? bytes : 1);
    blocks += block != NULL;
    return block;
}

static void release(void *context, void *block) {
    (void)context;
    blocks--;
    free(block);
}

/* Returns whether a call failed for lack of memory, which it may only if an allocation failed. */
static int no_memory(sl_status status) {
    PROMISE(status != SL_ERR_MEMORY || has_failed);
    return status == SL_ERR_MEMORY;
}

static void run_backwards(void *context, sl_int count, void (*body)(void *data, sl_int k),
                          void *data) {
    (void)context;
    for (sl_int k = count - 1; k >= 0; k--) {
        body(data, k);
    }
}

static sl_options options(void) {
    sl_options opt;
    memset(&opt, 0, sizeof opt);
    opt.allocator.allocate = allocate;
    opt.allocator.release = release;
    return opt;
}

static sl_options threaded(int count) {
    sl_options opt = options();
    opt.threads.count = count;
    opt.threads.run = run_backwards;
    return opt;
}

/* ---- releasing: what borrows an object goes before it ---- */

static void free_plan(plan_t *p) {
    sl_plan_free(p->P);
    p->P = NULL;
}

static void free_region(int which) {
    for (int k = 0; k < PLANS; k++) {
        if (plans[k].P && plans[k].region == which) {
            free_plan(&plans[k]);
        }
    }
    sl_region_free(regions[which].R);
    regions[which].R = NULL;
}

static void free_selected(selected_t *z) {
    sl_selected_free(z->Z);
    z->Z = NULL;
}

static void free_factor(int which) {
    for (int k = 0; k < REGIONS; k++) {
        if (regions[k].factor == which) {
            free_region(k);
        }
    }
    sl_factor_free(factors[which].F);
    factors[which].F = NULL;
}

static void free_analysis(int which) {
    for (int k = 0; k < FACTORS; k++) {
        if (factors[k].analysis == which) {
            free_factor(k);
        }
    }
    for (int k = 0; k < PLANS; k++) {
        if (plans[k].analysis == which) {
            free_plan(&plans[k]);
        }
    }
    for (int k = 0; k < REGIONS; k++) {
        if (regions[k].analysis == which) {
            free_region(k);
        }
    }
    for (int k = 0; k < SELECTED; k++) {
        if (selected[k].analysis == which) {
            free_selected(&selected[k]);
        }
    }
    sl_symbolic_free(analyses[which].S);
    analyses[which].S = NULL;
}

/* ---- the dense model ---- */

static sl_int order_of(const factor_t *f) {
    return analyses[f->analysis].n;
}

static sl_csc view(const analysis_t *s, const double *x) {
    sl_csc A = {s->n, s->n, s->p, s->i, x};
    return A;
}

static void set_dense(const analysis_t *s, values_t *v) {
    memset(v->a, 0, sizeof v->a);
    for (sl_int j = 0; j < s->n; j++) {
        for (sl_int q = s->p[j]; q < s->p[j + 1]; q++) {
            v->a[s->i[q] + MOST * j] = v->x[q];
            v->a[j + MOST * s->i[q]] = v->x[q];
        }
    }
}

/* x = A^-1 b by elimination with partial pivoting. Returns det A. */
static double dense_solve(const double *a, sl_int n, const double *b, double *x) {
    double m[MOST][MOST + 1], det = 1.0;
    for (sl_int i = 0; i < n; i++) {
        for (sl_int j = 0; j < n; j++) {
            m[i][j] = a[i + MOST * j];
        }
        m[i][n] = b[i];
    }
    for (sl_int k = 0; k < n; k++) {
        sl_int best = k;
        for (sl_int i = k + 1; i < n; i++) {
            best = fabs(m[i][k]) > fabs(m[best][k]) ? i : best;
        }
        for (sl_int j = 0; j <= n; j++) {
            const double keep = m[k][j];
            m[k][j] = m[best][j];
            m[best][j] = keep;
        }
        det *= best == k ? m[k][k] : -m[k][k];
        for (sl_int i = k + 1; i < n; i++) {
            const double l = m[i][k] / m[k][k];
            for (sl_int j = k; j <= n; j++) {
                m[i][j] -= l * m[k][j];
            }
        }
    }
    for (sl_int k = n - 1; k >= 0; k--) {
        x[k] = m[k][n];
        for (sl_int j = k + 1; j < n; j++) {
            x[k] -= m[k][j] * x[j];
        }
        x[k] /= m[k][k];
    }
    return det;
}

static double largest(const double *x, sl_int n) {
    double most = 0.0;
    for (sl_int k = 0; k < n; k++) {
        most = fmax(most, fabs(x[k]));
    }
    return most;
}

/* component[i] = the smallest row connected to i by nonzero entries */
static void find_components(const double *a, sl_int n, sl_int *component) {
    for (sl_int i = 0; i < n; i++) {
        component[i] = i;
    }
    for (sl_int round = 0; round < n; round++) {
        for (sl_int i = 0; i < n; i++) {
            for (sl_int j = 0; j < n; j++) {
                if (a[i + MOST * j] != 0.0 && component[j] < component[i]) {
                    component[i] = component[j];
                }
            }
        }
    }
}

/* Sums of b over the components, at their smallest rows. The values are eighths: sums are exact. */
static int is_consistent(const factor_t *f, const double *b) {
    const sl_int n = order_of(f);
    sl_int component[MOST];
    double sum[MOST] = {0.0};
    find_components(f->v.a, n, component);
    for (sl_int i = 0; i < n; i++) {
        sum[component[i]] += b[i];
    }
    return largest(sum, n) == 0.0;
}

/* Checks A x = b, or for a Laplacian with mass m: A x = b - c m with sum m x = 0 per component. */
static void check_laplacian(const factor_t *f, const double *x, const double *b) {
    const sl_int n = order_of(f);
    sl_int component[MOST];
    double sum_b[MOST] = {0.0}, sum_m[MOST] = {0.0}, sum_mx[MOST] = {0.0}, size = largest(b, n);
    find_components(f->v.a, n, component);
    for (sl_int i = 0; i < n; i++) {
        const sl_int c = component[i];
        sum_b[c] += b[i];
        sum_m[c] += f->mass[i];
        sum_mx[c] += f->mass[i] * x[i];
        for (sl_int j = 0; j < n; j++) {
            size = fmax(size, fabs(f->v.a[i + MOST * j] * x[j]));
        }
    }
    for (sl_int i = 0; i < n; i++) {
        const sl_int c = component[i];
        double residual = b[i] - (f->has_mass ? sum_b[c] / sum_m[c] * f->mass[i] : 0.0);
        for (sl_int j = 0; j < n; j++) {
            residual -= f->v.a[i + MOST * j] * x[j];
        }
        PROMISE(fabs(residual) <= 1e-11 * size);
        PROMISE(!f->has_mass || fabs(sum_mx[c]) <= 1e-11 * size * MOST);
    }
}

static void check_solution(const factor_t *f, const double *x, const double *b) {
    const sl_int n = order_of(f);
    double y[MOST];
    if (f->v.kind == LAPLACIAN) {
        check_laplacian(f, x, b);
    } else if (f->v.kind == DOMINANT) {
        (void)dense_solve(f->v.a, n, b, y);
        for (sl_int i = 0; i < n; i++) {
            PROMISE(fabs(x[i] - y[i]) <= 1e-11 * largest(y, n));
        }
    }
}

static void check_same(double x, double y) {
    PROMISE(x == y || (isnan(x) && isnan(y)));
}

/* ---- values from the input ---- */

static double take_eighths(input_t *in) {
    return (take(in) - 128) / 8.0;
}

static double take_wild(input_t *in) {
    static const double odd[8] = {1e300, -1e300, NAN, 0.0, 1.0 / 3.0, 5e-324, INFINITY, 1e16};
    const int byte = take(in);
    return byte >= 248 ? odd[byte - 248] : (byte - 124) / 8.0;
}

static void take_values(input_t *in, const analysis_t *s, kind_t kind, values_t *v) {
    double sum[MOST] = {0.0};
    memset(v->x, 0, sizeof v->x);
    v->kind = kind;
    for (sl_int j = 0; j < s->n; j++) {
        for (sl_int q = s->p[j]; q < s->p[j + 1]; q++) {
            const sl_int i = s->i[q];
            if (kind == WILD) {
                v->x[q] = take_wild(in);
            } else if (i != j) {
                v->x[q] = kind == LAPLACIAN ? -1.0 - take(in) % 16 / 8.0 : take_eighths(in);
                sum[i] += fabs(v->x[q]);
                sum[j] += fabs(v->x[q]);
            }
        }
    }
    for (sl_int j = 0; j < s->n && kind != WILD; j++) {
        for (sl_int q = s->p[j]; q < s->p[j + 1]; q++) {
            if (s->i[q] == j) {
                v->x[q] = kind == LAPLACIAN ? sum[j] : 1.25 * sum[j] + 1.0;
                v->x[q] *= kind == DOMINANT && take(in) % 4 == 0 ? -1.0 : 1.0;
            }
        }
    }
    set_dense(s, v);
}

/* Any rows, some of them twice. */
static void take_set(input_t *in, sl_int n, set_t *set) {
    const int form = take(in);
    set->is_all = form >= 240;
    set->count = set->is_all ? n : n > 0 ? form % (SET + 1) : 0;
    for (sl_int k = 0; k < set->count; k++) {
        set->rows[k] = set->is_all ? k : take(in) % n;
    }
}

static const sl_int *rows_of(const set_t *set) {
    return set->is_all ? NULL : set->rows;
}

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

static sl_options factor_options(input_t *in, factor_t *f, kind_t kind) {
    const int choices = take(in);
    sl_options opt = threaded(choices % 4);
    opt.isa = choices / 4 % 2 ? SL_ISA_SCALAR : SL_ISA_AUTO;
    opt.method = (sl_method)(choices / 8 % 3);
    f->has_mass = 0;
    if (kind == LAPLACIAN) {
        opt.null_pivots = SL_NULL_PIVOT_SKIP;
        f->has_mass = choices / 32 % 2;
        opt.mass = f->has_mass ? f->mass : NULL;
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
    take_values(in, s, kind, &v);
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

/* Fills B with eighths and adds it to the right-hand sides of the full solve. */
static void take_right_hand_sides(input_t *in, const set_t *b, sl_int nrhs, double *B,
                                  double *full) {
    memset(full, 0, MOST * RHS * sizeof *full);
    const int is_balanced = take(in) % 2;
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
                PROMISE(fabs(local - value) <= 1e-11 * largest(full + MOST * r, MOST));
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
            f->v.kind != LAPLACIAN || f->has_mass || is_consistent(f, full_b + MOST * r);
        if (reference == SL_OK) {
            check_solution(f, full + MOST * r, full_b + MOST * r);
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
            PROMISE(fabs(d[k] - expected) <= 1e-11 * fabs(expected));
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
        PROMISE(fabs(out[k] - inverse[i + MOST * j]) <= 1e-11 * entry_size(inverse, i, j));
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
            PROMISE(status != SL_OK || fabs(block[k + SET * l] - value) <= 1e-11 * most);
            exact += b[k] * c[l] * value;
            size += fabs(b[k] * c[l]) * most;
        }
    }
    status = sl_inverse_bilinear(f->F, &form_value, rows_of(&rows), b, rows.count,
                                 rows_of(&columns), c, columns.count, W, NULL);
    PROMISE(status == expected || no_memory(status));
    PROMISE(status != SL_OK || !is_known || fabs(form_value - exact) <= 1e-11 * size);
}

static void query(input_t *in) {
    const factor_t *f = &factors[take(in) % FACTORS];
    double log_abs_det = 0.0, sign = 0.0, rcond = -1.0, B[MOST * RHS], X[MOST * RHS], b[MOST];
    sl_int count = -1, rows[MOST], component[MOST], roots = 0;
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
    if (f->is_valid && f->v.kind == LAPLACIAN) {
        find_components(f->v.a, s->n, component);
        for (sl_int k = 0; k < s->n; k++) {
            roots += component[k] == k;
        }
        PROMISE(count == roots);
        PROMISE(status != SL_OK || (s->n == 0 ? rcond == 1.0 : rcond == 0.0));
    } else if (f->is_valid && f->v.kind == DOMINANT) {
        memset(b, 0, sizeof b);
        const double det = dense_solve(f->v.a, s->n, b, b);
        PROMISE(count == 0 && sign == (det < 0.0 ? -1.0 : 1.0));
        PROMISE(fabs(log_abs_det - log(fabs(det))) <= 1e-11 * (1.0 + fabs(log_abs_det)));
        PROMISE(status != SL_OK || (rcond > 0.0 && rcond <= 1.0 + 1e-9));
        PROMISE(refined != SL_OK || stats.refine.backward_error <= 4e-15);
        for (sl_int r = 0; refined == SL_OK && r < nrhs; r++) {
            check_solution(f, X + MOST * r, B + MOST * r);
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
    if (is_planned) {
        status = sl_plan_solve(p->P, f->F, X, SET, B, SET, nrhs, work);
        PROMISE(status == SL_OK || (p->region >= 0 && status == SL_ERR_STATE));
        status = sl_plan_solve_refined(p->P, f->F, X, SET, B, SET, nrhs, 2, work, NULL);
        PROMISE(status == SL_OK || (p->region >= 0 && status == SL_ERR_STATE));
    }
    PROMISE(!has_failed && sl_work_bytes(work) == bytes);
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
    const sl_options opt = threaded(1 + take(in) % 4);
    memset(X, 0, sizeof X);
    const sl_status status = sl_batch_solve(NULL, requests, count, &opt, NULL, &failed);
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
    enum { CALLS = (int)(sizeof calls / sizeof calls[0]) };
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
        left = byte >= 13 * CALLS ? take(&in) % 24 : -1; /* one call in twelve may fail */
        calls[byte % CALLS](&in);
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
