/* main.c: the bench program: its command line, its environment and the list of questions */
#define _POSIX_C_SOURCE 200112L
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "bench.h"
#include "tools/io/output_file.h"

typedef struct question {
    const char *name, *text;
    void (*answer)(bench_run *run);
} question;

/* What a newcomer wants to know; without a name and at the default size, only these are run. */
enum { N_FIRST = 6 };

static const question questions[] = {
    {"cold", "from the matrix to the first solution: each stage, by purpose and threads",
     bench_cold},
    {"locality", "the same local solve on meshes of growing size; plans of long chains",
     bench_locality},
    {"patches",
     "local solves on a patch against refactorization of the patch, conjugate gradients and full "
     "solves ([HDA17] Figures 4, 5)",
     bench_patches},
    {"multi_rhs", "1 to 8 right-hand sides in one call against one call each", bench_multi_rhs},
    {"harmonic", "harmonic, biharmonic, triharmonic systems: analysis, factorization, full solve",
     bench_harmonic},
    {"change", "entries changed by rank-one updates against refactorizations; pins", bench_change},
    /* by name, or of BENCH=quick and BENCH=full */
    {"vertex_pairs",
     "b and x at one vertex; random pairs by one or two reaches ([HDA17] section 5)",
     bench_vertex_pairs},
    {"inverse_entries", "entries and blocks of the inverse: forward sweeps against local solves",
     bench_inverse_entries},
    {"neumann", "zero-mean solutions of singular Laplacians against shifted ones; refinement",
     bench_neumann},
    {"change_patch", "the weights of a patch changed: the way that is chosen against each way",
     bench_change_patch},
    {"scaling", "ordering, analysis, factorization and nnz(L) as n grows ([HDA17] Figure 6)",
     bench_scaling},
    {"amortize",
     "setup for a patch alone against setup for the whole mesh ([HDA17] Figure 6, right)",
     bench_amortize},
    {"ordering", "orderings against METIS_NodeND: time, fill, operations, path weights",
     bench_ordering},
    {"factor", "factorization by method, instruction set and threads, against the machine's limits",
     bench_factor},
    {"front_kernels", "dense kernels of the factorization by shape of the front",
     bench_front_kernels},
    {"selected_inverse",
     "the whole diagonal of the inverse against a refactorization and against single entries",
     bench_selected_inverse},
    {"region", "local solves that end at a region's boundary against plans to the roots",
     bench_region},
    {"adf", "auto-diffusion at every vertex: the diagonal of the inverse ([HDA17] section 5)",
     bench_adf},
    {"shifted", "M + t L for eight t: factors, one plan on all of them, heat kernel signatures",
     bench_shifted},
    {"saved", "factors in files: saved, loaded, mapped, shared by processes", bench_saved},
    {"storage", "L in float against L in double: time, memory, accuracy after refinement",
     bench_storage},
    {"submatrix", "the factor of a patch from the whole one, or of thin sets, against their own",
     bench_submatrix},
    {"edit", "an analysis that follows a remeshed mesh against a new order and analysis",
     bench_edit},
    {"two_threads", "two threads against one: ordering, factorization, full solves, a batch",
     bench_two_threads},
#ifdef SL_BENCH_ARPACK
    {"eigenpairs",
     "auto-diffusion and heat kernel signatures by ARPACK's eigenpairs: digits and time",
     bench_eigenpairs},
#endif
#ifdef SL_BENCH_PEERS
    {"peers", "CHOLMOD and Eigen: setup, refactorization, full and local solves", bench_peers},
    {"peers_harmonic", "the same steps on harmonic, biharmonic and triharmonic systems",
     bench_peers_harmonic},
    {"peers_shifted", "eight refactorizations of M + t L against CHOLMOD", bench_peers_shifted},
    {"peers_complex", "a connection Laplacian against CHOLMOD and Eigen, complex",
     bench_peers_complex},
    {"peers_kkt", "KKT systems of quadratic programs against LDL with AMD", bench_peers_kkt},
    {"peers_kinds", "first factors on many kinds of small systems against CHOLMOD and Eigen",
     bench_peers_kinds},
    {"peers_multifrontal", "MUMPS: factor, solves, entries of the inverse; Scotch: orders",
     bench_peers_multifrontal},
    {"peers_small", "first factors of 1 to 10,000 rows against CHOLMOD and Eigen",
     bench_peers_small},
#endif
};

enum { N_QUESTIONS = sizeof questions / sizeof *questions };

static void list(FILE *out) {
    for (int k = 0; k < N_QUESTIONS; k++) {
        fprintf(out, "  %-16s %s\n", questions[k].name, questions[k].text);
    }
}

static int usage(FILE *out) {
    fprintf(out,
            "usage: bench [--help] [--list] [--machine file ...] [name ...]\n"
            "With --machine only writes on what machine other programs have measured a file. Runs\n"
            "the named questions, or the first %d, or all with BENCH:\n",
            N_FIRST);
    list(out);
    fprintf(out,
            "Environment:\n"
            "  BENCH=quick|full  all questions up to 1e5 vertices (seconds), or up to 4e6; "
            "default: the\n"
            "                    first ones up to 5e5 (a minute or two), named ones up to 1e6\n"
            "  MESH=path         use this mesh (.obj .off .ply .stl, plain or .gz) in place of "
            "synthetic grids\n"
            "  BENCH_OUT=folder  where CSV files and plots are written; default: build/bench-out\n"
            "  SL_DATA=folder    the question peers adds meshes/bunny.off.gz from this folder\n"
            "Exits with status 1 if a result was wrong or standard output could not be written, "
            "with 2 if a file could not.\n");
    return out == stderr ? 2 : 0;
}

