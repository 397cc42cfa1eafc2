/* measure_costs.c: what is the row of this machine in the table of src/impl/inverse/costs.h? */
#define SL_STATIC
#define SPARSE_LOCAL_IMPLEMENTATION
#include "sparse_local.h" /* with the implementation: this file runs its sweeps */

#include <stdio.h>
#include <stdlib.h>

/* Each number is the median over several grids, or a fit to them; each time is the least of some
 * runs. The machine should be idle. */
#define FRONT_SECONDS 0.4e-6 /* SLI_CHANGE_FRONT(flop) is FRONT_SECONDS + FRONT_FLOPS flop */
#define FRONT_FLOPS 20000.0
#define INPUT_SECONDS 2.5e-9 /* SLI_CHANGE_INPUT */
enum { SYSTEMS = 5, KINDS = 4, RUNS = 7, COLUMNS = 200, UNKNOWNS = 3 };

/* A grid of a x b x c vertices, and what was measured on it. */
typedef struct grid {
    sl_int a, b, c;
    double sweep[KINDS];    /* seconds for an entry of L, by lanes */
    double flop;            /* seconds */
    double inverse;         /* seconds of the diagonal of the inverse */
    double terms[UNKNOWNS]; /* fronts, entries and flops of the inverse */
} grid;

static void check(sl_status status) {
    if (status != SL_OK) {
        fprintf(stderr, "measure_costs: status %d\n", (int)status);
        exit(1);
    }
}

static double least(double a, double b) {
    return a < b ? a : b;
}

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *list, int count) {
    qsort(list, (size_t)count, sizeof *list, compare);
    return list[count / 2];
}

/* The lower triangle of the Laplacian of a grid, with 0.01 added to the diagonal. */
static sl_matrix *grid_matrix(const grid *g) {
    const sl_int n = g->a * g->b * g->c;
    sl_int *i = (sl_int *)malloc(4 * (size_t)n * sizeof *i),
           *j = (sl_int *)malloc(4 * (size_t)n * sizeof *j);
    double *x = (double *)malloc(4 * (size_t)n * sizeof *x);
    sl_off count = 0;
    sl_int k, d;
    sl_matrix *A = NULL;
    if (i == NULL || j == NULL || x == NULL) {
        check(SL_ERR_MEMORY);
        return NULL;
    }
    for (k = 0; k < n; k++) {
        const sl_int at[3] = {k % g->a, k / g->a % g->b, k / g->a / g->b};
        const sl_int size[3] = {g->a, g->b, g->c}, step[3] = {1, g->a, g->a * g->b};
        double sum = 0.01;
        for (d = 0; d < 3; d++) {
            sum += (at[d] > 0) + (at[d] + 1 < size[d]);
            if (at[d] + 1 < size[d]) {
                i[count] = k + step[d];
                j[count] = k;
                x[count++] = -1.0;
            }
        }
        i[count] = j[count] = k;
        x[count++] = sum;
    }
    check(sl_matrix_from_triplets(&A, n, n, count, i, j, x, NULL, NULL));
    free(i);
    free(j);
    free(x);
    return A;
}

/* Forward sweeps from random columns, for 1, 2, 4 and 8 lanes, with compiling the reach. */
static void measure_sweeps(grid *g, const sl_factor *F) {
    const sl_symbolic *S = F->S;
    const sl_allocator *a = &F->allocator; /* kernels need 64-byte alignment */
    const size_t scratch = sli_sweep_scratch(S->tallest, S->widest, 1) +
                           sli_sweep_scratch(S->tallest, S->widest, 2) +
                           sli_sweep_scratch(S->tallest, S->widest, 8);
    double *x = (double *)sli_alloc(a, 8 * (size_t)S->n * sizeof *x);
    double *buffer = (double *)sli_alloc(a, scratch * sizeof *buffer);
    sli_step *steps = (sli_step *)sli_alloc(a, (size_t)S->n_supers * sizeof *steps);
    sl_int *rows = (sl_int *)sli_alloc(a, ((size_t)S->rows_begin[S->n_supers] + 1) * sizeof *rows);
    int kind, run, k;
    if (x == NULL || buffer == NULL || steps == NULL || rows == NULL) {
        check(SL_ERR_MEMORY);
    }
    for (kind = 0; kind < KINDS; kind++) {
        double best = HUGE_VAL, entries = 0.0;
        for (run = 0; run < RUNS; run++) {
            uint64_t random = 1;
            const double start = sli_seconds();
            for (k = 0, entries = 0.0; k < COLUMNS; k++) {
                sli_reach R;
                uint64_t seed;
                random = random * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
                seed = sli_keyed((sl_int)((random >> 33) % (uint64_t)S->n), 0);
                sli_reach_measure(S, &seed, 1, &R);
                sli_reach_fill(S, &seed, 1, steps, rows, &R);
                memset(x, 0, ((size_t)R.columns << kind) * sizeof *x);
                x[0] = 1.0;
                sli_forward_sweep(F, kind, &R, x, buffer);
                entries += (double)R.entries;
            }
            best = least(best, sli_seconds() - start);
        }
        g->sweep[kind] = best / entries;
    }
    sli_free(a, x);
    sli_free(a, buffer);
    sli_free(a, steps);
    sli_free(a, rows);
}

