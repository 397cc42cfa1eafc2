/* sparse_local_mex.c: what the classes of this folder call, in Octave and in MATLAB: objects of
 * sparse_local.h, named by numbers
 *
 *     [out, ...] = sparse_local_mex(command, in, ...)
 *
 * Rows and columns begin with 1 here, also in messages. Objects live until `free`, and the file
 * stays loaded as long as there is one. mexErrMsgIdAndTxt does not return: it is called where no
 * object of the library is held; arrays of mxMalloc are released by the interpreter. */
#include "mex.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SL_STATIC
#define SL_WITH_ACCURACY
#define SL_WITH_CHANGE
#define SL_WITH_FILES
#define SL_WITH_FLOAT
#define SL_WITH_PIVOTS
#include "sparse_local.h"

/* ---- objects ---- */

typedef enum object_kind { FACTOR, PLAN, PINS } object_kind;

/* What a number names: a factor with its analysis and workspace, a plan, or a set of pins. */
typedef struct object {
    object_kind kind;
    double id;
    sl_symbolic *symbolic;
    sl_factor *factor;
    sl_work *work;
    sl_plan *plan;
    sl_pins *pins;
    sl_int b_rows; /* rows of right-hand sides: n, or the b-set of a plan */
    sl_int x_rows; /* rows of solutions */
    struct object *next;
} object;

static object *objects = NULL;
static double last_id = 0;

static void release(object *o) {
    sl_pins_free(o->pins);
    sl_plan_free(o->plan);
    sl_work_free(o->work);
    sl_factor_free(o->factor);
    sl_symbolic_free(o->symbolic);
    free(o);
}

static void release_all(void) {
    while (objects != NULL) {
        object *next = objects->next;
        release(objects);
        objects = next;
    }
}

/* A new object, not in the list yet. Nothing else may be held: it may not return. */
static object *new_object(object_kind k) {
    object *o = (object *)calloc(1, sizeof *o);
    if (o == NULL) mexErrMsgIdAndTxt("sparse_local:memory", "out of memory");
    o->kind = k;
    return o;
}

/* ---- a call: its arrays ---- */

typedef struct call {
    mxArray **out;
    const mxArray **in;
} call;

static void refuse(const char *text) {
    mexErrMsgIdAndTxt("sparse_local:argument", "invalid argument: %s", text);
}

/* The number of an object; 0 if it is none. */
static double id_of(const mxArray *id) {
    return mxIsDouble(id) && mxGetNumberOfElements(id) == 1 ? mxGetScalar(id) : 0;
}

static object *find(const mxArray *id, object_kind k) {
    object *o = objects;
    const double number = id_of(id);
    while (o != NULL && (o->id != number || o->kind != k))
        o = o->next;
    if (o == NULL) refuse("the object is closed, or comes from another session");
    return o;
}

/* Keeps an object, or releases it after an error, and returns its number. */
static sl_status keep(call *c, object *o, sl_status status) {
    if (status != SL_OK) {
        release(o);
        return status;
    }
    if (objects == NULL) mexLock();
    o->next = objects;
    o->id = ++last_id;
    objects = o;
    mxGetPr(c->out[0])[0] = o->id;
    return SL_OK;
}

static double *new_output(call *c, int k, size_t rows, size_t columns) {
    c->out[k] = mxCreateDoubleMatrix((mwSize)rows, (mwSize)columns, mxREAL);
    return mxGetPr(c->out[k]);
}

static sl_int count_of(size_t count) {
    if (count > 0x7fffffff) refuse("an array has 2^31 or more elements");
    return (sl_int)count;
}

static void check_dense(const mxArray *a, const char *name) {
    if (!mxIsDouble(a) || mxIsComplex(a) || mxIsSparse(a)) {
        mexErrMsgIdAndTxt("sparse_local:argument",
                          "invalid argument: %s is no array of real doubles", name);
    }
}

/* The numbers of an array that has the given number of rows, and its columns. */
static const double *dense(const mxArray *a, const char *name, sl_int rows, sl_int *columns) {
    check_dense(a, name);
    if (mxGetM(a) != (size_t)rows) {
        mexErrMsgIdAndTxt("sparse_local:argument", "invalid argument: %s has %.0f rows, not %d",
                          name, (double)mxGetM(a), (int)rows);
    }
    *columns = count_of(mxGetN(a));
    return mxGetPr(a);
}

