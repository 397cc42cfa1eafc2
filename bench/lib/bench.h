/* bench.h: declarations shared by all questions: run, clock, systems, checks, tables and plots */
#ifndef BENCH_H
#define BENCH_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "sparse_local.h"
#include "tools/mesh/adjacency.h"

typedef struct bench_report bench_report; /* report.c */

/* ---- the run (main.c) ---- */
typedef enum bench_size { BENCH_QUICK = 0, BENCH_DEFAULT, BENCH_FULL } bench_size;

typedef struct bench_run_t {
    bench_size size;
    const char *mesh_path; /* MESH: run every question on this mesh; NULL: on synthetic systems */
    const char *out_dir;   /* where CSV files and plots are written */
    double seconds;        /* about how long the repetitions of one comparison take */
    double largest;        /* vertices of the largest grid */
    int failures;          /* number of failed checks */
} bench_run;

/** The questions, one file each. */
void bench_patches(bench_run *run);
void bench_scaling(bench_run *run);
void bench_cold(bench_run *run);
void bench_amortize(bench_run *run);
void bench_ordering(bench_run *run);
void bench_factor(bench_run *run);
void bench_front_kernels(bench_run *run);
void bench_harmonic(bench_run *run);
void bench_multi_rhs(bench_run *run);
void bench_vertex_pairs(bench_run *run);
void bench_inverse_entries(bench_run *run);
void bench_locality(bench_run *run);
void bench_selected_inverse(bench_run *run);
void bench_region(bench_run *run);
void bench_adf(bench_run *run);
void bench_shifted(bench_run *run);
void bench_neumann(bench_run *run);
void bench_saved(bench_run *run);
void bench_change(bench_run *run);
#ifdef SL_BENCH_ARPACK
void bench_eigenpairs(bench_run *run);
#endif
void bench_change_patch(bench_run *run);
void bench_storage(bench_run *run);
void bench_submatrix(bench_run *run);
void bench_edit(bench_run *run);
void bench_two_threads(bench_run *run);
#ifdef SL_BENCH_PEERS
void bench_peers(bench_run *run);
void bench_peers_harmonic(bench_run *run);
void bench_peers_shifted(bench_run *run);
void bench_peers_complex(bench_run *run);
void bench_peers_kkt(bench_run *run);
void bench_peers_kinds(bench_run *run);
void bench_peers_multifrontal(bench_run *run);
void bench_peers_small(bench_run *run);
#endif

/* ---- clock, repetitions, memory, pseudo-random numbers (harness.c) ---- */

/** Seconds of a monotonic clock. */
double bench_now(void);

/** Processor seconds of this process, of all threads. */
double bench_processor_seconds(void);

/** Order statistics of a list of times, in seconds. */
typedef struct bench_sample {
    int count;
    double min, median, max;
} bench_sample;

/** Sorts times. */
bench_sample bench_sample_of(double *times, int count);

/** Something to time: call(state), batch times per round (0 means 1), each call timed alone. */
typedef struct bench_contender {
    void (*call)(void *state);
    void *state;
    int batch;
    void (*ready)(void *state); /* called before each call, not timed; may be NULL */
} bench_contender;

/** Times contenders side by side: a warm-up of each, then rounds that run all of them in turn, so
 *  that disturbances by other programs affect all alike.
 *
 *  Stops after about the given number of seconds, but not before 3 rounds; 1 round is enough if the
 *  warm-up takes more than 4 times that long. If the warm-up takes more than 20 times that long,
 *  its times are the result.
 */
void bench_race(bench_sample *out, const bench_contender *contenders, int count, double seconds);

/** malloc, or exit with a message; release with free(). */
void *bench_alloc(size_t count, size_t bytes_each);

/** Exits with a message if status is an error. */
void bench_must(sl_status status, const char *doing);

/** Opens a file for writing (output_open); exits with a message if that fails. */
FILE *bench_create(const char *path);

/** Closes a file of bench_create and gives it its name; exits with a message if not everything
 *  could be written. */
