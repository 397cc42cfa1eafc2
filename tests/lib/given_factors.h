/* given_factors.h: factors with every option and history, over matrices of every kind */
#ifndef SL_TEST_GIVEN_FACTORS_H
#define SL_TEST_GIVEN_FACTORS_H

#include "saved_pair.h"
#include "test.h"

/* The matrix: PARTS grids of complex rows, which no entry joins, as a real one of N rows. A change
 * is in the last grid, so that the columns of L of the others may be kept. */
enum { PARTS = 4, WIDE = 4, NODES = 3 * WIDE, HALF = PARTS * NODES, N = 2 * HALF };
enum { ROWS = 10, NUMBERS = 2 * N, KINDS = 5 };

/* What the grids are, besides definite: one is singular, has a small pivot, is negative, or has
 * pivots that grow. */
typedef enum kind { DEFINITE, SINGULAR, WEAK, NEGATIVE, GROWING } kind;
static const char *const kind_names[KINDS] = {"definite", "singular", "weak", "negative",
                                              "growing"};

static inline double turn_of(sl_int node) {
    return 1.3 * node + 0.2 * node * node;
}

/* The diagonal of a node with so many neighbors. */
static inline double diagonal_of(kind of, sl_int node, int neighbors) {
    const sl_int part = node / NODES;
    return of == SINGULAR && part == 2                    ? neighbors
           : of == WEAK && part == 1 && node % NODES == 5 ? neighbors + 1e-7
           : of == WEAK && part == 1                      ? neighbors
           : of == NEGATIVE && part == 1                  ? neighbors - 0.9
           : of == GROWING && part == 0 && neighbors == 2 ? 1e-5
                                                          : neighbors + 0.5 + 0.25 * (node % 3);
}

/* Makes the real matrix; changed: with 1 more on the diagonal of a node of the last grid. */
static inline sl_matrix *system_make(kind of, int changed) {
    sl_int p[HALF + 1], i[3 * HALF], e = 0;
    double x[6 * HALF];
    sl_matrix *M = NULL;
    for (sl_int j = 0; j < HALF; j++) {
        const sl_int u = j % WIDE, v = j % NODES / WIDE;
        const int neighbors = (u > 0) + (u + 1 < WIDE) + (v > 0) + (v + 1 < NODES / WIDE);
        p[j] = e;
        for (int k = 0; k < 3; k++) {
            const sl_int row = k == 0 ? j : k == 1 ? j + 1 : j + WIDE;
            if (k == 0 || (k == 1 ? u + 1 < WIDE : v + 1 < NODES / WIDE)) {
                const double a = k == 0 ? diagonal_of(of, j, neighbors) : -1.0;
                i[e] = row;
                x[2 * e] = a * cos(turn_of(row) - turn_of(j));
                x[2 * e + 1] = k == 0 ? 0.0 : a * sin(turn_of(row) - turn_of(j));
                e++;
            }
        }
        x[2 * p[j]] += changed && j == HALF - 3 ? 1.0 : 0.0;
    }
    p[HALF] = e;
    const sl_hermitian H = {HALF, p, i, x, NULL};
    SL_CHECK(sl_matrix_from_hermitian(&M, &H, NULL, NULL));
    return M;
}

/* The largest difference relative to the largest number. */
static inline double difference(const double *x, const double *y) {
    double most = 0.0, error = 0.0;
    for (int k = 0; k < NUMBERS; k++) {
        most = fmax(most, fabs(y[k]));
        error = fmax(error, fabs(x[k] - y[k]));
    }
    return error == 0.0 ? 0.0 : error / most;
}

/* ---- options ---- */

enum { MODES = 36 };

typedef struct world {
    sl_matrix *M[KINDS][2]; /* as they are, and changed */
    sl_symbolic *S[2];      /* for pivots as they come, and for 2x2 pivots */
    double z[3 * N], mass[N];
    sl_int signs[2][N], same[N], rows[ROWS];
    sl_options modes[MODES];
    const char *names[MODES];
    int n_modes;
} world;

static inline sl_options *mode_add(world *w, const char *name) {
    assert_true(w->n_modes < MODES);
    w->names[w->n_modes] = name;
    w->modes[w->n_modes] = options_none();
    return &w->modes[w->n_modes++];
}

static inline sl_options *mode_add_skip(world *w, const char *name) {
    sl_options *opt = mode_add(w, name);
    opt->pivots = SL_PIVOTS_SKIP_NULL;
    opt->null_vector = w->z;
    opt->null_vector_count = 2;
    return opt;
}

static inline sl_options *mode_add_regularized(world *w, const char *name, double by) {
    sl_options *opt = mode_add(w, name);
    opt->regularization = by;
    return opt;
}

