/* command_heat.c: heat diffusion from source vertices, solved at selected vertices */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "command.h"
#include "source_list.h"
#include "tools/cli/heat_system.h"

static const options_usage usage = {
    "heat", "MESH", 1, 1,
    "Diffuses heat from source vertices and solves for it only at the wanted vertices."};

static const options_manual manual = {
    "Each source has one unit of heat, and a curve one for each unit of its length; (M + t L) x = "
    "b is one implicit Euler step of length t with "
    "the lumped mass M and the cotangent Laplacian L. x is exact at the wanted vertices and is not "
    "computed elsewhere: the forward sweep visits the paths in the elimination tree from the "
    "sources to the root, the backward sweep those from the wanted vertices. MESH may also be a "
    "file of sparse-local save, whose name ends in .slf.",
    "The columns and entries of L that the solve reads, and microseconds for the plan, the first "
    "solve and each further solve. Up to 20 values are printed unless --csv is given; --csv has "
    "columns vertex,heat. The picture shows the logarithm of the heat over 12 decades.",
    "star:6 --from 100 --scaled-time 10 --png heat.png\nbunny.obj --from 17 --radius 0.2 --csv "
    "heat.csv"};

/* The vertices within a Euclidean distance of a source. */
static sl_int *within(const mesh *m, const sl_int *sources, sl_int n_sources, double radius,
                      sl_int *count) {
    sl_int *list = app_alloc((size_t)m->n_vertices, sizeof *list);
    *count = 0;
    for (sl_int v = 0; v < m->n_vertices; v++) {
        for (sl_int k = 0; k < n_sources; k++) {
            const double *a = m->xyz + 3 * (size_t)v, *b = m->xyz + 3 * (size_t)sources[k];
            if (hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]) <= radius) {
                list[(*count)++] = v;
                break;
            }
        }
    }
    return list;
}

/* Creates the region of the sources and the wanted vertices and prints a line on it. */
static sl_region *create_region(const heat_system *h, const sl_int *sources, sl_int n_sources,
                                const sl_int *wanted, sl_int n_wanted) {
    sl_region *R = NULL;
    sl_stats stats = h->stats;
    size_t count = (size_t)n_sources + (size_t)n_wanted;
    if (count > INT32_MAX) {
        app_die("--region: too many vertices");
    }
    sl_int *both = app_alloc(count, sizeof *both);
    memcpy(both, sources, (size_t)n_sources * sizeof *both);
    memcpy(both + n_sources, wanted, (size_t)n_wanted * sizeof *both);
    double began = app_now();
    app_must(sl_region_create(&R, h->F, both, (sl_int)count, NULL, NULL, &stats), "region", &stats);
    app_print_region("region", &stats, app_now() - began);
    free(both);
    return R;
}

/* What each source gives off: 1, or the length of the curve at it. */
static double *heat_of(const source_list *from, const mesh *m) {
    double *heat = app_alloc((size_t)from->count, sizeof *heat);
    for (sl_int k = 0; k < from->count; k++) {
        heat[k] = 1;
    }
    if (from->curve.ends.count > 0) {
        sl_int *place = app_alloc((size_t)m->n_vertices, sizeof *place);
        edge_curve_lengths(heat, place, &from->curve, m);
        free(place);
    }
    return heat;
}

/* Plans and solves for x at the wanted vertices, and times it: one plan serves any number of
 * solves. */
static void solve(double *x, const heat_system *h, const sl_int *sources, const double *heat,
                  sl_int n_sources, const sl_int *wanted, sl_int n_wanted, bool in_region) {
    sl_plan *P = NULL;
    sl_work *W = NULL;
    sl_options opt;
    sl_stats stats = h->stats;
    memset(&opt, 0, sizeof opt);
    stats.error.row = -1;
    sl_region *R = in_region ? create_region(h, sources, n_sources, wanted, n_wanted) : NULL;
    opt.region = R;
    double begin = app_now();
    app_must(sl_plan_create(&P, h->S, sources, n_sources, wanted, n_wanted, &opt, &stats), "plan",
             &stats);
    double planned = app_now();
    app_must(sl_work_create(&W, NULL), "workspace", NULL);
    app_must(sl_plan_solve(P, h->F, x, (size_t)n_wanted, heat, (size_t)n_sources, 1, W),
             "local solve", NULL);
    double first = app_now();
    app_must(sl_plan_solve(P, h->F, x, (size_t)n_wanted, heat, (size_t)n_sources, 1, W),
             "local solve", NULL);
    double second = app_now();
    app_detail("%d sources, wanted %d of %d vertices, %s\n", (int)n_sources, (int)n_wanted,
               (int)h->n, heat_system_time(h));
    app_detail("columns visited: forward %d, backward %d of %d; entries of L read %lld of %lld\n",
               (int)stats.plan.b_columns, (int)stats.plan.x_columns, (int)stats.symbolic.n,
               (long long)(stats.plan.b_entries + stats.plan.x_entries),
               (long long)(2 * stats.symbolic.nnz_panels));
    if (stats.plan.in_region) {
        app_detail("entries read of the region's inverse: %lld\n",
                   (long long)stats.plan.region_entries);
    }
    app_detail("microseconds: plan %.1f, first solve %.1f, each further solve %.1f\n",
               1e6 * (planned - begin), 1e6 * (first - planned), 1e6 * (second - first));
    sl_work_free(W);
    sl_plan_free(P);
    sl_region_free(R);
}

