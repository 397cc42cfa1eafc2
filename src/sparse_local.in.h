/* sparse_local.in.h: the manifest: the ordered list of all parts, by layer; compiles as it is */
/* ---- what a user reads ---- */
#ifndef SPARSE_LOCAL_H
#define SPARSE_LOCAL_H
#include "public/intro.h"
#include "public/config.h"
#ifdef __cplusplus
extern "C" {
#endif
#include "public/types.h"
#include "public/options.h"
#include "public/stats.h"
#include "public/csc.h"
#include "public/analyze.h"
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
#if (defined(SPARSE_LOCAL_IMPLEMENTATION) || defined(SL_STATIC)) && \
    !defined(SPARSE_LOCAL_IMPLEMENTED)
#define SPARSE_LOCAL_IMPLEMENTED
/* base: the compiler, status, memory, sorting, threads */
#include "impl/base/base.h"
#include "impl/base/status.h"
#include "impl/base/options.h"
#include "impl/base/alloc.h"
#include "impl/base/hash.h"
#include "impl/base/sort.h"
#include "impl/base/parallel.h"
/* kernels: numerical kernels on raw arrays, once for each instruction set */
#include "impl/kernels/panel.h"
#include "impl/kernels/step.h"
#include "impl/kernels/pivot_rule.h"
#include "impl/kernels/front.h"
#include "impl/kernels/pairs.h"
#include "impl/kernels/inverse_front.h"
#include "impl/kernels/table.h"
#include "impl/kernels/simd.h"
#include "impl/kernels/simd_scalar.h"
#include "impl/kernels/simd_avx2.h"
#include "impl/kernels/simd_avx512.h"
#include "impl/kernels/simd_neon.h"
#include "impl/kernels/dispatch.h"
/* matrix: sparse matrices of the caller and of the library */
#include "impl/matrix/csc.h"
#include "impl/matrix/csc_build.h"
#include "impl/matrix/csc_triangle.h"
#include "impl/matrix/csc_products.h"
#include "impl/matrix/permute.h"
#include "impl/matrix/sum.h"
#include "impl/matrix/output_file.h"
#include "impl/matrix/matrix_market.h"
/* ordering: fill-reducing orderings of a graph */
#include "impl/ordering/graph.h"
#include "impl/ordering/coarsen.h"
#include "impl/ordering/labels.h"
#include "impl/ordering/subgraph.h"
#include "impl/ordering/heap.h"
#include "impl/ordering/bisect.h"
#include "impl/ordering/separator.h"
#include "impl/ordering/mindeg.h"
#include "impl/ordering/dissect.h"
#include "impl/ordering/levelset.h"
#include "impl/ordering/geometric.h"
#include "impl/ordering/septree.h"
#include "impl/ordering/metis.h"
#include "impl/ordering/metis_refined.h"
#include "impl/ordering/nd.h"
#include "impl/ordering/compress.h"
#include "impl/ordering/quotient.h"
#include "impl/ordering/order.h"
/* analysis: elimination tree, supernodes, structure of L; never sees a value */
#include "impl/analysis/symbolic_types.h"
#include "impl/analysis/etree.h"
#include "impl/analysis/counts.h"
#include "impl/analysis/supernodes.h"
#include "impl/analysis/structure.h"
#include "impl/analysis/schedule.h"
#include "impl/analysis/symbolic.h"
#include "impl/analysis/reach.h"
/* factor: the numbers of L and D */
#include "impl/factor/factor_types.h"
#include "impl/factor/pivot_search.h"
#include "impl/factor/pivoted.h"
#include "impl/factor/scatter.h"
#include "impl/factor/uplooking.h"
#include "impl/factor/null_vectors.h"
#include "impl/factor/multifrontal.h"
#include "impl/factor/nullspace.h"
#include "impl/factor/factor_setup.h"
#include "impl/factor/factor.h"
#include "impl/factor/leftlooking.h"
#include "impl/factor/factor_query.h"
#include "impl/factor/combination.h"
/* solve: full and local solves */
#include "impl/solve/region_types.h"
#include "impl/solve/work.h"
#include "impl/solve/query.h"
#include "impl/solve/singular.h"
#include "impl/solve/backward.h"
#include "impl/solve/sweep.h"
#include "impl/solve/compile.h"
#include "impl/solve/plan.h"
#include "impl/solve/local.h"
#include "impl/solve/refine.h"
#include "impl/solve/refine_local.h"
#include "impl/solve/rcond.h"
#include "impl/solve/defects.h"
/* inverse: entries of the inverse, regions */
#include "impl/inverse/traversal.h"
#include "impl/inverse/traversal_run.h"
#include "impl/inverse/row_sets.h"
#include "impl/inverse/unit_vectors.h"
#include "impl/inverse/bilinear.h"
#include "impl/inverse/entries.h"
#include "impl/inverse/block.h"
#include "impl/inverse/reserve.h"
#include "impl/inverse/selected.h"
#include "impl/inverse/selected_query.h"
#include "impl/inverse/region_choose.h"
#include "impl/inverse/region.h"
/* batch: many solves, factors and diagonals by one call */
#include "impl/batch/batch_solve.h"
#include "impl/batch/batch_factor.h"
#include "impl/batch/batch_diagonal.h"
/* last: undefine every internal macro */
#include "impl/base/undef.h"
#endif
