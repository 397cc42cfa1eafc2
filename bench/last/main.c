/* main.c: is this header as fast as its older versions, call by call, in one process?
 *
 *     bench_last [--quick] [--isa scalar|avx2|avx512] [MESH ...]
 *
 * LAST_HEADERS lists the tables of the older versions as X(name) X(name) ...
 */
#include <stdlib.h>
#include <string.h>

#include "bench/lib/graph_kinds.h"
#include "bench/lib/kkt_programs.h"
#include "subjects.h"
#include "tools/io/dataset.h"

#define X(name) extern const last_header last_##name;
LAST_HEADERS X(this)
#undef X

#define X(name) &last_##name,
    static const last_header *const headers[] = {LAST_HEADERS X(this)};
#undef X

enum { HEADERS = sizeof headers / sizeof *headers, THIS = HEADERS - 1, MOST_ROWS = 64 };

/* What a row takes, relative to an older version, before it is named. */
static const double limit = 1.03;

typedef struct row {
    row_kind kind;
    int nrhs;
    double least[RACE_MOST];
} row;

typedef struct ratchet {
    last_isa isa;
    int is_quick;
    double seconds; /* of one row, all versions together */
    int ratios, above, wrong;
    char *named; /* lines of the rows above the limit */
    size_t named_length;
} ratchet;

/* ---- one system ---- */

static int list_rows(row *rows, int is_quick) {
    static const int rhs[] = {1, 2, 3, 8};
    int count = 0;
    memset(rows, 0, MOST_ROWS * sizeof *rows);
    for (row_kind kind = 0; kind < ROW_KINDS; kind++) {
        for (int k = 0; k < (row_is_solve(kind) ? 4 : 1); k++) {
            if (!is_quick || rhs[k] != 3) {
                rows[count].kind = kind;
                rows[count++].nrhs = rhs[k];
            }
        }
    }
    return count;
}

static double ratio(const row *r, int k) {
    return r->least[THIS] / r->least[k];
}

static int is_above(const row *r) {
    int above = 0;
    for (int k = 0; k < THIS; k++) {
        above = above || ratio(r, k) > limit;
    }
    return above;
}

/* Factors by all versions in order, or against it, so that memory lies otherwise, and times the
 * rows. */
static int measure(row *rows, int count, const last_case *c, const ratchet *run, int backward) {
    subject subjects[HEADERS];
    int error = 0, wrong = 0;
    memset(subjects, 0, sizeof subjects);
    for (int k = 0; k < HEADERS; k++) {
        const int s = backward ? THIS - k : k;
        const int failed = subject_create(&subjects[s], c, headers[s], run->isa);
        error = error ? error : failed;
    }
    if (!error && !backward) {
        printf("\n%s: %d rows; entries of L:", c->name, c->A.n);
        for (int k = 0; k < HEADERS; k++) {
            printf(" %lld%s", headers[k]->entries(subjects[k].state), k < THIS ? "," : "\n");
        }
        wrong = subjects_check(subjects, HEADERS);
    }
    for (int k = 0; k < count && !error && !wrong; k++) {
        error = subjects_race(rows[k].least, subjects, HEADERS, rows[k].kind, rows[k].nrhs, 0,
                              run->seconds);
    }
    for (int k = 0; k < HEADERS; k++) {
        subject_free(&subjects[k]);
    }
    if (error) {
        printf("%s: %s\n", c->name, sl_status_string((sl_status)error));
    }
    return wrong + (error != 0);
}

/* Repeats the rows that are above the limit. Of both measurements the one with the lower ratio to
 * an older version counts. */
static int measure_again(row *rows, int count, const last_case *c, const ratchet *run) {
    row again[MOST_ROWS];
    int at[MOST_ROWS], n_again = 0;
    for (int k = 0; k < count; k++) {
        if (is_above(&rows[k])) {
            at[n_again] = k;
            again[n_again++] = rows[k];
        }
    }
    const int wrong = n_again > 0 ? measure(again, n_again, c, run, 1) : 0;
    for (int k = 0; k < n_again && !wrong; k++) {
        row *r = &rows[at[k]];
        for (int h = 0; h < THIS; h++) {
            if (ratio(&again[k], h) < ratio(r, h)) {
                r->least[h] = again[k].least[h] * r->least[THIS] / again[k].least[THIS];
            }
        }
    }
    return wrong;
}

static void name_row(ratchet *run, const char *line) {
    const size_t length = strlen(line);
    char *named = realloc(run->named, run->named_length + length + 1);
    if (named) {
        memcpy(named + run->named_length, line, length + 1);
        run->named = named;
        run->named_length += length;
    }
}

static void print_row(ratchet *run, const last_case *c, const row *r) {
    char line[256], what[32];
    int end = 0;
    snprintf(what, sizeof what, "%s%s%.0d", row_names[r->kind], row_is_solve(r->kind) ? " x" : "",
             row_is_solve(r->kind) ? r->nrhs : 0);
    end = snprintf(line, sizeof line, "  %-20s %11.3f us", what, 1e6 * r->least[THIS]);
    for (int k = 0; k < THIS; k++) {
        run->ratios++;
        run->above += ratio(r, k) > limit;
        end += snprintf(line + end, sizeof line - (size_t)end, "  %11.3f us %6.3f%s",
                        1e6 * r->least[k], ratio(r, k), ratio(r, k) > limit ? " *" : "  ");
    }
    puts(line);
    if (is_above(r)) {
        char name[320];
        snprintf(name, sizeof name, "  %-20.20s%s\n", c->name, line);
        name_row(run, name);
    }
}