/* Rows as the library counts them; of the text ':' all, which is NULL. */
static sl_int *rows_of(const mxArray *a, sl_int *count) {
    sl_int *rows;
    const double *x;
    size_t k;
    *count = 0;
    if (mxIsChar(a)) return NULL;
    check_dense(a, "a set of rows");
    *count = count_of(mxGetNumberOfElements(a));
    rows = (sl_int *)mxMalloc(sizeof *rows * ((size_t)*count + 1));
    x = mxGetPr(a);
    for (k = 0; k < (size_t)*count; k++) {
        if (!(x[k] >= 1 && x[k] <= 0x7fffffff && x[k] == floor(x[k]))) {
            mexErrMsgIdAndTxt("sparse_local:argument",
                              "invalid argument: rows are whole numbers from 1 on, not %g", x[k]);
        }
        rows[k] = (sl_int)x[k] - 1;
    }
    return rows;
}

/* Two sets of the same length, and the length. */
static void pairs_of(const mxArray *i, const mxArray *j, sl_int **rows, sl_int **columns,
                     sl_int *count) {
    sl_int n;
    *rows = rows_of(i, count);
    *columns = rows_of(j, &n);
    if (*rows == NULL || *columns == NULL || n != *count) {
        refuse("rows and columns of entries are two arrays of one length");
    }
}

static void check_matrix(const mxArray *a) {
    if (!mxIsSparse(a) || !mxIsDouble(a) || mxIsComplex(a)) {
        refuse("a matrix is sparse, double and real; complex Hermitian systems need the C calls");
    }
    if (sizeof(mwIndex) != sizeof(int64_t)) refuse("indices of this interpreter have not 64 bits");
}

/* A sparse matrix: the indices are copied into *indices, the numbers used in place. */
static sl_status matrix_of(const mxArray *a, sl_matrix **indices, sl_csc *A) {
    sl_csc64 wide;
    sl_status status;
    *indices = NULL;
    check_matrix(a);
    wide.n_rows = (int64_t)mxGetM(a);
    wide.n_cols = (int64_t)mxGetN(a);
    wide.p = (const int64_t *)(const void *)mxGetJc(a);
    wide.i = (const int64_t *)(const void *)mxGetIr(a);
    wide.x = NULL;
    status = sl_matrix_from_csc64(indices, &wide, NULL, NULL);
    if (status == SL_OK) {
        *A = sl_matrix_view(*indices);
        A->x = mxGetPr(a);
    }
    return status;
}

/* ---- options ---- */

/* The position of a word in a list with | between words. */
static int word_in(const char *name, const mxArray *value, const char *words) {
    char word[32] = "";
    const char *at = words;
    int k;
    if (mxIsChar(value)) (void)mxGetString(value, word, sizeof word);
    for (k = 0;; k++) {
        const size_t length = strcspn(at, "|");
        if (length == strlen(word) && strncmp(at, word, length) == 0) return k;
        if (at[length] == 0) break;
        at += length + 1;
    }
    mexErrMsgIdAndTxt("sparse_local:argument", "invalid argument: %s is one of %s", name, words);
    return 0;
}

static double number_in(const char *name, const mxArray *value) {
    if ((!mxIsDouble(value) && !mxIsLogical(value)) || mxGetNumberOfElements(value) != 1) {
        mexErrMsgIdAndTxt("sparse_local:argument", "invalid argument: %s is one number", name);
    }
    return mxGetScalar(value);
}

static sl_int whole_in(const char *name, const mxArray *value) {
    const double x = number_in(name, value);
    if (!(x >= 0 && x <= 0x7fffffff && x == floor(x))) {
        mexErrMsgIdAndTxt("sparse_local:argument", "invalid argument: %s is a whole number", name);
    }
    return (sl_int)x;
}

static sl_int *signs_in(const mxArray *value, sl_int n) {
    sl_int k, columns, *signs = (sl_int *)mxMalloc(sizeof *signs * ((size_t)n + 1));
    const double *x = dense(value, "signs", n, &columns);
    for (k = 0; k < n; k++) {
        signs[k] = (x[k] > 0) - (x[k] < 0);
    }
    return signs;
}