void bench_close(FILE *file);

/** If the check failed, counts it and prints the message. Returns held. */
int bench_expect(bench_run *run, int held, const char *format, ...);

/** Exponent e of the least-squares fit y = c x^e. */
double bench_fit_exponent(const double *x, const double *y, int count);

/** Prints progress messages to stderr. */
void bench_progress(const char *format, ...);

/** A deterministic pseudo-random generator; its state must not be 0. */
uint64_t bench_random(uint64_t *state);
sl_int bench_random_below(uint64_t *state, sl_int bound);
double bench_random_unit(uint64_t *state); /* in (-1, 1) */
void bench_random_fill(uint64_t *state, double *x, size_t count);

/* ---- threads (threads.c) ---- */

/** The value of options.threads for this number of threads. */
sl_threads bench_threads(sl_int count);
void bench_threads_free(void);

/* ---- instruction sets (peak.c) ---- */

/** The name of an instruction set as the tables print it: "avx2". */
const char *bench_isa_name(sl_isa isa);

/** Whether it is compiled in and this processor has it. */
int bench_isa_is_present(sl_isa isa);

/** The one that SL_ISA_AUTO stands for on this processor. */
sl_isa bench_isa_best(void);

/* ---- the machine's limits (bandwidth.c, peak.c) ---- */

/** Read bandwidth of one core in bytes per second, over a block of the given size, measured in this
 *  run.
 */
double bench_bandwidth(double bytes);

/** Measures the bandwidth and prints it; checks that caches are not slower than memory. */
void bench_bandwidth_measure(bench_run *run);

/** Peak floating-point operations per second of one core, on registers alone; a fused multiply-add
 *  counts as 2. 0 if the instruction set is absent. SL_ISA_AUTO: the maximum over all.
 */
double bench_peak(sl_isa isa);

/** Measures the peak rates and prints them. */
void bench_peak_measure(bench_run *run);

/** Writes name.machine.txt beside the CSV file (machine.c): date, commit (BENCH_COMMIT of the
 *  environment), processor, instruction set, compiler, limits. Every report has one. */
void bench_machine_write(const bench_run *run, const char *name);

/* ---- systems (systems.c) ---- */

/** The matrix M + t L of a mesh (L is the cotangent Laplacian), analyzed and factored, with the
 *  graph of its entries.
 *
 *  Heat spreads over a tenth of the mesh: t = (0.1 diameter)^2. With the small t of a geodesic
 *  distance, far entries of the solution would be denormal numbers, and the bench would measure
 *  their cost.
 */
typedef struct bench_system {
    char name[64];
    sl_int n;
    double t;          /* of M + t L; 0 for other matrices */
    sl_matrix *matrix; /* lower triangle */
    sl_csc A;
    sl_symbolic *S;
    sl_factor *F;
    sl_stats stats;
    adjacency graph;
    unsigned char *seen; /* n zeros, scratch of adjacency_bfs */
    sl_int *local_index; /* n times -1, scratch for numbering a subset of the rows */
} bench_system;

/** Jittered triangle grids with about the wanted numbers of vertices, up to the size of the run; if
 *  MESH is set, only that mesh. Built on first use and kept. Returns how many were stored; out has
 *  room for count.
 */
int bench_systems(const bench_run *run, const double *wanted, int count, const bench_system **out);

/** A torus with about this many vertices, built on first use and kept. */
const bench_system *bench_torus(double vertices);

/** The 7-point Laplacian of a side x side x side grid, built on first use and kept. */
const bench_system *bench_volume(sl_int side);

/** M + t (L M^-1)^(k-1) L with k = 1, 2 or 3 on a grid with about this many vertices, or on MESH,
 *  where t = (0.1 diameter)^(2 k). Built on first use and kept. If rounding makes a pivot unusable,
 *  prints that and returns NULL.
 */
const bench_system *bench_k_harmonic(const bench_run *run, double vertices, int k);

/** The system of a mesh file, built on first use and kept. NULL if it cannot be read. */
const bench_system *bench_mesh(const char *path);

