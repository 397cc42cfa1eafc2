/* judge_systems.h: more families of random systems: meshes, elastic bodies, trees, saddle points,
 * scaled, graded and Hermitian ones, singular ones among them */
#ifndef SL_TEST_JUDGE_SYSTEMS_H
#define SL_TEST_JUDGE_SYSTEMS_H

#include "dense_reference.h"
#include "elasticity.h"
#include "judge_matrices.h"

enum { JUDGE_OWN = 21, JUDGE_FAMILIES = SYSTEM_FAMILIES + JUDGE_OWN };

/* A matrix and the options for its factorization. */
typedef struct judge_system_t {
    gen_matrix_t M;
    sl_int n;
    sl_int *of;   /* n: the first row of each row's component, by nonzero entries */
    int skips;    /* semidefinite: SL_PIVOTS_SKIP_NULL */
    int constant; /* the null vectors are constants */
    int is_complex;
    double *mass;   /* n weights, or NULL */
    double *Z;      /* n x vectors: options.null_vector, or NULL */
    sl_int vectors; /* 0: no Z */
    double regularization;
    sl_int *signs;
    int is_definite;
} judge_system_t;

static inline const char *judge_name(int family) {
    static const char *const names[JUDGE_OWN] = {
        "jittered mesh", "slivers",    "weights, null", "weak bridges", "mass and t L",
        "bi-Laplacian",  "dependent",  "scaled rows",   "dense rows",   "trees",
        "graded",        "duplicates", "elastic 2D",    "elastic 3D",   "dense mass row",
        "Gram",          "connection", "negative",      "signed graph", "mixed scales",
        "KKT of bodies"};
    return family < SYSTEM_FAMILIES ? system_name(family) : names[family - SYSTEM_FAMILIES];
}

