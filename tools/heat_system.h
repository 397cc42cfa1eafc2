/* heat_system.h: a mesh's diffusion operator M + t L, factored and ready to be asked */
#ifndef TOOLS_HEAT_SYSTEM_H
#define TOOLS_HEAT_SYSTEM_H

#include "app.h"

/** (M + t L) x = b moves heat b for a time t by one implicit step: M the lumped mass, L the cotangent Laplacian. */
typedef struct heat_system {
    double t;
    sl_matrix *matrix; /* lower triangle of M + t L */
    sl_csc A;          /* a view of it */
    sl_symbolic *S;
    sl_factor *F;
    sl_stats stats; /* of analysis and factorization */
} heat_system;

/** Assembles, analyses and factors; dies with a reason where that fails. Release with heat_system_free. */
void heat_system_create(heat_system *h, const mesh *m, double t);

/** Other values of t: assembled and factored again over the same analysis. */
void heat_system_set_time(heat_system *h, const mesh *m, double t);

void heat_system_free(heat_system *h);

/** The options --time and --scaled-time and what they come to; both start as 0. */
typedef struct heat_time {
    double time;
    double scaled;
} heat_time;

#define HEAT_TIME_OPTIONS(h)                                                                       \
    {OPTION_REAL, "time", &(h)->time, "T", "diffuse for the time T"}, {                            \
        OPTION_REAL, "scaled-time", &(h)->scaled, "S",                                             \
            "diffuse for S times the squared mean length of an edge (1)"                           \
    }

/** The time asked for; dies on one that is not positive. */
double heat_time_value(const heat_time *h, const mesh *m);

#endif
