/* mex_call.h: a call of sparse_local_mex: objects named by numbers, arrays in and out */
#ifndef SL_OCTAVE_MEX_CALL_H
#define SL_OCTAVE_MEX_CALL_H

#include "mex.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SL_STATIC
#define SL_WITH_ACCURACY
#define SL_WITH_CHANGE
#define SL_WITH_CONSTRAINTS
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
    sl_constraints *pins;
    sl_int b_rows; /* rows of right-hand sides: n, or the b-set of a plan */
    sl_int x_rows; /* rows of solutions */
    struct object *next;
} object;

static object *objects = NULL;
static double last_id = 0;

static void release(object *o) {
    sl_constraints_free(o->pins);
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
    if (o == NULL) {
        mexErrMsgIdAndTxt("sparse_local:stale", "%s: the object is closed, or of another session",
                          sl_status_string(SL_ERR_STALE));
    }
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
    *count = SL_ALL;
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

#endif