/* Each option of a factorization with values that change what it accepts or gives. */
static inline void modes_make(world *w) {
    const isa_list_t isas = isas_present();
    (void)mode_add(w, "none");
    mode_add(w, "isa scalar")->isa = SL_ISA_SCALAR;
    mode_add(w, "isa of the processor")->isa = isas.isa[isas.count - 1];
    mode_add(w, "isa unknown")->isa = (sl_isa)31;
    mode_add(w, "method up-looking")->method = SL_METHOD_UP_LOOKING;
    mode_add(w, "method supernodal")->method = SL_METHOD_SUPERNODAL;
    mode_add(w, "storage float")->storage = SL_STORAGE_FLOAT;
    mode_add(w, "storage complex")->storage = SL_STORAGE_COMPLEX;
    mode_add(w, "pivots positive")->pivots = SL_PIVOTS_POSITIVE;
    (void)mode_add_skip(w, "pivots skipped");
    mode_add(w, "null_tolerance 1e-3")->null_tolerance = 1e-3;
    mode_add(w, "null_tolerance -1")->null_tolerance = -1.0;
    mode_add_skip(w, "skipped, null_tolerance 1e-3")->null_tolerance = 1e-3;
    mode_add(w, "skipped, null_vector unknown")->pivots = SL_PIVOTS_SKIP_NULL;
    mode_add_skip(w, "skipped, null_vector_count 1")->null_vector_count = 1;
    mode_add_skip(w, "skipped, null_vector_count 3")->null_vector_count = 3;
    mode_add_skip(w, "skipped, mass")->mass = w->mass;
    mode_add_skip(w, "skipped, consistency_tolerance -1")->consistency_tolerance = -1.0;
    mode_add_skip(w, "skipped, consistency_tolerance 1e-30")->consistency_tolerance = 1e-30;
    (void)mode_add_regularized(w, "regularization 1e-3", 1e-3);
    (void)mode_add_regularized(w, "regularization 1e-8", 1e-8);
    mode_add_regularized(w, "signs", 1e-3)->signs = w->signs[0];
    mode_add_regularized(w, "signs, any", 1e-3)->signs = w->signs[1];
    mode_add(w, "growth_limit 1.5")->growth_limit = 1.5;
    mode_add(w, "growth_limit 1e3")->growth_limit = 1e3;
    mode_add(w, "growth_limit -1")->growth_limit = -1.0;
    mode_add(w, "error_limit 1e-30")->error_limit = 1e-30;
    mode_add(w, "error_limit -1")->error_limit = -1.0;
}

static inline void world_make(world *w) {
    sl_options opt = options_none();
    memset(w, 0, sizeof *w);
    for (int of = 0; of < KINDS; of++) {
        for (int changed = 0; changed < 2; changed++) {
            w->M[of][changed] = system_make((kind)of, changed);
        }
    }
    for (sl_int k = 0; k < N; k++) {
        const double t = turn_of(k / 2);
        w->z[k] = k % 2 == 0 ? cos(t) : sin(t);
        w->z[N + k] = k % 2 == 0 ? -sin(t) : cos(t);
        w->z[2 * N + k] = 1.0 + (double)(k % 5);
        w->mass[k] = 1.0 + (double)(k / 2 % 3);
        w->signs[0][k] = k / 2 / NODES == 1 ? -1 : 1;
        w->same[k] = k;
    }
    for (sl_int k = 0; k < ROWS; k++) {
        w->rows[k] = 9 * k + 2;
    }
    opt.block_size = 2;
    const sl_csc A = sl_matrix_view(w->M[0][0]);
    SL_CHECK(sl_symbolic_create(&w->S[0], &A, &opt, NULL));
    const sl_csc B = sl_matrix_view(w->M[GROWING][0]);
    SL_CHECK(sl_symbolic_create_pivoted(&w->S[1], &B, NULL, NULL));
    modes_make(w);
}

static inline void world_free(world *w) {
    for (int of = 0; of < KINDS; of++) {
        sl_matrix_free(w->M[of][0]);
        sl_matrix_free(w->M[of][1]);
    }
    sl_symbolic_free(w->S[0]);
    sl_symbolic_free(w->S[1]);
}

/* ---- factors with a history ---- */

typedef enum history {
    REFACTORED, /* it held another matrix before */
    FAILED,     /* its last factorization had failed */
    UPDATED,    /* rank-one changes */
    CHANGED,    /* entries */
    COLUMNS,    /* columns */
    EDITED,     /* follows another factor */
    LOADED,
    MAPPED,
    SUMMED,     /* of scattered terms */
    RESTRICTED, /* to all rows */
    HISTORIES
} history;

static const char *const history_names[HISTORIES] = {
    "refactored", "failed", "updated", "changed", "columns",
    "edited",     "loaded", "mapped",  "summed",  "restricted"};

typedef struct given {
    sl_factor *F;
    sl_symbolic *S; /* of a loaded factor or of a restriction */
    void *memory;
} given;

