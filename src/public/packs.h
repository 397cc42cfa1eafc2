/* packs.h: the packs that a user asks for: what each adds to the core, and what it brings along */
#ifndef SL_PUBLIC_PACKS_H
#define SL_PUBLIC_PACKS_H

/* The core analyzes, factors, refactors and solves: in full, on plans and in one shot, with one to
 * many right-hand sides, for regular and for singular matrices. Define the macro of a pack before
 * every include of this header to add to it, or SL_WITH_ALL for all packs:
 *
 *  SL_WITH_INVERSE    entries of the inverse, selected inversion, regions
 *  SL_WITH_CHANGE     changes of a factor in place, by vectors, entries and columns
 *  SL_WITH_CONSTRAINTS rows held at given values, on a factor that stays
 *  SL_WITH_EDIT       factors of submatrices, edits of the pattern
 *  SL_WITH_FIXED      rows fixed at given values: harmonic maps, interpolation
 *  SL_WITH_SAVE       factors, selected inverses and regions in files and in mapped memory
 *  SL_WITH_BATCH      many factors or solves by one call, weighted sums of matrices
 *  SL_WITH_COMPLEX    complex Hermitian systems, SL_STORAGE_COMPLEX
 *  SL_WITH_FLOAT      L in single precision: SL_STORAGE_FLOAT
 *  SL_WITH_ACCURACY   refinement, bounds of errors, condition numbers, defects, half solves
 *  SL_WITH_FILES      Matrix Market files, matrices with 64-bit indices
 *  SL_WITH_PIVOTS     2x2 pivots for indefinite matrices
 *
 * A call of a pack that is off does not compile, and the error names the macro. An option that
 * needs such a pack gives SL_ERR_UNSUPPORTED. SL_WITH_CONSTRAINTS and SL_WITH_SAVE bring
 * SL_WITH_INVERSE along, SL_WITH_EDIT brings SL_WITH_CHANGE. Objects and structs are the same with
 * any packs. */
#if defined(SL_WITH_ALL)
#undef SL_WITH_CHANGE
#undef SL_WITH_CONSTRAINTS
#undef SL_WITH_EDIT
#undef SL_WITH_FIXED
#undef SL_WITH_SAVE
#undef SL_WITH_BATCH
#undef SL_WITH_COMPLEX
#undef SL_WITH_FLOAT
#undef SL_WITH_ACCURACY
#undef SL_WITH_FILES
#undef SL_WITH_PIVOTS
#define SL_WITH_CHANGE
#define SL_WITH_CONSTRAINTS
#define SL_WITH_EDIT
#define SL_WITH_FIXED
#define SL_WITH_SAVE
#define SL_WITH_BATCH
#define SL_WITH_COMPLEX
#define SL_WITH_FLOAT
#define SL_WITH_ACCURACY
#define SL_WITH_FILES
#define SL_WITH_PIVOTS
#endif
#if (defined(SL_WITH_CONSTRAINTS) || defined(SL_WITH_SAVE)) && !defined(SL_WITH_INVERSE)
#define SL_WITH_INVERSE
#endif
#if defined(SL_WITH_EDIT) && !defined(SL_WITH_CHANGE)
#define SL_WITH_CHANGE
#endif

#endif