/** Releases all systems. */
void bench_systems_free(void);

/** Memory in bytes: the matrix, the panels of L, and what the library allocates. With a given
 *  permutation no memory of an ordering is included.
 */
typedef struct bench_memory {
    double matrix, panels;
    double analysis, analysis_peak; /* kept by the analysis, and its peak while it runs */
    double factor;                  /* kept by the factor, in addition to the analysis */
    double peak;                    /* peak of analysis + factorization */
} bench_memory;

bench_memory bench_memory_of(const bench_system *system, sl_options options);

/** Checks A X = B: the backward error of each of the nrhs columns (leading dimensions n) is within
 *  rounding.
 */
int bench_check_residual(bench_run *run, const bench_system *system, const double *X,
                         const double *B, sl_int nrhs, const char *method);

/** Prints the residual of nrhs solutions: its largest entry, the largest entry of B, and the
 *  largest backward error.
 */
void bench_note_residual(bench_report *report, const bench_system *system, const double *X,
                         const double *B, sl_int nrhs, const char *method);

/** Checks that X (nx x nrhs, leading dimension nx) equals rows xset of full (leading dimension n)
 *  bit for bit, except for the sign of zeros.
 */
int bench_check_bits(bench_run *run, const bench_system *system, const double *X,
                     const sl_int *xset, sl_int nx, const double *full, sl_int nrhs,
                     const char *method);

/** The mean over all rows of the path weight: the sum of the column counts from a row's column to
 *  the root, which are the entries that a local solve at that row reads, without relaxation
 *  (path_weight.c).
 *
 *  largest  [out]  the largest path weight; may be NULL.
 */
double bench_path_weight(const sl_symbolic *S, double *largest);

/* ---- patches of a graph (patch_system.c) ---- */

/** A connected set of vertices, its boundary and its submatrix. */
typedef struct bench_patch {
    sl_int size;
    sl_int *vertices;
    sl_int n_boundary; /* vertices with a neighbor outside */
    sl_int *boundary;
    sl_int *boundary_index; /* boundary[k] = vertices[boundary_index[k]] */
    sl_matrix
        *matrix; /* A(vertices, vertices), which means zero Dirichlet values around the patch */
    sl_csc A;
} bench_patch;

/** The patch of up to size vertices that a breadth-first search from seed finds. */
bench_patch bench_patch_create(const bench_system *system, sl_int seed, sl_int size);
/** A patch of the given vertices, without a boundary. */
bench_patch bench_patch_of(const bench_system *system, const sl_int *vertices, sl_int size);
void bench_patch_free(bench_patch *patch);

/** Patches of exactly size vertices around random seeds, none a whole connected component. Returns
 *  how many of count were found.
 */
int bench_patch_pick(bench_patch *out, int count, const bench_system *system, sl_int size);

/* ---- local solves in every variant (queries.c) ---- */

/** One local solve: sets, random values, plan. */
typedef struct bench_query {
    sl_int nb, nx;
    sl_int *bset, *xset;
    double *B, *X; /* nb x nrhs, nx x nrhs */
    sl_plan *plan;
    sl_stats reach;
} bench_query;

/** A list of local solves with the same number of right-hand sides. Each call below runs the next
 *  one, cyclically.
 */
typedef struct bench_queries {
    const bench_system *system;
    sl_work *W;
    sl_int nrhs;
    int count, room, next;
    bench_query *all;
    double *B_full, *X_full; /* n x nrhs, those of query 0 */
} bench_queries;

bench_queries *bench_queries_create(const bench_system *system, int room, sl_int nrhs);
void bench_queries_add(bench_queries *q, const sl_int *bset, sl_int nb, const sl_int *xset,
                       sl_int nx);
void bench_queries_free(bench_queries *q);

/** A list of room queries with b and x at one random vertex each. */
bench_queries *bench_queries_vertices(const bench_system *system, int room, sl_int nrhs);

/** Compares the first few queries with full solves, bit for bit: on a plan, plan + solve, in one
 *  call.
 */
