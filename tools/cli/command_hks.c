/* command_hks.c: heat kernel signatures: the auto-diffusion function at several times */
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "command.h"
#include "tools/cli/heat_system.h"

enum { FILES_MAX = 1000, TIMES = 16 };

static const options_usage usage = {"hks", "MESH | FILE.slf ...", 1, FILES_MAX,
                                    "Computes heat kernel signatures of vertices."};

static const options_manual manual = {
    "The signature of a vertex consists of its auto-diffusion function (see adf) at several times, "
    "which are evenly spaced on a logarithmic scale. By default the times span those of the first "
    "300 eigenvalues of the Laplacian, which Weyl's law estimates from the area of the surface. "
    "The pattern is analyzed once; then as many times as there are threads are factored by one "
    "call, and another call computes their diagonals. In place of MESH there may be files of "
    "sparse-local save, whose names end in .slf: one for each time. Their factors need not be "
    "computed, and neither need the diagonals of files with a selected inverse.",
    "The range of times and the seconds of each phase. --csv has a column per time, headed by the "
    "time, or by the name of the file. The picture shows the logarithm of the value at the middle "
    "time, or the distance to the signature of --like: the root mean square of the differences of "
    "the logarithms. Of files, up to 20 signatures are printed unless --csv is given.",
    "star:6 --like 100 --png hks.png --csv hks.csv\nbunny.obj --times 8 --at 17,100-200 --csv "
    "hks.csv\nbunny1.slf bunny2.slf --at 17,100-200"};

static const double pi = 3.14159265358979323846;

/* The usual range [Sun, Ovsjanikov, Guibas 2009]: 4 ln 10 / lambda_300 to 4 ln 10 / lambda_2, with
 * lambda_k = 4 pi k / area by Weyl's law. */
static void find_times(double *times, sl_int count, double first, double last, const mesh *m) {
    double area = heat_area(m);
    first = first > 0 ? first : 4 * log(10) * area / (4 * pi * 300);
    last = last > 0 ? last : 4 * log(10) * area / (4 * pi * 2);
    if (!(first > 0 && last >= first) || !isfinite(last)) {
        app_die("no range of times from %g to %g (area %g): give --first and --last", first, last,
                area);
    }
    for (sl_int k = 0; k < count; k++) {
        times[k] = first * pow(last / first, count > 1 ? (double)k / (count - 1) : 0);
    }
}

/* Number of factors held at once: one per thread, as far as their values fit into 4 GB. More
 * factors would only touch more memory: one thread with 8 factors takes about 25 % longer than with
 * 1. */
static sl_int block_size(const heat_system *h, sl_int n_times, sl_int threads) {
    double fit = 4e9 / (sizeof(double) * (double)(h->stats.symbolic.nnz_panels + 1));
    sl_int block = threads < n_times ? threads : n_times;
    block = fit < block ? (sl_int)fit : block;
    return block > 1 ? block : 1;
}

/* values[k * count + i]: vertex i of the list at time k. */
static void compute(double *values, heat_system *h, const double *times, sl_int n_times,
                    const sl_int *vertices, sl_int count, bool all, const sl_threads *threads) {
    sl_stats stats = h->stats;
    sl_int block = block_size(h, n_times, threads->count);
    sl_factor **factors = app_alloc((size_t)block, sizeof *factors);
    for (sl_int first = 0; first < n_times; first += block) {
        sl_int width = n_times - first < block ? n_times - first : block;
        app_progress("signatures", (double)first / n_times);
        heat_system_factors(h, factors, times + first, width, threads);
        for (sl_int k = 0; k < width; k++) {
            app_must(sl_inverse_diagonal(factors[k], values + (size_t)(first + k) * (size_t)count,
                                         all ? NULL : vertices, count, NULL, &stats),
                     "auto-diffusion", &stats);
        }
    }
    app_progress_end();
    /* the longest time has the largest condition */
    heat_system_warn(h, factors[(n_times - 1) % block], times[n_times - 1]);
    for (sl_int k = 0; k < block; k++) {
        sl_factor_free(factors[k]);
    }
    free(factors);
}

