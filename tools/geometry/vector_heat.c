/* vector_heat.c: parallel transport and the logarithmic map by diffusion, on the mesh or a ball */
#include "vector_heat.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "heat_solver.h"
#include "laplacian.h"
#include "tools/mesh/graph_ball.h"

void vector_heat_free(vector_heat *s) {
    sl_factor_free(s->heat);
    sl_factor_free(s->vectors);
    sl_symbolic_free(s->S);
    sl_symbolic_free(s->complex_S);
    sl_work_free(s->work);
    incidence_free(&s->inc);
    connection_free(&s->frames);
    memset(s, 0, sizeof *s);
}

sl_status vector_heat_create(vector_heat *out, const mesh *m, double t) {
    sl_matrix *A = NULL, *C = NULL;
    sl_options blocks, half;
    memset(out, 0, sizeof *out);
    sl_options_init(&blocks, sizeof blocks);
    sl_options_init(&half, sizeof half);
    blocks.block_size = 2; /* the two real rows of a vertex */
    half.storage = SL_STORAGE_COMPLEX;
    if (!(t > 0 && t <= 1e200) || !mesh_faces_are_in_range(m)) {
        return SL_ERR_ARGUMENT;
    }
    out->m = m;
    out->t = t;
    sl_status status = SL_ERR_MEMORY;
    if (connection_create(&out->frames, m) && incidence_create(&out->inc, m) &&
        laplacian_system(&A, m, t)) {
        status = sl_work_create(&out->work, NULL);
    }
    if (status == SL_OK) {
        const sl_csc view = sl_matrix_view(A);
        status = sl_symbolic_create(&out->S, &view, NULL, NULL);
        status = status == SL_OK ? sl_factor_create(&out->heat, out->S, &view, NULL, NULL) : status;
    }
    status = status == SL_OK ? connection_system(&C, &out->frames, t) : status;
    if (status == SL_OK) {
        const sl_csc view = sl_matrix_view(C);
        status = sl_symbolic_create(&out->complex_S, &view, &blocks, &out->stats);
        status = status == SL_OK
                     ? sl_factor_create(&out->vectors, out->complex_S, &view, &half, &out->stats)
                     : status;
    }
    sl_matrix_free(A);
    sl_matrix_free(C);
    if (status != SL_OK) {
        vector_heat_free(out);
    }
    return status;
}

void vector_field_free(vector_field *f) {
    free(f->vertices);
    free(f->z);
    memset(f, 0, sizeof *f);
}

static double *reals(sl_int count, int width) {
    return (double *)calloc((size_t)count * (size_t)width + 1, sizeof(double));
}

/* Solves with M + t C for b known at some vertices and z wanted at others, all complex. */
static sl_status solve_complex(double *z, vector_heat *s, const sl_int *wanted, sl_int n_wanted,
                               const double *b, const sl_int *known, sl_int n_known,
                               sl_stats *stats) {
    sl_plan *P = NULL;
    sl_status status =
        sl_complex_plan_create(&P, s->complex_S, known, n_known, wanted, n_wanted, NULL, stats);
    if (status == SL_OK) {
        status = sl_plan_solve(P, s->vectors, z, 2 * (size_t)n_wanted, b, 2 * (size_t)n_known, 1,
                               s->work);
    }
    sl_plan_free(P);
    return status;
}

/* Moves the vertices of a ball into an empty field, with room for their vectors. */
static sl_status begin_field(vector_field *out, vector_heat *s, const sl_int *sources, sl_int count,
                             double radius) {
    graph_ball b;
    memset(out, 0, sizeof *out);
    if (count < 1 || !(radius >= 0) || !incidence_vertices_are_distinct(&s->inc, sources, count)) {
        return SL_ERR_ARGUMENT;
    }
    if (!graph_ball_create(&b, &s->inc, sources, count, radius > 0 ? radius : INFINITY)) {
        return SL_ERR_MEMORY;
    }
    out->n = b.n;
    out->vertices = b.vertices;
    b.vertices = NULL;
    graph_ball_free(&b);
    out->z = reals(out->n, 2);
    if (out->z == NULL) {
        vector_field_free(out);
        return SL_ERR_MEMORY;
    }
    return SL_OK;
}

/* Replaces the diffused vectors by ones of the same direction and the length u / h; h has
 * u below it. */
static void set_lengths(vector_field *f, const double *h) {
    const double *u = h + f->n;
    for (size_t k = 0; k < (size_t)f->n; k++) {
        double *z = f->z + 2 * k;
        const double length = hypot(z[0], z[1]);
        const bool is_reached = h[k] > HEAT_MIN;
        f->unreached += !is_reached;
        for (int d = 0; d < 2; d++) {
            z[d] = !is_reached ? NAN : length > 0 ? z[d] / length * (u[k] / h[k]) : 0;
        }
    }
}