/* Checks and times a matrix; releases it if it is given. */
static void compare(ratchet *run, const char *name, const sl_csc *A) {
    last_case c;
    row rows[MOST_ROWS];
    case_create(&c, name, A, headers[THIS]);
    const int count = list_rows(rows, run->is_quick);
    int wrong = measure(rows, count, &c, run, 0);
    wrong = wrong ? wrong : measure_again(rows, count, &c, run);
    for (int k = 0; k < count && !wrong; k++) {
        print_row(run, &c, &rows[k]);
    }
    fflush(stdout);
    run->wrong += wrong;
    case_free(&c);
}

/* ---- all systems ---- */

static void compare_matrix(ratchet *run, const char *name, sl_matrix *matrix) {
    const sl_csc A = sl_matrix_view(matrix);
    compare(run, name, &A);
    sl_matrix_free(matrix);
}

static void compare_kinds(ratchet *run, const char *const *wanted, int count) {
    for (int k = 0; k < KINDS; k++) {
        for (int w = 0; w < count; w++) {
            if (strcmp(kind_name(k), wanted[w]) == 0) {
                compare_matrix(run, kind_name(k), kind_matrix(k));
            }
        }
    }
}

static void compare_systems(ratchet *run, char **meshes, int n_meshes) {
    static const char *const quick[] = {"grid 50^2", "quadtree 2^8", "path"};
    static const char *const kinds[] = {"grid 50^2",        "grid 100^2",
                                        "grid 316^2",       "9-point 100^2",
                                        "sphere",           "quadtree 2^9",
                                        "plate with holes", "path",
                                        "tetrahedra 18^3",  "tree",
                                        "7-point 24^3",     "roads",
                                        "fans 6000x6",      "biharmonic 120^2"};
    static const kkt_kind programs[] = {KKT_CONTROL, KKT_SPARSE, KKT_MPC, KKT_PDE};
    if (run->is_quick) {
        compare_kinds(run, quick, (int)(sizeof quick / sizeof *quick));
        compare_matrix(run, kkt_name(KKT_MPC), kkt_matrix(KKT_MPC, 0));
        return;
    }
    compare_kinds(run, kinds, (int)(sizeof kinds / sizeof *kinds));
    for (size_t k = 0; k < sizeof programs / sizeof *programs; k++) {
        compare_matrix(run, kkt_name(programs[k]), kkt_matrix(programs[k], 0));
    }
    for (int k = 0; k < n_meshes; k++) {
        const bench_system *system = bench_mesh(meshes[k]);
        if (system) {
            compare(run, dataset_basename(meshes[k]), &system->A);
        }
        bench_systems_free();
    }
}

/* This version beside itself, then with every solve done twice: the first ratio shows how well
 * this machine measures, the second has to be noticed. */
static int check_measurement(const ratchet *run) {
    sl_matrix *matrix = kind_matrix(1);
    const sl_csc A = sl_matrix_view(matrix);
    last_case c;
    subject both[2];
    double least[2], ratios[2] = {0, 0};
    int error;
    case_create(&c, "itself", &A, headers[THIS]);
    error = subject_create(&both[0], &c, headers[THIS], run->isa);
    error |= subject_create(&both[1], &c, headers[THIS], run->isa);
    for (int extra = 0; extra < 2 && !error; extra++) {
        error = subjects_race(least, both, 2, ROW_VERTEX, 1, extra, run->seconds);
        ratios[extra] = error ? 0 : least[0] / least[1];
    }
    printf("a vertex by this header beside itself: %.3f; solved twice: %.3f\n", ratios[0],
           ratios[1]);
    subject_free(&both[0]);
    subject_free(&both[1]);
    case_free(&c);
    sl_matrix_free(matrix);
    if (error) {
        printf("bench-last: %s\n", sl_status_string((sl_status)error));
    } else if (ratios[1] <= limit) {
        printf("bench-last: a slowdown is not noticed\n");
    }
    return !error && ratios[1] > limit;
}

static int usage(void) {
    fprintf(stderr, "bench_last [--quick] [--isa scalar|avx2|avx512] [MESH ...]\n");
    return 2;
}

int main(int argc, char **argv) {
    static const char *const isas[] = {"auto", "scalar", "avx2", "avx512"};
    ratchet run = {LAST_ISA_AUTO, 0, 0.12, 0, 0, 0, NULL, 0};
    int arg = 1;
    for (; arg < argc && argv[arg][0] == '-'; arg++) {
        if (strcmp(argv[arg], "--quick") == 0) {
            run.is_quick = 1;
            run.seconds = 0.05;
        } else if (strcmp(argv[arg], "--isa") == 0 && arg + 1 < argc) {
            int isa = 0;
            arg++;
            while (isa < 4 && strcmp(isas[isa], argv[arg]) != 0) {
                isa++;
            }
            if (isa == 4) {
                return usage();
            }
            run.isa = (last_isa)isa;
        } else {
            return usage();
        }
    }
    if (!check_measurement(&run)) {
        return 1;
    }
    printf("least times, instruction set %s, in one order: this header", isas[run.isa]);
    for (int k = 0; k < THIS; k++) {
        printf("; %s (version %d), ratio", headers[k]->name, headers[k]->version);
    }
    printf("\n");
    compare_systems(&run, argv + arg, argc - arg);
    printf("\n%s%d of %d rows above %.2f\n", run.named ? run.named : "", run.above, run.ratios,
           limit);
    if (run.wrong) {
        printf("bench-last: %d systems are wrong\n", run.wrong);
    }
    free(run.named);
    return run.wrong != 0;
}
