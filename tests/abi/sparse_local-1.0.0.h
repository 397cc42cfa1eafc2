/* sparse_local-1.0.0.h: what version 1.0.0 declares, as a compiler sees it */
#include <stddef.h>
#include <stdint.h>
typedef int32_t sl_int;
typedef int64_t sl_off;
extern int sl_version(void);
typedef enum sl_status {
    SL_OK = 0,
    SL_ERR_ARGUMENT,
    SL_ERR_MEMORY,
    SL_ERR_MALFORMED,
    SL_ERR_PIVOT,
    SL_ERR_NOT_FINITE,
    SL_ERR_TOO_LARGE,
    SL_ERR_UNSUPPORTED,
    SL_ERR_IO,
    SL_ERR_ORDERING,
    SL_ERR_MISMATCH,
    SL_ERR_INCONSISTENT,
    SL_ERR_INACCURATE,
    SL_ERR_OTHER_PATTERN,
    SL_ERR_STALE,
    SL_ERR_READ_ONLY
} sl_status;
extern const char *sl_status_string(sl_status status);
#define SL_ALL (-1)
typedef struct sl_csc {
    sl_int n_rows;
    sl_int n_cols;
    const sl_int *p;
    const sl_int *i;
    const double *x;
} sl_csc;
typedef enum sl_triangle {
    SL_TRIANGLE_NONE = 0,
    SL_TRIANGLE_LOWER,
    SL_TRIANGLE_UPPER,
    SL_TRIANGLE_BOTH
} sl_triangle;
typedef enum sl_reading {
    SL_AS_SYMMETRIC = 0,
    SL_AS_STORED
} sl_reading;
typedef enum sl_ordering {
    SL_ORDERING_ND = 0,
    SL_ORDERING_METIS = 1,
    SL_ORDERING_GIVEN = 3,
    SL_ORDERING_NATURAL = 4,
    SL_ORDERING_MINDEG = 5
} sl_ordering;
typedef enum sl_purpose {
    SL_PURPOSE_MANY_SOLVES = 0,
    SL_PURPOSE_ONE_FACTOR
} sl_purpose;
typedef enum sl_relaxation {
    SL_RELAXATION_DEFAULT = 0,
    SL_RELAXATION_NONE
} sl_relaxation;
typedef enum sl_isa {
    SL_ISA_AUTO = 0,
    SL_ISA_SCALAR,
    SL_ISA_AVX2,
    SL_ISA_AVX512,
    SL_ISA_NEON
} sl_isa;
typedef enum sl_method {
    SL_METHOD_AUTO = 0,
    SL_METHOD_UP_LOOKING,
    SL_METHOD_SUPERNODAL
} sl_method;
typedef enum sl_storage {
    SL_STORAGE_DOUBLE = 0,
    SL_STORAGE_FLOAT,
    SL_STORAGE_COMPLEX
} sl_storage;
typedef enum sl_pivots {
    SL_PIVOTS_NONZERO = 0,
    SL_PIVOTS_POSITIVE,
    SL_PIVOTS_SKIP_NULL
} sl_pivots;
typedef enum sl_inverse_method {
    SL_INVERSE_NONE = 0,
    SL_INVERSE_FORWARD,
    SL_INVERSE_SELECTED
} sl_inverse_method;
typedef enum sl_certainty {
    SL_UNCERTIFIED = 0,
    SL_ESTIMATED,
    SL_GUARANTEED
} sl_certainty;
typedef enum sl_change_method {
    SL_CHANGE_NONE = 0,
    SL_CHANGE_UPDATE,
    SL_CHANGE_REACH,
    SL_CHANGE_REFACTOR
} sl_change_method;
typedef enum sl_change_reason {
    SL_CHANGE_CHEAPEST = 0,
    SL_CHANGE_UNSUITED,
    SL_CHANGE_DRIFT,
    SL_CHANGE_REFUSED,
    SL_CHANGE_COLUMNS
} sl_change_reason;
typedef struct sl_matrix sl_matrix;
typedef struct sl_symbolic sl_symbolic;
typedef struct sl_factor sl_factor;
typedef struct sl_plan sl_plan;
typedef struct sl_work sl_work;
typedef struct sl_selected sl_selected;
typedef struct sl_constraints sl_constraints;
typedef struct sl_region sl_region;
typedef struct sl_fixed sl_fixed;
typedef void (*sl_parallel_for)(void *context, sl_int count, void (*body)(void *data, sl_int k),
                                void *data);
