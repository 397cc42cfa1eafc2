/* complex.list.h: the templates of complex matrices */

#include "../kernels/fronts/front.inl.h"
#include "complex_small.inl.h"
#include "complex_rows.inl.h"
#include "complex_groups.inl.h"
#include "../kernels/sweeps/multi_rhs_tiles.inl.h"
#include "complex_set.inl.h"
#include "../kernels/words/lanes_undef.inl.h"
