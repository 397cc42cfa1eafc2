/* null_space.h: what a factor knows of its null space, and the calls of impl/singular */
#ifndef SLI_FACTOR_NULL_SPACE_H
#define SLI_FACTOR_NULL_SPACE_H

#include "../../public/options.h"
#include "../base/alloc.h"
#include "../base/status.h"

#define SLI_NULL_VECTORS_MAX 32
/* Residuals of dependent columns, which are scaled to a largest entry between 0.5 and 1. */
#define SLI_NULL_DEPENDENT 1e-11

/* Row i of A z. A cache line holds two: the product may visit rows at random. */
typedef struct sli_null_row {
    double z;
    double product; /* (A z)(i) */
    double size;    /* (|A| |z|)(i) */
    sl_int entries; /* entries of the row */
    sl_int up;      /* a later pivot's row in the component; i itself: the last one */
} sli_null_row;

struct sli_source;
struct sli_failure;
struct sli_reach;
struct sli_query;
struct sli_rhs;
struct sli_vectors;
struct sli_packed;
struct sli_null_dot;

/* What a factor that skips null pivots calls. Factorizations and solves know of null spaces only
 * what is in these two structs: impl/singular is not there with SL_NO_SINGULAR. */
typedef struct sli_singular {
    /* The arrays that solves read, and the scratch of a factorization. */
    void (*layout)(sl_factor *F, sli_block *b, int has_mass);
    void (*layout_scratch)(sl_factor *F, sli_block *b);
    /* Copies the arrays among the options. */
    sl_status (*fill)(sl_factor *F, const sl_options *opt, sl_stats *stats);
    /* Before a factorization: which pivots are null because a null vector is known. After it: finds
     * the null pivots and prepares solves, or looks for the cause of a refusal. */
    sl_status (*prepare)(sl_factor *F, const struct sli_source *from, struct sli_failure *failure);
    sl_status (*finish)(sl_factor *F, const struct sli_source *from, struct sli_failure *failure);

    /* The calls of solves, where there are null pivots. y := P b and L^-1 y for a block of
     * right-hand sides; 0: one is inconsistent. */
    int (*load)(const sl_factor *F, const struct sli_query *q, const struct sli_vectors *v,
                const struct sli_rhs *rhs);
    /* y := L^-1 y, and y(k) := z' b at known null vectors. */
    void (*forward)(const sl_factor *F, const struct sli_reach *R, const struct sli_vectors *v,
                    sl_int nrhs);
    /* Are all right-hand sides consistent? */
    int (*check)(const sl_factor *F, const struct sli_query *q, const struct sli_rhs *rhs,
                 void *memory);
    /* Between the sweeps: chooses the solution, but not where pins hold (uses, or NULL). */
    void (*center)(const sl_factor *F, const struct sli_query *q, const struct sli_vectors *v,
                   sl_int lanes, const sl_int *uses);
    /* The sums of |b|, and z' b of one null pivot after the other. */
    void (*norms)(const struct sli_packed *b, double *norms);
    int (*next_dot)(const sl_factor *F, const struct sli_packed *b, sl_int first, sl_int root,
                    struct sli_null_dot *dot);
} sli_singular;

/* The table if null pivots are skipped and it is there; else NULL. Defined where that is known. */
static const sli_singular *sli_singular_of(int skips_nulls);
/* What the options ask for that is not compiled in, as the text of an error; NULL: nothing. */
static const char *sli_singular_missing(const sl_options *opt);
/* Refuses a call that is about null spaces if they are not compiled in. */
SLI_INLINE sl_status sli_singular_needed(void) {
    if (sli_singular_of(1) == NULL) {         /* branches untested: they are */
        return sli_refuse(SL_ERR_UNSUPPORTED, /* untested: the same */
                          "the call: compiled with SL_NO_SINGULAR");
    }
    return SL_OK;
}

/* The null space of a semidefinite matrix: what is known of it, and what solves need. */
typedef struct sli_null_space {
    const sli_singular *calls; /* NULL: null pivots are refused or regularized */
    double consistency; /* the bound on |z' b| relative to the sum of |b|; negative: no check */
    int checks;         /* there are null pivots, and solves check that b is consistent */
    int is_centered;    /* there are null pivots, and solves center x by the weights in mass */
    sl_int count;
    sl_int *pivots; /* n: the `count` skipped pivots, ascending */
    sl_int n_anchors;
    /* components: null pivots whose null vectors the weights fix, ascending, at most one a tree */
    sl_int *anchors;
    double *mass;   /* n: the weights m in pivot order; NULL: none */
    sl_int vectors; /* columns of z and g */
    double *z;      /* n x vectors: the assumed null vectors of all components */
    /* n x vectors: one: z in trees with one component whose null vector is known, else 0;
     * several: the null vectors that are known, 1 in one anchor each and 0 in the others */
    double *g;
    /* n: v = D^+ w, w = L^-1 P m / z' m, D^+ the pseudo-inverse of D (singular/nullspace.h); where
     * there are several null vectors, n x 2 vectors: U and V (singular/center_several.h) */
    double *center;
    double *squares; /* components: w' D^+ w of the tree of each anchor */
    double *ratios;  /* components: (e' L^-1 P m) / z' m for known z; 0: z is computed from L */

    /* scratch */
    int has_duplicates; /* of the pattern; known with the scratch arrays */
    sli_null_row *rows; /* n */
    sl_int *last;       /* n: the last pivot of each component */
    double *rounding;   /* n: for the rule */
    double *sweep;      /* of a kernel */
    /* where there are several null vectors (singular/basis.h): n: the pivot before in the
     * component, -1 at the first one; the entries of each row of A; n x (vectors + 2): A z, |A| |z|
     * and the diagonal of A */
    sl_int *chain, *row_entries;
    double *products;
} sli_null_space;

#endif