typedef struct sl_threads {
    sl_int count;
    sl_parallel_for run;
    void *context;
} sl_threads;
typedef struct sl_allocator {
    void *(*allocate)(void *context, size_t bytes);
    void (*release)(void *context, void *block);
    void *context;
} sl_allocator;
typedef struct sl_options {
    size_t size;
    sl_allocator allocator;
    sl_threads threads;
    sl_ordering ordering;
    sl_relaxation relaxation;
    sl_triangle triangle;
    const sl_int *perm;
    sl_int block_size;
    sl_purpose purpose;
    sl_isa isa;
    sl_method method;
    sl_storage storage;
    sl_pivots pivots;
    double null_tolerance;
    const double *null_vector;
    sl_int null_vector_count;
    const double *mass;
    double consistency_tolerance;
    double regularization;
    const sl_int *signs;
    double growth_limit;
    double error_limit;
    const sl_region *region;
    size_t region_bytes;
    sl_off reserved[16];
} sl_options;
extern void sl_options_init(sl_options *opt, size_t size);
typedef struct sl_error {
    sl_int row;
    sl_int column;
    sl_off line;
    double value;
    const char *what;
} sl_error;
typedef struct sl_symbolic_info {
    sl_int n;
    sl_triangle triangle;
    sl_off nnz_a;
    sl_off nnz_l;
    sl_off nnz_panels;
    double flops;
    sl_int supernodes;
    sl_int supernodes_fundamental;
    sl_int tree_height;
    sl_int components;
    sl_int pairs;
    sl_int delayed;
    double seconds_order;
    double seconds_analyze;
    double seconds_tree;
    double seconds_structure;
    size_t bytes;
} sl_symbolic_info;
typedef struct sl_factor_info {
    sl_int positive;
    sl_int negative;
    sl_int null;
    sl_int regularized;
    sl_int weak;
    sl_int regular;
    sl_isa isa;
    sl_method method;
    sl_storage storage;
    sl_int threads;
    double pivot_min;
    double pivot_max;
    double entry_max;
    double growth;
    double null_bound;
    double seconds_setup;
    double seconds;
    size_t bytes;
} sl_factor_info;
typedef struct sl_plan_info {
    sl_int b_supernodes;
    sl_int b_columns;
    sl_off b_entries;
    sl_int x_supernodes;
    sl_int x_columns;
    sl_off x_entries;
    int in_region;
    sl_off region_entries;
    size_t bytes;
} sl_plan_info;
typedef struct sl_inverse_info {
    sl_inverse_method method;
    sl_int supernodes;
    sl_int columns;
    sl_off entries;
} sl_inverse_info;
typedef struct sl_selected_info {
    sl_int supernodes;
    sl_int columns;
    sl_off entries;
    double seconds;
    size_t bytes;
} sl_selected_info;
typedef struct sl_region_info {
    sl_int rows;
    sl_int boundary;
    sl_int subtrees;
    sl_off entries;
    int is_copied;
    double seconds;
    size_t bytes;
} sl_region_info;
typedef struct sl_refine_info {
    sl_int steps;
    double backward_error;
} sl_refine_info;
typedef struct sl_certificate_info {
    sl_certainty certainty;
    sl_int solves;
    double eta;
    double eigenvalue_min;
    double seconds;
} sl_certificate_info;
typedef struct sl_change_info {
    sl_change_method method;
    sl_change_reason reason;
    sl_int ranks;
    sl_off entries;
    sl_off updates;
    double drift;
    double flops_update;
    double flops_changed;
    double flops_refactor;
    double seconds;
} sl_change_info;
typedef struct sl_submatrix_info {
    sl_int kept;
    sl_int computed;
    sl_off entries;
    int is_anew;
    double seconds;
} sl_submatrix_info;
typedef struct sl_edit_info {
    sl_int changed;
    sl_int moved;
    sl_int reordered;
    sl_int computed;
    int is_anew;
    int is_due;
    double growth;
    double seconds;
} sl_edit_info;
typedef struct sl_reuse_info {
    sl_int kept;
    sl_int computed;
    sl_off entries;
    double flops;
    double flops_anew;
    int is_anew;
    sl_change_reason reason;
    double seconds;
} sl_reuse_info;
typedef struct sl_constraints_info {
    sl_int count;
    double seconds;
} sl_constraints_info;
typedef struct sl_fixed_info {
    sl_int n_free;
    sl_off couplings;
    double seconds;
} sl_fixed_info;
typedef struct sl_stats {
    sl_error error;
    sl_symbolic_info symbolic;
    sl_factor_info factor;
    sl_plan_info plan;
    sl_inverse_info inverse;
    sl_selected_info selected;
    sl_region_info region;
    sl_refine_info refine;
    sl_change_info change;
    sl_submatrix_info submatrix;
    sl_edit_info edit;
    sl_reuse_info reuse;
    sl_constraints_info constraints;
    sl_certificate_info certificate;
    sl_fixed_info fixed;
    sl_off reserved[40];
} sl_stats;
extern size_t sl_error_text(char *buffer, size_t size, sl_status status, const sl_stats *stats);
extern size_t sl_stats_size(void);
extern sl_status sl_matrix_from_triplets(sl_matrix **out, sl_int n_rows,
                                                        sl_int n_cols, sl_off count,
                                                        const sl_int *i, const sl_int *j,
                                                        const double *x, const sl_options *opt,
                                                        sl_stats *stats);
