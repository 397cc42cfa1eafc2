/* solve_accuracy.c: warns where a mesh leaves few digits to the solutions of its systems */
#include "solve_accuracy.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/geometry/laplacian.h"

accuracy_faces accuracy_of_faces(const mesh *m, const double *lengths) {
    const double degree = 3.14159265358979323846 / 180;
    accuracy_faces found = {180, 0, 0};
    for (size_t f = 0; f < (size_t)m->n_faces; f++) {
        const laplacian_face face = lengths != NULL ? laplacian_of_lengths(lengths + 3 * f)
                                                    : laplacian_of_face(m, m->faces + 3 * f);
        const double *w = face.weight, half_cotangent = fmax(w[0], fmax(w[1], w[2]));
        if (w[0] == 0 && w[1] == 0 && w[2] == 0) {
            found.flat++;
            continue;
        }
        double angle = atan2(0.5, half_cotangent) / degree;
        found.angle = fmin(found.angle, angle);
        found.needle += angle < ACCURACY_ANGLE;
    }
    return found;
}

/* A bound of the condition, 1e300 if there is none.
 *
 * If no entry off the diagonal is positive and all rows sum to r > 0, A^-1 has no negative entry,
 * and A^-1 r = 1. Hence ||A^-1 |A|||, by which rounding the entries of A acts on x, is at most the
 * largest quotient of a row of |A| and its sum, whatever the scales of the rows. */
static double condition_bound(const sl_csc *A) {
    size_t n = (size_t)A->n_cols;
    double *sum = app_alloc(n, sizeof *sum), *size = app_alloc(n, sizeof *size), worst = 1;
    bool has_positive = false;
    for (sl_int j = 0; j < A->n_cols; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            const sl_int i = A->i[p];
            sum[j] += A->x[p];
            size[j] += fabs(A->x[p]);
            has_positive = has_positive || (i != j && A->x[p] > 0);
            if (i != j) {
                sum[i] += A->x[p];
                size[i] += fabs(A->x[p]);
            }
        }
    }
    for (size_t i = 0; i < n; i++) {
        worst = sum[i] > 0 ? fmax(worst, size[i] / sum[i]) : 1e300;
    }
    free(size);
    free(sum);
    return has_positive ? 1e300 : worst;
}

/* The condition by sl_factor_rcond. */
static double condition_of(const sl_factor *F, const sl_csc *A) {
    double rcond = 0;
    app_stage("estimating the condition");
    app_must(sl_factor_rcond(F, A, &rcond, NULL), "condition", NULL);
    app_progress_end();
    return rcond > 1e-300 ? 1 / rcond : 1e300;
}

/* Factors A; on failure the message of the command that needs it is better than one from here. */
static void factor(sl_symbolic **S, sl_factor **F, const sl_csc *A) {
    app_stage("estimating the condition");
    if (sl_symbolic_create(S, A, NULL, NULL) != SL_OK ||
        sl_factor_create(F, *S, A, NULL, NULL) != SL_OK) {
        app_warn("no digit of a solution is certain: the matrix of the mesh cannot be factored");
    }
    app_progress_end();
}

/* Appends to a text of `room` characters. */
static void add(char *text, size_t room, const char *format, double a, double b) {
    size_t used = strlen(text);
    (void)snprintf(text + used, room - used, format, a, b);
}

void accuracy_warn(const accuracy_faces *faces, const sl_factor *F, const sl_csc *A) {
    const double limit = pow(10, ACCURACY_DIGITS);
    double condition = A != NULL ? condition_bound(A) : 1;
    sl_symbolic *own_S = NULL;
    sl_factor *own_F = NULL;
    sl_stats stats;
    char text[400] = "";
    memset(&stats, 0, sizeof stats);
    if (condition >= limit && F == NULL) {
        factor(&own_S, &own_F, A);
        F = own_F;
    }
    if (condition >= limit && F != NULL) {
        condition = condition_of(F, A);
    }
    if (F != NULL) {
        stats.factor = sl_factor_view(F).info;
    }
    if (A == NULL && stats.factor.pivot_min > 0) { /* a lower bound for definite matrices */
        condition = stats.factor.pivot_max / stats.factor.pivot_min;
    }
    if (condition >= limit) {
        add(text, sizeof text, "rounding can cost %.0f of 16 digits (condition %.1e); ",
            fmin(16, floor(log10(condition))), condition);
    }
    if (faces != NULL && faces->needle > 0) {
        add(text, sizeof text, "the smallest angle is %.2g degrees, %.0f faces ", faces->angle,
            (double)faces->needle);
        add(text, sizeof text, "have one below %g; ", ACCURACY_ANGLE, 0);
    }
    if (text[0] != '\0' && F != NULL) {
        add(text, sizeof text, "pivots from %.2g to %.2g; ", stats.factor.pivot_min,
            stats.factor.pivot_max);
    }
    if (text[0] != '\0') {
        text[strlen(text) - 2] = '\0';
        app_warn("the mesh makes solutions inaccurate: %s", text);
    }
    sl_factor_free(own_F);
    sl_symbolic_free(own_S);
}

void accuracy_warn_poisson(const mesh *m, const double *lengths, double share) {
    const accuracy_faces faces = accuracy_of_faces(m, lengths);
    sl_matrix *M = NULL;
    double area = 0;
    for (size_t f = 0; f < (size_t)m->n_faces; f++) {
        area += share * (lengths != NULL ? laplacian_of_lengths(lengths + 3 * f)
                                         : laplacian_of_face(m, m->faces + 3 * f))
                            .area;
    }
    if (!(area > 0 && area < 1e200)) {
        accuracy_warn(&faces, NULL, NULL);
        return;
    }
    if (!laplacian_system_of(&M, m, lengths, share, area)) {
        app_die("out of memory for the Laplacian of %d vertices", (int)m->n_vertices);
    }
    const sl_csc A = sl_matrix_view(M);
    accuracy_warn(&faces, NULL, &A);
    sl_matrix_free(M);
}
