/* gen_matrices.h: seeded symmetric test matrices of many kinds, in every storage style */
#ifndef SL_TEST_GEN_MATRICES_H
#define SL_TEST_GEN_MATRICES_H

#include "gen_graphs.h"

/* ---- kinds of matrices ---- */

typedef enum gen_kind_t {
    GEN_NONE,                   /* n = 0 */
    GEN_ONE,                    /* 1 x 1 */
    GEN_DIAGONAL,               /* no edges */
    GEN_PATH,                   /* tridiagonal */
    GEN_STAR,                   /* the first row is adjacent to all others: L is dense */
    GEN_ARROW,                  /* the last row is adjacent to all others: no fill */
    GEN_GRID2,                  /* 5-point */
    GEN_GRID3,                  /* 7-point */
    GEN_FOREST,                 /* several trees */
    GEN_DENSE,                  /* all entries */
    GEN_RANDOM,                 /* each entry with probability 5/n */
    GEN_COMPONENTS,             /* grids, a path and isolated rows side by side */
    GEN_KKT,                    /* quasi-definite [H B'; B -C] */
    GEN_SCALED,                 /* a grid whose rows are scaled by 2^-20 .. 2^20 */
    GEN_REGULAR,                /* the number of kinds before; all of these factor */
    GEN_SINGULAR = GEN_REGULAR, /* Laplacian of a grid: the last pivot is null */
    GEN_EMPTY_ROW,              /* one row without entries */
    GEN_KINDS
} gen_kind_t;

static inline const char *gen_name(gen_kind_t kind) {
    static const char *const names[] = {
        "n = 0",  "1 x 1", "diagonal", "path",       "star", "arrow",  "grid2",    "grid3",
        "forest", "dense", "random",   "components", "KKT",  "scaled", "singular", "empty row"};
    return names[kind];
}

static inline void gen_kkt(gen_list_t *t, uint64_t *state) {
    sl_int m = t->n - t->n / 3;
    gen_list_t H = gen_list(m);
    gen_edges_random(&H, m > 4 ? 3000 / m : 500, state);
    gen_dominate(&H, 1, state);
    for (size_t k = 0; k < H.count; k++) {
        gen_add(t, H.row[k], H.col[k], H.x[k]);
    }
    gen_list_free(&H);
    for (sl_int k = m; k < t->n; k++) {
        for (sl_int step = 0, j = gen_below(state, m); step < 3 && j < m; step++) {
            gen_add(t, k, j, 2.0 * gen_real(state));
            j += 1 + gen_below(state, m);
        }
        gen_add(t, k, k, -0.125 - fabs(gen_real(state)));
    }
}

static inline void gen_components(gen_list_t *t, uint64_t *state) {
    sl_int third = t->n / 3, width = 1;
    while ((width + 1) * (width + 1) <= third) {
        width++;
    }
    gen_edges_grid(t, width, width, 1, state);
    for (sl_int k = third + 1; k < 2 * third; k++) {
        gen_add(t, k, k - 1, gen_real(state));
    }
    for (sl_int k = 2 * third + 2; k < t->n; k += 3) {
        gen_add(t, k, k - 1, gen_real(state));
    }
}

static inline void gen_scale(gen_list_t *t, uint64_t *state) {
    int *power = (int *)test_array((size_t)t->n, sizeof(int));
    for (sl_int k = 0; k < t->n; k++) {
        power[k] = (int)gen_below(state, 41) - 20;
    }
    for (size_t k = 0; k < t->count; k++) {
        t->x[k] = ldexp(t->x[k], power[t->row[k]] + power[t->col[k]]);
    }
    free(power);
}