extern sl_status sl_matrix_submatrix(sl_matrix **out, const sl_csc *A,
                                                    const sl_int *rows, sl_int count,
                                                    const sl_options *opt, sl_stats *stats);
extern sl_csc sl_matrix_view(const sl_matrix *M);
extern void sl_matrix_free(sl_matrix *M);
extern sl_status sl_csc_check(const sl_csc *A, sl_stats *stats);
extern sl_status sl_csc_triangle(const sl_csc *A, sl_triangle *out,
                                                const sl_options *opt, sl_stats *stats);
extern sl_status sl_csc_multiply(const sl_csc *A, sl_reading reading, double *Y,
                                                size_t ldy, const double *X, size_t ldx,
                                                sl_int nrhs);
extern sl_status sl_csc_residual(const sl_csc *A, double *R, size_t ldr,
                                                double *backward_error, const double *X, size_t ldx,
                                                const double *B, size_t ldb, sl_int nrhs);
extern sl_status sl_symbolic_create(sl_symbolic **out, const sl_csc *A,
                                                   const sl_options *opt, sl_stats *stats);
extern void sl_symbolic_free(sl_symbolic *S);
typedef struct sl_symbolic_arrays {
    sl_symbolic_info info;
    sl_int n;
    sl_int n_supers;
    const sl_int *perm;
    const sl_int *iperm;
    const sl_int *parent;
    const sl_int *counts;
    const sl_int *super_first;
    const sl_int *super_of;
    const sl_int *super_parent;
    const sl_off *rows_begin;
    const sl_int *rows;
    const sl_off *panel_begin;
    const unsigned char *pairs;
    sl_int n_nodes;
    const sl_int *node_of;
    const sl_int *node_parent;
    const sl_int *node_level;
    const void *reserved[2];
} sl_symbolic_arrays;
extern sl_symbolic_arrays sl_symbolic_view(const sl_symbolic *S);
extern sl_status sl_factor_create(sl_factor **out, const sl_symbolic *S,
                                                 const sl_csc *A, const sl_options *opt,
                                                 sl_stats *stats);
extern sl_status sl_factor_refactor(sl_factor *F, const sl_csc *A, sl_stats *stats);
extern void sl_factor_free(sl_factor *F);
typedef enum sl_pivot_kind {
    SL_PIVOT_NULL = 0,
    SL_PIVOT_REGULARIZED
} sl_pivot_kind;
extern sl_status sl_factor_pivot_rows(const sl_factor *F, sl_pivot_kind kind,
                                                     sl_int *rows, double *shifts, sl_int capacity,
                                                     sl_int *count);
extern sl_status sl_factor_logdet(const sl_factor *F, double *log_abs_det,
                                                 double *sign);
extern sl_status sl_factor_lower(sl_matrix **out, const sl_factor *F,
                                                const sl_options *opt);