/* Whether the question is to be run. */
static int is_selected(const bench_run *run, int k, int argc, char **argv) {
    for (int a = 1; a < argc; a++) {
        if (strcmp(argv[a], questions[k].name) == 0) {
            return 1;
        }
    }
    return argc == 1 && (k < N_FIRST || run->size != BENCH_DEFAULT);
}

/* Creates the folder and its parents. Returns whether it exists now. */
static int make_folder(const char *path) {
    char prefix[512];
    snprintf(prefix, sizeof prefix, "%s", path);
    for (char *c = prefix + 1; *c; c++) {
        if (*c == '/') {
            *c = '\0';
            (void)mkdir(prefix, 0777); /* a failure shows in the last call */
            *c = '/';
        }
    }
    return mkdir(prefix, 0777) == 0 || errno == EEXIST;
}

static int set_up(bench_run *run, int is_named) {
    const char *size = getenv("BENCH"), *mesh_path = getenv("MESH"), *folder = getenv("BENCH_OUT");
    memset(run, 0, sizeof *run);
    run->size = BENCH_DEFAULT;
    if (size && strcmp(size, "quick") == 0) {
        run->size = BENCH_QUICK;
    } else if (size && strcmp(size, "full") == 0) {
        run->size = BENCH_FULL;
    } else if (size && size[0]) {
        fprintf(stderr, "bench: BENCH=%s is neither quick nor full\n", size);
        return 0;
    }
    run->seconds = run->size == BENCH_QUICK ? 0.05 : run->size == BENCH_DEFAULT ? 0.2 : 2;
    run->largest = run->size == BENCH_QUICK  ? 1e5
                   : run->size == BENCH_FULL ? 4e6
                   : is_named                ? 1e6
                                             : 5e5;
    run->mesh_path = mesh_path && mesh_path[0] ? mesh_path : NULL;
    run->out_dir = folder && folder[0] ? folder : "build/bench-out";
    if (run->mesh_path && !bench_mesh(run->mesh_path)) {
        return 0;
    }
    if (!make_folder(run->out_dir)) {
        fprintf(stderr, "bench: cannot create the folder %s\n", run->out_dir);
        return 0;
    }
    return 1;
}

/* Writes NAME.machine.txt for each name. */
static int describe_machine(int count, char **names) {
    bench_run run;
    if (!set_up(&run, 0)) {
        return 2;
    }
    bench_bandwidth_measure(&run);
    bench_peak_measure(&run);
    for (int k = 0; k < count; k++) {
        bench_machine_write(&run, names[k]);
    }
    return run.failures > 0;
}

int main(int argc, char **argv) {
    bench_run run;
    int selected = 0, answered = 0;
    output_begin_program("bench");
    if (argc > 1 && strcmp(argv[1], "--machine") == 0) {
        return describe_machine(argc - 2, argv + 2);
    }
    for (int a = 1; a < argc; a++) {
        int known = 0;
        if (strcmp(argv[a], "--help") == 0 || strcmp(argv[a], "-h") == 0) {
            return usage(stdout);
        }
        if (strcmp(argv[a], "--list") == 0) {
            list(stdout);
            return 0;
        }
        for (int k = 0; k < N_QUESTIONS; k++) {
            known |= strcmp(argv[a], questions[k].name) == 0;
        }
        if (!known) {
            fprintf(stderr, "bench: unknown question %s\n", argv[a]);
            return usage(stderr);
        }
    }
    if (!set_up(&run, argc > 1)) {
        return 2;
    }
    double start = bench_now();
    bench_bandwidth_measure(&run);
    bench_peak_measure(&run);
    for (int k = 0; k < N_QUESTIONS; k++) {
        selected += is_selected(&run, k, argc, argv);
    }
    for (int k = 0; k < N_QUESTIONS; k++) {
        if (is_selected(&run, k, argc, argv)) {
            double begin = bench_now();
            bench_progress("[question %d of %d: %s]\n", ++answered, selected, questions[k].name);
            questions[k].answer(&run);
            bench_progress("[%s: %.0f s]\n", questions[k].name, bench_now() - begin);
        }
    }
    if (argc == 1 && run.size == BENCH_DEFAULT) {
        printf("\nMore questions by name (make bench QUESTION=...), or all with BENCH=full:");
        for (int k = N_FIRST; k < N_QUESTIONS; k++) {
            printf(" %s", questions[k].name);
        }
        printf("\n");
    }
    bench_summary_print();
    printf("\n%.0f s in total; CSV files and plots are in %s; %d checks failed\n",
           bench_now() - start, run.out_dir, run.failures);
    bench_summary_free();
    bench_systems_free();
    bench_threads_free();
    return run.failures > 0;
}
