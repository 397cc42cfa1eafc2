/* inverse.list.h: the templates of the inverse, for one instruction set */

#define SLW_NRHS 8
#define SLW_LAST
#include SLI_WORDS
#include SLI_LANES
#include "products.inl.h"
#include "inverse_front.inl.h"
#include "inverse_set.inl.h"
#include "../kernels/words/lanes_undef.inl.h"
