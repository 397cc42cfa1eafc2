/* kernels.list.h: the templates of the core */

#include "sweeps/copy_rows.inl.h"
#include "fronts/front.inl.h"
#include "sweeps/sweeps.inl.h"
#include "sweeps/multi_rhs.inl.h"
#include "sweeps/two_rhs.inl.h"
#include "sweeps/multi_rhs_tiles.inl.h"
#include "kernel_set.inl.h"
#include "words/lanes_undef.inl.h"
