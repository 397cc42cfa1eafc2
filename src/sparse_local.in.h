/* sparse_local.in.h: the manifest: the ordered list of all parts, by layer; compiles as it is */
/* ---- what a user reads ---- */
#ifndef SPARSE_LOCAL_H
#define SPARSE_LOCAL_H
#include "public/intro.h"
#if defined(SL_CONFIG_HEADER)
#include SL_CONFIG_HEADER
#endif
#include "public/packs.h"
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
#if defined(SL_WITH_FIXED)
#include "public/fixed.h"
#endif
#if defined(SL_WITH_ACCURACY)
#include "public/parts.h"
#include "public/pseudo.h"
#include "public/accuracy.h"
#include "public/bounds.h"
#endif
#if defined(SL_WITH_INVERSE)
#include "public/inverse.h"
#include "public/selected.h"
#include "public/region.h"
#endif
#if defined(SL_WITH_BATCH)
#include "public/batch.h"
#include "public/several.h"
#endif
#if defined(SL_WITH_SAVE)
#include "public/save.h"
#endif
#if defined(SL_WITH_CHANGE)
#include "public/change.h"
#endif
#if defined(SL_WITH_CONSTRAINTS)
#include "public/constraints.h"
#endif
#if defined(SL_WITH_EDIT)
#include "public/submatrix.h"
#include "public/edit.h"
#endif
#if defined(SL_WITH_COMPLEX)
#include "public/complex.h"
#endif
#if defined(SL_WITH_FILES)
#include "public/files.h"
#endif
#if defined(SL_WITH_PIVOTS)
#include "public/pivots.h"
#endif
#ifdef __cplusplus
}
#endif
#endif /* SPARSE_LOCAL_H */

/* ---- bodies, in one source file ---- */
#if (defined(SPARSE_LOCAL_IMPLEMENTATION) || defined(SL_STATIC)) && \
    !defined(SPARSE_LOCAL_IMPLEMENTED)