/* values[k * count + i]: vertex i of the list, of file k. Returns the vertices of --at. */
static sl_int *read_files(double **values, sl_int *count, const char *const *files, sl_int n_files,
                          const char *at, const app_output *output) {
    const heat_time none = {0, 0, 0, NULL};
    sl_int *vertices = NULL, n = 0;
    double began = app_now();
    for (sl_int k = 0; k < n_files; k++) {
        heat_system h;
        mesh m;
        if (!app_is_saved(files[k])) {
            app_die_usage("unexpected operand %s: expected one mesh, or files of sparse-local save",
                          files[k]);
        }
        heat_system_open(&h, &m, files[k], &none, 0, output);
        if (k == 0) {
            n = h.n;
            vertices = app_vertices("at", at, n, 1, count);
            *values = app_alloc((size_t)n_files * (size_t)*count, sizeof **values);
        } else if (h.n != n) {
            app_die("%s has %d rows, %s has %d", files[0], (int)n, files[k], (int)h.n);
        }
        heat_system_diagonal(&h, *values + (size_t)k * (size_t)*count,
                             strcmp(at, "all") == 0 ? NULL : vertices, *count);
        heat_system_free(&h);
        app_progress("signatures", (double)(k + 1) / n_files);
    }
    app_progress_end();
    printf("The signatures of %d of %d vertices at the times of %d files took %.4g s.\n",
           (int)*count, (int)n, (int)n_files, app_now() - began);
    return vertices;
}

/* The name of a file as the head of a column. */
static void print_name(FILE *csv, const char *name) {
    for (; *name != '\0'; name++) {
        fputc(strchr(",\"\r\n", *name) != NULL ? '_' : *name, csv);
    }
}

/* times NULL: each column is that of a file. */
static void write_csv(const char *path, const double *values, const double *times,
                      const char *const *files, sl_int n_times, const sl_int *vertices,
                      sl_int count) {
    FILE *csv = app_create(path);
    fprintf(csv, "vertex");
    for (sl_int k = 0; k < n_times; k++) {
        fprintf(csv, ",");
        if (times != NULL) {
            fprintf(csv, "%.17g", times[k]);
        } else {
            print_name(csv, files[k]);
        }
    }
    for (sl_int i = 0; i < count; i++) {
        fprintf(csv, "\n%d", (int)vertices[i]);
        for (sl_int k = 0; k < n_times; k++) {
            fprintf(csv, ",%.17g", values[(size_t)k * (size_t)count + (size_t)i]);
        }
    }
    fprintf(csv, "\n");
    app_close(csv);
}

/* The value drawn at vertex i of the list: the distance of its signature to that at position `like`
 * of the list, the root mean square of the differences of logarithms. Without `like` (-1) it is the
 * logarithm at the middle time. */
static double shown_value(const double *values, sl_int n_times, sl_int count, sl_int i,
                          sl_int like) {
    if (like < 0) {
        double x = values[(size_t)(n_times / 2) * (size_t)count + (size_t)i];
        return x > 0 ? log(x) : NAN;
    }
    double sum = 0;
    for (sl_int k = 0; k < n_times; k++) {
        double a = values[(size_t)k * (size_t)count + (size_t)i];
        double b = values[(size_t)k * (size_t)count + (size_t)like];
        sum += a > 0 && b > 0 ? log(a / b) * log(a / b) : NAN;
    }
    return sqrt(sum / n_times);
}