/* Sets one option; those of arrays have n rows. Returns 0 if there is no such option. */
static int set_option(sl_options *o, int *pivoted, const char *name, const mxArray *value,
                      sl_int n) {
    static const sl_ordering orderings[] = {SL_ORDERING_ND, SL_ORDERING_MINDEG,
                                            SL_ORDERING_NATURAL};
    sl_int count = 0;
    if (strcmp(name, "pivoted") == 0) {
        *pivoted = number_in(name, value) != 0;
    } else if (strcmp(name, "definite") == 0) {
        o->definite = number_in(name, value) != 0;
    } else if (strcmp(name, "threads") == 0) {
        o->threads.count = whole_in(name, value);
    } else if (strcmp(name, "triangle") == 0) {
        o->triangle = (sl_triangle)word_in(name, value, "both|lower|upper");
    } else if (strcmp(name, "ordering") == 0) {
        o->ordering = orderings[word_in(name, value, "nd|mindeg|natural")];
    } else if (strcmp(name, "perm") == 0) {
        o->ordering = SL_ORDERING_GIVEN;
        o->perm = rows_of(value, &count);
        if (count != n) refuse("perm has one element for each row");
    } else if (strcmp(name, "purpose") == 0) {
        o->purpose = (sl_purpose)word_in(name, value, "many solves|one factor");
    } else if (strcmp(name, "block_size") == 0) {
        o->block_size = whole_in(name, value);
    } else if (strcmp(name, "storage") == 0) {
        o->storage = (sl_storage)word_in(name, value, "double|float|float fronts");
    } else if (strcmp(name, "null_pivots") == 0) {
        o->null_pivots = (sl_null_pivots)word_in(name, value, "refuse|skip");
    } else if (strcmp(name, "null_tolerance") == 0) {
        o->null_tolerance = number_in(name, value);
    } else if (strcmp(name, "consistency_tolerance") == 0) {
        o->consistency_tolerance = number_in(name, value);
    } else if (strcmp(name, "mass") == 0) {
        o->mass = dense(value, name, n, &count);
    } else if (strcmp(name, "null_vector") == 0) {
        o->null_vector = dense(value, name, n, &count);
        o->null_vector_count = (size_t)count;
    } else if (strcmp(name, "regularization") == 0) {
        o->regularization = number_in(name, value);
    } else if (strcmp(name, "signs") == 0) {
        o->signs = signs_in(value, n);
    } else if (strcmp(name, "growth_limit") == 0) {
        o->growth_limit = number_in(name, value);
    } else if (strcmp(name, "error_limit") == 0) {
        o->error_limit = number_in(name, value);
    } else {
        return 0;
    }
    return 1;
}

/* The options of a cell array {name, value, name, value, ...}. */
static void options_of(const mxArray *list, sl_options *o, int *pivoted, sl_int n) {
    size_t k;
    const size_t count = mxIsCell(list) ? mxGetNumberOfElements(list) : 1;
    char name[32];
    sl_options_init(o, sizeof *o);
    *pivoted = 0;
    if (count % 2 != 0) refuse("options are pairs of a name and a value");
    for (k = 0; k < count; k += 2) {
        const mxArray *word = mxGetCell(list, (mwIndex)k), *value = mxGetCell(list, (mwIndex)k + 1);
        if (word == NULL || value == NULL || !mxIsChar(word) ||
            mxGetString(word, name, sizeof name) != 0 || !set_option(o, pivoted, name, value, n)) {
            mexErrMsgIdAndTxt("sparse_local:argument",
                              "invalid argument: option %.0f has no name that is "
                              "known; see help sparse_local",
                              (double)(k / 2 + 1));
        }
    }
}

/* ---- factors ---- */

/* id = create(A, {options}) */
static sl_status create(call *c) {
    sl_options o;
    sl_matrix *indices;
    sl_csc A;
    object *f;
    int pivoted;
    sl_status status;
    (void)new_output(c, 0, 1, 1);
    check_matrix(c->in[0]);
    options_of(c->in[1], &o, &pivoted, count_of(mxGetN(c->in[0])));
    f = new_object(FACTOR);
    status = matrix_of(c->in[0], &indices, &A);
    if (status == SL_OK) {
        status = pivoted ? sl_symbolic_create_pivoted(&f->symbolic, &A, &o, NULL)
                         : sl_symbolic_create(&f->symbolic, &A, &o, NULL);
    }
    if (status == SL_OK) status = sl_factor_create(&f->factor, f->symbolic, &A, &o, NULL);
    if (status == SL_OK) status = sl_work_create(&f->work, &o);
    if (status == SL_OK) f->b_rows = f->x_rows = A.n_cols;
    sl_matrix_free(indices);
    return keep(c, f, status);
}

