/* bench.h: what every question of the bench shares: the run, clock, systems, checks, rows and plots */
#ifndef BENCH_H
#define BENCH_H

#include <stddef.h>
#include <stdint.h>

#include "../sparse_local.h"
#include "../tools/patch.h"

typedef struct bench_report bench_report; /* report.c */

/* ---- the run (main.c) ---- */
typedef enum bench_size { BENCH_QUICK = 0, BENCH_DEFAULT, BENCH_FULL } bench_size;

typedef struct bench_run_t {
    bench_size size;
    const char *mesh_path; /* MESH: answers every question on this mesh; NULL: synthetic grids */
    const char *out_dir;   /* CSV files and plots go there */
    double seconds;        /* repetitions of one comparison go on for about so long */
    int failures;          /* checks that failed */
} bench_run;

/** The questions, each in a file of its own. */
void bench_patches(bench_run *run);
void bench_scaling(bench_run *run);
void bench_amortize(bench_run *run);
void bench_ordering(bench_run *run);
void bench_factor(bench_run *run);
void bench_kernels(bench_run *run);
void bench_harmonic(bench_run *run);
void bench_multi_rhs(bench_run *run);
void bench_pairs(bench_run *run);
void bench_inverse(bench_run *run);
void bench_locality(bench_run *run);
void bench_selected(bench_run *run);
void bench_region(bench_run *run);
void bench_adf(bench_run *run);
void bench_several(bench_run *run);
void bench_neumann(bench_run *run);
#ifdef SL_BENCH_PEERS
void bench_peers(bench_run *run);
void bench_peers_harmonic(bench_run *run);
void bench_peers_several(bench_run *run);
#endif

/* ---- clock, repetitions, memory, chance (harness.c) ---- */

/** Seconds of a monotonic clock. */
double bench_now(void);

/** Order statistics of some times, in seconds. */
typedef struct bench_sample {
    int count;
    double min, median, max;
} bench_sample;

/** Sorts times. */
bench_sample bench_sample_of(double *times, int count);

/** Something to time: call(state), batch times in a row a round (0 means 1), each call timed alone. */
typedef struct bench_contender {
    void (*call)(void *state);
    void *state;
    int batch;
    void (*ready)(void *state); /* before each call, not timed; may be NULL */
} bench_contender;

/** Times contenders side by side: a warm-up of each, then rounds that go through all of them, so that what the
 *  machine does meanwhile meets all alike. Goes on until about so many seconds have passed: 3 rounds at least, or 1
 *  where a round takes more than 4 times as long as that; beyond 20 times the warm-up is the round.
 */
void bench_race(bench_sample *out, const bench_contender *contenders, int count, double seconds);

/** Memory or the end of the program; free() releases. */
void *bench_alloc(size_t count, size_t bytes_each);

/** Ends the program with a message if status is an error. */
void bench_must(sl_status status, const char *doing);

/** Counts a failed check and says which; returns whether it held. */
int bench_expect(bench_run *run, int held, const char *format, ...);

/** The exponent e of the least-squares fit y = c x^e. */
double bench_fit_exponent(const double *x, const double *y, int count);

/** Progress, on the error stream. */
void bench_progress(const char *format, ...);

/** A deterministic stream of chance; state must not be 0. */
uint64_t bench_random(uint64_t *state);
sl_int bench_random_below(uint64_t *state, sl_int bound);
double bench_random_unit(uint64_t *state); /* in (-1, 1) */
void bench_random_fill(uint64_t *state, double *x, size_t count);

/* ---- threads (threads.c) ---- */

/** What options.threads takes for so many threads. */
sl_threads bench_threads(sl_int count);
void bench_threads_free(void);

/* ---- the machine's limits (bandwidth.c, peak.c) ---- */

/** Bytes a second that one core reads in a loop over a block of so many bytes, measured in this run. */
double bench_bandwidth(double bytes);

/** Measures, and prints what was found. */
void bench_bandwidth_measure(void);

/** Floating-point operations a second that one core does on registers alone, a fused multiply-add being two; 0 where
 *  the ISA is not here, SL_ISA_AUTO: of the best one. */
double bench_peak(sl_isa isa);

/** Measures, and prints what was found. */
void bench_peak_measure(bench_run *run);

