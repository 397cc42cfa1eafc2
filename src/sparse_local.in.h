/* sparse_local.in.h: the manifest: the only ordered list of parts, layer by layer; compiles as it is */
/* ---- what a user reads ---- */
#ifndef SPARSE_LOCAL_H
#define SPARSE_LOCAL_H
#include "public/intro.h"
#include "public/config.h"
#ifdef __cplusplus
extern "C" {
#endif
#include "public/types.h"
#include "public/csc.h"
#include "public/analyse.h"
#include "public/factor.h"
#include "public/solve.h"
#include "public/plan.h"
#include "public/accuracy.h"
#include "public/inverse.h"
#include "public/batch.h"
#include "public/several.h"
#include "public/selected.h"
#include "public/region.h"
#ifdef __cplusplus
}
#endif
#endif /* SPARSE_LOCAL_H */

/* ---- bodies, in one source file ---- */
#if (defined(SPARSE_LOCAL_IMPLEMENTATION) || defined(SL_STATIC)) &&                                \
    !defined(SPARSE_LOCAL_IMPLEMENTED)
#define SPARSE_LOCAL_IMPLEMENTED
/* L0 ground */
#include "impl/base.h"
#include "impl/status.h"
#include "impl/alloc.h"
#include "impl/sort.h"
#include "impl/cpu.h"
#include "impl/parallel.h"
/* L1 kernels: raw arrays only */
#include "impl/kernels.h"
#include "impl/isa_scalar.h"
#include "impl/isa_avx2.h"
#include "impl/isa_avx512.h"
#include "impl/isa_neon.h"
#include "impl/select.h"
/* L2 storage */
#include "impl/csc.h"
#include "impl/csc_products.h"
#include "impl/permute.h"
#include "impl/sum.h"
#include "impl/io.h"
/* L3 patterns: never see a value array */
#include "impl/symbolic_types.h"
#include "impl/graph.h"
#include "impl/order_coarsen.h"
#include "impl/order_tree.h"
#include "impl/order_piece.h"
#include "impl/order_heap.h"
#include "impl/order_bisect.h"
#include "impl/order_cut.h"
#include "impl/order_leaves.h"
#include "impl/order_dissect.h"
#include "impl/order_layers.h"
#include "impl/order_geometric.h"
#include "impl/order_nest.h"
#include "impl/order_metis.h"
#include "impl/order_quality.h"
#include "impl/order_own.h"
#include "impl/order_compress.h"
#include "impl/order.h"
#include "impl/etree.h"
#include "impl/counts.h"
#include "impl/supernodes.h"
#include "impl/structure.h"
#include "impl/mapping.h"
#include "impl/fronts.h"
#include "impl/schedule.h"
#include "impl/symbolic.h"
#include "impl/reach.h"
/* L4 numbers */
#include "impl/factor_parts.h"
#include "impl/spread.h"
#include "impl/uplooking.h"
#include "impl/multifrontal.h"
#include "impl/leftlooking.h"
#include "impl/nullspace.h"
#include "impl/factor.h"
#include "impl/factor_ask.h"
#include "impl/region_parts.h"
#include "impl/combination.h"
#include "impl/work.h"
#include "impl/sweep.h"
#include "impl/solve.h"
#include "impl/plan.h"
/* L5 on a factor */
#include "impl/descent.h"
#include "impl/descent_run.h"
#include "impl/groups.h"
#include "impl/inverse.h"
#include "impl/inverse_entries.h"
#include "impl/inverse_block.h"
#include "impl/refine.h"
#include "impl/refine_local.h"
#include "impl/condition.h"
#include "impl/batch.h"
#include "impl/batch_factor.h"
#include "impl/batch_inverse.h"
#include "impl/selected.h"
#include "impl/selected_ask.h"
#include "impl/region_choose.h"
#include "impl/region.h"
/* last: takes every internal macro away again */
#include "impl/leave.h"
#endif