typedef struct sl_factor_arrays {
    sl_factor_info info;
    const sl_symbolic *symbolic;
    const double *L;
    const double *D;
    const double *E;
    const float *L_float;
    const void *reserved[2];
} sl_factor_arrays;
extern sl_factor_arrays sl_factor_view(const sl_factor *F);
#define SL_ROWS(ld) ((size_t)(ld) | SL_ROW_MAJOR)
#define SL_ROW_MAJOR (~((size_t)-1 >> 1))
extern sl_status sl_work_create(sl_work **out, const sl_options *opt);
extern void sl_work_free(sl_work *W);
extern size_t sl_work_bytes(const sl_work *W);
extern sl_status sl_work_reserve(sl_work *W, size_t bytes);
extern sl_status sl_factor_solve(const sl_factor *F, double *X, size_t ldx,
                                                const double *B, size_t ldb, sl_int nrhs,
                                                sl_work *W);
extern sl_status sl_plan_create(sl_plan **out, const sl_symbolic *S,
                                               const sl_int *bset, sl_int nb, const sl_int *xset,
                                               sl_int nx, const sl_options *opt, sl_stats *stats);
extern void sl_plan_free(sl_plan *P);
extern void sl_plan_stats(const sl_plan *P, sl_stats *stats);
extern sl_status sl_plan_solve(const sl_plan *P, const sl_factor *F, double *X,
                                              size_t ldx, const double *B, size_t ldb, sl_int nrhs,
                                              sl_work *W);
extern sl_status sl_local_solve(const sl_factor *F, const sl_int *bset, sl_int nb,
                                               const sl_int *xset, sl_int nx, double *X, size_t ldx,
                                               const double *B, size_t ldb, sl_int nrhs, sl_work *W,
                                               sl_stats *stats);
extern sl_status sl_fixed_create(sl_fixed **out, const sl_csc *A, const sl_int *rows,
                                                sl_int count, const sl_options *opt,
                                                sl_stats *stats);
extern void sl_fixed_free(sl_fixed *D);
extern sl_status sl_fixed_refactor(sl_fixed *D, const sl_csc *A, sl_stats *stats);
extern sl_status sl_fixed_solve(const sl_fixed *D, double *X, size_t ldx,
                                               const double *B, size_t ldb, const double *G,
                                               size_t ldg, sl_int nrhs, sl_work *W);
typedef struct sl_fixed_arrays {
    sl_int n_free, n_fixed;
    const sl_int *free_rows;
    const sl_int *fixed_rows;
    const sl_symbolic *symbolic;
    const sl_factor *factor;
    sl_csc matrix;
    const void *reserved[2];
} sl_fixed_arrays;
extern sl_fixed_arrays sl_fixed_view(const sl_fixed *D);
typedef enum sl_part {
    SL_PART_P = 1,
    SL_PART_L = 2,
    SL_PART_D = 4,
    SL_PART_SQRT_D = 8,
    SL_PART_LT = 16,
    SL_PART_PT = 32
} sl_part;
extern sl_status sl_factor_solve_part(const sl_factor *F, const sl_plan *plan,
                                                     unsigned parts, double *X, size_t ldx,
                                                     const double *B, size_t ldb, sl_int nrhs,
                                                     sl_work *W);
extern sl_status sl_factor_multiply_part(const sl_factor *F, unsigned parts,
                                                        double *X, size_t ldx, const double *B,
                                                        size_t ldb, sl_int nrhs, sl_work *W);
extern sl_status sl_plan_columns(const sl_plan *P, sl_part part, sl_int *columns,
                                                sl_int capacity, sl_int *count);
typedef struct sl_pseudo_inverse {
    sl_int columns;
    sl_int *component;
    double *Q;
    double *K;
    double log_det;
} sl_pseudo_inverse;
extern sl_status sl_factor_pseudo_inverse(const sl_factor *F, sl_pseudo_inverse *P,
                                                         sl_work *W);
extern sl_status sl_factor_refine(const sl_factor *F, const sl_csc *A, double *X,
                                                 size_t ldx, const double *B, size_t ldb,
                                                 sl_int nrhs, sl_int steps, sl_work *W,
                                                 sl_stats *stats);
extern sl_status sl_plan_solve_regularized(const sl_plan *P, const sl_factor *F,
                                                          double *X, size_t ldx, const double *B,
                                                          size_t ldb, sl_int nrhs, sl_int steps,
                                                          sl_work *W, sl_stats *stats);
extern sl_status sl_factor_rcond(const sl_factor *F, const sl_csc *A, double *rcond,
                                                sl_work *W);