/* About size rows; grids round down. sign as in gen_dominate, where the kind leaves it open. */
static inline gen_list_t gen_make(gen_kind_t kind, sl_int size, int sign, uint64_t seed) {
    uint64_t state = seed * 1000003u + (uint64_t)kind;
    sl_int square = 1, cube = 1;
    while ((square + 1) * (square + 1) <= size) {
        square++;
    }
    while ((cube + 1) * (cube + 1) * (cube + 1) <= size) {
        cube++;
    }
    sl_int n = kind == GEN_NONE    ? 0
               : kind == GEN_ONE   ? 1
               : kind == GEN_GRID3 ? cube * cube * cube
               : kind == GEN_GRID2 || kind == GEN_SCALED || kind == GEN_SINGULAR ? square * square
                                                                                 : size;
    gen_list_t t = gen_list(n);
    switch (kind) {
    case GEN_PATH:
        gen_edges_path(&t, &state);
        break;
    case GEN_STAR:
        gen_edges_star(&t, 0, &state);
        break;
    case GEN_ARROW:
        gen_edges_star(&t, n - 1, &state);
        break;
    case GEN_GRID2:
    case GEN_SCALED:
    case GEN_SINGULAR:
        gen_edges_grid(&t, square, square, 1, &state);
        break;
    case GEN_GRID3:
        gen_edges_grid(&t, cube, cube, cube, &state);
        break;
    case GEN_FOREST:
        gen_edges_forest(&t, &state);
        break;
    case GEN_DENSE:
        gen_edges_random(&t, 1000, &state);
        break;
    case GEN_RANDOM:
    case GEN_EMPTY_ROW:
        gen_edges_random(&t, n > 5 ? 5000 / n : 1000, &state);
        break;
    case GEN_COMPONENTS:
        gen_components(&t, &state);
        break;
    case GEN_KKT:
        gen_kkt(&t, &state);
        break;
    default:
        break;
    }
    if (kind == GEN_SINGULAR) {
        gen_laplacian(&t);
    } else if (kind != GEN_KKT) {
        gen_dominate(&t, sign, &state);
    }
    if (kind == GEN_SCALED) {
        gen_scale(&t, &state);
    } else if (kind == GEN_EMPTY_ROW) {
        size_t kept = 0;
        for (size_t k = 0; k < t.count; k++) {
            if (t.row[k] != n / 2 && t.col[k] != n / 2) {
                t.row[kept] = t.row[k];
                t.col[kept] = t.col[k];
                t.x[kept++] = t.x[k];
            }
        }
        t.count = kept;
    }
    return t;
}

/* ---- storage styles ---- */

typedef struct gen_style_t {
    sl_triangle triangle; /* LOWER, UPPER or BOTH */
    int unsorted;         /* rows of a column in random order */
    int duplicated;       /* about half of the entries are split into duplicates that sum exactly */
} gen_style_t;

enum { GEN_STYLES = 12 };

static inline gen_style_t gen_style(int which) {
    static const sl_triangle triangles[3] = {SL_TRIANGLE_LOWER, SL_TRIANGLE_UPPER,
                                             SL_TRIANGLE_BOTH};
    gen_style_t style = {triangles[which % 3], which / 3 % 2, which / 6 % 2};
    return style;
}

typedef struct gen_matrix_t {
    sl_int *p, *i;
    double *x;
    sl_csc view;
} gen_matrix_t;

static inline void gen_matrix_free(gen_matrix_t *M) {
    free(M->p);
    free(M->i);
    free(M->x);
}

/* The one or two entries (row, col) that store the triplet (i, j); returns how many. */
static inline int gen_entries(sl_triangle triangle, sl_int i, sl_int j, sl_int row[2],
                              sl_int col[2]) {
    int upper_first = triangle == SL_TRIANGLE_UPPER;
    row[0] = upper_first ? j : i;
    col[0] = upper_first ? i : j;
    row[1] = j;
    col[1] = i;
    return triangle == SL_TRIANGLE_BOTH && i != j ? 2 : 1;
}