/* refactor(factor, A) */
static sl_status refactor(call *c) {
    object *f = find(c->in[0], FACTOR);
    sl_matrix *indices;
    sl_csc A;
    sl_status status = matrix_of(c->in[1], &indices, &A);
    if (status == SL_OK) status = sl_factor_refactor(f->factor, &A, NULL);
    sl_matrix_free(indices);
    return status;
}

/* X = solve(factor, B) */
static sl_status solve(call *c) {
    object *f = find(c->in[0], FACTOR);
    sl_int n = f->b_rows, nrhs;
    const double *B = dense(c->in[1], "b", n, &nrhs);
    double *X = new_output(c, 0, (size_t)n, (size_t)nrhs);
    return sl_factor_solve(f->factor, X, (size_t)n, B, (size_t)n, nrhs, f->work);
}

/* [X, backward_error] = refine(factor, A, B, steps) */
static sl_status refine(call *c) {
    object *f = find(c->in[0], FACTOR);
    sl_int n = f->b_rows, nrhs, steps = whole_in("steps", c->in[3]);
    const double *B = dense(c->in[2], "b", n, &nrhs);
    double *X = new_output(c, 0, (size_t)n, (size_t)nrhs), *error = new_output(c, 1, 1, 1);
    sl_matrix *indices;
    sl_csc A;
    sl_stats stats;
    sl_status status = matrix_of(c->in[1], &indices, &A);
    if (status == SL_OK) {
        status = sl_factor_solve(f->factor, X, (size_t)n, B, (size_t)n, nrhs, f->work);
    }
    if (status == SL_OK) {
        status = sl_factor_refine(f->factor, &A, X, (size_t)n, B, (size_t)n, nrhs, steps, f->work,
                                  &stats);
    }
    if (status == SL_OK) *error = stats.refine.backward_error;
    sl_matrix_free(indices);
    return status;
}

/* r = rcond(factor, A) */
static sl_status rcond(call *c) {
    object *f = find(c->in[0], FACTOR);
    double *r = new_output(c, 0, 1, 1);
    sl_matrix *indices;
    sl_csc A;
    sl_status status = matrix_of(c->in[1], &indices, &A);
    if (status == SL_OK) status = sl_factor_rcond(f->factor, &A, r, f->work);
    sl_matrix_free(indices);
    return status;
}

/* [logarithm, sign] = logdet(factor) */
static sl_status logdet(call *c) {
    object *f = find(c->in[0], FACTOR);
    double *logarithm = new_output(c, 0, 1, 1), *sign = new_output(c, 1, 1, 1);
    return sl_factor_logdet(f->factor, logarithm, sign);
}

/* [L, d, e, perm] = parts(factor): d and e are the diagonal of D and what is below it */
static sl_status parts(call *c) {
    object *f = find(c->in[0], FACTOR);
    const sl_factor_arrays F = sl_factor_view(f->factor);
    const sl_symbolic_arrays S = sl_symbolic_view(f->symbolic);
    double *d = new_output(c, 1, (size_t)S.n, 1), *e = new_output(c, 2, (size_t)S.n, 1);
    double *perm = new_output(c, 3, (size_t)S.n, 1);
    sl_matrix *M = NULL;
    sl_csc L;
    sl_int k;
    sl_status status = sl_factor_lower(&M, f->factor, NULL);
    if (status != SL_OK) return status;
    L = sl_matrix_view(M);
    c->out[0] =
        mxCreateSparse((mwSize)S.n, (mwSize)S.n, (mwSize)(L.p[S.n] + (L.p[S.n] == 0)), mxREAL);
    for (k = 0; k <= S.n; k++) {
        mxGetJc(c->out[0])[k] = (mwIndex)L.p[k];
    }
    for (k = 0; k < L.p[S.n]; k++) {
        mxGetIr(c->out[0])[k] = (mwIndex)L.i[k];
        mxGetPr(c->out[0])[k] = L.x[k];
    }
    for (k = 0; k < S.n; k++) {
        d[k] = F.D[k] < 1e308 ? F.D[k] : 0; /* a null pivot that was skipped */
        e[k] = F.E != NULL ? F.E[k] : 0;
        perm[k] = S.perm[k] + 1.0;
    }
    sl_matrix_free(M);
    return SL_OK;
}