static void write_csv(const char *path, const double *x, const sl_int *wanted, sl_int n_wanted) {
    FILE *csv = app_create(path);
    fprintf(csv, "vertex,heat\n");
    for (sl_int k = 0; k < n_wanted; k++) {
        fprintf(csv, "%d,%.17g\n", (int)wanted[k], x[k]);
    }
    app_close(csv);
}

/* The picture shows the logarithm, because heat decreases exponentially with the distance. */
static void write_mesh(const app_output *output, const mesh *m, double t, const double *x,
                       const sl_int *wanted, sl_int n_wanted, const sl_int *sources,
                       sl_int n_sources) {
    size_t n = (size_t)m->n_vertices;
    double *field = app_alloc(n, sizeof *field), *decades = app_alloc(n, sizeof *decades);
    render_mark *marks = app_alloc((size_t)n_sources, sizeof *marks);
    double largest = 0;
    for (size_t v = 0; v < n; v++) {
        field[v] = decades[v] = NAN;
    }
    for (sl_int k = 0; k < n_wanted; k++) {
        field[wanted[k]] = x[k];
        decades[wanted[k]] = x[k] > 0 ? log10(x[k]) : NAN;
        largest = x[k] > largest ? x[k] : largest;
    }
    for (sl_int k = 0; k < n_sources; k++) {
        const rgb red = {0xd5, 0x2b, 0x1e};
        marks[k].vertex = sources[k];
        marks[k].radius = 5;
        marks[k].color = red;
    }
    const mesh_field fields[] = {{"heat", field}, {"log10_heat", decades}};
    const mesh_extra extra = {.fields = fields, .n_fields = 2};
    char title[80];
    (void)snprintf(title, sizeof title, "log10 heat\nper area\nfrom %d%s\nt = %.3g",
                   n_sources > 0 ? (int)sources[0] : -1, n_sources > 1 ? "+" : "", t);
    const render_style style = {.scalar = decades,
                                .legend = title,
                                .low = largest > 0 ? log10(largest) - 12 : 0,
                                .high = largest > 0 ? log10(largest) : 1,
                                .isolines = 11,
                                .marks = marks,
                                .n_marks = n_sources};
    app_write(output, m, &extra, &style);
    free(marks);
    free(decades);
    free(field);
}

int command_heat(int argc, char **argv) {
    const char *operand = NULL, *from = NULL, *at = NULL;
    double radius = 0;
    bool in_region = false;
    heat_time time = {0, 0, 0, NULL};
    app_output output;
    memset(&output, 0, sizeof output);
    const option options[] = {
        {OPTION_TEXT, "from", &from, "VERTICES",
         "sources: " SOURCE_LIST_HELP " (the first vertex of a face with an area)"},
        {OPTION_TEXT, "at", &at, "VERTICES", "wanted vertices: a list or all (all)"},
        {OPTION_ABOVE_0, "radius", &radius, "R",
         "wanted vertices: those within the Euclidean distance R of a source"},
        {OPTION_FLAG, "region", &in_region, NULL,
         "create a region of the sources and the wanted vertices and end the sweeps at its "
         "boundary; worthwhile if the same system is solved many times"},
        HEAT_TIME_OPTIONS(&time, "otherwise S = 1"),
        APP_OUTPUT_OPTIONS(&output),
        APP_WELD_OPTION,
        {OPTION_END, NULL, NULL, NULL, NULL}};
    options_read(&usage, &manual, options, argc, argv, &operand);
    if (at != NULL && radius > 0) {
        app_die_usage("--at and --radius: give one of them");
    }
    app_check_output(&output, output.out);
    mesh m;
    heat_system h;
    if ((radius > 0 || (from != NULL && strncmp(from, "curve:", 6) == 0)) &&
        app_is_saved(operand)) {
        app_die_usage("%s: a saved factor has no mesh for --radius and curves", operand);
    }
    heat_system_open(&h, &m, operand, &time, 0, &output);
    app_set_up(&output, &m, output.png != NULL);
    sl_int n_wanted = 0;
    source_list from_list;
    source_list_read(&from_list, "from", from, &m);
    const sl_int *sources = from_list.vertices, n_sources = from_list.count;
    sl_int *wanted = radius > 0
                         ? within(&m, sources, n_sources, radius, &n_wanted)
                         : app_vertices("at", at != NULL ? at : "all", m.n_vertices, 2, &n_wanted);
    n_wanted = app_distinct(wanted, n_wanted, m.n_vertices);
    double *x = app_alloc((size_t)n_wanted, sizeof *x), least = INFINITY, most = -INFINITY;
    double *heat = heat_of(&from_list, &m);
    solve(x, &h, sources, heat, n_sources, wanted, n_wanted, in_region);
    free(heat);
    for (sl_int k = 0; k < n_wanted; k++) {
        least = fmin(least, x[k]);
        most = fmax(most, x[k]);
    }
    printf("The heat of %d source%s is solved for at %d of %d vertices, %s: from %.4g to %.4g.\n",
           (int)n_sources, n_sources == 1 ? "" : "s", (int)n_wanted, (int)m.n_vertices,
           heat_system_time(&h), n_wanted > 0 ? least : 0, n_wanted > 0 ? most : 0);
    if (output.csv != NULL) {
        write_csv(output.csv, x, wanted, n_wanted);
    } else if (n_wanted <= 20) {
        for (sl_int k = 0; k < n_wanted; k++) {
            printf("%d %.17g\n", (int)wanted[k], x[k]);
        }
    }
    app_aim_camera(&output, &m, sources, n_sources, false);
    write_mesh(&output, &m, h.t, x, wanted, n_wanted, sources, n_sources);
    free(x);
    free(wanted);
    source_list_free(&from_list);
    heat_system_free(&h);
    mesh_free(&m);
    return 0;
}
