/* cotangent.c: heat on a triangle mesh: its cotangent Laplacian, and a local solve */
#include "example.h"

enum { VERTICES = N, FACES = 2 * (SIDE - 1) * (SIDE - 1) };
static double vertex[VERTICES][3]; /* a curved square; yours comes from a file */
static sl_int face[FACES][3];

static double dot(const double *u, const double *v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

/* M + t L, the mass matrix and the cotangent Laplacian, as its lower triangle. The triplets of all
 * faces are summed. */
static sl_matrix *heat_matrix(double t) {
    static sl_int i[12 * FACES], j[12 * FACES];
    static double a[12 * FACES];
    sl_matrix *M = NULL;
    sl_int f, k, d, n = 0;
    for (f = 0; f < FACES; f++) {
        for (k = 0; k < 3; k++) { /* corner p, its edges u to q and v to r */
            const sl_int p = face[f][k], q = face[f][(k + 1) % 3], r = face[f][(k + 2) % 3];
            double u[3], v[3], area, w;
            for (d = 0; d < 3; d++) {
                u[d] = vertex[q][d] - vertex[p][d];
                v[d] = vertex[r][d] - vertex[p][d];
            }
            area = sqrt(dot(u, u) * dot(v, v) - dot(u, v) * dot(u, v)) / 2;
            w = t * dot(u, v) / (4 * area); /* t times half the cotangent at p */
            i[n] = j[n] = p;
            a[n++] = area / 3;
            i[n] = j[n] = q;
            a[n++] = w;
            i[n] = j[n] = r;
            a[n++] = w;
            i[n] = q > r ? q : r;
            j[n] = q > r ? r : q;
            a[n++] = -w;
        }
    }
    ok(sl_matrix_from_triplets(&M, VERTICES, VERTICES, n, i, j, a, NULL, NULL));
    return M;
}

int main(void) {
    const sl_int source[] = {820}, wanted[] = {820, 821, 861};
    const double heat[] = {1.0};
    double x[3];
    sl_matrix *M = NULL;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_plan *P = NULL;
    sl_csc A;
    int fails;
    sl_int v, f = 0;
    for (v = 0; v < VERTICES; v++) {
        const double s = (double)(v % SIDE) / SIDE, t = (double)(v / SIDE) / SIDE;
        vertex[v][0] = s;
        vertex[v][1] = t;
        vertex[v][2] = s * t;
        if (v % SIDE + 1 < SIDE && v + SIDE < VERTICES) {
            face[f][0] = v;
            face[f][1] = face[f + 1][0] = v + 1;
            face[f][2] = face[f + 1][2] = v + SIDE;
            face[f + 1][1] = v + SIDE + 1;
            f += 2;
        }
    }
    M = heat_matrix(1e-3);
    A = sl_matrix_view(M);
    ok(sl_symbolic_create(&S, &A, NULL, NULL));                 /* once per pattern */
    ok(sl_factor_create(&F, S, &A, NULL, NULL));                /* once per matrix */
    ok(sl_plan_create(&P, S, source, 1, wanted, 3, NULL, NULL));
    ok(sl_plan_solve(P, F, x, 3, heat, 1, 1, NULL));            /* any number of times */
    printf("heat at the source %g, beside it %g, two edges away %g\n", x[0], x[1], x[2]);
    fails = !(x[0] > x[1] && x[1] > x[2] && x[2] > 0.0);
    sl_plan_free(P);
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(M);
    return fails;
}
