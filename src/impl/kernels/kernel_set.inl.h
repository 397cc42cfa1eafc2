/* kernel_set.inl.h: all kernels of one instruction set except its sweeps, and their table */

/* The last template of an instruction set: it undefines the SIMD vocabulary. */

#include "product.inl.h"
#include "front.inl.h"
#include "inverse_front.inl.h"
#include "row.inl.h"
#include "change.inl.h"

#if !defined(SLV_NAME_4)
#define SLV_NAME_4(f) SLV_NAME(f##4)
#endif

static const sli_kernels SLV_NAME(kernels) = {
    SLV_ISA,
    {{{SLV_NAME(forward), SLV_NAME(forward2), SLV_NAME_4(forward), SLV_NAME(forward8)},
      {SLV_NAME(backward), SLV_NAME(backward2), SLV_NAME_4(backward), SLV_NAME(backward8)}},
     {{SLV_NAME(single_forward), SLV_NAME(single_forward2), SLV_NAME_4(single_forward),
       SLV_NAME(single_forward8)},
      {SLV_NAME(single_backward), SLV_NAME(single_backward2), SLV_NAME_4(single_backward),
       SLV_NAME(single_backward8)}}},
    SLV_NAME(row),
    SLV_NAME(pivots),
    SLV_NAME(rows),
    SLV_NAME(update),
    SLV_NAME(assemble),
    SLV_NAME(products8),
    SLV_NAME(gather),
    SLV_NAME(inverse_phase),
    SLV_NAME(takahashi),
    {SLV_NAME(change1), SLV_NAME(change2), SLV_NAME(change4), SLV_NAME(change8)},
    SLV_NAME(change_tiles)};

#undef SLV_NAME
#undef SLV_NAME_4
#undef SLV_ISA
#undef SLV_FUNCTION
#undef SLV_DECLARE
#undef SLV_ZERO
#undef SLV_LOAD
#undef SLV_STORE
#undef SLV_ADD
#undef SLV_READ_0
#undef SLV_READ_1
#undef SLV_WIDEN_ROWS
#undef SLV_AXPY
#undef SLV_DOT
#undef SLV_FNMA1
#undef SLV_STORE_ANY
#undef SLV_FNMA
#undef SLV_DUP_LOW
#undef SLV_DUP_HIGH
#undef SLV_DUP_AT
#undef SLV_PAIR
#undef SLV_TILES
#undef SLV_COLUMNS
#undef SLV_EACH_COLUMN
#undef SLV_LOAD_PINNED
#undef SLV_BROADCAST
#undef SLV_MULTIPLY
#undef SLV_DIVIDE
#undef SLV_BELOW
#undef SLV_BELOW_2
#undef SLV_EXPAND
#undef SLV_EXPAND_ADD
#undef SLV_LOAD_PART
#undef SLV_FIRST
#undef SLV_LANE
#undef SLV_GATHER
#undef SLV_TRANSPOSE
#undef SLV_TRANSPOSE_4
#undef SLV_BLOCKS_EVEN
#undef SLV_BLOCKS_ODD
#undef SLV_GATHER_2
#undef SLV_SUM_DECLARE
#undef SLV_SUM_ZERO
#undef SLV_SUM_DOT
#undef SLV_SUM_2
#undef SLV_SUM_4
#undef SLV_SUMS
#undef SLV_SUM_LOAD
#undef SLV_SUM_STORE
#undef SLW_ROWS
#undef SLW_DECLARE
#undef SLW_ZERO
#undef SLW_LOAD
#undef SLW_STORE
#undef SLW_FNMA
#undef SLW_ADD
#undef SLW_DIVIDE