static inline void judge_fill(judge_system_t *y, double *M, int family, uint64_t *state) {
    const sl_int n = y->n, m = 2 + gen_below(state, 7);
    y->skips = family <= 3;
    y->is_definite = 1;
    switch (family) {
    case 0:
        judge_mesh(M, n, 0, n, m, 0.49 * judge_uniform(state), 0.0, state);
        break;
    case 1:
        judge_mesh(M, n, 0, n, m, 0.0, system_scale(state, -8.0, 0.0), state);
        break;
    case 2:
        system_grid(M, n, 14.0 * judge_uniform(state), state);
        break;
    case 3:
        judge_bridges(M, n, state);
        break;
    case 4: {
        const double t = system_scale(state, -12.0, 12.0);
        judge_mesh(M, n, 0, n, m, 0.4 * judge_uniform(state), 0.0, state);
        for (sl_int k = 0; k < n * n; k++) {
            M[k] *= t;
        }
        judge_mass(M, n, -2.0, 2.0, state);
        break;
    }
    case 5:
        judge_mesh(M, n, 0, n, m, 0.3 * judge_uniform(state), 0.0, state);
        judge_bilaplacian(M, n, system_scale(state, -6.0, 12.0), state);
        break;
    case 6: /* the last constraints repeat the first ones, almost */
        y->is_definite = 0;
        system_kkt(M, n, gen_below(state, 2), state);
        for (sl_int i = n - n / 12 - 1; i < n && n > 6; i++) {
            const sl_int like = n - n / 3 + (n - 1 - i) % (n / 6);
            const double e = gen_below(state, 3) ? system_scale(state, -17.0, -2.0) : 0.0;
            for (sl_int j = 0; j < n - n / 3; j++) {
                CELL(M, n, i, j) = CELL(M, n, like, j) * (1.0 + e * gen_real(state));
            }
        }
        break;
    case 7:
        system_grid(M, n, 2.0, state);
        judge_mass(M, n, -2.0, 0.0, state);
        if (gen_below(state, 2)) {
            y->is_definite = 0;
            memset(M, 0, (size_t)n * (size_t)n * sizeof *M);
            system_kkt(M, n, 1, state);
            for (sl_int i = n - n / 3; i < n; i++) {
                CELL(M, n, i, i) = -system_scale(state, -6.0, 0.0);
            }
        }
        system_rescale(M, n, 150.0 * judge_uniform(state), state);
        break;
    case 8:
        system_grid(M, n, 1.0, state);
        judge_mass(M, n, -6.0, 0.0, state);
        for (sl_int r = 0; r < 1 + gen_below(state, 3); r++) {
            const sl_int i = gen_below(state, n);
            for (sl_int j = 0; j < n; j++) {
                if (i != j) {
                    system_spring(M, n, i, j, system_scale(state, -8.0, 0.0));
                }
            }
        }
        break;
    case 9:
        judge_tree(M, n, 10.0 * judge_uniform(state), state);
        y->skips = (int)gen_below(state, 2);
        if (!y->skips) {
            judge_mass(M, n, -10.0, 0.0, state);
        }
        break;
    case 10: {
        const double slope = 40.0 * judge_uniform(state) / (double)n;
        judge_gram(M, n, 2 * n, system_scale(state, -6.0, 0.0), state);
        for (sl_int i = 0; i < n; i++) {
            for (sl_int j = 0; j <= i; j++) {
                CELL(M, n, i, j) *= pow(10.0, -slope * (double)(i + j));
            }
        }
        break;
    }
    case 11:
        system_grid(M, n, 3.0, state);
        judge_mass(M, n, -14.0, -2.0, state);
        break;
    case 14: { /* libigl's heat geodesics: a Laplacian and one dense mass row */
        judge_mesh(M, n, 0, n, m, 0.3 * judge_uniform(state), 0.0, state);
        const double scale = system_scale(state, -4.0, 4.0);
        for (sl_int i = 0; i < n; i++) {
            for (sl_int j = 0; j <= i; j++) {
                CELL(M, n, i, j) += scale / ((double)n * (double)n);
            }
        }
        break;
    }
    case 15:
        judge_gram(M, n, n / 2 + gen_below(state, n),
                   gen_below(state, 3) ? system_scale(state, -15.0, 0.0) : 0.0, state);
        y->skips = (int)gen_below(state, 2);
        break;
    case 17:
        judge_tree(M, n, 4.0 * judge_uniform(state), state);
        y->skips = (int)gen_below(state, 2);
        if (!y->skips) {
            judge_mass(M, n, -4.0, 0.0, state);
        }
        y->is_definite = 0;
        for (sl_int k = 0; k < n * n; k++) {
            M[k] = -M[k];
        }
        break;
    case 18: /* springs of both signs in S L S: the null vector is a vector of signs */
        judge_tree(M, n, 4.0 * judge_uniform(state), state);
        y->skips = 1;
        for (sl_int i = 0; i < n; i++) {
            for (sl_int j = 0; j < i; j++) {
                CELL(M, n, i, j) *= (i ^ j) & 1 ? -1.0 : 1.0;
            }
        }
        break;
    case 19: /* components of very different size */
        judge_bridges(M, n, state);
        judge_mass(M, n, -8.0, 0.0, state);
        for (sl_int i = 0; i < n; i++) {
            for (sl_int j = 0; j <= i; j++) {
                CELL(M, n, i, j) *= i >= n / 2 && j >= n / 2 ? 1e-40 : i >= n / 2 ? 0.0 : 1e30;
            }
        }
        break;
    default: /* an indefinite Hessian that is definite on the constraints, or not */
        y->is_definite = 0;
        judge_mesh(M, n, 0, n - n / 4, m, 0.2, 0.0, state);
        for (sl_int i = n - n / 4; i < n; i++) {
            for (int k = 0; k < 2; k++) {
                CELL(M, n, i, gen_below(state, n - n / 4)) = gen_real(state);
            }
        }
        for (sl_int i = 0; i < n - n / 4; i++) {
            CELL(M, n, i, i) -= gen_below(state, 2) ? 0.0 : 2.0 * judge_uniform(state);
        }
    }
}

/* A connection Laplacian: springs of complex unit weights, with a mass or without; definite, or
 * with complex null vectors that nobody knows. */
static inline void judge_connection(judge_system_t *y, uint64_t *state) {
    const sl_int n = 2 + gen_below(state, 30);
    double *angle = test_reals((size_t)n);
    const int is_flat = (int)gen_below(state, 2);
    const double mass = is_flat && gen_below(state, 2) ? 0.0 : system_scale(state, -8.0, 0.0);
    gen_list_t t = gen_list(2 * n);
    double *diagonal = test_reals((size_t)n);
    y->n = 2 * n;
    gen_reals(angle, (size_t)n, gen_bits(state));
    for (sl_int k = 1; k < n; k++) {
        sl_int before = -1;
        for (int e = 0; e < 3; e++) {
            const sl_int j = e == 0 ? k - 1 : gen_below(state, k);
            const double a = 3.0 * (is_flat ? angle[k] - angle[j] : gen_real(state)),
                         w = judge_uniform(state);
            if (j == before || (e > 0 && j == k - 1)) {
                continue;
            }
            before = j;
            gen_add(&t, 2 * k, 2 * j, -w * cos(a));
            gen_add(&t, 2 * k + 1, 2 * j, -w * sin(a));
            gen_add(&t, 2 * k, 2 * j + 1, w * sin(a));
            gen_add(&t, 2 * k + 1, 2 * j + 1, -w * cos(a));
            diagonal[k] += w;
            diagonal[j] += w;
        }
    }
    for (sl_int k = 0; k < n; k++) {
        gen_add(&t, 2 * k, 2 * k, diagonal[k] + mass);
        gen_add(&t, 2 * k + 1, 2 * k, 0.0);
        gen_add(&t, 2 * k + 1, 2 * k + 1, diagonal[k] + mass);
    }
    y->is_complex = 1;
    y->is_definite = 1;
    y->skips = mass == 0.0;
    y->M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    free(angle);
    free(diagonal);
}