/* s = info(factor) */
static sl_status info(call *c) {
    static const char *const names[] = {"n",         "nnz_l",     "flops",       "positive",
                                        "negative",  "null",      "regularized", "growth",
                                        "pivot_min", "pivot_max", "threads",     "bytes"};
    enum { COUNT = sizeof names / sizeof names[0] };
    object *f = find(c->in[0], FACTOR);
    sl_stats s;
    double values[COUNT];
    int k = 0;
    memset(&s, 0, sizeof s);
    sl_symbolic_stats(f->symbolic, &s);
    sl_factor_stats(f->factor, &s);
    values[k++] = s.symbolic.n;
    values[k++] = (double)s.symbolic.nnz_l;
    values[k++] = s.symbolic.flops;
    values[k++] = s.factor.positive;
    values[k++] = s.factor.negative;
    values[k++] = s.factor.null;
    values[k++] = s.factor.regularized;
    values[k++] = s.factor.growth;
    values[k++] = s.factor.pivot_min;
    values[k++] = s.factor.pivot_max;
    values[k++] = (double)s.threads;
    values[k++] = (double)(s.symbolic.bytes + s.factor.bytes);
    c->out[0] = mxCreateStructMatrix(1, 1, COUNT, (const char **)names);
    for (k = 0; k < COUNT; k++) {
        mxSetFieldByNumber(c->out[0], 0, k, mxCreateDoubleScalar(values[k]));
    }
    return SL_OK;
}

/* ---- local solves ---- */

/* X = local(factor, bset, B, xset) */
static sl_status local(call *c) {
    object *f = find(c->in[0], FACTOR);
    sl_int nb, nx, nrhs, *bset = rows_of(c->in[1], &nb), *xset = rows_of(c->in[3], &nx);
    const sl_int b_rows = bset == NULL ? f->b_rows : nb, x_rows = xset == NULL ? f->x_rows : nx;
    const double *B = dense(c->in[2], "b", b_rows, &nrhs);
    double *X = new_output(c, 0, (size_t)x_rows, (size_t)nrhs);
    return sl_local_solve(f->factor, bset, nb, xset, nx, X, (size_t)x_rows, B, (size_t)b_rows, nrhs,
                          f->work, NULL);
}

/* id = plan(factor, bset, xset) */
static sl_status plan(call *c) {
    object *f = find(c->in[0], FACTOR), *p;
    sl_int nb, nx, *bset = rows_of(c->in[1], &nb), *xset = rows_of(c->in[2], &nx);
    (void)new_output(c, 0, 1, 1);
    p = new_object(PLAN);
    p->b_rows = bset == NULL ? f->b_rows : nb;
    p->x_rows = xset == NULL ? f->x_rows : nx;
    return keep(c, p, sl_plan_create(&p->plan, f->symbolic, bset, nb, xset, nx, NULL, NULL));
}

/* X = plan_solve(factor, plan, B) */
static sl_status plan_solve(call *c) {
    object *f = find(c->in[0], FACTOR), *p = find(c->in[1], PLAN);
    sl_int nrhs;
    const double *B = dense(c->in[2], "b", p->b_rows, &nrhs);
    double *X = new_output(c, 0, (size_t)p->x_rows, (size_t)nrhs);
    return sl_plan_solve(p->plan, f->factor, X, (size_t)p->x_rows, B, (size_t)p->b_rows, nrhs,
                         f->work);
}

/* ---- entries of the inverse ---- */

/* d = diagonal(factor, rows) */
static sl_status diagonal(call *c) {
    object *f = find(c->in[0], FACTOR);
    sl_int count, *rows = rows_of(c->in[1], &count);
    double *d = new_output(c, 0, (size_t)(rows == NULL ? f->b_rows : count), 1);
    return sl_inverse_diagonal(f->factor, d, rows, count, f->work, NULL);
}

