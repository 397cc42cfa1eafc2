/* command_info.c: statistics of a mesh and the cost of factoring its Laplacian */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "command.h"
#include "tools/cli/heat_system.h"
#include "tools/mesh/mesh_stats.h"

static const options_usage usage = {
    "info", "MESH", 1, 1,
    "Prints statistics of a mesh and the cost of factoring its Laplacian, or of a saved factor."};

static const options_manual manual = {
    "Counts components, boundaries and defects of the mesh. Then analyzes and factors M + t L, the "
    "lumped mass plus t times the cotangent Laplacian. MESH may also be a file of sparse-local "
    "save, "
    "whose name ends in .slf.",
    "Counts and measures of the mesh; entries of L, height of the elimination tree and entries of "
    "L "
    "on the path from a column to its root; seconds and megabytes of each phase; range of the "
    "pivots.",
    "star:6\nbunny.obj --mesh-only\nbunny.slf"};

/* What is odd about a mesh, as the end of a sentence; "" if nothing is. */
static void print_defects(const mesh *m, const mesh_stats *f) {
    const struct {
        long long count;
        const char *what;
    } odd[] = {{m->n_vertices - f->used_vertices, "vertices without a face"},
               {f->repeated_vertex_faces, "faces with a repeated vertex"},
               {f->zero_area_faces, "faces without area"},
               {f->nonmanifold_edges, "edges of three or more faces"},
               {f->inconsistent_edges, "edges of faces that are not oriented alike"},
               {f->nonmanifold_vertices, "vertices whose faces form several fans"}};
    bool is_first = true;
    for (size_t k = 0; k < sizeof odd / sizeof *odd; k++) {
        if (odd[k].count > 0) {
            printf("%s%lld %s", is_first ? "It has " : ", ", odd[k].count, odd[k].what);
            is_first = false;
        }
    }
    printf("%s.\n", is_first ? "Nothing is odd about it" : "");
}

static void print_mesh(const mesh *m, const mesh_stats *f) {
    printf("The mesh has %d vertices, %d faces and %lld edges in %d connected part%s.\n",
           (int)m->n_vertices, (int)m->n_faces, (long long)f->edges, (int)f->components,
           f->components == 1 ? "" : "s");
    if (f->boundary_edges > 0) {
        printf("Its border has %lld edges in %d loops; ", (long long)f->boundary_edges,
               (int)f->boundary_loops);
    } else {
        printf("It has no border; ");
    }
    printf("edges are %.4g to %.4g long, %.4g on average, ", f->edge_min, f->edge_max,
           f->edge_mean);
    if (isnan(f->angle_min)) {
        printf("and no face has an area.\n");
    } else {
        printf("angles %.3g to %.3g degrees.\n", f->angle_min, f->angle_max);
    }
    print_defects(m, f);
    app_detail("vertices             %12d   used by a face %d\n", (int)m->n_vertices,
               (int)f->used_vertices);
    app_detail("faces                %12d   with a repeated vertex %d, without area %d\n",
               (int)m->n_faces, (int)f->repeated_vertex_faces, (int)f->zero_area_faces);
    app_detail(
        "edges                %12lld   border %lld, not manifold %lld, inconsistently oriented "
        "%lld\n",
        (long long)f->edges, (long long)f->boundary_edges, (long long)f->nonmanifold_edges,
        (long long)f->inconsistent_edges);
    app_detail("components           %12d   border loops %d, Euler characteristic %lld\n",
               (int)f->components, (int)f->boundary_loops, (long long)f->euler);
    app_detail("pinched vertices     %12d   (their faces form several fans)\n",
               (int)f->nonmanifold_vertices);
    app_detail("edge length          %12.6g   from %.6g to %.6g\n", f->edge_mean, f->edge_min,
               f->edge_max);
    if (isnan(f->angle_min)) {
        app_detail("angles                       none   no face has an area\n");
    } else {
        app_detail("angles, degrees      %12.6g   to %.6g\n", f->angle_min, f->angle_max);
    }
    app_detail("area                 %12.6g   box %.6g x %.6g x %.6g\n", f->area,
               f->box_max[0] - f->box_min[0], f->box_max[1] - f->box_min[1],
               f->box_max[2] - f->box_min[2]);
}

/* The weight of a path is the number of entries of L in the columns from a vertex to the root: what
 * one sweep of a solve for that vertex reads. Parents follow their children, so one pass from the
 * roots computes all weights. */
static void print_paths(const sl_symbolic *S) {
    sl_symbolic_arrays view = sl_symbolic_view(S);
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
    app_detail(
        "path to the root     %12.1f   columns on average; entries of L %.1f, at most %.0f\n",
        length_sum / n, sum / n, largest);
    free(length);
    free(weight);
}

static void print_analysis(const sl_symbolic *S, const sl_stats *s) {
    app_detail("nnz(L)               %12lld   %.2f times as many; %lld stored in %d supernodes\n",
               (long long)s->symbolic.nnz_l,
               (double)s->symbolic.nnz_l / (double)(s->symbolic.nnz_a > 0 ? s->symbolic.nnz_a : 1),
               (long long)s->symbolic.nnz_panels, (int)s->symbolic.supernodes);
    app_detail("elimination tree     %12d   height in columns; roots %d\n",
               (int)s->symbolic.tree_height, (int)s->symbolic.components);
    print_paths(S);
}

