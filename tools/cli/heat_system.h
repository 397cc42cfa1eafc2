/* heat_system.h: a mesh's diffusion operator M + t L, factored and ready to be asked */
#ifndef TOOLS_HEAT_SYSTEM_H
#define TOOLS_HEAT_SYSTEM_H

#include "app.h"

/** (M + t L) x = b moves heat b for a time t by one implicit step: M the lumped mass, L the cotangent Laplacian.
 *
 *  With L phi = lambda M phi and phi' M phi = 1, the entries of the inverse are sums over all eigenvectors,
 *  x_ij = sum phi_i phi_j / (1 + t lambda): heat that one unit at j leaves at i, a unit of area.
 */
typedef struct heat_system {
    sl_int n;
    double t;         /* of F */
    double *terms[2]; /* M and L in the order of the analysis: what every M + t L is read from */
    sl_symbolic *S;
    sl_factor *F;            /* NULL: only analysed so far */
    sl_stats stats;          /* of analysis and factorization */
    double seconds_assemble; /* for L and M */
} heat_system;

/** Assembles and analyses; dies with a reason where that fails. Release with heat_system_free. */
void heat_system_analyse(heat_system *h, const mesh *m);

/** heat_system_analyse, and h->F of M + t L. */
void heat_system_create(heat_system *h, const mesh *m, double t);

/** Factors of M + t[k] L, all by one call; dies with a reason where that fails.
 *
 *  factors  [in,out]  count of them: all NULL, or all of an earlier call with this h, which are then factored again in
 *                     their own memory. Release with sl_factor_free.
 *  t        [in]      count times.
 *  threads  [in]      how many and whose, as in sl_batch_factor.
 */
void heat_system_factors(heat_system *h, sl_factor **factors, const double *t, sl_int count,
                         const sl_threads *threads);

void heat_system_free(heat_system *h);

/** The options --time, --scaled-time and --area-time, and what they come to; all start as 0. */
typedef struct heat_time {
    double time;
    double scaled;
    double area;
} heat_time;

#define HEAT_TIME_OPTIONS(h, default_text)                                                         \
    {OPTION_REAL, "time", &(h)->time, "T", "diffuse for the time T"},                              \
        {OPTION_REAL, "scaled-time", &(h)->scaled, "S",                                            \
         "diffuse for S times the squared mean length of an edge"},                                \
    {                                                                                              \
        OPTION_REAL, "area-time", &(h)->area, "A",                                                 \
            "diffuse for A times the area of the surface; " default_text                           \
    }

/** The time asked for; where none is, default_area times the area if that is above 0, else the squared mean length of an
 *  edge. Dies on a time that is not positive. */
double heat_time_value(const heat_time *h, const mesh *m, double default_area);

/** Area of all faces. */
double heat_area(const mesh *m);

#endif