/* The diagonal of the inverse, by a traversal of all fronts. */
static void measure_inverse(grid *g, const sl_factor *F) {
    const sl_symbolic *S = F->S;
    double *out = (double *)malloc((size_t)S->n * sizeof *out);
    sl_work *W = NULL;
    sl_int s;
    int run;
    if (out == NULL) {
        check(SL_ERR_MEMORY);
    }
    check(sl_work_create(&W, NULL));
    g->inverse = HUGE_VAL;
    for (run = 0; run < RUNS; run++) {
        const double start = sli_seconds();
        check(sl_inverse_diagonal(F, out, NULL, SL_ALL, W, NULL));
        g->inverse = least(g->inverse, sli_seconds() - start);
    }
    g->terms[0] = S->n_supers;
    g->terms[1] = g->terms[2] = 0.0;
    for (s = 0; s < S->n_supers; s++) {
        const double h = S->steps[s].width + S->steps[s].below;
        g->terms[1] += h * h;
        g->terms[2] += sli_front_flops(&S->steps[s]);
    }
    sl_work_free(W);
    free(out);
}

static void measure(grid *g, sl_isa isa) {
    sl_matrix *M = grid_matrix(g);
    const sl_csc A = sl_matrix_view(M);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_options opt;
    double best = HUGE_VAL;
    int run;
    memset(&opt, 0, sizeof opt);
    opt.isa = isa;
    check(sl_symbolic_create(&S, &A, NULL, NULL));
    check(sl_factor_create(&F, S, &A, &opt, NULL));
    for (run = 0; run < RUNS; run++) {
        const double start = sli_seconds();
        check(sl_factor_refactor(F, &A, NULL));
        best = least(best, sli_seconds() - start);
    }
    g->flop = (best - FRONT_SECONDS * S->n_supers -
               INPUT_SECONDS * (double)S->scatter_begin[S->n_supers]) /
              (S->stats.symbolic.flops + FRONT_FLOPS * S->n_supers);
    measure_sweeps(g, F);
    measure_inverse(g, F);
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(M);
}

/* x >= 0 minimizes the sum of the squares of the relative errors of terms' x against the times, by
 * descent along one unknown after the other. */
static void fit(const grid *grids, double *x) {
    int sweep, u, k, v;
    for (sweep = 0; sweep < 20000; sweep++) {
        for (u = 0; u < UNKNOWNS; u++) {
            double top = 0.0, bottom = 0.0;
            for (k = 0; k < SYSTEMS; k++) {
                const double weight = 1.0 / grids[k].inverse, t = grids[k].terms[u] * weight;
                double rest = 1.0;
                for (v = 0; v < UNKNOWNS; v++) {
                    rest -= v != u ? grids[k].terms[v] * weight * x[v] : 0.0;
                }
                top += t * rest;
                bottom += t * t;
            }
            x[u] = top > 0.0 ? top / bottom : 0.0;
        }
    }
}

static void print_row(sl_isa isa) {
    static const char *const names[] = {"", "plain C", "AVX2", "AVX-512", "others"};
    grid grids[SYSTEMS] = {{100, 100, 1, {0}, 0, 0, {0}},
                           {200, 200, 1, {0}, 0, 0, {0}},
                           {316, 316, 1, {0}, 0, 0, {0}},
                           {16, 16, 16, {0}, 0, 0, {0}},
                           {25, 25, 25, {0}, 0, 0, {0}}};
    double list[SYSTEMS], x[UNKNOWNS] = {0.0, 0.0, 0.0}, unit, lanes[KINDS], flop;
    int k, kind;
    for (k = 0; k < SYSTEMS; k++) {
        measure(&grids[k], isa);
    }
    for (kind = 0; kind < KINDS; kind++) {
        for (k = 0; k < SYSTEMS; k++) {
            list[k] = grids[k].sweep[kind] / grids[k].sweep[0];
        }
        lanes[kind] = median(list, SYSTEMS);
    }
    for (k = 0; k < SYSTEMS; k++) {
        list[k] = grids[k].sweep[0];
    }
    unit = median(list, SYSTEMS);
    for (k = 0; k < SYSTEMS; k++) {
        list[k] = grids[k].flop;
    }
    flop = median(list, SYSTEMS);
    fit(grids, x);
    printf("    {{%.1f, %.1f, %.1f, %.1f}, %.1f, %.1f, %.2f, %.3fe-9}, /* %s; the unit is %.3g "
           "s */\n",
           lanes[0], lanes[1], lanes[2], lanes[3], x[0] / unit, x[1] / unit, x[2] / unit,
           1e9 * flop, names[isa], unit);
}

/* One row for each instruction set that the processor has. */
int main(void) {
    int isa;
    for (isa = SL_ISA_SCALAR; isa <= SL_ISA_NEON; isa++) {
        if (sli_kernels_select((sl_isa)isa) != NULL) {
            print_row((sl_isa)isa);
        }
    }
    return 0;
}