static void print_factor(const sl_stats *s) {
    app_detail("megabytes            analysis %.2f, factor %.2f\n",
               1e-6 * (double)s->symbolic.bytes, 1e-6 * (double)s->factor.bytes);
    app_detail("pivots               from %.4g to %.4g\n", s->factor.pivot_min,
               s->factor.pivot_max);
}

static void print_costs(const heat_system *h, double seconds_read, double seconds_solve) {
    const sl_stats *s = &h->stats;
    printf("The factor of M + t L, t = %.6g, has %lld entries, %.2f times those of the matrix, and "
           "takes "
           "%.1f MB.\n",
           h->t, (long long)s->symbolic.nnz_l,
           (double)s->symbolic.nnz_l / (double)(s->symbolic.nnz_a > 0 ? s->symbolic.nnz_a : 1),
           1e-6 * (double)s->factor.bytes);
    app_detail("M + t L              %12d   rows, %lld entries of the lower triangle, t = %.6g\n",
               (int)s->symbolic.n, (long long)s->symbolic.nnz_a, h->t);
    print_analysis(h->S, s);
    app_detail(
        "seconds              read %.4g, assemble %.4g, order %.4g, analyze %.4g, factor %.4g, "
        "full solve %.4g\n",
        seconds_read, h->seconds_assemble, s->symbolic.seconds_order, s->symbolic.seconds_analyze,
        s->factor.seconds_setup + s->factor.seconds, seconds_solve);
    print_factor(s);
}

/* A file of sparse-local save, completely verified. */
static void print_saved(const char *path) {
    sl_saved_set set = {0};
    sl_stats s;
    memset(&s, 0, sizeof s);
    app_must(sl_load(&set, path, NULL, 0, SL_LOAD_VERIFIED, NULL), path, NULL);
    s.symbolic = sl_symbolic_view(set.symbolic).info;
    app_detail("matrix               %12d   rows, %lld entries of the lower triangle\n",
               (int)s.symbolic.n, (long long)s.symbolic.nnz_a);
    printf("%s has a factor of %d rows: L has %lld entries.\n", path, (int)s.symbolic.n,
           (long long)s.symbolic.nnz_l);
    print_analysis(set.symbolic, &s);
    if (set.factor != NULL) {
        s.factor = sl_factor_view(set.factor).info;
        print_factor(&s);
        app_detail("signs of the pivots  %12d   positive, %d negative, %d null, %d regularized\n",
                   (int)s.factor.positive, (int)s.factor.negative, (int)s.factor.null,
                   (int)s.factor.regularized);
    }
    if (set.selected != NULL) {
        s.selected = sl_selected_view(set.selected).info;
        app_detail("selected inverse     %12d   columns, %lld entries\n", (int)s.selected.columns,
                   (long long)s.selected.entries);
    }
    for (sl_int k = 0; k < set.n_regions; k++) {
        s.region = sl_region_view(set.regions[k]).info;
        app_detail("region               %12d   rows, %d of them on its boundary\n",
                   (int)s.region.rows, (int)s.region.boundary);
    }
    sl_saved_set_free(&set);
}

static double time_solve(const heat_system *h) {
    size_t n = (size_t)h->n;
    double *b = app_alloc(n, sizeof *b), *x = app_alloc(n, sizeof *x);
    for (size_t k = 0; k < n; k++) {
        b[k] = 1;
    }
    sl_work *W = NULL;
    app_must(sl_work_create(&W, NULL), "workspace", NULL);
    app_must(sl_factor_solve(h->F, x, n, b, n, 1, W), "solve", NULL); /* allocates in W */
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
    heat_time time = {0, 0, 0, NULL};
    bool mesh_only = false;
    const option options[] = {
        HEAT_TIME_OPTIONS(&time, "otherwise S = 1"),
        {OPTION_FLAG, "mesh-only", &mesh_only, NULL, "print the mesh statistics only"},
        APP_WELD_OPTION,
        {OPTION_END, NULL, NULL, NULL, NULL}};
    options_read(&usage, &manual, options, argc, argv, &operand);
    if (app_is_saved(operand)) {
        app_refuse_weld(operand);
        print_saved(operand);
        return 0;
    }
    mesh m;
    mesh_stats found;
    double begin = app_now();
    app_mesh(&m, operand, false);
    double seconds_read = app_now() - begin;
    if (!mesh_stats_compute(&found, &m)) {
        app_die("out of memory");
    }
    print_mesh(&m, &found);
    if (m.n_faces == 0) {
        app_die("%s: has no faces, only %d vertices", operand, (int)m.n_vertices);
    }
    if (!mesh_only) {
        heat_system h;
        heat_system_create(&h, &m, heat_time_value(&time, &m, 0), time.laplacian, NULL);
        print_costs(&h, seconds_read, time_solve(&h));
        heat_system_free(&h);
    }
    mesh_free(&m);
    return 0;
}
