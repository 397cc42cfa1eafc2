/* thin_view.c: a camera for a mesh that is much longer than wide, by its principal axes */
#include "thin_view.h"

#include <math.h>
#include <string.h>

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(double out[3], const double *a, const double *b) {
    for (int d = 0; d < 3; d++) {
        const int e = (d + 1) % 3, f = (d + 2) % 3;
        out[d] = a[e] * b[f] - a[f] * b[e];
    }
}

/* The covariance of the corners of all faces, up to a factor. False: it is not finite. */
static bool covariance_of(double C[3][3], const mesh *m) {
    const size_t corners = 3 * (size_t)m->n_faces;
    double mean[3] = {0, 0, 0}, size = 0;
    for (size_t k = 0; k < corners; k++) {
        for (size_t d = 0; d < 3; d++) {
            mean[d] += m->xyz[3 * (size_t)m->faces[k] + d] / (double)corners;
        }
    }
    for (size_t k = 0; k < corners; k++) {
        for (size_t d = 0; d < 3; d++) {
            size = fmax(size, fabs(m->xyz[3 * (size_t)m->faces[k] + d] - mean[d]));
        }
    }
    memset(C, 0, 9 * sizeof(double));
    for (size_t k = 0; k < corners; k++) {
        const double *x = m->xyz + 3 * (size_t)m->faces[k];
        for (int i = 0; i < 9; i++) {
            C[i / 3][i % 3] += (x[i / 3] - mean[i / 3]) / size * ((x[i % 3] - mean[i % 3]) / size);
        }
    }
    return isfinite(C[0][0] + C[1][1] + C[2][2]);
}

/* The longest axis: powers of C, which is far from the others where that is asked for. Returns the
 * deviation along it. */
static double longest_axis(double out[3], double C[3][3]) {
    enum { STEPS = 40 };
    int largest = C[1][1] > C[0][0] ? 1 : 0;
    largest = C[2][2] > C[largest][largest] ? 2 : largest;
    double value = 0;
    memcpy(out, C[largest], 3 * sizeof *out);
    for (int step = 0; step < STEPS; step++) {
        const double y[3] = {dot(C[0], out), dot(C[1], out), dot(C[2], out)};
        value = sqrt(dot(y, y));
        for (int d = 0; d < 3 && value > 0; d++) {
            out[d] = y[d] / value;
        }
    }
    return sqrt(value);
}

/* The longer axis across the first one. Returns the deviation along it. */
static double second_axis(double out[3], double C[3][3], const double *first) {
    const int axis = fabs(first[0]) < fabs(first[1]) ? 0 : 1;
    double unit[3] = {0, 0, 0}, u[3], v[3], image[2][3];
    unit[fabs(first[2]) < fabs(first[axis]) ? 2 : axis] = 1;
    cross(u, first, unit);
    const double length = sqrt(dot(u, u));
    for (int d = 0; d < 3; d++) {
        u[d] /= length;
    }
    cross(v, first, u);
    for (int d = 0; d < 3; d++) {
        image[0][d] = dot(C[d], u);
        image[1][d] = dot(C[d], v);
    }
    const double a = dot(u, image[0]), b = dot(u, image[1]), c = dot(v, image[1]);
    const double angle = 0.5 * atan2(2 * b, a - c);
    for (int d = 0; d < 3; d++) {
        out[d] = cos(angle) * u[d] + sin(angle) * v[d];
    }
    return sqrt(fmax(0, 0.5 * (a + c) + hypot(0.5 * (a - c), b)));
}

bool thin_view_turn(double axes[3][3], const mesh *m, double slope) {
    const double thin = 10;
    double C[3][3], along[3], across[3], toward[3];
    if (m->n_faces == 0 || !covariance_of(C, m)) {
        return false;
    }
    const double length = longest_axis(along, C);
    if (!(length > thin * second_axis(across, C, along))) {
        return false;
    }
    const double turn = 0.9 * atan(slope), upward = dot(across, axes[1]) < 0 ? -1 : 1;
    for (int d = 0; d < 3; d++) {
        across[d] *= upward;
    }
    cross(toward, along, across);
    const double sign = dot(toward, axes[2]) < 0 ? -1 : 1;
    for (int d = 0; d < 3; d++) {
        axes[0][d] = cos(turn) * sign * along[d] - sin(turn) * across[d];
        axes[1][d] = sin(turn) * sign * along[d] + cos(turn) * across[d];
        axes[2][d] = sign * toward[d];
    }
    return true;
}
