/* programs.h: min x'P x / 2 + c'x with A x + s = b and s in cones, for solvers of such programs
 *
 * P and A are compressed columns, P a diagonal. s is 0 in the first rows, then not negative, then
 * in second-order cones. */
#ifndef WORLD_PROGRAMS_H
#define WORLD_PROGRAMS_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct columns {
    int *p, *i;
    double *x;
} columns;

typedef struct program {
    int n, m;
    int zero, positive, cones, cone_size; /* rows; rows of the cones are cones * cone_size */
    columns A, P;
    double *b, *c;
} program;

static unsigned long long random_state = 1;

/* -1 to 1 */
static double uniform(void) {
    random_state = random_state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(random_state >> 11) / 9007199254740992.0 * 2 - 1;
}

static void room(columns *w, int count, int entries) {
    w->p = (int *)calloc((size_t)count + 1, sizeof *w->p);
    w->i = (int *)calloc((size_t)entries, sizeof *w->i);
    w->x = (double *)calloc((size_t)entries, sizeof *w->x);
}

/* Columns are filled in turn. */
static void add(columns *w, int column, int row, double value) {
    int *end = &w->p[column + 1];
    if (*end < w->p[column]) *end = w->p[column];
    w->i[*end] = row;
    w->x[(*end)++] = value;
}

static void close_columns(columns *w, int from, int count) {
    for (int j = from; j < count; j++) {
        if (w->p[j + 1] < w->p[j]) w->p[j + 1] = w->p[j];
    }
}

static void program_free(program *w) {
    free(w->A.p);
    free(w->A.i);
    free(w->A.x);
    free(w->P.p);
    free(w->P.i);
    free(w->P.x);
    free(w->b);
    free(w->c);
}

static program program_of(int n, int m, int entries) {
    program w;
    memset(&w, 0, sizeof w);
    w.n = n;
    w.m = m;
    room(&w.A, n, entries);
    room(&w.P, n, n);
    w.b = (double *)calloc((size_t)m, sizeof *w.b);
    w.c = (double *)calloc((size_t)n, sizeof *w.c);
    return w;
}

/* x, s and y are complementary in the cones, and with b and c the solution. */
static program random_program(int n, int zero, int positive, int cones, int cone_size,
                              double quadratic) {
    const int m = zero + positive + cones * cone_size;
    program w = program_of(n, m, n * m);
    w.zero = zero;
    w.positive = positive;
    w.cones = cones;
    w.cone_size = cone_size;
    double *y = (double *)calloc((size_t)m, sizeof *y), *s = w.b;
    for (int i = 0; i < m; i++) {
        const double v = uniform();
        if (i < zero) {
            y[i] = v;
        } else if (i < zero + positive) {
            /* a linear program has one solution if n rows are active */
            const int is_active = quadratic > 0 || cones > 0 ? v < 0 : i < n;
            *(is_active ? &y[i] : &s[i]) = fabs(v);
        } else {
            s[i] = v;
        }
    }
    for (int k = 0; k < cones; k++) { /* s on the boundary of its cone, y on the opposite ray */
        double *v = s + zero + positive + k * cone_size, *z = y + zero + positive + k * cone_size;
        double square = 0;
        for (int i = 1; i < cone_size; i++) square += v[i] * v[i];
        v[0] = z[0] = sqrt(square);
        for (int i = 1; i < cone_size; i++) z[i] = -v[i];
    }
    for (int j = 0; j < n; j++) {
        const double x = uniform(), p = quadratic * (1.5 + uniform());
        add(&w.P, j, j, p);
        w.c[j] = -p * x;
        for (int i = 0; i < m; i++) {
            if (uniform() > -0.7 && i != j) continue;
            const double a = uniform();
            add(&w.A, j, i, a);
            w.b[i] += a * x;
            w.c[j] -= a * y[i];
        }
    }
    free(y);
    return w;
}

/* min |x - f|^2 / 2 + 0.2 sum t with |x_i - x_j| <= t_ij of neighbors, side x side pixels. */
static program smoothing(int side) {
    const int pixels = side * side, edges = 2 * side * (side - 1);
    program w = program_of(pixels + edges, 2 * edges, 8 * pixels + 2 * edges);
    w.positive = w.m;
    const int below = side * (side - 1); /* edges to the right come first */
    for (int r = 0; r < side; r++) {
        for (int q = 0; q < side; q++) {
            const int j = r * side + q;
            const int edge[4] = {q > 0 ? r * (side - 1) + q - 1 : -1,
                                 q < side - 1 ? r * (side - 1) + q : -1,
                                 r > 0 ? below + j - side : -1, r < side - 1 ? below + j : -1};
            add(&w.P, j, j, 1);
            w.c[j] = -(double)((r / 20 + q / 20) % 2) - 0.3 * uniform();
            for (int k = 0; k < 4; k++) {
                if (edge[k] >= 0) add(&w.A, j, edge[k], k % 2 ? 1 : -1);
            }
            for (int k = 0; k < 4; k++) {
                if (edge[k] >= 0) add(&w.A, j, edges + edge[k], k % 2 ? -1 : 1);
            }
        }
    }
    for (int e = 0; e < edges; e++) {
        add(&w.A, pixels + e, e, -1);
        add(&w.A, pixels + e, edges + e, -1);
        w.c[pixels + e] = 0.2;
    }
    close_columns(&w.P, pixels, w.n);
    return w;
}

#endif
