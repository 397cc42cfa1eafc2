/* symbolic_types.h: the analysis object, filled by this layer and read by all later ones */
#ifndef SLI_ANALYSIS_SYMBOLIC_TYPES_H
#define SLI_ANALYSIS_SYMBOLIC_TYPES_H

#include "../../public/analyze.h"
#include "../base/alloc.h"
#include "../base/hash.h"
#include "../kernels/pairs.h"
#include "../kernels/step.h"
#include "../ordering/graph.h"

/* Memory of another owner that holds the arrays of an object, released with it. */
typedef struct sli_backing {
    void (*release)(const void *bytes, size_t size); /* NULL: there is none */
    const void *bytes;
    size_t size;
} sli_backing;

struct sl_symbolic {
    sl_allocator allocator;
    sli_atomic borrowers; /* factors, plans, selected inverses, regions */
    struct {
        sl_symbolic_info symbolic;
    } stats;
    sl_int n;        /* rows of A */
    sl_int n_supers; /* supernodes, in postorder */
    /* entries stored in A, read or not; -1: a restriction, which has no map of entries */
    sl_int nnz_input;
    sli_hash pattern;         /* of A's arrays p and i; a refactorization must match it */
    sli_hash identity;        /* of the pattern, the triangle read, the order and the supernodes */
    sl_int tallest, widest;   /* largest height (columns and rows below) and width of a supernode */
    sl_int *perm, *iperm;     /* n */
    sl_int *parent;           /* n: elimination tree, -1 at a root */
    int is_pivoted;           /* created from values: pivots of any sign are right */
    sl_int n_pairs;           /* 2x2 pivots */
    unsigned char *pairs;     /* n: SLI_PAIR_*; n_pairs = 0: none */
    sl_int *counts;           /* n: entries of each column of L, without relaxation */
    sl_int *super_of;         /* n */
    sl_int *super_first;      /* n_supers + 1 */
    sl_int *super_parent;     /* n_supers, -1 at a root */
    sl_off *rows_begin;       /* n_supers + 1 */
    sl_int *rows;             /* rows_begin[n_supers]: rows below each supernode, ascending */
    sl_off *panel_begin;      /* n_supers + 1, in doubles */
    sli_step *steps;          /* n_supers: the steps of a sweep over all supernodes */
    sl_int *first_descendant; /* n_supers: first supernode of each subtree */
    /* Relative indices, rows_begin[n_supers]: for each row below a supernode, its local row in the
     * parent's front. */
    sl_int *relative;
    /* The scatter map of A into L. Entries are grouped by supernode; duplicates share a position in
     * L.
     *
     *     scatter_begin  n_supers + 1
     *     scatter_from   scatter_begin[n_supers]: positions in A
     *     scatter_to     scatter_begin[n_supers]: positions in L
     */
    sl_off *scatter_begin;
    sl_int *scatter_from;
    sl_off *scatter_to;
    sl_int *plain;                    /* n_supers, as in sli_reach; NULL: not known. Not saved */
    sl_int *input;                    /* with plain: p and i of A, which are not hashed then */
    sl_int n_nodes;                   /* nodes of the separator tree; 0: the ordering has none */
    sl_int *node_of;                  /* n: the node of each column */
    sl_int *node_parent, *node_level; /* n_nodes */
    sli_backing backing;              /* the mapped file that holds the arrays */
    /* made from a file that has more than this library reads, or a restriction: it is not saved */
    int is_partial;
    /* after edits of the pattern: nnz_l and nnz_a of the last analysis with a new order; 0: none */
    sl_off ordered_l, ordered_a;
};

#endif