int bench_queries_check(bench_run *run, bench_queries *q, int few);

/** Means of the reach over all queries. */
sl_stats bench_queries_reach(const bench_queries *q);

/* contenders; state is a bench_queries * */
void bench_call_plan_create(void *state); /* and releases the plan */
void bench_call_plan_solve(void *state);
void bench_call_plan_and_solve(void *state); /* creates the plan, solves, releases the plan */
void bench_call_plan_solve_one_by_one(void *state); /* one call per right-hand side */
void bench_call_one_shot(void *state);
void bench_call_full(void *state);
void bench_call_full_interleaved(void *state); /* B and X are taken as row-major */
void bench_call_full_one_by_one(void *state);

/* ---- tables and CSV (report.c) ---- */

/** One line of a table. Fields that do not apply are 0. */
typedef struct bench_row {
    const char *what;   /* the case: "patch 2000" */
    const char *method; /* "plan solve" */
    sl_isa isa;         /* SL_ISA_AUTO: that of the system */
    int is_peer;        /* measured on another library, which chooses its instruction set itself */
    sl_int threads;     /* 0 means 1 */
    sl_int nrhs;
    sl_stats reach; /* columns and entries of both sweeps */
    double entries; /* doubles of L read, both sweeps together */
    int passes;     /* how often the same entries are read; 0 means once */
    double flops;   /* of a factorization; the flops of a solve follow from entries */
    bench_sample time;
    double baseline; /* seconds; the printed ratio is time.median / baseline */
} bench_row;

/** Prints the heading of the table of a question and opens its CSV file. */
bench_report *bench_report_open(const bench_run *run, const char *name, const char *question,
                                const char *baseline);

/** Formats a time in at most 9 characters: "4.321 us". */
const char *bench_time_text(char *text, size_t size, double seconds);
void bench_report_row(bench_report *report, const bench_system *system, const bench_row *row);
void bench_report_note(bench_report *report, const char *format, ...);
void bench_report_close(bench_report *report);

/** Sets the reach and entries of a row from the plan group of stats. */
void bench_row_reach(bench_row *row, const sl_stats *stats);

/** Sets the reach and entries of a row to those of a full solve. */
void bench_row_full(bench_row *row, const bench_system *system);

/* ---- the run in words (summary.c) ---- */

/** Keeps a row of a question for bench_summary_print. */
void bench_summary_keep(const char *question, const bench_system *system, const bench_row *row);

/** Prints a sentence or two on each of the first questions that were answered. */
void bench_summary_print(void);
void bench_summary_free(void);

/* ---- the variants of a local solve, timed (solve_variants.c) ---- */
enum {
    BENCH_PLAN_SOLVE = 0,
    BENCH_PLAN_CREATE,
    BENCH_ONE_SHOT,
    BENCH_FULL_SOLVE,
    BENCH_SOLVE_VARIANTS
};

extern const char *const bench_solve_variants[BENCH_SOLVE_VARIANTS];

/** Checks the first two queries, then times all queries in every variant and prints a row for each.
 *  what names the case.
 *
 *  medians [out] BENCH_SOLVE_VARIANTS times in seconds. Returns whether the checks passed; if not,
 *  nothing is timed.
 */
int bench_solve_variants_time(bench_run *run, bench_report *report, bench_queries *q,
                              const char *what, double *medians);

/* ---- plots (plot.c) ---- */
typedef struct bench_plot bench_plot;

/** Creates a plot. log contains x and y for the axes that are logarithmic. */
bench_plot *bench_plot_open(const bench_run *run, const char *name, const char *title,
                            const char *x_label, const char *y_label, const char *log);

/** Appends a point to the named series, which the first point creates. style is "linespoints",
 *  "points" or "boxes"; " lc K" adds a color, " dt 2" makes the line dashed.
 */
void bench_plot_point(bench_plot *plot, const char *series, const char *style, double x, double y);

/** Writes name.svg and frees the plot. */
void bench_plot_close(bench_plot *plot);

#endif