sl_status vector_heat_transport(vector_field *out, vector_heat *s, const sl_int *sources,
                                const double *vectors, sl_int count, double radius) {
    sl_status status = begin_field(out, s, sources, count, radius);
    if (status != SL_OK) {
        return status;
    }
    double *h = reals(out->n, 2), *b = reals(count, 2);
    status = h != NULL && b != NULL ? SL_OK : SL_ERR_MEMORY;
    for (size_t k = 0; k < (size_t)count && status == SL_OK; k++) {
        b[k] = 1;
        b[(size_t)count + k] = hypot(vectors[2 * k], vectors[2 * k + 1]);
        status = isfinite(b[(size_t)count + k]) ? SL_OK : SL_ERR_ARGUMENT;
    }
    if (status == SL_OK) {
        status = sl_local_solve(s->heat, sources, count, out->vertices, out->n, h, (size_t)out->n,
                                b, (size_t)count, 2, s->work, NULL);
    }
    if (status == SL_OK) {
        status =
            solve_complex(out->z, s, out->vertices, out->n, vectors, sources, count, &out->stats);
    }
    if (status == SL_OK) {
        set_lengths(out, h);
    }
    free(h);
    free(b);
    if (status != SL_OK) {
        vector_field_free(out);
    }
    return status;
}

/* What one face adds to t sum over edges weight e h_i. */
static void add_face(double *q, const vector_heat *s, sl_int face, const double *h,
                     const sl_int *at) {
    const sl_int *v = s->m->faces + 3 * (size_t)face;
    const laplacian_face measure = laplacian_of_face(s->m, v);
    const double *angle = s->frames.angle + 6 * (size_t)face;
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3; /* the edge from corner a to corner b */
        const double scale = s->t * measure.weight[k] * incidence_edge_length(&s->inc, face, k);
        const double to_b = scale * h[at[b]], to_a = scale * h[at[a]];
        q[2 * (size_t)at[a]] += to_b * cos(angle[2 * a]);
        q[2 * (size_t)at[a] + 1] += to_b * sin(angle[2 * a]);
        q[2 * (size_t)at[b]] += to_a * cos(angle[2 * b + 1]);
        q[2 * (size_t)at[b] + 1] += to_a * sin(angle[2 * b + 1]);
    }
}

/* The right-hand side for q at the vertices of `near`, of the faces between them, whose heat is
 * near_h. Moves the heat at the vertices of f, which are among them, to h. */
static void point_sources(double *q, double *h, vector_heat *s, const vector_field *near,
                          const double *near_h, const vector_field *f) {
    sl_int *number = s->inc.local_index;
    for (sl_int k = 0; k < near->n; k++) {
        number[near->vertices[k]] = k;
    }
    for (sl_int k = 0; k < near->n; k++) {
        const sl_int v = near->vertices[k];
        for (sl_off p = s->inc.begin[v]; p < s->inc.begin[v + 1]; p++) {
            const sl_int face = s->inc.face[p], *corner = s->m->faces + 3 * (size_t)face;
            const sl_int at[3] = {number[corner[0]], number[corner[1]], number[corner[2]]};
            /* each face once, with its first corner */
            if (corner[0] == v && at[1] >= 0 && at[2] >= 0) {
                add_face(q, s, face, near_h, at);
            }
        }
    }
    for (sl_int k = 0; k < f->n; k++) {
        h[k] = near_h[number[f->vertices[k]]];
    }
    for (sl_int k = 0; k < near->n; k++) {
        number[near->vertices[k]] = -1;
    }
}

/* Turns q in the planes of the vertices to logarithms in that of the source: -q / h is moved back
 * along y, the transported vector 1. */
static void move_to_source(vector_field *f, const double *y, const double *h) {
    for (size_t k = 0; k < (size_t)f->n; k++) {
        double *z = f->z + 2 * k;
        const double x = z[0], length = hypot(y[2 * k], y[2 * k + 1]) * h[k];
        const bool is_reached = h[k] > HEAT_MIN && length > 0;
        f->unreached += !is_reached;
        z[0] = is_reached ? -(x * y[2 * k] + z[1] * y[2 * k + 1]) / length : NAN;
        z[1] = is_reached ? -(z[1] * y[2 * k] - x * y[2 * k + 1]) / length : NAN;
    }
}

sl_status vector_heat_logarithm(vector_field *out, vector_heat *s, sl_int source, double radius) {
    const double one[2] = {1, 0};
    vector_field near; /* the ball and what is around it */
    sl_status status = begin_field(out, s, &source, 1, radius);
    if (status != SL_OK) {
        return status;
    }
    status = begin_field(&near, s, &source, 1,
                         radius > 0 ? radius + VECTOR_HEAT_MARGIN * sqrt(s->t) : 0);
    double *near_h = reals(near.n, 1), *h = reals(out->n, 1), *y = reals(out->n, 2);
    if (status == SL_OK) {
        status = near_h != NULL && h != NULL && y != NULL ? SL_OK : SL_ERR_MEMORY;
    }
    if (status == SL_OK) {
        status = sl_local_solve(s->heat, &source, 1, near.vertices, near.n, near_h, (size_t)near.n,
                                one, 1, 1, s->work, NULL);
    }
    if (status == SL_OK) {
        status = solve_complex(y, s, out->vertices, out->n, one, &source, 1, &out->stats);
    }
    if (status == SL_OK) {
        point_sources(near.z, h, s, &near, near_h, out);
        status = solve_complex(out->z, s, out->vertices, out->n, near.z, near.vertices, near.n,
                               &out->stats);
    }
    if (status == SL_OK) {
        move_to_source(out, y, h);
    }
    free(near_h);
    free(h);
    free(y);
    vector_field_free(&near);
    if (status != SL_OK) {
        vector_field_free(out);
    }
    return status;
}
