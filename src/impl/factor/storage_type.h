/* storage_type.h: a table for each sl_storage: how L is kept and how fronts are computed */
#ifndef SLI_FACTOR_STORAGE_TYPE_H
#define SLI_FACTOR_STORAGE_TYPE_H

#include "../analysis/reach.h"
#include "factor_types.h"

/* How fronts are computed (fronts.inl.h). */
typedef struct sli_fronts {
    /* Factors supernodes first .. last, whose descendants are done, on one worker. Stops at the
     * first failure. */
    sl_status (*factor)(sl_factor *F, const sli_source *from, sl_int first, sl_int last,
                        sl_int worker, sli_failure *failure);
    /* The front of supernode s that workers share, with the reciprocals of a group of pivots. Its
     * steps: clears row tiles t0 .. t1-1; adds the entries of A; assembles row tiles t0 .. t1-1;
     * hands its magnitudes over to the parent and checks the pivots. */
    sli_front (*shared)(const sl_factor *F, sl_int s, sl_int group);
    void (*clear)(const sli_front *f, sl_int t0, sl_int t1);
    sl_status (*load)(sl_factor *F, const sli_source *from, const sli_front *f,
                      sli_failure *failure);
    void (*assemble)(const sl_factor *F, const sli_front *f, sl_int worker, sl_int t0, sl_int t1);
    sl_status (*finish)(const sl_factor *F, const sli_front *f, sli_failure *failure);
} sli_fronts;

/* The core has the table of L in double; packs have those of the other storages. Common code reads
 * the sizes; what else differs goes through the functions. */
struct sli_storage_type {
    sl_storage storage;
    size_t value_bytes; /* of an entry of L */
    int half;           /* 1: panels and fronts hold the first columns of pairs only; else 0 */
    const sli_fronts *fronts;
    /* The kernels of an instruction set; sweeps NULL: it has none for this storage. */
    sli_own_kernels (*kernels)(const sli_kernels *kernels);
    /* Stores the panel of a front that is done; NULL: the panel is where it belongs. */
    sl_status (*store)(const sl_factor *F, const sli_front *f, sli_failure *failure);
    /* The entry of L at a position of the panels, and sets it to 0; NULL: L is in double. */
    double (*entry)(const void *values, sl_off at);
    void (*entry_clear)(void *values, sl_off at);
    /* Refuses a factor with an analysis or rules that do not suit it. NULL: all do. */
    sl_status (*suits)(const sl_factor *F);
    /* Refuses a matrix that does not have the form that is needed. NULL: all have it. */
    void (*accepts)(const sl_symbolic *S, const sli_source *from, sli_failure *failure);
    /* Has the matrix on these rows, with the analysis S, that form, too? NULL: always. */
    int (*keeps)(const sl_int *rows, sl_int count, const sl_symbolic *S);
    /* the storage in double that takes its place where no kernels serve it; of that itself NULL */
    const sli_storage_type *in_double;
};

/* The table of a storage; NULL: it is not compiled in. What it needs; NULL: it is no value of
 * sl_storage. Both are defined where all packs are known. */
static const sli_storage_type *sli_storage_type_of(sl_storage storage);
static const char *sli_storage_needs(sl_storage storage);

/* Is L kept in float? */
SLI_INLINE int sli_is_float(const sl_factor *F) {
    return F->type->value_bytes == sizeof(float);
}

/* Is the panel of supernode s copied when its front is done, as its numbers are rounded, or as it
 * has no padding? */
SLI_INLINE int sli_panel_is_copied(const sl_factor *F, sl_int s) {
    return F->S->steps[s].width == 1 || F->type->store != NULL;
}

/* The panel of supernode s in double, while a worker factors it. */
SLI_INLINE double *sli_front_panel(const sl_factor *F, sl_int s, sl_int worker) {
    return sli_panel_is_copied(F, s)
               ? F->work.panels + F->work.panel_room * worker
               : (double *)F->values + (F->S->steps[s].panel >> F->type->half);
}

/* The sweeps of F's factorization over a reach: x := L^-1 x, and x := L'^-1 D^-1 x. */
SLI_INLINE void sli_forward_sweep(const sl_factor *F, int kind, const sli_reach *R, double *x,
                                  double *scratch) {
    F->own.sweeps->forward[kind](R, F->values, x, scratch);
}
SLI_INLINE void sli_backward_sweep(const sl_factor *F, int kind, const sli_reach *R,
                                   const double *D, double *x, double *scratch) {
    F->own.sweeps->backward[kind](R, F->values, D, x, scratch);
}

/* The entry of L at a position of the panels. */
SLI_INLINE double sli_entry(const sl_factor *F, sl_off at) {
    return F->type->entry == NULL ? ((const double *)F->values)[at] : F->type->entry(F->values, at);
}

SLI_INLINE void sli_entry_clear(sl_factor *F, sl_off at) {
    if (F->type->entry_clear != NULL) {
        F->type->entry_clear(F->values, at);
    } else {
        ((double *)F->values)[at] = 0.0;
    }
}

#endif
