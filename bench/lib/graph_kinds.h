/* graph_kinds.h: small systems of the many kinds that a solver meets, made from graphs */
#ifndef BENCH_GRAPH_KINDS_H
#define BENCH_GRAPH_KINDS_H

#include "bench.h"

typedef enum kind_group {
    KIND_SURFACES,
    KIND_THIN, /* strips, tubes, sheets that branch: separators of a few rows */
    KIND_GRADED,
    KIND_VOLUMES,
    KIND_FANS, /* CAD parts: faces of one vertex and long rows of others */
    KIND_NETWORKS,
    KIND_DENSE_ROWS, /* k-harmonic systems and systems of small blocks: 20 and more entries a row */
    KIND_GROUPS
} kind_group;

enum { KINDS = 35 };

extern const char *const kind_group_names[KIND_GROUPS];

/** The name and the group of system k of 0 .. KINDS-1. The systems of a group are consecutive. */
const char *kind_name(int k);
kind_group kind_group_of(int k);

/** The lower triangle of system k, positive definite, the same in every run; release with
 *  sl_matrix_free. It is the Laplacian of a graph plus 0.01, or a k-harmonic system of a grid. */
sl_matrix *kind_matrix(int k);

#endif
