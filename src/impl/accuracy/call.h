/* call.h: what calls on accuracy share: layouts in the workspace, column-major arguments */
#ifndef SLI_ACCURACY_CALL_H
#define SLI_ACCURACY_CALL_H

#include "../solve/query.h"

/* Grows W to what the layout in b has counted, and rewinds b to W's memory for the second run. */
static sl_status sli_work_block(sl_work *W, sli_block *b) {
    const sl_status status = sli_work_grow(W, b->used);
    b->base = (unsigned char *)W->block;
    b->used = 0;
    return status;
}

/* The same for calls that take columns only. */
static sl_status sli_rhs_check_columns(const sli_rhs *r, sl_int nx, sl_int nb) {
    return r->nrhs > 0 && ((r->ldx | r->ldb) & SL_ROW_MAJOR) ? SL_ERR_ARGUMENT
                                                             : sli_rhs_check(r, nx, nb);
}

#endif