extern sl_status sl_factor_defects(const sl_factor *F, double *Y, size_t ldy,
                                                  const double *B, size_t ldb, sl_int nrhs,
                                                  sl_work *W);
extern sl_status sl_factor_certify(sl_factor *F, const sl_csc *A,
                                                  sl_certainty certainty, sl_work *W,
                                                  sl_stats *stats);
extern sl_status sl_plan_solve_bounded(const sl_plan *P, const sl_factor *F,
                                                      double *X, size_t ldx, double *bounds,
                                                      const double *B, size_t ldb, sl_int nrhs,
                                                      double *scales, sl_work *W, sl_stats *stats);
extern sl_status sl_inverse_diagonal(const sl_factor *F, double *out,
                                                    const sl_int *rows, sl_int count, sl_work *W,
                                                    sl_stats *stats);
extern sl_status sl_inverse_pairs(const sl_factor *F, double *out,
                                                 const sl_int *rows, const sl_int *columns,
                                                 sl_int count, sl_work *W, sl_stats *stats);
extern sl_status sl_inverse_block(const sl_factor *F, double *Z, size_t ldz,
                                                 const sl_int *rows, sl_int n_rows,
                                                 const sl_int *columns, sl_int n_columns,
                                                 sl_work *W, sl_stats *stats);
extern sl_status sl_selected_create(sl_selected **out, const sl_factor *F,
                                                   const sl_int *set, sl_int count,
                                                   const sl_options *opt, sl_stats *stats);
extern sl_status sl_selected_refactor(sl_selected *Z, const sl_factor *F,
                                                     sl_work *W);
extern void sl_selected_free(sl_selected *Z);
extern sl_status sl_selected_entries(const sl_selected *Z, double *out,
                                                    const sl_int *rows, const sl_int *columns,
                                                    sl_int count, sl_stats *stats);
typedef struct sl_selected_arrays {
    sl_selected_info info;
    const sl_symbolic *symbolic;
    sl_int count;
    const sl_int *supers;
    const sl_off *begin;
    const double *Z;
    const void *reserved[2];
} sl_selected_arrays;
extern sl_selected_arrays sl_selected_view(const sl_selected *Z);
extern sl_status sl_region_create(sl_region **out, const sl_factor *F,
                                                 const sl_int *set, sl_int count,
                                                 const sl_selected *Z, const sl_options *opt,
                                                 sl_stats *stats);
extern sl_status sl_region_refactor(sl_region *R, const sl_factor *F,
                                                   const sl_selected *Z, sl_work *W);
extern void sl_region_free(sl_region *R);
typedef struct sl_region_arrays {
    sl_region_info info;
    const sl_symbolic *symbolic;
    sl_int n_roots;
    const sl_int *roots;
    sl_int n_boundary;
    const sl_int *boundary;
    const void *reserved[2];
} sl_region_arrays;
extern sl_region_arrays sl_region_view(const sl_region *R);
typedef struct sl_request {
    const sl_plan *plan;
    double *X;
    size_t ldx;
    const double *B;
    size_t ldb;
    sl_int nrhs;
    const sl_factor *factor;
} sl_request;
extern sl_status sl_batch_solve(const sl_factor *F, const sl_request *requests,
                                               sl_int count, const sl_options *opt,
                                               sl_work *const *works, sl_int *failed);
extern sl_status sl_matrix_sum(sl_matrix **out, const double *coefficients,
                                              const sl_csc *terms, sl_int count,
                                              const sl_options *opt, sl_stats *stats);
extern sl_status sl_symbolic_scatter(const sl_symbolic *S, double *values,
                                                    const sl_csc *K, sl_stats *stats);
extern sl_status sl_factor_create_sums(sl_factor **out, sl_int count,
                                                      const sl_symbolic *S,
                                                      const double *coefficients,
                                                      const double *const *values, sl_int terms,
                                                      const sl_options *opt, sl_int *failed,
                                                      sl_stats *stats);
extern sl_status sl_factor_refactor_sums(sl_factor *const *factors, sl_int count,
                                                        const double *coefficients,
                                                        const double *const *values, sl_int terms,
                                                        const sl_options *opt, sl_int *failed,
                                                        sl_stats *stats);