/* z = entries(factor, rows, columns) */
static sl_status entries(call *c) {
    object *f = find(c->in[0], FACTOR);
    sl_int count, *rows, *columns;
    double *z;
    pairs_of(c->in[1], c->in[2], &rows, &columns, &count);
    z = new_output(c, 0, (size_t)count, 1);
    return sl_inverse_pairs(f->factor, z, rows, columns, count, f->work, NULL);
}

/* Z = block(factor, rows, columns) */
static sl_status block(call *c) {
    object *f = find(c->in[0], FACTOR);
    sl_int m, n, *rows = rows_of(c->in[1], &m), *columns = rows_of(c->in[2], &n);
    double *Z;
    if (rows == NULL || columns == NULL) refuse("a block has a set of rows and one of columns");
    Z = new_output(c, 0, (size_t)m, (size_t)n);
    return sl_inverse_block(f->factor, Z, (size_t)m, rows, m, columns, n, f->work, NULL);
}

/* ---- changes ---- */

/* update(factor, V, sigma) */
static sl_status update(call *c) {
    object *f = find(c->in[0], FACTOR);
    sl_int columns;
    const double *sigma = dense(c->in[2], "sigma", count_of(mxGetN(c->in[1])), &columns);
    sl_matrix *indices;
    sl_csc V;
    sl_status status = matrix_of(c->in[1], &indices, &V);
    if (status == SL_OK) status = sl_factor_update(f->factor, &V, sigma, f->work, NULL);
    sl_matrix_free(indices);
    return status;
}

/* change(factor, A, rows, columns, deltas) */
static sl_status change(call *c) {
    object *f = find(c->in[0], FACTOR);
    sl_int count, one, *rows, *columns;
    const double *deltas;
    sl_matrix *indices;
    sl_csc A;
    sl_status status;
    pairs_of(c->in[2], c->in[3], &rows, &columns, &count);
    deltas = dense(c->in[4], "deltas", count, &one);
    status = matrix_of(c->in[1], &indices, &A);
    if (status == SL_OK) {
        status = sl_factor_change(f->factor, &A, rows, columns, deltas, count, f->work, NULL);
    }
    sl_matrix_free(indices);
    return status;
}

/* ---- pins ---- */

/* id = pins(factor) */
static sl_status pins(call *c) {
    object *f = find(c->in[0], FACTOR), *p;
    (void)new_output(c, 0, 1, 1);
    p = new_object(PINS);
    p->b_rows = p->x_rows = f->b_rows;
    return keep(c, p, sl_pins_create(&p->pins, f->factor, NULL));
}

/* pins_add(pins, rows) */
static sl_status pins_add(call *c) {
    object *p = find(c->in[0], PINS);
    sl_int count, *rows = rows_of(c->in[1], &count);
    if (rows == NULL) refuse("pins have a set of rows");
    return sl_pins_add(p->pins, rows, count, NULL);
}

/* pins_release(pins, numbers) */
static sl_status pins_release(call *c) {
    object *p = find(c->in[0], PINS);
    sl_int count, *numbers = rows_of(c->in[1], &count);
    return sl_pins_release(p->pins, numbers, count, NULL);
}

/* pins_refactor(pins): the present numbers of the factor */
static sl_status pins_refactor(call *c) {
    return sl_pins_refactor(find(c->in[0], PINS)->pins, NULL);
}

/* X = pins_solve(factor, pins, B, G, count, plan): of count pins; plan 0: all rows */
static sl_status pins_solve(call *c) {
    object *f = find(c->in[0], FACTOR), *p = find(c->in[1], PINS);
    object *q = id_of(c->in[5]) == 0 ? NULL : find(c->in[5], PLAN);
    object *sides = q == NULL ? p : q;
    sl_int nrhs, sets, count = whole_in("count", c->in[4]);
    const double *B = dense(c->in[2], "b", sides->b_rows, &nrhs);
    const double *G = dense(c->in[3], "the values of pins", count, &sets);
    double *X = new_output(c, 0, (size_t)sides->x_rows, (size_t)nrhs);
    if (sets != nrhs) refuse("b and the values of pins have as many columns");
    return sl_pins_solve(p->pins, q == NULL ? NULL : q->plan, X, (size_t)sides->x_rows, B,
                         (size_t)sides->b_rows, G, (size_t)count, nrhs, f->work);
}