static inline void given_free(given *g) {
    sl_factor_free(g->F);
    sl_symbolic_free(g->S);
    free(g->memory);
    memset(g, 0, sizeof *g);
}

/* Saves F and takes what is loaded in its place. */
static inline sl_status given_load(given *g, const sl_symbolic *S, sl_isa isa, int is_mapped) {
    sl_options opt = options_none();
    size_t bytes = 0;
    sl_factor *F = NULL;
    sl_status s = pair_save_memory(NULL, &bytes, S, g->F);
    if (s == SL_OK) {
        opt.isa = isa;
        g->memory = test_array(bytes + 64, 1);
        char *at = (char *)g->memory + (64 - (uintptr_t)g->memory % 64) % 64;
        SL_CHECK(pair_save_memory(at, &bytes, S, g->F));
        s = (is_mapped ? pair_map_memory : pair_load_memory)(&g->S, &F, at, bytes, SL_LOAD_VERIFIED,
                                                             &opt);
        if (s == SL_OK) {
            sl_factor_free(g->F);
            g->F = F;
        }
    }
    return s;
}

/* Gives F the changed matrix as the sum of another one, and of the difference. */
static inline sl_status given_sum(given *g, const world *w, kind of) {
    const sl_symbolic *S = sl_factor_view(g->F).symbolic;
    const size_t length = (size_t)scatter_length(S);
    double *terms = test_reals(2 * length);
    const double *const values[2] = {terms, terms + length};
    const double ones[2] = {1.0, 1.0};
    const sl_csc A = sl_matrix_view(w->M[of][0]), B = sl_matrix_view(w->M[of][1]);
    SL_CHECK(sl_symbolic_scatter(S, terms, &A, NULL));
    SL_CHECK(sl_symbolic_scatter(S, terms + length, &B, NULL));
    for (size_t k = 0; k < length; k++) {
        terms[length + k] -= terms[k];
    }
    const sl_status s = sl_factor_refactor_sums(&g->F, 1, ones, values, 2, NULL, NULL, NULL);
    free(terms);
    return s;
}

/* Gives F the changed matrix. */
static inline sl_status given_change(given *g, const world *w, history h, kind of,
                                     const sl_options *opt) {
    const sl_int row = 2 * (HALF - 3), vp[3] = {0, 1, 2}, vi[2] = {row, row + 1};
    const double vx[2] = {1.0, 1.0};
    const sl_csc V = {N, 2, vp, vi, vx}, B = sl_matrix_view(w->M[of][1]);
    sl_factor *G = NULL;
    sl_status s;
    if (h == UPDATED) {
        return sl_factor_rank_update(g->F, &V, NULL, NULL, NULL);
    }
    if (h == SUMMED) {
        return given_sum(g, w, of);
    }
    if (h == CHANGED) {
        return sl_factor_change_entries(g->F, &B, vi, vi, vx, 2, NULL, NULL);
    }
    if (h == COLUMNS) {
        return sl_factor_change_entries(g->F, &B, NULL, vi, NULL, 2, NULL, NULL);
    }
    if (h != EDITED) {
        return sl_factor_refactor(g->F, &B, NULL);
    }
    s = sl_factor_edit(&G, g->F, sl_factor_view(g->F).symbolic, &B, w->same, opt, NULL);
    sl_factor_free(g->F);
    g->F = G;
    return s;
}

/* Makes a factor of the changed matrix with these options and this history. It is NULL if the
 * history refuses one on the way. */
static inline void given_make(given *g, const world *w, int pivoted, const sl_options *opt,
                              history h, kind of) {
    const sl_symbolic *S = w->S[pivoted];
    const kind from = h == REFACTORED ? DEFINITE : h == FAILED ? NEGATIVE : of;
    sl_csc A = sl_matrix_view(w->M[from][0]);
    double *x = NULL;
    sl_status s = sl_factor_create(&g->F, S, &A, opt, NULL);
    if (s == SL_OK && h == FAILED) {
        const size_t entries = (size_t)A.p[N];
        x = test_reals(entries);
        memcpy(x, A.x, entries * sizeof *x);
        x[entries / 2] = (double)INFINITY;
        A.x = x;
        SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_refactor(g->F, &A, NULL));
    }
    s = s == SL_OK ? given_change(g, w, h, of, opt) : s;
    if (s == SL_OK && h == RESTRICTED) {
        const sl_csc B = sl_matrix_view(w->M[of][1]);
        sl_factor *G = NULL;
        s = sl_factor_submatrix(&g->S, &G, g->F, &B, w->same, N, NULL, NULL);
        sl_factor_free(g->F);
        g->F = G;
    }
    if (s == SL_OK && (h == LOADED || h == MAPPED)) {
        s = given_load(g, S, opt->isa, h == MAPPED);
    }
    if (s != SL_OK) {
        given_free(g);
    }
    free(x);
}

#endif
