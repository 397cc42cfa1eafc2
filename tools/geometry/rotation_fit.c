/* rotation_fit.c: the rotation nearest to a 3 x 3 matrix */
#include "rotation_fit.h"

#include <math.h>
#include <string.h>

/* Horn's symmetric matrix for M = S / scale. Its trace is 0. */
static void quaternion_form(double N[4][4], const double M[9]) {
    const double xx = M[0], yx = M[1], zx = M[2]; /* y x' by columns: yx is M(1,0) */
    const double xy = M[3], yy = M[4], zy = M[5];
    const double xz = M[6], yz = M[7], zz = M[8];
    N[0][0] = xx + yy + zz;
    N[1][1] = xx - yy - zz;
    N[2][2] = -xx + yy - zz;
    N[3][3] = -xx - yy + zz;
    N[0][1] = N[1][0] = zy - yz;
    N[0][2] = N[2][0] = xz - zx;
    N[0][3] = N[3][0] = yx - xy;
    N[1][2] = N[2][1] = xy + yx;
    N[1][3] = N[3][1] = xz + zx;
    N[2][3] = N[3][2] = yz + zy;
}

/* The determinant of the 3 x 3 matrix that is left without row i and column j. */
static double minor_of(double N[4][4], int i, int j) {
    int r[3], c[3];
    for (int k = 0; k < 3; k++) {
        r[k] = k + (k >= i);
        c[k] = k + (k >= j);
    }
    return N[r[0]][c[0]] * (N[r[1]][c[1]] * N[r[2]][c[2]] - N[r[1]][c[2]] * N[r[2]][c[1]]) -
           N[r[0]][c[1]] * (N[r[1]][c[0]] * N[r[2]][c[2]] - N[r[1]][c[2]] * N[r[2]][c[0]]) +
           N[r[0]][c[2]] * (N[r[1]][c[0]] * N[r[2]][c[1]] - N[r[1]][c[1]] * N[r[2]][c[0]]);
}

/* The eigenvector by Newton's method on the characteristic polynomial, from above its largest
 * root, and a column of the adjugate of N - lambda I. Returns 0 if the root is not well separated,
 * where the adjugate is small. */
static int eigenvector_by_newton(double q[4], double N[4][4], const double M[9]) {
    const double separated = 1e-6; /* the least product of the gaps to the other eigenvalues */
    double c0 = 0, squares = 0, lambda = sqrt(3.0), length2 = 0;
    for (int k = 0; k < 9; k++) {
        squares += M[k] * M[k];
    }
    const double det = M[0] * (M[4] * M[8] - M[5] * M[7]) - M[3] * (M[1] * M[8] - M[2] * M[7]) +
                       M[6] * (M[1] * M[5] - M[2] * M[4]);
    for (int j = 0; j < 4; j++) {
        c0 += (j % 2 ? -1 : 1) * N[0][j] * minor_of(N, 0, j);
    }
    for (int step = 0; step < 50; step++) {
        const double x2 = lambda * lambda;
        const double value = x2 * x2 - 2 * squares * x2 - 8 * det * lambda + c0;
        const double slope = 4 * lambda * x2 - 4 * squares * lambda - 8 * det;
        const double next = slope > 0 ? lambda - value / slope : lambda;
        if (!(next < lambda * (1 - 1e-15))) { /* it falls until rounding stops it */
            break;
        }
        lambda = next;
    }
    for (int k = 0; k < 4; k++) {
        N[k][k] -= lambda;
    }
    int best = 0; /* the adjugate is q q' times a number: its largest diagonal entry */
    double largest = 0;
    for (int k = 0; k < 4; k++) {
        const double entry = fabs(minor_of(N, k, k));
        best = entry > largest ? k : best;
        largest = entry > largest ? entry : largest;
    }
    for (int k = 0; k < 4; k++) {
        q[k] = ((best + k) % 2 ? -1 : 1) * minor_of(N, best, k);
        length2 += q[k] * q[k];
    }
    for (int k = 0; k < 4; k++) {
        N[k][k] += lambda;
        q[k] /= length2 > 0 ? sqrt(length2) : 1;
    }
    return largest > separated;
}

/* The same by Jacobi's rotations: slower, for any N. Overwrites N. */
static void eigenvector_by_jacobi(double q[4], double N[4][4]) {
    double V[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    for (int sweep = 0; sweep < 30; sweep++) {
        double rest = 0;
        for (int i = 0; i < 3; i++) {
            for (int j = i + 1; j < 4; j++) {
                rest += N[i][j] * N[i][j];
                if (N[i][j] == 0) {
                    continue;
                }
                const double theta = (N[j][j] - N[i][i]) / (2 * N[i][j]);
                const double t = (theta < 0 ? -1 : 1) / (fabs(theta) + sqrt(theta * theta + 1));
                const double c = 1 / sqrt(t * t + 1), s = t * c;
                for (int k = 0; k < 4; k++) { /* columns, then rows */
                    const double a = N[k][i], b = N[k][j], v = V[k][i], w = V[k][j];
                    N[k][i] = c * a - s * b;
                    N[k][j] = s * a + c * b;
                    V[k][i] = c * v - s * w;
                    V[k][j] = s * v + c * w;
                }
                for (int k = 0; k < 4; k++) {
                    const double a = N[i][k], b = N[j][k];
                    N[i][k] = c * a - s * b;
                    N[j][k] = s * a + c * b;
                }
            }
        }
        if (!(rest > 1e-32)) {
            break;
        }
    }
    int best = 0;
    for (int k = 1; k < 4; k++) {
        best = N[k][k] > N[best][best] ? k : best;
    }
    for (int k = 0; k < 4; k++) {
        q[k] = V[k][best];
    }
}

double rotation_fit(double R[9], const double S[9]) {
    double M[9], N[4][4], q[4] = {1, 0, 0, 0}, scale = 0, norm2 = 0, trace = 0;
    for (int k = 0; k < 9; k++) {
        scale = fmax(scale, fabs(S[k]));
    }
    for (int k = 0; k < 9; k++) {
        M[k] = scale > 0 ? S[k] / scale : 0;
        norm2 += M[k] * M[k];
    }
    if (scale > 0 && isfinite(norm2)) {
        for (int k = 0; k < 9; k++) {
            M[k] /= sqrt(norm2);
        }
        quaternion_form(N, M);
        if (!eigenvector_by_newton(q, N, M)) {
            eigenvector_by_jacobi(q, N);
        }
    }
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    const double fitted[9] = {
        1 - 2 * (y * y + z * z), 2 * (x * y + w * z),     2 * (x * z - w * y),
        2 * (x * y - w * z),     1 - 2 * (x * x + z * z), 2 * (y * z + w * x),
        2 * (x * z + w * y),     2 * (y * z - w * x),     1 - 2 * (x * x + y * y)};
    for (int k = 0; k < 9; k++) {
        trace += fitted[k] * S[k];
    }
    memcpy(R, fitted, sizeof fitted);
    return trace;
}