#define SPARSE_LOCAL_IMPLEMENTED
#if defined(SL_API_DEFAULT) && defined(__GNUC__) && defined(__ELF__)
#undef SL_API
#define SL_API __attribute__((visibility("hidden"))) extern
#endif
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
#include "impl/kernels/table.h"
#include "impl/kernels/words/simd.h"
#include "impl/kernels/words/simd_avx2.h"
#include "impl/kernels/kernels.h"
#include "impl/kernels/dispatch.h"
/* matrix: sparse matrices of the caller and of the library */
#include "impl/matrix/csc.h"
#include "impl/matrix/csc_build.h"
#include "impl/matrix/csc_triangle.h"
#include "impl/matrix/dense.h"
#include "impl/matrix/csc_products.h"
#include "impl/matrix/submatrix.h"
/* ordering: fill-reducing orderings of a graph */
#include "impl/ordering/graph.h"
#include "impl/ordering/job.h"
#include "impl/ordering/reduce.h"
#include "impl/ordering/contract.h"
#include "impl/ordering/coarsen.h"
#include "impl/ordering/labels.h"
#include "impl/ordering/subgraph.h"
#include "impl/ordering/bisect.h"
#include "impl/ordering/separator.h"
#include "impl/ordering/mindeg.h"
#include "impl/ordering/dissection.h"
#include "impl/ordering/dissect.h"
#include "impl/ordering/levelset.h"
#include "impl/ordering/thin.h"
#include "impl/ordering/nd.h"
#include "impl/ordering/compress.h"
#include "impl/ordering/metis.h"
#include "impl/ordering/levels.h"
#include "impl/ordering/quotient.h"
#include "impl/ordering/quotient_order.h"
#include "impl/ordering/choice.h"
#include "impl/ordering/cuts.h"
#include "impl/ordering/order.h"
/* analysis: elimination tree, supernodes, structure of L; never sees a value */
#include "impl/analysis/symbolic_types.h"
#include "impl/analysis/etree.h"
#include "impl/analysis/supernodes.h"
#include "impl/analysis/supernode_order.h"
#include "impl/analysis/pattern.h"
#include "impl/analysis/structure.h"
#include "impl/analysis/schedule_types.h"
#include "impl/analysis/update_stacks.h"
#include "impl/analysis/schedule.h"
#include "impl/analysis/symbolic_build.h"
#include "impl/analysis/symbolic.h"
#include "impl/analysis/same_pattern.h"
#include "impl/analysis/reach.h"
/* factor: the numbers of L and D */
#include "impl/factor/null_space.h"
#include "impl/factor/factor_types.h"
#include "impl/factor/storage_type.h"
#include "impl/factor/panel_load.h"
#include "impl/factor/pivot_check.h"
#include "impl/factor/components.h"
#include "impl/factor/pivot_suspects.h"
#include "impl/factor/multifrontal.h"
#include "impl/factor/uplooking.h"
#include "impl/factor/front_tasks.h"
#include "impl/factor/growth.h"
#include "impl/factor/pivot_judge.h"
#include "impl/factor/factor_layout.h"
#include "impl/factor/factor_setup.h"
#include "impl/factor/advice.h"
#include "impl/factor/symmetry.h"
#include "impl/factor/factor.h"
#include "impl/factor/factor_query.h"
#include "impl/factor/costs.h"
/* solve: full and local solves */
#include "impl/solve/work.h"
#include "impl/solve/query.h"
#include "impl/solve/packed.h"
#include "impl/solve/backward.h"
#include "impl/solve/sweep_tasks.h"
#include "impl/solve/sweep.h"
#include "impl/solve/compile.h"
#include "impl/solve/plan.h"
#include "impl/solve/local.h"
/* singular: null spaces of semidefinite matrices */
#if !defined(SL_NO_SINGULAR)
#include "impl/singular/product.h"
#include "impl/singular/dense.h"
#include "impl/singular/basis.h"
#include "impl/singular/vectors.h"
#include "impl/singular/center_several.h"
#include "impl/singular/nullspace.h"
#include "impl/singular/null_sums.h"
#include "impl/singular/consistency.h"
#include "impl/singular/centering.h"
#include "impl/singular/singular.h"
#endif
/* accuracy: refinement, condition, defects, half solves, bounds of errors */
#if defined(SL_WITH_ACCURACY)
#include "impl/accuracy/parts.h"
#include "impl/accuracy/pseudo.h"
#include "impl/accuracy/refine.h"
#include "impl/accuracy/refine_local.h"
#include "impl/accuracy/rcond.h"
#include "impl/accuracy/defects.h"
#include "impl/accuracy/guarantee.h"
#include "impl/accuracy/certify.h"
#include "impl/accuracy/bounds.h"
#endif
/* pivots: the order of the pivots by the values of a matrix */
#if defined(SL_WITH_PIVOTS)
#include "impl/pivots/pivot_search.h"
#include "impl/pivots/pivoted.h"
#endif
/* float: L in single precision */
#if defined(SL_WITH_FLOAT)
#include "impl/float/float_kernels.h"
#include "impl/float/float_storage.h"
#endif
/* inverse: entries of the inverse, regions */
#if defined(SL_WITH_INVERSE)
#include "impl/inverse/inverse_front.h"
#include "impl/inverse/inverse_kernels.h"
#include "impl/inverse/traversal.h"
#include "impl/inverse/traversal_run.h"
#include "impl/inverse/row_sets.h"
#include "impl/inverse/unit_vectors.h"
#include "impl/inverse/pair_sums.h"
#include "impl/inverse/loss.h"
#include "impl/inverse/entries.h"
#include "impl/inverse/column.h"
#include "impl/inverse/entries_calls.h"
#include "impl/inverse/block.h"
#include "impl/inverse/selected.h"
#include "impl/inverse/selected_query.h"
#include "impl/inverse/region_types.h"
#include "impl/inverse/region_choose.h"
#include "impl/inverse/region_ending.h"
#include "impl/inverse/region.h"
#endif
/* change: a factor that follows changes of its matrix */
#if defined(SL_WITH_CHANGE)
#include "impl/change/change_kernels.h"
#include "impl/change/kept.h"
#include "impl/change/reached.h"
#include "impl/change/update_loss.h"
#include "impl/change/update_pivots.h"
#include "impl/change/update.h"
#include "impl/change/path.h"
#include "impl/change/rank_vectors.h"
#include "impl/change/rank.h"
#include "impl/change/edges.h"
#include "impl/change/choose.h"
#endif
/* constraints: rows held at values, on a factor that stays */
#if defined(SL_WITH_CONSTRAINTS)
#include "impl/constraints/constraints_types.h"
#include "impl/constraints/constraints_nulls.h"
#include "impl/constraints/constraints_capacitance.h"
#include "impl/constraints/constraints_rows.h"
#include "impl/constraints/constraints_balance.h"
#include "impl/constraints/constraints.h"
#include "impl/constraints/constraints_solve.h"
#endif
/* edit: factors of submatrices, and of matrices whose pattern is edited */
#if defined(SL_WITH_EDIT)
#include "impl/edit/subset.h"
#include "impl/edit/submatrix_kept.h"
#include "impl/edit/submatrix_analysis.h"
#include "impl/edit/submatrix_symbolic.h"
#include "impl/edit/submatrix.h"
#include "impl/edit/edit_match.h"
#include "impl/edit/edit_place.h"
#include "impl/edit/edit_separate.h"
#include "impl/edit/edit_order.h"
#include "impl/edit/edit_graph.h"
#include "impl/edit/edit_join.h"
#include "impl/edit/edit.h"
#include "impl/edit/edit_factor.h"
#endif
/* fixed: rows fixed at given values */
#if defined(SL_WITH_FIXED)
#include "impl/fixed/fixed_rows.h"
#include "impl/fixed/fixed.h"
#include "impl/fixed/fixed_solve.h"
#endif
/* io: files that are replaced only when they are complete */
#if defined(SL_WITH_SAVE)
#include "impl/io/output_file.h"
#endif
/* files: Matrix Market files, 64-bit indices */
#if defined(SL_WITH_FILES)
#include "impl/files/csc64.h"
#include "impl/files/text_reader.h"
#include "impl/files/matrix_market.h"
#endif
/* save: factors in files */
#if defined(SL_WITH_SAVE)
#include "impl/save/file_map.h"
#include "impl/save/format.h"
#include "impl/save/decode.h"
#include "impl/save/check.h"
#include "impl/save/write.h"
#include "impl/save/load.h"
#include "impl/save/load_inverse.h"
#include "impl/save/load_calls.h"
#endif
/* batch: many solves and factorizations by one call, sums of matrices */
#if defined(SL_WITH_BATCH)
#include "impl/batch/matrix_sum.h"
#include "impl/batch/scatter.h"
#include "impl/batch/batch_solve.h"
#include "impl/batch/batch_factor.h"
#endif
/* complex: complex Hermitian systems over real factors */
#if defined(SL_WITH_COMPLEX)
#include "impl/complex/complex_kernels.h"
#include "impl/complex/complex_storage.h"
#include "impl/complex/hermitian.h"
#include "impl/complex/complex_rows.h"
#endif
/* packs: the tables through which the core calls packs */
#include "impl/packs/storage_types.h"
#include "impl/packs/singular_table.h"
/* last: amalgamate writes an #undef of each internal macro here */
#endif