/** Writes name.machine.txt beside the CSV file: date, processor, compiler, limits (machine.c). */
void bench_machine_write(const bench_run *run, const char *name);

/* ---- systems (systems.c) ---- */

/** A mesh's matrix M + t L (L the cotangent Laplacian), analysed and factored, with the graph of its entries.
 *
 *  Heat spreads over a tenth of the mesh: t = (0.1 diameter)^2. With the small t of a geodesic distance the solution
 *  far away would be denormal numbers, and their cost would be measured in place of the solver's.
 */
typedef struct bench_system {
    char name[64];
    sl_int n;
    sl_matrix *matrix; /* lower triangle */
    sl_csc A;
    sl_symbolic *S;
    sl_factor *F;
    sl_stats stats;
    adjacency graph;
    unsigned char *seen; /* n zeros, lent to patch_bfs */
    sl_int *place;       /* n times -1, lent to whoever numbers a subset */
} bench_system;

/** Triangulated jittered grids of about the wanted numbers of vertices, those that the size of the run admits; with
 *  MESH the one mesh. Built at first demand and kept for later questions. Returns how many; out has room for count.
 */
int bench_systems(const bench_run *run, const double *wanted, int count, const bench_system **out);

/** A torus, closed, of about so many vertices, kept in the same way. */
const bench_system *bench_torus(double vertices);

/** The 7-point Laplacian of a side x side x side grid, kept in the same way. */
const bench_system *bench_volume(sl_int side);

/** M + t (L M^-1)^(k-1) L, k = 1, 2, 3, of such a grid (with MESH of the one mesh), t = (0.1 diameter)^(2 k), kept in
 *  the same way; NULL, and said, where rounding loses a pivot. */
const bench_system *bench_k_harmonic(const bench_run *run, double vertices, int k);

/** The mesh of that file, kept in the same way; NULL if it cannot be read. */
const bench_system *bench_mesh(const char *path);

/** Releases all of them. */
void bench_systems_free(void);

/** Bytes: the matrix, the panels of L, and what the library takes for them; nothing of an ordering's where the order
 *  is given. */
typedef struct bench_memory {
    double matrix, panels;
    double analysis, analysis_peak; /* kept, and at once while it runs */
    double factor;                  /* kept beside the analysis */
    double peak;                    /* at once, of analyse + factor */
} bench_memory;

bench_memory bench_memory_of(const bench_system *system, sl_options options);

/** A X = B holds: the backward error of each of the nrhs columns (leading dimensions n) is within rounding. */
int bench_check_residual(bench_run *run, const bench_system *system, const double *X,
                         const double *B, sl_int nrhs, const char *method);

/** Prints the residual of nrhs solutions as a line of the table: its largest entry beside the largest of B, and the
 *  backward error. */
void bench_note_residual(bench_report *report, const bench_system *system, const double *X,
                         const double *B, sl_int nrhs, const char *method);

/** X (nx x nrhs, leading dimension nx) has the bits of rows xset of full (leading dimension n), zeros of either
 *  sign being equal. */
int bench_check_bits(bench_run *run, const bench_system *system, const double *X,
                     const sl_int *xset, sl_int nx, const double *full, sl_int nrhs,
                     const char *method);

/* ---- patches of a graph (patch_system.c) ---- */

/** The vertices of a connected patch and what is around it. */
typedef struct bench_patch {
    sl_int size;
    sl_int *vertices;
    sl_int n_boundary; /* vertices with a neighbour outside */
    sl_int *boundary;
    sl_int *boundary_place; /* boundary[k] = vertices[boundary_place[k]] */
    sl_matrix *matrix;      /* A(vertices, vertices): zero Dirichlet values around the patch */
    sl_csc A;
} bench_patch;

/** Breadth-first patch of up to size vertices around seed. */
bench_patch bench_patch_create(const bench_system *system, sl_int seed, sl_int size);
void bench_patch_free(bench_patch *patch);

/** Patches of exactly size vertices, and not of a whole component, around seeds drawn by chance; returns how many
 *  of count were found. */
int bench_patch_pick(bench_patch *out, int count, const bench_system *system, sl_int size);

/* ---- local solves in every form (queries.c) ---- */

/** One local solve: its sets, random values, plan. */
typedef struct bench_query {
    sl_int nb, nx;
    sl_int *bset, *xset;
    double *B, *X; /* nb x nrhs, nx x nrhs */
    sl_plan *plan;
    sl_stats reach;
} bench_query;

