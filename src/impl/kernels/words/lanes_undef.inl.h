/* lanes_undef.inl.h: undefines the SIMD vocabulary of one number of right-hand sides, and what
 * multi_rhs.inl.h or complex_groups.inl.h has defined */

#include "words_undef.inl.h"

#undef SLW_NAME
#undef SLW_PASS
#undef SLW_LAST
#undef SLW_TWO
#undef SLW_NRHS
#undef SLW_HALF
#undef SLW_GROUPS
#undef SLW_EACH
#undef SLW_EACH_AGAIN
#undef SLW_HIGH
#undef SLW_LOW
#undef SLW_ROWS
#undef SLW_DECLARE
#undef SLW_ZERO
#undef SLW_LOAD
#undef SLW_STORE
#undef SLW_FNMA
#undef SLW_ADD
#undef SLW_DIVIDE

#undef SLI_DECLARE
#undef SLI_LOAD
#undef SLI_STORE
#undef SLI_PARTS
#undef SLI_KERNEL
#undef SLI_TABLE
#undef SLI_SMALL
#undef SLI_PREPARE
#undef SLI_COPIED
#undef SLI_BLOCK
#undef SLI_READ_BLOCK
#undef SLI_APPLY
#undef SLI_APPLY_COLUMN
#undef SLI_GATHER
#undef SLI_GATHER2
#undef SLI_GATHER_COLUMN
#undef SLI_DOWN
#undef SLI_UP
#undef SLI_COLUMN
#undef SLI_ROW
#undef SLI_TRIANGLE
#undef SLI_TRIANGLE_UP
#undef SLI_PAIRS
#undef SLI_PAIRS_AGAIN
#undef SLI_PAIRS_DOWN
#undef SLI_NEGATE
#undef SLI_SUBTRACT
#undef SLI_BELOW
#undef SLI_BEFORE
#undef SLW_ENTRIES
#undef SLW_ENTRY
#undef SLW_SET_ENTRIES
