/* subjects.h: a system factored by each version, with plans, and the rows that are timed on it */
#ifndef BENCH_LAST_SUBJECTS_H
#define BENCH_LAST_SUBJECTS_H

#include "bench/lib/bench.h"
#include "last.h"
#include "race.h"

enum { MOST_RHS = 8, VERTICES = 64 };

typedef enum row_kind {
    ROW_VERTEX,   /* b and x at one vertex, on a plan */
    ROW_PAIR,     /* b at a vertex, x at another, on a plan */
    ROW_PATCH,    /* b and x at 1000 vertices, on a plan */
    ROW_ONE_SHOT, /* b and x at one vertex, without a plan */
    ROW_FULL,
    ROW_REFACTOR,
    ROW_FACTOR,
    ROW_COLD,     /* analysis, factor, a full solve */
    ROW_COLD_ONE, /* the same in an order for one factor */
    ROW_KINDS
} row_kind;

extern const char *const row_names[ROW_KINDS];

/** Whether a row is a solve, which is timed with several right-hand sides. */
int row_is_solve(row_kind kind);

/* A list of local solves; the plans of a subject have the same order. */
typedef struct query_list {
    int count;
    last_query queries[VERTICES];
    int bsets[VERTICES], xsets[VERTICES];
} query_list;

/* One system and what is asked of it, the same for all versions. */
typedef struct last_case {
    char name[64];
    last_matrix A;
    int *order; /* n: that of the newest version, which all versions use */
    query_list vertices, pairs, patch;
    int *patch_vertices;
    double *B, *X, *reference; /* n x MOST_RHS */
} last_case;

/** Chooses vertices, pairs and a patch, and orders A by header. Exits with a message on errors. */
void case_create(last_case *c, const char *name, const sl_csc *A, const last_header *header);
void case_free(last_case *c);

/* One version on a case. */
typedef struct subject {
    const last_case *on;
    const last_header *header;
    void *state;
    void *vertices[VERTICES], *pairs[VERTICES], *patch[1];
} subject;

/** Returns 0, or the sl_status of the version; release in either case. */
int subject_create(subject *s, const last_case *c, const last_header *header, last_isa isa);
void subject_free(subject *s);

/** Checks a few results of every kind of row against full solves of the first subject, whose
 *  residuals are checked. Returns the number of results that differ by more than rounding.
 */
int subjects_check(const subject *subjects, int count);

/** Times one kind of row for all subjects: seconds of one solve, factor or cold start. extra: how
 *  often subject 0 does the work beyond once, to test the measurement. Returns 0 or an sl_status.
 */
int subjects_race(double *least, const subject *subjects, int count, row_kind kind, int nrhs,
                  int extra, double seconds);

#endif
