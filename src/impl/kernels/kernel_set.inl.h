/* kernel_set.inl.h: all kernels of one instruction set except its real sweeps, and their table */

#include "complex_small.inl.h"
#include "complex_rows.inl.h"
#include "inverse_front.inl.h"
#include "row.inl.h"
#include "change.inl.h"
#include "interleave.inl.h"

#if !defined(SLV_NAME_4)
#define SLV_NAME_4(f) SLV_NAME(f##4)
#endif

#if !defined(SLV_NAME_2)
#define SLV_NAME_2(f) SLV_NAME(f##2)
#endif

static const sli_kernels SLV_NAME(kernels) = {
    SLV_ISA,
    {{{SLV_NAME(forward), SLV_NAME(forward2), SLV_NAME_4(forward), SLV_NAME(forward8),
       SLV_NAME(forward16), SLV_NAME(forward32)},
      {SLV_NAME(backward), SLV_NAME(backward2), SLV_NAME_4(backward), SLV_NAME(backward8),
       SLV_NAME(backward16), SLV_NAME(backward32)}},
     {{SLV_NAME(single_forward), SLV_NAME(single_forward2), SLV_NAME_4(single_forward),
       SLV_NAME(single_forward8), SLV_NAME(single_forward16), SLV_NAME(single_forward32)},
      {SLV_NAME(single_backward), SLV_NAME(single_backward2), SLV_NAME_4(single_backward),
       SLV_NAME(single_backward8), SLV_NAME(single_backward16), SLV_NAME(single_backward32)}},
     {{SLV_NAME(complex_forward), SLV_NAME_2(complex_forward), SLV_NAME_4(complex_forward),
       SLV_NAME(complex_forward8), SLV_NAME(complex_forward16), SLV_NAME(complex_forward32)},
      {SLV_NAME(complex_backward), SLV_NAME_2(complex_backward), SLV_NAME_4(complex_backward),
       SLV_NAME(complex_backward8), SLV_NAME(complex_backward16), SLV_NAME(complex_backward32)}}},
    SLV_NAME(row),
    {{SLV_NAME(pivots), SLV_NAME(rows), SLV_NAME(update), SLV_NAME(assemble)},
     {SLV_NAME(single_pivots), SLV_NAME(single_rows), SLV_NAME(single_update),
      SLV_NAME(single_assemble)},
     {SLV_NAME(complex_pivots), SLV_NAME(complex_rows), SLV_NAME(complex_update),
      SLV_NAME(complex_assemble)}},
    SLV_NAME(products8),
    SLV_NAME(interleave),
    SLV_NAME(separate),
    SLV_NAME(gather),
    SLV_NAME(inverse_phase),
    SLV_NAME(takahashi),
    {SLV_NAME(change2), SLV_NAME(change4), SLV_NAME(change8)},
    SLV_NAME(change_ranks),
    SLV_NAME(change_panel)};
