/* float.list.h: the templates of L in float */

#include "../kernels/sweeps/sweeps.inl.h"
#include "../kernels/sweeps/multi_rhs.inl.h"
#include "../kernels/sweeps/two_rhs.inl.h"
#include "../kernels/sweeps/multi_rhs_tiles.inl.h"
#include "float_set.inl.h"
#include "../kernels/words/lanes_undef.inl.h"