static void write_mesh(const app_output *output, const mesh *m, const double *values,
                       sl_int n_times, const sl_int *vertices, sl_int count, sl_int like) {
    size_t n = (size_t)m->n_vertices, fields_room = (size_t)n_times + 1;
    double *columns = app_alloc(fields_room * n, sizeof *columns);
    mesh_field *fields = app_alloc(fields_room, sizeof *fields);
    char(*names)[24] = app_alloc(fields_room, sizeof *names);
    for (size_t k = 0; k < fields_room * n; k++) {
        columns[k] = NAN;
    }
    for (size_t k = 0; k < fields_room; k++) {
        (void)snprintf(names[k], sizeof names[k], k == 0 ? "shown" : "hks_%d", (int)k - 1);
        fields[k].name = names[k];
        fields[k].value = columns + k * n;
        for (sl_int i = 0; i < count; i++) {
            columns[k * n + (size_t)vertices[i]] =
                k == 0 ? shown_value(values, n_times, count, i, like)
                       : values[(k - 1) * (size_t)count + (size_t)i];
        }
    }
    const rgb red = {0xd5, 0x2b, 0x1e};
    const render_mark mark = {like >= 0 ? vertices[like] : 0, 6, red};
    const mesh_extra extra = {.fields = fields, .n_fields = (int)fields_room};
    char title[80];
    if (like >= 0) {
        (void)snprintf(title, sizeof title, "rms ln hks\nfrom %d", (int)vertices[like]);
    } else {
        (void)snprintf(title, sizeof title, "ln of hks,\nper area\nmiddle time");
    }
    render_style style = {.scalar = columns, .legend = title, .marks = &mark, .n_marks = like >= 0};
    app_range(&style.low, &style.high, m, columns);
    app_write(output, m, &extra, &style);
    free(names);
    free(fields);
    free(columns);
}

/* The position in the list of the vertex that --like names. */
static sl_int find_like(const char *like, const sl_int *vertices, sl_int count, sl_int n) {
    sl_int n_wanted = 0, position = -1;
    sl_int *wanted = app_vertices("like", like, n, 1, &n_wanted);
    for (sl_int i = 0; i < count && position < 0; i++) {
        position = vertices[i] == wanted[0] ? i : -1;
    }
    free(wanted);
    if (n_wanted != 1 || position < 0) {
        app_die_usage("--like %s: expected one vertex, which --at includes", like);
    }
    return position;
}

/* Signatures out of saved factors. */
static void run_files(const char *const *files, const char *at, const app_output *output) {
    sl_int n_files = 0, count = 0;
    double *values = NULL;
    while (n_files < FILES_MAX && files[n_files] != NULL) {
        n_files++;
    }
    sl_int *vertices = read_files(&values, &count, files, n_files, at, output);
    if (output->csv != NULL) {
        write_csv(output->csv, values, NULL, files, n_files, vertices, count);
    }
    for (sl_int i = 0; i < count && count <= 20 && output->csv == NULL; i++) {
        printf("%d", (int)vertices[i]);
        for (sl_int k = 0; k < n_files; k++) {
            printf(" %.17g", values[(size_t)k * (size_t)count + (size_t)i]);
        }
        printf("\n");
    }
    free(vertices);
    free(values);
}

typedef struct part {
    void (*body)(void *data, sl_int k);
    void *data;
    sl_int k;
} part;

static void *run_part(void *at) {
    const part *p = at;
    p->body(p->data, p->k);
    return NULL;
}

/* A thread for each k, and those that cannot be started on this one: at most 1,024. */
static void in_threads(void *context, sl_int count, void (*body)(void *data, sl_int k),
                       void *data) {
    pthread_t thread[1024];
    part parts[1024];
    sl_int started = 0, k;
    (void)context;
    for (k = 0; k < count - 1 && k < 1024; k++, started++) {
        parts[k].body = body;
        parts[k].data = data;
        parts[k].k = k;
        if (pthread_create(&thread[k], NULL, run_part, &parts[k]) != 0) {
            break;
        }
    }
    for (; k < count; k++) {
        body(data, k);
    }
    for (k = 0; k < started; k++) {
        (void)pthread_join(thread[k], NULL);
    }
}

