/* symbolic_types.h: the analysis object: what the pattern parts fill in and the number parts read */
#ifndef SLI_SYMBOLIC_TYPES_H
#define SLI_SYMBOLIC_TYPES_H

#include "../public/analyse.h"
#include "alloc.h"
#include "kernels.h"

struct sl_symbolic {
    sl_allocator allocator;
    sl_stats stats;         /* the symbolic group */
    sl_int n;               /* rows of A */
    sl_int n_supers;        /* supernodes, in postorder */
    sl_int nnz_input;       /* entries of A as handed in, read or not */
    uint64_t fingerprint;   /* of A's arrays p and i: a refactorization must bring the same */
    sl_int tallest, widest; /* largest height (columns + rows below) and width of a supernode */
    sl_int *perm, *iperm;   /* n */
    sl_int *parent;         /* n: elimination tree, -1 at a root */
    sl_int *counts;         /* n: entries of each column of L without relaxation */
    sl_int *super_of;       /* n */
    sl_int *super_first;    /* n_supers + 1 */
    sl_int *super_parent;   /* n_supers, -1 at a root */
    sl_off *rows_begin;     /* n_supers + 1 */
    sl_int *rows;           /* rows_begin[n_supers]: rows below each supernode, ascending */
    sl_off *panel_begin;    /* n_supers + 1, in doubles */
    sli_step *steps;        /* n_supers: the reach of everything */
    sl_int *descendant;     /* n_supers: the first supernode of each one's subtree */
    sl_int *places;    /* rows_begin[n_supers]: the local row of every row in the parent's front */
    sl_off *map_begin; /* n_supers + 1 */
    sl_int *map_from;  /* map_begin[n_supers]: positions in A, grouped by supernode */
    sl_off *map_to;    /* the same: positions in L; several may share one (duplicates) */
    sl_int n_parts;    /* nodes of the tree of separators; 0: the order has none */
    sl_int *part_of;   /* n: the node of each column */
    sl_int *part_parent, *part_level; /* n_parts */
};

/* One triangle of an ordered matrix, entry by entry, duplicates kept. Elimination-order numbers. */
typedef struct sli_half {
    sl_int *begin; /* n + 1 */
    sl_int *to;    /* begin[n] */
    sl_int *from;  /* begin[n]: the entry of A; NULL where nobody asks */
} sli_half;

#endif
