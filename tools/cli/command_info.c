/* command_info.c: what a mesh is, and what its factorization costs */
#include <stdlib.h>

#include "app.h"
#include "command.h"
#include "heat_system.h"
#include "mesh_facts.h"

static const options_usage usage = {"info", "MESH", 1, 1,
                                    "Counts the parts and the faults of a mesh, then analyses and "
                                    "factors M + t L (mass plus cotangent Laplacian) and "
                                    "says what each phase costs: entries, height of the "
                                    "elimination tree, weight of the paths to its root, seconds, "
                                    "bytes."};

static void print_facts(const mesh *m, const mesh_facts *f) {
    printf("vertices             %12d   used by a face %d\n", (int)m->n_vertices, (int)f->used);
    printf("faces                %12d   with a vertex twice %d, without area %d\n", (int)m->n_faces,
           (int)f->repeated, (int)f->flat);
    printf("edges                %12lld   border %lld, not manifold %lld, turned over %lld\n",
           (long long)f->edges, (long long)f->border_edges, (long long)f->fan_edges,
           (long long)f->twisted_edges);
    printf("components           %12d   border loops %d, Euler characteristic %lld\n",
           (int)f->components, (int)f->border_loops, (long long)f->euler);
    printf("pinched vertices     %12d   whose faces form several fans\n", (int)f->pinched);
    printf("edge length          %12.6g   from %.6g to %.6g\n", f->edge_mean, f->edge_shortest,
           f->edge_longest);
    printf("angles, degrees      %12.6g   to %.6g\n", f->angle_smallest, f->angle_largest);
    printf("area                 %12.6g   box %.6g x %.6g x %.6g\n", f->area,
           f->high[0] - f->low[0], f->high[1] - f->low[1], f->high[2] - f->low[2]);
}

/* Weight of a vertex's path: the entries of L in the columns from it to the root, what one sweep of a one-vertex
 * question has to read. Parents come after their children, so one pass from the roots finds all. */
static void print_paths(const sl_symbolic *S) {
    sl_symbolic_view_t view = sl_symbolic_view(S);
    double *weight = app_alloc((size_t)view.n, sizeof *weight);
    double sum = 0, largest = 0;
    sl_off *length = app_alloc((size_t)view.n, sizeof *length);
    double length_sum = 0;
    for (sl_int k = view.n - 1; k >= 0; k--) {
        sl_int up = view.parent[k];
        weight[k] = view.counts[k] + (up >= 0 ? weight[up] : 0);
        length[k] = 1 + (up >= 0 ? length[up] : 0);
        sum += weight[k];
        length_sum += (double)length[k];
        largest = weight[k] > largest ? weight[k] : largest;
    }
    double n = view.n > 0 ? view.n : 1;
    printf("path to the root     %12.1f   columns in the mean; entries of L %.1f, at most %.0f\n",
           length_sum / n, sum / n, largest);
    free(length);
    free(weight);
}

static void print_costs(const heat_system *h, double seconds_read, double seconds_solve) {
    const sl_stats *s = &h->stats;
    printf("M + t L              %12d   rows, %lld entries of the lower triangle, t = %.6g\n",
           (int)s->n, (long long)s->nnz_a, h->t);
    printf("nnz(L)               %12lld   %.2f times those; stored %lld in %d supernodes\n",
           (long long)s->nnz_l, (double)s->nnz_l / (double)(s->nnz_a > 0 ? s->nnz_a : 1),
           (long long)s->nnz_panels, (int)s->supernodes);
    printf("elimination tree     %12d   columns high, %d roots\n", (int)s->tree_height,
           (int)s->components);
    print_paths(h->S);
    printf("seconds              read %.4g, assemble %.4g, order %.4g, analyse %.4g, factor %.4g, "
           "full solve %.4g\n",
           seconds_read, h->seconds_assemble, s->seconds_order, s->seconds_analyse,
           s->seconds_setup + s->seconds_factor, seconds_solve);
    printf("megabytes            analysis %.2f, factor %.2f\n", 1e-6 * (double)s->bytes_symbolic,
           1e-6 * (double)s->bytes_factor);
    printf("pivots               from %.4g to %.4g\n", s->pivot_min, s->pivot_max);
}

static double time_solve(const heat_system *h) {
    size_t n = (size_t)h->n;
    double *b = app_alloc(n, sizeof *b), *x = app_alloc(n, sizeof *x);
    for (size_t k = 0; k < n; k++) {
        b[k] = 1;
    }
    sl_work *W = NULL;
    app_must(sl_work_create(&W, NULL), "workspace", NULL);
    app_must(sl_factor_solve(h->F, x, n, b, n, 1, W), "solve", NULL); /* grows W */
    double begin = app_now();
    app_must(sl_factor_solve(h->F, x, n, b, n, 1, W), "solve", NULL);
    double seconds = app_now() - begin;
    sl_work_free(W);
    free(x);
    free(b);
    return seconds;
}

int command_info(int argc, char **argv) {
    const char *operand = NULL;
    heat_time time = {0, 0, 0};
    bool mesh_only = false;
    const option options[] = {HEAT_TIME_OPTIONS(&time, "otherwise S = 1"),
                              {OPTION_FLAG, "mesh-only", &mesh_only, NULL, "do not factor"},
                              {OPTION_END, NULL, NULL, NULL, NULL}};
    options_read(&usage, options, argc, argv, &operand);
    mesh m;
    mesh_facts facts;
    double begin = app_now();
    app_mesh(&m, operand, false);
    double seconds_read = app_now() - begin;
    if (!mesh_facts_find(&facts, &m)) {
        app_die("out of memory");
    }
    printf("%s\n", operand);
    print_facts(&m, &facts);
    if (!mesh_only && m.n_faces == 0) {
        printf("no faces: there is nothing to factor\n");
    } else if (!mesh_only) {
        heat_system h;
        heat_system_create(&h, &m, heat_time_value(&time, &m, 0));
        print_costs(&h, seconds_read, time_solve(&h));
        heat_system_free(&h);
    }
    mesh_free(&m);
    return 0;
}