int command_hks(int argc, char **argv) {
    const char *operands[FILES_MAX] = {NULL}, *at = "all", *like = NULL, *laplacian = NULL;
    double first = 0, last = 0;
    sl_int n_times = -1, count = 0, like_position = -1;
    sl_threads threads = {1, NULL, NULL};
    app_output output;
    memset(&output, 0, sizeof output);
    const option options[] = {
        {OPTION_TEXT, "at", &at, "VERTICES", "vertices: 3,17,100-200 or random:5 or all (all)"},
        {OPTION_COUNT, "times", &n_times, "K", "number of times (16)"},
        {OPTION_ABOVE_0, "first", &first, "T", "first time (from the area)"},
        {OPTION_ABOVE_0, "last", &last, "T", "last time (from the area)"},
        {OPTION_TEXT, "like", &like, "VERTEX",
         "draw the distance of each signature to that of this vertex (default: draw the values at "
         "the middle time)"},
        {OPTION_COUNT, "threads", &threads.count, "N",
         "number of threads, if the program is built with OpenMP (1)"},
        LAPLACIAN_OPTION(&laplacian),
        APP_OUTPUT_OPTIONS(&output),
        APP_WELD_OPTION,
        {OPTION_END, NULL, NULL, NULL, NULL}};
    options_read(&usage, &manual, options, argc, argv, operands);
    const char *operand = operands[0];
    if (app_is_saved(operand)) {
        if (n_times >= 0 || first > 0 || last > 0) {
            app_die_usage("%s: has its own time", operand);
        }
        if (laplacian != NULL || like != NULL) {
            app_die_usage("%s: a saved factor has no mesh for --laplacian and --like", operand);
        }
        app_check_output(&output, output.out);
        run_files(operands, at, &output);
        return 0;
    }
    if (operands[1] != NULL) {
        app_die_usage("unexpected operand %s: expected one mesh, or files of sparse-local save",
                      operands[1]);
    }
    n_times = n_times < 0 ? TIMES : n_times;
    if (n_times < 1 || n_times > 1000) {
        app_die_usage("--times: expected 1 to 1000");
    }
    if (threads.count > 1024) {
        app_die_usage("--threads: expected at most 1024");
    }
    laplacian_check(laplacian);
    app_check_output(&output, output.out);
    mesh m;
    heat_system h;
    app_mesh(&m, operand, true);
    app_set_up(&output, &m, output.png != NULL);
    sl_int *vertices = app_vertices("at", at, m.n_vertices, 1, &count);
    if (like != NULL) {
        like_position = find_like(like, vertices, count, m.n_vertices);
    }
    double *times = app_alloc((size_t)n_times, sizeof *times);
    double *values = app_alloc((size_t)n_times * (size_t)count, sizeof *values);
    find_times(times, n_times, first, last, &m);
    heat_system_analyze(&h, &m, laplacian, NULL);
    double begin = app_now();
    if (threads.count > 1) {
        threads.run = in_threads;
    }
    compute(values, &h, times, n_times, vertices, count, strcmp(at, "all") == 0, &threads);
    printf("The signatures of %d of %d vertices at %d times from %.6g to %.6g are computed.\n",
           (int)count, (int)m.n_vertices, (int)n_times, times[0], times[n_times - 1]);
    app_detail("seconds: order and analyze %.4g, factors and signatures %.4g\n",
               h.stats.symbolic.seconds_order + h.stats.symbolic.seconds_analyze,
               app_now() - begin);
    if (output.csv != NULL) {
        write_csv(output.csv, values, times, NULL, n_times, vertices, count);
    }
    write_mesh(&output, &m, values, n_times, vertices, count, like_position);
    free(values);
    free(times);
    free(vertices);
    heat_system_free(&h);
    mesh_free(&m);
    return 0;
}