/** Several of them with the same number of right-hand sides: each call below takes the next one in turn. */
typedef struct bench_queries {
    const bench_system *system;
    sl_work *W;
    sl_int nrhs;
    int count, room, next;
    bench_query *all;
    double *B_full, *X_full; /* n x nrhs, of query 0 */
} bench_queries;

bench_queries *bench_queries_create(const bench_system *system, int room, sl_int nrhs);
void bench_queries_add(bench_queries *q, const sl_int *bset, sl_int nb, const sl_int *xset,
                       sl_int nx);
void bench_queries_free(bench_queries *q);

/** One query of one vertex to itself for each of room vertices drawn by chance. */
bench_queries *bench_queries_vertices(const bench_system *system, int room, sl_int nrhs);

/** Compares the first few queries, planned and in one shot, with full solves, bit for bit. */
int bench_queries_check(bench_run *run, bench_queries *q, int few);

/** Means of the reach of all queries. */
sl_stats bench_queries_reach(const bench_queries *q);

/* contenders; state is the bench_queries */
void bench_call_plan_create(void *state); /* and its release */
void bench_call_plan_solve(void *state);
void bench_call_plan_solve_apart(void *state); /* one right-hand side after the other */
void bench_call_one_shot(void *state);
void bench_call_full(void *state);
void bench_call_full_interleaved(void *state); /* B and X read as row-major */
void bench_call_full_apart(void *state);

/* ---- tables and CSV (report.c) ---- */

/** One line of a table. What does not apply is 0. */
typedef struct bench_row {
    const char *what;   /* the case: "patch 2000" */
    const char *method; /* "plan solve" */
    sl_isa isa;         /* SL_ISA_AUTO: the system's */
    int foreign;        /* another library's: it chooses its instructions by itself */
    sl_int threads;     /* 0 means 1 */
    sl_int nrhs;
    sl_stats reach; /* columns and entries of both sweeps */
    double entries; /* doubles of L read, both sweeps together */
    int passes;     /* how often over the same entries; 0 means once */
    double flops;   /* of a factorization; those of a solve follow from its entries */
    bench_sample time;
    double baseline; /* seconds: the ratio is time.median / baseline */
} bench_row;

/** Opens the question's table and its CSV file. */
bench_report *bench_report_open(const bench_run *run, const char *name, const char *question,
                                const char *baseline);

/** "avx2" */
const char *bench_isa_name(sl_isa isa);

/** "4.321 us": 9 characters at most. */
const char *bench_time_text(char *text, size_t size, double seconds);
void bench_report_row(bench_report *report, const bench_system *system, const bench_row *row);
void bench_report_note(bench_report *report, const char *format, ...);
void bench_report_close(bench_report *report);

/** A row's reach and entries from the plan group of stats. */
void bench_row_reach(bench_row *row, const sl_stats *stats);

/** A row's reach and entries for a full solve. */
void bench_row_full(bench_row *row, const bench_system *system);

/* ---- the forms of local solves, timed (forms.c) ---- */
enum { BENCH_PLAN_SOLVE = 0, BENCH_PLAN_CREATE, BENCH_ONE_SHOT, BENCH_FULL_SOLVE, BENCH_FORMS };

extern const char *const bench_forms[BENCH_FORMS];

/** Checks the first two queries, times all in every form, with a row for each; what names the case.
 *
 *  medians  [out]  BENCH_FORMS times in seconds.
 *  Returns whether the check held; nothing is timed otherwise.
 */
int bench_forms_time(bench_run *run, bench_report *report, bench_queries *q, const char *what,
                     double *medians);

/* ---- plots (plot.c) ---- */
typedef struct bench_plot bench_plot;

/** A plot of series of points; "x" and "y" in log hold where an axis is logarithmic. */
bench_plot *bench_plot_open(const bench_run *run, const char *name, const char *title,
                            const char *x_label, const char *y_label, const char *log);

/** Appends a point to the series of that name, made at first use; style is "linespoints" or "boxes", with
 *  " lc K" a colour of one's own, with " dt 2" dashed. */
void bench_plot_point(bench_plot *plot, const char *series, const char *style, double x, double y);

/** Writes name.svg; frees the plot. */
void bench_plot_close(bench_plot *plot);

#endif
