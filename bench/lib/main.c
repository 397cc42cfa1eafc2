/* main.c: the bench program: which questions are asked, how large, and where the answers go */
#define _POSIX_C_SOURCE 200112L
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "bench.h"

typedef struct question {
    const char *name, *text;
    void (*ask)(bench_run *run);
} question;

static const question questions[] = {
    {"scaling", "ordering, analysis, factorization and nnz(L) against n (paper: Figure 6)",
     bench_scaling},
    {"amortize", "factoring a patch alone against the whole mesh (paper: Figure 6, right)",
     bench_amortize},
    {"ordering", "time, fill and path weights of the orderings beside METIS_NodeND",
     bench_ordering},
    {"factor", "methods, instruction sets and threads of the factorization against the limits",
     bench_factor},
    {"kernels", "the dense kernels by shape, against registers alone", bench_kernels},
    {"harmonic", "harmonic, biharmonic, triharmonic systems: analyse, factor, solve",
     bench_harmonic},
    {"patches",
     "solves on a patch against refactorizing, conjugate gradients, full solve (Figures 4, 5)",
     bench_patches},
    {"multi_rhs", "1 to 8 right-hand sides together against one by one", bench_multi_rhs},
    {"pairs", "vertex to itself, random pairs with one tree or two (section 5, histogram)",
     bench_pairs},
    {"inverse", "entries and blocks of the inverse by forward sweeps against local solves",
     bench_inverse},
    {"locality", "the same local question on meshes of growing size", bench_locality},
    {"selected", "the whole diagonal of the inverse beside a refactorization and single entries",
     bench_selected},
    {"region", "local questions inside regions, beside plans to the roots, on growing meshes",
     bench_region},
    {"adf", "the auto-diffusion of every vertex: the diagonal of the inverse (section 5)",
     bench_adf},
    {"several", "M + t L for eight t: factors, one plan on all of them, heat-kernel signatures",
     bench_several},
    {"neumann", "zero-mean solutions of raw Laplacians beside shifted ones; refinement",
     bench_neumann},
#ifdef SL_BENCH_PEERS
    {"peers", "beside CHOLMOD and Eigen over the same permutation: factor, solve, local solves",
     bench_peers},
    {"peers_harmonic", "the same on harmonic, biharmonic and triharmonic systems",
     bench_peers_harmonic},
    {"peers_several", "eight refactorizations M + t L beside CHOLMOD's over one analysis",
     bench_peers_several},
#endif
};

enum { N_QUESTIONS = sizeof questions / sizeof *questions };

static void list(FILE *out) {
    for (int k = 0; k < N_QUESTIONS; k++) {
        fprintf(out, "  %-14s %s\n", questions[k].name, questions[k].text);
    }
}

static int usage(FILE *out) {
    fprintf(out, "usage: bench [--help] [--list] [name ...]\n"
                 "Answers the named questions, or all of them:\n");
    list(out);
    fprintf(out,
            "Environment:\n"
            "  BENCH=quick|full  up to 1e5 vertices in some seconds, or up to 4e6; otherwise "
            "1e6, four minutes\n"
            "  MESH=path         ask on that mesh (.obj .off .ply .stl, plain or .gz) and not on "
            "synthetic grids\n"
            "  BENCH_OUT=folder  CSV files and plots go there; otherwise build/bench-out\n"
            "  SL_DATA=folder    the peers question adds meshes/bunny.off.gz from there\n"
            "Ends with status 1 if a result was wrong.\n");
    return out == stderr ? 2 : 0;
}

static int named(const char *name, int argc, char **argv) {
    for (int a = 1; a < argc; a++) {
        if (strcmp(argv[a], name) == 0) {
            return 1;
        }
    }
    return argc == 1;
}

/* The folder and those above it. */
static int make_folder(const char *path) {
    char part[512];
    snprintf(part, sizeof part, "%s", path);
    for (char *c = part + 1; *c; c++) {
        if (*c == '/') {
            *c = '\0';
            (void)mkdir(part, 0777); /* the last one tells whether all is well */
            *c = '/';
        }
    }
    return mkdir(part, 0777) == 0 || errno == EEXIST;
}

static int set_up(bench_run *run) {
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
    run->mesh_path = mesh_path && mesh_path[0] ? mesh_path : NULL;
    run->out_dir = folder && folder[0] ? folder : "build/bench-out";
    if (run->mesh_path && !bench_mesh(run->mesh_path)) {
        return 0;
    }
    if (!make_folder(run->out_dir)) {
        fprintf(stderr, "bench: cannot make the folder %s\n", run->out_dir);
        return 0;
    }
    return 1;
}

int main(int argc, char **argv) {
    bench_run run;
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
            fprintf(stderr, "bench: there is no question %s\n", argv[a]);
            return usage(stderr);
        }
    }
    if (!set_up(&run)) {
        return 2;
    }
    double start = bench_now();
    bench_bandwidth_measure();
    bench_peak_measure(&run);
    for (int k = 0; k < N_QUESTIONS; k++) {
        if (named(questions[k].name, argc, argv)) {
            double begin = bench_now();
            questions[k].ask(&run);
            bench_progress("[%s: %.0f s]\n", questions[k].name, bench_now() - begin);
        }
    }
    printf("\n%.0f s in all; CSV files and plots are in %s; %d checks failed\n",
           bench_now() - start, run.out_dir, run.failures);
    bench_systems_free();
    bench_threads_free();
    return run.failures > 0;
}