/* free(id): of any object; nothing if there is none */
static sl_status free_object(call *c) {
    object **at = &objects, *o;
    const double id = id_of(c->in[0]);
    while (*at != NULL && (*at)->id != id)
        at = &(*at)->next;
    o = *at;
    if (o == NULL) return SL_OK;
    *at = o->next;
    release(o);
    if (objects == NULL) mexUnlock();
    return SL_OK;
}

/* count = live(): how many objects there are, for tests */
static sl_status live(call *c) {
    const object *o;
    double *count = new_output(c, 0, 1, 1);
    for (o = objects; o != NULL; o = o->next) {
        *count += 1;
    }
    return SL_OK;
}

/* ---- the function ---- */

static const struct {
    const char *name;
    sl_status (*run)(call *c);
    int inputs, outputs;
} commands[] = {
    {"create", create, 2, 1},
    {"refactor", refactor, 2, 0},
    {"solve", solve, 2, 1},
    {"refine", refine, 4, 2},
    {"rcond", rcond, 2, 1},
    {"logdet", logdet, 1, 2},
    {"parts", parts, 1, 4},
    {"info", info, 1, 1},
    {"local", local, 4, 1},
    {"plan", plan, 3, 1},
    {"plan_solve", plan_solve, 3, 1},
    {"diagonal", diagonal, 2, 1},
    {"entries", entries, 3, 1},
    {"block", block, 3, 1},
    {"update", update, 3, 0},
    {"change", change, 5, 0},
    {"pins", pins, 1, 1},
    {"pins_add", pins_add, 2, 0},
    {"pins_release", pins_release, 2, 0},
    {"pins_refactor", pins_refactor, 1, 0},
    {"pins_solve", pins_solve, 6, 1},
    {"free", free_object, 1, 0},
    {"live", live, 0, 1},
};

/* Adds 1 to the number behind a word of the place at the end of a message, as in (row 4). */
static void count_from_one(char *text, size_t size, const char *word) {
    char *place = strrchr(text, '('), *at = place == NULL ? NULL : strstr(place, word), *end;
    char rest[200];
    long number;
    if (at == NULL) return;
    at += strlen(word);
    number = strtol(at, &end, 10);
    (void)snprintf(rest, sizeof rest, "%ld%s", number + 1, end);
    (void)snprintf(at, size - (size_t)(at - text), "%s", rest);
}

static void fail(sl_status status) {
    static const char *const names[] = {"ok",         "argument",      "memory",    "pattern",
                                        "pivot",      "not_finite",    "too_large", "unsupported",
                                        "io",         "ordering",      "state",     "inconsistent",
                                        "inaccurate", "other_pattern", "stale",     "read_only"};
    char id[64], text[500];
    (void)sl_error_text(text, sizeof text - 4, status, NULL);
    count_from_one(text, sizeof text, "row ");
    count_from_one(text, sizeof text, "column ");
    (void)snprintf(id, sizeof id, "sparse_local:%s", names[status]);
    mexErrMsgIdAndTxt(id, "%s", text);
}

void mexFunction(int n_out, mxArray **out, int n_in, const mxArray **in) {
    char name[32] = "";
    size_t k;
    int i;
    mxArray *results[4] = {NULL, NULL, NULL, NULL};
    call c;
    sl_status status;
    mexAtExit(release_all);
    c.out = results;
    c.in = in + 1;
    if (n_in > 0 && mxIsChar(in[0])) (void)mxGetString(in[0], name, sizeof name);
    for (k = 0; k < sizeof commands / sizeof commands[0]; k++) {
        if (strcmp(commands[k].name, name) != 0) continue;
        if (n_in - 1 != commands[k].inputs || n_out > commands[k].outputs) {
            refuse("a command of sparse_local_mex has other arguments; see help sparse_local");
        }
        status = commands[k].run(&c);
        if (status != SL_OK) fail(status);
        for (i = 0; i < commands[k].outputs; i++) {
            if (i == 0 || i < n_out)
                out[i] = results[i];
            else
                mxDestroyArray(results[i]);
        }
        return;
    }
    refuse("sparse_local_mex has no such command; see help sparse_local");
}