typedef enum sl_saved_content {
    SL_SAVED_ALL = 0,
    SL_SAVED_FACTOR,
    SL_SAVED_ANALYSIS
} sl_saved_content;
typedef struct sl_saved_set {
    sl_symbolic *symbolic;
    sl_factor *factor;
    sl_selected *selected;
    sl_region **regions;
    sl_int n_regions;
    sl_allocator allocator;
    sl_saved_content wanted;
    void *reserved[6];
} sl_saved_set;
typedef enum sl_load_flag {
    SL_LOAD_CHECKED = 0,
    SL_LOAD_TRUSTED = 1,
    SL_LOAD_VERIFIED = 2,
    SL_LOAD_MAPPED = 4
} sl_load_flag;
extern sl_status sl_save(const char *path, void *memory, size_t *bytes,
                                        const sl_saved_set *set, const sl_options *opt);
extern sl_status sl_load(sl_saved_set *set, const char *path, const void *memory,
                                        size_t bytes, unsigned flags, const sl_options *opt);
extern void sl_saved_set_free(sl_saved_set *set);
extern sl_status sl_factor_rank_update(sl_factor *F, const sl_csc *V,
                                                      const double *sigma, sl_work *W,
                                                      sl_stats *stats);
extern sl_status sl_factor_change_entries(sl_factor *F, const sl_csc *A,
                                                         const sl_int *rows, const sl_int *columns,
                                                         const double *deltas, sl_int count,
                                                         sl_work *W, sl_stats *stats);
extern sl_status sl_constraints_create(sl_constraints **out, const sl_factor *F,
                                                      const sl_options *opt);
extern void sl_constraints_free(sl_constraints *P);
extern sl_status sl_constraints_add(sl_constraints *P, const sl_int *rows,
                                                   const double *values, sl_int count,
                                                   sl_stats *stats);
extern sl_status sl_constraints_release(sl_constraints *P, const sl_int *indices,
                                                       sl_int count, sl_stats *stats);
extern sl_status sl_constraints_refactor(sl_constraints *P, sl_stats *stats);
extern sl_status sl_constraints_solve(const sl_constraints *P, const sl_plan *plan,
                                                     double *X, size_t ldx, const double *B,
                                                     size_t ldb, const double *G, size_t ldg,
                                                     sl_int nrhs, sl_work *W);
extern sl_status sl_factor_submatrix(sl_symbolic **S, sl_factor **G,
                                                    const sl_factor *F, const sl_csc *A,
                                                    const sl_int *rows, sl_int count,
                                                    const sl_options *opt, sl_stats *stats);
extern sl_status sl_symbolic_edit(sl_symbolic **out, const sl_symbolic *S,
                                                 const sl_csc *A, const sl_csc *B,
                                                 const sl_int *new_of, const sl_options *opt,
                                                 sl_stats *stats);
extern sl_status sl_factor_edit(sl_factor **out, const sl_factor *F,
                                               const sl_symbolic *S, const sl_csc *B,
                                               const sl_int *new_of, const sl_options *opt,
                                               sl_stats *stats);
typedef struct sl_hermitian {
    sl_int n;
    const sl_int *p;
    const sl_int *i;
    const double *x;
    const double *im;
} sl_hermitian;
extern sl_status sl_matrix_from_hermitian(sl_matrix **out, const sl_hermitian *H,
                                                         const sl_options *opt, sl_stats *stats);
extern sl_status sl_complex_plan_create(sl_plan **out, const sl_symbolic *S,
                                                       const sl_int *bset, sl_int nb,
                                                       const sl_int *xset, sl_int nx,
                                                       const sl_options *opt, sl_stats *stats);
extern sl_status sl_complex_logdet(const sl_factor *F, double *log_abs_det,
                                                  double *sign);
extern sl_status sl_matrix_read(sl_matrix **out, const char *path,
                                               const sl_options *opt, sl_stats *stats);
extern sl_status sl_matrix_parse(sl_matrix **out, const char *text, size_t length,
                                                const sl_options *opt, sl_stats *stats);
typedef struct sl_csc64 {
    int64_t n_rows, n_cols;
    const int64_t *p;
    const int64_t *i;
    const double *x;
} sl_csc64;
extern sl_status sl_matrix_from_csc64(sl_matrix **out, const sl_csc64 *A,
                                                     const sl_options *opt, sl_stats *stats);
extern sl_status sl_symbolic_create_pivoted(sl_symbolic **out, const sl_csc *A,
                                                           const sl_options *opt, sl_stats *stats);
