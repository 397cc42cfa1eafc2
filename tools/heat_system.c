/* heat_system.c: a mesh's diffusion operator M + t L, factored and ready to be asked */
#include "heat_system.h"

#include <math.h>
#include <string.h>

#include "laplacian.h"

static void assemble(heat_system *h, const mesh *m, double t) {
    if (!laplacian_system(&h->matrix, m, t)) {
        app_die("the matrix M + t L cannot be made for t = %g: out of range, or no memory", t);
    }
    h->A = sl_matrix_view(h->matrix);
    h->t = t;
}

void heat_system_create(heat_system *h, const mesh *m, double t) {
    memset(h, 0, sizeof *h);
    h->stats.error_row = -1;
    assemble(h, m, t);
    app_must(sl_symbolic_create(&h->S, &h->A, NULL, &h->stats), "analysis", &h->stats);
    app_must(sl_factor_create(&h->F, h->S, &h->A, NULL, &h->stats), "factorization", &h->stats);
}

void heat_system_set_time(heat_system *h, const mesh *m, double t) {
    sl_matrix_free(h->matrix);
    assemble(h, m, t);
    app_must(sl_factor_refactor(h->F, &h->A, &h->stats), "factorization", &h->stats);
}

void heat_system_free(heat_system *h) {
    sl_factor_free(h->F);
    sl_symbolic_free(h->S);
    sl_matrix_free(h->matrix);
    memset(h, 0, sizeof *h);
}

double heat_time_value(const heat_time *h, const mesh *m) {
    if (h->time < 0 || h->scaled < 0 || (h->time > 0 && h->scaled > 0)) {
        app_die_usage("--time and --scaled-time: one of them, and above 0");
    }
    double edge = mesh_mean_edge_length(m);
    double t = h->time > 0 ? h->time : (h->scaled > 0 ? h->scaled : 1) * edge * edge;
    if (!(t > 0) || !isfinite(t)) {
        app_die("no time can be chosen: the mean length of an edge is %g; give --time", edge);
    }
    return t;
}