static inline gen_matrix_t gen_store(const gen_list_t *t, gen_style_t style, uint64_t seed) {
    size_t n = (size_t)t->n, total = 0;
    unsigned char *parts = (unsigned char *)test_array(t->count, 1);
    sl_int row[2], col[2], *next = test_ints(n + 1);
    for (size_t k = 0; k < t->count; k++) {
        parts[k] =
            (unsigned char)(style.duplicated && gen_bits(&seed) & 1u ? 2 + gen_below(&seed, 2) : 1);
    }
    gen_matrix_t M = {test_ints(n + 1), NULL, NULL, {0, 0, NULL, NULL, NULL}};
    for (size_t k = 0; k < t->count; k++) {
        for (int side = gen_entries(style.triangle, t->row[k], t->col[k], row, col); side-- > 0;) {
            M.p[col[side] + 1] += parts[k];
            total += parts[k];
        }
    }
    for (size_t j = 0; j < n; j++) {
        M.p[j + 1] += M.p[j];
        next[j] = M.p[j];
    }
    M.i = test_ints(total);
    M.x = test_reals(total);
    for (size_t k = 0; k < t->count; k++) {
        for (int side = gen_entries(style.triangle, t->row[k], t->col[k], row, col); side-- > 0;) {
            double left = t->x[k];
            /* x/2, x/4, x/4: their sum is exact in any order */
            for (int part = parts[k]; part-- > 0;) {
                sl_int p = next[col[side]]++;
                M.i[p] = row[side];
                M.x[p] = part ? left / 2 : left;
                left /= 2;
            }
        }
    }
    for (size_t j = 0; j < n; j++) {
        for (sl_int a = M.p[j]; a < M.p[j + 1]; a++) {
            sl_int b = a;
            if (style.unsorted) {
                b += gen_below(&seed, M.p[j + 1] - a);
            } else { /* selection sort: columns are short */
                for (sl_int c = a + 1; c < M.p[j + 1]; c++) {
                    b = M.i[c] < M.i[b] ? c : b;
                }
            }
            sl_int keep_i = M.i[a];
            double keep_x = M.x[a];
            M.i[a] = M.i[b];
            M.x[a] = M.x[b];
            M.i[b] = keep_i;
            M.x[b] = keep_x;
        }
    }
    M.view.n_rows = M.view.n_cols = t->n;
    M.view.p = M.p;
    M.view.i = M.i;
    M.view.x = M.x;
    free(parts);
    free(next);
    return M;
}

/* The lower triangle of edges with a dominant diagonal; name: of the rows, at random; 0: as they
 * are. Frees t. */
static inline gen_matrix_t gen_store_dominant(gen_list_t *t, uint64_t name) {
    uint64_t seed = 5;
    if (name > 0) {
        gen_rename(t, name);
    }
    gen_dominate(t, 1, &seed);
    gen_matrix_t M = gen_store(t, gen_style(0), 1);
    gen_list_free(t);
    return M;
}

/* The default style: lower triangle, rows ascending, no duplicates. */
static inline gen_matrix_t gen_matrix(gen_kind_t kind, sl_int size, int sign, uint64_t seed) {
    gen_list_t t = gen_make(kind, size, sign, seed);
    gen_matrix_t M = gen_store(&t, gen_style(0), seed);
    gen_list_free(&t);
    return M;
}

/* A matrix whose pattern is given by `edges`, one bit for each pair of rows. Values have mixed
 * signs and each row is diagonally dominant, so that no pivot is near 0. */
static inline gen_matrix_t gen_pattern(sl_int n, unsigned edges, uint64_t seed) {
    gen_list_t t = gen_list(n);
    for (sl_int j = 0; j < n; j++) {
        for (sl_int i = j + 1; i < n; i++, edges >>= 1) {
            if (edges & 1u) {
                gen_add(&t, i, j, gen_real(&seed));
            }
        }
    }
    gen_dominate(&t, 0, &seed);
    gen_matrix_t M = gen_store(&t, gen_style((int)(seed % 3)), seed);
    gen_list_free(&t);
    return M;
}

#endif
