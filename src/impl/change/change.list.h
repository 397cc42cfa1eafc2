/* change.list.h: the template of rank-k changes, for one instruction set */

#define SLW_LAST
#include SLI_WORDS
#include "change.inl.h"
#include "../kernels/words/lanes_undef.inl.h"