static inline void judge_elastic(judge_system_t *y, int dim, uint64_t *state) {
    elastic_t e = elastic_make(dim, dim == 2 ? 6 : 3, 3.0 * judge_uniform(state),
                               system_scale(state, -2.0, 0.0), system_scale(state, -6.0, 0.0),
                               gen_below(state, 3) > 0, state);
    gen_list_t t = gen_list(e.n);
    const double mass = gen_below(state, 3) ? 0.0 : system_scale(state, -10.0, 0.0);
    for (sl_int j = 0; j < e.n; j++) {
        gen_add(&t, j, j, mass);
        for (sl_int p = e.A.p[j]; p < e.A.p[j + 1]; p++) {
            if (e.A.i[p] == j) {
                t.x[t.count - 1] += e.A.x[p];
            }
        }
        for (sl_int p = e.A.p[j]; p < e.A.p[j + 1]; p++) {
            if (e.A.i[p] > j) {
                gen_add(&t, e.A.i[p], j, e.A.x[p]);
            }
        }
    }
    y->n = e.n;
    y->skips = mass == 0.0;
    y->is_definite = 1;
    y->M = gen_store(&t, gen_style(0), 1);
    if (y->skips) {
        y->vectors = e.rigid;
        y->Z = e.Z;
        e.Z = NULL;
    }
    gen_list_free(&t);
    elastic_free(&e);
}

/* ---- components ---- */

static inline sl_int judge_root(sl_int *of, sl_int i) {
    while (of[i] != i) {
        i = of[i] = of[of[i]];
    }
    return i;
}

/* The first row of each row's component; stored: zeros that are stored join rows, too. */
static inline sl_int *judge_components(const sl_csc *A, int stored) {
    const sl_int n = A->n_cols;
    sl_int *of = test_ints((size_t)n);
    double *D = ref_dense(A);
    char *pattern = ref_pattern(A);
    for (sl_int i = 0; i < n; i++) {
        of[i] = i;
        for (sl_int j = 0; j < i; j++) {
            if (CELL(D, n, i, j) != 0.0 || (stored && CELL(pattern, n, i, j))) {
                const sl_int a = judge_root(of, i), b = judge_root(of, j);
                of[a > b ? a : b] = a > b ? b : a;
            }
        }
    }
    for (sl_int i = 0; i < n; i++) {
        of[i] = judge_root(of, i);
    }
    free(D);
    free(pattern);
    return of;
}

static inline judge_system_t judge_system(int family, uint64_t seed) {
    uint64_t state = seed * 1000003u + (uint64_t)family;
    const int own = family - SYSTEM_FAMILIES;
    judge_system_t y;
    memset(&y, 0, sizeof y);
    if (own < 0) {
        random_system_t s = random_system(family, seed);
        y.n = s.n;
        y.M = s.M;
        y.regularization = s.regularization;
        y.signs = s.signs;
        y.is_definite = s.is_definite;
        free(s.b);
    } else if (own == 12 || own == 13) {
        judge_elastic(&y, own - 10, &state);
    } else if (own == 16) {
        judge_connection(&y, &state);
    } else {
        y.n = 4 + gen_below(&state, 50);
        y.n = gen_below(&state, 24) == 0 ? 120 + gen_below(&state, 60) : y.n;
        double *M = test_reals((size_t)y.n * (size_t)y.n);
        gen_list_t t = gen_list(y.n);
        judge_fill(&y, M, own, &state);
        for (sl_int i = 0; i < y.n; i++) {
            for (sl_int j = 0; j <= i; j++) {
                if (CELL(M, y.n, i, j) != 0.0 || i == j) {
                    gen_add(&t, i, j, CELL(M, y.n, i, j));
                }
            }
        }
        y.M = gen_store(&t, gen_style((int)gen_below(&state, own == 11 ? GEN_STYLES : 3)), seed);
        gen_list_free(&t);
        free(M);
    }
    y.of = judge_components(&y.M.view, 0);
    y.constant = y.skips && (own <= 3 || own == 9 || own == 17);
    if (y.skips && gen_below(&state, 2)) {
        y.mass = judge_weights(y.n, &state);
    }
    return y;
}

static inline void judge_system_free(judge_system_t *y) {
    gen_matrix_free(&y->M);
    free(y->of);
    free(y->mass);
    free(y->Z);
    free(y->signs);
}

#undef CELL

#endif
